//! Picking: finds the thing under the pointer, which is a place on a rope, a body, a place on the whale's skin, or a contact with skin.
//!
//! Ropes, marks and arrows are thin and found by their distance on screen; bodies and skin by the ray from the eye, x(t) = e + t d. The
//! thing nearest to the eye is picked, but rope takes precedence over the skin that it touches.

use endline_session::scene::Show;
use endline_session::scene::forces::{Presser, SkinForce, greatest_n, on_skin};
use endline_sim::contact::ContactPoint;
use endline_sim::contact::body_on_skin::BodyContact;
use endline_sim::whale::{pose, skin_all, skin_vertex};
use endline_sim::{Frame, Model};
use glam::{DVec2, DVec3};

use crate::scene::camera::Camera;

/// Greatest distance of the pointer to a rope, and least size of a body for picking [points].
const NEAR_PT: f64 = 7.0;
/// Distance to a contact below which it takes precedence over the rope that presses there [points].
const ON_MARK: f64 = 3.0;
/// Greatest depth of a rope behind the visible skin: for rope pressed in, or seen at a flat angle [m].
const BEHIND_M: f64 = 0.15;

/// A picked thing; it is stored relative to the thing, so that it moves with it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Picked {
    /// A place on a line.
    Rope {
        /// Index of the line.
        line: usize,
        /// Unstretched length from its first end [m].
        at_m: f64,
    },
    /// A body by its index.
    Body(usize),
    /// A place on the whale.
    Skin {
        /// Index of the skin's triangle.
        triangle: usize,
        /// Barycentric coordinates.
        barycentric: [f64; 3],
    },
    /// A place at which a line presses on skin.
    RopeOnSkin {
        /// Index of the line.
        line: usize,
        /// Unstretched length from its first end [m].
        at_m: f64,
    },
    /// A place at which a body presses on skin.
    BodyOnSkin {
        /// Index of the body.
        body: usize,
        /// Index of the skin's triangle.
        triangle: usize,
    },
}

/// The ray from the eye through the pointer, and the picture with the pointer.
struct Sight<'a> {
    eye: DVec3,
    along: DVec3,
    camera: &'a Camera,
    at: DVec2,
    size: DVec2,
}

impl Sight<'_> {
    /// Distance of a place from the eye along the ray [m].
    fn away_m(&self, place: DVec3) -> f64 {
        (place - self.eye).dot(self.along).max(0.0)
    }

    /// Length of one point at a distance from the eye [m].
    fn metres_a_point(&self, away_m: f64) -> f64 {
        self.camera.metres_a_point(self.size.y) * away_m / self.camera.distance_m
    }
}

/// A thin thing near the pointer.
#[derive(Clone, Copy)]
struct Thin {
    /// Distance to the pointer [points].
    beside: f64,
    /// Distance from the eye [m].
    away_m: f64,
    picked: Picked,
}

/// Picks the visible thing at a point of a picture of `size` [points]; `None` in open water.
pub fn pick(
    model: &Model,
    frame: &Frame,
    camera: &Camera,
    at: DVec2,
    size: DVec2,
    show: &Show,
) -> Option<Picked> {
    let (eye, along) = camera.ray(at, size);
    let sight = Sight { eye, along, camera, at, size };
    let body = body_under(model, frame, &sight);
    let skin = if show.whale { skin_under(model, frame, &sight) } else { None };
    let far = |hit: Option<(f64, Picked)>| hit.map_or(f64::INFINITY, |(away_m, _)| away_m);
    let is_before = |thin: &Thin| thin.away_m < far(body) && thin.away_m < far(skin) + BEHIND_M;
    let rope = rope_under(model, frame, &sight).filter(is_before);
    let press = press_under(model, frame, &sight, show).filter(is_before);
    let beside = |thin: Option<Thin>| thin.map_or(f64::INFINITY, |thin| thin.beside);
    let on_mark = beside(press) <= ON_MARK || beside(press) < beside(rope);
    let thin = press.filter(|_| on_mark).or(rope);
    let solid = if far(body) < far(skin) { body } else { skin };
    thin.map(|thin| thin.picked).or(solid.map(|(_, picked)| picked))
}

