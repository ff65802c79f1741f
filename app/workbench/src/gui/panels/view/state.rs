//! State of the 3-D view: its eyes, what is shown, what is drawn.

use std::sync::{Arc, Mutex, PoisonError};

use endline_session::live::{LiveView, Status};
use endline_session::scene::{Scene, Show};
use endline_sim::{Frame, Model};

use super::picking::Picks;
use super::pose::Start;
use crate::gui::shared::Shared;
use crate::scene::draw::MOST_PANES;
use crate::scene::{CameraPath, Canvas, Eye, View};

/// What the top of the tension scale is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ScaleTop {
    /// The run's peak so far.
    #[default]
    Peak,
    /// The least breaking strength of the ropes.
    Strength,
}

/// A run's scene as it was drawn last.
#[derive(Default)]
pub struct Drawn {
    /// The drawing, where there is OpenGL.
    pub canvas: Option<Arc<Mutex<Canvas>>>,
    shown: Option<(Arc<Frame>, Show)>,
}

/// The 3-D view.
pub struct ViewPanel {
    /// An eye for each pane, at least one.
    pub eyes: Vec<Eye>,
    /// The pane whose eye is turned by menus and keys.
    pub chosen: usize,
    /// What is shown.
    pub show: Show,
    /// Top of the tension scale.
    pub scale: ScaleTop,
    /// Keys of the camera, by which a film goes.
    pub path: CameraPath<Eye>,
    /// Whether the chosen pane looks by the keys of the camera.
    pub along: bool,
    /// What is read and measured.
    pub picks: Picks,
    /// The drawings of the run and of the one it is compared with.
    pub drawn: [Drawn; 2],
    /// Tension at the top of the scale as drawn last [N].
    pub(super) scale_n: f64,
    /// The whale's start while it is dragged.
    pub(super) held: Option<Start>,
    /// The run as it was seen last.
    seen: Seen,
}

/// What of the run changes where the eyes look.
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
    /// The eye that menus and keys turn.
    pub fn eye(&mut self) -> &mut Eye {
        let last = self.eyes.len() - 1;
        &mut self.eyes[self.chosen.min(last)]
    }

    /// Shows so many panes; a new one looks from where none looks yet.
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

    /// Takes the view anew where the run shows another model or gear come to rest; goes with the whale while it is flown.
    pub(super) fn follow(&mut self, shared: &Shared) {
        if std::mem::replace(&mut self.seen.flying, shared.flying) != shared.flying {
            if shared.flying {
                self.go_with_whale();
            } else {
                self.frame();
            }
        }
        let Some(view) = shared.workbench.view() else { return };
        let known = self.seen.model.as_ref().is_some_and(|model| Arc::ptr_eq(model, &view.model));
        let settling = view.status == Status::Settling;
        let settled = std::mem::replace(&mut self.seen.settling, settling) && !settling;
        if !known {
            self.seen.model = Some(Arc::clone(&view.model));
        }
        // Whoever drags the whale's start wants to see it from where they drag it.
        if (!known || settled) && !shared.posing {
            self.frame_all();
        }
    }

    /// Goes to a named view.
    pub fn look(&mut self, view: View) {
        self.eye().look(view);
    }

    /// Brings everything into sight.
    pub fn frame(&mut self) {
        self.eye().frame();
    }

    /// Every eye takes its view anew with the next frame.
    fn frame_all(&mut self) {
        self.eyes.iter_mut().for_each(|eye| eye.frame_again = true);
    }

    /// Goes with the whale: as it last did, or behind it.
    fn go_with_whale(&mut self) {
        let named = self.eye().named;
        self.look(if named.is_of_whale() { named } else { View::Whale });
    }

    /// Sets a key of the camera: what the chosen pane shows, at the moment shown.
    pub fn set_key(&mut self, time_s: f64) {
        let mut eye = self.eye().clone();
        eye.frame_again = false;
        self.path.set(time_s, eye);
    }

    /// Takes every key of the camera away.
    pub fn clear_keys(&mut self) {
        self.path.clear();
        self.along = false;
    }

    /// From third person to first and back.
    pub fn change_person(&mut self) {
        let first = self.eye().named == View::FirstPerson;
        self.look(if first { View::Whale } else { View::FirstPerson });
    }
}

impl Drawn {
    /// Has a canvas where the other run's drawing has one.
    pub fn like(&mut self, other: bool) {
        if other && self.canvas.is_none() {
            self.canvas = Some(Arc::new(Mutex::new(Canvas::default())));
        }
    }

    /// Makes the scene anew where the moment or what is shown has changed.
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
#[must_use]
pub fn scale_top(view: &LiveView, top: ScaleTop) -> f64 {
    let peak = || {
        view.summary
            .iter()
            .flat_map(|summary| &summary.lines)
            .map(|line| line.peak_tension_n)
            .fold(0.0, f64::max)
    };
    let strength = || {
        view.model
            .segment_strength_n
            .iter()
            .copied()
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
