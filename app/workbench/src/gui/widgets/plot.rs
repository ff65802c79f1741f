//! Charts of a run, each below its title and key, with a common cursor. A click on a chart shows that moment; a click on an entry of the
//! key hides or shows a curve.

use std::collections::BTreeSet;
use std::sync::Arc;

use egui::{
    Color32, FontId, Id, Rangef, Rect, RichText, ScrollArea, Sense, Shape, Stroke, Ui, WidgetInfo,
    WidgetType, vec2,
};
use egui_plot::{
    AxisHints, FilledArea, GridInput, GridMark, HLine, Line, LineStyle, Plot, PlotPoint,
    PlotPoints, PlotUi, Polygon, VLine,
};
use endline_session::command::TimeAction;
use endline_session::export::chart::{Chart, Curve, Kind, Style};
use endline_session::live::LiveView;
use endline_session::scales::{decimals, ticks};
use endline_session::units::Units;
use endline_sim::Model;

use crate::gui::shared::Shared;
use crate::gui::theme::{Palette, Theme};
use crate::gui::widgets;

/// A strength above the peak by more than this factor is not drawn.
const REACH: f64 = 3.0;

/// Height of the title and key of a plot, if they fit in one row [points].
pub const HEAD: f32 = 34.0;

/// Least height of a plot [points].
pub const LEAST: f32 = 104.0;

/// Charts with their points, reused until the run changes, and the names of hidden curves.
#[derive(Default)]
pub struct DrawnCharts {
    /// Names of curves that a click in the key has hidden.
    hidden: BTreeSet<String>,
    made: Vec<(Kind, Made)>,
}

/// A chart with the data it was made from.
struct Made {
    of: (Part, Option<Part>),
    units: Units,
    chart: Chart,
    /// Points of each curve, for drawing.
    points: Vec<Vec<PlotPoint>>,
}

/// The part of a run that a chart shows.
struct Part {
    model: Arc<Model>,
    samples: usize,
    shown_s: f64,
}

impl Part {
    fn of(kind: Kind, view: &LiveView) -> Self {
        let shown_s = if kind.over_time() { 0.0 } else { view.frame.time_s };
        Self { model: Arc::clone(&view.model), samples: view.tension.len(), shown_s }
    }
}

impl PartialEq for Part {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.model, &other.model)
            && self.samples == other.samples
            && self.shown_s.to_bits() == other.shown_s.to_bits()
    }
}

/// Makes a chart of a run, together with the run it is compared with.
pub fn chart(kind: Kind, view: &LiveView, other: Option<&LiveView>, units: Units) -> Chart {
    let own = Chart::of(kind, view, units);
    match other {
        Some(other) => own.beside(Chart::of(kind, other, units)),
        None => own,
    }
}

impl DrawnCharts {
    /// Draws a chart of the run shown, with title and key, in a height.
    pub fn show(&mut self, ui: &mut Ui, shared: &mut Shared, kind: Kind, title: &str, height: f32) {
        let Some(view) = shared.workbench.view().cloned() else {
            return widgets::nothing(ui, "No run yet.");
        };
        let (place, top) = (self.make(kind, &view, shared), ui.cursor().top());
        let made = &self.made[place].1;
        let chart = &made.chart;
        let clicked = key(ui, title, height, chart, &self.hidden);
        let height = (height + HEAD - (ui.cursor().top() - top)).max(LEAST);
        if chart.curves.iter().all(|curve| curve.points.is_empty()) {
            return widgets::nothing(ui, why_empty(kind));
        }
        let palette = Theme::palette_of(ui);
        let response = frame(chart, height, palette).show(ui, |plot| {
            self.draw(plot, made, &view, palette);
            plot.pointer_coordinate()
        });
        let at = response.inner.filter(|_| kind.over_time() && response.response.clicked());
        shared
            .commands
            .extend(at.map(|at| TimeAction::Seek(at.x.clamp(0.0, view.newest_s)).into()));
        if let Some(name) = clicked
            && !self.hidden.remove(&name)
        {
            self.hidden.insert(name);
        }
    }

