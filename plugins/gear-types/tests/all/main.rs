//! Tests of the gear types: what they lay out, and what acts while a run goes on.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test fails by panicking, in its helpers too"
)]

mod acting;
mod common;
mod sets;
mod single;
