//! Plots of the run, one below the other, with one cursor; a click shows that moment.

mod key;

use std::collections::BTreeSet;
use std::path::PathBuf;
use std::sync::Arc;

use egui::{Color32, Id, Rect, Ui};
use egui_plot::{
    AxisHints, FilledArea, HLine, Line, LineStyle, Plot, PlotPoint, PlotPoints, Polygon, VLine,
};
use endline_session::live::LiveView;
use endline_session::units::Units;
use endline_sim::Model;

use super::super::charts::{Chart, Curve, Kind, Style};
use super::super::desk::{Desk, Order};
use super::super::theme::Theme;

/// A strength further above the peak than this share is told, not drawn.
const REACH: f64 = 3.0;

/// Height of a plot's title and key where they take one row.
const HEAD: f32 = 34.0;

/// A plot is never less high.
const LEAST: f32 = 104.0;

/// Which plots are shown, and those last made.
#[derive(Default)]
pub struct PlotsState {
    /// The kinds shown; tension, force and wraps where `None`.
    pub shown: Option<Vec<Kind>>,
    /// A PNG to be cut from the window as it is drawn next.
    pub picture: Option<PathBuf>,
    /// Names of curves that a click in the key took away.
    hidden: BTreeSet<String>,
    made: Vec<(Kind, Made)>,
    /// The file that waits for the window's picture, and the part of it that is the plots.
    waiting: Option<(PathBuf, Rect)>,
}

/// A chart with what it was made of.
struct Made {
    of: (Part, Option<Part>),
    units: Units,
    chart: Chart,
}

/// As much of a run as a chart shows.
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

impl PlotsState {
    /// The kinds shown.
    #[must_use]
    pub fn kinds(&self) -> Vec<Kind> {
        self.shown.clone().unwrap_or_else(|| vec![Kind::Tension, Kind::Force, Kind::Wraps])
    }

    /// Makes charts anew where a run has gone on since.
    fn make(
        &mut self,
        kind: Kind,
        view: &LiveView,
        other: Option<&LiveView>,
        units: Units,
    ) -> &Chart {
        let of = (Part::of(kind, view), other.map(|other| Part::of(kind, other)));
        let place = self.made.iter().position(|(known, _)| *known == kind);
        let known = place
            .is_some_and(|place| self.made[place].1.of == of && self.made[place].1.units == units);
        if !known {
            let made = (kind, Made { of, units, chart: chart(kind, view, other, units) });
            match place {
                Some(place) => self.made[place] = made,
                None => self.made.push(made),
            }
        }
        let last = self.made.len() - 1;
        &self.made[place.unwrap_or(last)].1.chart
    }
}

/// A chart of a run, with the one it is compared with.
fn chart(kind: Kind, view: &LiveView, other: Option<&LiveView>, units: Units) -> Chart {
    let own = Chart::of(kind, view, units);
    match other {
        Some(other) => own.beside(Chart::of(kind, other, units)),
        None => own,
    }
}

/// Draws the plots panel.
pub fn show(ui: &mut Ui, desk: &mut Desk) {
    let Some(view) = desk.view.clone() else { return super::nothing(ui, "No run yet.") };
    toolbar(ui, desk);
    let kinds = desk.plots.kinds();
    if kinds.is_empty() {
        return super::nothing(ui, "Choose what to plot above.");
    }
    photograph(ui, desk);
    let height = (ui.available_height() / kinds.len() as f32 - HEAD).max(LEAST);
    egui::ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
        for kind in kinds {
            let compared = if desk.other().is_some() { "; A solid, B dashed" } else { "" };
            let note =
                if kind == Kind::Along { "; shaded from least to greatest so far" } else { "" };
            one(ui, desk, &view, kind, &format!("{}{note}{compared}", kind.title()), height);
        }
    });
}

/// Draws one plot alone, filling the panel.
pub fn alone(ui: &mut Ui, desk: &mut Desk, kind: Kind) {
    let Some(view) = desk.view.clone() else { return super::nothing(ui, "No run yet.") };
    let height = ui.available_height() - HEAD;
    one(ui, desk, &view, kind, "", height);
}

