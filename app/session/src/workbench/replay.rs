//! Other moments of the run: sought, and played again at the chosen speed.

use super::Workbench;
use crate::live::RunCommand;

/// How fast a run is played that was run as fast as the solver goes.
const FASTEST: f64 = 10.0;

/// The clock of a run that is played again.
pub(super) struct Replay {
    /// The moment shown [s]; `None` while nothing is played.
    shown_s: Option<f64>,
    speed: f64,
}

impl Default for Replay {
    fn default() -> Self {
        Self { shown_s: None, speed: 1.0 }
    }
}

impl Replay {
    pub(super) fn stop(&mut self) {
        self.shown_s = None;
    }

    pub(super) fn set_speed(&mut self, factor: f64) {
        self.speed = if factor.is_finite() { factor } else { FASTEST };
    }
}

impl Workbench {
    /// Whether what was run is being played.
    pub fn replaying(&self) -> bool {
        self.run.replay.shown_s.is_some()
    }

    /// Plays from the moment shown, from the start where that is the newest; stops what plays.
    pub(crate) fn replay(&mut self) -> Result<(), String> {
        let Some(view) = self.view() else { return Err("no run is there yet".to_owned()) };
        let from_s = if view.sought { view.frame.time_s } else { 0.0 };
        if self.run.replay.shown_s.take().is_some() {
            return Ok(());
        }
        self.run.replay.shown_s = Some(from_s);
        self.send(RunCommand::Pause)
    }

    /// Advances the playback by `elapsed_s` of real time.
    pub fn play(&mut self, elapsed_s: f64) {
        let replay = &self.run.replay;
        let Some((shown_s, view)) = replay.shown_s.zip(self.view()) else { return };
        let next_s = shown_s + elapsed_s * replay.speed;
        self.run.replay.shown_s = (next_s < view.newest_s).then_some(next_s);
        if self.send(RunCommand::Seek(next_s)).is_err() {
            self.run.replay.stop();
        }
    }

    pub(crate) fn seek(&mut self, time_s: f64) -> Result<(), String> {
        self.run.replay.stop();
        self.send(RunCommand::Seek(time_s))
    }

    pub(crate) fn shift(&mut self, by: i64) -> Result<(), String> {
        self.run.replay.stop();
        self.send(RunCommand::Shift(by))
    }
}
