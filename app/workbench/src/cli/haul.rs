//! `endline haul`: whether gear can be hauled, and the loads.

use std::path::Path;
use std::process::ExitCode;

use endline_session::haul::sheet::{Place, sweep};
use endline_session::haul::{HaulRequest, HaulSheet, Stage, Sweep, SweepRow, haul};
use endline_session::json;
use endline_session::units::newtons_and_lbf;
use endline_sim::DVec3;
use endline_sim::haul::Hauling;

use super::quantity::{drift, haul_length, haul_step, hauler, lead, period, segment, tide};
use super::table::columns;
use super::{Failure, host, output};

/// Parts shown of a haul; all are in the JSON.
const MOST_SHOWN: usize = 8;

#[derive(Debug, clap::Args)]
pub(super) struct HaulArgs {
    /// Assembly file, or the id of an assembly in the gear library.
    #[arg(value_name = "ASSEMBLY")]
    assembly: String,
    /// Site of the gear library: depth, tide and seabed.
    #[arg(long, value_name = "ID", default_value = "cape-cod-bay")]
    site: String,
    /// Depth of the water, such as "30 fathom"; several for a --table [default: the site's].
    #[arg(long, value_name = "LENGTH", value_parser = haul_length, value_delimiter = ',')]
    depth: Vec<f64>,
    /// Traps on one set, in place of those of the assembly; several for a --table.
    #[arg(long, value_name = "N", value_delimiter = ',')]
    traps: Vec<u16>,
    /// Speed of the tide, such as "0.5 knot"; several for a --table [default: the site's].
    #[arg(long, value_name = "SPEED", value_parser = tide, value_delimiter = ',')]
    tide: Vec<f64>,
    /// Print one row for each depth, number of traps and tide.
    #[arg(long)]
    table: bool,
    /// Rope taken in by the hauler.
    #[arg(long, value_name = "SPEED", default_value = "1.2 m/s", value_parser = hauler)]
    speed: f64,
    /// Height of the block over the sea surface.
    #[arg(long, value_name = "LENGTH", default_value = "2 m", value_parser = haul_length)]
    height: f64,
    /// Significant height of the waves on which the boat heaves; 0 m for a calm.
    #[arg(long, value_name = "LENGTH", default_value = "1 m", value_parser = haul_length)]
    sea: f64,
    /// Peak period of the waves [default: that of a fully developed sea of this height].
    #[arg(long, value_name = "TIME", value_parser = period)]
    period: Option<f64>,
    /// Angle of the line at the block from the vertical at which the boat keeps pace with the hauler.
    #[arg(long, value_name = "ANGLE", default_value = "15 deg", value_parser = lead, conflicts_with = "stay")]
    lead: f64,
    /// The boat does not follow the line.
    #[arg(long)]
    stay: bool,
    /// Drift of the boat with the tide's direction, against it below zero.
    #[arg(long, value_name = "SPEED", default_value = "0 m/s", value_parser = drift, allow_hyphen_values = true)]
    drift: f64,
    /// Break-out of traps from the seabed, as a multiple of that of their entries; 0 for none.
    #[arg(long, value_name = "TIMES", default_value_t = 1.0, value_parser = times)]
    break_out: f64,
    /// Buoy at which to begin [default: the first].
    #[arg(long, value_name = "ID")]
    buoy: Option<String>,
    /// Number of traps aboard at which the haul ends; 0 for all.
    #[arg(long, value_name = "N", default_value_t = 10)]
    aboard: usize,
    /// Longest segment of rope [default: a fortieth of the depth, from 0.5 m to 2 m].
    #[arg(long, value_name = "LENGTH", value_parser = segment)]
    segment: Option<f64>,
    /// Step of the simulation.
    #[arg(long, value_name = "TIME", default_value = "20 ms", value_parser = haul_step)]
    dt: f64,
    /// Seed of the waves.
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    /// Print the result as one JSON object.
    #[arg(long)]
    json: bool,
}

pub(super) fn haul_gear(args: &HaulArgs, library: Option<&Path>) -> Result<ExitCode, Failure> {
    let several = |count: usize| count > 1;
    let request = args.request();
    if args.table {
        let at = Sweep {
            depths_m: args.depth.clone(),
            traps: args.traps.clone(),
            tides_m_s: args.tide.clone(),
        };
        let each = |done, all| output::note(&format!("{done} of {all} hauls"));
        let rows = sweep(&args.assembly, &request, &at, (library, &host::load()), each)?;
        let json = || serde_json::to_string_pretty(&rows).map_err(Failure::failed);
        output::print(&if args.json { json()? + "\n" } else { table(&rows) })?;
        return Ok(ExitCode::SUCCESS);
    }
    if several(args.depth.len()) || several(args.traps.len()) || several(args.tide.len()) {
        return Err(Failure::usage("several depths, traps or tides: add --table"));
    }
    let sheet = haul(&args.assembly, &request, library, &host::load())?;
    output::print(&if args.json { json::indented(&sheet) + "\n" } else { words(&sheet) })?;
    Ok(ExitCode::SUCCESS)
}

