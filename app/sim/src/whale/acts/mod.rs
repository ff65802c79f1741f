//! Acts: what a whale does of itself when its pilot asks or rope touches it, played over any motion that swims.
//!
//! [`Acting`] is a motion made of a motion and clips. A clip ([`Clip`]) is keys over time of joint angles, of turns, of
//! bank and climb against the horizon, and of controls; it comes from a text file of the gear library, which hands over
//! numbers. The motion beneath swims on and knows nothing of it.
//!
//! ```text
//! pilot's controls --(held by the clip)--> motion beneath --> posture, turn rates, speed
//!                                                                |  clip in their place or on top
//!                                                             target(t)
//! shown(t) = target(t) + left (1 - 3r² + 2r³),   r = time since the last change of act / fade, at most 1
//! left     = shown - target at the change: nothing jumps, however often the pilot changes its mind
//! ```
//!
//! An act runs for as long as the pilot asks for it (`Controls::act`); a clip that returns ends by itself. Letting go breaks it off.
//! Where no act plays and nothing is left to fade, the motion beneath is passed on bit for bit.

mod angles;
mod attitude;
mod clip;
mod curve;
mod floats;
mod touch;

#[cfg(test)]
mod tests;

use std::sync::Arc;

use endline_sdk::{Act, Controls, Descriptor, HookError, MotionInput, MotionOutput, WhaleMotion};
use glam::{DQuat, DVec3};

pub use angles::{ANGLES, mirrored};
pub use attitude::{attitude, rates_to};
pub use clip::{After, Blend, Clip, Control, Moves, Side, Track, Turn};
pub use curve::Curve;
pub use touch::{Answer, NEW_TOUCH_S};

use floats::{Floats, Playing, count};

/// Force on a part from which a whale without an answer feels a touch [N].
const FELT_N: f64 = 1.0;

/// A motion that plays acts over another.
pub struct Acting {
    beneath: Arc<dyn WhaleMotion>,
    clips: Vec<Clip>,
    answer: Option<Answer>,
    descriptor: Descriptor,
}

impl Acting {
    /// A motion with acts; they follow those that the motion has of its own, in the order given.
    ///
    /// `answer` counts its act among all of them and must name one of the clips.
    #[must_use]
    pub fn new(beneath: Arc<dyn WhaleMotion>, clips: Vec<Clip>, answer: Option<Answer>) -> Self {
        let mut descriptor = beneath.descriptor().clone();
        let act = |clip: &Clip| Act {
            id: clip.id.clone().into(),
            name: clip.name.clone().into(),
            help: clip.help.clone().into(),
        };
        descriptor.acts.extend(clips.iter().map(act));
        descriptor.state_len += floats::LEN;
        Self { beneath, clips, answer, descriptor }
    }

    /// The acts it plays, in the order in which they follow those of the motion beneath.
    #[must_use]
    pub fn clips(&self) -> &[Clip] {
        &self.clips
    }
}

impl WhaleMotion for Acting {
    fn descriptor(&self) -> &Descriptor {
        &self.descriptor
    }

    fn step(
        &self,
        attributes: &[f64],
        input: &MotionInput<'_>,
        state: &mut [f64],
    ) -> Result<MotionOutput, HookError> {
        let (own, kept) = state.split_at_mut(self.beneath.descriptor().state_len.min(state.len()));
        let mut now = Floats::read(kept)?;
        let before = now.playing;
        now.playing = self.choose(&mut now, input)?;
        let swimming = self.swim(attributes, input, own, &now.playing)?;
        let target = self.target(&swimming, &now.playing, input);
        now.faded_s += input.dt_s;
        if now.playing != before {
            let shown = now.add_left(&self.target(&swimming, &before, input));
            let unturned = self.unturned(&target, &now.playing, input.dt_s);
            now.leave(&shown, &unturned, self.fade_s(&before, &now.playing));
        }
        let mut shown = now.add_left(&target);
        now.steer_to(self.steer(&now.playing, input), input.dt_s);
        shown.turn_rate_rad_s.iter_mut().zip(now.steer).for_each(|(rate, steer)| *rate += steer);
        now.playing.time_s += input.dt_s;
        now.write(kept);
        Ok(shown)
    }
}

impl Acting {
    /// The clip of an act, counted from 1 among all; none for one of the motion beneath.
    fn clip(&self, act: usize) -> Option<&Clip> {
        self.clips.get(act.checked_sub(1 + self.beneath.descriptor().acts.len())?)
    }

