//! `cargo xtask test`: from a bare machine to the whole test suite.

use std::process::{Command, Stdio};

use crate::workspace::{Profile, Workspace, announce};
use crate::{Outcome, packages, plugins, run, window};

/// Formatting, lints, every test of the workspace, the bundled encounter from start to picture, and the window in use.
///
/// # Errors
/// When any of them fails; the first failure ends it.
pub fn test(workspace: &Workspace) -> Outcome {
    packages::ensure_for_test()?;
    ensure_components(workspace)?;
    workspace.cargo(&["fmt", "--all", "--check"])?;
    workspace.cargo(&["clippy", "--workspace", "--all-targets", "--", "--deny", "warnings"])?;
    // The same selection and targets as the tests, so that nothing is compiled twice with other features;
    // the tests of the command line call the program that this makes.
    workspace.cargo(&["build", "--workspace", "--all-targets"])?;
    plugins::build(workspace, Profile::Dev)?;
    workspace.cargo(&["test", "--workspace", "--no-fail-fast"])?;
    run::show_encounter(workspace, Profile::Dev)?;
    window::drive(workspace)
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
