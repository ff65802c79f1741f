//! Tests that drive the built program from outside, by scripts, where the machine has what they need: the window by real mouse and
//! keys on a screen of its own, a study by a real queue of a cluster, and the program for Windows under Wine.

use std::path::Path;
use std::process::Command;

use crate::Outcome;
use crate::system_packages::are_here;
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

const WINDOWS: Script = Script {
    file: "tests/windows/wine.sh",
    what: "the program for Windows under Wine",
    tools: &["wine", "x86_64-w64-mingw32-gcc"],
    packages: "wine wine64 gcc-mingw-w64-x86-64-win32",
    folder: "windows",
};

/// Rust's name of the system for which [`windows`] builds.
const WINDOWS_TARGET: &str = "x86_64-pc-windows-gnu";

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

/// The program and a plugin library built for Windows, run under Wine and held against the same code here; what they left goes to
/// `<target>/windows`.
///
/// # Errors
/// When they cannot be built (`rustup target add x86_64-pc-windows-gnu` brings Rust's part), or a state or table differs.
pub fn windows(workspace: &Workspace) -> Outcome {
    if !WINDOWS.is_skipped() {
        workspace.cargo(&["build", "--package", "endline"])?;
        let build = |package: &[&str]| {
            workspace
                .cargo(&[&["build", "--target", WINDOWS_TARGET, "--package"], package].concat())
        };
        build(&["endline"])?;
        build(&["endline-friction-models", "--lib", "--features", "entry"])?;
    }
    drive(workspace, &WINDOWS, workspace.program(Profile::Dev).as_path())
}

impl Script {
    /// Whether a tool is missing, which is told.
    fn is_skipped(&self) -> bool {
        !are_here(self.what, self.tools, self.packages)
    }
}

fn drive(workspace: &Workspace, script: &Script, program: &Path) -> Outcome {
    if script.is_skipped() {
        return Ok(());
    }
    let Script { file, what, folder, .. } = script;
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
