//! The report of a haul: schema `endline.haul/1`; and a table over depth, traps and tide.

use std::path::Path;

use endline_sim::Settled;
use endline_sim::haul::Haul;
use schemars::JsonSchema;
use serde::Serialize;

use super::loads::{Greatest, Loads, Most};
use super::{HaulRequest, Made, haul_of, loads};
use crate::error::Error;
use crate::plugins::PluginHost;
use crate::settled::PartStrength;
use crate::source::AssemblyFile;

/// Name of the schema.
pub const SCHEMA: &str = "endline.haul/1";

/// A haul as reported.
#[derive(Clone, Debug, JsonSchema, Serialize)]
#[allow(non_snake_case, reason = "keys of the JSON contract carry their units")]
pub struct HaulSheet {
    /// Name and version of this form.
    #[schemars(extend("const" = SCHEMA))]
    pub schema: &'static str,
    /// Id of the assembly.
    pub assembly: String,
    /// Id of the site.
    pub site: String,
    /// Depth [m].
    pub depth_m: f64,
    /// Speed of the tide at its fastest height [m/s].
    pub tide_m_s: f64,
    /// Significant height of the waves; zero in a calm [m].
    pub sea_m: f64,
    /// Their peak period [s].
    pub period_s: Option<f64>,
    /// Traps of the gear.
    pub traps: usize,
    /// Traps that came aboard.
    pub traps_aboard: usize,
    /// Speed of the hauler [m/s].
    pub speed_m_s: f64,
    /// Height of the block over the sea surface [m].
    pub block_m: f64,
    /// Break-out over that of the traps' entries.
    pub break_out: f64,
    /// Statics before the haul: `at rest`, or why not.
    pub before: String,
    /// Rope taken in [m].
    pub hauled_m: f64,
    /// Length of the haul [s].
    pub time_s: f64,
    /// Greatest pull at the hauler [N].
    pub peak_N: f64,
    /// When [s].
    pub peak_s: f64,
    /// Rope taken in by then [m].
    pub peak_hauled_m: f64,
    /// Most traps and anchors that hung off the seabed at once.
    pub hanging: usize,
    /// The place with the greatest share of its delivered strength.
    pub nearest: Option<Place>,
    /// Probability that any part parts.
    pub parts: f64,
    /// Work of the hauler [J].
    pub work_J: f64,
    /// Solver steps that did not converge.
    pub unconverged: u64,
    /// Stage by stage.
    pub stages: Vec<Stage>,
    /// Every piece of rope and link, by the share used of its delivered strength.
    pub places: Vec<Place>,
    /// The delivered strength of each piece of rope and link, with its factors.
    pub strengths: Vec<PartStrength>,
    /// Tension along the endline through the haul.
    pub along: Along,
}

/// A stage of the haul: up to where something leaves the seabed or comes aboard.
#[derive(Clone, Debug, JsonSchema, Serialize)]
#[allow(non_snake_case, reason = "keys of the JSON contract carry their units")]
pub struct Stage {
    /// The event that ended it.
    pub until: String,
    /// When [s].
    pub time_s: f64,
    /// Rope taken in by then [m].
    pub hauled_m: f64,
    /// Greatest pull at the hauler [N].
    pub peak_N: f64,
    /// Most traps and anchors that hung at once.
    pub hanging: usize,
    /// Greatest angle of the line at the block from the vertical [deg].
    pub lead_deg: f64,
    /// The place with the greatest share of its delivered strength.
    pub nearest: Option<Place>,
    /// Probability that any part parts.
    pub parts: f64,
}

/// Where a part had the greatest share of its delivered strength.
#[derive(Clone, Debug, JsonSchema, Serialize)]
#[allow(non_snake_case, reason = "keys of the JSON contract carry their units")]
pub struct Place {
    /// Id of the piece of rope or link.
    pub part: String,
    /// From the buoy along the endline, where it is on it [m].
    pub from_buoy_m: Option<f64>,
    /// Tension [N].
    pub tension_N: f64,
    /// Mean strength delivered there [N].
    pub delivered_N: f64,
    /// Tension over that strength.
    pub used: f64,
    /// When [s].
    pub time_s: f64,
    /// Rope taken in by then [m].
    pub hauled_m: f64,
    /// Probability that it parts.
    pub parts: f64,
}

