//! Pictures made in the background: a film of the run shown, and the thumbnail of a recording. Neither simulates anything again.

use std::io::BufReader;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::Receiver;
use std::time::Duration;

use egui::ColorImage;
use endline_session::live::LiveView;
use endline_session::recording::kept;
use endline_session::scene::{Scene, Show};
use endline_session::task::{Task, Waker};
use endline_session::units::Units;
use endline_session::workbench::Notice;
use endline_sim::{Frame, Model};

use crate::scene::film::Film;
use crate::scene::{
    Camera, CameraPath, Eye, Reel, RenderRequest, Renderer, View, Water, write_png,
};

/// Widths and heights of films to choose from [px].
pub const FILM_SIZES: [[u32; 2]; 3] = [[640, 360], [1280, 720], [1920, 1080]];
/// Pictures per second of a film.
const FPS: u32 = 20;
/// Bytes per pixel of a picture in a GIF and in an MP4 file, measured on `case-e25-05-roll` from 9 to 11 s in the view orbit.
/// The whole run in the view whale-side has 0.20 and 0.0037.
const BYTES_PER_PIXEL: [f64; 2] = [0.323, 0.0064];

/// Size and part of the run of a film.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FilmChoice {
    /// Width and height [px].
    pub size: [u32; 2],
    /// First and last moment [s]; the last is at most the end of the run.
    pub span_s: [f64; 2],
}

impl Default for FilmChoice {
    fn default() -> Self {
        Self { size: FILM_SIZES[1], span_s: [0.0, f64::INFINITY] }
    }
}

impl FilmChoice {
    /// Number of pictures of a run that ends at a time [s].
    pub fn pictures(&self, end_s: f64) -> usize {
        let [from_s, to_s] = self.span_s;
        pictures(to_s.min(end_s) - from_s)
    }

    /// Expected sizes of a number of pictures as GIF and as MP4 [MB].
    pub fn megabytes(&self, pictures: usize) -> [f64; 2] {
        let pixels = self.size.map(f64::from).iter().product::<f64>() * pictures as f64;
        BYTES_PER_PIXEL.map(|bytes| 1e-6 * bytes * pixels)
    }
}

/// Number of pictures in a time [s].
fn pictures(time_s: f64) -> usize {
    if time_s < 0.0 { 0 } else { (time_s * f64::from(FPS) + 1e-6).floor() as usize + 1 }
}

/// Time limit for the run to send its stored frames.
const PATIENCE: Duration = Duration::from_secs(30);

/// Content and file of a film.
pub struct FilmOrder {
    /// The gear, sea and whale.
    pub model: Arc<Model>,
    /// Receives the stored frames of the run.
    pub frames: Receiver<Vec<Arc<Frame>>>,
    /// The eye, used where the camera path has no keys.
    pub eye: Eye,
    /// Camera path; its keys override the eye.
    pub path: CameraPath<Eye>,
    /// Size and part of the run.
    pub choice: FilmChoice,
    /// What is drawn.
    pub show: Show,
    /// Dark or light.
    pub water: Water,
    /// Line of text at the top left.
    pub caption: String,
    /// Units of the scale bar.
    pub units: Units,
    /// The file: GIF, MP4 or WebM by its extension.
    pub out: PathBuf,
}

/// A film in progress.
pub struct FilmJob {
    out: PathBuf,
    progress: Arc<Progress>,
    task: Task<Result<(), String>>,
}

/// Number of pictures drawn and in total, and whether to stop.
#[derive(Default)]
struct Progress {
    drawn: AtomicUsize,
    total: AtomicUsize,
    stop: AtomicBool,
}

