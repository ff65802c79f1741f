//! Traps, buoys, anchors, weights, obstacles and the whale.

use endline_sim::model::{Body, BodyRole, JointKind, PlacedShape, Shape};
use endline_sim::{DAffine3, Frame, Model};
use glam::{DVec3, Vec3};

use super::colour::{BUOY, BUOY_BAND, STEEL, TRAP, TRAP_WIRE};
use super::mesh::{Colour, Mesh};

/// Size of a trap's wire mesh as drawn [m].
const WIRE_M: f32 = 0.15;
/// Half edge of a fixture as drawn [m].
const FIXTURE_M: f32 = 0.15;
/// Half edge of a fixture as a share of the line's length, where that is less.
const FIXTURE_SHARE: f64 = 0.02;

/// Sides of a round part as drawn.
const SIDES: usize = 32;

/// Every body at its place in the frame.
pub fn bodies(model: &Model, frame: &Frame) -> Mesh {
    let mut mesh = Mesh::default();
    for (body, (place, turn)) in model.spec.bodies.iter().zip(&frame.bodies) {
        draw(&mut mesh, body, &DAffine3::from_rotation_translation(*turn, *place));
    }
    fixtures(&mut mesh, model, frame);
    mesh
}

/// A body by itself, about its middle.
pub fn one(body: &Body) -> Mesh {
    let mut mesh = Mesh::default();
    draw(&mut mesh, body, &DAffine3::IDENTITY);
    mesh
}

/// A small block at each end of a line that is fixed in the world.
fn fixtures(mesh: &mut Mesh, model: &Model, frame: &Frame) {
    let held = |joint: usize| {
        matches!(model.spec.joints[joint].kind, JointKind::Fixed | JointKind::Driven { .. })
    };
    for (line, nodes) in model.spec.lines.iter().zip(&model.line_nodes) {
        let whole_m: f64 = line.segments_m.iter().sum();
        let half = Vec3::splat(FIXTURE_M.min((FIXTURE_SHARE * whole_m) as f32));
        for (joint, node) in [(line.from, nodes.start), (line.to, nodes.end - 1)] {
            if let (true, Some(place)) = (held(joint), frame.nodes.get(node)) {
                mesh.block(&DAffine3::from_translation(*place), half, STEEL);
            }
        }
    }
}

/// Every part of a body. All but the first part of a buoy, its float, are of steel.
fn draw(mesh: &mut Mesh, body: &Body, pose: &DAffine3) {
    for (index, PlacedShape { shape, middle_m }) in body.parts.iter().enumerate() {
        let pose = &(*pose * DAffine3::from_translation(*middle_m));
        let is_fixed_to_float = body.role == BodyRole::Buoy && index > 0;
        let role = if is_fixed_to_float { BodyRole::Weight } else { body.role };
        draw_part(mesh, shape, role, pose);
    }
}

fn draw_part(mesh: &mut Mesh, shape: &Shape, role: BodyRole, pose: &DAffine3) {
    match shape {
        Shape::Box(half) if role == BodyRole::Trap => trap(mesh, pose, half.as_vec3()),
        Shape::Box(half) => mesh.block(pose, half.as_vec3(), colour(role)),
        Shape::Sphere(radius) => {
            mesh.capsule(pose, *radius as f32, *radius as f32, banded(role), SIDES / 2)
        }
        Shape::Capsule { radius_m, half_length_m } => {
            let half_length = *half_length_m as f32;
            mesh.capsule(pose, *radius_m as f32, half_length, banded(role), SIDES / 2);
        }
        Shape::Cylinder { radius_m, half_length_m } => {
            mesh.cylinder(pose, [*radius_m, *half_length_m], banded(role), SIDES);
        }
        Shape::Spheroid { across_m, along_m } => {
            mesh.spheroid(pose, [*across_m, *along_m], banded(role), SIDES / 2);
        }
    }
}

/// A wire cage with the solid runners it stands on.
fn trap(mesh: &mut Mesh, pose: &DAffine3, half: Vec3) {
    mesh.cage(pose, half, WIRE_M, [TRAP, TRAP_WIRE]);
    for side in [-1.0, 1.0] {
        let runner = DVec3::new(0.0, f64::from(side * half.y * 0.85), -f64::from(half.z) + 0.02);
        let at = *pose * DAffine3::from_translation(runner);
        mesh.block(&at, Vec3::new(half.x, 0.03, 0.02), TRAP_WIRE);
    }
}

fn colour(role: BodyRole) -> Colour {
    match role {
        BodyRole::Trap => TRAP,
        BodyRole::Buoy => BUOY,
        BodyRole::Anchor | BodyRole::Weight => STEEL,
    }
}

/// A buoy carries a pale band round its middle; other round bodies have one colour.
fn banded(role: BodyRole) -> impl Fn(f32) -> Colour {
    move |height| {
        if role == BodyRole::Buoy && height.abs() < 0.2 { BUOY_BAND } else { colour(role) }
    }
}
