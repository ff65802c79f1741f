//! The figures of a report: rates in rows, by option, against the baseline and by input; curves of tension and of break-away.

use endline_gear::StudyEvent;

use crate::study::stats::{Findings, Interval, LevelFinding, OptionFinding};

use crate::page::svg::{Axis, Side, Svg};
use crate::units::N_PER_LBF;

use super::hauled::HauledLoad;

/// Width of a figure.
pub(super) const WIDE: f64 = 760.0;
/// Room for the names of inputs at the left.
const NAMES: f64 = 190.0;
/// Width of a letter of a name, on average.
const LETTER: f64 = 7.2;
/// Height of a row.
const ROW: f64 = 26.0;

/// Rates of a few events by option, each with its interval.
pub(super) fn rates(findings: &Findings) -> String {
    let events = StudyEvent::of_the_chart();
    let height = 74.0 + ROW * 1.6 * findings.options.len() as f64;
    let mut svg = Svg::new(WIDE, height, "Rates by option, given an encounter");
    let names = room(findings);
    let axis = Axis { values: [0.0, 1.0], places: [names, WIDE - 20.0] };
    frame(&mut svg, &axis, height, |tick| format!("{:.0} %", 100.0 * tick));
    for (kind, event) in events.iter().enumerate() {
        let x = 12.0 + (WIDE - 20.0) / events.len() as f64 * kind as f64;
        svg.mark([x, 14.0], kind);
        svg.text([x + 10.0, 18.0], Side::Start, &event.words());
    }
    for (row, option) in findings.options.iter().enumerate() {
        let y = 46.0 + 1.6 * ROW * row as f64;
        svg.text([names - 10.0, y + 4.0], Side::End, &option.name);
        let rate = |(kind, event): (usize, &StudyEvent)| Some((kind, option.rate(&event.name())?));
        for (kind, rate) in events.iter().enumerate().filter_map(rate) {
            let Interval { low, high } = rate.interval;
            let places = [low, rate.rate, high].map(|share| axis.at(share));
            svg.whisker(y + 8.0 * (kind as f64 - 1.0), places, kind);
        }
    }
    svg.done()
}

/// Room that the names of the options take at the left.
fn room(findings: &Findings) -> f64 {
    let letters = findings.options.iter().map(|option| option.name.chars().count()).max();
    (LETTER * letters.unwrap_or(0) as f64 + 20.0).clamp(90.0, 0.5 * WIDE)
}

/// Differences from the baseline of the rate that options are ranked by: all together, then by level.
pub(super) fn forest(findings: &Findings) -> String {
    type Row = (String, f64, Interval);
    let own = |option: &OptionFinding| -> Option<Row> {
        let paired = option.against(&findings.event)?;
        Some((option.name.clone(), paired.difference, paired.difference_interval))
    };
    let mut groups: Vec<(String, Vec<Row>)> =
        vec![("all encounters".into(), findings.options.iter().filter_map(own).collect())];
    for LevelFinding { level, against, .. } in &findings.levels {
        let known = findings.options.iter().zip(against).filter(|(_, pair)| pair.encounters > 0);
        let rows = known.map(|(option, paired)| {
            (option.name.clone(), paired.difference, paired.difference_interval)
        });
        groups.push((level.clone(), rows.collect()));
    }
    for (_, rows) in &mut groups {
        *rows = std::mem::take(rows)
            .into_iter()
            .enumerate()
            .filter(|(index, _)| *index != findings.baseline)
            .map(|(_, row)| row)
            .collect();
    }
    let count = groups.iter().map(|(_, rows)| rows.len() + 1).sum::<usize>();
    let height = 80.0 + ROW * count as f64;
    let widest = groups
        .iter()
        .flat_map(|(_, rows)| rows)
        .map(|(_, _, interval)| interval.low.abs().max(interval.high.abs()))
        .fold(0.02, f64::max);
    let mut svg = Svg::new(WIDE, height, "Difference of rates from the baseline, with intervals");
    let names = room(findings);
    let axis = Axis { values: [-widest, widest], places: [names, WIDE - 20.0] };
    frame(&mut svg, &axis, height, |tick| format!("{:+.1}", 100.0 * tick + 0.0));
    svg.text([axis.at(0.0) - 12.0, 18.0], Side::End, "\u{2190} fewer than the baseline");
    svg.text([axis.at(0.0) + 12.0, 18.0], Side::Start, "more \u{2192}");
    svg.text(
        [axis.at(0.0), height - 2.0],
        Side::Middle,
        "difference of the rates, percentage points",
    );
    svg.line([axis.at(0.0), 10.0], [axis.at(0.0), height - 34.0], "zero");
    let mut y = 40.0;
    for (kind, (name, rows)) in groups.into_iter().enumerate() {
        svg.heading([6.0, y], &name);
        y += ROW;
        for (option, difference, Interval { low, high }) in rows {
            svg.text([names - 10.0, y + 4.0], Side::End, &option);
            svg.whisker(y, [axis.at(low), axis.at(difference), axis.at(high)], kind);
            y += ROW;
        }
    }
    svg.done()
}

