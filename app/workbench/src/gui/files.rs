//! Files of a library that a user chooses among.

use std::path::Path;

pub use endline_session::locate::{scenarios, studies};

/// The name of a file without folder and ending.
#[must_use]
pub fn stem(path: &Path) -> String {
    path.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default()
}

/// Shows a folder in the system's file manager.
///
/// # Errors
/// Where there is no program that does.
pub fn open_folder(folder: &Path) -> Result<(), String> {
    let program = if cfg!(target_os = "macos") {
        "open"
    } else if cfg!(windows) {
        "explorer"
    } else {
        "xdg-open"
    };
    let opened = std::process::Command::new(program).arg(folder).spawn();
    opened
        .map(|_| ())
        .map_err(|error| format!("{}: {program} cannot show it: {error}", folder.display()))
}
