//! What a solver step was, or why it was rejected.

use super::stop::Stop;
use crate::contact::skin_friction::Failed;
use crate::model::Model;
use crate::solver::Solver;
use crate::state::State;

/// Why a solver step must be redone shorter, or ends the run.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Rejection {
    NotFinite,
    NotConverged,
    PartsTooLate,
    /// This segment crosses skin before the step begins.
    Crossed(usize),
    /// This segment is pinched at this triangle by skin that closes on it.
    Pinched(usize, usize),
    /// These two segments are pressed into each other harder than rope can bear.
    RopesPinched([usize; 2]),
    /// Rope may touch rope, which needs the shorter step of contact.
    RopesMeet,
    /// This segment went into or through this obstacle or body.
    WentThrough(usize, usize),
    /// The friction plugin failed, with its message.
    Plugin(Failed),
}

impl Rejection {
    /// Whether a shorter step may help.
    pub fn may_halve(&self) -> bool {
        !matches!(self, Self::Crossed(_) | Self::Plugin(_))
    }

    /// The reason a run ends where even the shortest step is rejected.
    pub fn stop(self, model: &Model, state: &State, solver: &Solver) -> Stop {
        let line = || {
            solver.worst_line(model).map_or_else(
                || "model".into(),
                |line| format!("line {}", model.spec.lines[line].id),
            )
        };
        let (part, reason) = match self {
            Self::NotFinite => {
                (line(), "its numbers are no longer finite at the shortest step; check stiffness, mass and current of this part".into())
            }
            Self::NotConverged => {
                (line(), "no balance of forces was found at the shortest step; check strength and stiffness of this part".into())
            }
            Self::PartsTooLate => (line(), "it parts faster than the shortest step can follow".into()),
            Self::Crossed(segment) => {
                let line = &model.spec.lines[model.segment_line[segment]].id;
                (format!("line {line}"), "rope crosses the whale's skin where the run starts; move the whale or the gear apart".into())
            }
            Self::Pinched(segment, triangle) => {
                let line = &model.spec.lines[model.segment_line[segment]].id;
                let region = model.spec.whale.as_ref().map_or("skin", |whale| whale.skin.regions[triangle].part().name());
                let reason = format!("rope is pinched at the whale's {region} by parts of the skin that close on it harder than rope can bear");
                (format!("line {line}"), reason)
            }
            Self::WentThrough(segment, solid) => {
                let line = &model.spec.lines[model.segment_line[segment]].id;
                let solid = crate::solids::name_of(model, solid);
                (format!("line {line}"), format!("rope goes through {solid} even at the shortest step; use shorter segments or a slower start"))
            }
            Self::RopesPinched([segment, other]) => {
                let line = |segment: usize| &model.spec.lines[model.segment_line[segment]].id;
                let reason = format!("it is pressed into line {} harder than rope can bear; check what pulls on both", line(other));
                (format!("line {}", line(segment)), reason)
            }
            Self::RopesMeet => (line(), "rope meets rope in a step that cannot be made shorter".into()),
            Self::Plugin(failed) => (failed.id, failed.message),
        };
        Stop { time_s: state.time_s, part, reason }
    }
}

/// What a solver step was.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum StepKind {
    /// No rope near skin.
    Free,
    /// Rope near skin.
    InContact,
    /// Something parted at its end.
    Parted,
}
