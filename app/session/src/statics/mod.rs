//! Gear at rest without a run: one assembly settled while it is edited.
//!
//! | module | what |
//! |---|---|
//! | [`preview`] | one assembly alone in a chosen sea, settled |
//! | [`worker`] | previews on a thread of their own |

pub mod preview;
pub mod worker;

pub use preview::{RigAtRest, TrialSea};
pub use worker::{StaticsWorker, Trial};
