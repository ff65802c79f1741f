//! Hydrostatics of a float: submerged share, its centroid and its derivatives; what water that passes adds at the surface.
//!
//! The points of a float are at heights `z + Y` above the water, with `z` the height of its centre [m]. With `n` the vertical
//! component of its axis:
//!
//! | form | distribution of `Y` | submerged share |
//! |---|---|---|
//! | level, height `h` | uniform over `h` at any tilt | `clamp(1/2 - z/h, 0, 1)` |
//! | spheroid, semi-axes `a` across, `c` along | ball of radius `ρ = √(c²n² + a²(1 - n²))` | `t²(3 - 2t)`, `t = (1 - z/ρ)/2`: the spherical cap |
//! | cylinder, radius `r`, length `l` | uniform over `l·abs(n)` plus semicircle of radius `r √(1 - n²)` | mean of the semicircle's share over the uniform part |
//!
//! Drag scales with the submerged share of the area that faces a horizontal flow. For a spheroid this is the circular segment
//! `1/2 - (x √(1 - x²) + asin x)/π` of its outline with `x = z/ρ`. For the other forms it is the share of the volume, which
//! is exact for a cylinder that is upright or lies along the flow.
//!
//! All formulas are exact at any tilt and draft. The moment of buoyancy is `E[x 1(wet)] × ρ g V ẑ` with `x` the vector from the
//! centre to a point, `ρ` the density of water, `g` gravity and `V` the volume. Share and moment are derivatives of one
//! potential, so that a float gains no energy by rolling.
//! Reference: Biran and López-Pulido 2014, Ship Hydrostatics and Stability, chapter 2; the integrals were derived here.
//!
//! Water that passes a body at the surface with the level speed `U` draws it down and raises waves ([`WaterPlane::in_flow`]).
//! With its water-plane `A`, radius `a = √(A/π)`, wet volume `V` of the whole `V₀`, draught over radius `r`, Froude number `F`:
//!
//! ```text
//! r = (3/2) V/(A a)      F² = U²/(2 g a)      φ = 1 - (V/V₀)⁸
//! force down      ½ρU² A C φ / (1 + (F/1.2)⁴)      C = (5/4) r/(r + 9/11)
//! factor on drag  1 + w C φ (s exp(1 - s))⁴        s = (0.9/F)²
//! ```
//!
//! `C` is the suction of potential flow under a still surface. It is 11/16 for half of a sphere and within 3 % of that on half
//! of any spheroid up to `r = 2`, `(1 + k)² (1 - mean n_x²) - 1` with the added mass `k` (Lamb 1932, article 114) and the
//! normal's part `n_x` along the flow. 5/4 is the suction on the crown of a sphere under water. The bound 1.2 is where floats
//! begin to skip, and waves begin at about 0.6 (Kamoliddinov, Vakarelski and Thoroddsen 2021, doi:10.1063/5.0061768). `φ` is
//! ours; with it both terms end as a float goes under. `w` = 0.3 is ours as well: the open tows of a float allow 0 to 1
//! (`docs/lab-notebook.md`, drag of a towed float).

use std::f64::consts::PI;

use glam::DVec3;

/// Part of a body's displaced volume, with the drag of its surface.
#[derive(Clone, Debug, PartialEq)]
pub struct Float {
    /// Centre in the body's frame [m].
    pub offset_m: DVec3,
    /// Volume when fully submerged [m³].
    pub volume_m3: f64,
    /// Shape.
    pub form: Form,
    /// Drag coefficient times area when fully submerged, by body axis, at its centre [m²].
    pub drag_area_m2: DVec3,
}

/// Shape of a float about its centre; its axis is the body's z axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Form {
    /// Submerged share proportional to the draft over a height, at any tilt.
    Level {
        /// Height [m].
        height_m: f64,
    },
    /// Ellipsoid of revolution; a sphere if both semi-axes are equal.
    Spheroid {
        /// Semi-axis across [m].
        across_m: f64,
        /// Semi-axis along [m].
        along_m: f64,
    },
    /// Circular cylinder with flat ends.
    Cylinder {
        /// Radius [m].
        radius_m: f64,
        /// Length [m].
        length_m: f64,
    },
}

