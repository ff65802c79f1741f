//! State of the 3-D view: eyes, camera path, visible parts, picks, and the scenes drawn.

use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

use egui::{Align2, FontId, Ui, pos2};
use endline_session::live::{LiveView, Status};
use endline_session::scene::{Scene, Show};
use endline_sim::{Frame, Model};

use crate::gui::panel::Panel;
use crate::gui::panels::view::picking::Picks;
use crate::gui::panels::view::pose::Start;
use crate::gui::pictures::{FilmChoice, FilmJob, FilmOrder};
use crate::gui::shared::Shared;
use crate::gui::theme::Theme;
use crate::gui::widgets::words;
use crate::scene::draw::MOST_PANES;
use crate::scene::{CameraPath, Canvas, Eye, RenderRequest, Renderer, View, Water, write_png};

/// Top of the tension scale.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ScaleTop {
    /// Peak of the run so far.
    #[default]
    Peak,
    /// The least breaking strength of the ropes.
    Strength,
}

/// The scene of a run, updated when the frame changes.
#[derive(Default)]
pub struct Drawn {
    /// The drawing; `None` without OpenGL.
    pub canvas: Option<Arc<Mutex<Canvas>>>,
    shown: Option<(Arc<Frame>, Show)>,
}

/// The 3-D view.
pub struct ViewPanel {
    /// An eye for each pane, at least one.
    pub eyes: Vec<Eye>,
    /// Active pane, which menus and keys apply to.
    pub chosen: usize,
    /// Visible parts of the scene.
    pub show: Show,
    /// Top of the tension scale.
    pub scale: ScaleTop,
    /// Size and part of a film.
    pub film: FilmChoice,
    /// Camera path of a film.
    pub path: CameraPath<Eye>,
    /// Whether the active pane previews the camera path.
    pub along: bool,
    /// Things picked for readings and the ruler.
    pub picks: Picks,
    /// Scenes of the run and of the run it is compared with.
    pub drawn: [Drawn; 2],
    /// Tension at the top of the scale in the last frame [N].
    pub(super) scale_n: f64,
    /// Start of the whale while it is dragged.
    pub(super) held: Option<Start>,
    /// State of the run in the last frame.
    seen: Seen,
}

/// State of the run that resets the views when it changes.
#[derive(Default)]
struct Seen {
    model: Option<Arc<Model>>,
    settling: bool,
    flying: bool,
}

impl Default for ViewPanel {
    fn default() -> Self {
        Self {
            eyes: vec![Eye::default()],
            chosen: 0,
            show: Show { forces: true, ..Show::default() },
            scale: ScaleTop::default(),
            film: FilmChoice::default(),
            path: CameraPath::default(),
            along: false,
            picks: Picks::default(),
            drawn: <[Drawn; 2]>::default(),
            scale_n: 1.0,
            held: None,
            seen: Seen::default(),
        }
    }
}

impl ViewPanel {
    /// Eye of the active pane.
    pub fn eye(&mut self) -> &mut Eye {
        let last = self.eyes.len() - 1;
        &mut self.eyes[self.chosen.min(last)]
    }

    /// Sets the number of panes; a new one gets a view that no other has.
    pub fn split(&mut self, count: usize) {
        const FROM: [View; MOST_PANES] = [View::Side, View::Top, View::Front, View::FirstPerson];
        self.eyes.truncate(count.max(1));
        while self.eyes.len() < count.min(MOST_PANES) {
            let fresh =
                FROM.into_iter().find(|view| self.eyes.iter().all(|eye| eye.named != *view));
            self.eyes.push(Eye::at(fresh.unwrap_or_default()));
        }
        self.chosen = self.chosen.min(self.eyes.len() - 1);
        self.frame_all();
    }

