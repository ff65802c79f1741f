//! A flat map of the whale's skin: four views of the whale at rest, with a colour for each region. Panels show pressures and wraps on
//! it, and the user selects parts on it.

use std::collections::BTreeMap;
use std::sync::Arc;

use egui::epaint::{Mesh, Vertex, WHITE_UV};
use egui::{
    Align2, Color32, FontId, Painter, Pos2, Rect, Sense, Ui, Vec2, WidgetInfo, WidgetType, vec2,
};
use endline_sdk::Region;
use endline_sim::whale::Skin;
use endline_sim::{ContactPoint, DVec3};

use crate::gui::theme::Theme;

/// Direction from which the map shows the whale.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Face {
    /// From above, the snout to the right.
    Above,
    /// From below, the snout to the right.
    Below,
    /// Its port side, the snout to the left.
    Port,
    /// Its starboard side, the snout to the right.
    Starboard,
}

impl Face {
    /// All faces, in drawing order.
    pub const ALL: [Self; 4] = [Self::Above, Self::Below, Self::Port, Self::Starboard];

    /// Its name on screen.
    pub fn name(self) -> &'static str {
        match self {
            Self::Above => "from above, left is up",
            Self::Below => "from below, left is down",
            Self::Port => "left side",
            Self::Starboard => "right side",
        }
    }

    /// Unit vectors to the right, up and towards the eye, in the whale's frame (x to the snout, y to port, z up).
    fn axes(self) -> [DVec3; 3] {
        match self {
            Self::Above => [DVec3::X, DVec3::Y, DVec3::Z],
            Self::Below => [DVec3::X, DVec3::NEG_Y, DVec3::NEG_Z],
            Self::Port => [DVec3::NEG_X, DVec3::Z, DVec3::Y],
            Self::Starboard => [DVec3::X, DVec3::Z, DVec3::NEG_Y],
        }
    }
}

/// The triangles of a skin, sorted for drawing, for every face. One map serves a skin for good.
pub struct BodyMap {
    skin: Arc<Skin>,
    low: DVec3,
    high: DVec3,
    /// Triangles that face the eye, the farthest first, for each face.
    seen: [Vec<Seen>; 4],
    /// Last mesh of each face.
    drawn: [Option<Drawn>; 4],
}

/// Last mesh of a face, with the rectangle and the colours of the regions for which it was made.
type Drawn = (Rect, [Color32; REGIONS], Arc<Mesh>);

/// A triangle of skin on a face.
#[derive(Clone, Copy)]
struct Seen {
    /// Corners relative to the middle of the picture, in picture widths, y down.
    corners: [Vec2; 3],
    /// Index in the skin.
    triangle: u32,
    region: Region,
    /// Whether its centroid is to port.
    to_port: bool,
    /// Brightness [1].
    light: f32,
}

const REGIONS: usize = Region::ALL.len();

impl BodyMap {
    /// Makes the map of a skin at rest.
    pub fn of(skin: Arc<Skin>) -> Self {
        let low = skin.vertices.iter().copied().fold(DVec3::INFINITY, DVec3::min);
        let high = skin.vertices.iter().copied().fold(DVec3::NEG_INFINITY, DVec3::max);
        let mut map =
            Self { skin, low, high, seen: [const { Vec::new() }; 4], drawn: [const { None }; 4] };
        map.seen = Face::ALL.map(|face| map.seen_from(face));
        map
    }

    /// Whether this is the map of a skin.
    pub fn is_of(&self, skin: &Arc<Skin>) -> bool {
        Arc::ptr_eq(&self.skin, skin)
    }

    /// Height divided by width of a face.
    pub fn aspect(&self, face: Face) -> f32 {
        let [right, up, _] = face.axes();
        let size = self.high - self.low;
        (size.dot(up.abs()) / size.dot(right.abs()).max(1e-9)) as f32
    }

    fn place(&self, face: Face, rect: Rect, point: DVec3) -> Pos2 {
        rect.center() + self.flat(face, point) * rect.width()
    }

    /// A point relative to the middle of a face, in picture widths, y down.
    fn flat(&self, face: Face, point: DVec3) -> Vec2 {
        let [right, up, _] = face.axes();
        let middle = (self.low + self.high) * 0.5;
        let from_middle = (point - middle) / (self.high - self.low).dot(right.abs()).max(1e-9);
        vec2(from_middle.dot(right) as f32, -from_middle.dot(up) as f32)
    }

