//! Hydrodynamics of the body: submerged volume, added mass, and drag of swimming.
//!
//! Submerged volume: with `s` the height above the water [m] and `n` the outward normal, the divergence theorem over the wet
//! skin gives the volume `V = ∮ s n_z dA` [m³] and its first moments `∮ x s n_z dA`, `∮ y s n_z dA` [m⁴]; the waterplane
//! contributes nothing, because
//! `s = 0` there. On a flat triangle the mean of a product of two linear functions `f`, `g` is `(Σ f_i g_i + Σ f_i Σ g_i)/12`.
//! Triangles across the waterline are cut along it, so that the result is exact for a closed mesh at any heel and draught.
//! Reference: Biran and López-Pulido 2014, Ship Hydrostatics and Stability, chapter 2; the sums were derived here.
//!
//! Added mass of a prolate spheroid of semi-axes `a` along and `b` across, `e² = 1 - b²/a²`, as shares of the displaced water:
//! `α₀ = 2(1-e²)/e³ (½ ln((1+e)/(1-e)) - e)`, `β₀ = 1/e² - (1-e²)/(2e³) ln((1+e)/(1-e))`,
//! `k₁ = α₀/(2-α₀)` along, `k₂ = β₀/(2-β₀)` across, and for rotation about a transverse axis
//! `k' = e⁴ (β₀-α₀) / ((2-e²) (2e² - (2-e²)(β₀-α₀)))`. Rotation about its own axis has no added mass, but fins have: two plates
//! of half span `s` and chord `c` have the added moment of inertia `(π/8) ρ c s⁴` [kg m²].
//! References: Lamb 1932, Hydrodynamics, articles 114 and 115; Newman 1977, Marine Hydrodynamics, section 4.15 for the plates.
//!
//! Drag of a swimming body: `D = ½ρ U² S C_D0 g k` [N], `C_D0 = C_f [1 + 1.5 (d/L)^1.5 + 7 (d/L)³]`, `C_f = 0.072 Re^-0.2`,
//! `Re = U L/ν`, so that `D = c U^1.8` with `c` constant. For a coasting body of mass `m`, `U^-0.8 - 0.8 c t/m` is constant.
//! Symbols: `U` speed [m/s], `S` wetted area [m²], `L` length [m], `d` greatest diameter [m], `g` factor of flippers and
//! flukes, `k` factor of the oscillation of the body, `ν` kinematic viscosity [m²/s]. An open mouth multiplies the drag by up
//! to its own factor.
//! References: van der Hoop et al. 2013 (doi:10.1111/mms.12042) and 2017 (doi:10.1242/jeb.149781); `C_f` and form factor after
//! Hoerner 1965.

use endline_sdk::Posture;
use glam::{DMat3, DQuat, DVec3};

use crate::whale::{Bounds, Measures, Skin, pose, skin_vertex};

/// A closed surface of flat triangles in the whale's frame.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Hull {
    places: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
    /// Enclosed volume [m³].
    pub volume_m3: f64,
    /// Centroid of that volume [m].
    pub middle_m: DVec3,
    /// The box around its vertices.
    bounds: Bounds,
}

/// Submerged volume.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Wetted {
    /// Volume [m³].
    pub volume_m3: f64,
    /// First moments of the volume, east and north of the reference point [m⁴].
    pub moment_m4: [f64; 2],
}

impl Hull {
    /// A skin in a posture.
    pub fn of(skin: &Skin, posture: &Posture) -> Self {
        let mut bones = Vec::new();
        pose(skin, DVec3::ZERO, DQuat::IDENTITY, posture, &mut bones);
        let places =
            (0..skin.vertices.len()).map(|vertex| skin_vertex(skin, &bones, vertex)).collect();
        Self::new(places, skin.triangles.clone())
    }

    /// A closed surface with these vertices.
    fn new(places: Vec<DVec3>, triangles: Vec<[u32; 3]>) -> Self {
        let held = Measures::of_triangles(&places, &triangles, 1.0);
        let bounds = Bounds::around(&places);
        Self { places, triangles, volume_m3: held.volume_m3, middle_m: held.centre_m, bounds }
    }

