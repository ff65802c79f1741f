//! What a solver step was, or why it was rejected.

use super::stop::Stop;
use crate::contact::law::friction_arrays::Failed;
use crate::model::Model;
use crate::solver::Solver;
use crate::state::State;

/// Why a solver step must be redone shorter, or ends the run.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Rejection {
    NotFinite,
    NotConverged,
    PartsTooLate,
    /// Rope left the margin in which skin was looked for.
    Strayed,
    /// This segment crosses skin before the step begins.
    Crossed(usize),
    /// This segment is pinched at this triangle by skin that closes on it.
    Pinched(usize, usize),
    /// This body is pinched at this triangle by skin that closes on it, or would go through it.
    BodyPinched(usize, usize),
    /// These two bodies, or this body and this obstacle by its number after all bodies, are pressed into each other or would pass.
    BodiesMeet([usize; 2]),
    /// These two segments are pressed into each other harder than rope can bear.
    RopesPinched([usize; 2]),
    /// Rope may touch rope, which needs the shorter step of contact.
    RopesMeet,
    /// This segment went into or through this obstacle or body.
    WentThrough(usize, usize),
    /// More rope lies together at these two segments than is solved.
    RopesCrowded([usize; 2]),
    /// The friction plugin failed, with its message.
    Plugin(Failed),
}

impl Rejection {
    /// Whether a shorter step may help.
    pub fn may_halve(&self) -> bool {
        !matches!(self, Self::Crossed(_) | Self::RopesCrowded(_) | Self::Plugin(_))
    }

    /// The reason a run ends where even the shortest step is rejected.
    pub fn stop(self, model: &Model, state: &State, solver: &Solver) -> Stop {
        let line_of =
            |segment: usize| format!("line {}", model.spec.lines[model.segment_line[segment]].id);
        let worst = || {
            let line = solver.worst_line(model);
            line.map_or_else(
                || "model".into(),
                |line| format!("line {}", model.spec.lines[line].id),
            )
        };
        let (part, reason) = match self {
            Self::NotFinite => (
                worst(),
                "its numbers are no longer finite at the shortest step; check stiffness, mass and \
                 current of this part"
                    .into(),
            ),
            Self::NotConverged | Self::Strayed => (
                worst(),
                "no balance of forces was found at the shortest step; check strength and stiffness \
                 of this part"
                    .into(),
            ),
            Self::PartsTooLate => {
                (worst(), "it parts faster than the shortest step can follow".into())
            }
            Self::Crossed(segment) => (
                line_of(segment),
                "rope crosses the whale's skin where the run starts; move the whale or the gear apart"
                    .into(),
            ),
            Self::Pinched(segment, triangle) => {
                let whale = model.spec.whale.as_ref();
                let region =
                    whale.map_or("skin", |whale| whale.skin.regions[triangle].part().name());
                let reason = format!(
                    "rope is pinched at the whale's {region} by parts of the skin that close on it \
                     harder than rope can bear"
                );
                (line_of(segment), reason)
            }
            Self::BodyPinched(body, triangle) => {
                let whale = model.spec.whale.as_ref();
                let region =
                    whale.map_or("skin", |whale| whale.skin.regions[triangle].part().name());
                let reason = format!(
                    "it is pressed into the whale's {region} by parts of the skin that close on it, or \
                     by more than skin bears"
                );
                (format!("body {}", model.spec.bodies[body].id), reason)
            }
            Self::BodiesMeet([body, other]) => {
                let [part, other] =
                    [body, other].map(|thing| crate::contact::body_on_body::name_of(model, thing));
                (part, format!("it is pressed into {other} harder than either bears"))
            }
            Self::WentThrough(segment, solid) => {
                let solid = crate::solids::name_of(model, solid);
                let reason = format!(
                    "rope goes through {solid} even at the shortest step; use shorter segments or a \
                     slower start"
                );
                (line_of(segment), reason)
            }
            Self::RopesCrowded([segment, other]) => {
                let reason = format!(
                    "more rope lies together here, on {}, than can be solved; check its length, or use \
                     longer segments",
                    line_of(other)
                );
                (line_of(segment), reason)
            }
            Self::RopesPinched([segment, other]) => {
                let reason = format!(
                    "it is pressed into {} harder than rope can bear; check what pulls on both",
                    line_of(other)
                );
                (line_of(segment), reason)
            }
            Self::RopesMeet => {
                (worst(), "rope meets rope in a step that cannot be made shorter".into())
            }
            Self::Plugin(failed) => (failed.id, failed.message),
        };
        Stop { time_s: state.time_s, part, reason }
    }
}

/// What a solver step was.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum StepKind {
    /// No rope near skin.
    Free,
    /// Rope near skin, rope, obstacles or bodies; how much of what Newton is allowed it missed by.
    InContact {
        /// As a share.
        missed: f64,
    },
    /// Something parted at its end.
    Parted,
}
