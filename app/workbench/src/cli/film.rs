//! `endline render --out FILE.gif`: a stretch of a recording, or of a scenario, as a film; `FILE.glb`: as an animated 3-D model.

use std::path::Path;
use std::process::ExitCode;
use std::sync::Arc;

use endline_sdk::Controls;
use endline_session::recording::replay::{self, ReplayOptions};
use endline_session::{Overrides, Recording, Run, RunOptions, prepare};
use endline_session::{export, locate};
use endline_sim::Frame;

use super::args::RenderArgs;
use super::interrupt::Interrupt;
use super::progress::Progress;
use super::replay::tell_version;
use super::{Failure, host, output, picture};

/// Pictures of a film at most: they are kept until the greatest tension is known, by which rope is coloured.
const MOST: usize = 4000;

/// Runs what is to be seen in motion, and writes it as an animated 3-D model.
pub(super) fn animate(args: &RenderArgs, library: Option<&Path>) -> Result<ExitCode, Failure> {
    let interrupt = Interrupt::watch();
    let mut player = Player::open(args, library)?;
    let times = times(args, player.end_s).map_err(Failure::usage)?;
    let frames = player.frames(&times, &interrupt)?;
    let step_s = 1.0 / f64::from(args.fps);
    export::animation(&args.out, player.run.model(), &frames, step_s).map_err(Failure::failed)?;
    Ok(interrupt.exit_code().unwrap_or(ExitCode::SUCCESS))
}

/// Runs what is filmed, then draws it.
pub(super) fn film(args: &RenderArgs, library: Option<&Path>) -> Result<ExitCode, Failure> {
    let interrupt = Interrupt::watch();
    let mut player = Player::open(args, library)?;
    let times = times(args, player.end_s).map_err(Failure::usage)?;
    let film = picture::begin_film(&args.out, args.size, args.fps).map_err(Failure::failed)?;
    let frames = player.frames(&times, &interrupt)?;
    let caption = picture::caption(&player.caption);
    let reel = picture::Reel {
        model: player.run.model(),
        frames: &frames,
        view: &args.view,
        size: args.size,
        caption: &caption,
    };
    let progress = Progress::new("drawing");
    let drawn = picture::film(film, &reel, |done| {
        progress.at(done as u64, frames.len() as u64);
        !interrupt.is_asked()
    });
    let drawn = drawn.map_err(Failure::failed)?;
    if drawn < times.len() {
        output::note(&format!(
            "{}: {drawn} of {} pictures; the film ends there",
            args.out.display(),
            times.len()
        ));
    }
    Ok(interrupt.exit_code().unwrap_or(ExitCode::SUCCESS))
}

/// The moments that are drawn [s].
fn times(args: &RenderArgs, end_s: f64) -> Result<Vec<f64>, String> {
    let (from_s, to_s) = (args.from.unwrap_or(0.0), args.to.unwrap_or(end_s));
    if !(from_s >= 0.0 && from_s < to_s && to_s <= end_s + 1e-6) {
        return Err(format!(
            "--from {from_s} --to {to_s} is no stretch of a run from 0 to {end_s:.2} s"
        ));
    }
    let count = ((to_s - from_s) * f64::from(args.fps) + 1e-6).floor() as usize + 1;
    if count > MOST {
        return Err(format!(
            "{count} pictures are more than the {MOST} that a film may have; ask for fewer with --fps, --from or --to"
        ));
    }
    Ok((0..count).map(|number| from_s + number as f64 / f64::from(args.fps)).collect())
}

/// A run that is played for a film.
struct Player {
    run: Run,
    /// Inputs of a recording; the pilot program's without.
    inputs: Option<Vec<Controls>>,
    caption: String,
    end_s: f64,
}

impl Player {
    fn open(args: &RenderArgs, library: Option<&Path>) -> Result<Self, Failure> {
        if locate::is_scenario(&args.file) {
            let prepared = prepare(&args.file, library, &host::load(), Overrides::default())?;
            let caption = prepared.source.scenario_name.clone();
            let run = Run::new(prepared, RunOptions::default())?;
            let end_s = run.model().spec.settings.duration_s;
            return Ok(Self { run, inputs: None, caption, end_s });
        }
        let recording = Recording::load(&args.file)?;
        tell_version(&recording);
        let options = ReplayOptions { other_plugins: args.other_plugins, frames_hz: 0.0 };
        let run = replay::start(&recording, &host::load(), options)?;
        let caption = recording.source.scenario_name.clone();
        let end_s = recording.duration_s();
        Ok(Self { run, inputs: Some(recording.inputs), caption, end_s })
    }

    /// The frames of these moments, up to where the run ends.
    fn frames(&mut self, times: &[f64], interrupt: &Interrupt) -> Result<Vec<Arc<Frame>>, Failure> {
        let progress = Progress::new("running");
        let mut frames = Vec::with_capacity(times.len());
        for (number, time_s) in times.iter().enumerate() {
            while self.run.state().time_s < time_s - 0.5 * self.run.step_s() {
                if interrupt.is_asked() || !self.step() {
                    return Ok(frames);
                }
            }
            frames.push(self.run.frame());
            progress.at(number as u64 + 1, times.len() as u64);
        }
        Ok(frames)
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
