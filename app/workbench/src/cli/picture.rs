//! Pictures of frames and films; a build without the feature `scene` refuses them.

use std::path::Path;
use std::process::ExitCode;
use std::sync::Arc;

#[cfg(feature = "scene")]
use endline_session::scene::{Scene, Show};
#[cfg(feature = "scene")]
use endline_session::units::Units;
use endline_session::{Report, Run, export};
use endline_sim::{DVec3, Frame, Model};

use super::args::{Look, RenderArgs};
use super::interrupt::Interrupt;
use super::output::Progress;
use super::player::Player;
use super::{Failure, output};
#[cfg(feature = "scene")]
use crate::scene;

/// Refuses a view that does not exist, before anything is run.
#[cfg(feature = "scene")]
pub(super) fn check_view(view: &str, film: bool) -> Result<(), String> {
    let path = scene::CameraPath::read(view)?;
    if film || path.single().is_some() {
        Ok(())
    } else {
        Err(format!(
            "`{view}` is a way through a film; a picture has one view, one of {}",
            scene::View::names()
        ))
    }
}

/// A build without drawing refuses every view.
#[cfg(not(feature = "scene"))]
pub(super) fn check_view(_view: &str, _film: bool) -> Result<(), String> {
    Err(NO_SCENE.into())
}

#[cfg(not(feature = "scene"))]
const NO_SCENE: &str = "this program was built without the feature `scene` and draws no pictures; build it with default features";

/// A picture asked for on the command line.
#[cfg_attr(
    not(feature = "scene"),
    allow(dead_code, reason = "a build that draws nothing only takes it")
)]
pub(super) struct Shot<'a> {
    /// Name of the view.
    pub view: &'a str,
    /// Width and height [px].
    pub size: [u32; 2],
    /// Line of text at the top left.
    pub caption: &'a str,
    /// Whether it is drawn for films and print.
    pub film: bool,
    /// File to write.
    pub out: &'a Path,
    /// Places to fit in [m]; all gear and whale where empty.
    pub fit: Vec<DVec3>,
}

/// Draws a frame as a PNG.
#[cfg(feature = "scene")]
pub(super) fn draw(model: &Model, frame: &Frame, shot: &Shot<'_>) -> Result<(), String> {
    let Shot { view, size, caption, film, out, fit } = shot;
    scene::render_png(&scene::RenderRequest {
        model,
        frame,
        size: *size,
        view,
        show: Show { film: *film, ..Show::default() },
        fit,
        caption,
        out,
        units: Units::Mixed,
    })
}

/// A build without drawing refuses.
#[cfg(not(feature = "scene"))]
pub(super) fn draw(_model: &Model, _frame: &Frame, _shot: &Shot<'_>) -> Result<(), String> {
    Err(NO_SCENE.into())
}

/// Whether a file is a film by its extension.
#[cfg(feature = "scene")]
pub(super) fn is_film(out: &Path) -> bool {
    scene::film::Film::is_named(out)
}

/// A build without drawing makes no films; the picture that is tried instead is refused.
#[cfg(not(feature = "scene"))]
pub(super) fn is_film(_out: &Path) -> bool {
    false
}

/// A film file that is begun.
#[cfg(feature = "scene")]
pub(super) type Begun = scene::film::Film;
/// A build without drawing begins none.
#[cfg(not(feature = "scene"))]
pub(super) type Begun = std::convert::Infallible;

/// Begins a film file before the run, so that a bad path is reported at once.
#[cfg(feature = "scene")]
pub(super) fn begin_film(out: &Path, size: [u32; 2], fps: u32) -> Result<Begun, String> {
    scene::film::Film::begin(out, size, fps)
}

/// A build without drawing refuses.
#[cfg(not(feature = "scene"))]
pub(super) fn begin_film(_out: &Path, _size: [u32; 2], _fps: u32) -> Result<Begun, String> {
    Err(NO_SCENE.into())
}

/// A film asked for on the command line.
#[cfg_attr(not(feature = "scene"), allow(dead_code, reason = "as for a picture"))]
pub(super) struct Reel<'a> {
    pub model: &'a Model,
    /// The moments drawn.
    pub frames: &'a [Arc<Frame>],
    /// Name of the view, or views with the times at which the camera stands there.
    pub view: &'a str,
    /// Width and height [px].
    pub size: [u32; 2],
    /// Line of text at the top left.
    pub caption: &'a str,
    /// Whether it is drawn without instruments.
    pub film: bool,
}

