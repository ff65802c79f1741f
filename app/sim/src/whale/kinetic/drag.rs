//! Drag of a swimming body, and what it does to a body's speed.
//!
//! `D = ½ρ U² S C_D0 g k`, `C_D0 = C_f [1 + 1.5 (d/L)^1.5 + 7 (d/L)³]`, `C_f = 0.072 Re^-0.2`, `Re = U L/ν`, so that
//! `D = c U^1.8` with `c` constant. A body of mass `m` left to itself then keeps `U^-0.8 - 0.8 c t/m` constant.
//!
//! Symbols: `S` wetted area, `L` length, `d` greatest diameter, `g` factor of flippers and flukes, `k` factor of the body's oscillation,
//! `ν` kinematic viscosity. An open mouth multiplies by up to its own factor.
//! Reference: van der Hoop et al. 2013 (doi:10.1111/mms.12042) and 2017 (doi:10.1242/jeb.149781); `C_f` and form factor after Hoerner 1965.

/// Kinematic viscosity of sea water as the reference takes it [m²/s].
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
    /// Factor of the body's oscillation as it swims, `k`.
    pub oscillation: f64,
    /// Factor of a mouth wide open.
    pub open_mouth: f64,
    /// Jaw drop at which the mouth counts as wide open [rad].
    pub wide_rad: f64,
}

impl AxialDrag {
    /// Drag coefficient `C_D0` on wetted area at a speed above zero.
    #[must_use]
    pub fn coefficient(&self, speed_m_s: f64) -> f64 {
        let slenderness = self.diameter_m / self.length_m;
        let friction = 0.072 * libm::pow(speed_m_s * self.length_m / VISCOSITY_M2_S, -0.2);
        friction
            * (1.0
                + 1.5 * libm::pow(slenderness, 1.5)
                + 7.0 * slenderness * slenderness * slenderness)
    }

    /// `c` of `D = c U^1.8` in water of a density, with the jaw dropped by an angle [N s^1.8/m^1.8].
    #[must_use]
    pub fn factor(&self, density_kg_m3: f64, jaw_rad: f64) -> f64 {
        let mouth = 1.0 + (self.open_mouth - 1.0) * (jaw_rad / self.wide_rad).clamp(0.0, 1.0);
        0.5 * density_kg_m3
            * self.wetted_area_m2
            * self.coefficient(1.0)
            * self.appendages
            * self.oscillation
            * mouth
    }

    /// Drag at a speed, mouth closed [N].
    #[must_use]
    pub fn drag_n(&self, density_kg_m3: f64, speed_m_s: f64) -> f64 {
        drag_n(self.factor(density_kg_m3, 0.0), speed_m_s)
    }

    pub(super) fn fault(&self) -> Option<&'static str> {
        let sizes = [self.length_m, self.diameter_m, self.wide_rad];
        let factors = [self.wetted_area_m2, self.appendages, self.oscillation, self.open_mouth];
        let sound = sizes.iter().all(|size| size.is_finite() && *size > 0.0)
            && factors.iter().all(|factor| factor.is_finite() && *factor >= 0.0);
        (!sound).then_some("a figure of its drag is below zero")
    }
}

/// `c U^1.8`, against the speed [N].
#[must_use]
pub fn drag_n(factor: f64, speed_m_s: f64) -> f64 {
    factor * libm::pow(libm::fabs(speed_m_s), 0.8) * speed_m_s
}

/// The speed after a time, with `fading = c dt/m`; exact. Below zero, the speed that time before [m/s].
#[must_use]
pub fn coast(speed_m_s: f64, fading: f64) -> f64 {
    if speed_m_s == 0.0 || fading == 0.0 {
        return speed_m_s;
    }
    let slowness = libm::pow(libm::fabs(speed_m_s), -0.8) + 0.8 * fading;
    if slowness <= 0.0 {
        // So fast a body would have stood still never: straight back along the drag.
        return speed_m_s - fading * libm::pow(libm::fabs(speed_m_s), 0.8) * speed_m_s;
    }
    libm::copysign(libm::pow(slowness, -1.25), speed_m_s)
}

#[cfg(test)]
mod tests {
    use super::*;

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
        // van der Hoop's weighed and measured whales: length, mass, diameter, coefficient at 1 m/s, drag at each speed.
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
    fn coasting_solves_the_equation_of_motion_and_runs_back() {
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
