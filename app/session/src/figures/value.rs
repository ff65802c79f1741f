//! The value of a figure and its quantity, which decides unit and format.

use std::collections::BTreeMap;

use endline_sim::DVec3;
use serde::{Serialize, Serializer};

use crate::units::{ForceUnit, Units, rounded};

/// A value in SI units.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// There is none, such as the time at which a line that holds has parted.
    Absent,
    /// A number.
    Number(f64),
    /// A count.
    Whole(u64),
    /// Yes or no.
    Flag(bool),
    /// A text.
    Text(String),
    /// Several texts.
    Texts(Vec<String>),
    /// A vector: east, north, up.
    Vector([f64; 3]),
    /// Counts by name.
    Counts(BTreeMap<&'static str, u64>),
    /// A number in a unit of its own.
    Measured {
        /// The number.
        value: f64,
        /// Its unit.
        unit: &'static str,
    },
    /// Figures of something that belongs to the source.
    Group(Vec<(&'static str, Value)>),
    /// Figures of several parts of the source.
    List(Vec<Value>),
}

impl Value {
    /// As a number, where it is a finite one.
    pub fn number(&self) -> Option<f64> {
        let number = match self {
            Self::Number(number) | Self::Measured { value: number, .. } => *number,
            Self::Whole(count) => *count as f64,
            _ => return None,
        };
        number.is_finite().then_some(number)
    }
}

impl<T: Into<Self>> From<Option<T>> for Value {
    fn from(value: Option<T>) -> Self {
        value.map_or(Self::Absent, Into::into)
    }
}

impl From<f64> for Value {
    fn from(number: f64) -> Self {
        Self::Number(number)
    }
}

impl From<u64> for Value {
    fn from(count: u64) -> Self {
        Self::Whole(count)
    }
}

impl From<u32> for Value {
    fn from(count: u32) -> Self {
        Self::Whole(count.into())
    }
}

impl From<usize> for Value {
    fn from(count: usize) -> Self {
        Self::Whole(count as u64)
    }
}

impl From<bool> for Value {
    fn from(flag: bool) -> Self {
        Self::Flag(flag)
    }
}

impl From<&str> for Value {
    fn from(text: &str) -> Self {
        Self::Text(text.to_owned())
    }
}

impl From<&String> for Value {
    fn from(text: &String) -> Self {
        Self::Text(text.clone())
    }
}

impl From<Vec<String>> for Value {
    fn from(texts: Vec<String>) -> Self {
        Self::Texts(texts)
    }
}

impl From<&Vec<String>> for Value {
    fn from(texts: &Vec<String>) -> Self {
        Self::Texts(texts.clone())
    }
}

impl From<DVec3> for Value {
    fn from(vector: DVec3) -> Self {
        Self::Vector(vector.to_array())
    }
}

impl Serialize for Value {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Absent => serializer.serialize_none(),
            Self::Number(number) | Self::Measured { value: number, .. } => {
                serializer.serialize_f64(*number)
            }
            Self::Whole(count) => serializer.serialize_u64(*count),
            Self::Flag(flag) => serializer.serialize_bool(*flag),
            Self::Text(text) => serializer.serialize_str(text),
            Self::Texts(texts) => texts.serialize(serializer),
            Self::Vector(vector) => vector.serialize(serializer),
            Self::Counts(counts) => counts.serialize(serializer),
            Self::Group(figures) => {
                serializer.collect_map(figures.iter().map(|(key, value)| (key, value)))
            }
            Self::List(values) => values.serialize(serializer),
        }
    }
}

/// Kind of a quantity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// A force [N].
    Force,
    /// A force as a vector: east, north, up [N].
    ForceVector,
    /// A length [m].
    Length,
    /// A length of millimetres [m].
    SmallLength,
    /// A depth of water [m].
    Depth,
    /// A place: east, north, up [m].
    Place,
    /// A moment of the run [s].
    Moment,
    /// A time from one moment to another [s].
    Duration,
    /// A step of time [s].
    Step,
    /// A speed [m/s].
    Speed,
    /// A power [W].
    Power,
    /// Turns of rope [turns].
    Turns,
    /// A pressure [Pa].
    Pressure,
    /// A force by length of rope [N/m].
    LineLoad,
    /// A work [J].
    Work,
    /// A frequency [Hz].
    Frequency,
    /// An impulse, or one as a vector: east, north, up [N s].
    Impulse,
    /// A share, written in percent.
    Share,
    /// A number without a unit.
    Number,
    /// A number in a unit that its source declares.
    Measured,
    /// A whole number.
    Count,
    /// Yes or no.
    Flag,
    /// A name of the program, such as a part of the whale or an outcome, its words joined by `_`.
    Name,
    /// A text that is written unchanged, such as an id.
    Id,
    /// Several of those.
    Ids,
    /// Figures of a part of the source.
    Group,
}

