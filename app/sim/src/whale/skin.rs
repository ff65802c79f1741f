//! The whale's body as data: a triangle skin, its bones, the angles of a posture, and measures of the closed skin.
//!
//! Measures of a body of uniform density `ρ` [kg/m³] follow from the divergence theorem, as a sum over triangles `a b c` of the
//! signed tetrahedra that they form with the origin:
//!
//! ```text
//! V = Σ v,  v = a·(b × c) / 6              volume [m³]
//! c = Σ v (a + b + c) / 4 / V               centre [m]
//! C = Σ v (a aᵀ + b bᵀ + c cᵀ + s sᵀ) / 20  second moments about the origin [m⁵], s = a + b + c
//! I = ρ (tr C' 1 - C'),  C' = C - V c cᵀ     inertia about the centre [kg m²]
//! ```
//!
//! Reference: Tonon 2005, Journal of Mathematics and Statistics 1, 8-11 (moments of a tetrahedron in closed form).

use endline_sdk::{Region, SPINE_JOINTS};
use glam::{DMat3, DVec3};

/// A closed triangle skin on bones; at most four bones move a vertex.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Skin {
    /// Rest position of each vertex in the whale's frame [m].
    pub vertices: Vec<DVec3>,
    /// Vertices of each triangle, anticlockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
    /// Region of each triangle.
    pub regions: Vec<Region>,
    /// Bones that move each vertex, with weights that sum to 1; unused entries have weight 0.
    pub weights: Vec<[(u16, f64); 4]>,
    /// Appearance of each vertex, for pictures only; contact uses regions.
    pub marks: Vec<Mark>,
    /// Bones, parents before children; bone 0 is the control bone (the whale's frame).
    pub bones: Vec<Bone>,
}

/// Appearance of the skin at a vertex.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Mark {
    /// Dark skin.
    #[default]
    Skin,
    /// Raised, roughened patch on the head, pale with whale lice.
    Callosity,
    /// Baleen plates.
    Baleen,
    /// Inside of the mouth: gums, palate, tongue.
    Mouth,
    /// White patch on belly or throat.
    White,
    /// Eye.
    Eye,
}

/// A bone; channels of the posture rotate it about its origin.
#[derive(Clone, Debug, PartialEq)]
pub struct Bone {
    /// Name, such as `spine_3` or `left_flipper_blade`.
    pub name: String,
    /// Index of its parent; `None` for the control bone.
    pub parent: Option<usize>,
    /// Rest position of its origin in the whale's frame [m].
    pub origin: DVec3,
    /// Channels that rotate it, each with its axis in the whale's rest frame, applied in this order.
    pub turns: Vec<(Channel, DVec3)>,
}

/// A share of an angle of a [`Posture`](endline_sdk::Posture).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Channel {
    /// The angle.
    pub angle: Angle,
    /// Share of the angle that rotates the bone.
    pub share: f64,
}

/// Names of the angles of a posture; sides are 0 left, 1 right.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Angle {
    /// Spine pitch at a joint.
    SpinePitch(usize),
    /// Spine yaw at a joint.
    SpineYaw(usize),
    /// Spine roll at a joint.
    SpineRoll(usize),
    /// Fluke pitch.
    FlukePitch,
    /// Fluke flex by side.
    FlukeFlex(usize),
    /// Flipper sweep by side.
    FlipperSweep(usize),
    /// Flipper raise by side.
    FlipperRaise(usize),
    /// Flipper twist by side.
    FlipperTwist(usize),
    /// Flipper flex by side.
    FlipperFlex(usize),
    /// Jaw.
    Jaw,
    /// Lower lip by side.
    Lips(usize),
}

impl Angle {
    /// Angles of the spine by joint: pitch, yaw, roll.
    pub const SPINE: [fn(usize) -> Self; 3] = [Self::SpinePitch, Self::SpineYaw, Self::SpineRoll];

    /// All angles of a posture, each once.
    pub fn all() -> impl Iterator<Item = Self> {
        let spine = Self::SPINE.into_iter().flat_map(|axis| (0..SPINE_JOINTS).map(axis));
        let flippers =
            [Self::FlipperSweep, Self::FlipperRaise, Self::FlipperTwist, Self::FlipperFlex]
                .into_iter()
                .flat_map(Self::sides);
        spine
            .chain([Self::FlukePitch])
            .chain(Self::sides(Self::FlukeFlex))
            .chain(flippers)
            .chain([Self::Jaw])
            .chain(Self::sides(Self::Lips))
    }

