//! State of the 3-D view: its eyes, what is shown, what is drawn.

use std::sync::{Arc, Mutex, PoisonError};

use endline_session::live::LiveView;
use endline_sim::Frame;

use super::super::super::canvas::Canvas;
use super::super::super::order::Order;
use super::super::super::picking::Picks;
use super::eye::Eye;
use crate::scene::{Scene, Show, View};

/// Panes at most.
pub const MOST: usize = 4;

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

/// State of the 3-D view.
pub struct ViewState {
    /// An eye for each pane, at least one.
    pub eyes: Vec<Eye>,
    /// The pane whose eye is turned by menus and keys.
    pub chosen: usize,
    /// What is shown.
    pub show: Show,
    /// Top of the tension scale.
    pub scale: ScaleTop,
    /// What is read and measured.
    pub picks: Picks,
    /// The drawings of the run and of the one it is compared with.
    pub drawn: [Drawn; 2],
    /// Tension at the top of the scale as drawn last [N].
    pub scale_n: f64,
}

impl Default for ViewState {
    fn default() -> Self {
        Self {
            eyes: vec![Eye::default()],
            chosen: 0,
            show: Show { forces: true, ..Show::default() },
            scale: ScaleTop::default(),
            picks: Picks::default(),
            drawn: <[Drawn; 2]>::default(),
            scale_n: 1.0,
        }
    }
}

impl ViewState {
    /// The eye that menus and keys turn.
    pub fn eye(&mut self) -> &mut Eye {
        let last = self.eyes.len() - 1;
        &mut self.eyes[self.chosen.min(last)]
    }

    /// Shows so many panes; a new one looks from where none looks yet.
    pub fn split(&mut self, count: usize) {
        const FROM: [View; MOST] = [View::Side, View::Top, View::Front, View::FirstPerson];
        self.eyes.truncate(count.max(1));
        while self.eyes.len() < count.min(MOST) {
            let fresh =
                FROM.into_iter().find(|view| self.eyes.iter().all(|eye| eye.named != *view));
            self.eyes.push(Eye::at(fresh.unwrap_or_default()));
        }
        self.chosen = self.chosen.min(self.eyes.len() - 1);
        self.frame_all();
    }

    /// Looks, reads and measures by one order.
    pub fn obey(&mut self, order: &Order) {
        match order {
            Order::Person => self.change_person(),
            Order::Look(view) => self.look(*view),
            Order::Frame => self.frame(),
            Order::Views(count) => self.split(*count),
            Order::Ruler => self.picks.toggle_ruler(),
            Order::LetGo => self.picks.let_go(),
            Order::Read(picked) => self.picks.read = Some(*picked),
            _ => {}
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
    pub fn frame_all(&mut self) {
        self.eyes.iter_mut().for_each(|eye| eye.frame_again = true);
    }

    /// Goes with the whale: as it last did, or behind it.
    pub fn go_with_whale(&mut self) {
        let named = self.eye().named;
        self.look(if named.is_of_whale() { named } else { View::Whale });
    }

    /// Stays where it is, with everything in sight.
    pub fn leave_whale(&mut self) {
        self.frame();
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