    /// Updates a chart if the run has advanced since; returns its index.
    fn make(&mut self, kind: Kind, view: &LiveView, shared: &Shared) -> usize {
        let (other, units) =
            (shared.workbench.compared_view(), shared.workbench.preferences().units);
        let of = (Part::of(kind, view), other.as_deref().map(|other| Part::of(kind, other)));
        let place = self.made.iter().position(|(known, _)| *known == kind);
        let known = place
            .is_some_and(|place| self.made[place].1.of == of && self.made[place].1.units == units);
        if !known {
            let chart = chart(kind, view, other.as_deref(), units);
            let drawn =
                |curve: &Curve| curve.points.iter().map(|at| PlotPoint::from(*at)).collect();
            let points = chart.curves.iter().map(drawn).collect();
            let made = (kind, Made { of, units, chart, points });
            match place {
                Some(place) => self.made[place] = made,
                None => self.made.push(made),
            }
        }
        place.unwrap_or(self.made.len() - 1)
    }

    fn draw<'a>(&self, plot: &mut PlotUi<'a>, made: &'a Made, view: &LiveView, palette: Palette) {
        let chart = &made.chart;
        let curves = chart.curves.iter().zip(&made.points);
        let shown: Vec<(&Curve, &Vec<PlotPoint>)> =
            curves.filter(|(curve, _)| !self.hidden.contains(chart.line_of(curve))).collect();
        shade(plot, &shown.iter().map(|(curve, _)| *curve).collect::<Vec<_>>());
        shown.into_iter().for_each(|(curve, points)| plot.line(line(curve, points)));
        levels(plot, chart, palette);
        if chart.kind.over_time() {
            let now = VLine::new("", view.frame.time_s);
            plot.vline(now.color(palette.faint.gamma_multiply(0.7)).width(1.0));
        }
    }
}

fn why_empty(kind: Kind) -> &'static str {
    match kind {
        Kind::Force | Kind::Wraps => "No rope has touched the whale.",
        Kind::Tension | Kind::Along | Kind::Depth | Kind::Speed => "Nothing yet.",
    }
}

/// Distance of two lines of a grid at which they begin to be visible, and at which they have their full colour [points].
const GRID: Rangef = Rangef { min: 14.0, max: 220.0 };

/// Fewest values that an axis names.
const FEWEST: usize = 3;

/// Wanted distance of two values along the horizontal and the vertical axis [points].
const TICK_DISTANCE: [f64; 2] = [80.0, 36.0];

/// A horizontal axis whose values are written with the decimals that distinguish them.
pub fn x_axis<'a>(label: String) -> AxisHints<'a> {
    axis(AxisHints::new_x(), label).label_spacing(Rangef::new(16.0, 32.0))
}

/// A vertical axis whose values are written with the decimals that distinguish them.
pub fn y_axis<'a>(label: String) -> AxisHints<'a> {
    axis(AxisHints::new_y(), label).label_spacing(Rangef::new(8.0, 14.0))
}

fn axis<'a>(hints: AxisHints<'a>, label: String) -> AxisHints<'a> {
    hints
        .label(label)
        .tick_label_font(FontId::proportional(11.0))
        .formatter(|mark, _| written(mark))
}

fn written(mark: GridMark) -> String {
    format!("{:.*}", decimals(mark.step_size), mark.value)
}

/// A plot with round values on both axes, at least three on each.
pub fn with_ticks<'a>(plot: Plot<'a>, palette: Palette) -> Plot<'a> {
    plot.grid_spacing(GRID)
        .grid_color(palette.faint.gamma_multiply(0.5))
        .x_grid_spacer(|input| marks(&input, TICK_DISTANCE[0]))
        .y_grid_spacer(|input| marks(&input, TICK_DISTANCE[1]))
}

/// Round values between the bounds of an axis, about as far apart as wanted [points].
fn marks(input: &GridInput, wanted: f64) -> Vec<GridMark> {
    let (least, most) = input.bounds;
    let length = (most - least) / input.base_step_size * f64::from(GRID.min);
    // Smaller steps than these do not fit on any screen.
    let counts = (length / wanted).clamp(FEWEST as f64, 20.0) as u32..40;
    let values = counts
        .map(|count| ticks(least, most, count))
        .find(|values| values.len() >= FEWEST)
        .unwrap_or_default();
    let [first, second, ..] = values[..] else { return Vec::new() };
    let step_size = second - first;
    values.into_iter().map(|value| GridMark { value, step_size }).collect()
}

