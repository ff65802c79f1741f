//! Whether an event came, encounter by encounter.

use endline_gear::{Counted, StudyEvent};

use crate::table::Table;

/// Whether an event came in an encounter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mark {
    /// Whether it came.
    pub came: bool,
    /// What the encounter counts for.
    pub weight: f64,
}

/// By encounter: whether the event came; `None` where the run is invalid or missing.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Marks(pub Vec<Option<Mark>>);

impl Marks {
    /// The marks of an event in the runs of an option.
    #[must_use]
    pub fn of(table: &Table, option: &str, event: &StudyEvent) -> Self {
        let (options, valid) = (table.texts("option"), table.flags("valid"));
        let came = of_rows(table, event);
        Self::by_encounter(table, |row| options[row] == option && valid[row], |row| came[row])
    }

    /// Marks of the rows that count, by their encounters.
    fn by_encounter(
        table: &Table,
        counts: impl Fn(usize) -> bool,
        came: impl Fn(usize) -> bool,
    ) -> Self {
        let (encounters, weights) = (encounters(table), weights(table));
        let mut marks = vec![None; encounters.iter().max().map_or(0, |last| last + 1)];
        for (row, encounter) in encounters.iter().enumerate().filter(|(row, _)| counts(*row)) {
            marks[*encounter] = Some(Mark { came: came(row), weight: weights[row] });
        }
        Self(marks)
    }

    /// The marks of encounters that all count alike.
    #[must_use]
    pub fn even(came: impl IntoIterator<Item = Option<bool>>) -> Self {
        Self(came.into_iter().map(|came| Some(Mark { came: came?, weight: 1.0 })).collect())
    }

    /// Whether the event came, with what each encounter counts for.
    pub(super) fn values(&self) -> Vec<(f64, f64)> {
        self.0.iter().flatten().map(|mark| (f64::from(mark.came), mark.weight)).collect()
    }

    /// Encounters in which the event came.
    #[must_use]
    pub fn came(&self) -> Vec<bool> {
        self.0.iter().map(|mark| mark.is_some_and(|mark| mark.came)).collect()
    }

    /// Only the marks of some encounters.
    #[must_use]
    pub fn within(&self, keep: &[bool]) -> Self {
        Self(self.0.iter().zip(keep).map(|(mark, keep)| mark.filter(|_| *keep)).collect())
    }
}

/// The encounter of each row.
pub(super) fn encounters(table: &Table) -> Vec<usize> {
    table
        .reals("encounter")
        .into_iter()
        .map(|index| index.map_or(0, |index| index as usize))
        .collect()
}

/// What the encounter of each row counts for.
pub(super) fn weights(table: &Table) -> Vec<f64> {
    let known = table.reals("weight");
    (0..table.rows()).map(|row| known.get(row).copied().flatten().unwrap_or(1.0)).collect()
}

/// Whether an event came in each row.
fn of_rows(table: &Table, event: &StudyEvent) -> Vec<bool> {
    counted(table, &event.counted())
}

fn counted(table: &Table, how: &Counted<'_>) -> Vec<bool> {
    let outcome = |wanted: &[&str]| {
        table.texts("outcome").iter().map(|outcome| wanted.contains(&outcome.as_str())).collect()
    };
    let number = |column: &str, came: &dyn Fn(f64) -> bool| {
        table.reals(column).iter().map(|value| value.is_some_and(came)).collect()
    };
    let joined = |parts: &[Counted<'_>], join: fn(bool, bool) -> bool| {
        let parts = parts.iter().map(|part| counted(table, part));
        let both = |one: Vec<bool>, other: Vec<bool>| {
            one.into_iter().zip(other).map(|(one, other)| join(one, other)).collect()
        };
        parts.reduce(both).unwrap_or_default()
    };
    match *how {
        Counted::Outcome(wanted) => outcome(wanted),
        Counted::Present(column) => table.reals(column).iter().map(Option::is_some).collect(),
        Counted::Flag(column) => {
            let flags = table.flags(column);
            (0..table.rows()).map(|row| flags.get(row) == Some(&true)).collect()
        }
        Counted::AtLeast(name, parts, least) => {
            let mut came = vec![false; table.rows()];
            for part in parts {
                let values = table.reals(&format!("{}_{name}", part.name()));
                came.iter_mut()
                    .zip(values)
                    .for_each(|(came, value)| *came |= value.is_some_and(|value| value >= least));
            }
            came
        }
        Counted::Above(column, least) => number(column, &|value| value > least),
        Counted::NotAbove(column, most) => number(column, &|value| value <= most),
        Counted::All(parts) => joined(parts, |one, other| one && other),
        Counted::Any(parts) => joined(parts, |one, other| one || other),
    }
}