    /// Name in files, such as `spine_yaw`, and joint or side (0 left, 1 right).
    pub fn name(self) -> (&'static str, Option<usize>) {
        match self {
            Self::SpinePitch(joint) => ("spine_pitch", Some(joint)),
            Self::SpineYaw(joint) => ("spine_yaw", Some(joint)),
            Self::SpineRoll(joint) => ("spine_roll", Some(joint)),
            Self::FlukePitch => ("fluke_pitch", None),
            Self::FlukeFlex(side) => ("fluke_flex", Some(side)),
            Self::FlipperSweep(side) => ("flipper_sweep", Some(side)),
            Self::FlipperRaise(side) => ("flipper_raise", Some(side)),
            Self::FlipperTwist(side) => ("flipper_twist", Some(side)),
            Self::FlipperFlex(side) => ("flipper_flex", Some(side)),
            Self::Jaw => ("jaw", None),
            Self::Lips(side) => ("lips", Some(side)),
        }
    }

    fn sides(of: fn(usize) -> Self) -> impl Iterator<Item = Self> {
        (0..2).map(of)
    }
}

/// Mass and dimensions of a whale at rest.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Measures {
    /// Mass [kg].
    pub mass_kg: f64,
    /// Displaced volume [m³].
    pub volume_m3: f64,
    /// Area of the skin without the inside of the mouth [m²].
    pub wetted_area_m2: f64,
    /// Centre of mass in the whale's frame [m].
    pub centre_m: DVec3,
    /// Inertia about the centre of mass, along the axes of the whale's frame [kg m²].
    pub inertia_kg_m2: DMat3,
}

impl Measures {
    /// Measures of a closed skin of uniform density [kg/m³]; zero for a skin without volume.
    pub fn of(skin: &Skin, density_kg_m3: f64) -> Self {
        let inside = |vertex: &u32| {
            matches!(skin.marks.get(*vertex as usize), Some(Mark::Mouth | Mark::Baleen))
        };
        let outside = skin.triangles.iter().filter(|corners| !corners.iter().all(inside));
        let wetted_area_m2 = outside.map(|corners| area(&skin.vertices, *corners)).sum();
        Self {
            wetted_area_m2,
            ..Self::of_triangles(&skin.vertices, &skin.triangles, density_kg_m3)
        }
    }

    /// Measures of any closed surface, such as a skin in a posture; all of it is wetted.
    pub fn of_triangles(places: &[DVec3], triangles: &[[u32; 3]], density_kg_m3: f64) -> Self {
        let (mut volume, mut first, mut second, mut wetted) = (0.0, DVec3::ZERO, DMat3::ZERO, 0.0);
        for corners in triangles {
            let [a, b, c] = corners.map(|corner| places[corner as usize]);
            let (share, sum) = (a.dot(b.cross(c)) / 6.0, a + b + c);
            volume += share;
            first += share / 4.0 * sum;
            second += (square(a) + square(b) + square(c) + square(sum)) * (share / 20.0);
            wetted += area(places, *corners);
        }
        if volume <= 0.0 {
            return Self::default();
        }
        let centre = first / volume;
        let about = second - square(centre) * volume;
        let trace = about.x_axis.x + about.y_axis.y + about.z_axis.z;
        let inertia = (DMat3::IDENTITY * trace - about) * density_kg_m3;
        Self {
            mass_kg: density_kg_m3 * volume,
            volume_m3: volume,
            wetted_area_m2: wetted,
            centre_m: centre,
            inertia_kg_m2: inertia,
        }
    }
}

/// Area of a triangle [m²].
fn area(places: &[DVec3], corners: [u32; 3]) -> f64 {
    let [a, b, c] = corners.map(|corner| places[corner as usize]);
    (b - a).cross(c - a).length() / 2.0
}

/// `a aᵀ`.
fn square(a: DVec3) -> DMat3 {
    DMat3::from_cols(a * a.x, a * a.y, a * a.z)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A box of 2 by 3 by 4 m away from the origin, compared with the textbook.
    #[test]
    fn a_box_has_the_inertia_of_the_textbook() {
        let at = DVec3::new(5.0, -2.0, 1.0);
        let places: Vec<DVec3> = (0..8)
            .map(|n| {
                at + DVec3::new(
                    f64::from(n & 1) * 2.0,
                    f64::from(n >> 1 & 1) * 3.0,
                    f64::from(n >> 2) * 4.0,
                )
            })
            .collect();
        let faces =
            [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
        let triangles: Vec<[u32; 3]> =
            faces.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
        let found = Measures::of_triangles(&places, &triangles, 10.0);
        assert!(
            (found.mass_kg - 240.0).abs() < 1e-9 && (found.wetted_area_m2 - 52.0).abs() < 1e-12,
            "{found:?}"
        );
        assert!(found.centre_m.distance(at + DVec3::new(1.0, 1.5, 2.0)) < 1e-12);
        let expected = DMat3::from_diagonal(DVec3::new(25.0, 20.0, 13.0) * 20.0);
        assert!(
            (found.inertia_kg_m2 - expected).to_cols_array().iter().all(|off| off.abs() < 1e-8),
            "{}",
            found.inertia_kg_m2
        );
        assert_eq!(Measures::of_triangles(&places, &[], 10.0), Measures::default());
    }
}
