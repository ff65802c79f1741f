//! A study's folder of results: what it belongs to, and its blocks of encounters.
//!
//! | file | what |
//! |---|---|
//! | `study.json` | the study: hash, version, size, registered events and claims (`registration`) |
//! | `block-00012.parquet` | rows of encounter 12, whole or not there |
//! | `table.parquet`, `table.csv` | all rows, once merged; rows of blocks whose files are not there are read from it |
//! | `leases` | which process runs which block, while some do |

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::{Arc, OnceLock};
use std::{fs, io};

use endline_gear::read;
use serde::{Deserialize, Serialize};

use crate::campaign::folder;
use crate::error::Error;
use crate::save;

use super::prepared::PreparedStudy;
use super::registration::Registration;
use crate::table::{Column, Row, Table, parquet};

/// Encounters of a block: what a killed program loses at most, for each thread.
pub const BLOCK: u32 = 1;

/// Name of the schema of `study.json`.
const SCHEMA: &str = "endline.study/1";

/// Which study a folder belongs to.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Label {
    /// Always `endline.study/1`.
    pub schema: String,
    /// Id of the study.
    pub study: String,
    /// Hash of what defines its runs.
    pub hash: String,
    /// Version of Endline.
    pub version: String,
    /// Encounters asked for.
    pub encounters: u64,
    /// Encounters of a block.
    pub block: u32,
    /// Ids of the options.
    pub options: Vec<String>,
    /// The registration at the time when the folder was made.
    #[serde(default)]
    pub registration: Registration,
}

impl Label {
    fn of(opened: &PreparedStudy) -> Self {
        Self {
            schema: SCHEMA.into(),
            study: opened.study.id.clone(),
            hash: opened.hash.clone(),
            version: crate::VERSION.into(),
            encounters: opened.study.encounters,
            block: BLOCK,
            options: opened.options.iter().map(|option| option.id.clone()).collect(),
            registration: Registration::of(&opened.study),
        }
    }
}

/// A folder of results of one study.
#[derive(Clone, Debug)]
pub struct Folder {
    /// Where.
    pub path: PathBuf,
    /// The registration before the first run.
    pub registration: Registration,
    /// Hash of the study whose rows are in the folder.
    pub hash: String,
    /// Version of Endline that computed them.
    pub version: String,
    encounters: u32,
    merged: Arc<OnceLock<MergedRows>>,
}

/// Rows of the merged table, and where those of each encounter are. Empty if there is no table of the study.
#[derive(Debug, Default)]
struct MergedRows {
    table: Table,
    places: BTreeMap<u32, Range<usize>>,
}

impl MergedRows {
    fn new(table: Table) -> Self {
        let mut places: BTreeMap<u32, Range<usize>> = BTreeMap::new();
        if let Some(Column::Whole(encounters)) = table.column("encounter") {
            for (row, encounter) in encounters.iter().enumerate() {
                let Ok(encounter) = u32::try_from(*encounter) else { continue };
                places.entry(encounter).or_insert(row..row).end = row + 1;
            }
        }
        Self { table, places }
    }

    /// The rows of encounters, which lie one after the other.
    fn of(&self, encounters: Range<u32>) -> Table {
        let own = || self.places.range(encounters.clone()).map(|(_, rows)| rows);
        let rows =
            own().next().map_or(0, |rows| rows.start)..own().next_back().map_or(0, |rows| rows.end);
        debug_assert_eq!(own().map(ExactSizeIterator::len).sum::<usize>(), rows.len());
        self.table.slice(rows)
    }
}

impl Folder {
    /// Where the folder of a study's results is under a root: its id and the head of its hash.
    pub fn path_under(root: &Path, opened: &PreparedStudy) -> PathBuf {
        folder::path_under(root, &opened.study.id, &opened.hash)
    }

    /// Opens a folder for a study, made where it is not there.
    /// Errors: a folder that belongs to another study, or cannot be written.
    pub fn open(path: &Path, opened: &PreparedStudy) -> Result<Self, Error> {
        folder::make(path)?;
        let file = path.join("study.json");
        let label = Label::of(opened);
        let label = match folder::read_label(&file)? {
            None => {
                without_blocks(path)?;
                folder::write_label(&file, &label)?;
                label
            }
            Some(found) => same(&file, found, &label)?,
        };
        Ok(Self::with(path, opened, label))
    }