/// Draws a film; `each` receives the number of each picture and ends the film by returning `false`. Returns the number of pictures.
#[cfg(feature = "scene")]
pub(super) fn film(
    film: Begun,
    reel: &Reel<'_>,
    each: impl Fn(usize) -> bool,
) -> Result<usize, String> {
    let path = scene::CameraPath::read(reel.view)?;
    // A view of everything holds all that is to come, so that nothing jumps that did not move.
    let some = reel.frames.iter().step_by((reel.frames.len() / 20).max(1));
    let places: Vec<DVec3> = some.flat_map(|frame| Scene::places_of(reel.model, frame)).collect();
    let length_m = reel.model.spec.whale.as_ref().map_or(10.0, |whale| whale.length_m);
    let aspect = f64::from(reel.size[0]) / f64::from(reel.size[1]);
    let seen = |view: scene::View, frame: &Frame| {
        scene::Camera::of_view(view, &places, frame.whale.as_ref(), length_m, aspect)
    };
    let camera =
        |frame: &Frame| path.camera(frame.time_s, |view| seen(*view, frame)).unwrap_or_default();
    let drawing = scene::Reel {
        model: reel.model,
        frames: reel.frames,
        size: reel.size,
        camera: &camera,
        show: Show { film: reel.film, ..Show::default() },
        water: scene::Water::DARK,
        caption: reel.caption,
        units: Units::Mixed,
    };
    drawing.draw(film, each)
}

/// A build without drawing refuses.
#[cfg(not(feature = "scene"))]
pub(super) fn film(
    film: Begun,
    _reel: &Reel<'_>,
    _each: impl Fn(usize) -> bool,
) -> Result<usize, String> {
    match film {}
}

/// Caption of a picture beside its time: the scenario's name without its folder.
pub(super) fn caption(scenario: &str) -> String {
    Path::new(scenario)
        .file_stem()
        .map_or_else(String::new, |stem| stem.to_string_lossy().into_owned())
}

/// Draws the moment of the greatest tension of any line. A run without its picture is still a
/// run: where it cannot be drawn, a note says why.
pub(super) fn of_peak(run: &Run, report: &Report, out: &Path) {
    let peak_s = report.greatest().map_or(0.0, |line| line.peak_at_s);
    let nearest = run
        .frames()
        .iter()
        .min_by(|a, b| (a.time_s - peak_s).abs().total_cmp(&(b.time_s - peak_s).abs()));
    let Some(frame) = nearest else { return };
    let caption = caption(&report.scenario);
    let shot = Shot {
        view: "orbit",
        size: [1280, 800],
        caption: &caption,
        film: false,
        out,
        fit: Vec::new(),
    };
    if let Err(reason) = draw(run.model(), frame, &shot) {
        output::warn(&format!("no picture: {reason}"));
    }
}

/// Pictures of a film at most: they are kept until the greatest tension is known, by which rope is coloured.
const MOST: usize = 4000;

/// Runs a stretch, and writes it as an animated 3-D model.
pub(super) fn animate(args: &RenderArgs, library: Option<&Path>) -> Result<ExitCode, Failure> {
    let interrupt = Interrupt::watch();
    let mut player = Player::open(&args.file, args.other_plugins, library)?;
    let times = times(args, &player)?;
    let frames = player.frames(&times, &interrupt)?;
    let step_s = 1.0 / f64::from(args.fps);
    export::animation(&args.out, player.run.model(), &frames, step_s).map_err(Failure::failed)?;
    Ok(interrupt.exit_code().unwrap_or(ExitCode::SUCCESS))
}

/// Runs the stretch of a film, then draws it.
pub(super) fn render_film(args: &RenderArgs, library: Option<&Path>) -> Result<ExitCode, Failure> {
    let interrupt = Interrupt::watch();
    let mut player = Player::open(&args.file, args.other_plugins, library)?;
    let times = times(args, &player)?;
    let begun = begin_film(&args.out, args.size, args.fps).map_err(Failure::failed)?;
    let frames = player.frames(&times, &interrupt)?;
    let caption = caption(&player.scenario);
    let reel = Reel {
        model: player.run.model(),
        frames: &frames,
        view: &args.view,
        size: args.size,
        caption: &caption,
        film: args.look == Look::Film,
    };
    let progress = Progress::new("drawing");
    let drawn = film(begun, &reel, |done| {
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
