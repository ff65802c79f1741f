//! The start of the whale, dragged in the 3-D view by three handles: horizontally, vertically, and its heading.

use egui::{
    Color32, CursorIcon, FontId, Painter, Pos2, Rect, Sense, Stroke, Ui, Vec2, WidgetInfo,
    WidgetType, vec2,
};
use endline_gear::units::{Quantity, find, parse};
use endline_gear::{Document, Setting};
use endline_session::command::RunAction;
use endline_session::edit::Documents;
use endline_session::encounters::meet::{Path, path};
use endline_session::units::{Units, bearing_degrees};
use endline_sim::Model;
use glam::{DVec2, DVec3};

use super::pane::Pane;
use crate::gui::shared::Shared;
use crate::scene::Camera;

/// Half the size of the active area of a handle [points].
const GRIP: f32 = 11.0;
/// Length if the scenario has none [m].
const USUAL_LENGTH_M: f64 = 13.0;
/// Length of the dashes of the path [m].
const DASH_M: f64 = 0.7;
/// Time for which the path is drawn if it passes no rope [s].
const BEYOND_S: f64 = 30.0;
const INK: Color32 = Color32::from_rgb(0xff, 0xc9, 0x7a);

/// The start of a whale.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Start {
    /// Position of mid-body: east, north, up [m].
    pub place: DVec3,
    /// Compass bearing of the snout [rad].
    pub heading: f64,
    /// Length of the body [m].
    pub length_m: f64,
}

/// A handle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Handle {
    /// Moves the start horizontally.
    Place,
    /// Moves the start vertically.
    Depth,
    /// Rotates the heading.
    Heading,
}

impl Start {
    /// Reads the start from the scenario; `None` if it has no whale or a value is invalid.
    pub fn of(documents: &Documents) -> Option<Self> {
        let field = |key: &str| documents.field(Documents::SCENARIO, &format!("whale.{key}"));
        let read = |key: &str, quantity| field(key).and_then(|text| parse(&text, quantity).ok());
        let place = DVec3::new(
            read("position.0", Quantity::Length)?,
            read("position.1", Quantity::Length)?,
            -read("depth", Quantity::Length)?,
        );
        let heading = read("heading", Quantity::Angle).unwrap_or(std::f64::consts::FRAC_PI_2);
        Some(Self {
            place,
            heading,
            length_m: read("length", Quantity::Length).unwrap_or(USUAL_LENGTH_M),
        })
    }

    /// Writes the start to the scenario, keeping the unit of each value.
    pub fn write(&self, document: &mut Document) -> Result<(), String> {
        let message = |error: endline_gear::EditError| error.to_string();
        let places = [self.place.x, self.place.y].into_iter().enumerate();
        let places: Vec<String> = places
            .map(|(axis, at_m)| {
                as_written(document, &format!("position.{axis}"), at_m, Quantity::Length)
            })
            .collect();
        document.put("whale.position", &Setting::texts(&places)).map_err(message)?;
        let depth = as_written(document, "depth", -self.place.z, Quantity::Length);
        document.put("whale.depth", &Setting::text(&depth)).map_err(message)?;
        let degrees = (self.heading.to_degrees().rem_euclid(360.0) * 10.0).round() / 10.0;
        document
            .put("whale.heading", &Setting::text(&format!("{} deg", degrees.rem_euclid(360.0))))
            .map_err(message)
    }

    fn ahead(&self) -> DVec3 {
        DVec3::new(self.heading.sin(), self.heading.cos(), 0.0)
    }

    /// Position of a handle.
    pub fn handle(&self, handle: Handle) -> DVec3 {
        match handle {
            Handle::Place => self.place,
            Handle::Depth => self.place + DVec3::Z * (0.35 * self.length_m),
            Handle::Heading => self.place + self.ahead() * (0.7 * self.length_m),
        }
    }

