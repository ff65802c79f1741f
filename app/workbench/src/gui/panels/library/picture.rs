//! Pictures of traps, buoys and anchors, drawn from their figures at a common scale.

use egui::{Color32, Painter, Pos2, Rect, Sense, Shape, Stroke, Ui, pos2, vec2};
use endline_gear::{Kind, units};
use endline_session::edit::Documents;

use crate::gui::theme::{Palette, Theme};

/// Length across a picture [m].
const WIDE_M: f32 = 1.6;

/// Whether entries of a kind have a picture.
pub(in super::super) fn has(kind: Kind) -> bool {
    matches!(kind, Kind::Trap | Kind::Buoy | Kind::Anchor)
}

/// Draws an entry in a box of a size.
pub(in super::super) fn show(
    ui: &mut Ui,
    documents: &Documents,
    kind: Kind,
    path: &str,
    size: egui::Vec2,
) -> egui::Response {
    let (rect, response) = ui.allocate_exact_size(size, Sense::click());
    let palette = Theme::palette_of(ui);
    let painter = ui.painter_at(rect);
    painter.rect_filled(rect, 4.0, palette.field);
    match kind {
        Kind::Buoy => buoy(&painter, rect, palette, documents, path),
        _ => a_box(&painter, rect, palette, documents, path),
    }
    response
}

/// A length of an entry [m].
fn metres(documents: &Documents, path: &str, key: &str) -> Option<f32> {
    let field = Kind::ALL.iter().copied().flat_map(Kind::fields).find(|field| field.key == key)?;
    Some(units::parse(&documents.field(path, key)?, field.quantity).ok()? as f32)
}

/// Points per metre; less for an entry that would not fit.
fn scale(rect: Rect, wide_m: f32, high_m: f32) -> f32 {
    let room = rect.shrink(8.0);
    (rect.width() / WIDE_M)
        .min(room.width() / wide_m.max(0.01))
        .min(room.height() / high_m.max(0.01))
}

/// Draws a trap or anchor as a box with mesh.
fn a_box(painter: &Painter, rect: Rect, palette: Palette, documents: &Documents, path: &str) {
    let [length, width, height] =
        ["length", "width", "height"].map(|key| metres(documents, path, key).unwrap_or(0.3));
    // Cabinet projection: depth is drawn at 45 degrees and half scale.
    let back = width * 0.5 * std::f32::consts::FRAC_1_SQRT_2;
    let scale = scale(rect, length + back, height + back);
    let low_left =
        rect.center() + vec2(-(length + back) * scale / 2.0, (height + back) * scale / 2.0);
    let at = |x: f32, y: f32, z: f32| {
        low_left + vec2(x * length + y * back, -(z * height + y * back)) * scale
    };
    let face = |corners: [Pos2; 4], strength: f32| {
        let fill = palette.accent.gamma_multiply(strength);
        painter.add(Shape::convex_polygon(corners.to_vec(), fill, Stroke::new(1.4, palette.text)));
    };
    face([at(0.0, 0.0, 0.0), at(1.0, 0.0, 0.0), at(1.0, 0.0, 1.0), at(0.0, 0.0, 1.0)], 0.18);
    face([at(0.0, 0.0, 1.0), at(1.0, 0.0, 1.0), at(1.0, 1.0, 1.0), at(0.0, 1.0, 1.0)], 0.30);
    face([at(1.0, 0.0, 0.0), at(1.0, 1.0, 0.0), at(1.0, 1.0, 1.0), at(1.0, 0.0, 1.0)], 0.10);
    let mesh = Stroke::new(0.6, palette.faint);
    for part in 1..6 {
        let share = part as f32 / 6.0;
        painter.line_segment([at(share, 0.0, 0.0), at(share, 0.0, 1.0)], mesh);
        painter.line_segment([at(share, 0.0, 1.0), at(share, 1.0, 1.0)], mesh);
        painter.line_segment([at(0.0, 0.0, share), at(1.0, 0.0, share)], mesh);
    }
}

/// Draws a buoy: its float, half in water, and the line below.
fn buoy(painter: &Painter, rect: Rect, palette: Palette, documents: &Documents, path: &str) {
    let diameter = metres(documents, path, "diameter").unwrap_or(0.2);
    let shape = documents.field(path, "shape").unwrap_or_default();
    let length =
        metres(documents, path, "length").filter(|_| shape != "sphere").unwrap_or(diameter);
    let scale = scale(rect, diameter, length);
    let (half_wide, half_high) = (diameter * scale / 2.0, length * scale / 2.0);
    let centre = rect.center();
    painter.line_segment(
        [pos2(rect.left(), centre.y), pos2(rect.right(), centre.y)],
        Stroke::new(1.0, palette.accent),
    );
    painter.line_segment([centre, pos2(centre.x, rect.bottom())], Stroke::new(1.4, palette.faint));
    let fill = Color32::from_rgb(0xd5, 0x5e, 0x00);
    let outline = Stroke::new(1.2, palette.text);
    let body = Rect::from_center_size(centre, vec2(2.0 * half_wide, 2.0 * half_high));
    let corner = match shape.as_str() {
        "cylinder" => 2.0,
        "bullet" => half_wide.min(half_high).min(250.0),
        _ => {
            let turn = |step: i32| f64::from(step) * std::f64::consts::TAU / 48.0;
            let point = |step: i32| {
                centre
                    + vec2(half_wide * turn(step).cos() as f32, half_high * turn(step).sin() as f32)
            };
            painter.add(Shape::convex_polygon((0..48).map(point).collect(), fill, outline));
            return;
        }
    };
    painter.rect(body, corner, fill, outline, egui::StrokeKind::Inside);
}
