//! Scripts that test the built program from outside, if the machine has the tools they need.
//!
//! They drive the window with a real mouse and keyboard on a virtual screen, run a study in the queue of a cluster, and run
//! the program for Windows under Wine. The golden states run on other processors that qemu emulates: x86-64 with and without wide
//! vector registers, and ARM.

use std::path::Path;
use std::process::Command;

use crate::Outcome;
use crate::system_packages::are_here;
use crate::workspace::{Profile, Workspace, announce};

/// A script; its arguments are the program and an output folder.
struct Script {
    file: &'static str,
    /// Its subject, for messages.
    what: &'static str,
    /// Programs it needs.
    tools: &'static [&'static str],
    /// Debian packages of these programs.
    packages: &'static str,
    /// Its output folder below the target folder.
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

/// Target triple of [`windows`].
const WINDOWS_TARGET: &str = "x86_64-pc-windows-gnu";

/// Plays each user's first hour in a real window; writes the pictures to `<target>/first-hours`.
/// Errors: when a step fails.
pub fn window(workspace: &Workspace) -> Outcome {
    drive(workspace, &WINDOW, workspace.program(Profile::Dev).as_path())
}

/// Runs a study on a Slurm of one node, kills one task and requeues another; writes the results to `<target>/slurm`.
/// Errors: when the table differs from that of a single process.
pub fn slurm(workspace: &Workspace) -> Outcome {
    drive(workspace, &SLURM, workspace.program(Profile::Dev).as_path())
}

/// Builds the program and a plugin library for Windows, runs them under Wine and compares their results with those of this
/// system; writes the results to `<target>/windows`.
/// Errors: when the build fails (`rustup target add x86_64-pc-windows-gnu` installs the standard library), or a state or table
/// differs.
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
    /// Whether a tool is missing; prints which.
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
        Ok(_) => Err(format!("{what} failed, see above; its output is in {}", folder.display())),
        Err(error) => Err(format!("bash cannot be started: {error}")),
    }
}

/// The test for each processor.
const GOLDEN: [&str; 5] = ["test", "--package", "endline-tests", "--test", "golden"];
/// x86-64 processors by qemu's names: SSE2 alone, SSE4.2, AVX2, and AVX2 of another manufacturer.
const KINDS: [&str; 4] = ["qemu64", "Nehalem", "Haswell", "EPYC-Rome"];
/// Target triple of ARM.
const ARM: &str = "aarch64-unknown-linux-gnu";

/// Compares the golden states on each processor that can be emulated with the table of this repository.
/// Errors: when a test cannot be built (`rustup target add aarch64-unknown-linux-gnu` installs the standard
/// library of ARM), or a state differs.
pub fn emulate(workspace: &Workspace) -> Outcome {
    if are_here("other x86-64 processors", &["qemu-x86_64"], "qemu-user") {
        for kind in KINDS {
            let runner = format!("qemu-x86_64 -cpu {kind}");
            let runner = [("CARGO_TARGET_X86_64_UNKNOWN_LINUX_GNU_RUNNER", runner.as_str())];
            workspace.cargo_with(&GOLDEN, &runner)?;
        }
    }
    let packages = "qemu-user gcc-aarch64-linux-gnu libc6-dev-arm64-cross";
    if are_here("ARM", &["qemu-aarch64", "aarch64-linux-gnu-gcc"], packages) {
        let arm = [
            (
                "CARGO_TARGET_AARCH64_UNKNOWN_LINUX_GNU_RUNNER",
                "qemu-aarch64 -L /usr/aarch64-linux-gnu",
            ),
            ("CARGO_TARGET_AARCH64_UNKNOWN_LINUX_GNU_LINKER", "aarch64-linux-gnu-gcc"),
            ("CC_aarch64_unknown_linux_gnu", "aarch64-linux-gnu-gcc"),
        ];
        workspace.cargo_with(&[GOLDEN.as_slice(), &["--target", ARM]].concat(), &arm)?;
    }
    Ok(())
}
