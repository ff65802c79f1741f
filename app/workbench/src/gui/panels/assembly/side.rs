//! Side views of the gear, to scale: slack tide beside running tide, A solid, B dashed.

use egui::{Color32, RichText, Ui, vec2};
use egui_plot::{
    HLine, Line, LineStyle, MarkerShape, Plot, PlotBounds, PlotPoint, PlotPoints, PlotUi, Points,
    Text,
};
use endline_gear::WEAK_PLACES;
use endline_sdk::LineEnd;
use endline_session::scene::rope::along;
use endline_session::statics::RigAtRest;
use endline_session::units::Units;
use endline_sim::model::{Body, BodyRole, Rope};
use glam::DVec2;

use super::{AssemblyPanel, Drawn, Rig, strength, surface_m_s};
use crate::gui::shared::Shared;
use crate::gui::theme::Theme;
use crate::gui::widgets::plot::{with_ticks, x_axis, y_axis};

/// Width of the drawing relative to the gear, for labels at the right of lines.
const LABEL_ROOM: f64 = 1.35;
/// Maximum number of lines with diameter and strength.
const LABELLED: usize = 6;

/// One of the two gears.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Gear {
    name: &'static str,
    dashed: bool,
}

/// The gear that is edited.
pub(super) const A: Gear = Gear { name: "A", dashed: false };
/// The gear it is compared with.
pub(super) const B: Gear = Gear { name: "B", dashed: true };

impl Gear {
    /// Its colour.
    pub(super) fn color(self, ui: &Ui) -> Color32 {
        match (self.dashed, ui.visuals().dark_mode) {
            (false, true) => Color32::from_rgb(0x56, 0xb4, 0xe9),
            (false, false) => Color32::from_rgb(0x00, 0x64, 0x9b),
            (true, true) => Color32::from_rgb(0xe6, 0x9f, 0x00),
            (true, false) => Color32::from_rgb(0x9a, 0x5b, 0x00),
        }
    }

    fn style(self) -> LineStyle {
        if self.dashed { LineStyle::dashed_dense() } else { LineStyle::Solid }
    }
}

/// Draws both tides.
pub(super) fn show(ui: &mut Ui, panel: &AssemblyPanel, shared: &Shared) {
    let drawn = panel.drawn();
    let flat = Flat { axis: axis(&drawn), units: shared.workbench.preferences().units };
    let size = vec2((ui.available_width() - 8.0) / 2.0, ui.available_height());
    let bounds = bounds(&drawn, &flat, f64::from((size.x - 60.0) / (size.y - 70.0).max(1.0)));
    ui.horizontal_top(|ui| {
        for tide in 0..2 {
            ui.allocate_ui(size, |ui| ui.vertical(|ui| one(ui, &drawn, tide, bounds, &flat)));
        }
    });
}

/// Horizontal direction of the drawing: towards the node of A at running tide that is farthest from the first.
fn axis(drawn: &Drawn<'_>) -> DVec2 {
    let rest = drawn.a[1].rest.or(drawn.a[0].rest);
    let places =
        || rest.iter().flat_map(|rest| rest.shape.lines.iter().flat_map(|line| &line.position_m));
    let flat = |place: &[f64; 3]| DVec2::new(place[0], place[1]);
    let Some(first) = places().next().map(flat) else { return DVec2::X };
    let far = places()
        .map(|place| flat(place) - first)
        .max_by(|a, b| a.length_squared().total_cmp(&b.length_squared()));
    far.and_then(DVec2::try_normalize).unwrap_or(DVec2::X)
}

/// Common bounds of both tides: everything drawn and the sea from seabed to surface, with the aspect ratio of the picture.
fn bounds(drawn: &Drawn<'_>, flat: &Flat, aspect: f64) -> PlotBounds {
    let rests = || drawn.a.iter().chain(&drawn.b).filter_map(|rig| rig.rest);
    let points = rests()
        .flat_map(|rest| rest.shape.lines.iter().flat_map(|line| &line.position_m))
        .map(|place| flat.point(*place));
    let floors =
        rests().map(|rest| [f64::NAN, -flat.units.of_metres(rest.model.spec.water.depth_m)]);
    let empty = ([f64::INFINITY, 0.0], [f64::NEG_INFINITY, 0.0]);
    // f64::min and max ignore NaN.
    let (low, high) = points.chain(floors).fold(empty, |(low, high), point| {
        (
            std::array::from_fn(|axis| low[axis].min(point[axis])),
            std::array::from_fn(|axis| high[axis].max(point[axis])),
        )
    });
    if !low[0].is_finite() {
        return PlotBounds::from_min_max([0.0, -1.0], [1.0, 0.0]);
    }
    let height = (high[1] - low[1]).max(0.01) * 1.2;
    let wide = (high[0] - low[0]) * LABEL_ROOM;
    let height = height.max(wide / aspect.max(0.1));
    let middle = [f64::midpoint(low[0], low[0] + wide), f64::midpoint(low[1], high[1])];
    let half = [height * aspect.max(0.1) / 2.0, height / 2.0];
    PlotBounds::from_min_max(
        [middle[0] - half[0] * 1.02, middle[1] - half[1]],
        [middle[0] + half[0] * 0.98, middle[1] + half[1]],
    )
}

