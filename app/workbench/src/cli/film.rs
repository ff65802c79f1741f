//! `endline render --out FILE.gif`: a stretch of a recording, or of a scenario, as a film; `FILE.glb`: as an animated 3-D model.

use std::path::Path;
use std::process::ExitCode;

use endline_session::export;

use super::args::RenderArgs;
use super::interrupt::Interrupt;
use super::player::Player;
use super::progress::Progress;
use super::{Failure, output, picture};

/// Pictures of a film at most: they are kept until the greatest tension is known, by which rope is coloured.
const MOST: usize = 4000;

/// Runs what is to be seen in motion, and writes it as an animated 3-D model.
pub(super) fn animate(args: &RenderArgs, library: Option<&Path>) -> Result<ExitCode, Failure> {
    let interrupt = Interrupt::watch();
    let mut player = Player::open(&args.file, args.other_plugins, library)?;
    let times = times(args, &player)?;
    let frames = player.frames(&times, &interrupt)?;
    let step_s = 1.0 / f64::from(args.fps);
    export::animation(&args.out, player.run.model(), &frames, step_s).map_err(Failure::failed)?;
    Ok(interrupt.exit_code().unwrap_or(ExitCode::SUCCESS))
}

/// Runs what is filmed, then draws it.
pub(super) fn film(args: &RenderArgs, library: Option<&Path>) -> Result<ExitCode, Failure> {
    let interrupt = Interrupt::watch();
    let mut player = Player::open(&args.file, args.other_plugins, library)?;
    let times = times(args, &player)?;
    let film = picture::begin_film(&args.out, args.size, args.fps).map_err(Failure::failed)?;
    let frames = player.frames(&times, &interrupt)?;
    let caption = picture::caption(&player.scenario);
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
fn times(args: &RenderArgs, player: &Player) -> Result<Vec<f64>, Failure> {
    let times = player.times(args.from, args.to, args.fps)?;
    if times.len() > MOST {
        return Err(Failure::usage(format!(
            "{} pictures are more than the {MOST} that a film may have; ask for fewer with --fps, --from or --to",
            times.len()
        )));
    }
    Ok(times)
}
