//! The defined set of all that advances in time, and nothing else.

use endline_sdk::Posture;
use glam::{DQuat, DVec3};

use crate::contact::Grips;
use crate::contact::ropes::RopeGrip;
use crate::in_place::clone_in_place;
use crate::model::{Body, JointKind, Model};
use crate::pace::Pace;
use crate::solids::SolidGrip;
use crate::solver::LOOSE_M;
use crate::whale::pilot::{self, PilotMemory};
use crate::whale::{Exertion, Whale};

/// Everything the next step depends on, besides the model and the input.
#[derive(Debug, PartialEq)]
pub struct State {
    /// Simulated time [s].
    pub time_s: f64,
    /// Steps taken (calls of `step`).
    pub step: u64,
    /// Rope nodes and segments.
    pub rope: RopeState,
    /// Bodies, in the model's order.
    pub bodies: Vec<BodyState>,
    /// The whale, where the model has one.
    pub whale: Option<WhaleState>,
    /// When each weak link parted [s].
    pub link_parted_s: Vec<Option<f64>>,
    /// When each line parted (rope broken or cut) [s], and how far from its end A, by unstretched length [m].
    pub line_parted: Vec<Option<(f64, f64)>>,
    /// Floats of each gear type.
    pub gear: Vec<Vec<f64>>,
    /// How long the next solver step is to be, and why.
    pub pace: Pace,
    /// What the whale's pilot program has seen and begun; it chooses inputs and moves nothing by itself.
    pub pilot: PilotMemory,
}

/// Nodes and segments of all lines, in the model's layout.
#[derive(Debug, PartialEq, Default)]
pub struct RopeState {
    /// Place of each node [m].
    pub position: Vec<DVec3>,
    /// Velocity of each node [m/s].
    pub velocity: Vec<DVec3>,
    /// Unstretched length of each segment [m]; those of a line add up to the line.
    pub segment_length: Vec<f64>,
    /// Tension of each segment; below zero it is slack and pulls nothing [N].
    pub tension: Vec<f64>,
    /// Whether each segment is cut (a parted link or rope): it pulls and touches nothing.
    pub cut: Vec<bool>,
    /// Place of each node one solver step earlier [m].
    pub earlier_position: Vec<DVec3>,
    /// Velocity of each node one solver step earlier [m/s].
    pub earlier_velocity: Vec<DVec3>,
    /// Length of that earlier solver step [s]; zero where there is none.
    pub earlier_dt_s: f64,
    /// Where each node grips the seabed: tangential stretch of the grip [m].
    pub seabed_grip: Vec<DVec3>,
    /// Floats of the friction model where rope touches skin.
    pub grips: Grips,
    /// Where rope touches obstacles and bodies.
    pub solid_grips: Vec<SolidGrip>,
    /// Where rope touches rope.
    pub rope_grips: Vec<RopeGrip>,
}

/// A rigid body in motion.
#[derive(Debug, PartialEq)]
pub struct BodyState {
    /// Place of its origin (centre of mass) [m].
    pub position: DVec3,
    /// Orientation, body to world.
    pub orientation: DQuat,
    /// Velocity [m/s].
    pub velocity: DVec3,
    /// Angular velocity in the world frame [rad/s].
    pub spin: DVec3,
    /// Place one solver step earlier [m].
    pub earlier_position: DVec3,
    /// Velocity one solver step earlier [m/s].
    pub earlier_velocity: DVec3,
    /// Tangential stretch of each foot's grip on the seabed [m].
    pub grip: Vec<DVec3>,
    /// Whether each foot slides.
    pub sliding: Vec<bool>,
    /// Greatest lift of each foot off the seabed since it last set there, up to where it is loose [m].
    pub lift_m: Vec<f64>,
}

/// The whale in motion. A kinematic one goes where its motion plugin and pilot send it, a kinetic one as its forces do.
#[derive(Debug, PartialEq)]
pub struct WhaleState {
    /// Place of the whale frame's origin, mid-body [m].
    pub position: DVec3,
    /// Orientation, whale to world (x to the snout, y to port, z dorsal).
    pub orientation: DQuat,
    /// Speed through the water along its x axis [m/s].
    pub speed_m_s: f64,
    /// Turn rates about its own axes [rad/s].
    pub turn_rate: DVec3,
    /// Joint angles.
    pub posture: Posture,
    /// Floats of the motion plugin.
    pub motion: Vec<f64>,
    /// Sum of normal contact forces of the last step, by body part [N].
    pub contact_force_n: [f64; endline_sdk::BodyPart::ALL.len()],
    /// Where on each part those forces are: mean place to port of the midplane on the body at rest [m].
    pub contact_port_m: [f64; endline_sdk::BodyPart::ALL.len()],
    /// What it does and bears.
    pub exertion: Exertion,
}

