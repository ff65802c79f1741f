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
//! | `draw`, `priors` | what is drawn for an encounter, and the fields that it sets |
//! | `aim`, `aimed_lines`, `equilibria` | gear at rest in the sea of an encounter, and the rope that the whale is aimed at |
//! | `prepare` | plan, draws and aim together, assembled |
//! | `play`, `equivalence`, `branch` | the run, or the run that another option has already |
//! | `finer` | the run on a finer resolution |
//! | `row` | the run's figures |
//!
//! Run `i` of an option is defined by the study's hash and `i`. Blocks of encounters are written whole or not at all, so
//! a study that was killed goes on where it stood, on one machine or on many, and the merged table has the same bytes.
//! How to use it and what its numbers do not say: `docs/studies.md`.

mod aim;
mod aimed_lines;
pub mod batch;
mod branch;
pub mod control;
#[cfg(test)]
mod damaged;
mod density;
pub mod draw;
mod drawn;
pub mod encounter;
mod equilibria;
mod equivalence;
mod finer;
pub mod folder;
mod leases;
pub mod merge;
mod open;
pub(crate) mod parquet;
mod plan;
pub(crate) mod planned;
mod play;
pub(crate) mod prepare;
pub mod priority;
mod priors;
pub mod queue;
mod reader;
mod ready;
pub mod registration;
pub mod report;
pub mod results;
mod row;
mod seal;
mod shard;
pub mod stats;
pub mod table;
#[cfg(test)]
pub(crate) mod tests;
pub mod threat;

pub use control::Control;
pub use drawn::in_words;
pub use leases::{Worker, workers};
pub use open::{Files, Opened};
pub use plan::OptionPlan;
pub use play::{Played, REPLAY_HZ};
pub use reader::ResultsReader;
pub use results::{ResultsRequest, StudyResults};
pub use shard::Shard;
pub use table::{Cell, Column, Row, Table};
