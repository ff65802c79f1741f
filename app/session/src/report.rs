//! The summary of a run as JSON: schema `endline.run/1`. Scripts depend on it; keys may be added,
//! never renamed. Each key that carries a unit ends in it.

use endline_sim::Audit;
use endline_sim::metrics::{Summary, WhaleSummary};
use serde::Serialize;

use crate::error::Error;
use crate::recording::PluginUsed;
use crate::run::{Run, by_line};
use crate::timing::Phase;

/// Name of the schema.
pub const SCHEMA: &str = "endline.run/1";

/// Summary of a run.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    /// Always [`SCHEMA`].
    pub schema: &'static str,
    /// The scenario's file as the user named it.
    pub scenario: String,
    /// Seed.
    pub seed: u64,
    /// Simulated time [s].
    pub simulated_s: f64,
    /// Real time of the steps, statics apart [s].
    pub wall_s: f64,
    /// Simulated seconds for each real one.
    pub times_real_time: f64,
    /// Step between inputs [s].
    pub dt_s: f64,
    /// Steps taken.
    pub steps: u64,
    /// Rope nodes.
    pub nodes: usize,
    /// Triangles of the whale's skin.
    pub triangles: usize,
    /// Hash of the last state.
    pub state_hash: String,
    /// Whether the numbers can be trusted: not stopped, nothing tunnelled, nothing not finite.
    pub valid: bool,
    /// Why the run stopped before its end.
    pub stopped: Option<String>,
    /// What the reader should know of the solver's work.
    pub audit: AuditReport,
    /// One for each line.
    pub lines: Vec<LineReport>,
    /// One for each weak link.
    pub links: Vec<LinkReport>,
    /// One for each body.
    pub bodies: Vec<BodyReport>,
    /// One for each probe.
    pub probes: Vec<ProbeReport>,
    /// The whale; `null` without one.
    pub whale: Option<WhaleReport>,
    /// Steps before rope first came near the whale.
    pub approach: PhaseReport,
    /// That step and all after it.
    pub contact: PhaseReport,
    /// The statics before the run.
    pub settled: SettledReport,
    /// Events in the order in which they were noticed.
    pub events: Vec<EventReport>,
    /// Version of Endline.
    pub version: &'static str,
    /// BLAKE3 of the scenario, the gear library and the options.
    pub model_hash: String,
    /// Plugins of the model.
    pub plugins: Vec<PluginUsed>,
}

/// See [`Audit`].
#[derive(Clone, Debug, Serialize)]
pub struct AuditReport {
    /// Times rope passed through skin.
    pub tunnelled: u64,
    /// Deepest the rope's surface sank into the skin [m].
    pub max_penetration_m: f64,
    /// Numbers that were not finite.
    pub non_finite: u64,
    /// Solver steps.
    pub solver_steps: u64,
    /// Solver steps with rope near the whale.
    pub contact_steps: u64,
    /// Solver steps redone shorter.
    pub halved: u64,
    /// Solver steps accepted above the wanted residual.
    pub unconverged: u64,
    /// Newton passes.
    pub passes: u64,
}

/// A line.
#[derive(Clone, Debug, Serialize)]
#[allow(non_snake_case, reason = "keys of the JSON contract carry their units")]
pub struct LineReport {
    /// Id.
    pub id: String,
    /// Greatest tension of any segment [N].
    pub peak_tension_N: f64,
    /// When that was [s].
    pub peak_at_s: f64,
    /// Tension at end A at the end [N].
    pub end_a_tension_N: f64,
    /// Tension at end B at the end [N].
    pub end_b_tension_N: f64,
    /// Greatest tension of any segment in the settled state [N].
    pub settled_tension_N: f64,
    /// When it parted [s].
    pub parted_at_s: Option<f64>,
}

/// A weak link.
#[derive(Clone, Debug, Serialize)]
#[allow(non_snake_case, reason = "keys of the JSON contract carry their units")]
pub struct LinkReport {
    /// Id.
    pub id: String,
    /// Tension above which it parts [N].
    pub rating_N: f64,
    /// Greatest tension it bore [N].
    pub peak_tension_N: f64,
    /// When it parted [s].
    pub parted_at_s: Option<f64>,
}

/// A body.
#[derive(Clone, Debug, Serialize)]
pub struct BodyReport {
    /// Id.
    pub id: String,
    /// Place at the end [m].
    pub position_m: [f64; 3],
    /// Greatest speed [m/s].
    pub peak_speed_m_s: f64,
}

