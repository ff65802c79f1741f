//! Bodies of the rig against each other: traps of a trawl, a buoy and its high-flyer.
//!
//! Each body is a core with a surface that lies by its contact distance `h` off it, as against skin (`contact/bodies/core.rs`). Where two cores are nearer than
//! `h₁ + h₂`, the bodies push each other off along the line of least distance, by a law that is linear at first and stiffens as the cores
//! come near (`contact/barrier.rs`), with friction by an elastic grip (`solver/elastic_grip.rs`). Boxes whose faces lie along each other bear
//! where these overlap, so that a trap stands flat on another. The cores never meet: the path of each solver step is proved free (`path.rs`).
//!
//! Bodies that overlap as they are placed (a buoy stowed on its trap) are not driven apart: the depth at their first touch is forgiven for as
//! long as they do not separate.

mod gather;
mod measure;
mod nearest;
mod path;
mod touching;

use glam::{DMat3, DVec3};
use parry3d::query::ContactManifold;

use super::bodies::core::BodyCore;
use crate::model::Model;
use crate::solids::Pose;

pub(crate) use gather::Coupled;
pub use touching::bodies_touching;

/// Stiffness of a touch of two bodies [N/m]: wire traps and hard floats give way by a millimetre or so under the weight of a man; estimate.
const STIFFNESS_N_M: f64 = 2e5;
/// Friction of bodies on each other: coated wire and plastic, wet, 0.2 to 0.4; estimate.
const FRICTION: f64 = 0.3;

/// Two bodies that may touch in a solver step.
#[derive(Clone, Copy, Debug)]
struct Pair {
    bodies: [usize; 2],
    /// Distance of the cores where the solver step begins [m].
    gap: f64,
    /// Depth that is forgiven [m].
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
    /// Depth beyond what is forgiven [m].
    depth: f64,
    share: f64,
    /// Push and friction on the first body, and `-d force / d place` of the one relative to the other [N], [N/m].
    force: DVec3,
    block: DMat3,
    /// The grip's stretch at the end of the step, in the world [m].
    stretch: DVec3,
}

/// Scratch of bodies against each other for one model; it keeps nothing that a step depends on.
#[derive(Clone, Debug, Default)]
pub(crate) struct BodyPairs {
    cores: Vec<BodyCore>,
    pairs: Vec<Pair>,
    /// Whether two bodies may touch in this solver step.
    pub touching: bool,
    /// Passes of the solver step in which shares were measured.
    shared: usize,
    touches: Vec<Touch>,
    /// The same as measured before.
    touched: Vec<Touch>,
    /// Where each body was when it was measured last.
    measured: Vec<Pose>,
    manifold: ContactManifold<(), ()>,
    /// Places of two cores at which they may touch, by number.
    places: Vec<(u64, [DVec3; 2])>,
    dt: f64,
}

impl BodyPairs {
    /// Scratch for a model.
    pub fn new(model: &Model) -> Self {
        let bodies = &model.spec.bodies;
        let collide = model.spec.settings.bodies_on_bodies && bodies.len() > 1;
        let cores = if collide { bodies.iter().map(BodyCore::of).collect() } else { Vec::new() };
        Self { cores, ..Self::default() }
    }
}
