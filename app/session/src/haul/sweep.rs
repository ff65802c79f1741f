//! Hauls at every depth, number of traps and tide of a table.

use std::path::Path;

use schemars::JsonSchema;
use serde::Serialize;

use crate::error::Error;
use crate::plugins::PluginHost;
use crate::source::AssemblyFile;

use super::{HaulRequest, haul_of};

/// Depths, numbers of traps and tides to haul at.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Sweep {
    /// Depths; empty for that of the request [m].
    pub depths_m: Vec<f64>,
    /// Traps; empty for that of the request.
    pub traps: Vec<u16>,
    /// Tides; empty for that of the request [m/s].
    pub tides_m_s: Vec<f64>,
}

/// One haul of a table.
#[derive(Clone, Debug, JsonSchema, PartialEq, Serialize)]
#[allow(non_snake_case, reason = "keys of the JSON contract carry their units")]
pub struct SweepRow {
    /// Depth [m].
    pub depth_m: f64,
    /// Traps.
    pub traps: usize,
    /// Tide [m/s].
    pub tide_m_s: f64,
    /// Most traps and anchors that hung at once.
    pub hanging: usize,
    /// Greatest pull at the hauler [N].
    pub peak_N: f64,
    /// Part that came nearest to what it delivers.
    pub nearest: String,
    /// Tension there over mean delivered strength.
    pub used: f64,
    /// Probability that any part parts.
    pub parts: f64,
    /// What statics found before the haul.
    pub before: String,
}

/// Hauls at each depth, number of traps and tide; `each` is told after each haul how many are done, and of how many.
///
/// # Errors
/// As of [`haul_of`].
pub fn sweep(
    named: &str,
    request: &HaulRequest,
    sweep: &Sweep,
    (library, host): (Option<&Path>, &PluginHost),
    mut each: impl FnMut(usize, usize),
) -> Result<Vec<SweepRow>, Error> {
    let file = AssemblyFile::open(named, library)?;
    let library = file.library()?;
    let requests = requests(request, sweep);
    let mut rows = Vec::with_capacity(requests.len());
    for request in &requests {
        let sheet = haul_of(&file.id, request, &library, host)?;
        rows.push(SweepRow {
            depth_m: sheet.depth_m,
            traps: sheet.traps,
            tide_m_s: sheet.tide_m_s,
            hanging: sheet.hanging,
            peak_N: sheet.peak_N,
            used: sheet.nearest.as_ref().map_or(0.0, |place| place.used),
            nearest: sheet.nearest.map(|place| place.part).unwrap_or_default(),
            parts: sheet.parts,
            before: sheet.before,
        });
        each(rows.len(), requests.len());
    }
    Ok(rows)
}

/// Every combination, tides within traps within depths.
fn requests(request: &HaulRequest, sweep: &Sweep) -> Vec<HaulRequest> {
    let depths = or_one(&sweep.depths_m, request.depth_m);
    let (traps, tides) =
        (or_one(&sweep.traps, request.traps), or_one(&sweep.tides_m_s, request.tide_m_s));
    let mut requests = Vec::new();
    for depth_m in depths {
        for traps in &traps {
            for tide_m_s in &tides {
                let (traps, tide_m_s) = (*traps, *tide_m_s);
                requests.push(HaulRequest { depth_m, traps, tide_m_s, ..request.clone() });
            }
        }
    }
    requests
}

fn or_one<T: Copy>(all: &[T], one: Option<T>) -> Vec<Option<T>> {
    if all.is_empty() { vec![one] } else { all.iter().copied().map(Some).collect() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_combination_is_hauled_once() {
        let sweep = Sweep { depths_m: vec![25.0, 60.0], traps: vec![], tides_m_s: vec![0.1, 0.3] };
        let request = HaulRequest { traps: Some(5), ..HaulRequest::default() };
        let all: Vec<_> = requests(&request, &sweep)
            .iter()
            .map(|request| (request.depth_m, request.traps, request.tide_m_s))
            .collect();
        let of = |depth, tide| (Some(depth), Some(5), Some(tide));
        assert_eq!(all, [of(25.0, 0.1), of(25.0, 0.3), of(60.0, 0.1), of(60.0, 0.3)]);
    }
}
