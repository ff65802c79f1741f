//! The state of a simulation: everything that advances in time, and nothing else.

pub mod friction;
pub mod step_control;

use endline_sdk::Posture;
use glam::{DQuat, DVec3};

use crate::bits::clone_in_place;
use crate::model::{JointKind, Model};
use crate::whale::kinetic::Exertion;

pub use friction::{
    Bears, BodyGrip, BodyGrips, FrictionState, PairGrip, RopeGrip, RopeWithin, SolidGrip,
};
pub use step_control::{LimitedBy, StepControl};

/// Everything that the next step depends on, apart from the model and the input.
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
    /// Contacts of bodies with the whale's skin.
    pub body_grips: BodyGrips,
    /// Contacts of bodies with each other.
    pub pair_grips: Vec<PairGrip>,
    /// The whale, where the model has one.
    pub whale: Option<WhaleState>,
    /// Time at which each weak link parted [s].
    pub link_parted_s: Vec<Option<f64>>,
    /// Time at which each line parted (rope broken or cut) [s], and unstretched length from its end A to the break [m].
    pub line_parted: Vec<Option<(f64, f64)>>,
    /// Floats of each gear type.
    pub gear: Vec<Vec<f64>>,
    /// Length of the next solver step and what limits it.
    pub step_control: StepControl,
    /// Progress of the whale's pilot program.
    pub pilot: PilotMemory,
}

clone_in_place!(State {
    time_s,
    step,
    rope,
    bodies,
    body_grips,
    pair_grips,
    whale,
    link_parted_s,
    line_parted,
    gear,
    step_control,
    pilot
});

impl State {
    /// Unstretched length from end A of a segment's line to a fraction of the segment [m].
    pub fn arc(&self, model: &Model, segment: usize, fraction: f64) -> f64 {
        let first = model.line_segments[model.segment_line[segment]].start;
        self.rope.segment_length[first..segment].iter().sum::<f64>()
            + fraction * self.rope.segment_length[segment]
    }

    /// Position of a joint [m]; `None` for a joint without body or line.
    pub fn joint_place(&self, model: &Model, joint: usize) -> Option<DVec3> {
        let kind = &model.spec.joints.get(joint)?.kind;
        if let JointKind::Body { body, offset_m } = kind {
            let body = self.bodies.get(*body)?;
            return Some(body.position + body.orientation * *offset_m);
        }
        let node =
            model.spec.lines.iter().zip(&model.line_nodes).find_map(|(line, nodes)| match joint {
                _ if line.from == joint => Some(nodes.start),
                _ if line.to == joint => Some(nodes.end - 1),
                _ => None,
            });
        node.map(|node| self.rope.position[node])
    }

    /// Sets all velocities to zero and the history to that of gear at rest.
    pub(crate) fn rest(&mut self) {
        let rope = &mut self.rope;
        rope.velocity.fill(DVec3::ZERO);
        rope.earlier_velocity.fill(DVec3::ZERO);
        rope.earlier_position.clone_from(&rope.position);
        rope.earlier_dt_s = 0.0;
        self.bodies.iter_mut().for_each(BodyState::rest);
    }
}

impl BodyState {
    /// Sets all velocities to zero and the history to that of a body at rest.
    pub(crate) fn rest(&mut self) {
        self.velocity = DVec3::ZERO;
        self.earlier_velocity = DVec3::ZERO;
        self.earlier_position = self.position;
        self.spin = DVec3::ZERO;
        self.earlier_spin = DVec3::ZERO;
        self.earlier_orientation = self.orientation;
    }
}

