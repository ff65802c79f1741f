//! The rows of the benchmark in `docs/benchmark` are the observations of the library's studies and the checks of its cases.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking, in its helpers too")]

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use endline_gear::{Case, Study};

/// Expected range of a row, its kind and its source.
type Row = ([f64; 2], String, String);

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).to_owned()
}

fn rows() -> BTreeMap<String, Row> {
    let file = root().join("../docs/benchmark/rows.csv");
    let mut table = csv::Reader::from_path(file).unwrap();
    let heads = table.headers().unwrap().clone();
    let column = |name: &str| heads.iter().position(|head| head == name).unwrap();
    let of = |record: csv::StringRecord| {
        let text = |name: &str| record[column(name)].to_owned();
        let range = ["least", "greatest"].map(|name| text(name).parse().unwrap());
        (text("row"), (range, text("kind"), text("source")))
    };
    table.records().map(|record| of(record.unwrap())).collect()
}

/// Name and text of each TOML file of a folder of the library.
fn files(folder: &str) -> Vec<(String, String)> {
    let entries = fs::read_dir(root().join(folder)).unwrap().map(|entry| entry.unwrap().path());
    let is_toml = |path: &PathBuf| path.extension().is_some_and(|end| end == "toml");
    let mut files: Vec<PathBuf> = entries.filter(is_toml).collect();
    files.sort();
    let read = |path: PathBuf| (path.display().to_string(), fs::read_to_string(&path).unwrap());
    files.into_iter().map(read).collect()
}

#[test]
fn shares_of_the_benchmark_are_the_observations_of_the_studies() {
    let mut rows = rows();
    rows.retain(|_, (_, kind, _)| kind == "share");
    let mut seen = BTreeMap::new();
    for (name, text) in files("studies") {
        let study = Study::read(&name, &text).unwrap();
        for own in study.observations.into_iter().filter(|own| own.by_construction.is_none()) {
            let row = rows.get(&own.id.value);
            let (range, _, source) = row.unwrap_or_else(|| panic!("no row {}", own.id.value));
            let apart = (range[0] - own.observed[0]).abs() + (range[1] - own.observed[1]).abs();
            assert!(apart < 1e-12, "{}: {range:?} and {:?}", own.id.value, own.observed);
            assert_eq!(*source, own.source, "{}", own.id.value);
            seen.insert(own.id.value, ());
        }
    }
    assert!(rows.len() > 20 && rows.keys().all(|row| seen.contains_key(row)), "{rows:?}");
}

#[test]
fn every_case_has_a_row_of_the_benchmark_for_each_check() {
    let mut rows = rows();
    rows.retain(|_, (_, kind, _)| kind != "share");
    for (name, text) in files("cases") {
        let case = Case::read(&name, &text).unwrap();
        let is_own = |row: &String| row.split('/').next() == Some(case.id.as_str());
        let own: Vec<&Row> =
            rows.iter().filter(|(row, _)| is_own(row)).map(|(_, row)| row).collect();
        // A check of several groups of measurements has a row for each.
        assert!(own.len() >= case.checks.len().max(1), "{}: {own:?}", case.id);
        for (range, kind, source) in own {
            assert!(range[0] <= range[1], "{}: {range:?}", case.id);
            assert_eq!(*kind == "measured", case.confidence.word() == "measured", "{}", case.id);
            assert_eq!(*source, case.source, "{}", case.id);
        }
    }
}
