//! A frame as plain data: triangles with colours, made from a model and a frame.
//!
//! This module does not draw. The program's 3-D view draws these triangles, and
//! [`export::model`](crate::export::model) writes them to files.

pub mod bodies;
pub mod colour;
pub mod forces;
pub mod mesh;
pub mod obstacles;
pub mod rope;
pub mod sea;
pub mod whale;

use endline_sim::model::Whale;
use endline_sim::{DAffine3, Frame, Model};
use glam::DVec3;

use mesh::Mesh;

/// How a part is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Look {
    /// Lit from above, solid.
    Solid,
    /// Its own colour, hardly shaded, to be read against a scale.
    Own,
    /// Seabed: grid lines at this distance, both ways.
    Seabed {
        /// Distance between lines [m]; 0 for none.
        grid_m: f32,
    },
    /// Sea surface: see-through, brighter at a flat angle, seen from both sides; grid lines at this distance, both ways.
    Surface {
        /// Distance between lines [m]; 0 for none.
        grid_m: f32,
    },
    /// Laid rope in its own colours, with a dark edge; its grain is the place along it [m] and the direction round it.
    Rope,
    /// Wet, mottled skin; its grain sticks to the body at rest.
    Skin,
}

/// Triangles with one appearance.
#[derive(Clone, Debug)]
pub struct Part {
    /// What it is: `seabed`, `obstacles`, `whale`, `eyes`, `ropes`, `weak places`, `bodies`, `current`, `marks`, `forces`, `surface`; heads of arrows apart.
    pub name: &'static str,
    /// How it is drawn.
    pub look: Look,
    /// Least half width on screen of a shape about a centre line [px].
    pub least_px: f32,
    /// The triangles.
    pub mesh: Mesh,
}

/// All that is to be seen at one moment, as plain data.
#[derive(Clone, Debug)]
pub struct Scene {
    /// Parts in the order of drawing: solid first, see-through last.
    pub parts: Vec<Part>,
    /// Box round gear and whale [m].
    pub bounds: Bounds,
    /// Tension at the top of the colour scale [N].
    pub scale_n: f64,
    /// Simulated time [s].
    pub time_s: f64,
    /// Height of the sea surface above the seabed under the gear [m].
    pub depth_m: f64,
    /// Path of the water since the start of the run [m], along which particles in it drift.
    pub drift_m: DVec3,
    /// Whether it is drawn for a film ([`Show::film`]).
    pub film: bool,
}

/// Choices of the parts shown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Show {
    /// Tension at the top of the colour scale [N]; the frame's own peak where `None`.
    pub scale_n: Option<f64>,
    /// Sea surface.
    pub surface: bool,
    /// Seabed.
    pub seabed: bool,
    /// Arrows of the current.
    pub current: bool,
    /// Marks where rope presses on skin.
    pub contacts: bool,
    /// Arrows of its force on the skin.
    pub forces: bool,
    /// The whale.
    pub whale: bool,
    /// Names of buoys, traps and anchors that appear small, written over the scene.
    pub names: bool,
    /// A picture for films and print: no marks, lines, scales or text; rope in its own colours; particles and shafts of light in the
    /// water.
    pub film: bool,
}

impl Show {
    /// The choices that apply: a film has no marks, arrows and names.
    pub fn effective(self) -> Self {
        let measures = !self.film;
        Self {
            current: self.current && measures,
            contacts: self.contacts && measures,
            forces: self.forces && measures,
            names: self.names && measures,
            ..self
        }
    }
}

impl Default for Show {
    fn default() -> Self {
        Self {
            scale_n: None,
            surface: true,
            seabed: true,
            current: true,
            contacts: true,
            forces: false,
            whale: true,
            names: true,
            film: false,
        }
    }
}

impl Scene {
    /// The scene of a frame of a model.
    pub fn of(model: &Model, frame: &Frame, show: &Show) -> Self {
        let show = show.effective();
        let bounds = bounds(&Self::places_of(model, frame));
        let scale_n = show
            .scale_n
            .unwrap_or_else(|| frame.tension_n.iter().copied().fold(0.0, f64::max))
            .max(1.0);
        let [skin, eyes] = whale::skin_and_eyes(model, frame);
        let [current, current_heads] = sea::current(model);
        let [shafts, force_heads] = forces::forces(frame);
        let tinted = (!show.film).then_some(scale_n);
        let mut parts = Vec::new();
        let mut add = |wanted: bool, name, look, least_px, mesh: Mesh| {
            if wanted && !mesh.triangles.is_empty() {
                parts.push(Part { name, look, least_px, mesh });
            }
        };
        let grid_m = if show.film { 0.0 } else { 10.0 };
        add(show.seabed, "seabed", Look::Seabed { grid_m }, 0.0, sea::seabed(model, &bounds));
        add(true, "obstacles", Look::Solid, 0.0, obstacles::obstacles(model));
        add(show.whale, "whale", Look::Skin, 0.0, skin);
        add(show.whale, "eyes", Look::Solid, 0.0, eyes);
        add(true, "ropes", Look::Rope, 1.4, rope::lines(model, frame, tinted));
        add(!show.film, "weak places", Look::Own, 4.0, rope::weak_places(model, frame));
        add(true, "bodies", Look::Solid, 0.8, bodies::bodies(model, frame));
        add(show.current, "current", Look::Own, 0.8, current);
        add(show.current, "current heads", Look::Own, 5.0, current_heads);
        add(show.contacts, "marks", Look::Own, 4.0, forces::contacts(frame));
        add(show.forces, "forces", Look::Own, 1.0, shafts);
        add(show.forces, "force heads", Look::Own, 9.0, force_heads);
        add(show.surface, "surface", Look::Surface { grid_m }, 0.0, sea::surface(model, &bounds));
        let water = &model.spec.water;
        let drift_m = water.current.surface_m_s * frame.time_s;
        let Show { film, .. } = show;
        Self { parts, bounds, scale_n, time_s: frame.time_s, depth_m: water.depth_m, drift_m, film }
    }

