//! Tests of the suite that take seconds there, run for hours: `cargo xtask fuzz` and `cargo xtask soak`.

use crate::Outcome;
use crate::workspace::Workspace;

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
