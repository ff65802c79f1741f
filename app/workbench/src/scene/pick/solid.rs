//! Bodies and skin that a ray from the eye meets.

use endline_sim::whale::{pose, skin_all};
use endline_sim::{Frame, Model};
use glam::DVec3;

use super::{NEAR, Picked, Sight};

/// Skin lies no farther than this from the whale's middle, as a share of its length.
const WHALE_REACH: f64 = 0.8;

/// The nearest body that the ray meets. One that is small on screen is taken as if it were larger, so that it can be hit.
pub(super) fn body(model: &Model, frame: &Frame, sight: &Sight<'_>) -> Option<(f64, Picked)> {
    let pairs = model.spec.bodies.iter().zip(&frame.bodies).enumerate();
    let hits = pairs.filter_map(|(index, (body, at))| {
        let least_m = 0.5 * NEAR * sight.metres_a_point(sight.away_m(at.0));
        let away_m = body.met_by_ray(*at, (sight.eye, sight.along), least_m)?;
        Some((away_m, Picked::Body(index)))
    });
    hits.min_by(|a, b| a.0.total_cmp(&b.0))
}

/// The nearest triangle of skin that the ray meets (Möller and Trumbore 1997).
pub(super) fn skin(model: &Model, frame: &Frame, sight: &Sight<'_>) -> Option<(f64, Picked)> {
    let (whale, at) = (model.spec.whale.as_ref()?, frame.whale.as_ref()?);
    let skin = &whale.skin;
    let aside = (at.position - sight.eye).cross(sight.along).length();
    if aside > WHALE_REACH * whale.length_m {
        return None;
    }
    let (mut bones, mut places) = (Vec::new(), Vec::new());
    pose(skin, at.position, at.orientation, &at.posture, &mut bones);
    skin_all(skin, &bones, &mut places);
    let hits = skin.triangles.iter().enumerate().filter_map(|(triangle, corners)| {
        let (away_m, barycentric) = meets(sight, corners.map(|corner| places[corner as usize]))?;
        Some((away_m, Picked::Skin { triangle, barycentric }))
    });
    hits.min_by(|a, b| a.0.total_cmp(&b.0))
}

/// How far away a ray meets a triangle [m], and the shares of its corners there.
fn meets(sight: &Sight<'_>, [a, b, c]: [DVec3; 3]) -> Option<(f64, [f64; 3])> {
    let (ab, ac, from) = (b - a, c - a, sight.eye - a);
    let across = sight.along.cross(ac);
    let det = ab.dot(across);
    if det.abs() < 1e-14 {
        return None;
    }
    let of_b = from.dot(across) / det;
    let turned = from.cross(ab);
    let (of_c, away_m) = (sight.along.dot(turned) / det, ac.dot(turned) / det);
    let inside = of_b >= 0.0 && of_c >= 0.0 && of_b + of_c <= 1.0 && away_m > 0.0;
    inside.then_some((away_m, [1.0 - of_b - of_c, of_b, of_c]))
}
