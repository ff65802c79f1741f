//! A wrap: taut rope about the sections of a body part, and the search for the azimuth at which it begins.
//!
//! A section is the cut of the skin by the plane across the part's axis. Taut rope lies on the convex
//! hull of the section, at a distance `h`. Where the skin faces along the unit vector `o(phi)`, the rope
//! is at `x(phi) = argmax_x (x . o) + h o`, with `x` over the cut. The *azimuth* `phi` is the direction
//! in which the skin faces. It is counted from the whale's back about the axis, which runs from the snout or the
//! root; the rope's direction is perpendicular to `o`. With `n` turns (negative for left-handed)
//!
//! ```text
//! phi(t) = phi_0 + 2 pi n t,    t from 0 to 1
//! ```
//!
//! rope turns by exactly `n` on a drum and on a thin blade: each edge of a blade takes half a turn, its faces none. At both
//! ends the rope continues straight for a short length, so that it leaves along a tangent. The
//! place along the axis is `s = s_m + p |n| (c - 1/2)` with the pitch `p` and the share `c` of the
//! path. Slack `e` is added to `h`, so that the path is `1 + e` times the tight one.
//!
//! # Azimuth
//!
//! The path sections between wraps should be short, outside the skin, and with small bends at the wraps, because a bend
//! changes the turns of the wrap. The cost of a path section is its length, plus [`THROUGH_M`] if it passes through skin,
//! plus up to [`BACK_M`] for its bends. A beam search from wrap to wrap keeps the paths of lowest cost.

use std::f64::consts::TAU;

use endline_sdk::BodyPart;
use endline_sim::DVec3;
use endline_sim::model::Rope;

use crate::assemble::line_shapes::length;
use crate::scenario::WrapOf;

use super::skin::{Outline, PosedSkin};
use super::{PathSection, way};

/// Places per turn of a wrap.
const EACH_TURN: f64 = 240.0;
/// Default pitch, in rope diameters.
const USUAL_PITCH: f64 = 5.0;
/// Default longest segments on the trunk and on fins [m].
const USUAL_SEGMENTS_M: [f64; 2] = [0.05, 0.02];
/// Straight segments at each end of a wrap: a shift of the inner one does not affect the outer one.
const STRAIGHT_ON: f64 = 2.0;

/// A wrap to be laid.
pub(super) struct Helix<'a> {
    /// The wrap as written.
    pub wrap: &'a WrapOf,
    pitch_m: f64,
    fine_m: f64,
}

/// The section at a place along the axis.
struct Section {
    outline: Outline,
    /// Directions along the axis, away from snout or root, and towards the whale's back.
    onward: DVec3,
    back: DVec3,
}

impl<'a> Helix<'a> {
    /// The wrap with its own pitch and segments, or the defaults.
    pub fn of(wrap: &'a WrapOf, rope: &Rope) -> Self {
        let fine_m = wrap.segment_m.unwrap_or(USUAL_SEGMENTS_M[usize::from(!wrap.part.on_trunk())]);
        Self { wrap, pitch_m: wrap.pitch_m.unwrap_or(USUAL_PITCH * rope.diameter_m), fine_m }
    }

    /// The path from an azimuth.
    pub fn lay(&self, skin: &PosedSkin, azimuth: f64) -> Result<Vec<DVec3>, String> {
        let tight = self.way(skin, azimuth, 0.0)?;
        if self.wrap.slack <= 0.0 {
            return Ok(tight);
        }
        let wanted = (1.0 + self.wrap.slack) * length(&tight);
        // A loop at a distance h is 2 pi h longer; two corrections account for the pitch.
        let (mut off, mut way) = (0.0, tight);
        for _ in 0..3 {
            off += (wanted - length(&way)) / (TAU * self.wrap.turns.abs());
            way = self.way(skin, azimuth, off)?;
        }
        Ok(way)
    }

