//! Tests that take seconds in the suite, for hours: `cargo xtask fuzz` and `cargo xtask soak`.

use crate::Outcome;
use crate::workspace::Workspace;

/// Feeds damaged files (`tests/tests/fuzz`) for so many hours.
///
/// # Errors
/// When it cannot be built, or found something.
pub fn fuzz(workspace: &Workspace, hours: f64) -> Outcome {
    let arguments =
        ["test", "--release", "--package", "endline-tests", "--test", "fuzz", "--", "--nocapture"];
    workspace.cargo_with(&arguments, &[("ENDLINE_FUZZ_HOURS", &hours.to_string())])
}

/// Runs random sessions of the window on faults (`app/workbench/tests/all/soak`) for so many hours.
///
/// # Errors
/// When it cannot be built, or a promise was broken.
pub fn soak(workspace: &Workspace, hours: f64) -> Outcome {
    let random = "soak::random_sessions_on_faults_keep_every_promise";
    let arguments = ["test", "--package", "endline", "--test", "all", "--", "--nocapture", random];
    workspace.cargo_with(&arguments, &[("ENDLINE_SOAK_HOURS", &hours.to_string())])
}
