//! What statics costs, by shipped scenario: `cargo bench -p endline-tests --bench statics`.
//!
//! Wanted: a single below 5 ms, a trawl of ten traps below 50 ms, at the resolution they ship with.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    missing_docs,
    reason = "a benchmark says what it needs"
)]

#[path = "../tests/linked/mod.rs"]
mod linked;

use divan::Bencher;
use endline_sim::settle;
use linked::model;

fn main() {
    divan::main();
}

/// A single of 500 nodes at half and slack tide, trawls of 10 and 45 traps (461 and 1,855 nodes), reference problem b.
#[divan::bench(args = ["hello-endline", "hello-slack-tide", "trawl-10", "trawl-45", "reference-b-static"])]
fn from_first_guess(bencher: Bencher, scenario: &str) {
    let model = model(scenario, &[]);
    assert!(settle(&model).converged, "{scenario} does not reach equilibrium");
    bencher.bench_local(|| settle(&model));
}
