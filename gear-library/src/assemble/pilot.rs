//! The pilot program of a scenario, with the parts and acts it names looked up.

use std::sync::Arc;

use endline_sdk::{Controls, Descriptor};
use endline_sim::model::{PilotEntry, PilotProgram, Target, Trigger};

use crate::diagnostic::At;
use crate::nearest::hint;
use crate::scenario::{PilotOf, TriggerOf};

use super::builder::{Builder, Part};

impl Builder<'_> {
    /// The pilot program of the scenario's whale, once the gear is there that its entries may name.
    pub fn add_pilot(&mut self) {
        let Some(motion) = self.spec.whale.as_ref().map(|whale| Arc::clone(&whale.motion)) else {
            return;
        };
        let Some(placed) = &self.scenario.whale else { return };
        let program = self.pilot(&placed.pilot, motion.descriptor());
        if let Some(whale) = &mut self.spec.whale {
            whale.pilot = program;
        }
    }

    /// The program of these entries for a motion that declares its acts.
    fn pilot(&self, entries: &[PilotOf], motion: &Descriptor) -> PilotProgram {
        PilotProgram {
            entries: entries.iter().filter_map(|entry| self.pilot_entry(entry, motion)).collect(),
        }
    }

    fn pilot_entry(&self, entry: &PilotOf, motion: &Descriptor) -> Option<PilotEntry> {
        let mut controls = entry.controls;
        if let Some(act) = &entry.act {
            controls[Controls::ACT] = Some(self.act(act, motion)?);
        }
        let trigger = match &entry.trigger {
            TriggerOf::Time(time_s) => Trigger::Time(*time_s),
            TriggerOf::Touch(part) => Trigger::Touch(*part),
            TriggerOf::Within(distance_m, of) => {
                Trigger::Within(*distance_m, self.target(of.as_ref())?)
            }
            TriggerOf::Depth(depth_m) => Trigger::Depth(*depth_m),
            TriggerOf::Heading(bearing_rad) => Trigger::Heading(*bearing_rad),
            TriggerOf::After(entry) => Trigger::After(*entry),
        };
        Some(PilotEntry {
            trigger,
            delay_s: entry.delay_s,
            hold_s: entry.hold_s,
            ramp_s: entry.ramp_s,
            controls,
        })
    }

    /// Number of an act; `none` is 0.
    fn act(&self, act: &At<String>, motion: &Descriptor) -> Option<f64> {
        let known = || motion.acts.iter().map(|act| act.id.as_ref());
        let place = std::iter::once("none").chain(known()).position(|id| id == act.value);
        if place.is_none() {
            let message = format!("the motion {} has no act `{}`", motion.id, act.value);
            self.problems.push(act.place.error(message, hint(&act.value, known().chain(["none"]))));
        }
        place.map(|place| place as f64)
    }

    /// The part of the gear that a distance is taken to; any line where none is named.
    fn target(&self, of: Option<&At<String>>) -> Option<Target> {
        let Some(of) = of else { return Some(Target::AnyLine) };
        match self.part(&of.value) {
            Some(Part::Body(body)) => Some(Target::Body(body)),
            Some(Part::Joint(joint)) => Some(Target::Joint(joint)),
            Some(Part::Line { first, last }) => Some(Target::Lines(first..last + 1)),
            _ => {
                let is_target =
                    |part| matches!(part, Part::Body(_) | Part::Joint(_) | Part::Line { .. });
                self.unknown("line, body or joint", of, is_target);
                None
            }
        }
    }
}
