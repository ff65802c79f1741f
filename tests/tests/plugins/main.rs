//! The plugin boundary: what is linked and what is loaded give the same bits, a plugin in C works,
//! and nothing that is wrong with a plugin takes the program with it.
#![expect(
    clippy::unwrap_used,
    clippy::panic,
    reason = "helpers of tests: where one cannot go on, the test fails there"
)]

mod built;
mod c_plugin;
mod checked;
mod guarded;
mod header;
mod kept;
#[path = "../linked/mod.rs"]
mod linked;
mod random;
mod refused;
mod reload;
mod same_bits;
mod same_run;
mod skinned;
mod templates;
mod text;
mod twelve;
