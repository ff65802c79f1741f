//! Attributes of the swim with their ranges and defaults.

use endline_sdk::{Attribute, HookError};

/// Attribute values of a call, in the declared order; units as their names say.
pub(super) struct Settings {
    /// Speed at full speed control [m/s].
    pub cruise_speed_m_s: f64,
    /// Greatest speed, with the burst control [m/s].
    pub burst_speed_m_s: f64,
    /// Greatest gain of speed [m/s²].
    pub acceleration_m_s2: f64,
    /// Greatest loss of speed [m/s²].
    pub braking_m_s2: f64,
    /// Peak-to-peak excursion of the flukes as a share of body length [1].
    pub beat_amplitude: f64,
    /// Strouhal number of the beat [1].
    pub strouhal: f64,
    /// Slowest beat [Hz].
    pub least_beat_hz: f64,
    /// Fastest beat of a whale of 13.7 m [Hz].
    pub greatest_beat_hz: f64,
    /// Angle of attack of the flukes at mid-stroke [rad].
    pub fluke_attack_rad: f64,
    /// Yaw rate at full control [rad/s].
    pub yaw_rate_rad_s: f64,
    /// Pitch rate at full control [rad/s].
    pub pitch_rate_rad_s: f64,
    /// Roll rate at full control [rad/s].
    pub roll_rate_rad_s: f64,
    /// Smoothing time of speed, pitch, roll and yaw [s].
    pub smoothing_s: f64,
    /// Sweep of the flippers aft while swimming [rad].
    pub flipper_sweep_rad: f64,
    /// Time of a flipper from its middle to an end of its range [s].
    pub flipper_time_s: f64,
    /// Jaw drop at full mouth control [rad].
    pub jaw_open_rad: f64,
    /// Time of the mouth to open or close [s].
    pub mouth_time_s: f64,
}

impl Settings {
    /// The settings from the values of a call.
    ///
    /// # Errors
    /// Where there are fewer values than attributes.
    pub(super) fn read(attributes: &[f64]) -> Result<Self, HookError> {
        let mut values = attributes.iter().copied();
        let mut next = || {
            values.next().ok_or_else(|| {
                let (expected, count) = (NUMBERS.len(), attributes.len());
                HookError::new(format!("expected {expected} attribute values, got {count}"))
            })
        };
        Ok(Self {
            cruise_speed_m_s: next()?,
            burst_speed_m_s: next()?,
            acceleration_m_s2: next()?,
            braking_m_s2: next()?,
            beat_amplitude: next()?,
            strouhal: next()?,
            least_beat_hz: next()?,
            greatest_beat_hz: next()?,
            fluke_attack_rad: next()?,
            yaw_rate_rad_s: next()?,
            pitch_rate_rad_s: next()?,
            roll_rate_rad_s: next()?,
            smoothing_s: next()?,
            flipper_sweep_rad: next()?,
            flipper_time_s: next()?,
            jaw_open_rad: next()?,
            mouth_time_s: next()?,
        })
    }
}

/// A numeric attribute.
struct Number {
    key: &'static str,
    unit: &'static str,
    /// Least and greatest value, in the unit.
    range: [f64; 2],
    default: f64,
    help: &'static str,
}

const fn number(
    key: &'static str,
    unit: &'static str,
    range: [f64; 2],
    default: f64,
    help: &'static str,
) -> Number {
    Number { key, unit, range, default, help }
}

/// All attributes, in the order of [`Settings::read`].
const NUMBERS: [Number; 17] = [
    number(
        "cruise_speed",
        "m/s",
        [0.1, 5.0],
        1.23,
        "Speed at full speed control; tracked right whales travel at 0.9 to 1.5 m/s.",
    ),
    number(
        "burst_speed",
        "m/s",
        [0.1, 10.0],
        4.5,
        "Greatest speed, with the burst control; an estimate from sprints of 4 to 5 m/s.",
    ),
    number(
        "acceleration",
        "m/s^2",
        [0.01, 2.0],
        0.3,
        "Greatest gain of speed; an estimate between sustained (0.2) and greatest (0.6) thrust over mass.",
    ),
    number(
        "braking",
        "m/s^2",
        [0.01, 2.0],
        0.15,
        "Greatest loss of speed, flippers and body as brakes; an estimate.",
    ),
    number(
        "beat_amplitude",
        "1",
        [0.02, 0.4],
        0.2,
        "Peak-to-peak excursion of the flukes as a share of body length.",
    ),
    number(
        "strouhal",
        "1",
        [0.1, 0.6],
        0.3,
        "Beat frequency times excursion over speed; swimmers keep 0.2 to 0.4.",
    ),
    number(
        "least_beat",
        "Hz",
        [0.01, 1.0],
        0.05,
        "Slowest beat; below it the flukes move less far instead.",
    ),
    number(
        "greatest_beat",
        "Hz",
        [0.02, 3.0],
        0.6,
        "Fastest beat of a whale of 13.7 m; it scales with length to the power -0.53.",
    ),
    number("fluke_attack", "rad", [0.0, 0.6], 0.26, "Angle of attack of the flukes at mid-stroke."),
    number(
        "yaw_rate",
        "rad/s",
        [0.0, 1.0],
        0.174_532_925_199_432_95,
        "Yaw rate at full control (10 degrees a second); avoidance turns are 5 to 15.",
    ),
    number(
        "pitch_rate",
        "rad/s",
        [0.0, 1.0],
        0.139_626_340_159_546_36,
        "Pitch rate at full control (8 degrees a second); an estimate.",
    ),
    number(
        "roll_rate",
        "rad/s",
        [0.0, 1.0],
        0.349_065_850_398_865_9,
        "Roll rate at full control (20 degrees a second); humpbacks reach 43.",
    ),
    number(
        "smoothing",
        "s",
        [0.01, 10.0],
        0.5,
        "How slowly the whale follows speed, pitch, roll and yaw controls.",
    ),
    number(
        "flipper_sweep",
        "rad",
        [-0.5, 1.2],
        0.2,
        "How far aft the flippers are swept while swimming.",
    ),
    number(
        "flipper_time",
        "s",
        [0.05, 20.0],
        1.0,
        "Time a flipper takes from its middle to an end of its range.",
    ),
    number(
        "jaw_open",
        "rad",
        [0.0, 0.8],
        0.26,
        "Jaw drop at full mouth control; 10 to 20 degrees when skim feeding.",
    ),
    number(
        "mouth_time",
        "s",
        [0.05, 20.0],
        2.0,
        "Time the mouth takes to open or close; 1 to 3 seconds.",
    ),
];

/// The attributes as the descriptor declares them.
pub(super) fn attributes() -> Vec<Attribute> {
    let declared = |number: &Number| {
        Attribute::number(number.key, number.unit, number.range, number.default, number.help)
    };
    NUMBERS.iter().map(declared).collect()
}
