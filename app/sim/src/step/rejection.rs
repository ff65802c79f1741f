//! Results of a solver step: its kind, or why it was rejected.

use crate::contact::failure::{ContactFailure, Reason, Refusal};
use crate::contact::law::friction_arrays::Failed;
use crate::model::Model;
use crate::solver::Solver;
use crate::state::State;
use crate::step::Stop;

/// Why a solver step must be repeated shorter, or ends the run.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Rejection {
    NotFinite,
    NotConverged,
    PartsTooLate,
    /// Rope may touch rope, which needs the shorter step of contact.
    RopesMeet,
    /// Contact refuses the step.
    Contact(Refusal),
    /// The friction plugin failed, with its message.
    Plugin(Failed),
}

impl From<ContactFailure> for Rejection {
    fn from(failure: ContactFailure) -> Self {
        match failure {
            ContactFailure::Refused(refusal) => Self::Contact(refusal),
            ContactFailure::Plugin(failed) => Self::Plugin(failed),
        }
    }
}

impl Rejection {
    /// Whether a shorter step may help.
    pub fn may_halve(&self) -> bool {
        match self {
            Self::Contact(refusal) => refusal.may_halve(),
            Self::Plugin(_) => false,
            Self::NotFinite | Self::NotConverged | Self::PartsTooLate | Self::RopesMeet => true,
        }
    }

    /// Whether contact near the whale must be searched for again.
    pub fn calls_for_search(&self) -> bool {
        matches!(self, Self::Contact(refusal) if refusal.reason == Reason::LeftSearchMargin)
    }

    /// The reason a run ends if even the shortest step is rejected.
    pub fn stop(self, model: &Model, state: &State, solver: &Solver) -> Stop {
        let worst = || {
            let line = solver.worst_line(model);
            line.map_or_else(
                || "model".into(),
                |line| format!("line {}", model.spec.lines[line].id),
            )
        };
        let no_balance = || {
            let reason = "no balance of forces was found at the shortest step; check strength and \
                          stiffness of this part";
            (worst(), reason.to_owned())
        };
        let (part, reason) = match self {
            Self::NotFinite => (
                worst(),
                "its numbers are no longer finite at the shortest step; check stiffness, mass and \
                 current of this part"
                    .into(),
            ),
            Self::NotConverged => no_balance(),
            Self::PartsTooLate => {
                (worst(), "it parts faster than the shortest step can follow".into())
            }
            Self::RopesMeet => {
                (worst(), "rope meets rope in a step that cannot be made shorter".into())
            }
            Self::Contact(refusal) => refusal.describe(model).unwrap_or_else(no_balance),
            Self::Plugin(failed) => (failed.id, failed.message),
        };
        Stop { time_s: state.time_s, part, reason }
    }
}

/// Kind of a solver step that was accepted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum StepKind {
    /// Nothing may touch.
    Free,
    /// Something may touch.
    InContact {
        /// Error as a share of the tolerance of Newton.
        missed: f64,
        /// Number of iterations.
        passes: usize,
    },
    /// Something parted at its end.
    Parted,
}
