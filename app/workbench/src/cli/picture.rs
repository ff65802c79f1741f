//! Pictures of frames; a build without the feature `scene` says that it draws none.

use std::path::Path;

use endline_session::{Report, Run};
use endline_sim::{DVec3, Frame, Model};

#[cfg(feature = "scene")]
use crate::scene;

use super::output;

/// Refuses a view that does not exist, before anything is run.
#[cfg(feature = "scene")]
pub(super) fn check_view(view: &str) -> Result<(), String> {
    let known = scene::View::named(view).is_some();
    if known {
        Ok(())
    } else {
        Err(format!("there is no view `{view}`; expected one of {}", scene::View::names()))
    }
}

/// A build that draws nothing refuses every view.
#[cfg(not(feature = "scene"))]
pub(super) fn check_view(_view: &str) -> Result<(), String> {
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
    /// File to write.
    pub out: &'a Path,
    /// Places to fit in [m]; all gear and whale where empty.
    pub fit: Vec<DVec3>,
}

/// Draws a frame as a PNG.
#[cfg(feature = "scene")]
pub(super) fn draw(model: &Model, frame: &Frame, shot: &Shot<'_>) -> Result<(), String> {
    let Shot { view, size, caption, out, fit } = shot;
    scene::render_png(&scene::RenderRequest {
        model,
        frame,
        size: *size,
        view,
        scale_n: None,
        fit,
        caption,
        out,
    })
}

/// A build that draws nothing says so.
#[cfg(not(feature = "scene"))]
pub(super) fn draw(_model: &Model, _frame: &Frame, _shot: &Shot<'_>) -> Result<(), String> {
    Err(NO_SCENE.into())
}

/// What a picture says besides its time: the scenario's name without its folder.
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
    let shot = Shot { view: "orbit", size: [1280, 800], caption: &caption, out, fit: Vec::new() };
    if let Err(reason) = draw(run.model(), frame, &shot) {
        output::note(&format!("no picture: {reason}"));
    }
}
