//! Every asset has its row with source and licence.

use crate::none;

#[test]
fn every_asset_stands_in_the_table_with_source_and_licence() {
    let root = endline_tests::root().join("assets");
    let readme = std::fs::read_to_string(root.join("README.md")).expect("assets/README.md");
    let rows: Vec<Vec<&str>> = readme
        .lines()
        .filter(|line| line.starts_with("| `"))
        .map(|line| line.trim_matches('|').split('|').map(str::trim).collect())
        .collect();
    let mut complaints = Vec::new();
    for file in endline_tests::files_below(&root).expect("the assets can be read") {
        let inside = file.strip_prefix(&root).expect("below assets").to_string_lossy().into_owned();
        let covers = |row: &&Vec<&str>| {
            let place = row[0].trim_matches('`');
            inside == place || (place.ends_with('/') && inside.starts_with(place))
        };
        let row = rows.iter().find(covers);
        let whole =
            row.is_some_and(|row| row.len() == 5 && row.iter().all(|cell| !cell.is_empty()));
        if !whole && inside != "README.md" {
            complaints.push(format!("assets/{inside}"));
        }
    }
    none(&complaints, "assets/README.md lacks a row with source and licence for these");
}
