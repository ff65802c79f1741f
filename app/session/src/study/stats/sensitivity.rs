//! Sensitivity: how a rate and the ranking of options change with each input that was drawn.
//!
//! No run is made for it: the encounters of a study are divided by the lower and upper half of an input, or by its
//! levels. Inputs are drawn independently of one another, so that parts differ in that input alone but for chance. Rates
//! are the baseline's: options meet the same encounters, so that their runs together would count each encounter many times.

use schemars::JsonSchema;
use serde::Serialize;

use endline_gear::Prior;

use crate::study::prepared::PreparedStudy;
use crate::study::runs::Runs;
use crate::table::Column;

use super::bootstrap::{Draws, RESAMPLES};
use super::indicators::EventIndicators;
use super::interval::Rate;
use super::sobol::{SobolIndex, classes};

/// Part of an input's range.
#[derive(Clone, Debug, JsonSchema, PartialEq, Serialize)]
pub struct Part {
    /// Its name: `below 1.1`, `from 1.1 on`, or a level.
    pub name: String,
    /// Rate of the event with the baseline.
    pub rate: Rate,
    /// Rates by option.
    pub by_option: Vec<Rate>,
    /// Options by rising rate.
    pub ranking: Vec<usize>,
}

/// The effect of an input.
#[derive(Clone, Debug, JsonSchema, PartialEq, Serialize)]
pub struct InputFinding {
    /// Name of the prior.
    pub name: String,
    /// Its name in words.
    pub words: String,
    /// Its parts.
    pub parts: Vec<Part>,
    /// Greatest less least rate over the parts.
    pub span: f64,
    /// Share of the variance of the event with the baseline that it explains alone.
    pub sobol: SobolIndex,
    /// Whether some option has the lowest rate, or shares it, in every part.
    pub same_best: bool,
}

/// Every input that varies, that with the greatest span first.
pub(super) fn of_inputs(
    opened: &PreparedStudy,
    runs: &Runs,
    indicators: &[EventIndicators],
    baseline: usize,
) -> Vec<InputFinding> {
    let of = |prior: &Prior| {
        let (column, parts) = (runs.drawn(&prior.name.value)?, parts_of(opened, prior, runs)?);
        let sobol = index(&prior.name.value, runs, column, &indicators[baseline]);
        input(prior, parts, sobol, indicators, baseline)
    };
    let mut found: Vec<InputFinding> = opened.study.priors.iter().filter_map(of).collect();
    found.sort_by(|one, other| other.span.total_cmp(&one.span));
    found
}

fn input(
    prior: &Prior,
    parts: Vec<(String, Vec<bool>)>,
    sobol: SobolIndex,
    indicators: &[EventIndicators],
    baseline: usize,
) -> Option<InputFinding> {
    if parts.len() < 2 {
        return None;
    }
    let parts: Vec<Part> =
        parts.into_iter().map(|(name, keep)| part(name, &keep, indicators, baseline)).collect();
    let rates = || parts.iter().filter(|part| part.rate.runs > 0).map(|part| part.rate.rate);
    let span = rates().fold(0.0, f64::max) - rates().fold(1.0, f64::min);
    let best = |part: &Part, option: usize| {
        part.by_option.iter().all(|other| part.by_option[option].rate <= other.rate)
    };
    let same_best = (0..indicators.len()).any(|option| parts.iter().all(|part| best(part, option)));
    Some(InputFinding {
        name: prior.name.value.clone(),
        words: prior.words(),
        parts,
        span: span.max(0.0),
        sobol,
        same_best,
    })
}

/// The Sobol index of an input over the encounters whose run with the baseline counts.
fn index(name: &str, runs: &Runs, column: &Column, indicators: &EventIndicators) -> SobolIndex {
    let mut row_of = vec![None; indicators.0.len()];
    for (row, run) in runs.rows().iter().enumerate() {
        if let Some(place) = row_of.get_mut(run.index()) {
            *place = Some(row);
        }
    }
    let known: Vec<(usize, (f64, f64))> = row_of
        .into_iter()
        .zip(&indicators.0)
        .filter_map(|(row, indicator)| {
            let (row, indicator) = (row?, (*indicator)?);
            Some((row, (f64::from(indicator.occurred), indicator.weight)))
        })
        .collect();
    let (rows, values): (Vec<usize>, Vec<(f64, f64)>) = known.into_iter().unzip();
    let classes = match column {
        Column::Text(texts) => levels_of(&rows.iter().map(|row| &texts[*row]).collect::<Vec<_>>()),
        Column::Real(numbers) => {
            classes(&rows.iter().map(|row| numbers[*row].unwrap_or_default()).collect::<Vec<_>>())
        }
        _ => return SobolIndex::default(),
    };
    SobolIndex::of(name, &classes, &values)
}

/// The place of each text among the texts there are.
fn levels_of(texts: &[&String]) -> Vec<usize> {
    let mut levels = texts.to_vec();
    levels.sort();
    levels.dedup();
    texts.iter().map(|text| levels.partition_point(|level| level < text)).collect()
}

