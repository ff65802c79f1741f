//! A prior: what is drawn for each encounter, by which law, and how well that is known.

mod known;
mod law;
mod read_law;
mod support;

use crate::confidence::Confidence;
use crate::diagnostic::{At, Place};
use crate::fields::{Fields, confidence};
use crate::nearest::hint;
use crate::tree::Node;

use super::option::library_field;
use known::{KNOWN, Takes};
use read_law::law;
use support::check_same;

pub use law::{Law, Level};

/// A quantity of the encounter with its distribution.
#[derive(Clone, Debug, PartialEq)]
pub struct Prior {
    /// Name: one of the known ones, or the dotted path of a field.
    pub name: At<String>,
    /// Where a drawn value goes.
    pub target: Target,
    /// Its distribution.
    pub law: Law,
    /// The distribution from which most encounters are drawn instead, weighted back to the prior.
    pub proposal: Option<Law>,
    /// Where that comes from.
    pub source: String,
    /// How well it is known.
    pub confidence: Confidence,
}

/// Where a drawn value goes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Target {
    /// One of the encounter's own quantities: the session knows what it does.
    Known,
    /// A field of the scenario.
    Scenario(String),
    /// A field of a library file.
    Library(String, String),
}

impl Prior {
    /// Its name for people: `flipper sweep`, `friction coefficient scale`.
    #[must_use]
    pub fn words(&self) -> String {
        let parts = self
            .name
            .value
            .split(['.', '/'])
            .filter(|part| *part != "attributes" && part.parse::<usize>().is_err());
        parts.collect::<Vec<_>>().join(" ").replace('_', " ")
    }
}

/// Reads every table of `[encounter]` that is left, sorted by name.
pub(super) fn read_all(fields: &Fields<'_>) -> Vec<Prior> {
    let mut priors: Vec<Prior> = fields
        .rest()
        .into_iter()
        .filter_map(|(name, key, node)| read(name, key, node, fields))
        .collect();
    priors.sort_by(|one, other| one.name.value.cmp(&other.name.value));
    priors
}

fn read(name: &str, key: &Place, node: &Node, outer: &Fields<'_>) -> Option<Prior> {
    let problems = outer.problems();
    let known = KNOWN.iter().find(|(known, _)| *known == name).map(|(_, takes)| *takes);
    let Some(target) = target(name, known.is_some()) else {
        let names = KNOWN.iter().map(|(known, _)| *known).chain(["aim", "aim_by", "gap"]);
        let help = hint(name, names);
        problems.push(key.error(
            format!("nothing of an encounter is called `{name}`"),
            format!("{help} A field of the scenario or of a library item goes by its dotted path in quotes"),
        ));
        return None;
    };
    let fields = Fields::of(node, problems);
    let law = law(&fields, known);
    let proposal = law.as_ref().and_then(|law| proposal(&fields, law, known));
    let source = fields.text("source");
    let given = confidence(&fields, &Confidence::OF_PRIORS);
    if source.is_none() && fields.get("source").is_none() {
        fields.missing("source", "say where the distribution comes from, or source = \"assumed\"");
    }
    fields.finish();
    let source = source?;
    if given.is_none() && source.value != "assumed" {
        problems.push(source.place.error(
            format!("`{name}` has a source but no confidence"),
            "write confidence = \"measured\", \"derived\", \"estimate\" or \"assumed\" beside it",
        ));
    }
    let name = At { value: name.to_owned(), place: key.clone() };
    Some(Prior {
        name,
        target,
        law: law?,
        proposal,
        confidence: given.unwrap_or(Confidence::Assumed),
        source: source.value,
    })
}

/// `proposal`: a table with a law of the same values.
fn proposal(fields: &Fields<'_>, prior: &Law, known: Option<Takes>) -> Option<Law> {
    let table = fields.table("proposal")?;
    let law = law(&table, known);
    table.finish();
    let place = fields.get("proposal").map(|node| node.place.clone());
    let same =
        |law: &Law| place.is_some_and(|place| check_same(prior, law, &place, fields.problems()));
    law.filter(same)
}

/// Where a value drawn under a name goes; `None` where there is nothing of that name.
fn target(name: &str, known: bool) -> Option<Target> {
    match library_field(name) {
        _ if known => Some(Target::Known),
        Some((file, field)) => Some(Target::Library(file, field.to_owned())),
        None => name.contains('.').then(|| Target::Scenario(name.to_owned())),
    }
}
