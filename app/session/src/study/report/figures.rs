//! The figures of a report.

use crate::study::stats::{Findings, Interval, LevelFinding, OptionFinding, Rate};

use super::svg::{Axis, Side, Svg};
use super::words::{N_PER_LBF, event_words};

/// Width of a figure.
const WIDE: f64 = 760.0;
/// Room for names at the left.
const NAMES: f64 = 190.0;
/// Height of a row.
const ROW: f64 = 26.0;

/// Rates of a few events by option, each with its interval.
pub(super) fn rates(findings: &Findings) -> String {
    let events = ["contact", "entangled", "parted"];
    let height = 74.0 + ROW * 1.6 * findings.options.len() as f64;
    let mut svg = Svg::new(WIDE, height, "Rates by option, given an encounter");
    let axis = Axis { values: [0.0, 1.0], places: [NAMES, WIDE - 20.0] };
    frame(&mut svg, &axis, height, |tick| format!("{:.0} %", 100.0 * tick));
    for (kind, event) in events.iter().enumerate() {
        let x = NAMES + 150.0 * kind as f64;
        svg.mark([x, 14.0], kind);
        svg.text([x + 10.0, 18.0], Side::Start, &event_words(event));
    }
    for (row, option) in findings.options.iter().enumerate() {
        let y = 46.0 + 1.6 * ROW * row as f64;
        svg.text([NAMES - 10.0, y + 4.0], Side::End, &option.name);
        for (kind, rate) in events.iter().enumerate().filter_map(|(kind, event)| Some((kind, option.rate(event)?))) {
            whisker(&mut svg, &axis, y + 8.0 * (kind as f64 - 1.0), rate, kind);
        }
    }
    svg.done()
}

fn whisker(svg: &mut Svg, axis: &Axis, y: f64, rate: &Rate, kind: usize) {
    let Interval { low, high } = rate.interval;
    svg.whisker(y, [axis.at(low), axis.at(rate.rate), axis.at(high)], kind);
}

/// Differences from the baseline of the rate that options are ranked by: all together, then by level.
pub(super) fn forest(findings: &Findings) -> String {
    type Row = (String, f64, Interval);
    let own = |option: &OptionFinding| -> Option<Row> {
        let paired = option.against(&findings.event)?;
        Some((option.name.clone(), paired.difference, paired.difference_interval))
    };
    let mut groups: Vec<(String, Vec<Row>)> = vec![("all encounters".into(), findings.options.iter().filter_map(own).collect())];
    for LevelFinding { level, against, .. } in &findings.levels {
        let rows = findings
            .options
            .iter()
            .zip(against)
            .map(|(option, paired)| (option.name.clone(), paired.difference, paired.difference_interval));
        groups.push((level.clone(), rows.collect()));
    }
    for (_, rows) in &mut groups {
        *rows = std::mem::take(rows).into_iter().enumerate().filter(|(index, _)| *index != findings.baseline).map(|(_, row)| row).collect();
    }
    let count = groups.iter().map(|(_, rows)| rows.len() + 1).sum::<usize>();
    let height = 60.0 + ROW * count as f64;
    let widest =
        groups.iter().flat_map(|(_, rows)| rows).map(|(_, _, interval)| interval.low.abs().max(interval.high.abs())).fold(0.02, f64::max);
    let mut svg = Svg::new(WIDE, height, "Difference of rates from the baseline, with intervals");
    let axis = Axis { values: [-widest, widest], places: [NAMES, WIDE - 20.0] };
    frame(&mut svg, &axis, height, |tick| format!("{:+.1}", 100.0 * tick));
    svg.line([axis.at(0.0), 10.0], [axis.at(0.0), height - 34.0], "zero");
    let mut y = 24.0;
    for (kind, (name, rows)) in groups.into_iter().enumerate() {
        svg.text([6.0, y], Side::Start, &name);
        y += ROW;
        for (option, difference, Interval { low, high }) in rows {
            svg.text([NAMES - 10.0, y + 4.0], Side::End, &option);
            svg.whisker(y, [axis.at(low), axis.at(difference), axis.at(high)], kind);
            y += ROW;
        }
    }
    svg.done()
}

/// Vertical lines with their values below.
fn frame(svg: &mut Svg, axis: &Axis, height: f64, words: impl Fn(f64) -> String) {
    for tick in axis.ticks() {
        svg.line([axis.at(tick), 28.0], [axis.at(tick), height - 34.0], "grid");
        svg.text([axis.at(tick), height - 18.0], Side::Middle, &words(tick));
    }
}

