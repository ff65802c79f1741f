//! The thread of a live run: takes commands, steps when due, publishes views.

#![deny(clippy::wildcard_enum_match_arm, reason = "each command must be dispatched")]

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::sync::mpsc::{Receiver, RecvTimeoutError};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use endline_sdk::Controls;
use endline_sim::{Audit, Cost, Frame, State};

use super::history::{Envelope, FrameHistory, KeptState, KeptStates, Series, Watch};
use super::{LiveView, Made, Pace, RunCommand, Status};
use crate::error::Error;
use crate::plugins::PluginHost;
use crate::recording::program::program;
use crate::run::{Run, RunOptions, frame_stride};
use crate::source::Prepared;

/// Views published for each real second, at most.
const VIEWS_HZ: f64 = 60.0;
/// Frames and tensions kept for each simulated second.
const KEPT_HZ: f64 = 30.0;
/// Speeds a user may ask for; above it, as fast as the solver runs.
const SPEEDS: [f64; 2] = [0.01, 1000.0];

/// Where views are put.
pub(super) struct Screen {
    pub(super) view: Arc<Mutex<Arc<LiveView>>>,
    pub(super) on_view: Box<dyn Fn() + Send>,
}

impl Screen {
    fn show(&self, view: LiveView) {
        *self.view.lock().unwrap_or_else(PoisonError::into_inner) = Arc::new(view);
        (self.on_view)();
    }

    fn fail(&self, why: String) {
        let last = Arc::clone(&self.view.lock().unwrap_or_else(PoisonError::into_inner));
        self.show(LiveView { status: Status::Failed(why), ..(*last).clone() });
    }
}

/// The view before statics: the gear as first guessed.
pub(super) fn first_view(prepared: &Prepared) -> LiveView {
    let model = Arc::clone(&prepared.model);
    LiveView {
        frame: Arc::new(Frame::of(&State::start(&model), &[], &[])),
        model,
        strengths: Arc::clone(&prepared.strengths),
        newest_s: 0.0,
        sought: false,
        summary: None,
        tension: Series::default(),
        history: Series::default(),
        audit: Audit::default(),
        state_hash: String::new(),
        events: Arc::new([]),
        status: Status::Settling,
        speed: 1.0,
        times_real_time: 0.0,
        cost: Cost::default(),
        piloted: false,
        controls: Controls::default(),
        message: None,
        envelope: Arc::default(),
        program: None,
    }
}

/// Runs until the sender of commands is dropped.
pub(super) fn work(
    prepared: Prepared,
    host: &PluginHost,
    options: RunOptions,
    commands: &Receiver<RunCommand>,
    screen: &Screen,
) {
    // A panic here is a fault of ours or of a plugin's; the workbench stays up and says so.
    let worked = catch_unwind(AssertUnwindSafe(|| {
        let mut worker = Worker::new(prepared, host, options, screen);
        while worker.turn(commands) {}
    }));
    if worked.is_err() {
        screen.fail("the run ended by a fault inside the program; open the scenario again, and report what led to it".into());
    }
}

struct Worker<'a> {
    host: &'a PluginHost,
    options: RunOptions,
    screen: &'a Screen,
    prepared: Prepared,
    run: Option<Run>,
    status: Status,
    pace: Pace,
    pilot: Option<Controls>,
    controls: Controls,
    frames: FrameHistory,
    tension: Series,
    history: Series,
    watch: Watch,
    /// Greatest tension of each line since the last sample [N].
    peak_n: Vec<f64>,
    /// States from which the run can be continued.
    states: KeptStates,
    sought: Option<Arc<Frame>>,
    script: Option<Script>,
    envelope: Envelope,
    program: Option<Arc<Made>>,
    message: Option<String>,
    shown: Instant,
}

impl<'a> Worker<'a> {
    fn new(
        prepared: Prepared,
        host: &'a PluginHost,
        options: RunOptions,
        screen: &'a Screen,
    ) -> Self {
        let now = Instant::now();
        let mut worker = Self {
            host,
            // The history of frames is kept here; the run's own frames would double it.
            options: RunOptions { frames_hz: 0.0, ..options },
            screen,
            prepared,
            run: None,
            status: Status::Settling,
            pace: Pace::new(1.0, now, 0.0),
            pilot: None,
            controls: Controls::default(),
            frames: FrameHistory::new(1),
            tension: Series::default(),
            history: Series::default(),
            watch: Watch::default(),
            peak_n: Vec::new(),
            states: KeptStates::new(1.0),
            sought: None,
            script: None,
            envelope: Envelope::default(),
            program: None,
            message: None,
            shown: now,
        };
        worker.settle();
        worker
    }

