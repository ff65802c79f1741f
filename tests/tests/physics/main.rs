//! Shipped gear, scenarios and whales in the water, against hand calculation, published figures and what was seen at sea.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test fails by panicking, in its helpers too"
)]

mod acts;
mod balance;
mod beat;
mod bodies;
mod buoy_jams;
mod case_wraps;
mod delivered;
mod drawn;
mod encounters;
mod friction;
mod gear;
mod gear_types;
mod groundlines;
mod held;
mod items;
mod kinetic;
#[path = "../linked/mod.rs"]
mod linked;
mod mistakes;
mod momentum;
mod pilot;
#[path = "../recovery/mod.rs"]
mod recovery;
mod resolution;
mod rigs;
mod ropes;
mod sea;
mod slack;
mod twisted_bight;
