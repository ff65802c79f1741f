use glam::DQuat;

use parry3d::shape::SupportMap;

use crate::geometry::core::convex::nearest_to_segment;
use crate::geometry::core::*;

fn share(k: u32, step: f64) -> f64 {
    2.0 * (f64::from(k) * step).fract() - 1.0
}

/// Places spread evenly over a cube by a lattice of irrational steps.
fn place(k: u32) -> DVec3 {
    DVec3::new(share(k, 0.754_877_666), share(k, 0.569_840_291), share(k, 0.419_725_169))
}

fn core(shape: Shape) -> BodyCore {
    BodyCore::of(0, &PlacedShape { shape, middle_m: DVec3::new(0.02, -0.03, 0.1) })
}

/// Shapes with a curved side: squat, long and thin ones.
fn curved() -> [Shape; 6] {
    [
        Shape::Cylinder { radius_m: 0.15, half_length_m: 0.2 },
        Shape::Cylinder { radius_m: 0.019, half_length_m: 0.9 },
        Shape::Cylinder { radius_m: 0.3, half_length_m: 0.03 },
        Shape::Spheroid { across_m: 0.16, along_m: 0.29 },
        Shape::Spheroid { across_m: 0.3, along_m: 0.1 },
        Shape::Spheroid { across_m: 0.2, along_m: 0.2 },
    ]
}

/// No place of a fine net over triangle and core is nearer than the distance found, and one is as near to within the net's width.
#[test]
fn no_place_of_a_net_is_nearer() {
    let half = DVec3::new(0.3, 0.2, 0.12);
    let others = [
        Shape::Sphere(0.15),
        Shape::Capsule { radius_m: 0.07, half_length_m: 0.3 },
        Shape::Box(half),
    ];
    for shape in others.into_iter().chain(curved()) {
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
            assert!(least - nearest.distance < 0.04, "{shape:?} {k}: {} {least}", nearest.distance);
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
            Core::Cylinder(cylinder) => {
                let across = DVec3::new(inward.x, inward.y, 0.0);
                let off = across.length();
                let across =
                    if off > cylinder.radius { across * (cylinder.radius / off) } else { across };
                across + DVec3::Z * inward.z.clamp(-cylinder.half, cylinder.half)
            }
            Core::Spheroid(spheroid) => by_bisection(spheroid, inward),
            Core::HalfSpace => unreachable!("no body has such a core"),
        };
        inward.distance(nearest)
    }
}

/// The nearest place of a spheroid by another way: with half axes `h`, it is `h² p/(h² + t)` where `t` makes it lie on the surface.
fn by_bisection(spheroid: &Spheroid, place: DVec3) -> DVec3 {
    let half = DVec3::new(spheroid.across, spheroid.across, spheroid.along);
    if (place / half).length_squared() <= 1.0 {
        return place;
    }
    let at = |t: f64| place * half * half / (half * half + DVec3::splat(t));
    let (mut low, mut high) = (0.0, place.length() * half.max_element() + 1.0);
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        let outside = (at(middle) / half).length_squared() > 1.0;
        (low, high) = if outside { (middle, high) } else { (low, middle) };
    }
    at(low)
}

fn support(core: &Core, direction: DVec3) -> DVec3 {
    match core {
        Core::Cylinder(cylinder) => cylinder.local_support_point(direction),
        Core::Spheroid(spheroid) => spheroid.local_support_point(direction),
        _ => unreachable!("only curved cores are asked"),
    }
}