impl Picked {
    /// Position in a frame [m]; `None` if the frame has no such thing.
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
                Some(*place + *turn * body.middle_m())
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
            Self::RopeOnSkin { line, at_m } => {
                rope_on_skin(model, frame, line, at_m).map(|contact| contact.position)
            }
            Self::BodyOnSkin { body, triangle } => {
                body_on_skin(frame, body, triangle).map(|contact| contact.position)
            }
        }
    }
}

/// The rope nearest to the pointer on screen, within reach.
fn rope_under(model: &Model, frame: &Frame, sight: &Sight<'_>) -> Option<Thin> {
    let mut best: Option<Thin> = None;
    for (line, segments) in model.line_segments.iter().enumerate() {
        let (first, mut before_m) = (model.line_nodes[line].start, 0.0);
        for (order, segment) in segments.clone().enumerate() {
            let length_m = *frame.segment_length_m.get(segment)?;
            let ends = [*frame.nodes.get(first + order)?, *frame.nodes.get(first + order + 1)?];
            let whole = !frame.cut.get(segment).copied().unwrap_or(false);
            if let Some((beside, share)) = sight.beside(ends).filter(|_| whole)
                && beside <= NEAR_PT
                && best.is_none_or(|best| beside < best.beside)
            {
                let away_m = sight.away_m(ends[0].lerp(ends[1], share));
                let picked = Picked::Rope { line, at_m: before_m + share * length_m };
                best = Some(Thin { beside, away_m, picked });
            }
            before_m += length_m;
        }
    }
    best
}

/// Segment, and share of it, at an unstretched length from the first end of a line; `None` if there is no such line.
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

/// Unstretched length from the first end of a line to a share of one of its segments [m].
pub fn along_m(
    model: &Model,
    frame: &Frame,
    line: usize,
    segment: usize,
    share: f64,
) -> Option<f64> {
    let first = model.line_segments.get(line)?.start;
    let before = frame.segment_length_m.get(first..segment)?.iter().sum::<f64>();
    Some(before + share * frame.segment_length_m.get(segment)?)
}

/// Both ends of a segment of a line [m].
pub fn ends(model: &Model, frame: &Frame, line: usize, segment: usize) -> Option<[DVec3; 2]> {
    let first = model.line_nodes.get(line)?.start
        + segment.checked_sub(model.line_segments.get(line)?.start)?;
    Some([*frame.nodes.get(first)?, *frame.nodes.get(first + 1)?])
}

/// Unstretched length of a line [m].
pub fn length_m(model: &Model, frame: &Frame, line: usize) -> f64 {
    model
        .line_segments
        .get(line)
        .and_then(|segments| frame.segment_length_m.get(segments.clone()))
        .map_or(0.0, |all| all.iter().sum())
}

impl Sight<'_> {
    /// Distance of the pointer to a straight line between two places on screen [points], and the share of the line at its nearest point;
    /// `None` behind the eye.
    fn beside(&self, ends: [DVec3; 2]) -> Option<(f64, f64)> {
        let [a, b] = ends.map(|end| self.camera.project(end, self.size));
        let (a, b): (DVec2, DVec2) = (a?, b?);
        let share =
            ((self.at - a).dot(b - a) / (b - a).length_squared().max(1e-12)).clamp(0.0, 1.0);
        Some(((a + (b - a) * share - self.at).length(), share))
    }
}

/// Greatest distance of the pointer to an arrow or mark [points].
const REACH: f64 = 5.0;
/// Distance along a line within which a contact is still the same one [m].
const SAME_M: f64 = 0.5;

/// The mark or arrow nearest to the pointer on screen, of those shown and within reach.
fn press_under(model: &Model, frame: &Frame, sight: &Sight<'_>, show: &Show) -> Option<Thin> {
    let greatest_n = greatest_n(frame);
    let hits = on_skin(frame).filter_map(|force: SkinForce| {
        let shaft = force.shaft(greatest_n).filter(|_| show.forces);
        if shaft.is_none() && !show.contacts {
            return None;
        }
        let ends = [force.place, force.place - shaft.unwrap_or_default()];
        let (beside, share) = sight.beside(ends).filter(|(beside, _)| *beside <= REACH)?;
        let away_m = sight.away_m(ends[0].lerp(ends[1], share));
        Some(Thin { beside, away_m, picked: picked(model, frame, force.of)? })
    });
    hits.min_by(|one, other| one.beside.total_cmp(&other.beside))
}