    /// Opens a folder of kept results for reading: another version of the program, or another library, may have computed its rows.
    /// Errors: a folder without a label, or whose study has another id or other options.
    pub fn open_kept(path: &Path, opened: &PreparedStudy) -> Result<Self, Error> {
        let file = path.join("study.json");
        let found: Label = folder::read_label(&file)?
            .ok_or_else(|| Error::at(&file, "is missing: no results are kept in this folder"))?;
        let own = Label::of(opened);
        if found.study != own.study || found.options != own.options {
            let message = format!(
                "belongs to the study `{}` with the options {}, not to `{}` with the options {}; name the study file that is kept beside it",
                found.study,
                found.options.join(", "),
                own.study,
                own.options.join(", ")
            );
            return Err(Error::at(&file, message));
        }
        Ok(Self::with(path, opened, found))
    }

    fn with(path: &Path, opened: &PreparedStudy, label: Label) -> Self {
        Self {
            path: path.to_path_buf(),
            registration: label.registration,
            hash: label.hash,
            version: label.version,
            encounters: u32::try_from(opened.study.encounters).unwrap_or(u32::MAX),
            merged: Arc::default(),
        }
    }

    /// The rows of the merged table.
    /// Errors: no merged table, one that is damaged, or of another study.
    pub fn merged(&self) -> Result<Table, Error> {
        let file = self.path.join("table.parquet");
        let bytes = read::bytes(&file).map_err(|error| {
            Error::at(&file, format!("cannot be read: {error}; run `endline study merge` first"))
        })?;
        let (table, tags) = parquet::read(bytes)
            .map_err(|error| Error::at(&file, format!("is damaged: {error}; merge again")))?;
        if !tags.iter().any(|(key, value)| key == "study" && *value == self.hash) {
            return Err(Error::at(&file, "was merged from another study; merge again"));
        }
        Ok(table)
    }

    /// Checks that a merged table without any file of a block can be read: a study would otherwise begin anew beside it.
    /// Errors: as [`merged`](Self::merged), and a folder that cannot be read.
    pub fn check_merged(&self) -> Result<(), Error> {
        if self.path.join("table.parquet").is_file() && self.written()?.is_empty() {
            self.merged()?;
        }
        Ok(())
    }

    fn merged_rows(&self) -> &MergedRows {
        self.merged.get_or_init(|| self.merged().map(MergedRows::new).unwrap_or_default())
    }

    /// The folder with the first encounters only.
    #[must_use]
    pub fn first(&self, encounters: u32) -> Self {
        Self { encounters: self.encounters.min(encounters), ..self.clone() }
    }

    /// Number of encounters before the first missing block.
    pub fn first_stored(&self) -> u32 {
        let there = (0..self.blocks()).take_while(|block| self.is_stored(*block)).count();
        self.encounters.min(u32::try_from(there).unwrap_or(u32::MAX).saturating_mul(BLOCK))
    }

    /// Number of blocks.
    pub fn blocks(&self) -> u32 {
        self.blocks_of(self.encounters)
    }

    /// Number of blocks of the first encounters.
    pub fn blocks_of(&self, encounters: u32) -> u32 {
        encounters.div_ceil(BLOCK)
    }

    /// The encounters of a block.
    pub fn encounters_of(&self, block: u32) -> Range<u32> {
        block * BLOCK..((block + 1) * BLOCK).min(self.encounters)
    }

    /// The file of a block.
    pub fn file_of(&self, block: u32) -> PathBuf {
        self.path.join(format!("block-{block:05}.parquet"))
    }

    /// Whether the rows of a block are in its file or in the merged table; the file may be damaged.
    pub fn is_stored(&self, block: u32) -> bool {
        self.file_of(block).is_file() || self.is_merged(block)
    }

    fn is_merged(&self, block: u32) -> bool {
        let places = &self.merged_rows().places;
        self.encounters_of(block).all(|encounter| places.contains_key(&encounter))
    }

    /// Whether a block is there, whole and of this study.
    pub fn has(&self, block: u32) -> bool {
        self.is_stored(block) && self.read(block).is_ok()
    }

