//! Inputs as they are kept: eight numbers a step, and never out of range.

use endline_sdk::Controls;

/// How many numbers an input is kept as.
pub const NUMBERS: usize = 8;

/// The controls in the order in which they are kept.
#[must_use]
pub fn to_array(controls: &Controls) -> [f64; NUMBERS] {
    let Controls { speed, pitch, roll, yaw, burst, mouth, flipper_raise, flipper_twist } = *controls;
    [speed, pitch, roll, yaw, burst, mouth, flipper_raise, flipper_twist]
}

/// The controls from the numbers they were kept as.
#[must_use]
pub fn from_array(numbers: [f64; NUMBERS]) -> Controls {
    let [speed, pitch, roll, yaw, burst, mouth, flipper_raise, flipper_twist] = numbers;
    Controls { speed, pitch, roll, yaw, burst, mouth, flipper_raise, flipper_twist }
}

/// The controls within their declared ranges; a number that is not finite counts as 0.
#[must_use]
pub fn within_range(controls: &Controls) -> Controls {
    const LEAST: [f64; NUMBERS] = [0.0, -1.0, -1.0, -1.0, 0.0, 0.0, -1.0, -1.0];
    let mut numbers = to_array(controls);
    for (number, least) in numbers.iter_mut().zip(LEAST) {
        *number = if number.is_finite() { number.clamp(least, 1.0) } else { 0.0 };
    }
    from_array(numbers)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn controls_survive_the_round_trip_and_stay_in_range() {
        let numbers = [0.1, -0.2, 0.3, -0.4, 0.5, 0.6, -0.7, 0.8];
        let bits = |numbers: [f64; NUMBERS]| numbers.map(f64::to_bits);
        assert_eq!(bits(to_array(&from_array(numbers))), bits(numbers));
        let wild = from_array([-3.0, f64::NAN, 7.0, f64::NEG_INFINITY, 2.0, 0.5, -9.0, 1.0]);
        assert_eq!(bits(to_array(&within_range(&wild))), bits([0.0, 0.0, 1.0, 0.0, 1.0, 0.5, -1.0, 1.0]));
    }
}
