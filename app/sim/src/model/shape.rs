//! Shapes of bodies and of their parts, for the picture and for contact.

use glam::DVec3;

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
        /// Half of the whole length, ends included [m].
        half_length_m: f64,
    },
    /// Cylinder along z with flat ends.
    Cylinder {
        /// Radius [m].
        radius_m: f64,
        /// Half of its length [m].
        half_length_m: f64,
    },
    /// Ellipsoid that is round about z.
    Spheroid {
        /// Half axis across z [m].
        across_m: f64,
        /// Half axis along z [m].
        along_m: f64,
    },
}

/// A part of a body: a convex shape that is fixed to it.
#[derive(Clone, Debug, PartialEq)]
pub struct PlacedShape {
    /// Shape.
    pub shape: Shape,
    /// Middle of the shape in the body's frame [m].
    pub middle_m: DVec3,
}

impl Shape {
    /// Half extents of the box round it [m].
    #[must_use]
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

    /// Corners of the box round it, in its frame [m].
    #[must_use]
    pub fn corners(&self) -> [DVec3; 8] {
        let half = self.half_m();
        let sign = |corner: usize, bit: usize| if corner >> bit & 1 == 0 { -1.0 } else { 1.0 };
        std::array::from_fn(|corner| {
            half * DVec3::new(sign(corner, 0), sign(corner, 1), sign(corner, 2))
        })
    }
}

impl PlacedShape {
    /// A part with its middle at the body's origin.
    #[must_use]
    pub fn about_origin(shape: Shape) -> Self {
        Self { shape, middle_m: DVec3::ZERO }
    }
}
