//! Every reader on damaged files, and damaged scenarios that still read settled and stepped: nothing may panic, hang or grow.
//!
//! | file | what |
//! |---|---|
//! | `targets` | what is fed, and what it is fed from |
//! | `mutate` | how files are damaged |
//! | `watch` | the clock and memory of the inputs at work |
//! | `campaign` | targets by turns, for so long; the report |
//!
//! The test takes seconds. `cargo xtask fuzz --hours N` runs the same for hours, from a seed of the clock.
//! A damaged file that causes a failure is saved in the folder `fuzz` of the build; after the correction it belongs in `tests/corpus`.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test fails by panicking, in its helpers too"
)]

mod campaign;
#[path = "../linked/mod.rs"]
mod linked;
mod mutate;
mod targets;
mod watch;

use std::time::Duration;

use campaign::{Campaign, Turn};

/// A seed that is always the same, so that a failure comes again.
const SEED: u64 = 20_261_126;

/// For seconds; for hours where `ENDLINE_FUZZ_HOURS` says so, from a seed of the clock.
#[test]
fn damaged_files_of_every_kind_are_read_or_refused() {
    let hours = std::env::var("ENDLINE_FUZZ_HOURS").ok().and_then(|hours| hours.parse().ok());
    let report = hours.map_or(SHORT, for_hours).run();
    println!("{report}");
    assert!(report.is_clean(), "{report}");
    assert!(report.inputs() > 500, "{report}");
}

/// What the suite runs.
const SHORT: Campaign =
    Campaign { seed: SEED, turn: Turn::Inputs { quick: 60, slow: 3 }, turns: 1, threads: 1 };

fn for_hours(hours: f64) -> Campaign {
    let turn = Turn::Time(Duration::from_secs(1));
    let turns = (hours * 3600.0 / targets::all().len() as f64).ceil() as u32;
    let seed = std::time::UNIX_EPOCH.elapsed().map_or(SEED, |since| since.as_nanos() as u64);
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    Campaign { seed, turn, turns, threads }
}