    /// Ends of the wrap from an azimuth, with the direction of the rope.
    pub fn ends(&self, skin: &PosedSkin, azimuth: f64) -> Result<[(DVec3, DVec3); 2], String> {
        let (first, last) = (self.section(skin, 0.0, 0.0)?, self.section(skin, 1.0, 1.0)?);
        let end = |section: &Section, azimuth: f64, sense: f64| {
            let way = section.way(azimuth);
            (
                section.place(azimuth, skin.off_m) + way * self.on_m(sense),
                way * self.wrap.turns.signum(),
            )
        };
        Ok([end(&first, azimuth, -1.0), end(&last, azimuth + TAU * self.wrap.turns, 1.0)])
    }

    /// The path section of the wrap, stretched by its pretension.
    pub fn section_of(&self, way: Vec<DVec3>, rope: &Rope) -> PathSection {
        let rope_m = length(&way) / (1.0 + strain(rope, self.wrap.pretension_n));
        PathSection { way, rope_m: Some(rope_m), fine_m: Some(self.fine_m) }
    }

    /// Signed length of the straight continuation before (-1) or after (1) the wrap, along rising azimuth [m].
    fn on_m(&self, sense: f64) -> f64 {
        sense * self.wrap.turns.signum() * STRAIGHT_ON * self.fine_m
    }

    /// Places along the path at an additional distance `off_m`.
    fn way(&self, skin: &PosedSkin, start: f64, off_m: f64) -> Result<Vec<DVec3>, String> {
        let off_m = skin.off_m + off_m;
        let count = (EACH_TURN * self.wrap.turns.abs()).ceil().max(2.0);
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "at most some thousands"
        )]
        let turned: Vec<f64> = (0..=count as u32).map(|number| f64::from(number) / count).collect();
        let azimuth = |turned: f64| start + TAU * self.wrap.turns * turned;
        let middle = self.section(skin, 0.5, 0.5)?;
        let flat: Vec<DVec3> =
            turned.iter().map(|turned| middle.place(azimuth(*turned), off_m)).collect();
        let (round_m, mut done_m) = (length(&flat), 0.0);
        let slope = self.pitch_m * self.wrap.turns.abs() / round_m;
        let mut way = Vec::with_capacity(turned.len() + 2);
        for (number, turned) in turned.iter().enumerate() {
            done_m += if number == 0 { 0.0 } else { flat[number].distance(flat[number - 1]) };
            let section = self.section(skin, done_m / round_m, *turned)?;
            let (place, azimuth) = (section.place(azimuth(*turned), off_m), azimuth(*turned));
            let on = |sense: f64| {
                place
                    + section.way(azimuth) * self.on_m(sense)
                    + section.onward * (slope * sense * STRAIGHT_ON * self.fine_m)
            };
            if number == 0 {
                way.push(on(-1.0));
            }
            way.push(place);
            if *turned >= 1.0 {
                way.push(on(1.0));
            }
        }
        Ok(way)
    }

    /// The section at a share `done` of the path, after a share `turned` of the turns.
    fn section(&self, skin: &PosedSkin, done: f64, turned: f64) -> Result<Section, String> {
        let wrap = self.wrap;
        let (axis, reach) = skin
            .axis(wrap.part)
            .ok_or_else(|| format!("this whale has no {}", wrap.part.name()))?;
        let station =
            wrap.station + self.pitch_m * wrap.turns.abs() * (done - 0.5) / (reach[1] - reach[0]);
        let found = axis.at(along(*reach, wrap.part, station)).and_then(|spot| {
            let onward = if wrap.part.on_trunk() { -spot.along() } else { spot.along() };
            let back = (skin.up - onward * skin.up.dot(onward)).try_normalize()?;
            let outline = skin.outline(wrap.part, spot.middle, onward);
            (!outline.is_empty()).then_some(Section { outline, onward, back })
        });
        let turned = wrap.turns * turned;
        found.ok_or_else(|| {
            format!("there is no skin of the {} after {turned:.2} turns", wrap.part.name())
        })
    }
}

impl Section {
    /// Outward direction of the skin at an azimuth.
    fn out(&self, azimuth: f64) -> DVec3 {
        self.back * libm::cos(azimuth) + self.onward.cross(self.back) * libm::sin(azimuth)
    }

