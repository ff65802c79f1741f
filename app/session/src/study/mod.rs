//! Studies: options of gear compared on the same encounters, counted, with intervals.
//!
//! ```text
//! study file -> options (edited scenarios) x encounters (draws) -> runs -> rows -> blocks on disk -> table -> statistics -> report
//! ```
//! | file | content |
//! |---|---|
//! | `prepared` | the study read, each option planned and checked |
//! | `plan` | an option as an edited scenario and library |
//! | `prepare` | an option in an encounter: drawn values, gear at rest, the aim of the whale, assembled |
//! | `exposure` | tracks of whales through gear, and the gear that is met, in a study with `[exposure]` |
//! | `adapt` | stages whose proposals are fitted to earlier encounters |
//! | `play`, `equivalence` | the runs of an encounter, and which options share one |
//! | `row`, `runs` | a run's figures as a row of the table, and rows read back as structs |
//! | `batch`, `folder`, `registration` | blocks of encounters on threads and processes, and their folder |
//! | `forecast` | cost and precision of a study from its first encounters |
//! | `merge`, `results` | the table from the blocks, and its results for a window |
//! | `stats`, `report`, `threat` | statistics, the report and the threat table |
//! | `queue` | studies behind a window, one after the other |
//!
//! Run `i` of an option is defined by the study's hash and `i`. Blocks of encounters are written whole or not at all, so
//! a killed study continues from its blocks, on one machine or on many, and the merged table has the same bytes.
//! How to use it and what its numbers do not say: `docs/studies.md`.

mod adapt;
pub mod batch;
#[cfg(test)]
mod damaged;
mod equivalence;
mod exposure;
pub mod folder;
pub mod forecast;
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
