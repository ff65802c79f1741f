//! Whales held with the baseline: what each option does for them, by route of attachment, and rates against any strength.

use crate::study::stats::{
    Banded, Findings, HeldWhales, OptionOnHeld, Rate, RouteFinding, StrengthCurve,
};
use crate::units::N_PER_LBF;

use super::figures::{WIDE, break_away_scales, legend};
use super::words::{event_words, rate};
use crate::page::svg::{Axis, Svg};
use crate::page::{Cell, Table};

/// Held whales below which no curve is drawn.
const LEAST_WHALES: u64 = 5;

/// How whales are held with the baseline, beside observed whales.
pub(super) fn routes(held: &HeldWhales) -> Table {
    let row = |found: &RouteFinding| {
        let observed = found.observed.map_or_else(
            || "not stated".to_owned(),
            |observed| format!("{:.0} %", 100.0 * observed),
        );
        vec![Cell::from(found.route.words()), rate(&found.share).into(), observed.into()]
    };
    let headings = ["held by", "of the simulated whales", "of observed whales"];
    let caption = "Places at which rope holds whales with the baseline";
    Table::new(caption, &headings, held.routes.iter().map(row).collect())
}

/// Shares that each option frees of the whales held with the baseline.
pub(super) fn freed(held: &HeldWhales) -> Table {
    let is_met = |found: &&RouteFinding| found.share.hits > 0;
    let met: Vec<&RouteFinding> = held.routes.iter().filter(is_met).collect();
    let headings: Vec<String> = ["option", "freed", "others that it holds"]
        .into_iter()
        .map(str::to_owned)
        .chain(met.iter().map(|found| format!("freed: {}", found.route.words())))
        .chain(held.observed_from.iter().map(|_| "freed, weighted as observed".to_owned()))
        .collect();
    let headings: Vec<&str> = headings.iter().map(String::as_str).collect();
    let row = |option: &OptionOnHeld| {
        let others = match option.newly_held {
            0 => "none".to_owned(),
            count => format!("{:.0} % ({count})", 100.0 * option.newly_held_share),
        };
        let mut row = vec![Cell::from(&option.name), few(&option.freed).into(), others.into()];
        row.extend(
            met.iter().map(|found| Cell::from(few(&option.freed_by_route[found.route as usize]))),
        );
        if held.observed_from.is_some() {
            row.push(weighted(option));
        }
        row
    };
    let event = event_words(&held.event);
    Table::new(
        format!(
            "Of the whales with \"{event}\" with the baseline: share without it with the option"
        ),
        &headings,
        held.options.iter().map(row).collect(),
    )
}

/// `25` for a quarter.
fn percent(share: f64) -> String {
    format!("{:.0}", 100.0 * share)
}

/// `25 % [7, 59] (1 of 4)`.
fn few(rate: &Rate) -> String {
    let [low, high] = [rate.interval.low, rate.interval.high].map(percent);
    format!("{} % [{low},\u{a0}{high}] ({} of {})", percent(rate.rate), rate.hits, rate.runs)
}

/// The share weighted by observed routes.
fn weighted(option: &OptionOnHeld) -> Cell {
    let Some(weighted) = option.weighted else { return "no route met".into() };
    let [low, high] = [weighted.interval.low, weighted.interval.high].map(percent);
    format!("{} % [{low},\u{a0}{high}]", percent(weighted.share)).into()
}

/// How much of the observed whales the weighted shares stand for.
pub(super) fn covered(held: &HeldWhales) -> Option<String> {
    let source = held.observed_from.as_ref()?;
    let covered = held.options.iter().find_map(|option| option.weighted)?.covered;
    let rest = if covered > 0.999 {
        String::new()
    } else {
        format!(
            " No simulated whale is held by the other routes, so that these shares stand for {:.0} % of the observed whales.",
            100.0 * covered
        )
    };
    Some(format!(
        "Observed whales: {source}. A share weighted as observed is the mean over the places at which rope holds, each with its share \
         among observed whales.{rest}"
    ))
}

/// Share of the held whales whose rope or link parts, against its strength, with the band, and the share that stays held.
pub(super) fn curves(findings: &Findings) -> Option<String> {
    let drawn = |curve: &&StrengthCurve| curve.parts_given_held.encounters >= LEAST_WHALES;
    let curves: Vec<&StrengthCurve> = findings.strength_curves.iter().filter(drawn).collect();
    if curves.is_empty() {
        return None;
    }
    let most_n = greatest_n(&curves);
    let (top, bottom) = (20.0, 310.0);
    let mut svg = Svg::new(WIDE, 382.0, "Held whales whose rope parts, by strength");
    let right = WIDE - 250.0;
    let across = Axis { values: [0.0, most_n / N_PER_LBF], places: [70.0, right] };
    let up = Axis { values: [0.0, 1.0], places: [bottom, top] };
    break_away_scales(&mut svg, &across, &up);
    let mut y = top + 6.0;
    for (kind, curve) in curves.iter().enumerate() {
        let drawn = || curve.strengths_n.iter().enumerate().filter(|(_, n)| **n <= most_n);
        let x = |strength_n: f64| across.at(strength_n / N_PER_LBF);
        let Banded { shares, .. } = &curve.parts_given_held;
        let ends = |end: usize| {
            drawn().map(move |(place, n)| [x(*n), up.at(curve.parts_given_held.band(place)[end])])
        };
        let band: Vec<[f64; 2]> =
            ends(0).chain(ends(1).collect::<Vec<_>>().into_iter().rev()).collect();
        svg.area(&band, 2 * kind);
        let line: Vec<[f64; 2]> = drawn().map(|(place, n)| [x(*n), up.at(shares[place])]).collect();
        svg.path(&line, 2 * kind);
        let words = format!("{} parts", curve.part);
        y = legend(&mut svg, [right, y], 2 * kind, &[words.as_str()]);
        let Some(whole) = curve.held.last().filter(|share| **share > 0.0) else { continue };
        let held: Vec<[f64; 2]> =
            drawn().map(|(place, n)| [x(*n), up.at(curve.held[place] / whole)]).collect();
        svg.path(&held, 2 * kind + 1);
        let words = format!("still held, {}", curve.part);
        y = legend(&mut svg, [right, y], 2 * kind + 1, &[words.as_str()]);
    }
    Some(svg.done())
}

/// Strength beyond which nothing parts in any curve, with some room [N].
fn greatest_n(curves: &[&StrengthCurve]) -> f64 {
    let last = |curve: &&StrengthCurve| {
        let places = curve.strengths_n.iter().zip(&curve.parts_given_held.shares);
        places.filter(|(_, share)| **share > 0.0).map(|(n, _)| *n).fold(0.0, f64::max)
    };
    let most_n = curves.iter().map(last).fold(0.0, f64::max);
    let end_n = curves.iter().flat_map(|curve| &curve.strengths_n).copied().fold(0.0, f64::max);
    (1.15 * most_n).clamp(2000.0 * N_PER_LBF, end_n)
}

/// Caption of the figure of [`curves`].
pub(super) fn curves_caption(findings: &Findings) -> String {
    let whales = findings.strength_curves.iter().map(|curve| curve.parts_given_held.encounters);
    format!(
        "Of the {} whales that are held if nothing can part: share in which the part parts if it delivers this strength, with a band that \
         contains the whole curve with a probability of 95 %. Every strength is known from the same runs. \"Still held\" is the rate of \
         holding as a share of that of the greatest strength; between the strengths that were simulated it is that of the nearest.",
        whales.max().unwrap_or_default()
    )
}
