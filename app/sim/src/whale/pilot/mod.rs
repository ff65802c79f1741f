//! The pilot program: controls that change at given times, or when something happens to the whale.
//!
//! ```text
//! v_0 = 0,  v_k = v_(k-1) + w_k (c_k - v_(k-1))     over the entries in the order in which they began
//! w = min((t - b)/r, 1)                             while held, from the beginning b over the ramp r
//! w = max(min(h/r, 1) - (t - b - h)/r, 0)           after the hold h
//! ```
//!
//! for each control with the value `c_k` in entry `k`; an entry says nothing of the controls it does not name. A ramp
//! of zero is a jump, a hold without end never lets go. An act is a choice and not blended: it is the entry's from `b`
//! to `b + h`.
//!
//! The program is pure: what its entries have seen and when they began is part of the [`State`], written at the end of
//! each step, so that snapshots go on alike. It chooses inputs only; inputs alone move the whale, and they are recorded.

mod sense;

use endline_sdk::Controls;

use crate::model::{Model, PilotEntry, PilotProgram, Trigger};
use crate::state::{Begun, PilotMemory, Seen, State};

/// A time counts as reached this much before it [s]: `0.3 s` is the step at 0.29999999999999999.
const GRACE_S: f64 = 1e-7;

impl PilotProgram {
    /// The controls for the step that begins with a state.
    #[must_use]
    pub fn at(&self, state: &State) -> Controls {
        let mut controls = [0.0; Controls::COUNT];
        for begun in &state.pilot.begun {
            let Some(entry) = self.entries.get(begun.entry) else { continue };
            let weight = entry.weight(state.time_s - begun.at_s);
            let held = state.time_s - begun.at_s < entry.hold_s - GRACE_S;
            for (index, (control, wanted)) in controls.iter_mut().zip(entry.controls).enumerate() {
                let Some(wanted) = wanted else { continue };
                // A whole weight gives the very bits that are written.
                match if index == Controls::ACT { f64::from(u8::from(held)) } else { weight } {
                    1.0 => *control = wanted,
                    weight => *control += weight * (wanted - *control),
                }
            }
        }
        Controls::from_array(controls)
    }
}

impl PilotEntry {
    /// How much its controls count, this long after its beginning [1].
    fn weight(&self, since_s: f64) -> f64 {
        let ramped =
            |time_s: f64| if time_s < self.ramp_s { (time_s / self.ramp_s).max(0.0) } else { 1.0 };
        let over_s = since_s - self.hold_s;
        if over_s < -GRACE_S {
            ramped(since_s)
        } else if over_s < self.ramp_s {
            (ramped(self.hold_s) - over_s / self.ramp_s).clamp(0.0, 1.0)
        } else {
            0.0
        }
    }
}

/// Starts the memory of a model's program at a state: nothing seen before it.
pub(crate) fn begin(model: &Model, state: &mut State) {
    let entries = model.spec.whale.as_ref().map_or(0, |whale| whale.pilot.entries.len());
    state.pilot =
        PilotMemory { seen: vec![Seen::default(); entries], begun: Vec::with_capacity(entries) };
    look(model, state);
}

/// Looks at a new state: which triggers are met, which entries begin.
pub(crate) fn look(model: &Model, state: &mut State) {
    let Some(whale) = &model.spec.whale else { return };
    let mut memory = std::mem::take(&mut state.pilot);
    let known = memory.begun.len();
    for (index, entry) in whale.pilot.entries.iter().enumerate() {
        let Some(seen) = memory.seen.get(index).copied().filter(|seen| !seen.begun) else {
            continue;
        };
        let mut seen = match entry.trigger {
            Trigger::After(other) => Seen { met_s: began_s(&memory, other), ..seen },
            _ => sense::look(model, state, &entry.trigger, seen),
        };
        let begins_s = seen.met_s.map(|met_s| met_s + entry.delay_s);
        if let Some(at_s) = begins_s.filter(|at_s| *at_s <= state.time_s + GRACE_S) {
            seen.begun = true;
            memory.begun.push(Begun { entry: index, at_s });
        }
        memory.seen[index] = seen;
    }
    memory.begun[known..].sort_unstable_by(|one, other| {
        one.at_s.total_cmp(&other.at_s).then(one.entry.cmp(&other.entry))
    });
    state.pilot = memory;
}

/// When an entry began [s].
fn began_s(memory: &PilotMemory, entry: usize) -> Option<f64> {
    if !memory.seen.get(entry)?.begun {
        return None;
    }
    memory.begun.iter().find(|begun| begun.entry == entry).map(|begun| begun.at_s)
}
