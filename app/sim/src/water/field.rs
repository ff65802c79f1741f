//! Kinematics of waves: linear (Airy) theory, summed over components.
//!
//! With amplitude `a` [m], wave number `k` [rad/m], angular frequency `ω` [rad/s], depth `d` [m] and phase
//! `θ = k s - ω t + ε`, where `s` is the distance along the direction of propagation:
//!
//! | quantity | formula |
//! |---|---|
//! | surface | `a cos θ` |
//! | velocity along, up | `a ω C cos θ`, `a ω S sin θ` |
//! | acceleration along, up | `a ω² C sin θ`, `-a ω² S cos θ` |
//!
//! `C = cosh k(z+d)/sinh kd = (E + F)/(1 - e^{-2kd})`, `S = (E - F)/(1 - e^{-2kd})`, `E = e^{kz}`, `F = e^{-k(z+2d)}`.
//! Above the mean surface the values are those at z = 0 (constant stretching); below the depth at the origin they are those
//! there.
//! All quantities are multiplied by a ramp `r(t) = q²(3 - 2q)`, `q = t/T`, which is zero at time zero, when gear is at rest.
//! The acceleration includes the additional term `u dr/dt`, so that it remains the derivative of the velocity.
//!
//! Along a rope the fields are advanced from node to node: power series update the phase and `E`, `F` for a short move, four
//! components at a time. A long move evaluates the functions directly.
//! Reference: Airy 1845; DNV-RP-C205, sections 3.2 and 3.3.

use glam::DVec3;

use super::WaterAt;
use super::waves::{Waves, wave_number};

/// Greatest change of phase or decay exponent for the series; their error is then below 1e-12 [rad].
const SERIES_REACH: f64 = 0.5;

/// Greatest number of such moves before direct evaluation.
const MOST_MOVES: f64 = 4.0;

/// Value of `2 k d` above which `F` at the surface is zero.
const BOTTOMLESS: f64 = 500.0;

/// The waves of a model.
#[derive(Clone, Debug)]
pub struct Field {
    toward: DVec3,
    ramp_s: f64,
    depth_m: f64,
    /// Greatest wave number.
    shortest: f64,
    groups: Vec<Figures>,
}

/// Value of the ramp and its rate.
#[derive(Clone, Copy, Debug, Default)]
struct Ramp {
    share: f64,
    /// [1/s]
    rate: f64,
}

/// State of the evaluation along a rope; `Field::begin` resets it.
#[derive(Clone, Debug, Default)]
pub struct Walk {
    ramp: Ramp,
    time_s: f64,
    /// Distance along the direction of propagation and height of the last position; NaN before the first.
    at: (f64, f64),
    groups: Vec<Stand>,
}

impl Field {
    /// Field of waves in water of this depth under this gravity.
    pub fn new(waves: &Waves, depth_m: f64, gravity_m_s2: f64, seed: u64) -> Self {
        let components = waves.components(seed);
        let (mut groups, mut shortest) = (Vec::new(), 0.0_f64);
        for chunk in components.chunks(LANES) {
            let mut group = Figures::default();
            for (lane, wave) in chunk.iter().enumerate() {
                let number = wave_number(wave.frequency_rad_s, depth_m, gravity_m_s2);
                shortest = shortest.max(number);
                group.number[lane] = number;
                group.amplitude[lane] = wave.amplitude_m;
                group.frequency[lane] = wave.frequency_rad_s;
                group.phase[lane] = wave.phase_rad;
                let twice = 2.0 * number * depth_m;
                group.bottom[lane] = if twice < BOTTOMLESS { libm::exp(-twice) } else { 0.0 };
                group.whole[lane] = -1.0 / libm::expm1(-twice);
            }
            groups.push(group);
        }
        Self { toward: waves.toward, ramp_s: waves.ramp_s, depth_m, shortest, groups }
    }

    /// Whether the waves have started: after time zero.
    pub fn runs_at(&self, time_s: f64) -> bool {
        time_s > 0.0
    }

    /// The ramp at a time.
    fn ramp(&self, time_s: f64) -> Ramp {
        if time_s >= self.ramp_s {
            return Ramp { share: 1.0, rate: 0.0 };
        }
        let share = time_s / self.ramp_s;
        Ramp {
            share: share * share * (3.0 - 2.0 * share),
            rate: 6.0 * share * (1.0 - share) / self.ramp_s,
        }
    }