impl HaulArgs {
    fn request(&self) -> HaulRequest {
        HaulRequest {
            site: self.site.clone(),
            depth_m: self.depth.first().copied(),
            tide_m_s: self.tide.first().copied(),
            sea_m: (self.sea > 0.0).then_some(self.sea),
            period_s: self.period,
            traps: self.traps.first().copied(),
            buoy: self.buoy.clone(),
            aboard: (self.aboard > 0).then_some(self.aboard),
            break_out: self.break_out,
            seed: self.seed,
            segment_m: self.segment,
            step_s: self.dt,
            how: Hauling {
                speed_m_s: self.speed,
                block_m: self.height,
                lead_rad: (!self.stay).then_some(self.lead),
                drift_m_s: DVec3::X * self.drift,
                ..HaulRequest::default().how
            },
        }
    }
}

fn words(sheet: &HaulSheet) -> String {
    let sea = match sheet.period_s {
        Some(period) => format!("waves of {:.1} m at {period:.1} s", sheet.sea_m),
        None => "a calm".to_owned(),
    };
    let mut text = format!(
        "{} at {}, {} m, tide {:.2} m/s, {sea}; hauled at {:.2} m/s over a block at {:.1} m\n\n",
        sheet.assembly, sheet.site, sheet.depth_m, sheet.tide_m_s, sheet.speed_m_s, sheet.block_m
    );
    let heads = [
        "until",
        "time",
        "rope in",
        "hanging",
        "lead",
        "at the hauler",
        "nearest to parting",
        "from buoy",
        "tension",
        "delivered",
        "used",
        "P(parts)",
    ];
    let mut rows = vec![heads.map(str::to_owned).to_vec()];
    rows.extend(sheet.stages.iter().map(stage));
    text += &columns(&rows);
    let mut rows = vec![
        ["part", "from buoy", "tension", "delivered", "used", "P(parts)"]
            .map(str::to_owned)
            .to_vec(),
    ];
    rows.extend(
        sheet
            .places
            .iter()
            .take(MOST_SHOWN)
            .map(|one| [vec![one.part.clone()], place(one)].concat()),
    );
    text += &columns(&rows);
    text += &format!(
        "at most {} at the hauler after {:.0} m of rope, {} hanging; {} of {} traps aboard in {:.0} s\nP(any part parts) {}\n",
        force(sheet.peak_N),
        sheet.peak_hauled_m,
        sheet.hanging,
        sheet.traps_aboard,
        sheet.traps,
        sheet.time_s,
        probability(sheet.parts)
    );
    if sheet.before != "at rest" {
        text += &format!("before the haul: {}\n", sheet.before);
    }
    if sheet.unconverged > 0 {
        text += &format!(
            "{} solver steps did not converge; no tension is read from them\n",
            sheet.unconverged
        );
    }
    text
}

fn stage(stage: &Stage) -> Vec<String> {
    let mut row = vec![
        stage.until.clone(),
        format!("{:.0} s", stage.time_s),
        format!("{:.0} m", stage.hauled_m),
        stage.hanging.to_string(),
        format!("{:.0}°", stage.lead_deg),
        force(stage.peak_N),
    ];
    if let Some(nearest) = &stage.nearest {
        let Place { part, .. } = nearest;
        row.push(part.clone());
        row.extend(place(nearest));
    }
    if let Some(last) = row.last_mut() {
        *last = probability(stage.parts);
    }
    row
}

fn place(place: &Place) -> Vec<String> {
    vec![
        place.from_buoy_m.map_or("-".to_owned(), |at| format!("{at:.0} m")),
        force(place.tension_N),
        force(place.delivered_N),
        format!("{:.0} %", 100.0 * place.used),
        probability(place.parts),
    ]
}

fn table(rows: &[SweepRow]) -> String {
    let heads = [
        "depth",
        "traps",
        "tide",
        "hanging",
        "at the hauler",
        "nearest to parting",
        "used",
        "P(parts)",
        "before the haul",
    ];
    let mut shown = vec![heads.map(str::to_owned).to_vec()];
    shown.extend(rows.iter().map(|row| {
        vec![
            format!("{} m", row.depth_m),
            row.traps.to_string(),
            format!("{:.2} m/s", row.tide_m_s),
            row.hanging.to_string(),
            force(row.peak_N),
            row.nearest.clone(),
            format!("{:.0} %", 100.0 * row.used),
            probability(row.parts),
            row.before.clone(),
        ]
    }));
    columns(&shown)
}

fn force(newtons: f64) -> String {
    newtons_and_lbf(newtons, 0)
}

fn probability(share: f64) -> String {
    if share < 1e-6 {
        "below 1e-6".to_owned()
    } else if share < 1e-3 {
        format!("{share:.0e}")
    } else {
        format!("{share:.3}")
    }
}

fn times(text: &str) -> Result<f64, String> {
    let times: Option<f64> = text.parse().ok();
    times
        .filter(|times| (0.0..=100.0).contains(times))
        .ok_or_else(|| "expected a number from 0 to 100".into())
}
