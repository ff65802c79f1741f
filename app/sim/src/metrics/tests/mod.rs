//! Fixtures of the metrics' tests: scripted states and contacts on a small whale of known shape.

mod encounter;
mod gear;
mod winding;

use std::sync::Arc;

use endline_sdk::{
    AttributeValue, BodyPart, Contacts, Descriptor, FrictionModel, FrictionResponse, GearType,
    HookError, LineEnd, MotionInput, MotionOutput, Region, Rig, Site, WhaleMotion,
};
use glam::{DQuat, DVec3};

use super::Metrics;
use crate::contact::ContactPoint;
use crate::model::{
    Body, BodyRole, Float, Friction, Hitch, Joint, JointKind, Line, Link, Model, ModelSpec,
    PilotProgram, Probe, ProbeTarget, Rope, Seabed, Settings, Shape, Whale,
};
use crate::state::State;
use crate::water::{Current, Water};
use crate::whale::{Bone, JointRanges, Measures, Skin};

/// Half widths of the fixture's peduncle and flipper, and the flipper's root and tip.
const PEDUNCLE_R: f64 = 0.3;
const FLIPPER_ROOT: DVec3 = DVec3::new(2.0, 1.0, -0.3);
const FLIPPER_TIP: DVec3 = DVec3::new(1.4, 3.0, -0.6);
const STEP_S: f64 = 0.01;

/// A plugin of every kind that does nothing.
struct Idle(Descriptor);

impl Idle {
    fn shared() -> Arc<Self> {
        let (id, name, help) = ("test.idle".into(), "Idle".into(), "Does nothing.".into());
        Arc::new(Self(Descriptor {
            id,
            version: "0.1.0".into(),
            name,
            help,
            attributes: Vec::new(),
            state_len: 0,
            acts: Vec::new(),
        }))
    }
}

impl WhaleMotion for Idle {
    fn descriptor(&self) -> &Descriptor {
        &self.0
    }
    fn step(
        &self,
        _: &[f64],
        _: &MotionInput<'_>,
        _: &mut [f64],
    ) -> Result<MotionOutput, HookError> {
        Ok(MotionOutput::default())
    }
}

impl FrictionModel for Idle {
    fn descriptor(&self) -> &Descriptor {
        &self.0
    }
    fn respond(
        &self,
        _: &[f64],
        _: &Contacts<'_>,
        _: &mut [FrictionResponse],
    ) -> Result<(), HookError> {
        Ok(())
    }
    fn advance(&self, _: &[f64], _: &Contacts<'_>, _: &mut [f64]) -> Result<(), HookError> {
        Ok(())
    }
}

impl GearType for Idle {
    fn descriptor(&self) -> &Descriptor {
        &self.0
    }
    fn build(&self, _: &[AttributeValue], _: &Site) -> Result<Rig, HookError> {
        Ok(Rig::default())
    }
}

/// Rope of 0.1 kg/m and 5e-5 m³/m, 10 mm thick.
fn rope() -> Rope {
    Rope {
        id: "rope".into(),
        diameter_m: 0.01,
        mass_kg_m: 0.1,
        displaced_m3_m: 5e-5,
        axial_stiffness_n: 1e5,
        axial_damping_n_s: 10.0,
        drag_normal: 1.2,
        drag_tangential: 0.01,
        added_mass_normal: 1.0,
        ..Rope::default()
    }
}

fn joint(id: &str, kind: JointKind, position_m: DVec3) -> Joint {
    Joint { id: id.into(), kind, position_m }
}

fn line(id: &str, from: usize, to: usize, segments_m: Vec<f64>) -> Line {
    Line {
        id: id.into(),
        rope: 0,
        from,
        to,
        segments_m,
        strength: crate::model::Strength::default(),
        weak_places: Vec::new(),
        knots_m: [0.0; 2],
        start_m: Vec::new(),
    }
}

pub(crate) fn body(id: &str, role: BodyRole, position_m: DVec3) -> Body {
    Body {
        id: id.into(),
        item: String::new(),
        role,
        parts: vec![crate::model::PlacedShape::about_origin(Shape::Sphere(0.2))],
        mass_kg: 20.0,
        inertia_kg_m2: DVec3::ONE,
        added_mass_kg: DVec3::ONE,
        added_inertia_kg_m2: DVec3::ONE,
        drag_area_m2: DVec3::splat(0.1),
        turn_drag_m5: DVec3::splat(0.01),
        floats: vec![Float::level(DVec3::ZERO, 0.03, 0.4)],
        wetted_drag: true,
        feet_m: Vec::new(),
        foot_radius_m: Vec::new(),
        start_friction: 0.5,
        slide_friction: 0.4,
        foot_break_out_n: 0.0,
        position_m,
        orientation: DQuat::IDENTITY,
        spin_rad_s: DVec3::ZERO,
        held_until_s: None,
    }
}

