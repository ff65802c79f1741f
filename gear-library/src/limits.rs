//! Every limit of a number, count, size, depth or time that a file or an option may ask for: one table, each limit with its reason.
//!
//! A limit lies far beyond what gear, whales and seas need, and well within what the program bears.
//! It is there so that a slip of the keyboard, or a hostile file, is refused with a message instead of taking all memory or all day.

use crate::units::{Quantity, format_si};

/// The least and the most of something, and why.
#[derive(Debug, PartialEq)]
pub struct Limit {
    /// What it measures.
    pub quantity: Quantity,
    /// The least allowed [SI].
    pub least: f64,
    /// The most allowed [SI].
    pub most: f64,
    /// Why there is no more: ends the sentence "the limit is there because".
    pub why: &'static str,
    /// What to do instead; may be empty.
    pub mend: &'static str,
}

/// A value beyond its limit, in words.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Beyond {
    /// What is wrong, with field and value.
    pub message: String,
    /// The limit, its reason, and how to mend it.
    pub help: String,
}

/// Step between inputs, and of the solver.
pub const STEP: Limit = Limit {
    quantity: Quantity::Time,
    least: 1e-6,
    most: 1.0,
    why: "a shorter step takes more than a million of them for a second, and a longer one follows no rope",
    mend: "write a step from 1 ms to 20 ms; 10 ms is usual",
};
/// Length of a run.
pub const DURATION: Limit = Limit {
    quantity: Quantity::Time,
    least: 1e-6,
    most: 1e6,
    why: "inputs and hashes of every step are kept",
    mend: "write minutes, such as \"10 min\"",
};
/// Length of a segment of rope.
pub const SEGMENT: Limit = Limit {
    quantity: Quantity::Length,
    least: 1e-3,
    most: 1000.0,
    why: "a segment shorter than rope is thick bends like a row of beads",
    mend: "write a length such as \"0.5 m\"",
};
/// Radius of a ball, or an edge of a box, among the bodies of a scenario.
pub const BODY_SIZE: Limit = Limit {
    quantity: Quantity::Length,
    least: 1e-3,
    most: 20.0,
    why: "a body as large as a whale touches every triangle of its skin at once, and each touch is weighed against all others",
    mend: "write the size of a trap, buoy or anchor, such as \"0.3 m\"; what stands still is an `[[obstacle]]`",
};
/// Nodes of all ropes together.
pub const ROPE_NODES: Limit = Limit {
    quantity: Quantity::Ratio,
    least: 2.0,
    most: 100_000.0,
    why: "a node takes about 4 kB and a step visits every one",
    mend: "write a smaller `rope_nodes`, a longer `segment`, or a shorter line",
};
/// Parts of gear in a scenario: bodies, joints, lines and links together.
pub const PARTS: Limit = count_of(1.0, 10_000.0, "each part is searched for by name and drawn", "");
/// Seed of random draws.
pub const SEED: Limit = count_of(
    0.0,
    9e15,
    "a greater whole number has no exact value in a file",
    "write any smaller whole number",
);
/// Number of the format of a file.
pub const FORMAT: Limit = count_of(1.0, 1e6, "formats are counted up from 1", "");
/// Traps hauled aboard or trawled.
pub const TRAPS: Limit = count_of(1.0, 10_000.0, "no fishery sets more in a row", "");
/// Components of a sea of irregular waves.
pub const WAVE_COMPONENTS: Limit = count_of(
    1.0,
    endline_sim::water::check::MOST_COMPONENTS as f64,
    "every component is summed at every node of rope in every step",
    "64 is usual",
);
/// Encounters of a study.
pub const ENCOUNTERS: Limit = count_of(
    1.0,
    65_536.0,
    "the sequence they are drawn from has no more",
    "1,000 tell a rate to a few percent",
);
/// Encounters that were counted in a study.
pub const COUNTED: Limit = count_of(0.0, 65_536.0, "a study has no more encounters", "");
/// Size of one text file.
pub const TEXT_FILE_BYTES: u64 = 16 << 20;
/// Size of one file of a mesh or an animation.
pub const MESH_FILE_BYTES: u64 = 64 << 20;
/// Size of one recording, table of results or other file that is read whole.
pub const FILE_BYTES: u64 = 4 << 30;
/// Size of all files of a library together.
pub const LIBRARY_BYTES: u64 = 512 << 20;
/// Problems of a file that are kept; the others are counted.
pub const DIAGNOSTICS: usize = 200;
/// Characters of a line that a problem shows.
pub const EXCERPT_CHARS: usize = 160;
/// Corners of a mesh, with every instance of it, counted before they are made.
pub const MESH_CORNERS: usize = 2_000_000;

/// Memory that a node of rope takes in state, workspace and contact [bytes]: 2.6 kB were measured with the scenario `hello-endline`.
const NODE_BYTES: f64 = 4e3;

