//! Acts of the library, played over the swim that ships: what they reach, how they begin and end, which way they turn,
//! what the skin does meanwhile, and what is said of a bad file.

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
