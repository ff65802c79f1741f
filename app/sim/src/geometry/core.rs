//! The core of a part of a body, and its distance from a triangle of skin.
//!
//! Ball: its centre. Buoy with rounded ends: the straight part of its axis. Box and flat-ended cylinder: reduced by `h` on each side,
//! so that edges are rounded by `h`. Spheroid: one with both half axes less by `h` (`core/spheroid.rs`). Distances of points and rods
//! (`geometry/distance.rs`), of cylinders and of spheroids (`core/convex.rs`) are exact; that of a box is found by the algorithm of Gilbert, Johnson
//! and Keerthi (1988, doi:10.1109/56.2083), of the library parry.

pub(crate) mod convex;
pub(crate) mod cylinder;
pub(crate) mod obstacle_core;
pub(crate) mod spheroid;

use glam::DVec3;
use parry3d::math::Pose as Frame;
use parry3d::query::ClosestPoints;
use parry3d::query::details::closest_points_support_map_support_map;
use parry3d::shape::{Cuboid, Triangle};

use crate::geometry::Pose;
use crate::geometry::core::convex::{Convex, nearest_to_triangle};
use crate::geometry::core::cylinder::Cylinder;
use crate::geometry::core::spheroid::Spheroid;
use crate::geometry::distance::{point_triangle, segment_triangle};
use crate::geometry::placed::on_triangle;
use crate::model::{Body, PlacedShape, Shape};

/// Rounding of edges: at most this [m], and this share of the least half extent.
const ROUNDED_M: f64 = 0.05;
const ROUNDED_SHARE: f64 = 0.5;

/// By how much the edges of a shape of a least half extent are rounded [m].
fn rounded(least_half_m: f64) -> f64 {
    ROUNDED_M.min(ROUNDED_SHARE * least_half_m)
}

/// A core, in the body's frame about the middle of its shape.
#[derive(Clone, Debug)]
pub(crate) enum Core {
    Point,
    /// Half of a rod along z [m].
    Rod(f64),
    Box(Cuboid),
    /// A cylinder along z.
    Cylinder(Cylinder),
    Spheroid(Spheroid),
    /// All that lies below z = 0; only of obstacles.
    HalfSpace,
}

/// A part of a body as skin and other bodies meet it, or an obstacle as bodies do.
#[derive(Clone, Debug)]
pub(crate) struct BodyCore {
    /// The body that it is a part of; of an obstacle its number after all bodies.
    pub thing: usize,
    pub core: Core,
    /// Contact distance: how far the surface lies off the core [m].
    pub reach: f64,
    /// Middle of the shape in the body's frame [m].
    pub middle: DVec3,
    /// Radius of a ball round the body's origin that holds it [m].
    pub radius: f64,
}

/// Where a core and a triangle are nearest.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Nearest {
    pub distance: f64,
    pub barycentric: [f64; 3],
    /// Places on the core and on the triangle [m].
    pub on_core: DVec3,
    pub on_skin: DVec3,
}

impl BodyCore {
    /// The cores of all parts of bodies, body after body.
    pub fn of_bodies(bodies: &[Body]) -> impl Iterator<Item = Self> {
        bodies
            .iter()
            .enumerate()
            .flat_map(|(index, body)| body.parts.iter().map(move |part| Self::of(index, part)))
    }

    /// The core of a part of a body of this index.
    pub fn of(body: usize, part: &PlacedShape) -> Self {
        let (core, reach, half) = match part.shape {
            Shape::Sphere(radius_m) => (Core::Point, radius_m, 0.0),
            Shape::Capsule { radius_m, half_length_m } => {
                let straight = (half_length_m - radius_m).max(0.0);
                (Core::Rod(straight), radius_m, straight)
            }
            Shape::Box(half) => {
                let reach = rounded(half.min_element());
                let inner = half - DVec3::splat(reach);
                (Core::Box(Cuboid::new(inner)), reach, inner.length())
            }
            Shape::Cylinder { radius_m, half_length_m } => {
                let (cylinder, reach) = Cylinder::rounded(radius_m, half_length_m);
                let half = libm::hypot(cylinder.radius, cylinder.half);
                (Core::Cylinder(cylinder), reach, half)
            }
            Shape::Spheroid { across_m, along_m } => {
                let (spheroid, reach) = Spheroid::shrunk(across_m, along_m);
                (Core::Spheroid(spheroid), reach, spheroid.across.max(spheroid.along))
            }
        };
        let middle = part.middle_m;
        Self { thing: body, core, reach, middle, radius: middle.length() + half + reach }
    }

