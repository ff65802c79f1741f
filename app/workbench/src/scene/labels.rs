//! Names of buoys, traps and anchors that look too small to be known by their shape.

use egui::{Align2, Color32, FontId, Painter, Rect, Stroke, pos2, vec2};
use endline_sim::{Frame, Model};
use glam::DVec2;

use super::camera::Camera;
use super::silhouette::silhouette;

/// A body that looks larger than this needs no name [points].
const LARGE: f64 = 36.0;
/// From the middle of a body to its name [points].
const AWAY: f32 = 13.0;

const INK: Color32 = Color32::from_rgb(0xdf, 0xea, 0xec);
const PLATE: Color32 = Color32::from_black_alpha(120);

/// Writes the ids of small bodies beside them; a name that would lie on another is left out.
pub fn paint(painter: &Painter, rect: Rect, camera: &Camera, model: &Model, frame: &Frame) {
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
        let text = painter.layout_no_wrap(body.id.clone(), FontId::proportional(11.5), INK);
        let left = pos2(middle.x + AWAY, middle.y - text.size().y / 2.0);
        let plate = Rect::from_min_size(left, text.size()).expand2(vec2(4.0, 1.0));
        if taken.iter().any(|other| other.intersects(plate)) {
            continue;
        }
        painter.line_segment(
            [middle + vec2(5.0, 0.0), plate.left_center()],
            Stroke::new(1.0, INK.gamma_multiply(0.6)),
        );
        painter.rect_filled(plate, 3.0, PLATE);
        painter.text(left, Align2::LEFT_TOP, &body.id, FontId::proportional(11.5), INK);
        taken.push(plate);
    }
}
