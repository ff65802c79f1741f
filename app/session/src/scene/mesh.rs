//! Triangles as plain data, and the shapes the scene is made of: balls, boxes, tubes, bodies of revolution.

use std::f64::consts::{PI, TAU};

use glam::{DAffine3, DVec3, Vec3};

/// A coloured triangle mesh in world coordinates [m], single precision.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// Places, one a vertex [m]. Where [`radius_m`](Self::radius_m) is above zero this is the centre
    /// from which the vertex stands out along its normal.
    pub place: Vec<Vec3>,
    /// Unit normals, one a vertex.
    pub normal: Vec<Vec3>,
    /// How far a vertex stands out along its normal [m]; the drawing widens it to a least width on
    /// screen, so that a 10 mm rope is still seen from 100 m.
    pub radius_m: Vec<f32>,
    /// Red, green, blue, opacity, each 0 to 1 (sRGB), one a vertex.
    pub colour: Vec<[f32; 4]>,
    /// Places on the body at rest to which its grain sticks, one a vertex [m]; empty where it has none.
    pub grain: Vec<Vec3>,
    /// Vertices of each triangle, anticlockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
}

/// Red, green, blue, opacity, each 0 to 1 (sRGB).
pub type Colour = [f32; 4];

impl Mesh {
    /// Adds a vertex and returns its index.
    pub fn vertex(&mut self, place: Vec3, normal: Vec3, radius_m: f32, colour: Colour) -> u32 {
        let index = u32::try_from(self.place.len()).unwrap_or(u32::MAX);
        self.place.push(place);
        self.normal.push(normal);
        self.radius_m.push(radius_m);
        self.colour.push(colour);
        index
    }

    /// Where each vertex's grain is taken [m]: its own place where the mesh has no grain of its own.
    pub fn own_grain(&self) -> &[Vec3] {
        if self.grain.len() == self.place.len() { &self.grain } else { &self.place }
    }

    /// Number of vertices.
    pub fn vertices(&self) -> usize {
        self.place.len()
    }

    /// Where a vertex stands at full size [m].
    pub fn surface(&self, vertex: usize) -> Vec3 {
        self.place[vertex] + self.normal[vertex] * self.radius_m[vertex]
    }

    /// A flat four-sided patch: corners in order round it, seen from outside anticlockwise.
    pub fn quad(&mut self, corners: [Vec3; 4], colour: Colour) {
        let normal = (corners[1] - corners[0]).cross(corners[3] - corners[0]).normalize_or_zero();
        let [a, b, c, d] = corners.map(|corner| self.vertex(corner, normal, 0.0, colour));
        self.triangles.extend([[a, b, c], [a, c, d]]);
    }

    /// A tube through `centres` with a colour at each; `sides` at least 3. Fewer than two centres draw nothing.
    pub fn tube(&mut self, centres: &[Vec3], radius_m: f32, colours: &[Colour], sides: usize) {
        if centres.len() < 2 || colours.len() != centres.len() {
            return;
        }
        let mut across = any_across(direction(centres, 0));
        let mut earlier: Option<u32> = None;
        for (index, centre) in centres.iter().enumerate() {
            let along = direction(centres, index);
            across = (across - along * across.dot(along))
                .try_normalize()
                .unwrap_or_else(|| any_across(along));
            let first = self.ring(*centre, along, across, radius_m, colours[index], sides);
            if let Some(before) = earlier {
                self.band(before, first, sides);
            }
            earlier = Some(first);
        }
    }

    /// A tube of rope: like [`tube`](Self::tube), with the place along it [m] and the direction round it as grain.
    pub fn rope(&mut self, centres: &[Vec3], radius_m: f32, colours: &[Colour], sides: usize) {
        // Balls and tubes of the same mesh have none.
        self.grain.resize(self.place.len(), Vec3::Y);
        self.tube(centres, radius_m, colours, sides);
        let angle = |side: usize| std::f32::consts::TAU * side as f32 / sides as f32;
        let around: Vec<(f32, f32)> = (0..sides).map(|side| angle(side).sin_cos()).collect();
        let mut along = 0.0;
        for (index, centre) in centres.iter().enumerate() {
            along += if index > 0 { centre.distance(centres[index - 1]) } else { 0.0 };
            self.grain.extend(around.iter().map(|(sin, cos)| Vec3::new(along, *cos, *sin)));
        }
        self.grain.truncate(self.place.len());
    }