    /// Bound of how high it reaches above the point `centre` of its frame at this orientation [m].
    pub fn top_m(&self, centre: DVec3, orientation: DQuat) -> f64 {
        let up = orientation.conjugate() * DVec3::Z;
        let Bounds { low, high } = self.bounds;
        (up * low).max(up * high).element_sum() - up.dot(centre)
    }

    /// Computes the submerged volume with the point `centre` of its frame `height_m` above the surface, at this orientation.
    ///
    /// `turned` is a buffer of the rotated vertices.
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

    /// Buffer for [`wetted`](Self::wetted) of sufficient capacity.
    pub fn scratch(&self) -> Vec<DVec3> {
        Vec::with_capacity(self.places.len())
    }
}

impl Wetted {
    /// Adds the submerged part of a triangle; heights are above the surface.
    ///
    /// Corners are separate arguments: an array would be passed through memory, which costs more than the sum.
    fn add_cut(&mut self, a: DVec3, b: DVec3, c: DVec3) {
        // The single corner on its side of the surface is the first argument.
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

    /// Adds a triangle of which only corner `a` is dry.
    fn add_below(&mut self, a: DVec3, b: DVec3, c: DVec3) {
        let (on_b, on_c) = (at_surface(a, b), at_surface(a, c));
        self.add(on_b, b, c);
        self.add(on_b, c, on_c);
    }

    /// Adds a triangle of which only corner `a` is wet.
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

/// Intersection of an edge with the surface.
fn at_surface(from: DVec3, to: DVec3) -> DVec3 {
    from.lerp(to, from.z / (from.z - to.z))
}

/// Added mass of a prolate spheroid as shares of the displaced water.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shares {
    /// Along, `k₁`.
    pub along: f64,
    /// Across, `k₂`.
    pub across: f64,
    /// In rotation about a cross axis, `k'`.
    pub turning: f64,
}

/// Shares for a spheroid of this ratio of length to breadth, above 1.
///
/// Errors are below 1e-9 for ratios of 1.05 and more. Nearer to a sphere the difference of logarithms loses precision, and the
/// value for 1.05 is returned.
pub fn spheroid(slenderness: f64) -> Shares {
    let slenderness = slenderness.max(1.05);
    let square = 1.0 - 1.0 / (slenderness * slenderness);
    let e = square.sqrt();
    let log = libm::log1p(e) - libm::log1p(-e);
    let alpha = 2.0 * (1.0 - square) / (square * e) * (0.5 * log - e);
    let beta = 1.0 / square - (1.0 - square) / (2.0 * square * e) * log;
    let (less, more) = (2.0 - square, beta - alpha);
    Shares {
        along: alpha / (2.0 - alpha),
        across: beta / (2.0 - beta),
        turning: square * square * more / (less * (2.0 * square - less * more)),
    }
}

/// Added moment of inertia about the axis of a pair of fins of half span `s` and chord `c` [kg m²].
pub fn fins(density_kg_m3: f64, half_span_m: f64, chord_m: f64) -> f64 {
    let square = half_span_m * half_span_m;
    core::f64::consts::FRAC_PI_8 * density_kg_m3 * chord_m * square * square
}

/// Kinematic viscosity of sea water of the reference [m²/s].
const VISCOSITY_M2_S: f64 = 1e-6;

/// Drag of a body along its axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AxialDrag {
    /// Length [m].
    pub length_m: f64,
    /// Greatest diameter [m].
    pub diameter_m: f64,
    /// Wetted area [m²].
    pub wetted_area_m2: f64,
    /// Factor of flippers and flukes, `g`.
    pub appendages: f64,
    /// Factor of the oscillation of the body in swimming, `k`.
    pub oscillation: f64,
    /// Factor of a mouth wide open.
    pub open_mouth: f64,
    /// Jaw angle at which the mouth is wide open [rad].
    pub wide_rad: f64,
}