fn picked(model: &Model, frame: &Frame, of: Presser) -> Option<Picked> {
    match of {
        Presser::Rope(index) => {
            let contact = frame.contacts.get(index)?;
            let at_m = contact_m(model, frame, contact)?;
            Some(Picked::RopeOnSkin { line: contact.line, at_m })
        }
        Presser::Body(index) => {
            let contact = frame.body_contacts.get(index)?;
            Some(Picked::BodyOnSkin { body: contact.body, triangle: contact.triangle })
        }
    }
}

/// Unstretched length from the first end of its line to a contact [m].
pub fn contact_m(model: &Model, frame: &Frame, contact: &ContactPoint) -> Option<f64> {
    along_m(model, frame, contact.line, contact.segment, contact.fraction)
}

/// The contact of a line with skin nearest to a length along it; `None` if there is none near.
pub fn rope_on_skin<'a>(
    model: &Model,
    frame: &'a Frame,
    line: usize,
    at_m: f64,
) -> Option<&'a ContactPoint> {
    let mine = frame.contacts.iter().filter(|it| it.line == line && it.normal_force_n > 0.0);
    let away = mine.filter_map(|it| Some(((contact_m(model, frame, it)? - at_m).abs(), it)));
    let nearest = away.min_by(|one, other| one.0.total_cmp(&other.0));
    nearest.filter(|(away_m, _)| *away_m <= SAME_M).map(|(_, contact)| contact)
}

/// The contact of a body with a triangle of skin, or else its contact with the largest force.
pub fn body_on_skin(frame: &Frame, body: usize, triangle: usize) -> Option<&BodyContact> {
    let mine = frame.body_contacts.iter().filter(|it| it.body == body && it.normal_force_n > 0.0);
    mine.max_by(|one, other| {
        let rank = |it: &BodyContact| (it.triangle == triangle, it.normal_force_n);
        let (one, other) = (rank(one), rank(other));
        one.0.cmp(&other.0).then(one.1.total_cmp(&other.1))
    })
}

/// Greatest distance of skin from the middle of the whale, as a share of its length.
const WHALE_REACH: f64 = 0.8;

/// The nearest body on the ray. A body that is small on screen is enlarged, so that it can be picked.
fn body_under(model: &Model, frame: &Frame, sight: &Sight<'_>) -> Option<(f64, Picked)> {
    let pairs = model.spec.bodies.iter().zip(&frame.bodies).enumerate();
    let hits = pairs.filter_map(|(index, (body, at))| {
        let least_m = 0.5 * NEAR_PT * sight.metres_a_point(sight.away_m(at.0));
        let away_m = body.met_by_ray(*at, (sight.eye, sight.along), least_m)?;
        Some((away_m, Picked::Body(index)))
    });
    hits.min_by(|a, b| a.0.total_cmp(&b.0))
}

/// The nearest triangle of skin on the ray (Möller and Trumbore 1997).
fn skin_under(model: &Model, frame: &Frame, sight: &Sight<'_>) -> Option<(f64, Picked)> {
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
        let (away_m, barycentric) = hit(sight, corners.map(|corner| places[corner as usize]))?;
        Some((away_m, Picked::Skin { triangle, barycentric }))
    });
    hits.min_by(|a, b| a.0.total_cmp(&b.0))
}

/// Distance at which a ray hits a triangle [m], and the barycentric coordinates.
fn hit(sight: &Sight<'_>, [a, b, c]: [DVec3; 3]) -> Option<(f64, [f64; 3])> {
    let (ab, ac, from) = (b - a, c - a, sight.eye - a);
    let across = sight.along.cross(ac);
    let det = ab.dot(across);
    if det.abs() < 1e-14 {
        return None;
    }
    let of_b = from.dot(across) / det;
    let cross = from.cross(ab);
    let (of_c, away_m) = (sight.along.dot(cross) / det, ac.dot(cross) / det);
    let inside = of_b >= 0.0 && of_c >= 0.0 && of_b + of_c <= 1.0 && away_m > 0.0;
    inside.then_some((away_m, [1.0 - of_b - of_c, of_b, of_c]))
}