/// Axes and grid of a chart.
fn frame<'a>(chart: &Chart, height: f32, palette: Palette) -> Plot<'a> {
    let (x, y) = (x_axis(chart.x.clone()), y_axis(chart.y.clone()).min_thickness(46.0));
    let plot = with_ticks(Plot::new(("plot", chart.kind.name())), palette)
        .height(height)
        .include_x(0.0)
        .include_x(chart.end_x)
        .include_y(0.0)
        .include_y(1.1 * top(chart))
        .custom_x_axes(vec![x])
        .custom_y_axes(vec![y])
        .allow_scroll(false)
        .show_background(false);
    if chart.kind.over_time() {
        let time = Id::new("time");
        plot.link_cursor(time, [true, false]).link_axis(time, [true, false])
    } else {
        plot
    }
}

/// Greatest value of a chart, above zero.
fn top(chart: &Chart) -> f64 {
    chart.top().max(1e-6)
}

fn colour(curve: &Curve) -> Color32 {
    let [red, green, blue] = curve.rgb();
    Color32::from_rgb(red, green, blue)
}

fn line<'a>(curve: &'a Curve, points: &'a [PlotPoint]) -> Line<'a> {
    // egui_plot shows the name near the pointer; an edge has none.
    let name = if curve.style == Style::Edge { "" } else { &curve.name };
    let line = Line::new(name, PlotPoints::Borrowed(points)).color(colour(curve)).width(1.5);
    match curve.style {
        Style::Solid => line,
        Style::Dashed => line.style(LineStyle::dashed_dense()),
        Style::Edge => line.color(colour(curve).gamma_multiply(0.55)).width(1.0),
    }
}

/// Draws strengths and ratings near the peak: a line, and a band if there is a least and a greatest value.
fn levels(plot: &mut PlotUi<'_>, chart: &Chart, palette: Palette) {
    let top = top(chart);
    for level in chart.levels.iter().filter(|level| level.band[0] < REACH * top) {
        let [low, high] = level.band;
        if high > low {
            let corners = [[0.0, low], [chart.end_x, low], [chart.end_x, high], [0.0, high]];
            let points: Vec<PlotPoint> = corners.map(PlotPoint::from).to_vec();
            let band = Polygon::new(&level.name, PlotPoints::Owned(points))
                .fill_color(palette.error.gamma_multiply(0.12));
            plot.polygon(band.stroke(Stroke::NONE).allow_hover(false));
        }
        let line = HLine::new(&level.name, low).color(palette.error).width(1.0);
        plot.hline(line.style(LineStyle::dashed_loose()));
    }
}

/// Fills the area between the curves of least and greatest, which follow each other in the list.
fn shade(plot: &mut PlotUi<'_>, curves: &[&Curve]) {
    for pair in curves.windows(2) {
        let [least, greatest] = pair else { continue };
        let edges = least.style == Style::Edge
            && greatest.style == Style::Edge
            && least.colour == greatest.colour;
        if edges && least.points.len() == greatest.points.len() && least.points.len() > 1 {
            let xs: Vec<f64> = least.points.iter().map(|[x, _]| *x).collect();
            let [low, high] = [least, greatest]
                .map(|curve| curve.points.iter().map(|[_, y]| *y).collect::<Vec<f64>>());
            let fill = colour(least).gamma_multiply(0.16);
            plot.add(FilledArea::new("", &xs, &low, &high).fill_color(fill).allow_hover(false));
        }
    }
}

/// Greatest share of a plot's height for a key with several rows.
const SHARE: f32 = 0.3;

/// Approximate width of a letter [points].
const LETTER: f32 = 6.5;

/// Length of the sample line of an entry [points].
const SAMPLE: f32 = 14.0;

/// Gap between sample line and name [points].
const GAP: f32 = 6.0;

/// Size of the names, and height of a row [points].
const SIZE: f32 = 12.0;
const HEIGHT: f32 = 18.0;

