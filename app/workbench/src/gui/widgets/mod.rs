//! Pieces of the screen that several panels draw.

pub mod command;
pub mod figures;
pub mod plot;
pub mod plot_key;
pub mod problem;
pub mod steered;
pub mod words;

use egui::{Align2, FontId, Grid, Id, Rect, RichText, Sense, Ui, UiBuilder, Vec2, vec2};

use super::theme::Theme;

/// A line of small grey text above a group.
pub fn caption(ui: &mut Ui, text: &str) {
    let faint = Theme::palette_of(ui).faint;
    ui.add_space(3.0);
    ui.label(RichText::new(text.to_uppercase()).size(10.5).color(faint).strong());
}

/// The name of a field, all as wide, so that fields line up.
pub fn name(ui: &mut Ui, text: &str) {
    let (rect, _) = ui.allocate_exact_size(vec2(84.0, 20.0), Sense::hover());
    let (colour, font) = (Theme::palette_of(ui).faint, FontId::proportional(13.0));
    ui.painter().text(rect.left_center(), Align2::LEFT_CENTER, text, font, colour);
}

/// A line that says why a panel is empty.
pub fn nothing(ui: &mut Ui, text: &str) {
    let faint = Theme::palette_of(ui).faint;
    ui.add_space(8.0);
    ui.vertical_centered(|ui| ui.label(RichText::new(text).color(faint)));
}

/// Draws in a part of the panel and nowhere else.
pub fn within<R>(ui: &mut Ui, rect: Rect, draw: impl FnOnce(&mut Ui) -> R) {
    ui.scope_builder(UiBuilder::new().max_rect(rect), |ui| {
        ui.set_clip_rect(rect.intersect(ui.clip_rect()));
        draw(ui);
    });
}

/// Draws a piece of a long list. Out of sight it is not laid out: its room is that of the last time it was, at this width.
pub fn where_seen(ui: &mut Ui, id: Id, draw: impl FnOnce(&mut Ui)) {
    let width = ui.available_width();
    let known =
        ui.data(|data| data.get_temp::<Vec2>(id)).filter(|room| (room.x - width).abs() < 0.5);
    if let Some(room) = known {
        let rect = Rect::from_min_size(ui.cursor().min, room);
        if !ui.is_rect_visible(rect) {
            ui.allocate_space(room);
            return;
        }
    }
    let height = ui.scope(draw).response.rect.height();
    ui.data_mut(|data| data.insert_temp(id, vec2(width, height)));
}

/// Names and values in two columns, with what each is on hover.
pub fn explained(ui: &mut Ui, id: &str, rows: &[(&str, String, &str)]) {
    let faint = Theme::palette_of(ui).faint;
    Grid::new(id).num_columns(2).spacing([16.0, 2.0]).min_row_height(17.0).show(ui, |ui| {
        for (name, value, help) in rows {
            ui.label(RichText::new(*name).color(faint)).on_hover_text(*help);
            ui.label(RichText::new(value)).on_hover_text(*help);
            ui.end_row();
        }
    });
}

/// Names and values in two columns.
pub fn numbers(ui: &mut Ui, id: &str, rows: &[(&str, String)]) {
    let faint = Theme::palette_of(ui).faint;
    Grid::new(id).num_columns(2).spacing([16.0, 2.0]).min_row_height(17.0).show(ui, |ui| {
        for (name, value) in rows {
            ui.label(RichText::new(*name).color(faint));
            ui.label(RichText::new(value));
            ui.end_row();
        }
    });
}