    /// Returns the start after a handle was dragged to a ray from the eye.
    pub fn dragged(self, handle: Handle, eye: DVec3, along: DVec3, right: DVec3) -> Self {
        match handle {
            Handle::Place => Self { place: horizontally(self.place, eye, along, right), ..self },
            Handle::Depth => {
                let up_m =
                    vertically(self.handle(Handle::Depth), eye, along) - 0.35 * self.length_m;
                Self { place: DVec3::new(self.place.x, self.place.y, up_m.min(0.0)), ..self }
            }
            Handle::Heading => {
                let to = horizontally(self.handle(Handle::Heading), eye, along, right) - self.place;
                Self { heading: bearing_degrees(to.x, to.y).to_radians(), ..self }
            }
        }
    }
}

/// A value in the unit of a field of the whale, rounded to a hundredth of the unit.
fn as_written(document: &Document, key: &str, value: f64, quantity: Quantity) -> String {
    let text = document.get(&format!("whale.{key}")).unwrap_or_default();
    let name = text.trim_start_matches(|letter: char| !letter.is_alphabetic());
    let (factor, name) =
        find(name, quantity).map_or((1.0, "m"), |unit| (unit.factor(), unit.name()));
    format!("{} {name}", (value / factor * 100.0).round() / 100.0 + 0.0)
}

/// Intersection of a ray with the horizontal plane through a place. If the plane is seen edge on, it moves only to the right and left.
fn horizontally(place: DVec3, eye: DVec3, along: DVec3, right: DVec3) -> DVec3 {
    if along.z.abs() > 0.06 {
        let away_m = (place.z - eye.z) / along.z;
        if away_m > 0.0 {
            return eye + along * away_m;
        }
    }
    let level = DVec3::new(right.x, right.y, 0.0).normalize_or_zero();
    // Use the vertical plane through the place that faces the eye.
    let facing = level.cross(DVec3::Z);
    let away_m = (place - eye).dot(facing) / along.dot(facing);
    if away_m.is_finite() {
        place + level * (eye + along * away_m - place).dot(level)
    } else {
        place
    }
}

/// Height at which a ray is nearest to the vertical line through a place [m].
fn vertically(place: DVec3, eye: DVec3, along: DVec3) -> f64 {
    let level = DVec3::new(along.x, along.y, 0.0);
    let facing = level.length_squared();
    if facing < 1e-4 {
        return place.z;
    }
    eye.z + along.z * (place - eye).dot(level) / facing
}

/// Draws the start with its handles in a pane and handles dragging.
pub(super) fn show(
    ui: &mut Ui,
    held: &mut Option<Start>,
    shared: &mut Shared,
    pane: Pane,
    camera: &Camera,
) {
    let Pane { rect, slot, .. } = pane;
    let Some(written) = Start::of(shared.documents()).filter(|_| shared.posing) else {
        return;
    };
    let start = held.unwrap_or(written);
    let sheet = Sheet { painter: ui.painter().with_clip_rect(rect), rect, camera };
    sheet.body(&start);
    let units = shared.workbench.preferences().units;
    if let Some(view) = shared.workbench.view()
        && let Some(path) = path(&view.model, &view.frame, start.place, start.heading)
    {
        sheet.path(&start, &path, &view.model, units);
    }
    let mut moved = None;
    for (handle, name) in [
        (Handle::Place, "Start place"),
        (Handle::Depth, "Start depth"),
        (Handle::Heading, "Start heading"),
    ] {
        let Some(at) = sheet.place(start.handle(handle)) else { continue };
        // Seen from above, the vertical handle coincides with the square and is hidden.
        let hidden = handle != Handle::Place
            && sheet.place(start.place).is_some_and(|middle| middle.distance(at) < 2.0 * GRIP);
        if hidden {
            continue;
        }
        let response = ui.interact(
            Rect::from_center_size(at, Vec2::splat(2.0 * GRIP)),
            ui.id().with((name, slot)),
            Sense::drag(),
        );
        response.widget_info(|| WidgetInfo::labeled(WidgetType::Other, true, name));
        let active = response.hovered() || response.dragged();
        sheet.handle(handle, at, active);
        if active {
            ui.ctx().set_cursor_icon(CursorIcon::Grab);
            sheet.label_start(&start, at, units);
        }
        if let Some(pointer) = response.interact_pointer_pos().filter(|_| response.dragged()) {
            let (eye, along) = sheet.ray(pointer);
            moved = Some(start.dragged(handle, eye, along, camera.axes().0));
        }
        if response.drag_stopped() {
            *held = None;
            write_start(shared, &start);
            return;
        }
    }
    *held = moved.or(*held);
}

