//! A small rig and a whale of eight triangles, for tests.

use endline_fixtures::hooks::NoEffect;
use endline_fixtures::skin::rigid;
use endline_fixtures::whale::of_skin;
use endline_sdk::Region;
use endline_sim::contact::ContactPoint;
use endline_sim::contact::body_on_skin::BodyContact;
use endline_sim::model::{
    Body, BodyRole, Float, Friction, Joint, JointKind, Line, ModelSpec, PlacedShape, Rope, Seabed,
    Settings, Shape, Strength, Whale,
};
use endline_sim::water::{Current, Water};
use endline_sim::{DQuat, DVec3, Frame, Model, State};

/// Depth of the sample's water [m].
pub const DEPTH_M: f64 = 30.0;

/// A trap on the seabed, one endline in a gentle curve, a buoy at the surface, a whale beside it.
pub fn model() -> Model {
    let bodies = vec![body("trap", BodyRole::Trap), body("buoy", BodyRole::Buoy)];
    let joint = |id: &str, body| Joint {
        id: id.into(),
        kind: JointKind::Body { body, offset_m: DVec3::ZERO },
        position_m: DVec3::ZERO,
    };
    let segments = 60;
    let spec = ModelSpec {
        water: water(),
        seabed: Some(Seabed {
            depth_m: DEPTH_M,
            normal: DVec3::Z,
            rope_stiffness_n_m2: 1e4,
            foot_stiffness_n_m: 1e5,
            rope_friction: 0.3,
        }),
        ropes: vec![rope()],
        joints: vec![joint("trap-eye", 0), joint("buoy-eye", 1)],
        lines: vec![Line {
            id: "endline".into(),
            rope: 0,
            from: 0,
            to: 1,
            segments_m: vec![36.0 / f64::from(segments); segments as usize],
            strength: Strength::default(),
            weak_places: Vec::new(),
            knots_m: [0.0; 2],
            start_m: (0..=segments)
                .map(|node| place_on_rope(f64::from(node) / f64::from(segments)))
                .collect(),
        }],
        bodies,
        links: Vec::new(),
        gear: Vec::new(),
        whale: Some(whale()),
        friction: Some(friction()),
        obstacles: Vec::new(),
        probes: Vec::new(),
        settings: Settings::default(),
    };
    Model::new(spec).unwrap()
}

/// The sample at rest, with a tension that rises linearly from 0 at the trap to 600 N at the buoy, and one contact.
pub fn frame(model: &Model) -> Frame {
    let mut state = State::start(model);
    state.rope.tension = (0..60).map(|segment| 600.0 * f64::from(segment) / 59.0).collect();
    let touch = ContactPoint {
        is_knot: false,
        line: 0,
        segment: 30,
        fraction: 0.5,
        triangle: 0,
        barycentric: [1.0, 0.0, 0.0],
        region: Region::Head,
        position: place_on_rope(0.5),
        normal: DVec3::X,
        distance_m: 0.0,
        length_m: 0.6,
        normal_force_n: 80.0,
        friction_n: DVec3::ZERO,
        slip_m: DVec3::ZERO,
        dt_s: 0.01,
    };
    Frame::of(&state, &[touch], &[])
}

/// A frictionless contact of a body with a triangle of the whale's skin.
pub fn body_contact(
    body: usize,
    triangle: usize,
    position: DVec3,
    normal: DVec3,
    normal_force_n: f64,
) -> BodyContact {
    BodyContact {
        body,
        triangle,
        region: Region::Body,
        position,
        normal,
        depth_m: 0.01,
        normal_force_n,
        friction_n: DVec3::ZERO,
        slip_m: DVec3::ZERO,
    }
}

/// The curve of the endline, from trap (0) to buoy (1) [m].
fn place_on_rope(share: f64) -> DVec3 {
    DVec3::new(
        12.0 * share,
        3.0 * (share * std::f64::consts::PI).sin(),
        -DEPTH_M + 0.2 + (DEPTH_M - 0.2) * share,
    )
}

fn water() -> Water {
    let current = Current::power(DVec3::new(0.6, 0.0, 0.0), 1.0 / 7.0);
    Water {
        density_kg_m3: 1025.0,
        gravity_m_s2: 9.806_65,
        depth_m: DEPTH_M,
        rope_dries: true,
        current,
        waves: None,
    }
}

fn rope() -> Rope {
    Rope {
        id: "sample".into(),
        diameter_m: 0.0095,
        mass_kg_m: 0.045,
        displaced_m3_m: 5e-5,
        axial_stiffness_n: 6e4,
        drag_normal: 1.2,
        drag_tangential: 0.02,
        added_mass_normal: 1.0,
        strength_n: 7560.0,
        ..Rope::default()
    }
}

fn body(id: &str, role: BodyRole) -> Body {
    let trap = role == BodyRole::Trap;
    Body {
        id: id.into(),
        item: String::new(),
        role,
        parts: vec![PlacedShape::about_origin(if trap {
            Shape::Box(DVec3::new(0.6, 0.27, 0.2))
        } else {
            Shape::Capsule { radius_m: 0.18, half_length_m: 0.4 }
        })],
        mass_kg: 20.0,
        inertia_kg_m2: DVec3::ONE,
        added_mass_kg: DVec3::ZERO,
        added_inertia_kg_m2: DVec3::ZERO,
        drag_area_m2: DVec3::ONE,
        turn_drag_m5: DVec3::ZERO,
        floats: vec![Float::level(DVec3::ZERO, 0.01, 0.4)],
        wetted_drag: false,
        feet_m: Vec::new(),
        foot_radius_m: Vec::new(),
        start_friction: 0.5,
        slide_friction: 0.5,
        foot_break_out_n: 0.0,
        position_m: if trap { place_on_rope(0.0) } else { place_on_rope(1.0) },
        orientation: DQuat::IDENTITY,
        spin_rad_s: DVec3::ZERO,
        held_until_s: None,
    }
}

/// A whale whose skin is a long octahedron on one bone.
fn whale() -> Whale {
    let tip = |x: f64, y: f64, z: f64| DVec3::new(x, y, z);
    let vertices = vec![
        tip(6.5, 0.0, 0.0),
        tip(-6.5, 0.0, 0.0),
        tip(0.0, 1.3, 0.0),
        tip(0.0, -1.3, 0.0),
        tip(0.0, 0.0, 1.3),
        tip(0.0, 0.0, -1.3),
    ];
    let triangles = vec![
        [0, 2, 4],
        [0, 4, 3],
        [0, 3, 5],
        [0, 5, 2],
        [1, 4, 2],
        [1, 3, 4],
        [1, 5, 3],
        [1, 2, 5],
    ];
    let skin = rigid(vertices, triangles, |_| Region::Body);
    Whale {
        length_m: 13.0,
        burst_speed_m_s: 4.0,
        position_m: DVec3::new(-6.0, 2.0, -14.0),
        contact_stiffness_n_m2: 1e5,
        ..of_skin(skin, 1.0, NoEffect::shared())
    }
}

fn friction() -> Friction {
    Friction::of_one(NoEffect::shared(), Vec::new(), vec![[0.0; Region::ALL.len()]])
}
