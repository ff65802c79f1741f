//! Outlines of the parts of a body on screen. Each part is convex, so its outline is the convex hull of points on its surface.

use std::f64::consts::{PI, TAU};

use endline_sim::model::{Body, PlacedShape, Shape};
use glam::{DQuat, DVec2, DVec3};

use super::camera::Camera;

/// Circles of latitude of a sphere, and points on each.
const CIRCLES: u32 = 12;
const ROUND: u32 = 24;

/// Outline of each part of a body with a position and orientation, in a picture of `size` [points]. Parts behind the eye have none.
pub fn silhouette<'a>(
    body: &'a Body,
    (place, turn): (DVec3, DQuat),
    camera: &'a Camera,
    size: DVec2,
) -> impl Iterator<Item = Vec<DVec2>> + 'a {
    body.parts.iter().filter_map(move |PlacedShape { shape, middle_m }| {
        let seen = surface(shape).into_iter().map(|at| {
            let at = place + turn * (*middle_m + at);
            camera.project(at, size)
        });
        seen.collect::<Option<Vec<DVec2>>>().map(hull)
    })
}

/// Points on a shape whose convex hull is the shape, up to the resolution of round surfaces.
fn surface(shape: &Shape) -> Vec<DVec3> {
    let round = |radius_m: f64, straight_m: f64| {
        let on = move |circle: u32, step: u32| {
            let polar = PI * f64::from(circle) / f64::from(CIRCLES);
            let turn = TAU * f64::from(step) / f64::from(ROUND);
            let height = polar.cos();
            let side = DVec3::new(polar.sin() * turn.cos(), polar.sin() * turn.sin(), height);
            side * radius_m + DVec3::Z * if height < 0.0 { -straight_m } else { straight_m }
        };
        (0..=CIRCLES).flat_map(|circle| (0..ROUND).map(move |step| on(circle, step))).collect()
    };
    match shape {
        Shape::Box(_) => shape.corners().to_vec(),
        Shape::Sphere(radius_m) => round(*radius_m, 0.0),
        Shape::Capsule { radius_m, half_length_m } => {
            round(*radius_m, (half_length_m - radius_m).max(0.0))
        }
        Shape::Cylinder { radius_m, half_length_m } => {
            let rim = |height: f64| {
                (0..ROUND).map(move |step| {
                    let turn = TAU * f64::from(step) / f64::from(ROUND);
                    DVec3::new(radius_m * turn.cos(), radius_m * turn.sin(), height)
                })
            };
            rim(-half_length_m).chain(rim(*half_length_m)).collect()
        }
        Shape::Spheroid { across_m, along_m } => {
            let scale = DVec3::new(*across_m, *across_m, *along_m);
            let ball: Vec<DVec3> = round(1.0, 0.0);
            ball.into_iter().map(|at| at * scale).collect()
        }
    }
}

/// Convex hull of points, in order (Andrew 1979, doi:10.1016/0020-0190(79)90072-3).
fn hull(mut places: Vec<DVec2>) -> Vec<DVec2> {
    places.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    let mut hull = half(places.iter().copied());
    let back = half(places.into_iter().rev());
    hull.extend(back);
    hull
}

/// One side of the hull from end to end, without the last point.
fn half(places: impl Iterator<Item = DVec2>) -> Vec<DVec2> {
    let mut side: Vec<DVec2> = Vec::new();
    for place in places {
        while let [.., a, b] = side[..]
            && (b - a).perp_dot(place - b) <= 0.0
        {
            side.pop();
        }
        side.push(place);
    }
    side.pop();
    side
}

#[cfg(test)]
mod tests {
    use super::super::camera::View;
    use super::super::sample;
    use super::*;

    const SIZE: DVec2 = DVec2::new(900.0, 700.0);

    #[test]
    fn the_outline_of_a_ball_is_a_circle_of_its_radius() {
        let model = sample::model();
        let camera = Camera::of_view(View::Side, &[DVec3::ZERO], None, 13.0, SIZE.x / SIZE.y);
        let camera = Camera { distance_m: 20.0, ..camera };
        let parts = vec![PlacedShape::about_origin(Shape::Sphere(0.3))];
        let ball = Body { parts, ..model.spec.bodies[1].clone() };
        let at = (camera.target, DQuat::IDENTITY);
        let outline = silhouette(&ball, at, &camera, SIZE).next().unwrap();
        let radius = 0.3 / camera.metres_a_point(SIZE.y);
        let middle = camera.project(camera.target, SIZE).unwrap();
        assert!(outline.len() >= 12);
        for place in outline {
            let seen = (place - middle).length();
            assert!((seen / radius - 1.0).abs() < 0.02, "{seen} points of {radius}");
        }
    }

    #[test]
    fn a_hull_consists_of_the_corners_only() {
        let square = [(0.0, 0.0), (2.0, 0.0), (1.0, 1.0), (2.0, 2.0), (0.0, 2.0), (1.0, 0.0)];
        let hull = hull(square.map(|(x, y)| DVec2::new(x, y)).to_vec());
        assert_eq!(hull.len(), 4, "{hull:?}");
    }
}
