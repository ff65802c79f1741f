//! The key of a plot, in a row with its title: what each curve is, with its peak; a click takes one away or brings it back.

use std::collections::BTreeSet;

use egui::{
    Color32, FontId, Rect, RichText, ScrollArea, Sense, Shape, Stroke, Ui, WidgetInfo, WidgetType,
    vec2,
};
use endline_session::export::chart::{Chart, Curve, Kind, Style};

use crate::gui::theme::Theme;

/// The key takes as many rows as it needs up to this share of the plot's height.
const SHARE: f32 = 0.3;

/// Width of a letter, more or less [points].
const LETTER: f32 = 6.5;

/// Length of the piece of line [points].
const SAMPLE: f32 = 14.0;

/// Between it and the name [points].
const GAP: f32 = 6.0;

/// Size of the names, and height of a row [points].
const SIZE: f32 = 12.0;
const HEIGHT: f32 = 18.0;

/// Draws title and key of a plot of a height; answers the name of the curve that was clicked.
pub(super) fn show(
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
    // A long key must not push its plot away: it is moved along in one row.
    ScrollArea::horizontal()
        .id_salt(("key", chart.kind.name()))
        .auto_shrink([false, true])
        .show(ui, |ui| ui.horizontal(all).inner)
        .inner
}

/// A piece of the curve's line, then its name; never on two rows.
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
    let help = if hidden { "Click to show it" } else { "Click to take it away" };
    response.on_hover_text(help).clicked().then(|| curve.name.clone())
}

/// The greatest value of a tension or a force, with its unit, and its time.
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
