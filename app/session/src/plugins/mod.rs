//! Plugins: found in folders, checked in a child process, loaded, and guarded while they run.
//!
//! ```text
//! folders -> files -> checker (child process) -> load (C table) -> guard (finite, passive) -> PluginHost
//! ```
//!
//! First-party plugins take the same road as anyone's. A file that cannot be used becomes a
//! [`PluginProblem`] and the program goes on without it.

pub mod check;
mod cut_short;
mod declared;
mod folders;
mod guard;
mod host;
mod info;
mod load;
mod new;

pub use check::trial::Finding;
pub use check::{Checker, Tried, by_child, check_here, remembering, report_here, report_of_child, try_here};
pub use folders::{default_folders, known_file};
pub use host::PluginHost;
pub use info::{Hook, PluginInfo, PluginKind, PluginProblem};
pub use new::{Language, Project, write_project};