fn toolbar(ui: &mut Ui, desk: &mut Desk) {
    ui.horizontal_wrapped(|ui| {
        let mut shown = desk.plots.kinds();
        for kind in Kind::ALL {
            let mut on = shown.contains(&kind);
            if ui.toggle_value(&mut on, kind.title()).changed() {
                shown = Kind::ALL
                    .into_iter()
                    .filter(|known| if *known == kind { on } else { shown.contains(known) })
                    .collect();
                desk.plots.shown = Some(shown.clone());
            }
        }
        ui.menu_button("Save ⏷", |ui| {
            for (text, ending) in [("As SVG …", "svg"), ("As PNG …", "png"), ("As CSV …", "csv")]
            {
                if ui.button(text).clicked() {
                    desk.orders.push(Order::AskExportPlots(ending));
                    ui.close();
                }
            }
        });
    });
}

/// Cuts the plots out of a picture of the window.
fn photograph(ui: &Ui, desk: &mut Desk) {
    if let Some(path) = desk.plots.picture.take() {
        desk.plots.waiting = Some((path, ui.available_rect_before_wrap()));
        ui.ctx().send_viewport_cmd(egui::ViewportCommand::Screenshot(egui::UserData::default()));
    }
    let shot = |event: &egui::Event| {
        if let egui::Event::Screenshot { image, .. } = event {
            Some(Arc::clone(image))
        } else {
            None
        }
    };
    let Some(image) = ui.input(|input| input.events.iter().find_map(shot)) else { return };
    let Some((path, rect)) = desk.plots.waiting.take() else { return };
    let cut = image.region(&rect, Some(ui.ctx().pixels_per_point()));
    let written = png_of(&cut).and_then(|bytes| {
        endline_session::save::atomically(&path, &bytes).map_err(|error| error.to_string())
    });
    desk.notice = Some(match written {
        Ok(()) => (format!("saved {}", path.display()), false),
        Err(error) => (format!("{}: {error}", path.display()), true),
    });
}

fn png_of(image: &egui::ColorImage) -> Result<Vec<u8>, String> {
    let mut bytes = Vec::new();
    let side = |pixels: usize| u32::try_from(pixels).map_err(|error| error.to_string());
    let mut encoder = png::Encoder::new(&mut bytes, side(image.size[0])?, side(image.size[1])?);
    encoder.set_color(png::ColorType::Rgba);
    let mut writer = encoder.write_header().map_err(|error| error.to_string())?;
    writer.write_image_data(image.as_raw()).map_err(|error| error.to_string())?;
    writer.finish().map_err(|error| error.to_string())?;
    Ok(bytes)
}

/// The charts shown, for writing.
pub fn charts(desk: &Desk) -> Vec<Chart> {
    let Some(view) = &desk.view else { return Vec::new() };
    let other = desk.other_view();
    desk.plots
        .kinds()
        .into_iter()
        .map(|kind| chart(kind, view, other.as_deref(), desk.preferences.units))
        .collect()
}

