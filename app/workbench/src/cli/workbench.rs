//! `endline` without a command: the workbench.

use std::path::Path;
use std::process::ExitCode;

use super::Failure;

/// Opens the workbench, or says why not and what to use instead.
#[cfg(feature = "gui")]
pub(super) fn open(library: Option<&Path>) -> Result<ExitCode, Failure> {
    if !has_display() {
        return Err(Failure::failed(
            "there is no display here (neither DISPLAY nor WAYLAND_DISPLAY is set); use `endline run SCENARIO`, or see `endline --help`",
        ));
    }
    let plugins = super::host::folders();
    let options = crate::gui::Options {
        library: library.map(Path::to_path_buf),
        plugins,
        ..Default::default()
    };
    crate::gui::open(options).map_err(Failure::failed)?;
    Ok(ExitCode::SUCCESS)
}

#[cfg(feature = "gui")]
fn has_display() -> bool {
    let set = |name| std::env::var_os(name).is_some_and(|value| !value.is_empty());
    !cfg!(target_os = "linux") || set("DISPLAY") || set("WAYLAND_DISPLAY")
}

/// A build without a screen says so.
#[cfg(not(feature = "gui"))]
pub(super) fn open(_library: Option<&Path>) -> Result<ExitCode, Failure> {
    Err(Failure::failed(
        "this program was built without its workbench; use `endline run SCENARIO`, or see `endline --help`",
    ))
}
