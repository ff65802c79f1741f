//! Campaigns: long work that is divided into numbered runs, stored as it advances and resumed after an interruption. Studies and
//! searches are campaigns.
//!
//! | file | content |
//! |---|---|
//! | `control` | pause, cancellation and progress, from any thread |
//! | `pool` | the threads that run the work, their number and priority; the part of the work that one of several machines does |
//! | `leases` | which process runs which block, for processes that share a folder |
//! | `folder` | the folder of results, and the label that says to which campaign it belongs |
//! | `job` | a campaign behind a window |

pub mod control;
pub(crate) mod folder;
pub mod job;
pub(crate) mod leases;
pub mod pool;

pub use control::{ContactTime, Control, Count, Pace, Progress};
pub use job::{Job, State};
pub use leases::{Worker, workers};
pub use pool::Shard;
