//! A run: a settled model stepped through time, measured and recorded on the way.

mod log;
mod over;

use std::io;
use std::ops::Range;
use std::path::Path;
use std::sync::Arc;
use std::time::{Duration, Instant};

use endline_sdk::Controls;
use endline_sim::balance::{Balance, BalanceSummary};
use endline_sim::metrics::{Metrics, Summary};
use endline_sim::whale::pilot::memory_for;
use endline_sim::{
    Audit, ContactPoint, Frame, Input, Model, Outcome, Settled, State, Stop, Workspace, settle,
    step,
};

use crate::error::Error;
use crate::hash::{PARTS, StateHash};
use crate::recording::{self, Header, Recording, Rows, words};
use crate::source::Prepared;
use crate::timing::{Timing, clock_ns};
use log::Log;

/// How a run is kept.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RunOptions {
    /// Start even where statics did not converge.
    pub unsettled: bool,
    /// Frames kept for each simulated second, fewer of a long run; 0 keeps none.
    pub frames_hz: f64,
}

/// Most frames kept: those of a line of 500 nodes take 50 MB.
const MOST_FRAMES: usize = 2048;

/// A run in progress.
pub struct Run {
    prepared: Prepared,
    options: RunOptions,
    state: State,
    workspace: Workspace,
    metrics: Metrics,
    inputs: Log<{ Controls::COUNT }>,
    hashes: Log<PARTS>,
    frames: Vec<Arc<Frame>>,
    /// How often every second frame was dropped.
    thinned: u32,
    settled: Arc<Settled>,
    stopped: Option<Stop>,
    /// Since when every check has found it invalid [s].
    invalid_since_s: Option<f64>,
    timing: Timing,
}

impl Run {
    /// Settles the model, where its scenario does not start it as placed, and stands ready for the first step.
    pub fn new(prepared: Prepared, options: RunOptions) -> Result<Self, Error> {
        let start = Instant::now();
        let model = &prepared.model;
        let settled = if model.spec.settings.as_placed { as_placed(model) } else { settle(model) };
        if !settled.converged && !options.unsettled {
            return Err(Error::Unsettled { why: settled.why(), passes: settled.trace_n.len() });
        }
        Ok(Self::from_rest(prepared, options, Arc::new(settled), start.elapsed()))
    }

    /// Stands ready for the first step with gear that was settled before: [`Settled::with_whale_of`] of the model.
    pub fn from_settled(prepared: Prepared, options: RunOptions, settled: Arc<Settled>) -> Self {
        Self::from_rest(prepared, options, settled, Duration::ZERO)
    }

    /// The run at its start again, without settling again.
    pub fn restarted(&self) -> Self {
        Self::from_rest(
            self.prepared.clone(),
            self.options,
            Arc::clone(&self.settled),
            Duration::ZERO,
        )
    }

    fn from_rest(
        prepared: Prepared,
        options: RunOptions,
        settled: Arc<Settled>,
        settled_in: Duration,
    ) -> Self {
        let mut run = Self {
            workspace: Workspace::new(&prepared.model),
            metrics: Metrics::new(&prepared.model),
            inputs: Log::new(),
            hashes: Log::new(),
            frames: Vec::new(),
            thinned: 0,
            stopped: None,
            invalid_since_s: None,
            state: settled.state.clone(),
            timing: Timing::settled_in(settled_in),
            settled,
            prepared,
            options,
        };
        run.workspace.lend_clock(clock_ns);
        run.hashes.push(StateHash::of(&Input::default(), &run.state).parts);
        run.metrics.fold(&run.prepared.model, &run.state, &[]);
        run.keep_frame();
        run
    }

    /// Takes one step under these controls, kept within their ranges.
    pub fn step(&mut self, controls: Controls) -> Result<(), Stop> {
        self.step_raw(controls.within_range(self.acts()))?;
        match self.stuck() {
            None => Ok(()),
            Some(stop) => {
                self.stopped = Some(stop.clone());
                Err(stop)
            }
        }
    }

    /// Takes one step under recorded controls, bit for bit.
    pub(crate) fn step_raw(&mut self, controls: Controls) -> Result<(), Stop> {
        if let Some(stop) = &self.stopped {
            return Err(stop.clone());
        }
        let input = Input { controls };
        self.inputs.push(words(&controls));
        let near = self.workspace.audit.contact_steps;
        let start = Instant::now();
        let stepped = step(&self.prepared.model, &input, &mut self.state, &mut self.workspace);
        self.timing.add(start.elapsed(), self.step_s(), self.workspace.audit.contact_steps > near);
        if let Err(stop) = stepped {
            self.timing.add_cost(self.workspace.cost(), Duration::ZERO);
            self.stopped = Some(stop.clone());
            return Err(stop);
        }
        let stepped_at = Instant::now();
        self.hashes.push(StateHash::of(&input, &self.state).parts);
        self.metrics.fold_step(&self.prepared.model, &self.state, &self.workspace);
        self.keep_frame();
        self.timing.add_cost(self.workspace.cost(), stepped_at.elapsed());
        Ok(())
    }