/// Submerged part of a float.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wet {
    /// Submerged share of the volume.
    pub share: f64,
    /// Submerged share of the area that faces a horizontal flow.
    pub facing: f64,
    /// Decrease of the submerged share of the volume with height: water-plane over volume [1/m].
    pub slope: f64,
    /// Growth of that slope with depth [1/m²].
    pub widening: f64,
    /// First moment of the submerged part about the float's centre: its centroid times the share; world frame [m].
    pub moment: DVec3,
    /// Bound of the derivative of that moment with respect to tilt, for the solver's matrix [m].
    pub turn: f64,
}

impl Wet {
    fn plain(share: f64, slope: f64) -> Self {
        Self { share, facing: share, slope, widening: 0.0, moment: DVec3::ZERO, turn: 0.0 }
    }
}

impl Float {
    /// A float of the form [`Form::Level`] without drag.
    pub fn level(offset_m: DVec3, volume_m3: f64, height_m: f64) -> Self {
        Self { offset_m, volume_m3, form: Form::Level { height_m }, drag_area_m2: DVec3::ZERO }
    }
}

impl Form {
    /// Submerged part with the centre `height_m` above the water and the axis along the unit vector `axis`, world frame.
    pub fn wet(&self, height_m: f64, axis: DVec3) -> Wet {
        let is_unit = (axis.length_squared() - 1.0).abs() < 1e-6;
        debug_assert!(is_unit || !axis.is_finite(), "the axis is a unit vector: {axis}");
        let reach = self.reach_m(axis);
        if height_m >= reach {
            return Wet::plain(0.0, 0.0);
        }
        if height_m <= -reach {
            return Wet::plain(1.0, 0.0);
        }
        match *self {
            Self::Level { height_m: whole } => Wet::plain(0.5 - height_m / whole, 1.0 / whole),
            Self::Spheroid { across_m, along_m } => {
                spheroid(height_m, axis, across_m, along_m, reach)
            }
            Self::Cylinder { radius_m, length_m } => cylinder(height_m, axis, radius_m, length_m),
        }
    }

    /// Height of its highest point above its centre [m].
    fn reach_m(&self, axis: DVec3) -> f64 {
        let upright = axis.z * axis.z;
        let level = (1.0 - upright).max(0.0);
        match *self {
            Self::Level { height_m } => 0.5 * height_m,
            Self::Spheroid { across_m, along_m } => {
                (along_m * along_m * upright + across_m * across_m * level).sqrt()
            }
            Self::Cylinder { radius_m, length_m } => {
                0.5 * length_m * axis.z.abs() + radius_m * level.sqrt()
            }
        }
    }

    /// Whether all dimensions are positive and finite.
    pub(crate) fn is_sound(&self) -> bool {
        let sound = |size: f64| size.is_finite() && size > 0.0;
        match *self {
            Self::Level { height_m } => sound(height_m),
            Self::Spheroid { across_m, along_m } => sound(across_m) && sound(along_m),
            Self::Cylinder { radius_m, length_m } => sound(radius_m) && sound(length_m),
        }
    }
}

/// Suction on the crown of a sphere under water, over the dynamic pressure.
const CROWN: f64 = 5.0 / 4.0;
/// Draught over radius at which a float has half of that; with it half of a sphere has 11/16.
const HALF_DRAWN: f64 = 9.0 / 11.0;
/// Froude number, by the diameter of the water-plane, at which floats begin to skip.
const SKIPS: f64 = 1.2;
/// Froude number of the greatest wave drag.
const CREST: f64 = 0.9;
/// Greatest wave drag over the drag of the wet part, for half of a sphere times 16/11.
const WAVES: f64 = 0.3;
/// Least and greatest change of a float's stiffness by the force that draws it down, in the matrix.
const SOFTENS: [f64; 2] = [-1.0, 0.75];

/// Water-plane and wet volume of a body, summed over its floats.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct WaterPlane {
    /// Area [m²].
    pub area_m2: f64,
    /// Volume under water [m³].
    pub wet_m3: f64,
    /// Volume of all floats [m³].
    pub whole_m3: f64,
    /// Growth of the area with depth [m].
    pub widening_m: f64,
}