    /// Waits for commands or for the next step to be due; false when the sender was dropped.
    fn turn(&mut self, commands: &Receiver<RunCommand>) -> bool {
        let received = match self.wait() {
            Some(wait) => commands.recv_timeout(wait),
            None => commands.recv().map_err(|_| RecvTimeoutError::Disconnected),
        };
        match received {
            Ok(command) => {
                self.obey(command);
                commands.try_iter().for_each(|command| self.obey(command));
                self.show();
            }
            Err(RecvTimeoutError::Timeout) => self.step_due(),
            Err(RecvTimeoutError::Disconnected) => return false,
        }
        true
    }

    /// Time until the next step is due; `None` while standing still.
    fn wait(&mut self) -> Option<Duration> {
        let run = self.run.as_ref().filter(|_| self.status == Status::Running)?;
        Some(self.pace.wait(Instant::now(), run.state().time_s + run.step_s()))
    }

    fn obey(&mut self, command: RunCommand) {
        match command {
            RunCommand::Start => self.start(),
            RunCommand::Pause => self.pause(),
            RunCommand::Step => {
                self.pause();
                self.sought = None;
                self.step();
            }
            RunCommand::Reset => self.reset(),
            RunCommand::Speed(speed) => self.set_speed(speed),
            RunCommand::Controls(controls) => self.pilot = Some(controls),
            RunCommand::Autopilot => self.pilot = None,
            RunCommand::Load(prepared) => self.load(*prepared),
            RunCommand::Seek(time_s) => {
                self.pause();
                self.show_stored(|frames, _| frames.nearest(time_s));
            }
            RunCommand::Shift(by) => {
                self.pause();
                self.show_stored(|frames, now_s| frames.beside(now_s, by));
            }
            RunCommand::Inputs(inputs) => {
                let speed = self.wanted_speed();
                self.run_again(inputs, false, speed);
            }
            RunCommand::Rerun(prepared) => self.rerun(*prepared),
            RunCommand::Program(thin) => self.make_program(thin),
            RunCommand::Branch => self.branch(),
            RunCommand::SaveRecording(path) => self.save(&path),
            RunCommand::KeptFrames(to) => {
                // Who asked may have gone.
                let _ = to.send(self.frames.all().to_vec());
            }
        }
    }

    /// Shows a stored frame, found by the time shown; the newest moment where that is reached.
    fn show_stored(&mut self, find: impl FnOnce(&FrameHistory, f64) -> Option<Arc<Frame>>) {
        let newest_s = self.run.as_ref().map_or(0.0, |run| run.state().time_s);
        let shown_s = self.sought.as_ref().map_or(newest_s, |frame| frame.time_s);
        let found = find(&self.frames, shown_s);
        // The newest moment lies at most a stride after the last kept frame.
        let last = self.frames.nearest(f64::MAX).map(|frame| frame.step);
        self.sought = found.filter(|frame| Some(frame.step) != last);
    }

    fn start(&mut self) {
        self.sought = None;
        if matches!(self.status, Status::Paused) {
            self.status = Status::Running;
            self.set_speed(self.pace.speed());
        }
    }

    fn pause(&mut self) {
        if self.status == Status::Running {
            self.status = Status::Paused;
        }
    }

    fn set_speed(&mut self, speed: f64) {
        let [least, most] = SPEEDS;
        let speed = if speed > most { f64::INFINITY } else { speed.max(least) };
        self.pace = Pace::new(
            speed,
            Instant::now(),
            self.run.as_ref().map_or(0.0, |run| run.state().time_s),
        );
    }

    fn load(&mut self, prepared: Prepared) {
        self.prepared = prepared;
        self.run = None;
        self.status = Status::Settling;
        self.screen.show(LiveView { speed: self.pace.speed(), ..first_view(&self.prepared) });
        self.settle();
    }

