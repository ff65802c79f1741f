//! Marks in the 3-D view of what is read, measured and under the pointer.

use egui::{Align2, Color32, FontId, Painter, Pos2, Rect, Shape, Stroke, vec2};
use endline_session::live::LiveView;
use endline_session::units::Units;
use glam::{DVec2, DVec3};

use super::picking::Picks;
use super::split::Pane;
use crate::gui::inspector::measured;
use crate::scene::silhouette::silhouette;
use crate::scene::{Camera, Picked};

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

/// Whether two places are of one line or body.
fn same_thing(one: Picked, other: Picked) -> bool {
    match (one, other) {
        (Picked::Rope { line: one, .. }, Picked::Rope { line: other, .. }) => one == other,
        _ => one == other,
    }
}

const INK: Color32 = Color32::from_rgb(0xff, 0xf2, 0xc4);
/// Of what the pointer rests on.
const FAINT: Color32 = Color32::from_rgba_premultiplied(0x90, 0x88, 0x6e, 0x90);

/// A picture to mark places on.
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

    /// The whole line, or the outline of a body.
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
