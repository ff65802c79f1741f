//! The immutable half of a simulation: what the gear, the sea and the whale are.

use std::ops::Range;
use std::sync::Arc;

use endline_sdk::{AttributeValue, FrictionModel, GearType, LineEnd};
use glam::{DQuat, DVec3};

use crate::check::check;
pub use crate::contact::ropes::RopeOnRope;
pub use crate::float::{Float, Form, Wet};
use crate::solids::Obstacle;
use crate::water::{Sea, Water};
use crate::whale::{Hitch, SkinTree, Whale};

/// A rope material, per metre of unstretched length.
#[derive(Clone, Debug, PartialEq)]
pub struct Rope {
    /// Id in the gear library.
    pub id: String,
    /// Nominal diameter, for drag and contact [m].
    pub diameter_m: f64,
    /// Mass in air [kg/m].
    pub mass_kg_m: f64,
    /// Volume of fibre, for buoyancy [m³/m].
    pub displaced_m3_m: f64,
    /// Axial stiffness EA at zero strain [N].
    pub axial_stiffness_n: f64,
    /// Stiffening EA2: tension = EA·strain + EA2·strain² where stretched; zero for a linear law [N].
    pub axial_stiffening_n: f64,
    /// Internal damping BA: tension grows by BA·strain rate [N s].
    pub axial_damping_n_s: f64,
    /// Internal damping besides, as a ratio of a segment's critical damping `2 √(EA/l · mass·l)`.
    pub axial_damping_ratio: f64,
    /// Bending stiffness EI; zero for a rope that bends freely [N m²].
    pub bending_stiffness_n_m2: f64,
    /// Drag coefficient across, on `d·l`.
    pub drag_normal: f64,
    /// Drag coefficient along, on `π·d·l`.
    pub drag_tangential: f64,
    /// Added-mass coefficient across.
    pub added_mass_normal: f64,
    /// Added-mass coefficient along.
    pub added_mass_tangential: f64,
    /// Breaking strength of the rope itself; infinite for a rope that cannot break [N].
    pub strength_n: f64,
}

/// A point where line ends meet.
#[derive(Clone, Debug, PartialEq)]
pub struct Joint {
    /// Id, for reports.
    pub id: String,
    /// What holds it.
    pub kind: JointKind,
    /// First guess of its place, or its place where fixed or driven [m].
    pub position_m: DVec3,
}

/// What holds a joint.
#[derive(Clone, Debug, PartialEq)]
pub enum JointKind {
    /// Nothing: it moves with the lines (a splice).
    Free,
    /// A fixture.
    Fixed,
    /// A fixture that moves at a steady velocity between two times.
    Driven {
        /// Velocity [m/s].
        velocity_m_s: DVec3,
        /// From this time [s].
        from_s: f64,
        /// Until this time [s].
        until_s: f64,
    },
    /// A steady force: a rope's free end that is hauled or tailed.
    Pulled {
        /// Force [N].
        force_n: DVec3,
        /// From this time on; it is held until then, through statics too. Below zero it is never held [s].
        from_s: f64,
    },
    /// A body: the joint rides at `offset_m` in the body's frame.
    Body {
        /// Index of the body.
        body: usize,
        /// Place in the body's frame [m].
        offset_m: DVec3,
    },
    /// The whale's skin: the joint goes where the skin goes, and pulls on the whale.
    Whale(Hitch),
}

/// What a line keeps of its rope's breaking strength, as shares of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Strength {
    /// All along: wear and scatter.
    pub all: f64,
    /// At end A besides, in the first segment: a knot or splice.
    pub end_a: f64,
    /// At end B besides, in the last segment.
    pub end_b: f64,
}

impl Default for Strength {
    fn default() -> Self {
        Self { all: 1.0, end_a: 1.0, end_b: 1.0 }
    }
}

/// A length of one rope between two joints.
#[derive(Clone, Debug, PartialEq)]
pub struct Line {
    /// Id, such as `endline-top`.
    pub id: String,
    /// Index of its rope.
    pub rope: usize,
    /// Joint at end A.
    pub from: usize,
    /// Joint at end B.
    pub to: usize,
    /// Unstretched length of each segment from A to B at the start of a run; the state knows them as they are [m].
    pub segments_m: Vec<f64>,
    /// What it keeps of its rope's strength.
    pub strength: Strength,
    /// First guess of its nodes, both ends included; empty for a straight line [m].
    pub start_m: Vec<DVec3>,
}

