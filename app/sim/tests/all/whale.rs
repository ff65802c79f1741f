//! A kinetic whale for tests: a spindle of skin with the mass, drag and strength of the literature.
#![allow(dead_code, reason = "each test file uses a part of it")]

use std::f64::consts::{PI, TAU};
use std::sync::Arc;

use endline_friction_models::Coulomb;
use endline_sdk::{
    Controls, Descriptor, FrictionModel, HookError, MotionInput, MotionOutput, Region, WhaleMotion,
};
use endline_sim::model::{Friction, ModelSpec, PilotProgram, Whale};
use endline_sim::whale::kinetic::hull::spheroid;
use endline_sim::whale::kinetic::{AxialDrag, Effort, Hull, Muscle};
use endline_sim::whale::{Bone, JointRanges, Kinetic, Measures, Skin};
use endline_sim::{DQuat, DVec3};

/// A motion that asks for the same speed and turn rates all along, and for nothing while no speed is wanted.
pub struct Steady {
    descriptor: Descriptor,
    pub speed_m_s: f64,
    pub turn_rate: [f64; 3],
}

impl Steady {
    pub fn shared(speed_m_s: f64, turn_rate: [f64; 3]) -> Arc<Self> {
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
        Arc::new(Self { descriptor, speed_m_s, turn_rate })
    }
}

impl WhaleMotion for Steady {
    fn descriptor(&self) -> &Descriptor {
        &self.descriptor
    }

    fn step(
        &self,
        _: &[f64],
        input: &MotionInput<'_>,
        _: &mut [f64],
    ) -> Result<MotionOutput, HookError> {
        let speed_m_s = if input.controls.speed > 0.0 { self.speed_m_s } else { 0.0 };
        Ok(MotionOutput { speed_m_s, turn_rate_rad_s: self.turn_rate, ..MotionOutput::default() })
    }
}

/// Controls of a whale that swims.
pub fn swims() -> Controls {
    Controls { speed: 1.0, ..Controls::default() }
}

/// Controls of a whale that bursts.
pub fn bursts() -> Controls {
    Controls { speed: 1.0, burst: 1.0, ..Controls::default() }
}

/// A kinetic whale of a length, mass and greatest diameter.
pub fn kinetic(length_m: f64, mass_kg: f64, diameter_m: f64) -> Kinetic {
    let (along, grown) = (0.5 * length_m, libm::pow(length_m, 1.56));
    let across = 3.0 * mass_kg / (1025.0 * 4.0 * PI * along);
    let turning = mass_kg * (along * along + across) / 5.0;
    let shares = spheroid(length_m / diameter_m);
    let strength = 99.0 * grown;
    Kinetic {
        mass_kg,
        centre_m: DVec3::ZERO,
        inertia_kg_m2: DVec3::new(0.4 * mass_kg * across, turning, turning),
        added_mass_kg: DVec3::new(shares.along, shares.across, shares.across) * mass_kg,
        added_inertia_kg_m2: DVec3::new(0.0, shares.turning, shares.turning) * turning,
        drag: AxialDrag {
            length_m,
            diameter_m,
            wetted_area_m2: 0.08 * libm::pow(mass_kg, 0.65),
            appendages: 1.3,
            oscillation: 1.5,
            open_mouth: 2.5,
            wide_rad: 0.26,
        },
        side_drag_m2: [0.118 * length_m * length_m, 0.144 * length_m * length_m],
        turn_drag_m5: DVec3::new(
            20.0,
            0.0021 * libm::pow(length_m, 5.0),
            0.0017 * libm::pow(length_m, 5.0),
        ),
        muscle: Muscle {
            sustained_n: strength,
            burst_n: 401.0 * grown,
            efficiency: 0.13,
            swept_area_m2: 0.078 * length_m * length_m,
            effort: Effort::Power,
        },
        steering_n_m: DVec3::new(0.05, 0.4, 0.4) * length_m * strength,
        steering_time_s: 1.0,
        buoyancy: 0.0,
        hull: Arc::new(Hull::default()),
        dead: None,
    }
}

