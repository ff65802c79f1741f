//! Solid things that rope meets and that are not the whale: obstacles of a scenario, and the bodies of the rig.
//!
//! A solid has a shape with a signed distance in closed form (`shape.rs`). Rope touches it at its nodes and, where an
//! edge or a shape smaller than a segment lies nearer, at up to two points within a segment (`along.rs`). Rope near
//! solids is gathered once a step by boxes (`broad.rs`); what touches lives in a list of contact points (`workspace.rs`). The forces
//! stand in `solver/solid.rs`. A picture asks where a ray meets a body (`ray.rs`).

pub(crate) mod along;
pub(crate) mod broad;
mod ray;
pub mod shape;
pub(crate) mod workspace;

use glam::{DQuat, DVec3};

use crate::model::{Body, Model, Obstacle, ROPE_ON_HARD_N_M2, Shape};
use crate::state::{BodyState, State};
pub use shape::SolidShape;
use workspace::SolidWorkspace;

/// Friction of rope on a trap, buoy or anchor: wet synthetic rope on steel is 0.1 to 0.3 (Brown 1977, NUC TP-544, as
/// known second hand; estimate).
pub const ROPE_ON_BODY_FRICTION: f64 = 0.25;

/// What carries a solid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Carrier {
    /// It stands still at this pose.
    World(Pose),
    /// It is the body of this index.
    Body(usize),
}

/// Place and orientation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Pose {
    pub place: DVec3,
    pub orientation: DQuat,
}

impl Obstacle {
    /// Where it stands.
    pub(crate) fn pose(&self) -> Pose {
        Pose { place: self.position_m, orientation: self.orientation }
    }
}

impl Pose {
    /// Where a body is.
    pub fn of(body: &BodyState) -> Self {
        Self { place: body.position, orientation: body.orientation }
    }

    /// A place of the world in this frame.
    pub fn inward(&self, place: DVec3) -> DVec3 {
        self.orientation.inverse() * (place - self.place)
    }

    /// A place of this frame in the world.
    pub fn outward(&self, place: DVec3) -> DVec3 {
        self.place + self.orientation * place
    }
}

/// An obstacle or a body as rope meets it.
#[derive(Clone, Debug)]
pub(crate) struct Solid {
    pub shape: SolidShape,
    pub carrier: Carrier,
    pub friction: f64,
    pub stiffness_n_m2: f64,
    /// Mass with which it answers a push at its farthest point [kg]; infinite where it stands still.
    pub mass_kg: f64,
    /// Radius of a ball round its origin that holds it [m]; infinite for a plane.
    pub radius_m: f64,
}

impl Solid {
    fn of_obstacle(obstacle: &Obstacle) -> Self {
        Self {
            shape: obstacle.shape.clone(),
            carrier: Carrier::World(obstacle.pose()),
            friction: obstacle.friction,
            stiffness_n_m2: obstacle.stiffness_n_m2,
            mass_kg: f64::INFINITY,
            radius_m: obstacle.shape.radius(),
        }
    }

    fn of_body(index: usize, body: &Body) -> Self {
        let shape = match body.shape {
            Shape::Box(half) => SolidShape::Box(half),
            Shape::Sphere(radius) => SolidShape::Sphere(radius),
            Shape::Capsule { radius_m, half_length_m } => {
                SolidShape::Capsule { radius_m, half_length_m }
            }
        };
        let radius_m = shape.radius();
        let turning = radius_m * radius_m / body.inertia_kg_m2.min_element();
        Self {
            shape,
            carrier: Carrier::Body(index),
            friction: ROPE_ON_BODY_FRICTION,
            stiffness_n_m2: ROPE_ON_HARD_N_M2,
            mass_kg: 1.0 / (1.0 / body.mass_kg + turning),
            radius_m,
        }
    }
}

/// All solids of a model: obstacles first, then bodies where rope touches them.
pub(crate) fn of_model(model: &Model) -> Vec<Solid> {
    let obstacles = model.spec.obstacles.iter().map(Solid::of_obstacle);
    let bodies = if model.spec.settings.rope_on_bodies { &model.spec.bodies[..] } else { &[] };
    let bodies = bodies.iter().enumerate().map(|(index, body)| Solid::of_body(index, body));
    obstacles.chain(bodies).collect()
}

/// Whether rope lies in a body that it could touch.
pub(crate) fn lies_in_body(model: &Model, state: &State) -> bool {
    model.spec.settings.rope_on_bodies && SolidWorkspace::new(model).any_in_body(state)
}

/// The id of a solid, with what it is.
pub(crate) fn name_of(model: &Model, solid: usize) -> String {
    let obstacles = model.spec.obstacles.len();
    match model.spec.obstacles.get(solid) {
        Some(obstacle) => format!("obstacle {}", obstacle.id),
        None => format!("body {}", model.spec.bodies[solid - obstacles].id),
    }
}
