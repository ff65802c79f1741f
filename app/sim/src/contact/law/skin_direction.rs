//! A direction fixed to the skin at a contact, for friction that knows directions.
//!
//! At rest the grain of a triangle runs athwart the whale: `g = n x` crossed, with `n` its normal and `x` the whale's
//! fore-and-aft axis. Baleen plates are athwart, in a row along the jaw, so on the racks the direction is along the plates.
//! A skinned triangle carries the fore-and-aft direction `f` within it: with rest edges `a`, `b` and
//! `f = alpha a + beta b`, it is `alpha a' + beta b'` on the edges `a'`, `b'` of the moment. At a contact with normal `n`
//! the direction is the unit vector along `n x f`. If a triangle faces fore or aft, the dorsal axis replaces `x`.

use glam::DVec3;

use crate::geometry::norm;
use crate::whale::Skin;

/// Least part of the fore-and-aft axis that lies in a triangle for it to be taken.
const LEAST_SHARE: f64 = 0.2;

/// The fore-and-aft direction of every triangle of a skin at rest, in shares of two of its edges.
#[derive(Clone, Debug)]
pub(crate) struct Grains(Vec<[Option<Along>; 2]>);

/// A direction within a triangle, as shares of its edges from the first corner to the second and to the third.
type Along = [f64; 2];

impl Grains {
    /// Computes the direction of every triangle of a skin.
    pub fn new(skin: &Skin) -> Self {
        let along = |corners: &[u32; 3]| {
            let rest = corners.map(|corner| skin.vertices[corner as usize]);
            [within(rest, DVec3::X), within(rest, DVec3::Z)]
        };
        Self(skin.triangles.iter().map(along).collect())
    }

    /// Unit vector across `normal` that is fixed to the skin of a triangle whose corners are at `now`.
    #[inline(always)]
    pub fn at(&self, triangle: usize, now: &[DVec3; 3], normal: DVec3) -> DVec3 {
        let carried = |along: &Option<Along>| {
            let [alpha, beta] = (*along)?;
            let along = (now[1] - now[0]) * alpha + (now[2] - now[0]) * beta;
            norm::try_normalize(normal.cross(along))
        };
        let [fore_and_aft, dorsal] = &self.0[triangle];
        carried(fore_and_aft)
            .or_else(|| carried(dorsal))
            .unwrap_or_else(|| normal.any_orthonormal_vector())
    }
}

/// The part of an axis within the rest triangle; `None` if the axis is normal to it.
fn within(rest: [DVec3; 3], axis: DVec3) -> Option<Along> {
    let (a, b) = (rest[1] - rest[0], rest[2] - rest[0]);
    let (aa, ab, bb) = (a.dot(a), a.dot(b), b.dot(b));
    let area_squared = aa * bb - ab * ab;
    if area_squared <= 0.0 {
        return None;
    }
    let (on_a, on_b) = (a.dot(axis), b.dot(axis));
    let (alpha, beta) =
        ((bb * on_a - ab * on_b) / area_squared, (aa * on_b - ab * on_a) / area_squared);
    let within = (a * alpha + b * beta).length();
    (within > LEAST_SHARE).then_some([alpha, beta])
}

#[cfg(test)]
mod tests {
    use endline_sdk::Region;
    use glam::{DMat3, DQuat};

    use super::*;

    fn skin(corners: [DVec3; 3]) -> Skin {
        Skin {
            vertices: corners.to_vec(),
            triangles: vec![[0, 1, 2]],
            regions: vec![Region::Body],
            weights: Vec::new(),
            marks: Vec::new(),
            bones: Vec::new(),
        }
    }

    #[test]
    fn grain_is_athwart_at_rest_and_goes_with_the_skin() {
        let rest =
            [DVec3::new(0.1, 0.2, 0.3), DVec3::new(0.5, 0.3, 0.2), DVec3::new(0.2, 0.9, 0.4)];
        let grains = Grains::new(&skin(rest));
        let normal = |at: [DVec3; 3]| (at[1] - at[0]).cross(at[2] - at[0]).normalize();
        let still = grains.at(0, &rest, normal(rest));
        assert!(
            still.dot(DVec3::X).abs() < 1e-12
                && still.dot(normal(rest)).abs() < 1e-12
                && still.y.abs() > 0.9,
            "{still}"
        );
        let turn = DMat3::from_quat(DQuat::from_rotation_z(0.7) * DQuat::from_rotation_x(1.1));
        let turned = rest.map(|place| turn * place + DVec3::Y);
        assert!(
            (grains.at(0, &turned, normal(turned)) - turn * still).length() < 1e-12,
            "turned with the whale"
        );
        // Stretched fore and aft the direction stays; a contact normal that leans keeps it across.
        let leaning = (normal(rest) + DVec3::new(0.2, 0.1, -0.1)).normalize();
        assert!(grains.at(0, &rest, leaning).dot(leaning).abs() < 1e-12);
    }

    #[test]
    fn a_triangle_that_faces_forward_has_a_grain_too() {
        let rest = [DVec3::ZERO, DVec3::Y, DVec3::Z];
        let at = Grains::new(&skin(rest)).at(0, &rest, DVec3::X);
        assert!((at.abs() - DVec3::Y).length() < 1e-12, "{at}");
        assert!(
            (Grains::new(&skin([DVec3::ZERO; 3])).at(0, &[DVec3::ZERO; 3], DVec3::X).length()
                - 1.0)
                .abs()
                < 1e-12
        );
    }
}