    fn settle(&mut self) {
        match Run::new(self.prepared.clone(), self.options) {
            Ok(run) => self.begin(run),
            Err(error) => {
                self.status = Status::Failed(error.to_string());
                self.show();
            }
        }
    }

    fn reset(&mut self) {
        match self.run.as_ref().map(Run::restarted) {
            Some(run) => self.begin(run),
            None => self.settle(),
        }
    }

    /// Stands ready at the start of a run.
    fn begin(&mut self, run: Run) {
        self.frames = FrameHistory::new(frame_stride(KEPT_HZ, run.step_s()));
        (self.tension, self.history) = (Series::default(), Series::default());
        self.watch = Watch::default();
        self.peak_n.clear();
        self.states = KeptStates::new(run.step_s());
        self.envelope = Envelope::default();
        (self.sought, self.script) = (None, None);
        self.message = None;
        self.controls = run.pilot();
        self.run = Some(run);
        self.status = Status::Paused;
        self.store_moment();
        self.set_speed(self.pace.speed());
        self.show();
    }

    /// Takes the step that is due and shows it where a view is due too.
    fn step_due(&mut self) {
        self.step();
        if self.status != Status::Running || self.shown.elapsed().as_secs_f64() >= 1.0 / VIEWS_HZ {
            self.show();
        }
    }

    fn step(&mut self) {
        let scripted = self.scripted();
        let Some(run) = &mut self.run else { return };
        self.controls = scripted.or(self.pilot).unwrap_or_else(|| run.pilot());
        if let Err(stop) = run.step(self.controls) {
            self.status = Status::Stopped(Error::Stopped(stop).to_string());
        } else if run.finished() && self.pilot.is_none() {
            self.status = Status::Finished;
        }
        self.store_moment();
    }

    /// Stores the newest moment for the history.
    fn store_moment(&mut self) {
        let Some(run) = &self.run else { return };
        let now_n = run.peak_tensions_n();
        self.peak_n.resize(now_n.len(), 0.0);
        self.peak_n.iter_mut().zip(now_n).for_each(|(peak, now)| *peak = peak.max(now));
        self.watch.fold(run.contacts());
        self.envelope.fold(run.model(), run.state(), run.segment_peaks_n());
        if self.frames.wants(run.state().step) {
            self.history.push(run.state().time_s, self.watch.sample(run));
            self.frames.store(run.frame());
            self.tension.push(run.state().time_s, std::mem::take(&mut self.peak_n));
        }
        if self.states.wants(run.state().step) {
            self.states.store(KeptState {
                moment: run.moment(),
                samples: self.tension.len(),
                watch: self.watch.clone(),
                peak_n: self.peak_n.clone(),
                envelope: self.envelope.clone(),
            });
        }
    }

    fn save(&mut self, path: &Path) {
        let Some(run) = &self.run else { return };
        self.message = Some(match run.save_recording(path) {
            Ok(()) => format!("saved {}", path.display()),
            Err(error) => error.to_string(),
        });
    }

    fn show(&mut self) {
        self.shown = Instant::now();
        let Some(run) = &self.run else {
            let first = first_view(&self.prepared);
            self.screen.show(LiveView {
                status: self.status.clone(),
                message: self.message.clone(),
                speed: self.pace.speed(),
                ..first
            });
            return;
        };
        self.screen.show(LiveView {
            frame: self.sought.clone().unwrap_or_else(|| run.frame()),
            model: Arc::clone(run.model()),
            strengths: Arc::clone(&run.prepared().strengths),
            newest_s: run.state().time_s,
            sought: self.sought.is_some(),
            summary: Some(run.summary()),
            tension: self.tension.clone(),
            history: self.history.clone(),
            audit: run.audit(),
            state_hash: run.state_hash().hex(),
            events: run.metrics().events().into(),
            status: self.status.clone(),
            speed: self.pace.speed(),
            times_real_time: run.timing().whole().times_real_time(),
            cost: run.timing().cost,
            piloted: self.pilot.is_some(),
            controls: self.controls,
            message: self.message.clone(),
            envelope: Arc::new(self.envelope.clone()),
            program: self.program.clone(),
        });
    }
}

/// Inputs still to be run, and the state after them.
struct Script {
    inputs: std::vec::IntoIter<Controls>,
    /// The speed at which the run continues.
    speed: f64,
    /// Whether the pilot program steers from there; else the run pauses.
    on: bool,
}

