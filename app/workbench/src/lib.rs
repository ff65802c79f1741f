//! The parts of the program `endline`: command line, pictures, workbench.
//!
//! | module | feature | what |
//! |---|---|---|
//! | [`cli`] | | the command line |
//! | [`scene`] | `scene` | what a frame looks like, as plain data; drawing it with or without a display |
//! | [`input`] | `gui` | gamepad and keyboard as the pilot's controls |
//! | [`gui`] | `gui` | the workbench |

pub mod cli;
#[cfg(feature = "gui")]
pub mod gui;
#[cfg(feature = "gui")]
pub mod input;
#[cfg(feature = "scene")]
pub mod scene;
