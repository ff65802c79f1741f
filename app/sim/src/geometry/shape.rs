//! Signed distance of a place from a solid shape, with the direction out of it.
//!
//! Below zero inside. All shapes are convex, so the distance along a straight line is a convex function.
//! Sphere `|p| - R`; capsule and cylinder about z; box by `q = |p| - half`: `|max(q, 0)| + min(max(q), 0)`; spheroid by the nearest
//! place of the ellipse in the half plane through its axis (`ellipse.rs`).
//! Reference: Quilez, Distance functions (iquilezles.org/articles/distfunctions).

use glam::DVec3;

use crate::geometry::ellipse::nearest_on_ellipse;

/// Shape of a solid, in its own frame.
#[derive(Clone, Debug, PartialEq)]
pub enum SolidShape {
    /// All that lies below z = 0.
    Plane,
    /// Sphere by radius [m].
    Sphere(f64),
    /// Cylinder along z with flat ends.
    Cylinder {
        /// Radius [m].
        radius_m: f64,
        /// Half of its length [m].
        half_length_m: f64,
    },
    /// Cylinder along z with rounded ends.
    Capsule {
        /// Radius [m].
        radius_m: f64,
        /// Half of its whole length, ends included [m].
        half_length_m: f64,
    },
    /// Box by half extents [m].
    Box(DVec3),
    /// Ellipsoid that is round about z.
    Spheroid {
        /// Half axis across z [m].
        across_m: f64,
        /// Half axis along z [m].
        along_m: f64,
    },
}

/// The nearest point of a surface, as distance and direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Nearest {
    /// Distance from the surface; below zero inside [m].
    pub distance: f64,
    /// Unit direction out of the solid.
    pub normal: DVec3,
}

impl SolidShape {
    /// Distance and direction at a place of its frame.
    pub(crate) fn nearest(&self, place: DVec3) -> Nearest {
        match self {
            Self::Plane => Nearest { distance: place.z, normal: DVec3::Z },
            Self::Sphere(radius) => from_centre(place, *radius),
            Self::Cylinder { radius_m, half_length_m } => {
                from_cylinder(place, *radius_m, *half_length_m)
            }
            Self::Capsule { radius_m, half_length_m } => {
                let straight = (half_length_m - radius_m).max(0.0);
                from_centre(place - DVec3::Z * place.z.clamp(-straight, straight), *radius_m)
            }
            Self::Box(half) => from_box(place, *half),
            Self::Spheroid { across_m, along_m } => from_spheroid(place, *across_m, *along_m),
        }
    }

    /// Distance alone.
    pub(crate) fn distance(&self, place: DVec3) -> f64 {
        self.nearest(place).distance
    }

    /// Radius of the surface nearest to a place, by which rope bends there [m]: infinite on a flat face, zero on an edge.
    ///
    /// On a flat face of a box or cylinder it is zero too: rope between two nodes comes nearest there only at the edge. A spheroid has two; the
    /// smaller counts.
    pub(crate) fn bend_radius(&self, place: DVec3) -> f64 {
        match self {
            Self::Plane => f64::INFINITY,
            Self::Sphere(radius) | Self::Capsule { radius_m: radius, .. } => *radius,
            Self::Cylinder { radius_m, half_length_m } => {
                if place.z.abs() < *half_length_m {
                    *radius_m
                } else {
                    0.0
                }
            }
            Self::Box(_) => 0.0,
            Self::Spheroid { across_m, along_m } => bend_of_spheroid(place, *across_m, *along_m),
        }
    }

    /// A lower bound of the bend radius at the places between two [m].
    pub(crate) fn least_bend_radius(&self, a: DVec3, b: DVec3) -> f64 {
        match self {
            Self::Plane | Self::Sphere(_) | Self::Capsule { .. } => self.bend_radius(a),
            Self::Cylinder { radius_m, half_length_m }
                if a.z.abs().max(b.z.abs()) < *half_length_m =>
            {
                *radius_m
            }
            _ => 0.0,
        }
    }

