//! The figures of a report that are curves: greatest tensions, and break-away against strength.

use crate::study::stats::{Findings, OptionFinding};

use super::figures::WIDE;
use super::hauled::HauledLoad;
use super::words::N_PER_LBF;
use crate::page::svg::{Axis, Side, Svg};

/// Tensions named on the axis [N].
const NAMED_N: [f64; 8] = [10.0, 30.0, 100.0, 300.0, 1000.0, 3000.0, 10_000.0, 30_000.0];

/// Share of runs whose greatest tension stays below a value, by option; options with the same tensions share a curve.
pub(super) fn tensions(findings: &Findings) -> String {
    let groups = alike(&findings.options, |option| &option.tensions.sorted_n);
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

/// The look of a curve with the names of all that share it, beside the curves; answers where the next begins.
pub(super) fn legend(svg: &mut Svg, [x, mut y]: [f64; 2], kind: usize, names: &[&str]) -> f64 {
    svg.path(&[[x + 14.0, y], [x + 50.0, y]], kind);
    svg.mark([x + 32.0, y], kind);
    for name in names {
        svg.text([x + 58.0, y + 4.0], Side::Start, name);
        y += 20.0;
    }
    y + 8.0
}

/// Options told apart by what a curve is drawn from: the first of each kind with the names of all of it.
pub(super) fn alike<'a, T: PartialEq + 'a>(
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

/// Rate of parting against the strength an option stands for, a mark for each of its curves; the line is the share of the
/// baseline's runs that pull harder. Beside it, the probability of parting in each haul.
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
    scales(&mut svg, &across, &up);
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

/// What a strength is of.
fn curve(option: &OptionFinding) -> &str {
    option.curve.as_deref().unwrap_or("something parted")
}

/// Shares upwards, strengths across in both units.
fn scales(svg: &mut Svg, across: &Axis, up: &Axis) {
    let ([left, right], [bottom, _]) = (across.places, up.places);
    for tick in up.ticks() {
        svg.line([left, up.at(tick)], [right, up.at(tick)], "grid");
        svg.text([left - 6.0, up.at(tick) + 4.0], Side::End, &format!("{:.1} %", 100.0 * tick));
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
