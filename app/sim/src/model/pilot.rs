//! The pilot program: which controls begin when, and how long they hold.

use std::ops::Range;

use endline_sdk::{BodyPart, Controls};

/// Controls where no pilot flies.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PilotProgram {
    /// Its entries.
    pub entries: Vec<PilotEntry>,
}

/// Controls that hold from a beginning on.
#[derive(Clone, Debug, PartialEq)]
pub struct PilotEntry {
    /// What begins it; once.
    pub trigger: Trigger,
    /// Time from there to its beginning [s].
    pub delay_s: f64,
    /// How long it holds its controls; infinite for ever [s].
    pub hold_s: f64,
    /// Time over which controls come to their values, and leave them after the hold [s].
    pub ramp_s: f64,
    /// The controls it names, in the order of [`Controls::NAMES`].
    pub controls: [Option<f64>; Controls::COUNT],
}

/// What begins an entry.
#[derive(Clone, Debug, PartialEq)]
pub enum Trigger {
    /// A simulated time [s].
    Time(f64),
    /// Rope first presses on a body part, or on any.
    Touch(Option<BodyPart>),
    /// The whale's axis, the straight line from snout to fluke notch, first comes this near [m].
    Within(f64, Target),
    /// Mid-body passes this depth, either way [m].
    Depth(f64),
    /// The compass bearing of the whale's x axis passes this one, either way [rad].
    Heading(f64),
    /// The entry of this index, above it, begins.
    After(usize),
}

/// What a whale may come near.
#[derive(Clone, Debug, PartialEq)]
pub enum Target {
    /// Any line.
    AnyLine,
    /// These lines: the pieces of one.
    Lines(Range<usize>),
    /// A body's origin.
    Body(usize),
    /// A joint.
    Joint(usize),
}

impl PilotProgram {
    /// Whether its numbers are finite, where a hold may be without end, and entries follow others above them only.
    pub(crate) fn is_sound(&self) -> bool {
        self.entries.iter().enumerate().all(|(index, entry)| {
            let amounts = entry.controls.iter().flatten().chain([&entry.delay_s, &entry.ramp_s]);
            let follows =
                if let Trigger::After(other) = entry.trigger { other < index } else { true };
            follows && entry.hold_s > 0.0 && amounts.copied().all(f64::is_finite)
        })
    }
}
