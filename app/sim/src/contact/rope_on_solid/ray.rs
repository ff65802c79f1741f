//! Intersection of a ray with a body, by the shapes of contact: what is under the pointer in a picture.

use glam::{DQuat, DVec3};
use parry3d::query::{Ray, RayCast};
use parry3d::shape::{Ball, Capsule, Cuboid};

use crate::geometry::Pose;
use crate::model::{Body, PlacedShape, Shape};

impl Shape {
    /// This shape larger by so much on every side, with sharp edges where it has edges [m].
    pub fn grown(&self, by_m: f64) -> Self {
        match self {
            Self::Box(half) => Self::Box(*half + DVec3::splat(by_m)),
            Self::Sphere(radius_m) => Self::Sphere(radius_m + by_m),
            Self::Capsule { radius_m, half_length_m } => {
                Self::Capsule { radius_m: radius_m + by_m, half_length_m: half_length_m + by_m }
            }
            Self::Cylinder { radius_m, half_length_m } => {
                Self::Cylinder { radius_m: radius_m + by_m, half_length_m: half_length_m + by_m }
            }
            Self::Spheroid { across_m, along_m } => {
                Self::Spheroid { across_m: across_m + by_m, along_m: along_m + by_m }
            }
        }
    }

    /// Half of its least extent [m].
    pub fn least_half_m(&self) -> f64 {
        self.half_m().min_element()
    }

    /// How far along a ray of its own frame it begins; zero from inside, `None` where the ray passes it [m].
    pub fn met_by_ray(&self, from: DVec3, along: DVec3) -> Option<f64> {
        let ray = Ray::new(from, along);
        match self {
            Self::Box(half) => Cuboid::new(*half).cast_local_ray(&ray, f64::MAX, true),
            Self::Sphere(radius_m) => Ball::new(*radius_m).cast_local_ray(&ray, f64::MAX, true),
            Self::Capsule { radius_m, half_length_m } => {
                let straight = (half_length_m - radius_m).max(0.0);
                Capsule::new_z(straight, *radius_m).cast_local_ray(&ray, f64::MAX, true)
            }
            Self::Cylinder { radius_m, half_length_m } => {
                let round = within_round(from.with_z(0.0), along.with_z(0.0), *radius_m)?;
                let slab = within_slab(from.z, along.z, *half_length_m)?;
                first_of([round, slab])
            }
            Self::Spheroid { across_m, along_m } => {
                let scale = DVec3::new(*across_m, *across_m, *along_m).recip();
                first_of([within_round(from * scale, along * scale, 1.0)?, [0.0, f64::MAX]])
            }
        }
    }
}

/// Between which lengths along a ray it is nearer to the origin than a radius; all of them for a ray without direction that begins there.
fn within_round(from: DVec3, along: DVec3, radius: f64) -> Option<[f64; 2]> {
    let (a, b) = (along.length_squared(), from.dot(along));
    let c = from.length_squared() - radius * radius;
    if a <= 0.0 {
        return (c <= 0.0).then_some([f64::MIN, f64::MAX]);
    }
    let square = b * b - a * c;
    (square >= 0.0).then(|| [-1.0, 1.0].map(|side| (-b + side * libm::sqrt(square)) / a))
}

/// Between which lengths along a ray its height is less than this on both sides.
fn within_slab(from: f64, along: f64, half: f64) -> Option<[f64; 2]> {
    if along == 0.0 {
        return (from.abs() <= half).then_some([f64::MIN, f64::MAX]);
    }
    let [one, two] = [-half, half].map(|height| (height - from) / along);
    Some([one.min(two), one.max(two)])
}

/// Where a ray first is within two spans of itself; `None` where it never is.
fn first_of([one, two]: [[f64; 2]; 2]) -> Option<f64> {
    let (first, last) = (one[0].max(two[0]).max(0.0), one[1].min(two[1]));
    (first <= last).then_some(first)
}

