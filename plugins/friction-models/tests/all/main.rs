//! Tests of the friction models, each through its own door.

mod baleen;
mod common;
mod coulomb;
mod laws;
mod stribeck;
mod tissue;
