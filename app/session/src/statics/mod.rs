//! Gear at rest without a run: settled while it is edited.
//!
//! | module | what |
//! |---|---|
//! | [`preview`] | one gear alone in a chosen sea, settled |
//! | [`sweep`] | one gear over depths of water and currents |
//! | [`worker`] | previews on a thread of their own |

pub mod preview;
pub mod sweep;
pub mod worker;

pub use preview::{RigAtRest, TrialGear, TrialSea};
pub use worker::{StaticsWorker, Trial};