    /// Kinematics at one position; zero until time zero.
    pub fn at(&self, place: DVec3, time_s: f64) -> WaterAt {
        if !self.runs_at(time_s) {
            return WaterAt::default();
        }
        let (along, height) = self.coordinates(place);
        let mut sums = Sums::default();
        for group in &self.groups {
            sums.add(group, &group.stand(along, height, time_s));
        }
        self.water_at(sums, self.ramp(time_s))
    }

    /// Starts the evaluation along a rope at a time; allocates only on first use.
    pub fn begin(&self, walk: &mut Walk, time_s: f64) {
        walk.ramp = self.ramp(time_s);
        walk.time_s = time_s;
        walk.at = (f64::NAN, f64::NAN);
        walk.groups.resize(self.groups.len(), Stand::default());
    }

    /// Kinematics at the next position along a rope.
    pub fn walk_to(&self, walk: &mut Walk, place: DVec3) -> WaterAt {
        debug_assert_eq!(walk.groups.len(), self.groups.len(), "a walk starts with `begin`");
        let (along, height) = self.coordinates(place);
        let (by, up) = (along - walk.at.0, height - walk.at.1);
        let moves = (self.shortest * by.abs().max(up.abs()) / SERIES_REACH).ceil();
        let mut sums = Sums::default();
        if moves <= MOST_MOVES {
            let times = moves.max(1.0);
            for (group, stand) in self.groups.iter().zip(&mut walk.groups) {
                for part in 0..times as u32 {
                    let from = walk.at.1 + up * (f64::from(part) / times);
                    stand.advance(group, by / times, from, from + up / times);
                }
                sums.add(group, stand);
            }
        } else {
            for (group, stand) in self.groups.iter().zip(&mut walk.groups) {
                *stand = group.stand(along, height, walk.time_s);
                sums.add(group, stand);
            }
        }
        walk.at = (along, height);
        self.water_at(sums, walk.ramp)
    }

    /// Distance along the direction of propagation, and height clamped between bed and mean surface.
    fn coordinates(&self, place: DVec3) -> (f64, f64) {
        (place.dot(self.toward), place.z.clamp(-self.depth_m, 0.0))
    }

    fn water_at(&self, sums: Sums, Ramp { share: ramp, rate }: Ramp) -> WaterAt {
        let [surface, along, up, along_rate, up_rate] =
            sums.0.map(|four| (four[0] + four[1]) + (four[2] + four[3]));
        let velocity = self.toward * along + DVec3::Z * up;
        let acceleration = self.toward * along_rate + DVec3::Z * up_rate;
        WaterAt {
            velocity_m_s: velocity * ramp,
            acceleration_m_s2: acceleration * ramp + velocity * rate,
            surface_m: surface * ramp,
        }
    }
}

/// Components evaluated at once.
const LANES: usize = 4;

/// Lower limit of the exponent `kz`, which keeps `E` a normal number at any depth.
const DEEPEST: f64 = -60.0;

/// Four numbers, one per lane.
type Four = [f64; LANES];

/// Constants of four components.
#[derive(Clone, Debug, Default)]
struct Figures {
    /// Wave number [rad/m].
    pub number: Four,
    /// Amplitude [m].
    pub amplitude: Four,
    /// Angular frequency [rad/s].
    pub frequency: Four,
    /// Phase at the origin at time zero [rad].
    pub phase: Four,
    /// `e^{-2kd}`.
    pub bottom: Four,
    /// `1/(1 - e^{-2kd})`; zero for an unused lane.
    pub whole: Four,
}

/// Phase and decay of four components at one position: `cos θ`, `sin θ`, `E`, `F`.
#[derive(Clone, Copy, Debug, Default)]
struct Stand {
    pub cosine: Four,
    pub sine: Four,
    pub falling: Four,
    pub rising: Four,
}

/// Sums over components at a position: surface, velocity and acceleration along and up.
#[derive(Clone, Copy, Debug, Default)]
struct Sums(pub [Four; 5]);

impl Figures {
    /// Evaluates the four components at a position and time directly.
    pub fn stand(&self, along: f64, height: f64, time_s: f64) -> Stand {
        let mut stand = Stand::default();
        for lane in 0..LANES {
            let number = self.number[lane];
            let (sine, cosine) =
                libm::sincos(number * along - self.frequency[lane] * time_s + self.phase[lane]);
            let decay = (number * height).max(DEEPEST);
            stand.cosine[lane] = cosine;
            stand.sine[lane] = sine;
            stand.falling[lane] = libm::exp(decay);
            stand.rising[lane] = self.bottom[lane] * libm::exp(-decay);
        }
        stand
    }
}

