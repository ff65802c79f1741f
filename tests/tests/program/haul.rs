//! Gear hauled as its users ask for it: loads, probabilities, tables, mistakes.

use crate::common::{Called, Place, form, library, text};

fn haul(place: &Place, arguments: &[&str]) -> Called {
    let library = text(&library());
    place.endline(&[&["--library", &library, "haul"], arguments].concat())
}

#[test]
fn a_single_is_hauled_within_its_strength_and_the_sheet_holds_together() {
    let place = Place::new("haul");
    let sheet = haul(&place, &["single", "--sea", "0 m", "--json"]).done().json();
    let number = |of: &serde_json::Value| of.as_f64().unwrap();
    // More than the wet weight of the trap, 130 N; less than three times its weight in air, 178 N.
    let peak = number(&sheet["peak_N"]);
    assert!(peak > 130.0 && peak < 534.0, "{peak} N");
    assert!(number(&sheet["parts"]) < 1e-6 && sheet["traps_aboard"] == 1, "{sheet}");
    let stages = sheet["stages"].as_array().unwrap();
    let greatest = stages.iter().map(|stage| number(&stage["peak_N"])).fold(0.0, f64::max);
    assert!((greatest - peak).abs() < 1e-9, "{greatest} N of {peak} N");
    // The line of 32.5 m comes in over a block at 2 m.
    let hauled = number(&sheet["hauled_m"]);
    assert!((30.0..34.0).contains(&hauled), "{hauled} m");
    let along = &sheet["along"];
    let count = |key: &str| along[key].as_array().unwrap().len();
    assert_eq!(count("time_s"), count("tension_N"));
    assert_eq!(count("from_buoy_m"), along["tension_N"][0].as_array().unwrap().len());
    // At first all of it is out, at last only what is next to the trap.
    let out =
        |row: &serde_json::Value| row.as_array().unwrap().iter().filter(|one| one.is_f64()).count();
    let rows = along["tension_N"].as_array().unwrap();
    assert_eq!(out(&rows[0]), count("from_buoy_m"));
    assert!(out(rows.last().unwrap()) < 4);
    let nearest = &sheet["nearest"];
    let used = number(&nearest["tension_N"]) / number(&nearest["delivered_N"]);
    assert!((number(&nearest["used"]) - used).abs() < 1e-12, "{nearest}");
}

#[test]
fn a_trap_that_is_stuck_parts_the_line_and_more_depth_and_traps_pull_more() {
    let place = Place::new("haul-table");
    let weak = ["massachusetts-single", "--sea", "0 m", "--break-out", "100", "--json"];
    let stuck = haul(&place, &weak).done().json();
    // Feet that hold 9.1 kN together break out one after the other; an insert delivers 5.6 kN in the mean.
    assert!(stuck["parts"].as_f64().unwrap() > 1e-3, "{}", stuck["parts"]);
    assert!(stuck["nearest"]["part"].as_str().unwrap().contains("insert"), "{}", stuck["nearest"]);
    let arguments =
        ["trawl-10", "--table", "--depth", "30 m,60 m", "--traps", "2,4", "--aboard", "1"];
    let rows = haul(&place, &[&arguments[..], &["--sea", "0 m", "--json"]].concat()).done();
    let rows: serde_json::Value = serde_json::from_str(&rows.stdout).unwrap();
    form::hold(&rows, "endline.haul_sweep/1");
    let rows = rows.as_array().unwrap();
    assert_eq!(rows.len(), 4);
    let peak = |row: usize| rows[row]["peak_N"].as_f64().unwrap();
    // Rows go 30 m with 2 and 4 traps, 60 m with 2 and 4. Of two traps both hang in either depth: there depth adds nothing.
    assert!(peak(1) > peak(0) && peak(3) > peak(2) && peak(3) > peak(1), "{rows:?}");
}

#[test]
fn what_cannot_be_hauled_is_said_so() {
    let place = Place::new("haul-mistakes");
    haul(&place, &["single", "--depth", "20 m,30 m"]).fails(2, &["--table"]);
    haul(&place, &["single", "--site", "nowhere"]).fails(1, &["no site `nowhere`", "cape-cod-bay"]);
    haul(&place, &["single", "--buoy", "trap"]).fails(1, &["no endline begins at `trap`", "buoy"]);
    haul(&place, &["lone-trap"]).fails(1, &["no endline from a buoy"]);
    haul(&place, &["single", "--speed", "1.2"]).fails(2, &["--speed"]);
    haul(&place, &["single", "--traps", "3"]).fails(1, &["traps"]);
}