    /// Runs by the pilot program to the end of the scenario or to a stop, telling the steps taken and in all.
    pub fn to_end(&mut self, mut progress: impl FnMut(u64, u64)) {
        self.to_end_until(|run| {
            progress(run.state.step, run.steps_in_all());
            false
        });
    }

    /// Runs by the pilot program to the end of the scenario, to a stop, or until `over` says after a step that it is enough.
    pub fn to_end_until(&mut self, mut over: impl FnMut(&mut Self) -> bool) {
        while !self.finished() && self.step(self.pilot()).is_ok() {
            if over(self) {
                return;
            }
        }
    }

    /// Ends the run here, with a reason.
    pub fn give_up(&mut self, reason: &str) {
        self.stopped =
            Some(Stop { time_s: self.state.time_s, part: "the run".into(), reason: reason.into() });
    }

    /// The pilot program's controls for the next step.
    pub fn pilot(&self) -> Controls {
        self.model()
            .spec
            .whale
            .as_ref()
            .map_or_else(Controls::default, |whale| whale.pilot.at(&self.state))
    }

    /// How many acts the whale's motion declares.
    fn acts(&self) -> usize {
        self.model().spec.whale.as_ref().map_or(0, |whale| whale.motion.descriptor().acts.len())
    }

    /// Whether the scenario's time is over or the run is stopped.
    pub fn finished(&self) -> bool {
        self.stopped.is_some() || self.state.step >= self.steps_in_all()
    }

    /// Steps of the whole scenario.
    pub fn steps_in_all(&self) -> u64 {
        let settings = &self.model().spec.settings;
        // Rounded up, but not for the last bits of a quotient such as 60 / 0.01.
        (settings.duration_s / settings.step_s - 1e-6).ceil().max(0.0) as u64
    }

    /// Length of a step [s].
    pub fn step_s(&self) -> f64 {
        self.model().spec.settings.step_s
    }

    /// The model.
    pub fn model(&self) -> &Arc<Model> {
        &self.prepared.model
    }

    /// The texts that it was made from.
    pub fn prepared(&self) -> &Prepared {
        &self.prepared
    }

    /// The state now.
    pub fn state(&self) -> &State {
        &self.state
    }

    /// Why it stopped before its end, if it did.
    pub fn stopped(&self) -> Option<&Stop> {
        self.stopped.as_ref()
    }

    /// The moment now.
    pub fn frame(&self) -> Arc<Frame> {
        let Workspace { contacts, body_contacts, .. } = &self.workspace;
        Arc::new(Frame::of(&self.state, contacts, body_contacts))
    }

    /// The controls of the first steps, of all where there are fewer.
    pub fn inputs(&self, steps: usize) -> Result<Vec<Controls>, Error> {
        let rows = self.inputs.first(steps).map_err(|error| lost(&error))?;
        Ok(rows.into_iter().map(|row| Controls::from_array(row.map(f64::from_bits))).collect())
    }

    /// Places where rope presses on skin, at the end of the last step.
    pub fn contacts(&self) -> &[ContactPoint] {
        &self.workspace.contacts
    }

    /// The frames kept so far, at the rate asked for.
    pub fn frames(&self) -> &[Arc<Frame>] {
        &self.frames
    }

    /// Counters of the solver.
    pub fn audit(&self) -> Audit {
        self.workspace.audit
    }

    /// Momentum and energy of the gear by source, where the model computes them.
    pub fn balance(&self) -> Option<BalanceSummary> {
        self.workspace.balance.summary(self.model(), &self.state)
    }

    /// How long it took, approach and contact apart.
    pub fn timing(&self) -> &Timing {
        &self.timing
    }

    /// The metrics so far.
    pub fn summary(&self) -> Summary {
        self.metrics.summary(self.model(), &self.state)
    }

    /// The metrics as they stand, with their events.
    pub fn metrics(&self) -> &Metrics {
        &self.metrics
    }

    /// The gear at rest, from which it started.
    pub fn settled(&self) -> &Settled {
        &self.settled
    }

