//! A picture of how a kept run ended, drawn beside its recording on a thread of its own.

use std::fs::File;
use std::io::BufReader;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use egui::ColorImage;
use endline_session::live::LiveView;
use endline_session::recording::kept;
use endline_session::scene::{Scene, Show};
use endline_session::task::{Task, Waker};
use endline_session::units::Units;

use crate::scene::{Camera, RenderRequest, Renderer, View, Water, write_png};

/// Width and height [px].
const SIZE: [u32; 2] = [256, 144];

/// The picture that is being drawn.
#[derive(Debug, Default)]
pub struct KeptPicture {
    task: Task<()>,
}

impl KeptPicture {
    /// Draws the moment that a view shows beside a recording. A recording without a picture is as good: nobody is told
    /// where none can be drawn.
    pub fn begin(&mut self, view: Arc<LiveView>, recording: &Path, waker: Waker) {
        let file = kept::picture(recording);
        let _ = self.task.start("endline-picture", move || drop(draw(&view, &file)), waker);
    }

    /// Whether one has been drawn, or given up, since the last call.
    pub fn ended(&mut self) -> bool {
        self.task.poll().is_some()
    }
}

/// The whale from its side where rope or gear has touched it, else everything.
fn draw(view: &LiveView, file: &PathBuf) -> Result<(), String> {
    let (model, frame) = (&view.model, &view.frame);
    let whale = view.summary.as_ref().and_then(|summary| summary.whale.as_ref());
    let touched =
        whale.is_some_and(|whale| whale.first_contact_s.is_some() || whale.peak_body_push_n > 0.0);
    let from = if touched { View::WhaleSide } else { View::Orbit };
    let length_m = model.spec.whale.as_ref().map_or(10.0, |whale| whale.length_m);
    let aspect = f64::from(SIZE[0]) / f64::from(SIZE[1]);
    let places = Scene::places_of(model, frame);
    let camera = Camera::of_view(from, &places, frame.whale.as_ref(), length_m, aspect);
    let request = RenderRequest {
        model,
        frame,
        size: SIZE,
        view: "",
        scale_n: None,
        fit: &[],
        caption: "",
        out: file,
        units: Units::Mixed,
    };
    let show = Show { names: false, ..Show::default() };
    write_png(file, SIZE, &Renderer::new(SIZE)?.bare(&request, &show, &camera, Water::DARK))
}

/// The picture beside a recording; none where there is none that can be read.
#[must_use]
pub fn read(recording: &Path) -> Option<ColorImage> {
    let file = File::open(kept::picture(recording)).ok()?;
    let mut reader = png::Decoder::new(BufReader::new(file)).read_info().ok()?;
    let info = reader.info();
    let ([width, height], right) = (
        [info.width as usize, info.height as usize],
        info.width <= 1024 && info.height <= 1024 && info.color_type == png::ColorType::Rgb,
    );
    let mut bytes = vec![0; reader.output_buffer_size().filter(|_| right)?];
    reader.next_frame(&mut bytes).ok()?;
    (bytes.len() == 3 * width * height).then(|| ColorImage::from_rgb([width, height], &bytes))
}
