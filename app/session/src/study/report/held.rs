//! Duration of holding: share of touched whales still held, by time since first contact, as a table and as curves.

use crate::study::stats::{Findings, OptionFinding, Survival};

use super::figures::{WIDE, grouped, legend};
use super::words::percent_interval;
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
