//! A comparison of a case: a measure of the readings, its expected value and tolerance.

use crate::diagnostic::At;
use crate::fields::{Fields, Range};
use crate::tree::{Content, Node};
use crate::units::Quantity;

use super::{reading, words};

/// A comparison.
#[derive(Clone, Debug, PartialEq)]
pub struct Check {
    /// Name shown to the user.
    pub name: String,
    /// Its measure.
    pub measure: Measure,
    /// Its tolerance.
    pub limit: Limit,
}

/// A measure of the readings.
#[derive(Clone, Debug, PartialEq)]
pub enum Measure {
    /// RMS distance from the points of the table over points and times [m]; a point is a list of probes.
    Distance(Vec<Vec<At<String>>>),
    /// RMS of the difference of probes from the table, over the RMS of the table.
    Series(Vec<At<String>>),
    /// Greatest sample of a probe and of the table.
    Peak(At<String>),
    /// Last reading of a probe and an expected value.
    Value(At<String>, f64),
    /// Mean of a probe from a time [s] on, over a unit of its own and an expected value.
    Mean {
        /// The probe.
        of: At<String>,
        /// From this time on [s].
        from_s: f64,
        /// Divisor of the mean.
        over: f64,
        /// Expected value.
        expected: f64,
    },
    /// Mean of a probe over that of another, both from a time [s] on and an expected value.
    Ratio {
        /// The probe.
        of: At<String>,
        /// The probe whose mean is the divisor.
        over: At<String>,
        /// From this time on [s].
        from_s: f64,
        /// Expected value.
        expected: f64,
    },
    /// Greatest sample of a probe and an expected value.
    Greatest(At<String>, f64),
    /// Time of the first sample of a probe above zero, and an expected value [s].
    First(At<String>, f64),
    /// Mean rate at which a probe's reading changes from a time on, and an expected value [unit/s].
    Rate {
        /// The probe.
        of: At<String>,
        /// From this time on [s].
        from_s: f64,
        /// Expected value.
        expected: f64,
    },
    /// Greatest reading of a probe above its first, over the greatest of another; expected 0.
    Gain(At<String>, At<String>),
    /// Last reading of a probe below its first, over the greatest of another; expected 0.
    Loss(At<String>, At<String>),
    /// Rows: sums of readings and measurements, with a verdict per group.
    Sums,
    /// Rows: least-squares slope of the groups' mean reading over a column, and an expected value.
    Slope(At<String>, f64),
    /// Rows: relative decrease of readings over the square of a column from one group to another, and that of the
    /// measurements.
    Fall {
        /// First group.
        from: String,
        /// Second group.
        to: String,
        /// Column whose square is the divisor.
        square: At<String>,
    },
}

/// The tolerance of a comparison.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Limit {
    /// The difference is at most this share of what is expected.
    Share(f64),
    /// The difference is at most this [SI].
    Absolute(f64),
    /// The result is between the two.
    Between(f64, f64),
}

/// Reads `[[check]]`; `None` if a field is missing or wrong, which is reported.
pub(super) fn read(fields: &Fields<'_>) -> Option<Check> {
    let name = fields.need_text("name", "write the compared quantity, such as \"anchor tension\"");
    let measure = measure(fields);
    let limit = limit(fields);
    if measure.is_none() {
        // The fields of an unknown measure are not known; the measure is reported.
        fields.rest();
    }
    Some(Check { name: name?.value, measure: measure?, limit: limit? })
}

const MEASURES: [&str; 14] = [
    "distance", "series", "peak", "value", "mean", "ratio", "greatest", "first", "rate", "gain",
    "loss", "sums", "slope", "fall",
];

