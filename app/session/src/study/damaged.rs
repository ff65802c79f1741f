//! Damaged results: a block or table whose bytes are not those that were written is refused, and nothing unread is written over.
//! Kept results: the merged table stands for the blocks, and another program reports it if asked to.

use std::fs;

use super::folder::Folder;
use super::results::{ResultsRequest, StudyResults};
use super::stats::Findings;
use super::tests::Place;
use super::{batch, merge};
use crate::campaign::Shard;
use crate::campaign::control::Control;
use crate::plugins::PluginHost;
use crate::table::{Cell, parquet, seal};

/// Numbers without a pattern, the same in every run (Knuth's MMIX).
struct Numbers(u64);

impl Numbers {
    fn below(&mut self, end: usize) -> usize {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as usize % end.max(1)
    }
}

/// Bytes damaged in one of eight ways; `other` is a sound file to take bytes from.
fn damaged(bytes: &[u8], other: &[u8], numbers: &mut Numbers) -> Vec<u8> {
    let mut made = bytes.to_vec();
    let (at, far) = (numbers.below(made.len()), numbers.below(made.len()));
    match numbers.below(8) {
        0 => made[at] ^= 1 << numbers.below(8),
        1 => made[at] = numbers.below(256) as u8,
        2 => made.truncate(at),
        3 => drop(made.drain(at.min(far)..at.max(far))),
        4 => made.swap(at, far),
        5 => made.insert(at, numbers.below(256) as u8),
        6 => made.copy_within(at.min(far)..at.max(far), 0),
        _ => made = [&bytes[..at], &other[at.min(other.len())..]].concat(),
    }
    made
}

#[test]
fn every_damage_of_a_block_or_table_is_refused_or_harmless() {
    let place = Place::new("damaged");
    let opened = place.open();
    let folder = Folder::open(&place.0.join("results"), &opened).unwrap();
    batch::run(&opened, &folder, Shard::WHOLE, 2, &Control::default()).unwrap();
    merge::save(&opened, &folder, &merge::merge(&opened, &folder).unwrap()).unwrap();
    let files = [folder.file_of(0), folder.file_of(1), folder.path.join("table.parquet")];
    let sound = files.map(|file| fs::read(file).unwrap());
    let tables = sound.each_ref().map(|bytes| parquet::read(bytes.clone()).unwrap().0);
    let many = if std::env::var_os("ENDLINE_LONG").is_some() { 100_000 } else { 3_000 };
    let (mut numbers, mut refused) = (Numbers(18), 0);
    for number in 0..many {
        let which = number % sound.len();
        let bytes = damaged(&sound[which], &sound[(which + 1) % sound.len()], &mut numbers);
        match parquet::read(bytes.clone()) {
            Err(_) => refused += 1,
            // A swap of equal bytes damages nothing; another file's bytes put in whole are that file.
            Ok((table, _)) => {
                let same = sound.iter().position(|sound| *sound == bytes).expect("a sound file");
                assert_eq!(table, tables[same]);
            }
        }
    }
    assert!(refused > many * 9 / 10, "{refused} of {many} were refused");
}

/// Damage under a seal that fits it: what a forger could write, and no accident does.
#[test]
fn a_forged_block_is_a_whole_table_or_an_error() {
    let place = Place::new("forged");
    let opened = place.open();
    let folder = Folder::open(&place.0.join("results"), &opened).unwrap();
    batch::run(&opened, &folder, Shard { part: 0, of: 12 }, 1, &Control::default()).unwrap();
    let sound = fs::read(folder.file_of(0)).unwrap();
    let many = if std::env::var_os("ENDLINE_LONG").is_some() { 100_000 } else { 1_000 };
    let (mut numbers, mut refused) = (Numbers(19), 0);
    for _ in 0..many {
        let mut bytes = damaged(&sound, &sound, &mut numbers);
        seal::seal(&mut bytes);
        match parquet::read(bytes) {
            Err(_) => refused += 1,
            Ok((table, _)) => {
                assert!(table.columns.iter().all(|(_, column)| column.len() == table.rows()));
            }
        }
    }
    assert!(refused > many / 4, "{refused} of {many} were refused");
}

#[test]
fn a_damaged_block_is_named_and_a_damaged_table_is_not_replaced_by_its_blocks() {
    let place = Place::new("named");
    let opened = place.open();
    let folder = Folder::open(&place.0.join("results"), &opened).unwrap();
    batch::run(&opened, &folder, Shard::WHOLE, 2, &Control::default()).unwrap();
    merge::save(&opened, &folder, &merge::merge(&opened, &folder).unwrap()).unwrap();

    // A block of another encounter under this one's name.
    fs::copy(folder.file_of(4), folder.file_of(3)).unwrap();
    let error = merge::merge(&opened, &folder).unwrap_err().to_string();
    assert!(
        error.contains("block-00003.parquet") && error.contains("run the study again"),
        "{error}"
    );
    assert!(!folder.has(3) && folder.has(4));
    batch::run(&opened, &folder, Shard::WHOLE, 1, &Control::default()).unwrap();
    assert!(folder.has(3), "the same command runs it again");

    let table = folder.path.join("table.parquet");
    let mut bytes = fs::read(&table).unwrap();
    bytes[100] ^= 4;
    fs::write(&table, bytes).unwrap();
    let request = ResultsRequest {
        file: Some(place.study()),
        folder: Some(folder.path.clone()),
        library: place.library(),
        ..ResultsRequest::default()
    };
    let error = StudyResults::read(request, &PluginHost::empty()).err().unwrap().to_string();
    assert!(error.contains("table.parquet") && error.contains("merge again"), "{error}");
}

