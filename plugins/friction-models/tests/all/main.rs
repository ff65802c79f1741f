//! Tests of the friction models, each through its interface.

mod baleen;
mod common;
mod coulomb;
mod laws;
mod stribeck;
mod tissue;