/// Vertical lines with their values below.
pub(super) fn frame(svg: &mut Svg, axis: &Axis, height: f64, words: impl Fn(f64) -> String) {
    for tick in axis.ticks() {
        svg.line([axis.at(tick), 28.0], [axis.at(tick), height - 34.0], "grid");
        svg.text([axis.at(tick), height - 18.0], Side::Middle, &words(tick));
    }
}

/// The least and greatest rate over the parts of each input.
pub(super) fn tornado(findings: &Findings) -> Option<String> {
    let inputs: Vec<_> = findings.inputs.iter().take(12).collect();
    if inputs.is_empty() {
        return None;
    }
    let height = 70.0 + ROW * inputs.len() as f64;
    let most = inputs
        .iter()
        .flat_map(|input| &input.parts)
        .map(|part| part.rate.rate)
        .fold(0.02, f64::max);
    let mut svg = Svg::new(
        WIDE,
        height,
        "Rate with the baseline by parts of each input, greatest effect first",
    );
    let axis = Axis { values: [0.0, 1.1 * most], places: [NAMES + 90.0, WIDE - 110.0] };
    frame(&mut svg, &axis, height, |tick| format!("{:.0} %", 100.0 * tick));
    for (row, input) in inputs.iter().enumerate() {
        let y = 44.0 + ROW * row as f64;
        let mut parts: Vec<_> = input.parts.iter().filter(|part| part.rate.runs > 0).collect();
        parts.sort_by(|one, other| one.rate.rate.total_cmp(&other.rate.rate));
        let (Some(least), Some(most)) = (parts.first(), parts.last()) else { continue };
        let (from, to) = (axis.at(least.rate.rate), axis.at(most.rate.rate));
        svg.bar([from, y - 7.0], [(to - from).max(1.0), 14.0], 0);
        svg.heading([6.0, y + 4.0], &input.words);
        svg.text([from - 6.0, y + 4.0], Side::End, &least.name);
        svg.text([to + 6.0, y + 4.0], Side::Start, &most.name);
    }
    Some(svg.done())
}

/// Tensions with a label on the axis [N].
const NAMED_N: [f64; 8] = [10.0, 30.0, 100.0, 300.0, 1000.0, 3000.0, 10_000.0, 30_000.0];

