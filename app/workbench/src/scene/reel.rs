//! Moments of a run drawn as a film: one scale of tension for all, so that no colour changes that does not mean it.

use std::path::Path;
use std::sync::Arc;

use endline_session::scene::Show;
use endline_session::units::Units;
use endline_sim::{Frame, Model};

use super::camera::Camera;
use super::draw::Water;
use super::film::Film;
use super::picture::{RenderRequest, Renderer};

/// What a film shows.
pub struct Reel<'a> {
    /// The gear, sea and whale.
    pub model: &'a Model,
    /// A moment for each picture.
    pub frames: &'a [Arc<Frame>],
    /// Width and height [px].
    pub size: [u32; 2],
    /// Where each moment is seen from.
    pub camera: &'a dyn Fn(&Frame) -> Camera,
    /// What is drawn.
    pub show: Show,
    /// Dark or light.
    pub water: Water,
    /// Line of text at the top left.
    pub caption: &'a str,
    /// Units of the scale bar.
    pub units: Units,
}

impl Reel<'_> {
    /// Draws every moment into a film and ends it; `go_on` hears of each picture and ends the film there where it
    /// answers `false`. Answers how many were drawn.
    ///
    /// # Errors
    /// Without OpenGL, or where the film cannot be written.
    pub fn draw(
        &self,
        mut film: Film,
        mut go_on: impl FnMut(usize) -> bool,
    ) -> Result<usize, String> {
        let mut renderer = Renderer::new(self.size)?;
        let tensions = self.frames.iter().flat_map(|frame| frame.tension_n.iter().copied());
        let scale_n = Some(tensions.fold(0.0, f64::max));
        let show = Show { scale_n, ..self.show };
        let mut drawn = 0;
        for frame in self.frames {
            let request = RenderRequest {
                model: self.model,
                frame,
                size: self.size,
                view: "",
                scale_n,
                fit: &[],
                caption: self.caption,
                out: Path::new(""),
                units: self.units,
            };
            film.add(&renderer.seen_by(&request, &show, &(self.camera)(frame), self.water))?;
            drawn += 1;
            if !go_on(drawn) {
                break;
            }
        }
        film.end()?;
        Ok(drawn)
    }
}