impl AxialDrag {
    /// Drag coefficient `C_D0` on wetted area at a positive speed.
    pub fn coefficient(&self, speed_m_s: f64) -> f64 {
        let slenderness = self.diameter_m / self.length_m;
        let friction = 0.072 * libm::pow(speed_m_s * self.length_m / VISCOSITY_M2_S, -0.2);
        friction
            * (1.0
                + 1.5 * libm::pow(slenderness, 1.5)
                + 7.0 * slenderness * slenderness * slenderness)
    }

    /// `c` of `D = c U^1.8` at a density of water and a jaw angle [N s^1.8/m^1.8].
    pub fn factor(&self, density_kg_m3: f64, jaw_rad: f64) -> f64 {
        let mouth = 1.0 + (self.open_mouth - 1.0) * (jaw_rad / self.wide_rad).clamp(0.0, 1.0);
        0.5 * density_kg_m3
            * self.wetted_area_m2
            * self.coefficient(1.0)
            * self.appendages
            * self.oscillation
            * mouth
    }

    /// Drag at a speed with the mouth closed [N].
    pub fn drag_n(&self, density_kg_m3: f64, speed_m_s: f64) -> f64 {
        drag_n(self.factor(density_kg_m3, 0.0), speed_m_s)
    }

    pub(super) fn fault(&self) -> Option<&'static str> {
        let sizes = [self.length_m, self.diameter_m, self.wide_rad];
        let factors = [self.wetted_area_m2, self.appendages, self.oscillation, self.open_mouth];
        let sound = sizes.iter().all(|size| size.is_finite() && *size > 0.0)
            && factors.iter().all(|factor| factor.is_finite() && *factor >= 0.0);
        (!sound).then_some("a property of its drag is below zero")
    }
}

/// Drag `c U^1.8` with the sign of the speed [N].
pub fn drag_n(factor: f64, speed_m_s: f64) -> f64 {
    factor * libm::pow(libm::fabs(speed_m_s), 0.8) * speed_m_s
}

/// Speed at which the drag `c U^1.8` has a value of at least zero [m/s]; zero for a body without drag.
pub(super) fn speed_of_drag(factor: f64, drag_n: f64) -> f64 {
    if factor > 0.0 { libm::pow(drag_n / factor, 1.0 / 1.8) } else { 0.0 }
}

