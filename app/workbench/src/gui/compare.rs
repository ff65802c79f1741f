//! Key figures of two runs and their differences, as plain data.

use endline_sdk::BodyPart;
use endline_session::live::LiveView;
use endline_session::units::Units;
use endline_sim::metrics::{RegionSummary, WhaleSummary};

use super::widgets::words::spoken;

/// One figure of both runs.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// What it is.
    pub name: String,
    /// Of the run shown.
    pub a: String,
    /// Of the run it is compared with.
    pub b: String,
    /// B less A; empty where the two have no difference to tell.
    pub difference: String,
}

/// Rows under a head.
pub type Group = (&'static str, Vec<Row>);

/// Every figure of two runs, so far as each was run, in groups.
#[must_use]
pub fn groups(a: &LiveView, b: &LiveView, units: Units) -> Vec<Group> {
    let all = [
        ("Whale", whale(a, b, units)),
        ("Peak tension of each line", lines(a, b, units)),
        ("Most on each part", parts(a, b, units)),
    ];
    let now = ("At the moment shown", now(a, b, units));
    all.into_iter().chain([now]).filter(|(_, rows)| !rows.is_empty()).collect()
}

/// A figure that one of the runs may lack; `text` writes it with its unit.
fn row(name: impl Into<String>, figures: [Option<f64>; 2], text: impl Fn(f64) -> String) -> Row {
    let [a, b] = figures.map(|figure| figure.filter(|value| value.is_finite()));
    let shown = |value: Option<f64>| value.map_or_else(|| "–".to_owned(), &text);
    let difference = a.zip(b).map_or_else(String::new, |(a, b)| difference(a, b, &text));
    Row { name: name.into(), a: shown(a), b: shown(b), difference }
}

/// With its sign, and as a share of A where that says something.
fn difference(a: f64, b: f64, text: &impl Fn(f64) -> String) -> String {
    let by = b - a;
    let unsigned = text(by.abs());
    if unsigned == text(0.0) {
        return "same".to_owned();
    }
    let sign = if by < 0.0 { "−" } else { "+" };
    let share = 100.0 * by.abs() / a.abs();
    if share.is_finite() && share < 1000.0 {
        format!("{sign}{unsigned} ({sign}{share:.0} %)")
    } else {
        format!("{sign}{unsigned}")
    }
}

fn of(view: &LiveView) -> Option<&WhaleSummary> {
    view.summary.as_ref()?.whale.as_ref()
}

fn whale(a: &LiveView, b: &LiveView, units: Units) -> Vec<Row> {
    let pair = [of(a), of(b)];
    let figure =
        |name: &str, pick: fn(&WhaleSummary) -> Option<f64>, text: &dyn Fn(f64) -> String| {
            row(name, pair.map(|whale| pick(whale?)), text)
        };
    let seconds = |value: f64| format!("{value:.2} s");
    let [first, second] = pair
        .map(|whale| whale.map_or_else(|| "–".to_owned(), |whale| spoken(whale.outcome.name())));
    let difference = if first == second { "same" } else { "differs" }.to_owned();
    let mut rows = vec![Row { name: "Outcome".into(), a: first, b: second, difference }];
    rows.push(figure("First contact", |whale| whale.first_contact_s, &seconds));
    rows.push(figure("Time in contact", |whale| Some(whale.contact_time_s), &seconds));
    rows.push(figure("Added drag, mean of 5 s", |whale| Some(whale.drag_added_n), &|value| {
        units.force().text(value)
    }));
    rows.push(figure("Trailing rope", |whale| Some(whale.trailing_m), &|value| {
        units.length(value)
    }));
    rows.push(figure("Tethered rope", |whale| Some(whale.tethered_m), &|value| {
        units.length(value)
    }));
    if pair.iter().all(Option::is_none) { Vec::new() } else { rows }
}

/// Lines of either run by id, in A's order.
fn lines(a: &LiveView, b: &LiveView, units: Units) -> Vec<Row> {
    let ids = |view: &LiveView| {
        view.model.spec.lines.iter().map(|line| line.id.clone()).collect::<Vec<_>>()
    };
    let (mut all, others) = (ids(a), ids(b));
    all.extend(others.into_iter().filter(|id| !ids(a).contains(id)));
    let peak = |view: &LiveView, id: &str| {
        let summary = view.summary.as_ref()?;
        Some(summary.lines.iter().find(|line| line.id == id)?.peak_tension_n)
    };
    all.into_iter()
        .map(|id| row(&id, [peak(a, &id), peak(b, &id)], |value| units.force().text(value)))
        .collect()
}

/// Greatest force and most wraps on each part that either run touched.
fn parts(a: &LiveView, b: &LiveView, units: Units) -> Vec<Row> {
    let region = |view: &LiveView, part: BodyPart| -> Option<RegionSummary> {
        let whale = view.summary.as_ref()?.whale.as_ref()?;
        whale.regions.iter().find(|region| region.part == part).cloned()
    };
    let mut rows = Vec::new();
    for part in BodyPart::ALL {
        let both = [region(a, part), region(b, part)];
        if both.iter().flatten().all(|region| region.peak_contact_length_m <= 0.0) {
            continue;
        }
        let name = spoken(part.name());
        let pick = |pick: fn(&RegionSummary) -> f64| {
            both.each_ref().map(|region| region.as_ref().map(pick))
        };
        rows.push(row(format!("{name}, force"), pick(|region| region.peak_normal_n), |value| {
            units.force().text(value)
        }));
        rows.push(row(format!("{name}, wraps"), pick(|region| region.peak_wraps), |value| {
            format!("{value:.2}")
        }));
    }
    rows
}

fn now(a: &LiveView, b: &LiveView, units: Units) -> Vec<Row> {
    let whale = |pick: fn(&endline_sim::frame::WhaleFrame) -> f64| {
        [a, b].map(|view| view.frame.whale.as_ref().map(pick))
    };
    let worst = [a, b].map(|view| view.frame.tension_n.iter().copied().reduce(f64::max));
    vec![
        row("Time", [a, b].map(|view| Some(view.frame.time_s)), |value| format!("{value:.2} s")),
        row("Greatest tension", worst, |value| units.force().text(value)),
        row("Depth of the whale", whale(|whale| -whale.position.z), |value| units.depth(value)),
        row("Its speed", whale(|whale| whale.speed_m_s), |value| units.speed(value)),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn differences_carry_their_sign_and_what_reads_alike_is_the_same() {
        let newton = |value: f64| format!("{value:.0} N");
        let told = |a: Option<f64>, b: Option<f64>| row("x", [a, b], newton).difference;
        assert_eq!(told(Some(100.0), Some(125.0)), "+25 N (+25 %)");
        assert_eq!(told(Some(100.0), Some(60.0)), "−40 N (−40 %)");
        assert_eq!(told(Some(100.0), Some(100.3)), "same");
        assert_eq!(told(Some(0.0), Some(5.0)), "+5 N");
        assert_eq!(told(None, Some(5.0)), "", "nothing to take away from");
        assert_eq!(row("x", [None, Some(5.0)], newton).a, "–");
    }
}
