//! Figures of a run as rows and tables. [`endline_session::figures`] declares them and their formats.

use egui::{Grid, RichText, Ui};
use endline_session::figures::{Figure, Quantity, Value, View, shown};
use endline_session::units::Units;

use crate::gui::theme::Theme;
use crate::gui::widgets::words::capital;

/// Selection and units of figures.
#[derive(Clone, Copy, Debug)]
pub struct Style {
    /// View that selects the figures.
    pub view: View,
    /// Units of the values.
    pub units: Units,
}

/// Id of a list or table, unique in its panel.
fn id<S>(kind: &str, figures: &[Figure<S>], style: Style) -> String {
    let first = figures.first().map_or("", |figure| figure.label);
    format!("{kind} {first} {:?}", style.view)
}

/// Draws the figures of one source, one row each; returns the moment that was clicked [s].
pub fn list<S>(ui: &mut Ui, figures: &[Figure<S>], source: &S, style: Style) -> Option<f64> {
    let faint = Theme::palette_of(ui).faint;
    let mut wanted = None;
    let grid = Grid::new(id("list", figures, style)).num_columns(2);
    grid.spacing([16.0, 2.0]).min_row_height(17.0).show(ui, |ui| {
        for figure in shown(figures, style.view).filter(|figure| figure.is_shown(source)) {
            ui.label(RichText::new(capital(figure.label)).color(faint)).on_hover_text(figure.help);
            wanted = wanted.or(cell(ui, figure, source, style, false));
            ui.end_row();
        }
    });
    wanted
}

/// Draws a table with a row for each source and a column for each figure; returns the moment that was clicked [s]. `is_faint` selects
/// rows in faint text.
pub fn table<S>(
    ui: &mut Ui,
    figures: &[Figure<S>],
    sources: &[S],
    style: Style,
    is_faint: impl Fn(&S) -> bool,
) -> Option<f64> {
    let faint = Theme::palette_of(ui).faint;
    let mut wanted = None;
    let columns = shown(figures, style.view);
    let grid = Grid::new(id("table", figures, style)).num_columns(columns.clone().count());
    grid.striped(true).spacing([14.0, 2.0]).min_row_height(17.0).show(ui, |ui| {
        for figure in columns.clone() {
            let head = RichText::new(capital(figure.label)).small().color(faint);
            ui.label(head).on_hover_text(figure.help);
        }
        ui.end_row();
        for source in sources {
            for figure in columns.clone() {
                wanted = wanted.or(cell(ui, figure, source, style, is_faint(source)));
            }
            ui.end_row();
        }
    });
    wanted
}

/// Draws one value; a moment is a link to it.
fn cell<S>(
    ui: &mut Ui,
    figure: &Figure<S>,
    source: &S,
    style: Style,
    is_faint: bool,
) -> Option<f64> {
    let palette = Theme::palette_of(ui);
    let value = (figure.read)(source);
    let colour = match value {
        Value::Absent => palette.faint,
        _ if figure.alarms(source) => palette.error,
        _ if is_faint => palette.faint,
        _ => palette.text,
    };
    let text = RichText::new(figure.quantity.text(&value, style.units)).color(colour);
    let moment = value.number().filter(|_| figure.quantity == Quantity::Moment);
    let Some(moment) = moment else {
        ui.label(text);
        return None;
    };
    ui.link(text).on_hover_text("Show this moment").clicked().then_some(moment)
}