/// Writes the start as one edit; applies it immediately if the run has not started.
pub(in crate::gui::panels) fn write_start(shared: &mut Shared, start: &Start) {
    if !shared.alter(Documents::SCENARIO, |document| start.write(document)) {
        return;
    }
    if shared.workbench.view().is_some_and(|view| view.newest_s <= 0.0) {
        shared.give(RunAction::Apply);
    }
}

/// A picture to draw on.
struct Sheet<'a> {
    painter: Painter,
    rect: Rect,
    camera: &'a Camera,
}

impl Sheet<'_> {
    fn size(&self) -> DVec2 {
        DVec2::new(f64::from(self.rect.width()), f64::from(self.rect.height()))
    }

    fn place(&self, place: DVec3) -> Option<Pos2> {
        let at = self.camera.project(place, self.size())?;
        Some(self.rect.min + vec2(at.x as f32, at.y as f32))
    }

    fn ray(&self, at: Pos2) -> (DVec3, DVec3) {
        let from = at - self.rect.min;
        self.camera.ray(DVec2::new(f64::from(from.x), f64::from(from.y)), self.size())
    }

    fn line(&self, from: DVec3, to: DVec3, width: f32) {
        if let (Some(from), Some(to)) = (self.place(from), self.place(to)) {
            self.painter.line_segment([from, to], Stroke::new(width, INK));
        }
    }

    /// Draws the outline of the whale from above, its flukes, and lines to its handles.
    fn body(&self, start: &Start) {
        let (ahead, length_m) = (start.ahead(), start.length_m);
        let port = DVec3::Z.cross(ahead);
        let outline =
            [(0.5, 0.0), (0.3, 0.1), (0.0, 0.12), (-0.3, 0.05), (-0.46, 0.0), (-0.5, 0.16)];
        for side in [-1.0, 1.0] {
            let places = outline
                .map(|(along, out)| start.place + (ahead * along + port * (side * out)) * length_m);
            places.windows(2).for_each(|pair| self.line(pair[0], pair[1], 1.5));
        }
        self.line(start.place, start.handle(Handle::Heading), 1.0);
        self.line(start.place, start.handle(Handle::Depth), 1.0);
        self.line(start.place, DVec3::new(start.place.x, start.place.y, 0.0), 0.5);
    }

    /// Draws the path over the ground, dashed, and the nearest rope on it with its distance from mid-body.
    fn path(&self, start: &Start, path: &Path, model: &Model, units: Units) {
        let speed_m_s = path.velocity_m_s.length();
        let until_s = path.nearest.as_ref().map_or(BEYOND_S, |nearest| nearest.after_s + 2.0);
        let dashes = (until_s * speed_m_s / (2.0 * DASH_M)).ceil().min(200.0) as u32;
        let at = |way_m: f64| start.place + path.velocity_m_s * (way_m / speed_m_s);
        for dash in 0..dashes {
            let way_m = 2.0 * DASH_M * f64::from(dash);
            self.line(at(way_m), at(way_m + DASH_M), 1.5);
        }
        let Some(nearest) = &path.nearest else { return };
        let passes = at(nearest.after_s * speed_m_s);
        self.line(passes, nearest.place_m, 1.0);
        if let Some(at) = self.place(passes) {
            let text = format!(
                "passes {} from {}, {} deep, after {:.0} s",
                units.length(nearest.distance_m),
                model.spec.lines[nearest.line].id,
                units.depth(-nearest.place_m.z),
                nearest.after_s
            );
            self.label(text, at);
        }
    }

    fn handle(&self, handle: Handle, at: Pos2, active: bool) {
        let size = if active { 8.0 } else { 6.0 };
        let edge = Stroke::new(1.5, Color32::BLACK);
        match handle {
            Handle::Place => self.painter.rect(
                Rect::from_center_size(at, Vec2::splat(2.0 * size)),
                2.0,
                INK,
                edge,
                egui::StrokeKind::Middle,
            ),
            _ => self.painter.circle(at, size, INK, edge),
        };
    }

    fn label_start(&self, start: &Start, at: Pos2, units: Units) {
        let DVec3 { x, y, z } = start.place;
        let degrees = start.heading.to_degrees().rem_euclid(360.0);
        let text = format!(
            "east {}, north {}, depth {}, heading {degrees:.0}°",
            units.length(x),
            units.length(y),
            units.depth(-z)
        );
        self.label(text, at);
    }

    /// Draws a text on a dark plate beside a place on screen.
    fn label(&self, text: String, at: Pos2) {
        let galley = self.painter.layout_no_wrap(text, FontId::proportional(12.5), INK);
        let wanted = at + vec2(14.0, 12.0);
        let left =
            wanted.x.min(self.rect.right() - galley.size().x - 8.0).max(self.rect.left() + 8.0);
        let plate =
            Rect::from_min_size(Pos2::new(left, wanted.y), galley.size()).expand2(vec2(6.0, 3.0));
        self.painter.rect_filled(plate, 4.0, Color32::from_black_alpha(180));
        self.painter.galley(Pos2::new(left, wanted.y), galley, INK);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const START: Start =
        Start { place: DVec3::new(10.0, -20.0, -12.0), heading: 0.0, length_m: 13.0 };
    const SIZE: DVec2 = DVec2::new(800.0, 600.0);

    /// The ray through a place on screen.
    fn through(camera: &Camera, place: DVec3) -> (DVec3, DVec3) {
        camera.ray(camera.project(place, SIZE).unwrap(), SIZE)
    }

    #[test]
    fn a_handle_follows_the_pointer() {
        let camera =
            Camera { target: START.place, distance_m: 60.0, elevation: 0.5, ..Camera::default() };
        let right = camera.axes().0;
        let to = DVec3::new(16.0, -9.0, -12.0);
        let (eye, along) = through(&camera, to);
        assert!((START.dragged(Handle::Place, eye, along, right).place - to).length() < 1e-9);
        let up = DVec3::new(10.0, -20.0, -5.0);
        let (eye, along) = through(&camera, up + DVec3::Z * (0.35 * 13.0));
        assert!((START.dragged(Handle::Depth, eye, along, right).place - up).length() < 1e-6);
        let east = START.place + DVec3::X * 4.0;
        let (eye, along) = through(&camera, east);
        assert!(
            (START.dragged(Handle::Heading, eye, along, right).heading.to_degrees() - 90.0).abs()
                < 1e-9
        );
    }

    #[test]
    fn in_a_plane_seen_edge_on_a_drag_moves_only_to_the_right_and_left() {
        let camera = Camera {
            target: START.place,
            distance_m: 60.0,
            azimuth: -std::f64::consts::FRAC_PI_2,
            elevation: 0.0,
            ..Camera::default()
        };
        let (eye, along) = through(&camera, START.place + DVec3::new(5.0, 0.0, 1.0));
        let to = START.dragged(Handle::Place, eye, along, camera.axes().0).place;
        assert!((to - DVec3::new(15.0, -20.0, -12.0)).length() < 1e-6, "{to}");
    }

    #[test]
    fn values_keep_their_units() {
        let text = "[whale]\nposition = [\"30 ft\", \"1 m\"]\ndepth = \"5 fathom\"\n";
        let mut document = Document::parse(text).unwrap();
        Start { place: DVec3::new(6.096, -2.5, -18.288), heading: 1.0, length_m: 13.0 }
            .write(&mut document)
            .unwrap();
        let read = |key: &str| document.get(&format!("whale.{key}")).unwrap();
        assert_eq!(
            [read("position.0"), read("position.1"), read("depth"), read("heading")],
            ["20 ft", "-2.5 m", "10 fathom", "57.3 deg"]
        );
    }
}
