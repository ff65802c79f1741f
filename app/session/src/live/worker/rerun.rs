//! Inputs run again: of a recording, up to the moment shown, or in another model.

use endline_sdk::Controls;

use super::{Status, Worker};
use crate::recording::program::program;
use crate::source::Prepared;

/// Inputs still to be run, and what comes after them.
pub(super) struct Script {
    inputs: std::vec::IntoIter<Controls>,
    /// The speed to go on at.
    speed: f64,
    /// Whether the pilot program steers on from there; else it stands still.
    on: bool,
}

impl Worker<'_> {
    /// Runs inputs again from the start as fast as it goes.
    pub(super) fn run_again(&mut self, inputs: Vec<Controls>, on: bool) {
        let speed = self.script.take().map_or(self.pace.speed(), |script| script.speed);
        self.reset();
        if !inputs.is_empty() {
            self.script = Some(Script { inputs: inputs.into_iter(), speed, on });
            self.start();
            self.set_speed(f64::INFINITY);
        } else if on {
            self.start();
        }
    }

    /// Runs again up to the moment shown.
    pub(super) fn branch(&mut self) {
        if let Some(inputs) = self.inputs_up_to_the_moment_shown() {
            self.run_again(inputs, false);
        }
    }

    /// The same inputs up to the moment shown in another model, whose pilot program steers on from there.
    pub(super) fn rerun(&mut self, prepared: Prepared) {
        let Some(inputs) = self.inputs_up_to_the_moment_shown() else { return };
        self.pilot = None;
        self.load(prepared);
        if !matches!(self.status, Status::Failed(_)) {
            self.run_again(inputs, true);
        }
    }

    /// None where they cannot be read again, which is told.
    fn inputs_up_to_the_moment_shown(&mut self) -> Option<Vec<Controls>> {
        let Some(run) = &self.run else { return Some(Vec::new()) };
        let step = self.sought.as_ref().map_or(run.state().step, |frame| frame.step);
        let inputs = run.inputs(usize::try_from(step).unwrap_or(usize::MAX));
        inputs.map_err(|error| self.message = Some(error.to_string())).ok()
    }

    /// The next input of those run again.
    pub(super) fn scripted(&mut self) -> Option<Controls> {
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
    pub(super) fn make_program(&mut self, thin: f64) {
        let Some(run) = &self.run else { return };
        let made = run.recording().and_then(|recording| program(&recording, self.host, thin));
        let made = made.map_err(|error| error.to_string());
        self.program = Some(std::sync::Arc::new(made));
    }
}
