//! The figures of two runs side by side, with their differences, as plain data.

use endline_sim::model::{Model, Whale};

use super::View::Compare;
use super::{
    Figure, LINE, Line, MOMENT, PART, Part, Quantity, Value, WHALE, lines as lines_of,
    parts as parts_of, shown,
};
use crate::live::LiveView;
use crate::units::Units;

/// Text in place of the difference where both runs have the same value.
pub const SAME: &str = "same";

/// One figure of both runs.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// Its name.
    pub name: String,
    /// Its meaning, in a sentence.
    pub help: &'static str,
    /// Of the run shown.
    pub a: String,
    /// Of the run it is compared with.
    pub b: String,
    /// A − B, the change since the run that was held; empty where one of them has no value.
    pub difference: String,
}

/// Rows under a head.
pub type Group = (&'static str, Vec<Row>);

/// Every figure that is compared of two runs, so far as each was run, in groups.
pub fn groups(a: &LiveView, b: &LiveView, units: Units) -> Vec<Group> {
    let whales = [a, b].map(|view| view.summary.as_ref()?.whale.as_ref());
    let whale = shown(WHALE, Compare).map(|figure| row(figure, whales, units, ""));
    let moment = shown(MOMENT, Compare).map(|figure| row(figure, [Some(a), Some(b)], units, ""));
    let whale = if whales == [None, None] { Vec::new() } else { whale.collect() };
    let all = [
        ("Set-up", set_up([a, b], units)),
        ("Whale", whale),
        ("Lines", lines([a, b], units)),
        ("Parts of the whale", parts([a, b], units)),
        ("At the moment shown", moment.collect()),
    ];
    all.into_iter().filter(|(_, rows)| !rows.is_empty()).collect()
}

/// Inputs of both runs: the animal always, and the others that differ.
fn set_up(views: [&LiveView; 2], units: Units) -> Vec<Row> {
    let rows = SET_UP.iter().map(|(figure, is_shown)| {
        let values = views.map(|view| (figure.read)(&view.model));
        let is_known = values.iter().any(|value| *value != Value::Absent);
        (is_known && (*is_shown || values[0] != values[1]))
            .then(|| row(figure, views.map(|view| Some(&*view.model)), units, ""))
    });
    rows.flatten().collect()
}

/// Inputs of a run, each with whether it is shown where it does not differ.
const SET_UP: [(Figure<Model>, bool); 8] = [
    (
        input("whale, length", "From the snout to the fluke notch", Quantity::Length, |model| {
            of_whale(model, |whale| whale.length_m.into())
        }),
        true,
    ),
    (
        input("whale, motion", "The plugin that moves the whale", Quantity::Name, |model| {
            of_whale(model, |whale| (&*whale.motion.descriptor().name).into())
        }),
        false,
    ),
    (
        input("whale, speed at the start", "Speed through the water", Quantity::Speed, |model| {
            of_whale(model, |whale| whale.speed_m_s.into())
        }),
        false,
    ),
    (
        input("whale feels the rope", "Whether rope moves the whale", Quantity::Flag, |model| {
            of_whale(model, |whale| whale.kinetic.is_some().into())
        }),
        false,
    ),
    (
        input("friction on skin", "The plugin of its law", Quantity::Name, |model| {
            let law = model.spec.friction.as_ref().and_then(|friction| friction.laws.first());
            law.map_or(Value::Absent, |law| (&*law.model.descriptor().name).into())
        }),
        false,
    ),
    (
        input("depth of the water", "At the origin", Quantity::Depth, |model| {
            model.spec.water.depth_m.into()
        }),
        true,
    ),
    (
        input("current", "At the surface, at the start", Quantity::Speed, |model| {
            model.spec.water.current.at(1.0, 0.0).length().into()
        }),
        true,
    ),
    (
        input("length of rope", "Of all lines, unstretched", Quantity::Length, |model| {
            let lines = model.spec.lines.iter();
            lines.flat_map(|line| &line.segments_m).sum::<f64>().into()
        }),
        true,
    ),
];

const fn input(
    label: &'static str,
    help: &'static str,
    quantity: Quantity,
    read: fn(&Model) -> Value,
) -> Figure<Model> {
    Figure::new("", label, help, quantity, read)
}

fn of_whale(model: &Model, read: fn(&Whale) -> Value) -> Value {
    model.spec.whale.as_ref().map_or(Value::Absent, read)
}

/// Lines of either run by id, in the order of the first.
fn lines(views: [&LiveView; 2], units: Units) -> Vec<Row> {
    let own = views.map(|view| {
        view.summary.as_ref().map(|summary| lines_of(summary, &[])).unwrap_or_default()
    });
    let mut ids: Vec<&String> = own[0].iter().map(|line| &line.summary.id).collect();
    for line in &own[1] {
        if !ids.contains(&&line.summary.id) {
            ids.push(&line.summary.id);
        }
    }
    let of_id = |lines: &'_ [Line], id: &str| lines.iter().position(|line| line.summary.id == id);
    let rows = |id: &String| {
        let pair = own.each_ref().map(|lines| of_id(lines, id).map(|index| &lines[index]));
        shown(LINE, Compare).map(|figure| row(figure, pair, units, id)).collect::<Vec<_>>()
    };
    ids.into_iter().flat_map(rows).collect()
}

/// Parts that rope touched in either run.
fn parts(views: [&LiveView; 2], units: Units) -> Vec<Row> {
    let own: [Vec<Part>; 2] = views.map(|view| {
        let whale = view.summary.as_ref().and_then(|summary| summary.whale.as_ref());
        whale.map(|whale| parts_of(whale, &view.frame.contacts)).unwrap_or_default()
    });
    let count = own.iter().map(Vec::len).max().unwrap_or_default();
    let rows = |index: usize| {
        let pair = own.each_ref().map(|parts| parts.get(index));
        let name = pair
            .iter()
            .flatten()
            .find(|part| !part.is_untouched())
            .map(|part| part.summary.part.name().replace('_', " "));
        let rows = |name: String| {
            let rows = shown(PART, Compare).map(|figure| row(figure, pair, units, &name));
            rows.collect::<Vec<_>>()
        };
        name.map(rows).unwrap_or_default()
    };
    (0..count).flat_map(rows).collect()
}

/// A figure of both runs; one of them may lack its source. `of` names the source where there are several.
fn row<S>(figure: &Figure<S>, sources: [Option<&S>; 2], units: Units, of: &str) -> Row {
    let [a, b] = sources.map(|source| source.map_or(Value::Absent, |source| (figure.read)(source)));
    let comma = if of.is_empty() { "" } else { ", " };
    let text = |value: &Value| figure.quantity.text(value, units);
    Row {
        name: format!("{of}{comma}{}", figure.label),
        help: figure.help,
        difference: difference(&a, &b, &text),
        a: text(&a),
        b: text(&b),
    }
}

/// A − B with its sign, and as a share of B where that means something.
fn difference(a: &Value, b: &Value, text: &impl Fn(&Value) -> String) -> String {
    let (Some(now), Some(held)) = (a.number(), b.number()) else {
        return match (a, b) {
            (Value::Absent, _) | (_, Value::Absent) => String::new(),
            _ if a == b => SAME.to_owned(),
            _ => "differs".to_owned(),
        };
    };
    let by = now - held;
    let unsigned = text(&Value::Number(by.abs()));
    if unsigned == text(&Value::Number(0.0)) {
        return SAME.to_owned();
    }
    let sign = if by < 0.0 { "−" } else { "+" };
    let share = 100.0 * by.abs() / held.abs();
    if share.is_finite() && share < 1000.0 {
        format!("{sign}{unsigned} ({sign}{share:.0} %)")
    } else {
        format!("{sign}{unsigned}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn differences_carry_their_sign_and_what_reads_alike_is_the_same() {
        let text = |value: &Value| Quantity::Force.text(value, Units::Si);
        let written = |a: Option<f64>, b: Option<f64>| difference(&a.into(), &b.into(), &text);
        assert_eq!(written(Some(250.0), Some(200.0)), "+50.0 N (+25 %)");
        assert_eq!(written(Some(60.0), Some(100.0)), "−40.0 N (−40 %)");
        assert_eq!(written(Some(100.0), Some(100.03)), SAME);
        assert_eq!(written(Some(5.0), Some(0.0)), "+5.0 N");
        assert_eq!(written(Some(5.0), None), "", "there is nothing to subtract from");
        assert_eq!(text(&Value::Absent), "–");
    }

    #[test]
    fn names_are_the_same_or_differ() {
        let text = |value: &Value| Quantity::Name.text(value, Units::Si);
        assert_eq!(difference(&"shed".into(), &"shed".into(), &text), SAME);
        assert_eq!(difference(&"shed".into(), &"entangled".into(), &text), "differs");
    }
}