/// Share of runs whose greatest tension stays below a value, by option.
pub(super) fn tensions(findings: &Findings) -> String {
    let (height, top, bottom) = (380.0, 20.0, 320.0);
    let most = findings.options.iter().filter_map(|option| option.tensions.quantile_n(1.0)).fold(1.0, f64::max);
    let mut svg = Svg::new(WIDE, height, "Distribution of the greatest tension, by option");
    let across = Axis { values: [0.0, (1.0 + most).log10()], places: [60.0, WIDE - 210.0] };
    let up = Axis { values: [0.0, 1.0], places: [bottom, top] };
    for share in [0.0, 0.25, 0.5, 0.75, 1.0] {
        svg.line([60.0, up.at(share)], [WIDE - 210.0, up.at(share)], "grid");
        svg.text([54.0, up.at(share) + 4.0], Side::End, &format!("{:.0} %", 100.0 * share));
    }
    for tension_n in
        [1.0_f64, 3.0, 10.0, 30.0, 100.0, 300.0, 1000.0, 3000.0, 10_000.0, 30_000.0].into_iter().filter(|tension| *tension <= most)
    {
        let x = across.at((1.0 + tension_n).log10());
        svg.line([x, top], [x, bottom], "grid");
        svg.text([x, bottom + 18.0], Side::Middle, &format!("{tension_n} N"));
        svg.text([x, bottom + 34.0], Side::Middle, &format!("{:.1} lbf", tension_n / N_PER_LBF));
    }
    for (kind, option) in findings.options.iter().enumerate() {
        let count = option.tensions.sorted_n.len().max(1) as f64;
        let step = |(index, tension): (usize, &f64)| {
            let x = across.at((1.0 + tension).log10());
            [[x, up.at(index as f64 / count)], [x, up.at((index + 1) as f64 / count)]]
        };
        svg.path(&option.tensions.sorted_n.iter().enumerate().flat_map(step).collect::<Vec<_>>(), kind);
        let y = top + 20.0 * kind as f64 + 6.0;
        svg.path(&[[WIDE - 196.0, y], [WIDE - 160.0, y]], kind);
        svg.text([WIDE - 154.0, y + 4.0], Side::Start, &option.name);
    }
    svg.done()
}

/// Rate of parting against the strength an option stands for; the line is the share of the baseline's runs that pull harder.
pub(super) fn break_away(findings: &Findings) -> Option<String> {
    let rated: Vec<(f64, &OptionFinding)> = findings.options.iter().filter_map(|option| Some((option.strength_n?, option))).collect();
    if rated.len() < 2 {
        return None;
    }
    let (height, bottom) = (340.0, 280.0);
    let most_n = 1.15 * rated.iter().map(|(strength, _)| *strength).fold(0.0, f64::max);
    let baseline = &findings.options[findings.baseline].tensions;
    let highest = rated.iter().filter_map(|(_, option)| Some(option.rate("parted")?.interval.high)).fold(0.02, f64::max);
    let mut svg = Svg::new(WIDE, height, "Rate of parting against strength");
    let across = Axis { values: [0.0, most_n / N_PER_LBF], places: [70.0, WIDE - 20.0] };
    let up = Axis { values: [0.0, highest], places: [bottom, 20.0] };
    for tick in up.ticks() {
        svg.line([70.0, up.at(tick)], [WIDE - 20.0, up.at(tick)], "grid");
        svg.text([64.0, up.at(tick) + 4.0], Side::End, &format!("{:.1} %", 100.0 * tick));
    }
    for tick in across.ticks() {
        svg.text([across.at(tick), bottom + 18.0], Side::Middle, &format!("{tick:.0} lbf"));
        svg.text([across.at(tick), bottom + 34.0], Side::Middle, &format!("{:.1} kN", tick * N_PER_LBF / 1000.0));
    }
    let curve = (1..=200)
        .map(|index| most_n * f64::from(index) / 200.0)
        .map(|strength| [across.at(strength / N_PER_LBF), up.at(baseline.share_above(strength))]);
    svg.path(&curve.collect::<Vec<_>>(), 1);
    for (strength, rate) in rated.iter().filter_map(|(strength, option)| Some((*strength, option.rate("parted")?))) {
        let x = across.at(strength / N_PER_LBF);
        svg.line([x, up.at(rate.interval.low)], [x, up.at(rate.interval.high)], "bar");
        svg.mark([x, up.at(rate.rate)], 0);
    }
    Some(svg.done())
}

/// The least and greatest rate over the parts of each input.
pub(super) fn tornado(findings: &Findings) -> Option<String> {
    let inputs: Vec<_> = findings.inputs.iter().take(12).collect();
    if inputs.is_empty() {
        return None;
    }
    let height = 50.0 + 1.7 * ROW * inputs.len() as f64;
    let most = inputs.iter().flat_map(|input| &input.parts).map(|part| part.rate.rate).fold(0.02, f64::max);
    let mut svg = Svg::new(WIDE, height, "Rate by parts of each input, greatest effect first");
    let axis = Axis { values: [0.0, 1.1 * most], places: [NAMES, WIDE - 60.0] };
    frame(&mut svg, &axis, height, |tick| format!("{:.1} %", 100.0 * tick));
    for (row, input) in inputs.iter().enumerate() {
        let y = 40.0 + 1.7 * ROW * row as f64;
        let mut parts: Vec<_> = input.parts.iter().filter(|part| part.rate.runs > 0).collect();
        parts.sort_by(|one, other| one.rate.rate.total_cmp(&other.rate.rate));
        let (Some(least), Some(most)) = (parts.first(), parts.last()) else { continue };
        let (from, to) = (axis.at(least.rate.rate), axis.at(most.rate.rate));
        svg.bar([from, y - 7.0], [(to - from).max(1.0), 14.0], 0);
        svg.text([NAMES - 10.0, y + 4.0], Side::End, &input.name.replace('_', " "));
        svg.text([from, y + 20.0], Side::End, &least.name);
        svg.text([to, y + 20.0], Side::Start, &most.name);
    }
    Some(svg.done())
}