    fn seen_from(&self, face: Face) -> Vec<Seen> {
        let eye = face.axes()[2];
        let seen = |triangle: u32| {
            let corners = corners(&self.skin, triangle);
            let light = 0.55 + 0.45 * normal(corners).dot(eye).clamp(0.0, 1.0) as f32;
            let region = self.skin.regions[triangle as usize];
            let to_port = corners.iter().map(|corner| corner.y).sum::<f64>() > 0.0;
            let corners = corners.map(|corner| self.flat(face, corner));
            Seen { corners, triangle, region, to_port, light }
        };
        sorted(&self.skin, face).into_iter().map(seen).collect()
    }

    /// Returns the mesh of a face in a rectangle, with a colour for each region, lit from the eye. Reuses the last mesh where nothing has
    /// changed.
    pub fn mesh(
        &mut self,
        face: Face,
        rect: Rect,
        colour: impl Fn(Region) -> Color32,
    ) -> Arc<Mesh> {
        let colours = Region::ALL.map(colour);
        let drawn = self.drawn[face as usize]
            .as_ref()
            .filter(|(place, of, _)| *place == rect && *of == colours);
        if let Some((_, _, mesh)) = drawn {
            return Arc::clone(mesh);
        }
        let seen = &self.seen[face as usize];
        let mut mesh = Mesh::default();
        mesh.indices.extend(0..3 * u32::try_from(seen.len()).unwrap_or(0));
        mesh.vertices.reserve(3 * seen.len());
        for triangle in seen {
            let color = shade(colours[triangle.region as usize], triangle.light);
            let vertex = |corner: Vec2| Vertex {
                pos: rect.center() + corner * rect.width(),
                uv: WHITE_UV,
                color,
            };
            mesh.vertices.extend(triangle.corners.map(vertex));
        }
        let mesh = Arc::new(mesh);
        self.drawn[face as usize] = Some((rect, colours, Arc::clone(&mesh)));
        mesh
    }

    /// Position of a contact on a face; `None` if the contact is on the far side.
    pub fn contact(&self, face: Face, rect: Rect, contact: &ContactPoint) -> Option<Pos2> {
        let corners = self
            .skin
            .triangles
            .get(contact.triangle)?
            .map(|vertex| self.skin.vertices[vertex as usize]);
        let seen = normal(corners).dot(face.axes()[2]) > 0.0;
        let point =
            corners.iter().zip(contact.barycentric).map(|(corner, share)| *corner * share).sum();
        seen.then(|| self.place(face, rect, point))
    }
}

fn sorted(skin: &Skin, face: Face) -> Vec<u32> {
    let eye = face.axes()[2];
    let count = u32::try_from(skin.triangles.len()).unwrap_or(0);
    let mut seen: Vec<u32> =
        (0..count).filter(|triangle| normal(corners(skin, *triangle)).dot(eye) > 0.0).collect();
    let nearness =
        |triangle: u32| corners(skin, triangle).iter().map(|corner| corner.dot(eye)).sum::<f64>();
    seen.sort_by(|a, b| nearness(*a).total_cmp(&nearness(*b)));
    seen
}

fn corners(skin: &Skin, triangle: u32) -> [DVec3; 3] {
    skin.triangles[triangle as usize].map(|vertex| skin.vertices[vertex as usize])
}

fn normal([a, b, c]: [DVec3; 3]) -> DVec3 {
    (b - a).cross(c - a).normalize_or_zero()
}

fn shade(colour: Color32, light: f32) -> Color32 {
    let part = |value: u8| (f32::from(value) * light) as u8;
    Color32::from_rgb(part(colour.r()), part(colour.g()), part(colour.b()))
}

/// A line of an outline: its two ends relative to the middle of the picture, in picture widths, y down.
pub type Edge = [Vec2; 2];

impl BodyMap {
    /// The region at a point of a face; `None` beside the whale.
    pub fn hit(&self, face: Face, rect: Rect, place: Pos2) -> Option<Region> {
        let flat = (place - rect.center()) / rect.width();
        // The last triangle is the nearest to the eye.
        let mut seen = self.seen[face as usize].iter().rev();
        seen.find(|triangle| holds(triangle.corners, flat)).map(|triangle| triangle.region)
    }

    /// Centroid of the visible area of some regions on a face; `None` if none of it is visible. With `to_port`, only that side counts.
    pub fn middle(
        &self,
        face: Face,
        rect: Rect,
        is_it: impl Fn(Region) -> bool,
        to_port: Option<bool>,
    ) -> Option<Pos2> {
        let (mut sum, mut whole) = (Vec2::ZERO, 0.0);
        let side = |port: bool| to_port.is_none_or(|wanted| wanted == port);
        let seen = self.seen[face as usize].iter();
        for triangle in seen.filter(|triangle| is_it(triangle.region) && side(triangle.to_port)) {
            let [a, b, c] = triangle.corners;
            let area = cross(b - a, c - a).abs();
            sum += (a + b + c) / 3.0 * area;
            whole += area;
        }
        (whole > 0.0).then(|| rect.center() + sum / whole * rect.width())
    }

