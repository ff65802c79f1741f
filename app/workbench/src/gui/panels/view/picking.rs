//! What is read in the 3-D view, and the ruler: shown on the picture, told in a card beside it.

use crate::gui::command::action::ViewAction;
use egui::{
    Align, Align2, Color32, FontId, Frame, Layout, Painter, Pos2, Rect, RichText, Stroke, Ui,
    UiBuilder, pos2, vec2,
};
use endline_session::live::LiveView;
use endline_session::units::Units;
use glam::{DVec2, DVec3};

use super::split::Pane;
use crate::gui::inspector::{Reading, measured, read};
use crate::gui::shared::Shared;
use crate::gui::theme::Theme;
use crate::gui::widgets;
use crate::scene::{Camera, Picked};

/// Width of the card [points].
const WIDTH: f32 = 268.0;

/// What was picked.
#[derive(Clone, Debug, Default)]
pub struct Picks {
    /// What is read.
    pub read: Option<Picked>,
    /// Whether clicks measure.
    pub ruler: bool,
    /// Ends of the ruler, none to two.
    pub ends: Vec<Picked>,
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

/// Marks what is read and measured in a pane.
pub(super) fn paint(
    painter: &Painter,
    picks: &Picks,
    pane: Pane,
    camera: &Camera,
    view: &LiveView,
    units: Units,
) {
    let sheet = Sheet { painter, rect: pane.rect, camera };
    if let Some(picked) = picks.read {
        sheet.outline(picked, view);
        sheet.ring(picked, view);
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

const INK: Color32 = Color32::from_rgb(0xff, 0xf2, 0xc4);

/// A picture to mark places on.
struct Sheet<'a> {
    painter: &'a Painter,
    rect: Rect,
    camera: &'a Camera,
}

impl Sheet<'_> {
    fn place(&self, place: DVec3) -> Option<Pos2> {
        let size = DVec2::new(f64::from(self.rect.width()), f64::from(self.rect.height()));
        let at = self.camera.project(place, size)?;
        Some(self.rect.min + vec2(at.x as f32, at.y as f32))
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

    /// The whole line, or the box round a body.
    fn outline(&self, picked: Picked, view: &LiveView) {
        match picked {
            Picked::Rope { line, .. } => {
                let nodes = view
                    .model
                    .line_nodes
                    .get(line)
                    .and_then(|nodes| view.frame.nodes.get(nodes.clone()))
                    .unwrap_or_default();
                let segments =
                    view.model.line_segments.get(line).map_or(0, |segments| segments.start);
                for (order, ends) in nodes.windows(2).enumerate() {
                    let whole = !view.frame.cut.get(segments + order).copied().unwrap_or(false);
                    self.edge([ends[0], ends[1]], whole);
                }
            }
            Picked::Body(index) => {
                let pair = view.model.spec.bodies.get(index).zip(view.frame.bodies.get(index));
                let Some((body, (place, turn))) = pair else { return };
                let corners = body
                    .shape
                    .corners()
                    .map(|corner| *place + *turn * (body.shape_offset_m + corner));
                for one in 0..8_usize {
                    for other in
                        [one | 1, one | 2, one | 4].into_iter().filter(|other| *other != one)
                    {
                        self.edge([corners[one], corners[other]], true);
                    }
                }
            }
            Picked::Skin { .. } => {}
        }
    }

    fn edge(&self, ends: [DVec3; 2], wanted: bool) {
        if let (true, [Some(from), Some(to)]) = (wanted, ends.map(|end| self.place(end))) {
            self.painter.line_segment([from, to], Stroke::new(1.5, INK.gamma_multiply(0.75)));
        }
    }
}

/// The card with what is read or measured, at the upper left.
pub(super) fn card(ui: &mut Ui, picks: &Picks, shared: &mut Shared, view: &LiveView, rect: Rect) {
    let units = shared.workbench.preferences.units;
    let readings =
        [picks.read.and_then(|picked| read(view, picked, units)), ruler(picks, view, units)];
    let mut place = Rect::from_min_size(
        rect.min + vec2(12.0, 46.0),
        vec2(WIDTH.min(rect.width() - 24.0), rect.height() - 58.0),
    );
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
            frame.show(ui, |ui| told(ui, shared, &reading)).response.rect
        });
        place = Rect::from_min_max(pos2(place.left(), inner.inner.bottom() + 6.0), place.max);
    }
}

fn ruler(picks: &Picks, view: &LiveView, units: Units) -> Option<Reading> {
    let waiting =
        |text: &str| Reading { title: "Ruler".to_owned(), rows: vec![("Next", text.to_owned())] };
    match (picks.ruler, picks.ends.len()) {
        (false, _) => None,
        (true, 0) => Some(waiting("click where to measure from")),
        (true, 1) => Some(waiting("click where to measure to")),
        (true, _) => measured(view, &picks.ends, units),
    }
}

fn told(ui: &mut Ui, shared: &mut Shared, reading: &Reading) {
    ui.set_width(ui.available_width());
    ui.horizontal(|ui| {
        ui.label(RichText::new(&reading.title).strong().color(Theme::palette_of(ui).accent));
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            if ui.add(egui::Button::new("×").frame(false)).on_hover_text("Close").clicked() {
                shared.give(ViewAction::LetGo);
            }
        });
    });
    widgets::numbers(ui, &reading.title, &reading.rows);
}
