//! The whale's skin laid flat: four views of it at rest, each region in a colour, for pressures and wraps to be read off and parts to
//! be chosen.

mod faces;
mod pick;

use std::sync::Arc;

use egui::epaint::{Mesh, Vertex, WHITE_UV};
use egui::{Color32, Pos2, Rect, Vec2, vec2};
use endline_sdk::Region;
use endline_sim::whale::Skin;
use endline_sim::{ContactPoint, DVec3};

pub use pick::Edge;

/// From where the whale is looked at.
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
    /// Every face, in the order drawn.
    pub const ALL: [Self; 4] = [Self::Above, Self::Below, Self::Port, Self::Starboard];

    /// Its name.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Above => "from above, left is up",
            Self::Below => "from below, left is down",
            Self::Port => "left side",
            Self::Starboard => "right side",
        }
    }

    /// Right and up of the picture, and towards the eye, in the whale's frame (x to the snout, y to port, z up).
    fn axes(self) -> [DVec3; 3] {
        match self {
            Self::Above => [DVec3::X, DVec3::Y, DVec3::Z],
            Self::Below => [DVec3::X, DVec3::NEG_Y, DVec3::NEG_Z],
            Self::Port => [DVec3::NEG_X, DVec3::Z, DVec3::Y],
            Self::Starboard => [DVec3::X, DVec3::Z, DVec3::NEG_Y],
        }
    }
}

/// The skin sorted for drawing from every face; made once for a skin.
pub struct BodyMap {
    skin: Arc<Skin>,
    low: DVec3,
    high: DVec3,
    /// Triangles that face the eye, the farthest first.
    seen: [Vec<Seen>; 4],
    /// What was drawn last of each face, and where and in which colours.
    drawn: [Option<Drawn>; 4],
}

/// A face as it was drawn last: where, in which colours of the regions, and its triangles.
type Drawn = (Rect, [Color32; REGIONS], Arc<Mesh>);

/// A triangle as a face shows it.
#[derive(Clone, Copy)]
struct Seen {
    /// Corners from the middle of the picture, in widths of it, y down.
    corners: [Vec2; 3],
    /// Its place in the skin.
    triangle: u32,
    region: Region,
    /// Whether its middle lies to port.
    to_port: bool,
    /// How it is lit [1].
    light: f32,
}

const REGIONS: usize = Region::ALL.len();

impl BodyMap {
    /// Of a skin at rest.
    #[must_use]
    pub fn of(skin: Arc<Skin>) -> Self {
        let low = skin.vertices.iter().copied().fold(DVec3::INFINITY, DVec3::min);
        let high = skin.vertices.iter().copied().fold(DVec3::NEG_INFINITY, DVec3::max);
        let mut map =
            Self { skin, low, high, seen: [const { Vec::new() }; 4], drawn: [const { None }; 4] };
        map.seen = Face::ALL.map(|face| map.seen_from(face));
        map
    }

    /// Whether it is of this skin.
    #[must_use]
    pub fn is_of(&self, skin: &Arc<Skin>) -> bool {
        Arc::ptr_eq(&self.skin, skin)
    }

    /// Height over width of a face.
    #[must_use]
    pub fn aspect(&self, face: Face) -> f32 {
        let [right, up, _] = face.axes();
        let size = self.high - self.low;
        (size.dot(up.abs()) / size.dot(right.abs()).max(1e-9)) as f32
    }

    fn place(&self, face: Face, rect: Rect, point: DVec3) -> Pos2 {
        rect.center() + self.flat(face, point) * rect.width()
    }

    /// A place from the middle of a face's picture, in widths of it, y down.
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

    /// A face in a rectangle, each region in its colour, lit from the eye; the same as last where nothing has changed.
    #[must_use]
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

    /// Where a contact lies on a face; `None` where it is on the far side.
    #[must_use]
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
