//! Text over a scene: caption and time, the tension scale in lbf and N, a scale bar, names of small bodies.

use egui::{Align2, Color32, FontId, Mesh, Painter, Pos2, Rect, Stroke, Vec2, pos2, vec2};
use endline_session::scales::{decimals, nice_below, ticks};
use endline_session::scene::colour::tension_colour;
use endline_session::units::{N_PER_LBF, Units};
use endline_sim::{Frame, Model};
use glam::DVec2;

use crate::scene::camera::Camera;
use crate::scene::silhouette::silhouette;

/// Content of the overlay.
#[derive(Clone, Debug, PartialEq)]
pub struct Overlay<'a> {
    /// Line at the top left, such as the scenario's name; may be empty.
    pub caption: &'a str,
    /// Simulated time [s].
    pub time_s: f64,
    /// Tension at the top of the colour scale [N]; zero for a scene without rope, which has no scale.
    pub scale_n: f64,
    /// Length of one point at the camera's target [m].
    pub metres_a_point: f64,
    /// Units of the scale bar.
    pub units: Units,
}

const INK: Color32 = Color32::from_rgb(0xe6, 0xee, 0xf0);
const FAINT: Color32 = Color32::from_rgb(0xa9, 0xbd, 0xc4);
const PLATE: Color32 = Color32::from_black_alpha(110);
const MARGIN: f32 = 12.0;
/// Width below which a pane is narrow [points].
const NARROW: f32 = 700.0;

/// Draws the overlay into `rect`.
pub fn paint(painter: &Painter, rect: Rect, overlay: &Overlay<'_>) {
    caption(painter, rect, overlay);
    if overlay.scale_n > 0.0 && rect.height() > 260.0 && rect.width() > 320.0 {
        legend(painter, rect, overlay.scale_n);
    }
    // In a low pane it would overlap the caption.
    if rect.height() > 90.0 {
        scale_bar(painter, rect, overlay.metres_a_point, overlay.units);
    }
}

fn caption(painter: &Painter, rect: Rect, overlay: &Overlay<'_>) {
    let time = format!("{:.2} s", overlay.time_s);
    let text =
        if overlay.caption.is_empty() { time } else { format!("{}   {time}", overlay.caption) };
    let at = rect.left_top() + Vec2::splat(MARGIN);
    let galley = painter.layout_no_wrap(text, FontId::proportional(14.0), INK);
    painter.rect_filled(Rect::from_min_size(at, galley.size()).expand2(vec2(7.0, 4.0)), 4.0, PLATE);
    painter.galley(at, galley, INK);
}

/// Draws the colour bar, with pounds-force at its left and newtons at its right.
fn legend(painter: &Painter, rect: Rect, scale_n: f64) {
    // The bar is short in a narrow pane, such as for two compared runs, where it would cover the scene.
    let share = if rect.width() < NARROW { 0.2 } else { 0.35 };
    let height = (rect.height() * share).clamp(90.0, 220.0);
    let bar = Rect::from_min_size(
        pos2(rect.right() - 78.0, rect.bottom() - MARGIN - 12.0 - height),
        vec2(10.0, height),
    );
    let plate = Rect::from_min_max(
        bar.min - vec2(60.0, 44.0),
        pos2(rect.right() - MARGIN + 4.0, bar.max.y + 12.0),
    );
    painter.rect_filled(plate, 5.0, PLATE);
    let small = FontId::proportional(11.5);
    painter.text(
        pos2(plate.center().x, plate.top() + 13.0),
        Align2::CENTER_CENTER,
        "Tension",
        small.clone(),
        INK,
    );
    painter.text(
        bar.left_top() - vec2(7.0, 14.0),
        Align2::RIGHT_CENTER,
        "lbf",
        small.clone(),
        FAINT,
    );
    painter.text(
        bar.right_top() + vec2(7.0, -14.0),
        Align2::LEFT_CENTER,
        "N",
        small.clone(),
        FAINT,
    );
    gradient(painter, bar);
    for (per_n, side, align) in
        [(1.0 / N_PER_LBF, -1.0, Align2::RIGHT_CENTER), (1.0, 1.0, Align2::LEFT_CENTER)]
    {
        let ticks = ticks(0.0, scale_n * per_n, 5);
        let places = ticks.get(1).map_or(0, |step| decimals(*step));
        for tick in ticks {
            let y = bar.bottom() - bar.height() * (tick / (scale_n * per_n)) as f32;
            let edge = if side < 0.0 { bar.left() } else { bar.right() };
            painter
                .line_segment([pos2(edge, y), pos2(edge + side * 4.0, y)], Stroke::new(1.0, FAINT));
            painter.text(
                pos2(edge + side * 7.0, y),
                align,
                thousands(tick, places),
                small.clone(),
                INK,
            );
        }
    }
}

