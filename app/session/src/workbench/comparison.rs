//! A second run beside the one shown: B beside A, always at A's moment.

use std::path::Path;
use std::sync::Arc;

use endline_sdk::Controls;

use super::Workbench;
use super::notice::Notice;
use crate::live::{Engine, LiveView, Maker, RunCommand, Status};
use crate::recording::Recording;

/// The run that the one shown is compared with.
#[derive(Default)]
pub struct Comparison {
    /// Its name.
    pub name: String,
    /// Its newest view.
    pub view: Option<Arc<LiveView>>,
    engine: Option<Box<dyn Engine>>,
    maker: Maker,
    /// Inputs to be run once its model is made.
    inputs: Vec<Controls>,
    /// The moment it was sent to last [s].
    sent_s: Option<f64>,
}

impl Comparison {
    /// Sends it to a moment, once; where it is shorter, to its end. Not while it runs, for that would stop it.
    fn follow(&mut self, time_s: f64) {
        let Some((engine, view)) = self.engine.as_ref().zip(self.view.as_ref()) else { return };
        let still = matches!(view.status, Status::Paused | Status::Finished | Status::Stopped(_));
        if !still || self.sent_s == Some(time_s) || view.newest_s <= 0.0 {
            return;
        }
        let wanted_s = if time_s >= view.newest_s { f64::MAX } else { time_s };
        if engine.send(RunCommand::Seek(wanted_s)) {
            self.sent_s = Some(time_s);
        }
    }
}

impl Workbench {
    /// The run that the one shown is compared with.
    pub fn comparison(&self) -> Option<&Comparison> {
        self.run.comparison.as_ref()
    }

    /// Its newest view.
    pub fn compared_view(&self) -> Option<Arc<LiveView>> {
        self.comparison()?.view.clone()
    }

    /// Takes in what the other run has ready, and keeps it at the moment shown.
    pub(super) fn refresh_comparison(&mut self) {
        if let Err(reason) = self.take_compared_model() {
            self.run.comparison = None;
            let text = format!("the run to compare with cannot be made: {reason}");
            self.notice = Some(Notice::fault(text));
        }
        let shown_s = self.view().map(|view| view.frame.time_s);
        let Some(other) = &mut self.run.comparison else { return };
        other.view = other.engine.as_ref().map(|engine| engine.latest());
        if let Some(shown_s) = shown_s {
            other.follow(shown_s);
        }
    }

    /// Runs the model of the other run once it is made.
    fn take_compared_model(&mut self) -> Result<(), String> {
        let (host, waker) = self.helpers();
        let Some(other) = &mut self.run.comparison else { return Ok(()) };
        let Some(made) = other.maker.poll() else { return Ok(()) };
        let prepared = made.map_err(|error| error.to_string())?;
        let engine = (self.run.launch)(prepared, host, waker)?;
        engine.send(RunCommand::Inputs(std::mem::take(&mut other.inputs)));
        other.engine = Some(engine);
        Ok(())
    }

    /// The run shown becomes B; the texts make a new A.
    pub(crate) fn hold(&mut self) -> Result<(), String> {
        self.keep_run();
        let Some(engine) = self.run.engine.take() else {
            return Err("no run is there yet".to_owned());
        };
        engine.send(RunCommand::Pause);
        let name = format!("{}, held", self.scenario_stem());
        let view = Some(engine.latest());
        let engine = Some(engine);
        self.run.comparison = Some(Comparison { name, view, engine, ..Comparison::default() });
        self.run.replay.stop();
        self.run.is_kept = true;
        self.make_model()
    }

    /// Runs a recording again as B.
    pub(crate) fn compare_with(&mut self, file: &Path) -> Result<(), String> {
        let recording = Recording::load(file).map_err(|error| error.to_string())?;
        let (host, waker) = self.helpers();
        let mut maker = Maker::default();
        maker
            .start(recording.source, host, waker)
            .map_err(|error| format!("the model cannot be made: {error}"))?;
        let name = file.file_stem().map(|stem| stem.to_string_lossy().into_owned());
        let (name, inputs) = (name.unwrap_or_default(), recording.inputs);
        self.run.comparison = Some(Comparison { name, maker, inputs, ..Comparison::default() });
        Ok(())
    }

    pub(crate) fn end_comparison(&mut self) -> Result<(), String> {
        let ended = self.run.comparison.take();
        ended.map(|_| ()).ok_or_else(|| "no run is compared with the one shown".to_owned())
    }
}
