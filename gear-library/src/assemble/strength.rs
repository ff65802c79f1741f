//! Strength of lines and weak links as they are made up: the budget of each, and the rope of a line that is to
//! deliver a strength.
//!
//! What a budget is: [`StrengthBudget`]. A line that delivers `S` needs rope whose new pieces hold `S / (w · e)` in the
//! mean, with the least `e` along the line; its stiffness follows, so that it breaks at the same stretch.

use endline_sim::model::Strength;

use crate::diagnostic::At;
use crate::entry::Entry;
use crate::fields::Problems;
use crate::items::{Condition, Rope, WeakLink};
use crate::line::LineMake;
use crate::strength::{StrengthBudget, StrengthFactor, StrengthFigure};

use super::builder::{Builder, Scale};
use super::inserts::{Piece, Tied};
use super::line::NewLine;
use super::strength_variation;

impl Builder<'_> {
    /// The condition of a line's rope: its own, or the scenario's.
    pub fn condition(&self, make: &LineMake) -> At<Condition> {
        let usual =
            || At { value: self.scenario.rope_condition, place: self.scenario.place.clone() };
        make.condition.clone().unwrap_or_else(usual)
    }

    /// The scale of the line's own rope by which it delivers the strength asked for at its weakest place.
    pub fn scale_to_deliver(&self, line: &NewLine<'_>, pieces: &[Piece<'_>]) -> Option<Scale> {
        let wanted_n = line.make.delivered_n?;
        let condition = self.condition(line.make).value;
        // What is wrong with the rope is reported where it is put into the spec.
        let item = self.find_rope(&line.rope, &Problems::default())?;
        let weakest = pieces
            .iter()
            .filter(|piece| piece.own)
            .map(|piece| weaker_end(&item, piece))
            .fold(1.0, f64::min);
        let usual_n =
            item.strength_n * item.mean_factor * wear(&item, line.make, condition) * weakest;
        let strength = wanted_n / usual_n;
        let keeps = line.make.keeps_stiffness.unwrap_or(false);
        Some(Scale { strength, stiffness: if keeps { 1.0 } else { strength } })
    }

    /// What a piece keeps of its rope's strength: wear and variation all along, a knot or splice at each end.
    pub fn piece_strength(
        &mut self,
        rope: usize,
        piece: &Piece<'_>,
        make: &LineMake,
        scale: Option<Scale>,
    ) -> Strength {
        let condition = self.condition(make).value;
        let item = &self.stock[rope];
        // What a line says of its wear is of its own rope, not of what is put into it.
        let usual = LineMake::default();
        let make = if piece.own { make } else { &usual };
        let drawn = self.strength_factor(item.strength_cv, &piece.id);
        let left = |end: usize| end_left(item, piece, end);
        let strength =
            Strength { all: wear(item, make, condition) * drawn, end_a: left(0), end_b: left(1) };
        let budget = StrengthBudget {
            part: piece.id.clone(),
            item: item.entry.id.clone(),
            stated: stated(&item.entry, "strength", item.strength_n),
            factors: rope_factors(item, piece, make, condition, scale),
            variation: StrengthFigure::of(&item.entry, "strength_cv"),
            drawn,
        };
        self.strengths.push(budget);
        strength
    }

    /// The tension above which a weak link of the library parts, as drawn [N]; its budget is noted.
    pub fn link_strength(&mut self, link: &WeakLink, id: &str) -> f64 {
        let drawn = self.strength_factor(link.spread, id);
        let budget = StrengthBudget {
            part: id.to_owned(),
            item: link.entry.id.clone(),
            stated: stated(&link.entry, "rating", link.rating_n),
            factors: mean_factor(&link.entry).into_iter().collect(),
            variation: StrengthFigure::of(&link.entry, "spread"),
            drawn,
        };
        let drawn_n = budget.drawn_n();
        self.strengths.push(budget);
        drawn_n
    }

    /// The drawn factor on the strength of a part; 1 where the scenario takes strengths as they are named.
    fn strength_factor(&self, variation: f64, id: &str) -> f64 {
        if self.scenario.strength_variation {
            strength_variation::factor(self.spec.settings.seed, id, variation)
        } else {
            1.0
        }
    }

    /// A knot or splice of the library.
    pub fn knot(&mut self, id: &At<String>) -> Option<Tied> {
        let Some(knot) = self.library.knots.iter().find(|known| known.entry.id == id.value) else {
            self.no_item(crate::schema::Kind::Knot, &id.value, &id.place);
            return None;
        };
        self.uses(&knot.entry.path);
        let source = StrengthFigure::of(&knot.entry, "strength_left");
        Some(Tied {
            strength_left: knot.strength_left,
            bulk: knot.bulk,
            source: source.map(|figure| (knot.entry.name.clone(), figure)),
        })
    }
}

/// Share of a rope's strength that wear leaves; rope that has never been loaded is not worn.
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

/// The strength as the item states it; one written into a scenario in place may lack its figure.
fn stated(entry: &Entry, key: &str, value: f64) -> StrengthFigure {
    StrengthFigure::of(entry, key)
        .unwrap_or_else(|| StrengthFigure::chosen(value, "written in the scenario"))
}

fn mean_factor(entry: &Entry) -> Option<StrengthFactor> {
    let figure = StrengthFigure::of(entry, "mean_factor")?;
    Some(StrengthFactor { name: "mean of new pieces".to_owned(), figure })
}

/// The factors of a piece of rope, those that nobody named left out.
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

/// The weaker end of a piece: its knot or splice, or what is usual for the rope.
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