/// A vertical line of `lengths` from a fixture to a free end, in water 50 m deep, with the fixture whale.
pub(crate) fn spec(lengths: Vec<f64>) -> ModelSpec {
    let whole: f64 = lengths.iter().sum();
    ModelSpec {
        water: Water {
            density_kg_m3: 1025.0,
            gravity_m_s2: 9.81,
            depth_m: 50.0,
            rope_dries: true,
            current: Current::uniform(DVec3::ZERO),
            waves: None,
        },
        seabed: Some(Seabed {
            depth_m: 50.0,
            normal: DVec3::Z,
            rope_stiffness_n_m2: 1e4,
            foot_stiffness_n_m: 1e5,
            rope_friction: 0.5,
        }),
        ropes: vec![rope()],
        joints: vec![
            joint("low", JointKind::Fixed, DVec3::new(0.0, 0.0, -40.0)),
            joint("high", JointKind::Free, DVec3::new(0.0, 0.0, -40.0 + whole)),
        ],
        lines: vec![line("endline", 0, 1, lengths)],
        bodies: Vec::new(),
        links: Vec::new(),
        gear: Vec::new(),
        whale: Some(whale()),
        friction: Some(Friction::of_one(
            Idle::shared(),
            Vec::new(),
            vec![[0.2; Region::ALL.len()]],
        )),
        obstacles: Vec::new(),
        probes: Vec::new(),
        settings: Settings { step_s: STEP_S, ..Settings::default() },
    }
}

pub(crate) fn model(spec: ModelSpec) -> Model {
    Model::new(spec).unwrap_or_else(|errors| panic!("{errors:?}"))
}

fn whale() -> Whale {
    Whale {
        skin: Arc::new(skin()),
        joints: JointRanges::unbounded(),
        length_m: 12.0,
        measures: Measures::default(),
        burst_speed_m_s: 4.0,
        position_m: DVec3::new(0.0, 0.0, -20.0),
        orientation: DQuat::IDENTITY,
        speed_m_s: 1.0,
        motion: Idle::shared(),
        motion_attributes: Vec::new(),
        pilot: PilotProgram::default(),
        contact_stiffness_n_m2: 2e6,
        jaws: None,
        kinetic: None,
    }
}

/// Height of the trunk's centre; it sags, so that its axis is not the x axis.
fn trunk_middle(x: f64) -> DVec3 {
    DVec3::new(x, 0.0, 0.01 * x * x)
}

/// Radius of the trunk: 1.2 m forward, 0.3 m at the peduncle.
fn trunk_radius(x: f64) -> f64 {
    PEDUNCLE_R + 0.9 * ((x + 3.0) / 2.0).clamp(0.0, 1.0)
}

/// A round trunk 12 m long and two flippers of elliptic section.
fn skin() -> Skin {
    let mut skin = Skin {
        bones: vec![Bone {
            name: "control".into(),
            parent: None,
            origin: DVec3::ZERO,
            turns: Vec::new(),
        }],
        ..Skin::default()
    };
    let rings = (0..=120).map(|i| -6.0 + 0.1 * f64::from(i));
    let trunk_region = |x: f64| match x {
        _ if x < -3.0 => Region::Peduncle,
        _ if x < 3.5 => Region::Body,
        _ => Region::Head,
    };
    tube(
        &mut skin,
        rings
            .map(|x| {
                (
                    trunk_middle(x),
                    DVec3::Y * trunk_radius(x),
                    DVec3::Z * trunk_radius(x),
                    trunk_region(x),
                )
            })
            .collect(),
    );
    for (side, region) in [(1.0, Region::LeftFlipper), (-1.0, Region::RightFlipper)] {
        let mirrored = |place: DVec3| DVec3::new(place.x, side * place.y, place.z);
        let station = |i: i32| FLIPPER_ROOT.lerp(FLIPPER_TIP, f64::from(i) / 20.0);
        tube(
            &mut skin,
            (0..=20)
                .map(|i| (mirrored(station(i)), DVec3::X * 0.4, DVec3::Z * 0.1 * side, region))
                .collect(),
        );
    }
    skin
}

