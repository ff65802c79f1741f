//! Studies: options of gear compared on the same encounters, counted, with intervals.
//!
//! ```text
//! study file -> options (edited scenarios) x encounters (draws) -> runs -> rows -> blocks on disk -> table -> statistics -> report
//! ```
//! An option of the study's file goes through these files:
//!
//! | file | what |
//! |---|---|
//! | `open` | the study read, each option planned and checked |
//! | `plan` | an option as an edited scenario and library |
//! | `encounters` | what is drawn for an encounter, and the fields that it sets |
//! | `aim` | gear at rest in the sea of an encounter, and the rope that the whale is aimed at |
//! | `prepare` | plan, draws and aim together, assembled |
//! | `play`, `equivalence`, `branch` | the run, or the run that another option has already |
//! | `finer` | the run on a finer resolution |
//! | `row` | the run's figures |
//!
//! Run `i` of an option is defined by the study's hash and `i`. Blocks of encounters are written whole or not at all, so
//! a killed study continues from its blocks, on one machine or on many, and the merged table has the same bytes.
//! How to use it and what its numbers do not say: `docs/studies.md`.

pub mod batch;

#[cfg(test)]
mod damaged;
mod equivalence;

pub mod folder;
pub mod merge;
mod plan;
mod play;
pub(crate) mod prepare;
pub(crate) mod prepared;
pub mod queue;

pub mod registration;
pub mod report;
pub mod results;
mod row;
pub mod runs;
pub mod stats;
#[cfg(test)]
pub(crate) mod tests;
pub mod threat;

pub use plan::OptionPlan;
pub use play::{Played, REPLAY_HZ};
pub use prepared::{Files, PreparedStudy};
pub use results::{ResultsReader, ResultsRequest, StudyResults};
