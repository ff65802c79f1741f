//! The parts of the program `endline`: command line, pictures, workbench.
//!
//! | module | feature | content |
//! |---|---|---|
//! | [`cli`] | | the command line |
//! | [`scene`] | `scene` | drawing of a frame, with or without a display |
//! | [`documents`] | | the documents, also as HTML pages |
//! | [`embedded`] | | the gear library, the first-party plugins and the documents embedded in the program |
//! | [`input`] | `gui` | gamepad and keyboard as controls of the whale |
//! | [`gui`] | `gui` | the window of the workbench |

#![cfg_attr(
    test,
    allow(clippy::disallowed_methods, reason = "tests read files that they have written")
)]

pub mod cli;
pub mod documents;
pub mod embedded;
#[cfg(feature = "gui")]
pub mod gui;
#[cfg(feature = "gui")]
pub mod input;
#[cfg(feature = "scene")]
pub mod scene;
