//! Acts: movements of a whale on request of its pilot or in response to contact, superposed on any motion.
//!
//! [`Acting`] combines a motion and clips. A clip ([`Clip`]) has keys over time for joint angles, turns, bank and climb
//! relative to the horizon, and controls; the gear library reads it from a text file. The underlying motion continues
//! unchanged.
//!
//! ```text
//! pilot's controls --(replaced by the clip)--> underlying motion --> posture, turn rates, speed
//!                                                                |  replaced by the clip or added to
//!                                                             target(t)
//! shown(t) = target(t) + left (1 - 3r² + 2r³),   r = time since the last change of act / fade time, at most 1
//! left     = shown - target at the change, so that no value jumps
//! ```
//!
//! Angles in radians, times in seconds. An act continues while the pilot requests it (`Controls::act`); a clip that returns
//! ends by itself. The end of the request ends the act. Without an act or a fade the output of the underlying motion is passed
//! on to the bit.
//! The state of acts is stored as floats behind those of the underlying motion.

mod clip;
#[cfg(test)]
mod tests;

use std::sync::Arc;

use endline_sdk::{
    Act, BodyPart, Controls, Descriptor, HookError, MotionInput, MotionOutput, WhaleMotion,
};
use glam::{DQuat, DVec3};

use super::Angle;
use super::pose::{angle_mut, angle_of};

pub use clip::{
    ANGLES, After, Blend, Clip, Control, Curve, Moves, Side, Track, Turn, attitude, mirrored,
    rates_to,
};

/// Force on a part above which a whale without responses notices contact [N].
const NOTICED_N: f64 = 1.0;

/// A motion that superposes acts on another.
pub struct Acting {
    beneath: Arc<dyn WhaleMotion>,
    clips: Vec<Clip>,
    answers: Option<Answers>,
    descriptor: Descriptor,
}

impl Acting {
    /// A motion with acts, which are numbered after those of the underlying motion.
    ///
    /// `answers` refers to acts by that number, which must be that of a clip.
    pub fn new(beneath: Arc<dyn WhaleMotion>, clips: Vec<Clip>, answers: Option<Answers>) -> Self {
        let mut descriptor = beneath.descriptor().clone();
        let act = |clip: &Clip| Act {
            id: clip.id.clone().into(),
            name: clip.name.clone().into(),
            help: clip.help.clone().into(),
        };
        descriptor.acts.extend(clips.iter().map(act));
        descriptor.state_len += LEN;
        Self { beneath, clips, answers, descriptor }
    }

    /// Acts, in the order of their numbers after those of the underlying motion.
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
    /// Clip of an act by its number from 1; `None` for an act of the underlying motion.
    fn clip(&self, act: usize) -> Option<&Clip> {
        self.clips.get(act.checked_sub(1 + self.beneath.descriptor().acts.len())?)
    }

    /// Returns the act of this step: that of the pilot's request, otherwise the response to contact, otherwise the previous
    /// one.
    fn choose(&self, now: &mut Floats, input: &MotionInput<'_>) -> Result<Playing, HookError> {
        let asked = self.asked(&input.controls)?;
        let above_n = self.answers.as_ref().map_or(NOTICED_N, |answers| answers.above_n);
        let noticed = now.notice(input, above_n);
        let mut playing = now.playing;
        let ends = |clip: &Clip| {
            clip.is_over(playing.time_s)
                || noticed.parts.iter().zip(clip.ends_at_touch).any(|(part, ends)| *part && ends)
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
        if let Some(answers) = &self.answers
            && playing.act == 0
            && answers.is_due(&noticed, now.answered_s)
        {
            let act = answers.act(now.answers, held(input, now.contact_s, answers));
            (now.answered_s, now.answers) = (answers.again_s, now.answers + 1);
            if act != 0 {
                playing = self.begin(act, now.touch_side);
            }
        }
        Ok(playing)
    }

    /// Number of the clip that the pilot requests; 0 for none or for an act of the underlying motion.
    fn asked(&self, controls: &Controls) -> Result<usize, HookError> {
        let act = count(controls.act);
        let acts = self.descriptor.acts.len();
        if act > acts {
            return Err(HookError::new(format!(
                "there is no act {act}: the whale has {acts} acts, numbered from 1"
            )));
        }
        Ok(if self.clip(act).is_some() { act } else { 0 })
    }

    /// Starts an act.
    fn begin(&self, act: usize, touch_side: f64) -> Playing {
        let mirror = self.clip(act).is_some_and(|clip| match clip.side {
            Side::AsWritten => false,
            Side::Mirrored => true,
            Side::Touched => touch_side < 0.0,
        });
        Playing { act, time_s: 0.0, mirror }
    }

    /// Steps the underlying motion with the pilot's controls, except those that the clip replaces.
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

    /// Turn rates towards the bank and climb of an act; zero without them [rad/s].
    fn steer(&self, playing: &Playing, input: &MotionInput<'_>) -> DVec3 {
        let Some(clip) = self.clip(playing.act) else { return DVec3::ZERO };
        let wanted = clip.attitude(playing.time_s + input.dt_s, playing.mirror);
        rates_to(DQuat::from_array(input.orientation), wanted, clip.turn_rate_rad_s)
    }

    /// Combined request of the underlying motion and an act at the end of the step.
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

    /// Target of an act that starts, without the turn of its first step if its turns start from rest. The fade then does not
    /// reduce the total turn.
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

    /// Fade time of a change: that of the act that starts, otherwise that of the act that ends [s].
    fn fade_s(&self, before: &Playing, now: &Playing) -> f64 {
        self.clip(now.act).or_else(|| self.clip(before.act)).map_or(0.0, |clip| clip.fade_s)
    }
}

/// Least time without contact before the next contact counts as new [s].
pub const NEW_TOUCH_S: f64 = 1.0;

/// The whale's responses to contact: the first, and later ones while contact lasts or returns.
#[derive(Clone, Debug, PartialEq)]
pub struct Answers {
    /// Number of the act of the first response, from 1, or 0 for none; `None` if it is drawn like later ones.
    pub first: Option<usize>,
    /// Normal force on a part above which it notices contact [N].
    pub above_n: f64,
    /// Time after which it responds again to continuing contact; infinite for never [s].
    pub again_s: f64,
    /// Later responses; `None` repeats the first, at each new contact also.
    pub drawn: Option<DrawnAnswers>,
}

/// Responses that are drawn at random, at most one in each interval.
#[derive(Clone, Debug, PartialEq)]
pub struct DrawnAnswers {
    /// By state, in the order of [`Held`]: acts, 0 for none, with their cumulative probabilities; the last is 1.
    pub acts: [Vec<(usize, f64)>; 3],
    /// Duration of contact after which the whale is held [s].
    pub held_after_s: f64,
    /// Random numbers of 0 to 1, at least one, one for each response in turn; they repeat after the last.
    pub shares: Vec<f64>,
}

/// State of a whale in contact.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Held {
    /// In contact, not held.
    Touched,
    /// Held, and pressed most at the head.
    ByMouth,
    /// Held, and pressed most at another part.
    ByFin,
}

