//! What a float displaces: how much of it is under water, where the middle of that lies, how it changes.
//!
//! A float's points stand at heights `z + Y` above the water, `z` its middle. With `n` the vertical part of its axis:
//!
//! | form | distribution of `Y` | wet share |
//! |---|---|---|
//! | level, height `h` | uniform over `h`, however it lies | `clamp(1/2 - z/h, 0, 1)` |
//! | spheroid, half axes `a` across, `c` along | ball of radius `ρ = √(c²n² + a²(1 - n²))` | `t²(3 - 2t)`, `t = (1 - z/ρ)/2`: the spherical cap |
//! | cylinder, radius `r`, length `l` | uniform over `l·abs(n)` plus semicircle of radius `r √(1 - n²)` | mean of the semicircle's share over the uniform part |
//!
//! Drag is that of the area under water which faces a level flow: of a spheroid the segment `1/2 - (x √(1 - x²) + asin x)/π` of its
//! outline, `x = z/ρ`, twice the share of the volume where it floats high; of the others the share of the volume, which is the
//! same for a cylinder that stands or lies along the flow.
//!
//! All are exact at any tilt and draft. The buoyancy's turning moment is `E[x 1(wet)] × ρ g V ẑ` with `x` the place of a
//! point from the middle; share and moment are derivatives of one potential, so that a float gains no energy by rolling.
//! Reference: Biran and López-Pulido 2014, Ship Hydrostatics and Stability, chapter 2; the integrals are our own.

use glam::DVec3;

use std::f64::consts::PI;

/// Share of a body's displaced volume, with the drag of the surface around it.
#[derive(Clone, Debug, PartialEq)]
pub struct Float {
    /// Centre in the body's frame [m].
    pub offset_m: DVec3,
    /// Volume when wholly under water [m³].
    pub volume_m3: f64,
    /// How it goes under.
    pub form: Form,
    /// Drag coefficient times area by body axis, at its centre and as far as it is wet [m²].
    pub drag_area_m2: DVec3,
}

/// Shape of a float about its centre, its axis along the body's z.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Form {
    /// Goes under evenly over a height, however it lies.
    Level {
        /// The height [m].
        height_m: f64,
    },
    /// Ellipsoid of revolution; a sphere where both are the same.
    Spheroid {
        /// Half axis across [m].
        across_m: f64,
        /// Half axis along [m].
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

/// A float at a height.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wet {
    /// Share of the volume under water.
    pub share: f64,
    /// Share under water of the area that faces a level flow.
    pub facing: f64,
    /// How fast that share falls as the float rises [1/m].
    pub slope: f64,
    /// Mean of the places under water from the float's centre, times the share; world frame [m].
    pub moment: DVec3,
    /// Size of the change of that moment with a tilt, for the solver's matrix [m].
    pub turn: f64,
}

impl Wet {
    fn plain(share: f64, slope: f64) -> Self {
        Self { share, facing: share, slope, moment: DVec3::ZERO, turn: 0.0 }
    }
}

impl Float {
    /// A float that goes under evenly over a height, without drag of its own.
    #[must_use]
    pub fn level(offset_m: DVec3, volume_m3: f64, height_m: f64) -> Self {
        Self { offset_m, volume_m3, form: Form::Level { height_m }, drag_area_m2: DVec3::ZERO }
    }
}

impl Form {
    /// Its state with its centre `height_m` above the water and its axis along the unit vector `axis` of the world.
    #[must_use]
    pub fn wet(&self, height_m: f64, axis: DVec3) -> Wet {
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

    /// How far its highest point stands above its centre [m].
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

    /// Whether its measures can be.
    pub(crate) fn is_sound(&self) -> bool {
        let sound = |size: f64| size.is_finite() && size > 0.0;
        match *self {
            Self::Level { height_m } => sound(height_m),
            Self::Spheroid { across_m, along_m } => sound(across_m) && sound(along_m),
            Self::Cylinder { radius_m, length_m } => sound(radius_m) && sound(length_m),
        }
    }
}

/// The wet cap of a ball, stretched: `E[p 1] = -3/16 (1 - x²)² u` for a unit ball cut at `x` along `u`.
fn spheroid(height: f64, axis: DVec3, across: f64, along: f64, reach: f64) -> Wet {
    let x = height / reach;
    let t = 0.5 * (1.0 - x);
    let cap = 3.0 / 16.0 * (1.0 - x * x) * (1.0 - x * x) / reach;
    let longer = along * along - across * across;
    Wet {
        share: t * t * (3.0 - 2.0 * t),
        facing: Semicircle { radius: reach }.share(-height),
        slope: 3.0 * t * (1.0 - t) / reach,
        moment: (DVec3::Z * (across * across) + axis * (longer * axis.z)) * -cap,
        turn: cap * longer.abs(),
    }
}

/// Below this share of the semicircle's radius the uniform part is taken as a point, to second order.
const FLAT: f64 = 1e-3;

fn cylinder(height: f64, axis: DVec3, radius: f64, length: f64) -> Wet {
    let lying = (1.0 - axis.z * axis.z).max(0.0).sqrt();
    let (uniform, circle) =
        (length * axis.z.abs(), Semicircle { radius: (radius * lying).max(1e-12 * radius) });
    let depth = -height;
    let (low, high) = (depth - 0.5 * uniform, depth + 0.5 * uniform);
    let (share, slope, across, along) = if uniform < FLAT * circle.radius {
        let density = circle.density(depth);
        (circle.share(depth), density, circle.first(depth) / lying, -uniform * density / 12.0)
    } else {
        let mean = |f: &dyn Fn(f64) -> f64| (f(high) - f(low)) / uniform;
        let share = mean(&|u| circle.share_integral(u));
        let ends = 0.5 * (circle.share_integral(high) + circle.share_integral(low));
        let along = (mean(&|u| circle.share_second_integral(u)) - ends) / uniform;
        (share, mean(&|u| circle.share(u)), radius * mean(&|u| circle.first_integral(u)), along)
    };
    // `across` is by the sine of the tilt: its direction is (ẑ - n·axis)/sine.
    let sign = if axis.z < 0.0 { -1.0 } else { 1.0 };
    let moment = (DVec3::Z - axis * axis.z) * (radius * across) + axis * (sign * length * along);
    Wet { share, facing: share, slope, moment, turn: 0.25 * slope * radius * radius }
}

/// Heights of a disc's points: density `2√(1 - q²)/πR` with `q = u/R`.
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

    /// Share of the disc below `u`.
    fn share(&self, u: f64) -> f64 {
        let (q, root, angle) = self.parts(u);
        0.5 + (q * root + angle) / PI
    }

    /// Integral of the share from far below.
    fn share_integral(&self, u: f64) -> f64 {
        let (q, root, angle) = self.parts(u);
        let inside = 0.5 * q + (q * angle + root) / PI - root * root * root / (3.0 * PI);
        self.radius * inside + (u - self.radius).max(0.0)
    }

    /// Integral of that.
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

    /// Integral of that over `u/R`.
    fn first_integral(&self, u: f64) -> f64 {
        let (q, root, angle) = self.parts(u);
        -2.0 * cubed(q, root, angle) / (3.0 * PI)
    }
}

/// Integral of `(1 - q²)^(3/2)` from zero.
fn cubed(q: f64, root: f64, angle: f64) -> f64 {
    q * (5.0 - 2.0 * q * q) * root / 8.0 + 0.375 * angle
}

#[cfg(test)]
#[path = "float_tests.rs"]
mod tests;
