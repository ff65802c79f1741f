//! Meshes of round solids: cylinders with flat ends, and spheroids.

use std::f64::consts::{PI, TAU};

use endline_sim::DAffine3;
use glam::DVec3;

use super::mesh::{Colour, Mesh};

/// A ring of vertices round z.
struct Ring {
    /// How far off the axis, and how high [m].
    off_m: f64,
    height_m: f64,
    /// Parts of the normal away from the axis and along it.
    normal: [f64; 2],
    /// How far each vertex stands out along its normal [m].
    out_m: f64,
}

impl Mesh {
    /// A cylinder with flat ends along z of the pose, of a radius and half a length [m]. `paint` gives a colour by height along it, -1 to 1.
    pub fn cylinder(
        &mut self,
        pose: &DAffine3,
        [radius_m, half_length_m]: [f64; 2],
        paint: impl Fn(f32) -> Colour,
        sides: usize,
    ) {
        let heights = [-1.0_f32, -0.2, -0.2, 0.2, 0.2, 1.0];
        let middles = [-0.6, -0.6, 0.0, 0.0, 0.6, 0.6];
        let rings: Vec<u32> = heights
            .into_iter()
            .zip(middles)
            .map(|(height, painted)| {
                let height_m = f64::from(height) * half_length_m;
                // About the axis, so that a thin staff is widened as rope is.
                let ring = Ring { off_m: 0.0, height_m, normal: [1.0, 0.0], out_m: radius_m };
                self.circle(pose, &ring, paint(painted), sides)
            })
            .collect();
        for pair in rings.chunks_exact(2) {
            self.band(pair[0], pair[1], sides);
        }
        for end in [-1.0, 1.0] {
            let height_m = end * half_length_m;
            let colour = paint(end as f32);
            let [middle, rim] = [0.0, radius_m].map(|off_m| {
                let ring = Ring { off_m, height_m, normal: [0.0, end], out_m: 0.0 };
                self.circle(pose, &ring, colour, sides)
            });
            let [lower, upper] = if end < 0.0 { [middle, rim] } else { [rim, middle] };
            self.band(lower, upper, sides);
        }
    }

    /// A spheroid round about z of the pose, of half axes across and along z [m]. `paint` gives a colour by height along it, -1 to 1.
    pub fn spheroid(
        &mut self,
        pose: &DAffine3,
        [across_m, along_m]: [f64; 2],
        paint: impl Fn(f32) -> Colour,
        rings: usize,
    ) {
        let sides = 2 * rings;
        let ring = |mesh: &mut Self, ring: usize| {
            let polar = PI * ring as f64 / rings as f64;
            let (out, up) = (polar.sin(), -polar.cos());
            let normal = [out / across_m, up / along_m];
            let it = Ring { off_m: across_m * out, height_m: along_m * up, normal, out_m: 0.0 };
            mesh.circle(pose, &it, paint(up as f32), sides)
        };
        let mut before = ring(self, 0);
        for number in 1..=rings {
            let next = ring(self, number);
            self.band(before, next, sides);
            before = next;
        }
    }

    /// Vertices round the pose's z axis; the number of the first.
    fn circle(&mut self, pose: &DAffine3, ring: &Ring, colour: Colour, sides: usize) -> u32 {
        let Ring { off_m, height_m, normal: [outward, upward], out_m } = *ring;
        let first = u32::try_from(self.place.len()).unwrap_or(u32::MAX);
        for side in 0..sides {
            let angle = TAU * side as f64 / sides as f64;
            let out = DVec3::new(angle.cos(), angle.sin(), 0.0);
            let at = pose.transform_point3(out * off_m + DVec3::Z * height_m);
            let normal = pose.transform_vector3(out * outward + DVec3::Z * upward);
            let normal = normal.normalize_or_zero().as_vec3();
            self.vertex(at.as_vec3(), normal, out_m as f32, colour);
        }
        first
    }
}
