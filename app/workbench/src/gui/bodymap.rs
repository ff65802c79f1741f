//! The whale's skin laid flat: four views of it at rest, each part in a colour, for pressures and wraps to be read off.

use std::sync::Arc;

use egui::epaint::{Mesh, Vertex, WHITE_UV};
use egui::{Color32, Pos2, Rect, pos2};
use endline_sdk::BodyPart;
use endline_sim::whale::Skin;
use endline_sim::{ContactPoint, DVec3};

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
            Self::Above => "from above",
            Self::Below => "from below",
            Self::Port => "port side",
            Self::Starboard => "starboard side",
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
    sorted: [Vec<u32>; 4],
}

impl BodyMap {
    /// Of a skin at rest.
    #[must_use]
    pub fn of(skin: Arc<Skin>) -> Self {
        let low = skin.vertices.iter().copied().fold(DVec3::INFINITY, DVec3::min);
        let high = skin.vertices.iter().copied().fold(DVec3::NEG_INFINITY, DVec3::max);
        let sorted = Face::ALL.map(|face| sorted(&skin, face));
        Self { skin, low, high, sorted }
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
        let [right, up, _] = face.axes();
        let middle = (self.low + self.high) * 0.5;
        let scale = f64::from(rect.width()) / (self.high - self.low).dot(right.abs()).max(1e-9);
        let from_middle = (point - middle) * scale;
        pos2(rect.center().x + from_middle.dot(right) as f32, rect.center().y - from_middle.dot(up) as f32)
    }

    /// A face in a rectangle, each part in its colour, lit from the eye.
    #[must_use]
    pub fn mesh(&self, face: Face, rect: Rect, colour: impl Fn(BodyPart) -> Color32) -> Mesh {
        let eye = face.axes()[2];
        let colours = BodyPart::ALL.map(colour);
        let mut mesh = Mesh::default();
        for triangle in &self.sorted[face as usize] {
            let corners = self.skin.triangles[*triangle as usize].map(|vertex| self.skin.vertices[vertex as usize]);
            let light = normal(corners).dot(eye).clamp(0.0, 1.0);
            let part = self.skin.regions[*triangle as usize].part();
            let lit = shade(colours[part as usize], 0.55 + 0.45 * light as f32);
            let first = mesh.vertices.len() as u32;
            mesh.vertices.extend(corners.map(|corner| Vertex { pos: self.place(face, rect, corner), uv: WHITE_UV, color: lit }));
            mesh.indices.extend([first, first + 1, first + 2]);
        }
        mesh
    }

    /// Where a contact lies on a face; `None` where it is on the far side.
    #[must_use]
    pub fn contact(&self, face: Face, rect: Rect, contact: &ContactPoint) -> Option<Pos2> {
        let corners = self.skin.triangles.get(contact.triangle)?.map(|vertex| self.skin.vertices[vertex as usize]);
        let seen = normal(corners).dot(face.axes()[2]) > 0.0;
        let point = corners.iter().zip(contact.barycentric).map(|(corner, share)| *corner * share).sum();
        seen.then(|| self.place(face, rect, point))
    }
}

fn sorted(skin: &Skin, face: Face) -> Vec<u32> {
    let eye = face.axes()[2];
    let corners = |triangle: u32| skin.triangles[triangle as usize].map(|vertex| skin.vertices[vertex as usize]);
    let count = u32::try_from(skin.triangles.len()).unwrap_or(0);
    let mut seen: Vec<u32> = (0..count).filter(|triangle| normal(corners(*triangle)).dot(eye) > 0.0).collect();
    let nearness = |triangle: u32| corners(triangle).iter().map(|corner| corner.dot(eye)).sum::<f64>();
    seen.sort_by(|a, b| nearness(*a).total_cmp(&nearness(*b)));
    seen
}

fn normal([a, b, c]: [DVec3; 3]) -> DVec3 {
    (b - a).cross(c - a).normalize_or_zero()
}

fn shade(colour: Color32, light: f32) -> Color32 {
    let part = |value: u8| (f32::from(value) * light) as u8;
    Color32::from_rgb(part(colour.r()), part(colour.g()), part(colour.b()))
}
