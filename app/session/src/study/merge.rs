//! The table of a study, merged from its blocks.

use crate::error::Error;
use crate::save;

use super::folder::Folder;
use super::prepared::PreparedStudy;
use super::runs::Runs;
use super::stats::is_narrow;
use crate::campaign::{Shard, leases};
use crate::table::{Table, parquet};

/// Encounters between two tests of whether the interval is as narrow as the study asks.
const TEST_EVERY: u32 = 4;

/// The rows of all blocks in order, or of the first that are enough for the interval that the study asks for.
/// Errors: blocks that are missing, with the command that runs them, damaged, or of another study.
pub fn merge(opened: &PreparedStudy, folder: &Folder) -> Result<Runs, Error> {
    let mut table = Table::default();
    for block in 0..folder.blocks() {
        if !folder.is_stored(block) {
            return Err(missing(opened, folder));
        }
        folder.append(block, &mut table)?;
        if narrow(opened, &table, folder.encounters_of(block).end) {
            break;
        }
    }
    Runs::read(table).map_err(|wrong| Error::at(&folder.path, wrong.to_string()))
}

/// Writes `table.parquet` and `table.csv`, and removes the leases of processes that have ended.
/// Errors: where they cannot be written.
pub fn save(opened: &PreparedStudy, folder: &Folder, runs: &Runs) -> Result<(), Error> {
    let table = runs.table();
    let file = folder.path.join("table.parquet");
    let tags = [("study".to_owned(), opened.hash.clone())];
    let bytes = parquet::write(table, &tags).map_err(Error::on(&file, "cannot be put together"))?;
    for (file, bytes) in [(file, bytes), (folder.path.join("table.csv"), table.csv().into_bytes())]
    {
        save::atomically(&file, &bytes).map_err(Error::on(&file, "cannot be written"))?;
    }
    leases::clear(&folder.path);
    Ok(())
}

/// The merged rows.
/// Errors: where the study was not merged, or its table belongs to another study.
pub fn load(folder: &Folder) -> Result<Runs, Error> {
    let file = folder.path.join("table.parquet");
    Runs::read(folder.merged()?).map_err(|wrong| Error::at(&file, format!("{wrong}; merge again")))
}

/// Whether the blocks before the first missing one are enough for the interval that the study asks for.
pub fn is_enough(opened: &PreparedStudy, folder: &Folder) -> bool {
    if opened.study.enough.is_none() {
        return false;
    }
    let mut table = Table::default();
    for block in 0..folder.blocks() {
        if folder.append(block, &mut table).is_err() {
            return false;
        }
        if narrow(opened, &table, folder.encounters_of(block).end) {
            return true;
        }
    }
    false
}

fn narrow(opened: &PreparedStudy, table: &Table, encounters: u32) -> bool {
    let Some(enough) = &opened.study.enough else { return false };
    encounters.is_multiple_of(TEST_EVERY)
        && u64::from(encounters) >= enough.least
        && Runs::read(table.clone())
            .is_ok_and(|runs| is_narrow(&runs, &opened.options, &enough.event, enough.width))
}

fn missing(opened: &PreparedStudy, folder: &Folder) -> Error {
    let blocks: Vec<u32> = (0..folder.blocks()).filter(|block| !folder.is_stored(*block)).collect();
    let named: Vec<String> = blocks.iter().take(20).map(u32::to_string).collect();
    let more =
        if blocks.len() > 20 { format!(" and {} more", blocks.len() - 20) } else { String::new() };
    let first = folder.encounters_of(blocks.first().copied().unwrap_or_default()).start;
    let so_far = match first {
        0 => String::new(),
        first => format!("\nadd `--encounters {first}` to merge the first {first} alone"),
    };
    Error::at(
        &folder.path,
        format!(
            "lacks {} of {} blocks of encounters: {}{more}\nrun `endline study run {} --out {}` to add them{}{so_far}",
            blocks.len(),
            folder.blocks(),
            named.join(", "),
            opened.study.place.source.path,
            folder.path.display(),
            shards(&blocks)
        ),
    )
}

/// Shards, of common numbers of them, that hold the missing blocks.
fn shards(blocks: &[u32]) -> String {
    for of in [2, 3, 4, 7, 8, 16, 32, 64] {
        let parts: Vec<String> = (0..of)
            .filter(|part| blocks.iter().any(|block| Shard { part: *part, of }.holds(*block)))
            .map(|part| format!("{}/{of}", part + 1))
            .collect();
        if (1..=2).contains(&parts.len()) {
            return format!("; of {of} shards it is --shard {}", parts.join(" and "));
        }
    }
    String::new()
}
