//! A second run beside the one shown: B beside A, always at A's moment.

use std::path::Path;
use std::sync::Arc;

use endline_sdk::Controls;
use endline_session::Recording;
use endline_session::live::{Engine, Maker};
use endline_session::live::{LiveView, RunCommand, Status};

use super::{Desk, Order};

/// The run that the one shown is compared with.
pub struct Other {
    /// What it is, in words.
    pub name: String,
    /// Its newest view.
    pub view: Option<Arc<LiveView>>,
    engine: Option<Box<dyn Engine>>,
    maker: Maker,
    /// Inputs to be run again once its model is made.
    inputs: Vec<Controls>,
    /// The moment it was last sent to [s].
    sent_s: Option<f64>,
}

impl Other {
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

impl Desk {
    /// The run that the one shown is compared with.
    #[must_use]
    pub fn other(&self) -> Option<&Other> {
        self.other.as_ref()
    }

    /// Its newest view.
    #[must_use]
    pub fn other_view(&self) -> Option<Arc<LiveView>> {
        self.other.as_ref()?.view.clone()
    }

    /// Takes in what the other run has ready, and keeps it at the moment shown.
    pub(super) fn refresh_other(&mut self) {
        let Some(other) = &mut self.other else { return };
        if let Some(made) = other.maker.poll() {
            let launched = made.map_err(|error| error.to_string()).and_then(|prepared| {
                (self.launch)(prepared, Arc::clone(&self.host), Arc::clone(&self.waker))
            });
            match launched {
                Ok(engine) => {
                    engine.send(RunCommand::Inputs(std::mem::take(&mut other.inputs)));
                    other.engine = Some(engine);
                }
                Err(error) => {
                    self.notice =
                        Some((format!("the run to compare with cannot be made: {error}"), true));
                    self.other = None;
                    return;
                }
            }
        }
        other.view = other.engine.as_ref().map(|engine| engine.latest());
        if let Some(view) = &self.view {
            other.follow(view.frame.time_s);
        }
    }

    /// The run shown stays as B; the texts make a new A.
    pub(super) fn hold_run(&mut self) {
        if self.documents.any_error() {
            self.notice = Some(("the gear has errors; see Problems".into(), true));
            return;
        }
        self.keep_run();
        let Some(engine) = self.engine.take() else { return };
        engine.send(RunCommand::Pause);
        let name = format!("{}, held", self.scenario_stem());
        self.other = Some(Other {
            name,
            view: Some(engine.latest()),
            engine: Some(engine),
            maker: Maker::default(),
            inputs: Vec::new(),
            sent_s: None,
        });
        self.replaying_s = None;
        self.run_is_kept = true;
        self.make();
    }

    /// Runs a recording again as B.
    pub(super) fn compare_with(&mut self, path: &Path) {
        let recording = match Recording::load(path) {
            Ok(recording) => recording,
            Err(error) => return self.notice = Some((error.to_string(), true)),
        };
        let mut maker = Maker::default();
        if let Err(error) =
            maker.start(recording.source, Arc::clone(&self.host), Arc::clone(&self.waker))
        {
            return self.notice = Some((format!("the model cannot be made: {error}"), true));
        }
        let name =
            path.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default();
        self.other = Some(Other {
            name,
            view: None,
            engine: None,
            maker,
            inputs: recording.inputs,
            sent_s: None,
        });
    }

    /// Runs compared by one order.
    pub(super) fn obey_compare(&mut self, order: &Order) {
        match order {
            Order::HoldRun => self.hold_run(),
            Order::CompareWith(path) => self.compare_with(path),
            _ => self.other = None,
        }
    }

    /// The scenario's name without folder and ending.
    #[must_use]
    pub fn scenario_stem(&self) -> String {
        self.documents
            .scenario_path()
            .file_stem()
            .map(|stem| stem.to_string_lossy().into_owned())
            .unwrap_or_default()
    }
}
