//! The floats the swim keeps between steps: phase of the beat and smoothed controls.

use std::f64::consts::TAU;

use endline_sdk::{Controls, HookError};

use super::settings::Settings;

/// How many floats there are.
pub(super) const LEN: usize = 11;

/// The floats by name; all zero is a whale at rest that has not begun to swim.
pub(super) struct Floats {
    /// Phase of the beat, 0 to 2 pi [rad].
    pub phase: f64,
    /// How much the whale beats: 0 gliding, 1 swimming.
    pub effort: f64,
    /// Smoothed speed control, 0 to 1.
    pub speed: f64,
    /// Smoothed pitch, -1 to 1.
    pub pitch: f64,
    /// Smoothed roll, -1 to 1.
    pub roll: f64,
    /// Smoothed yaw, -1 to 1.
    pub yaw: f64,
    /// Smoothed burst, 0 to 1.
    pub burst: f64,
    /// Opening of the mouth, 0 to 1.
    pub mouth: f64,
    /// Raise of the flippers, -1 to 1.
    pub flipper_raise: f64,
    /// Twist of the flippers, -1 to 1.
    pub flipper_twist: f64,
    /// Sweep of the flippers, -1 to 1.
    pub flipper_sweep: f64,
}

impl Floats {
    /// The floats as the engine hands them over.
    ///
    /// # Errors
    /// Where there are more or fewer than [`LEN`].
    pub(super) fn read(state: &[f64]) -> Result<Self, HookError> {
        let &[
            phase,
            effort,
            speed,
            pitch,
            roll,
            yaw,
            burst,
            mouth,
            flipper_raise,
            flipper_twist,
            flipper_sweep,
        ] = state
        else {
            return Err(HookError::new(format!(
                "expected {LEN} floats of state, got {}",
                state.len()
            )));
        };
        Ok(Self {
            phase,
            effort,
            speed,
            pitch,
            roll,
            yaw,
            burst,
            mouth,
            flipper_raise,
            flipper_twist,
            flipper_sweep,
        })
    }

    /// Writes the floats back.
    pub(super) fn write(&self, state: &mut [f64]) {
        let all = [
            self.phase,
            self.effort,
            self.speed,
            self.pitch,
            self.roll,
            self.yaw,
            self.burst,
            self.mouth,
            self.flipper_raise,
            self.flipper_twist,
            self.flipper_sweep,
        ];
        state.copy_from_slice(&all);
    }

    /// Moves the smoothed controls towards the pilot's over one step.
    pub(super) fn follow(&mut self, settings: &Settings, controls: &Controls, dt_s: f64) {
        let share = -libm::expm1(-dt_s / settings.smoothing_s);
        let swims = controls.speed > 0.0 || controls.burst > 0.0;
        for (value, wanted) in [
            (&mut self.effort, f64::from(u8::from(swims))),
            (&mut self.speed, controls.speed.clamp(0.0, 1.0)),
            (&mut self.pitch, controls.pitch.clamp(-1.0, 1.0)),
            (&mut self.roll, controls.roll.clamp(-1.0, 1.0)),
            (&mut self.yaw, controls.yaw.clamp(-1.0, 1.0)),
            (&mut self.burst, controls.burst.clamp(0.0, 1.0)),
        ] {
            *value += share * (wanted - *value);
        }
        let flipper = dt_s / settings.flipper_time_s;
        approach(&mut self.mouth, controls.mouth.clamp(0.0, 1.0), dt_s / settings.mouth_time_s);
        approach(&mut self.flipper_raise, controls.flipper_raise.clamp(-1.0, 1.0), flipper);
        approach(&mut self.flipper_twist, controls.flipper_twist.clamp(-1.0, 1.0), flipper);
        approach(&mut self.flipper_sweep, controls.flipper_sweep.clamp(-1.0, 1.0), flipper);
    }

    /// Moves the phase of the beat on over one step.
    pub(super) fn advance_phase(&mut self, frequency_hz: f64, dt_s: f64) {
        self.phase = (self.phase + TAU * frequency_hz * dt_s) % TAU;
    }
}

/// Moves a value towards another by at most `most`.
fn approach(value: &mut f64, wanted: f64, most: f64) {
    *value += (wanted - *value).clamp(-most, most);
}
