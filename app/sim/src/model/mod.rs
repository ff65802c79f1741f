//! The immutable half of a simulation: what the gear, the sea and the whale are.
//!
//! Data only: `assembly.rs` makes a [`Model`] from a [`ModelSpec`] that holds together.

pub mod body;
pub mod friction;
pub mod gear;
pub mod joint;
pub mod link;
pub mod obstacle;
pub mod pilot;
pub mod probe;
pub mod rope;
pub mod seabed;
pub mod settings;
pub mod shape;
pub mod whale;

use std::ops::Range;
use std::sync::Arc;

use endline_sdk::LineEnd;

use crate::water::{Sea, Water};
use crate::whale::tree::SkinTree;

pub use crate::float::{Float, Form, Wet};
pub use body::{Body, BodyRole};
pub use friction::{BODY_ON_SKIN_FRICTION, Friction, FrictionLaw};
pub use gear::GearHook;
pub use joint::{Hitch, Joint, JointKind};
pub use link::Link;
pub use obstacle::{Obstacle, ROPE_ON_HARD_N_M2};
pub use pilot::{PilotEntry, PilotProgram, Target, Trigger};
pub use probe::{EnergyForm, Probe, ProbeTarget, WhaleFigure};
pub use rope::{Line, ROPE_ON_ROPE_FRICTION, Rope, RopeOnRope, Strength};
pub use seabed::Seabed;
pub use settings::{CONTACT_TOLERANCE, Resolution, Settings};
pub use shape::{PlacedShape, Shape};
pub use whale::Whale;

/// All that a model is made from; [`Model::new`] checks it.
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
    /// Gear types at work.
    pub gear: Vec<GearHook>,
    /// The whale, if any.
    pub whale: Option<Whale>,
    /// Friction of rope on whale; needed where there is a whale.
    pub friction: Option<Friction>,
    /// Solid things that stand still.
    pub obstacles: Vec<Obstacle>,
    /// Probes.
    pub probes: Vec<Probe>,
    /// Steps and tolerances.
    pub settings: Settings,
}

/// A checked, immutable model with the indices the solver walks by.
///
/// Node layout: every line owns `segments + 1` nodes in a row, both ends included; the nodes of
/// lines that meet at a joint are copies of the joint's place. Segment `k` of a line lies between
/// its nodes `k` and `k + 1`.
#[derive(Clone)]
pub struct Model {
    /// What it was made from.
    pub spec: ModelSpec,
    /// Nodes of each line.
    pub line_nodes: Vec<Range<usize>>,
    /// Segments of each line.
    pub line_segments: Vec<Range<usize>>,
    /// Nodes in all.
    pub node_count: usize,
    /// Segments in all.
    pub segment_count: usize,
    /// Line of each segment.
    pub segment_line: Vec<usize>,
    /// Tension at which each segment breaks [N].
    pub segment_strength_n: Vec<f64>,
    /// Knots, splices and links on the rope, in rising order of segment.
    pub knots: Vec<Knot>,
    /// Tree over the whale's skin.
    pub skin_tree: Option<Arc<SkinTree>>,
    /// Current and waves made ready.
    pub sea: Sea,
}

/// A knot, splice, swivel or link: a ball on the first or the last segment of a line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Knot {
    /// Its segment: those at the ends of a line stay as they are.
    pub segment: usize,
    /// At which end of its line.
    pub end: LineEnd,
    /// Unstretched rope from that end to its middle [m].
    pub from_end_m: f64,
    /// Radius [m].
    pub radius_m: f64,
}

impl Knot {
    /// Those on a segment, of knots in rising order of segment.
    pub(crate) fn on_segment(knots: &[Self], segment: usize) -> &[Self] {
        let first = knots.partition_point(|knot| knot.segment < segment);
        let count = knots[first..].iter().take_while(|knot| knot.segment == segment).count();
        &knots[first..first + count]
    }

    /// Where its middle lies on a segment of this unstretched length, 0 at its first node, 1 at its second.
    #[must_use]
    pub fn fraction(&self, length_m: f64) -> f64 {
        let share = (self.from_end_m / length_m).min(1.0);
        if self.end == LineEnd::A { share } else { 1.0 - share }
    }
}

/// What is wrong with a [`ModelSpec`].
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ModelError {
    /// Which part, such as `line endline-top`.
    pub part: String,
    /// What is wrong and what was expected.
    pub message: String,
}

impl Model {
    /// Whether any rope resists bending.
    #[must_use]
    pub fn bends(&self) -> bool {
        self.spec.ropes.iter().any(|rope| rope.bending_stiffness_n_m2 > 0.0)
    }

    /// Whether rope moves the whale.
    #[must_use]
    pub fn whale_is_kinetic(&self) -> bool {
        self.spec.whale.as_ref().is_some_and(|whale| whale.kinetic.is_some())
    }

    /// Whether a line that is made fast to the whale moves it.
    #[must_use]
    pub fn whale_is_towed(&self) -> bool {
        let is_on_whale = |joint: &Joint| matches!(joint.kind, JointKind::Whale(_));
        self.whale_is_kinetic() && self.spec.joints.iter().any(is_on_whale)
    }

    /// Knots on a segment.
    #[must_use]
    pub fn knots_of_segment(&self, segment: usize) -> &[Knot] {
        Knot::on_segment(&self.knots, segment)
    }

    /// Rope of a segment.
    #[must_use]
    pub fn rope_of_segment(&self, segment: usize) -> &Rope {
        &self.spec.ropes[self.spec.lines[self.segment_line[segment]].rope]
    }
}
