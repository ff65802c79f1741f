//! What stands under the pointer: a place on a rope, a body, a place on the whale's skin, or a place where rope or a body presses on skin.
//!
//! Ropes, marks and arrows are thin, so they are found by their distance on screen; bodies and skin by the ray from the eye,
//! x(t) = e + t d. What is nearer to the eye counts, but rope wins over the skin that it lies on.

mod line;
pub mod press;
mod solid;

use endline_session::scene::Show;
use endline_sim::whale::{pose, skin_vertex};
use endline_sim::{Frame, Model};
use glam::{DVec2, DVec3};

pub use line::{along_m, ends, length_m, on_line};

use super::camera::Camera;

/// How far beside a rope the pointer may be, and how large a small body is taken to be [points].
const NEAR: f64 = 7.0;
/// How near to a place of contact the pointer must be for it to win over the rope that presses there [points].
const ON_MARK: f64 = 3.0;
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
    /// A place at which a line presses on skin.
    RopeOnSkin {
        /// Index of the line.
        line: usize,
        /// Unstretched rope from its first end [m].
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

/// The ray from the eye through the pointer, and the picture that the pointer is in.
struct Sight<'a> {
    eye: DVec3,
    along: DVec3,
    camera: &'a Camera,
    at: DVec2,
    size: DVec2,
}

impl Sight<'_> {
    /// How far a place is from the eye, along the ray [m].
    fn away_m(&self, place: DVec3) -> f64 {
        (place - self.eye).dot(self.along).max(0.0)
    }

    /// Length that one point spans so far from the eye [m].
    fn metres_a_point(&self, away_m: f64) -> f64 {
        self.camera.metres_a_point(self.size.y) * away_m / self.camera.distance_m
    }
}

/// Something thin near the pointer.
#[derive(Clone, Copy)]
struct Thin {
    /// Beside the pointer [points].
    beside: f64,
    /// From the eye [m].
    away_m: f64,
    picked: Picked,
}

/// What stands at a place of a picture of `size` [points], of what is shown; `None` in open water.
#[must_use]
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
    let body = solid::body(model, frame, &sight);
    let skin = if show.whale { solid::skin(model, frame, &sight) } else { None };
    let far = |hit: Option<(f64, Picked)>| hit.map_or(f64::INFINITY, |(away_m, _)| away_m);
    let is_before = |thin: &Thin| thin.away_m < far(body) && thin.away_m < far(skin) + BEHIND_M;
    let rope = line::rope(model, frame, &sight).filter(is_before);
    let press = press::press(model, frame, &sight, show).filter(is_before);
    let beside = |thin: Option<Thin>| thin.map_or(f64::INFINITY, |thin| thin.beside);
    let on_mark = beside(press) <= ON_MARK || beside(press) < beside(rope);
    let thin = press.filter(|_| on_mark).or(rope);
    let solid = if far(body) < far(skin) { body } else { skin };
    thin.map(|thin| thin.picked).or(solid.map(|(_, picked)| picked))
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
                press::rope_on_skin(model, frame, line, at_m).map(|contact| contact.position)
            }
            Self::BodyOnSkin { body, triangle } => {
                press::body_on_skin(frame, body, triangle).map(|contact| contact.position)
            }
        }
    }
}

#[cfg(test)]
mod tests;
