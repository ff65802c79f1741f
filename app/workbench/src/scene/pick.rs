//! What stands under the pointer: a place on a rope, a body, or a place on the whale's skin.
//!
//! A rope is thin, so it is found by its distance on screen; bodies and skin by the ray from the eye,
//! x(t) = e + t d. What is nearer to the eye counts, but rope wins over the skin that it lies on.

use endline_sim::model::Shape;
use endline_sim::whale::{pose, skin_all, skin_vertex};
use endline_sim::{DAffine3, Frame, Model};
use glam::{DVec2, DVec3};

use super::camera::Camera;

/// How far beside a rope or a small body the pointer may be [points].
const NEAR: f64 = 7.0;
/// How far behind the skin's front a rope may lie and still be found: rope pressed in, or at a flat angle [m].
const BEHIND_M: f64 = 0.15;

/// What was picked; it stays on the thing while that moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Picked {
    /// A place on a line.
    Rope {
        /// Index of the line.
        line: usize,
        /// Unstretched rope from its first end [m].
        at_m: f64,
    },
    /// A body by its index.
    Body(usize),
    /// A place on the whale.
    Skin {
        /// Index of the skin's triangle.
        triangle: usize,
        /// Shares of its corners.
        barycentric: [f64; 3],
    },
}

/// The ray from the eye through a place of a picture.
struct Ray {
    eye: DVec3,
    along: DVec3,
}

/// What stands at a place of a picture of `size` [points]; `None` in open water. Skin only where the whale is shown.
#[must_use]
pub fn pick(
    model: &Model,
    frame: &Frame,
    camera: &Camera,
    at: DVec2,
    size: DVec2,
    whale_is_shown: bool,
) -> Option<Picked> {
    let (eye, along) = camera.ray(at, size);
    let ray = Ray { eye, along };
    let body = body(model, frame, &ray, camera, size);
    let skin = if whale_is_shown { skin(model, frame, &ray) } else { None };
    let rope = rope(model, frame, &ray, camera, at, size);
    let far = |hit: Option<(f64, Picked)>| hit.map_or(f64::INFINITY, |(away_m, _)| away_m);
    let solid = if far(body) < far(skin) { body } else { skin };
    let rope = rope.filter(|(away_m, _)| *away_m < far(body) && *away_m < far(skin) + BEHIND_M);
    rope.or(solid).map(|(_, picked)| picked)
}

/// The rope nearest to the pointer on screen, of those within reach.
fn rope(
    model: &Model,
    frame: &Frame,
    ray: &Ray,
    camera: &Camera,
    at: DVec2,
    size: DVec2,
) -> Option<(f64, Picked)> {
    let mut best: Option<(f64, (f64, Picked))> = None;
    for (line, segments) in model.line_segments.iter().enumerate() {
        let (first, mut before_m) = (model.line_nodes[line].start, 0.0);
        for (order, segment) in segments.clone().enumerate() {
            let length_m = *frame.segment_length_m.get(segment)?;
            let ends = [*frame.nodes.get(first + order)?, *frame.nodes.get(first + order + 1)?];
            let whole = !frame.cut.get(segment).copied().unwrap_or(false);
            if let (true, [Some(a), Some(b)]) = (whole, ends.map(|end| camera.project(end, size))) {
                let share =
                    ((at - a).dot(b - a) / (b - a).length_squared().max(1e-12)).clamp(0.0, 1.0);
                let beside = (a + (b - a) * share - at).length();
                if beside <= NEAR && best.is_none_or(|(least, _)| beside < least) {
                    let away_m = (ends[0].lerp(ends[1], share) - ray.eye).dot(ray.along);
                    best = Some((
                        beside,
                        (away_m, Picked::Rope { line, at_m: before_m + share * length_m }),
                    ));
                }
            }
            before_m += length_m;
        }
    }
    best.map(|(_, hit)| hit)
}