/// Exact speed of a coasting body after a time, with `fading = c dt/m`; for a negative `fading`, the speed before that time
/// [m/s].
pub fn coast(speed_m_s: f64, fading: f64) -> f64 {
    if speed_m_s == 0.0 || fading == 0.0 {
        return speed_m_s;
    }
    let slowness = libm::pow(libm::fabs(speed_m_s), -0.8) + 0.8 * fading;
    if slowness <= 0.0 {
        // No such speed exists: extrapolate linearly with the present drag.
        return speed_m_s - fading * libm::pow(libm::fabs(speed_m_s), 0.8) * speed_m_s;
    }
    libm::copysign(libm::pow(slowness, -1.25), speed_m_s)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A box with these half extents about the origin.
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
    fn the_top_of_a_box_is_its_highest_corner() {
        let (hull, centre) = (crate_of(DVec3::new(4.0, 1.5, 0.5)), DVec3::new(1.0, 0.2, 0.1));
        for orientation in
            [DQuat::IDENTITY, DQuat::from_rotation_y(0.4) * DQuat::from_rotation_x(-2.0)]
        {
            let heights = hull.places.iter().map(|place| (orientation * (*place - centre)).z);
            let highest = heights.fold(f64::NEG_INFINITY, f64::max);
            assert!((hull.top_m(centre, orientation) - highest).abs() < 1e-12);
        }
    }

    #[test]
    fn a_box_displaces_its_volume_below_the_waterline() {
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
        // Heeled by 0.1 rad about x with its centre in the surface, half of the volume is submerged.
        let heeled = hull.wetted(DVec3::ZERO, DQuat::from_rotation_x(0.1), 0.0, &mut turned);
        assert!((heeled.volume_m3 - 12.0).abs() < 1e-12);
        // Its moment about the centre is that of the upright half, rotated, and of the two wedges: L b³ tan φ/12 (1 + tan²φ/2) along the keel.
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

    /// A buffer used for another hull and pose does not change the result, which is bit-equal to the sum over separately
    /// rotated triangles.
    #[test]
    fn shared_corners_give_the_bits_of_separate_triangles() {
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

    /// Adds a triangle, permuted so that the single corner on its side is first; returns the number of dry corners.
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

    #[test]
    fn shares_are_those_of_lambs_table() {
        // Lamb, article 115, printed to three digits with errors of up to two in the last: slenderness, k1, k2, k'.
        let table = [
            (1.50, 0.305, 0.621, 0.094),
            (2.00, 0.209, 0.702, 0.240),
            (3.99, 0.082, 0.860, 0.608),
            (6.01, 0.045, 0.918, 0.764),
            (9.97, 0.021, 0.960, 0.883),
        ];
        for (slenderness, along, across, turning) in table {
            let shares = spheroid(slenderness);
            for (ours, lamb) in
                [(shares.along, along), (shares.across, across), (shares.turning, turning)]
            {
                assert!((ours - lamb).abs() < 2.5e-3, "{slenderness}: {ours} against {lamb}");
            }
        }
    }

    fn whale(length_m: f64, mass_kg: f64, diameter_m: f64) -> AxialDrag {
        let wetted_area_m2 = 0.08 * libm::pow(mass_kg, 0.65);
        AxialDrag {
            length_m,
            diameter_m,
            wetted_area_m2,
            appendages: 1.3,
            oscillation: 1.5,
            open_mouth: 2.5,
            wide_rad: 0.26,
        }
    }

    #[test]
    fn drag_of_a_clean_whale_is_that_of_the_table() {
        let speeds = [0.5, 1.0, 1.23, 1.5, 2.0, 2.5];
        // Whales measured by van der Hoop: length, mass, diameter, coefficient at 1 m/s, drag at each speed.
        let table = [
            (whale(10.0, 7_000.0, 2.196), 0.00352, [25.5, 88.9, 129.0, 184.0, 310.0, 463.0]),
            (whale(13.6, 32_670.0, 2.93), 0.00329, [64.9, 226.0, 328.0, 469.0, 787.0, 1175.0]),
            (whale(13.7, 52_640.0, 2.96), 0.00329, [88.4, 308.0, 447.0, 639.0, 1072.0, 1602.0]),
            (whale(4.12, 1_230.0, 0.72), 0.00392, [9.2, 31.9, 46.4, 66.3, 111.0, 166.0]),
        ];
        for (whale, coefficient, drags) in table {
            assert!(
                (whale.coefficient(1.0) / coefficient - 1.0).abs() < 0.01,
                "{whale:?}: {}",
                whale.coefficient(1.0)
            );
            for (speed, drag) in speeds.into_iter().zip(drags) {
                let ours = whale.drag_n(1025.0, speed);
                assert!(
                    (ours / drag - 1.0).abs() < 0.01,
                    "{whale:?} at {speed} m/s: {ours} against {drag} N"
                );
            }
        }
    }

    #[test]
    fn coasting_solves_the_equation_of_motion_in_both_directions() {
        for speed in [2.5, 0.3, 1e-4, -1.2] {
            let fading = 1e-4;
            let (after, before) = (coast(speed, fading), coast(speed, -fading));
            assert!((coast(after, -fading) / speed - 1.0).abs() < 1e-12);
            let change = (after - before) / (2.0 * fading);
            assert!((change / -drag_n(1.0, speed) - 1.0).abs() < 1e-6, "{speed}: {change}");
        }
        assert_eq!(coast(0.0, 0.1).to_bits(), 0.0_f64.to_bits());
    }
}
