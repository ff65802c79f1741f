//! The pilot's controls as a list: their names in files, their ranges, their order in recordings.

use crate::motion::Controls;

impl Controls {
    /// Number of controls.
    pub const COUNT: usize = 10;

    /// Index of [`act`](Self::act) in the list; it is a choice, the others are amounts.
    pub const ACT: usize = 9;

    /// The greatest number of an act; no motion declares more.
    pub const MOST_ACTS: usize = 1000;

    /// Their names in files, in the order of lists and recordings.
    pub const NAMES: [&'static str; Self::COUNT] = [
        "speed",
        "pitch",
        "roll",
        "yaw",
        "burst",
        "mouth",
        "flipper_raise",
        "flipper_twist",
        "flipper_sweep",
        "act",
    ];

    /// Least and greatest of each.
    pub const RANGES: [[f64; 2]; Self::COUNT] = {
        let (share, both) = ([0.0, 1.0], [-1.0, 1.0]);
        [share, both, both, both, share, share, both, both, both, [0.0, Self::MOST_ACTS as f64]]
    };

    /// The controls in the order of [`NAMES`](Self::NAMES).
    #[must_use]
    pub fn to_array(&self) -> [f64; Self::COUNT] {
        let Self {
            speed,
            pitch,
            roll,
            yaw,
            burst,
            mouth,
            flipper_raise,
            flipper_twist,
            flipper_sweep,
            act,
        } = *self;
        [speed, pitch, roll, yaw, burst, mouth, flipper_raise, flipper_twist, flipper_sweep, act]
    }

    /// The controls from numbers in the order of [`NAMES`](Self::NAMES).
    #[must_use]
    pub fn from_array(numbers: [f64; Self::COUNT]) -> Self {
        let [
            speed,
            pitch,
            roll,
            yaw,
            burst,
            mouth,
            flipper_raise,
            flipper_twist,
            flipper_sweep,
            act,
        ] = numbers;
        Self {
            speed,
            pitch,
            roll,
            yaw,
            burst,
            mouth,
            flipper_raise,
            flipper_twist,
            flipper_sweep,
            act,
        }
    }

    /// The controls within their ranges; a number that is not finite counts as 0, an act is a whole number, and one
    /// beyond the `acts` that the motion declares is none.
    #[must_use]
    pub fn within_range(&self, acts: usize) -> Self {
        let mut numbers = self.to_array();
        for (number, [least, most]) in numbers.iter_mut().zip(Self::RANGES) {
            *number = if number.is_finite() { number.clamp(least, most) } else { 0.0 };
        }
        let controls = Self::from_array(numbers);
        let act = controls.act.round();
        Self { act: if act <= acts as f64 { act } else { 0.0 }, ..controls }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn controls_survive_the_round_trip_and_stay_in_range() {
        let numbers = [0.1, -0.2, 0.3, -0.4, 0.5, 0.6, -0.7, 0.8, -0.9, 3.0];
        let bits = |numbers: [f64; Controls::COUNT]| numbers.map(f64::to_bits);
        assert_eq!(bits(Controls::from_array(numbers).to_array()), bits(numbers));
        let wild = Controls::from_array([
            -3.0,
            f64::NAN,
            7.0,
            f64::NEG_INFINITY,
            2.0,
            0.5,
            -9.0,
            1.0,
            -2.0,
            2.6,
        ]);
        assert_eq!(
            bits(wild.within_range(3).to_array()),
            bits([0.0, 0.0, 1.0, 0.0, 1.0, 0.5, -1.0, 1.0, -1.0, 3.0])
        );
        assert_eq!(wild.within_range(2).act.to_bits(), 0.0_f64.to_bits());
    }
}
