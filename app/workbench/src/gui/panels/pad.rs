//! Assignment of sticks, triggers and buttons of the pad, with live values, dead zones and curve.

use std::ops::RangeInclusive;

use egui::{Grid, RichText, ScrollArea, Sense, Slider, SliderClamping, Ui, vec2};

use crate::gui::panel::Panel;
use crate::gui::shared::Shared;
use crate::gui::theme::Theme;
use crate::gui::widgets;
use crate::input::{AxisUse, Hands, Mapping, PadAxis, Pressed, Steered};

/// Function that waits for its button or stick.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Learning {
    /// Nothing.
    #[default]
    Nothing,
    /// A function of a button.
    Button(Pressed),
    /// A function of a stick or trigger, first or second.
    Axis(Steered, bool),
}

/// Least deflection that assigns a stick or trigger.
const FAR: f64 = 0.7;

/// The panel of the pad.
#[derive(Debug, Default)]
pub struct PadPanel {
    learning: Learning,
}

impl Panel for PadPanel {
    fn ui(&mut self, ui: &mut Ui, shared: &mut Shared) {
        self.learn(shared);
        ScrollArea::both().auto_shrink(false).show(ui, |ui| {
            // Only the tables can be wider than the panel.
            ui.set_max_width(ui.clip_rect().width() - 16.0);
            head(ui, shared);
            zones(ui, shared);
            widgets::caption(ui, "Sticks and triggers");
            self.axes(ui, shared);
            widgets::caption(ui, "Buttons");
            self.buttons(ui, shared);
        });
        // The values change without events of the window.
        if shared.pilot.pad_name().is_some() || self.learning != Learning::Nothing {
            ui.ctx().request_repaint_after(std::time::Duration::from_millis(33));
        }
    }
}

impl PadPanel {
    /// Assigns the pressed button or moved stick to the waiting function.
    fn learn(&mut self, shared: &mut Shared) {
        match self.learning {
            Learning::Nothing => {
                shared.pilot.take_pressed();
            }
            Learning::Button(does) => {
                if let Some(button) = shared.pilot.take_pressed() {
                    shared.pilot.mapping.bind_button(button, does);
                    self.learning = Learning::Nothing;
                }
            }
            Learning::Axis(steers, second) => {
                let moved =
                    PadAxis::ALL.iter().copied().find(|axis| shared.pilot.axis(*axis).abs() > FAR);
                if let Some(axis) = moved {
                    let inverted = shared.pilot.axis(axis) < 0.0;
                    shared.pilot.mapping.bind_axis(AxisUse { axis, second, steers, inverted });
                    self.learning = Learning::Nothing;
                }
            }
        }
    }

    fn axes(&mut self, ui: &mut Ui, shared: &mut Shared) {
        let faint = Theme::palette_of(ui).faint;
        Grid::new("pad-axes").num_columns(5).striped(true).spacing([12.0, 3.0]).show(ui, |ui| {
            for head in ["", "", "", "while the second-function button is held", ""] {
                ui.label(RichText::new(head).small().color(faint));
            }
            ui.end_row();
            for steers in Steered::ALL.iter().copied() {
                ui.label(steers.words());
                let first = shared
                    .pilot
                    .mapping
                    .axes
                    .iter()
                    .find(|uses| uses.steers == steers && !uses.second)
                    .copied();
                bar(
                    ui,
                    first.map_or(0.0, |uses| {
                        shared.pilot.mapping.shaped(uses.axis, shared.pilot.axis(uses.axis))
                            * if uses.inverted { -1.0 } else { 1.0 }
                    }),
                );
                for second in [false, true] {
                    self.axis_cell(ui, shared, steers, second);
                }
                ui.end_row();
            }
        });
    }

    fn axis_cell(&mut self, ui: &mut Ui, shared: &mut Shared, steers: Steered, second: bool) {
        ui.horizontal(|ui| {
            let uses = shared
                .pilot
                .mapping
                .axes
                .iter_mut()
                .find(|uses| uses.steers == steers && uses.second == second);
            let learning = self.learning == Learning::Axis(steers, second);
            let text = match &uses {
                _ if learning => "move it all the way …".to_owned(),
                Some(uses) => {
                    format!(
                        "{}{}",
                        uses.axis.words(),
                        if uses.inverted { ", inverted" } else { "" }
                    )
                }
                None => "–".to_owned(),
            };
            if ui
                .selectable_label(learning, text)
                .on_hover_text("Click, then move a stick or trigger to assign it")
                .clicked()
            {
                self.learning =
                    if learning { Learning::Nothing } else { Learning::Axis(steers, second) };
            }
            if let Some(uses) = uses
                && ui.small_button("±").on_hover_text("Invert").clicked()
            {
                uses.inverted = !uses.inverted;
            }
        });
    }