    /// Frames everything when the model changes or statics have converged. Follows the whale from the start of a flight on, and in a run
    /// of a search, a study or a recording, which ends where the whale has swum to. The end of a flight does not move the camera.
    pub(super) fn follow(&mut self, shared: &Shared) {
        if !std::mem::replace(&mut self.seen.flying, shared.flying) && shared.flying {
            self.follow_whale();
        }
        let Some(view) = shared.workbench.view() else { return };
        let known = self.seen.model.as_ref().is_some_and(|model| Arc::ptr_eq(model, &view.model));
        let settling = view.status == Status::Settling;
        let settled = std::mem::replace(&mut self.seen.settling, settling) && !settling;
        if !known {
            self.seen.model = Some(Arc::clone(&view.model));
        }
        // While the start of the whale is dragged, the view stays.
        if (!known || settled) && !shared.posing {
            self.frame_all();
        }
        if !known && shared.workbench.shows_guest() && view.model.spec.whale.is_some() {
            self.follow_whale();
        }
    }

    /// Changes to a named view.
    pub fn look(&mut self, view: View) {
        self.eye().set_view(view);
    }

    /// Frames everything.
    pub fn frame(&mut self) {
        self.eye().frame();
    }

    /// Frames everything in all panes at the next frame.
    fn frame_all(&mut self) {
        self.eyes.iter_mut().for_each(|eye| eye.frame_again = true);
    }

    /// Follows the whale, in its last view of the whale or from behind.
    fn follow_whale(&mut self) {
        let named = self.eye().named;
        self.look(if named.is_of_whale() { named } else { View::Whale });
    }

    /// Sets a camera key with the view of the active pane.
    pub fn set_key(&mut self, time_s: f64) {
        let mut eye = self.eye().clone();
        eye.frame_again = false;
        self.path.set(time_s, eye);
    }

    /// Removes all camera keys.
    pub fn clear_keys(&mut self) {
        self.path.clear();
        self.along = false;
    }

    /// Switches between first and third person.
    pub fn change_person(&mut self) {
        let first = self.eye().named.is_first_person();
        self.look(if first { View::Whale } else { View::FirstPerson });
    }
}

impl Drawn {
    /// Creates a canvas if the other run has one.
    pub fn like(&mut self, other: bool) {
        if other && self.canvas.is_none() {
            self.canvas = Some(Arc::new(Mutex::new(Canvas::default())));
        }
    }

    /// Updates the scene if the frame or the visible parts have changed.
    pub fn load(&mut self, view: &LiveView, show: Show) {
        if self
            .shown
            .as_ref()
            .is_some_and(|(frame, shown)| Arc::ptr_eq(frame, &view.frame) && *shown == show)
        {
            return;
        }
        self.shown = Some((Arc::clone(&view.frame), show));
        if let Some(canvas) = &self.canvas {
            let scene = Scene::of(&view.model, &view.frame, &show);
            canvas.lock().unwrap_or_else(PoisonError::into_inner).load(scene);
        }
    }
}

/// Tension at the top of the colour scale [N].
pub fn scale_top(view: &LiveView, top: ScaleTop) -> f64 {
    let peak = || {
        view.summary
            .iter()
            .flat_map(|summary| &summary.lines)
            .map(|line| line.peak_tension_n)
            .fold(0.0, f64::max)
    };
    let strength = || {
        let places = view.model.spec.lines.iter().flat_map(|line| &line.weak_places);
        let places = places.map(|place| place.strength_n);
        view.model
            .rope_strength_n
            .iter()
            .copied()
            .chain(places)
            .filter(|strength| strength.is_finite())
            .fold(f64::INFINITY, f64::min)
    };
    let value = match top {
        ScaleTop::Peak => peak(),
        ScaleTop::Strength => strength(),
    };
    let now = view.frame.tension_n.iter().copied().fold(0.0, f64::max);
    if value.is_finite() && value > 0.0 { value } else { now }.max(1.0)
}

/// Width and height of a saved picture [px].
const PICTURE_SIZE: [u32; 2] = [1920, 1080];

