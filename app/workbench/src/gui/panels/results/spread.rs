//! Distribution of the greatest tensions: a curve for each option and a dot for each run; a click on a dot replays the run.

use std::sync::Arc;

use egui::{Color32, RichText, Ui};
use egui_plot::{
    AxisHints, GridMark, Legend, Line, LineStyle, MarkerShape, Plot, PlotPoint, PlotPoints, PlotUi,
    Points,
};
use endline_session::scales::SERIES;
use endline_session::study::StudyResults;
use endline_session::units::ForceUnit;

use super::ResultsPanel;
use crate::gui::shared::Shared;
use crate::gui::theme::{Palette, Theme};
use crate::gui::widgets;
use crate::gui::widgets::plot::{with_ticks, y_axis};

/// Greatest distance of a click to its dot [points].
const REACH: f32 = 14.0;

/// Dots, with the results and units they were made for.
#[derive(Clone)]
pub(super) struct Placed {
    shown: Arc<StudyResults>,
    unit: ForceUnit,
    dots: Arc<Vec<Dot>>,
}

/// A run as a dot.
struct Dot {
    option: usize,
    encounter: u32,
    tension_n: f64,
    outcome: String,
    /// Logarithm of the tension plus one in the unit shown, and the share of runs below.
    at: [f64; 2],
}

/// Draws the distribution of greatest tensions.
pub(super) fn show(
    ui: &mut Ui,
    panel: &mut ResultsPanel,
    shared: &mut Shared,
    shown: &Arc<StudyResults>,
) {
    let unit = shared.workbench.preferences().units.force();
    let dots = placed(panel, shown, unit);
    if dots.is_empty() {
        return widgets::nothing(ui, "No run has a tension yet.");
    }
    ui.label(
        RichText::new("Share of runs with a greatest tension below a value. Each dot is a run; click it to replay the run.")
            .color(Theme::palette_of(ui).faint),
    );
    let response =
        frame(unit, Theme::palette_of(ui)).height(ui.available_height()).show(ui, |plot| {
            for (index, option) in shown.findings.options.iter().enumerate() {
                let own = dots.iter().filter(|dot| dot.option == index);
                curve(plot, index, &option.name, own.map(|dot| dot.at.into()).collect());
            }
        });
    let Some(at) = response.response.hover_pos() else { return };
    let distance = |dot: &&Dot| response.transform.position_from_point(&dot.at.into()).distance(at);
    let nearest = dots.iter().min_by(|one, other| distance(one).total_cmp(&distance(other)));
    let Some(nearest) = nearest.filter(|dot| distance(dot) < REACH) else { return };
    let text = format!(
        "{}, encounter {}: {}, {}\nClick to replay it in the 3-D view",
        shown.findings.options[nearest.option].name,
        nearest.encounter,
        unit.text(nearest.tension_n),
        nearest.outcome.replace('_', " ")
    );
    if response.response.clicked() {
        panel.replay(shared, shown, (nearest.option, nearest.encounter));
    }
    response.response.on_hover_text_at_pointer(text);
}

/// Axes: tension on a logarithmic scale, and share of runs.
fn frame(unit: ForceUnit, palette: Palette) -> Plot<'static> {
    let x = AxisHints::new_x()
        .label(format!("greatest tension [{}]", unit.symbol()))
        .formatter(move |mark, _| format!("{:.0}", 10.0_f64.powf(mark.value) - 1.0));
    let y = y_axis(String::new())
        .formatter(|mark, _| format!("{:.0} %", 100.0 * mark.value))
        .min_thickness(46.0);
    with_ticks(Plot::new("tensions of runs"), palette)
        // The curves rise to the right, so the lower right is free.
        .legend(Legend::default().position(egui_plot::Corner::RightBottom).background_alpha(0.6))
        .x_grid_spacer(|input| marks(input.bounds))
        .include_x(0.0)
        .include_y(0.0)
        .include_y(1.0)
        .custom_x_axes(vec![x])
        .custom_y_axes(vec![y])
        .allow_scroll(false)
        .show_background(false)
}

/// Grid marks of the tension axis: 0, then 1 and 3 times powers of ten.
fn marks((least, most): (f64, f64)) -> Vec<GridMark> {
    let round = (0..8).flat_map(|power| [1.0, 3.0].map(|lead| lead * 10.0_f64.powi(power)));
    let places = std::iter::once(0.0).chain(round).map(|tension| (1.0 + tension).log10());
    let within = places.filter(|place| (least..=most).contains(place));
    within.map(|value| GridMark { value, step_size: 0.5 }).collect()
}

/// Draws the runs of an option: a line, and a mark for each run.
fn curve(plot: &mut PlotUi<'_>, index: usize, name: &str, points: Vec<PlotPoint>) {
    let [red, green, blue] = SERIES[index % SERIES.len()];
    let colour = Color32::from_rgb(red, green, blue);
    let line = Line::new(name, PlotPoints::Owned(points.clone()));
    // Colours repeat after seven options; line styles differ.
    let style = if index < SERIES.len() { LineStyle::Solid } else { LineStyle::dashed_dense() };
    plot.line(line.color(colour).width(1.3).style(style));
    let shapes = [MarkerShape::Circle, MarkerShape::Square, MarkerShape::Diamond, MarkerShape::Up];
    let marks = Points::new(name, PlotPoints::Owned(points)).color(colour).radius(2.6);
    plot.points(marks.shape(shapes[index % shapes.len()]).allow_hover(false));
}

/// Dots, made again if the results or the unit have changed.
fn placed(panel: &mut ResultsPanel, shown: &Arc<StudyResults>, unit: ForceUnit) -> Arc<Vec<Dot>> {
    let same = |placed: &&Placed| Arc::ptr_eq(&placed.shown, shown) && placed.unit == unit;
    if let Some(placed) = panel.placed.as_ref().filter(same) {
        return Arc::clone(&placed.dots);
    }
    let dots = Arc::new(dots(shown, unit));
    panel.placed = Some(Placed { shown: Arc::clone(shown), unit, dots: Arc::clone(&dots) });
    dots
}

/// All valid runs, by option and ascending tension.
fn dots(shown: &StudyResults, unit: ForceUnit) -> Vec<Dot> {
    let mut all = Vec::new();
    for (index, option) in shown.findings.options.iter().enumerate() {
        let mut dots: Vec<Dot> = shown
            .runs
            .valid_of(&option.id)
            .filter_map(|run| {
                let (encounter, tension_n) =
                    (u32::try_from(run.encounter).ok()?, run.peak_tension_n?);
                let x = (1.0 + unit.of_newtons(tension_n).max(0.0)).log10();
                Some(Dot {
                    option: index,
                    encounter,
                    tension_n,
                    outcome: run.outcome.clone(),
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn marks_stand_at_round_tensions() {
        let tensions = |marks: Vec<GridMark>| -> Vec<f64> {
            marks.iter().map(|mark| (10.0_f64.powf(mark.value) - 1.0).round()).collect()
        };
        assert_eq!(tensions(marks((0.0, 2.01))), [0.0, 1.0, 3.0, 10.0, 30.0, 100.0]);
        assert_eq!(tensions(marks((1.4, 3.5))), [30.0, 100.0, 300.0, 1000.0, 3000.0]);
    }
}