    /// Least thickness: rope that moves less in a step cannot have passed through [m].
    pub(crate) fn thickness(&self) -> f64 {
        match self {
            Self::Plane => f64::INFINITY,
            Self::Sphere(radius) | Self::Capsule { radius_m: radius, .. } => 2.0 * radius,
            Self::Cylinder { radius_m, half_length_m } => 2.0 * radius_m.min(*half_length_m),
            Self::Box(half) => 2.0 * half.min_element(),
            Self::Spheroid { across_m, along_m } => 2.0 * across_m.min(*along_m),
        }
    }

    /// Radius of a ball round its origin that holds it [m]; infinite for a plane.
    pub(crate) fn radius(&self) -> f64 {
        match self {
            Self::Plane => f64::INFINITY,
            Self::Sphere(radius) => *radius,
            Self::Cylinder { radius_m, half_length_m } => libm::hypot(*radius_m, *half_length_m),
            Self::Capsule { radius_m, half_length_m } => radius_m.max(*half_length_m),
            Self::Box(half) => half.length(),
            Self::Spheroid { across_m, along_m } => across_m.max(*along_m),
        }
    }

    /// The error in its measures, if there is one.
    pub(crate) fn fault(&self) -> Option<&'static str> {
        let above_zero =
            |values: &[f64]| values.iter().all(|value| value.is_finite() && *value > 0.0);
        let (sound, fault) = match self {
            Self::Plane => (true, ""),
            Self::Sphere(radius) => (above_zero(&[*radius]), "its radius is not above zero"),
            Self::Cylinder { radius_m, half_length_m }
            | Self::Capsule { radius_m, half_length_m } => {
                (above_zero(&[*radius_m, *half_length_m]), "its radius or length is not above zero")
            }
            Self::Box(half) => (above_zero(&half.to_array()), "its size is not above zero"),
            Self::Spheroid { across_m, along_m } => {
                (above_zero(&[*across_m, *along_m]), "a half axis is not above zero")
            }
        };
        (!sound).then_some(fault)
    }
}

fn from_centre(place: DVec3, radius: f64) -> Nearest {
    let length = place.length();
    let normal = if length > 1e-12 { place / length } else { DVec3::Z };
    Nearest { distance: length - radius, normal }
}

fn from_cylinder(place: DVec3, radius: f64, half_length: f64) -> Nearest {
    let across = DVec3::new(place.x, place.y, 0.0);
    let from_axis = across.length();
    let outward = if from_axis > 1e-12 { across / from_axis } else { DVec3::X };
    let endward = DVec3::Z * if place.z < 0.0 { -1.0 } else { 1.0 };
    let (beside, beyond) = (from_axis - radius, place.z.abs() - half_length);
    if beside > 0.0 && beyond > 0.0 {
        let distance = libm::hypot(beside, beyond);
        return Nearest { distance, normal: (outward * beside + endward * beyond) / distance };
    }
    if beside > beyond {
        Nearest { distance: beside, normal: outward }
    } else {
        Nearest { distance: beyond, normal: endward }
    }
}

fn from_box(place: DVec3, half: DVec3) -> Nearest {
    let beyond = place.abs() - half;
    let sign = DVec3::select(place.cmplt(DVec3::ZERO), DVec3::NEG_ONE, DVec3::ONE);
    let outside = beyond.max(DVec3::ZERO);
    let distance = outside.length();
    if distance > 0.0 {
        return Nearest { distance, normal: sign * outside / distance };
    }
    let axis = if beyond.x >= beyond.y && beyond.x >= beyond.z {
        DVec3::X
    } else if beyond.y >= beyond.z {
        DVec3::Y
    } else {
        DVec3::Z
    };
    Nearest { distance: beyond.max_element(), normal: sign * axis }
}

/// The nearest place of a spheroid: in the half plane through its axis, how far off the axis and how high; and the direction away from the axis.
fn foot_on_spheroid(place: DVec3, across: f64, along: f64) -> ([f64; 2], DVec3) {
    let flat = DVec3::new(place.x, place.y, 0.0);
    let from_axis = flat.length();
    let outward = if from_axis > 1e-12 { flat / from_axis } else { DVec3::X };
    (nearest_on_ellipse([across, along], [from_axis, place.z]), outward)
}

