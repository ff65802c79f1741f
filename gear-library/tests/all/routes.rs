//! Routes of observed whales in shipped studies, counted again from the table that they name as their source.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use endline_gear::Study;

/// Counts of right whales seen with gear, by the places that their accounts name: mouth or head, flipper or body, tail, several.
fn counts(table: &str) -> [u64; 4] {
    let mut reader = csv::ReaderBuilder::new().comment(Some(b'#')).from_reader(table.as_bytes());
    let mut counts = [0; 4];
    for row in reader.deserialize::<BTreeMap<String, String>>() {
        let row = row.unwrap();
        let is = |column: &str| row[column] == "1";
        if row["species"] != "right whale" || row["ocean"] != "ATL" || !is("gear_present") {
            continue;
        }
        let places = [is("mouth") || is("head"), is("flipper") || is("body"), is("tail")];
        match places.iter().filter(|place| **place).count() {
            0 => {}
            1 => counts[places.iter().position(|place| *place).unwrap()] += 1,
            _ => counts[3] += 1,
        }
    }
    counts
}

#[test]
fn the_routes_of_a_study_are_those_of_its_source() {
    let library = Path::new(env!("CARGO_MANIFEST_DIR"));
    let read = |file: &str| fs::read_to_string(library.join(file)).unwrap();
    let study = Study::read("weak-links.toml", &read("studies/weak-links.toml")).unwrap();
    let routes = study.routes.unwrap();
    assert!(routes.source.contains("cases/tables/noaa-entanglement-cases.csv"));
    let stated = [routes.mouth, routes.flipper, routes.tail, routes.several];
    assert_eq!(stated, counts(&read("cases/tables/noaa-entanglement-cases.csv")));
}