clone_in_place!(State {
    time_s,
    step,
    rope,
    bodies,
    whale,
    link_parted_s,
    line_parted,
    gear,
    pace,
    pilot
});
clone_in_place!(RopeState {
    position,
    velocity,
    segment_length,
    tension,
    cut,
    earlier_position,
    earlier_velocity,
    earlier_dt_s,
    seabed_grip,
    grips,
    solid_grips,
    rope_grips
});
clone_in_place!(BodyState {
    position,
    orientation,
    velocity,
    spin,
    earlier_position,
    earlier_velocity,
    grip,
    sliding,
    lift_m
});
clone_in_place!(WhaleState {
    position,
    orientation,
    speed_m_s,
    turn_rate,
    posture,
    motion,
    contact_force_n,
    contact_port_m,
    exertion
});

impl State {
    /// The state a model starts from before statics: first guesses, at rest.
    #[must_use]
    pub fn start(model: &Model) -> Self {
        let position = start_nodes(model);
        let nodes = position.len();
        let rope = RopeState {
            velocity: vec![DVec3::ZERO; nodes],
            segment_length: model
                .spec
                .lines
                .iter()
                .flat_map(|line| line.segments_m.iter().copied())
                .collect(),
            tension: vec![0.0; model.segment_count],
            cut: vec![false; model.segment_count],
            earlier_position: position.clone(),
            earlier_velocity: vec![DVec3::ZERO; nodes],
            earlier_dt_s: 0.0,
            seabed_grip: vec![DVec3::ZERO; nodes],
            grips: Grips::default(),
            solid_grips: Vec::new(),
            rope_grips: Vec::new(),
            position,
        };
        let mut state = Self {
            time_s: 0.0,
            step: 0,
            rope,
            bodies: model.spec.bodies.iter().map(BodyState::start).collect(),
            whale: model.spec.whale.as_ref().map(WhaleState::start),
            link_parted_s: vec![None; model.spec.links.len()],
            line_parted: vec![None; model.spec.lines.len()],
            gear: model
                .spec
                .gear
                .iter()
                .map(|hook| vec![0.0; hook.gear.descriptor().state_len])
                .collect(),
            pace: Pace::new(model),
            pilot: PilotMemory::default(),
        };
        pilot::begin(model, &mut state);
        state
    }
}

/// First guess of every node: the line's own, or a straight line between its joints.
fn start_nodes(model: &Model) -> Vec<DVec3> {
    let joint_place = |joint: usize| match &model.spec.joints[joint].kind {
        JointKind::Body { body, offset_m } => {
            let body = &model.spec.bodies[*body];
            body.position_m + body.orientation * *offset_m
        }
        _ => model.spec.joints[joint].position_m,
    };
    let mut nodes = Vec::with_capacity(model.node_count);
    for line in &model.spec.lines {
        if line.start_m.len() == line.segments_m.len() + 1 {
            nodes.extend_from_slice(&line.start_m);
            continue;
        }
        let (from, to) = (joint_place(line.from), joint_place(line.to));
        let whole: f64 = line.segments_m.iter().sum();
        let mut along = 0.0;
        nodes.push(from);
        for segment in &line.segments_m {
            along += segment;
            nodes.push(from.lerp(to, along / whole));
        }
    }
    nodes
}

impl BodyState {
    fn start(body: &Body) -> Self {
        Self {
            position: body.position_m,
            orientation: body.orientation,
            velocity: DVec3::ZERO,
            spin: DVec3::ZERO,
            earlier_position: body.position_m,
            earlier_velocity: DVec3::ZERO,
            grip: vec![DVec3::ZERO; body.feet_m.len()],
            sliding: vec![false; body.feet_m.len()],
            lift_m: vec![LOOSE_M; body.feet_m.len()],
        }
    }
}

impl WhaleState {
    fn start(whale: &Whale) -> Self {
        let dead = whale.kinetic.as_ref().is_some_and(|kinetic| kinetic.dead.is_some());
        Self {
            position: whale.position_m,
            orientation: whale.orientation,
            speed_m_s: whale.speed_m_s,
            turn_rate: DVec3::ZERO,
            posture: whale.start_posture(),
            motion: vec![0.0; whale.motion.descriptor().state_len],
            contact_force_n: [0.0; endline_sdk::BodyPart::ALL.len()],
            contact_port_m: [0.0; endline_sdk::BodyPart::ALL.len()],
            exertion: Exertion {
                asked_speed_m_s: if dead { 0.0 } else { whale.speed_m_s },
                ..Exertion::default()
            },
        }
    }
}

impl State {
    /// Unstretched rope of a segment's line from its end A to a fraction of the segment [m].
    #[must_use]
    pub fn arc(&self, model: &Model, segment: usize, fraction: f64) -> f64 {
        let first = model.line_segments[model.segment_line[segment]].start;
        self.rope.segment_length[first..segment].iter().sum::<f64>()
            + fraction * self.rope.segment_length[segment]
    }

    /// Forgets all motion: the history of a rig at rest.
    pub(crate) fn rest(&mut self) {
        let rope = &mut self.rope;
        rope.velocity.fill(DVec3::ZERO);
        rope.earlier_velocity.fill(DVec3::ZERO);
        rope.earlier_position.clone_from(&rope.position);
        rope.earlier_dt_s = 0.0;
        for body in &mut self.bodies {
            body.velocity = DVec3::ZERO;
            body.earlier_velocity = DVec3::ZERO;
            body.earlier_position = body.position;
            body.spin = DVec3::ZERO;
        }
    }
}
