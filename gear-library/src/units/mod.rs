//! Units: conversion between texts such as `"3/8 in"` and SI numbers.
//!
//! Other units than SI exist only here and in labels. A value is a number followed by its unit:
//! `3/8 in`, `1 1/2 in`, `1,700 lbf`, `40 fathom`, `4.5 lb/100ft`, `58 deg`, `75 %`.

mod table;

use std::fmt;

use strum::VariantArray;

use crate::diagnostic::nearest;

pub use table::Unit;

/// The physical quantity of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, VariantArray)]
pub enum Quantity {
    /// A pure number: a ratio or a coefficient; may be written in percent.
    Ratio,
    /// Length [m].
    Length,
    /// Area [m²].
    Area,
    /// Volume [m³].
    Volume,
    /// Mass [kg].
    Mass,
    /// Time [s].
    Time,
    /// Speed [m/s].
    Speed,
    /// Acceleration [m/s²].
    Acceleration,
    /// Force [N].
    Force,
    /// Force by length: a wet weight, a spring [N/m].
    ForceByLength,
    /// Pressure, or spring stiffness by length of rope [N/m²].
    Pressure,
    /// Mass by length of rope [kg/m].
    MassByLength,
    /// Mass by volume [kg/m³].
    Density,
    /// Axial damping of a rope [N s].
    Damping,
    /// Bending stiffness EI of a rope [N m²].
    BendingStiffness,
    /// Moment of inertia [kg m²].
    Inertia,
    /// Plane angle [rad].
    Angle,
    /// Rate of turn [rad/s].
    TurnRate,
    /// Frequency [Hz].
    Frequency,
}

/// Why a text is not a value of the expected quantity.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnitError {
    /// What is wrong.
    pub message: String,
    /// What was expected and how to fix it.
    pub help: String,
}

impl fmt::Display for UnitError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}; {}", self.message, self.help)
    }
}

impl std::error::Error for UnitError {}

impl Quantity {
    /// Every quantity.
    pub const ALL: &'static [Self] = Self::VARIANTS;

    /// Its name with an article, for messages: `a length`.
    pub fn noun(self) -> &'static str {
        self.words().0
    }

    /// Example values for messages: `3/8 in, 9.5 mm, 40 fathom`.
    pub fn examples(self) -> &'static str {
        self.words().1
    }

    /// Help on a value: `expected a length such as 3/8 in, 9.5 mm, …`.
    pub fn expected(self) -> String {
        format!("expected {} such as {}", self.noun(), self.examples())
    }

    /// Its SI unit: `m/s`; `1` for a pure number.
    pub fn si_unit(self) -> &'static str {
        self.units().first().map_or("1", |unit| unit.name())
    }

    /// The quantity of an SI unit in a plugin, such as `m/s`, `rad` or `1`.
    pub fn from_si_unit(unit: &str) -> Option<Self> {
        Self::ALL
            .iter()
            .copied()
            .find(|quantity| table::plain(quantity.si_unit()) == table::plain(unit))
    }

    /// Its units, the SI unit first; empty for a pure number.
    pub fn units(self) -> &'static [Unit] {
        table::units(self)
    }

    fn words(self) -> (&'static str, &'static str) {
        match self {
            Self::Ratio => ("a plain number", "0.3, 1.2 or 75 %"),
            Self::Length => ("a length", "3/8 in, 9.5 mm, 25 m or 40 fathom"),
            Self::Area => ("an area", "0.19 m2 or 2 ft2"),
            Self::Volume => ("a volume", "5 L or 0.005 m3"),
            Self::Mass => ("a mass", "18 kg or 40 lb"),
            Self::Time => ("a time", "60 s or 10 ms"),
            Self::Speed => ("a speed", "0.5 m/s or 1 kn"),
            Self::Acceleration => ("an acceleration", "9.81 m/s2"),
            Self::Force => ("a force", "1700 lbf, 49 kN or 50 N"),
            Self::ForceByLength => ("a force by length", "0.065 N/m or 20 kN/m"),
            Self::Pressure => ("a pressure or a stiffness by length", "400 kN/m2"),
            Self::MassByLength => ("a mass by length", "4.5 lb/100ft or 0.0417 kg/m"),
            Self::Density => ("a density", "1025 kg/m3 or 0.94 g/cm3"),
            Self::Damping => ("a damping", "2.5 N s"),
            Self::BendingStiffness => ("a bending stiffness", "0.004 N m2"),
            Self::Inertia => ("a moment of inertia", "1.2 kg m2"),
            Self::Angle => ("an angle", "58 deg or 1 rad"),
            Self::TurnRate => ("a rate of turn", "10 deg/s"),
            Self::Frequency => ("a frequency", "0.14 Hz"),
        }
    }
}

