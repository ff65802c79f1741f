//! The core of an obstacle, as bodies meet it.
//!
//! As for bodies (`core.rs`): a ball is a point, a capsule a rod; of a box, a cylinder and a plane `h` is taken off each side, so that the edges are
//! rounded by `h`.

use glam::DVec3;
use parry3d::shape::{Cuboid, SupportMap};

use super::{BodyCore, Core, ROUNDED_M, ROUNDED_SHARE};
use crate::model::Obstacle;
use crate::solids::SolidShape;

/// Places round each rim of a cylinder at which a face that lies on it bears.
const RIM_PLACES: u32 = 8;

/// A cylinder along z with flat ends.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cylinder {
    /// Radius [m].
    pub radius: f64,
    /// Half of its length [m].
    pub half: f64,
}

impl Cylinder {
    /// Its place that is nearest to another place of its frame.
    pub fn nearest(&self, place: DVec3) -> DVec3 {
        let across = DVec3::new(place.x, place.y, 0.0).clamp_length_max(self.radius);
        across + DVec3::Z * place.z.clamp(-self.half, self.half)
    }

    /// Places round both rims, in its frame.
    pub fn rims(self) -> impl Iterator<Item = DVec3> {
        (0..2 * RIM_PLACES).map(move |k| {
            let angle = core::f64::consts::TAU * f64::from(k / 2) / f64::from(RIM_PLACES);
            let height = if k % 2 == 0 { -self.half } else { self.half };
            let (sin, cos) = (libm::sin(angle), libm::cos(angle));
            DVec3::new(self.radius * cos, self.radius * sin, height)
        })
    }
}

impl SupportMap for Cylinder {
    fn local_support_point(&self, direction: DVec3) -> DVec3 {
        let across = DVec3::new(direction.x, direction.y, 0.0).normalize_or_zero() * self.radius;
        across + DVec3::Z * self.half.copysign(direction.z)
    }
}

impl BodyCore {
    /// The core of an obstacle, in its frame.
    pub fn of_obstacle(obstacle: &Obstacle) -> Self {
        let rounded = |least_half: f64| ROUNDED_M.min(ROUNDED_SHARE * least_half);
        let (core, reach, middle) = match obstacle.shape {
            SolidShape::Plane => (Core::HalfSpace, ROUNDED_M, DVec3::NEG_Z * ROUNDED_M),
            SolidShape::Sphere(radius_m) => (Core::Point, radius_m, DVec3::ZERO),
            SolidShape::Capsule { radius_m, half_length_m } => {
                (Core::Rod((half_length_m - radius_m).max(0.0)), radius_m, DVec3::ZERO)
            }
            SolidShape::Cylinder { radius_m, half_length_m } => {
                let reach = rounded(radius_m.min(half_length_m));
                let cylinder = Cylinder { radius: radius_m - reach, half: half_length_m - reach };
                (Core::Cylinder(cylinder), reach, DVec3::ZERO)
            }
            SolidShape::Box(half) => {
                let reach = rounded(half.min_element());
                (Core::Box(Cuboid::new(half - DVec3::splat(reach))), reach, DVec3::ZERO)
            }
        };
        Self { core, reach, middle, radius: obstacle.shape.radius() }
    }
}

#[cfg(test)]
mod tests {
    use glam::DQuat;

    use super::*;
    use crate::metrics::tests::body;
    use crate::model::{Body, BodyRole, ROPE_ON_HARD_N_M2, Shape};
    use crate::solids::{Pose, SolidShape};

    fn place(k: u32) -> DVec3 {
        let share = |step: f64| 2.0 * (f64::from(k) * step).fract() - 1.0;
        DVec3::new(share(0.754_877_666), share(0.569_840_291), share(0.419_725_169))
    }

    fn obstacle(shape: SolidShape) -> BodyCore {
        BodyCore::of_obstacle(&Obstacle {
            id: "it".into(),
            shape,
            position_m: DVec3::ZERO,
            orientation: DQuat::IDENTITY,
            friction: 0.0,
            stiffness_n_m2: ROPE_ON_HARD_N_M2,
        })
    }

    /// Half extents of the box round a body's core [m].
    fn half_of(core: &BodyCore) -> DVec3 {
        match &core.core {
            Core::Rod(half) => DVec3::Z * *half,
            Core::Box(cuboid) => cuboid.half_extents,
            _ => DVec3::ZERO,
        }
    }

    /// No place of a net over the body's core is nearer to the obstacle than the distance found, and one is as near to within the net's width.
    #[test]
    fn no_place_of_a_net_is_nearer_to_an_obstacle() {
        let shapes = [
            Shape::Sphere(0.15),
            Shape::Capsule { radius_m: 0.07, half_length_m: 0.3 },
            Shape::Box(DVec3::new(0.3, 0.2, 0.12)),
        ];
        let obstacles = [
            SolidShape::Plane,
            SolidShape::Cylinder { radius_m: 0.3, half_length_m: 0.2 },
            SolidShape::Capsule { radius_m: 0.1, half_length_m: 0.4 },
            SolidShape::Box(DVec3::new(0.4, 0.2, 0.3)),
        ];
        for (shape, other) in
            shapes.iter().flat_map(|one| obstacles.iter().map(move |two| (one, two)))
        {
            let it = body("it", BodyRole::Buoy, DVec3::ZERO);
            let core = BodyCore::of(&Body { shape: shape.clone(), ..it });
            let rock = obstacle(other.clone());
            let half = half_of(&core);
            for k in 1..60 {
                let turn = |k: u32| DQuat::from_scaled_axis(place(k) * 3.0);
                let at = |k: u32, place: DVec3| Pose { place, orientation: turn(k) };
                let (pose, there) = (at(k, place(500 + k)), at(900 + k, DVec3::ZERO));
                let found = core.nearest_to(&pose, &rock, &there);
                let net = (0..11 * 11 * 11).map(|n: i32| {
                    let at =
                        DVec3::new(f64::from(n % 11), f64::from(n / 11 % 11), f64::from(n / 121));
                    pose.outward(core.middle + half * (at / 5.0 - 1.0))
                });
                let least = net
                    .map(|at| at.distance(rock.nearest_to_place(&there, at)))
                    .fold(f64::INFINITY, f64::min);
                let Some([mine, others]) = found else {
                    assert!(least < 0.06, "{shape:?} {other:?} {k}: none found, {least}");
                    continue;
                };
                let distance = mine.distance(others);
                assert!(distance <= least + 1e-9, "{shape:?} {other:?} {k}: {distance} {least}");
                assert!(least - distance < 0.06, "{shape:?} {other:?} {k}: {distance} {least}");
                let apart = others.distance(rock.nearest_to_place(&there, mine));
                assert!(apart < 1e-6, "{shape:?} {other:?} {k}: {apart} m aside");
            }
        }
    }
}
