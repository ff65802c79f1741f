//! The shape that the workspace keeps.
//!
//! Each list names what does not keep it yet. A list only ever becomes shorter: an entry that is no
//! longer true fails its test too.

use std::collections::BTreeSet;
use std::path::Path;
use std::sync::OnceLock;

use super::sizes::{Measured, Sizes, over, quantile};
use super::tree::Crate;
use super::{ARGUMENTS_MAX, FILE_MAX, FILE_MEDIAN, FUNCTION_MAX, FUNCTION_MEDIAN, FUNCTION_P95};

/// Files that stand in a circle.
const IN_CIRCLES: [&str; 0] = [];
/// Files that are too long.
const LONG_FILES: [&str; 0] = [];
/// Functions that are too long: file and name.
const LONG_FUNCTIONS: [&str; 0] = [];
/// Functions with too many arguments: file and name.
const MANY_ARGUMENTS: [&str; 0] = [];

fn house() -> &'static [Crate] {
    static HOUSE: OnceLock<Vec<Crate>> = OnceLock::new();
    HOUSE.get_or_init(|| {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).ancestors().nth(2).unwrap();
        super::read(root, None).unwrap()
    })
}

/// Fails where what breaks a rule is not exactly what is known to.
fn same(found: BTreeSet<String>, known: &[&str], rule: &str) {
    let known: BTreeSet<String> = known.iter().map(|name| (*name).to_owned()).collect();
    let list = |of: &BTreeSet<String>, without: &BTreeSet<String>| {
        of.difference(without).cloned().collect::<Vec<String>>().join("\n  ")
    };
    let (new, gone) = (list(&found, &known), list(&known, &found));
    assert!(new.is_empty(), "{rule} (`cargo xtask shape` shows more):\n  {new}");
    assert!(gone.is_empty(), "no longer so: take it off the list:\n  {gone}");
}

/// Places without the number of the line, which changes with each edit.
fn without_line(measured: &[Measured]) -> BTreeSet<String> {
    let name = |place: &str| {
        let (file, rest) = place.split_once(':')?;
        Some(format!("{file} {}", rest.split_once(' ')?.1))
    };
    let all = measured.iter();
    all.map(|one| name(&one.place).unwrap_or_else(|| one.place.clone())).collect()
}

#[test]
fn files_that_name_each_other_are_parent_and_child() {
    let circles = house().iter().flat_map(super::circles::circles);
    let files = circles.flat_map(|circle| circle.files).collect();
    same(files, &IN_CIRCLES, "files must not name each other in circles");
}

#[test]
fn files_are_short() {
    let sizes = Sizes::of(house());
    assert!(sizes.files.len() > 400, "the whole workspace is read");
    assert!(quantile(&sizes.files, 0.5) <= FILE_MEDIAN, "half the files are short");
    same(without_line(over(&sizes.files, FILE_MAX)), &LONG_FILES, "a file is too long");
}

#[test]
fn functions_are_short() {
    let sizes = Sizes::of(house());
    assert!(sizes.functions.len() > 3000, "the whole workspace is read");
    assert!(quantile(&sizes.functions, 0.5) <= FUNCTION_MEDIAN, "half the functions are short");
    assert!(quantile(&sizes.functions, 0.95) <= FUNCTION_P95, "few functions are long");
    let long = without_line(over(&sizes.functions, FUNCTION_MAX));
    same(long, &LONG_FUNCTIONS, "a function is too long");
}

#[test]
fn functions_take_few_arguments() {
    let many = without_line(over(&Sizes::of(house()).arguments, ARGUMENTS_MAX));
    same(many, &MANY_ARGUMENTS, "a function takes too many arguments: give it a small struct");
}
