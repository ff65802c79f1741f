//! Strength of lines and weak links: their budgets ([`StrengthBudget`]), required delivered strengths, random variation.
//!
//! A line that delivers `S` needs rope with a mean new strength of `S / (w · e)`, where `e` is the smallest along the line.
//! Its stiffness is that of its item, or scaled with the strength where `keeps_stiffness = false`, so that the stretch at break is unchanged.
//!
//! The variation of a line or weak link is `1 + c z` with the coefficient of variation `c` and a standard normal `z`
//! (Box and Muller 1958, doi:10.1214/aoms/1177706645) from two uniform numbers, the BLAKE3 hash of seed, id and attempt.
//! It is therefore independent of other parts. A factor below [`LEAST`] is drawn again.
//! An assembly with `fleet_cv` has a second factor of this form, one draw for all of its rope, because gears of a fleet differ in
//! rope and age. The two are independent: a piece varies between gears with `√(strength_cv² + fleet_cv²)`.

use std::f64::consts::PI;

use endline_sim::model::{Strength, WeakPlace};

use crate::assembly::Assembly;
use crate::diagnostic::At;
use crate::entry::Entry;
use crate::fields::Problems;
use crate::items::{Condition, Rope, WeakLink};
use crate::line::LineMake;
use crate::scenario::PlacedGear;
use crate::schema::Kind;
use crate::strength::{StrengthBudget, StrengthFactor, StrengthFigure, WEAK_PLACES};
use crate::tree::{Content, Node};

use super::builder::{Builder, Scale};
use super::line::{NewLine, Piece, Tied, weak_lengths};

/// Variation of the strength of rope between gears of a fleet.
#[derive(Clone, Debug)]
pub struct Fleet {
    /// Its coefficient of variation.
    figure: StrengthFigure,
    /// The drawn factor of this gear.
    drawn: f64,
}

impl Builder<'_> {
    /// Variation between gears like an assembly, and its draw for this gear; none if an attribute of the gear chooses a rope.
    pub fn fleet_of(&self, gear: &PlacedGear, assembly: &Assembly) -> Option<Fleet> {
        let figure = StrengthFigure::of(&assembly.entry, "fleet_cv")?;
        let is_rope = |node: &Node| {
            let Content::Text(text) = &node.content else { return false };
            self.library.ropes.iter().any(|rope| rope.entry.id == *text)
        };
        if gear.attributes.0.iter().any(|(_, _, node)| is_rope(node)) {
            return None;
        }
        let id = gear.id.as_ref().map_or("", |id| &id.value);
        let drawn = self.strength_factor(figure.value, &format!("fleet {id}"));
        Some(Fleet { figure, drawn })
    }

    /// The fleet that a piece's strength varies with: none for inserts, and for lines that state their delivered strength.
    fn fleet_at(&self, piece: &Piece<'_>, make: &LineMake) -> Option<&Fleet> {
        self.fleet.as_ref().filter(|_| piece.own && make.delivered_n.is_none())
    }

    /// Condition of a line's rope: its own, else that of the scenario.
    pub fn condition(&self, make: &LineMake) -> At<Condition> {
        let usual =
            || At { value: self.scenario.rope_condition, place: self.scenario.place.clone() };
        make.condition.clone().unwrap_or_else(usual)
    }

    /// Scale of the line's rope for its required delivered strength at the weakest place.
    pub fn scale_to_deliver(&self, line: &NewLine<'_>, pieces: &[Piece<'_>]) -> Option<Scale> {
        let wanted_n = line.make.delivered_n?;
        let condition = self.condition(line.make).value;
        // Problems of the rope are reported when it is added to the spec.
        let item = self.find_rope(&line.rope, &Problems::default())?;
        let weakest = pieces
            .iter()
            .filter(|piece| piece.own)
            .map(|piece| weaker_end(&item, piece))
            .fold(1.0, f64::min);
        let usual_n =
            item.strength_n * item.mean_factor * wear(&item, line.make, condition) * weakest;
        let strength = wanted_n / usual_n;
        let keeps = line.make.keeps_stiffness.unwrap_or(true);
        Some(Scale { strength, stiffness: if keeps { 1.0 } else { strength } })
    }

    /// Strength of a piece relative to its rope: wear and variation along it, connections at its ends. Records its budget.
    pub fn piece_strength(
        &mut self,
        rope: usize,
        piece: &Piece<'_>,
        make: &LineMake,
        scale: Option<Scale>,
    ) -> Strength {
        let condition = self.condition(make).value;
        let item = &self.stock[rope];
        // `wear_factor` of a line applies to its own rope, not to inserts.
        let usual = LineMake::default();
        let make = if piece.own { make } else { &usual };
        let fleet = self.fleet_at(piece, make);
        let drawn = self.strength_factor(item.strength_cv, &piece.id)
            * fleet.map_or(1.0, |fleet| fleet.drawn);
        let left = |end: usize| end_left(item, piece, end);
        let strength =
            Strength { all: wear(item, make, condition) * drawn, end_a: left(0), end_b: left(1) };
        let budget = StrengthBudget {
            part: piece.id.clone(),
            item: item.entry.id.clone(),
            stated: stated(&item.entry, "strength", item.strength_n),
            factors: rope_factors(item, piece, make, condition, scale),
            variation: StrengthFigure::of(&item.entry, "strength_cv"),
            fleet: fleet.map(|fleet| fleet.figure.clone()),
            drawn,
        };
        self.strengths.push(budget);
        strength
    }

    /// Weak places of a line, which vary with its rope: one draw applies to all of them. Records their budget.
    pub fn weak_places(&mut self, rope: usize, line: &NewLine<'_>) -> Vec<WeakPlace> {
        // Both together are refused where the line is cut at its inserts.
        let Some(weak) = line.make.weak_places.as_ref().filter(|_| line.make.inserts.is_none())
        else {
            return Vec::new();
        };
        let lengths = match weak_lengths(weak, &line.id.value, line.length_m) {
            Ok(lengths) => lengths,
            Err(problem) => {
                self.problems.push(*problem);
                return Vec::new();
            }
        };
        let item = &self.stock[rope];
        let drawn = self.strength_factor(item.strength_cv, &line.id.value);
        let budget = StrengthBudget {
            part: format!("{}.{WEAK_PLACES}", line.id.value),
            item: weak_places_in_words(&lengths),
            stated: StrengthFigure::chosen(weak.strength_n, "weak_places of the line"),
            factors: Vec::new(),
            variation: StrengthFigure::of(&item.entry, "strength_cv"),
            fleet: None,
            drawn,
        };
        let strength_n = budget.drawn_n();
        self.strengths.push(budget);
        lengths.into_iter().map(|at_m| WeakPlace { at_m, strength_n }).collect()
    }

    /// Drawn rating of a weak link of the library [N]. Records its budget.
    pub fn link_strength(&mut self, link: &WeakLink, id: &str) -> f64 {
        let drawn = self.strength_factor(link.spread, id);
        let budget = StrengthBudget {
            part: id.to_owned(),
            item: link.entry.id.clone(),
            stated: stated(&link.entry, "rating", link.rating_n),
            factors: mean_factor(&link.entry).into_iter().collect(),
            variation: StrengthFigure::of(&link.entry, "spread"),
            fleet: None,
            drawn,
        };
        let drawn_n = budget.drawn_n();
        self.strengths.push(budget);
        drawn_n
    }

    /// Drawn factor on the strength of a part; 1 without variation.
    fn strength_factor(&self, variation: f64, id: &str) -> f64 {
        if self.scenario.strength_variation {
            factor(self.spec.settings.seed, id, variation)
        } else {
            1.0
        }
    }

    /// A knot or splice of the library.
    pub fn knot(&mut self, id: &At<String>) -> Option<Tied> {
        let knot = self.item(Kind::Knot, id, &self.library.knots, |knot| &knot.entry)?;
        let source = StrengthFigure::of(&knot.entry, "strength_left");
        Some(Tied {
            strength_left: knot.strength_left,
            bulk: knot.bulk,
            source: source.map(|figure| (knot.entry.name.clone(), figure)),
        })
    }
}

