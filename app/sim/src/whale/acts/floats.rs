//! The floats that acting keeps between steps, behind those of the motion that swims.

use endline_sdk::{HookError, MotionInput, MotionOutput};
use glam::DVec3;

use super::angles::ANGLES;
use super::touch::{Felt, NEW_TOUCH_S, side, touched};
use crate::whale::Angle;
use crate::whale::pose::{angle_mut, angle_of};

/// Greatest change of the turn towards a bank or climb [rad/s²]; an estimate.
const STEER_RAD_S2: f64 = 0.5;

/// What plays: an act, how far it is, and for which side.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Playing {
    /// Which act, counted from 1; 0 is none [1].
    pub act: usize,
    /// Time since it began [s].
    pub time_s: f64,
    /// Whether it is the mirror image of what is written.
    pub mirror: bool,
}

/// The floats by name; all zero is a whale that swims and has not been touched.
#[derive(Clone, Debug, PartialEq)]
pub struct Floats {
    /// What plays now.
    pub playing: Playing,
    /// The act the pilot asked for in the last step, counted from 1.
    pub asked: usize,
    /// How long rope must stay away until a touch counts as a new one [s]; counts down.
    pub touched_s: f64,
    /// How long until the whale answers a lasting touch again [s]; counts down.
    pub answered_s: f64,
    /// Turn rates towards the bank and climb that the act asks for, about the whale's own axes [rad/s].
    pub steer: [f64; 3],
    /// Side of the last touch: 1 left (port), -1 right; 0 before any.
    pub touch_side: f64,
    /// Time since the last change of act [s].
    pub faded_s: f64,
    /// Time in which what the change left over fades [s]; 0 where nothing is left.
    pub fade_s: f64,
    /// Angles left over at the change [rad].
    pub angles: [f64; ANGLES],
    /// Turn rates left over at the change [rad/s].
    pub rates: [f64; 3],
}

/// How many floats there are.
pub const LEN: usize = 9 + ANGLES + 6;

impl Floats {
    /// From the engine's floats.
    ///
    /// # Errors
    /// Where there are not [`LEN`] of them.
    pub fn read(state: &[f64]) -> Result<Self, HookError> {
        let wrong =
            || HookError::new(format!("expected {LEN} floats for acts, got {}", state.len()));
        let (head, rest) = state.split_first_chunk::<9>().ok_or_else(wrong)?;
        let (angles, rest) = rest.split_first_chunk::<ANGLES>().ok_or_else(wrong)?;
        let (rates, rest) = rest.split_first_chunk::<3>().ok_or_else(wrong)?;
        let steer: [f64; 3] = rest.try_into().map_err(|_| wrong())?;
        let [act, time_s, mirror, asked, touched_s, answered_s, touch_side, faded_s, fade_s] =
            *head;
        let playing = Playing { act: count(act), time_s, mirror: mirror > 0.5 };
        Ok(Self {
            playing,
            asked: count(asked),
            touched_s,
            answered_s,
            steer,
            touch_side,
            faded_s,
            fade_s,
            angles: *angles,
            rates: *rates,
        })
    }

    /// To the engine's floats, [`LEN`] of them.
    pub fn write(&self, state: &mut [f64]) {
        let Self {
            playing,
            asked,
            touched_s,
            answered_s,
            steer,
            touch_side,
            faded_s,
            fade_s,
            angles,
            rates,
        } = self;
        let mirror = f64::from(u8::from(playing.mirror));
        let head = [
            number(playing.act),
            playing.time_s,
            mirror,
            number(*asked),
            *touched_s,
            *answered_s,
            *touch_side,
            *faded_s,
            *fade_s,
        ];
        let all = head.iter().chain(angles).chain(rates).chain(steer);
        state.iter_mut().zip(all).for_each(|(place, value)| *place = *value);
    }

    /// Takes in the forces of the last step; what the whale feels of them.
    pub fn feel(&mut self, input: &MotionInput<'_>, above_n: f64) -> Felt {
        let parts = touched(input, above_n);
        let any = parts.contains(&true);
        let is_new = any && self.touched_s <= 0.0;
        let sided = side(input);
        if any && sided.abs() > 0.0 {
            self.touch_side = sided;
        }
        self.touched_s = if any { NEW_TOUCH_S } else { (self.touched_s - input.dt_s).max(0.0) };
        self.answered_s = (self.answered_s - input.dt_s).max(0.0);
        Felt { parts, any, is_new }
    }

    /// Turns towards wanted rates, no faster than [`STEER_RAD_S2`]: the way to an attitude may flip from one side to the other.
    pub fn steer_to(&mut self, wanted: DVec3, dt_s: f64) {
        let most = STEER_RAD_S2 * dt_s;
        for (rate, wanted) in self.steer.iter_mut().zip(wanted.to_array()) {
            *rate += (wanted - *rate).clamp(-most, most);
        }
    }

    /// A target with what is left over from the last change.
    #[must_use]
    pub fn add_left(&self, target: &MotionOutput) -> MotionOutput {
        let mut shown = *target;
        if self.faded_s >= self.fade_s {
            return shown;
        }
        let r = self.faded_s / self.fade_s;
        let share = 1.0 - r * r * (3.0 - 2.0 * r);
        for (angle, left) in Angle::all().zip(&self.angles) {
            if let Some(place) = angle_mut(&mut shown.posture, angle) {
                *place += share * left;
            }
        }
        for (rate, left) in shown.turn_rate_rad_s.iter_mut().zip(self.rates) {
            *rate += share * left;
        }
        shown
    }

    /// Keeps what lies between what is shown and a new target, to fade from now on.
    pub fn leave(&mut self, shown: &MotionOutput, target: &MotionOutput, fade_s: f64) {
        for (angle, left) in Angle::all().zip(&mut self.angles) {
            *left = angle_of(&shown.posture, angle) - angle_of(&target.posture, angle);
        }
        for (axis, left) in self.rates.iter_mut().enumerate() {
            *left = shown.turn_rate_rad_s[axis] - target.turn_rate_rad_s[axis];
        }
        (self.faded_s, self.fade_s) = (0.0, fade_s);
    }
}

/// A count kept as a float; anything else is 0.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "between 0 and a million"
)]
pub fn count(value: f64) -> usize {
    if (0.5..1e6).contains(&value) { libm::round(value) as usize } else { 0 }
}

#[expect(clippy::cast_precision_loss, reason = "acts are few")]
fn number(count: usize) -> f64 {
    count as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn floats_are_read_as_they_were_written() {
        let mut state: Vec<f64> = (0..LEN).map(|index| 0.25 + index as f64).collect();
        (state[0], state[2], state[3]) = (3.0, 1.0, 7.0);
        let before = state.clone();
        let floats = Floats::read(&state).unwrap();
        state.fill(0.0);
        floats.write(&mut state);
        assert_eq!(state, before);
        assert!(Floats::read(&state[1..]).unwrap_err().message.contains("floats for acts"));
    }
}