impl ViewPanel {
    /// Starts a film of the run, as the active pane shows it.
    pub fn begin_film(&mut self, shared: &mut Shared, out: PathBuf) -> Result<FilmJob, String> {
        if shared.film.is_some() {
            return Err("a film is in progress; wait for it or cancel it".to_owned());
        }
        let view = shared.workbench.view().cloned().ok_or("there is no run to film")?;
        // Refused before the file is created, which may replace one.
        if self.film.pictures(view.newest_s) == 0 {
            let [from_s, _] = self.film.span_s;
            return Err(format!(
                "the run ends at {:.2} s, before the film begins at {from_s:.2} s; choose another part in the menu Film",
                view.newest_s
            ));
        }
        let order = FilmOrder {
            model: Arc::clone(&view.model),
            frames: shared.workbench.kept_frames()?,
            eye: self.eye().clone(),
            path: self.path.clone(),
            choice: self.film,
            show: self.show,
            water: water(shared),
            caption: caption(shared),
            units: shared.workbench.preferences().units,
            out,
        };
        FilmJob::begin(order, shared.workbench.helpers().1)
    }

    /// Saves the active pane as a PNG, drawn again at full size.
    pub fn save_picture(&mut self, shared: &Shared, file: &Path) -> Result<(), String> {
        let view = shared.workbench.view().ok_or("there is no run to draw")?;
        let (model, frame) = (Arc::clone(&view.model), Arc::clone(&view.frame));
        let show = Show { scale_n: Some(self.scale_n), ..self.show };
        let camera = self.eye().camera.clone();
        let (water, caption) = (water(shared), caption(shared));
        let (units, file) = (shared.workbench.preferences().units, PathBuf::from(file));
        // On a separate thread, because the OpenGL of the window is current on this one.
        let drawing = std::thread::spawn(move || {
            let request = RenderRequest {
                model: &model,
                frame: &frame,
                size: PICTURE_SIZE,
                view: "",
                show,
                fit: &[],
                caption: &caption,
                out: &file,
                units,
            };
            let pixels = Renderer::new(PICTURE_SIZE)?.seen_by(&request, &camera, water);
            write_png(&file, PICTURE_SIZE, &pixels)
        });
        drawing.join().map_err(|_| "the picture could not be drawn".to_owned())?
    }
}

fn water(shared: &Shared) -> Water {
    if shared.preferences.theme == Theme::Dark { Water::DARK } else { Water::LIGHT }
}

/// Name of the scenario, or of another source of the run.
fn caption(shared: &Shared) -> String {
    let of = shared.workbench.guest().map(str::to_owned);
    of.unwrap_or_else(|| shared.workbench.scenario_stem())
}

/// Height of the letters [points].
const LETTERS: f32 = 20.0;

impl ViewPanel {
    /// Draws only the view, with the name of the run and its outcome in large letters above it, for a talk.
    pub fn presented(&mut self, ui: &mut Ui, shared: &mut Shared) {
        let top = ui.max_rect().center_top();
        self.ui(ui, shared);
        let palette = Theme::palette_of(ui);
        let painter = ui.painter();
        let name = title(shared);
        let font = FontId::proportional(LETTERS);
        painter.text(pos2(top.x, top.y + 8.0), Align2::CENTER_TOP, name, font, palette.text);
        let Some(view) = shared.workbench.view().filter(|view| view.newest_s > 0.0) else { return };
        let Some(whale) = view.summary.as_ref().and_then(|summary| summary.whale.as_ref()) else {
            return;
        };
        let (outcome, _, colour) = words::outcome_at(whale, view.newest_s, palette);
        let place = pos2(top.x, top.y + 8.0 + 1.3 * LETTERS);
        painter.text(
            place,
            Align2::CENTER_TOP,
            outcome,
            FontId::proportional(0.8 * LETTERS),
            colour,
        );
    }
}

/// Name of the scenario, or of another source of the run.
fn title(shared: &Shared) -> String {
    let documents = shared.documents();
    let scenario = || documents.field(endline_session::edit::Documents::SCENARIO, "name");
    let guest = shared.workbench.guest().map(str::to_owned);
    guest.or_else(scenario).unwrap_or_else(|| shared.workbench.scenario_stem())
}
