//! The value of a figure.

use std::collections::BTreeMap;

use endline_sim::DVec3;
use serde::{Serialize, Serializer};

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
    /// Figures of several things that belong to the source.
    List(Vec<Value>),
}

impl Value {
    /// As a number, where it is a finite one.
    #[must_use]
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
