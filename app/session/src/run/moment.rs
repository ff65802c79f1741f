//! A moment of a run, from which another run goes on.

use std::io;
use std::sync::Arc;

use endline_sim::balance::Balance;
use endline_sim::metrics::Metrics;
use endline_sim::{Audit, Frame, State, Workspace};

use crate::source::Prepared;
use crate::timing::clock_ns;

use super::Run;

/// What a run is at the end of one of its steps.
#[derive(Clone, Debug)]
pub struct Moment {
    state: State,
    metrics: Metrics,
    audit: Audit,
    balance: Balance,
    invalid_since_s: Option<f64>,
    /// Steps so far.
    steps: usize,
}

impl Run {
    /// This moment.
    #[must_use]
    pub fn moment(&self) -> Moment {
        Moment {
            state: self.state.clone(),
            metrics: self.metrics.clone(),
            audit: self.workspace.audit,
            balance: self.workspace.balance,
            invalid_since_s: self.invalid_since_s,
            steps: self.inputs.len(),
        }
    }

    /// The run of another model that had the same run up to a moment of this one: it goes on from there.
    ///
    /// The models differ in nothing that had any effect until then, such as in strengths above every tension so far.
    ///
    /// # Errors
    /// Where the steps of a long run cannot be read again.
    pub fn branched(&self, moment: &Moment, prepared: Prepared) -> io::Result<Self> {
        // A workspace is scratch: a new one changes no bit.
        let mut workspace = Workspace::new(&prepared.model);
        workspace.audit = moment.audit;
        workspace.balance = moment.balance;
        workspace.lend_clock(clock_ns);
        Ok(Self {
            workspace,
            metrics: moment.metrics.clone(),
            inputs: self.inputs.begun(moment.steps)?,
            hashes: self.hashes.begun(moment.steps + 1)?,
            frames: self.frames_until(moment.steps),
            thinned: self.thinned,
            state: moment.state.clone(),
            settled: Arc::clone(&self.settled),
            stopped: None,
            invalid_since_s: moment.invalid_since_s,
            timing: self.timing,
            options: self.options,
            prepared,
        })
    }

    /// The frames kept of the first steps.
    fn frames_until(&self, steps: usize) -> Vec<Arc<Frame>> {
        let frames = self.frames.iter().take_while(|frame| frame.step <= steps as u64);
        frames.cloned().collect()
    }
}
