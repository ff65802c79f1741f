//! Delivered strength of a line or weak link: its mean, and on hover the budget of factors.

use egui::{Color32, CornerRadius, Grid, Rect, RichText, Sense, Ui, pos2, vec2};
use endline_session::settled::{PartStrength, Sourced};
use endline_session::statics::RigAtRest;
use endline_session::units::Units;

use crate::gui::theme::Theme;

/// Width of the longest bar and height of a bar [points].
const BAR: [f32; 2] = [150.0, 12.0];
/// Width of the source of a factor [points].
const SOURCE_WIDTH: f32 = 360.0;

/// Strength budget of a part, by its id.
pub(super) fn of<'a>(rest: &'a RigAtRest, part: &str) -> Option<&'a PartStrength> {
    rest.shape.strengths.iter().find(|strength| strength.part == part)
}

/// Draws the mean delivered strength with its budget on hover, or the rating of a part without a budget.
pub(super) fn cell(ui: &mut Ui, strength: Option<&PartStrength>, rating_n: f64, units: Units) {
    let Some(strength) = strength else {
        ui.label(units.force().text(rating_n)).on_hover_text("As rated here, without variation");
        return;
    };
    let spread = 100.0 * strength.variation.as_ref().map_or(0.0, |variation| variation.value);
    let text = format!("{}  ± {spread:.0} %", units.force().text(strength.delivered_N));
    ui.label(text).on_hover_ui(|ui| budget(ui, strength, units));
}

/// A row of the budget, with the strength that remains after it.
struct Step<'a> {
    name: String,
    left_n: f64,
    figure: &'a Sourced,
}

/// Draws the budget from stated to delivered strength; each factor has bar, figure and source.
fn budget(ui: &mut Ui, strength: &PartStrength, units: Units) {
    let palette = Theme::palette_of(ui);
    ui.label(RichText::new(format!("{}, {}", strength.part, strength.item)).strong());
    let steps = steps(strength, units);
    let most_n = steps.iter().map(|step| step.left_n).fold(0.0, f64::max);
    Grid::new(("budget", &strength.part)).num_columns(4).spacing([10.0, 4.0]).show(ui, |ui| {
        for (index, step) in steps.iter().enumerate() {
            let last = index + 1 == steps.len();
            ui.label(&step.name);
            bar(ui, step.left_n / most_n, if last { palette.good } else { palette.accent });
            ui.label(units.force().text(step.left_n));
            ui.allocate_ui(vec2(SOURCE_WIDTH, 0.0), |ui| {
                let source = format!("{}; {}", step.figure.confidence, step.figure.source);
                ui.add(egui::Label::new(RichText::new(source).small().color(palette.faint)).wrap());
            });
            ui.end_row();
        }
    });
    if let Some(variation) = &strength.variation {
        let [least, most] = strength.nine_of_ten_N.map(|force_n| units.force().text(force_n));
        let share = 100.0 * variation.value;
        ui.label(format!(
            "Pieces vary by {share:.0} %: 90 % hold {least} to {most}; this gear has {}.",
            units.force().text(strength.drawn_N)
        ));
    }
    ui.label(format!("Confidence of its least certain factor: {}.", strength.confidence));
}

/// Stated strength, and what remains after each factor.
fn steps(strength: &PartStrength, units: Units) -> Vec<Step<'_>> {
    let mut left_n = strength.stated.value;
    let stated = Step {
        name: format!("stated, {}", units.force().text(left_n)),
        left_n,
        figure: &strength.stated,
    };
    let factors = strength.factors.iter().map(|factor| {
        left_n *= factor.figure.value;
        let name = format!("× {:.2}  {}", factor.figure.value, factor.name);
        Step { name, left_n, figure: &factor.figure }
    });
    std::iter::once(stated).chain(factors).collect()
}

fn bar(ui: &mut Ui, share: f64, color: Color32) {
    let (rect, _) = ui.allocate_exact_size(vec2(BAR[0], BAR[1]), Sense::hover());
    let end = rect.left() + rect.width() * share.clamp(0.0, 1.0) as f32;
    let filled = Rect::from_min_max(rect.min, pos2(end, rect.max.y));
    ui.painter().rect_filled(filled, CornerRadius::same(2), color);
}
