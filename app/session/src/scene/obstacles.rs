//! Obstacles of a scenario: solid shapes that stand still.

use endline_sim::model::Obstacle;
use endline_sim::solids::SolidShape;
use endline_sim::{DAffine3, Model};
use glam::{DVec3, Vec3};

use super::colour::ROCK;
use super::mesh::Mesh;

/// Sides of a round obstacle as drawn.
const SIDES: usize = 48;
/// Half edge of the piece of a plane that is drawn [m].
const PLANE_M: f32 = 20.0;
/// Half thickness of it [m].
const PLANE_THICKNESS_M: f32 = 0.01;

/// Every obstacle of the model.
pub fn obstacles(model: &Model) -> Mesh {
    let mut mesh = Mesh::default();
    for obstacle in &model.spec.obstacles {
        draw(&mut mesh, obstacle);
    }
    mesh
}

fn draw(mesh: &mut Mesh, obstacle: &Obstacle) {
    let pose = DAffine3::from_rotation_translation(obstacle.orientation, obstacle.position_m);
    match &obstacle.shape {
        SolidShape::Plane => {
            let sunk = pose * DAffine3::from_translation(DVec3::Z * -f64::from(PLANE_THICKNESS_M));
            mesh.block(&sunk, Vec3::new(PLANE_M, PLANE_M, PLANE_THICKNESS_M), ROCK);
        }
        SolidShape::Sphere(radius) => {
            mesh.capsule(&pose, *radius as f32, *radius as f32, |_| ROCK, SIDES / 2)
        }
        SolidShape::Capsule { radius_m, half_length_m } => {
            mesh.capsule(&pose, *radius_m as f32, *half_length_m as f32, |_| ROCK, SIDES / 2);
        }
        SolidShape::Cylinder { radius_m, half_length_m } => {
            cylinder(mesh, &pose, *radius_m, *half_length_m)
        }
        SolidShape::Box(half) => mesh.block(&pose, half.as_vec3(), ROCK),
    }
}

/// A tube along z of the pose, closed by flat ends.
fn cylinder(mesh: &mut Mesh, pose: &DAffine3, radius_m: f64, half_length_m: f64) {
    let at = |place: DVec3| pose.transform_point3(place).as_vec3();
    let ends = [-half_length_m, half_length_m].map(|height| at(DVec3::Z * height));
    mesh.tube(&ends, radius_m as f32, &[ROCK; 2], SIDES);
    for (end, height) in [(-1.0, -half_length_m), (1.0, half_length_m)] {
        let normal = pose.transform_vector3(DVec3::Z * end).as_vec3();
        let middle = mesh.vertex(at(DVec3::Z * height), normal, 0.0, ROCK);
        let rim = |side: usize| {
            let angle = std::f64::consts::TAU * end * side as f64 / SIDES as f64;
            at(DVec3::new(radius_m * angle.cos(), radius_m * angle.sin(), height))
        };
        let first: Vec<u32> =
            (0..SIDES).map(|side| mesh.vertex(rim(side), normal, 0.0, ROCK)).collect();
        mesh.triangles
            .extend((0..SIDES).map(|side| [middle, first[side], first[(side + 1) % SIDES]]));
    }
}