impl FilmJob {
    /// Starts a film. Errors of its file are returned immediately.
    pub fn begin(order: FilmOrder, waker: Waker) -> Result<Self, String> {
        let film = Film::begin(&order.out, order.choice.size, FPS)?;
        let (progress, mut task) = (Arc::new(Progress::default()), Task::default());
        let (out, shared_progress) = (order.out.clone(), Arc::clone(&progress));
        let awake = Arc::clone(&waker);
        task.start("endline-film", move || order.draw(film, &shared_progress, &awake), waker)
            .map_err(|error| format!("the film cannot be started: {error}"))?;
        Ok(Self { out, progress, task })
    }

    /// Ends it after the picture that is being drawn.
    pub fn cancel(&self) {
        self.progress.stop.store(true, Ordering::Relaxed);
    }

    /// The file.
    pub fn out(&self) -> &Path {
        &self.out
    }

    /// Number of pictures drawn, and in total.
    pub fn counted(&self) -> (usize, usize) {
        let count = |number: &AtomicUsize| number.load(Ordering::Relaxed);
        (count(&self.progress.drawn), count(&self.progress.total))
    }

    /// Returns the outcome once, after it has ended.
    pub fn ended(&mut self) -> Option<Notice> {
        let ended = self.task.poll()?;
        let ((drawn, of), out) = (self.counted(), self.out.display());
        Some(match ended.unwrap_or_else(|_| Err("a fault in the program".to_owned())) {
            Ok(()) if drawn < of => Notice::done(format!("saved {out}: {drawn} of {of} pictures")),
            Ok(()) => Notice::done(format!("saved {out}")),
            Err(error) => Notice::fault(error),
        })
    }
}

impl FilmOrder {
    fn draw(&self, film: Film, progress: &Progress, waker: &Waker) -> Result<(), String> {
        let stored = self.frames.recv_timeout(PATIENCE);
        let FilmChoice { size, span_s } = self.choice;
        let frames = paced(&stored.map_err(|_| "the run does not send its frames")?, span_s);
        progress.total.store(frames.len(), Ordering::Relaxed);
        let aspect = f64::from(size[0]) / f64::from(size[1]);
        let camera = |frame: &Frame| {
            let placed = |eye: &Eye| eye.at_moment(&self.model, frame, aspect);
            self.path.camera(frame.time_s, placed).unwrap_or_else(|| placed(&self.eye))
        };
        let reel = Reel {
            model: &self.model,
            frames: &frames,
            size,
            camera: &camera,
            show: self.show,
            water: self.water,
            caption: &self.caption,
            units: self.units,
        };
        let drawn = reel.draw(film, |drawn| {
            progress.drawn.store(drawn, Ordering::Relaxed);
            waker();
            !progress.stop.load(Ordering::Relaxed)
        });
        drawn.map(drop)
    }
}

/// The stored frame nearest in time to each picture, in a part of the run [s].
fn paced(stored: &[Arc<Frame>], [from_s, to_s]: [f64; 2]) -> Vec<Arc<Frame>> {
    let (Some(first), Some(last)) = (stored.first(), stored.last()) else { return Vec::new() };
    let begin_s = first.time_s.max(from_s);
    let count = pictures(last.time_s.min(to_s) - begin_s);
    let at = |picture: usize| {
        let time_s = begin_s + picture as f64 / f64::from(FPS);
        let after = stored.partition_point(|frame| frame.time_s < time_s).min(stored.len() - 1);
        let before = after.saturating_sub(1);
        let off = |index: usize| (stored[index].time_s - time_s).abs();
        Arc::clone(&stored[if off(before) < off(after) { before } else { after }])
    };
    (0..count).map(at).collect()
}

/// Width and height of a thumbnail [px].
const THUMBNAIL_SIZE: [u32; 2] = [256, 144];

/// The thumbnail that is being drawn: it shows the last frame of a recorded run.
#[derive(Debug, Default)]
pub struct Thumbnail {
    task: Task<()>,
}

impl Thumbnail {
    /// Draws the moment of a view and saves it beside a recording. Errors are ignored: a recording needs no thumbnail.
    pub fn begin(&mut self, view: Arc<LiveView>, recording: &Path, waker: Waker) {
        let file = kept::picture(recording);
        let _ = self.task.start("endline-picture", move || drop(draw_ending(&view, &file)), waker);
    }

