//! Greatest tensions of all runs: a curve for each option, a dot for each run, and a click shows that run.

use std::sync::Arc;

use egui::{Color32, RichText, Ui};
use egui_plot::{AxisHints, Legend, Line, MarkerShape, Plot, PlotPoint, PlotPoints, Points};
use endline_session::units::ForceUnit;

use super::super::super::charts::COLOURS;
use super::super::super::desk::Desk;
use super::super::super::studies::Shown;
use super::super::super::theme::Theme;

/// Nearest a click must come to a dot [points].
const REACH: f32 = 14.0;

/// The dots last placed, with what they were placed for.
#[derive(Clone)]
pub struct Placed {
    shown: Arc<Shown>,
    unit: ForceUnit,
    dots: Arc<Vec<Dot>>,
}

/// A run as a dot.
struct Dot {
    option: usize,
    encounter: u32,
    tension_n: f64,
    outcome: String,
    /// Logarithm of one more than the tension in the unit shown, and the share of runs below.
    at: [f64; 2],
}

/// Draws the distribution of greatest tensions.
pub(super) fn show(ui: &mut Ui, desk: &mut Desk, shown: &Arc<Shown>) {
    let unit = desk.preferences.units.force();
    let dots = placed(desk, shown, unit);
    if dots.is_empty() {
        return super::super::nothing(ui, "No run has a tension yet.");
    }
    ui.label(
        RichText::new("Share of runs whose greatest tension stays below a value. Each dot is a run: click it to see it.")
            .color(Theme::palette_of(ui).faint),
    );
    let words = move |value: f64| {
        let tension = 10.0_f64.powf(value) - 1.0;
        format!("{tension:.*}", usize::from(tension < 10.0))
    };
    let response = Plot::new("tensions of runs")
        .height(ui.available_height())
        .legend(Legend::default().position(egui_plot::Corner::LeftTop).background_alpha(0.6))
        .include_x(0.0)
        .include_y(0.0)
        .include_y(1.0)
        .custom_x_axes(vec![
            AxisHints::new_x()
                .label(format!("greatest tension [{}]", unit.symbol()))
                .formatter(move |mark, _| words(mark.value)),
        ])
        .custom_y_axes(vec![
            AxisHints::new_y()
                .formatter(|mark, _| format!("{:.0} %", 100.0 * mark.value))
                .min_thickness(46.0),
        ])
        .allow_scroll(false)
        .show_background(false)
        .show(ui, |plot| {
            for (index, option) in shown.findings.options.iter().enumerate() {
                let [red, green, blue] = COLOURS[index % COLOURS.len()];
                let colour = Color32::from_rgb(red, green, blue);
                let points: Vec<PlotPoint> = dots
                    .iter()
                    .filter(|dot| dot.option == index)
                    .map(|dot| dot.at.into())
                    .collect();
                plot.line(
                    Line::new(&option.name, PlotPoints::Owned(points.clone()))
                        .color(colour)
                        .width(1.3),
                );
                let shapes = [
                    MarkerShape::Circle,
                    MarkerShape::Square,
                    MarkerShape::Diamond,
                    MarkerShape::Up,
                ];
                let marks =
                    Points::new(&option.name, PlotPoints::Owned(points)).color(colour).radius(2.6);
                plot.points(marks.shape(shapes[index % shapes.len()]).allow_hover(false));
            }
        });
    let Some(at) = response.response.hover_pos() else { return };
    let distance = |dot: &&Dot| response.transform.position_from_point(&dot.at.into()).distance(at);
    let Some(nearest) = dots
        .iter()
        .min_by(|one, other| distance(one).total_cmp(&distance(other)))
        .filter(|dot| distance(dot) < REACH)
    else {
        return;
    };
    let told = format!(
        "{}, encounter {}: {}, {}\nClick to see it in the 3-D view",
        shown.findings.options[nearest.option].name,
        nearest.encounter,
        unit.text(nearest.tension_n),
        nearest.outcome.replace('_', " ")
    );
    if response.response.clicked() {
        super::replay(desk, nearest.option, nearest.encounter);
    }
    response.response.on_hover_text_at_pointer(told);
}

/// The dots, placed anew where the results or the unit have changed.
fn placed(desk: &mut Desk, shown: &Arc<Shown>, unit: ForceUnit) -> Arc<Vec<Dot>> {
    let same = |placed: &&Placed| Arc::ptr_eq(&placed.shown, shown) && placed.unit == unit;
    if let Some(placed) = desk.studies.results.placed.as_ref().filter(same) {
        return Arc::clone(&placed.dots);
    }
    let dots = Arc::new(dots(shown, unit));
    desk.studies.results.placed =
        Some(Placed { shown: Arc::clone(shown), unit, dots: Arc::clone(&dots) });
    dots
}

/// Every run that counts, by option and rising tension.
fn dots(shown: &Shown, unit: ForceUnit) -> Vec<Dot> {
    let table = &shown.table;
    let (encounters, tensions) = (table.reals("encounter"), table.reals("peak_tension_N"));
    let (options, valid, outcomes) =
        (table.texts("option"), table.flags("valid"), table.texts("outcome"));
    let mut all = Vec::new();
    for (index, option) in shown.findings.options.iter().enumerate() {
        let own = (0..table.rows()).filter(|row| valid[*row] && options[*row] == option.id);
        let mut dots: Vec<Dot> = own
            .filter_map(|row| {
                let (encounter, tension_n) = (encounters[row]? as u32, tensions[row]?);
                let x = (1.0 + unit.of_newtons(tension_n).max(0.0)).log10();
                Some(Dot {
                    option: index,
                    encounter,
                    tension_n,
                    outcome: outcomes[row].clone(),
                    at: [x, 0.0],
                })
            })
            .collect();
        dots.sort_by(|one, other| one.tension_n.total_cmp(&other.tension_n));
        let count = dots.len().max(1) as f64;
        dots.iter_mut()
            .enumerate()
            .for_each(|(place, dot)| dot.at[1] = (place as f64 + 0.5) / count);
        all.extend(dots);
    }
    all
}