/// The nearest body whose box, a little grown, the ray meets.
fn body(
    model: &Model,
    frame: &Frame,
    ray: &Ray,
    camera: &Camera,
    size: DVec2,
) -> Option<(f64, Picked)> {
    let hits = model.spec.bodies.iter().zip(&frame.bodies).enumerate().filter_map(
        |(index, (body, (place, turn)))| {
            let pose =
                DAffine3::from_rotation_translation(*turn, *place + *turn * body.shape_offset_m)
                    .inverse();
            let away_m = (*place - ray.eye).dot(ray.along).max(0.0);
            let half = half(&body.shape)
                + DVec3::splat(
                    0.5 * NEAR * camera.metres_a_point(size.y) * away_m / camera.distance_m,
                );
            let (from, along) = (pose.transform_point3(ray.eye), pose.transform_vector3(ray.along));
            let (one, other) = ((-half - from) / along, (half - from) / along);
            let (enters, leaves) = (one.min(other).max_element(), one.max(other).min_element());
            (enters <= leaves && leaves > 0.0).then_some((enters, Picked::Body(index)))
        },
    );
    hits.min_by(|a, b| a.0.total_cmp(&b.0))
}

/// Half extents of the box round a shape [m].
fn half(shape: &Shape) -> DVec3 {
    shape.corners().into_iter().fold(DVec3::ZERO, |half, corner| half.max(corner.abs()))
}

/// The nearest triangle of skin that the ray meets (Möller and Trumbore 1997).
fn skin(model: &Model, frame: &Frame, ray: &Ray) -> Option<(f64, Picked)> {
    let (skin, at) = (&model.spec.whale.as_ref()?.skin, frame.whale.as_ref()?);
    let (mut bones, mut places) = (Vec::new(), Vec::new());
    pose(skin, at.position, at.orientation, &at.posture, &mut bones);
    skin_all(skin, &bones, &mut places);
    let hits = skin.triangles.iter().enumerate().filter_map(|(triangle, corners)| {
        let (away_m, barycentric) = meets(ray, corners.map(|corner| places[corner as usize]))?;
        Some((away_m, Picked::Skin { triangle, barycentric }))
    });
    hits.min_by(|a, b| a.0.total_cmp(&b.0))
}

/// How far away a ray meets a triangle [m], and the shares of its corners there.
fn meets(ray: &Ray, [a, b, c]: [DVec3; 3]) -> Option<(f64, [f64; 3])> {
    let (ab, ac, from) = (b - a, c - a, ray.eye - a);
    let across = ray.along.cross(ac);
    let det = ab.dot(across);
    if det.abs() < 1e-14 {
        return None;
    }
    let of_b = from.dot(across) / det;
    let turned = from.cross(ab);
    let (of_c, away_m) = (ray.along.dot(turned) / det, ac.dot(turned) / det);
    let inside = of_b >= 0.0 && of_c >= 0.0 && of_b + of_c <= 1.0 && away_m > 0.0;
    inside.then_some((away_m, [1.0 - of_b - of_c, of_b, of_c]))
}

/// Where a length of rope from a line's first end lies: its segment and the share of it; `None` where there is no such line.
#[must_use]
pub fn on_line(model: &Model, frame: &Frame, line: usize, at_m: f64) -> Option<(usize, f64)> {
    let segments = model.line_segments.get(line)?.clone();
    let (mut before_m, last) = (0.0, segments.end.checked_sub(1)?);
    for segment in segments {
        let length_m = *frame.segment_length_m.get(segment)?;
        if at_m <= before_m + length_m || segment == last {
            return Some((segment, ((at_m - before_m) / length_m.max(1e-12)).clamp(0.0, 1.0)));
        }
        before_m += length_m;
    }
    None
}

/// Both ends of a segment of a line [m].
#[must_use]
pub fn ends(model: &Model, frame: &Frame, line: usize, segment: usize) -> Option<[DVec3; 2]> {
    let first = model.line_nodes.get(line)?.start
        + segment.checked_sub(model.line_segments.get(line)?.start)?;
    Some([*frame.nodes.get(first)?, *frame.nodes.get(first + 1)?])
}

/// Unstretched length of a line [m].
#[must_use]
pub fn length_m(model: &Model, frame: &Frame, line: usize) -> f64 {
    model
        .line_segments
        .get(line)
        .and_then(|segments| frame.segment_length_m.get(segments.clone()))
        .map_or(0.0, |all| all.iter().sum())
}

