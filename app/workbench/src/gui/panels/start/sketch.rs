//! Draws a sketch of the content of a file: traps, endlines, a net, a whale.

use egui::{Color32, Painter, Pos2, Rect, Shape, Stroke, pos2, vec2};
use endline_session::sketch::Sketch;

use crate::gui::theme::Palette;

/// Maximum number of traps drawn.
const MOST_TRAPS: usize = 12;

/// Draws the sketch in a rectangle.
pub(super) fn draw(painter: &Painter, place: Rect, sketch: &Sketch, palette: Palette) {
    painter.rect_filled(place, 4.0, palette.field);
    if sketch.options > 0 {
        return options(painter, place, sketch.options, palette);
    }
    let sea = Sea {
        painter,
        place,
        surface: place.top() + 11.0,
        seabed: place.bottom() - 6.0,
        ink: palette.text.gamma_multiply(0.8),
        palette,
    };
    sea.water();
    sea.gear(sketch);
    if sketch.whale {
        let across = if sketch.has_gear() { 0.34 } else { 0.5 };
        let x = place.left() + place.width() * across;
        whale(painter, pos2(x, (sea.surface + sea.seabed) / 2.0), sea.ink);
    }
}

/// Drawing area of gear, from the surface to the seabed.
struct Sea<'a> {
    painter: &'a Painter,
    place: Rect,
    surface: f32,
    seabed: f32,
    ink: Color32,
    palette: Palette,
}

impl Sea<'_> {
    fn water(&self) {
        let (place, accent) = (self.place, self.palette.accent);
        let water = Rect::from_min_max(pos2(place.left(), self.surface), place.max);
        self.painter.rect_filled(water, 4.0, accent.gamma_multiply(0.16));
        let surface = Stroke::new(1.0, accent.gamma_multiply(0.6));
        self.painter.hline(place.x_range(), self.surface, surface);
        self.painter.hline(place.x_range(), self.seabed, Stroke::new(1.0, self.palette.line));
    }

    /// Draws traps along the seabed, a net between the ends, and endlines with buoys at the ends.
    fn gear(&self, sketch: &Sketch) {
        let traps = sketch.traps.min(MOST_TRAPS);
        let (from, to) = self.ends(traps, sketch.whale);
        let step = (to - from) / traps.saturating_sub(1).max(1) as f32;
        for trap in 0..traps {
            let middle = pos2(from + step * trap as f32, self.seabed - 2.5);
            let shape = Rect::from_center_size(middle, vec2(5.0, 4.0));
            self.painter.rect_filled(shape, 0.5, self.ink);
        }
        if traps > 1 {
            self.painter.hline(from..=to, self.seabed - 1.5, Stroke::new(1.0, self.ink));
        }
        if sketch.net {
            let panel = Rect::from_x_y_ranges(from..=to, self.seabed - 13.0..=self.seabed - 2.0);
            self.painter.rect_filled(panel, 0.0, self.ink.gamma_multiply(0.25));
        }
        let ends = [(sketch.endlines >= 1, from), (sketch.endlines >= 2 && traps > 1, to)];
        for (_, foot) in ends.into_iter().filter(|(is_there, _)| *is_there) {
            self.endline(foot, if sketch.stowed { self.seabed - 9.0 } else { self.surface });
        }
    }

    /// Positions of the first and last trap.
    fn ends(&self, traps: usize, whale: bool) -> (f32, f32) {
        let across = |share: f32| self.place.left() + self.place.width() * share;
        match (traps, whale) {
            (..=1, _) => (across(0.7), across(0.7)),
            (_, true) => (across(0.45), across(0.86)),
            (_, false) => (across(0.14), across(0.81)),
        }
    }

    /// Draws a rope that leans with the tide, and its buoy.
    fn endline(&self, foot: f32, top: f32) {
        let bottom = self.seabed - 4.0;
        let lean = (bottom - top) * 0.35;
        let points = (0..=8).map(|step| {
            let up = step as f32 / 8.0;
            pos2(foot + lean * up * up, bottom + (top - bottom) * up)
        });
        self.painter.add(Shape::line(points.collect(), Stroke::new(1.4, self.ink)));
        self.painter.circle_filled(pos2(foot + lean, top), 2.6, self.palette.warning);
    }
}

/// Draws a whale from the side, its head to the right.
fn whale(painter: &Painter, middle: Pos2, colour: Color32) {
    const OUTLINE: [(f32, f32); 14] = [
        (16.0, 1.0),
        (14.0, -3.5),
        (7.0, -5.5),
        (0.0, -5.0),
        (-8.0, -2.5),
        (-14.0, -1.2),
        (-20.0, -2.6),
        (-17.5, 0.2),
        (-19.5, 1.8),
        (-14.0, 0.6),
        (-7.0, 3.0),
        (1.0, 5.5),
        (9.0, 5.5),
        (14.5, 4.0),
    ];
    let points: Vec<Pos2> = OUTLINE.iter().map(|(x, y)| middle + vec2(*x, *y)).collect();
    // The outline is not convex at the flukes, but each triangle of a fan about the middle is.
    for index in 0..points.len() {
        let next = points[(index + 1) % points.len()];
        painter.add(Shape::convex_polygon(vec![middle, points[index], next], colour, Stroke::NONE));
    }
    let flipper = [(6.0, 4.0), (1.0, 9.0), (3.5, 4.5)].map(|(x, y)| middle + vec2(x, y));
    painter.add(Shape::convex_polygon(flipper.to_vec(), colour, Stroke::NONE));
}

/// Draws the options of a study as intervals beside a line.
fn options(painter: &Painter, place: Rect, count: usize, palette: Palette) {
    let rows = count.clamp(2, 5);
    let zero = place.left() + place.width() * 0.45;
    painter.vline(zero, place.shrink(6.0).y_range(), Stroke::new(1.0, palette.line));
    for row in 0..rows {
        let y = place.top() + place.height() * (row as f32 + 1.0) / (rows as f32 + 1.0);
        let middle = zero + place.width() * (0.02 + 0.06 * row as f32);
        let half = place.width() * (0.2 - 0.02 * row as f32);
        painter.hline(middle - half..=middle + half, y, Stroke::new(1.2, palette.faint));
        painter.circle_filled(pos2(middle, y), 2.5, palette.accent);
    }
}
