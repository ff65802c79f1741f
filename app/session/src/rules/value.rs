//! Values of expressions: numbers that know their unit, lines, places along a line, truth, and what is not known.

use endline_gear::units::{self, Quantity, Unit};

use super::makeup::{MadeUp, Places};

/// What a value is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// True or false.
    Truth,
    /// A number.
    Number(Quantity),
    /// An endline, piece by piece.
    Line,
    /// Places along an endline.
    Places,
}

/// A value of an expression.
#[derive(Clone, Debug)]
pub enum Value {
    /// A number [SI], with the unit in which it is told.
    Number {
        /// SI value.
        si: f64,
        /// What it measures.
        quantity: Quantity,
        /// The unit of the rule that named it.
        unit: Option<&'static Unit>,
        /// Id of the line, piece or link that it was measured on, where it is one of several.
        of: Option<String>,
    },
    /// True or false, with the comparisons that decided it.
    Truth {
        /// Whether it holds.
        holds: bool,
        /// What was compared.
        compared: Vec<Compared>,
    },
    /// An endline.
    Line(MadeUp),
    /// Places along an endline.
    Places(Places),
    /// A value of this kind that nobody knows, and why.
    Unknown {
        /// What it would be.
        kind: Kind,
        /// Why it is not known.
        why: String,
    },
    /// No value: the expression makes no sense, for this reason.
    Wrong(String),
}

/// Two numbers that were compared.
#[derive(Clone, Debug)]
pub struct Compared {
    /// Left of the sign, what was measured [SI].
    pub left: f64,
    /// The sign.
    pub sign: &'static str,
    /// Right of the sign, the limit [SI].
    pub right: f64,
    /// What both measure.
    pub quantity: Quantity,
    /// The unit in which both are told; SI where there is none.
    pub unit: Option<&'static Unit>,
    /// Id of the piece that was measured, where it is one of several.
    pub of: Option<String>,
    /// Whether it holds.
    pub holds: bool,
}

impl Kind {
    /// In words, with an article.
    #[must_use]
    pub fn noun(self) -> &'static str {
        match self {
            Self::Truth => "true or false",
            Self::Number(quantity) => quantity.noun(),
            Self::Line => "an endline",
            Self::Places => "places along an endline",
        }
    }
}

impl Value {
    /// A pure number.
    #[must_use]
    pub fn count(number: f64) -> Self {
        Self::measure(number, Quantity::Ratio)
    }

    /// A number of a quantity [SI].
    #[must_use]
    pub fn measure(si: f64, quantity: Quantity) -> Self {
        Self::Number { si, quantity, unit: None, of: None }
    }

    /// A number [SI] measured on one piece.
    #[must_use]
    pub fn measure_of(piece: &str, si: f64, quantity: Quantity) -> Self {
        Self::Number { si, quantity, unit: None, of: Some(piece.to_owned()) }
    }

    /// True or false by itself.
    #[must_use]
    pub fn truth(holds: bool) -> Self {
        Self::Truth { holds, compared: Vec::new() }
    }

    /// What it is; none where it makes no sense.
    #[must_use]
    pub fn kind(&self) -> Option<Kind> {
        match self {
            Self::Number { quantity, .. } => Some(Kind::Number(*quantity)),
            Self::Truth { .. } => Some(Kind::Truth),
            Self::Line(_) => Some(Kind::Line),
            Self::Places(_) => Some(Kind::Places),
            Self::Unknown { kind, .. } => Some(*kind),
            Self::Wrong(_) => None,
        }
    }

    /// In words, for messages.
    pub(super) fn noun(&self) -> &'static str {
        self.kind().map_or("nothing", Kind::noun)
    }
}

/// Numbers in an expression are pure.
impl std::str::FromStr for Value {
    type Err = std::num::ParseFloatError;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        text.parse().map(Self::count)
    }
}

impl Default for Value {
    fn default() -> Self {
        Self::Wrong("no value".to_owned())
    }
}

impl Compared {
    /// A number of the comparison in its unit, such as `60 ft`; `none` for one that is infinite.
    #[must_use]
    pub fn told(&self, si: f64) -> String {
        if !si.is_finite() {
            return "none".to_owned();
        }
        let unit = self.unit.or_else(|| self.quantity.units().first());
        let factor = unit.map_or(1.0, Unit::factor);
        // The sum of nothing is minus zero.
        let number = if si == 0.0 { 0.0 } else { si / factor };
        let size = if number == 0.0 { 0.0 } else { number.abs().log10().floor() };
        let digits = (3.0 - size).clamp(0.0, 4.0);
        let scale = 10f64.powf(digits);
        let rounded = (number * scale).round() / scale * factor;
        match unit {
            Some(unit) => units::format(rounded, unit),
            None => format!("{}", (number * scale).round() / scale),
        }
    }
}

impl std::fmt::Display for Compared {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} {} {}", self.told(self.left), self.sign, self.told(self.right))
    }
}
