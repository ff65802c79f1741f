//! The parts of the program `endline`: command line, pictures, workbench.
//!
//! | module | feature | what |
//! |---|---|---|
//! | [`cli`] | | the command line |
//! | [`scene`] | `scene` | what a frame looks like, as plain data; drawing it with or without a display |
//! | [`documents`] | | the documents, and as pages for a browser |
//! | [`inside`] | | the gear library, the first-party plugins and the documents inside the program |
//! | [`input`] | `gui` | gamepad and keyboard as the pilot's controls |
//! | [`gui`] | `gui` | the workbench |

#![cfg_attr(
    test,
    allow(clippy::disallowed_methods, reason = "tests read files that they have written")
)]

pub mod cli;
pub mod documents;
#[cfg(feature = "gui")]
pub mod gui;
#[cfg(feature = "gui")]
pub mod input;
pub mod inside;
#[cfg(feature = "scene")]
pub mod scene;
