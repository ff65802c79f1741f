//! The gear from the side at slack and at running tide, to one scale: height above the seabed over distance along the tide.
//!
//! Gear much longer than the water is deep is drawn at its endline nearest down-tide; the rest is named, not drawn.

use endline_sim::model::BodyRole;

use crate::page::svg::{Axis, Side, Svg};
use crate::settled::SettledShape;

use super::ComplianceSheet;

/// Size of the picture.
const WIDTH: f64 = 520.0;
const HEIGHT: f64 = 340.0;
/// Space for words: left, right, above, below.
const MARGINS: [f64; 4] = [56.0, 16.0, 26.0, 40.0];
/// Widths of the water shown, in its depths.
const MOST_DEPTHS: f64 = 2.4;

/// Both shapes, the first with solid and the second with dashed lines.
pub(super) fn side_view(sheet: &ComplianceSheet) -> String {
    let depth_m = sheet.rules.depth_m;
    let shapes = sheet.rest.each_ref().map(|rest| &rest.shape);
    let window = window(shapes, depth_m);
    let mut svg = Svg::new(WIDTH, HEIGHT, "The gear from the side, at slack and at running tide");
    let axes = axes(window, depth_m);
    frame(&mut svg, axes, depth_m);
    for (kind, shape) in shapes.iter().enumerate() {
        for line in &shape.lines {
            let points: Vec<[f64; 2]> =
                line.position_m.iter().map(|place| seen(*place, axes)).collect();
            runs_within(&points, axes).iter().for_each(|run| svg.path(run, kind));
        }
    }
    bodies(&mut svg, sheet, axes);
    legend(&mut svg, sheet);
    svg.done()
}

/// The range along the tide that is drawn [m].
fn window(shapes: [&SettledShape; 2], depth_m: f64) -> [f64; 2] {
    let along = || {
        let lines = shapes.iter().flat_map(|shape| &shape.lines);
        lines.flat_map(|line| line.position_m.iter().map(|place| place[0]))
    };
    let (least, most) = (along().fold(f64::MAX, f64::min), along().fold(f64::MIN, f64::max));
    let least = least.max(most - MOST_DEPTHS * depth_m);
    let space = 0.04 * (most - least).max(depth_m);
    [least - space, most + space]
}

/// Axes along the tide and upward, of one scale.
fn axes([least, most]: [f64; 2], depth_m: f64) -> [Axis; 2] {
    let [left, right, above, below] = MARGINS;
    let (wide, high) = (WIDTH - left - right, HEIGHT - above - below);
    let highest = 1.12 * depth_m;
    let scale = (wide / (most - least)).min(high / highest);
    let side = 0.5 * (wide - scale * (most - least));
    [
        Axis { values: [least, most], places: [left + side, WIDTH - right - side] },
        Axis { values: [0.0, highest], places: [HEIGHT - below, HEIGHT - below - scale * highest] },
    ]
}

/// A point of the world in the picture; the sea's surface is at height 0.
fn seen([along, _, height]: [f64; 3], [x, y]: [Axis; 2]) -> [f64; 2] {
    let depth_m = y.values[1] / 1.12;
    let slope = (x.places[1] - x.places[0]) / (x.values[1] - x.values[0]);
    [x.places[0] + slope * (along - x.values[0]), y.at(height + depth_m)]
}

/// The parts of a line within the picture.
fn runs_within(points: &[[f64; 2]], [x, _]: [Axis; 2]) -> Vec<Vec<[f64; 2]>> {
    let is_in = |point: &[f64; 2]| (x.places[0]..=x.places[1]).contains(&point[0]);
    let runs = points.split(|point| !is_in(point));
    runs.filter(|run| run.len() > 1).map(<[[f64; 2]]>::to_vec).collect()
}

/// Surface, seabed and scale.
fn frame(svg: &mut Svg, [x, y]: [Axis; 2], depth_m: f64) {
    let [left, right] = x.places;
    for (height_m, name) in [(0.0, "seabed".to_owned()), (depth_m, "surface".to_owned())] {
        let at = y.at(height_m);
        svg.line([left, at], [right, at], "zero");
        svg.text([left - 6.0, at + 4.0], Side::End, &name);
    }
    let foot = y.places[0];
    for metres in x.ticks() {
        let at = x.at(metres);
        svg.line([at, foot], [at, foot + 4.0], "zero");
        svg.text([at, foot + 16.0], Side::Middle, &format!("{metres:.0} m"));
    }
    svg.text(
        [0.5 * (left + right), foot + 32.0],
        Side::Middle,
        "along the tide, to the right; heights to the same scale",
    );
}

/// Marks of bodies: traps and anchors square, buoys round.
fn bodies(svg: &mut Svg, sheet: &ComplianceSheet, axes: [Axis; 2]) {
    for rest in &sheet.rest {
        for (body, at) in rest.prepared.model.spec.bodies.iter().zip(&rest.shape.bodies) {
            let place = seen(at.position_m, axes);
            if (axes[0].places[0]..=axes[0].places[1]).contains(&place[0]) {
                svg.mark(place, usize::from(body.role != BodyRole::Buoy));
            }
        }
    }
}

fn legend(svg: &mut Svg, sheet: &ComplianceSheet) {
    let running = format!("running tide, {:.2} m/s", sheet.tide_m_s);
    let mut x = MARGINS[0];
    for (kind, (words, width)) in [("slack tide", 110.0), (&running, 190.0)].iter().enumerate() {
        svg.path(&[[x, 12.0], [x + 30.0, 12.0]], kind);
        svg.text([x + 36.0, 16.0], Side::Start, words);
        x += width;
    }
    for (kind, (words, width)) in [("buoy", 60.0), ("trap, anchor", 90.0)].iter().enumerate() {
        svg.mark([x, 12.0], kind);
        svg.text([x + 9.0, 16.0], Side::Start, words);
        x += width;
    }
}