/// Share of runs whose greatest tension stays below a value, by option; options with the same tensions share a curve.
pub(super) fn tensions(findings: &Findings) -> String {
    let groups = grouped(&findings.options, |option| &option.tensions.sorted_n);
    let (top, bottom, right): (f64, f64, f64) = (20.0, 330.0, WIDE - 230.0);
    let height = (bottom + 62.0).max(
        top + 20.0 * groups.iter().map(|(_, names)| names.len() as f64 + 0.4).sum::<f64>() + 10.0,
    );
    let most = findings
        .options
        .iter()
        .filter_map(|option| option.tensions.quantile_n(1.0))
        .fold(1.0, f64::max);
    let mut svg = Svg::new(WIDE, height, "Distribution of the greatest tension, by option");
    let across = Axis { values: [1.0, (1.2 * most).max(100.0).log10()], places: [60.0, right] };
    let up = Axis { values: [0.0, 1.0], places: [bottom, top] };
    for share in [0.0, 0.25, 0.5, 0.75, 1.0] {
        svg.line([60.0, up.at(share)], [right, up.at(share)], "grid");
        svg.text([54.0, up.at(share) + 4.0], Side::End, &format!("{:.0} %", 100.0 * share));
    }
    for tension_n in NAMED_N.into_iter().filter(|tension| *tension <= (1.2 * most).max(100.0)) {
        let x = across.at(tension_n.log10());
        svg.line([x, top], [x, bottom], "grid");
        svg.text([x, bottom + 18.0], Side::Middle, &format!("{tension_n} N"));
        svg.text([x, bottom + 34.0], Side::Middle, &format!("{:.0} lbf", tension_n / N_PER_LBF));
    }
    svg.text(
        [0.5 * (60.0 + right), bottom + 54.0],
        Side::Middle,
        "greatest tension of a run (each step to the right: about three times more)",
    );
    let mut y = top + 6.0;
    for (kind, (option, names)) in groups.into_iter().enumerate() {
        let sorted_n = &option.tensions.sorted_n;
        let shares = shares_below(sorted_n);
        let place =
            |share: f64, tension_n: f64| [across.at(tension_n.max(1e-9).log10()), up.at(share)];
        let steps = sorted_n
            .iter()
            .zip(shares.windows(2))
            .flat_map(|((tension, _), ends)| [place(ends[0], *tension), place(ends[1], *tension)]);
        svg.path(&steps.collect::<Vec<_>>(), kind);
        for tenth in (0..10).map(|tenth| tenth * sorted_n.len() / 10 + kind * sorted_n.len() / 100)
        {
            if let Some((tension, _)) = sorted_n.get(tenth) {
                svg.mark(place(shares[tenth], *tension), kind);
            }
        }
        y = legend(&mut svg, [right, y], kind, &names);
    }
    svg.done()
}

/// Share of the weight of all runs before each of them, and 1 at the end.
fn shares_below(sorted_n: &[(f64, f64)]) -> Vec<f64> {
    let all: f64 = sorted_n.iter().map(|(_, weight)| weight).sum();
    let mut below = 0.0;
    let mut shares = vec![0.0];
    for (_, weight) in sorted_n {
        below += weight / all.max(f64::MIN_POSITIVE);
        shares.push(below);
    }
    shares
}

/// The legend of a curve with the names of all options that share it; returns the place of the next.
pub(super) fn legend(svg: &mut Svg, [x, mut y]: [f64; 2], kind: usize, names: &[&str]) -> f64 {
    svg.path(&[[x + 14.0, y], [x + 50.0, y]], kind);
    svg.mark([x + 32.0, y], kind);
    for name in names {
        svg.text([x + 58.0, y + 4.0], Side::Start, name);
        y += 20.0;
    }
    y + 8.0
}

