//! Tests that drive the built program from outside, by scripts, where the machine has what they need: the window by real mouse and
//! keys on a screen of its own, and a study by a real queue of a cluster.

use std::path::Path;
use std::process::Command;

use crate::Outcome;
use crate::system_packages::on_path;
use crate::workspace::{Profile, Workspace, announce};

/// A script that takes the program and a folder of its own.
struct Script {
    file: &'static str,
    /// What it drives.
    what: &'static str,
    /// Programs that it needs.
    tools: &'static [&'static str],
    /// Debian's packages of them.
    packages: &'static str,
    /// Name of its folder in that of the build.
    folder: &'static str,
}

const WINDOW: Script = Script {
    file: "tests/window/first_hours.sh",
    what: "each user's first hour in a real window",
    tools: &["Xvfb", "xdotool", "import"],
    packages: "xvfb xdotool imagemagick",
    folder: "first-hours",
};

const SLURM: Script = Script {
    file: "tests/cluster/slurm.sh",
    what: "a study on a Slurm of one node",
    tools: &["slurmctld", "slurmd", "munged", "sbatch", "bc"],
    packages: "slurm-wlm munge bc, as root",
    folder: "slurm",
};

/// Each user's first hour in a real window; its pictures go to `<target>/first-hours`.
///
/// # Errors
/// When a step of it fails.
pub fn window(workspace: &Workspace) -> Outcome {
    drive(workspace, &WINDOW, workspace.program(Profile::Dev).as_path())
}

/// A study on a Slurm of its own, with a task that is killed and one that is put back; its results go to `<target>/slurm`.
///
/// # Errors
/// When its table is not that of one process.
pub fn slurm(workspace: &Workspace) -> Outcome {
    drive(workspace, &SLURM, workspace.program(Profile::Dev).as_path())
}

fn drive(workspace: &Workspace, script: &Script, program: &Path) -> Outcome {
    let Script { file, what, tools, packages, folder } = script;
    if let Some(missing) = tools.iter().find(|tool| !on_path(tool)) {
        eprintln!(
            "skipped: {what}, as there is no {missing} here; Debian: apt-get install {packages}"
        );
        return Ok(());
    }
    let folder = workspace.target.join(folder);
    announce(file, &[&program.display().to_string(), &folder.display().to_string()]);
    let status = Command::new("bash")
        .arg(file)
        .args([program, &folder])
        .current_dir(&workspace.root)
        .status();
    match status {
        Ok(status) if status.success() => Ok(()),
        Ok(_) => {
            Err(format!("{what} went wrong, see above; what it left is in {}", folder.display()))
        }
        Err(error) => Err(format!("bash cannot be started: {error}")),
    }
}
