//! The plugin boundary: linked and loaded plugins give the same bits, a plugin in C works, and no bad plugin crashes the
//! program.
#![expect(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail the test")]

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
