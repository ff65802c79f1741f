//! What waves do at a place: linear (Airy) kinematics, summed over components.
//!
//! With amplitude `a`, wave number `k`, depth `d` and phase `θ = k s - ω t + ε`, `s` the distance along the waves' way:
//!
//! | what | is |
//! |---|---|
//! | surface | `a cos θ` |
//! | velocity along, up | `a ω C cos θ`, `a ω S sin θ` |
//! | acceleration along, up | `a ω² C sin θ`, `-a ω² S cos θ` |
//!
//! `C = cosh k(z+d)/sinh kd = (E + F)/(1 - e^{-2kd})`, `S = (E - F)/(1 - e^{-2kd})`, `E = e^{kz}`, `F = e^{-k(z+2d)}`.
//! Above the mean surface they are as at z = 0 (constant stretching), below the depth at the origin as there.
//! All of it is multiplied by a ramp `r(t) = q²(3 - 2q)`, `q = t/T`, that is zero at time zero, when rigs are at rest;
//! the acceleration gains `u dr/dt`, so that it stays the derivative of the velocity.
//!
//! Along a rope the fields are walked from node to node: phases turn and `E`, `F` grow by the short move's sine, cosine
//! and exponentials as power series, four components at once; a long move starts anew.
//! Reference: Airy 1845; DNV-RP-C205, sections 3.2 and 3.3.

mod components;
#[cfg(test)]
mod tests;

use glam::DVec3;

use super::WaterAt;
use super::waves::{Waves, wave_number};
use components::{Figures, LANES, Stand, Sums};

/// Greatest move by phase or decay that the series take: their error is then below 1e-12 [rad].
const SERIES_REACH: f64 = 0.5;
/// Most moves of that length in place of a new start.
const MOST_MOVES: f64 = 4.0;

/// `F` at the surface is nothing where `2 k d` is beyond this.
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

/// Share of the waves that has grown, and its rate.
#[derive(Clone, Copy, Debug, Default)]
struct Ramp {
    share: f64,
    /// [1/s]
    rate: f64,
}

/// Where a walk along a rope stands; keeps nothing between two beginnings.
#[derive(Clone, Debug, Default)]
pub struct Walk {
    ramp: Ramp,
    time_s: f64,
    /// Distance along the waves' way and height of the last place; not a number before the first.
    at: (f64, f64),
    groups: Vec<Stand>,
}

impl Field {
    /// Of waves in water of a depth under gravity.
    #[must_use]
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

    /// Whether there are waves at a time; none at time zero and before.
    #[must_use]
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

    /// What the waves do at one place; nothing at time zero and before.
    #[must_use]
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

    /// Begins a walk at a time; allocates only the first time.
    pub fn begin(&self, walk: &mut Walk, time_s: f64) {
        walk.ramp = self.ramp(time_s);
        walk.time_s = time_s;
        walk.at = (f64::NAN, f64::NAN);
        walk.groups.resize(self.groups.len(), Stand::default());
    }

    /// What the waves do at the next place of a walk.
    pub fn walk_to(&self, walk: &mut Walk, place: DVec3) -> WaterAt {
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

    /// Distance along the waves' way, and height held between bed and mean surface.
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
