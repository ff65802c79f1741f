//! How much of a skin is under water, and where: Archimedes on the triangles.
//!
//! With `s` the height above the water and `n` the outward normal, the divergence theorem over the wet skin gives the displaced volume
//! `V = ∮ s n_z dA` and its first moments `∮ x s n_z dA`, `∮ y s n_z dA`; the waterplane adds nothing, since `s = 0` there. On a flat triangle
//! of area vector `N` the mean of a product of two linear functions is `(Σ f_i g_i + Σ f_i Σ g_i)/12`. Triangles across the
//! waterline are cut along it, so that a closed mesh is exact at any heel and draught.
//! Reference: Biran and López-Pulido 2014, Ship Hydrostatics and Stability, chapter 2; the sums are our own.

use glam::{DMat3, DVec3};

use super::super::{Measures, Skin, pose, skin_vertex};
use endline_sdk::Posture;
use glam::DQuat;

/// A closed surface of flat triangles in the whale's frame.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Hull {
    places: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
    /// Volume it holds [m³].
    pub volume_m3: f64,
    /// Middle of that volume [m].
    pub middle_m: DVec3,
    /// Farthest place from the frame's origin [m].
    pub reach_m: f64,
}

/// What is under water.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Wetted {
    /// Volume [m³].
    pub volume_m3: f64,
    /// Volume times how far its middle lies east and north of the point it is measured from [m⁴].
    pub moment_m4: [f64; 2],
}

impl Hull {
    /// A skin in a posture.
    #[must_use]
    pub fn of(skin: &Skin, posture: &Posture) -> Self {
        let mut bones = Vec::new();
        pose(skin, DVec3::ZERO, DQuat::IDENTITY, posture, &mut bones);
        let places =
            (0..skin.vertices.len()).map(|vertex| skin_vertex(skin, &bones, vertex)).collect();
        Self::new(places, skin.triangles.clone())
    }

    /// A closed surface by its corners.
    fn new(places: Vec<DVec3>, triangles: Vec<[u32; 3]>) -> Self {
        let held = Measures::of_triangles(&places, &triangles, 1.0);
        let reach_m = places.iter().map(|place| place.length()).fold(0.0, f64::max);
        Self { places, triangles, volume_m3: held.volume_m3, middle_m: held.centre_m, reach_m }
    }

    /// What is under water with the point `centre` of its frame `height_m` above the surface, turned by `orientation`.
    ///
    /// `turned` is scratch: each corner is turned once for all of its triangles.
    #[must_use]
    pub fn wetted(
        &self,
        centre: DVec3,
        orientation: DQuat,
        height_m: f64,
        turned: &mut Vec<DVec3>,
    ) -> Wetted {
        let axes = DMat3::from_quat(orientation);
        let up = DVec3::Z * height_m;
        turned.clear();
        turned.extend(self.places.iter().map(|place| axes * (*place - centre) + up));
        let mut sum = Wetted::default();
        for corners in &self.triangles {
            let [a, b, c] = *corners;
            sum.add_cut(turned[a as usize], turned[b as usize], turned[c as usize]);
        }
        sum
    }

    /// Scratch for [`wetted`](Self::wetted) that need not grow.
    #[must_use]
    pub fn scratch(&self) -> Vec<DVec3> {
        Vec::with_capacity(self.places.len())
    }
}

impl Wetted {
    /// Adds the part of a triangle that is under water; heights are above the surface.
    ///
    /// Corners are handed over one by one: as an array they would go through memory, which costs more than the sum.
    fn add_cut(&mut self, a: DVec3, b: DVec3, c: DVec3) {
        // The lone corner comes first.
        match [a, b, c].map(|corner| corner.z > 0.0) {
            [false, false, false] => self.add(a, b, c),
            [true, true, true] => {}
            [true, false, false] => self.add_below(a, b, c),
            [false, true, false] => self.add_below(b, c, a),
            [false, false, true] => self.add_below(c, a, b),
            [false, true, true] => self.add_tip(a, b, c),
            [true, false, true] => self.add_tip(b, c, a),
            [true, true, false] => self.add_tip(c, a, b),
        }
    }

    /// Adds a triangle of which corner `a` alone is dry.
    fn add_below(&mut self, a: DVec3, b: DVec3, c: DVec3) {
        let (on_b, on_c) = (at_surface(a, b), at_surface(a, c));
        self.add(on_b, b, c);
        self.add(on_b, c, on_c);
    }

    /// Adds a triangle of which corner `a` alone is wet.
    fn add_tip(&mut self, a: DVec3, b: DVec3, c: DVec3) {
        self.add(a, at_surface(a, b), at_surface(a, c));
    }

