//! A wrap: a helix about a part's axis, its radius that of the skin and what rope stands off.
//!
//! With `t` from 0 to 1, turns `n` (below zero left-handed), pitch `p`, the azimuth from the whale's back is
//! `phi(t) = phi_0 + 2 pi n t` about the axis from snout or root on, and the place along it `s(t) = s_m + p |n| (t - 1/2)`.
//! Slack `e` lets the rope stand off evenly by so much that its way is `1 + e` times the tight one.

use std::f64::consts::TAU;

use endline_sdk::BodyPart;
use endline_sim::DVec3;
use endline_sim::model::Rope;

use crate::scenario::{WrapOf, on_trunk};

use super::cut::Stretch;
use super::skin::PosedSkin;

/// Places on each turn of a wrap.
const EACH_TURN: f64 = 240.0;
/// Azimuths tried where none is given.
const TRIED: u32 = 36;
/// Length that a way through the whale counts for in the choice of an azimuth [m].
const THROUGH_M: f64 = 100.0;
/// Pitch where none is given, in rope diameters.
const USUAL_PITCH: f64 = 5.0;
/// Longest segments about the trunk and about fins where a wrap names none [m].
const USUAL_SEGMENTS_M: [f64; 2] = [0.05, 0.02];

pub(super) fn usual_segment_m(part: BodyPart) -> f64 {
    USUAL_SEGMENTS_M[usize::from(!on_trunk(part))]
}

/// A place on the axis at the middle of a wrap.
pub(super) fn middle(skin: &PosedSkin, wrap: &WrapOf) -> Result<DVec3, String> {
    let spot = skin.axis(wrap.part).and_then(|(axis, reach)| axis.at(along(*reach, wrap, wrap.station)));
    spot.map(|spot| spot.middle).ok_or_else(|| format!("this whale has no {}", wrap.part.name()))
}

/// The way round, between the place it comes from and the one it goes on to.
pub(super) fn lay(skin: &mut PosedSkin, rope: &Rope, wrap: &WrapOf, ends: [DVec3; 2]) -> Result<Vec<DVec3>, String> {
    let start = match wrap.azimuth_rad {
        Some(azimuth) => azimuth,
        None => best_start(skin, rope, wrap, ends)?,
    };
    let tight = helix(skin, rope, wrap, (start, 0.0))?;
    if wrap.slack <= 0.0 {
        return Ok(tight);
    }
    let wanted = (1.0 + wrap.slack) * length(&tight);
    // A loop that stands off by h is about 2 pi h longer; two corrections take in what the shape adds.
    let (mut off, mut way) = (0.0, tight);
    for _ in 0..3 {
        off += (wanted - length(&way)) / (TAU * wrap.turns.abs());
        way = helix(skin, rope, wrap, (start, off))?;
    }
    Ok(way)
}

/// A wrap as a stretch of rope: stretched by its pretension.
pub(super) fn stretch(way: Vec<DVec3>, rope: &Rope, wrap: &WrapOf, fine_m: f64) -> Stretch {
    let rope_m = length(&way) / (1.0 + strain(rope, wrap.pretension_n));
    Stretch { way, rope_m: Some(rope_m), fine_m: Some(fine_m) }
}

/// Strain at a tension: the positive root of `EA e + EA2 e^2 = T`.
fn strain(rope: &Rope, tension_n: f64) -> f64 {
    let (ea, ea2) = (rope.axial_stiffness_n, rope.axial_stiffening_n);
    2.0 * tension_n / (ea + libm::sqrt(ea * ea + 4.0 * ea2 * tension_n))
}

/// The azimuth from which the ways to the wrap and on from it are shortest and go through no skin.
fn best_start(skin: &mut PosedSkin, rope: &Rope, wrap: &WrapOf, [from, to]: [DVec3; 2]) -> Result<f64, String> {
    let mut best = (f64::INFINITY, 0.0);
    for tried in 0..TRIED {
        let start = TAU * f64::from(tried) / f64::from(TRIED);
        let (first, last) = (place(skin, rope, wrap, (start, 0.0), 0.0)?, place(skin, rope, wrap, (start, 0.0), 1.0)?);
        let legs = [[from, first], [last, to]];
        let through = legs.iter().filter(|leg| skin.pierced(**leg)).count() as f64;
        let cost = legs.iter().map(|leg| leg[0].distance(leg[1])).sum::<f64>() + THROUGH_M * through;
        if cost < best.0 {
            best = (cost, start);
        }
    }
    Ok(best.1)
}

/// Places on the helix, its azimuth beginning at `start`, standing off by `off_m` more than it need.
fn helix(skin: &PosedSkin, rope: &Rope, wrap: &WrapOf, how: (f64, f64)) -> Result<Vec<DVec3>, String> {
    let count = (EACH_TURN * wrap.turns.abs()).ceil().max(2.0);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at most some thousands")]
    let numbers = 0..=count as u32;
    numbers.map(|number| place(skin, rope, wrap, how, f64::from(number) / count)).collect()
}

/// The place at a share of the helix.
fn place(skin: &PosedSkin, rope: &Rope, wrap: &WrapOf, (start, off_m): (f64, f64), share: f64) -> Result<DVec3, String> {
    let (axis, reach) = skin.axis(wrap.part).ok_or_else(|| format!("this whale has no {}", wrap.part.name()))?;
    let pitch_m = wrap.pitch_m.unwrap_or(USUAL_PITCH * rope.diameter_m);
    let station = wrap.station + pitch_m * wrap.turns.abs() * (share - 0.5) / (reach[1] - reach[0]);
    let found = axis.at(along(*reach, wrap, station)).and_then(|spot| {
        let onward = if on_trunk(wrap.part) { -spot.along() } else { spot.along() };
        let back = (skin.up - onward * skin.up.dot(onward)).try_normalize()?;
        let angle = start + TAU * wrap.turns * share;
        let out = back * libm::cos(angle) + onward.cross(back) * libm::sin(angle);
        let outline = skin.outline(wrap.part, spot.middle, onward);
        Some(outline.centre + out * (outline.radius(out)? + skin.off_m + off_m))
    });
    let turned = wrap.turns * share;
    found.ok_or_else(|| format!("there is no skin of the {} to lie on, {turned:.2} turns on", wrap.part.name()))
}

/// Place along the sim's axis, which on the trunk runs to the snout.
fn along([least, most]: [f64; 2], wrap: &WrapOf, station: f64) -> f64 {
    if on_trunk(wrap.part) { most + station * (least - most) } else { least + station * (most - least) }
}

/// Length of a way [m].
pub(super) fn length(way: &[DVec3]) -> f64 {
    way.windows(2).map(|pair| pair[0].distance(pair[1])).sum()
}
