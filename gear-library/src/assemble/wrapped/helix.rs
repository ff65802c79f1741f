//! A wrap: rope taut about the sections of a part, going along it as it goes round.
//!
//! A section is the cut of the skin by the plane across the part's axis. Taut rope lies on the convex
//! hull of the section, at a distance `h`. Where the skin faces along the unit vector `o(phi)`, the rope
//! is at `x(phi) = argmax_x (x . o) + h o`, with `x` over the cut. The *azimuth* `phi` is the direction
//! in which the skin faces. It is counted from the whale's back, about the axis from the snout or the
//! root on; the rope's own direction is square to `o`. With turns `n` (below zero left-handed)
//!
//! ```text
//! phi(t) = phi_0 + 2 pi n t,    t from 0 to 1
//! ```
//!
//! rope turns by exactly `n` on a drum and on a thin blade: the edges of a blade take half a turn each,
//! its faces none. At both ends rope goes straight on for a little, so that it leaves as a tangent. The
//! place along the axis is `s = s_m + p |n| (c - 1/2)`, where `p` is the pitch and `c` the share of the
//! way round that is done. Slack `e` adds to `h`, so that the way is `1 + e` times the tight one.

use std::f64::consts::TAU;

use endline_sdk::BodyPart;
use endline_sim::DVec3;
use endline_sim::model::Rope;

use crate::scenario::WrapOf;

use crate::assemble::way::length;

use super::skin::{Outline, PosedSkin};
use super::stretch::Stretch;

/// Places on each turn of a wrap.
const EACH_TURN: f64 = 240.0;
/// Pitch where none is given, in rope diameters.
const USUAL_PITCH: f64 = 5.0;
/// Longest segments about the trunk and about fins where a wrap names none [m].
const USUAL_SEGMENTS_M: [f64; 2] = [0.05, 0.02];
/// Segments that go straight on at each end of a wrap: moving the inner one clear of the skin leaves the outer as it is.
const STRAIGHT_ON: f64 = 2.0;

/// A wrap as it is laid.
pub(super) struct Helix<'a> {
    /// The wrap as written.
    pub wrap: &'a WrapOf,
    pitch_m: f64,
    fine_m: f64,
}

/// The section at a place along the axis.
struct Section {
    outline: Outline,
    /// Along the axis, from snout or root on, and towards the whale's back.
    onward: DVec3,
    back: DVec3,
}

impl<'a> Helix<'a> {
    /// The wrap with the pitch and segments that it names, or the usual ones.
    pub fn of(wrap: &'a WrapOf, rope: &Rope) -> Self {
        let fine_m = wrap.segment_m.unwrap_or(USUAL_SEGMENTS_M[usize::from(!wrap.part.on_trunk())]);
        Self { wrap, pitch_m: wrap.pitch_m.unwrap_or(USUAL_PITCH * rope.diameter_m), fine_m }
    }

    /// The way round that begins at an azimuth.
    pub fn lay(&self, skin: &PosedSkin, azimuth: f64) -> Result<Vec<DVec3>, String> {
        let tight = self.way(skin, azimuth, 0.0)?;
        if self.wrap.slack <= 0.0 {
            return Ok(tight);
        }
        let wanted = (1.0 + self.wrap.slack) * length(&tight);
        // A loop that stands off by h is 2 pi h longer; two corrections take in what the pitch adds.
        let (mut off, mut way) = (0.0, tight);
        for _ in 0..3 {
            off += (wanted - length(&way)) / (TAU * self.wrap.turns.abs());
            way = self.way(skin, azimuth, off)?;
        }
        Ok(way)
    }

    /// Where it begins and ends when it begins at an azimuth, and which way rope goes there.
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

    /// It as a stretch of rope: stretched by its pretension.
    pub fn stretch(&self, way: Vec<DVec3>, rope: &Rope) -> Stretch {
        let rope_m = length(&way) / (1.0 + strain(rope, self.wrap.pretension_n));
        Stretch { way, rope_m: Some(rope_m), fine_m: Some(self.fine_m) }
    }

    /// How far it goes straight on, along the way of growing azimuth, before (-1) or after it (1) [m].
    fn on_m(&self, sense: f64) -> f64 {
        sense * self.wrap.turns.signum() * STRAIGHT_ON * self.fine_m
    }

    /// Places along the way, standing off by `off_m` more than they need.
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

    /// The section where a share of the way round is done, which is so far round.
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
            format!("there is no skin of the {} to lie on, {turned:.2} turns on", wrap.part.name())
        })
    }
}

impl Section {
    /// The direction in which skin faces at an azimuth.
    fn out(&self, azimuth: f64) -> DVec3 {
        self.back * libm::cos(azimuth) + self.onward.cross(self.back) * libm::sin(azimuth)
    }

    /// The way of growing azimuth there.
    fn way(&self, azimuth: f64) -> DVec3 {
        self.onward.cross(self.out(azimuth))
    }

    /// Where rope lies there, standing off by so much.
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

/// Place along the sim's axis, which on the trunk runs to the snout.
fn along([least, most]: [f64; 2], part: BodyPart, station: f64) -> f64 {
    if part.on_trunk() { most + station * (least - most) } else { least + station * (most - least) }
}
