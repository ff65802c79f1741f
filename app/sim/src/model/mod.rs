//! The immutable half of a simulation: gear, sea, seabed, obstacles and whale.
//!
//! Data only: `assembly.rs` checks a [`ModelSpec`] and makes a [`Model`] from it.

pub mod body;
pub mod gears;
pub mod rope;
pub mod settings;
pub mod whale;

use std::ops::Range;
use std::sync::Arc;

use endline_sdk::{AttributeValue, GearType, LineEnd};
use glam::{DQuat, DVec3};

use crate::geometry::shape::SolidShape;
use crate::water::{Sea, Water};
use crate::whale::tree::SkinTree;

pub use crate::float::{Float, Form, Passing, WaterPlane, Wet};
pub use body::{Body, BodyRole, PlacedShape, Shape};
pub use gears::Gears;
pub use rope::{
    Hitch, Joint, JointKind, Line, Link, ROPE_ON_ROPE_FRICTION, Rope, RopeOnRope, Strength,
    WeakPlace,
};
pub use settings::{
    CONTACT_TOLERANCE, EnergyForm, Probe, ProbeTarget, Resolution, Settings, WhaleFigure,
};
pub use whale::{
    BODY_ON_SKIN_FRICTION, Friction, FrictionLaw, PilotEntry, PilotProgram, Sight, Target, Trigger,
    Whale,
};

/// Input of a model; [`Model::new`] checks it.
#[derive(Clone)]
pub struct ModelSpec {
    /// The sea.
    pub water: Water,
    /// The seabed, if any.
    pub seabed: Option<Seabed>,
    /// Rope materials.
    pub ropes: Vec<Rope>,
    /// Joints.
    pub joints: Vec<Joint>,
    /// Lines.
    pub lines: Vec<Line>,
    /// Bodies.
    pub bodies: Vec<Body>,
    /// Weak links.
    pub links: Vec<Link>,
    /// Gear types that act during the run.
    pub gear: Vec<GearHook>,
    /// The whale, if any.
    pub whale: Option<Whale>,
    /// Friction on the whale; required where there is a whale.
    pub friction: Option<Friction>,
    /// Solids at rest.
    pub obstacles: Vec<Obstacle>,
    /// Probes.
    pub probes: Vec<Probe>,
    /// Steps and tolerances.
    pub settings: Settings,
}

/// A checked, immutable model with the indices that the solver uses.
///
/// Layout: every line owns `segments + 1` consecutive nodes, both ends included. Segment `k` of a line lies between its nodes
/// `k` and `k + 1`. Lines that meet at a joint each have a node there, all at the same position.
#[derive(Clone)]
pub struct Model {
    /// The checked spec.
    pub spec: ModelSpec,
    /// Nodes of each line.
    pub line_nodes: Vec<Range<usize>>,
    /// Segments of each line.
    pub line_segments: Vec<Range<usize>>,
    /// Number of nodes.
    pub node_count: usize,
    /// Number of segments.
    pub segment_count: usize,
    /// Line of each segment.
    pub segment_line: Vec<usize>,
    /// Tension at which the rope of each segment breaks, without weak places, which segments may pass as they move along the line
    /// ([`weakest`](Self::weakest)) [N].
    pub rope_strength_n: Vec<f64>,
    /// Knots, splices and links on the rope, sorted by segment.
    pub knots: Vec<Knot>,
    /// Tree over the whale's skin.
    pub skin_tree: Option<Arc<SkinTree>>,
    /// Its separate gears.
    pub gears: Gears,
    /// Whether gear is held while it stands still.
    pub(crate) may_be_held: bool,
    /// Current and waves, prepared for evaluation.
    pub sea: Sea,
}

/// Where a segment is weakest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Weakest {
    /// Tension at which the segment breaks [N].
    pub strength_n: f64,
    /// Unstretched length from end A of the line to the weak place that breaks [m]; `None` if the rope itself breaks.
    pub at_m: Option<f64>,
}

/// A knot, splice, swivel or link: a ball on the first or the last segment of a line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Knot {
    /// Its segment; end segments keep their length.
    pub segment: usize,
    /// End of its line.
    pub end: LineEnd,
    /// Unstretched length from that end to its centre [m].
    pub from_end_m: f64,
    /// Radius [m].
    pub radius_m: f64,
}

impl Knot {
    /// Knots on a segment, from a list sorted by segment.
    pub(crate) fn on_segment(knots: &[Self], segment: usize) -> &[Self] {
        debug_assert!(knots.is_sorted_by_key(|knot| knot.segment), "knots are sorted by segment");
        let first = knots.partition_point(|knot| knot.segment < segment);
        let count = knots[first..].iter().take_while(|knot| knot.segment == segment).count();
        &knots[first..first + count]
    }