/// What passing water adds to a body at the surface.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Passing {
    /// Force down, over the area of the water-plane [Pa].
    pub pull_pa: f64,
    /// Growth of the force down with depth, over the area of the water-plane, as the solver's matrix uses it [Pa/m].
    pub softening_pa_m: f64,
    /// Wave drag over the drag of the wet part.
    pub waves: f64,
    /// Its derivative with respect to the logarithm of speed.
    pub waves_growth: f64,
}

impl WaterPlane {
    /// Adds a float with its wet part.
    pub fn add(&mut self, float: &Float, wet: &Wet) {
        self.area_m2 += float.volume_m3 * wet.slope;
        self.wet_m3 += float.volume_m3 * wet.share;
        self.whole_m3 += float.volume_m3;
        self.widening_m += float.volume_m3 * wet.widening;
    }

    /// Forces of water that passes with this level speed; `speed_squared` is its square [m²/s²].
    pub fn in_flow(&self, speed_squared: f64, density_kg_m3: f64, gravity_m_s2: f64) -> Passing {
        let Self { area_m2: area, wet_m3: wet, whole_m3: whole, widening_m: widening } = *self;
        // Below a micrometre per second, and with less than a square micrometre of water-plane, the forces are none.
        if area < 1e-12 || wet <= 0.0 || speed_squared < 1e-12 {
            return Passing::default();
        }
        let radius = (area / PI).sqrt();
        let draught = 1.5 * wet / (area * radius);
        let froude_squared = speed_squared / (2.0 * gravity_m_s2 * radius);
        let part = (wet / whole).min(1.0);
        let seventh = part * part * part * part * part * part * part;
        let dry = 1.0 - part * seventh;
        let suction = CROWN * draught / (draught + HALF_DRAWN) * dry;
        let skips = froude_squared / (SKIPS * SKIPS);
        let skips = skips * skips;
        let pull_pa = 0.5 * density_kg_m3 * speed_squared * suction / (1.0 + skips);

        // Logarithmic derivatives of the force by area and by wet volume.
        let share = HALF_DRAWN / (draught + HALF_DRAWN);
        let by_area = 1.0 - 1.5 * share + skips / (1.0 + skips);
        let by_volume = share / wet - 8.0 * seventh / (whole * dry.max(1e-9));
        let weight = density_kg_m3 * gravity_m_s2;
        let softening_pa_m = (pull_pa * (by_area * widening / area + by_volume * area))
            .clamp(SOFTENS[0] * weight, SOFTENS[1] * weight);

        let ratio = CREST * CREST / froude_squared;
        let hump = ratio * libm::exp(1.0 - ratio);
        let waves = WAVES * suction * (hump * hump) * (hump * hump);
        Passing { pull_pa, softening_pa_m, waves, waves_growth: 8.0 * (ratio - 1.0) * waves }
    }
}

/// Submerged cap of a ball under a linear map: `E[p 1] = -3/16 (1 - x²)² u` for a unit ball cut at `x` along `u`.
fn spheroid(height: f64, axis: DVec3, across: f64, along: f64, reach: f64) -> Wet {
    let x = height / reach;
    let t = 0.5 * (1.0 - x);
    let cap = 3.0 / 16.0 * (1.0 - x * x) * (1.0 - x * x) / reach;
    let longer = along * along - across * across;
    Wet {
        share: t * t * (3.0 - 2.0 * t),
        facing: Semicircle { radius: reach }.share(-height),
        slope: 3.0 * t * (1.0 - t) / reach,
        widening: 1.5 * (1.0 - 2.0 * t) / (reach * reach),
        moment: (DVec3::Z * (across * across) + axis * (longer * axis.z)) * -cap,
        turn: cap * longer.abs(),
    }
}

/// Ratio of the uniform part to the semicircle's radius below which a series of second order is used.
const FLAT: f64 = 1e-3;

