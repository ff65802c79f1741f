//! One linear wave.

/// One linear wave.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Component {
    /// Amplitude: half of the height [m].
    pub amplitude_m: f64,
    /// Angular frequency [rad/s].
    pub frequency_rad_s: f64,
    /// Phase at the origin at time zero [rad].
    pub phase_rad: f64,
}
