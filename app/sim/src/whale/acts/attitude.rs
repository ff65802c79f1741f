//! Turning to a bank and a climb against the horizon.
//!
//! ```text
//! R = Rz(heading) Ry(-climb) Rx(bank);   wanted R' with the heading as it is
//! rates about the whale's own axes: log(R⁻¹ R')/tau, its length at most the greatest rate
//! ```

use std::f64::consts::{FRAC_PI_2, PI};

use glam::{DQuat, DVec3};

/// Time in which most of the way to the wanted attitude is gone [s]; an estimate.
const TAU_S: f64 = 1.5;

/// Heading (anticlockwise from east), bank (starboard side down) and climb (nose up) of a whale [rad].
#[must_use]
pub fn attitude(orientation: DQuat) -> [f64; 3] {
    let (ahead, port) = (orientation * DVec3::X, orientation * DVec3::Y);
    let climb = FRAC_PI_2 - libm::acos(ahead.z.clamp(-1.0, 1.0));
    let heading = libm::atan2(ahead.y, ahead.x);
    let level_port = DVec3::new(-libm::sin(heading), libm::cos(heading), 0.0);
    let bank = libm::atan2(port.dot(ahead.cross(level_port)), port.dot(level_port));
    [heading, bank, climb]
}

/// Turn rates about the whale's own axes towards a bank and a climb, where they are asked for [rad/s].
#[must_use]
pub fn rates_to(orientation: DQuat, [bank, climb]: [Option<f64>; 2], most_rad_s: f64) -> DVec3 {
    if bank.is_none() && climb.is_none() {
        return DVec3::ZERO;
    }
    let [heading, bank_now, climb_now] = attitude(orientation);
    let wanted = DQuat::from_rotation_z(heading)
        * DQuat::from_rotation_y(-climb.unwrap_or(climb_now))
        * DQuat::from_rotation_x(bank.unwrap_or(bank_now));
    let mut left = (orientation.conjugate() * wanted).to_scaled_axis();
    if left.length() > PI {
        left *= 1.0 - 2.0 * PI / left.length();
    }
    (left / TAU_S).clamp_length_max(most_rad_s)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pointing(heading: f64, bank: f64, climb: f64) -> DQuat {
        DQuat::from_rotation_z(heading)
            * DQuat::from_rotation_y(-climb)
            * DQuat::from_rotation_x(bank)
    }

    #[test]
    fn attitude_is_read_back() {
        for (heading, bank, climb) in
            [(0.3, 0.0, 0.0), (-2.0, 1.2, 0.9), (3.0, -3.0, -1.1), (1.0, 0.1, 1.4)]
        {
            let read = attitude(pointing(heading, bank, climb));
            for (read, given) in read.into_iter().zip([heading, bank, climb]) {
                assert!((read - given).abs() < 1e-9, "{read} for {given}");
            }
        }
        let (port_up, nose_up) =
            (DQuat::from_rotation_x(0.5) * DVec3::Y, DQuat::from_rotation_y(-0.5) * DVec3::X);
        assert!(port_up.z > 0.0 && nose_up.z > 0.0);
    }

    /// From many attitudes the whale comes to what is asked within its rate, keeping the rest.
    #[test]
    fn it_turns_to_what_is_asked() {
        for (start, asked) in [
            ([0.4, 0.0, 0.0], [None, Some(-1.0)]),
            ([2.4, 0.7, 0.3], [Some(0.0), Some(0.0)]),
            ([-1.0, 0.0, 0.2], [Some(FRAC_PI_2), None]),
            ([-1.0, 0.5, 0.2], [Some(PI), Some(0.1)]),
        ] {
            let [heading, bank, climb] = start;
            let mut orientation = pointing(heading, bank, climb);
            for _ in 0..6000 {
                let rates = rates_to(orientation, asked, 0.35);
                assert!(rates.length() <= 0.35 + 1e-12);
                orientation = (orientation * DQuat::from_scaled_axis(rates * 0.01)).normalize();
            }
            let now = attitude(orientation);
            let off = (now[1] - asked[0].unwrap_or(bank)).rem_euclid(2.0 * PI);
            assert!(off.min(2.0 * PI - off) < 1e-3, "bank {now:?} for {asked:?}");
            assert!(
                (now[2] - asked[1].unwrap_or(climb)).abs() < 1e-3,
                "climb {now:?} for {asked:?}"
            );
        }
    }
}
