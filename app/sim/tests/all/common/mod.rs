//! Models shared by the tests of the solver: the common rope of the reference problems.
#![allow(dead_code, reason = "each test file uses a part of it")]
#![allow(clippy::expect_used, reason = "a test fails by panicking, in its helpers too")]

pub mod drum;

use endline_sim::model::{
    Body, BodyRole, Joint, JointKind, Line, Obstacle, PlacedShape, Rope, Settings, Shape, Strength,
};
use endline_sim::water::{Current, Water};
use endline_sim::{DQuat, DVec3, Model, ModelSpec};

/// The common rope: d = 10 mm, 0.06 kg/m, EA = 1e5 N, BA = 5 N s.
pub fn rope() -> Rope {
    Rope {
        id: "reference".into(),
        diameter_m: 0.010,
        mass_kg_m: 0.06,
        displaced_m3_m: std::f64::consts::PI * 0.010 * 0.010 / 4.0,
        axial_stiffness_n: 1e5,
        axial_damping_n_s: 5.0,
        drag_normal: 1.2,
        drag_tangential: 0.02,
        added_mass_normal: 1.0,
        ..Rope::default()
    }
}

/// A vacuum or a sea with a uniform current along x.
pub fn water(density_kg_m3: f64, current_m_s: f64) -> Water {
    let current = Current::uniform(DVec3::X * current_m_s);
    Water {
        density_kg_m3,
        gravity_m_s2: 9.81,
        depth_m: 30.0,
        rope_dries: false,
        current,
        waves: None,
    }
}

/// A body without extent.
pub fn weight(id: &str, mass_kg: f64, position_m: DVec3, held_until_s: Option<f64>) -> Body {
    Body {
        id: id.into(),
        item: String::new(),
        role: BodyRole::Weight,
        parts: vec![PlacedShape::about_origin(Shape::Sphere(0.1))],
        mass_kg,
        inertia_kg_m2: DVec3::splat(0.1 * mass_kg),
        added_mass_kg: DVec3::ZERO,
        added_inertia_kg_m2: DVec3::ZERO,
        drag_area_m2: DVec3::ZERO,
        turn_drag_m5: DVec3::ZERO,
        floats: Vec::new(),
        wetted_drag: false,
        feet_m: Vec::new(),
        foot_radius_m: Vec::new(),
        start_friction: 0.0,
        slide_friction: 0.0,
        foot_break_out_n: 0.0,
        position_m,
        orientation: DQuat::IDENTITY,
        spin_rad_s: DVec3::ZERO,
        held_until_s,
    }
}

pub fn fixed(id: &str, position_m: DVec3) -> Joint {
    Joint { id: id.into(), kind: JointKind::Fixed, position_m }
}

pub fn on_body(id: &str, body: usize) -> Joint {
    Joint {
        id: id.into(),
        kind: JointKind::Body { body, offset_m: DVec3::ZERO },
        position_m: DVec3::ZERO,
    }
}

/// A line of equal segments.
pub fn line(id: &str, length_m: f64, segments: usize) -> Line {
    Line {
        id: id.into(),
        rope: 0,
        from: 0,
        to: 1,
        segments_m: vec![length_m / segments as f64; segments],
        strength: Strength::default(),
        knots_m: [0.0; 2],
        start_m: Vec::new(),
    }
}

/// A model of one line between two joints.
pub fn model(
    water: Water,
    joints: Vec<Joint>,
    lines: Vec<Line>,
    bodies: Vec<Body>,
    settings: Settings,
) -> Model {
    model_with(water, joints, lines, bodies, settings, Vec::new())
}

/// The same with obstacles.
pub fn model_with(
    water: Water,
    joints: Vec<Joint>,
    lines: Vec<Line>,
    bodies: Vec<Body>,
    settings: Settings,
    obstacles: Vec<Obstacle>,
) -> Model {
    let spec = ModelSpec {
        water,
        seabed: None,
        ropes: vec![rope()],
        joints,
        lines,
        bodies,
        links: Vec::new(),
        gear: Vec::new(),
        whale: None,
        friction: None,
        obstacles,
        probes: Vec::new(),
        settings,
    };
    Model::new(spec).expect("a sound model")
}
