//! What a closed skin holds: volume, wetted area, mass, centre of mass and inertia of a body of even density.
//!
//! By the divergence theorem, as a sum over triangles `a b c` of the signed tetrahedra they make with the origin:
//!
//! ```text
//! V = Σ v,  v = a·(b × c) / 6              volume [m³]
//! c = Σ v (a + b + c) / 4 / V               centre [m]
//! C = Σ v (a aᵀ + b bᵀ + c cᵀ + s sᵀ) / 20  second moments about the origin [m⁵], s = a + b + c
//! I = ρ (tr C' 1 - C'),  C' = C - V c cᵀ     inertia about the centre [kg m²]
//! ```
//!
//! Reference: the moments of a tetrahedron in closed form, as in F. Tonon, Journal of Mathematics and Statistics 1 (2005), 8-11.

use glam::{DMat3, DVec3};

use super::{Mark, Skin};

/// Mass and measures of a whale at rest, about the whale's frame.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Measures {
    /// Mass [kg].
    pub mass_kg: f64,
    /// Displaced volume [m³].
    pub volume_m3: f64,
    /// Area of the skin without the mouth's inside, which a closed mouth shuts off [m²].
    pub wetted_area_m2: f64,
    /// Centre of mass in the whale's frame [m].
    pub centre_m: DVec3,
    /// Inertia about the centre of mass, along the axes of the whale's frame [kg m²].
    pub inertia_kg_m2: DMat3,
}

impl Measures {
    /// Measures of a closed skin filled evenly with a density [kg/m³]; all zero for a skin that holds nothing.
    #[must_use]
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

    /// Measures of any closed surface, such as a skin in a posture, all of it wetted.
    #[must_use]
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

    /// A box of 2 by 3 by 4 m off the origin against the textbook.
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
