//! Hauling: an assembly hauled from a boat, the loads on its way up, and the probability that something parts.
//!
//! | module | what |
//! |---|---|
//! | `gear` | an assembly at a site in a tide and a sea, at rest |
//! | `loads` | the greatest tension of every part, stage by stage |
//! | [`risk`] | probability that a part or any part parts |
//! | [`sheet`] | what is reported |
//! | [`sweep`] | depth, traps and tide varied |
//!
//! The physics of the haul is [`endline_sim::haul`]; docs/hauling.md tells it with its sources.

mod gear;
mod loads;
pub mod risk;
pub mod sheet;
pub mod sweep;

use std::path::Path;

use endline_gear::Library;
use endline_sim::DVec3;
use endline_sim::haul::{Haul, Hauling, endlines};
use endline_sim::settle;

use crate::error::Error;
use crate::plugins::PluginHost;
use crate::source::AssemblyFile;

use gear::Made;
use loads::Loads;
pub use sheet::{HaulSheet, Stage};
pub use sweep::{Sweep, SweepRow};

/// Hauls longer than this many times their rope over the hauler's speed are given up.
const MOST_TIMES: f64 = 4.0;

/// An assembly to be hauled, and how.
#[derive(Clone, Debug, PartialEq)]
pub struct HaulRequest {
    /// Id of a site of the library.
    pub site: String,
    /// Depth, in place of the site's [m].
    pub depth_m: Option<f64>,
    /// Speed of the tide, in place of the site's [m/s].
    pub tide_m_s: Option<f64>,
    /// Significant height of the waves; none in a calm [m].
    pub sea_m: Option<f64>,
    /// Their peak period, in place of that of a fully developed sea [s].
    pub period_s: Option<f64>,
    /// Traps, in place of the assembly's.
    pub traps: Option<u16>,
    /// Buoy at which the haul begins, in place of the first.
    pub buoy: Option<String>,
    /// Stop once so many traps are aboard.
    pub aboard: Option<usize>,
    /// Break-out over that of the traps' entries.
    pub break_out: f64,
    /// Seed of the waves.
    pub seed: u64,
    /// Longest segment of rope, in place of one that goes with the depth [m].
    pub segment_m: Option<f64>,
    /// Step [s].
    pub step_s: f64,
    /// The hauler and the boat.
    pub how: Hauling,
}

impl Default for HaulRequest {
    /// What docs/hauling.md says of each.
    fn default() -> Self {
        Self {
            site: "cape-cod-bay".to_owned(),
            depth_m: None,
            tide_m_s: None,
            sea_m: Some(1.0),
            period_s: None,
            traps: None,
            buoy: None,
            aboard: None,
            break_out: 1.0,
            seed: 1,
            segment_m: None,
            step_s: 0.02,
            how: Hauling {
                speed_m_s: 1.2,
                start_s: 1.0,
                block_m: 2.0,
                heave: 1.0,
                lead_rad: Some(0.26),
                drift_m_s: DVec3::ZERO,
            },
        }
    }
}

/// Hauls an assembly, by its id or its file.
///
/// # Errors
/// A file that cannot be read, every located error of assembly and library, gear without a buoy at the surface, or a solver
/// that cannot go on.
pub fn haul(
    named: &str,
    request: &HaulRequest,
    library: Option<&Path>,
    host: &PluginHost,
) -> Result<HaulSheet, Error> {
    let file = AssemblyFile::open(named, library)?;
    let library = file.library()?;
    haul_of(&file.id, request, &library, host)
}

/// Hauls an assembly of a library that was read.
///
/// # Errors
/// As above.
pub fn haul_of(
    id: &str,
    request: &HaulRequest,
    library: &Library,
    host: &PluginHost,
) -> Result<HaulSheet, Error> {
    let made = Made::of(id, request, library, host)?;
    let settled = settle(&made.model);
    let from = start(&made, request)?;
    let mut haul =
        Haul::begin(&made.model, &settled.state, from, request.how).map_err(Error::Message)?;
    let mut loads = Loads::new(&made, from);
    let most_s = MOST_TIMES * made.rope_m() / request.how.speed_m_s;
    while haul.advance().map_err(|stop| stopped(&stop))? {
        loads.take(&haul, &made);
        if loads.is_done(request.aboard) || haul.state().time_s > most_s {
            break;
        }
    }
    loads.finish(&haul, &made);
    Ok(HaulSheet::of(id, request, &made, &settled, &haul, &loads))
}

fn stopped(stop: &endline_sim::Stop) -> Error {
    Error::Message(format!(
        "the haul stops at {:.2} s: {}: {}",
        stop.time_s, stop.part, stop.reason
    ))
}

/// The line's end at which the haul begins.
fn start(
    made: &Made,
    request: &HaulRequest,
) -> Result<(usize, usize, endline_sdk::LineEnd), Error> {
    let ends = endlines(&made.model);
    let id = |body: usize| made.model.spec.bodies[body].id.as_str();
    let Some(asked) = &request.buoy else {
        return ends.first().copied().ok_or_else(|| {
            Error::Message("this gear has no endline from a buoy at the surface to haul".to_owned())
        });
    };
    let found = ends.iter().find(|end| id(end.0) == asked);
    found.copied().ok_or_else(|| {
        let known: Vec<&str> = ends.iter().map(|end| id(end.0)).collect();
        Error::Message(format!("no endline begins at `{asked}`; there are {}", known.join(", ")))
    })
}