/// A probe.
#[derive(Clone, Debug, Serialize)]
pub struct ProbeReport {
    /// Id.
    pub id: String,
    /// Unit of the numbers.
    pub unit: &'static str,
    /// Reading at the end.
    #[serde(rename = "final")]
    pub last: f64,
    /// Least.
    pub min: f64,
    /// Greatest.
    pub max: f64,
    /// Mean over time.
    pub mean: f64,
}

/// The whale.
#[derive(Clone, Debug, Serialize)]
#[allow(non_snake_case, reason = "keys of the JSON contract carry their units")]
pub struct WhaleReport {
    /// `no_contact`, `shed`, `entangled`, `parted_free` or `parted_entangled`.
    pub outcome: &'static str,
    /// Whether the run was long enough for that to stand.
    pub decided: bool,
    /// When rope first touched [s].
    pub first_contact_s: Option<f64>,
    /// When rope last touched [s].
    pub last_contact_s: Option<f64>,
    /// Time with rope touching [s].
    pub contact_time_s: f64,
    /// One for each body part.
    pub regions: Vec<RegionReport>,
    /// Drag of rope and gear the whale carries [N].
    pub drag_added_N: f64,
    /// Rope from the whale to loose ends [m].
    pub trailing_m: f64,
    /// Rope from the whale to what holds it [m].
    pub tethered_m: f64,
}

/// Rope on a body part.
#[derive(Clone, Debug, Serialize)]
#[allow(non_snake_case, reason = "keys of the JSON contract carry their units")]
pub struct RegionReport {
    /// Name of the part.
    pub region: &'static str,
    /// Wraps at the end [turns].
    pub wraps: f64,
    /// Most wraps [turns].
    pub peak_wraps: f64,
    /// Rope in contact at the end [m].
    pub contact_length_m: f64,
    /// Most rope in contact [m].
    pub peak_contact_length_m: f64,
    /// Greatest sum of normal forces [N].
    pub peak_normal_N: f64,
    /// Greatest pressure under the rope [Pa].
    pub peak_pressure_Pa: f64,
    /// Work of friction [J].
    pub friction_work_J: f64,
}

/// A phase of a run.
#[derive(Clone, Debug, Serialize)]
pub struct PhaseReport {
    /// Simulated time [s].
    pub simulated_s: f64,
    /// Real time [s].
    pub wall_s: f64,
    /// Simulated seconds for each real one; 0 where the phase is empty.
    pub times_real_time: f64,
}

/// The statics before a run.
#[derive(Clone, Debug, Serialize)]
#[allow(non_snake_case, reason = "keys of the JSON contract carry their units")]
pub struct SettledReport {
    /// Greatest force out of balance [N].
    pub residual_N: f64,
    /// Real time [s].
    pub wall_s: f64,
}

/// Something that happened.
#[derive(Clone, Debug, Serialize)]
pub struct EventReport {
    /// When [s].
    pub time_s: f64,
    /// What, such as `link_parted`.
    pub kind: &'static str,
    /// Of what.
    pub subject: String,
    /// The number that goes with it.
    pub value: f64,
    /// Its unit.
    pub unit: &'static str,
}

impl Report {
    /// The summary of a run as it stands.
    #[must_use]
    pub fn of(run: &Run) -> Self {
        let model = run.model();
        let settings = &model.spec.settings;
        let (audit, whole) = (run.audit(), run.timing().whole());
        let Summary { lines: _, links, bodies, probes, whale } = run.summary();
        Self {
            schema: SCHEMA,
            scenario: run.prepared().source.scenario_name.clone(),
            seed: settings.seed,
            simulated_s: run.state().time_s,
            wall_s: whole.wall_s,
            times_real_time: whole.times_real_time(),
            dt_s: settings.step_s,
            steps: run.state().step,
            nodes: model.node_count,
            triangles: model.spec.whale.as_ref().map_or(0, |whale| whale.skin.triangles.len()),
            state_hash: run.state_hash().hex(),
            valid: run.stopped().is_none() && audit.tunnelled == 0 && audit.non_finite == 0,
            stopped: run.stopped().map(|stop| Error::Stopped(stop.clone()).to_string()),
            audit: audit_report(&audit),
            lines: line_reports(run),
            links: links.into_iter().map(LinkReport::from).collect(),
            bodies: bodies.into_iter().map(BodyReport::from).collect(),
            probes: probes.into_iter().map(ProbeReport::from).collect(),
            whale: whale.map(whale_report),
            approach: phase_report(&run.timing().approach),
            contact: phase_report(&run.timing().contact),
            settled: SettledReport { residual_N: run.settled().residual_n, wall_s: run.timing().settle_wall_s },
            events: event_reports(run),
            version: env!("CARGO_PKG_VERSION"),
            model_hash: run.prepared().source.hash(),
            plugins: run.prepared().plugins.clone(),
        }
    }