    /// Outline of the visible area of some regions on a face.
    pub fn outline(&self, face: Face, is_it: impl Fn(Region) -> bool) -> Vec<Edge> {
        let mut edges: BTreeMap<[u32; 2], (Edge, u32, u32)> = BTreeMap::new();
        for triangle in self.seen[face as usize].iter().filter(|seen| is_it(seen.region)) {
            let vertices = self.skin.triangles[triangle.triangle as usize];
            for (one, other) in [(0, 1), (1, 2), (2, 0)] {
                let (a, b) = (vertices[one], vertices[other]);
                let ends = [triangle.corners[one], triangle.corners[other]];
                let of = triangle.triangle;
                edges.entry([a.min(b), a.max(b)]).or_insert((ends, of, 0)).2 += 1;
            }
        }
        let border = edges.into_values().filter(|(.., count)| *count == 1);
        border
            .filter(|(edge, of, _)| self.is_seen(face, *edge, *of))
            .map(|(edge, ..)| edge)
            .collect()
    }

    /// Whether a triangle is the nearest to the eye close to one of its edges.
    fn is_seen(&self, face: Face, [one, other]: Edge, triangle: u32) -> bool {
        let seen = &self.seen[face as usize];
        let Some(own) = seen.iter().find(|seen| seen.triangle == triangle) else { return false };
        let middle = own.corners.iter().fold(Vec2::ZERO, |sum, corner| sum + *corner / 3.0);
        let inside = (one + other) * 0.45 + middle * 0.1;
        let nearest = seen.iter().rev().find(|seen| holds(seen.corners, inside));
        nearest.is_some_and(|nearest| nearest.triangle == triangle)
    }
}

fn cross(one: Vec2, other: Vec2) -> f32 {
    one.x * other.y - one.y * other.x
}

/// Whether a triangle contains a point, for either order of its corners.
fn holds([a, b, c]: [Vec2; 3], point: Vec2) -> bool {
    let sides = [(a, b), (b, c), (c, a)].map(|(from, to)| cross(to - from, point - from));
    sides.iter().all(|side| *side >= 0.0) || sides.iter().all(|side| *side <= 0.0)
}

/// Height of the name above a face [points].
const NAME: f32 = 16.0;

impl BodyMap {
    /// Colour of skin without a value.
    pub fn plain(ui: &Ui) -> Color32 {
        if ui.visuals().dark_mode {
            Color32::from_rgb(0x6d, 0x7b, 0x84)
        } else {
            Color32::from_rgb(0xb4, 0xc0, 0xc7)
        }
    }

    /// Draws every face with a colour for each region, and calls `over` to draw on top. Returns the region under the pointer and whether
    /// it was clicked.
    pub fn faces(
        &mut self,
        ui: &mut Ui,
        sense: Sense,
        colour: impl Fn(Region) -> Color32,
        over: impl Fn(&Self, &Painter, Face, Rect),
    ) -> Option<(Region, bool)> {
        let mut at = None;
        let width = (ui.available_width() - 16.0) / 2.0;
        for faces in Face::ALL.chunks(2) {
            let heights = faces.iter().map(|face| width * self.aspect(*face));
            let size = vec2(width, heights.fold(0.0, f32::max) + NAME + 2.0);
            ui.horizontal(|ui| {
                for face in faces {
                    let (rect, response) = ui.allocate_exact_size(size, sense);
                    if !ui.is_rect_visible(rect) {
                        continue;
                    }
                    let label = || WidgetInfo::labeled(WidgetType::Image, true, face.name());
                    response.widget_info(label);
                    let below = rect.with_min_y(rect.top() + NAME).shrink(2.0);
                    self.face(ui, *face, rect, below, &colour);
                    over(self, &ui.painter_at(rect), *face, below);
                    let pointer = response.hover_pos();
                    let region = pointer.and_then(|pointer| self.hit(*face, below, pointer));
                    at = region.map(|region| (region, response.clicked())).or(at);
                }
            });
        }
        at
    }

    fn face(
        &mut self,
        ui: &Ui,
        face: Face,
        rect: Rect,
        below: Rect,
        colour: &impl Fn(Region) -> Color32,
    ) {
        let painter = ui.painter_at(rect);
        let faint = Theme::palette_of(ui).faint;
        let font = FontId::proportional(11.0);
        painter.text(rect.left_top(), Align2::LEFT_TOP, face.name(), font, faint);
        painter.add(self.mesh(face, below, colour));
    }
}