/// Greatest number of weak places whose lengths are all listed.
const MOST_LISTED: usize = 6;

/// Number and lengths of weak places, such as `2 weak places at 9.14 m, 27.43 m`.
fn weak_places_in_words(lengths_m: &[f64]) -> String {
    let text = |at_m: &f64| format!("{at_m:.2} m");
    match lengths_m {
        [only] => format!("1 weak place at {}", text(only)),
        [first, .., last] if lengths_m.len() > MOST_LISTED => {
            format!("{} weak places from {} to {}", lengths_m.len(), text(first), text(last))
        }
        all => {
            let listed: Vec<String> = all.iter().map(text).collect();
            format!("{} weak places at {}", all.len(), listed.join(", "))
        }
    }
}

/// Strength after wear, as a share; rope that has never been loaded has no wear.
fn wear(item: &Rope, make: &LineMake, condition: Condition) -> f64 {
    let usual = if condition == Condition::New { 1.0 } else { item.wear_factor };
    make.wear_factor.unwrap_or(usual)
}

fn end_left(item: &Rope, piece: &Piece<'_>, end: usize) -> f64 {
    piece.ends[end].as_ref().map_or(item.knot_factor, |tied| tied.strength_left)
}

fn weaker_end(item: &Rope, piece: &Piece<'_>) -> f64 {
    end_left(item, piece, 0).min(end_left(item, piece, 1)).min(1.0)
}

/// Stated strength of an item; an item written into a scenario may have no figure.
fn stated(entry: &Entry, key: &str, value: f64) -> StrengthFigure {
    StrengthFigure::of(entry, key)
        .unwrap_or_else(|| StrengthFigure::chosen(value, "written in the scenario"))
}

fn mean_factor(entry: &Entry) -> Option<StrengthFactor> {
    let figure = StrengthFigure::of(entry, "mean_factor")?;
    Some(StrengthFactor { name: "mean of new pieces".to_owned(), figure })
}

