//! What statics found, and why not where it found nothing.

use std::fmt;

use glam::DVec3;

use super::newton::Reached;
use crate::model::{JointKind, Model};
use crate::solver::{WorstAt, is_laid};
use crate::state::State;

/// What statics found.
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome {
    /// The gear is at rest.
    AtRest,
    /// There is no rest: the gear drags. The state is that with the laid bodies held where they were laid.
    Drags(Drag),
    /// No balance was found: the state is the nearest to it.
    NotFound(Unfound),
}

/// How far statics came where it found no balance.
#[derive(Clone, Debug, PartialEq)]
pub enum Unfound {
    /// Not even with the laid bodies held where they were laid did the lines and buoys come to rest.
    Held,
    /// With the laid bodies held it is at rest, but not once they hold by their own grip; the gear that is nearest to
    /// dragging, where some lies on a seabed.
    Released(Option<Drag>),
    /// At rest with coarser segments, but not with these.
    Fine,
}

/// What pulls gear along the seabed and what holds it.
#[derive(Clone, Debug, PartialEq)]
pub struct Drag {
    /// The laid body that lacks most.
    pub body: String,
    /// Pull along the seabed on all laid bodies of the gear together [N].
    pub pull_n: f64,
    /// What they hold by friction, less what the lines lift [N].
    pub hold_n: f64,
}

impl Drag {
    /// Pull that nothing holds; less than zero where the gear holds more [N].
    #[must_use]
    pub fn excess_n(&self) -> f64 {
        self.pull_n - self.hold_n
    }

    /// Whether more pulls than holds.
    pub(super) fn is_lost(&self) -> bool {
        self.excess_n() > 0.0
    }
}

/// The part with the greatest force out of balance.
#[derive(Clone, Debug, PartialEq)]
pub struct Worst {
    /// The part, such as `line endline-top`.
    pub part: String,
    /// The force; on a body the torque where that is greater [N or N m].
    pub force_n: f64,
}

impl fmt::Display for Outcome {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::AtRest => f.write_str("at rest"),
            Self::Drags(drag) => write!(
                f,
                "the gear drags: {:.1} N more pull than its {:.1} N of hold on the seabed, most at `{}`",
                drag.excess_n(),
                drag.hold_n,
                drag.body
            ),
            Self::NotFound(unfound) => write!(f, "no balance of forces was found{unfound}"),
        }
    }
}

impl fmt::Display for Unfound {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Held => {
                f.write_str(", even with all that lies on the seabed held where it was laid")
            }
            Self::Released(None) => Ok(()),
            Self::Released(Some(Drag { body, pull_n, hold_n })) => {
                f.write_str(": with all that lies on the seabed held there it is at rest, but not once that is let go, ")?;
                write!(f, "with {pull_n:.1} N of pull for {hold_n:.1} N of hold, most at `{body}`")
            }
            Self::Fine => f.write_str(": it is at rest with coarser segments, but not with these"),
        }
    }
}

/// Names the part with the greatest force out of balance.
pub(super) fn worst(model: &Model, reached: &Reached) -> Option<Worst> {
    let (at, force_n) = reached.worst?;
    let part = match at {
        WorstAt::Line(line) => format!("line {}", model.spec.lines[line].id),
        WorstAt::Joint(joint) => format!("joint {}", model.spec.joints[joint].id),
        WorstAt::Body(body) => format!("body {}", model.spec.bodies[body].id),
    };
    Some(Worst { part, force_n })
}

/// Lean beyond which a laid body lies no more as it was laid, as a cosine: 45 degrees.
const OVERTURNED: f64 = core::f64::consts::FRAC_1_SQRT_2;

/// Whether a laid body has turned over from how it was laid.
pub(super) fn overturned(model: &Model, laid: &State, now: &State) -> bool {
    let up = |state: &State, body: usize| state.bodies[body].orientation * DVec3::Z;
    (0..model.spec.bodies.len())
        .any(|body| is_laid(model, body) && up(laid, body).dot(up(now, body)) < OVERTURNED)
}

