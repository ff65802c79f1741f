//! Options that differ in strengths alone, weak places of lines included, share a run until something parts.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::collections::BTreeSet;
use std::fs;

use crate::common::Place;
use crate::studies::small;

/// Links and ropes of several strengths, in a rope that is drawn apart.
const PULL: &str = r#"
format = 1
kind = "study"
name = "Pull"
scenario = "weak-link-pull"
encounters = 1
baseline = "never"

[[option]]
id = "never"
set = { weak_links = false }

[[option]]
id = "late"
set = { "link.0.rating" = "6 kN" }

[[option]]
id = "middle"
set = { "link.0.rating" = "3 kN" }

[[option]]
id = "rope"
set = { weak_links = false, "ropes/polysteel-7-16.strength" = "400 lbf" }

[[option]]
id = "unbreakable"
set = { weak_links = false, unbreakable = true, "line.0.weak_places.strength" = "1 lbf", "line.0.weak_places.every" = "30 ft" }

[[option]]
id = "made-900"
strength = "900 lbf"
set = { weak_links = false, "line.0.delivered_strength" = "900 lbf" }

[[option]]
id = "made-900-link"
set = { "link.0.rating" = "6 kN", "line.0.delivered_strength" = "900 lbf" }

[[option]]
id = "made-500"
strength = "500 lbf"
set = { weak_links = false, "line.0.delivered_strength" = "500 lbf" }

[[option]]
id = "made-4000"
strength = "4000 lbf"
set = { weak_links = false, "line.0.delivered_strength" = "4,000 lbf" }

[[option]]
id = "made-900-until"
strength = "900 lbf"
until = "parted"
set = { weak_links = false, "line.0.delivered_strength" = "900 lbf" }

[[option]]
id = "places-hold"
[option.set]
weak_links = false
"line.0.delivered_strength" = "9,000 lbf"
"line.0.weak_places.strength" = "7,000 lbf"
"line.0.weak_places.every" = "30 ft"

[[option]]
id = "places-part"
[option.set]
weak_links = false
"line.0.delivered_strength" = "4,000 lbf"
"line.0.weak_places.strength" = "700 lbf"
"line.0.weak_places.every" = "30 ft"

# The tension is the same everywhere: one more place changes only where the line parts.
[[option]]
id = "places-part-near"
[option.set]
weak_links = false
"line.0.delivered_strength" = "4,000 lbf"
"line.0.weak_places.strength" = "700 lbf"
"line.0.weak_places.at" = ["2 m"]

[encounter.tide]
value = "0.1 m/s"
source = "assumed"
"#;

/// Options that part ways midway are run from there on only; each ends in the state of its whole run, that of a replay.
#[test]
fn a_run_begun_where_options_part_ways_is_the_whole_run() {
    let place = Place::new("study-branches");
    small(&place);
    let study = place.write("gear-library/studies/pull.toml", PULL).display().to_string();
    let out = place.folder.join("pull").display().to_string();
    place.endline(&["study", "run", &study, "--out", &out]).done();
    place.endline(&["study", "merge", &study, "--out", &out]).done();
    let rows = fs::read_to_string(place.path("pull/table.csv")).unwrap();
    let cell = |option: &str, column: &str| cell(&rows, option, column);
    let at: Vec<f64> = ["rope", "middle", "late"]
        .map(|option| cell(option, "parted_at_s").parse().unwrap())
        .to_vec();
    assert!(
        0.5 < at[0] && at[0] + 0.5 < at[1] && at[1] + 0.5 < at[2],
        "each parts after a look at the run: {at:?}"
    );
    let needed_n: f64 = cell("unbreakable", "needed_rope_N").parse().unwrap();
    assert_eq!(cell("unbreakable", "parted"), "");
    for (option, lbf) in [("made-500", 500.0), ("made-900", 900.0), ("made-4000", 4000.0)] {
        let parts = cell(option, "parted") == "warp";
        assert_eq!(parts, lbf * 4.448_221_615_260_5 < needed_n, "{option}, {needed_n} N needed");
    }
    // The line that parts has the same strength in both; the stronger link does not matter.
    assert_eq!(cell("made-900-link", "state_hash"), cell("made-900", "state_hash"));
    // Its run is that of the other until the line parts, and ends there.
    assert_eq!(cell("made-900-until", "parted_at_s"), cell("made-900", "parted_at_s"));
    assert_eq!(cell("made-900-until", "outcome"), "parted");
    let ends = |option: &str| cell(option, "simulated_s").parse::<f64>().unwrap();
    let parts_s: f64 = cell("made-900", "parted_at_s").parse().unwrap();
    assert!(
        (0.0..=0.5).contains(&(ends("made-900-until") - parts_s)),
        "it is looked at twice a second"
    );
    assert!(ends("made-900") > parts_s + 1.0);
    let place_n: f64 = cell("unbreakable", "needed_place_N").parse().unwrap();
    // The tension is nearly the same everywhere. The value of a place is the greatest in its half metre of the line.
    assert!((0.95..=1.0).contains(&(place_n / needed_n)), "{place_n} of {needed_n} N");
    assert_eq!(cell("made-900", "needed_place_N"), "");
    assert_eq!(cell("places-hold", "parted"), "");
    assert_eq!(cell("places-hold", "state_hash"), cell("unbreakable", "state_hash"));
    for option in ["places-part", "places-part-near"] {
        assert_eq!(cell(option, "parted"), "warp", "{option}");
        let at_s: f64 = cell(option, "parted_at_s").parse().unwrap();
        assert!(0.5 < at_s, "{option} parts after a look at the run: {at_s}");
    }
    assert_ne!(cell("places-part", "state_hash"), cell("places-part-near", "state_hash"));
    let all = [
        "middle",
        "late",
        "rope",
        "unbreakable",
        "made-500",
        "made-900",
        "made-900-link",
        "made-900-until",
        "made-4000",
        "places-hold",
        "places-part",
        "places-part-near",
    ];
    for option in all {
        let replayed = place
            .endline(&["study", "replay", &study, "--out", &out, "--row", "0", "--option", option])
            .done();
        assert!(
            replayed.stderr.contains("ends in the state that the table has"),
            "{option}: {replayed}"
        );
    }
}