impl Body {
    /// How far along a ray of unit direction it begins where it is at a place in an orientation, each of its parts being made larger until half of
    /// its least extent is this; `None` where the ray passes it [m].
    pub fn met_by_ray(
        &self,
        (place, orientation): (DVec3, DQuat),
        (from, along): (DVec3, DVec3),
        least_half_m: f64,
    ) -> Option<f64> {
        let pose = Pose { place, orientation };
        let (inward, along) = (pose.inward(from), orientation.inverse() * along);
        let met = self.parts.iter().filter_map(|PlacedShape { shape, middle_m }| {
            let (from, grown_m) = (inward - *middle_m, least_half_m - shape.least_half_m());
            if grown_m > 0.0 {
                shape.grown(grown_m).met_by_ray(from, along)
            } else {
                shape.met_by_ray(from, along)
            }
        });
        met.min_by(f64::total_cmp)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::metrics::tests::body;
    use crate::model::BodyRole;

    /// A ray of direction (0, sin, -cos) towards a ball of radius R about the origin, aimed to pass its centre by b, meets it
    /// √(R² - b²) before it is nearest.
    #[test]
    fn a_ball_is_met_half_a_chord_before_its_middle() {
        for beside_m in [0.0, 0.1, 0.29] {
            let along = DVec3::new(0.0, 0.6, -0.8);
            let from = -along * 7.0 + DVec3::X * beside_m;
            let met = Shape::Sphere(0.3).met_by_ray(from, along).unwrap();
            let chord = (0.09_f64 - beside_m * beside_m).sqrt();
            assert!((met - (7.0 - chord)).abs() < 1e-9, "{met} at {beside_m}");
        }
        assert_eq!(Shape::Sphere(0.3).met_by_ray(DVec3::new(0.31, 0.0, 5.0), DVec3::NEG_Z), None);
        assert_eq!(Shape::Sphere(0.3).met_by_ray(DVec3::Z, DVec3::Z), None, "behind the eye");
    }

    #[test]
    fn a_box_is_met_at_the_face_that_looks_to_the_eye() {
        let half = DVec3::new(0.6, 0.3, 0.2);
        let along = DVec3::new(-0.6, 0.0, -0.8);
        // Aimed at the place (0.1, 0.05, 0.2) of its upper face.
        let from = DVec3::new(0.1, 0.05, 0.2) - along * 4.0;
        let met = Shape::Box(half).met_by_ray(from, along).unwrap();
        assert!((met - 4.0).abs() < 1e-12, "{met}");
        assert_eq!(
            Shape::Box(half).met_by_ray(DVec3::new(0.61, 0.0, 3.0), DVec3::NEG_Z),
            None,
            "past its edge"
        );
    }

    #[test]
    fn a_capsule_is_met_on_its_side_and_on_its_rounded_end() {
        let capsule = Shape::Capsule { radius_m: 0.15, half_length_m: 0.5 };
        let side = capsule.met_by_ray(DVec3::new(0.09, -3.0, 0.3), DVec3::Y).unwrap();
        assert!((side - (3.0 - 0.12)).abs() < 1e-6, "{side}: 0.09² + 0.12² = 0.15²");
        let end = capsule.met_by_ray(DVec3::new(0.0, 0.09, 4.0), DVec3::NEG_Z).unwrap();
        assert!((end - (4.0 - 0.35 - 0.12)).abs() < 1e-6, "{end}");
        // Inside the box round it, outside its rounded end.
        assert_eq!(capsule.met_by_ray(DVec3::new(0.13, 0.13, 4.0), DVec3::NEG_Z), None);
    }

    #[test]
    fn a_cylinder_is_met_on_its_side_and_on_its_flat_end() {
        let cylinder = Shape::Cylinder { radius_m: 0.15, half_length_m: 0.5 };
        let side = cylinder.met_by_ray(DVec3::new(0.09, -3.0, 0.3), DVec3::Y).unwrap();
        assert!((side - (3.0 - 0.12)).abs() < 1e-12, "{side}: 0.09² + 0.12² = 0.15²");
        let end = cylinder.met_by_ray(DVec3::new(0.0, 0.14, 4.0), DVec3::NEG_Z).unwrap();
        assert!((end - 3.5).abs() < 1e-12, "{end}");
        assert_eq!(cylinder.met_by_ray(DVec3::new(0.13, 0.13, 4.0), DVec3::NEG_Z), None);
        // Past its rim, though it enters the round and the slab one after the other.
        let along = DVec3::new(0.8, 0.0, -0.6);
        assert_eq!(cylinder.met_by_ray(DVec3::new(0.1, 0.0, 0.6), along), None);
        assert_eq!(cylinder.met_by_ray(DVec3::ZERO, along), Some(0.0), "from inside");
    }

    /// The place met lies on the surface `(x² + y²)/a² + z²/c² = 1`, and the ray has not been inside before.
    #[test]
    fn a_spheroid_is_met_on_its_surface() {
        let spheroid = Shape::Spheroid { across_m: 0.2, along_m: 0.5 };
        let level = |at: DVec3| (at.x * at.x + at.y * at.y) / 0.04 + at.z * at.z / 0.25;
        let (from, along) = (DVec3::new(3.0, 0.1, -1.0), DVec3::new(-0.96, 0.0, 0.28));
        let met = spheroid.met_by_ray(from, along).unwrap();
        assert!((level(from + along * met) - 1.0).abs() < 1e-12, "{met}");
        assert!(level(from + along * (met - 1e-3)) > 1.0);
        assert_eq!(spheroid.met_by_ray(from + DVec3::Y * 0.11, along), None);
    }

    #[test]
    fn a_body_is_met_where_it_is_and_as_it_is_turned() {
        let it = body("it", BodyRole::Trap, DVec3::ZERO);
        let half = DVec3::new(0.6, 0.3, 0.2);
        let part = PlacedShape { shape: Shape::Box(half), middle_m: DVec3::Z * 0.1 };
        let it = Body { parts: vec![part], ..it };
        // Its long side stands upright, so that its own z axis lies along -x of the world.
        let turn = DQuat::from_rotation_y(-std::f64::consts::FRAC_PI_2);
        let at = DVec3::new(10.0, 0.0, -5.0);
        let ray = (at + DVec3::Z * 3.0 - DVec3::X * 0.1, DVec3::NEG_Z);
        let met = it.met_by_ray((at, turn), ray, 0.0).unwrap();
        assert!((met - 2.4).abs() < 1e-9, "{met}");
        let grown = it.met_by_ray((at, turn), ray, 0.25).unwrap();
        assert!((grown - 2.35).abs() < 1e-9, "{grown}");
    }
}
