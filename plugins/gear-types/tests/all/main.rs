//! Tests of the gear types: their layout, and their actions during a run.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test fails by panicking, in its helpers too"
)]

mod acting;
mod common;
mod sets;
mod single;
