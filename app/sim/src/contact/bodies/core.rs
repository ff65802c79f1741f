//! The core of a body, and its distance from a triangle of skin.
//!
//! Ball: its centre. Buoy: the straight part of its axis. Box: what is left of it where `h` is taken off each side, so that its edges are
//! rounded by `h`. Distances of points and rods are exact (`contact/distance.rs`); that of a box is found by the algorithm of Gilbert, Johnson and
//! Keerthi (1988, doi:10.1109/56.2083), of the library parry.

pub(crate) mod obstacle_core;

use glam::DVec3;
use parry3d::math::Pose as Frame;
use parry3d::query::ClosestPoints;
use parry3d::query::details::closest_points_support_map_support_map;
use parry3d::shape::{Cuboid, Triangle};

use self::obstacle_core::Cylinder;
use crate::contact::distance::{point_triangle, segment_triangle};
use crate::contact::placed::on_triangle;
use crate::model::{Body, Shape};
use crate::solids::Pose;

/// Rounding of a box's edges: at most this [m], and this share of its least half extent.
pub(super) const ROUNDED_M: f64 = 0.05;
pub(super) const ROUNDED_SHARE: f64 = 0.5;

/// A core, in the body's frame about the middle of its shape.
#[derive(Clone, Debug)]
pub(crate) enum Core {
    Point,
    /// Half of a rod along z [m].
    Rod(f64),
    Box(Cuboid),
    /// A cylinder along z; only of obstacles.
    Cylinder(Cylinder),
    /// All that lies below z = 0; only of obstacles.
    HalfSpace,
}

/// A body as skin meets it.
#[derive(Clone, Debug)]
pub(crate) struct BodyCore {
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
    /// The core of a body.
    pub fn of(body: &Body) -> Self {
        let (core, reach, half) = match body.shape {
            Shape::Sphere(radius_m) => (Core::Point, radius_m, 0.0),
            Shape::Capsule { radius_m, half_length_m } => {
                let straight = (half_length_m - radius_m).max(0.0);
                (Core::Rod(straight), radius_m, straight)
            }
            Shape::Box(half) => {
                let reach = ROUNDED_M.min(ROUNDED_SHARE * half.min_element());
                let inner = half - DVec3::splat(reach);
                (Core::Box(Cuboid::new(inner)), reach, inner.length())
            }
        };
        let middle = body.shape_offset_m;
        Self { core, reach, middle, radius: middle.length() + half + reach }
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
            // Obstacles do not meet skin.
            Core::Cylinder(_) | Core::HalfSpace => return None,
        };
        (distance > 0.0).then(|| Nearest {
            distance,
            barycentric,
            on_core: pose.outward(on_core + self.middle),
            on_skin: on_triangle(corners, barycentric),
        })
    }

    /// Corners of a box's core with the places nearest to them on a triangle; a face that lies along skin bears on them. Empty for other cores.
    pub fn nearest_to_corners(
        &self,
        pose: &Pose,
        corners: [DVec3; 3],
    ) -> impl Iterator<Item = Nearest> {
        self.corners(pose).map(move |on_core| {
            let (distance, barycentric) = point_triangle(on_core, corners);
            Nearest { distance, barycentric, on_core, on_skin: on_triangle(corners, barycentric) }
        })
    }

    /// Corners of a box's core in a pose; none for other cores.
    pub fn corners(&self, pose: &Pose) -> impl Iterator<Item = DVec3> {
        let half = match &self.core {
            Core::Box(cuboid) => Some(cuboid.half_extents),
            _ => None,
        };
        let (pose, middle) = (*pose, self.middle);
        half.into_iter().flat_map(|half| (0..8).map(move |k| (half, k))).map(move |(half, k)| {
            let sign = |bit: usize| if k >> bit & 1 == 0 { -1.0 } else { 1.0 };
            pose.outward(middle + half * DVec3::new(sign(0), sign(1), sign(2)))
        })
    }

    /// The longest line of the core, for a test of crossing that knows nothing of distances.
    pub fn axis(&self, pose: &Pose) -> [DVec3; 2] {
        let half = match &self.core {
            Core::Point | Core::HalfSpace => DVec3::ZERO,
            Core::Rod(half) => DVec3::Z * *half,
            Core::Cylinder(cylinder) => DVec3::Z * cylinder.half,
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
mod tests {
    use glam::DQuat;

    use super::*;
    use crate::metrics::tests::body;
    use crate::model::BodyRole;

    fn share(k: u32, step: f64) -> f64 {
        2.0 * (f64::from(k) * step).fract() - 1.0
    }

    /// Places spread evenly over a cube by a lattice of irrational steps.
    fn place(k: u32) -> DVec3 {
        DVec3::new(share(k, 0.754_877_666), share(k, 0.569_840_291), share(k, 0.419_725_169))
    }

    fn core(shape: Shape) -> BodyCore {
        let it = body("it", BodyRole::Buoy, DVec3::ZERO);
        BodyCore::of(&Body { shape, shape_offset_m: DVec3::new(0.02, -0.03, 0.1), ..it })
    }

    /// No place of a fine net over triangle and core is nearer than the distance found, and one is as near to within the net's width.
    #[test]
    fn no_place_of_a_net_is_nearer() {
        let half = DVec3::new(0.3, 0.2, 0.12);
        for shape in [
            Shape::Sphere(0.15),
            Shape::Capsule { radius_m: 0.07, half_length_m: 0.3 },
            Shape::Box(half),
        ] {
            let core = core(shape.clone());
            for k in 1..60 {
                let corners = [place(3 * k), place(3 * k + 1), place(3 * k + 2)];
                let orientation = DQuat::from_scaled_axis(place(1000 + k) * 3.0);
                let pose = Pose { place: place(2000 + k) * 0.5, orientation };
                let Some(nearest) = core.nearest(&pose, corners) else { continue };
                let net = |n: u32| (0..=n).map(move |i| f64::from(i) / f64::from(n));
                let mut least = f64::INFINITY;
                for u in net(40) {
                    for v in net(40).filter(|v| u + v <= 1.0 + 1e-9) {
                        let at = on_triangle(corners, [1.0 - u - v, u, v]);
                        least = least.min(core.distance_of(&pose, at));
                    }
                }
                assert!(
                    nearest.distance <= least + 1e-9,
                    "{shape:?} {k}: {} {least}",
                    nearest.distance
                );
                assert!(
                    least - nearest.distance < 0.04,
                    "{shape:?} {k}: {} {least}",
                    nearest.distance
                );
                let apart = nearest.on_core.distance(nearest.on_skin);
                assert!((apart - nearest.distance).abs() < 1e-9);
                assert!(core.distance_of(&pose, nearest.on_core).abs() < 1e-9);
            }
        }
    }

    impl BodyCore {
        /// Distance of a place from the core in closed form.
        fn distance_of(&self, pose: &Pose, place: DVec3) -> f64 {
            let inward = pose.inward(place) - self.middle;
            let nearest = match &self.core {
                Core::Point => DVec3::ZERO,
                Core::Rod(half) => DVec3::Z * inward.z.clamp(-half, *half),
                Core::Box(cuboid) => inward.clamp(-cuboid.half_extents, cuboid.half_extents),
                Core::Cylinder(_) | Core::HalfSpace => unreachable!("no body has such a core"),
            };
            inward.distance(nearest)
        }
    }
}
