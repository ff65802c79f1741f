//! `endline export`: tables of a run's moments, held against the run's own summary. `app/python/tests` reads them as Parquet.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test fails by panicking, in its helpers too"
)]

use std::collections::{BTreeMap, BTreeSet};

use crate::common::Place;

/// A table of comma-separated values without quotation marks: the names of its columns, and its rows.
fn table(place: &Place, name: &str) -> (Vec<String>, Vec<Vec<String>>) {
    let text = std::fs::read_to_string(place.path(&format!("tables/{name}.csv"))).unwrap();
    let cells = |line: &str| line.split(',').map(str::to_owned).collect::<Vec<_>>();
    let mut lines = text.lines();
    let names = cells(lines.next().unwrap());
    (names, lines.map(cells).collect())
}

/// The greatest number of a column, by what stands in another.
fn greatest(place: &Place, name: &str, of: &str, column: &str) -> BTreeMap<String, f64> {
    let (names, rows) = table(place, name);
    let at = |wanted: &str| names.iter().position(|name| name == wanted).unwrap();
    let mut greatest = BTreeMap::new();
    for row in rows {
        let number: f64 = row[at(column)].parse().unwrap();
        let most = greatest.entry(row[at(of)].clone()).or_insert(number);
        *most = most.max(number);
    }
    greatest
}

#[test]
fn tables_of_a_recording_hold_its_moments() {
    let place = Place::new("exported");
    let scenario = place.encounter();
    let out = place.path("run").display().to_string();
    let run = place.endline(&["run", &scenario, "--out", &out, "--json"]).done().json();
    let recording = place.path("run/recording.endline").display().to_string();
    let tables = place.path("tables").display().to_string();
    // A moment for every step of 0.005 s or more, so that the peaks of every step are nearly among them.
    let export = ["export", &recording, "--out", &tables, "--format", "csv", "--rate", "200"];
    place.endline(&export).done().prints(&["nodes", "segments", "contacts"]);

    let (_, described) = table(&place, "columns");
    let described: BTreeSet<(String, String)> =
        described.into_iter().map(|row| (row[0].clone(), row[1].clone())).collect();
    for name in ["nodes", "segments", "bodies", "whale", "contacts"] {
        let (names, rows) = table(&place, name);
        assert!(!rows.is_empty(), "{name}");
        let own = names.into_iter().map(|column| (name.to_owned(), column));
        assert!(own.collect::<BTreeSet<_>>().is_subset(&described), "{name}");
    }

    let tension = greatest(&place, "segments", "line", "tension_N");
    for line in run["lines"].as_array().unwrap() {
        let peak = line["peak_tension_N"].as_f64().unwrap();
        let seen = tension[line["id"].as_str().unwrap()];
        assert!(seen <= peak * (1.0 + 1e-9) && seen > 0.9 * peak, "{seen} N, peak {peak} N");
    }
    let (names, rows) = table(&place, "bodies");
    let last: BTreeMap<&str, Vec<f64>> = rows
        .iter()
        .map(|row| (row[1].as_str(), row[2..5].iter().map(|cell| cell.parse().unwrap()).collect()))
        .collect();
    assert_eq!(names[2..5], ["x_m", "y_m", "z_m"]);
    for body in run["bodies"].as_array().unwrap() {
        let place = body["position_m"].as_array().unwrap();
        for (axis, at) in place.iter().enumerate() {
            let off = (last[body["id"].as_str().unwrap()][axis] - at.as_f64().unwrap()).abs();
            assert!(off < 1e-9, "{} is {off} m off", body["id"]);
        }
    }
    let (_, contacts) = table(&place, "contacts");
    let first: f64 = contacts[0][0].parse().unwrap();
    let reported = run["whale"]["first_contact_s"].as_f64().unwrap();
    assert!((first - reported).abs() < 0.01, "{first} s, {reported} s");
}

