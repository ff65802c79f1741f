//! Values of expressions: numbers with a unit, endlines and their weak places, truth, and unknown values.

use endline_gear::units::{self, Quantity, Unit};

use crate::units::grouped;

/// The kind of a value.
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
    /// A number [SI], with the unit in which it is shown.
    Number {
        /// SI value.
        si: f64,
        /// The quantity.
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
        /// The comparisons.
        compared: Vec<Compared>,
    },
    /// An endline.
    Line(MadeUp),
    /// Places along an endline.
    Places(Places),
    /// An unknown value of this kind, and why it is unknown.
    Unknown {
        /// Its kind.
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
    /// Left of the sign, the measured value [SI].
    pub left: f64,
    /// The sign.
    pub sign: &'static str,
    /// Right of the sign, the limit [SI].
    pub right: f64,
    /// The quantity of both.
    pub quantity: Quantity,
    /// The unit in which both are shown; SI where there is none.
    pub unit: Option<&'static Unit>,
    /// Id of the piece that was measured, where it is one of several.
    pub of: Option<String>,
    /// Whether it holds.
    pub holds: bool,
}

impl Kind {
    /// In words, with an article.
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
    pub fn count(number: f64) -> Self {
        Self::measure(number, Quantity::Ratio)
    }

    /// A number of a quantity [SI].
    pub fn measure(si: f64, quantity: Quantity) -> Self {
        Self::Number { si, quantity, unit: None, of: None }
    }

    /// A number [SI] measured on one piece.
    pub fn measure_of(piece: &str, si: f64, quantity: Quantity) -> Self {
        Self::Number { si, quantity, unit: None, of: Some(piece.to_owned()) }
    }

    /// True or false by itself.
    pub fn truth(holds: bool) -> Self {
        Self::Truth { holds, compared: Vec::new() }
    }

    /// Its kind; none where it makes no sense.
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
    /// A number of the comparison in its unit, such as `60 ft` or `1,700 lbf`, without a unit for a specific gravity; `none` for one that is infinite.
    pub fn text(&self, si: f64) -> String {
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
        grouped(&match unit {
            Some(unit) if unit.name() != SPECIFIC_GRAVITY => units::format(rounded, unit),
            _ => format!("{}", (number * scale).round() / scale),
        })
    }

    /// What the comparison asks, such as `at most 1,700 lbf allowed`.
    fn asks(&self) -> String {
        let limit = self.text(self.right);
        match self.sign {
            "<=" => format!("at most {limit} allowed"),
            ">=" => format!("at least {limit} required"),
            "<" => format!("less than {limit} required"),
            ">" => format!("more than {limit} required"),
            "==" if self.right == 0.0 => "none allowed".to_owned(),
            "==" => format!("{limit} required"),
            _ => format!("{limit} not allowed"),
        }
    }
}

/// Unit of specific gravity, which is written before the number.
const SPECIFIC_GRAVITY: &str = "SG";

/// Writes measured value and limit, such as `2,440 lbf; at most 1,700 lbf allowed`.
impl std::fmt::Display for Compared {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let is_gravity = self.unit.is_some_and(|unit| unit.name() == SPECIFIC_GRAVITY);
        let name = if is_gravity { "specific gravity " } else { "" };
        write!(f, "{name}{}; {}", self.text(self.left), self.asks())
    }
}

/// An endline, or its upper part.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MadeUp {
    /// Pieces from the buoy down; a sleeve or link has no length.
    pub pieces: Vec<Stretch>,
}

/// A piece of an endline.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stretch {
    /// Unstretched length [m].
    pub length_m: f64,
    /// Strength of new material as its source states it [N].
    pub rated_n: f64,
}

/// Places along an endline.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Places {
    /// From and to, from the buoy down [m].
    pub spans_m: Vec<[f64; 2]>,
    /// Length of the endline, or of the part that was checked [m].
    pub length_m: f64,
}

/// Relative tolerance for strengths: conversion of units changes the last digits.
const ROUNDING: f64 = 1e-9;

impl MadeUp {
    /// Its length [m].
    pub fn length_m(&self) -> f64 {
        self.pieces.iter().map(|piece| piece.length_m).sum()
    }

