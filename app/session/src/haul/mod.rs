//! Hauling: an assembly hauled from a boat, the loads on its way up, and the probability that something parts.
//!
//! | module | content |
//! |---|---|
//! | `loads` | the greatest tension of every part, stage by stage, and the probability that parts part |
//! | [`sheet`] | the report, and a table over depth, traps and tide |
//!
//! The physics of the haul is [`endline_sim::haul`]; docs/hauling.md describes it with its sources.

pub mod loads;
pub mod sheet;

use std::path::Path;

use endline_gear::{
    Assembled, Diagnostic, Library, Options, Scenario, Setting, StrengthBudget, assemble_traced,
};
use endline_sim::haul::{Haul, Hauling, endlines};
use endline_sim::model::BodyRole;
use endline_sim::{DVec3, Model, settle};

use crate::error::Error;
use crate::plugins::PluginHost;
use crate::source::{AssemblyFile, written};
use loads::Loads;

pub use sheet::{HaulSheet, Stage, Sweep, SweepRow};

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
    /// Number of traps aboard at which the haul ends.
    pub aboard: Option<usize>,
    /// Break-out over that of the traps' entries.
    pub break_out: f64,
    /// Seed of the waves.
    pub seed: u64,
    /// Longest segment of rope, in place of one in proportion to the depth [m].
    pub segment_m: Option<f64>,
    /// Step [s].
    pub step_s: f64,
    /// The hauler and the boat.
    pub how: Hauling,
}

impl Default for HaulRequest {
    /// The defaults that docs/hauling.md gives.
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
        loads.record(&haul, &made);
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

/// Peak period of a fully developed sea over the root of its significant height: `H = 0.21 U²/g` and `ω = 0.877 g/U` (Pierson
/// and Moskowitz 1964, doi:10.1029/JZ069i024p05181) [s/√m].
const PERIOD_OF_ROOT_HEIGHT: f64 = 4.99;
/// Segments that the depth is cut into, at the least.
const SEGMENTS: f64 = 40.0;

/// Assembled gear.
struct Made {
    /// The model, with its strengths at their means.
    pub model: Model,
    /// The strength of each piece and link, with its factors.
    pub strengths: Vec<StrengthBudget>,
    /// Peak period of the waves, where there are any [s].
    pub period_s: Option<f64>,
}

impl Made {
    /// Assembles an assembly for a request.
    pub fn of(
        id: &str,
        request: &HaulRequest,
        library: &Library,
        host: &PluginHost,
    ) -> Result<Self, Error> {
        let site =
            library.sites.iter().find(|site| site.entry.id == request.site).ok_or_else(|| {
                let known: Vec<&str> =
                    library.sites.iter().map(|site| site.entry.id.as_str()).collect();
                Error::Message(format!(
                    "no site `{}`; there are {}",
                    request.site,
                    known.join(", ")
                ))
            })?;
        let depth_m = request.depth_m.unwrap_or(site.depth_m);
        let period_s = request
            .sea_m
            .map(|height| request.period_s.unwrap_or(PERIOD_OF_ROOT_HEIGHT * height.sqrt()));
        let text = text(id, request, depth_m, period_s)?;
        let scenario = Scenario::read("scenario", &text)?;
        let options = Options { step_s: Some(request.step_s), ..Options::default() };
        let Assembled { mut spec, strengths, .. } =
            assemble_traced(&scenario, library, host, &options)?;
        for body in &mut spec.bodies {
            body.foot_break_out_n *= request.break_out;
        }
        let model = Model::new(spec).map_err(|errors| {
            let located = errors.into_iter().map(|error| {
                let message = format!("{}: {}", error.part, error.message);
                Diagnostic::of_file("scenario", message, "")
            });
            Error::Diagnostics(located.collect())
        })?;
        Ok(Self { model, strengths, period_s })
    }

    /// Rope in all, and the depth [m].
    pub fn rope_m(&self) -> f64 {
        let lines = self.model.spec.lines.iter();
        lines.flat_map(|line| &line.segments_m).sum::<f64>() + self.model.spec.water.depth_m
    }

    /// Traps of the gear.
    pub fn traps(&self) -> usize {
        self.model.spec.bodies.iter().filter(|body| body.role == BodyRole::Trap).count()
    }

    /// The budget of a part.
    pub fn budget(&self, part: &str) -> Option<&StrengthBudget> {
        self.strengths.iter().find(|budget| budget.part == part)
    }
}

/// The text of the scenario.
fn text(
    id: &str,
    request: &HaulRequest,
    depth_m: f64,
    period_s: Option<f64>,
) -> Result<String, Error> {
    let head = "format = 1\nkind = \"scenario\"\nname = \"haul\"\nduration = \"1 s\"\nstrength_scatter = false\nrope_on_rope = false\nrope_on_bodies = false\nbodies_on_bodies = false\nweak_links = false\n";
    let segment_m = request.segment_m.unwrap_or((depth_m / SEGMENTS).clamp(0.5, 2.0));
    let metres = |length: f64| Setting::text(&format!("{length} m"));
    let mut settings = vec![
        ("seed", Setting::plain(&request.seed.to_string())),
        ("segment", metres(segment_m)),
        ("site.item", Setting::text(&request.site)),
        ("site.depth", metres(depth_m)),
        ("gear.0.assembly", Setting::text(id)),
        ("gear.0.heading", Setting::text("90 deg")),
    ];
    if let Some(tide) = request.tide_m_s {
        settings.push(("current.speed", Setting::text(&format!("{tide} m/s"))));
    }
    if let Some(traps) = request.traps {
        settings.push(("gear.0.attributes.traps", Setting::plain(&traps.to_string())));
    }
    if let (Some(height), Some(period)) = (request.sea_m, period_s) {
        settings.extend([
            ("waves.spectrum", Setting::text("jonswap")),
            ("waves.height", metres(height)),
            ("waves.period", Setting::text(&format!("{period} s"))),
            ("waves.toward", Setting::text("270 deg")),
        ]);
    }
    written(head, &settings)
}