impl Stand {
    /// Advances along the waves and from one height to another, within the range of the series.
    #[inline]
    pub fn advance(&mut self, figures: &Figures, by: f64, from: f64, to: f64) {
        for lane in 0..LANES {
            let number = figures.number[lane];
            let (cosine, sine) = circle(number * by);
            let turned = self.cosine[lane] * cosine - self.sine[lane] * sine;
            self.sine[lane] = self.sine[lane] * cosine + self.cosine[lane] * sine;
            self.cosine[lane] = turned;
            let (even, odd) = hyperbola((number * to).max(DEEPEST) - (number * from).max(DEEPEST));
            self.falling[lane] *= even + odd;
            self.rising[lane] *= even - odd;
        }
    }
}

/// Cosine and sine of a small angle.
#[inline]
fn circle(angle: f64) -> (f64, f64) {
    let square = -angle * angle;
    let (even, odd) = series(square);
    (even, odd * angle)
}

/// Hyperbolic cosine and sine of a small number.
#[inline]
fn hyperbola(number: f64) -> (f64, f64) {
    let (even, odd) = series(number * number);
    (even, odd * number)
}

/// `Σ qⁱ/(2i)!` and `Σ qⁱ/(2i+1)!`, to 1e-13 for `|q| < 1/4`.
#[inline]
fn series(square: f64) -> (f64, f64) {
    let even = 1.0
        + square / 2.0
            * (1.0
                + square / 12.0
                    * (1.0 + square / 30.0 * (1.0 + square / 56.0 * (1.0 + square / 90.0))));
    let odd =
        1.0 + square / 6.0 * (1.0 + square / 20.0 * (1.0 + square / 42.0 * (1.0 + square / 72.0)));
    (even, odd)
}

impl Sums {
    #[inline]
    pub fn add(&mut self, figures: &Figures, stand: &Stand) {
        let [surface, along, up, along_rate, up_rate] = &mut self.0;
        for lane in 0..LANES {
            let (amplitude, frequency) = (figures.amplitude[lane], figures.frequency[lane]);
            let speed = amplitude * frequency * figures.whole[lane];
            let level = speed * (stand.falling[lane] + stand.rising[lane]);
            let upright = speed * (stand.falling[lane] - stand.rising[lane]);
            surface[lane] += amplitude * stand.cosine[lane];
            along[lane] += level * stand.cosine[lane];
            up[lane] += upright * stand.sine[lane];
            along_rate[lane] += level * frequency * stand.sine[lane];
            up_rate[lane] -= upright * frequency * stand.cosine[lane];
        }
    }
}

#[cfg(test)]
mod tests {
    use core::f64::consts::{PI, TAU};

    use super::*;
    use crate::water::waves::{Spectrum, WaveKind};

    fn regular(height_m: f64, period_s: f64, ramp_s: f64) -> Waves {
        Waves {
            toward: DVec3::X,
            ramp_s,
            kind: WaveKind::Regular { height_m, period_s, phase_rad: 0.0 },
        }
    }

    fn irregular() -> Field {
        let spectrum = Spectrum { significant_height_m: 1.5, peak_period_s: 5.0, gamma: 3.3 };
        let waves = Waves {
            toward: DVec3::new(0.6, 0.8, 0.0),
            ramp_s: 10.0,
            kind: WaveKind::Jonswap { spectrum, components: 62 },
        };
        Field::new(&waves, 25.0, 9.81, 3)
    }

    /// Deep water: circular orbits with speed `a ω e^{kz}`, 4.3 % of the surface value at a depth of half a wavelength. Shallow
    /// water: the horizontal speed is uniform over the depth, the vertical speed decreases linearly to the bed.
    #[test]
    fn orbital_velocity_decays_as_in_linear_theory() {
        let deep = Field::new(&regular(1.0, 6.0, 0.0), 500.0, 9.81, 1);
        let number = wave_number(TAU / 6.0, 500.0, 9.81);
        for depth in [0.0, 0.3, 1.0, PI] {
            let at = |time: f64| deep.at(DVec3::new(0.0, 0.0, -depth / number), time);
            let expected = 0.5 * TAU / 6.0 * libm::exp(-depth);
            assert!((at(6.0).velocity_m_s.x / expected - 1.0).abs() < 1e-12);
            assert!((at(4.5).velocity_m_s.z / expected - 1.0).abs() < 1e-9);
        }
        let shallow = Field::new(&regular(0.1, 600.0, 0.0), 10.0, 9.81, 1);
        let speed = 0.05 * (9.81_f64 / 10.0).sqrt();
        for share in [0.0, 0.25, 1.0] {
            let at = |time: f64| shallow.at(DVec3::new(0.0, 0.0, -10.0 * share), time);
            assert!((at(600.0).velocity_m_s.x / speed - 1.0).abs() < 1e-3);
            assert!((at(450.0).velocity_m_s.z - 0.05 * TAU / 600.0 * (1.0 - share)).abs() < 1e-6);
        }
    }