fn cylinder(height: f64, axis: DVec3, radius: f64, length: f64) -> Wet {
    let lying = (1.0 - axis.z * axis.z).max(0.0).sqrt();
    let (uniform, circle) =
        (length * axis.z.abs(), Semicircle { radius: (radius * lying).max(1e-12 * radius) });
    let depth = -height;
    let (low, high) = (depth - 0.5 * uniform, depth + 0.5 * uniform);
    let (share, slope, widening, across, along) = if uniform < FLAT * circle.radius {
        let density = circle.density(depth);
        let widening = circle.growth(depth);
        let first = circle.first(depth) / lying;
        (circle.share(depth), density, widening, first, -uniform * density / 12.0)
    } else {
        let mean = |f: &dyn Fn(f64) -> f64| (f(high) - f(low)) / uniform;
        let share = mean(&|u| circle.share_integral(u));
        let ends = 0.5 * (circle.share_integral(high) + circle.share_integral(low));
        let along = (mean(&|u| circle.share_second_integral(u)) - ends) / uniform;
        let across = radius * mean(&|u| circle.first_integral(u));
        (share, mean(&|u| circle.share(u)), mean(&|u| circle.density(u)), across, along)
    };
    // `across` is divided by the sine of the tilt, because its direction is (ẑ - n·axis)/sine.
    let sign = if axis.z < 0.0 { -1.0 } else { 1.0 };
    let moment = (DVec3::Z - axis * axis.z) * (radius * across) + axis * (sign * length * along);
    Wet { share, facing: share, slope, widening, moment, turn: 0.25 * slope * radius * radius }
}

/// Distribution of the heights `u` of a disc's points: density `2√(1 - q²)/πR` with `q = u/R`.
struct Semicircle {
    radius: f64,
}

impl Semicircle {
    fn parts(&self, u: f64) -> (f64, f64, f64) {
        let q = (u / self.radius).clamp(-1.0, 1.0);
        (q, (1.0 - q * q).max(0.0).sqrt(), libm::asin(q))
    }

    fn density(&self, u: f64) -> f64 {
        2.0 * self.parts(u).1 / (PI * self.radius)
    }

    /// Derivative of the density, bounded at the rim.
    fn growth(&self, u: f64) -> f64 {
        let (q, root, _) = self.parts(u);
        -2.0 * q / (PI * self.radius * self.radius * root.max(FLAT))
    }

    /// Share of the disc below `u`.
    fn share(&self, u: f64) -> f64 {
        let (q, root, angle) = self.parts(u);
        0.5 + (q * root + angle) / PI
    }

    /// Integral of the share from minus infinity to `u`.
    fn share_integral(&self, u: f64) -> f64 {
        let (q, root, angle) = self.parts(u);
        let inside = 0.5 * q + (q * angle + root) / PI - root * root * root / (3.0 * PI);
        self.radius * inside + (u - self.radius).max(0.0)
    }

    /// Second integral of the share.
    fn share_second_integral(&self, u: f64) -> f64 {
        let (q, root, angle) = self.parts(u);
        let inside = 0.25 * q * q + ((0.5 * q * q + 0.25) * angle + 0.75 * q * root) / PI
            - cubed(q, root, angle) / (3.0 * PI)
            + 0.0625;
        let beyond = (u * u - self.radius * self.radius).max(0.0);
        self.radius * self.radius * inside + if u > self.radius { 0.5 * beyond } else { 0.0 }
    }

    /// Mean of `q` over the part below `u`, times its share.
    fn first(&self, u: f64) -> f64 {
        let (_, root, _) = self.parts(u);
        -2.0 * root * root * root / (3.0 * PI)
    }

    /// Integral of `first` over `u/R`.
    fn first_integral(&self, u: f64) -> f64 {
        let (q, root, angle) = self.parts(u);
        -2.0 * cubed(q, root, angle) / (3.0 * PI)
    }
}

