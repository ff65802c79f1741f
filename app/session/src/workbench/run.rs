//! The run shown: started, paused, stepped, at a speed, steered.

use std::sync::Arc;

use endline_sdk::Controls;

use super::Workbench;
use super::comparison::Comparison;
use super::model::{Made, Pending, Then};
use super::program::ProgramRequest;
use super::replay::Replay;
use crate::live::{Engine, Launch, LiveView, Maker, RunCommand, Status};
use crate::shell;

/// A speed that is offered.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Speed {
    /// Simulated seconds for each real one; infinite for as fast as the solver goes.
    pub factor: f64,
    /// Its name.
    pub name: &'static str,
    /// Its name where there is little space.
    pub short: &'static str,
}

const fn speed(factor: f64, name: &'static str, short: &'static str) -> Speed {
    Speed { factor, name, short }
}

/// The speeds offered, the slowest first.
pub const SPEEDS: [Speed; 7] = [
    speed(0.1, "0.1×", "0.1×"),
    speed(0.25, "0.25×", "¼×"),
    speed(0.5, "0.5×", "½×"),
    speed(1.0, "1×", "1×"),
    speed(2.0, "2×", "2×"),
    speed(5.0, "5×", "5×"),
    speed(f64::INFINITY, "as fast as it goes", "max"),
];

impl Speed {
    /// Whether a run's speed is this one.
    pub fn is(self, factor: f64) -> bool {
        // A run gives the greatest speed as a large number or as infinite.
        let most = factor >= 999.0;
        if self.factor.is_infinite() { most } else { !most && (factor - self.factor).abs() < 1e-9 }
    }
}

/// Towards slower or faster speeds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    /// Slower.
    Slower,
    /// Faster.
    Faster,
}

/// The run shown, with the thread it is on.
pub struct CurrentRun {
    pub(super) view: Option<Arc<LiveView>>,
    pub(super) engine: Option<Box<dyn Engine>>,
    pub(super) launch: Launch,
    pub(super) maker: Maker,
    pub(super) pending: Pending,
    pub(super) made: Made,
    pub(super) replay: Replay,
    pub(super) program: ProgramRequest,
    pub(super) comparison: Option<Comparison>,
    /// Whether the run was kept as it stands.
    pub(super) is_kept: bool,
    /// Times that a run was kept, or a kept one renamed, noted on or deleted since the start.
    pub(super) kept_changes: u64,
    /// Whether plugins were loaded again since the run's thread began.
    pub(super) other_plugins: bool,
}

impl CurrentRun {
    /// No run yet.
    pub(super) fn new(launch: Launch) -> Self {
        Self {
            view: None,
            engine: None,
            launch,
            maker: Maker::default(),
            pending: Pending::default(),
            made: Made::default(),
            replay: Replay::default(),
            program: ProgramRequest::default(),
            comparison: None,
            is_kept: false,
            kept_changes: 0,
            other_plugins: false,
        }
    }

    /// Takes in the newest view.
    pub(super) fn refresh(&mut self) {
        self.view = self.engine.as_ref().map(|engine| engine.latest());
    }
}

impl Workbench {
    /// Sends a command to the run.
    /// Errors: where there is no run to take it.
    pub(super) fn send(&self, command: RunCommand) -> Result<(), String> {
        let sent = self.run.engine.as_ref().is_some_and(|engine| engine.send(command));
        if sent { Ok(()) } else { Err("the run does not take commands now".to_owned()) }
    }

    pub(super) fn is_over(&self) -> bool {
        matches!(self.status(), Some(Status::Finished | Status::Stopped(_)))
    }

    pub(crate) fn start(&mut self) -> Result<(), String> {
        self.run.replay.stop();
        let stale = self.stale() && !self.shows_guest();
        if stale && !self.project.documents.any_error() {
            return self.make_model_then(Then::Start);
        }
        if self.is_over() {
            self.send(RunCommand::Reset)?;
        } else {
            self.run.is_kept = false;
        }
        self.send(RunCommand::Start)
    }

    pub(crate) fn pause(&mut self) -> Result<(), String> {
        self.send(RunCommand::Pause)
    }

    /// Pauses a run or playback; plays if an earlier moment is shown; else continues the run.
    pub(crate) fn toggle(&mut self) -> Result<(), String> {
        if self.running() {
            return self.pause();
        }
        let earlier = self.view().is_some_and(|view| view.sought);
        if self.replaying() || earlier { self.replay() } else { self.start() }
    }

    pub(crate) fn step(&mut self) -> Result<(), String> {
        self.send(RunCommand::Step)
    }

    pub(crate) fn reset(&mut self) -> Result<(), String> {
        self.keep_run();
        self.send(RunCommand::Reset)
    }

    pub(crate) fn set_speed(&mut self, factor: f64) -> Result<(), String> {
        self.run.replay.set_speed(factor);
        self.send(RunCommand::Speed(factor))
    }

    /// The next of the speeds offered; none where this is the last.
    pub fn next_speed(&self, direction: Direction) -> Option<f64> {
        let now = self.view().map_or(1.0, |view| view.speed);
        let mut factors = SPEEDS.iter().map(|speed| speed.factor);
        match direction {
            Direction::Slower => factors.rev().find(|factor| *factor < now),
            Direction::Faster => factors.find(|factor| *factor > now),
        }
    }

    pub(crate) fn change_speed(&mut self, direction: Direction) -> Result<(), String> {
        match self.next_speed(direction) {
            Some(factor) => self.set_speed(factor),
            None => Err("no further speed is offered".to_owned()),
        }
    }

    pub(crate) fn steer(&mut self, controls: Controls) -> Result<(), String> {
        self.send(RunCommand::Controls(controls))
    }

    pub(crate) fn autopilot(&mut self) -> Result<(), String> {
        self.send(RunCommand::Autopilot)
    }

    /// The command line that gives the run of the scenario's file.
    pub fn command_line(&self) -> String {
        let documents = &self.project.documents;
        let [scenario, library] = [documents.scenario_path(), documents.root()].map(shell::path);
        format!("endline run {scenario} --library {library}")
    }
}