/// Writes an SI value in a unit of its quantity, such as `3/8 in` or `0.5 m/s`.
///
/// Whole sixteenths of an inch under three feet are written as fractions, as rope sizes are; other numbers as the
/// shortest decimal that agrees to ten digits.
pub fn format(value: f64, unit: &Unit) -> String {
    let number = value / unit.factor();
    let written = if unit.name() == "in" { inches(number) } else { None };
    format!("{} {}", written.unwrap_or_else(|| short(number)), unit.name())
}

/// Writes an SI value in the SI unit of its quantity.
pub fn format_si(value: f64, quantity: Quantity) -> String {
    quantity.units().first().map_or_else(|| short(value), |unit| format(value, unit))
}

/// The unit of a quantity by any of its names.
pub fn find(name: &str, quantity: Quantity) -> Option<&'static Unit> {
    table::find(name, quantity)
}

/// The shortest decimal that agrees to ten significant digits.
fn short(number: f64) -> String {
    let rounded: f64 = format!("{number:.9e}").parse().unwrap_or(number);
    if rounded != 0.0 && !(1e-6..1e12).contains(&rounded.abs()) {
        format!("{rounded:e}")
    } else {
        format!("{rounded}")
    }
}

/// Inches as a fraction, such as `3/8` or `1 1/2`; `None` if they are not whole sixteenths.
fn inches(number: f64) -> Option<String> {
    let sixteenths = (number * 16.0).round();
    if !(0.0..576.0).contains(&number)
        || (number * 16.0 - sixteenths).abs() > 1e-7
        || sixteenths % 16.0 == 0.0
    {
        return None;
    }
    let whole = (sixteenths / 16.0).floor();
    let (mut above, mut below) = (sixteenths - 16.0 * whole, 16.0);
    while above % 2.0 == 0.0 {
        (above, below) = (above / 2.0, below / 2.0);
    }
    Some(if whole > 0.0 { format!("{whole} {above}/{below}") } else { format!("{above}/{below}") })
}

/// Reads a value such as `3/8 in`, `1,700 lbf` or `0.5 m/s` into SI.
pub fn parse(text: &str, quantity: Quantity) -> Result<f64, UnitError> {
    let (number, unit) = split(text.trim());
    let value = read_number(number).ok_or_else(|| bad_number(text, number, quantity))?;
    let factor = read_unit(text, unit, quantity)?;
    Ok(value * factor)
}

/// Splits `1 1/2 in` into `1 1/2` and `in`.
fn split(text: &str) -> (&str, &str) {
    let mut end = 0;
    let bytes = text.as_bytes();
    while end < bytes.len() {
        let exponent = matches!(bytes[end], b'e' | b'E') && exponent_follows(bytes, end);
        let sign = matches!(bytes[end], b'+' | b'-')
            && (end == 0 || matches!(bytes[end - 1], b'e' | b'E'));
        let part = bytes[end].is_ascii_digit()
            || matches!(bytes[end], b'.' | b',' | b' ')
            || exponent
            || sign;
        let fraction =
            bytes[end] == b'/' && end > 0 && bytes.get(end + 1).is_some_and(u8::is_ascii_digit);
        if !part && !fraction {
            break;
        }
        end += 1;
    }
    (text[..end].trim(), text[end..].trim())
}

fn exponent_follows(bytes: &[u8], at: usize) -> bool {
    let after = bytes.get(at + 1).copied().unwrap_or(b' ');
    let digits = after.is_ascii_digit()
        || (matches!(after, b'+' | b'-') && bytes.get(at + 2).is_some_and(u8::is_ascii_digit));
    at > 0 && bytes[at - 1].is_ascii_digit() && digits
}

