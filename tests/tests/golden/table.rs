//! The table of golden states: a row for each scenario and step, with the hash of each part of the state.

use std::path::{Path, PathBuf};

use endline_session::hash::{PART_NAMES, StateHash};

/// The state of a scenario after a step.
pub struct Row {
    /// Name of the case.
    pub case: String,
    /// Steps taken.
    pub step: u64,
    /// Hash of the state, and of the input that led to it.
    pub hash: StateHash,
}

fn path() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden/states.csv")
}

/// Reads the table.
pub fn read() -> Vec<Row> {
    let text = std::fs::read_to_string(path()).unwrap();
    text.lines().skip(1).map(row).collect()
}

fn row(line: &str) -> Row {
    let cells: Vec<&str> = line.split(',').collect();
    let [case, step, parts @ ..] = cells.as_slice() else { panic!("a short row: {line}") };
    let parts: Vec<u64> = parts.iter().map(|part| u64::from_str_radix(part, 16).unwrap()).collect();
    let hash = StateHash { parts: parts.try_into().unwrap() };
    Row { case: (*case).to_owned(), step: step.parse().unwrap(), hash }
}

/// Writes the table anew.
pub fn write(rows: &[Row]) {
    let mut text = format!("scenario,step,{}\n", PART_NAMES.join(","));
    for row in rows {
        let parts = row.hash.parts.map(|part| format!("{part:016x}"));
        text += &format!("{},{},{}\n", row.case, row.step, parts.join(","));
    }
    std::fs::write(path(), text).unwrap();
}