impl Quantity {
    /// Its unit in JSON and in the tables of a study, or the kind of value.
    pub fn unit(self) -> &'static str {
        match self {
            Self::Force | Self::ForceVector => "N",
            Self::Length | Self::SmallLength | Self::Depth | Self::Place => "m",
            Self::Moment | Self::Duration | Self::Step => "s",
            Self::Speed => "m/s",
            Self::Power => "W",
            Self::Turns => "turns",
            Self::Pressure => "Pa",
            Self::LineLoad => "N/m",
            Self::Work => "J",
            Self::Frequency => "Hz",
            Self::Impulse => "N s",
            Self::Number | Self::Share => "1",
            Self::Measured => "its own unit",
            Self::Count => "count",
            Self::Flag => "yes or no",
            Self::Name => "name",
            Self::Id => "text",
            Self::Ids => "texts",
            Self::Group => "object",
        }
    }

    /// A value of this kind for people, in their units; a dash where there is none.
    pub fn text(self, value: &Value, units: Units) -> String {
        match value {
            Value::Absent => "–".to_owned(),
            Value::Number(number) if !number.is_finite() => "–".to_owned(),
            Value::Number(number) => self.number(*number, units),
            Value::Whole(count) => count.to_string(),
            Value::Flag(flag) => if *flag { "yes" } else { "no" }.to_owned(),
            Value::Text(text) if self == Self::Name => text.replace('_', " "),
            Value::Text(text) => text.clone(),
            Value::Texts(texts) if texts.is_empty() => "none".to_owned(),
            Value::Texts(texts) => texts.join(", "),
            Value::Vector(vector) => vector.map(|along| self.number(along, units)).join(", "),
            Value::Counts(counts) => {
                let written = counts.iter().map(|(name, count)| format!("{name} {count}"));
                written.collect::<Vec<_>>().join(", ")
            }
            Value::Measured { value, unit: "N" } => units.force().text(*value),
            Value::Measured { value, unit } => format!("{} {unit}", rounded(*value, 2)),
            Value::Group(_) | Value::List(_) => String::new(),
        }
    }

    fn number(self, value: f64, units: Units) -> String {
        match self {
            Self::Force | Self::ForceVector => units.force().text(value),
            Self::Length | Self::Place => units.length(value),
            Self::SmallLength => format!("{} mm", rounded(1e3 * value, 2)),
            Self::Depth => units.depth(value),
            Self::Moment | Self::Duration => format!("{} s", rounded(value, 2)),
            Self::Step => format!("{value} s"),
            Self::Speed => units.speed(value),
            Self::Power => format!("{} W", rounded(value, 0)),
            Self::Pressure => units.force().pressure(value),
            Self::LineLoad => line_load(value, units.force()),
            Self::Work => format!("{} J", rounded(value, tenths(value))),
            Self::Impulse => format!("{} N s", rounded(value, tenths(value))),
            Self::Share => format!("{} %", rounded(100.0 * value, 4)),
            Self::Frequency => format!("{} Hz", rounded(value, 3)),
            _ => rounded(value, 2),
        }
    }
}

/// Decimals of a number shown with about three figures: one below a hundred.
fn tenths(value: f64) -> usize {
    usize::from(value.abs() < 100.0)
}

/// A force by length with its unit.
fn line_load(n_per_m: f64, force: ForceUnit) -> String {
    /// Newtons by metre in a pound-force by foot.
    const N_M_PER_LBF_FT: f64 = 14.593_903;
    match force {
        ForceUnit::Lbf => format!("{} lbf/ft", rounded(n_per_m / N_M_PER_LBF_FT, 1)),
        ForceUnit::Newton => format!("{} N/m", rounded(n_per_m, 0)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_rounds_to_nothing_has_no_sign() {
        let text = |quantity: Quantity, value| quantity.text(&Value::Number(value), Units::Si);
        assert_eq!(text(Quantity::Turns, -0.001), "0.00");
        assert_eq!(text(Quantity::Turns, -0.5), "-0.50");
        assert_eq!(text(Quantity::Work, -0.01), "0.0 J");
        assert_eq!(text(Quantity::Moment, -1e-9), "0.00 s");
    }
}