    /// Blocks whose files are there, read or not, and those of the merged table.
    /// Errors: a folder that cannot be read.
    pub fn written(&self) -> Result<BTreeSet<u32>, Error> {
        let number =
            |name: &str| name.strip_prefix("block-")?.strip_suffix(".parquet")?.parse::<u32>().ok();
        let entries = fs::read_dir(&self.path).and_then(Iterator::collect::<io::Result<Vec<_>>>);
        let entries = entries.map_err(Error::on(&self.path, "cannot be read"))?;
        let merged = (0..self.blocks()).filter(|block| self.is_merged(*block));
        Ok(entries
            .iter()
            .filter_map(|entry| number(&entry.file_name().to_string_lossy()))
            .chain(merged)
            .collect())
    }

    /// Writes the rows of a block, whole or not at all.
    /// Errors: rows of unlike columns, or a folder that cannot be written; the block is then not there.
    pub fn write(&self, block: u32, rows: Vec<Row>) -> Result<(), Error> {
        let file = self.file_of(block);
        let table = Table::of(rows)
            .map_err(|wrong| Error::at(&file, format!("cannot be written: {wrong}")))?;
        let tags =
            [("study".to_owned(), self.hash.clone()), ("block".to_owned(), block.to_string())];
        let bytes =
            parquet::write(&table, &tags).map_err(Error::on(&file, "cannot be put together"))?;
        save::atomically(&file, &bytes).map_err(|error| {
            Error::at(
                &file,
                format!("cannot be written: {error}; stored blocks are complete, and the same command continues from them"),
            )
        })
    }

    /// Adds the rows of a block to a table.
    /// Errors: as [`read`](Self::read), and a block whose columns are not those of the table.
    pub fn append(&self, block: u32, table: &mut Table) -> Result<(), Error> {
        table.append(self.read(block)?).map_err(|wrong| {
            let message = format!(
                "does not fit the other blocks: {wrong}; delete it and run the study again"
            );
            Error::at(&self.file_of(block), message)
        })
    }

    /// The rows of a block.
    /// Errors: a block that is neither in a file nor in the merged table; a file that is damaged or belongs to another study.
    pub fn read(&self, block: u32) -> Result<Table, Error> {
        let file = self.file_of(block);
        if !file.is_file() && self.is_merged(block) {
            return Ok(self.merged_rows().of(self.encounters_of(block)));
        }
        let bytes = read::bytes(&file).map_err(Error::on(&file, "cannot be read"))?;
        let wrong =
            |what: &str| Error::at(&file, format!("{what}; delete it and run the study again"));
        let (table, tags) =
            parquet::read(bytes).map_err(|error| wrong(&format!("is damaged: {error}")))?;
        let tag = |key: &str| {
            tags.iter()
                .find(|(known, _)| known == key)
                .map(|(_, value)| value.as_str())
                .unwrap_or_default()
        };
        if tag("study") != self.hash || tag("block") != block.to_string() {
            return Err(wrong("holds rows of another study or block"));
        }
        let own = self.encounters_of(block);
        let own = i64::from(own.start)..i64::from(own.end);
        let Some(Column::Whole(encounters)) = table.column("encounter") else {
            return Err(wrong("has no column `encounter`"));
        };
        if !encounters.iter().all(|encounter| own.contains(encounter)) {
            return Err(wrong("has rows of encounters of another block"));
        }
        Ok(table)
    }
}

/// A folder without a label is new; blocks in it belong to an unknown study.
fn without_blocks(path: &Path) -> Result<(), Error> {
    let files = fs::read_dir(path).into_iter().flatten().flatten();
    let is_block = |name: &str| name.starts_with("block-") && name.ends_with(".parquet");
    if files.into_iter().any(|file| is_block(&file.file_name().to_string_lossy())) {
        let message = "has blocks of encounters but no study.json, which says of which study they are; put it back, or choose another folder with --out";
        return Err(Error::at(path, message));
    }
    Ok(())
}

/// A folder's label, if it is that of the study, with any number of encounters.
fn same(file: &Path, found: Label, label: &Label) -> Result<Label, Error> {
    if found.hash == label.hash && found.block == label.block {
        return Ok(found);
    }
    let short = |hash: &str| hash.chars().take(16).collect::<String>();
    let message = format!(
        "belongs to the study `{}` of hash {} (Endline {}), not to `{}` of hash {}: study, scenario, library, plugins or program have changed; choose another folder with --out; `endline study report --kept` reports the rows that are there",
        found.study,
        short(&found.hash),
        found.version,
        label.study,
        short(&label.hash)
    );
    Err(Error::at(file, message))
}