fn part(name: String, keep: &[bool], indicators: &[EventIndicators], baseline: usize) -> Part {
    let own: Vec<EventIndicators> =
        indicators.iter().map(|indicators| indicators.within(keep)).collect();
    let by_option: Vec<Rate> = own.iter().map(Rate::of).collect();
    let rate = by_option[baseline];
    Part {
        name,
        rate,
        ranking: ranking(&by_option.iter().map(|rate| rate.rate).collect::<Vec<_>>()),
        by_option,
    }
}

/// Options by rising rate; the earlier of equal ones first.
fn ranking(rates: &[f64]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..rates.len()).collect();
    order.sort_by(|one, other| rates[*one].total_cmp(&rates[*other]));
    order
}

/// The encounters of each part of an input: its levels, or the lower and upper half of its range.
pub(super) fn parts_of(
    opened: &PreparedStudy,
    prior: &Prior,
    runs: &Runs,
) -> Option<Vec<(String, Vec<bool>)>> {
    let column = runs.drawn(&prior.name.value)?;
    let mut parts = parts(runs, column, &|number| prior.law.written(number));
    if let Column::Text(_) = column {
        parts.iter_mut().for_each(|(level, _)| *level = opened.value_words(prior, level));
    }
    Some(parts)
}

/// The encounters of each part of an input, whose numbers `words` puts in words.
fn parts(runs: &Runs, column: &Column, words: &dyn Fn(f64) -> String) -> Vec<(String, Vec<bool>)> {
    let keep = |belongs: &dyn Fn(usize) -> bool| {
        let mut keep = vec![false; runs.encounters()];
        let rows = runs.rows().iter().enumerate();
        rows.for_each(|(row, run)| keep[run.index()] |= belongs(row));
        keep
    };
    match column {
        Column::Text(values) => {
            let mut levels: Vec<&String> = values.iter().collect();
            levels.sort();
            levels.dedup();
            levels
                .into_iter()
                .map(|level| (level.clone(), keep(&|row| values[row] == *level)))
                .collect()
        }
        Column::Real(values) => {
            let keep_if = |is_in: &dyn Fn(f64) -> bool| keep(&|row| values[row].is_some_and(is_in));
            let mut sorted: Vec<f64> = values.iter().flatten().copied().collect();
            sorted.sort_by(f64::total_cmp);
            let mut levels = sorted.clone();
            levels.dedup();
            if (2..=6).contains(&levels.len()) {
                let part =
                    |level: f64| (words(level), keep_if(&|value| value.total_cmp(&level).is_eq()));
                return levels.into_iter().map(part).collect();
            }
            let (Some(middle), true) = (sorted.get(sorted.len() / 2).copied(), levels.len() > 6)
            else {
                return Vec::new();
            };
            vec![
                (format!("below {}", words(middle)), keep_if(&|value| value < middle)),
                (format!("from {} on", words(middle)), keep_if(&|value| value >= middle)),
            ]
        }
        _ => Vec::new(),
    }
}

/// Share of resamples in which an option has the lowest rate.
#[derive(Clone, Copy, Debug, Default, JsonSchema, PartialEq, Serialize)]
pub struct Lowest {
    /// Share of the draws in which no other option has it.
    pub alone: f64,
    /// Share of the draws in which others have it too.
    pub tied: f64,
}

/// Share of resamples in which each option has the lowest rate.
pub(super) fn lowest(indicators: &[EventIndicators]) -> Vec<Lowest> {
    let count = EventIndicators::longest(indicators);
    let mut draws = Draws::of("ranking");
    let mut counts = vec![[0_u32; 2]; indicators.len()];
    let mut indices = vec![0; count];
    for _ in 0..RESAMPLES {
        indices.iter_mut().for_each(|index| *index = draws.below(count));
        let rate = |indicators: &EventIndicators| {
            let known =
                indices.iter().filter_map(|index| indicators.0.get(*index).copied().flatten());
            let (hits, all) = known.fold((0.0, 0.0), |(hits, all), indicator| {
                (hits + f64::from(indicator.occurred) * indicator.weight, all + indicator.weight)
            });
            if all > 0.0 { hits / all } else { f64::INFINITY }
        };
        let rates: Vec<f64> = indicators.iter().map(rate).collect();
        let least = rates.iter().copied().fold(f64::INFINITY, f64::min);
        let have = |rate: &f64| *rate <= least && rate.is_finite();
        let tied = usize::from(rates.iter().filter(|rate| have(rate)).count() > 1);
        let best = counts.iter_mut().zip(&rates).filter(|(_, rate)| have(rate));
        best.for_each(|(counts, _)| counts[tied] += 1);
    }
    let share = |count: u32| f64::from(count) / RESAMPLES as f64;
    counts
        .into_iter()
        .map(|[alone, tied]| Lowest { alone: share(alone), tied: share(tied) })
        .collect()
}
