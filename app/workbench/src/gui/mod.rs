//! The workbench: an egui window over a session.

use std::path::PathBuf;

/// How the workbench starts.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// Folder of the gear library; searched for where `None`.
    pub library: Option<PathBuf>,
    /// Scenario opened at the start; `hello-endline` of the library where `None`.
    pub scenario: Option<PathBuf>,
    /// Folders searched for plugins.
    pub plugins: Vec<PathBuf>,
    /// Where layout and preferences are kept; the user's data folder where `None`.
    pub settings: Option<PathBuf>,
}

/// Opens the workbench and returns when its window is closed.
///
/// # Errors
/// With the reason, where no window can be opened (no display, no OpenGL).
pub fn open(_options: Options) -> Result<(), String> {
    Err("the window is not part of this build yet; use `endline run SCENARIO`".into())
}
