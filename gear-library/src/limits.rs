//! Limits of numbers, counts, sizes and times in files and options, each with its reason.
//!
//! A limit is far above the values of gear, whales and seas, and within the capacity of the program. It rejects typing errors
//! and hostile files with a message before they use all memory or time.

use crate::units::{Quantity, format_si};

/// A least and a greatest value with the reason.
#[derive(Debug, PartialEq)]
pub struct Limit {
    /// Physical quantity.
    pub quantity: Quantity,
    /// Least allowed value [SI].
    pub least: f64,
    /// Greatest allowed value [SI].
    pub most: f64,
    /// Reason: completes the sentence "the limit exists because".
    pub why: &'static str,
    /// Correction; may be empty.
    pub correction: &'static str,
}

/// A message on a value beyond its limit.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Beyond {
    /// What is wrong, with field and value.
    pub message: String,
    /// The limit, its reason and the correction.
    pub help: String,
}

/// Step between inputs, and of the solver.
pub const STEP: Limit = Limit {
    quantity: Quantity::Time,
    least: 1e-6,
    most: 1.0,
    why: "a shorter step needs more than a million steps per second, and a longer one cannot resolve the motion of rope",
    correction: "write a step from 1 ms to 20 ms; 10 ms is usual",
};
/// Length of a run.
pub const DURATION: Limit = Limit {
    quantity: Quantity::Time,
    least: 1e-6,
    most: 1e6,
    why: "inputs and hashes of all steps are stored",
    correction: "write minutes, such as \"10 min\"",
};
/// Length of a segment of rope.
pub const SEGMENT: Limit = Limit {
    quantity: Quantity::Length,
    least: 1e-3,
    most: 1000.0,
    why: "a segment shorter than the rope's diameter is not a rope",
    correction: "write a length such as \"0.5 m\"",
};
/// Radius of a ball, or an edge of a box, among the bodies of a scenario.
pub const BODY_SIZE: Limit = Limit {
    quantity: Quantity::Length,
    least: 1e-3,
    most: 20.0,
    why: "the contact of a body as large as a whale includes all triangles of its skin at once",
    correction: "write the size of a trap, buoy or anchor, such as \"0.3 m\"; a fixed solid is an `[[obstacle]]`",
};
/// Nodes of all ropes together.
pub const ROPE_NODES: Limit = Limit {
    quantity: Quantity::Ratio,
    least: 2.0,
    most: 100_000.0,
    why: "a node needs about 4 kB of memory, and a step visits each node",
    correction: "write a smaller `rope_nodes`, a longer `segment`, or a shorter line",
};
/// Parts of gear in a scenario: bodies, joints, lines and links together.
pub const PARTS: Limit = count_of(1.0, 10_000.0, "each part is found by name and drawn", "");
/// Gears of a field.
pub const FIELD: Limit = count_of(
    1.0,
    1_000.0,
    "the parts of all gears are assembled and brought to rest one after the other",
    "write a smaller field, such as 10 columns in 10 rows",
);
/// Length of a track of a whale through gear, and of its legs.
pub const TRACK: Limit = Limit {
    quantity: Quantity::Length,
    least: 1.0,
    most: 1e6,
    why: "a track is followed until it meets gear",
    correction: "write a length such as \"200 m\" or \"10 km\"",
};
/// Least distance, and displacement, of gears of a field.
pub const FIELD_LENGTH: Limit = Limit {
    quantity: Quantity::Length,
    least: 0.0,
    most: 1e5,
    why: "a field is a fishing ground, not a sea",
    correction: "write a length such as \"20 m\"",
};
/// Seed of random draws.
pub const SEED: Limit = count_of(
    0.0,
    9e15,
    "a greater whole number has no exact value in a file",
    "write any smaller whole number",
);
/// Number of the format of a file.
pub const FORMAT: Limit = count_of(1.0, 1e6, "formats are numbered from 1", "");
/// Traps hauled aboard or trawled.
pub const TRAPS: Limit = count_of(1.0, 10_000.0, "no fishery sets more in a row", "");
/// Components of a sea of irregular waves.
pub const WAVE_COMPONENTS: Limit = count_of(
    1.0,
    endline_sim::water::check::MOST_COMPONENTS as f64,
    "each component is summed at each node of rope in each step",
    "64 is usual",
);
/// Encounters of a study.
pub const ENCOUNTERS: Limit = count_of(
    1.0,
    65_536.0,
    "their sequence has no more points",
    "1,000 give a rate within a few percent",
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
/// Number of stored problems of a file; the others are counted.
pub const DIAGNOSTICS: usize = 200;
/// Shown characters of a line.
pub const EXCERPT_CHARS: usize = 160;
/// Corners of all instances of a mesh.
pub const MESH_CORNERS: usize = 2_000_000;

/// Memory of a node of rope in state, workspace and contact [bytes]; measured with `hello-endline`: 2.6 kB.
const NODE_BYTES: f64 = 4e3;

const fn count_of(least: f64, most: f64, why: &'static str, correction: &'static str) -> Limit {
    Limit { quantity: Quantity::Ratio, least, most, why, correction }
}

const fn up_to(quantity: Quantity, most: f64, why: &'static str) -> Limit {
    Limit { quantity, least: -most, most, why, correction: "" }
}

/// Greatest magnitude of each quantity: a greater figure is a typing error.
static AMOUNTS: [Limit; 19] = [
    up_to(Quantity::Ratio, 1e15, "no ratio, count or coefficient is greater"),
    up_to(Quantity::Length, 1e6, "the sea is flat, and no distance is a thousand kilometres"),
    up_to(Quantity::Area, 1e6, "nothing in a model is larger"),
    up_to(Quantity::Volume, 1e6, "nothing in a model is larger"),
    up_to(Quantity::Mass, 1e9, "nothing in a model is heavier"),
    up_to(Quantity::Time, 1e10, "this is more than three centuries"),
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
    up_to(Quantity::Angle, 1e5, "rounding makes greater angles inexact"),
    up_to(Quantity::TurnRate, 1e4, "nothing in water turns faster"),
    up_to(Quantity::Frequency, 1e5, "no step resolves it"),
];

/// The limit of a quantity.
pub fn amount(quantity: Quantity) -> &'static Limit {
    let found = AMOUNTS.iter().find(|limit| limit.quantity == quantity);
    found.unwrap_or(&AMOUNTS[0])
}

