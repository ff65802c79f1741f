//! The figures of a report that set rates in rows: by option, against the baseline, by input.

use endline_gear::StudyEvent;

use crate::study::stats::{Findings, Interval, LevelFinding, OptionFinding, Rate};

use crate::page::svg::{Axis, Side, Svg};

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
            whisker(&mut svg, &axis, y + 8.0 * (kind as f64 - 1.0), rate, kind);
        }
    }
    svg.done()
}

/// Room that the names of the options take at the left.
fn room(findings: &Findings) -> f64 {
    let letters = findings.options.iter().map(|option| option.name.chars().count()).max();
    (LETTER * letters.unwrap_or(0) as f64 + 20.0).clamp(90.0, 0.5 * WIDE)
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
    let mut groups: Vec<(String, Vec<Row>)> =
        vec![("all encounters".into(), findings.options.iter().filter_map(own).collect())];
    for LevelFinding { level, against, .. } in &findings.levels {
        let rows = findings.options.iter().zip(against).map(|(option, paired)| {
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