fn measure(fields: &Fields<'_>) -> Option<Measure> {
    let known = MEASURES.join(", ");
    fields.need_text("measure", &format!("write one of {known}"))?;
    let measure = fields.word("measure", &MEASURES)?;
    match measure.value.as_str() {
        "distance" => points(fields).map(Measure::Distance),
        "series" => some(fields, words(fields, "of", &[])).map(Measure::Series),
        "peak" => probe(fields, "of").map(Measure::Peak),
        "value" => Some(Measure::Value(probe(fields, "of")?, expected(fields)?)),
        "mean" => mean(fields),
        "ratio" => Some(Measure::Ratio {
            of: probe(fields, "of")?,
            over: probe(fields, "over")?,
            from_s: fields.need_value("from", Quantity::Time, Range::NotNegative)?.value,
            expected: expected(fields)?,
        }),
        "greatest" => Some(Measure::Greatest(probe(fields, "of")?, expected(fields)?)),
        "first" => Some(Measure::First(
            probe(fields, "of")?,
            fields.need_value("expected", Quantity::Time, Range::NotNegative)?.value,
        )),
        "rate" => {
            let from = fields.need_value("from", Quantity::Time, Range::NotNegative);
            Some(Measure::Rate {
                of: probe(fields, "of")?,
                from_s: from?.value,
                expected: expected(fields)?,
            })
        }
        "gain" => Some(Measure::Gain(probe(fields, "of")?, probe(fields, "over")?)),
        "loss" => Some(Measure::Loss(probe(fields, "of")?, probe(fields, "over")?)),
        "sums" => Some(Measure::Sums),
        "slope" => Some(Measure::Slope(probe(fields, "over")?, expected(fields)?)),
        _ => Some(Measure::Fall {
            from: probe(fields, "from")?.value,
            to: probe(fields, "to")?.value,
            square: probe(fields, "square")?,
        }),
    }
}

fn mean(fields: &Fields<'_>) -> Option<Measure> {
    let from = fields.need_value("from", Quantity::Time, Range::NotNegative);
    let over = fields.get("over").map_or(Some(1.0), |node| reading(node, fields.problems()));
    Some(Measure::Mean {
        of: probe(fields, "of")?,
        from_s: from?.value,
        over: over?,
        expected: expected(fields)?,
    })
}

fn probe(fields: &Fields<'_>, key: &'static str) -> Option<At<String>> {
    fields.need_text(key, "write the id of a probe, or the name of a column or group")
}

fn expected(fields: &Fields<'_>) -> Option<f64> {
    match fields.get("expected") {
        Some(node) => reading(node, fields.problems()),
        None => {
            fields.missing(
                "expected",
                "write the expected value, such as \"23.9 N\", \"1.5 m\" or 2.57",
            );
            None
        }
    }
}

/// Points as lists of probes: `[["end x", "end z"], ["middle x", "middle z"]]`.
fn points(fields: &Fields<'_>) -> Option<Vec<Vec<At<String>>>> {
    let help = "expected points as lists of probes: [[\"end x\", \"end z\"], [\"middle x\", \"middle z\"]]";
    let Some(node) = fields.get("of") else {
        fields.missing("of", help);
        return None;
    };
    let text = |item: &Node| match &item.content {
        Content::Text(text) => Some(At { value: text.clone(), place: item.place.clone() }),
        _ => None,
    };
    let point = |item: &Node| match &item.content {
        Content::List(items) => items.iter().map(text).collect::<Option<Vec<_>>>(),
        _ => None,
    };
    let read = match &node.content {
        Content::List(items) => items.iter().map(point).collect::<Option<Vec<_>>>(),
        _ => None,
    };
    if read.is_none() {
        fields.problems().push(node.place.error("these are not points", help));
    }
    read
}

fn some(fields: &Fields<'_>, probes: Vec<At<String>>) -> Option<Vec<At<String>>> {
    if probes.is_empty() {
        fields.missing("of", "write the ids of probes, such as [\"pin tension\"]");
        return None;
    }
    Some(probes)
}

/// `tolerance`, a share or with a unit, or `between`.
fn limit(fields: &Fields<'_>) -> Option<Limit> {
    let problems = fields.problems();
    match (fields.get("tolerance"), fields.get("between")) {
        (Some(node), None) => {
            let value = reading(node, problems)?;
            Some(if matches!(node.content, Content::Number(_)) {
                Limit::Share(value)
            } else {
                Limit::Absolute(value)
            })
        }
        (None, Some(node)) => match &node.content {
            Content::List(ends) if ends.len() == 2 => {
                Some(Limit::Between(reading(&ends[0], problems)?, reading(&ends[1], problems)?))
            }
            _ => problems.refuse(node.place.error(
                "`between` does not have two values",
                "write [least, most], such as [0.35, 0.6]",
            )),
        },
        _ => {
            fields.missing("tolerance", "write tolerance = 0.002 (a share) or \"1 cm\", or between = [least, most]; one of them");
            None
        }
    }
}