    /// One ring of a tube; returns its first vertex.
    fn ring(
        &mut self,
        centre: Vec3,
        along: Vec3,
        across: Vec3,
        radius_m: f32,
        colour: Colour,
        sides: usize,
    ) -> u32 {
        let other = along.cross(across);
        let first = u32::try_from(self.place.len()).unwrap_or(u32::MAX);
        for side in 0..sides {
            let angle = std::f32::consts::TAU * side as f32 / sides as f32;
            self.vertex(centre, across * angle.cos() + other * angle.sin(), radius_m, colour);
        }
        first
    }

    /// Triangles between two rings, of which the second lies above the first where both turn anticlockwise as seen from above.
    pub(crate) fn band(&mut self, before: u32, after: u32, sides: usize) {
        let sides = u32::try_from(sides).unwrap_or(3);
        for side in 0..sides {
            let next = (side + 1) % sides;
            self.triangles.push([before + side, before + next, after + next]);
            self.triangles.push([before + side, after + next, after + side]);
        }
    }

    /// A bar of round section between two places.
    pub fn bar(&mut self, from: Vec3, to: Vec3, radius_m: f32, colour: Colour) {
        self.tube(&[from, to], radius_m, &[colour, colour], 6);
    }

    /// A ball; `rings` from pole to pole, at least 2.
    pub fn ball(&mut self, centre: Vec3, radius_m: f32, colour: Colour, rings: usize) {
        self.capsule(
            &DAffine3::from_translation(centre.as_dvec3()),
            radius_m,
            radius_m,
            |_| colour,
            rings,
        );
    }

    /// A capsule along the z axis of `pose`: its half length includes the round ends. `paint` gives a
    /// colour by height along the axis, -1 to 1.
    pub fn capsule(
        &mut self,
        pose: &DAffine3,
        radius_m: f32,
        half_length_m: f32,
        paint: impl Fn(f32) -> Colour,
        rings: usize,
    ) {
        let straight = (half_length_m - radius_m).max(0.0);
        let sides = 2 * rings;
        let mut earlier: Option<u32> = None;
        for ring in 0..=rings {
            let polar = std::f32::consts::PI * ring as f32 / rings as f32;
            let up = -polar.cos();
            let middle = pose
                .transform_point3(DVec3::new(
                    0.0,
                    0.0,
                    f64::from(straight * if up < 0.0 { -1.0 } else { 1.0 }),
                ))
                .as_vec3();
            let first = u32::try_from(self.place.len()).unwrap_or(u32::MAX);
            let colour = paint(up);
            for side in 0..sides {
                let angle = std::f32::consts::TAU * side as f32 / sides as f32;
                let out = Vec3::new(polar.sin() * angle.cos(), polar.sin() * angle.sin(), up);
                self.vertex(
                    middle,
                    pose.transform_vector3(out.as_dvec3()).as_vec3(),
                    radius_m,
                    colour,
                );
            }
            if let Some(before) = earlier {
                self.band(before, first, sides);
            }
            earlier = Some(first);
        }
    }

    /// The twelve edges of a box and wires across its faces about every `mesh_m`.
    pub fn cage(&mut self, pose: &DAffine3, half_m: Vec3, mesh_m: f32, colours: [Colour; 2]) {
        let place = |x: f32, y: f32, z: f32| {
            pose.transform_point3((Vec3::new(x, y, z) * half_m).as_dvec3()).as_vec3()
        };
        let [frame, wire] = colours;
        for axis in 0..3 {
            let (other, third) = ((axis + 1) % 3, (axis + 2) % 3);
            let point = |a: f32, b: f32, c: f32| {
                let mut at = [0.0; 3];
                (at[axis], at[other], at[third]) = (a, b, c);
                place(at[0], at[1], at[2])
            };
            for [b, c] in [[-1.0, -1.0], [-1.0, 1.0], [1.0, -1.0], [1.0, 1.0]] {
                self.bar(point(-1.0, b, c), point(1.0, b, c), 0.012, frame);
            }
            let wires = (2.0 * half_m[other] / mesh_m).round().clamp(1.0, 12.0);
            for c in [-1.0, 1.0] {
                for step in 1..wires as usize {
                    let b = 2.0 * step as f32 / wires - 1.0;
                    self.bar(point(-1.0, b, c), point(1.0, b, c), 0.003, wire);
                    self.bar(point(-1.0, c, b), point(1.0, c, b), 0.003, wire);
                }
            }
        }
    }

    /// A closed box.
    pub fn block(&mut self, pose: &DAffine3, half_m: Vec3, colour: Colour) {
        for axis in 0..3 {
            let (other, third) = ((axis + 1) % 3, (axis + 2) % 3);
            for side in [-1.0_f32, 1.0] {
                let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(|[b, c]| {
                    let mut at = [0.0_f32; 3];
                    (at[axis], at[other], at[third]) = (side, b * side, c);
                    pose.transform_point3((Vec3::from_array(at) * half_m).as_dvec3()).as_vec3()
                });
                self.quad(corners, colour);
            }
        }
    }

