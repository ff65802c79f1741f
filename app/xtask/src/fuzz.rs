//! `cargo xtask fuzz`: damaged files for hours.

use crate::Outcome;
use crate::workspace::Workspace;

/// Runs the long test of `tests/tests/fuzz` for so many hours.
///
/// # Errors
/// When it cannot be built, or found something.
pub fn for_hours(workspace: &Workspace, hours: f64) -> Outcome {
    let arguments = ["test", "--package", "endline-tests", "--test", "fuzz", "--", "--nocapture"];
    workspace.cargo_with(&arguments, &[("ENDLINE_FUZZ_HOURS", &hours.to_string())])
}
