//! What is read in the 3-D view, and the ruler: what a click and a resting pointer pick.

use egui::{PopupAnchor, Pos2, Rect, Response, RichText, Tooltip, Ui};
use endline_session::live::LiveView;
use endline_session::scene::Show;
use endline_session::units::Units;
use glam::DVec2;

use crate::gui::inspector::read;
use crate::gui::theme::Theme;
use crate::gui::widgets;
use crate::scene::pick::pick;
use crate::scene::{Camera, Picked};

/// Between the pointer and what is told of the thing that it rests on [points].
const GAP: f32 = 16.0;

/// What was picked.
#[derive(Clone, Debug, Default)]
pub struct Picks {
    /// What is read.
    pub read: Option<Picked>,
    /// What the pointer rests on, in the run of this number.
    pub hovered: Option<(usize, Picked)>,
    /// Whether clicks measure.
    pub ruler: bool,
    /// Ends of the ruler, none to two.
    pub ends: Vec<Picked>,
    /// Where cards were drawn last: what lies behind them is not picked.
    pub(super) cards: Vec<Rect>,
}

impl Picks {
    /// Takes a click: on a thing, or beside all of them.
    pub fn take(&mut self, hit: Option<Picked>) {
        if !self.ruler {
            self.read = hit;
            return;
        }
        if hit.is_none() || self.ends.len() == 2 {
            self.ends.clear();
        }
        self.ends.extend(hit);
    }

    /// Clicks measure, or read again.
    pub fn toggle_ruler(&mut self) {
        self.ruler = !self.ruler;
        self.ends.clear();
    }

    /// Whether something is read or measured.
    #[must_use]
    pub fn holds(&self) -> bool {
        self.read.is_some() || self.ruler
    }

    /// Nothing is read or measured.
    pub fn let_go(&mut self) {
        (self.read, self.ruler) = (None, false);
        self.ends.clear();
    }
}

/// What stands at a place of a pane; nothing behind a card.
pub(super) fn under(
    picks: &Picks,
    view: &LiveView,
    camera: &Camera,
    (rect, at): (Rect, Pos2),
    show: &Show,
) -> Option<Picked> {
    if picks.cards.iter().any(|card| card.contains(at)) {
        return None;
    }
    let at = at - rect.min;
    let (at, size) = (
        DVec2::new(f64::from(at.x), f64::from(at.y)),
        DVec2::new(f64::from(rect.width()), f64::from(rect.height())),
    );
    pick(&view.model, &view.frame, camera, at, size, show)
}

/// Tells beside the pointer what it rests on; a card already tells of what is read.
pub(super) fn glance(ui: &Ui, picks: &Picks, response: &Response, view: &LiveView, units: Units) {
    let hovered = picks.hovered.map(|(_, hovered)| hovered);
    let Some(hovered) = hovered.filter(|hovered| picks.read != Some(*hovered)) else { return };
    let Some(reading) = read(view, hovered, units) else { return };
    let reading = reading.glance(hovered);
    let context = ui.ctx().clone();
    let tooltip =
        Tooltip::always_open(context, response.layer_id, response.id, PopupAnchor::Pointer);
    tooltip.gap(GAP).show(|ui| {
        ui.label(RichText::new(&reading.title).strong().color(Theme::palette_of(ui).accent));
        widgets::numbers(ui, "glance", &reading.rows);
    });
}