const fn count_of(least: f64, most: f64, why: &'static str, mend: &'static str) -> Limit {
    Limit { quantity: Quantity::Ratio, least, most, why, mend }
}

const fn up_to(quantity: Quantity, most: f64, why: &'static str) -> Limit {
    Limit { quantity, least: -most, most, why, mend: "" }
}

/// The greatest amount of each quantity, either way from zero: beyond it a figure is a slip of the keyboard, whatever it is of.
static AMOUNTS: [Limit; 19] = [
    up_to(Quantity::Ratio, 1e15, "no ratio, count or coefficient is greater"),
    up_to(Quantity::Length, 1e6, "the sea is flat here, and nothing is a thousand kilometres away"),
    up_to(Quantity::Area, 1e6, "nothing in a model is larger"),
    up_to(Quantity::Volume, 1e6, "nothing in a model is larger"),
    up_to(Quantity::Mass, 1e9, "nothing in a model is heavier"),
    up_to(Quantity::Time, 1e10, "it is longer than three centuries"),
    up_to(Quantity::Speed, 1e3, "nothing in water moves faster"),
    up_to(Quantity::Acceleration, 1e4, "nothing in water is pulled harder"),
    up_to(Quantity::Force, 1e9, "no rope bears more"),
    up_to(
        Quantity::ForceByLength,
        1e9,
        "a stiffer spring is a rigid body, and no step resolves it",
    ),
    up_to(Quantity::Pressure, 1e13, "no material is stiffer"),
    up_to(Quantity::MassByLength, 1e5, "no rope or chain is heavier"),
    up_to(Quantity::Density, 1e5, "no material is denser"),
    up_to(Quantity::Damping, 1e9, "no rope damps more"),
    up_to(Quantity::BendingStiffness, 1e9, "no rope is stiffer"),
    up_to(Quantity::Inertia, 1e12, "nothing in a model is larger"),
    up_to(Quantity::Angle, 1e5, "beyond it rounding blurs where a turn ends"),
    up_to(Quantity::TurnRate, 1e4, "nothing in water turns faster"),
    up_to(Quantity::Frequency, 1e5, "no step resolves it"),
];

/// The greatest amount of a quantity.
#[must_use]
pub fn amount(quantity: Quantity) -> &'static Limit {
    let found = AMOUNTS.iter().find(|limit| limit.quantity == quantity);
    found.unwrap_or(&AMOUNTS[0])
}

impl Limit {
    /// Whether it allows a value [SI].
    #[must_use]
    pub fn holds(&self, value: f64) -> bool {
        (self.least..=self.most).contains(&value)
    }

    /// Refuses a value [SI] beyond it.
    ///
    /// # Errors
    /// With field, value, limit, reason and what to do.
    pub fn check(&self, field: &str, value: f64) -> Result<(), Beyond> {
        if self.holds(value) {
            return Ok(());
        }
        let message = format!("`{field}` is {}", format_si(value, self.quantity));
        Err(Beyond { message, help: self.words() })
    }

    /// The limit, its reason, and what to do.
    #[must_use]
    pub fn words(&self) -> String {
        let Self { least, most, why, mend, .. } = self;
        let [least, most] = [least, most].map(|value| format_si(*value, self.quantity));
        let mend = if mend.is_empty() { String::new() } else { format!("; {mend}") };
        format!("it must be between {least} and {most}, because {why}{mend}")
    }
}

/// Refuses more rope nodes than a run can bear, before memory is taken for them.
///
/// # Errors
/// With the nodes, the memory they would take, the limit and what to do.
pub fn check_nodes(nodes: f64) -> Result<(), Beyond> {
    if nodes <= ROPE_NODES.most {
        return Ok(());
    }
    let gigabytes = nodes * NODE_BYTES / 1e9;
    let message = format!("the ropes come to {nodes:.0} nodes, for about {gigabytes:.1} GB");
    let (most, why, mend) = (ROPE_NODES.most, ROPE_NODES.why, ROPE_NODES.mend);
    Err(Beyond { message, help: format!("at most {most} are allowed, because {why}; {mend}") })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_quantity_has_its_greatest_amount() {
        for quantity in Quantity::ALL {
            assert_eq!(amount(quantity).quantity, quantity);
            assert!(!amount(quantity).holds(1e300) && !amount(quantity).holds(f64::NAN));
        }
    }

    #[test]
    fn a_refusal_names_field_value_limit_reason_and_what_to_do() {
        let beyond = STEP.check("step", 1e-12).expect_err("it is too short");
        assert_eq!(beyond.message, "`step` is 1e-12 s");
        for part in ["0.000001 s", "1 s", "because", "10 ms is usual"] {
            assert!(beyond.help.contains(part), "{part} in {}", beyond.help);
        }
    }
}
