//! What is inside the program, so that it works wherever its file is copied alone: the gear library, the first-party plugins and
//! the documents.
//!
//! Folders come first: a gear library that is found, and a plugin's file of the same id, serve instead.

use std::path::PathBuf;
use std::sync::Arc;

use endline_session::plugins::{Hook, Loader};
use endline_session::{plugin_loader as loader_of, shipped};

/// Files of the gear library as it was when the program was built (`build.rs` lists them).
pub const GEAR_LIBRARY: shipped::Files = include!(concat!(env!("OUT_DIR"), "/gear_library.rs"));

/// The documents, as Markdown.
pub const DOCUMENTS: shipped::Files = include!(concat!(env!("OUT_DIR"), "/documents.rs"));

/// The pictures of the documents.
#[cfg(feature = "gui")]
pub const PICTURES: shipped::Files = include!(concat!(env!("OUT_DIR"), "/pictures.rs"));

/// A loader of plugins in these folders, with the first-party ones for what they lack.
#[must_use]
pub fn plugin_loader(folders: &[PathBuf]) -> Loader {
    loader_of(folders).with_linked(first_party())
}

/// The first-party plugins, linked.
#[must_use]
pub fn first_party() -> Vec<Hook> {
    let motion = Hook::Motion(Arc::new(endline_whale_motions::Swim::new()));
    let friction = endline_friction_models::all().into_iter().map(Hook::Friction);
    let gear = endline_gear_types::all().into_iter().map(Hook::Gear);
    std::iter::once(motion).chain(friction).chain(gear).collect()
}
