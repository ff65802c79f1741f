//! `cargo xtask test`: from a bare machine to the whole test suite; `--quick` to a part of it.

use std::process::{Command, Stdio};

use crate::workspace::{Profile, Workspace, announce};
use crate::{Outcome, driven, instructions, plugins, run, system_packages};

/// Programs of the quick tier: the rules of the workspace and the golden states.
const QUICK_PROGRAMS: [&str; 4] = ["--test", "tidy", "--test", "golden"];

/// Tests of the quick tier that call the program, by module.
const QUICK_CALLS: [&str; 2] = ["determinism::", "cli::"];

/// Runs formatting, lints, every test of the workspace, the bundled encounter, the counts of instructions if valgrind is installed, the scripts of the window, and a study on Slurm
/// if that is installed.
/// Errors: when any of them fails; the first failure ends it.
pub fn test(workspace: &Workspace) -> Outcome {
    check_sources(workspace)?;
    // Plugins are built before the tests: built after them, they would replace libraries that the tests link, and these would
    // be compiled twice.
    plugins::build(workspace, Profile::Dev)?;
    // `--tests` omits benches, which clippy has compiled, and examples in documentation, which do not exist. It builds the
    // program too, which the tests of the command line call.
    workspace.cargo(&["test", "--workspace", "--tests", "--no-run"])?;
    workspace.cargo(&["test", "--workspace", "--tests", "--no-fail-fast"])?;
    run::show_encounter(workspace, Profile::Dev)?;
    instructions::compare(workspace)?;
    driven::window(workspace)?;
    driven::slurm(workspace)
}

/// Runs the checks for everyday work: formatting, lints, the tests inside the crates, the rules of the workspace, the golden
/// states, and calls of the program.
/// Errors: when any of them fails; the first failure ends it.
pub fn quick(workspace: &Workspace) -> Outcome {
    check_sources(workspace)?;
    plugins::build(workspace, Profile::Dev)?;
    let inside = ["test", "--workspace", "--lib", "--bins"];
    workspace.cargo(&[inside.as_slice(), &QUICK_PROGRAMS].concat())?;
    // This builds the program as well. `cargo build`, or a selection of packages, would compile the outside crates once
    // more, without the features that tests enable.
    workspace.cargo(&["test", "--workspace", "--test", "all", "--no-run"])?;
    let calls = ["test", "--workspace", "--test", "program", "--"];
    workspace.cargo(&[calls.as_slice(), &QUICK_CALLS].concat())
}

/// Rewrites the table of golden states after an intended change of the physics.
/// Errors: when a scenario of the table no longer reaches the event it is meant to cover.
pub fn write_golden(workspace: &Workspace) -> Outcome {
    let arguments = ["test", "--workspace", "--test", "golden", "--", "--nocapture"];
    workspace.cargo_with(&arguments, &[("ENDLINE_WRITE_GOLDEN", "1")])
}

fn check_sources(workspace: &Workspace) -> Outcome {
    system_packages::ensure_for_test()?;
    ensure_components(workspace)?;
    workspace.cargo(&["fmt", "--all", "--check"])?;
    workspace.cargo(&["clippy", "--workspace", "--all-targets", "--", "--deny", "warnings"])
}

/// Installs formatter and linter by rustup, because a minimal Rust toolchain lacks them.
fn ensure_components(workspace: &Workspace) -> Outcome {
    let has = |tool: &str| workspace.quiet_cargo(&[tool, "--version"]);
    if has("fmt") && has("clippy") {
        return Ok(());
    }
    let arguments = ["component", "add", "rustfmt", "clippy"];
    announce("rustup", &arguments);
    let status = Command::new("rustup").args(arguments).stdin(Stdio::null()).status();
    if status.is_ok_and(|status| status.success()) {
        Ok(())
    } else {
        Err("this Rust toolchain has no rustfmt or no clippy; install them (Debian: apt-get install rustfmt rust-clippy)".to_owned())
    }
}

/// Feeds damaged files to every reader (`tests/tests/fuzz`) for a number of hours.
/// Errors: when the build fails, or a reader panics or hangs.
pub fn fuzz(workspace: &Workspace, hours: f64) -> Outcome {
    let arguments =
        ["test", "--release", "--package", "endline-tests", "--test", "fuzz", "--", "--nocapture"];
    workspace.cargo_with(&arguments, &[("ENDLINE_FUZZ_HOURS", &hours.to_string())])
}

/// Runs random sessions of the window on faults (`app/workbench/tests/all/soak`) for a number of hours.
/// Errors: when the build fails, or a session loses or tears a file, or hangs.
pub fn soak(workspace: &Workspace, hours: f64) -> Outcome {
    let random = "soak::random_sessions_with_faults_lose_and_break_nothing";
    let arguments = ["test", "--package", "endline", "--test", "all", "--", "--nocapture", random];
    workspace.cargo_with(&arguments, &[("ENDLINE_SOAK_HOURS", &hours.to_string())])
}