    /// One line of JSON.
    #[must_use]
    pub fn json(&self) -> String {
        // Structs of numbers and strings always serialise; the empty string would fail every reader at once.
        serde_json::to_string(self).unwrap_or_default()
    }
}

fn audit_report(audit: &Audit) -> AuditReport {
    let Audit { tunnelled, max_penetration_m, non_finite, solver_steps, contact_steps, halved, unconverged, passes } = *audit;
    AuditReport { tunnelled, max_penetration_m, non_finite, solver_steps, contact_steps, halved, unconverged, passes }
}

fn line_reports(run: &Run) -> Vec<LineReport> {
    let report = |(line, settled): (endline_sim::metrics::LineSummary, &f64)| LineReport {
        id: line.id,
        peak_tension_N: line.peak_tension_n,
        peak_at_s: line.peak_at_s,
        end_a_tension_N: line.end_a_tension_n,
        end_b_tension_N: line.end_b_tension_n,
        settled_tension_N: *settled,
        parted_at_s: line.parted_at_s,
    };
    let settled = by_line(run.model(), &run.settled().state.rope.tension);
    run.summary().lines.into_iter().zip(&settled).map(report).collect()
}

impl From<endline_sim::metrics::LinkSummary> for LinkReport {
    fn from(link: endline_sim::metrics::LinkSummary) -> Self {
        Self { id: link.id, rating_N: link.rating_n, peak_tension_N: link.peak_tension_n, parted_at_s: link.parted_at_s }
    }
}

impl From<endline_sim::metrics::BodySummary> for BodyReport {
    fn from(body: endline_sim::metrics::BodySummary) -> Self {
        Self { id: body.id, position_m: body.position_m.to_array(), peak_speed_m_s: body.peak_speed_m_s }
    }
}

impl From<endline_sim::metrics::ProbeSummary> for ProbeReport {
    fn from(probe: endline_sim::metrics::ProbeSummary) -> Self {
        Self { id: probe.id, unit: probe.unit, last: probe.last, min: probe.min, max: probe.max, mean: probe.mean }
    }
}

fn whale_report(whale: WhaleSummary) -> WhaleReport {
    WhaleReport {
        outcome: whale.outcome.name(),
        decided: whale.decided,
        first_contact_s: whale.first_contact_s,
        last_contact_s: whale.last_contact_s,
        contact_time_s: whale.contact_time_s,
        regions: whale.regions.into_iter().map(RegionReport::from).collect(),
        drag_added_N: whale.drag_added_n,
        trailing_m: whale.trailing_m,
        tethered_m: whale.tethered_m,
    }
}

impl From<endline_sim::metrics::RegionSummary> for RegionReport {
    fn from(region: endline_sim::metrics::RegionSummary) -> Self {
        Self {
            region: region.part.name(),
            wraps: region.wraps,
            peak_wraps: region.peak_wraps,
            contact_length_m: region.contact_length_m,
            peak_contact_length_m: region.peak_contact_length_m,
            peak_normal_N: region.peak_normal_n,
            peak_pressure_Pa: region.peak_pressure_pa,
            friction_work_J: region.friction_work_j,
        }
    }
}

fn phase_report(phase: &Phase) -> PhaseReport {
    PhaseReport { simulated_s: phase.simulated_s, wall_s: phase.wall_s, times_real_time: phase.times_real_time() }
}

fn event_reports(run: &Run) -> Vec<EventReport> {
    let report = |event: &endline_sim::metrics::Event| EventReport {
        time_s: event.time_s,
        kind: event.kind.name(),
        subject: event.subject.clone(),
        value: event.value,
        unit: event.kind.unit(),
    };
    run.metrics().events().iter().map(report).collect()
}
