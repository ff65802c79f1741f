//! Films of a run: pictures written to a GIF, or by ffmpeg to MP4 or WebM.

use std::ffi::OsStr;
use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::{Arc, LazyLock};

use endline_session::scene::Show;
use endline_session::units::Units;
use endline_sim::{Frame, Model};
use gif::{Encoder, Repeat};

use crate::scene::camera::Camera;
use crate::scene::draw::Water;
use crate::scene::picture::{RenderRequest, Renderer};

/// Quality of the search for a GIF's palette: 1 best and slowest, 30 fastest.
const PALETTE_SPEED: i32 = 10;

/// A film file in progress.
pub struct Film {
    out: PathBuf,
    size: [u32; 2],
    fps: u32,
    to: Target,
}

enum Target {
    Gif(Box<Encoder<BufWriter<File>>>),
    Ffmpeg(Child),
}

impl Film {
    /// Whether a file is a film by its extension.
    pub fn is_named(out: &Path) -> bool {
        ["gif", "mp4", "webm"].contains(&extension(out).as_str())
    }

    /// Starts a film of a size [px] with a number of pictures per second.
    /// Errors: if the file cannot be written, its format does not allow the size, or ffmpeg is missing.
    pub fn begin(out: &Path, size: [u32; 2], fps: u32) -> Result<Self, String> {
        let to = match extension(out).as_str() {
            "gif" => Target::Gif(Box::new(begin_gif(out, size)?)),
            format => Target::Ffmpeg(begin_ffmpeg(out, size, fps, format)?),
        };
        Ok(Self { out: out.to_owned(), size, fps, to })
    }

    /// Adds a picture, row by row from the top: red, green, blue, opacity.
    pub fn add(&mut self, pixels: &[[u8; 4]]) -> Result<(), String> {
        let added = match &mut self.to {
            Target::Gif(encoder) => {
                let [width, height] = self.size.map(|side| side as u16);
                let bytes: Vec<u8> =
                    pixels.iter().flat_map(|[red, green, blue, _]| [*red, *green, *blue]).collect();
                let mut frame = gif::Frame::from_rgb_speed(width, height, &bytes, PALETTE_SPEED);
                frame.delay = hundredths(self.fps);
                encoder.write_frame(&frame).map_err(|error| error.to_string())
            }
            Target::Ffmpeg(child) => match &mut child.stdin {
                Some(input) => {
                    input.write_all(pixels.as_flattened()).map_err(|error| error.to_string())
                }
                None => Err("ffmpeg has closed its input".to_owned()),
            },
        };
        added.map_err(|reason| {
            format!("{}: the film cannot be written: {reason}", self.out.display())
        })
    }

    /// Ends the film.
    pub fn end(self) -> Result<(), String> {
        let Target::Ffmpeg(child) = self.to else { return Ok(()) };
        // `wait_with_output` closes the input of ffmpeg first, so that it ends.
        let ended = child.wait_with_output().map_err(|error| error.to_string())?;
        if ended.status.success() {
            return Ok(());
        }
        let messages = String::from_utf8_lossy(&ended.stderr);
        let last = messages.lines().last().unwrap_or("no message").to_owned();
        Err(format!("{}: ffmpeg could not make the film: {last}", self.out.display()))
    }
}

fn extension(out: &Path) -> String {
    out.extension().map(|extension| extension.to_string_lossy().to_lowercase()).unwrap_or_default()
}

/// Display time of a picture of a GIF [1/100 s].
fn hundredths(fps: u32) -> u16 {
    (100.0 / f64::from(fps.max(1))).round().max(2.0) as u16
}

fn begin_gif(out: &Path, size: [u32; 2]) -> Result<Encoder<BufWriter<File>>, String> {
    let explain = |reason: &dyn std::fmt::Display| {
        format!("{}: the film cannot be written: {reason}", out.display())
    };
    let file = BufWriter::new(File::create(out).map_err(|error| explain(&error))?);
    let [width, height] = size.map(|side| side as u16);
    let mut encoder = Encoder::new(file, width, height, &[]).map_err(|error| explain(&error))?;
    encoder.set_repeat(Repeat::Infinite).map_err(|error| explain(&error))?;
    Ok(encoder)
}

/// Whether the program ffmpeg, which MP4 and WebM need, is in the search path. It is looked up once.
pub fn has_ffmpeg() -> bool {
    static FOUND: LazyLock<bool> = LazyLock::new(|| {
        std::env::var_os("PATH").is_some_and(|folders| has_program("ffmpeg", &folders))
    });
    *FOUND
}