    /// Position of its centre on a segment of this unstretched length: 0 at the first node, 1 at the second.
    pub fn fraction(&self, length_m: f64) -> f64 {
        let share = (self.from_end_m / length_m).min(1.0);
        if self.end == LineEnd::A { share } else { 1.0 - share }
    }
}

/// An error in a [`ModelSpec`].
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ModelError {
    /// The part, such as `line endline-top`.
    pub part: String,
    /// The error and the expected value.
    pub message: String,
}

impl Model {
    /// Whether any rope resists bending.
    pub fn bends(&self) -> bool {
        self.spec.ropes.iter().any(|rope| rope.bending_stiffness_n_m2 > 0.0)
    }

    /// Whether forces of rope move the whale.
    pub fn whale_is_kinetic(&self) -> bool {
        self.spec.whale.as_ref().is_some_and(|whale| whale.kinetic.is_some())
    }

    /// Whether a line attached to the whale moves it.
    pub fn whale_is_towed(&self) -> bool {
        let is_on_whale = |joint: &Joint| matches!(joint.kind, JointKind::Whale(_));
        self.whale_is_kinetic() && self.spec.joints.iter().any(is_on_whale)
    }

    /// Where each segment of a line is weakest, from end A, with the current unstretched lengths of all segments of the model [m].
    ///
    /// A weak place at a node belongs to the segment that begins there; one at end B, to the last segment.
    pub fn weakest<'a>(
        &'a self,
        line: usize,
        segment_length_m: &'a [f64],
    ) -> impl Iterator<Item = Weakest> + 'a {
        debug_assert_eq!(segment_length_m.len(), self.segment_count, "one length per segment");
        let segments = self.line_segments[line].clone();
        let (last, mut left) = (segments.end - 1, self.spec.lines[line].weak_places.as_slice());
        let mut to_m = 0.0;
        segments.map(move |segment| {
            to_m += segment_length_m[segment];
            let count = if segment == last {
                left.len()
            } else {
                left.partition_point(|place| place.at_m < to_m)
            };
            let (own, others) = left.split_at(count);
            left = others;
            let rope = Weakest { strength_n: self.rope_strength_n[segment], at_m: None };
            own.iter().fold(rope, |weakest, &WeakPlace { at_m, strength_n }| {
                if strength_n < weakest.strength_n {
                    Weakest { strength_n, at_m: Some(at_m) }
                } else {
                    weakest
                }
            })
        })
    }

    /// Knots on a segment.
    pub fn knots_of_segment(&self, segment: usize) -> &[Knot] {
        Knot::on_segment(&self.knots, segment)
    }

    /// Rope of a segment.
    pub fn rope_of_segment(&self, segment: usize) -> &Rope {
        &self.spec.ropes[self.spec.lines[self.segment_line[segment]].rope]
    }
}

/// The seabed: a plane with stiffness and friction.
#[derive(Clone, Debug, PartialEq)]
pub struct Seabed {
    /// Depth at the origin: the plane contains `(0, 0, -depth)` [m].
    pub depth_m: f64,
    /// Upward unit normal.
    pub normal: DVec3,
    /// Stiffness under rope, per metre of rope [N/m²].
    pub rope_stiffness_n_m2: f64,
    /// Stiffness under one foot of a body [N/m].
    pub foot_stiffness_n_m: f64,
    /// Friction of rope.
    pub rope_friction: f64,
}

impl Seabed {
    /// Height of the seabed at a horizontal position [m].
    pub fn height_at(&self, place: DVec3) -> f64 {
        -self.depth_m - (self.normal.x * place.x + self.normal.y * place.y) / self.normal.z
    }
}

/// Contact stiffness of rope on a hard surface, per length of rope [N/m²]: the order of the transverse modulus of laid
/// polypropylene. A load of 1 kN over 0.1 m compresses the rope by 0.5 mm (estimate).
pub const ROPE_ON_HARD_N_M2: f64 = 2e7;

/// A solid at rest, declared by a scenario.
#[derive(Clone, Debug, PartialEq)]
pub struct Obstacle {
    /// Id, for reports.
    pub id: String,
    /// Its shape, in its own frame.
    pub shape: SolidShape,
    /// Position of its frame's origin [m].
    pub position_m: DVec3,
    /// Orientation, body to world.
    pub orientation: DQuat,
    /// Coulomb friction of rope and bodies on it.
    pub friction: f64,
    /// Contact stiffness under rope, per length of rope [N/m²].
    pub stiffness_n_m2: f64,
}

/// A gear type that acts during the run, with what it built and the attributes of its calls.
#[derive(Clone)]
pub struct GearHook {
    /// The plugin.
    pub gear: Arc<dyn GearType>,
    /// Its attribute values.
    pub attributes: Vec<AttributeValue>,
    /// Its lines in the order built: indices of the first and last of the model's lines that form each one. A line with
    /// inserts consists of several, end to end.
    pub lines: Vec<[usize; 2]>,
    /// Its links in the order built: indices of the model's links.
    pub links: Vec<usize>,
}