/// Factors of a piece of rope that have a source.
fn rope_factors(
    item: &Rope,
    piece: &Piece<'_>,
    make: &LineMake,
    condition: Condition,
    scale: Option<Scale>,
) -> Vec<StrengthFactor> {
    let made = scale.filter(|_| piece.own).map(|scale| StrengthFactor {
        name: "made to deliver".to_owned(),
        figure: StrengthFigure::chosen(scale.strength, "delivered_strength of the line"),
    });
    let wear = worn(item, make, condition);
    let end = usize::from(end_left(item, piece, 1) < end_left(item, piece, 0));
    mean_factor(&item.entry)
        .into_iter()
        .chain(made)
        .chain(wear)
        .chain(end_factor(item, piece, end))
        .collect()
}

fn worn(item: &Rope, make: &LineMake, condition: Condition) -> Option<StrengthFactor> {
    let name = "wear".to_owned();
    if let Some(wear) = make.wear_factor {
        let figure = StrengthFigure::chosen(wear, "wear_factor of the line");
        return Some(StrengthFactor { name, figure });
    }
    let figure = StrengthFigure::of(&item.entry, "wear_factor")?;
    (condition != Condition::New).then_some(StrengthFactor { name, figure })
}

/// Factor of an end: its knot or splice, else the rope's default.
fn end_factor(item: &Rope, piece: &Piece<'_>, end: usize) -> Option<StrengthFactor> {
    match &piece.ends[end] {
        Some(tied) => tied.source.as_ref().map(|(knot, figure)| StrengthFactor {
            name: format!("end, {}", knot.to_lowercase()),
            figure: figure.clone(),
        }),
        None => StrengthFigure::of(&item.entry, "knot_factor")
            .map(|figure| StrengthFactor { name: "end, usual splice or knot".to_owned(), figure }),
    }
}

/// Smallest factor.
const LEAST: f64 = 0.2;

/// Factor on the strength of a part, with mean 1 and a coefficient of variation of at most 0.5.
fn factor(seed: u64, id: &str, variation: f64) -> f64 {
    if variation <= 0.0 {
        return 1.0;
    }
    (0..)
        .map(|attempt: u64| {
            1.0 + variation * normal(uniform("endline strength scatter 1", seed, attempt, id))
        })
        .find(|factor| *factor >= LEAST)
        .unwrap_or(1.0)
}

/// A standard normal number from two uniform ones.
pub(super) fn normal([one, other]: [f64; 2]) -> f64 {
    (-2.0 * libm::log(one)).sqrt() * libm::cos(2.0 * PI * other)
}

/// Two independent random numbers between 0 and 1, by their purpose, seed, index and id.
pub(crate) fn uniform(purpose: &'static str, seed: u64, index: u64, id: &str) -> [f64; 2] {
    let mut hasher = blake3::Hasher::new_derive_key(purpose);
    hasher.update(&seed.to_le_bytes()).update(&index.to_le_bytes()).update(id.as_bytes());
    let bytes = hasher.finalize();
    let whole = |from: usize| {
        bytes.as_bytes()[from..from + 8].iter().fold(0_u64, |sum, byte| sum << 8 | u64::from(*byte))
    };
    // 53 bits, shifted by half so that zero is never drawn.
    [0, 8].map(|from| ((whole(from) >> 11) as f64 + 0.5) / (1_u64 << 53) as f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mean_and_variation_over_seeds_and_over_ids_are_as_stated() {
        let by_seed: Vec<f64> = (0..4000).map(|seed| factor(seed, "endline-top", 0.12)).collect();
        let by_id: Vec<f64> =
            (0..4000).map(|number| factor(7, &format!("groundline-{number}"), 0.12)).collect();
        for drawn in [by_seed, by_id] {
            let mean = drawn.iter().sum::<f64>() / 4000.0;
            let variance =
                drawn.iter().map(|factor| (factor - mean) * (factor - mean)).sum::<f64>() / 3999.0;
            // Standard errors: 0.12/√4000 = 0.0019 of the mean, 0.12/√8000 = 0.0013 of the deviation.
            assert!((mean - 1.0).abs() < 0.006, "{mean}");
            assert!((variance.sqrt() - 0.12).abs() < 0.005, "{}", variance.sqrt());
        }
    }

    #[test]
    fn a_draw_is_a_function_of_seed_and_id() {
        assert_eq!(factor(3, "a", 0.1).to_bits(), factor(3, "a", 0.1).to_bits());
        assert!((factor(3, "a", 0.1) - factor(4, "a", 0.1)).abs() > 1e-9);
        assert!((factor(3, "a", 0.1) - factor(3, "b", 0.1)).abs() > 1e-9);
        assert_eq!(factor(3, "a", 0.0).to_bits(), 1.0_f64.to_bits());
    }

    #[test]
    fn weak_places_are_listed_or_counted() {
        assert_eq!(weak_places_in_words(&[9.144]), "1 weak place at 9.14 m");
        assert_eq!(weak_places_in_words(&[8.9, 18.04]), "2 weak places at 8.90 m, 18.04 m");
        let many: Vec<f64> = (1..=7).map(f64::from).collect();
        assert_eq!(weak_places_in_words(&many), "7 weak places from 1.00 m to 7.00 m");
    }
}
