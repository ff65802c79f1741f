//! The rig of an encounter: a taut rope in still water, and a whale that is a moving piece of fin.

use endline_fixtures::gear::coulomb;
use endline_fixtures::hooks::steady;
use endline_fixtures::whale::of_skin;
use endline_sim::model::{Joint, JointKind, Line, Rope, Settings, Strength, Whale};
use endline_sim::water::{Current, Water};
use endline_sim::whale::Skin;
use endline_sim::{DVec3, ModelSpec};

const EA_N: f64 = 1e5;

/// Returns a piece of fin that moves with constant speed and turn rates.
pub fn whale(skin: Skin, speed_m_s: f64, turn_rate: [f64; 3]) -> Whale {
    let motion = steady(speed_m_s, turn_rate);
    Whale { contact_stiffness_n_m2: 4e5, ..of_skin(skin, speed_m_s, motion) }
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
        friction: Some(coulomb(friction)),
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
        weak_places: Vec::new(),
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
