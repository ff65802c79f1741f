//! Held whales: share of touched whales still held, by time since first contact; what each option does for the whales held with the
//! baseline, by route of attachment; rates against any strength of rope.

use crate::study::stats::{
    AskedStrength, Banded, Findings, HeldKind, HeldWhales, OptionFinding, OptionOnHeld, Rate,
    RouteFinding, StrengthCurve, Survival, Weighted,
};
use crate::study::threat::ThreatRange;
use crate::units::{self, N_PER_LBF};

use super::Beside;
use super::figures::{WIDE, break_away_scales, grouped, legend};
use super::words::{event_words, percent_interval, rate};
use crate::page::svg::{Axis, Side, Svg};
use crate::page::{Cell, Table};

/// Times of the columns [s].
const TIMES_S: [f64; 7] = [5.0, 10.0, 30.0, 60.0, 120.0, 300.0, 600.0];
/// Least time on the axis, which is logarithmic [s].
const LEAST_S: f64 = 1.0;

/// Shares still held, by option and time.
pub(super) fn table(findings: &Findings) -> Table {
    let times = times(findings);
    let words: Vec<String> = times.iter().map(|time| format!("held at {time} s")).collect();
    let headings: Vec<&str> = ["option", "touched", "released", "half are free after"]
        .into_iter()
        .chain(words.iter().map(String::as_str))
        .collect();
    let row = |option: &OptionFinding| {
        let own = &option.survival;
        let median = own.median_s().map_or_else(|| "longer".into(), |time| format!("{time:.1} s"));
        let mut row = vec![
            Cell::from(&option.name),
            own.touched.to_string().into(),
            own.released.to_string().into(),
            median.into(),
        ];
        row.extend(times.iter().map(|time| Cell::from(share(own, *time))));
        row
    };
    let rows = findings.options.iter().map(row).collect();
    Table::new("Of the whales that rope touched, the share that it still holds", &headings, rows)
}

fn share(survival: &Survival, time_s: f64) -> String {
    survival.at(time_s).map_or_else(
        || "not followed".to_owned(),
        |held| format!("{:.1} % {}", 100.0 * held.share, percent_interval(held.interval)),
    )
}

/// Times up to the longest that a whale was followed.
fn times(findings: &Findings) -> Vec<f64> {
    let most_s = longest_s(findings);
    TIMES_S.into_iter().filter(|time| *time <= most_s).collect()
}

fn longest_s(findings: &Findings) -> f64 {
    findings.options.iter().map(|option| option.survival.followed_s).fold(0.0, f64::max)
}

/// A falling curve for each option; options with the same releases share one.
pub(super) fn figure(findings: &Findings) -> String {
    let groups = grouped(&findings.options, |option| &option.survival);
    let (top, bottom, right): (f64, f64, f64) = (20.0, 330.0, WIDE - 230.0);
    let names: usize = groups.iter().map(|(_, names)| names.len()).sum();
    let height = (bottom + 44.0).max(top + 20.0 * names as f64 + 8.0 * groups.len() as f64 + 10.0);
    let mut svg = Svg::new(WIDE, height, "Share of whales still held, by time since first contact");
    let most_s = longest_s(findings).max(10.0);
    let across = Axis { values: [LEAST_S.log10(), most_s.log10()], places: [60.0, right] };
    let up = Axis { values: [0.0, 1.0], places: [bottom, top] };
    scales(&mut svg, &across, &up, most_s);
    let mut y = top + 6.0;
    for (kind, (option, names)) in groups.into_iter().enumerate() {
        curve(&mut svg, &across, &up, (&option.survival, kind));
        y = legend(&mut svg, [right, y], kind, &names);
    }
    svg.done()
}

