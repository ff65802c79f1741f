//! `cargo xtask test`: from a bare machine to the whole test suite; `--quick` to a part of it.

use std::process::{Command, Stdio};

use crate::workspace::{Profile, Workspace, announce};
use crate::{Outcome, driven, plugins, run, system_packages};

/// Programs of the quick tier: the rules of the workspace and the golden states.
const QUICK_PROGRAMS: [&str; 4] = ["--test", "tidy", "--test", "golden"];

/// Tests of the quick tier that call the program, by the start of their names.
const QUICK_CALLS: [&str; 2] = ["determinism::", "cli::"];

/// Formatting, lints, every test of the workspace, the bundled encounter from start to picture, the window in use, and a study on Slurm where that is.
///
/// # Errors
/// When any of them fails; the first failure ends it.
pub fn test(workspace: &Workspace) -> Outcome {
    check_sources(workspace)?;
    // Before the tests: built after them, the plugins would replace libraries that the tests link, which would then be
    // compiled twice.
    plugins::build(workspace, Profile::Dev)?;
    // `--tests` leaves out benches, which clippy has compiled, and examples in documentation, of which there are none.
    // The program is among what it builds: the tests of the command line call it.
    workspace.cargo(&["test", "--workspace", "--tests", "--no-run"])?;
    workspace.cargo(&["test", "--workspace", "--tests", "--no-fail-fast"])?;
    run::show_encounter(workspace, Profile::Dev)?;
    driven::window(workspace)?;
    driven::slurm(workspace)
}

/// What everyday work runs: formatting, lints, the tests inside the crates, the rules of the workspace, the golden states,
/// and the program called as a user calls it.
///
/// # Errors
/// When any of them fails; the first failure ends it.
pub fn quick(workspace: &Workspace) -> Outcome {
    check_sources(workspace)?;
    plugins::build(workspace, Profile::Dev)?;
    let inside = ["test", "--workspace", "--lib", "--bins"];
    workspace.cargo(&[inside.as_slice(), &QUICK_PROGRAMS].concat())?;
    // The program is built for the tests of its window. `cargo build` would compile the outside crates once more, without
    // the features that tests ask for; so would a choice of packages.
    workspace.cargo(&["test", "--workspace", "--test", "all", "--no-run"])?;
    let calls = ["test", "--workspace", "--test", "program", "--"];
    workspace.cargo(&[calls.as_slice(), &QUICK_CALLS].concat())
}

/// Writes the table of golden states anew, after a change of the physics that was meant.
///
/// # Errors
/// When a scenario of the table no longer shows what it is there for.
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

/// A minimal Rust toolchain comes without its formatter and linter; rustup can add them.
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
