//! The posterior of an encounter: each quantity among the draws that end alike, beside all draws.
//!
//! Draws are from the priors themselves and have equal weight. Those like the observation are therefore a sample of the posterior,
//! `p(encounter | ending) ∝ p(ending | encounter) p(encounter)`, and their number is its effective size.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::Serialize;

use crate::encounters::draw::Drawn;
use crate::encounters::{Encounter, in_words};

use super::distance::LIKE;
use super::rounds::Rounds;

/// Least number of draws for quartiles or shares.
pub const LEAST: usize = 4;

/// Greatest number of words of a quantity, the most frequent first.
const WORDS: usize = 4;

/// A quantity among the draws.
#[derive(Clone, Debug, JsonSchema, PartialEq, Serialize)]
pub struct Quantity {
    /// Its name; `first touched` for the part that rope touched first.
    pub name: String,
    /// Among the draws that end alike: the middle half, or words with their shares.
    pub like: String,
    /// Among all draws.
    pub all: String,
}

/// Every quantity that varies; empty if too few draws end alike.
pub(super) fn quantities(rounds: &Rounds<'_>) -> Vec<Quantity> {
    let is_like: Vec<bool> =
        rounds.prior_sample.iter().map(|(_, trial)| trial.distance <= LIKE).collect();
    if is_like.iter().filter(|like| **like).count() < LEAST {
        return Vec::new();
    }
    let mut columns: BTreeMap<String, Vec<Drawn>> = BTreeMap::new();
    for (point, trial) in &rounds.prior_sample {
        let first = Drawn {
            name: "first touched".into(),
            text: trial.first_part.replace('_', " "),
            number: None,
            plain: false,
        };
        let drawn = Encounter::at_point(&rounds.question.opened.study, point).drawn;
        for drawn in drawn.into_iter().chain([first]) {
            columns.entry(drawn.name.clone()).or_default().push(drawn);
        }
    }
    columns.into_iter().filter_map(|(name, column)| quantity(name, &column, &is_like)).collect()
}

fn quantity(name: String, column: &[Drawn], is_like: &[bool]) -> Option<Quantity> {
    let like = column.iter().zip(is_like).filter(|(_, like)| **like).map(|(drawn, _)| drawn);
    let (like, all) = (summary(like.collect()), summary(column.iter().collect()));
    let varies = column.iter().any(|drawn| drawn.text != column[0].text);
    varies.then_some(Quantity { name, like, all })
}

/// The middle half of numbers, or words with their shares.
fn summary(mut drawn: Vec<&Drawn>) -> String {
    if drawn.iter().all(|drawn| drawn.number.is_some()) {
        drawn.sort_by(|one, other| {
            one.number.partial_cmp(&other.number).unwrap_or(one.name.cmp(&other.name))
        });
        let at = |quarters: usize| in_words(&drawn[(drawn.len() - 1) * quarters / 4].text);
        return format!("{} to {}", at(1), at(3));
    }
    let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
    for one in &drawn {
        *counts.entry(&one.text).or_default() += 1;
    }
    let mut counts: Vec<(&str, usize)> = counts.into_iter().collect();
    counts.sort_by_key(|(word, count)| (std::cmp::Reverse(*count), *word));
    let word = |(word, count): &(&str, usize)| {
        let word = if word.is_empty() { "none" } else { word };
        format!("{word} {} %", 100 * count / drawn.len())
    };
    counts.iter().take(WORDS).map(word).collect::<Vec<_>>().join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn drawn(name: &str, text: &str) -> Drawn {
        let number = text.split(' ').next().and_then(|number| number.parse().ok());
        Drawn { name: name.into(), text: text.into(), number, plain: false }
    }

    #[test]
    fn numbers_are_summarised_by_their_middle_half_and_words_by_their_shares() {
        let depths: Vec<Drawn> =
            (0..9).rev().map(|depth| drawn("depth", &format!("{depth}.125 m"))).collect();
        let is_like: Vec<bool> = (0..9).map(|place| place >= 4).collect();
        let found = quantity("depth".into(), &depths, &is_like).unwrap();
        // All lie from 0 to 8 m; those that end alike are the five from 0 to 4 m.
        assert_eq!(
            (found.all.as_str(), found.like.as_str()),
            ("2.12 m to 6.12 m", "1.12 m to 3.12 m")
        );

        let acts: Vec<Drawn> = ["bolt", "", "", "roll", "roll", "roll", "roll", "", ""]
            .map(|act| drawn("answer", act))
            .into();
        let found = quantity("answer".into(), &acts, &is_like).unwrap();
        assert_eq!(found.all, "none 44 %, roll 44 %, bolt 11 %");
        assert_eq!(found.like, "roll 60 %, none 40 %");
        assert_eq!(quantity("same".into(), &vec![drawn("same", "1 m"); 9], &is_like), None);
    }
}