fn one(ui: &mut Ui, drawn: &Drawn<'_>, tide: usize, bounds: PlotBounds, flat: &Flat) {
    let units = flat.units;
    let gears = [(A, drawn.a[tide]), (B, drawn.b[tide])];
    heading(ui, tide, &gears, units);
    let palette = Theme::palette_of(ui);
    let colors = [A.color(ui), B.color(ui)];
    let plot = with_ticks(Plot::new(("side", tide)), palette)
        .data_aspect(1.0)
        .allow_drag(false)
        .allow_zoom(false)
        .allow_boxed_zoom(false)
        .allow_double_click_reset(false)
        .custom_x_axes(vec![x_axis(format!("along [{}]", units.length_symbol()))])
        .custom_y_axes(vec![
            y_axis(format!("height [{}]", units.length_symbol())).min_thickness(42.0),
        ])
        .show_background(false)
        .allow_scroll(false);
    plot.show(ui, |plot| {
        plot.set_plot_bounds(bounds);
        let depth_m =
            gears.iter().find_map(|(_, rig)| rig.rest).map(|rest| rest.model.spec.water.depth_m);
        if let Some(depth_m) = depth_m {
            plot.hline(
                HLine::new("sea surface", 0.0).color(palette.accent.gamma_multiply(0.8)).width(1.0),
            );
            plot.hline(
                HLine::new("seabed", -units.of_metres(depth_m)).color(palette.faint).width(2.0),
            );
        }
        for ((gear, shown), color) in gears.into_iter().zip(colors) {
            if let Some(rest) = shown.rest {
                rig(plot, rest, gear, color, palette.text, flat);
            }
        }
    });
}