fn scales(svg: &mut Svg, across: &Axis, up: &Axis, most_s: f64) {
    let ([left, right], [bottom, top]) = (across.places, up.places);
    for share in [0.0, 0.25, 0.5, 0.75, 1.0] {
        svg.line([left, up.at(share)], [right, up.at(share)], "grid");
        svg.text([left - 6.0, up.at(share) + 4.0], Side::End, &format!("{:.0} %", 100.0 * share));
    }
    for time_s in [1.0].into_iter().chain(TIMES_S).filter(|time| *time <= most_s) {
        let x = across.at(time_s.log10());
        svg.line([x, top], [x, bottom], "grid");
        svg.text([x, bottom + 18.0], Side::Middle, &format!("{time_s} s"));
    }
    let words = "time since first contact";
    svg.text([0.5 * (left + right), bottom + 38.0], Side::Middle, words);
}

/// The steps of a curve, and intervals at the times of the columns, beside each other by option.
fn curve(svg: &mut Svg, across: &Axis, up: &Axis, (survival, kind): (&Survival, usize)) {
    let x = |time_s: f64| across.at(time_s.max(LEAST_S).log10());
    let mut points = vec![[x(LEAST_S), up.at(1.0)]];
    for step in &survival.steps {
        let before = points.last().map_or(up.at(1.0), |point| point[1]);
        points.push([x(step.time_s), before]);
        points.push([x(step.time_s), up.at(step.share)]);
    }
    let last = points.last().map_or(up.at(1.0), |point| point[1]);
    points.push([x(survival.followed_s), last]);
    svg.path(&points, kind);
    for held in TIMES_S.into_iter().filter_map(|time_s| survival.at(time_s)) {
        let ends = [held.interval.low, held.share, held.interval.high];
        svg.post(x(held.time_s) + 5.0 * kind as f64, ends.map(|share| up.at(share)), kind);
    }
}

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
            row.push(weighted(option.weighted));
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

