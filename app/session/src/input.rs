//! Inputs as they are kept: ten numbers a step, and never out of range.

use endline_sdk::Controls;

/// How many numbers an input is kept as.
pub const NUMBERS: usize = 10;

/// The greatest number of an act; no motion declares more.
pub const MOST_ACTS: usize = 1000;

/// The controls in the order in which they are kept.
#[must_use]
pub fn to_array(controls: &Controls) -> [f64; NUMBERS] {
    let Controls { speed, pitch, roll, yaw, burst, mouth, flipper_raise, flipper_twist, flipper_sweep, act } = *controls;
    [speed, pitch, roll, yaw, burst, mouth, flipper_raise, flipper_twist, flipper_sweep, act]
}

/// The controls from the numbers they were kept as.
#[must_use]
pub fn from_array(numbers: [f64; NUMBERS]) -> Controls {
    let [speed, pitch, roll, yaw, burst, mouth, flipper_raise, flipper_twist, flipper_sweep, act] = numbers;
    Controls { speed, pitch, roll, yaw, burst, mouth, flipper_raise, flipper_twist, flipper_sweep, act }
}

/// Least and greatest of each control, in the order in which they are kept.
const RANGES: [[f64; 2]; NUMBERS] = {
    let (share, both) = ([0.0, 1.0], [-1.0, 1.0]);
    [share, both, both, both, share, share, both, both, both, [0.0, MOST_ACTS as f64]]
};

/// The controls within their declared ranges; a number that is not finite counts as 0, and an act is a whole number.
#[must_use]
pub fn within_range(controls: &Controls) -> Controls {
    let mut numbers = to_array(controls);
    for (number, [least, most]) in numbers.iter_mut().zip(RANGES) {
        *number = if number.is_finite() { number.clamp(least, most) } else { 0.0 };
    }
    let controls = from_array(numbers);
    Controls { act: controls.act.round(), ..controls }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn controls_survive_the_round_trip_and_stay_in_range() {
        let numbers = [0.1, -0.2, 0.3, -0.4, 0.5, 0.6, -0.7, 0.8, -0.9, 3.0];
        let bits = |numbers: [f64; NUMBERS]| numbers.map(f64::to_bits);
        assert_eq!(bits(to_array(&from_array(numbers))), bits(numbers));
        let wild = from_array([-3.0, f64::NAN, 7.0, f64::NEG_INFINITY, 2.0, 0.5, -9.0, 1.0, -2.0, 2.6]);
        assert_eq!(bits(to_array(&within_range(&wild))), bits([0.0, 0.0, 1.0, 0.0, 1.0, 0.5, -1.0, 1.0, -1.0, 3.0]));
    }
}