/// The gear that is pulled hardest for what its laid bodies hold, from the loads on them where they are held.
///
/// At rest the seabed must take up the whole pull along it on a gear's bodies, and friction takes up no more than `μN`:
/// where the sum of the pulls is greater than the sum of the `μN` the gear drags, wherever the bodies lie.
pub(super) fn grip(model: &Model, held: &Reached) -> Option<Drag> {
    let seabed = model.spec.seabed.as_ref()?;
    let laid: Vec<usize> =
        (0..model.spec.bodies.len()).filter(|body| is_laid(model, *body)).collect();
    let gear = gear_of_bodies(model);
    let lacks = |one: usize| {
        let mates: Vec<usize> =
            (0..laid.len()).filter(|other| gear[laid[*other]] == gear[laid[one]]).collect();
        let along = |index: usize| held.load_n[index].reject_from_normalized(seabed.normal);
        let hold = |index: usize| {
            model.spec.bodies[laid[index]].start_friction
                * (-held.load_n[index].dot(seabed.normal)).max(0.0)
        };
        let pull_n = mates.iter().map(|mate| along(*mate)).sum::<DVec3>().length();
        let hold_n = mates.iter().map(|mate| hold(*mate)).sum::<f64>();
        let most = mates.iter().copied().max_by(|a, b| {
            (along(*a).length() - hold(*a)).total_cmp(&(along(*b).length() - hold(*b)))
        });
        Drag {
            body: most.map_or_else(String::new, |mate| model.spec.bodies[laid[mate]].id.clone()),
            pull_n,
            hold_n,
        }
    };
    let free = (0..laid.len()).filter(|index| gear[laid[*index]] != FIXED);
    free.map(lacks).max_by(|a, b| a.excess_n().total_cmp(&b.excess_n()))
}

/// Whether some gear is pulled harder than its laid bodies hold.
pub(super) fn drags(model: &Model, held: &Reached) -> Option<Drag> {
    grip(model, held).filter(Drag::is_lost)
}

/// Gear that a fixture or a held body keeps from dragging.
const FIXED: usize = usize::MAX;

/// A number for each body, the same for bodies of the same gear: those that lines join.
fn gear_of_bodies(model: &Model) -> Vec<usize> {
    let joints = &model.spec.joints;
    // Joints of one body are one; lines join their ends.
    let mut gear: Vec<usize> = (0..joints.len()).collect();
    let body_of = |joint: usize| {
        if let JointKind::Body { body, .. } = joints[joint].kind { Some(body) } else { None }
    };
    let pairs = model.spec.lines.iter().map(|line| (line.from, line.to));
    let same = (0..joints.len()).flat_map(|one| (0..one).map(move |other| (one, other)));
    let same =
        same.filter(|(one, other)| body_of(*one).is_some() && body_of(*one) == body_of(*other));
    for (one, other) in pairs.chain(same) {
        let (from, to) = (gear[one], gear[other]);
        gear.iter_mut().filter(|gear| **gear == from).for_each(|gear| *gear = to);
    }
    let fixed = |joint: usize| match joints[joint].kind {
        JointKind::Fixed | JointKind::Driven { .. } | JointKind::Whale(_) => true,
        JointKind::Body { body, .. } => model.spec.bodies[body].held_until_s.is_some(),
        JointKind::Free | JointKind::Pulled { .. } => false,
    };
    let fixed_gear: Vec<usize> =
        (0..joints.len()).filter(|joint| fixed(*joint)).map(|joint| gear[joint]).collect();
    let of_body = |body: usize| {
        let joint = (0..joints.len()).find(|joint| body_of(*joint) == Some(body));
        match joint {
            Some(joint) if fixed_gear.contains(&gear[joint]) => FIXED,
            Some(joint) => gear[joint],
            None => FIXED,
        }
    };
    (0..model.spec.bodies.len()).map(of_body).collect()
}