    /// Its upper part, from the buoy to a share of its length.
    pub fn upper_part(&self, share: f64) -> Self {
        let mut left_m = share.clamp(0.0, 1.0) * self.length_m();
        let mut pieces = Vec::new();
        for piece in &self.pieces {
            if left_m < 0.0 || (left_m == 0.0 && piece.length_m > 0.0) {
                break;
            }
            pieces.push(Stretch { length_m: piece.length_m.min(left_m), ..*piece });
            left_m -= piece.length_m;
        }
        Self { pieces }
    }

    /// Where it is rated at most this strong; places that touch are one.
    pub fn weak_places(&self, most_n: f64) -> Places {
        let (mut spans, mut at_m) = (Vec::<[f64; 2]>::new(), 0.0);
        for piece in &self.pieces {
            let end_m = at_m + piece.length_m;
            if piece.rated_n <= most_n * (1.0 + ROUNDING) {
                match spans.last_mut() {
                    Some(last) if last[1] >= at_m => last[1] = end_m,
                    _ => spans.push([at_m, end_m]),
                }
            }
            at_m = end_m;
        }
        Places { spans_m: spans, length_m: at_m }
    }
}

impl Places {
    /// The longest stretch without one, from the buoy, between two, or to the lower end [m].
    pub fn longest_gap_m(&self) -> f64 {
        let starts = self.spans_m.iter().map(|span| span[0]).chain([self.length_m]);
        let ends = [0.0].into_iter().chain(self.spans_m.iter().map(|span| span[1]));
        starts.zip(ends).map(|(start, end)| start - end).fold(0.0, f64::max)
    }

    /// Share of the length that they take.
    pub fn share(&self) -> f64 {
        let taken: f64 = self.spans_m.iter().map(|span| span[1] - span[0]).sum();
        if self.length_m > 0.0 { taken / self.length_m } else { 0.0 }
    }

    /// From the buoy to the first; infinite where there is none [m].
    pub fn first_m(&self) -> f64 {
        self.spans_m.first().map_or(f64::INFINITY, |span| span[0])
    }

    /// Distance of the nearest from a share of the length, as a share; infinite where there is none.
    pub fn from_share(&self, share: f64) -> f64 {
        let at_m = share * self.length_m;
        let away = |span: &[f64; 2]| (span[0] - at_m).max(at_m - span[1]).max(0.0);
        self.spans_m.iter().map(away).fold(f64::INFINITY, f64::min) / self.length_m
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(pieces: &[(f64, f64)]) -> MadeUp {
        let piece =
            |(length_m, rated_n): &(f64, f64)| Stretch { length_m: *length_m, rated_n: *rated_n };
        MadeUp { pieces: pieces.iter().map(piece).collect() }
    }

    #[test]
    fn weak_places_lie_where_the_line_is_weak_and_gaps_between_them() {
        // 10 m strong, 1 m weak, 20 m strong, a sleeve, 9 m strong, from the buoy down: 40 m.
        let line = line(&[(10.0, 9.0), (1.0, 5.0), (20.0, 9.0), (0.0, 4.0), (9.0, 9.0)]);
        let weak = line.weak_places(5.0);
        assert_eq!(weak.spans_m, [[10.0, 11.0], [31.0, 31.0]]);
        assert_eq!((weak.longest_gap_m(), weak.first_m()), (20.0, 10.0));
        assert!((weak.share() - 1.0 / 40.0).abs() < 1e-12);
        // A quarter of the line is at 10 m, three quarters at 30 m, 1 m above the sleeve.
        assert!((weak.from_share(0.25), weak.from_share(0.75)) == (0.0, 1.0 / 40.0));
        // The upper half ends at 20 m, 9 m below the insert's lower end.
        let upper = line.upper_part(0.5).weak_places(5.0);
        assert_eq!((upper.spans_m.len(), upper.length_m, upper.longest_gap_m()), (1, 20.0, 10.0));
        assert!(line.weak_places(1.0).first_m().is_infinite());
    }

    #[test]
    fn weak_pieces_that_touch_are_one_place() {
        let weak = line(&[(2.0, 5.0), (3.0, 4.0), (5.0, 9.0)]).weak_places(5.0);
        assert_eq!(weak.spans_m, [[0.0, 5.0]]);
        assert_eq!((weak.share(), weak.longest_gap_m()), (0.5, 5.0));
    }
}
