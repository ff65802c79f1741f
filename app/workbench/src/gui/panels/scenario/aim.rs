//! Aim: places the start of the whale so that it meets a line at a depth with a part of its body.

use egui::{CollapsingHeader, ComboBox, Grid, Label, RichText, TextEdit, Ui};
use endline_gear::units::{Quantity, parse};
use endline_sdk::BodyPart;
use endline_session::encounters::meet::{Meeting, USUAL_GAP_M, meet};
use endline_session::live::LiveView;

use super::name;
use crate::gui::command::action::{PanelAction, ViewAction};
use crate::gui::panel::PanelId;
use crate::gui::panels::view::pose::{Start, write_start};
use crate::gui::shared::Shared;
use crate::gui::theme::Theme;
use crate::gui::widgets::words::spoken;

/// What the whale is to meet, and the answer to the last try.
#[derive(Debug)]
pub(super) struct AimForm {
    line: String,
    depth: String,
    part: BodyPart,
    answer: Option<Result<String, String>>,
}

impl Default for AimForm {
    fn default() -> Self {
        Self {
            line: String::new(),
            depth: "10 m".to_owned(),
            part: BodyPart::LeftFlipper,
            answer: None,
        }
    }
}

/// Draws the aim of a living whale, once its model has been assembled.
pub(super) fn show(ui: &mut Ui, shared: &mut Shared, form: &mut AimForm) {
    let Some(view) = shared.workbench.view().cloned() else { return };
    if view.model.spec.whale.is_none() || view.model.spec.lines.is_empty() {
        return;
    }
    CollapsingHeader::new("Aim at a line").id_salt("aim").show(ui, |ui| {
        Grid::new("aim fields").num_columns(2).spacing([8.0, 3.0]).show(ui, |ui| {
            name(ui, "Line");
            line(ui, &view, form);
            ui.end_row();
            name(ui, "Depth");
            let width = ui.available_width() - 12.0;
            ui.add(TextEdit::singleline(&mut form.depth).desired_width(width))
                .on_hover_text("Depth of the place on the line that the whale meets");
            ui.end_row();
            name(ui, "With its");
            part(ui, form);
            ui.end_row();
        });
        let why_not = why_not(shared, &view);
        let button = ui.add_enabled(why_not.is_none(), egui::Button::new("Place the start"));
        let help = "Moves the start so that the whale meets the line there, with its heading, its speed and the current; Ctrl+Z takes it back";
        let button = button.on_hover_text(help).on_disabled_hover_text(why_not.unwrap_or_default());
        if button.clicked() {
            form.answer = Some(aim(shared, &view, form));
        }
        if let Some(answer) = &form.answer {
            let palette = Theme::palette_of(ui);
            let (text, colour) = match answer {
                Ok(text) => (text, palette.faint),
                Err(text) => (text, palette.error),
            };
            ui.add(Label::new(RichText::new(text).size(12.0).color(colour)).wrap());
        }
    });
}

/// Why the start cannot be placed now.
fn why_not(shared: &Shared, view: &LiveView) -> Option<&'static str> {
    if shared.workbench.making() || shared.workbench.stale() {
        return Some("Apply the edits first");
    }
    (view.frame.time_s > 0.0).then_some("Restart the run first: the aim needs the gear at rest")
}

/// Id of a line, or of the whole of which it is a piece.
fn whole_id(id: &str) -> &str {
    match id.rsplit_once('.') {
        Some((whole, piece)) if piece.bytes().all(|letter| letter.is_ascii_digit()) => whole,
        _ => id,
    }
}

/// Ids of lines; the pieces of a line have the id of the whole.
fn lines(view: &LiveView) -> Vec<&str> {
    let mut lines: Vec<&str> =
        view.model.spec.lines.iter().map(|line| whole_id(&line.id)).collect();
    lines.dedup();
    lines
}

/// Id of the line that rises most, which is met at most depths.
fn highest(view: &LiveView) -> Option<&str> {
    let rise_m = |line: usize| {
        let nodes = &view.frame.nodes[view.model.line_nodes[line].clone()];
        let heights = || nodes.iter().map(|node| node.z);
        heights().fold(f64::MIN, f64::max) - heights().fold(f64::MAX, f64::min)
    };
    let lines = view.model.spec.lines.iter().enumerate();
    let highest = lines.max_by(|(one, _), (other, _)| rise_m(*one).total_cmp(&rise_m(*other)));
    highest.map(|(_, line)| line.id.as_str())
}

fn line(ui: &mut Ui, view: &LiveView, form: &mut AimForm) {
    let lines = lines(view);
    if !lines.contains(&form.line.as_str()) {
        form.line = highest(view).map_or_else(String::new, |line| whole_id(line).to_owned());
    }
    let width = ui.available_width() - 8.0;
    let combo = ComboBox::from_id_salt("aim line").width(width).truncate();
    combo.selected_text(form.line.clone()).show_ui(ui, |ui| {
        for line in lines {
            if ui.selectable_label(form.line == line, line).clicked() {
                line.clone_into(&mut form.line);
            }
        }
    });
}

fn part(ui: &mut Ui, form: &mut AimForm) {
    let width = ui.available_width() - 8.0;
    let combo = ComboBox::from_id_salt("aim part").width(width).truncate();
    combo.selected_text(spoken(form.part.name())).show_ui(ui, |ui| {
        for part in BodyPart::ALL {
            ui.selectable_value(&mut form.part, part, spoken(part.name()));
        }
    });
}

/// Places the start; returns what follows from it.
fn aim(shared: &mut Shared, view: &LiveView, form: &AimForm) -> Result<String, String> {
    let depth_m =
        parse(&form.depth, Quantity::Length).map_err(|error| format!("Depth: {error}"))?;
    let meeting = Meeting { line: form.line.clone(), depth_m, part: form.part, gap_m: USUAL_GAP_M };
    let met = meet(&view.model, &view.frame, &meeting).map_err(|error| error.to_string())?;
    let Some(start) = Start::of(shared.documents()) else {
        return Err("The scenario's start cannot be read; correct its position".to_owned());
    };
    write_start(shared, &Start { place: met.start_m, ..start });
    shared.give(PanelAction::Show(PanelId::View));
    if !shared.posing {
        shared.give(ViewAction::Pose);
    }
    let units = shared.workbench.preferences().units;
    Ok(format!(
        "The {} meets {} at a depth of {} after {:.1} s.",
        spoken(form.part.name()),
        form.line,
        units.depth(-met.place_m.z),
        met.after_s
    ))
}
