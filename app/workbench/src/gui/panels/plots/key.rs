//! The key of a plot, in a row with its title: what each curve is, with its peak; a click takes one away or brings it back.

use std::collections::BTreeSet;

use egui::{Button, Color32, RichText, ScrollArea, Sense, Shape, Stroke, Ui, vec2};

use super::super::super::charts::{Chart, Curve, Kind, Style};
use super::super::super::theme::Theme;

/// Draws title and key; answers the name of the curve that was clicked.
pub(super) fn show(ui: &mut Ui, title: &str, chart: &Chart, hidden: &BTreeSet<String>) -> Option<String> {
    let faint = Theme::palette_of(ui).faint;
    let row = ScrollArea::horizontal().id_salt(("key", chart.kind.name())).auto_shrink([false, true]);
    row.show(ui, |ui| {
        ui.horizontal(|ui| {
            ui.label(RichText::new(title).color(faint));
            let named = chart.curves.iter().filter(|curve| curve.style != Style::Edge);
            named.filter_map(|curve| entry(ui, chart, curve, hidden.contains(&curve.name))).last()
        })
        .inner
    })
    .inner
}

/// A piece of the curve's line, then its name.
fn entry(ui: &mut Ui, chart: &Chart, curve: &Curve, hidden: bool) -> Option<String> {
    let palette = Theme::palette_of(ui);
    let [red, green, blue] = curve.rgb();
    let (rect, _) = ui.allocate_exact_size(vec2(14.0, 12.0), Sense::hover());
    let ends = [rect.left_center(), rect.right_center()];
    let stroke = Stroke::new(2.5, Color32::from_rgb(red, green, blue).gamma_multiply(if hidden { 0.35 } else { 1.0 }));
    match curve.style {
        Style::Dashed => ui.painter().extend(Shape::dashed_line(&ends, stroke, 4.0, 3.0)),
        _ => {
            ui.painter().line_segment(ends, stroke);
        }
    }
    let text = RichText::new(format!("{}{}", curve.name, peak(chart, curve))).size(12.0);
    let text = if hidden { text.strikethrough().color(palette.faint) } else { text.color(palette.text) };
    let help = if hidden { "Click to show it" } else { "Click to take it away" };
    ui.add(Button::new(text).frame(false)).on_hover_text(help).clicked().then(|| curve.name.clone())
}

/// The greatest value of a tension or a force, with its unit, and its time.
fn peak(chart: &Chart, curve: &Curve) -> String {
    if !matches!(chart.kind, Kind::Tension | Kind::Force) {
        return String::new();
    }
    let Some(top) = curve.points.iter().max_by(|a, b| a.y.total_cmp(&b.y)) else { return String::new() };
    let value = if top.y.abs() < 100.0 { format!("{:.1}", top.y) } else { format!("{:.0}", top.y) };
    format!(" (peak {value} {} at {:.1} s)", chart.y, top.x)
}