impl Worker<'_> {
    /// Runs inputs again from the start as fast as possible, then pauses, or runs on at a speed.
    fn run_again(&mut self, inputs: Vec<Controls>, on: bool, speed: f64) {
        self.reset();
        self.play(inputs, on, speed);
    }

    /// Runs again up to the moment shown, from the last state kept before it.
    fn branch(&mut self) {
        let Some(inputs) = self.inputs_up_to_the_moment_shown() else { return };
        let (prepared, speed) = (self.prepared.clone(), self.wanted_speed());
        match self.back_to_kept_state(inputs.len(), &prepared) {
            Some(done) => self.play(inputs[done..].to_vec(), false, speed),
            None => self.run_again(inputs, false, speed),
        }
    }

    /// Runs the inputs up to the moment shown in another model, whose pilot program steers from there. If the models differ in the pilot
    /// program alone, the run continues from the last state kept before that moment.
    fn rerun(&mut self, prepared: Prepared) {
        let Some(inputs) = self.inputs_up_to_the_moment_shown() else { return };
        self.pilot = None;
        let speed = self.wanted_speed();
        if self.prepared.differs_in_pilot_alone(&prepared)
            && let Some(done) = self.back_to_kept_state(inputs.len(), &prepared)
        {
            self.prepared = prepared;
            self.play(inputs[done..].to_vec(), true, speed);
            return;
        }
        self.load(prepared);
        if !matches!(self.status, Status::Failed(_)) {
            self.run_again(inputs, true, speed);
        }
    }

    /// The speed that the user has chosen, while inputs are run again too.
    fn wanted_speed(&mut self) -> f64 {
        self.script.take().map_or(self.pace.speed(), |script| script.speed)
    }

    /// Runs inputs as fast as possible, then pauses, or runs on at a speed.
    fn play(&mut self, inputs: Vec<Controls>, on: bool, speed: f64) {
        self.set_speed(speed);
        if !inputs.is_empty() {
            self.script = Some(Script { inputs: inputs.into_iter(), speed, on });
            self.start();
            self.set_speed(f64::INFINITY);
        } else if on {
            self.start();
        }
    }

    /// Continues the run with a model from the last state kept at or before a step; returns the step of that state, `None` if there is none.
    fn back_to_kept_state(&mut self, step: usize, prepared: &Prepared) -> Option<usize> {
        let before = Arc::clone(self.run.as_ref()?.model());
        self.states.convert(|moment| moment.with_pilot_of(&before, &prepared.model));
        let kept = self.states.back_to(step)?;
        let run = self.run.as_ref()?.branched(&kept.moment, prepared.clone()).ok()?;
        self.frames.truncate(run.state().step);
        self.tension.truncate(kept.samples);
        self.history.truncate(kept.samples);
        (self.watch, self.peak_n, self.envelope) = (kept.watch, kept.peak_n, kept.envelope);
        (self.sought, self.script, self.message) = (None, None, None);
        self.controls = run.pilot();
        self.run = Some(run);
        self.status = Status::Paused;
        Some(kept.moment.step())
    }

    /// None where they cannot be read again, which is reported.
    fn inputs_up_to_the_moment_shown(&mut self) -> Option<Vec<Controls>> {
        let Some(run) = &self.run else { return Some(Vec::new()) };
        let step = self.sought.as_ref().map_or(run.state().step, |frame| frame.step);
        let inputs = run.inputs(usize::try_from(step).unwrap_or(usize::MAX));
        inputs.map_err(|error| self.message = Some(error.to_string())).ok()
    }

    /// The next input of those run again.
    fn scripted(&mut self) -> Option<Controls> {
        let script = self.script.as_mut()?;
        let next = script.inputs.next();
        if script.inputs.len() == 0 {
            let (speed, on) = (script.speed, script.on);
            self.script = None;
            if !on {
                self.pause();
            }
            self.set_speed(speed);
        }
        next
    }

    /// Makes the run so far a scenario whose pilot program flies it again.
    fn make_program(&mut self, thin: f64) {
        let Some(run) = &self.run else { return };
        let made = run.recording().and_then(|recording| program(&recording, self.host, thin));
        let made = made.map_err(|error| error.to_string());
        self.program = Some(Arc::new(made));
    }
}