/// Draws the colours of the scale in a bar, upwards or to the right along its longer side.
pub fn gradient(painter: &Painter, bar: Rect) {
    const STEPS: u32 = 24;
    let upright = bar.height() > bar.width();
    let mut mesh = Mesh::default();
    for step in 0..=STEPS {
        let share = f64::from(step) / f64::from(STEPS);
        let [x, y] =
            [bar.left() + bar.width() * share as f32, bar.bottom() - bar.height() * share as f32];
        let across = if upright {
            [pos2(bar.left(), y), pos2(bar.right(), y)]
        } else {
            [pos2(x, bar.top()), pos2(x, bar.bottom())]
        };
        for place in across {
            mesh.colored_vertex(place, scale_colour(share));
        }
        if step > 0 {
            let first = 2 * (step - 1);
            mesh.add_triangle(first, first + 1, first + 3);
            mesh.add_triangle(first, first + 3, first + 2);
        }
    }
    painter.add(mesh);
}

fn scale_bar(painter: &Painter, rect: Rect, metres_a_point: f64, units: Units) {
    let a_point = units.of_metres(metres_a_point);
    let length = nice_below(a_point * 150.0);
    let width = (length / a_point) as f32;
    if !width.is_finite() || width < 4.0 {
        return;
    }
    let left = rect.left_bottom() + vec2(MARGIN + 2.0, -MARGIN - 4.0);
    let right = left + vec2(width, 0.0);
    let plate = Rect::from_min_max(left - vec2(8.0, 26.0), right + vec2(8.0, 8.0));
    painter.rect_filled(plate, 4.0, PLATE);
    let line = Stroke::new(1.5, INK);
    painter.line_segment([left, right], line);
    for end in [left, right] {
        painter.line_segment([end - vec2(0.0, 4.0), end + vec2(0.0, 4.0)], line);
    }
    let middle: Pos2 = left + (right - left) * 0.5;
    let text = match units.length_symbol() {
        "m" if length < 1.0 => format!("{:.0} cm", length * 100.0),
        symbol => format!("{} {symbol}", thousands(length, decimals(length))),
    };
    painter.text(
        middle - vec2(0.0, 13.0),
        Align2::CENTER_CENTER,
        text,
        FontId::proportional(12.0),
        INK,
    );
}

/// A number with a number of decimals and a thin space between thousands; zero is 0.
fn thousands(value: f64, places: usize) -> String {
    let text = if value == 0.0 { "0".to_owned() } else { format!("{value:.places$}") };
    let mut out = String::new();
    let whole = text.find('.').unwrap_or(text.len());
    for (index, digit) in text.char_indices() {
        if index > 0 && index < whole && (whole - index).is_multiple_of(3) && !out.ends_with('-') {
            out.push('\u{2009}');
        }
        out.push(digit);
    }
    out
}

/// Colour of a share of the top of the scale.
pub fn scale_colour(share: f64) -> Color32 {
    let [red, green, blue, _] = tension_colour(share).map(|part| (part * 255.0).round() as u8);
    Color32::from_rgb(red, green, blue)
}

/// A body larger than this on screen needs no name [points].
const LARGE: f64 = 36.0;
/// Distance from the middle of a body to its name [points].
const AWAY: f32 = 13.0;

const NAME_INK: Color32 = Color32::from_rgb(0xdf, 0xea, 0xec);
const NAME_PLATE: Color32 = Color32::from_black_alpha(120);

/// Writes the ids of small bodies beside them, without names that would overlap another.
pub fn paint_names(painter: &Painter, rect: Rect, camera: &Camera, model: &Model, frame: &Frame) {
    let size = DVec2::new(f64::from(rect.width()), f64::from(rect.height()));
    let mut taken: Vec<Rect> = Vec::new();
    for (body, at) in model.spec.bodies.iter().zip(&frame.bodies) {
        let Some(middle) = camera.project(at.0, size) else { continue };
        let outlines = silhouette(body, *at, camera, size).flatten();
        let across = outlines.map(|seen| seen.distance(middle)).fold(0.0, f64::max) * 2.0;
        let middle = rect.min + vec2(middle.x as f32, middle.y as f32);
        if across > LARGE || !rect.shrink(4.0).contains(middle) {
            continue;
        }
        let text = painter.layout_no_wrap(body.id.clone(), FontId::proportional(11.5), NAME_INK);
        let left = pos2(middle.x + AWAY, middle.y - text.size().y / 2.0);
        let plate = Rect::from_min_size(left, text.size()).expand2(vec2(4.0, 1.0));
        if taken.iter().any(|other| other.intersects(plate)) {
            continue;
        }
        painter.line_segment(
            [middle + vec2(5.0, 0.0), plate.left_center()],
            Stroke::new(1.0, NAME_INK.gamma_multiply(0.6)),
        );
        painter.rect_filled(plate, 3.0, NAME_PLATE);
        painter.text(left, Align2::LEFT_TOP, &body.id, FontId::proportional(11.5), NAME_INK);
        taken.push(plate);
    }
}

#[cfg(test)]
mod tests {

    use super::*;

    #[test]
    fn thousands_are_grouped() {
        assert_eq!(thousands(7560.0, 0), "7\u{2009}560");
        assert_eq!(thousands(1_700_000.0, 0), "1\u{2009}700\u{2009}000");
        assert_eq!(thousands(0.5, 1), "0.5");
        assert_eq!(thousands(200.0, 0), "200");
    }
}
