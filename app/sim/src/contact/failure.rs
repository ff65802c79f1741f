//! Why contact refuses a solver step.

use crate::contact::law::friction_arrays::Failed;
use crate::model::{Model, Whale};

/// The kinds of contact, in the order of their sums.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    RopeOnSkin,
    BodyOnSkin,
    RopeOnSolid,
    RopeOnRope,
    BodyOnBody,
}

impl Kind {
    /// Number of kinds.
    pub const COUNT: usize = 5;
}

/// Why a step is refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Reason {
    /// The parts cross where the step begins.
    CrossedAtStart,
    /// The parts are pressed together harder than the law bears.
    Overcompressed,
    /// The path leads through.
    PassedThrough,
    /// The path could not be proved free.
    PathNotProved,
    /// A part left the margin in which contact was searched for.
    LeftSearchMargin,
    /// More places are in contact than can be solved.
    Crowded,
}

/// A step that contact refuses: the kind, the two parts, and the reason.
///
/// Parts are a segment and a triangle, a body and a triangle, a segment and a solid, two segments, or two bodies (obstacles come
/// after all bodies), by the kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Refusal {
    pub kind: Kind,
    pub parts: [usize; 2],
    pub reason: Reason,
}

/// A failure of contact in a solver step.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum ContactFailure {
    Refused(Refusal),
    /// The friction plugin failed.
    Plugin(Failed),
}

impl ContactFailure {
    /// A refusal.
    pub fn refused(kind: Kind, parts: [usize; 2], reason: Reason) -> Self {
        Self::Refused(Refusal { kind, parts, reason })
    }
}

impl Refusal {
    /// Whether a shorter step may help.
    pub fn may_halve(&self) -> bool {
        !matches!(self.reason, Reason::CrossedAtStart | Reason::Crowded)
    }

    /// The part and the reason, for the user; `None` where no balance of forces was found.
    pub fn describe(&self, model: &Model) -> Option<(String, String)> {
        let [one, two] = self.parts;
        let line_of =
            |segment: usize| format!("line {}", model.spec.lines[model.segment_line[segment]].id);
        let region_of = |triangle: usize| {
            let region = |whale: &Whale| whale.skin.regions[triangle].part().name();
            model.spec.whale.as_ref().map_or("skin", region)
        };
        let described = match (self.reason, self.kind) {
            (Reason::PathNotProved | Reason::LeftSearchMargin, _) => return None,
            (Reason::CrossedAtStart, _) => (
                line_of(one),
                "rope crosses the whale's skin where the run starts; move the whale or the gear apart"
                    .to_owned(),
            ),
            (Reason::Crowded, _) => (
                line_of(one),
                format!(
                    "more rope lies together here, on {}, than can be solved; check its length, or use \
                     longer segments",
                    line_of(two)
                ),
            ),
            (_, Kind::RopeOnSkin) => (
                line_of(one),
                format!(
                    "rope is pinched at the whale's {} by parts of the skin that close on it harder than \
                     rope can bear",
                    region_of(two)
                ),
            ),
            (_, Kind::BodyOnSkin) => (
                format!("body {}", model.spec.bodies[one].id),
                format!(
                    "it is pressed into the whale's {} by parts of the skin that close on it, or by more \
                     than skin bears",
                    region_of(two)
                ),
            ),
            (_, Kind::RopeOnSolid) => (
                line_of(one),
                format!(
                    "rope goes through {} even at the shortest step; use shorter segments or a slower start",
                    crate::solids::name_of(model, two)
                ),
            ),
            (_, Kind::RopeOnRope) => (
                line_of(one),
                format!(
                    "it is pressed into {} harder than rope can bear; check what pulls on both",
                    line_of(two)
                ),
            ),
            (_, Kind::BodyOnBody) => {
                let [part, other] =
                    [one, two].map(|thing| crate::contact::body_on_body::name_of(model, thing));
                (part, format!("it is pressed into {other} harder than either bears"))
            }
        };
        Some(described)
    }
}
