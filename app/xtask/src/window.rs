//! The window driven by real mouse and keys on a screen of its own, where the machine has what that needs.

use std::path::Path;
use std::process::Command;

use crate::Outcome;
use crate::packages::on_path;
use crate::workspace::{Profile, Workspace, announce};

/// A screen without a display, mouse and keys without hands, and pictures of it.
const TOOLS: [&str; 3] = ["Xvfb", "xdotool", "import"];

/// Each user's first hour in a real window; its pictures go to `<target>/first-hours`.
///
/// # Errors
/// When a step of it fails.
pub fn drive(workspace: &Workspace) -> Outcome {
    if let Some(missing) = TOOLS.into_iter().find(|tool| !on_path(tool)) {
        eprintln!(
            "there is no {missing} here, so the window is not driven; Debian: apt-get install xvfb xdotool imagemagick"
        );
        return Ok(());
    }
    let (script, pictures) =
        (Path::new("tests/window/first_hours.sh"), workspace.target.join("first-hours"));
    let program = workspace.program(Profile::Dev);
    announce(
        "tests/window/first_hours.sh",
        &[&program.display().to_string(), &pictures.display().to_string()],
    );
    let status = Command::new("bash")
        .arg(script)
        .args([&program, &pictures])
        .current_dir(&workspace.root)
        .status();
    match status {
        Ok(status) if status.success() => Ok(()),
        Ok(_) => Err(format!(
            "a user's first hour went wrong, see WRONG above; pictures are in {}",
            pictures.display()
        )),
        Err(error) => Err(format!("bash cannot be started: {error}")),
    }
}
