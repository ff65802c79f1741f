//! Bodies of the rig against each other and against obstacles: traps of a trawl, a buoy and its high-flyer, a trap on a ramp.
//!
//! Each part of a body is a core with a surface at the contact distance `h` from it, as against skin (`geometry/core.rs`). Where two cores
//! of different bodies are closer than `h₁ + h₂`, the bodies repel each other along the line of least distance, by a law that is linear at
//! first and stiffens as the cores approach (`law/barrier.rs`), with friction by an elastic grip (`law/elastic_grip.rs`). Parallel faces of
//! boxes bear over their common area, so that a trap stands flat on another. The cores never meet: the path of each solver step is proved
//! free (`path.rs`).
//!
//! An obstacle is a body of one part that never moves and has no unknowns; it has its own coefficient of friction. Bodies and their
//! parts come first in all numbers, then obstacles.
//!
//! Bodies that overlap as they are placed (a buoy stowed on its trap) are not driven apart: the depth at their first touch is allowed
//! until they separate.

mod gather;
mod kind;
mod measure;
mod nearest;
mod path;
#[cfg(test)]
mod tests;
mod touching;

use glam::{DMat3, DVec3};
use parry3d::query::ContactManifold;

use crate::geometry::Pose;
use crate::geometry::core::BodyCore;
use crate::model::{Model, Obstacle};
use crate::state::State;

pub use touching::bodies_touching;

/// Stiffness of a touch of two bodies [N/m]: wire traps and hard floats yield by about a millimetre under the weight of a man; estimate.
const STIFFNESS_N_M: f64 = 2e5;
/// Friction of bodies on each other: coated wire and plastic, wet, 0.2 to 0.4; estimate.
const FRICTION: f64 = 0.3;

/// Parts of two bodies, or of a body and an obstacle, that may touch in a solver step.
#[derive(Clone, Copy, Debug)]
struct Pair {
    parts: [usize; 2],
    /// The bodies or obstacles to which they belong.
    bodies: [usize; 2],
    /// Distance of the cores where the solver step begins [m].
    gap: f64,
    /// Overlap that is allowed [m].
    forgiven_m: f64,
    /// Push and friction on the first body by the last solution [N].
    solved: DVec3,
}

/// A place at which two bodies touch, as measured last.
#[derive(Clone, Copy, Debug)]
struct Touch {
    pair: usize,
    /// Which: the nearest places, an end or corner of either, or where two faces bear.
    feature: u64,
    place: DVec3,
    /// From the second body to the first.
    normal: DVec3,
    /// Depth beyond the allowed overlap [m].
    depth: f64,
    share: f64,
    /// Push and friction on the first body, and `-d force / d place` of the one relative to the other [N], [N/m].
    force: DVec3,
    block: DMat3,
    /// The grip's stretch at the end of the step, in the world [m].
    stretch: DVec3,
}

/// "body" or "obstacle" with its id.
pub(crate) fn name_of(model: &Model, thing: usize) -> String {
    let spec = &model.spec;
    match spec.bodies.get(thing) {
        Some(body) => format!("body {}", body.id),
        None => format!("obstacle {}", spec.obstacles[thing - spec.bodies.len()].id),
    }
}

/// Bodies against each other in one model. A step depends on nothing that is stored here between steps.
#[derive(Clone, Debug, Default)]
pub(crate) struct BodyOnBody {
    /// Cores of the parts of bodies, then of obstacles.
    cores: Vec<BodyCore>,
    /// How many of them are those of bodies, and how many bodies there are.
    part_count: usize,
    count: usize,
    /// Whether bodies touch each other.
    mutual: bool,
    /// Poses of the obstacles.
    still: Vec<Pose>,
    /// Friction of bodies on each obstacle.
    friction: Vec<f64>,
    /// How far the surface of each core moves in the solver step, at most [m].
    moves_m: Vec<f64>,
    pairs: Vec<Pair>,
    /// Whether two bodies may touch in this solver step.
    pub touching: bool,
    /// Passes of the solver step in which shares were measured.
    shared: usize,
    touches: Vec<Touch>,
    /// Touches of the evaluation before.
    touched: Vec<Touch>,
    /// Where each body was when it was measured last, and each obstacle.
    measured: Vec<Pose>,
    manifold: ContactManifold<(), ()>,
    /// Places of two cores at which they may touch, by number.
    places: Vec<(u64, [DVec3; 2])>,
    dt: f64,
}

impl BodyOnBody {
    /// Scratch for a model.
    pub fn new(model: &Model) -> Self {
        let (bodies, obstacles) = (&model.spec.bodies, &model.spec.obstacles);
        let mutual = model.spec.settings.bodies_on_bodies && bodies.len() > 1;
        if !mutual && obstacles.is_empty() {
            return Self::default();
        }
        let numbers = bodies.len()..;
        let of_obstacles =
            numbers.zip(obstacles).map(|(thing, it)| BodyCore::of_obstacle(thing, it));
        Self {
            cores: BodyCore::of_bodies(bodies).chain(of_obstacles).collect(),
            part_count: bodies.iter().map(|body| body.parts.len()).sum(),
            count: bodies.len(),
            mutual,
            still: obstacles.iter().map(Obstacle::pose).collect(),
            friction: obstacles.iter().map(|obstacle| obstacle.friction).collect(),
            ..Self::default()
        }
    }

    /// Where a body or an obstacle is when the solver step begins.
    fn began(&self, state: &State, thing: usize) -> Pose {
        self.pose(thing, |body| Pose::of(&state.bodies[body]))
    }

    /// Where a body or an obstacle is, with bodies in these poses.
    fn pose(&self, thing: usize, of_body: impl Fn(usize) -> Pose) -> Pose {
        if thing < self.count { of_body(thing) } else { self.still[thing - self.count] }
    }

    fn friction_of(&self, pair: usize) -> f64 {
        let obstacle = self.pairs[pair].bodies[1].checked_sub(self.count);
        obstacle.map_or(FRICTION, |obstacle| self.friction[obstacle])
    }
}
