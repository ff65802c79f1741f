//! Studies: options of gear compared on the same encounters, counted, with intervals.
//!
//! ```text
//! study file -> options (edited scenarios) x encounters (draws) -> runs -> rows -> blocks on disk -> table -> statistics -> report
//! ```
//! Run `i` of an option is defined by the study's hash and `i`. Blocks of encounters are written whole or not at all, so
//! a study that was killed goes on where it stood, on one machine or on many, and the merged table has the same bytes.
//! How to use it and what its numbers do not say: `docs/studies.md`.

pub mod batch;
mod branch;
pub mod draw;
pub mod encounter;
pub mod folder;
pub mod merge;
mod open;
mod parquet;
mod play;
mod ready;
pub mod report;
mod rest;
mod row;
mod same;
pub mod stats;
pub mod table;

pub use open::{Opened, OptionPlan};
pub use play::{Played, REPLAY_HZ};
pub use table::{Cell, Column, Row, Table};
