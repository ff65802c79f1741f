//! The state hash: 64 bits for each part of a state, so that a replay names the part that differs.
//!
//! A hash of our own rather than a library's, for one property: every word is folded in by a
//! bijection of the running hash (rotate, exclusive or, multiply by an odd number), so states
//! that differ in one word always differ in hash, and a few thousand words a step cost
//! microseconds without copying them into bytes first. It guards against drift and damage, not
//! against an adversary; files are sealed with BLAKE3.

use endline_sdk::{Controls, Posture};
use endline_sim::state::{
    BodyGrip, BodyGrips, BodyState, FrictionState, PairGrip, RopeGrip, RopeState, RopeWithin,
    SolidGrip, StepControl, WhaleState,
};
use endline_sim::whale::Exertion;
use endline_sim::{DQuat, DVec3, Input, State};

/// How many parts a state is hashed by.
pub const PARTS: usize = 7;

/// Names of the parts, in the order of [`StateHash::parts`].
pub const PART_NAMES: [&str; PARTS] =
    ["input", "clock", "rope", "bodies", "whale", "contact and friction", "links and gear"];

/// Hash of a state and of the input that led to it, part by part.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct StateHash {
    /// One hash a part, in the order of [`PART_NAMES`].
    pub parts: [u64; PARTS],
}

impl StateHash {
    /// Hashes a state and the input of the step that led to it.
    pub fn of(input: &Input, state: &State) -> Self {
        // No `..`: a new field of the state must find its part here before this compiles. The pilot's memory chooses
        // inputs, which are hashed; so a run flown by hand and its program, which sees nothing, have the same hashes.
        let State {
            time_s,
            step,
            rope,
            bodies,
            body_grips,
            pair_grips,
            whale,
            link_parted_s,
            line_parted,
            gear,
            step_control,
            pilot: _,
        } = state;
        let mut parts = [Fold::new(); PARTS];
        let [_, clock, ropes, rigid, animal, contact, links] = &mut parts;
        clock.real(*time_s);
        clock.word(*step);
        fold_rope(rope, ropes, contact, links);
        for body in bodies {
            fold_body(body, rigid);
        }
        fold_body_grips(body_grips, contact);
        for PairGrip { parts: two, place, normal, stretch, forgiven_m } in pair_grips {
            two.iter().for_each(|part| contact.word(*part as u64));
            contact.reals(&[*forgiven_m]);
            contact.vectors(&[*place, *normal, *stretch]);
        }
        if let Some(whale) = whale {
            fold_whale(whale, animal, contact);
        }
        link_parted_s.iter().for_each(|parted| links.maybe(*parted));
        for parted in line_parted {
            links.maybe(parted.map(|(time_s, _)| time_s));
            links.maybe(parted.map(|(_, along_m)| along_m));
        }
        gear.iter().for_each(|floats| links.reals(floats));
        fold_step_control(step_control, clock);
        parts[0] = Fold(input_hash(input));
        Self { parts: parts.map(|fold| fold.0) }
    }

    /// Name of the first part in which two hashes differ; `None` where they are equal.
    pub fn first_difference(&self, other: &Self) -> Option<&'static str> {
        (0..PARTS).find(|&part| self.parts[part] != other.parts[part]).map(|part| PART_NAMES[part])
    }

    /// All parts in one number, as sixteen hexadecimal digits.
    pub fn hex(&self) -> String {
        let mut whole = Fold::new();
        self.parts.iter().for_each(|part| whole.word(*part));
        format!("{:016x}", whole.0)
    }
}

/// Hash of an input: the part `input` of the step it led to, so that a changed input is found
/// before it is stepped with.
pub fn input_hash(input: &Input) -> u64 {
    let mut fold = Fold::new();
    fold.controls(&input.controls);
    fold.0
}

fn fold_body_grips(BodyGrips { contacts, floats }: &BodyGrips, contact: &mut Fold) {
    if contacts.is_empty() {
        return;
    }
    for BodyGrip { part, place, normal } in contacts {
        contact.word(*part as u64);
        contact.vectors(&[*place, *normal]);
    }
    contact.reals(floats);
}

fn fold_rope(rope: &RopeState, ropes: &mut Fold, contact: &mut Fold, links: &mut Fold) {
    let RopeState {
        position,
        velocity,
        segment_length,
        tension,
        cut,
        earlier_position,
        earlier_velocity,
        earlier_dt_s,
        seabed_grip,
        friction,
        solid_grips,
        within,
        rope_grips,
    } = rope;
    for vectors in [position, velocity, earlier_position, earlier_velocity] {
        ropes.vectors(vectors);
    }
    ropes.reals(segment_length);
    ropes.reals(tension);
    ropes.real(*earlier_dt_s);
    contact.vectors(seabed_grip);
    let FrictionState { sites, push_n, normals, floats } = friction;
    sites.iter().for_each(|site| contact.word(*site));
    contact.reals(push_n);
    contact.vectors(normals);
    contact.reals(floats);
    for SolidGrip { solid, line, along_m, bears, stretch, push_n, most_n_m } in solid_grips {
        contact.word(*solid as u64);
        contact.word(*line as u64);
        contact.word(*bears as u64);
        contact.reals(&[*along_m, *push_n, *most_n_m]);
        contact.vectors(&[*stretch]);
    }
    for RopeWithin { solid, line, from_m, to_m } in within {
        contact.word(*solid as u64);
        contact.word(*line as u64);
        contact.reals(&[*from_m, *to_m]);
    }
    for RopeGrip { lines, knots, along_m, stretch, forgiven_m } in rope_grips {
        lines.iter().for_each(|line| contact.word(*line as u64));
        knots.iter().flatten().for_each(|knot| contact.word(*knot as u64));
        contact.reals(along_m);
        contact.vectors(&[*stretch]);
        contact.real(*forgiven_m);
    }
    cut.iter().for_each(|cut| links.word(u64::from(*cut)));
}

