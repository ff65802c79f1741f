//! The rig of an encounter: a taut rope in still water, and a whale that is a moving piece of fin.

use std::sync::Arc;

use endline_friction_models::Coulomb;
use endline_sdk::{
    Descriptor, FrictionModel, HookError, MotionInput, MotionOutput, Region, WhaleMotion,
};
use endline_sim::model::{
    Friction, Joint, JointKind, Line, PilotProgram, Rope, Settings, Strength, Whale,
};
use endline_sim::water::{Current, Water};
use endline_sim::whale::{JointRanges, Measures, Skin};
use endline_sim::{DQuat, DVec3, ModelSpec};

const EA_N: f64 = 1e5;

/// A motion at one speed and turn rate.
struct Steady {
    descriptor: Descriptor,
    speed_m_s: f64,
    turn_rate: [f64; 3],
}

impl WhaleMotion for Steady {
    fn descriptor(&self) -> &Descriptor {
        &self.descriptor
    }

    fn step(
        &self,
        _: &[f64],
        _: &MotionInput<'_>,
        _: &mut [f64],
    ) -> Result<MotionOutput, HookError> {
        Ok(MotionOutput {
            speed_m_s: self.speed_m_s,
            turn_rate_rad_s: self.turn_rate,
            ..MotionOutput::default()
        })
    }
}

/// A moving piece of fin.
pub fn whale(skin: Skin, speed_m_s: f64, turn_rate: [f64; 3]) -> Whale {
    let (id, name, help) = ("test.steady".into(), "Steady".into(), "Always the same.".into());
    let descriptor = Descriptor {
        id,
        version: "1".into(),
        name,
        help,
        attributes: Vec::new(),
        state_len: 0,
        acts: Vec::new(),
    };
    Whale {
        skin: Arc::new(skin),
        joints: JointRanges::unbounded(),
        length_m: 1.0,
        measures: Measures::default(),
        burst_speed_m_s: speed_m_s,
        position_m: DVec3::ZERO,
        orientation: DQuat::IDENTITY,
        speed_m_s,
        motion: Arc::new(Steady { descriptor, speed_m_s, turn_rate }),
        motion_attributes: Vec::new(),
        pilot: PilotProgram::default(),
        contact_stiffness_n_m2: 4e5,
        jaws: None,
        kinetic: None,
    }
}

/// A taut rope, fixed at its start.
pub struct Taut {
    pub held: DVec3,
    pub along: DVec3,
    pub pull_n: f64,
    pub radius_m: f64,
    pub length_m: f64,
    pub segments: usize,
}

impl Taut {
    /// All of the encounter: the rope, held at one end and pulled at the other, and the whale.
    pub fn rig(&self, whale: Whale, friction: f64, settings: Settings) -> ModelSpec {
        let Self { held, along, pull_n, radius_m, length_m, segments } = *self;
        let stretched = length_m / segments as f64 * (1.0 + pull_n / EA_N);
        let nodes = (0..=segments).map(|node| held + along * (stretched * node as f64)).collect();
        sea(whale, &[Strand { nodes, pull_n }], radius_m, friction, settings)
    }
}

/// A rope along given nodes, fixed at its start and pulled straight at its end.
pub struct Strand {
    pub nodes: Vec<DVec3>,
    pub pull_n: f64,
}

/// Ropes in still water, and the whale.
pub fn sea(
    whale: Whale,
    strands: &[Strand],
    radius_m: f64,
    friction: f64,
    settings: Settings,
) -> ModelSpec {
    let (mut joints, mut lines) = (Vec::new(), Vec::new());
    for (number, strand) in strands.iter().enumerate() {
        joints.extend(ends(strand));
        lines.push(line(strand, number));
    }
    let coulomb = Coulomb::new();
    let attributes = coulomb
        .descriptor()
        .attributes
        .iter()
        .filter_map(|attribute| attribute.default_value().number())
        .collect();
    ModelSpec {
        water: Water {
            density_kg_m3: 1025.0,
            gravity_m_s2: 9.81,
            depth_m: 100.0,
            rope_dries: false,
            current: Current::uniform(DVec3::ZERO),
            waves: None,
        },
        seabed: None,
        ropes: vec![rope(2.0 * radius_m)],
        joints,
        lines,
        bodies: Vec::new(),
        links: Vec::new(),
        gear: Vec::new(),
        whale: Some(whale),
        friction: Some(Friction::of_one(
            Arc::new(coulomb),
            attributes,
            vec![[friction; Region::ALL.len()]],
        )),
        obstacles: Vec::new(),
        probes: Vec::new(),
        settings,
    }
}

/// The two ends of a rope: fixed, and pulled straight.
fn ends(strand: &Strand) -> [Joint; 2] {
    let joint = |id: &str, kind, position_m| Joint { id: id.into(), kind, position_m };
    let last = strand.nodes.len() - 1;
    let onward = (strand.nodes[last] - strand.nodes[last - 1]).normalize();
    let pulled = JointKind::Pulled { force_n: onward * strand.pull_n, from_s: -1.0 };
    [joint("held", JointKind::Fixed, strand.nodes[0]), joint("pulled", pulled, strand.nodes[last])]
}

fn line(Strand { nodes, pull_n }: &Strand, number: usize) -> Line {
    let unstretched = |ends: &[DVec3]| ends[0].distance(ends[1]) / (1.0 + pull_n / EA_N);
    Line {
        id: "rope".into(),
        rope: 0,
        from: 2 * number,
        to: 2 * number + 1,
        segments_m: nodes.windows(2).map(unstretched).collect(),
        strength: Strength::default(),
        knots_m: [0.0; 2],
        start_m: nodes.clone(),
    }
}

fn rope(diameter_m: f64) -> Rope {
    Rope {
        id: "rope".into(),
        diameter_m,
        mass_kg_m: 600.0 * diameter_m * diameter_m,
        displaced_m3_m: 0.6 * diameter_m * diameter_m,
        axial_stiffness_n: EA_N,
        axial_damping_n_s: 5.0,
        drag_normal: 1.2,
        drag_tangential: 0.015,
        added_mass_normal: 1.0,
        ..Rope::default()
    }
}