/// One plot below its title and its key, which never covers a curve.
fn one(ui: &mut Ui, desk: &mut Desk, view: &LiveView, kind: Kind, title: &str, height: f32) {
    let palette = Theme::palette_of(ui);
    let units = desk.preferences.units;
    let other = desk.other_view();
    let hidden = desk.plots.hidden.clone();
    let chart = desk.plots.make(kind, view, other.as_deref(), units);
    let head_top = ui.cursor().top();
    let clicked = key::show(ui, (title, height), chart, &hidden);
    let height = (height + HEAD - (ui.cursor().top() - head_top)).max(LEAST);
    if chart.curves.iter().all(|curve| curve.points.is_empty()) {
        let why = if matches!(kind, Kind::Force | Kind::Wraps) {
            "No rope has touched the whale."
        } else {
            "Nothing yet."
        };
        return super::nothing(ui, why);
    }
    let top = chart.top().max(1e-6);
    let mut plot = Plot::new(("plot", kind.name()))
        .height(height)
        .include_x(0.0)
        .include_x(chart.end_x)
        .include_y(0.0)
        .custom_x_axes(vec![
            AxisHints::new_x().label(chart.x.clone()).label_spacing(egui::Rangef::new(24.0, 48.0)),
        ])
        .custom_y_axes(vec![
            AxisHints::new_y()
                .label(chart.y.clone())
                .label_spacing(egui::Rangef::new(14.0, 26.0))
                .min_thickness(46.0),
        ])
        .grid_spacing(egui::Rangef::new(14.0, 220.0))
        .grid_color(palette.faint.gamma_multiply(0.5))
        .allow_scroll(false)
        .show_background(false);
    if top > 0.0 {
        plot = plot.include_y(top * 1.1);
    }
    if kind.over_time() {
        plot = plot
            .link_cursor(Id::new("time"), [true, false])
            .link_axis(Id::new("time"), [true, false]);
    }
    let response = plot.show(ui, |plot| {
        let shown: Vec<&Curve> =
            chart.curves.iter().filter(|curve| !hidden.contains(chart.line_of(curve))).collect();
        shade(plot, &shown);
        for curve in shown {
            let [red, green, blue] = curve.rgb();
            let colour = Color32::from_rgb(red, green, blue);
            let line = Line::new(&curve.name, PlotPoints::Borrowed(&curve.points));
            match curve.style {
                Style::Solid => plot.line(line.color(colour).width(1.5)),
                Style::Dashed => {
                    plot.line(line.color(colour).width(1.5).style(LineStyle::dashed_dense()))
                }
                Style::Edge => plot.line(
                    Line::new("", PlotPoints::Borrowed(&curve.points))
                        .color(colour.gamma_multiply(0.55))
                        .width(1.0),
                ),
            }
        }
        for level in chart.levels.iter().filter(|level| level.band[0] < REACH * top) {
            let [low, high] = level.band;
            if high > low {
                let corners = [[0.0, low], [chart.end_x, low], [chart.end_x, high], [0.0, high]];
                let points: Vec<PlotPoint> = corners.map(PlotPoint::from).to_vec();
                let band = Polygon::new(&level.name, PlotPoints::Owned(points))
                    .fill_color(palette.error.gamma_multiply(0.12));
                plot.polygon(band.stroke(egui::Stroke::NONE).allow_hover(false));
            }
            plot.hline(
                HLine::new(&level.name, low)
                    .color(palette.error)
                    .width(1.0)
                    .style(LineStyle::dashed_loose()),
            );
        }
        if kind.over_time() {
            plot.vline(
                VLine::new("", view.frame.time_s)
                    .color(palette.faint.gamma_multiply(0.7))
                    .width(1.0),
            );
        }
        plot.pointer_coordinate()
    });
    if let Some(name) = clicked
        && !desk.plots.hidden.remove(&name)
    {
        desk.plots.hidden.insert(name);
    }
    if let (true, true, Some(at)) = (kind.over_time(), response.response.clicked(), response.inner)
    {
        desk.orders.push(Order::Seek(at.x.clamp(0.0, view.newest_s)));
    }
}

/// Fills between least and greatest so far, which stand one after the other.
fn shade(plot: &mut egui_plot::PlotUi<'_>, curves: &[&Curve]) {
    for pair in curves.windows(2) {
        let [least, greatest] = pair else { continue };
        let edges = least.style == Style::Edge
            && greatest.style == Style::Edge
            && least.colour == greatest.colour;
        if edges && least.points.len() == greatest.points.len() && least.points.len() > 1 {
            let [red, green, blue] = least.rgb();
            let xs: Vec<f64> = least.points.iter().map(|point| point.x).collect();
            let [low, high] = [least, greatest]
                .map(|curve| curve.points.iter().map(|point| point.y).collect::<Vec<f64>>());
            let fill = Color32::from_rgb(red, green, blue).gamma_multiply(0.16);
            plot.add(FilledArea::new("", &xs, &low, &high).fill_color(fill).allow_hover(false));
        }
    }
}
