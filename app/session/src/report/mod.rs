//! The summary of a run: the data that figures are read from.
//!
//! Scripts depend on its JSON, schema `endline.run/1`: keys may be added, never renamed. Which keys
//! there are, what they mean and how they are read is declared in [`figures`](crate::figures).

mod from_run;
pub mod validity;

use endline_sim::Audit;
use endline_sim::balance::BalanceSummary;
use endline_sim::metrics::{Event, LineSummary, Summary};

use crate::plugins::PluginUsed;
use crate::timing::Timing;

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
    /// Why the numbers cannot be trusted, in plain words; empty where they can.
    pub invalid_because: Vec<String>,
    /// Why the run stopped before its end.
    pub stopped: Option<String>,
    /// Counters of the solver.
    pub audit: Audit,
    /// Momentum and energy of the gear by source, where the model tells them.
    pub balance: Option<BalanceSummary>,
    /// What was measured.
    pub summary: Summary,
    /// Greatest tension of each line in the settled state [N].
    pub settled_tension_n: Vec<f64>,
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
    /// What statics found, in words.
    pub outcome: String,
    /// Greatest force out of balance [N].
    pub residual_n: f64,
}

impl Report {
    /// Whether the numbers can be trusted, within the bounds of [`validity`].
    #[must_use]
    pub fn is_valid(&self) -> bool {
        self.invalid_because.is_empty()
    }

    /// The line with the greatest tension, the first of them where several have it.
    #[must_use]
    pub fn greatest(&self) -> Option<&LineSummary> {
        self.summary.lines.iter().fold(None, |most: Option<&LineSummary>, line| match most {
            Some(most) if most.peak_tension_n >= line.peak_tension_n => Some(most),
            _ => Some(line),
        })
    }

    /// Time [s] and id of the weak link or line that parted first; a link before a line of the same
    /// time.
    #[must_use]
    pub fn first_parted(&self) -> Option<(f64, &String)> {
        let links = self.summary.links.iter().map(|link| (link.parted_at_s, &link.id));
        let lines = self.summary.lines.iter().map(|line| (line.parted_at_s, &line.id));
        let parted = links.chain(lines).filter_map(|(time_s, id)| Some((time_s?, id)));
        parted.fold(None, |least: Option<(f64, &String)>, next| match least {
            Some(least) if least.0 <= next.0 => Some(least),
            _ => Some(next),
        })
    }
}