/// A rope is drawn apart beside a single trap or beside traps in line; an encounter has the lines of one of them.
const DRAWN_GEAR: &str = r#"
format = 1
kind = "study"
name = "Pull beside traps"
scenario = "pull-beside-traps"
encounters = 6
baseline = "never"

[[option]]
id = "never"
set = { weak_links = false, unbreakable = true }

[[option]]
id = "rope-50"
strength = "50 lbf"
set = { weak_links = false, "line.0.delivered_strength" = "50 lbf" }

[[option]]
id = "rope-9000"
strength = "9000 lbf"
set = { weak_links = false, "line.0.delivered_strength" = "9,000 lbf" }

[encounter."gear.0.assembly"]
choice = ["foot-trawl-10", "foot-single"]
source = "assumed"
"#;

/// Strengths are compared with what the lines of the encounter bore, also where it has other lines than another encounter.
#[test]
fn runs_are_shared_by_the_lines_of_the_encounter() {
    let place = Place::new("study-drawn-gear");
    let library = place.library();
    let pull = fs::read_to_string(library.join("scenarios/weak-link-pull.toml")).unwrap();
    let short = pull.replace("duration = \"6 s\"", "duration = \"0.4 s\"");
    let beside = short.replace(
        "[[fixture]]\nid = \"post\"",
        "[[gear]]\nassembly = \"foot-trawl-10\"\n\n[[fixture]]\nid = \"post\"",
    );
    assert!(pull != short && short != beside);
    fs::write(library.join("scenarios/pull-beside-traps.toml"), beside).unwrap();
    let study = place.write("gear-library/studies/pull-beside-traps.toml", DRAWN_GEAR);
    let study = study.display().to_string();
    let out = place.folder.join("beside").display().to_string();
    for command in ["run", "merge"] {
        place.endline(&["study", command, &study, "--out", &out]).done();
    }
    let table = fs::read_to_string(place.path("beside/table.csv")).unwrap();
    let (head, rows) = table.split_once('\n').unwrap();
    let mut assemblies = BTreeSet::new();
    for (encounter, rows) in rows.lines().collect::<Vec<_>>().chunks(3).enumerate() {
        let rows = [&[head], rows].concat().join("\n");
        let parted = |option| cell(&rows, option, "parted");
        assert_eq!(["never", "rope-50", "rope-9000"].map(parted), ["", "warp", ""], "{rows}");
        assemblies.insert(cell(&rows, "never", "drawn_gear.0.assembly"));
        let row = encounter.to_string();
        let replayed = place
            .endline(&[
                "study", "replay", &study, "--out", &out, "--row", &row, "--option", "rope-50",
            ])
            .done();
        assert!(replayed.stderr.contains("ends in the state that the table has"), "{replayed}");
    }
    assert_eq!(assemblies.len(), 2, "{assemblies:?}");
}

/// A cell of the row of an option in a table of one encounter.
fn cell(rows: &str, option: &str, column: &str) -> String {
    let place = rows.lines().next().unwrap().split(',').position(|head| head == column).unwrap();
    let row = rows.lines().find(|row| row.split(',').nth(1) == Some(option)).unwrap();
    row.split(',').nth(place).unwrap().to_owned()
}