/// Draws the name of the tide, and why there are no statics.
fn heading(ui: &mut Ui, tide: usize, gears: &[(Gear, Rig<'_>); 2], units: Units) {
    let palette = Theme::palette_of(ui);
    let title = match (tide, gears[0].1.rest) {
        (0, _) => "Slack tide".to_owned(),
        (_, Some(rest)) => format!("Running tide, {}", units.speed(surface_m_s(rest))),
        (_, None) => "Running tide".to_owned(),
    };
    ui.horizontal(|ui| {
        ui.label(RichText::new(title).strong());
        for (gear, rig) in gears {
            let unsettled = rig.rest.filter(|rest| !rest.shape.converged);
            let says = match (rig.wrong, rig.rest) {
                (Some(why), Some(_)) => Some(format!("{}, last result: {why}", gear.name)),
                (Some(why), None) => Some(format!("{}: {why}", gear.name)),
                (None, _) => unsettled.map(|rest| format!("{}: {}", gear.name, rest.shape.outcome)),
            };
            if let Some(says) = says {
                let text = RichText::new(&says).color(palette.warning);
                ui.add(egui::Label::new(text).truncate()).on_hover_text(says);
            }
        }
    });
}

/// Projection of places to points of the drawing.
struct Flat {
    axis: DVec2,
    units: Units,
}

impl Flat {
    fn point(&self, place: [f64; 3]) -> [f64; 2] {
        let along = DVec2::new(place[0], place[1]).dot(self.axis);
        [self.units.of_metres(along), self.units.of_metres(place[2])]
    }

    /// Diameter and delivered strength of a line.
    fn rope(&self, rope: &Rope, delivered_n: f64) -> String {
        let strength = self.units.force().text(delivered_n);
        format!("{}, {strength}", self.units.diameter(rope.diameter_m))
    }
}

/// Colour of weak inserts, links and weak places.
const PARTS: Color32 = Color32::from_rgb(0xd5, 0x5e, 0x00);

fn rig(
    plot: &mut PlotUi<'_>,
    rest: &RigAtRest,
    gear: Gear,
    color: Color32,
    text: Color32,
    flat: &Flat,
) {
    let spec = &rest.model.spec;
    for (index, (line, shape)) in spec.lines.iter().zip(&rest.shape.lines).enumerate() {
        let points: Vec<[f64; 2]> =
            shape.position_m.iter().map(|place| flat.point(*place)).collect();
        let insert = line.id.contains(".insert-");
        let (color, width) = if insert { (PARTS, 5.0) } else { (color, 2.0) };
        let rope = &spec.ropes[line.rope];
        let delivered_n =
            strength::of(rest, &line.id).map_or(rope.strength_n, |strength| strength.delivered_N);
        let rope = flat.rope(rope, delivered_n);
        let middle = points.get(points.len() / 2).copied();
        let name = format!("{} {}: {rope}", gear.name, line.id);
        let drawn = Line::new(name, PlotPoints::from(points));
        plot.line(drawn.color(color).width(width).style(gear.style()));
        let labelled = !gear.dashed && !insert && spec.lines.len() <= LABELLED;
        if let Some(at) = middle.filter(|_| labelled && speaks(&spec.lines, index)) {
            label(plot, at, &rope, text);
        }
    }
    for (body, at) in spec.bodies.iter().zip(&rest.shape.bodies) {
        mark(plot, body, flat.point(at.position_m), gear, color);
    }
    for index in 0..spec.lines.len() {
        weak_places(plot, rest, gear, index, flat);
    }
    for link in spec.links.iter().filter(|link| link.enabled) {
        let Some(line) = rest.shape.lines.get(link.line) else { continue };
        let end = match link.end {
            LineEnd::A => line.position_m.first(),
            LineEnd::B => line.position_m.last(),
        };
        let Some(at) = end else { continue };
        let rating = flat.units.force().text(link.rating_n);
        let name = format!("{} {}: parts at {rating}", gear.name, link.id);
        let points = Points::new(name, vec![flat.point(*at)]);
        plot.points(points.shape(MarkerShape::Cross).radius(5.0).color(PARTS));
    }
}

/// Marks the weak places of a line, as weak links are marked.
fn weak_places(plot: &mut PlotUi<'_>, rest: &RigAtRest, gear: Gear, index: usize, flat: &Flat) {
    let line = &rest.model.spec.lines[index];
    let Some(first) = line.weak_places.first() else { return };
    let part = format!("{}.{WEAK_PLACES}", line.id);
    let parts_n =
        strength::of(rest, &part).map_or(first.strength_n, |strength| strength.delivered_N);
    let places = line
        .weak_places
        .iter()
        .filter_map(|place| along(&rest.model, &rest.frame, index, place.at_m))
        .map(|place| flat.point(place.to_array()));
    let name = format!(
        "{} {}: weak place, parts at {}",
        gear.name,
        line.id,
        flat.units.force().text(parts_n)
    );
    let points = Points::new(name, places.collect::<Vec<_>>());
    plot.points(points.shape(MarkerShape::Cross).radius(5.0).color(PARTS));
}

/// Draws diameter and strength beside a line, on the side with room.
fn label(plot: &mut PlotUi<'_>, at: [f64; 2], rope: &str, color: Color32) {
    let right = at[0] > plot.plot_bounds().center().x;
    let anchor = if right { egui::Align2::RIGHT_CENTER } else { egui::Align2::LEFT_CENTER };
    let words = RichText::new(format!("  {rope}  ")).size(11.0);
    plot.text(Text::new("", PlotPoint::new(at[0], at[1]), words).color(color).anchor(anchor));
}

/// Whether a piece has the label of its line: the longest piece of its rope has.
fn speaks(lines: &[endline_sim::model::Line], index: usize) -> bool {
    let (of, length) = (
        |id: &str| id.split('.').next().map(str::to_owned),
        |line: &endline_sim::model::Line| -> f64 { line.segments_m.iter().sum() },
    );
    let own = &lines[index];
    let same = lines
        .iter()
        .enumerate()
        .filter(|(_, line)| of(&line.id) == of(&own.id) && line.rope == own.rope);
    same.max_by(|(_, a), (_, b)| length(a).total_cmp(&length(b)))
        .is_some_and(|(longest, _)| longest == index)
}

fn mark(plot: &mut PlotUi<'_>, body: &Body, at: [f64; 2], gear: Gear, color: Color32) {
    let shape = match body.role {
        BodyRole::Trap => MarkerShape::Square,
        BodyRole::Buoy => MarkerShape::Circle,
        BodyRole::Anchor => MarkerShape::Down,
        BodyRole::Weight => MarkerShape::Diamond,
    };
    plot.points(
        Points::new(format!("{} {}", gear.name, body.id), vec![at])
            .shape(shape)
            .radius(5.0)
            .filled(!gear.dashed)
            .color(color),
    );
}
