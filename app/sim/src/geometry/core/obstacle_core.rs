//! The core of an obstacle, as bodies meet it.
//!
//! As for bodies (`core.rs`): a ball is a point, a capsule a rod; of a box, a cylinder and a plane `h` is taken off each side, so that the edges are
//! rounded by `h`.

use glam::DVec3;
use parry3d::shape::Cuboid;

use crate::geometry::core::cylinder::Cylinder;
use crate::geometry::core::spheroid::Spheroid;
use crate::geometry::core::{BodyCore, Core, ROUNDED_M, rounded};
use crate::geometry::shape::SolidShape;
use crate::model::Obstacle;

impl BodyCore {
    /// The core of an obstacle of this number among all things, in its frame.
    pub fn of_obstacle(thing: usize, obstacle: &Obstacle) -> Self {
        let (core, reach, middle) = match obstacle.shape {
            SolidShape::Plane => (Core::HalfSpace, ROUNDED_M, DVec3::NEG_Z * ROUNDED_M),
            SolidShape::Sphere(radius_m) => (Core::Point, radius_m, DVec3::ZERO),
            SolidShape::Capsule { radius_m, half_length_m } => {
                (Core::Rod((half_length_m - radius_m).max(0.0)), radius_m, DVec3::ZERO)
            }
            SolidShape::Cylinder { radius_m, half_length_m } => {
                let (cylinder, reach) = Cylinder::rounded(radius_m, half_length_m);
                (Core::Cylinder(cylinder), reach, DVec3::ZERO)
            }
            SolidShape::Box(half) => {
                let reach = rounded(half.min_element());
                (Core::Box(Cuboid::new(half - DVec3::splat(reach))), reach, DVec3::ZERO)
            }
            SolidShape::Spheroid { across_m, along_m } => {
                let (spheroid, reach) = Spheroid::shrunk(across_m, along_m);
                (Core::Spheroid(spheroid), reach, DVec3::ZERO)
            }
        };
        Self { core, reach, middle, radius: obstacle.shape.radius(), thing }
    }
}

#[cfg(test)]
mod tests {
    use glam::DQuat;

    use super::*;
    use crate::geometry::Pose;
    use crate::geometry::shape::SolidShape;
    use crate::model::{PlacedShape, ROPE_ON_HARD_N_M2, Shape};

    fn place(k: u32) -> DVec3 {
        let share = |step: f64| 2.0 * (f64::from(k) * step).fract() - 1.0;
        DVec3::new(share(0.754_877_666), share(0.569_840_291), share(0.419_725_169))
    }

    fn obstacle(shape: SolidShape) -> BodyCore {
        BodyCore::of_obstacle(
            1,
            &Obstacle {
                id: "it".into(),
                shape,
                position_m: DVec3::ZERO,
                orientation: DQuat::IDENTITY,
                friction: 0.0,
                stiffness_n_m2: ROPE_ON_HARD_N_M2,
            },
        )
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
            let core = BodyCore::of(0, &PlacedShape::about_origin(shape.clone()));
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