/// A slab between core and triangle proves that they are as far apart as found: all of the core lies on one side of it, all of the triangle on
/// the other. Where they are said to meet, no slab parts them.
#[test]
fn the_distance_of_a_curved_core_is_exact() {
    let mut least = f64::INFINITY;
    for shape in curved() {
        let core = core(shape.clone());
        let mut met = 0;
        for k in 1..4000 {
            let scale = [1.0, 0.3, 0.05][k as usize % 3];
            let about = place(5000 + k) * 0.4;
            let corners = [0, 1, 2].map(|corner| about + place(3 * k + corner) * scale);
            let pose = Pose { place: DVec3::ZERO, orientation: DQuat::IDENTITY };
            let inward = corners.map(|corner| corner - core.middle);
            let Some(nearest) = core.nearest(&pose, corners) else {
                met += 1;
                let directions = (0..200).map(|n| place(n + 7)).map(DVec3::normalize);
                for n in directions {
                    let first = inward.map(|corner| n.dot(corner)).into_iter().fold(9.0, f64::min);
                    assert!(first <= n.dot(support(&core.core, n)), "{shape:?} {k}: not met");
                }
                continue;
            };
            let n = (nearest.on_skin - nearest.on_core) / nearest.distance;
            let first =
                inward.map(|corner| n.dot(corner)).into_iter().fold(f64::INFINITY, f64::min);
            let slab = first - n.dot(support(&core.core, n));
            least = least.min(nearest.distance);
            assert!(
                (slab - nearest.distance).abs() < 1e-9,
                "{shape:?} {k}: {slab} {}",
                nearest.distance
            );
        }
        assert!(met > 100, "{shape:?}: met {met}");
    }
    assert!(least < 1e-3, "none was near: {least}");
}

/// A triangle that lies along an end, along a side or on a pole is as far away as its plane.
#[test]
fn triangles_along_a_curved_core_are_as_far_as_their_planes() {
    let wide = |at: DVec3, one: DVec3, two: DVec3| {
        [at - one - two, at + 3.0 * one - two, at - one + 3.0 * two]
    };
    let pose = Pose { place: DVec3::ZERO, orientation: DQuat::IDENTITY };
    for shape in curved() {
        let core = BodyCore::of(0, &PlacedShape::about_origin(shape.clone()));
        let half = shape.half_m() + DVec3::splat(0.01);
        let planes = [
            wide(DVec3::Z * half.z, DVec3::X, DVec3::Y),
            wide(DVec3::NEG_Z * half.z, DVec3::X, DVec3::Y),
            wide(DVec3::X * half.x, DVec3::Y, DVec3::Z),
            wide(DVec3::NEG_Y * half.y, DVec3::X, DVec3::Z),
        ];
        for corners in planes {
            let found = core.nearest(&pose, corners).expect("they do not meet").distance;
            assert!((found - core.reach - 0.01).abs() < 1e-12, "{shape:?}: {found}");
        }
    }
}

/// A segment lies as near to a core as the nearest of its places.
#[test]
fn segments_are_as_near_as_their_nearest_place() {
    let cylinder = Cylinder { radius: 0.1, half: 0.3 };
    for k in 1..500 {
        let ends = [place(2 * k), place(2 * k + 1)];
        let [on_core, on_segment] = nearest_to_segment(&cylinder, ends);
        let found = on_core.distance(on_segment);
        for n in 0..=1000 {
            let at = ends[0].lerp(ends[1], f64::from(n) / 1000.0);
            assert!(found <= at.distance(cylinder.nearest(at)) + 1e-12, "{k}");
        }
    }
}

/// The surface about a spheroid's core touches the spheroid at poles and equator, and lies outside it between, by no more than is said.
#[test]
fn the_surface_about_a_core_is_the_spheroid_within_some_hundredths() {
    for (times, most) in [(1.0, 1e-12), (2.0, 0.02), (3.0, 0.04), (0.5, 0.02), (1.0 / 3.0, 0.04)] {
        let (a, c) = (0.2, 0.2 * times);
        let (core, reach) = Spheroid::shrunk(a, c);
        let mut greatest = 0.0_f64;
        for k in 0..=1000 {
            let angle = std::f64::consts::FRAC_PI_2 * f64::from(k) / 1000.0;
            let n = DVec3::new(libm::sin(angle), 0.0, libm::cos(angle));
            let whole = n.dot(Spheroid { across: a, along: c }.local_support_point(n));
            let outside = n.dot(core.local_support_point(n)) + reach - whole;
            assert!(outside > -1e-12, "{times} {k}: {outside}");
            greatest = greatest.max(outside);
        }
        assert!(greatest <= most * a.min(c), "{times}: {greatest}");
    }
}