impl Answers {
    /// Whether a response is due.
    fn is_due(&self, noticed: &NoticedContact, answered_s: f64) -> bool {
        let is_again = noticed.any && self.again_s.is_finite() && answered_s <= 0.0;
        is_again || (noticed.is_new && self.drawn.is_none())
    }

    /// Number of the act of a response, 0 for none, by the number of responses before it.
    fn act(&self, before: usize, held: Held) -> usize {
        let Some(drawn) = &self.drawn else { return self.first.unwrap_or(0) };
        if let (0, Some(first)) = (before, self.first) {
            return first;
        }
        debug_assert!(!drawn.shares.is_empty(), "a random number for each response");
        let share = drawn.shares[before % drawn.shares.len()];
        let acts = &drawn.acts[held as usize];
        debug_assert!(acts.is_sorted_by(|one, next| one.1 <= next.1), "cumulative probabilities");
        acts.iter().find(|(_, to)| share < *to).or(acts.last()).map_or(0, |(act, _)| *act)
    }
}

/// State of a whale with contact for a time [s].
fn held(input: &MotionInput<'_>, contact_s: f64, answers: &Answers) -> Held {
    let held_after_s = answers.drawn.as_ref().map_or(0.0, |drawn| drawn.held_after_s);
    let parts = BodyPart::ALL.iter().zip(input.contact_force_n);
    let most = parts.max_by(|one, other| one.1.total_cmp(other.1)).map(|(part, _)| *part);
    match most {
        _ if contact_s < held_after_s => Held::Touched,
        Some(BodyPart::Head) => Held::ByMouth,
        _ => Held::ByFin,
    }
}

/// Contact that the whale notices in the last step.
#[derive(Clone, Copy, Debug)]
pub struct NoticedContact {
    /// Parts in contact.
    pub parts: [bool; BodyPart::ALL.len()],
    /// Whether any part is in contact.
    pub any: bool,
    /// Whether the contact is new.
    pub is_new: bool,
}

/// Returns the parts with a contact force above a limit [N].
pub fn touched(input: &MotionInput<'_>, above_n: f64) -> [bool; BodyPart::ALL.len()] {
    input.contact_force_n.map(|force| force > above_n)
}

/// Distance from the midplane at which contact on head, body or peduncle counts fully for its side, as a share of length: half
/// the breadth of the head.
const WHOLE_SIDE: f64 = 0.07;

/// Share of the total force below which contact has no side.
const MIDDLE: f64 = 0.1;

/// Side of the contact: 1 left (port), -1 right, 0 if neither side dominates.
///
/// Contact on flippers and flukes is on their side; on head, body and peduncle the lateral position determines it.
pub fn side(input: &MotionInput<'_>) -> f64 {
    let (mut sided, mut all) = (0.0, 0.0);
    for (part, (force, port_m)) in
        BodyPart::ALL.iter().zip(input.contact_force_n.iter().zip(input.contact_port_m))
    {
        all += force;
        sided += force
            * part.side().map_or_else(
                || (port_m / (WHOLE_SIDE * input.length_m)).clamp(-1.0, 1.0),
                endline_sdk::Side::sign,
            );
    }
    if sided > MIDDLE * all {
        1.0
    } else if sided < -MIDDLE * all {
        -1.0
    } else {
        0.0
    }
}

