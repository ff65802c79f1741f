//! Where wraps begin that name no azimuth: so that the ways to them, between them and on from them are short and free.
//!
//! A way that goes through skin counts [`THROUGH_M`] more. The best beginnings of the first wraps are kept and gone on
//! from, wrap by wrap; what is left are whole lines, the best first.

use std::f64::consts::TAU;

use endline_sim::DVec3;

use super::helix::{Helix, length};
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

/// Where each wrap of a line begins, and what the ways between cost.
#[derive(Clone)]
struct Line {
    azimuths: Vec<f64>,
    at: DVec3,
    cost_m: f64,
}

/// Azimuths for every wrap, the best first.
///
/// # Errors
/// With the wrap that has no place to lie, and why.
pub(super) fn azimuths(skin: &mut PosedSkin, helices: &[Helix<'_>], [from, to]: [DVec3; 2]) -> Result<Vec<Vec<f64>>, (usize, String)> {
    let mut lines = vec![Line { azimuths: Vec::new(), at: from, cost_m: 0.0 }];
    for (number, helix) in helices.iter().enumerate() {
        let tried: Vec<f64> = match helix.wrap.azimuth_rad {
            Some(azimuth) => vec![azimuth],
            None => (0..TRIED).map(|tried| TAU * f64::from(tried) / f64::from(TRIED)).collect(),
        };
        let mut longer = Vec::with_capacity(lines.len() * tried.len());
        for azimuth in tried {
            let [first, last] = helix.ends(skin, azimuth).map_err(|what| (number, what))?;
            for line in &lines {
                let azimuths = line.azimuths.iter().copied().chain([azimuth]).collect();
                longer.push(Line { azimuths, at: last, cost_m: line.cost_m + cost_m(skin, [line.at, first]) });
            }
        }
        lines = best(longer);
    }
    lines.iter_mut().for_each(|line| line.cost_m += cost_m(skin, [line.at, to]));
    Ok(best(lines).into_iter().map(|line| line.azimuths).collect())
}

fn best(mut lines: Vec<Line>) -> Vec<Line> {
    lines.sort_by(|one, other| one.cost_m.total_cmp(&other.cost_m));
    lines.truncate(KEPT);
    lines
}

/// What the way between two places counts for.
fn cost_m(skin: &mut PosedSkin, ends: [DVec3; 2]) -> f64 {
    let way = leg::way(skin, ends, EACH_M);
    let through = skin.goes_through(&way);
    length(&way) + if through { THROUGH_M } else { 0.0 }
}