/// Draws title and key of a plot; returns the name of the curve that was clicked.
fn key(
    ui: &mut Ui,
    title: &str,
    height: f32,
    chart: &Chart,
    hidden: &BTreeSet<String>,
) -> Option<String> {
    let faint = Theme::palette_of(ui).faint;
    let named: Vec<&Curve> =
        chart.curves.iter().filter(|curve| curve.style != Style::Edge).collect();
    let all = |ui: &mut Ui| {
        ui.spacing_mut().item_spacing.y = 2.0;
        if !title.is_empty() {
            ui.label(RichText::new(title).color(faint));
        }
        named
            .iter()
            .filter_map(|curve| entry(ui, chart, curve, hidden.contains(&curve.name)))
            .last()
    };
    let letters: usize =
        named.iter().map(|curve| curve.name.len() + peak(chart, curve).len() + 5).sum::<usize>()
            + title.len();
    let rows = (letters as f32 * LETTER / ui.available_width()).ceil();
    if rows * HEIGHT <= SHARE * height {
        return ui
            .scope(|ui| {
                ui.spacing_mut().interact_size.y = HEIGHT;
                ui.horizontal_wrapped(all).inner
            })
            .inner;
    }
    // A long key would leave no room for its plot: it scrolls in one row.
    ScrollArea::horizontal()
        .id_salt(("key", chart.kind.name()))
        .auto_shrink([false, true])
        .show(ui, |ui| ui.horizontal(all).inner)
        .inner
}

/// Draws an entry of the key: a sample of the line and the name, never split across rows.
fn entry(ui: &mut Ui, chart: &Chart, curve: &Curve, hidden: bool) -> Option<String> {
    let palette = Theme::palette_of(ui);
    let text = format!("{}{}", curve.name, peak(chart, curve));
    let galley = ui.painter().layout_no_wrap(
        text.clone(),
        FontId::proportional(SIZE),
        if hidden { palette.faint } else { palette.text },
    );
    let (rect, response) =
        ui.allocate_exact_size(vec2(SAMPLE + GAP + galley.size().x, HEIGHT), Sense::click());
    response.widget_info(|| WidgetInfo::selected(WidgetType::Checkbox, true, !hidden, &text));
    let [red, green, blue] = curve.rgb();
    let stroke = Stroke::new(
        2.5,
        Color32::from_rgb(red, green, blue).gamma_multiply(if hidden { 0.35 } else { 1.0 }),
    );
    let ends = [rect.left_center(), rect.left_center() + vec2(SAMPLE, 0.0)];
    match curve.style {
        Style::Dashed => ui.painter().extend(Shape::dashed_line(&ends, stroke, 4.0, 3.0)),
        _ => {
            ui.painter().line_segment(ends, stroke);
        }
    }
    let words = Rect::from_min_size(
        rect.left_center() + vec2(SAMPLE + GAP, -galley.size().y / 2.0),
        galley.size(),
    );
    ui.painter().galley(words.min, galley, palette.text);
    if hidden {
        ui.painter().hline(words.x_range(), words.center().y, Stroke::new(1.0, palette.faint));
    }
    let help = if hidden { "Click to show it" } else { "Click to hide it" };
    response.on_hover_text(help).clicked().then(|| curve.name.clone())
}

/// Peak of a tension or force, with its unit and time; empty for other charts.
fn peak(chart: &Chart, curve: &Curve) -> String {
    if !matches!(chart.kind, Kind::Tension | Kind::Force) {
        return String::new();
    }
    let Some([top_x, top]) = curve.points.iter().max_by(|[_, a], [_, b]| a.total_cmp(b)) else {
        return String::new();
    };
    let value = if top.abs() < 100.0 { format!("{top:.1}") } else { format!("{top:.0}") };
    format!(" peak {value} {} at {top_x:.1} s", chart.y)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_axis_names_three_values_and_no_two_alike() {
        for most in [0.03, 0.7, 1.0, 3.3, 26.0, 47.0, 512.0, 7562.0] {
            for points in [70.0, 100.0, 400.0, 1500.0] {
                for least in [0.0, -0.05 * most, -1.3 * most] {
                    let base_step_size = (most - least) / points * f64::from(GRID.min);
                    let input = GridInput { bounds: (least, most), base_step_size };
                    let marks = marks(&input, TICK_DISTANCE[1]);
                    assert!(marks.len() >= FEWEST, "{most}, {points}: {marks:?}");
                    let apart = marks[0].step_size / (most - least) * points;
                    assert!(apart > 12.0, "{apart} points, {marks:?}");
                    let mut texts: Vec<String> = marks.into_iter().map(written).collect();
                    let count = texts.len();
                    texts.dedup();
                    assert_eq!(texts.len(), count, "{texts:?}");
                }
            }
        }
        let empty = GridInput { bounds: (0.0, 0.0), base_step_size: 1.0 };
        assert!(marks(&empty, TICK_DISTANCE[0]).is_empty());
    }
}
