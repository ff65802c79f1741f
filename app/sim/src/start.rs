//! Initial state of a model before statics: initial guesses, at rest.

use glam::DVec3;

use crate::forces::suction::LOOSE_M;
use crate::model::{Body, JointKind, Model, Whale};
use crate::state::{
    BodyGrips, BodyState, FrictionState, PilotMemory, RopeState, State, StepControl, WhaleState,
};
use crate::whale::{Exertion, pilot};

impl State {
    /// The initial state of a model before statics: initial guesses, at rest.
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
            friction: FrictionState::default(),
            solid_grips: Vec::new(),
            within: Vec::new(),
            rope_grips: Vec::new(),
            position,
        };
        let mut state = Self {
            time_s: 0.0,
            step: 0,
            rope,
            bodies: model.spec.bodies.iter().map(body_at_start).collect(),
            whale: model.spec.whale.as_ref().map(whale_at_start),
            body_grips: BodyGrips::default(),
            pair_grips: Vec::new(),
            link_parted_s: vec![None; model.spec.links.len()],
            line_parted: vec![None; model.spec.lines.len()],
            gear: model
                .spec
                .gear
                .iter()
                .map(|hook| vec![0.0; hook.gear.descriptor().state_len])
                .collect(),
            step_control: StepControl::new(model.spec.lines.len(), model.gears.count),
            pilot: PilotMemory::default(),
        };
        debug_assert_eq!(state.rope.position.len(), model.node_count, "one position per node");
        debug_assert_eq!(
            state.rope.segment_length.len(),
            model.segment_count,
            "one length per segment"
        );
        pilot::begin(model, &mut state);
        state
    }
}

/// Initial position of every node: that of the line, or on a straight line between its joints.
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

fn body_at_start(body: &Body) -> BodyState {
    BodyState {
        position: body.position_m,
        orientation: body.orientation,
        velocity: DVec3::ZERO,
        spin: body.spin_rad_s,
        earlier_position: body.position_m,
        earlier_velocity: DVec3::ZERO,
        earlier_orientation: body.orientation,
        earlier_spin: body.spin_rad_s,
        grip: vec![DVec3::ZERO; body.feet_m.len()],
        sliding: vec![false; body.feet_m.len()],
        lift_m: vec![LOOSE_M; body.feet_m.len()],
    }
}

fn whale_at_start(whale: &Whale) -> WhaleState {
    let dead = whale.kinetic.as_ref().is_some_and(|kinetic| kinetic.dead.is_some());
    WhaleState {
        position: whale.position_m,
        orientation: whale.orientation,
        speed_m_s: whale.speed_m_s,
        turn_rate: DVec3::ZERO,
        posture: whale.start_posture(),
        motion: vec![0.0; whale.motion.descriptor().state_len],
        contact_force_n: [0.0; endline_sdk::BodyPart::ALL.len()],
        contact_port_m: [0.0; endline_sdk::BodyPart::ALL.len()],
        mouth_moment_n_m: [0.0; 3],
        exertion: Exertion {
            asked_speed_m_s: if dead { 0.0 } else { whale.speed_m_s },
            ..Exertion::default()
        },
    }
}