    #[inline]
    fn add(&mut self, a: DVec3, b: DVec3, c: DVec3) {
        let flat = 0.5 * ((b - a).cross(c - a)).z;
        let depth = a.z + b.z + c.z;
        self.volume_m3 += flat * depth / 3.0;
        let moment = (a * a.z + b * b.z + c * c.z + (a + b + c) * depth) * (flat / 12.0);
        self.moment_m4[0] += moment.x;
        self.moment_m4[1] += moment.y;
    }
}

/// Where an edge meets the surface.
fn at_surface(from: DVec3, to: DVec3) -> DVec3 {
    from.lerp(to, from.z / (from.z - to.z))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A box of these half sides about the origin.
    fn crate_of(half: DVec3) -> Hull {
        let corner = |k: u32| {
            half * DVec3::from_array(
                [0, 1, 2].map(|bit| if k >> bit & 1 == 0 { -1.0 } else { 1.0 }),
            )
        };
        let faces =
            [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        let triangles =
            faces.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]).collect();
        Hull::new((0..8).map(corner).collect(), triangles)
    }

    #[test]
    fn a_box_displaces_what_lies_below_the_waterline() {
        let hull = crate_of(DVec3::new(4.0, 1.5, 0.5));
        let mut turned = hull.scratch();
        let mut level_at =
            |height_m| hull.wetted(DVec3::ZERO, DQuat::IDENTITY, height_m, &mut turned);
        let level = level_at(0.1);
        assert!(
            (level.volume_m3 - 8.0 * 3.0 * 0.4).abs() < 1e-12
                && level.moment_m4.iter().all(|moment| moment.abs() < 1e-12)
        );
        assert!((level_at(-9.0).volume_m3 - 24.0).abs() < 1e-12);
        assert!(level_at(9.0).volume_m3.abs() < 1e-12);
        // Heeled by 0.1 about x with its middle in the surface, the waterline cuts both sides: as much under as over.
        let heeled = hull.wetted(DVec3::ZERO, DQuat::from_rotation_x(0.1), 0.0, &mut turned);
        assert!((heeled.volume_m3 - 12.0).abs() < 1e-12);
        // Its moment about the middle is that of the level half, turned, and of the two wedges: L b³ tan φ/12 (1 + tan²φ/2) along the keel.
        let (sin, cos, tan) = (libm::sin(0.1), libm::cos(0.1), libm::tan(0.1));
        let (across, down) =
            (8.0 * 27.0 * tan / 12.0, -(12.0 * 0.25) + 8.0 * 27.0 * tan * tan / 24.0);
        let expected = -across * cos - down * sin;
        assert!(
            (heeled.moment_m4[1] - expected).abs() < 1e-9,
            "{} against {expected}",
            heeled.moment_m4[1]
        );
    }

    /// Scratch of another hull and pose changes no bit, and the sum is that of triangles turned and cut one by one.
    #[test]
    fn corners_turned_once_give_the_bits_of_triangles_turned_alone() {
        let hull = crate_of(DVec3::new(4.0, 1.5, 0.5));
        let (centre, axis) = (DVec3::new(0.3, -0.2, 0.1), DVec3::new(0.6, 0.48, 0.64));
        let (mut turned, mut cut) = (vec![DVec3::NAN; 99], [0; 4]);
        for step in 0..60 {
            let orientation = DQuat::from_axis_angle(axis, 0.1 * f64::from(step));
            let height_m = 0.05 * f64::from(step - 30);
            let axes = DMat3::from_quat(orientation);
            let mut sum = Wetted::default();
            for triangle in &hull.triangles {
                let corners = triangle.map(|corner| {
                    axes * (hull.places[corner as usize] - centre) + DVec3::Z * height_m
                });
                cut[add_alone(&mut sum, corners)] += 1;
            }
            assert_eq!(hull.wetted(centre, orientation, height_m, &mut turned), sum);
        }
        assert!(cut.iter().all(|triangles| *triangles > 20), "{cut:?}");
    }

    /// Adds a triangle turned so that its lone corner comes first, by the number of its dry corners; that number.
    fn add_alone(sum: &mut Wetted, corners: [DVec3; 3]) -> usize {
        let dry = corners.map(|corner| corner.z > 0.0);
        let count = dry.iter().filter(|is_dry| **is_dry).count();
        let lone = dry.iter().position(|is_dry| *is_dry == (count == 1)).unwrap_or(0);
        let [a, b, c] = [0, 1, 2].map(|step| corners[(lone + step) % 3]);
        let cross = |to: DVec3| a.lerp(to, a.z / (a.z - to.z));
        match count {
            0 => sum.add(corners[0], corners[1], corners[2]),
            1 => {
                sum.add(cross(b), b, c);
                sum.add(cross(b), c, cross(c));
            }
            2 => sum.add(a, cross(b), cross(c)),
            _ => {}
        }
        count
    }
}
