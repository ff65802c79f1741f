//! Tension of every line over time, with the ratings of weak links and ropes.

use egui::{RichText, Ui};
use egui_plot::{AxisHints, HLine, Legend, Line, LineStyle, Plot, PlotPoints, VLine};
use endline_session::live::{LiveView, Series};

use super::super::desk::Desk;
use super::super::theme::Theme;
use super::super::units::ForceUnit;

/// Spans a line is drawn with at most: least and greatest of each, so that no peak is lost.
const SPANS: usize = 900;

/// Colours that stay apart for every colour vision (Okabe and Ito 2008, without yellow and black).
const COLOURS: [[u8; 3]; 6] =
    [[0x56, 0xb4, 0xe9], [0xe6, 0x9f, 0x00], [0x00, 0x9e, 0x73], [0xcc, 0x79, 0xa7], [0xd5, 0x5e, 0x00], [0x4f, 0x8f, 0xd0]];

/// Draws the plot.
pub fn show(ui: &mut Ui, desk: &mut Desk) {
    let Some(view) = desk.view.clone() else { return super::nothing(ui, "No run yet.") };
    let unit = &mut desk.preferences.force;
    ui.horizontal(|ui| {
        ui.label(RichText::new("Greatest tension of each line").color(Theme::palette_of(ui).faint));
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            for choice in [ForceUnit::Newton, ForceUnit::Lbf] {
                ui.selectable_value(unit, choice, choice.symbol());
            }
        });
    });
    plot(ui, &view, *unit);
}

fn plot(ui: &mut Ui, view: &LiveView, unit: ForceUnit) {
    let palette = Theme::palette_of(ui);
    let duration = view.model.spec.settings.duration_s;
    let plot = Plot::new("tension")
        .legend(Legend::default().position(egui_plot::Corner::RightTop).background_alpha(0.6))
        .include_x(0.0)
        .include_x(duration)
        .include_y(0.0)
        .include_y(unit.of_newtons(peak(view)) * 1.1)
        .custom_x_axes(vec![AxisHints::new_x().label("Time [s]").label_spacing(egui::Rangef::new(24.0, 48.0))])
        .custom_y_axes(vec![AxisHints::new_y().label(unit.symbol()).label_spacing(egui::Rangef::new(14.0, 26.0)).min_thickness(42.0)])
        .grid_spacing(egui::Rangef::new(14.0, 220.0))
        .allow_scroll(false)
        .show_background(false);
    plot.show(ui, |plot| {
        for (index, line) in view.model.spec.lines.iter().enumerate() {
            let [red, green, blue] = COLOURS[index % COLOURS.len()];
            let points = PlotPoints::from(polyline(&view.tension, index, unit));
            plot.line(Line::new(&line.id, points).color(egui::Color32::from_rgb(red, green, blue)).width(1.5));
        }
        for link in view.model.spec.links.iter().filter(|link| link.enabled && link.rating_n < 3.0 * peak(view)) {
            let rating = HLine::new(format!("{} rating", link.id), unit.of_newtons(link.rating_n));
            plot.hline(rating.color(palette.error).width(1.0).style(LineStyle::dashed_loose()));
        }
        plot.vline(VLine::new("", view.frame.time_s).color(palette.faint.gamma_multiply(0.7)).width(1.0));
    });
}

/// Greatest tension so far, at least a newton [N].
fn peak(view: &LiveView) -> f64 {
    let peaks = view.summary.iter().flat_map(|summary| &summary.lines).map(|line| line.peak_tension_n);
    peaks.fold(1.0, f64::max)
}

/// A line's tension as points: each span's least and greatest value, in the unit.
fn polyline(series: &Series, line: usize, unit: ForceUnit) -> Vec<[f64; 2]> {
    let spans = series.spans(line, SPANS);
    let ends = |span: &endline_session::live::Span| [[span.time_s, unit.of_newtons(span.min)], [span.time_s, unit.of_newtons(span.max)]];
    spans.iter().flat_map(ends).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_peak_of_one_sample_in_ten_thousand_is_drawn_at_its_height() {
        let mut series = Series::default();
        for step in 0..10_000_u32 {
            series.push(f64::from(step) * 0.01, vec![if step == 7321 { 1000.0 * crate::scene::N_PER_LBF } else { 100.0 }]);
        }
        let points = polyline(&series, 0, ForceUnit::Lbf);
        assert!(points.len() <= 2 * SPANS);
        let top = points.iter().map(|point| point[1]).fold(0.0, f64::max);
        assert!((top - 1000.0).abs() < 1e-6, "{top} lbf");
    }
}
