//! Everything that a user can do with Endline without a screen: prepare a scenario, run it, record it, replay it.
//!
//! | module | content |
//! |---|---|
//! | [`source`] | scenario, gear library and options become a model |
//! | [`run`] | a model stepped through time, measured and recorded |
//! | [`hash`] | 64 bits for each part of a state |
//! | [`recording`] | the file of a run; running it again and comparing every step |
//! | [`report`] | the summary of a run |
//! | [`touching`] | the contact of a body with the whale at the moment shown |
//! | [`figures`] | every figure of a run, declared once; comparison of two runs |
//! | [`forms`] | the JSON forms that commands print, with their schemas |
//! | [`json`] | results as JSON |
//! | [`settled`] | the gear at rest as JSON |
//! | [`statics`] | one assembly alone at rest, while it is edited |
//! | [`cases`] | validation cases run and judged |
//! | [`check`] | every problem of the files a user names |
//! | [`command`] | the commands of a user, declared once |
//! | [`workbench`] | open files, runs and results, driven by commands |
//! | [`edit`] | open texts with undo, their problems, recovery after a crash |
//! | [`haul`] | gear hauled over a block: loads, the part nearest to parting, and the probability that it parts |
//! | [`mill`] | breaks of a product: its law of strength, and the probability that it is approved |
//! | [`campaign`] | studies and searches at work: threads, processes, pause, progress |
//! | [`encounters`] | encounters of whales with gear, drawn from priors |
//! | `page` | what HTML pages share |
//! | [`table`] | tables of results as CSV and Parquet |
//! | [`rules`] | rule packs of fishing law, checked on an assembly |
//! | [`search`] | encounters that end like an observation of a real whale |
//! | [`scene`] | the triangles of a frame |
//! | [`export`] | charts and 3-D models written to files |
//! | [`scales`] | round values for axes, colours of series |
//! | [`shell`] | words of a command line as a shell takes them |
//! | [`units`] | display units and number formatting |
//! | [`live`] | a run on a thread of its own, for the workbench |
//! | [`task`] | work on a thread of its own, taken in without waiting |
//! | [`plugins`] | plugins found, checked and loaded |
//! | [`locate`] | where the gear library of a scenario is |
//! | [`shipped`] | the gear library inside the program, written to the user's data folder where no other is found |
//! | [`sketch`] | the content of a scenario or study in few numbers, for the sketch on the start page |
//!
//! A run gives the same bits for the same source, inputs and program, whoever watches it.

#![cfg_attr(
    test,
    allow(clippy::disallowed_methods, reason = "tests read files that they have written")
)]

/// The made-up run of `figures/tests` names this crate as the tests of other crates do.
#[cfg(test)]
extern crate self as endline_session;

pub mod campaign;
pub mod cases;
pub mod check;
pub mod command;
pub mod compliance;
pub mod edit;
pub mod encounters;
pub mod error;
pub mod export;
pub mod figures;
pub mod forms;
pub mod hash;
pub mod haul;
mod hooks;
pub mod live;
pub mod locate;
pub mod mill;
mod page;
pub mod plugins;
pub mod recording;
pub mod report;
pub mod rules;
pub mod run;
pub mod save;
pub mod scales;
pub mod scene;
pub mod search;
pub mod settled;
pub mod shell;
pub mod shipped;
pub mod sketch;
pub mod source;
pub mod statics;
pub mod study;
pub mod table;
pub mod task;
pub mod timing;
pub mod touching;
pub mod units;
pub mod workbench;

/// Version of Endline and, after the plus sign, the mark of the code that decides what a run is (`build.rs`): the bits of a
/// run are promised for one mark.
pub const VERSION: &str = concat!(env!("CARGO_PKG_VERSION"), "+", env!("ENDLINE_CODE"));

pub use error::Error;
pub use hooks::{load_plugins, load_with, plugin_loader};
pub use plugins::PluginHost;
pub use recording::Recording;
pub use report::Report;
pub use run::{Run, RunOptions};
pub use source::{Overrides, Prepared, Source, prepare};

/// Results as JSON. Structs of numbers and texts always serialise; the empty string would fail every reader at once.
pub mod json {
    use serde::Serialize;

    /// One line of JSON.
    pub fn line(value: &impl Serialize) -> String {
        serde_json::to_string(value).unwrap_or_default()
    }

    /// JSON with a line for each value.
    pub fn indented(value: &impl Serialize) -> String {
        serde_json::to_string_pretty(value).unwrap_or_default()
    }
}

#[cfg(test)]
mod tests {
    #[test]
    fn the_version_carries_a_mark_of_the_code() {
        let (_, mark) = super::VERSION.split_once('+').unwrap();
        assert!(mark.len() == 8 && mark.bytes().all(|digit| digit.is_ascii_hexdigit()), "{mark}");
    }
}