fn has_program(name: &str, folders: &OsStr) -> bool {
    let file = format!("{name}{}", std::env::consts::EXE_SUFFIX);
    std::env::split_paths(folders).any(|folder| folder.join(&file).is_file())
}

fn begin_ffmpeg(out: &Path, size: [u32; 2], fps: u32, format: &str) -> Result<Child, String> {
    let [width, height] = size;
    if !width.is_multiple_of(2) || !height.is_multiple_of(2) {
        return Err(format!(
            "a film as {format} has an even width and height; {width}x{height} is not: try --size {}x{}",
            width + width % 2,
            height + height % 2
        ));
    }
    let codec: &[&str] = match format {
        "webm" => &["-c:v", "libvpx-vp9", "-crf", "32", "-b:v", "0", "-row-mt", "1"],
        _ => &["-c:v", "libx264", "-crf", "20", "-movflags", "+faststart"],
    };
    let begun = Command::new("ffmpeg")
        .args(["-hide_banner", "-loglevel", "error", "-y", "-f", "rawvideo", "-pix_fmt", "rgba"])
        .args(["-s", &format!("{width}x{height}"), "-r", &fps.to_string(), "-i", "-", "-an"])
        .args(codec)
        .args(["-pix_fmt", "yuv420p"])
        .arg(out)
        .stdin(Stdio::piped())
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn();
    begun.map_err(|error| {
        format!(
            "a film as {format} needs the program ffmpeg, which cannot be started ({error}); install it, or write a .gif, which needs nothing"
        )
    })
}

/// Frames of a run to be drawn as a film. One tension scale applies to all, so that a colour has one meaning.
pub struct Reel<'a> {
    /// The gear, sea and whale.
    pub model: &'a Model,
    /// A frame for each picture.
    pub frames: &'a [Arc<Frame>],
    /// Width and height [px].
    pub size: [u32; 2],
    /// Camera for each frame.
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
    /// Draws all frames into a film and ends it. After each picture, `proceed` receives the number drawn so far; the film ends there if it
    /// returns `false`. Returns the number of pictures drawn.
    pub fn draw(
        &self,
        mut film: Film,
        mut proceed: impl FnMut(usize) -> bool,
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
                show,
                fit: &[],
                caption: self.caption,
                out: Path::new(""),
                units: self.units,
            };
            film.add(&renderer.seen_by(&request, &(self.camera)(frame), self.water))?;
            drawn += 1;
            if !proceed(drawn) {
                break;
            }
        }
        film.end()?;
        Ok(drawn)
    }
}

#[cfg(test)]
mod tests {

    use super::*;

    #[test]
    fn a_gif_has_every_picture_with_its_colours_and_time() {
        let out = std::env::temp_dir().join(format!("endline-film-{}.gif", std::process::id()));
        let mut film = Film::begin(&out, [32, 16], 20).unwrap();
        let colours = [[200, 30, 30, 255], [20, 180, 40, 255], [10, 20, 220, 255]];
        for colour in colours {
            film.add(&[colour; 32 * 16]).unwrap();
        }
        film.end().unwrap();
        let mut options = gif::DecodeOptions::new();
        options.set_color_output(gif::ColorOutput::RGBA);
        let mut decoder = options.read_info(File::open(&out).unwrap()).unwrap();
        for colour in colours {
            let frame = decoder.read_next_frame().unwrap().expect("a picture");
            assert_eq!((frame.width, frame.height, frame.delay), (32, 16, 5));
            let seen = &frame.buffer[..3];
            assert!(
                seen.iter().zip(colour).all(|(seen, made)| seen.abs_diff(made) < 4),
                "{seen:?} for {colour:?}"
            );
        }
        assert!(decoder.read_next_frame().unwrap().is_none());
        std::fs::remove_file(out).unwrap();
    }

    #[test]
    fn an_odd_size_and_a_missing_folder_are_refused() {
        let odd = Film::begin(Path::new("x.mp4"), [33, 16], 20).err().unwrap();
        assert!(odd.contains("try --size 34x16"), "{odd}");
        let nowhere = Film::begin(Path::new("/nowhere/x.gif"), [32, 16], 20).err().unwrap();
        assert!(nowhere.contains("/nowhere/x.gif"), "{nowhere}");
    }
}
