//! Acts of the library, played over the shipped swim: the angles they reach, their begin and end, the direction of turns,
//! the skin during an act, and the diagnostics of a bad file.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail the test")]

mod files;
mod flight;
mod moves;
mod scenarios;
mod size;
mod skin;
mod smooth;
mod strouhal;
mod touched;
