//! The declaration of a figure; figures of the moment shown.

use endline_sim::frame::WhaleFrame;

use super::View::Compare;
use super::{Quantity, Value};
use crate::live::LiveView;

/// A view that shows some of the figures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum View {
    /// The tables of the command line.
    Table,
    /// The panel Summary.
    Summary,
    /// The panel Entanglement.
    Entanglement,
    /// The comparison of two runs.
    Compare,
}

/// The column of a figure in a study's table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Column {
    /// Columns stand in the order of these numbers; those of parts stand together, part by part.
    pub place: u16,
    /// Name of the column; that of a part stands behind the part's name.
    pub name: &'static str,
}

/// A figure of a source such as a line, a part of the whale or a run.
#[derive(Clone, Copy, Debug)]
pub struct Figure<S> {
    /// Key in JSON; ends in the unit where there is one.
    pub key: &'static str,
    /// Label on screen and in printed tables, in lower case.
    pub label: &'static str,
    /// Its meaning, in a sentence.
    pub help: &'static str,
    /// The kind of quantity, which decides unit and format.
    pub quantity: Quantity,
    /// Whether the JSON summary has it.
    pub in_json: bool,
    /// The other views that show it.
    pub views: &'static [View],
    /// Its column in a study's table.
    pub column: Option<Column>,
    /// Whether a value other than none, zero or no asks for attention.
    pub alarm: bool,
    /// Whether panels leave it out where it is none, zero or no.
    pub if_any: bool,
    /// Reads its value.
    pub read: fn(&S) -> Value,
}

impl<S> Figure<S> {
    /// A figure that stands in the JSON summary alone.
    pub(crate) const fn new(
        key: &'static str,
        label: &'static str,
        help: &'static str,
        quantity: Quantity,
        read: fn(&S) -> Value,
    ) -> Self {
        Self {
            key,
            label,
            help,
            quantity,
            in_json: true,
            views: &[],
            column: None,
            alarm: false,
            if_any: false,
            read,
        }
    }

    /// Shown by these views too.
    pub(crate) const fn shown(self, views: &'static [View]) -> Self {
        Self { views, ..self }
    }

    /// In a study's table under its own key.
    pub(crate) const fn column(self, place: u16) -> Self {
        let name = self.key;
        self.column_named(place, name)
    }

    /// In a study's table under another name.
    pub(crate) const fn column_named(self, place: u16, name: &'static str) -> Self {
        Self { column: Some(Column { place, name }), ..self }
    }

    /// Not in the JSON summary.
    pub(crate) const fn not_in_json(self) -> Self {
        Self { in_json: false, ..self }
    }

    /// Asks for attention where it is not none, zero or no.
    pub(crate) const fn alarming(self) -> Self {
        Self { alarm: true, ..self }
    }

    /// Left out by panels where it is none, zero or no.
    pub(crate) const fn if_any(self) -> Self {
        Self { if_any: true, ..self }
    }

    /// Whether a view shows it.
    pub fn is_in(&self, view: View) -> bool {
        self.views.contains(&view)
    }

    /// Whether its value asks for attention.
    pub fn alarms(&self, source: &S) -> bool {
        self.alarm && self.says_something(source)
    }

    /// Whether a panel has something to say by it.
    pub fn is_shown(&self, source: &S) -> bool {
        !self.if_any || self.says_something(source)
    }

    /// Whether its value is other than none, zero or no.
    fn says_something(&self, source: &S) -> bool {
        match (self.read)(source) {
            Value::Absent | Value::Flag(false) | Value::Whole(0) => false,
            Value::Number(number) => number.abs() > 0.0,
            _ => true,
        }
    }
}

/// The figures of a list that a view shows, in order.
pub fn shown<S>(figures: &[Figure<S>], view: View) -> impl Iterator<Item = &Figure<S>> + Clone {
    figures.iter().filter(move |figure| figure.is_in(view))
}

/// The figures of a source that stand in JSON, by key.
pub fn object<S>(figures: &[Figure<S>], source: &S) -> Value {
    let own = figures.iter().filter(|figure| figure.in_json);
    Value::Group(own.map(|figure| (figure.key, (figure.read)(source))).collect())
}

/// The figures of several sources that stand in JSON.
pub fn list<S>(figures: &[Figure<S>], sources: &[S]) -> Value {
    Value::List(sources.iter().map(|source| object(figures, source)).collect())
}

fn whale(view: &LiveView, read: fn(&WhaleFrame) -> f64) -> Option<f64> {
    view.frame.whale.as_ref().map(read)
}

/// Figures of the moment shown.
pub static MOMENT: &[Figure<LiveView>] = &[
    Figure::new(
        "time_s",
        "time",
        "Time of the moment shown.",
        Quantity::Moment,
        |view: &LiveView| view.frame.time_s.into(),
    )
    .not_in_json()
    .shown(&[Compare]),
    Figure::new(
        "greatest_tension_N",
        "greatest tension",
        "Greatest tension of any segment at the moment shown.",
        Quantity::Force,
        |view: &LiveView| view.frame.tension_n.iter().copied().reduce(f64::max).into(),
    )
    .not_in_json()
    .shown(&[Compare]),
    Figure::new(
        "whale_depth_m",
        "depth of the whale",
        "Depth of the whale at the moment shown.",
        Quantity::Depth,
        |view: &LiveView| whale(view, |whale| -whale.position.z).into(),
    )
    .not_in_json()
    .shown(&[Compare]),
    Figure::new(
        "whale_speed_m_s",
        "speed of the whale",
        "Speed of the whale at the moment shown.",
        Quantity::Speed,
        |view: &LiveView| whale(view, |whale| whale.speed_m_s).into(),
    )
    .not_in_json()
    .shown(&[Compare]),
];
