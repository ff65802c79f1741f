//! The azimuth at which a wrap begins, where the file names none.
//!
//! The ways to the wraps, between them and on from them should be short and clear of the skin. They
//! should also bend little where they leave a wrap, because such a bend changes the wrap's turns.
//! A way is scored by its length: [`THROUGH_M`] is added where it goes through skin, and up to
//! [`BACK_M`] where it turns back at a wrap. The search goes wrap by wrap and keeps the lines with the
//! lowest scores (a beam search); what is left are whole lines, the best first.

use std::f64::consts::TAU;

use endline_sim::DVec3;

use crate::assemble::way::length;

use super::helix::Helix;
use super::leg;
use super::skin::PosedSkin;

/// Azimuths tried for each wrap.
const TRIED: u32 = 24;
/// Lines kept from wrap to wrap, and tried in the end.
const KEPT: usize = 12;
/// Distance of places looked at on the ways [m].
const EACH_M: f64 = 0.1;
/// Length that a way through the whale counts for [m].
const THROUGH_M: f64 = 100.0;
/// Length that a way counts for which turns back where it leaves a wrap; the versed sine of a lesser bend's part of it [m].
const BACK_M: f64 = 20.0;

/// Where each wrap of a line begins, and what the ways between cost.
#[derive(Clone)]
struct Line {
    azimuths: Vec<f64>,
    end: End,
    cost_m: f64,
}

/// An end of a wrap or of the line, and which way rope goes there; none at the line's.
type End = (DVec3, Option<DVec3>);

/// Azimuths for every wrap, the best first.
///
/// # Errors
/// With the wrap that has no place to lie, and why.
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
    lines.truncate(KEPT);
    lines
}

/// What the way between two ends counts for.
fn cost_m(skin: &mut PosedSkin, ends: [End; 2]) -> f64 {
    let way = leg::way(skin, ends.map(|(place, _)| place), EACH_M);
    let through = skin.goes_through(&way);
    let straight = (ends[1].0 - ends[0].0).normalize_or_zero();
    let bends: f64 =
        ends.iter().filter_map(|(_, along)| Some(0.5 * (1.0 - straight.dot((*along)?)))).sum();
    length(&way) + BACK_M * bends + if through { THROUGH_M } else { 0.0 }
}
