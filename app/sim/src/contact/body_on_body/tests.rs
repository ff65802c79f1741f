//! Distances of cores from each other, proved by slabs that part them.

use glam::{DQuat, DVec3};

use crate::geometry::Pose;
use crate::geometry::core::{BodyCore, Core};
use crate::geometry::shape::SolidShape;
use crate::model::{Obstacle, PlacedShape, ROPE_ON_HARD_N_M2, Shape};
use parry3d::shape::SupportMap;

fn place(k: u32) -> DVec3 {
    let share = |step: f64| 2.0 * (f64::from(k) * step).fract() - 1.0;
    DVec3::new(share(0.754_877_666), share(0.569_840_291), share(0.419_725_169))
}

/// Shapes of parts: all kinds, squat and long ones, and a staff.
fn shapes() -> Vec<Shape> {
    vec![
        Shape::Sphere(0.15),
        Shape::Capsule { radius_m: 0.07, half_length_m: 0.3 },
        Shape::Box(DVec3::new(0.3, 0.2, 0.12)),
        Shape::Cylinder { radius_m: 0.15, half_length_m: 0.2 },
        Shape::Cylinder { radius_m: 0.019, half_length_m: 0.9 },
        Shape::Cylinder { radius_m: 0.3, half_length_m: 0.03 },
        Shape::Spheroid { across_m: 0.16, along_m: 0.29 },
        Shape::Spheroid { across_m: 0.3, along_m: 0.1 },
    ]
}

/// The place of a core in a pose that lies farthest in a direction.
fn farthest(core: &BodyCore, pose: &Pose, direction: DVec3) -> DVec3 {
    let inward = pose.orientation.inverse() * direction;
    let place = match &core.core {
        Core::Point => DVec3::ZERO,
        Core::Rod(half) => DVec3::Z * half.copysign(inward.z),
        Core::Box(cuboid) => cuboid.half_extents * inward.signum(),
        Core::Cylinder(cylinder) => cylinder.local_support_point(inward),
        Core::Spheroid(spheroid) => spheroid.local_support_point(inward),
        Core::HalfSpace => unreachable!("a plane has no farthest place"),
    };
    pose.outward(core.middle + place)
}

/// How far apart two cores are, and how thick the slab is that lies across the line between their nearest places and parts them.
fn apart(core: &BodyCore, pose: &Pose, other: &BodyCore, other_pose: &Pose) -> Option<[f64; 2]> {
    let [mine, others] = core.nearest_to(pose, other, other_pose)?;
    let on = [(core, pose, mine), (other, other_pose, others)];
    for (core, pose, place) in on {
        assert!(core.nearest_to_place(pose, place).distance(place) < 1e-9, "it is not on the core");
    }
    let n = (others - mine).normalize();
    let slab = n.dot(farthest(other, other_pose, -n)) - n.dot(farthest(core, pose, n));
    Some([mine.distance(others), slab])
}

/// Every kind of core against every other: a slab as thick as the distance found parts them, so nothing is nearer.
#[test]
fn no_place_of_a_core_is_nearer_to_another() {
    for (one, two) in
        shapes().iter().flat_map(|one| shapes().into_iter().map(move |two| (one.clone(), two)))
    {
        let part = |shape: &Shape| PlacedShape {
            shape: shape.clone(),
            middle_m: DVec3::new(0.1, 0.0, -0.2),
        };
        let (core, other) = (BodyCore::of(0, &part(&one)), BodyCore::of(1, &part(&two)));
        // A rod or a box over a cylinder is searched for as over a cylinder that is an obstacle, with one turn less to settle the line.
        let is_searched = matches!(one, Shape::Capsule { .. } | Shape::Box(_))
            && matches!(two, Shape::Cylinder { .. });
        let bound = if is_searched { 1e-4 } else { 1e-7 };
        let mut met = 0;
        for k in 1..400 {
            let turn = |k: u32| DQuat::from_scaled_axis(place(k) * 3.0);
            let pose = Pose { place: place(500 + k) * 0.7, orientation: turn(k) };
            let there = Pose { place: DVec3::ZERO, orientation: turn(900 + k) };
            let Some([distance, slab]) = apart(&core, &pose, &other, &there) else {
                met += 1;
                continue;
            };
            // Contact begins at the sum of both contact distances; much nearer no step may end.
            if distance > 0.1 * (core.reach + other.reach) {
                let off = (slab - distance).abs();
                assert!(off < bound, "{one:?} {two:?} {k}: {distance} {slab}");
            }
        }
        assert!(met < 200, "{one:?} {two:?}: {met} are said to meet");
    }
}

/// A part over a plane is as far away as its lowest place.
#[test]
fn the_lowest_place_is_nearest_to_a_plane() {
    let plane = Obstacle {
        id: "it".into(),
        shape: SolidShape::Plane,
        position_m: DVec3::ZERO,
        orientation: DQuat::from_rotation_x(0.3),
        friction: 0.0,
        stiffness_n_m2: ROPE_ON_HARD_N_M2,
    };
    let (rock, there) = (BodyCore::of_obstacle(1, &plane), plane.pose());
    let up = plane.orientation * DVec3::Z;
    for shape in shapes() {
        let core = BodyCore::of(0, &PlacedShape::about_origin(shape.clone()));
        for k in 1..200 {
            let pose =
                Pose { place: up * 2.0, orientation: DQuat::from_scaled_axis(place(k) * 3.0) };
            let [mine, others] = core.nearest_to(&pose, &rock, &there).expect("it is above");
            let lowest = up.dot(farthest(&core, &pose, -up)) + rock.reach;
            assert!((mine.distance(others) - lowest).abs() < 1e-12, "{shape:?} {k}");
        }
    }
}