    /// Direction of rising azimuth.
    fn way(&self, azimuth: f64) -> DVec3 {
        self.onward.cross(self.out(azimuth))
    }

    /// Place of the rope at a distance from the skin.
    fn place(&self, azimuth: f64, off_m: f64) -> DVec3 {
        let out = self.out(azimuth);
        self.outline.farthest(out) + out * off_m
    }
}

/// Strain at a tension: the positive root of `EA e + EA2 e^2 = T`.
fn strain(rope: &Rope, tension_n: f64) -> f64 {
    let (ea, ea2) = (rope.axial_stiffness_n, rope.axial_stiffening_n);
    2.0 * tension_n / (ea + libm::sqrt(ea * ea + 4.0 * ea2 * tension_n))
}

/// Place along the axis of the model, which points to the snout on the trunk.
fn along([least, most]: [f64; 2], part: BodyPart, station: f64) -> f64 {
    if part.on_trunk() { most + station * (least - most) } else { least + station * (most - least) }
}

/// Azimuths tried for each wrap.
const TRIED: u32 = 24;
/// Width of the beam, and number of returned lines.
const BEAM: usize = 12;
/// Distance of sample places on path sections [m].
const EACH_M: f64 = 0.1;
/// Cost of a path section through the whale [m].
const THROUGH_M: f64 = 100.0;
/// Cost of a reversal at a wrap; a smaller bend costs half its versed sine of it [m].
const BACK_M: f64 = 20.0;

/// Azimuths of the wraps of a line so far, and their cost.
#[derive(Clone)]
struct Line {
    azimuths: Vec<f64>,
    end: End,
    cost_m: f64,
}

/// An end of a wrap with the direction of the rope, or an end of the line.
type End = (DVec3, Option<DVec3>);

/// Azimuths of all wraps, the best first; `Err` is a wrap without skin, and the reason.
pub(super) fn azimuths(
    skin: &mut PosedSkin,
    helices: &[Helix<'_>],
    [from, to]: [DVec3; 2],
) -> Result<Vec<Vec<f64>>, (usize, String)> {
    let mut lines = vec![Line { azimuths: Vec::new(), end: (from, None), cost_m: 0.0 }];
    for (number, helix) in helices.iter().enumerate() {
        let tried: Vec<f64> = match helix.wrap.azimuth_rad {
            Some(azimuth) => vec![azimuth],
            None => (0..TRIED).map(|tried| TAU * f64::from(tried) / f64::from(TRIED)).collect(),
        };
        let mut longer = Vec::with_capacity(lines.len() * tried.len());
        for azimuth in tried {
            let [first, last] = helix
                .ends(skin, azimuth)
                .map_err(|what| (number, what))?
                .map(|(place, way)| (place, Some(way)));
            for line in &lines {
                let azimuths = line.azimuths.iter().copied().chain([azimuth]).collect();
                longer.push(Line {
                    azimuths,
                    end: last,
                    cost_m: line.cost_m + cost_m(skin, [line.end, first]),
                });
            }
        }
        lines = best(longer);
    }
    lines.iter_mut().for_each(|line| line.cost_m += cost_m(skin, [line.end, (to, None)]));
    Ok(best(lines).into_iter().map(|line| line.azimuths).collect())
}

fn best(mut lines: Vec<Line>) -> Vec<Line> {
    lines.sort_by(|one, other| one.cost_m.total_cmp(&other.cost_m));
    lines.truncate(BEAM);
    lines
}

/// Cost of the path section between two ends [m].
fn cost_m(skin: &mut PosedSkin, ends: [End; 2]) -> f64 {
    let way = way(skin, ends.map(|(place, _)| place), EACH_M);
    let through = skin.goes_through(&way);
    let straight = (ends[1].0 - ends[0].0).normalize_or_zero();
    let bends: f64 =
        ends.iter().filter_map(|(_, along)| Some(0.5 * (1.0 - straight.dot((*along)?)))).sum();
    length(&way) + BACK_M * bends + if through { THROUGH_M } else { 0.0 }
}
