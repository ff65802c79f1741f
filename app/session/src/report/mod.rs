//! The summary of a run: the data that figures are read from.
//!
//! Scripts depend on its JSON, schema `endline.run/1`: keys may be added, never renamed. Which keys
//! exist, their meanings and how they are read is declared in [`figures`](crate::figures).

pub mod headline;
pub mod needed;
pub mod validity;

use endline_sim::Audit;
use endline_sim::balance::BalanceSummary;
use endline_sim::metrics::{Event, LineSummary, Summary};

use self::headline::{Headline, Sentence};
use self::needed::NeededStrength;
use crate::error::Error;
use crate::plugins::PluginUsed;
use crate::run::{Run, by_line};
use crate::timing::Timing;
use crate::units::newtons_and_lbf;

/// Name of the schema.
pub const SCHEMA: &str = "endline.run/1";

/// Summary of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Report {
    /// The scenario's file as the user named it.
    pub scenario: String,
    /// Seed.
    pub seed: u64,
    /// Simulated time [s].
    pub simulated_s: f64,
    /// Real time by phase.
    pub timing: Timing,
    /// Step between inputs [s].
    pub dt_s: f64,
    /// Steps taken.
    pub steps: u64,
    /// Rope nodes.
    pub nodes: usize,
    /// Triangles of the whale's skin.
    pub triangles: usize,
    /// Hash of the last state, hexadecimal.
    pub state_hash: String,
    /// The result in a few sentences, forces in newtons and pounds-force.
    pub headline: Vec<Sentence>,
    /// Why the numbers cannot be trusted, in plain words; empty where they can.
    pub invalid_because: Vec<String>,
    /// Why the run stopped before its end.
    pub stopped: Option<String>,
    /// Counters of the solver.
    pub audit: Audit,
    /// Momentum and energy of the gear by source, where the model computes them.
    pub balance: Option<BalanceSummary>,
    /// The measurements.
    pub summary: Summary,
    /// Greatest tension of each line in the settled state [N].
    pub settled_tension_n: Vec<f64>,
    /// Strengths with which nothing parts in this run.
    pub needed: NeededStrength,
    /// The statics before the run.
    pub settled: SettledReport,
    /// Events in the order in which they were noticed.
    pub events: Vec<Event>,
    /// BLAKE3 of the scenario, the gear library and the options, hexadecimal.
    pub model_hash: String,
    /// Plugins of the model.
    pub plugins: Vec<PluginUsed>,
}

/// The statics before a run.
#[derive(Clone, Debug, PartialEq)]
pub struct SettledReport {
    /// Whether the run began from rest.
    pub converged: bool,
    /// The outcome of statics, in words.
    pub outcome: String,
    /// Greatest force out of balance [N].
    pub residual_n: f64,
}

impl Report {
    /// Whether the numbers can be trusted, within the bounds of [`validity`].
    pub fn is_valid(&self) -> bool {
        self.invalid_because.is_empty()
    }

    /// Why the run does not count: where it stopped, else why it is invalid; empty where it is valid.
    pub fn fault(&self) -> String {
        let stopped = self.stopped.clone().filter(|_| !self.is_valid());
        stopped.unwrap_or_else(|| self.invalid_because.join("; "))
    }

    /// The line with the greatest tension, the first of them where several have it.
    pub fn greatest(&self) -> Option<&LineSummary> {
        greatest(&self.summary)
    }

    /// Time [s] and id of the weak link or line that parted first; a link before a line of the same
    /// time.
    pub fn first_parted(&self) -> Option<(f64, &String)> {
        let links = self.summary.links.iter().map(|link| (link.parted_at_s, &link.id));
        let lines = self.summary.lines.iter().map(|line| (line.parted_at_s, &line.id));
        let parted = links.chain(lines).filter_map(|(time_s, id)| Some((time_s?, id)));
        parted.fold(None, |least: Option<(f64, &String)>, next| match least {
            Some(least) if least.0 <= next.0 => Some(least),
            _ => Some(next),
        })
    }

    /// The summary of a run so far.
    pub fn from_run(run: &Run) -> Self {
        let model = run.model();
        let settings = &model.spec.settings;
        let (audit, prepared) = (run.audit(), run.prepared());
        let summary = run.summary();
        let stopped = run.stopped().map(|stop| Error::Stopped(stop.clone()).to_string());
        let invalid_because = validity::reasons(stopped.as_deref(), &audit, summary.whale.as_ref());
        let headline = Headline::of(
            model,
            &summary,
            &prepared.strengths,
            &audit,
            &invalid_because,
            run.state().time_s,
        )
        .sentences(|force_n| newtons_and_lbf(force_n, 0));
        Self {
            scenario: prepared.source.scenario_name.clone(),
            seed: settings.seed,
            simulated_s: run.state().time_s,
            timing: *run.timing(),
            dt_s: settings.step_s,
            steps: run.state().step,
            nodes: model.node_count,
            triangles: model.spec.whale.as_ref().map_or(0, |whale| whale.skin.triangles.len()),
            state_hash: run.state_hash().hex(),
            headline,
            invalid_because,
            stopped,
            audit,
            balance: run.balance(),
            needed: NeededStrength::of(model, &summary, &prepared.strengths),
            summary,
            settled_tension_n: by_line(model, &run.settled().state.rope.tension),
            settled: SettledReport {
                converged: run.settled().converged,
                outcome: run.settled().outcome.to_string(),
                residual_n: run.settled().residual_n,
            },
            events: run.metrics().events().to_vec(),
            model_hash: prepared.source.hash(),
            plugins: prepared.plugins.clone(),
        }
    }
}

/// The line with the greatest tension, the first of them where several have it.
fn greatest(summary: &Summary) -> Option<&LineSummary> {
    summary.lines.iter().fold(None, |most: Option<&LineSummary>, line| match most {
        Some(most) if most.peak_tension_n >= line.peak_tension_n => Some(most),
        _ => Some(line),
    })
}
