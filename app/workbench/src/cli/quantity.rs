//! Quantities on the command line: a number with its unit, within the range of its option.

use std::ops::RangeInclusive;

use endline_gear::limits::{STEP, amount};
use endline_gear::units::{self, Quantity};

/// Reads a quantity [SI]; a number without a unit is refused, as in text files.
fn within(
    text: &str,
    quantity: Quantity,
    range: RangeInclusive<f64>,
    expected: &str,
) -> Result<f64, String> {
    let value = units::parse(text.trim(), quantity).map_err(|error| error.to_string())?;
    if range.contains(&value) { Ok(value) } else { Err(format!("expected {expected}")) }
}

pub(super) fn force(text: &str) -> Result<f64, String> {
    let limit = amount(Quantity::Force);
    let expected = format!("a force above 0; {}", limit.words());
    within(text, Quantity::Force, f64::MIN_POSITIVE..=limit.most, &expected)
}

/// A time of a run.
pub(super) fn time(text: &str) -> Result<f64, String> {
    within(text, Quantity::Time, 0.0..=f64::MAX, "a time of zero or above")
}

/// The step between inputs.
pub(super) fn step(text: &str) -> Result<f64, String> {
    let seconds = within(text, Quantity::Time, f64::MIN..=f64::MAX, "")?;
    STEP.check("step", seconds).map_err(|beyond| format!("{}; {}", beyond.message, beyond.help))?;
    Ok(seconds)
}

/// The step of a haul.
pub(super) fn haul_step(text: &str) -> Result<f64, String> {
    within(text, Quantity::Time, 1e-4..=0.05, "a step from 0.1 ms to 50 ms")
}

/// The peak period of waves.
pub(super) fn period(text: &str) -> Result<f64, String> {
    within(text, Quantity::Time, 0.5..=60.0, "a period from 0.5 s to 60 s")
}

/// A depth, height or distance.
pub(super) fn length(text: &str) -> Result<f64, String> {
    within(text, Quantity::Length, 0.0..=f64::MAX, "a length of zero or above")
}

/// A depth or height for a haul.
pub(super) fn haul_length(text: &str) -> Result<f64, String> {
    within(text, Quantity::Length, 0.0..=6000.0, "a length from 0 m to 6000 m")
}

pub(super) fn body_length(text: &str) -> Result<f64, String> {
    within(text, Quantity::Length, 1.0..=35.0, "a length from 1 m to 35 m")
}

/// The longest segment of rope.
pub(super) fn segment(text: &str) -> Result<f64, String> {
    within(text, Quantity::Length, 0.1..=20.0, "a length from 0.1 m to 20 m")
}

/// The speed of a running tide.
pub(super) fn running(text: &str) -> Result<f64, String> {
    within(text, Quantity::Speed, f64::MIN_POSITIVE..=f64::MAX, "a speed above 0")
}

/// The speed of a tide, which may be slack.
pub(super) fn tide(text: &str) -> Result<f64, String> {
    within(text, Quantity::Speed, 0.0..=5.0, "a speed from 0 m/s to 5 m/s")
}

/// The speed of a hauler.
pub(super) fn hauler(text: &str) -> Result<f64, String> {
    within(text, Quantity::Speed, 0.01..=5.0, "a speed from 0.01 m/s to 5 m/s")
}

/// The speed at which a boat drifts, either way.
pub(super) fn drift(text: &str) -> Result<f64, String> {
    within(text, Quantity::Speed, -5.0..=5.0, "a speed from -5 m/s to 5 m/s")
}

/// The angle of a line at the block.
pub(super) fn lead(text: &str) -> Result<f64, String> {
    let most = 80.0_f64.to_radians();
    within(text, Quantity::Angle, 0.017..=most, "an angle from 1 deg to 80 deg")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_without_a_unit_is_refused_by_every_option_and_units_are_named() {
        type Read = fn(&str) -> Result<f64, String>;
        let options: [(Read, &str, f64, &str); 15] = [
            (force, "1700 lbf", 1700.0 * 4.448_221_615_260_5, "lbf"),
            (time, "2 min", 120.0, "s"),
            (step, "10 ms", 0.01, "ms"),
            (haul_step, "20 ms", 0.02, "ms"),
            (period, "8 s", 8.0, "s"),
            (length, "10 fathom", 18.288, "fathom"),
            (haul_length, "10 fathom", 18.288, "fathom"),
            (body_length, "40 ft", 12.192, "fathom"),
            (segment, "1 m", 1.0, "m"),
            (running, "1 knot", 1852.0 / 3600.0, "kn"),
            (tide, "1 knot", 1852.0 / 3600.0, "kn"),
            (hauler, "1 m/s", 1.0, "m/s"),
            (drift, "-1 m/s", -1.0, "m/s"),
            (lead, "45 deg", std::f64::consts::FRAC_PI_4, "deg"),
            (force, "1 kN", 1000.0, "N"),
        ];
        for (read, text, si, unit) in options {
            assert!((read(text).unwrap() / si - 1.0).abs() < 1e-9, "{text}: {:?}", read(text));
            let refused = read(text.split(' ').next().unwrap()).unwrap_err();
            assert!(refused.contains("has no unit") && refused.contains(unit), "{refused}");
        }
        for beyond in [force("0 N"), force("1e300 N"), body_length("1 ft"), running("0 m/s")] {
            assert!(beyond.unwrap_err().starts_with("expected a "));
        }
    }
}
