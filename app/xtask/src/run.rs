//! `cargo xtask run`: from a bare machine to the workbench.

use std::process::ExitStatus;

use crate::workspace::{Profile, Workspace};
use crate::{Outcome, plugins, system_packages};

/// The bundled encounter.
const ENCOUNTER: &str = "gear-library/scenarios/hello-endline.toml";

/// Builds everything in release, then opens the workbench; without a display, runs the bundled encounter.
/// Errors: when a package, the build or the program fails.
pub fn run(workspace: &Workspace) -> Outcome {
    build(workspace)?;
    if has_display() {
        return succeeded(workspace.call_program(Profile::Release, &[])?);
    }
    eprintln!(
        "no display here (neither DISPLAY nor WAYLAND_DISPLAY is set): running the bundled encounter instead of the workbench"
    );
    show_encounter(workspace, Profile::Release)
}

/// Builds everything in release, then calls the program with the user's own arguments.
/// Errors: when a package, the build or the program fails.
pub fn run_with(workspace: &Workspace, arguments: &[&str]) -> Outcome {
    build(workspace)?;
    succeeded(workspace.call_program(Profile::Release, arguments)?)
}

fn build(workspace: &Workspace) -> Outcome {
    system_packages::ensure_for_run()?;
    workspace.cargo(&["build", Profile::Release.flag(), "--package", "endline"])?;
    plugins::build(workspace, Profile::Release)
}

/// Runs the bundled encounter, which prints a summary and draws the state of greatest tension.
/// Errors: when the program fails or writes no picture.
pub fn show_encounter(workspace: &Workspace, profile: Profile) -> Outcome {
    let folder = workspace.target.join("hello");
    let picture = folder.join("picture.png");
    if picture.exists() {
        // An old picture must not pass for a new one.
        std::fs::remove_file(&picture)
            .map_err(|error| format!("cannot remove {}: {error}", picture.display()))?;
    }
    let folder = folder.to_str().ok_or("the target folder's name is not plain text")?;
    succeeded(workspace.call_program(profile, &["run", ENCOUNTER, "--out", folder])?)?;
    if !picture.is_file() {
        return Err(format!(
            "the encounter ran, but did not draw {}; see above",
            picture.display()
        ));
    }
    eprintln!("wrote summary, recording and picture to {folder}");
    Ok(())
}

fn succeeded(status: ExitStatus) -> Outcome {
    if status.success() { Ok(()) } else { Err(format!("endline ended with {status}")) }
}

fn has_display() -> bool {
    let is_set = |name| std::env::var_os(name).is_some_and(|value| !value.is_empty());
    !cfg!(target_os = "linux") || is_set("DISPLAY") || is_set("WAYLAND_DISPLAY")
}
