//! Obstacles of a scenario: solid shapes that stand still.

use endline_sim::geometry::shape::SolidShape;
use endline_sim::model::Obstacle;
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
            mesh.cylinder(&pose, [*radius_m, *half_length_m], |_| ROCK, SIDES);
        }
        SolidShape::Box(half) => mesh.block(&pose, half.as_vec3(), ROCK),
        SolidShape::Spheroid { across_m, along_m } => {
            mesh.spheroid(&pose, [*across_m, *along_m], |_| ROCK, SIDES / 2);
        }
    }
}
