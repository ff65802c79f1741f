//! Files and plugins embedded in the program, so that its one file works alone: the gear library, the first-party plugins and the
//! documents.
//!
//! Folders have precedence: a gear library that is found, or a plugin file with the same id, is used instead.

use std::path::PathBuf;
use std::sync::Arc;

use endline_session::plugins::{Hook, Loader};
use endline_session::{plugin_loader as loader_of, shipped};

/// Files of the gear library at the time of the build, as listed by `build.rs`.
pub const GEAR_LIBRARY: shipped::Files = include!(concat!(env!("OUT_DIR"), "/gear_library.rs"));

/// The documents, as Markdown.
pub const DOCUMENTS: shipped::Files = include!(concat!(env!("OUT_DIR"), "/documents.rs"));

/// The pictures of the documents.
#[cfg(feature = "gui")]
pub const PICTURES: shipped::Files = include!(concat!(env!("OUT_DIR"), "/pictures.rs"));

/// A loader for the plugins in folders, and for the first-party plugins that are not in them.
pub fn plugin_loader(folders: &[PathBuf]) -> Loader {
    loader_of(folders).with_linked(first_party())
}

/// The first-party plugins, linked into the program.
pub fn first_party() -> Vec<Hook> {
    let motion = Hook::Motion(Arc::new(endline_whale_motions::Swim::new()));
    let friction = endline_friction_models::all().into_iter().map(Hook::Friction);
    let gear = endline_gear_types::all().into_iter().map(Hook::Gear);
    std::iter::once(motion).chain(friction).chain(gear).collect()
}