/// Integral of `(1 - q²)^(3/2)` from 0 to `q`.
fn cubed(q: f64, root: f64, angle: f64) -> f64 {
    q * (5.0 - 2.0 * q * q) * root / 8.0 + 0.375 * angle
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DQuat;

    const SPHERE: Form = Form::Spheroid { across_m: 0.2, along_m: 0.2 };
    const EGG: Form = Form::Spheroid { across_m: 0.16, along_m: 0.29 };
    const STAFF: Form = Form::Cylinder { radius_m: 0.02, length_m: 3.4 };
    const DRUM: Form = Form::Cylinder { radius_m: 0.15, length_m: 0.4 };

    fn tilted(angle: f64) -> DVec3 {
        DQuat::from_rotation_x(angle) * DVec3::Z
    }

    /// Submerged share and first moment, summed over points distributed uniformly over the volume.
    fn summed(form: Form, height: f64, axis: DVec3) -> (f64, DVec3) {
        let turn = DQuat::from_rotation_arc(DVec3::Z, axis);
        let (slices, rings, spokes) = (160, 40, 48);
        let (mut share, mut moment, mut all) = (0.0, DVec3::ZERO, 0.0);
        for slice in 0..slices {
            let t = (f64::from(slice) + 0.5) / f64::from(slices) * 2.0 - 1.0;
            let (z, radius) = match form {
                Form::Spheroid { across_m, along_m } => {
                    (t * along_m, across_m * (1.0 - t * t).sqrt())
                }
                Form::Cylinder { radius_m, length_m } => (0.5 * t * length_m, radius_m),
                Form::Level { height_m } => (0.5 * t * height_m, 1.0),
            };
            for cell in 0..rings * spokes {
                let r = radius * ((f64::from(cell / spokes) + 0.5) / f64::from(rings)).sqrt();
                let around = 2.0 * PI * (f64::from(cell % spokes) + 0.5) / f64::from(spokes);
                let place = turn * DVec3::new(r * libm::cos(around), r * libm::sin(around), z);
                let weight = radius * radius;
                all += weight;
                if height + place.z < 0.0 {
                    share += weight;
                    moment += place * weight;
                }
            }
        }
        (share / all, moment / all)
    }

    #[test]
    fn share_and_moment_are_those_of_the_submerged_points() {
        for form in [SPHERE, EGG, STAFF, DRUM] {
            for angle in [0.0, 0.02, 0.4, 1.1, 1.5, 0.5 * PI, 2.6] {
                let axis = tilted(angle);
                for part in [-0.8, -0.3, 0.05, 0.6] {
                    let height = part * form.reach_m(axis);
                    let (wet, (share, moment)) =
                        (form.wet(height, axis), summed(form, height, axis));
                    assert!(
                        (wet.share - share).abs() < 0.008,
                        "{form:?} {angle} {part}: {} for {share}",
                        wet.share
                    );
                    let off = (wet.moment - moment).length();
                    assert!(
                        off < 0.008 * form.reach_m(axis).max(0.02),
                        "{form:?} {angle} {part}: {} for {moment}",
                        wet.moment
                    );
                }
            }
        }
    }

    /// Share and moment are derivatives of one potential: `dW/dz = -share`, and with respect to tilt the cross product of
    /// moment and `ẑ`.
    #[test]
    fn a_float_gains_no_energy_by_rolling() {
        for form in [SPHERE, EGG, STAFF, DRUM] {
            for angle in [0.01, 0.3, 0.9, 1.3, 1.5, 1.565, 1.5703] {
                let axis = tilted(angle);
                for part in [-0.7, 0.0, 0.4] {
                    let height = part * form.reach_m(axis);
                    let (d, at) = (1e-6, |height: f64, angle: f64| form.wet(height, tilted(angle)));
                    // Mixed derivatives agree: that of the share by tilt and that of the moment by height.
                    let by_tilt =
                        (at(height, angle + d).share - at(height, angle - d).share) / (2.0 * d);
                    let turning = |height: f64| at(height, angle).moment.cross(DVec3::Z).x;
                    let by_height = (turning(height + d) - turning(height - d)) / (2.0 * d);
                    assert!(
                        (by_tilt - by_height).abs() < 2e-4 * (1.0 + by_tilt.abs()),
                        "{form:?} {angle} {part}: {by_tilt} {by_height}"
                    );
                    let slope =
                        (at(height - d, angle).share - at(height + d, angle).share) / (2.0 * d);
                    let expected = at(height, angle).slope;
                    assert!(
                        (slope - expected).abs() < 1e-4 * expected,
                        "{form:?} {angle} {part}: {slope} {expected}"
                    );
                }
            }
        }
    }

    /// `V_wet = π d² (3R - d)/3` at draft `d`.
    #[test]
    fn a_sphere_displaces_its_cap() {
        for draft in [0.01, 0.1, 0.2, 0.37] {
            let cap = draft * draft * (0.6 - draft) / 3.0 / (4.0 / 3.0 * 0.2 * 0.2 * 0.2);
            assert!((SPHERE.wet(0.2 - draft, DVec3::Z).share - cap).abs() < 1e-14);
        }
    }

    /// Submerged share of a float's outline across a horizontal flow, summed over a grid of lines along the flow.
    fn outline_under_water(form: Form, height: f64, axis: DVec3, along_flow: DVec3) -> f64 {
        let Form::Spheroid { across_m, along_m } = form else { panic!("{form:?}") };
        let stretch = DVec3::new(1.0 / across_m, 1.0 / across_m, 1.0 / along_m);
        let to_ball = |v: DVec3| stretch * (DQuat::from_rotation_arc(axis, DVec3::Z) * v);
        let (side, reach) = (along_flow.cross(DVec3::Z), across_m.max(along_m));
        let (mut under, mut all, cells) = (0.0, 0.0, 600);
        let at = |cell: i32| (f64::from(cell) + 0.5) / f64::from(cells) * 2.0 * reach - reach;
        for (row, column) in (0..cells).flat_map(|row| (0..cells).map(move |column| (row, column)))
        {
            let place = to_ball(DVec3::Z * at(row) + side * at(column));
            let ray = to_ball(along_flow).normalize();
            if (place - place.dot(ray) * ray).length() < 1.0 {
                all += 1.0;
                under += f64::from(u8::from(height + at(row) < 0.0));
            }
        }
        under / all
    }

    #[test]
    fn the_facing_share_is_that_of_the_submerged_outline() {
        for (form, angle) in [(SPHERE, 0.0), (EGG, 0.0), (EGG, 0.7), (EGG, 0.5 * PI)] {
            for part in [-0.7, 0.1, 0.8] {
                let axis = tilted(angle);
                let height = part * form.reach_m(axis);
                let facing = form.wet(height, axis).facing;
                for along in [DVec3::X, DVec3::Y, DVec3::new(0.6, 0.8, 0.0)] {
                    let sum = outline_under_water(form, height, axis, along);
                    assert!(
                        (facing - sum).abs() < 0.004,
                        "{form:?} {angle} {part}: {facing}, {sum}"
                    );
                }
            }
        }
    }

    /// The restoring moment of an upright cylinder at a small heel: `ρ g π r⁴/4` per radian about its centre from the
    /// waterplane, and the part of buoyancy below the centre (wall-sided formula).
    #[test]
    fn an_upright_cylinder_rights_itself_by_its_waterplane() {
        let (radius, length, angle) = (0.15, 0.4, 1e-4);
        let wet = DRUM.wet(0.05, tilted(angle));
        let (share, area) = (0.5 - 0.05 / length, PI * radius * radius);
        let volume = area * length;
        assert!((wet.share - share).abs() < 1e-9);
        // The centroid of the submerged part is below the centre by half of the dry length.
        let below = 0.5 * (1.0 - share) * length;
        let expected =
            (-PI * radius * radius * radius * radius / 4.0 / volume + share * below) * angle;
        let turning = wet.moment.cross(DVec3::Z).x;
        assert!((turning / expected - 1.0).abs() < 1e-6, "{turning} for {expected}");
    }

    #[test]
    fn the_share_of_a_level_float_is_linear_in_the_draft() {
        let wet = Form::Level { height_m: 0.25 }.wet(0.05, tilted(0.7));
        assert!(
            (wet.share - 0.3).abs() < 1e-15
                && (wet.slope - 4.0).abs() < 1e-15
                && wet.moment == DVec3::ZERO
        );
    }
}
