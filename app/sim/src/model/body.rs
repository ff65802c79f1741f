//! Rigid bodies: traps, buoys, anchors and other weights.
//!
//! Shapes of bodies and of their parts, for the picture and for contact.

use glam::{DQuat, DVec3};

use crate::float::{Float, Passing, WaterPlane, Wet};

/// Kind of a body, for pictures and reports.
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
    /// Name of its library item; empty where the scenario declares its properties.
    pub item: String,
    /// Kind.
    pub role: BodyRole,
    /// Shapes it consists of, for contact and pictures; at least one.
    pub parts: Vec<PlacedShape>,
    /// Mass in air [kg].
    pub mass_kg: f64,
    /// Principal moments of inertia in the body's frame [kg m²].
    pub inertia_kg_m2: DVec3,
    /// Added mass when wet, by body axis [kg].
    pub added_mass_kg: DVec3,
    /// Added moment of inertia when wet, by body axis [kg m²].
    pub added_inertia_kg_m2: DVec3,
    /// Drag coefficient times area of the whole body, by body axis at its origin [m²]; zero where its floats have drag of
    /// their own.
    pub drag_area_m2: DVec3,
    /// Rotational drag `D` when wet, by body axis: torque = `½ρ D ω|ω|` [m⁵].
    pub turn_drag_m5: DVec3,
    /// Displaced volume, in parts that submerge separately.
    pub floats: Vec<Float>,
    /// Whether drag and added mass scale with the submerged share; otherwise they have their full value.
    pub wetted_drag: bool,
    /// Contact points for the seabed, or centres of balls, in the body's frame [m].
    pub feet_m: Vec<DVec3>,
    /// Radius of the ball at each foot [m]; a missing entry is a point.
    pub foot_radius_m: Vec<f64>,
    /// Static friction coefficient on the seabed.
    pub start_friction: f64,
    /// Kinetic friction coefficient on the seabed.
    pub slide_friction: f64,
    /// Greatest suction on each foot while it is lifted off the seabed [N].
    pub foot_break_out_n: f64,
    /// Initial guess of its position [m].
    pub position_m: DVec3,
    /// Initial orientation, body to world.
    pub orientation: DQuat,
    /// Initial angular velocity in the world frame, used where a run starts without statics [rad/s].
    pub spin_rad_s: DVec3,
    /// Time until which it is held in place, statics included unless negative; `None` if free [s].
    pub held_until_s: Option<f64>,
}

impl Body {
    /// Whether passing water draws it down and raises waves at it while it pierces the surface. Traps and anchors let the water
    /// through, and drag that does not depend on the draught is that of an idealised body.
    fn pierces(&self) -> bool {
        self.wetted_drag && !matches!(self.role, BodyRole::Trap | BodyRole::Anchor)
    }

    /// What water adds that passes with this velocity [m/s], by the wet part of each float; `float.rs` has the law.
    pub fn passing(
        &self,
        velocity_m_s: DVec3,
        [density_kg_m3, gravity_m_s2]: [f64; 2],
        wet: impl Fn(&Float) -> Wet,
    ) -> Passing {
        if !self.pierces() {
            return Passing::default();
        }
        let mut plane = WaterPlane::default();
        for float in &self.floats {
            plane.add(float, &wet(float));
        }
        let speed_squared = velocity_m_s.truncate().length_squared();
        plane.in_flow(speed_squared, density_kg_m3, gravity_m_s2)
    }

    /// Corners of the bounding boxes of its parts, in its frame [m].
    pub fn corners(&self) -> impl Iterator<Item = DVec3> {
        self.parts.iter().flat_map(|part| part.shape.corners().map(|corner| part.middle_m + corner))
    }

    /// Centre of its first part, in its frame [m].
    pub fn middle_m(&self) -> DVec3 {
        self.parts.first().map_or(DVec3::ZERO, |part| part.middle_m)
    }

    /// Vector from the body's origin to the point of a foot nearest to a plane with this unit normal, at this orientation [m].
    pub(crate) fn foot_arm(&self, foot: usize, orientation: DQuat, normal: DVec3) -> DVec3 {
        let radius = self.foot_radius_m.get(foot).copied().unwrap_or(0.0);
        orientation * self.feet_m[foot] - normal * radius
    }

    /// Drag coefficient times area when fully submerged, by body axis [m²].
    pub fn whole_drag_area_m2(&self) -> DVec3 {
        self.floats.iter().fold(self.drag_area_m2, |sum, float| sum + float.drag_area_m2)
    }
}

/// Returns the index of the body that a part belongs to; parts are numbered body after body.
///
/// A number beyond the last part is that of another solid: `Err` holds its offset from the last part.
pub(crate) fn body_of_part(bodies: &[Body], mut part: usize) -> Result<usize, usize> {
    for (index, body) in bodies.iter().enumerate() {
        if part < body.parts.len() {
            return Ok(index);
        }
        part -= body.parts.len();
    }
    Err(part)
}

/// Shape of a part of a body.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// Box by half extents [m].
    Box(DVec3),
    /// Sphere by radius [m].
    Sphere(f64),
    /// Cylinder along z with rounded ends.
    Capsule {
        /// Radius [m].
        radius_m: f64,
        /// Half of the length, ends included [m].
        half_length_m: f64,
    },
    /// Cylinder along z with flat ends.
    Cylinder {
        /// Radius [m].
        radius_m: f64,
        /// Half of its length [m].
        half_length_m: f64,
    },
    /// Ellipsoid of revolution about z.
    Spheroid {
        /// Semi-axis across z [m].
        across_m: f64,
        /// Semi-axis along z [m].
        along_m: f64,
    },
}

/// A part of a body: a convex shape fixed to it.
#[derive(Clone, Debug, PartialEq)]
pub struct PlacedShape {
    /// Shape.
    pub shape: Shape,
    /// Centre of the shape in the body's frame [m].
    pub middle_m: DVec3,
}

impl Shape {
    /// Half extents of its bounding box [m].
    pub fn half_m(&self) -> DVec3 {
        match self {
            Self::Box(half) => *half,
            Self::Sphere(radius_m) => DVec3::splat(*radius_m),
            Self::Capsule { radius_m: across, half_length_m: along }
            | Self::Cylinder { radius_m: across, half_length_m: along }
            | Self::Spheroid { across_m: across, along_m: along } => {
                DVec3::new(*across, *across, *along)
            }
        }
    }

    /// Corners of its bounding box, in its frame [m].
    pub fn corners(&self) -> [DVec3; 8] {
        let half = self.half_m();
        let sign = |corner: usize, bit: usize| if corner >> bit & 1 == 0 { -1.0 } else { 1.0 };
        std::array::from_fn(|corner| {
            half * DVec3::new(sign(corner, 0), sign(corner, 1), sign(corner, 2))
        })
    }
}

impl PlacedShape {
    /// A part centred at the body's origin.
    pub fn about_origin(shape: Shape) -> Self {
        Self { shape, middle_m: DVec3::ZERO }
    }
}
