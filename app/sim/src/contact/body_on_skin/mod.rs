//! Bodies of the rig against the whale's skin: traps, buoys and anchors.
//!
//! Each part of a body is a core with a surface at the contact distance `h` from that core (`geometry/core.rs`): a ball is a point, a buoy
//! a rod, a trap a box with rounded edges, a staff a cylinder. All parts move with their body. Where the core is closer to a triangle of
//! skin than `h`, skin is pressed and repels it along the line of least distance (`press.rs`), with friction by the law of its surface.
//! The core itself never meets skin: the path of each solver step, of body and skin together, is proved free (`path.rs`). Inside and
//! outside therefore need not be distinguished, and a thin fluke has two sides.
//!
//! Triangles near a body's path are gathered once a step of the model (`gather.rs`); those that may touch are evaluated in each iteration
//! (`measure.rs`). The forces act on the body's place and rotation in the linear system of rope and bodies (`kind.rs`).

pub(crate) mod gather;
mod kind;
pub(crate) mod measure;
pub(crate) mod path;
mod press;
pub mod sums;

use std::ops::Range;
use std::sync::Arc;

use endline_sdk::Region;
use glam::{DMat3, DVec3};

use crate::contact::law::friction_arrays::FrictionArrays;
use crate::contact::law::skin_direction::Grains;
use crate::geometry::Pose;
use crate::geometry::core::BodyCore;
use crate::geometry::sweep::SweptTriangle;
use crate::model::Model;
use crate::whale::{Candidate, Surface};

/// One place where a body presses on skin, at the end of a step.
#[derive(Clone, Debug, PartialEq)]
pub struct BodyContact {
    /// Index of the body.
    pub body: usize,
    /// Index of the skin triangle.
    pub triangle: usize,
    /// Region of the triangle.
    pub region: Region,
    /// Place on the skin [m].
    pub position: DVec3,
    /// Unit normal from skin to body.
    pub normal: DVec3,
    /// Depth of the body's surface in the skin at rest [m].
    pub depth_m: f64,
    /// Normal force [N].
    pub normal_force_n: f64,
    /// Friction force of skin on the body [N].
    pub friction_n: DVec3,
    /// Slip of the body over skin in the last solver step [m].
    pub slip_m: DVec3,
}

/// A part of a body and a triangle near it.
#[derive(Clone, Copy, Debug)]
struct Pair {
    triangle: u32,
    /// Corners at the start and the end of the model's step.
    sweep: SweptTriangle,
    /// No more than the distance of the core where the solver step begins [m].
    gap: f64,
    /// Whether it may touch in this solver step.
    active: bool,
    /// Normal force and friction on the body by the last solution [N].
    solved: DVec3,
}

/// A part of a body near skin, with its pairs.
#[derive(Clone, Debug)]
struct NearPart {
    /// Number of the part, and its body.
    part: usize,
    body: usize,
    pairs: Range<usize>,
    /// How far beyond its contact distance triangles were gathered [m].
    room: f64,
    /// Greatest move of any triangle near it over the model's step [m].
    skin_move: f64,
    /// How far part and skin have moved since triangles were gathered [m].
    moved: f64,
}

/// A part of a body pressed on a triangle, as measured last.
#[derive(Clone, Copy, Debug)]
struct Touch {
    part: usize,
    body: usize,
    pair: usize,
    /// Which place of the core: the nearest, or a corner.
    feature: u64,
    /// Number of the law of friction.
    law: usize,
    region: Region,
    barycentric: [f64; 3],
    /// Place on the skin [m].
    place: DVec3,
    normal: DVec3,
    depth: f64,
    share: f64,
    /// Push [N] and its growth with depth [N/m].
    push_n: f64,
    stiffness: f64,
}

/// Bodies against skin in one model. A step depends on nothing that is stored here between steps.
#[derive(Clone, Debug)]
pub(crate) struct BodyOnSkin {
    /// Cores of all parts of bodies.
    cores: Vec<BodyCore>,
    surface: Surface,
    grains: Arc<Grains>,
    candidates: Vec<Candidate>,
    near: Vec<NearPart>,
    pairs: Vec<Pair>,
    /// Shares of the model's step at which the solver step begins and ends, and up to which bodies and skin have been moved.
    start: f64,
    goal: f64,
    fraction: f64,
    /// Whether paths are checked ([`Settings::swept`](crate::model::Settings::swept)).
    swept: bool,
    /// Whether a body may touch skin in this solver step.
    pub touching: bool,
    /// Passes of the solver step in which shares were measured.
    shared: usize,
    touches: Vec<Touch>,
    /// Touches of the evaluation before.
    touched: Vec<Touch>,
    arrays: FrictionArrays,
    /// Where each body was when it was measured last.
    measured: Vec<Pose>,
    /// `-d force / d place` of each touch [N/m].
    blocks: Vec<DMat3>,
}

impl BodyOnSkin {
    /// Scratch for a model, where it has a whale and bodies that touch it.
    pub fn new(model: &Model) -> Option<Self> {
        let tree = model.skin_tree.clone()?;
        if !model.spec.settings.bodies_on_whale || model.spec.bodies.is_empty() {
            return None;
        }
        Some(Self {
            cores: BodyCore::of_bodies(&model.spec.bodies).collect(),
            grains: Arc::new(Grains::new(tree.skin())),
            surface: Surface::new(tree),
            candidates: Vec::new(),
            near: Vec::new(),
            pairs: Vec::new(),
            start: 0.0,
            goal: 1.0,
            fraction: 0.0,
            swept: model.spec.settings.swept,
            touching: false,
            shared: 0,
            touches: Vec::new(),
            touched: Vec::new(),
            arrays: FrictionArrays::default(),
            measured: Vec::new(),
            blocks: Vec::new(),
        })
    }

    /// Whether any triangle is near a body in this step of the model.
    pub fn is_near(&self) -> bool {
        !self.pairs.is_empty()
    }
}