impl Picked {
    /// Where it is in a frame [m]; `None` where this frame has no such thing.
    #[must_use]
    pub fn place(self, model: &Model, frame: &Frame) -> Option<DVec3> {
        match self {
            Self::Rope { line, at_m } => {
                let (segment, share) = on_line(model, frame, line, at_m)?;
                let [a, b] = ends(model, frame, line, segment)?;
                Some(a.lerp(b, share))
            }
            Self::Body(index) => {
                let (body, (place, turn)) =
                    (model.spec.bodies.get(index)?, frame.bodies.get(index)?);
                Some(*place + *turn * body.shape_offset_m)
            }
            Self::Skin { triangle, barycentric } => {
                let (skin, at) = (&model.spec.whale.as_ref()?.skin, frame.whale.as_ref()?);
                let corners = skin.triangles.get(triangle)?;
                let mut bones = Vec::new();
                pose(skin, at.position, at.orientation, &at.posture, &mut bones);
                Some(
                    corners
                        .iter()
                        .zip(barycentric)
                        .map(|(corner, share)| skin_vertex(skin, &bones, *corner as usize) * share)
                        .sum(),
                )
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::camera::View;
    use super::super::sample;
    use super::*;
    use endline_session::scene::Scene;

    const SIZE: DVec2 = DVec2::new(900.0, 700.0);

    #[test]
    fn what_is_clicked_where_it_is_drawn_is_what_is_picked() {
        let model = sample::model();
        let frame = sample::frame(&model);
        let camera = Camera::of_view(
            View::Side,
            &Scene::places_of(&model, &frame),
            None,
            13.0,
            SIZE.x / SIZE.y,
        );
        for at_m in [6.0, 15.3, 30.1] {
            let wanted = Picked::Rope { line: 0, at_m };
            let place = wanted.place(&model, &frame).unwrap();
            let beside = camera.project(place, SIZE).unwrap() + DVec2::new(2.0, 0.0);
            let Some(Picked::Rope { line: 0, at_m: found_m }) =
                pick(&model, &frame, &camera, beside, SIZE, false)
            else {
                panic!("rope at {at_m} m is not found")
            };
            assert!(
                (found_m - at_m).abs() < 3.0 * camera.metres_a_point(SIZE.y),
                "{found_m} for {at_m}"
            );
        }
        let buoy = camera.project(frame.bodies[1].0, SIZE).unwrap();
        assert_eq!(pick(&model, &frame, &camera, buoy, SIZE, true), Some(Picked::Body(1)));
        assert_eq!(
            pick(&model, &frame, &camera, DVec2::new(5.0, SIZE.y / 2.0), SIZE, true),
            None,
            "open water"
        );
    }

    #[test]
    fn the_near_side_of_the_skin_is_picked_and_its_place_lies_on_the_ray() {
        let model = sample::model();
        let frame = sample::frame(&model);
        let at = frame.whale.as_ref().unwrap();
        let camera = Camera::of_view(View::WhaleSide, &[], Some(at), 13.0, SIZE.x / SIZE.y);
        let middle = SIZE / 2.0 + DVec2::new(11.0, -3.0);
        let Some(picked @ Picked::Skin { .. }) = pick(&model, &frame, &camera, middle, SIZE, true)
        else {
            panic!("the whale fills the picture")
        };
        let place = picked.place(&model, &frame).unwrap();
        assert!(
            (camera.project(place, SIZE).unwrap() - middle).length() < 1e-6,
            "under the pointer"
        );
        assert!(
            (place - camera.eye()).length() < (at.position - camera.eye()).length(),
            "not on its far side"
        );
        assert_eq!(
            pick(&model, &frame, &camera, middle, SIZE, false),
            None,
            "a whale that is not shown is not read"
        );
    }

    #[test]
    fn lengths_along_a_line_are_found_again() {
        let model = sample::model();
        let frame = sample::frame(&model);
        assert!((length_m(&model, &frame, 0) - 36.0).abs() < 1e-9);
        let (segment, share) = on_line(&model, &frame, 0, 36.0 * 12.25 / 60.0).unwrap();
        assert!(segment == 12 && (share - 0.25).abs() < 1e-9, "{segment} {share}");
        assert_eq!(on_line(&model, &frame, 7, 1.0), None);
    }
}
