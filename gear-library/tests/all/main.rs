//! Tests of the gear library through its public interface: files, assembly, the whale's skin, encounters.

#![allow(
    clippy::disallowed_methods,
    reason = "expected values may come from the functions of the platform"
)]

mod animations;
mod benchmark;
mod body;
mod files;
mod fins;
mod idle;
mod jaws;
mod joints;
mod limits;
mod measured;
mod mesh_files;
mod mouth;
mod obstacles;
mod one_skin;
mod rig;
mod routes;
mod tunnelling;
mod units;
mod whale_encounters;
mod wound;
mod wraps;
