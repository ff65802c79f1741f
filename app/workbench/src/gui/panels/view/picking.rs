//! Picks of the 3-D view: readings and ruler by clicks, a tooltip at the pointer, their cards, and their marks in the panes.

use egui::{
    Align2, Button, Color32, FontId, Frame, Painter, PopupAnchor, Pos2, Rect, Response, RichText,
    Shape, Stroke, Tooltip, Ui, UiBuilder, pos2, vec2,
};
use endline_session::live::LiveView;
use endline_session::scene::Show;
use endline_session::units::Units;
use glam::{DVec2, DVec3};

use crate::gui::command::action::ViewAction;
use crate::gui::inspector::{Reading, measured, read};
use crate::gui::panels::view::pane::Pane;
use crate::gui::shared::Shared;
use crate::gui::theme::Theme;
use crate::gui::widgets;
use crate::scene::pick::pick;
use crate::scene::silhouette::silhouette;
use crate::scene::{Camera, Picked};

/// Distance between the pointer and its tooltip [points].
const GAP: f32 = 16.0;

/// Picked things.
#[derive(Clone, Debug, Default)]
pub struct Picks {
    /// The thing whose reading is shown.
    pub read: Option<Picked>,
    /// Number of the run and thing under the pointer.
    pub hovered: Option<(usize, Picked)>,
    /// Whether clicks set the ends of the ruler.
    pub ruler: bool,
    /// Ends of the ruler, up to two.
    pub ends: Vec<Picked>,
    /// Rectangles of the cards; nothing behind them is picked.
    pub(super) cards: Vec<Rect>,
}

impl Picks {
    /// Handles a click on a thing or on open water.
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

    /// Switches between ruler and readings.
    pub fn toggle_ruler(&mut self) {
        self.ruler = !self.ruler;
        self.ends.clear();
    }

    /// Whether a reading or the ruler is shown.
    pub fn holds(&self) -> bool {
        self.read.is_some() || self.ruler
    }

    /// Closes reading and ruler.
    pub fn let_go(&mut self) {
        (self.read, self.ruler) = (None, false);
        self.ends.clear();
    }
}

/// Picks the thing at a point of a pane; `None` behind a card.
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

/// Shows a tooltip with the reading under the pointer, unless a card shows it.
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

/// Width of a card [points].
const WIDTH: f32 = 268.0;

/// Draws the cards of the reading and the ruler at the upper left; returns their rectangles.
pub(super) fn show_cards(
    ui: &mut Ui,
    picks: &Picks,
    shared: &mut Shared,
    view: &LiveView,
    rect: Rect,
) -> Vec<Rect> {
    let units = shared.workbench.preferences().units;
    let readings =
        [picks.read.and_then(|picked| read(view, picked, units)), ruler(picks, view, units)];
    let mut place = Rect::from_min_size(
        rect.min + vec2(12.0, 46.0),
        vec2(WIDTH.min(rect.width() - 24.0), rect.height() - 58.0),
    );
    let mut drawn = Vec::new();
    for reading in readings.into_iter().flatten() {
        let fill = Theme::palette_of(ui).panel.gamma_multiply(0.94);
        let line = Theme::palette_of(ui).line;
        let inner = ui.scope_builder(UiBuilder::new().max_rect(place), |ui| {
            ui.set_clip_rect(rect.intersect(ui.clip_rect()));
            let frame = Frame::new()
                .fill(fill)
                .stroke(Stroke::new(1.0, line))
                .corner_radius(6.0)
                .inner_margin(8.0);
            let card = frame.show(ui, |ui| rows(ui, &reading)).response.rect;
            close(ui, shared, card);
            card
        });
        drawn.push(inner.inner);
        place = Rect::from_min_max(pos2(place.left(), inner.inner.bottom() + 6.0), place.max);
    }
    drawn
}

fn ruler(picks: &Picks, view: &LiveView, units: Units) -> Option<Reading> {
    let waiting =
        |text: &str| Reading { title: "Ruler".to_owned(), rows: vec![("Next", text.to_owned())] };
    match (picks.ruler, picks.ends.len()) {
        (false, _) => None,
        (true, 0) => Some(waiting("click the start of the distance")),
        (true, 1) => Some(waiting("click the end of the distance")),
        (true, _) => measured(view, &picks.ends, units),
    }
}

fn rows(ui: &mut Ui, reading: &Reading) {
    ui.set_width(ui.available_width());
    ui.label(RichText::new(&reading.title).strong().color(Theme::palette_of(ui).accent));
    widgets::numbers(ui, &reading.title, &reading.rows);
}

/// Draws the button that closes a card, in its corner.
fn close(ui: &mut Ui, shared: &mut Shared, card: Rect) {
    let corner = Rect::from_min_size(card.right_top() + vec2(-26.0, 4.0), vec2(22.0, 22.0));
    if ui.put(corner, Button::new("×").frame(false)).on_hover_text("Close").clicked() {
        shared.give(ViewAction::LetGo);
    }
}

