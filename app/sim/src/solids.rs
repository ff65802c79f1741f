//! Solids that rope touches and that are not the whale: obstacles of a scenario, and the bodies of the rig.
//!
//! A solid has a shape with a signed distance (`geometry/shape.rs`); a body is one solid for each of its parts. Contact of rope on
//! solids is in `contact/rope_on_solid`.

use glam::DVec3;

use crate::contact::rope_on_solid::RopeOnSolid;
use crate::geometry::Pose;
use crate::geometry::shape::SolidShape;

use crate::model::body::body_of_part;
use crate::model::{Body, Model, Obstacle, PlacedShape, ROPE_ON_HARD_N_M2, Shape};
use crate::state::{BodyState, State};

/// Friction of rope on a trap, buoy or anchor: wet synthetic rope on steel is 0.1 to 0.3 (Brown 1977, NUC TP-544, as
/// known second hand; estimate).
pub const ROPE_ON_BODY_FRICTION: f64 = 0.25;

/// Carrier of a solid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Carrier {
    /// It is fixed at this pose.
    World(Pose),
    /// It is a part of a body.
    Body {
        /// Index of the body.
        body: usize,
        /// Its origin in the body's frame [m].
        middle_m: DVec3,
    },
}

impl Carrier {
    /// Where the solid is, with bodies where a function says.
    pub fn pose(&self, of_body: impl FnOnce(usize) -> Pose) -> Pose {
        match *self {
            Self::World(pose) => pose,
            Self::Body { body, middle_m } => of_body(body).about(middle_m),
        }
    }

    /// The body that it is a part of.
    pub fn body(&self) -> Option<usize> {
        match self {
            Self::World(_) => None,
            Self::Body { body, .. } => Some(*body),
        }
    }
}

impl Obstacle {
    /// Its pose.
    pub(crate) fn pose(&self) -> Pose {
        Pose { place: self.position_m, orientation: self.orientation }
    }
}

impl Pose {
    /// Where a body is.
    pub fn of(body: &BodyState) -> Self {
        Self { place: body.position, orientation: body.orientation }
    }
}

/// An obstacle or a body as rope meets it.
#[derive(Clone, Debug)]
pub(crate) struct Solid {
    pub shape: SolidShape,
    pub carrier: Carrier,
    pub friction: f64,
    pub stiffness_n_m2: f64,
    /// Effective mass at its farthest point [kg]; infinite if it is fixed.
    pub mass_kg: f64,
    /// Radius of a ball round its origin that holds it [m]; infinite for a plane.
    pub radius_m: f64,
}

impl Solid {
    pub(crate) fn of_obstacle(obstacle: &Obstacle) -> Self {
        Self {
            shape: obstacle.shape.clone(),
            carrier: Carrier::World(obstacle.pose()),
            friction: obstacle.friction,
            stiffness_n_m2: obstacle.stiffness_n_m2,
            mass_kg: f64::INFINITY,
            radius_m: obstacle.shape.radius(),
        }
    }

    fn of_part(index: usize, body: &Body, part: &PlacedShape) -> Self {
        let shape = SolidShape::of(&part.shape);
        let radius_m = shape.radius();
        let (middle_m, inertia) = (part.middle_m, body.inertia_kg_m2);
        let (across_m, far_m) = (part.reach_across_m(), middle_m.length() + radius_m);
        // Two bounds on how much a push turns it: by the least moment of inertia, and about its axis and across it apart.
        let about_any = far_m * far_m / inertia.min_element();
        let apart = across_m * across_m / inertia.z + far_m * far_m / inertia.x.min(inertia.y);
        let turning = about_any.min(apart);
        Self {
            shape,
            carrier: Carrier::Body { body: index, middle_m },
            friction: ROPE_ON_BODY_FRICTION,
            stiffness_n_m2: ROPE_ON_HARD_N_M2,
            mass_kg: 1.0 / (1.0 / body.mass_kg + turning),
            radius_m,
        }
    }
}

impl SolidShape {
    fn of(shape: &Shape) -> Self {
        match *shape {
            Shape::Box(half) => Self::Box(half),
            Shape::Sphere(radius) => Self::Sphere(radius),
            Shape::Capsule { radius_m, half_length_m } => Self::Capsule { radius_m, half_length_m },
            Shape::Cylinder { radius_m, half_length_m } => {
                Self::Cylinder { radius_m, half_length_m }
            }
            Shape::Spheroid { across_m, along_m } => Self::Spheroid { across_m, along_m },
        }
    }
}

impl PlacedShape {
    /// How far it reaches from the body's z axis, at most [m].
    fn reach_across_m(&self) -> f64 {
        let half = self.shape.half_m();
        libm::hypot(half.x, half.y) + libm::hypot(self.middle_m.x, self.middle_m.y)
    }
}

/// All solids of a model: obstacles first, then the parts of bodies, body after body, where rope touches them.
pub(crate) fn of_model(model: &Model) -> Vec<Solid> {
    let obstacles = model.spec.obstacles.iter().map(Solid::of_obstacle);
    let bodies = if model.spec.settings.rope_on_bodies { &model.spec.bodies[..] } else { &[] };
    let parts = bodies.iter().enumerate().flat_map(|(index, body)| {
        body.parts.iter().map(move |part| Solid::of_part(index, body, part))
    });
    obstacles.chain(parts).collect()
}

/// Whether rope lies in a body that it could touch.
pub(crate) fn lies_in_body(model: &Model, state: &State) -> bool {
    model.spec.settings.rope_on_bodies && RopeOnSolid::new(model).any_in_body(state)
}

/// "obstacle" or "body" with the id of the obstacle or body to which a solid belongs.
pub(crate) fn name_of(model: &Model, solid: usize) -> String {
    let (obstacles, bodies) = (&model.spec.obstacles, &model.spec.bodies);
    match obstacles.get(solid) {
        Some(obstacle) => format!("obstacle {}", obstacle.id),
        None => {
            let body = body_of_part(bodies, solid - obstacles.len()).ok();
            format!("body {}", body.map_or("", |body| &bodies[body].id))
        }
    }
}
