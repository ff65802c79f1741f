//! How sharp the edges of a skin are: the radius that rope bends round on flippers and flukes.
//!
//! ```text
//! r = (h₁ + h₂)/2 / (2 sin(θ/2))
//! ```
//!
//! `θ` is the angle between the planes of two triangles at the side they share. `h` is how far each
//! triangle reaches from that side. On a prism round a circle of radius `r` the formula gives that
//! radius, whatever the number of sides. Hollow (concave) sides are left out.

use std::collections::BTreeMap;

use endline_sdk::Region;
use endline_sim::whale::Skin;
use glam::DVec3;

/// Least radius over the sides whose two triangles both lie in regions that `of` picks, and the middle of that side [m].
///
/// None where no two such triangles bend outward.
#[must_use]
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

/// Radius at a side `[a, b]` of the triangles `a b c` and `b a d`; none where they are flat or hollow.
fn radius([a, b]: [DVec3; 2], [c, d]: [DVec3; 2]) -> Option<f64> {
    let along = b - a;
    let (one, other) = (along.cross(c - a), (d - a).cross(along));
    let (from, to) = (one.normalize_or_zero(), other.normalize_or_zero());
    if from.dot(d - a) >= 0.0 {
        return None;
    }
    let reach = (one.length() + other.length()) / (2.0 * along.length());
    // Twice the sine of half the angle between unit vectors is the distance of their ends.
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