/// Shape of a body, for the picture and for contact.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// Box by half extents [m].
    Box(DVec3),
    /// Sphere by radius [m].
    Sphere(f64),
    /// Cylinder along the body's z axis with rounded ends [m].
    Capsule {
        /// Radius [m].
        radius_m: f64,
        /// Half of the whole length, ends included [m].
        half_length_m: f64,
    },
}

impl Shape {
    /// Corners of the box round it, in the body's frame [m].
    #[must_use]
    pub fn corners(&self) -> [DVec3; 8] {
        let half = match self {
            Self::Box(half) => *half,
            Self::Sphere(radius_m) => DVec3::splat(*radius_m),
            Self::Capsule { radius_m, half_length_m } => {
                DVec3::new(*radius_m, *radius_m, *half_length_m)
            }
        };
        let sign = |corner: usize, bit: usize| if corner >> bit & 1 == 0 { -1.0 } else { 1.0 };
        std::array::from_fn(|corner| {
            half * DVec3::new(sign(corner, 0), sign(corner, 1), sign(corner, 2))
        })
    }
}

/// What a body is, for pictures and reports.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BodyRole {
    /// Trap.
    Trap,
    /// Buoy.
    Buoy,
    /// Anchor.
    Anchor,
    /// Any other weight.
    Weight,
}

/// A rigid body with six degrees of freedom.
#[derive(Clone, Debug, PartialEq)]
pub struct Body {
    /// Id, such as `trap`.
    pub id: String,
    /// What it is.
    pub role: BodyRole,
    /// Shape.
    pub shape: Shape,
    /// Middle of the shape in the body's frame [m].
    pub shape_offset_m: DVec3,
    /// Mass in air [kg].
    pub mass_kg: f64,
    /// Principal moments of inertia in the body's frame [kg m²].
    pub inertia_kg_m2: DVec3,
    /// Added mass when wet, by body axis [kg].
    pub added_mass_kg: DVec3,
    /// Added moment of inertia when wet, by body axis [kg m²].
    pub added_inertia_kg_m2: DVec3,
    /// Drag coefficient times area of the body as a whole, by body axis at its origin [m²]; a body of several
    /// parts has that of its floats instead.
    pub drag_area_m2: DVec3,
    /// Turning drag: torque = ½ρ·this·ω|ω| when wet, by body axis [m⁵].
    pub turn_drag_m5: DVec3,
    /// Displaced volume, split so that it goes under and rights itself part by part.
    pub floats: Vec<Float>,
    /// Whether drag and added mass scale with the wet share (else always full).
    pub wetted_drag: bool,
    /// Points that touch the seabed, in the body's frame [m].
    pub feet_m: Vec<DVec3>,
    /// Friction on the seabed before it starts to move.
    pub start_friction: f64,
    /// Friction on the seabed once it slides.
    pub slide_friction: f64,
    /// Force that holds each foot back when it is lifted off the seabed, at most [N].
    pub foot_break_out_n: f64,
    /// First guess of its place [m].
    pub position_m: DVec3,
    /// Start orientation, body to world.
    pub orientation: DQuat,
    /// Held in place until this time (through statics, if not below zero); `None` is free.
    pub held_until_s: Option<f64>,
}

impl Body {
    /// Drag coefficient times area when all of it is wet, by body axis [m²].
    #[must_use]
    pub fn whole_drag_area_m2(&self) -> DVec3 {
        self.floats.iter().fold(self.drag_area_m2, |sum, float| sum + float.drag_area_m2)
    }
}

/// The seabed: a plane with stiffness and friction.
#[derive(Clone, Debug, PartialEq)]
pub struct Seabed {
    /// A point of the plane is `(0, 0, -depth)` [m].
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
    /// Its height at a place east and north [m].
    #[must_use]
    pub fn height_at(&self, place: DVec3) -> f64 {
        -self.depth_m - (self.normal.x * place.x + self.normal.y * place.y) / self.normal.z
    }
}

/// A weak link at one end of a line.
#[derive(Clone, Debug, PartialEq)]
pub struct Link {
    /// Id.
    pub id: String,
    /// Index of its line.
    pub line: usize,
    /// At which end.
    pub end: LineEnd,
    /// Tension above which it parts [N].
    pub rating_n: f64,
    /// Whether it can part at all (weak links on).
    pub enabled: bool,
}