/// Greatest angular acceleration towards a bank or climb; an estimate [rad/s²].
const STEER_RAD_S2: f64 = 0.5;

/// An act in progress.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Playing {
    /// Number of the act, from 1; 0 for none.
    pub act: usize,
    /// Time since its start [s].
    pub time_s: f64,
    /// Whether it is mirrored.
    pub mirror: bool,
}

/// State of acts; all zero for a whale that swims and had no contact.
#[derive(Clone, Debug, PartialEq)]
pub struct Floats {
    /// Act in progress.
    pub playing: Playing,
    /// Act that the pilot requested in the last step, numbered from 1; 0 for none.
    pub asked: usize,
    /// Time without contact until the next contact counts as new; decreases [s].
    pub touched_s: f64,
    /// Time until the next response to continuing contact; decreases [s].
    pub answered_s: f64,
    /// Turn rates towards the bank and climb of the act, about the whale's own axes [rad/s].
    pub steer: [f64; 3],
    /// Responses so far.
    pub answers: usize,
    /// Time since contact began, with pauses below [`NEW_TOUCH_S`]; 0 without contact [s].
    pub contact_s: f64,
    /// Side of the last contact: 1 left (port), -1 right; 0 before any.
    pub touch_side: f64,
    /// Time since the last change of act [s].
    pub faded_s: f64,
    /// Duration of the fade; 0 without one [s].
    pub fade_s: f64,
    /// Differences of angles at the change [rad].
    pub angles: [f64; ANGLES],
    /// Differences of turn rates at the change [rad/s].
    pub rates: [f64; 3],
}

/// Number of floats.
pub const LEN: usize = 11 + ANGLES + 6;

impl Floats {
    /// Reads the engine's floats.
    /// Errors: reports a number of floats other than [`LEN`].
    pub fn read(state: &[f64]) -> Result<Self, HookError> {
        let wrong =
            || HookError::new(format!("expected {LEN} floats for acts, got {}", state.len()));
        let (head, rest) = state.split_first_chunk::<11>().ok_or_else(wrong)?;
        let (angles, rest) = rest.split_first_chunk::<ANGLES>().ok_or_else(wrong)?;
        let (rates, rest) = rest.split_first_chunk::<3>().ok_or_else(wrong)?;
        let steer: [f64; 3] = rest.try_into().map_err(|_| wrong())?;
        let [
            act,
            time_s,
            mirror,
            asked,
            touched_s,
            answered_s,
            answers,
            contact_s,
            touch_side,
            faded_s,
            fade_s,
        ] = *head;
        let playing = Playing { act: count(act), time_s, mirror: mirror > 0.5 };
        Ok(Self {
            playing,
            asked: count(asked),
            touched_s,
            answered_s,
            answers: count(answers),
            contact_s,
            steer,
            touch_side,
            faded_s,
            fade_s,
            angles: *angles,
            rates: *rates,
        })
    }

    /// Writes the engine's floats, of which there are [`LEN`].
    pub fn write(&self, state: &mut [f64]) {
        let Self {
            playing,
            asked,
            touched_s,
            answered_s,
            answers,
            contact_s,
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
            number(*answers),
            *contact_s,
            *touch_side,
            *faded_s,
            *fade_s,
        ];
        debug_assert_eq!(state.len(), LEN, "the state of acts has a fixed length");
        let all = head.iter().chain(angles).chain(rates).chain(steer);
        state.iter_mut().zip(all).for_each(|(place, value)| *place = *value);
    }

    /// Updates the state with the contact forces of the last step; returns the contact that the whale notices.
    pub fn notice(&mut self, input: &MotionInput<'_>, above_n: f64) -> NoticedContact {
        let parts = touched(input, above_n);
        let any = parts.contains(&true);
        let is_new = any && self.touched_s <= 0.0;
        let sided = side(input);
        if any && sided.abs() > 0.0 {
            self.touch_side = sided;
        }
        let lasts = any || self.touched_s > input.dt_s;
        self.contact_s = if lasts { self.contact_s + input.dt_s } else { 0.0 };
        self.touched_s = if any { NEW_TOUCH_S } else { (self.touched_s - input.dt_s).max(0.0) };
        self.answered_s = (self.answered_s - input.dt_s).max(0.0);
        NoticedContact { parts, any, is_new }
    }

    /// Approaches target turn rates with at most [`STEER_RAD_S2`], because the direction to an attitude may change
    /// discontinuously.
    pub fn steer_to(&mut self, wanted: DVec3, dt_s: f64) {
        let most = STEER_RAD_S2 * dt_s;
        for (rate, wanted) in self.steer.iter_mut().zip(wanted.to_array()) {
            *rate += (wanted - *rate).clamp(-most, most);
        }
    }

    /// Adds the fading difference of the last change to a target.
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

    /// Stores the difference of the shown values and a new target, and starts its fade.
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

/// Reads a count that is stored as a float; 0 for an invalid value.
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
