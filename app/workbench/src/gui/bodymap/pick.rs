//! What lies where on a face: the region under the pointer, the middle of a part, and its outline.

use std::collections::BTreeMap;

use egui::{Pos2, Rect, Vec2};
use endline_sdk::Region;

use super::{BodyMap, Face};

/// A line of an outline: its ends from the middle of the picture, in widths of it, y down.
pub type Edge = [Vec2; 2];

impl BodyMap {
    /// The region at a place of a face; `None` beside the whale.
    #[must_use]
    pub fn hit(&self, face: Face, rect: Rect, place: Pos2) -> Option<Region> {
        let flat = (place - rect.center()) / rect.width();
        // The nearest to the eye comes last.
        let mut seen = self.seen[face as usize].iter().rev();
        seen.find(|triangle| holds(triangle.corners, flat)).map(|triangle| triangle.region)
    }

    /// The middle of what a face shows of some regions, on one side where `to_port` says which; `None` where it shows nothing of them.
    #[must_use]
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

    /// The outline of what a face shows of some regions; what lies behind other skin is left out.
    #[must_use]
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

    /// Whether a triangle is the nearest to the eye just inside one of its edges.
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

/// Whether a triangle holds a point, in either sense of rotation.
fn holds([a, b, c]: [Vec2; 3], point: Vec2) -> bool {
    let sides = [(a, b), (b, c), (c, a)].map(|(from, to)| cross(to - from, point - from));
    sides.iter().all(|side| *side >= 0.0) || sides.iter().all(|side| *side <= 0.0)
}