impl Limit {
    /// Whether it allows a value [SI].
    pub fn holds(&self, value: f64) -> bool {
        (self.least..=self.most).contains(&value)
    }

    /// Checks a value [SI].
    pub fn check(&self, field: &str, value: f64) -> Result<(), Beyond> {
        if self.holds(value) {
            return Ok(());
        }
        let message = format!("`{field}` is {}", format_si(value, self.quantity));
        Err(Beyond { message, help: self.words() })
    }

    /// The limit, its reason and the correction.
    pub fn words(&self) -> String {
        let Self { least, most, why, correction, .. } = self;
        let [least, most] = [least, most].map(|value| format_si(*value, self.quantity));
        let correction =
            if correction.is_empty() { String::new() } else { format!("; {correction}") };
        format!("it must be between {least} and {most}, because {why}{correction}")
    }
}

/// Checks the number of rope nodes before memory is allocated.
pub fn check_nodes(nodes: f64) -> Result<(), Beyond> {
    if nodes <= ROPE_NODES.most {
        return Ok(());
    }
    let gigabytes = nodes * NODE_BYTES / 1e9;
    let message = format!("the ropes have {nodes:.0} nodes, which need about {gigabytes:.1} GB");
    let (most, why, correction) = (ROPE_NODES.most, ROPE_NODES.why, ROPE_NODES.correction);
    Err(Beyond {
        message,
        help: format!("at most {most} are allowed, because {why}; {correction}"),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_quantity_has_a_limit() {
        for quantity in Quantity::ALL.iter().copied() {
            assert_eq!(amount(quantity).quantity, quantity);
            assert!(!amount(quantity).holds(1e300) && !amount(quantity).holds(f64::NAN));
        }
    }

    #[test]
    fn a_message_names_field_value_limit_reason_and_correction() {
        let beyond = STEP.check("step", 1e-12).expect_err("it is too short");
        assert_eq!(beyond.message, "`step` is 1e-12 s");
        for part in ["0.000001 s", "1 s", "because", "10 ms is usual"] {
            assert!(beyond.help.contains(part), "{part} in {}", beyond.help);
        }
    }
}