#[test]
fn probes_of_positions_are_three_columns_over_time() {
    let place = Place::new("exported-probes");
    let scenario = place.encounter();
    let mut text = std::fs::read_to_string(&scenario).unwrap();
    for (id, target) in [
        ("float", "part = \"buoy\""),
        ("whale", "part = \"whale\""),
        ("head", "part = \"whale:snout\""),
        ("foot", "line = \"endline-bottom\"\nat = \"0 m\""),
    ] {
        text += &format!("[[probe]]\nid = \"{id}\"\nof = \"position\"\n{target}\n");
    }
    std::fs::write(&scenario, &text).unwrap();
    let tables = place.path("tables").display().to_string();
    let export = ["export", &scenario, "--out", &tables, "--format", "csv", "--rate", "10"];
    place.endline(&export).done().prints(&["probes"]);
    let (names, rows) = table(&place, "probes");
    let at = |wanted: &str| {
        let found = names.iter().position(|name| name == wanted);
        found.unwrap_or_else(|| panic!("{wanted}: {names:?}"))
    };
    let of_row = |row: &[String], id: &str| {
        ["x", "y", "z"].map(|axis| row[at(&format!("{id} {axis}_m"))].parse::<f64>().unwrap())
    };
    let own_table = |name: &str, first: usize| -> Vec<[f64; 3]> {
        let (_, rows) = table(&place, name);
        let rows = rows.into_iter().filter(|row| name != "bodies" || row[1] == "buoy");
        rows.map(|row| [0, 1, 2].map(|axis| row[first + axis].parse().unwrap())).collect()
    };
    for (id, name, first) in [("float", "bodies", 2), ("whale", "whale", 1)] {
        let wanted = own_table(name, first);
        assert_eq!(wanted.len(), rows.len(), "{name}");
        for (row, wanted) in rows.iter().zip(wanted) {
            let off = of_row(row, id).into_iter().zip(wanted).map(|(a, b)| (a - b).abs());
            assert!(off.fold(0.0, f64::max) < 1e-9, "{id}: {row:?} against {wanted:?}");
        }
    }
    // The snout is half the whale's length before its origin, to a few per cent.
    let length: f64 = 13.7;
    for row in &rows {
        let (origin, head) = (of_row(row, "whale"), of_row(row, "head"));
        let apart = origin.iter().zip(head).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt();
        assert!((apart / (0.5 * length) - 1.0).abs() < 0.1, "{apart} m");
    }
    let (_, described) = table(&place, "columns");
    let unit = described.iter().find(|row| row[0] == "probes" && row[1] == "head x_m").unwrap();
    assert_eq!(unit[2], "m");
    // With --json a run has the three probes too.
    let run = place.endline(&["run", &scenario, "--json"]).done().json();
    let ids: Vec<&str> =
        run["probes"].as_array().unwrap().iter().map(|one| one["id"].as_str().unwrap()).collect();
    assert!(["foot x", "foot y", "foot z"].iter().all(|id| ids.contains(id)), "{ids:?}");
    for (from, to, says) in [
        ("part = \"whale:snout\"", "part = \"whale:nose\"", "no spot `nose`"),
        ("part = \"whale:snout\"", "", "write the id of a body"),
        (
            "part = \"whale:snout\"",
            "part = \"buoy\"\nline = \"endline-bottom\"",
            "both `part` and `line`",
        ),
        ("at = \"0 m\"", "point = [\"0 m\", \"0 m\", \"0 m\"]", "a line has no `point`"),
    ] {
        std::fs::write(&scenario, text.replacen(from, to, 1)).unwrap();
        place.endline(&["run", &scenario]).fails(1, &[says]);
    }
}

#[test]
fn a_stretch_that_is_none_and_too_many_rows_are_refused() {
    let place = Place::new("exported-wrong");
    let scenario = place.encounter();
    let tables = place.path("tables").display().to_string();
    let export = |rest: &[&str]| {
        place.endline(&[&["export", scenario.as_str(), "--out", tables.as_str()], rest].concat())
    };
    export(&["--from", "5s", "--to", "2s"]).fails(2, &["no stretch of a run"]);
    export(&["--rate", "0"]).fails(2, &["--rate"]);
    export(&["--format", "hdf5"]).fails(2, &["parquet", "arrow", "csv"]);
    assert!(!place.path("tables").exists());
}