/// Options grouped by the data of their curves: the first of each group with the names of all.
pub(super) fn grouped<'a, T: PartialEq + 'a>(
    options: &'a [OptionFinding],
    of: impl Fn(&'a OptionFinding) -> &'a T,
) -> Vec<(&'a OptionFinding, Vec<&'a str>)> {
    let mut groups: Vec<(&OptionFinding, Vec<&str>)> = Vec::new();
    for option in options {
        match groups.iter_mut().find(|(first, _)| of(first) == of(option)) {
            Some((_, names)) => names.push(&option.name),
            None => groups.push((option, vec![&option.name])),
        }
    }
    groups
}

/// Rate of parting against the strength of an option, with a mark for each of its curves. The line is the share of the baseline's runs
/// with a greater tension; further lines are the probability of parting in each haul.
pub(super) fn break_away(findings: &Findings, hauls: &[HauledLoad]) -> Option<String> {
    let rated: Vec<(f64, &OptionFinding)> =
        findings.options.iter().filter_map(|option| Some((option.strength_n?, option))).collect();
    if rated.len() < 2 {
        return None;
    }
    let mut curves: Vec<&str> = rated.iter().map(|(_, option)| curve(option)).collect();
    curves.dedup();
    let legends = 20.0 * hauls.len() as f64;
    let (height, top, bottom) = (382.0 + legends, 44.0 + legends, 310.0 + legends);
    let most_n = 1.15 * rated.iter().map(|(strength, _)| *strength).fold(0.0, f64::max);
    let highest = rated
        .iter()
        .filter_map(|(_, option)| Some(option.rate("parted")?.interval.high))
        .fold(0.02, f64::max);
    let mut svg = Svg::new(WIDE, height, "Rate of parting against strength");
    let across = Axis { values: [0.0, most_n / N_PER_LBF], places: [70.0, WIDE - 30.0] };
    let up = Axis { values: [0.0, highest], places: [bottom, top] };
    break_away_scales(&mut svg, &across, &up);
    let baseline = &findings.options[findings.baseline].tensions;
    let places = (1..=400)
        .map(|index| most_n * f64::from(index) / 400.0)
        .filter(|strength| baseline.share_above(*strength) <= highest);
    let line = places
        .map(|strength| [across.at(strength / N_PER_LBF), up.at(baseline.share_above(strength))]);
    svg.path(&line.collect::<Vec<_>>(), curves.len());
    for (place, haul) in hauls.iter().enumerate() {
        let kind = curves.len() + 1 + place;
        let strengths = (1..=400).map(|index| most_n * f64::from(index) / 400.0);
        let line = strengths
            .map(|strength| (strength, haul.parts(strength)))
            .filter(|(_, share)| *share <= highest)
            .map(|(strength, share)| [across.at(strength / N_PER_LBF), up.at(share)]);
        svg.path(&line.collect::<Vec<_>>(), kind);
        let y = 36.0 + 20.0 * place as f64;
        svg.path(&[[70.0, y], [106.0, y]], kind);
        svg.text([112.0, y + 4.0], Side::Start, &haul.name);
    }
    for (kind, name) in curves.iter().enumerate() {
        let x = 70.0 + 220.0 * kind as f64;
        svg.mark([x, 16.0], kind);
        svg.text([x + 10.0, 20.0], Side::Start, name);
        let own = rated.iter().filter(|(_, option)| curve(option) == *name);
        for (strength, rate) in
            own.filter_map(|(strength, option)| Some((*strength, option.rate("parted")?)))
        {
            // Beside each other where two curves have an option of one strength.
            let x = across.at(strength / N_PER_LBF) + 9.0 * kind as f64;
            svg.post(
                x,
                [rate.interval.low, rate.rate, rate.interval.high].map(|rate| up.at(rate)),
                kind,
            );
        }
    }
    Some(svg.done())
}

/// The curve of an option.
fn curve(option: &OptionFinding) -> &str {
    option.curve.as_deref().unwrap_or("something parted")
}

/// Shares upwards, strengths across in both units.
pub(super) fn break_away_scales(svg: &mut Svg, across: &Axis, up: &Axis) {
    let ([left, right], [bottom, _]) = (across.places, up.places);
    for tick in up.ticks() {
        svg.line([left, up.at(tick)], [right, up.at(tick)], "grid");
        let decimals = usize::from(up.values[1] < 0.5);
        let words = format!("{:.decimals$} %", 100.0 * tick);
        svg.text([left - 6.0, up.at(tick) + 4.0], Side::End, &words);
    }
    for tick in across.ticks() {
        svg.text([across.at(tick), bottom + 18.0], Side::Middle, &format!("{tick:.0} lbf"));
        svg.text(
            [across.at(tick), bottom + 34.0],
            Side::Middle,
            &format!("{:.1} kN", tick * N_PER_LBF / 1000.0),
        );
    }
    svg.text([0.5 * (left + right), bottom + 54.0], Side::Middle, "strength");
}