#[test]
fn a_label_that_is_unreadable_or_gone_is_not_written_anew() {
    let place = Place::new("label");
    let opened = place.open();
    let path = place.0.join("results");
    let folder = Folder::open(&path, &opened).unwrap();
    batch::run(&opened, &folder, Shard { part: 0, of: 12 }, 1, &Control::default()).unwrap();
    let label = path.join("study.json");
    let no_text = [0xff, 0xfe, b'{'];
    fs::write(&label, no_text).unwrap();
    let error = Folder::open(&path, &opened).unwrap_err().to_string();
    assert!(error.contains("study.json") && error.contains("cannot be read"), "{error}");
    assert_eq!(fs::read(&label).unwrap(), no_text);
    fs::remove_file(&label).unwrap();
    let error = Folder::open(&path, &opened).unwrap_err().to_string();
    assert!(error.contains("no study.json") && error.contains("--out"), "{error}");
}

#[test]
fn a_block_whose_column_has_another_kind_is_named_with_column_row_and_kind() {
    let place = Place::new("kinds");
    let opened = place.open();
    let folder = Folder::open(&place.0.join("results"), &opened).unwrap();
    let row = |encounter: u32, depth: Cell| {
        let encounter = Cell::Whole(encounter.into());
        vec![("encounter".to_owned(), encounter), ("drawn_depth".to_owned(), depth)]
    };
    for block in 0..folder.blocks() {
        let depth = if block == 5 { Cell::Text("deep".into()) } else { Cell::Real(Some(2.0)) };
        folder.write(block, vec![row(block, depth)]).unwrap();
    }
    let error = merge::merge(&opened, &folder).unwrap_err().to_string();
    assert!(error.contains("block-00005.parquet"), "{error}");
    assert!(
        error.contains("column `drawn_depth`, row 6: expected a number, found a text"),
        "{error}"
    );
}

#[test]
fn the_merged_table_stands_for_blocks_that_are_gone_and_a_study_continues_from_it() {
    let place = Place::new("continued");
    let mut opened = place.open();
    opened.study.encounters = 8;
    let folder = Folder::open(&place.0.join("results"), &opened).unwrap();
    batch::run(&opened, &folder, Shard::WHOLE, 2, &Control::default()).unwrap();
    let first = merge::merge(&opened, &folder).unwrap();
    merge::save(&opened, &folder, &first).unwrap();
    for block in 0..folder.blocks() {
        fs::remove_file(folder.file_of(block)).unwrap();
    }

    opened.study.encounters = 12;
    let folder = Folder::open(&folder.path, &opened).unwrap();
    assert!((0..8).all(|block| folder.has(block)) && !folder.has(8));
    let done = batch::run(&opened, &folder, Shard::WHOLE, 2, &Control::default()).unwrap();
    assert_eq!((done.blocks.found, done.blocks.total), (8, 12));
    assert!(!folder.file_of(0).is_file() && folder.file_of(8).is_file());
    let continued = merge::merge(&opened, &folder).unwrap();

    // A table that cannot be read is not taken for none: the study would begin anew beside it.
    let alone = place.0.join("alone");
    fs::create_dir_all(&alone).unwrap();
    fs::copy(folder.path.join("study.json"), alone.join("study.json")).unwrap();
    fs::write(alone.join("table.parquet"), b"PAR1").unwrap();
    let torn = Folder::open(&alone, &opened).unwrap();
    let error = batch::run(&opened, &torn, Shard::WHOLE, 1, &Control::default()).unwrap_err();
    assert!(error.to_string().contains("table.parquet is damaged"), "{error}");

    let whole = Folder::open(&place.0.join("whole"), &opened).unwrap();
    batch::run(&opened, &whole, Shard::WHOLE, 2, &Control::default()).unwrap();
    assert_eq!(continued, merge::merge(&opened, &whole).unwrap());
}

#[test]
fn kept_results_of_another_program_are_reported_only_if_asked_for() {
    let place = Place::new("kept");
    let opened = place.open();
    let folder = Folder::open(&place.0.join("results"), &opened).unwrap();
    batch::run(&opened, &folder, Shard::WHOLE, 2, &Control::default()).unwrap();
    let own = merge::merge(&opened, &folder).unwrap();
    merge::save(&opened, &folder, &own).unwrap();

    // A change of the scenario changes the hash, as another program does.
    let scenario = place.library().join("studies/small.toml");
    let text = fs::read_to_string(&scenario).unwrap();
    fs::write(&scenario, text.replace("length = \"30 m\"", "length = \"31 m\"")).unwrap();
    let changed = place.open();
    let refused = Folder::open(&folder.path, &changed).unwrap_err().to_string();
    assert!(refused.contains("have changed") && refused.contains("--kept"), "{refused}");
    let kept = Folder::open_kept(&folder.path, &changed).unwrap();
    assert!(kept.hash != changed.hash && kept.hash == folder.hash);
    let runs = merge::load(&kept).unwrap();
    assert_eq!(runs, own);
    let findings = Findings::of(&changed, &runs, &kept);
    assert_eq!((&findings.hash, findings.options.len()), (&opened.hash, 2));

    let mut fewer = place.open();
    fewer.options.pop();
    let refused = Folder::open_kept(&folder.path, &fewer).unwrap_err().to_string();
    assert!(refused.contains("kept beside it"), "{refused}");
    let none = Folder::open_kept(&place.library(), &opened).unwrap_err().to_string();
    assert!(none.contains("no results are kept"), "{none}");
}