/// A decimal, a fraction, or a whole number with a fraction; thousands may have commas.
fn read_number(text: &str) -> Option<f64> {
    let mut parts = text.split_whitespace();
    let (first, second) = (parts.next()?, parts.next());
    if parts.next().is_some() {
        return None;
    }
    let value = match second {
        None => read_fraction(first).or_else(|| read_decimal(first))?,
        Some(fraction) => {
            let whole = read_decimal(first).filter(|_| !first.contains('.'))?;
            let part = read_fraction(fraction)?;
            if first.starts_with('-') { whole - part } else { whole + part }
        }
    };
    value.is_finite().then_some(value)
}

fn read_fraction(text: &str) -> Option<f64> {
    let (above, below) = text.split_once('/')?;
    let (above, below) = (read_decimal(above)?, read_decimal(below)?);
    (below > 0.0).then(|| above / below)
}

/// The common size nearest to an uncommon fraction of an inch, such as `5/17 in`; `None` for other texts.
pub(crate) fn odd_fraction(text: &str) -> Option<String> {
    let (number, unit) = split(text.trim());
    let unit = table::find(unit, Quantity::Length).filter(|unit| unit.name() == "in")?;
    let (_, below) = number.split_whitespace().last()?.split_once('/')?;
    if ["2", "4", "8", "16", "32", "64"].contains(&below) {
        return None;
    }
    let sixteenths = (read_number(number)? * 16.0).round().max(1.0);
    Some(format(sixteenths / 16.0 * unit.factor(), unit))
}

fn read_decimal(text: &str) -> Option<f64> {
    let well_grouped = text.split('.').next().is_some_and(|whole| {
        let mut groups = whole.split(',');
        let first = groups.next().unwrap_or_default();
        !whole.contains(',') || (!first.is_empty() && groups.all(|group| group.len() == 3))
    });
    let fraction_has_comma =
        text.split_once('.').is_some_and(|(_, fraction)| fraction.contains(','));
    if !well_grouped || fraction_has_comma {
        return None;
    }
    text.replace(',', "").parse().ok()
}

fn bad_number(text: &str, number: &str, quantity: Quantity) -> UnitError {
    let message = if number.is_empty() {
        format!("`{text}` has no number")
    } else {
        format!("`{number}` is not a number")
    };
    let comma = if number.contains(',') {
        "; write decimals with a point, commas only between thousands"
    } else {
        ""
    };
    UnitError { message, help: quantity.expected() + comma }
}

/// The factor of a unit.
fn read_unit(text: &str, unit: &str, quantity: Quantity) -> Result<f64, UnitError> {
    let expected = quantity.expected();
    if quantity == Quantity::Ratio {
        let message = format!("`{text}` has the unit `{unit}`, but this is a pure number");
        return match unit {
            "" => Ok(1.0),
            "%" => Ok(0.01),
            _ => Err(UnitError { message, help: expected }),
        };
    }
    if unit.is_empty() {
        return Err(UnitError { message: format!("`{text}` has no unit"), help: expected });
    }
    if let Some(found) = table::find(unit, quantity) {
        return Ok(found.factor());
    }
    let other = Quantity::ALL.iter().copied().find(|other| table::find(unit, *other).is_some());
    let message = match other {
        Some(other) => {
            format!("`{unit}` is a unit of {}, not of {}", other.noun(), quantity.noun())
        }
        None => format!("unknown unit `{unit}`"),
    };
    let names = quantity.units().iter().flat_map(Unit::names).copied();
    let known: Vec<&str> = quantity.units().iter().map(Unit::name).collect();
    let meant = match other {
        None => nearest(unit, names),
        // Forces in pounds are often written without the `f`.
        Some(Quantity::Mass) if quantity == Quantity::Force && unit.starts_with("lb") => {
            Some("lbf")
        }
        Some(_) => None,
    };
    let number = text.trim().trim_end_matches(unit).trim();
    let hint = meant.map_or_else(
        || format!("; known units are {}", known.join(", ")),
        |name| format!("; did you mean `{number} {name}`?"),
    );
    Err(UnitError { message, help: expected + &hint })
}
