use super::*;

/// Repeatable numbers in -1..1 for tests.
struct Dice(u64);

impl Dice {
    fn next(&mut self) -> f64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    fn point(&mut self) -> DVec3 {
        DVec3::new(self.next(), self.next(), self.next())
    }
}

/// Least distance by nested minimisation: the distance along the segment is convex, and so is that
/// along each line of the triangle.
fn searched(segment: [DVec3; 2], triangle: [DVec3; 3]) -> f64 {
    golden(|s| {
        let point = segment[0].lerp(segment[1], s);
        golden(|v| {
            let low = triangle[0].lerp(triangle[1], v);
            let high = triangle[0].lerp(triangle[2], v);
            let along = high - low;
            let t = if along.length_squared() > 0.0 {
                ((point - low).dot(along) / along.length_squared()).clamp(0.0, 1.0)
            } else {
                0.0
            };
            (low + along * t).distance(point)
        })
    })
}

fn golden(value: impl Fn(f64) -> f64) -> f64 {
    let ratio = 0.618_033_988_749_894_8;
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..60 {
        let (left, right) = (high - ratio * (high - low), low + ratio * (high - low));
        if value(left) < value(right) { high = right } else { low = left }
    }
    value((low + high) / 2.0).min(value(0.0)).min(value(1.0))
}

#[test]
fn distance_agrees_with_a_search() {
    let mut dice = Dice(7);
    let mut crossed = 0;
    for _ in 0..1500 {
        let segment = [dice.point(), dice.point()];
        let triangle = [dice.point(), dice.point(), dice.point()];
        let nearest = segment_triangle(segment, triangle);
        let reference = searched(segment, triangle);
        assert!(
            (nearest.distance - reference).abs() < 2e-6,
            "{} against {reference}",
            nearest.distance
        );
        crossed += i32::from(nearest.distance == 0.0);
    }
    assert!(crossed > 50, "the search must see crossings too, saw {crossed}");
}

/// The two places named are as far apart as the distance says, on the segment and on the triangle.
#[test]
fn places_and_distance_agree() {
    let mut dice = Dice(11);
    for _ in 0..20_000 {
        let segment = [dice.point(), dice.point()];
        let triangle = [dice.point(), dice.point(), dice.point()];
        let nearest = segment_triangle(segment, triangle);
        let on_rope = segment[0].lerp(segment[1], nearest.fraction);
        let on_skin: DVec3 =
            triangle.iter().zip(nearest.barycentric).map(|(corner, share)| *corner * share).sum();
        assert!((on_rope.distance(on_skin) - nearest.distance).abs() < 1e-12);
        assert!(
            (nearest.barycentric.iter().sum::<f64>() - 1.0).abs() < 1e-12
                && inside(nearest.barycentric)
        );
        assert!((0.0..=1.0).contains(&nearest.fraction));
    }
}

#[test]
fn a_point_is_a_segment_without_length() {
    let mut dice = Dice(13);
    for _ in 0..5000 {
        let point = dice.point() * 2.0;
        let triangle = [dice.point(), dice.point(), dice.point()];
        let (distance, _) = point_triangle(point, triangle);
        assert!((distance - segment_triangle([point, point], triangle).distance).abs() < 1e-12);
    }
}

/// Shrunken triangles and segments: measured against the lines and points they have become.
#[test]
fn degenerate_shapes_are_measured() {
    let spot = DVec3::new(0.3, -0.2, 0.5);
    let point = segment_triangle([DVec3::ZERO, DVec3::ZERO], [spot; 3]);
    assert!((point.distance - spot.length()).abs() < 1e-15);
    let line = [DVec3::ZERO, DVec3::X, DVec3::X * 0.5];
    let above = segment_triangle([DVec3::new(0.2, 1.0, 0.0), DVec3::new(0.8, 1.0, 0.0)], line);
    assert!((above.distance - 1.0).abs() < 1e-15);
    let (flat, _) = point_triangle(DVec3::new(2.0, 0.0, 0.0), line);
    assert!((flat - 1.0).abs() < 1e-15);
    let parallel = segment_triangle(
        [DVec3::new(-5.0, 0.25, 0.5), DVec3::new(5.0, 0.25, 0.5)],
        [DVec3::ZERO, DVec3::X, DVec3::Y],
    );
    assert!((parallel.distance - 0.5).abs() < 1e-15);
}

/// A segment that lies in the triangle's plane and overlaps it has distance 0.
#[test]
fn coplanar_overlap_is_contact() {
    let triangle = [DVec3::ZERO, DVec3::X, DVec3::Y];
    let across =
        segment_triangle([DVec3::new(-1.0, 0.2, 0.0), DVec3::new(1.0, 0.2, 0.0)], triangle);
    assert!(across.distance < 1e-15);
    let within = segment_triangle([DVec3::new(0.2, 0.2, 0.0), DVec3::new(0.3, 0.2, 0.0)], triangle);
    assert!(within.distance < 1e-15);
}