fn fold_step_control(control: &StepControl, clock: &mut Fold) {
    let StepControl { step_s, limit, contact_step_s, tension_n, known, still_steps } = control;
    clock.real(*step_s);
    clock.word(*limit as u64);
    clock.real(*contact_step_s);
    tension_n.iter().for_each(|two| clock.reals(two));
    clock.word(u64::from(*known));
    still_steps.iter().for_each(|steps| clock.word(u64::from(*steps)));
}

fn fold_body(body: &BodyState, fold: &mut Fold) {
    let BodyState {
        position,
        orientation,
        velocity,
        spin,
        earlier_position,
        earlier_velocity,
        earlier_orientation,
        earlier_spin,
        grip,
        sliding,
        lift_m,
    } = body;
    fold.vectors(&[*position, *velocity, *spin, *earlier_position, *earlier_velocity]);
    fold.vectors(&[*earlier_spin]);
    fold.turn(*orientation);
    fold.turn(*earlier_orientation);
    fold.vectors(grip);
    sliding.iter().for_each(|sliding| fold.word(u64::from(*sliding)));
    fold.reals(lift_m);
}

fn fold_whale(whale: &WhaleState, fold: &mut Fold, contact: &mut Fold) {
    let WhaleState {
        position,
        orientation,
        speed_m_s,
        turn_rate,
        posture,
        motion,
        contact_force_n,
        contact_port_m,
        mouth_moment_n_m,
        exertion,
    } = whale;
    fold.vectors(&[*position, *turn_rate]);
    fold.turn(*orientation);
    fold.real(*speed_m_s);
    fold.posture(posture);
    fold.reals(motion);
    contact.reals(contact_force_n);
    contact.reals(contact_port_m);
    contact.reals(mouth_moment_n_m);
    let Exertion {
        slip_m_s,
        asked_speed_m_s,
        asked_turn_rate,
        thrust_n,
        fatigue,
        drag_n,
        power_w,
        rope_force_n,
        rope_moment_n_m,
        behind_m,
        behind_rad,
    } = exertion;
    fold.reals(slip_m_s);
    fold.reals(&[*asked_speed_m_s, *thrust_n, *fatigue, *drag_n, *power_w]);
    fold.vectors(&[*asked_turn_rate, *behind_m, *behind_rad]);
    contact.vectors(&[*rope_force_n, *rope_moment_n_m]);
}

/// A running hash.
#[derive(Clone, Copy)]
struct Fold(u64);

impl Fold {
    /// Any odd number with well-spread bits; this is 2⁶⁴ over the golden ratio.
    const FACTOR: u64 = 0x9e37_79b9_7f4a_7c15;

    fn new() -> Self {
        Self(0x243f_6a88_85a3_08d3)
    }

    fn word(&mut self, word: u64) {
        self.0 = (self.0.rotate_left(23) ^ word).wrapping_mul(Self::FACTOR);
    }

    /// The bits of a number; -0 and 0 differ, as they may lead to different bits later.
    fn real(&mut self, number: f64) {
        self.word(number.to_bits());
    }

    fn reals(&mut self, numbers: &[f64]) {
        self.word(numbers.len() as u64);
        numbers.iter().for_each(|number| self.real(*number));
    }

    fn vectors(&mut self, vectors: &[DVec3]) {
        self.word(vectors.len() as u64);
        for vector in vectors {
            vector.to_array().iter().for_each(|number| self.real(*number));
        }
    }

    fn turn(&mut self, turn: DQuat) {
        turn.to_array().iter().for_each(|number| self.real(*number));
    }

    fn maybe(&mut self, number: Option<f64>) {
        self.word(u64::from(number.is_some()));
        self.real(number.unwrap_or_default());
    }

    fn controls(&mut self, controls: &Controls) {
        controls.to_array().iter().for_each(|number| self.real(*number));
    }

    fn posture(&mut self, posture: &Posture) {
        posture.groups().into_iter().for_each(|(_, angles)| self.reals(angles));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_changed_word_always_changes_the_hash() {
        let words: Vec<u64> =
            (0..64).map(|word: u64| word.wrapping_mul(0x1234_5678_9abc_def1)).collect();
        let hash = |words: &[u64]| {
            let mut fold = Fold::new();
            words.iter().for_each(|word| fold.word(*word));
            fold.0
        };
        for place in 0..words.len() {
            for bit in 0..64 {
                let mut changed = words.clone();
                changed[place] ^= 1 << bit;
                assert_ne!(hash(&words), hash(&changed), "word {place} bit {bit}");
            }
        }
    }

    #[test]
    fn zero_and_minus_zero_differ() {
        let (mut plus, mut minus) = (Fold::new(), Fold::new());
        plus.real(0.0);
        minus.real(-0.0);
        assert_ne!(plus.0, minus.0);
    }
}
