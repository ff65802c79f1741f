//! The view as a picture or film in a file, drawn anew at full size: not a crop of the screen.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use endline_session::scene::Show;

use super::ViewPanel;
use crate::gui::pictures::{FilmJob, FilmOrder};
use crate::gui::shared::Shared;
use crate::gui::theme::Theme;
use crate::scene::{RenderRequest, Renderer, Water, write_png};

/// Width and height [px].
const SIZE: [u32; 2] = [1920, 1080];

impl ViewPanel {
    /// Begins a film of the run as the chosen pane shows it.
    ///
    /// # Errors
    /// Without a run, while another film is made, or where the file cannot be begun.
    pub fn film(&mut self, shared: &mut Shared, out: PathBuf) -> Result<FilmJob, String> {
        if shared.film.is_some() {
            return Err("a film is being made; wait for it, or cancel it".to_owned());
        }
        let view = shared.workbench.view().cloned().ok_or("there is no run to film")?;
        let order = FilmOrder {
            model: Arc::clone(&view.model),
            frames: shared.workbench.kept_frames()?,
            eye: self.eye().clone(),
            path: self.path.clone(),
            show: self.show,
            water: water(shared),
            caption: caption(shared),
            units: shared.workbench.preferences.units,
            out,
        };
        FilmJob::begin(order, shared.workbench.helpers().1)
    }

    /// Writes what the chosen pane shows of the run as a PNG.
    ///
    /// # Errors
    /// Without a run or OpenGL, or where the file cannot be written.
    pub fn save_picture(&mut self, shared: &Shared, file: &Path) -> Result<(), String> {
        let view = shared.workbench.view().ok_or("there is no run to draw")?;
        let (model, frame) = (Arc::clone(&view.model), Arc::clone(&view.frame));
        let show = Show { scale_n: Some(self.scale_n), ..self.show };
        let camera = self.eye().camera.clone();
        let (water, caption) = (water(shared), caption(shared));
        let (units, file) = (shared.workbench.preferences.units, PathBuf::from(file));
        // A thread of its own: the window's OpenGL stays current on this one.
        let drawing = std::thread::spawn(move || {
            let request = RenderRequest {
                model: &model,
                frame: &frame,
                size: SIZE,
                view: "",
                scale_n: show.scale_n,
                fit: &[],
                caption: &caption,
                out: &file,
                units,
            };
            let pixels = Renderer::new(SIZE)?.seen_by(&request, &show, &camera, water);
            write_png(&file, SIZE, &pixels)
        });
        drawing.join().map_err(|_| "the picture could not be drawn".to_owned())?
    }
}

fn water(shared: &Shared) -> Water {
    if shared.preferences.theme == Theme::Dark { Water::DARK } else { Water::LIGHT }
}

/// What is shown: the scenario, or what else the run is of.
fn caption(shared: &Shared) -> String {
    let of = shared.workbench.guest().map(str::to_owned);
    of.unwrap_or_else(|| shared.workbench.scenario_stem())
}
