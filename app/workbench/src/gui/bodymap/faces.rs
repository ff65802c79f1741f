//! The four faces of a whale in a panel, two beside each other.

use egui::{Align2, Color32, FontId, Painter, Rect, Sense, Ui, WidgetInfo, WidgetType, vec2};
use endline_sdk::Region;

use super::{BodyMap, Face};
use crate::gui::theme::Theme;

/// Room for the name of a face above it.
const NAME: f32 = 16.0;

impl BodyMap {
    /// Colour of skin of which nothing is told.
    #[must_use]
    pub fn plain(ui: &Ui) -> Color32 {
        if ui.visuals().dark_mode {
            Color32::from_rgb(0x6d, 0x7b, 0x84)
        } else {
            Color32::from_rgb(0xb4, 0xc0, 0xc7)
        }
    }

    /// Draws every face, each region in its colour, and `over` on top of it. Answers the region under the pointer, and whether it
    /// was clicked.
    pub fn faces(
        &mut self,
        ui: &mut Ui,
        sense: Sense,
        colour: impl Fn(Region) -> Color32,
        over: impl Fn(&Self, &Painter, Face, Rect),
    ) -> Option<(Region, bool)> {
        let mut at = None;
        let width = (ui.available_width() - 16.0) / 2.0;
        for faces in Face::ALL.chunks(2) {
            let heights = faces.iter().map(|face| width * self.aspect(*face));
            let size = vec2(width, heights.fold(0.0, f32::max) + NAME + 2.0);
            ui.horizontal(|ui| {
                for face in faces {
                    let (rect, response) = ui.allocate_exact_size(size, sense);
                    if !ui.is_rect_visible(rect) {
                        continue;
                    }
                    let told = || WidgetInfo::labeled(WidgetType::Image, true, face.name());
                    response.widget_info(told);
                    let below = rect.with_min_y(rect.top() + NAME).shrink(2.0);
                    self.face(ui, *face, rect, below, &colour);
                    over(self, &ui.painter_at(rect), *face, below);
                    let pointer = response.hover_pos();
                    let region = pointer.and_then(|pointer| self.hit(*face, below, pointer));
                    at = region.map(|region| (region, response.clicked())).or(at);
                }
            });
        }
        at
    }

    fn face(
        &mut self,
        ui: &Ui,
        face: Face,
        rect: Rect,
        below: Rect,
        colour: &impl Fn(Region) -> Color32,
    ) {
        let painter = ui.painter_at(rect);
        let faint = Theme::palette_of(ui).faint;
        let font = FontId::proportional(11.0);
        painter.text(rect.left_top(), Align2::LEFT_TOP, face.name(), font, faint);
        painter.add(self.mesh(face, below, colour));
    }
}