/// A quantity to follow through the run.
#[derive(Clone, Debug, PartialEq)]
pub struct Probe {
    /// Id.
    pub id: String,
    /// What it reads.
    pub target: ProbeTarget,
}

/// What a probe reads.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ProbeTarget {
    /// Tension at an end of a line [N].
    EndTension(usize, LineEnd),
    /// Tension of a line at an unstretched length from its end A [N].
    TensionAt(usize, f64),
    /// A coordinate of a line at an unstretched length from its end A: 0 x, 1 y, 2 z [m].
    LineAt(usize, f64, usize),
    /// Greatest height of a line above the seabed, with this unstretched length left out at each end [m].
    Height(usize, f64),
    /// Mechanical energy of all rope and bodies [J].
    Energy(EnergyForm),
    /// A coordinate of the middle of a line by unstretched length: 0 x, 1 y, 2 z [m].
    LineMiddle(usize, usize),
    /// A coordinate of a joint: 0 x, 1 y, 2 z [m].
    Joint(usize, usize),
    /// A coordinate of a body: 0 x, 1 y, 2 z [m].
    Body(usize, usize),
}

/// A form of mechanical energy.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EnergyForm {
    /// All three together.
    Total,
    /// Of motion and turning.
    Kinetic,
    /// Of height above z = 0; buoyancy is not counted.
    Height,
    /// Of stretch.
    Stretch,
}

/// A friction model with its attribute values.
#[derive(Clone)]
pub struct FrictionLaw {
    /// The model.
    pub model: Arc<dyn FrictionModel>,
    /// Its attributes, SI, in the declared order.
    pub attributes: Vec<f64>,
}

/// How ropes rub on the whale: the laws, which of them holds where, and the table of coefficients.
#[derive(Clone)]
pub struct Friction {
    /// The laws; at least one.
    pub laws: Vec<FrictionLaw>,
    /// Index among the laws by rope index and region number.
    pub law_of: Vec<[usize; endline_sdk::Region::ALL.len()]>,
    /// Coefficient by rope index and region number.
    pub coefficients: Vec<[f64; endline_sdk::Region::ALL.len()]>,
}

impl Friction {
    /// One law for every rope and region.
    #[must_use]
    pub fn of_one(
        model: Arc<dyn FrictionModel>,
        attributes: Vec<f64>,
        coefficients: Vec<[f64; endline_sdk::Region::ALL.len()]>,
    ) -> Self {
        let law_of = vec![[0; endline_sdk::Region::ALL.len()]; coefficients.len()];
        Self { laws: vec![FrictionLaw { model, attributes }], law_of, coefficients }
    }

    /// Floats of a contact: as many as the law with the most takes.
    #[must_use]
    pub fn state_len(&self) -> usize {
        self.laws.iter().map(|law| law.model.descriptor().state_len).max().unwrap_or(0)
    }
}

/// A gear type at work: what it built, and its attributes for the calls of the run.
#[derive(Clone)]
pub struct GearHook {
    /// The plugin.
    pub gear: Arc<dyn GearType>,
    /// Its attribute values.
    pub attributes: Vec<AttributeValue>,
    /// Its lines in the order built, each by the indices of its first and last piece among the model's lines: a
    /// line with inserts is several of them, end to end.
    pub lines: Vec<[usize; 2]>,
    /// Its links in the order built, as indices of the model's links.
    pub links: Vec<usize>,
}

/// Lengths that segments are given as the whale comes and goes; the number of segments of each line stays.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Resolution {
    /// Near skin [m].
    pub near_m: f64,
    /// Near the edges of flippers and flukes [m].
    pub edge_m: f64,
    /// Far from the whale [m].
    pub far_m: f64,
}

impl Default for Resolution {
    fn default() -> Self {
        Self { near_m: 0.05, edge_m: 0.0125, far_m: 1.0 }
    }
}