    /// Whether a thumbnail was finished, or failed, since the last call.
    pub fn ended(&mut self) -> bool {
        self.task.poll().is_some()
    }
}

/// Draws the whale from its side if rope or gear has touched it, otherwise everything.
fn draw_ending(view: &LiveView, file: &PathBuf) -> Result<(), String> {
    let (model, frame) = (&view.model, &view.frame);
    let whale = view.summary.as_ref().and_then(|summary| summary.whale.as_ref());
    let touched =
        whale.is_some_and(|whale| whale.first_contact_s.is_some() || whale.peak_body_push_n > 0.0);
    let from = if touched { View::WhaleSide } else { View::Orbit };
    let length_m = model.spec.whale.as_ref().map_or(10.0, |whale| whale.length_m);
    let aspect = f64::from(THUMBNAIL_SIZE[0]) / f64::from(THUMBNAIL_SIZE[1]);
    let places = Scene::places_of(model, frame);
    let camera = Camera::of_view(from, &places, frame.whale.as_ref(), length_m, aspect);
    let request = RenderRequest {
        model,
        frame,
        size: THUMBNAIL_SIZE,
        view: "",
        show: Show { names: false, ..Show::default() },
        fit: &[],
        caption: "",
        out: file,
        units: Units::Mixed,
    };
    write_png(
        file,
        THUMBNAIL_SIZE,
        &Renderer::new(THUMBNAIL_SIZE)?.bare(&request, &camera, Water::DARK),
    )
}

/// Reads the thumbnail of a recording; `None` if there is none or it cannot be read.
pub fn thumbnail(recording: &Path) -> Option<ColorImage> {
    let file = endline_gear::read::open(&kept::picture(recording)).ok()?;
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::sample;

    #[test]
    fn each_picture_shows_the_frame_nearest_to_its_time() {
        let model = sample::model();
        let frame = |time_s: f64| Arc::new(Frame { time_s, ..sample::frame(&model) });
        let stored: Vec<Arc<Frame>> = (0..=30).map(|step| frame(f64::from(step) / 30.0)).collect();
        let times: Vec<f64> =
            paced(&stored, FilmChoice::default().span_s).iter().map(|frame| frame.time_s).collect();
        assert_eq!(times.len(), 21);
        for (picture, time_s) in times.iter().enumerate() {
            assert!(
                (time_s - picture as f64 / 20.0).abs() <= 1.0 / 60.0 + 1e-9,
                "{picture}: {time_s}"
            );
        }
        let part: Vec<f64> = paced(&stored, [0.4, 0.6]).iter().map(|frame| frame.time_s).collect();
        assert_eq!(part, [0.4, 0.45, 0.5, 0.55, 0.6].map(|time_s: f64| nearest(time_s)));
        assert!(paced(&stored, [2.0, 3.0]).is_empty() && paced(&[], [0.0, 1.0]).is_empty());
    }

    /// The moment of thirty in a second that is nearest to a time; of two as near, the later.
    fn nearest(time_s: f64) -> f64 {
        (time_s * 30.0 + 1e-9).round() / 30.0
    }

    #[test]
    fn pictures_and_sizes_of_a_film_are_counted_before_it_is_made() {
        let all = FilmChoice::default();
        assert_eq!(all.pictures(2.0), 41);
        assert_eq!(FilmChoice { span_s: [0.5, 1.5], ..all }.pictures(2.0), 21);
        assert_eq!(FilmChoice { span_s: [3.0, 9.0], ..all }.pictures(2.0), 0);
        // 41 pictures of 1280 by 720 were 12.2 MB as GIF and 0.24 MB as MP4.
        let [gif, mp4] = all.megabytes(41);
        assert!((gif / 12.2 - 1.0).abs() < 0.05 && mp4 < 0.3, "{gif} and {mp4} MB");
    }
}