    /// Nearest places of the core in a pose and a triangle; `None` where they meet.
    pub fn nearest(&self, pose: &Pose, corners: [DVec3; 3]) -> Option<Nearest> {
        let inward = corners.map(|corner| pose.inward(corner) - self.middle);
        let (distance, barycentric, on_core) = match &self.core {
            Core::Point => {
                let (distance, barycentric) = point_triangle(DVec3::ZERO, inward);
                (distance, barycentric, DVec3::ZERO)
            }
            Core::Rod(half) => {
                let rod = [DVec3::NEG_Z * *half, DVec3::Z * *half];
                let nearest = segment_triangle(rod, inward);
                let on_core = rod[0].lerp(rod[1], nearest.fraction);
                (nearest.distance, nearest.barycentric, on_core)
            }
            Core::Box(cuboid) => from_box(cuboid, inward)?,
            Core::Cylinder(cylinder) => nearest_to_triangle(cylinder, inward)?,
            Core::Spheroid(spheroid) => nearest_to_triangle(spheroid, inward)?,
            // Obstacles do not meet skin.
            Core::HalfSpace => return None,
        };
        (distance > 0.0).then(|| Nearest {
            distance,
            barycentric,
            on_core: pose.outward(on_core + self.middle),
            on_skin: on_triangle(corners, barycentric),
        })
    }

    /// Corners of a core, and the side of a cylinder that faces a place, with the places nearest to them on a triangle; a face or a side that
    /// lies along skin bears on them. Empty for cores without.
    pub fn nearest_to_corners(
        &self,
        pose: &Pose,
        corners: [DVec3; 3],
        towards: DVec3,
    ) -> impl Iterator<Item = Nearest> {
        self.corners(pose).chain(self.side_towards(pose, towards)).map(move |on_core| {
            let (distance, barycentric) = point_triangle(on_core, corners);
            Nearest { distance, barycentric, on_core, on_skin: on_triangle(corners, barycentric) }
        })
    }

    /// Corners of a box's core and places round the rims of a cylinder's, in a pose; empty for other cores.
    pub fn corners(&self, pose: &Pose) -> impl Iterator<Item = DVec3> {
        let (half, cylinder) = match &self.core {
            Core::Box(cuboid) => (Some(cuboid.half_extents), None),
            Core::Cylinder(cylinder) => (None, Some(*cylinder)),
            _ => (None, None),
        };
        let corners = half.into_iter().flat_map(|half| {
            (0..8).map(move |k| {
                let sign = |bit: usize| if k >> bit & 1 == 0 { -1.0 } else { 1.0 };
                half * DVec3::new(sign(0), sign(1), sign(2))
            })
        });
        let (pose, middle) = (*pose, self.middle);
        let rims = cylinder.into_iter().flat_map(Cylinder::rims);
        corners.chain(rims).map(move |place| pose.outward(middle + place))
    }

    /// Both ends of the line along a cylinder's side that faces a place; empty for other cores.
    pub fn side_towards(&self, pose: &Pose, place: DVec3) -> impl Iterator<Item = DVec3> {
        let ends = match &self.core {
            Core::Cylinder(cylinder) => {
                Some(cylinder.side_towards(pose.inward(place) - self.middle))
            }
            _ => None,
        };
        let (pose, middle) = (*pose, self.middle);
        ends.into_iter().flatten().map(move |place| pose.outward(middle + place))
    }

    /// The place of the core in a pose that is nearest to another place.
    pub fn nearest_to_place(&self, pose: &Pose, place: DVec3) -> DVec3 {
        let inward = pose.inward(place) - self.middle;
        let nearest = match &self.core {
            Core::Point => DVec3::ZERO,
            Core::Rod(half) => DVec3::Z * inward.z.clamp(-half, *half),
            Core::Box(cuboid) => inward.clamp(-cuboid.half_extents, cuboid.half_extents),
            Core::Cylinder(cylinder) => cylinder.nearest(inward),
            Core::Spheroid(spheroid) => spheroid.nearest(inward),
            Core::HalfSpace => inward.with_z(inward.z.min(0.0)),
        };
        pose.outward(nearest + self.middle)
    }

    /// The longest line of the core, for a test of crossing that knows nothing of distances.
    pub fn axis(&self, pose: &Pose) -> [DVec3; 2] {
        let half = match &self.core {
            Core::Point | Core::HalfSpace => DVec3::ZERO,
            Core::Rod(half) => DVec3::Z * *half,
            Core::Cylinder(Cylinder { radius: across, half: along })
            | Core::Spheroid(Spheroid { across, along }) => {
                if along >= across {
                    DVec3::Z * *along
                } else {
                    DVec3::X * *across
                }
            }
            Core::Box(cuboid) => {
                let extents = cuboid.half_extents;
                let longest = extents.max_element();
                DVec3::select(extents.cmpge(DVec3::splat(longest)), extents, DVec3::ZERO)
            }
        };
        [self.middle - half, self.middle + half].map(|end| pose.outward(end))
    }
}

/// Distance, place on the triangle and on the box; `None` where they meet.
fn from_box(cuboid: &Cuboid, corners: [DVec3; 3]) -> Option<(f64, [f64; 3], DVec3)> {
    let [a, b, c] = corners;
    let triangle = Triangle::new(a, b, c);
    let found =
        closest_points_support_map_support_map(&Frame::IDENTITY, cuboid, &triangle, f64::MAX);
    let ClosestPoints::WithinMargin(on_box, _) = found else { return None };
    // The nearest place to that of the box, to rounding, whatever the last digits of the search.
    let (distance, barycentric) = point_triangle(on_box, corners);
    Some((distance, barycentric, on_box))
}

#[cfg(test)]
mod tests;