/// Marks the picked things in a pane.
pub(super) fn paint_marks(
    painter: &Painter,
    picks: &Picks,
    pane: Pane,
    camera: &Camera,
    view: &LiveView,
    units: Units,
) {
    let sheet = Sheet { painter, rect: pane.rect, camera };
    let hovered = picks.hovered.filter(|(run, picked)| {
        *run == pane.run && picks.read.is_none_or(|read| !same_thing(read, *picked))
    });
    if let Some((_, hovered)) = hovered {
        sheet.outline(hovered, view, FAINT);
        if matches!(hovered, Picked::RopeOnSkin { .. } | Picked::BodyOnSkin { .. }) {
            sheet.ring(hovered, view);
        }
    }
    if let Some(picked) = picks.read {
        sheet.outline(picked, view, INK);
        if !matches!(picked, Picked::Body(_)) {
            sheet.ring(picked, view);
        }
    }
    let ends: Vec<Pos2> = picks.ends.iter().filter_map(|end| sheet.ring(*end, view)).collect();
    if let [from, to] = ends[..] {
        painter.line_segment([from, to], Stroke::new(3.0, Color32::from_black_alpha(150)));
        painter.line_segment([from, to], Stroke::new(1.5, INK));
        let straight =
            measured(view, &picks.ends, units).and_then(|reading| reading.rows.into_iter().next());
        if let Some((_, text)) = straight {
            sheet.label(from + (to - from) * 0.5 - vec2(0.0, 14.0), &text);
        }
    }
}

/// Whether two places are on the same line or body.
fn same_thing(one: Picked, other: Picked) -> bool {
    match (one, other) {
        (Picked::Rope { line: one, .. }, Picked::Rope { line: other, .. }) => one == other,
        _ => one == other,
    }
}

const INK: Color32 = Color32::from_rgb(0xff, 0xf2, 0xc4);
/// For the thing under the pointer.
const FAINT: Color32 = Color32::from_rgba_premultiplied(0x90, 0x88, 0x6e, 0x90);

/// A pane to draw on at places in the world.
struct Sheet<'a> {
    painter: &'a Painter,
    rect: Rect,
    camera: &'a Camera,
}

impl Sheet<'_> {
    fn place(&self, place: DVec3) -> Option<Pos2> {
        Some(self.on_screen(self.camera.project(place, self.size())?))
    }

    /// Size of the picture [points].
    fn size(&self) -> DVec2 {
        DVec2::new(f64::from(self.rect.width()), f64::from(self.rect.height()))
    }

    fn on_screen(&self, at: DVec2) -> Pos2 {
        self.rect.min + vec2(at.x as f32, at.y as f32)
    }

    fn ring(&self, picked: Picked, view: &LiveView) -> Option<Pos2> {
        let at = self.place(picked.place(&view.model, &view.frame)?)?;
        self.painter.circle_stroke(at, 7.0, Stroke::new(4.0, Color32::from_black_alpha(150)));
        self.painter.circle_stroke(at, 7.0, Stroke::new(2.0, INK));
        Some(at)
    }

    fn label(&self, at: Pos2, text: &str) {
        let galley = self.painter.layout_no_wrap(text.to_owned(), FontId::proportional(13.0), INK);
        let plate = Rect::from_center_size(at, galley.size() + vec2(10.0, 4.0));
        self.painter.rect_filled(plate, 4.0, Color32::from_black_alpha(170));
        self.painter.text(at, Align2::CENTER_CENTER, text, FontId::proportional(13.0), INK);
    }

    /// Outlines a whole line or a body.
    fn outline(&self, picked: Picked, view: &LiveView, ink: Color32) {
        match picked {
            Picked::Rope { line, .. } => self.line(line, view, ink),
            Picked::Body(index) => self.body(index, view, ink),
            Picked::Skin { .. } | Picked::RopeOnSkin { .. } | Picked::BodyOnSkin { .. } => {}
        }
    }

    fn line(&self, line: usize, view: &LiveView, ink: Color32) {
        let nodes = view.model.line_nodes.get(line);
        let nodes = nodes.and_then(|nodes| view.frame.nodes.get(nodes.clone())).unwrap_or_default();
        let segments = view.model.line_segments.get(line).map_or(0, |segments| segments.start);
        for (order, ends) in nodes.windows(2).enumerate() {
            let cut = view.frame.cut.get(segments + order).copied().unwrap_or(false);
            if let (false, Some(from), Some(to)) = (cut, self.place(ends[0]), self.place(ends[1])) {
                let stroke = Stroke::new(1.5, ink.gamma_multiply(0.75));
                self.painter.line_segment([from, to], stroke);
            }
        }
    }

    fn body(&self, index: usize, view: &LiveView, ink: Color32) {
        let pair = view.model.spec.bodies.get(index).zip(view.frame.bodies.get(index));
        let Some((body, at)) = pair else { return };
        for outline in silhouette(body, *at, self.camera, self.size()) {
            self.closed(outline.into_iter().map(|at| self.on_screen(at)).collect(), ink);
        }
    }

    fn closed(&self, outline: Vec<Pos2>, ink: Color32) {
        let fill = ink.gamma_multiply(0.15);
        self.painter.add(Shape::convex_polygon(outline.clone(), fill, Stroke::NONE));
        let dark = Color32::from_black_alpha(ink.a() / 2);
        self.painter.add(Shape::closed_line(outline.clone(), Stroke::new(5.0, dark)));
        self.painter.add(Shape::closed_line(outline, Stroke::new(2.0, ink)));
    }
}
