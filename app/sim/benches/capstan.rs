//! How well the capstan law comes out on triangles, over turns, segment lengths, facets and edges: tables for docs/lab-notebook.md.
//!
//! `cargo bench -p endline-sim --bench capstan`, and after `--` one of `turns`, `lengths`, `edges`, `follows` for that table alone.
//! A rope is drawn round a drum of skin against a steady pull (`tests/fixtures/src/capstan.rs`); friction and ratio are by how much the
//! mean ratio of tensions misses `e^{μθ}`, ripple is its spread over its mean.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use endline_fixtures::capstan::{Capstan, Reading};
use endline_sim::model::Resolution;

/// Segments of the shipped encounters [m].
const SHIPPED_M: f64 = 0.07;
/// Pull on the taut end of the drum, by the law [N].
const TAUT_N: f64 = 4000.0;

fn main() {
    let tables: [(&str, fn()); 4] =
        [("turns", turns), ("lengths", lengths), ("edges", edges), ("follows", follows)];
    let asked: Vec<String> =
        std::env::args().skip(1).filter(|word| !word.starts_with('-')).collect();
    for (name, table) in tables {
        if asked.is_empty() || asked.iter().any(|word| word == name) {
            table();
        }
    }
}

/// A table's head, with its columns.
fn head(title: &str, columns: &[&str]) {
    println!("\n{title}\n\n| {} |\n|{}", columns.join(" | "), "---|".repeat(columns.len()));
}

/// A reading of friction or ratio, and of ripple, in per cent.
fn cell(value: f64, read: &Reading) -> String {
    assert_eq!(read.audit.tunnelled, 0, "rope crossed the drum");
    format!("{:+.1} ({:.1})", 100.0 * (value - 1.0), 100.0 * read.ripple)
}

fn row(what: &str, cells: &[String]) {
    println!("| {what} | {} |", cells.join(" | "));
}

/// Rope of the shipped length round a drum of 0.3 m.
fn turns() {
    head(
        "Effective friction, % off (ripple %), segments of 7 cm, 96 facets",
        &["friction", "π/2", "π", "2π", "4π"],
    );
    for friction in [0.1, 0.2, 0.3, 0.4, 0.5, 0.6] {
        let cells = [FRAC_PI_2, PI, TAU, 2.0 * TAU].map(|turn| {
            let slack_n = TAUT_N / libm::exp(friction * turn);
            let read =
                Capstan { turn, friction, slack_n, segment_m: SHIPPED_M, ..Capstan::default() }
                    .read();
            cell(read.friction, &read)
        });
        row(&format!("{friction}"), &cells);
    }
}

/// Segment length over facets, one turn.
fn lengths() {
    let facets = [24, 48, 96, 192];
    let heads: Vec<String> = facets.iter().map(|count| format!("{count} facets")).collect();
    let columns: Vec<&str> =
        ["segments a turn"].into_iter().chain(heads.iter().map(String::as_str)).collect();
    head("Effective friction, % off (ripple %), one turn at 0.3", &columns);
    for around in [8.0, 12.0, 24.0, 48.0] {
        let cells = facets.map(|facets| {
            let segment_m = TAU * 0.305 / around;
            let slack_n = TAUT_N / libm::exp(0.3 * TAU);
            let read =
                Capstan { turn: TAU, facets, slack_n, segment_m, ..Capstan::default() }.read();
            cell(read.friction, &read)
        });
        row(&format!("{around}"), &cells);
    }
}

/// Equal segments over edges.
fn edges() {
    const LENGTHS: [f64; 5] = [0.1, 0.05, 0.025, 0.0125, 0.009];
    head(
        "Ratio of tensions over an edge, % off (ripple %), equal segments",
        &["edge", "turn", "10 cm", "5", "2.5", "1.25", "0.9"],
    );
    over_edges(|capstan| {
        LENGTHS.map(|segment_m| Capstan { segment_m, tail_m: 0.5, ..capstan }).to_vec()
    });
}

/// Segments that follow the whale.
fn follows() {
    let columns = ["edge", "turn", "from 10 cm", "7 cm", "5 cm"];
    head(
        "Ratio of tensions over an edge, % off (ripple %), segments that follow as usual",
        &columns,
    );
    over_edges(|capstan| {
        let following = Capstan { resolution: Some(Resolution::default()), tail_m: 5.0, ..capstan };
        [0.1, SHIPPED_M, 0.05].map(|segment_m| Capstan { segment_m, ..following }).to_vec()
    });
}

fn over_edges(columns: impl Fn(Capstan) -> Vec<Capstan>) {
    for radius_m in [0.01, 0.02, 0.05] {
        for degrees in [90.0_f64, 160.0] {
            let turn = degrees.to_radians();
            let capstan = Capstan {
                radius_m,
                turn,
                facets: 48,
                slack_n: 100.0,
                drawn_m: [0.15, 0.2],
                ..Capstan::default()
            };
            let cells: Vec<String> = columns(capstan)
                .iter()
                .map(Capstan::read)
                .map(|read| cell(read.ratio, &read))
                .collect();
            row(&format!("{} cm | {degrees}°", 100.0 * radius_m), &cells);
        }
    }
}
