//! Golden states: short runs of bundled scenarios, one of each kind of event, end in known states, bit for bit.
//!
//! The other tests bound what a run gives; this one shows that a change of the code left every bit of
//! every kind of run alone. Where a change of the physics is meant, `cargo xtask golden` writes the
//! table `states.csv` anew (it sets ENDLINE_WRITE_GOLDEN), and the new table belongs to the commit.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test fails by panicking, in its helpers too"
)]

#[path = "../linked/mod.rs"]
mod linked;
mod runs;
mod table;

use runs::{CASES, Case};

/// Whether the table is to be written rather than compared with.
fn is_written_anew() -> bool {
    std::env::var_os("ENDLINE_WRITE_GOLDEN").is_some()
}

/// Runs one scenario, asserts that it shows its kind, and compares its states with the table.
fn check(name: &str) {
    if is_written_anew() {
        return;
    }
    let case = CASES.iter().find(|case| case.name == name).unwrap();
    let rows = run(case);
    let known = table::read();
    let expected: Vec<_> = known.iter().filter(|row| row.case == name).collect();
    for (row, expected) in rows.iter().zip(&expected) {
        assert_eq!(row.step, expected.step, "{name}: the table has other steps");
        let difference = row.hash.first_difference(&expected.hash);
        assert!(
            difference.is_none(),
            "{name} ({}): the state differs first in the part `{}`, at step {} or in the steps since \
             the one before it in the table; where this is meant: cargo xtask golden",
            case.scenario,
            difference.unwrap_or_default(),
            row.step
        );
    }
    assert_eq!(rows.len(), expected.len(), "{name}: the table has other steps");
}

fn run(case: &Case) -> Vec<table::Row> {
    let start = std::time::Instant::now();
    let (shown, rows) = runs::run(case);
    println!(
        "{}: {} s simulated in {:.1} s",
        case.name,
        case.seconds,
        start.elapsed().as_secs_f64()
    );
    (case.shows)(&shown);
    rows
}

#[test]
fn free_rope_and_buoy() {
    check("free");
}

#[test]
fn rope_that_slides_over_skin() {
    check("sliding");
}

#[test]
fn rope_wrapped_round_flipper_and_peduncle() {
    check("wrapped");
}

#[test]
fn rope_lodged_in_the_mouth() {
    check("lodged");
}

#[test]
fn a_link_that_parts() {
    check("parted");
}

#[test]
fn a_whale_that_feels_the_gear() {
    check("kinetic");
}

#[test]
fn a_buoy_in_waves() {
    check("waves");
}

#[test]
fn rope_that_crosses_rope() {
    check("rope on rope");
}

#[test]
fn the_table_has_these_scenarios_and_no_others() {
    if is_written_anew() {
        let rows: Vec<_> = CASES.iter().flat_map(run).collect();
        table::write(&rows);
    }
    let known = table::read();
    let known: std::collections::BTreeSet<&str> =
        known.iter().map(|row| row.case.as_str()).collect();
    assert_eq!(known, CASES.iter().map(|case| case.name).collect());
}
