//! `endline render`: a moment of a recording as a picture.

use std::process::ExitCode;

use endline_session::Recording;
use endline_session::recording::replay::{self, ReplayOptions};

use super::args::RenderArgs;
use super::{Failure, host, picture};

pub(super) fn render(args: &RenderArgs) -> Result<ExitCode, Failure> {
    picture::check_view(&args.view).map_err(Failure::usage)?;
    let recording = Recording::load(&args.recording)?;
    let options = ReplayOptions { other_plugins: args.other_plugins, frames_hz: 0.0 };
    let (run, frame) = replay::frame_at(&recording, &host::load(), options, args.at)?;
    let caption = picture::caption(&recording.source.scenario_name);
    picture::draw(run.model(), &frame, &args.view, args.size, &caption, &args.out).map_err(Failure::failed)?;
    Ok(ExitCode::SUCCESS)
}
