//! Plugins: found in folders, checked in a child process, loaded, and guarded while they run.
//!
//! ```text
//! folders -> files -> choices (allowed by its user) -> checker (child process)
//!         -> library (C table, from a copy), in a process of its own unless it is trusted -> guard (finite, passive) -> PluginHost
//! ```
//!
//! First-party plugins take the same road as anyone's. A file that cannot be used becomes a
//! [`PluginProblem`] and the program continues without it.

pub mod check;
mod choices;
mod guard;
mod host;
mod info;
mod library;
mod loader;
mod new;
#[cfg(unix)]
mod process;

pub use check::trial::Finding;
pub use check::{Tried, by_child, check_here, remembering, report_here, report_of_child, try_here};
pub use choices::{Ask, Change, Choices};
pub use host::PluginHost;
pub use info::{Checker, Hook, PluginInfo, PluginKind, PluginProblem, PluginUsed, Standing};
pub(crate) use loader::data_folder;
pub use loader::{
    Loader, chosen_file, default_folders, file_hash, known_file, program, program_folder,
    stands_for,
};
pub use new::{Language, Project, write_project};
#[cfg(unix)]
pub use process::serve_here;
