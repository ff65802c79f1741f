//! Long work that is divided into numbered runs, stored as it advances and resumed after an interruption: a study or a search.
//!
//! | file | content |
//! |---|---|
//! | `control` | pause, cancellation and progress, from any thread |
//! | `shard` | the part of the work that one of several machines does |
//! | `leases` | which process runs which block, for processes that share a folder |
//! | `priority` | number and priority of threads |

pub mod control;
pub(crate) mod leases;
pub mod priority;
pub(crate) mod shard;

pub use control::{Control, Count, Progress};
pub use leases::{Worker, workers};
pub use shard::Shard;