/// Adds a closed tube: rings of 48 vertices about the centres, with semi-axes `u` and `v`.
fn tube(skin: &mut Skin, rings: Vec<(DVec3, DVec3, DVec3, Region)>) {
    const AROUND: u32 = 48;
    let base = skin.vertices.len() as u32;
    for (middle, u, v, _) in &rings {
        for j in 0..AROUND {
            let angle = std::f64::consts::TAU * f64::from(j) / f64::from(AROUND);
            skin.vertices.push(*middle + *u * libm::cos(angle) + *v * libm::sin(angle));
        }
    }
    for (i, (_, _, _, region)) in rings.iter().enumerate().skip(1) {
        let (low, high) = (base + (i as u32 - 1) * AROUND, base + i as u32 * AROUND);
        for j in 0..AROUND {
            let k = (j + 1) % AROUND;
            skin.triangles.extend([[low + j, high + j, high + k], [low + j, high + k, low + k]]);
            skin.regions.extend([*region; 2]);
        }
    }
    let last = base + (rings.len() as u32 - 1) * AROUND;
    for j in 1..AROUND - 1 {
        skin.triangles.extend([[base, base + j, base + j + 1], [last, last + j + 1, last + j]]);
        skin.regions.extend([rings[0].3, rings[rings.len() - 1].3]);
    }
    skin.weights.resize(skin.vertices.len(), [(0, 1.0), (0, 0.0), (0, 0.0), (0, 0.0)]);
}

/// Intersection of a ray with a part of the skin: triangle and barycentric coordinates.
fn ray(skin: &Skin, part: BodyPart, from: DVec3, toward: DVec3) -> (usize, [f64; 3]) {
    for (index, triangle) in
        skin.triangles.iter().enumerate().filter(|(index, _)| skin.regions[*index].part() == part)
    {
        let [a, b, c] = triangle.map(|vertex| skin.vertices[vertex as usize]);
        let across = toward.cross(c - a);
        let volume = (b - a).dot(across);
        let u = (from - a).dot(across) / volume;
        let v = toward.dot((from - a).cross(b - a)) / volume;
        let along = (c - a).dot((from - a).cross(b - a)) / volume;
        if u >= 0.0 && v >= 0.0 && u + v <= 1.0 && along > 0.0 {
            return (index, [1.0 - u - v, u, v]);
        }
    }
    panic!("the ray misses {}", part.name());
}

/// A contact of 10 N at the middle of segment `segment` of line 0, at a point of the skin.
fn contact(
    model: &Model,
    segment: usize,
    (triangle, barycentric): (usize, [f64; 3]),
) -> ContactPoint {
    let skin = &model.spec.whale.as_ref().unwrap().skin;
    ContactPoint {
        is_knot: false,
        line: 0,
        segment,
        fraction: 0.5,
        triangle,
        barycentric,
        region: skin.regions[triangle],
        position: DVec3::ZERO,
        normal: DVec3::Z,
        distance_m: 0.005,
        length_m: model.spec.lines[0].segments_m[segment],
        normal_force_n: 10.0,
        friction_n: DVec3::ZERO,
        slip_m: DVec3::ZERO,
        dt_s: STEP_S,
    }
}

/// Points on the peduncle along a helix of `turns` about the trunk's axis, one for each of `count` segments.
fn helix(skin: &Skin, turns: f64, count: usize) -> Vec<(usize, [f64; 3])> {
    let place = |k: usize| {
        let share = (k as f64 + 0.5) / count as f64;
        let (angle, x) = (0.3 + std::f64::consts::TAU * turns * share, -5.5 + 0.4 * share);
        ray(
            skin,
            BodyPart::Peduncle,
            trunk_middle(x),
            DVec3::new(0.0, libm::cos(angle), libm::sin(angle)),
        )
    };
    (0..count).map(place).collect()
}

/// Folds one step of [`STEP_S`] with these contacts.
fn advance(metrics: &mut Metrics, model: &Model, state: &mut State, contacts: &[ContactPoint]) {
    state.step += 1;
    state.time_s = state.step as f64 * STEP_S;
    metrics.fold(model, state, contacts);
}

/// A contact somewhere on the back.
fn touch(model: &Model) -> Vec<ContactPoint> {
    let skin = &model.spec.whale.as_ref().unwrap().skin;
    vec![contact(
        model,
        0,
        ray(skin, BodyPart::Body, trunk_middle(0.55), DVec3::new(0.0, 0.1, 1.0)),
    )]
}