/// A share weighted by observed routes.
fn weighted(share: Option<Weighted>) -> Cell {
    let Some(weighted) = share else { return "no route met".into() };
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

/// A line of a figure: its points, the outline of its band if it has one, and the words of its legend.
struct Series {
    line: Vec<[f64; 2]>,
    band: Vec<[f64; 2]>,
    words: Vec<String>,
}

/// Share of the held whales whose rope or link parts, against its strength, with the band, and the share that stays held. NOAA's threat is
/// drawn as the share that is no threat.
pub(super) fn curves(all: &[StrengthCurve], beside: &Beside<'_>) -> Option<String> {
    let drawn = |curve: &&StrengthCurve| curve.parts_given_held.encounters >= LEAST_WHALES;
    let curves: Vec<&StrengthCurve> = all.iter().filter(drawn).collect();
    if curves.is_empty() {
        return None;
    }
    let most_n = greatest_n(&curves, beside);
    let (top, bottom) = (20.0, 310.0);
    let mut svg = Svg::new(WIDE, 382.0, "Held whales whose rope parts, by strength");
    let right = WIDE - 250.0;
    let across = Axis { values: [0.0, most_n / N_PER_LBF], places: [70.0, right] };
    let up = Axis { values: [0.0, 1.0], places: [bottom, top] };
    break_away_scales(&mut svg, &across, &up);
    let points = |values: &mut dyn Iterator<Item = (f64, f64)>| -> Vec<[f64; 2]> {
        let drawn = values.filter(|(n, _)| *n <= most_n);
        drawn.map(|(n, share)| [across.at(n / N_PER_LBF), up.at(share)]).collect()
    };
    let mut series: Vec<Series> = Vec::new();
    for curve in &curves {
        let at_strengths = |share: &dyn Fn(usize) -> f64| {
            let values = curve.strengths_n.iter().enumerate();
            points(&mut values.map(|(place, n)| (*n, share(place))))
        };
        let Banded { shares, .. } = &curve.parts_given_held;
        let ends = |end: usize| at_strengths(&|place| curve.parts_given_held.band(place)[end]);
        series.push(Series {
            line: at_strengths(&|place| shares[place]),
            band: between(ends(0), ends(1)),
            words: vec![format!("{} parts", curve.part)],
        });
        if let Some(whole) = curve.held.last().filter(|share| **share > 0.0) {
            let line = at_strengths(&|place| curve.held[place] / whole);
            let words = vec![format!("still held, {}", curve.part)];
            series.push(Series { line, band: Vec::new(), words });
        }
    }
    let strengths_n = || (1..=400).map(|step| most_n * f64::from(step) / 400.0);
    if let Some(threats) = &beside.threats {
        let line = |share: &dyn Fn(ThreatRange) -> f64| {
            let known = strengths_n().filter(|n| threats.contains(n / N_PER_LBF));
            points(&mut known.map(|n| (n, share(threats.range(n / N_PER_LBF)))))
        };
        series.push(Series {
            line: line(&|range| 1.0 - range.threat),
            band: between(line(&|range| 1.0 - range.upper), line(&|range| 1.0 - range.lower)),
            words: vec!["NOAA's model V3.1:".to_owned(), "1 less threat".to_owned()],
        });
    }
    for haul in beside.hauls {
        let words = haul.name.split(", ").map(str::to_owned).collect();
        let line = points(&mut strengths_n().map(|n| (n, haul.parts(n))));
        series.push(Series { line, band: Vec::new(), words });
    }
    let mut y = top + 6.0;
    for (kind, Series { line, band, words }) in series.iter().enumerate() {
        if !band.is_empty() {
            svg.area(band, kind);
        }
        svg.path(line, kind);
        let words: Vec<&str> = words.iter().map(String::as_str).collect();
        y = legend(&mut svg, [right, y], kind, &words);
    }
    Some(svg.done())
}

/// The outline of the area between two lines.
fn between(low: Vec<[f64; 2]>, high: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    low.into_iter().chain(high.into_iter().rev()).collect()
}

/// Greatest strength of the axis, with some room [N]: nothing parts in any curve or haul beyond it, and it includes the strengths asked for most.
fn greatest_n(curves: &[&StrengthCurve], beside: &Beside<'_>) -> f64 {
    let last = |curve: &&StrengthCurve| {
        let places = curve.strengths_n.iter().zip(&curve.parts_given_held.shares);
        places.filter(|(_, share)| **share > 0.0).map(|(n, _)| *n).fold(0.0, f64::max)
    };
    let hauled = beside.hauls.iter().map(|haul| haul.tension_n * (1.0 + 3.0 * haul.variation));
    let most_n = curves.iter().map(last).chain(hauled).fold(0.0, f64::max);
    let end_n = curves.iter().flat_map(|curve| &curve.strengths_n).copied().fold(0.0, f64::max);
    (1.15 * most_n).clamp(3000.0 * N_PER_LBF, end_n)
}

/// Shares of held whales on which whole rope parts, at the strengths asked for most: of all, and by route of attachment.
pub(super) fn strengths(all: &[StrengthCurve]) -> Option<Table> {
    let rope = all.iter().find(|curve| curve.is_of_rope())?;
    let whales = rope.asked.first().map_or(0, |asked| asked.parts.runs);
    let every = rope.asked.iter().map(|asked| short(&asked.parts));
    let mut rows = vec![row_of("all", whales, every)];
    if rope.asked.iter().any(|asked| asked.weighted.is_some()) {
        let cells = rope.asked.iter().map(|asked| weighted(asked.weighted));
        rows.push(row_of("all, weighted as observed", whales, cells));
    }
    rows.extend(kinds(&rope.by_route));
    Some(at_strengths(rope, "whales", rows))
}

/// Shares of held whales on which whole rope parts, by part of each input.
pub(super) fn strengths_by_input(all: &[StrengthCurve]) -> Option<Table> {
    let rope = all.iter().find(|curve| curve.is_of_rope())?;
    let rows: Vec<Vec<Cell>> = kinds(&rope.by_input).collect();
    (!rows.is_empty()).then(|| at_strengths(rope, "input", rows))
}

fn at_strengths(rope: &StrengthCurve, of: &str, rows: Vec<Vec<Cell>>) -> Table {
    let lbf = |asked: &AskedStrength| {
        format!("{} lbf", units::grouped(&format!("{:.0}", asked.strength_n / N_PER_LBF)))
    };
    let strengths: Vec<String> = rope.asked.iter().map(lbf).collect();
    let headings: Vec<&str> =
        [of, "number held"].into_iter().chain(strengths.iter().map(String::as_str)).collect();
    let caption = "Of the whales held if nothing parts: share on which whole rope parts if it delivers this strength";
    Table::new(caption, &headings, rows)
}

/// A row for each kind of held whale that occurred.
fn kinds(kinds: &[HeldKind]) -> impl Iterator<Item = Vec<Cell>> {
    kinds.iter().filter(|kind| kind.parts.iter().any(|rate| rate.runs > 0)).map(|kind| {
        let runs = kind.parts.first().map_or(0, |rate| rate.runs);
        row_of(&format!("{}: {}", kind.of, kind.name), runs, kind.parts.iter().map(short))
    })
}

fn row_of(name: &str, whales: u64, cells: impl Iterator<Item = Cell>) -> Vec<Cell> {
    [Cell::from(name.to_owned()), whales.to_string().into()].into_iter().chain(cells).collect()
}

/// `25 % [7, 59]`.
fn short(rate: &Rate) -> Cell {
    let [low, high] = [rate.interval.low, rate.interval.high].map(percent);
    format!("{} % [{low},\u{a0}{high}]", percent(rate.rate)).into()
}

/// Caption of the figure of [`curves`].
pub(super) fn curves_caption(all: &[StrengthCurve], beside: &Beside<'_>) -> String {
    let whales = all.iter().map(|curve| curve.parts_given_held.encounters);
    let noaa = match &beside.threats {
        Some(_) => {
            " NOAA's threat is a logistic curve fitted to the strengths of ropes that were taken off right whales; what it leaves to 1 is drawn, with \
             the range of its three curves. These whales had carried rope for days to months, the simulated ones for minutes."
        }
        None => "",
    };
    let held = match all.iter().any(|curve| !curve.held.is_empty()) {
        true => {
            " \"Still held\" is the rate of holding as a share of that of the greatest strength; between the strengths that were simulated it is \
             that of the nearest."
        }
        false => "",
    };
    let hauls = match beside.hauls {
        [] => "",
        _ => {
            " At the hauler: probability that a line that delivers this strength parts in one haul."
        }
    };
    format!(
        "Of the {} whales that are held if nothing can part: share in which the part parts if it delivers this strength, with a band that \
         contains the whole curve with a probability of 95 %. Every strength is known from the same runs.{held}{noaa}{hauls}",
        whales.max().unwrap_or_default()
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A curve of held whales that need from 0 to 4,000 lbf, evenly; rope of half their strength leaves them held.
    fn curve(part: &str, encounters: u64) -> StrengthCurve {
        let strengths_n: Vec<f64> =
            (4..=200).map(|step| f64::from(step) * 50.0 * N_PER_LBF).collect();
        let shares = || strengths_n.iter().map(|n| (1.0 - n / (4000.0 * N_PER_LBF)).max(0.0));
        let banded = || Banded {
            encounters,
            effective: encounters as f64,
            half_width: 0.17,
            shares: shares().collect(),
        };
        StrengthCurve {
            part: part.to_owned(),
            option: "unbreakable".to_owned(),
            parts: banded(),
            parts_given_held: banded(),
            held: shares().map(|parts| 0.06 * (1.0 - 0.5 * parts)).collect(),
            asked: Vec::new(),
            by_route: Vec::new(),
            by_input: Vec::new(),
            strengths_n: strengths_n.clone(),
        }
    }

    #[test]
    fn a_figure_has_a_band_for_each_part_and_none_of_few_whales() {
        let all =
            [curve("whole rope", 60), curve("weak link", 60), curve("other", LEAST_WHALES - 1)];
        let figure = curves(&all, &Beside::default()).unwrap();
        assert_eq!(figure.matches("<polygon").count(), 2);
        for words in ["whole rope parts", "still held, weak link", "100 %", "4000 lbf"] {
            assert!(figure.contains(words), "{words}");
        }
        assert!(!figure.contains("other"));
        assert_eq!(curves(&all[2..], &Beside::default()), None);
    }
}