/// Nodes and segments of all lines, in the model's layout.
#[derive(Debug, PartialEq, Default)]
pub struct RopeState {
    /// Position of each node [m].
    pub position: Vec<DVec3>,
    /// Velocity of each node [m/s].
    pub velocity: Vec<DVec3>,
    /// Unstretched length of each segment [m]; the sum over a line is constant.
    pub segment_length: Vec<f64>,
    /// Tension of each segment [N]; a negative value marks a slack segment, which exerts no force.
    pub tension: Vec<f64>,
    /// Whether each segment is cut (a parted link or rope); a cut segment exerts no force and has no contact.
    pub cut: Vec<bool>,
    /// Position of each node one solver step earlier [m].
    pub earlier_position: Vec<DVec3>,
    /// Velocity of each node one solver step earlier [m/s].
    pub earlier_velocity: Vec<DVec3>,
    /// Length of that earlier solver step [s]; zero where there is none.
    pub earlier_dt_s: f64,
    /// Tangential displacement of each node's elastic grip on the seabed [m].
    pub seabed_grip: Vec<DVec3>,
    /// Friction state where rope touches skin.
    pub friction: FrictionState,
    /// Contacts of rope with obstacles and bodies.
    pub solid_grips: Vec<SolidGrip>,
    /// Rope that has been inside a body since the start.
    pub within: Vec<RopeWithin>,
    /// Contacts of rope with rope.
    pub rope_grips: Vec<RopeGrip>,
}

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
    friction,
    solid_grips,
    within,
    rope_grips
});

/// A rigid body in motion.
#[derive(Debug, PartialEq)]
pub struct BodyState {
    /// Position of its origin (centre of mass) [m].
    pub position: DVec3,
    /// Orientation, body to world.
    pub orientation: DQuat,
    /// Velocity [m/s].
    pub velocity: DVec3,
    /// Angular velocity in the world frame [rad/s].
    pub spin: DVec3,
    /// Position one solver step earlier [m].
    pub earlier_position: DVec3,
    /// Velocity one solver step earlier [m/s].
    pub earlier_velocity: DVec3,
    /// Orientation one solver step earlier, body to world.
    pub earlier_orientation: DQuat,
    /// Angular velocity in the world frame one solver step earlier [rad/s].
    pub earlier_spin: DVec3,
    /// Tangential displacement of each foot's elastic grip on the seabed [m].
    pub grip: Vec<DVec3>,
    /// Whether each foot slides.
    pub sliding: Vec<bool>,
    /// Greatest lift of each foot since it last settled on the seabed, limited to the lift at which suction ends [m].
    pub lift_m: Vec<f64>,
}

clone_in_place!(BodyState {
    position,
    orientation,
    velocity,
    spin,
    earlier_position,
    earlier_velocity,
    earlier_orientation,
    earlier_spin,
    grip,
    sliding,
    lift_m
});

/// The whale in motion. A kinematic whale follows its motion plugin and pilot; a kinetic whale moves under forces.
#[derive(Debug, PartialEq)]
pub struct WhaleState {
    /// Position of the whale frame's origin, mid-body [m].
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
    /// Mean lateral position of those forces on the body at rest, positive to port of the midplane [m].
    pub contact_port_m: [f64; endline_sdk::BodyPart::ALL.len()],
    /// Opening moments of contact on jaw, left lip and right lip in the last step [N m].
    pub mouth_moment_n_m: [f64; 3],
    /// Effort of the whale and forces on it.
    pub exertion: Exertion,
}

clone_in_place!(WhaleState {
    position,
    orientation,
    speed_m_s,
    turn_rate,
    posture,
    motion,
    contact_force_n,
    contact_port_m,
    mouth_moment_n_m,
    exertion
});

/// Progress of a pilot program: observations of its triggers and entries begun.
#[derive(Debug, Default, PartialEq)]
pub struct PilotMemory {
    /// Observation of each entry's trigger.
    pub seen: Vec<Seen>,
    /// Entries begun, in the order in which they began.
    pub begun: Vec<Begun>,
}

clone_in_place!(PilotMemory { seen, begun });

/// Observation of an entry's trigger.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Seen {
    /// Time at which the condition was met [s].
    pub met_s: Option<f64>,
    /// Difference of depth or heading from the threshold at the last evaluation [m or rad].
    pub last: Option<f64>,
    /// Whether the target was seen by the starboard eye.
    pub is_starboard: bool,
    /// Whether rope touched the whale before it saw the target.
    pub is_touched: bool,
    /// Whether the entry has begun.
    pub begun: bool,
}

/// An entry that has begun.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Begun {
    /// Index of the entry.
    pub entry: usize,
    /// Time at which it began [s].
    pub at_s: f64,
    /// Whether it began because the starboard eye saw its target.
    pub is_starboard: bool,
}
