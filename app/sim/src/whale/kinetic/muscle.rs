//! Thrust: what the whale's effort gives at the speed it has, as far as its strength goes.
//!
//! Asked for a speed, a clean whale would need the thrust `T₀` at `u₀`. Flukes that sweep an area `A` push water back at `w`
//! besides its own speed: `T = 2ρA (u + w) w`, for the power `P = T (u + w)` (actuator disk). Three ways to keep an effort:
//!
//! | effort | held | slowed by gear |
//! |---|---|---|
//! | power | `P` of `T₀` at `u₀`, whatever the speed: the flukes bite harder as the whale slows | until `(D + R) u` is what `D u` was |
//! | thrust | `T₀` | until `D + R` is what `D` was |
//! | speed | the speed asked for, the gear's drag felt and answered | not at all, up to its strength |
//!
//! Thrust is never below zero, nor above what a whale of its length sustains or, in a burst, can do at most. A burst is an effort to reach its speed whatever it takes.
//! Power put in is `P/η`.
//! References: Arthur et al. 2015 (doi:10.1111/mms.12230) for the greatest forces; van der Hoop et al. 2017 (doi:10.3354/esr00781) for `η`;
//! Rankine 1865 and Froude 1889 for the disk.

/// How a whale keeps up its effort when gear holds it back.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Effort {
    /// It keeps its power.
    #[default]
    Power,
    /// It keeps its thrust.
    Thrust,
    /// It keeps its speed.
    Speed,
}

/// A whale's thrust and power.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Muscle {
    /// Greatest thrust it sustains [N].
    pub sustained_n: f64,
    /// Greatest thrust in a burst [N].
    pub burst_n: f64,
    /// Useful power over the power put in.
    pub efficiency: f64,
    /// Area that its flukes sweep [m²].
    pub swept_area_m2: f64,
    /// How it keeps up its effort.
    pub effort: Effort,
}

/// Thrust asked of the muscle in a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Asked {
    /// Thrust of a clean whale at the speed asked for [N].
    pub thrust_n: f64,
    /// That speed [m/s].
    pub speed_m_s: f64,
    /// Thrust that brings the whale as it is to the speed asked for within the step [N].
    pub answer_n: f64,
    /// Burst, 0 to 1.
    pub burst: f64,
}

impl Muscle {
    /// Greatest thrust with a share of a burst [N].
    #[must_use]
    pub fn strength_n(&self, burst: f64) -> f64 {
        self.sustained_n + (self.burst_n - self.sustained_n).max(0.0) * burst.clamp(0.0, 1.0)
    }

    /// Useful power of a thrust at a speed ahead [W].
    #[must_use]
    pub fn disk_power_w(&self, density_kg_m3: f64, thrust_n: f64, speed_m_s: f64) -> f64 {
        let speed = speed_m_s.max(0.0);
        let mass_m = density_kg_m3 * self.swept_area_m2;
        let wash = if mass_m > 0.0 {
            0.5 * ((speed * speed + 2.0 * thrust_n.max(0.0) / mass_m).sqrt() - speed)
        } else {
            0.0
        };
        thrust_n * (speed + wash)
    }

    /// Thrust that a useful power gives at a speed ahead [N].
    #[must_use]
    pub fn disk_thrust_n(&self, density_kg_m3: f64, power_w: f64, speed_m_s: f64) -> f64 {
        let twice = 2.0 * density_kg_m3 * self.swept_area_m2;
        if power_w <= 0.0 || twice <= 0.0 {
            return 0.0;
        }
        let (speed, target) = (speed_m_s.max(0.0), power_w / twice);
        // w (u + w)² = P/2ρA; both guesses are too high, and from above Newton falls on the root without passing it.
        let mut wash = libm::cbrt(target);
        if speed > 0.0 {
            wash = wash.min(target / (speed * speed));
        }
        for _ in 0..MOST_PASSES {
            let past = speed + wash;
            let change = (wash * past * past - target) / (past * (past + 2.0 * wash));
            wash -= change;
            if change <= 1e-15 * wash {
                break;
            }
        }
        power_w / (speed + wash)
    }

    /// Power put in for a thrust at a speed [W].
    #[must_use]
    pub fn power_w(&self, density_kg_m3: f64, thrust_n: f64, speed_m_s: f64) -> f64 {
        self.disk_power_w(density_kg_m3, thrust_n, speed_m_s) / self.efficiency
    }

    /// The thrust of a step at a speed [N].
    pub(super) fn thrust_n(&self, density_kg_m3: f64, asked: &Asked, speed_m_s: f64) -> f64 {
        let wanted = match self.effort {
            _ if asked.burst > 0.0 => asked.answer_n,
            Effort::Speed => asked.answer_n,
            Effort::Thrust => asked.thrust_n,
            Effort::Power if density_kg_m3 * self.swept_area_m2 <= 0.0 => asked.thrust_n,
            Effort::Power => {
                let power_w = self.disk_power_w(density_kg_m3, asked.thrust_n, asked.speed_m_s);
                self.disk_thrust_n(density_kg_m3, power_w, speed_m_s)
            }
        };
        wanted.clamp(0.0, self.strength_n(asked.burst))
    }

    pub(super) fn fault(&self) -> Option<&'static str> {
        let sound = |size: f64| size.is_finite() && size >= 0.0;
        let all = sound(self.sustained_n)
            && sound(self.burst_n)
            && sound(self.swept_area_m2)
            && self.efficiency.is_finite();
        (!all || self.efficiency <= 0.0).then_some("a figure of its strength is below zero")
    }
}

/// Passes of Newton, far more than it takes.
const MOST_PASSES: usize = 60;

#[cfg(test)]
mod tests {
    use super::*;

    fn muscle(effort: Effort) -> Muscle {
        Muscle {
            sustained_n: 5_800.0,
            burst_n: 23_900.0,
            efficiency: 0.13,
            swept_area_m2: 14.6,
            effort,
        }
    }

    #[test]
    fn thrust_and_power_of_the_disk_are_inverse_to_one_another() {
        let muscle = muscle(Effort::Power);
        for thrust in [1e-3, 10.0, 350.0, 5e4] {
            for speed in [0.0, 1e-6, 0.3, 1.3, 6.0] {
                let back =
                    muscle.disk_thrust_n(1025.0, muscle.disk_power_w(1025.0, thrust, speed), speed);
                assert!((back / thrust - 1.0).abs() < 1e-9, "{thrust} N at {speed} m/s: {back}");
            }
        }
        // At the pier: T³ = 2ρA P².
        let pull = muscle.disk_thrust_n(1025.0, 455.0, 0.0);
        assert!((pull - libm::cbrt(2.0 * 1025.0 * 14.6 * 455.0 * 455.0)).abs() < 1e-6 * pull);
    }

    #[test]
    fn no_effort_passes_the_whales_strength() {
        let asked = |burst| Asked { thrust_n: 300.0, speed_m_s: 1.3, answer_n: 1e6, burst };
        assert!((muscle(Effort::Speed).thrust_n(1025.0, &asked(0.0), 0.0) - 5_800.0).abs() < 1e-9);
        assert!((muscle(Effort::Power).thrust_n(1025.0, &asked(1.0), 0.0) - 23_900.0).abs() < 1e-9);
        assert!((muscle(Effort::Thrust).thrust_n(1025.0, &asked(0.0), 0.0) - 300.0).abs() < 1e-9);
        let kept = muscle(Effort::Power).thrust_n(1025.0, &asked(0.0), 0.6);
        assert!(
            kept > 600.0 && kept < 650.0,
            "at less than half the speed, nearly as much more thrust: {kept}"
        );
    }
}