/// Steps and tolerances.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// Step between inputs [s]; the solver divides it where it must.
    pub step_s: f64,
    /// Whether the solver step is chosen from the error of each step; else it is the whole step wherever nothing forbids it.
    pub auto_step: bool,
    /// Longest step while rope is near the whale [s].
    pub contact_step_s: f64,
    /// Shortest step before a run gives up [s].
    pub least_step_s: f64,
    /// How segment lengths follow the whale; `None` where they stay as they are.
    pub resolution: Option<Resolution>,
    /// Length of the run [s].
    pub duration_s: f64,
    /// Seed of everything drawn at random.
    pub seed: u64,
    /// Whether the run starts as its parts are placed, without statics before it.
    pub as_placed: bool,
    /// Whether rope touches the bodies of the rig too, and not obstacles alone.
    pub rope_on_bodies: bool,
    /// How rope touches rope; `None` where ropes pass through each other.
    pub rope_on_rope: Option<RopeOnRope>,
    /// Whether every move near skin is cut short where its path would cross: always, but to show what tests at the end of
    /// each step alone let through.
    pub swept: bool,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            step_s: 0.01,
            auto_step: false,
            contact_step_s: 0.002,
            least_step_s: 1e-6,
            resolution: None,
            duration_s: 60.0,
            seed: 1,
            rope_on_bodies: false,
            rope_on_rope: None,
            as_placed: false,
            swept: true,
        }
    }
}

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
    /// Tree over the whale's skin.
    pub skin_tree: Option<Arc<SkinTree>>,
    /// Current and waves made ready.
    pub sea: Sea,
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
    /// Checks a spec and lays out nodes and segments.
    ///
    /// # Errors
    /// Everything wrong with it, all at once.
    pub fn new(spec: ModelSpec) -> Result<Self, Vec<ModelError>> {
        let errors = check(&spec);
        if !errors.is_empty() {
            return Err(errors);
        }
        let skin_tree =
            spec.whale.as_ref().map(|whale| Arc::new(SkinTree::new(whale.skin.clone())));
        let sea = Sea::new(&spec.water, spec.seabed.as_ref(), spec.settings.seed);
        Ok(Self::laid_out(spec, skin_tree, sea))
    }

    /// Lays out nodes and segments.
    fn laid_out(spec: ModelSpec, skin_tree: Option<Arc<SkinTree>>, sea: Sea) -> Self {
        let (mut line_nodes, mut line_segments) = (Vec::new(), Vec::new());
        let (mut node_count, mut segment_count) = (0, 0);
        for line in &spec.lines {
            let segments = line.segments_m.len();
            line_nodes.push(node_count..node_count + segments + 1);
            line_segments.push(segment_count..segment_count + segments);
            node_count += segments + 1;
            segment_count += segments;
        }
        let segment_line = spec
            .lines
            .iter()
            .enumerate()
            .flat_map(|(index, line)| std::iter::repeat_n(index, line.segments_m.len()))
            .collect();
        let segment_strength_n = spec
            .lines
            .iter()
            .flat_map(|line| strengths(line, spec.ropes[line.rope].strength_n))
            .collect();
        Self {
            spec,
            line_nodes,
            line_segments,
            node_count,
            segment_count,
            segment_line,
            segment_strength_n,
            skin_tree,
            sea,
        }
    }

    /// The same gear in the same sea with its lines as these, alone: without whale, plugins, links and probes.
    pub(crate) fn with_lines(&self, lines: Vec<Line>) -> Self {
        let spec = &self.spec;
        let alone = ModelSpec {
            water: spec.water.clone(),
            seabed: spec.seabed.clone(),
            ropes: spec.ropes.clone(),
            joints: spec.joints.clone(),
            lines,
            bodies: spec.bodies.clone(),
            links: Vec::new(),
            gear: Vec::new(),
            whale: None,
            friction: None,
            obstacles: spec.obstacles.clone(),
            probes: Vec::new(),
            settings: Settings { resolution: None, ..spec.settings.clone() },
        };
        Self::laid_out(alone, None, self.sea.clone())
    }

    /// Whether any rope resists bending.
    #[must_use]
    pub fn bends(&self) -> bool {
        self.spec.ropes.iter().any(|rope| rope.bending_stiffness_n_m2 > 0.0)
    }

    /// Rope of a segment.
    #[must_use]
    pub fn rope_of_segment(&self, segment: usize) -> &Rope {
        &self.spec.ropes[self.spec.lines[self.segment_line[segment]].rope]
    }
}

/// Strength of each segment of a line: an end's factor weakens the segment at that end.
fn strengths(line: &Line, rope_n: f64) -> Vec<f64> {
    let Strength { all, end_a, end_b } = line.strength;
    let mut strengths = vec![rope_n * all; line.segments_m.len()];
    let last = strengths.len() - 1;
    strengths[0] *= end_a;
    strengths[last] = strengths[last].min(rope_n * all * end_b);
    strengths
}