fn from_spheroid(place: DVec3, across: f64, along: f64) -> Nearest {
    let ([off, height], outward) = foot_on_spheroid(place, across, along);
    let gradient = outward * (off / (across * across)) + DVec3::Z * (height / (along * along));
    let normal = gradient.normalize();
    Nearest { distance: (place - outward * off - DVec3::Z * height).dot(normal), normal }
}

/// With `w² = r²/a⁴ + z²/c⁴` at the foot, half axes `a` across and `c` along: radii of curvature `a² c² w³` along the meridian and `a² w` across it.
fn bend_of_spheroid(place: DVec3, across: f64, along: f64) -> f64 {
    let ([off, height], _) = foot_on_spheroid(place, across, along);
    let w = libm::hypot(off / (across * across), height / (along * along));
    let round = across * across * w;
    round.min(round * along * along * w * w)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shapes() -> Vec<SolidShape> {
        vec![
            SolidShape::Plane,
            SolidShape::Sphere(0.4),
            SolidShape::Cylinder { radius_m: 0.3, half_length_m: 0.5 },
            SolidShape::Capsule { radius_m: 0.2, half_length_m: 0.6 },
            SolidShape::Box(DVec3::new(0.5, 0.3, 0.2)),
            SolidShape::Spheroid { across_m: 0.2, along_m: 0.5 },
            SolidShape::Spheroid { across_m: 0.6, along_m: 0.15 },
            SolidShape::Spheroid { across_m: 0.3, along_m: 0.3 },
        ]
    }

    /// Radii of curvature of a spheroid at its poles `a²/c` and on its equator, the smaller of `a` and `c²/a`.
    #[test]
    fn a_spheroid_bends_rope_by_its_curvature() {
        for (a, c) in [(0.2, 0.5), (0.6, 0.15)] {
            let shape = SolidShape::Spheroid { across_m: a, along_m: c };
            let pole = shape.bend_radius(DVec3::Z * (c + 0.01));
            assert!((pole - a * a / c).abs() < 1e-12, "{pole}");
            let equator = shape.bend_radius(DVec3::Y * (a + 0.01));
            assert!((equator - a.min(c * c / a)).abs() < 1e-12, "{equator}");
        }
    }

    /// Places spread evenly over a cube by a lattice of irrational steps.
    fn places() -> impl Iterator<Item = DVec3> {
        (1..2000).map(|k| {
            let share = |step: f64| 2.0 * (f64::from(k) * step).fract() - 1.0;
            DVec3::new(share(0.754_877_666), share(0.569_840_291), share(0.419_725_169))
        })
    }

    /// A foot taken back along the normal lies on the surface, and no distance changes faster than the place.
    #[test]
    fn the_normal_leads_to_the_surface() {
        for shape in shapes() {
            for place in places() {
                let near = shape.nearest(place);
                assert!((near.normal.length() - 1.0).abs() < 1e-12);
                let foot = place - near.normal * near.distance;
                assert!(
                    shape.distance(foot).abs() < 1e-9,
                    "{shape:?} at {place}: {}",
                    shape.distance(foot)
                );
                let other = place + DVec3::new(0.013, -0.021, 0.017);
                assert!(
                    (shape.distance(other) - near.distance).abs()
                        <= (other - place).length() + 1e-12
                );
            }
        }
    }

    /// The normal is the gradient of the distance, away from where it has a kink.
    #[test]
    fn the_normal_is_the_gradient() {
        let step = 1e-6;
        for shape in shapes() {
            let mut kinks = 0;
            for place in places() {
                let by = |axis: DVec3| {
                    (shape.distance(place + axis * step) - shape.distance(place - axis * step))
                        / (2.0 * step)
                };
                let gradient = DVec3::new(by(DVec3::X), by(DVec3::Y), by(DVec3::Z));
                kinks += usize::from((gradient - shape.nearest(place).normal).length() > 1e-4);
            }
            assert!(kinks < 4, "{shape:?}: {kinks}");
        }
    }
}
