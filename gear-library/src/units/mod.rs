//! Units: text such as `"3/8 in"` in, SI numbers out, and back.
//!
//! This is the one place where a unit other than SI exists, besides labels. A value is a number
//! followed by its unit: `3/8 in`, `1 1/2 in`, `1,700 lbf`, `40 fathom`, `4.5 lb/100ft`, `58 deg`, `75 %`.

mod parse;
mod table;

use std::fmt;

pub(crate) use parse::odd_fraction;
pub use parse::parse;
pub use table::Unit;

/// What a number measures.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
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

/// Why a text is not a value of the wanted quantity.
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
    pub const ALL: [Self; 19] = [
        Self::Ratio,
        Self::Length,
        Self::Area,
        Self::Volume,
        Self::Mass,
        Self::Time,
        Self::Speed,
        Self::Acceleration,
        Self::Force,
        Self::ForceByLength,
        Self::Pressure,
        Self::MassByLength,
        Self::Density,
        Self::Damping,
        Self::BendingStiffness,
        Self::Inertia,
        Self::Angle,
        Self::TurnRate,
        Self::Frequency,
    ];

    /// Its name with an article, for messages: `a length`.
    #[must_use]
    pub fn noun(self) -> &'static str {
        self.words().0
    }

    /// Values a user may copy, for messages: `3/8 in, 9.5 mm, 40 fathom`.
    #[must_use]
    pub fn examples(self) -> &'static str {
        self.words().1
    }

    /// Its SI unit: `m/s`; `1` for a pure number.
    #[must_use]
    pub fn si_unit(self) -> &'static str {
        self.units().first().map_or("1", |unit| unit.name())
    }

    /// The quantity a plugin means by an SI unit such as `m/s`, `rad` or `1`.
    #[must_use]
    pub fn from_si_unit(unit: &str) -> Option<Self> {
        Self::ALL
            .into_iter()
            .find(|quantity| table::plain(quantity.si_unit()) == table::plain(unit))
    }

    /// The units it may be written in, the SI unit first; none for a pure number.
    #[must_use]
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
/// Inches under three feet that are whole sixteenths come out as a fraction, as rope sizes are
/// written. The shortest decimal that reads back to nine digits is used.
#[must_use]
pub fn format(value: f64, unit: &Unit) -> String {
    let number = value / unit.factor();
    let written = if unit.name() == "in" { inches(number) } else { None };
    format!("{} {}", written.unwrap_or_else(|| short(number)), unit.name())
}

/// Writes an SI value in the SI unit of its quantity.
#[must_use]
pub fn format_si(value: f64, quantity: Quantity) -> String {
    quantity.units().first().map_or_else(|| short(value), |unit| format(value, unit))
}

/// The unit of a quantity by any of its names.
#[must_use]
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

/// Inches as a rope maker writes them: `3/8`, `1 1/2`; `None` where not whole sixteenths.
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
