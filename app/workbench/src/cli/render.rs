//! `endline render`: a moment of a recording, or of a scenario, as a picture; `film` has films.

use std::path::Path;
use std::process::ExitCode;
use std::sync::Arc;

use endline_session::recording::replay::{self, ReplayOptions};
use endline_session::{Overrides, Recording, Run, RunOptions, locate, prepare};
use endline_sim::{Frame, Model};

use super::args::{Look, RenderArgs};
use super::replay::tell_version;
use super::{Failure, host, output, picture};

pub(super) fn render(args: &RenderArgs, library: Option<&Path>) -> Result<ExitCode, Failure> {
    picture::check_view(&args.view, picture::is_film(&args.out)).map_err(Failure::usage)?;
    output::not_its_own_input(&args.file, &args.out)?;
    if picture::is_film(&args.out) {
        return picture::render_film(args, library);
    }
    if args.out.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("glb")) {
        return picture::animate(args, library);
    }
    if args.from.is_some() || args.to.is_some() {
        return Err(Failure::usage(format!(
            "{} is no film: --from and --to need --out with .gif, .mp4, .webm or .glb",
            args.out.display()
        )));
    }
    let moment = if locate::is_scenario(&args.file) {
        of_scenario(args, library)?
    } else {
        of_recording(args)?
    };
    picture::draw(&moment.model, &moment.frame, &shot(args, &moment)?).map_err(Failure::failed)?;
    Ok(ExitCode::SUCCESS)
}

/// The content of a picture.
struct Moment {
    model: Arc<Model>,
    frame: Arc<Frame>,
    caption: String,
}

fn of_recording(args: &RenderArgs) -> Result<Moment, Failure> {
    let recording = Recording::load(&args.file)?;
    tell_version(&recording);
    let options = ReplayOptions { other_plugins: args.other_plugins, frames_hz: 0.0 };
    let (run, frame) = replay::frame_at(&recording, &host::load(), options, args.at)?;
    if !replay::ends_as_recorded(&recording, &run) {
        output::warn(
            "what is drawn is not the recorded state; `endline replay --verify` names the first step that differs",
        );
    }
    Ok(Moment {
        model: Arc::clone(run.model()),
        frame,
        caption: picture::caption(&recording.source.scenario_name),
    })
}

/// The scenario's gear at rest, or run up to the moment.
fn of_scenario(args: &RenderArgs, library: Option<&Path>) -> Result<Moment, Failure> {
    let prepared = prepare(&args.file, library, &host::load(), Overrides::default())?;
    let caption = picture::caption(&prepared.source.scenario_name);
    let mut run = Run::new(prepared, RunOptions::default())?;
    while run.state().time_s < args.at - 0.5 * run.step_s() && !run.finished() {
        run.step(run.pilot()).map_err(|stop| {
            Failure::failed(format!(
                "the run stopped at {:.3} s, at {}: {}",
                stop.time_s, stop.part, stop.reason
            ))
        })?;
    }
    let end_s = run.state().time_s;
    if args.at > end_s + run.step_s() {
        output::warn(&format!("the run ends at {end_s:.2} s; the picture shows that moment"));
    }
    Ok(Moment { model: Arc::clone(run.model()), frame: run.frame(), caption })
}

/// The picture asked for: the whole scene, or some of its bodies and lines.
fn shot<'a>(args: &'a RenderArgs, moment: &'a Moment) -> Result<picture::Shot<'a>, Failure> {
    let (model, frame, mut fit) = (&moment.model, &moment.frame, Vec::new());
    for id in &args.fit {
        if let Some(index) = model.spec.bodies.iter().position(|body| body.id == *id) {
            fit.extend(
                model.spec.bodies[index]
                    .corners()
                    .map(|corner| frame.bodies[index].0 + frame.bodies[index].1 * corner),
            );
        } else if let Some(index) = model.spec.lines.iter().position(|line| line.id == *id) {
            fit.extend_from_slice(&frame.nodes[model.line_nodes[index].clone()]);
        } else {
            let known = model
                .spec
                .bodies
                .iter()
                .map(|body| &body.id)
                .chain(model.spec.lines.iter().map(|line| &line.id));
            let known: Vec<&str> = known.map(String::as_str).collect();
            return Err(Failure::usage(format!(
                "there is no body or line `{id}` to fit; there are {}",
                known.join(", ")
            )));
        }
    }
    Ok(picture::Shot {
        view: &args.view,
        size: args.size,
        caption: &moment.caption,
        film: args.look == Look::Film,
        out: &args.out,
        fit,
    })
}