    /// Greatest tension of each line within the last step, or at rest before the first [N].
    pub fn peak_tensions_n(&self) -> Vec<f64> {
        let peaks_n = by_line(self.model(), self.segment_peaks_n());
        let unconverged_n = by_line(self.model(), &self.workspace.unconverged_peak_n);
        peaks_n.iter().zip(unconverged_n).map(|(peak, other)| peak.max(other)).collect()
    }

    /// Greatest tension of each segment in the solver steps of the last step that converged, in the model's layout [N].
    pub fn segment_peaks_n(&self) -> &[f64] {
        if self.state.step == 0 { &self.state.rope.tension } else { &self.workspace.peak_tension_n }
    }

    /// Hash of the state now.
    pub fn state_hash(&self) -> StateHash {
        self.hashes.last().map_or_else(StateHash::default, |parts| StateHash { parts })
    }

    /// The run so far as a recording, all of it in memory.
    pub fn recording(&self) -> Result<Recording, Error> {
        let hashes = self.hashes.first(self.hashes.len()).map_err(|error| lost(&error))?;
        Ok(Recording {
            header: self.header(),
            source: (*self.prepared.source).clone(),
            inputs: self.inputs(self.inputs.len())?,
            hashes: hashes.into_iter().map(|parts| StateHash { parts }).collect(),
            damage: None,
        })
    }

    /// Saves the run so far as a recording, so that a crash leaves the old file whole.
    pub fn save_recording(&self, path: &Path) -> Result<(), Error> {
        let rows: [&dyn Rows; 2] = [&self.inputs, &self.hashes];
        recording::save_rows(path, &self.header(), &self.prepared.source, rows)
    }

    fn header(&self) -> Header {
        let settings = &self.model().spec.settings;
        Header {
            program: crate::VERSION.into(),
            model_hash: self.prepared.source.hash(),
            plugins: self.prepared.plugins.clone(),
            seed: settings.seed,
            dt_s: settings.step_s,
            unsettled: self.options.unsettled,
            stopped: self.stopped.as_ref().map(|stop| Error::Stopped(stop.clone()).to_string()),
        }
    }

    fn keep_frame(&mut self) {
        if self.options.frames_hz <= 0.0 {
            return;
        }
        let stride = frame_stride(self.options.frames_hz, self.step_s()) << self.thinned;
        if self.state.step.is_multiple_of(stride) {
            self.frames.push(self.frame());
        }
        if self.frames.len() > MOST_FRAMES {
            // A long run keeps every second of its frames, and half as many from here on.
            self.thinned += 1;
            let mut place = 0;
            self.frames.retain(|_| {
                place += 1;
                place % 2 == 1
            });
        }
    }
}

/// The older steps of a long run are in a file without a name.
fn lost(error: &io::Error) -> Error {
    Error::Message(format!("the steps of the run cannot be read again: {error}"))
}

/// The parts where they are placed, taken as they are.
pub(crate) fn as_placed(model: &Model) -> Settled {
    Settled {
        state: State::start(model),
        outcome: Outcome::AtRest,
        residual_n: 0.0,
        worst: None,
        converged: true,
        trace_n: Vec::new(),
    }
}

/// Steps from one kept frame to the next: the whole number nearest to the rate asked for.
pub(crate) fn frame_stride(frames_hz: f64, step_s: f64) -> u64 {
    (1.0 / (frames_hz * step_s)).round().max(1.0) as u64
}

/// Greatest of each line's segments, never below zero.
pub(crate) fn by_line(model: &Model, segments: &[f64]) -> Vec<f64> {
    let greatest = |own: &Range<usize>| {
        segments.get(own.clone()).unwrap_or_default().iter().copied().fold(0.0, f64::max)
    };
    model.line_segments.iter().map(greatest).collect()
}

/// The state of a run at the end of a step.
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

impl Moment {
    /// Steps so far.
    pub fn step(&self) -> usize {
        self.steps
    }

    /// The moment that a model with another pilot program would have had after the same inputs; `None` if it cannot be known from this one
    /// alone ([`memory_for`]).
    pub fn with_pilot_of(mut self, from: &Model, to: &Model) -> Option<Self> {
        let (Some(before), Some(after)) = (&from.spec.whale, &to.spec.whale) else {
            return Some(self);
        };
        let programs = [&before.pilot, &after.pilot];
        self.state.pilot = memory_for(&self.state.pilot, programs, self.state.time_s)?;
        Some(self)
    }
}

impl Run {
    /// This moment.
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

    /// The run of another model that had the same states up to a moment of this one; it continues from there.
    ///
    /// The models may differ only where it had no effect until then, such as in strengths above every tension so far.
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