/// Tension along the endline through the haul.
#[derive(Clone, Debug, JsonSchema, Serialize)]
#[allow(non_snake_case, reason = "keys of the JSON contract carry their units")]
pub struct Along {
    /// Places from the buoy, by unstretched rope [m].
    pub from_buoy_m: Vec<f64>,
    /// Times [s].
    pub time_s: Vec<f64>,
    /// Rope taken in at each time [m].
    pub hauled_m: Vec<f64>,
    /// Pull at the hauler at each time [N].
    pub load_N: Vec<f64>,
    /// Angle of the line at the block from the vertical at each time [deg].
    pub lead_deg: Vec<f64>,
    /// Tension at each time and place; `null` where it is aboard [N].
    pub tension_N: Vec<Vec<Option<f64>>>,
}

impl HaulSheet {
    pub(super) fn of(
        id: &str,
        request: &HaulRequest,
        made: &Made,
        settled: &Settled,
        haul: &Haul,
        loads: &Loads,
    ) -> Self {
        let Greatest { load_n, time_s, hauled_m, hanging, .. } = loads.greatest;
        let water = &made.model.spec.water;
        let mut places: Vec<Place> = (0..loads.parts.len())
            .map(|part| place(loads, part, &loads.greatest.parts[part]))
            .filter(|place| place.used > 0.0)
            .collect();
        places.sort_by(|one, other| other.used.total_cmp(&one.used));
        Self {
            schema: SCHEMA,
            assembly: id.to_owned(),
            site: request.site.clone(),
            depth_m: water.depth_m,
            tide_m_s: water.current.surface_m_s.length(),
            sea_m: request.sea_m.unwrap_or(0.0),
            period_s: made.period_s,
            traps: made.traps(),
            traps_aboard: loads.aboard,
            speed_m_s: request.how.speed_m_s,
            block_m: request.how.block_m,
            break_out: request.break_out,
            before: settled.why(),
            hauled_m: haul.hauled_m(),
            time_s: haul.state().time_s,
            peak_N: load_n,
            peak_s: time_s,
            peak_hauled_m: hauled_m,
            hanging,
            nearest: places.first().cloned(),
            parts: loads.greatest.parts(&loads.parts),
            work_J: loads.work_j,
            unconverged: haul.unconverged(),
            stages: loads.stages.iter().map(|stage| self::stage(loads, stage)).collect(),
            places,
            strengths: made.strengths.iter().map(PartStrength::from).collect(),
            along: along(loads),
        }
    }
}

fn stage(loads: &Loads, stage: &loads::StageLoads) -> Stage {
    let greatest = &stage.greatest;
    Stage {
        until: stage.until.clone(),
        time_s: stage.time_s,
        hauled_m: stage.hauled_m,
        peak_N: greatest.load_n,
        hanging: greatest.hanging,
        lead_deg: greatest.lead_rad.to_degrees(),
        nearest: greatest.nearest().map(|(part, most)| place(loads, part, most)),
        parts: greatest.parts(&loads.parts),
    }
}

fn place(loads: &Loads, part: usize, most: &Most) -> Place {
    let on_endline = loads.along.iter().find(|(segment, _)| *segment == most.segment);
    let part = &loads.parts[part];
    Place {
        part: part.id.clone(),
        from_buoy_m: on_endline.map(|(_, at_m)| *at_m),
        tension_N: most.tension_n,
        delivered_N: most.holds_n,
        used: most.used,
        time_s: most.time_s,
        hauled_m: most.hauled_m,
        parts: loads::probability(most.used, part.variation),
    }
}

fn along(loads: &Loads) -> Along {
    let samples = &loads.samples;
    Along {
        from_buoy_m: loads.along.iter().map(|(_, at_m)| *at_m).collect(),
        time_s: samples.iter().map(|sample| sample.time_s).collect(),
        hauled_m: samples.iter().map(|sample| sample.hauled_m).collect(),
        load_N: samples.iter().map(|sample| sample.load_n).collect(),
        lead_deg: samples.iter().map(|sample| sample.lead_rad.to_degrees()).collect(),
        tension_N: samples.iter().map(|sample| sample.tension_n.clone()).collect(),
    }
}

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
    /// Part with the greatest share of its delivered strength.
    pub nearest: String,
    /// Tension there over mean delivered strength.
    pub used: f64,
    /// Probability that any part parts.
    pub parts: f64,
    /// Statics before the haul.
    pub before: String,
}

/// Hauls at each depth, number of traps and tide; `each` receives the number of hauls done and of all after each haul.
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