    fn buttons(&mut self, ui: &mut Ui, shared: &mut Shared) {
        Grid::new("pad-buttons").num_columns(2).striped(true).spacing([12.0, 3.0]).show(ui, |ui| {
            for does in Pressed::ALL.iter().copied() {
                ui.label(does.words());
                let button = shared
                    .pilot
                    .mapping
                    .buttons
                    .iter()
                    .find(|(_, done)| *done == does)
                    .map(|(button, _)| *button);
                let learning = self.learning == Learning::Button(does);
                let text = match button {
                    _ if learning => "press it …",
                    Some(button) => button.words(),
                    None => "–",
                };
                if ui
                    .selectable_label(learning, text)
                    .on_hover_text("Click, then press a button to assign it")
                    .clicked()
                {
                    shared.pilot.take_pressed();
                    self.learning =
                        if learning { Learning::Nothing } else { Learning::Button(does) };
                }
                ui.end_row();
            }
        });
    }
}

fn head(ui: &mut Ui, shared: &mut Shared) {
    let palette = Theme::palette_of(ui);
    ui.horizontal_wrapped(|ui| {
        let (text, colour) = match (shared.pilot.hands(), shared.pilot.pad_name()) {
            (Hands::Holding | Hands::Gliding, _) => {
                ("the pad is disconnected".to_owned(), palette.warning)
            }
            (Hands::On, Some(name)) => (name.to_owned(), palette.good),
            (Hands::On, None) => {
                ("no pad found; the keyboard steers too (F1)".to_owned(), palette.faint)
            }
        };
        ui.label(RichText::new(text).color(colour));
        ui.end_row();
        ui.label(RichText::new("Preset").color(palette.faint));
        for (name, preset) in Mapping::presets() {
            let same = shared.pilot.mapping.axes == preset.axes
                && shared.pilot.mapping.buttons == preset.buttons;
            if ui.selectable_label(same, name).clicked() {
                let own = &shared.pilot.mapping;
                let (dead_zone, trigger_dead_zone, curve, rumble) =
                    (own.dead_zone, own.trigger_dead_zone, own.curve, own.rumble);
                shared.pilot.mapping =
                    Mapping { dead_zone, trigger_dead_zone, curve, rumble, ..preset };
            }
        }
        ui.checkbox(&mut shared.pilot.invert_pitch, "Invert pitch: push for nose down");
    });
}

fn zones(ui: &mut Ui, shared: &mut Shared) {
    let mapping = &mut shared.pilot.mapping;
    // Name and value are laid out first.
    ui.spacing_mut().slider_width = (ui.available_width() - 190.0).clamp(40.0, 160.0);
    let mut tried = false;
    Grid::new("pad-zones").num_columns(2).spacing([10.0, 3.0]).show(ui, |ui| {
        row(
            ui,
            "Dead zone, sticks",
            "Deflection of a stick that is ignored, as a share",
            &mut mapping.dead_zone,
            0.0..=0.5,
        );
        ui.end_row();
        row(
            ui,
            "Dead zone, triggers",
            "Deflection of a trigger that is ignored, as a share",
            &mut mapping.trigger_dead_zone,
            0.0..=0.5,
        );
        ui.end_row();
        row(
            ui,
            "Curve",
            "1 is linear; above 1, sticks are less sensitive near the middle",
            &mut mapping.curve,
            1.0..=3.0,
        );
        ui.end_row();
        row(
            ui,
            "Rumble",
            "Strength of the vibration; 0 switches it off",
            &mut mapping.rumble,
            0.0..=1.0,
        );
        ui.end_row();
        ui.label("");
        tried = ui.button("Try the rumble").clicked();
        ui.end_row();
    });
    if tried {
        shared.pilot.rumble(1.0, 0.3);
    }
}

/// Draws a label and a slider with four decimals, which does not round a value before it is moved.
fn row(ui: &mut Ui, name: &str, help: &str, value: &mut f64, range: RangeInclusive<f64>) {
    ui.label(name).on_hover_text(help);
    ui.add(Slider::new(value, range).clamping(SliderClamping::Edits).max_decimals(4))
        .on_hover_text(help);
}

/// Draws a bar for a value from -1 to 1.
fn bar(ui: &mut Ui, value: f64) {
    let palette = Theme::palette_of(ui);
    let (rect, _) = ui.allocate_exact_size(vec2(56.0, 12.0), Sense::hover());
    ui.painter().rect_filled(rect, 2.0, palette.field);
    let middle = rect.center().x;
    let end = middle + value.clamp(-1.0, 1.0) as f32 * rect.width() / 2.0;
    ui.painter().rect_filled(
        rect.with_min_x(middle.min(end)).with_max_x(middle.max(end)),
        2.0,
        palette.accent,
    );
    ui.painter().vline(middle, rect.y_range(), egui::Stroke::new(1.0, palette.line));
}
