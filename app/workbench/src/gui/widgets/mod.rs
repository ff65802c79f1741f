//! Widgets that several panels draw.

pub mod figures;
pub mod plot;
pub mod words;

use egui::{
    Align, Align2, Button, FontId, Grid, Id, Label, Layout, Rect, Response, RichText, Sense, Ui,
    UiBuilder, Vec2, vec2,
};
use endline_gear::Diagnostic;
use endline_gear::limits::ROPE_NODES;
use endline_session::command::{Command, EditAction};
use endline_session::edit::Documents;
use endline_session::edit::problems::place;
use endline_session::live::LiveView;

use crate::gui::command::action::WindowCommand;
use crate::gui::command::find;
use crate::gui::shared::Shared;
use crate::gui::theme::Theme;

/// Draws a caption in small grey capitals above a group.
pub fn caption(ui: &mut Ui, text: &str) {
    let faint = Theme::palette_of(ui).faint;
    ui.add_space(3.0);
    ui.label(RichText::new(text.to_uppercase()).size(10.5).color(faint).strong());
}

/// Draws the label of a field at a fixed width, so that fields align.
pub fn name(ui: &mut Ui, text: &str) {
    let (rect, _) = ui.allocate_exact_size(vec2(84.0, 20.0), Sense::hover());
    let (colour, font) = (Theme::palette_of(ui).faint, FontId::proportional(13.0));
    ui.painter().text(rect.left_center(), Align2::LEFT_CENTER, text, font, colour);
}

/// Draws a label of 150 to 230 points, truncated if it is longer, with the whole of it and a help on hover.
pub fn long_name(ui: &mut Ui, text: &str, help: &str) {
    let label = Label::new(RichText::new(text).color(Theme::palette_of(ui).faint)).truncate();
    let layout = Layout::left_to_right(Align::Center);
    ui.allocate_ui_with_layout(vec2(230.0, 20.0), layout, |ui| {
        ui.set_min_width(150.0);
        ui.add(label).on_hover_text(format!("{text}\n{help}"));
    });
}

/// Draws the reason why a panel is empty.
pub fn nothing(ui: &mut Ui, text: &str) {
    let faint = Theme::palette_of(ui).faint;
    ui.add_space(8.0);
    ui.vertical_centered(|ui| ui.label(RichText::new(text).color(faint)));
}

/// Draws in a rectangle of the panel, clipped to it.
pub fn within<R>(ui: &mut Ui, rect: Rect, draw: impl FnOnce(&mut Ui) -> R) {
    ui.scope_builder(UiBuilder::new().max_rect(rect), |ui| {
        ui.set_clip_rect(rect.intersect(ui.clip_rect()));
        draw(ui);
    });
}

/// Draws a piece of a long list. A piece out of sight is not laid out: it takes the size of its last layout at this width.
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

/// Draws names and values in two columns, with help on hover.
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

/// Draws names and values in two columns.
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

/// Draws a button that gives a command. It shows the help of the command on hover; a disabled one is grey, with the reason on hover.
pub fn command(
    ui: &mut Ui,
    shared: &mut Shared,
    text: &str,
    command: impl Into<WindowCommand>,
) -> Response {
    styled(ui, shared, Button::new(text), command)
}

/// Draws a button with its own style that gives a command.
pub fn styled(
    ui: &mut Ui,
    shared: &mut Shared,
    button: Button<'_>,
    command: impl Into<WindowCommand>,
) -> Response {
    let command = command.into();
    let declared = find(command.id());
    let enabled = declared.is_none_or(|info| info.enabled(shared).is_ok());
    let hint = declared.map(|info| info.hint(shared)).unwrap_or_default();
    let response = ui.add_enabled(enabled, button);
    let response =
        if enabled { response.on_hover_text(hint) } else { response.on_disabled_hover_text(hint) };
    if response.clicked() {
        shared.give(command);
    }
    response
}

/// Draws a problem of a file in two lines; returns whether it was clicked.
pub fn problem(ui: &mut Ui, problem: &Diagnostic) -> bool {
    let palette = Theme::palette_of(ui);
    let (mark, colour) =
        if problem.is_error() { ("✖", palette.error) } else { ("⚠", palette.warning) };
    let row = ui.scope(|ui| {
        ui.spacing_mut().item_spacing.y = 1.0;
        ui.horizontal(|ui| {
            ui.label(RichText::new(mark).color(colour));
            ui.label(RichText::new(place(problem)).monospace().size(12.0).color(palette.faint));
            if !problem.field.is_empty() {
                ui.label(
                    RichText::new(&problem.field).monospace().size(12.0).color(palette.accent),
                );
            }
            ui.add(Label::new(RichText::new(&problem.message).color(colour)).truncate());
        });
        if !problem.help.is_empty() {
            ui.horizontal(|ui| {
                ui.add_space(20.0);
                ui.add(Label::new(RichText::new(&problem.help).color(palette.faint)).truncate());
            });
        }
    });
    ui.add_space(4.0);
    row.response.interact(Sense::click()).on_hover_text(problem.to_string()).clicked()
}

/// Field and value that make the gear act on the whale.
const KINETIC: [&str; 2] = ["whale.dynamics", "kinetic"];

/// Button that doubles the rope nodes of the scenario, where it has a number of them.
pub fn more_nodes(ui: &mut Ui, shared: &mut Shared) {
    const FIELD: &str = "rope_nodes";
    if shared.workbench.shows_guest() {
        return;
    }
    let now = shared.documents().field(Documents::SCENARIO, FIELD);
    let Some(nodes) = now.and_then(|now| now.parse::<u64>().ok()?.checked_mul(2)) else { return };
    if nodes as f64 > ROPE_NODES.most {
        return;
    }
    let help =
        format!("Sets {FIELD} = {nodes} in the scenario; the next run uses it and takes longer");
    if ui.small_button(format!("Use {nodes} rope nodes")).on_hover_text(help).clicked() {
        shared.give(Command::from(EditAction::Set {
            path: Documents::SCENARIO.to_owned(),
            field: FIELD.to_owned(),
            value: nodes.to_string(),
        }));
    }
}

/// Warns if the whale of a run is kinematic, with a button that makes it kinetic in the scenario.
pub fn kinematic_whale(ui: &mut Ui, shared: &mut Shared, view: &LiveView) {
    let whale = view.model.spec.whale.as_ref();
    if view.model.spec.lines.is_empty() || whale.is_none_or(|whale| whale.kinetic.is_some()) {
        return;
    }
    let text = "The gear does not act on this whale: it moves as steered, whatever pulls. \
                Peak tensions are those of a whale that is never slowed.";
    let colour = Theme::palette_of(ui).warning;
    ui.horizontal_wrapped(|ui| {
        ui.add(Label::new(RichText::new(text).small().color(colour)).wrap());
        let documents = shared.documents();
        let of_scenario = !shared.workbench.shows_guest()
            && documents.field(Documents::SCENARIO, KINETIC[0]).is_none();
        let help = "Sets dynamics = \"kinetic\" in the scenario; the next run uses it";
        if of_scenario && ui.small_button("Let gear act on it").on_hover_text(help).clicked() {
            shared.give(Command::from(EditAction::Set {
                path: Documents::SCENARIO.to_owned(),
                field: KINETIC[0].to_owned(),
                value: KINETIC[1].to_owned(),
            }));
        }
    });
}
