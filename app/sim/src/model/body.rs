//! Rigid bodies: traps, buoys, anchors and other weights.

use glam::{DQuat, DVec3};

use crate::float::Float;
use crate::model::shape::PlacedShape;

/// What a body is, for pictures and reports.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BodyRole {
    /// Trap.
    Trap,
    /// Buoy.
    Buoy,
    /// Anchor.
    Anchor,
    /// Any other weight.
    Weight,
}

/// A rigid body with six degrees of freedom.
#[derive(Clone, Debug, PartialEq)]
pub struct Body {
    /// Id, such as `trap`.
    pub id: String,
    /// Name of the library's item that it is; empty where its figures stand in a scenario.
    pub item: String,
    /// What it is.
    pub role: BodyRole,
    /// What it consists of, for contact and for the picture; at least one part.
    pub parts: Vec<PlacedShape>,
    /// Mass in air [kg].
    pub mass_kg: f64,
    /// Principal moments of inertia in the body's frame [kg m²].
    pub inertia_kg_m2: DVec3,
    /// Added mass when wet, by body axis [kg].
    pub added_mass_kg: DVec3,
    /// Added moment of inertia when wet, by body axis [kg m²].
    pub added_inertia_kg_m2: DVec3,
    /// Drag coefficient times area of the body as a whole, by body axis at its origin [m²]; a body of several
    /// parts has that of its floats instead.
    pub drag_area_m2: DVec3,
    /// Turning drag: torque = ½ρ·this·ω|ω| when wet, by body axis [m⁵].
    pub turn_drag_m5: DVec3,
    /// Displaced volume, split so that it goes under and rights itself part by part.
    pub floats: Vec<Float>,
    /// Whether drag and added mass scale with the wet share (else always full).
    pub wetted_drag: bool,
    /// What touches the seabed: points, or middles of balls, in the body's frame [m].
    pub feet_m: Vec<DVec3>,
    /// Radius of the ball about each foot [m]; a foot without one is a point.
    pub foot_radius_m: Vec<f64>,
    /// Friction on the seabed before it starts to move.
    pub start_friction: f64,
    /// Friction on the seabed once it slides.
    pub slide_friction: f64,
    /// Force that holds each foot back when it is lifted off the seabed, at most [N].
    pub foot_break_out_n: f64,
    /// First guess of its place [m].
    pub position_m: DVec3,
    /// Start orientation, body to world.
    pub orientation: DQuat,
    /// Start angular velocity in the world frame, where a run begins as placed [rad/s].
    pub spin_rad_s: DVec3,
    /// Held in place until this time (through statics, if not below zero); `None` is free.
    pub held_until_s: Option<f64>,
}

impl Body {
    /// Corners of the boxes round its parts, in its frame [m].
    pub fn corners(&self) -> impl Iterator<Item = DVec3> {
        self.parts.iter().flat_map(|part| part.shape.corners().map(|corner| part.middle_m + corner))
    }

    /// Middle of its first part, in its frame [m].
    #[must_use]
    pub fn middle_m(&self) -> DVec3 {
        self.parts.first().map_or(DVec3::ZERO, |part| part.middle_m)
    }

    /// From the body's place to the lowest place of a foot above a plane of this normal, with the body turned like this [m].
    pub(crate) fn foot_arm(&self, foot: usize, orientation: DQuat, normal: DVec3) -> DVec3 {
        let radius = self.foot_radius_m.get(foot).copied().unwrap_or(0.0);
        orientation * self.feet_m[foot] - normal * radius
    }

    /// Drag coefficient times area when all of it is wet, by body axis [m²].
    #[must_use]
    pub fn whole_drag_area_m2(&self) -> DVec3 {
        self.floats.iter().fold(self.drag_area_m2, |sum, float| sum + float.drag_area_m2)
    }
}

/// Where in a list of things the part of a number stands, parts of bodies being numbered body after body: the index of its body, or how
/// far past the last part.
pub(crate) fn body_of_part(bodies: &[Body], mut part: usize) -> Result<usize, usize> {
    for (index, body) in bodies.iter().enumerate() {
        if part < body.parts.len() {
            return Ok(index);
        }
        part -= body.parts.len();
    }
    Err(part)
}