    /// Places that together show gear and whale: rope nodes, bodies, a box round the whale [m].
    pub fn places_of(model: &Model, frame: &Frame) -> Vec<DVec3> {
        let pair = model.spec.whale.as_ref().zip(frame.whale.as_ref());
        let whale = pair
            .into_iter()
            .flat_map(|(whale, at)| whale_corners(whale, at.position, at.orientation));
        let shapes = model.spec.bodies.iter().zip(&frame.bodies);
        let bodies = shapes
            .flat_map(|(body, (place, turn))| body.corners().map(|corner| *place + *turn * corner));
        frame
            .nodes
            .iter()
            .copied()
            .chain(bodies)
            .chain(whale)
            .filter(|place| place.is_finite())
            .collect()
    }

    /// A part by its name.
    pub fn part(&self, name: &str) -> Option<&Part> {
        self.parts.iter().find(|part| part.name == name)
    }
}

/// Box round gear and whale.
fn bounds(places: &[DVec3]) -> Bounds {
    let mut bounds = Bounds::of(places.iter().copied());
    // A little air round small gear, so that a lone trap does not fill the picture.
    let least = DVec3::splat(1.0);
    let (centre, half) = (bounds.centre(), bounds.half_size().max(least));
    bounds.low = centre - half;
    bounds.high = centre + half;
    bounds
}

/// Corners of a box round a whale: half its length fore and aft, a quarter to each side.
fn whale_corners(whale: &Whale, position: DVec3, orientation: endline_sim::DQuat) -> [DVec3; 8] {
    let half = DVec3::new(0.52, 0.25, 0.15) * whale.length_m;
    let pose = DAffine3::from_rotation_translation(orientation, position);
    Bounds { low: -half, high: half }.corners().map(|corner| pose.transform_point3(corner))
}

/// An axis-aligned box [m].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// Least corner.
    pub low: DVec3,
    /// Greatest corner.
    pub high: DVec3,
}

impl Bounds {
    /// The least box round some places; a small box at the origin where there are none.
    pub fn of(places: impl IntoIterator<Item = DVec3>) -> Self {
        let empty = Self { low: DVec3::INFINITY, high: DVec3::NEG_INFINITY };
        let all = places.into_iter().filter(|place| place.is_finite());
        let bounds = all.fold(empty, |bounds, place| Self {
            low: bounds.low.min(place),
            high: bounds.high.max(place),
        });
        if bounds.low.x > bounds.high.x {
            Self { low: -DVec3::ONE, high: DVec3::ONE }
        } else {
            bounds
        }
    }

    /// Its middle [m].
    pub fn centre(&self) -> DVec3 {
        (self.low + self.high) * 0.5
    }

    /// Half its edges [m].
    pub fn half_size(&self) -> DVec3 {
        (self.high - self.low) * 0.5
    }

    /// Its eight corners [m].
    pub fn corners(&self) -> [DVec3; 8] {
        std::array::from_fn(|corner| {
            let pick = |bit: usize, low: f64, high: f64| if corner & bit == 0 { low } else { high };
            DVec3::new(
                pick(1, self.low.x, self.high.x),
                pick(2, self.low.y, self.high.y),
                pick(4, self.low.z, self.high.z),
            )
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_that_are_not_finite_do_not_stretch_the_box() {
        let bounds = Bounds::of([DVec3::ZERO, DVec3::NAN, DVec3::new(2.0, 4.0, -6.0)]);
        assert_eq!(
            bounds,
            Bounds { low: DVec3::new(0.0, 0.0, -6.0), high: DVec3::new(2.0, 4.0, 0.0) }
        );
        assert!(bounds.corners().contains(&DVec3::new(2.0, 0.0, -6.0)));
    }

    #[test]
    fn nothing_has_a_small_box() {
        assert_eq!(Bounds::of([]).half_size(), DVec3::ONE);
    }
}