    /// Divergence and rotation are zero and the surface moves with the water, by central differences.
    #[test]
    fn the_flow_is_incompressible_irrotational_and_carries_its_surface() {
        let field = irregular();
        let step = 1e-4;
        for (place, time) in
            [(DVec3::new(3.0, -7.0, -2.0), 41.0), (DVec3::new(-20.0, 11.0, -14.0), 7.0)]
        {
            let by = |axis: DVec3| {
                (field.at(place + axis * step, time).velocity_m_s
                    - field.at(place - axis * step, time).velocity_m_s)
                    / (2.0 * step)
            };
            let (x, y, z) = (by(DVec3::X), by(DVec3::Y), by(DVec3::Z));
            assert!((x.x + y.y + z.z).abs() < 1e-7);
            assert!((z.x - x.z).abs() + (z.y - y.z).abs() + (y.x - x.y).abs() < 1e-7);
            let rate = (field.at(place, time + step).velocity_m_s
                - field.at(place, time - step).velocity_m_s)
                / (2.0 * step);
            assert!((rate - field.at(place, time).acceleration_m_s2).length() < 1e-6);
        }
        let surface = DVec3::new(2.0, 3.0, 0.0);
        let rise = (field.at(surface, 41.0 + step).surface_m
            - field.at(surface, 41.0 - step).surface_m)
            / (2.0 * step);
        assert!((rise - field.at(surface, 41.0).velocity_m_s.z).abs() < 1e-6);
    }

    /// Dynamic pressure at the surface is `ρ g η`: `du/dt = -g ∂η/∂x` there.
    #[test]
    fn acceleration_at_the_surface_is_gravity_times_its_slope() {
        let field = irregular();
        let (place, toward, step) = (DVec3::new(2.0, 3.0, 0.0), DVec3::new(0.6, 0.8, 0.0), 1e-4);
        let slope = (field.at(place + toward * step, 41.0).surface_m
            - field.at(place - toward * step, 41.0).surface_m)
            / (2.0 * step);
        assert!((field.at(place, 41.0).acceleration_m_s2.dot(toward) + 9.81 * slope).abs() < 1e-6);
    }

    #[test]
    fn waves_grow_from_zero_and_are_constant_above_the_mean_surface() {
        let field = Field::new(&regular(2.0, 6.0, 12.0), 25.0, 9.81, 1);
        assert_eq!(field.at(DVec3::ZERO, 0.0), WaterAt::default());
        assert!(field.at(DVec3::ZERO, 0.01).acceleration_m_s2.length() < 0.01);
        assert!((field.at(DVec3::ZERO, 6.0).surface_m - 0.5).abs() < 1e-12);
        assert!((field.at(DVec3::ZERO, 12.0).surface_m - 1.0).abs() < 1e-12);
        assert_eq!(field.at(DVec3::new(1.0, 0.0, 0.7), 20.0), field.at(DVec3::X, 20.0));
    }

    /// A rope of short and long segments from the bed to above the surface, in deep and in shallow water.
    #[test]
    fn evaluation_along_a_rope_agrees_with_direct_evaluation() {
        for field in [irregular(), Field::new(&regular(1.0, 4.0, 0.0), 300.0, 9.81, 1)] {
            let mut walk = Walk::default();
            field.begin(&mut walk, 123.4);
            let (mut place, mut worst) = (DVec3::new(5.0, -3.0, -30.0), 0.0_f64);
            for node in 0..600 {
                let length = if node % 100 == 99 { 3.0 } else { 0.06 };
                place += DVec3::new(0.3 * libm::sin(0.05 * f64::from(node)), 0.2, 0.8).normalize()
                    * length;
                let (walked, alone) = (field.walk_to(&mut walk, place), field.at(place, 123.4));
                worst = worst.max((walked.velocity_m_s - alone.velocity_m_s).length());
                worst = worst.max((walked.acceleration_m_s2 - alone.acceleration_m_s2).length());
                worst = worst.max((walked.surface_m - alone.surface_m).abs());
            }
            assert!(worst < 1e-10, "{worst:e}");
        }
    }
}
