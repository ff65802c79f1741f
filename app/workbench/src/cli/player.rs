//! A scenario opened, or a recording or scenario run again for its moments.

use std::io;
use std::path::Path;
use std::sync::Arc;

use endline_gear::Setting;
use endline_sdk::Controls;
use endline_session::export::tables;
use endline_session::recording::replay::{self, ReplayOptions};
use endline_session::{
    Overrides, PluginHost, Prepared, Recording, Run, RunOptions, Source, locate, prepare,
};
use endline_sim::Frame;

use super::interrupt::Interrupt;
use super::output::{Progress, Verbosity};
use super::replay::tell_version;
use super::{Failure, host, output};

/// A run that is played again.
pub(super) struct Player {
    pub(super) run: Run,
    /// Inputs of a recording; the pilot program's without.
    inputs: Option<Vec<Controls>>,
    /// Name of the scenario.
    pub(super) scenario: String,
    pub(super) end_s: f64,
}

/// Frames, and the readings of all probes at each of them.
type Moments = (Vec<Arc<Frame>>, Vec<Vec<f64>>);

impl Player {
    /// Opens a recording or a scenario.
    pub(super) fn open(
        file: &Path,
        other_plugins: bool,
        library: Option<&Path>,
    ) -> Result<Self, Failure> {
        if locate::is_scenario(file) {
            let prepared = prepare(file, library, &host::load(), Overrides::default())?;
            let scenario = prepared.source.scenario_name.clone();
            let run = Run::new(prepared, RunOptions::default())?;
            let end_s = run.model().spec.settings.duration_s;
            return Ok(Self { run, inputs: None, scenario, end_s });
        }
        let recording = Recording::load(file)?;
        tell_version(&recording);
        let options = ReplayOptions { other_plugins, frames_hz: 0.0 };
        let run = replay::start(&recording, &host::load(), options)?;
        let scenario = recording.source.scenario_name.clone();
        let end_s = recording.duration_s();
        Ok(Self { run, inputs: Some(recording.inputs), scenario, end_s })
    }

    /// Moments of a stretch of the run, `each_s` a second [s].
    pub(super) fn times(
        &self,
        from: Option<f64>,
        to: Option<f64>,
        each_s: u32,
    ) -> Result<Vec<f64>, Failure> {
        let (from_s, to_s) = (from.unwrap_or(0.0), to.unwrap_or(self.end_s));
        if !(from_s >= 0.0 && from_s < to_s && to_s <= self.end_s + 1e-6) {
            return Err(Failure::usage(format!(
                "--from {from_s}s --to {to_s}s is no stretch of a run from 0 to {:.2} s",
                self.end_s
            )));
        }
        let count = ((to_s - from_s) * f64::from(each_s) + 1e-6).floor() as usize + 1;
        Ok((0..count).map(|number| from_s + number as f64 / f64::from(each_s)).collect())
    }

    /// The frames of these moments, up to where the run ends.
    pub(super) fn frames(
        &mut self,
        times: &[f64],
        interrupt: &Interrupt,
    ) -> Result<Vec<Arc<Frame>>, Failure> {
        self.moments(times, interrupt).map(|(frames, _)| frames)
    }

    /// The frames of these moments with the readings of the probes at each, up to where the run ends.
    pub(super) fn moments(
        &mut self,
        times: &[f64],
        interrupt: &Interrupt,
    ) -> Result<Moments, Failure> {
        let progress = Progress::new("running");
        let (mut frames, mut readings) = (Vec::with_capacity(times.len()), Vec::new());
        for (number, time_s) in times.iter().enumerate() {
            while self.run.state().time_s < time_s - 0.5 * self.run.step_s() {
                if interrupt.is_asked() || !self.step() {
                    return Ok((frames, readings));
                }
            }
            frames.push(self.run.frame());
            readings.push(tables::readings(self.run.model(), self.run.state()));
            progress.at(number as u64 + 1, times.len() as u64);
        }
        Ok((frames, readings))
    }

    /// One step; `false` where the run is over.
    fn step(&mut self) -> bool {
        let controls = match &self.inputs {
            None if self.run.finished() => None,
            None => Some(self.run.pilot()),
            Some(inputs) => inputs.get(self.run.state().step as usize).copied(),
        };
        controls.is_some_and(|controls| self.run.step(controls).is_ok())
    }
}

/// Prepares the scenario that the command line names, with fields set over its own.
pub(super) fn prepared(
    named: &Path,
    library: Option<&Path>,
    host: &PluginHost,
    (over, set): (Overrides, &[(String, Setting)]),
) -> Result<Prepared, Failure> {
    let is_stream = named == Path::new("-");
    if output::is_shown(Verbosity::Details) {
        let file = named.is_file().then_some(named);
        if let Ok(folder) = locate::library(file, library) {
            output::detail(&format!("gear library: {}", folder.display()));
        }
    }
    let mut source = if is_stream {
        let text = endline_gear::read::stream(io::stdin().lock())
            .map_err(|error| Failure::failed(format!("standard input cannot be read: {error}")))?;
        Source::of_text(("standard input", text), library, over)?
    } else {
        Source::read(named, library, over)?
    };
    source.set(set)?;
    Ok(source.prepare_with_clips(host)?)
}
