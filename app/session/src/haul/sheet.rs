//! What is reported of a haul: schema `endline.haul/1`.

use endline_sim::Settled;
use endline_sim::haul::Haul;
use schemars::JsonSchema;
use serde::Serialize;

use crate::strength::PartStrength;

use super::gear::Made;
use super::loads::{Greatest, Loads, Most};
use super::{HaulRequest, risk};

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
    /// What statics found before the haul: `at rest`, or why not.
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
    /// The place that came nearest to what it delivers.
    pub nearest: Option<Place>,
    /// Probability that any part parts.
    pub parts: f64,
    /// Work of the hauler [J].
    pub work_J: f64,
    /// Solver steps that did not converge.
    pub unconverged: u64,
    /// Stage by stage.
    pub stages: Vec<Stage>,
    /// Every piece of rope and link, by the share used of what it delivers.
    pub places: Vec<Place>,
    /// What each piece of rope and link delivers, and why.
    pub strengths: Vec<PartStrength>,
    /// Tension along the endline through the haul.
    pub along: Along,
}

/// A part of the haul, up to something that came up.
#[derive(Clone, Debug, JsonSchema, Serialize)]
#[allow(non_snake_case, reason = "keys of the JSON contract carry their units")]
pub struct Stage {
    /// What ended it.
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
    /// The place that came nearest to what it delivers.
    pub nearest: Option<Place>,
    /// Probability that any part parts.
    pub parts: f64,
}

/// Where a part came nearest to what it delivers.
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
    /// The sheet as one JSON object.
    #[must_use]
    pub fn json(&self) -> String {
        // Strings and finite numbers always become JSON.
        serde_json::to_string_pretty(self).unwrap_or_default()
    }

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

fn stage(loads: &Loads, stage: &super::loads::StageLoads) -> Stage {
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
        parts: risk::parts(most.used, part.variation),
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