    /// Head of an arrow: a cone with its tip at a place. All of it stands out from the tip, so that it keeps its shape where the drawing
    /// widens it to a least length on screen.
    pub fn head(&mut self, tip: Vec3, along: Vec3, length_m: f32, colour: Colour) {
        const SIDES: u32 = 12;
        /// Half angle of the cone.
        const HALF: f32 = 0.4;
        let across = any_across(along);
        let other = along.cross(across);
        let point = self.vertex(tip, along, 0.0, colour);
        let middle = self.vertex(tip, -along, length_m * HALF.cos(), colour);
        let rim = middle + 1;
        for side in 0..SIDES {
            let angle = std::f32::consts::TAU * side as f32 / SIDES as f32;
            let out = across * angle.cos() + other * angle.sin();
            self.vertex(tip, out * HALF.sin() - along * HALF.cos(), length_m, colour);
        }
        for side in 0..SIDES {
            let next = rim + (side + 1) % SIDES;
            self.triangles.extend([[rim + side, next, point], [next, rim + side, middle]]);
        }
    }
}

/// A world place in single precision.
pub(super) fn single(place: DVec3) -> Vec3 {
    place.as_vec3()
}

/// Unit direction of a polyline at a node: the mean of its two neighbours' segments.
fn direction(centres: &[Vec3], index: usize) -> Vec3 {
    let before = centres[index.saturating_sub(1)];
    let after = centres[(index + 1).min(centres.len() - 1)];
    (after - before).try_normalize().unwrap_or(Vec3::Z)
}

/// Any unit vector across a direction.
fn any_across(along: Vec3) -> Vec3 {
    let aside = if along.z.abs() < 0.9 { Vec3::Z } else { Vec3::X };
    along.cross(aside).try_normalize().unwrap_or(Vec3::X)
}

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

#[cfg(test)]
mod tests {
    use super::*;

    const GREY: Colour = [0.5, 0.5, 0.5, 1.0];

    /// Signed volume of a closed mesh by the divergence theorem [m³].
    fn volume(mesh: &Mesh) -> f32 {
        mesh.triangles
            .iter()
            .map(|corners| {
                let [a, b, c] = corners.map(|corner| mesh.surface(corner as usize));
                a.dot(b.cross(c)) / 6.0
            })
            .sum()
    }

    #[test]
    fn a_ball_has_the_volume_of_a_sphere_and_faces_outward() {
        let mut mesh = Mesh::default();
        mesh.ball(Vec3::new(3.0, -2.0, 1.0), 0.5, GREY, 32);
        let exact = 4.0 / 3.0 * std::f32::consts::PI * 0.125;
        assert!((volume(&mesh) / exact - 1.0).abs() < 0.01, "{} against {exact}", volume(&mesh));
    }

    #[test]
    fn a_capsule_has_the_volume_of_cylinder_and_two_half_balls() {
        let mut mesh = Mesh::default();
        mesh.capsule(&DAffine3::IDENTITY, 0.2, 1.0, |_| GREY, 33);
        let exact = std::f32::consts::PI * 0.04 * (1.6 + 4.0 / 3.0 * 0.2);
        assert!((volume(&mesh) / exact - 1.0).abs() < 0.01, "{} against {exact}", volume(&mesh));
    }

    #[test]
    fn a_block_has_its_volume_and_faces_outward() {
        let mut mesh = Mesh::default();
        mesh.block(
            &DAffine3::from_translation(DVec3::new(5.0, 0.0, 0.0)),
            Vec3::new(0.5, 1.0, 0.25),
            GREY,
        );
        assert!((volume(&mesh) - 1.0).abs() < 1e-5);
    }

    #[test]
    fn a_tube_keeps_its_radius_round_a_bend_and_its_ends() {
        let centres: Vec<Vec3> = (0..50)
            .map(|step| step as f32 * 0.1)
            .map(|a| Vec3::new(a.cos(), a.sin(), 0.3 * a) * 4.0)
            .collect();
        let mut mesh = Mesh::default();
        mesh.tube(&centres, 0.25, &vec![GREY; 50], 8);
        assert_eq!(mesh.vertices(), 50 * 8);
        assert_eq!(mesh.triangles.len(), 49 * 16);
        for vertex in 0..mesh.vertices() {
            let offset = mesh.surface(vertex) - centres[vertex / 8];
            assert!((offset.length() - 0.25).abs() < 1e-5);
            assert!(offset.dot(direction(&centres, vertex / 8)).abs() < 1e-5, "across the rope");
        }
    }
}
