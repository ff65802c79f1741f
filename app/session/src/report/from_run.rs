//! From a run to its summary.

use super::{Report, SettledReport, validity};
use crate::error::Error;
use crate::run::{Run, by_line};

impl Report {
    /// The summary of a run as it stands.
    #[must_use]
    pub fn from_run(run: &Run) -> Self {
        let model = run.model();
        let settings = &model.spec.settings;
        let (audit, prepared) = (run.audit(), run.prepared());
        let summary = run.summary();
        let stopped = run.stopped().map(|stop| Error::Stopped(stop.clone()).to_string());
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
            invalid_because: validity::reasons(stopped.as_deref(), &audit, summary.whale.as_ref()),
            stopped,
            audit,
            balance: run.balance(),
            summary,
            settled_tension_n: by_line(model, &run.settled().state.rope.tension),
            settled: settled(run),
            events: run.metrics().events().to_vec(),
            model_hash: prepared.source.hash(),
            plugins: prepared.plugins.clone(),
        }
    }
}

fn settled(run: &Run) -> SettledReport {
    let settled = run.settled();
    SettledReport {
        converged: settled.converged,
        outcome: settled.outcome.to_string(),
        residual_n: settled.residual_n,
    }
}
