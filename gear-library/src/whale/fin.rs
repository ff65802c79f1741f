//! Fins: their section (a flat lens with rounded edges), their tips, and the measured radius of edges of a skin.
//!
//! The radius about which rope bends at the edge of a skin is
//!
//! ```text
//! r = (h₁ + h₂)/2 / (2 sin(θ/2))
//! ```
//!
//! with the angle `θ` between two adjacent triangles and their heights `h` over the common side. For a prism around a circle
//! of radius `r` the formula is exact for any number of sides. Concave sides do not count.

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use endline_sdk::Region;
use endline_sim::whale::Skin;
use glam::{DVec2, DVec3};

/// Least half chord and half thickness, so that any form has a section [m].
const LEAST_M: f64 = 1e-6;

/// One section of a fin in its own plane: `x` ahead along the chord, `z` across the thickness [m].
#[derive(Clone, Copy, Debug)]
pub struct Section {
    /// Leading edge [m].
    pub lead: f64,
    /// Trailing edge [m].
    pub trail: f64,
    /// Half the greatest thickness [m].
    pub half_thickness: f64,
    /// Radius of both edges [m].
    pub edge_radius: f64,
}

impl Section {
    /// The point at a share of the outline, from the leading edge over the upper side, and its
    /// place along the chord from -1 (trailing edge) to 1 (leading edge).
    ///
    /// The outline is a flat lens offset by a disc of the edge's radius: the edges have that radius, and equal steps are
    /// denser at the edges.
    pub fn corner(&self, share: f64) -> (f64, f64, f64) {
        let half_chord = ((self.lead - self.trail) / 2.0).max(LEAST_M);
        let half_thickness = self.half_thickness.max(LEAST_M);
        let radius = self.edge_radius.min(0.9 * half_thickness).min(0.45 * half_chord);
        let long = half_chord - radius;
        let short = (half_thickness - radius).max(0.03 * long);
        let turn = TAU * share;
        let crowd = libm::pow(short / long, 0.6);
        let around = libm::atan2(crowd * libm::sin(turn), libm::cos(turn));
        let (cos, sin) = (libm::cos(around), libm::sin(around));
        let normal = DVec2::new(cos / long, sin / short).normalize();
        let x = long * cos + radius * normal.x;
        let z = short * sin * (1.0 + 0.25 * cos * sin * sin) + radius * normal.y;
        ((self.lead + self.trail) / 2.0 + x, z, x / half_chord)
    }
}

/// Share of chord and thickness near a rounded tip; `blunt` is large for a square tip.
pub fn tip_rounding(s: f64, blunt: f64) -> f64 {
    libm::sqrt((1.0 - libm::pow(s.clamp(0.0, 1.0), blunt)).max(0.0))
}

/// Exponent of [`tip_rounding`] for a tip of a half thickness and radius over a span.
pub fn tip_bluntness(radius: f64, span: f64, half_thickness: f64) -> f64 {
    (2.0 * radius * span / (half_thickness * half_thickness).max(LEAST_M * LEAST_M))
        .clamp(8.0, 80.0)
}

/// Rings of a fin as shares of the span, without root (0) and tip (1): dense at the fillet of the root and at the tip.
pub fn spans(rings: usize) -> Vec<f64> {
    (1..rings)
        .map(|ring| {
            let share = ring as f64 / rings as f64;
            let slow = 1.0 - libm::pow(1.0 - share, 2.2);
            slow * libm::pow(share, 0.45)
        })
        .collect()
}

/// Weight of a fillet at a share of the span, 1 at the root, with a smooth start.
pub fn fillet(s: f64, reach: f64) -> f64 {
    let left = (1.0 - libm::pow((s / reach).clamp(0.0, 1.0), 0.6)).max(0.0);
    left * left
}

/// Smallest radius over the convex sides between triangles in regions selected by `of`, and the middle of that side [m].
/// `None` if there is no such side.
pub fn smallest_radius(skin: &Skin, of: impl Fn(Region) -> bool) -> Option<(f64, DVec3)> {
    let mut first = BTreeMap::new();
    let mut least: Option<(f64, DVec3)> = None;
    for (triangle, _) in skin.triangles.iter().zip(&skin.regions).filter(|(_, region)| of(**region))
    {
        for turn in 0..3 {
            let [a, b, c] = [0, 1, 2].map(|step| triangle[(turn + step) % 3]);
            let Some(other) = first.remove(&(b, a)) else {
                first.insert((a, b), c);
                continue;
            };
            let [a, b, c, other] = [a, b, c, other].map(|corner| skin.vertices[corner as usize]);
            let Some(radius) = radius([a, b], [c, other]) else { continue };
            if least.is_none_or(|(known, _)| radius < known) {
                least = Some((radius, (a + b) / 2.0));
            }
        }
    }
    least
}

/// Radius at the side `[a, b]` of the triangles `a b c` and `b a d`; `None` if they are flat or concave.
fn radius([a, b]: [DVec3; 2], [c, d]: [DVec3; 2]) -> Option<f64> {
    let along = b - a;
    let (one, other) = (along.cross(c - a), (d - a).cross(along));
    let (from, to) = (one.normalize_or_zero(), other.normalize_or_zero());
    if from.dot(d - a) >= 0.0 {
        return None;
    }
    let reach = (one.length() + other.length()) / (2.0 * along.length());
    // The distance of two unit vectors is twice the sine of half their angle.
    let bend = from.distance(to);
    (bend > 0.0 && reach > 0.0).then(|| reach / bend)
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;

    /// A prism of `sides` round the x axis, of radius 0.02 m.
    fn prism(sides: u32) -> Skin {
        let rim = |x: f64| {
            (0..sides).map(move |side| {
                let angle = TAU * f64::from(side) / f64::from(sides);
                DVec3::new(x, 0.02 * libm::cos(angle), 0.02 * libm::sin(angle))
            })
        };
        let triangles = (0..sides).flat_map(|side| {
            let next = (side + 1) % sides;
            [[side, sides + side, next], [next, sides + side, sides + next]]
        });
        let triangles: Vec<[u32; 3]> = triangles.map(|[a, b, c]| [a, c, b]).collect();
        Skin {
            regions: vec![Region::LeftFluke; triangles.len()],
            vertices: rim(0.0).chain(rim(0.3)).collect(),
            triangles,
            ..Skin::default()
        }
    }

    #[test]
    fn a_prism_has_the_radius_of_its_circle() {
        for sides in [5, 8, 30] {
            let skin = prism(sides);
            let (radius, place) = smallest_radius(&skin, |_| true).unwrap();
            assert!((radius / 0.02 - 1.0).abs() < 1e-9, "{sides} sides: {radius}");
            assert!((0.0..=0.3).contains(&place.x));
            assert!(smallest_radius(&skin, |region| region == Region::Body).is_none());
            let mut hollow = skin.clone();
            hollow.triangles.iter_mut().for_each(|triangle| triangle.swap(1, 2));
            assert!(smallest_radius(&hollow, |_| true).is_none(), "from inside it is hollow");
        }
    }
}