    /// What plays in this step: what the pilot asks for, else the answer to a touch, else what played.
    fn choose(&self, now: &mut Floats, input: &MotionInput<'_>) -> Result<Playing, HookError> {
        let asked = self.asked(&input.controls)?;
        let felt = now.feel(input, self.answer.map_or(FELT_N, |answer| answer.above_n));
        let mut playing = now.playing;
        let ends = |clip: &Clip| {
            clip.is_over(playing.time_s)
                || felt.parts.iter().zip(clip.ends_at_touch).any(|(felt, ends)| *felt && ends)
        };
        if self.clip(playing.act).is_some_and(ends) {
            playing = Playing::default();
        }
        if asked != now.asked {
            let pilots = playing.act == now.asked;
            now.asked = asked;
            if asked != 0 || pilots {
                playing = self.begin(asked, now.touch_side);
            }
        }
        if let Some(answer) = &self.answer
            && playing.act == 0
            && (felt.is_new || felt.any && answer.again_s.is_finite() && now.answered_s <= 0.0)
        {
            now.answered_s = answer.again_s;
            playing = self.begin(answer.act, now.touch_side);
        }
        Ok(playing)
    }

    /// The clip the pilot asks for; 0 for none, or for an act of the motion beneath.
    fn asked(&self, controls: &Controls) -> Result<usize, HookError> {
        let act = count(controls.act);
        let acts = self.descriptor.acts.len();
        if act > acts {
            return Err(HookError::new(format!(
                "there is no act {act}: the whale has {acts}, counted from 1"
            )));
        }
        Ok(if self.clip(act).is_some() { act } else { 0 })
    }

    fn begin(&self, act: usize, touch_side: f64) -> Playing {
        let mirror = self.clip(act).is_some_and(|clip| match clip.side {
            Side::AsWritten => false,
            Side::Mirrored => true,
            Side::Touched => touch_side < 0.0,
        });
        Playing { act, time_s: 0.0, mirror }
    }

    /// The motion beneath under the controls that the clip leaves to the pilot.
    fn swim(
        &self,
        attributes: &[f64],
        input: &MotionInput<'_>,
        own: &mut [f64],
        playing: &Playing,
    ) -> Result<MotionOutput, HookError> {
        let mut controls = input.controls;
        if let Some(clip) = self.clip(playing.act) {
            controls = clip.controls(playing.time_s + input.dt_s, playing.mirror, &controls);
        }
        if self.clip(count(controls.act)).is_some() {
            controls.act = 0.0;
        }
        self.beneath.step(attributes, &MotionInput { controls, ..*input }, own)
    }

    /// Turn rates towards the bank and climb that an act asks for [rad/s]; zero where it asks for none.
    fn steer(&self, playing: &Playing, input: &MotionInput<'_>) -> DVec3 {
        let Some(clip) = self.clip(playing.act) else { return DVec3::ZERO };
        let wanted = clip.attitude(playing.time_s + input.dt_s, playing.mirror);
        rates_to(DQuat::from_array(input.orientation), wanted, clip.turn_rate_rad_s)
    }

    /// What swimming and an act ask for at the end of the step.
    fn target(
        &self,
        swimming: &MotionOutput,
        playing: &Playing,
        input: &MotionInput<'_>,
    ) -> MotionOutput {
        let Some(clip) = self.clip(playing.act) else { return *swimming };
        let (from_s, to_s) = (playing.time_s, playing.time_s + input.dt_s);
        let [roll, pitch, yaw] = clip.turned(from_s, to_s, playing.mirror);
        let turned = [roll, -pitch, yaw].map(|turned| turned / input.dt_s);
        MotionOutput {
            speed_m_s: swimming.speed_m_s,
            turn_rate_rad_s: std::array::from_fn(|axis| {
                swimming.turn_rate_rad_s[axis] + turned[axis]
            }),
            posture: clip.posture(to_s, playing.mirror, &swimming.posture),
        }
    }

    /// The target of an act that begins, without the turn of its first step where its turns ease in from rest anyway:
    /// what fades must not take from how far it turns.
    fn unturned(&self, target: &MotionOutput, playing: &Playing, dt_s: f64) -> MotionOutput {
        let mut target = *target;
        if let Some(clip) = self.clip(playing.act).filter(|clip| clip.after != After::Repeat) {
            let [roll, pitch, yaw] =
                clip.turned(playing.time_s, playing.time_s + dt_s, playing.mirror);
            for (rate, turned) in target.turn_rate_rad_s.iter_mut().zip([roll, -pitch, yaw]) {
                *rate -= turned / dt_s;
            }
        }
        target
    }

    /// How long a change takes: as the act says that begins, or where none does, as the one says that ends [s].
    fn fade_s(&self, before: &Playing, now: &Playing) -> f64 {
        self.clip(now.act).or_else(|| self.clip(before.act)).map_or(0.0, |clip| clip.fade_s)
    }
}