/// A closed spindle along x.
pub fn spindle(length_m: f64, diameter_m: f64) -> Skin {
    const ROUND: u32 = 16;
    const ALONG: u32 = 20;
    let station = |k: u32| {
        let x = libm::cos(PI * f64::from(k) / f64::from(ALONG));
        (0.5 * length_m * x, 0.5 * diameter_m * libm::sqrt((1.0 - x * x).max(0.0)))
    };
    let rim = |k: u32, j: u32| {
        let ((x, r), angle) = (station(k), TAU * f64::from(j) / f64::from(ROUND));
        DVec3::new(x, r * libm::cos(angle), r * libm::sin(angle))
    };
    let mut vertices: Vec<DVec3> =
        (1..ALONG).flat_map(|k| (0..ROUND).map(move |j| rim(k, j))).collect();
    vertices.extend([DVec3::X * (0.5 * length_m), DVec3::X * (-0.5 * length_m)]);
    let at = |k: u32, j: u32| (k - 1) * ROUND + j % ROUND;
    let (snout, tail) = ((ALONG - 1) * ROUND, (ALONG - 1) * ROUND + 1);
    let mut triangles: Vec<[u32; 3]> = (0..ROUND)
        .flat_map(|j| {
            [[snout, at(1, j), at(1, j + 1)], [tail, at(ALONG - 1, j + 1), at(ALONG - 1, j)]]
        })
        .collect();
    for k in 1..ALONG - 1 {
        triangles.extend((0..ROUND).flat_map(|j| {
            [[at(k, j), at(k + 1, j), at(k, j + 1)], [at(k, j + 1), at(k + 1, j), at(k + 1, j + 1)]]
        }));
    }
    Skin {
        weights: vec![[(0, 1.0), (0, 0.0), (0, 0.0), (0, 0.0)]; vertices.len()],
        regions: vec![Region::Body; triangles.len()],
        bones: vec![Bone {
            name: "control".into(),
            parent: None,
            origin: DVec3::ZERO,
            turns: Vec::new(),
        }],
        vertices,
        triangles,
        ..Skin::default()
    }
}

/// A whale of this kind, 12 m down, heading east.
pub fn whale(kinetic: Kinetic, speed_m_s: f64, motion: Arc<Steady>) -> Whale {
    let AxialDrag { length_m, diameter_m, .. } = kinetic.drag;
    let skin = spindle(length_m, diameter_m);
    Whale {
        measures: Measures::of(&skin, 1025.0),
        skin: Arc::new(skin),
        length_m,
        burst_speed_m_s: 5.0,
        position_m: DVec3::Z * -12.0,
        orientation: DQuat::IDENTITY,
        speed_m_s,
        motion,
        motion_attributes: Vec::new(),
        pilot: PilotProgram::default(),
        contact_stiffness_n_m2: 4e5,
        jaws: None,
        joints: JointRanges::unbounded(),
        kinetic: Some(kinetic),
    }
}

/// A closed box of these half sides about the origin, as a whale's skin.
pub fn crate_of(half: DVec3) -> Skin {
    let corner = |k: u32| {
        half * DVec3::from_array([0, 1, 2].map(|bit| if k >> bit & 1 == 0 { -1.0 } else { 1.0 }))
    };
    let faces =
        [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let triangles: Vec<[u32; 3]> =
        faces.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]).collect();
    Skin {
        weights: vec![[(0, 1.0), (0, 0.0), (0, 0.0), (0, 0.0)]; 8],
        regions: vec![Region::Body; triangles.len()],
        bones: vec![Bone {
            name: "control".into(),
            parent: None,
            origin: DVec3::ZERO,
            turns: Vec::new(),
        }],
        vertices: (0..8).map(corner).collect(),
        triangles,
        ..Skin::default()
    }
}

/// A sea with a whale and no gear, of one rope.
pub fn spec(whale: Whale, density_kg_m3: f64) -> ModelSpec {
    let coulomb = Coulomb::new();
    let attributes = coulomb
        .descriptor()
        .attributes
        .iter()
        .filter_map(|attribute| attribute.default_value().number())
        .collect();
    ModelSpec {
        water: crate::common::water(density_kg_m3, 0.0),
        seabed: None,
        ropes: vec![crate::common::rope()],
        joints: Vec::new(),
        lines: Vec::new(),
        bodies: Vec::new(),
        links: Vec::new(),
        gear: Vec::new(),
        whale: Some(whale),
        friction: Some(Friction::of_one(
            Arc::new(coulomb),
            attributes,
            vec![[0.2; Region::ALL.len()]],
        )),
        obstacles: Vec::new(),
        probes: Vec::new(),
        settings: endline_sim::model::Settings::default(),
    }
}
