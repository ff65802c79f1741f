//! Routes of observed whales in shipped studies, counted again from the table that they name as their source.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use endline_gear::Study;

#[test]
fn the_routes_of_a_study_are_those_of_its_source() {
    let library = Path::new(env!("CARGO_MANIFEST_DIR"));
    let read = |file: &str| fs::read_to_string(library.join(file)).unwrap();
    let study = Study::read("weak-links.toml", &read("studies/weak-links.toml")).unwrap();
    let routes = study.routes.unwrap();
    assert!(routes.source.contains("cases/tables/noaa-entanglement-cases.csv"));
    let stated = [routes.mouth, routes.flipper, routes.tail, routes.several];
    let table = read("cases/tables/noaa-entanglement-cases.csv");
    let mut reader = csv::ReaderBuilder::new().comment(Some(b'#')).from_reader(table.as_bytes());
    // Mouth or head, flipper or body, tail, several.
    let mut counts = [0; 4];
    for row in reader.deserialize::<BTreeMap<String, String>>() {
        let row = row.unwrap();
        let is = |column: &str| row[column] == "1";
        if row["species"] != "right whale" || row["ocean"] != "ATL" || !is("gear_present") {
            continue;
        }
        let places = [is("mouth") || is("head"), is("flipper") || is("body"), is("tail")];
        match places {
            [false, false, false] => {}
            [true, false, false] => counts[0] += 1,
            [false, true, false] => counts[1] += 1,
            [false, false, true] => counts[2] += 1,
            _ => counts[3] += 1,
        }
    }
    assert_eq!(stated, counts);
}
