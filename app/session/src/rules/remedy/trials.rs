//! Edited copies of an assembly, assembled and checked in memory; the usual weak inserts.

use endline_gear::{Document, Library, Options, Scenario, Setting, Sources, assemble_traced};
use schemars::JsonSchema;
use serde::Serialize;

use super::super::gear::{Gear, Piece, gear_of};
use super::super::packs::Packs;
use super::super::sheet::{Fishing, RuleGear, RuleSheet, check, of_library};
use super::{Asked, propose};
use crate::error::Error;
use crate::plugins::PluginHost;
use crate::statics::{TrialGear, TrialSea, alone};

/// Folders of the items that gear is made of, which alone are read again for each copy.
const FOLDERS: [&str; 8] =
    ["ropes/", "traps/", "buoys/", "weak-links/", "knots/", "anchors/", "sites/", "friction/"];

/// Where edited copies of an assembly are tried.
pub(super) struct CandidateTrials<'a> {
    pub id: &'a str,
    pub host: &'a PluginHost,
    pub packs: &'a Packs,
    pub fishing: &'a Fishing,
    sources: Sources,
}

/// A copy that was tried.
pub(super) struct Tried {
    pub gear: Gear,
    pub sheet: RuleSheet,
    pub library: Library,
}

impl<'a> CandidateTrials<'a> {
    pub fn new(
        id: &'a str,
        sources: &Sources,
        host: &'a PluginHost,
        packs: &'a Packs,
        fishing: &'a Fishing,
    ) -> Self {
        let of_gear = |path: &str| FOLDERS.iter().any(|folder| path.starts_with(folder));
        let paths = sources.iter().map(|(path, _)| path).filter(|path| of_gear(path));
        let paths: Vec<String> = paths.map(str::to_owned).collect();
        Self { id, host, packs, fishing, sources: sources.only(&paths) }
    }

    /// Assembles and checks a text of the assembly.
    pub fn tried(&self, text: &str) -> Result<Tried, Error> {
        let library = library_with(self.id, text, self.sources.clone())?;
        let gear: RuleGear = of_library(self.id, self.fishing.depth_m, &library, self.host)?;
        let sheet = check(&gear, self.packs, self.fishing)?;
        Ok(Tried { gear: gear.gear, sheet, library })
    }
}

/// The library with a text of an assembly.
pub(super) fn library_with(id: &str, text: &str, mut sources: Sources) -> Result<Library, Error> {
    let file = format!("assemblies/{id}.toml");
    sources.set(file.as_str(), text);
    let (library, problems) = Library::read(&sources);
    let own = problems.into_iter().filter(|problem| problem.is_error() && problem.file == file);
    let own: Vec<_> = own.collect();
    if own.is_empty() { Ok(library) } else { Err(Error::Diagnostics(own)) }
}

/// How much of the gear an edit changes: share of its rope that is replaced or taken off, and how many traps, endlines, floats
/// and reflectors are added or removed.
pub(super) fn size(before: &Gear, after: &Gear) -> (f64, usize) {
    let (old, new) = (lengths(before), lengths(after));
    let left = |item: &str| new.iter().find(|(known, _)| *known == item).map_or(0.0, |one| one.1);
    let gone_m: f64 = old.iter().map(|(item, length_m)| (length_m - left(item)).max(0.0)).sum();
    let total_m: f64 = old.iter().map(|(_, length_m)| length_m).sum();
    let bodies =
        |gear: &Gear| [gear.traps, gear.endlines.len(), gear.floats.len(), gear.reflectors];
    let parts =
        bodies(before).into_iter().zip(bodies(after)).map(|(one, other)| one.abs_diff(other));
    (if total_m > 0.0 { gone_m / total_m } else { 0.0 }, parts.sum())
}

/// Length of each rope in the gear [m].
fn lengths(gear: &Gear) -> Vec<(&str, f64)> {
    let mut lengths: Vec<(&str, f64)> = Vec::new();
    let pieces = gear.endlines.iter().flat_map(|endline| &endline.pieces).chain(&gear.groundlines);
    for Piece { item, length_m, .. } in pieces.filter(|piece| piece.length_m > 0.0) {
        match lengths.iter_mut().find(|(known, _)| known == item) {
            Some((_, sum)) => *sum += length_m,
            None => lengths.push((item, *length_m)),
        }
    }
    lengths
}

/// A field that an edit changes.
#[derive(Clone, Debug, Eq, JsonSchema, PartialEq, Serialize)]
pub struct Change {
    /// Its dotted path in the assembly's file, such as `lines.endline-top.inserts.first`.
    pub field: String,
    /// Its value before; none where it is new.
    pub before: Option<String>,
    /// Its value after; none where it is removed.
    pub after: Option<String>,
}

/// A step of an edit.
#[derive(Clone, Debug)]
pub(super) enum Step {
    /// A value put at a path.
    Put(String, String),
    /// A field removed, if it exists.
    Remove(String),
    /// A table added to a list, such as a `body`.
    Add(&'static str, Vec<(&'static str, String)>),
    /// A table taken out of a list by its `id`.
    Drop(&'static str, String),
}

/// An edit of an assembly's file.
#[derive(Clone, Debug)]
pub(super) struct Candidate {
    /// Its effect, in a sentence.
    pub says: String,
    /// Its steps, in order.
    pub steps: Vec<Step>,
}

impl Candidate {
    pub fn new(says: String) -> Self {
        Self { says, steps: Vec::new() }
    }

    /// With a value put at a path.
    pub fn put(mut self, field: impl Into<String>, value: impl Into<String>) -> Self {
        self.steps.push(Step::Put(field.into(), value.into()));
        self
    }

    /// With a field taken out.
    pub fn remove(mut self, field: impl Into<String>) -> Self {
        self.steps.push(Step::Remove(field.into()));
        self
    }

    /// Makes the edit; returns its changes, field by field.
    pub fn apply(&self, document: &mut Document) -> Result<Vec<Change>, String> {
        let mut changes = Vec::new();
        for step in &self.steps {
            step.apply(document, &mut changes)?;
        }
        changes.retain(|change| change.before != change.after);
        Ok(changes)
    }
}

impl Step {
    fn apply(&self, document: &mut Document, changes: &mut Vec<Change>) -> Result<(), String> {
        match self {
            Self::Put(field, value) => {
                let before = document.get(field);
                document.put(field, &Setting::plain(value)).map_err(|error| error.message)?;
                changes.push(Change { field: field.clone(), before, after: Some(value.clone()) });
            }
            Self::Remove(field) if document.has(field) => {
                let before = document.get(field);
                document.remove(field).map_err(|error| error.message)?;
                changes.push(Change { field: field.clone(), before, after: None });
            }
            Self::Remove(_) => {}
            Self::Add(list, fields) => {
                let texts: Vec<(&str, &str)> =
                    fields.iter().map(|(key, value)| (*key, value.as_str())).collect();
                let index = document.push_table(list, &texts).map_err(|error| error.message)?;
                changes.extend(fields.iter().map(|(key, value)| Change {
                    field: format!("{list}.{index}.{key}"),
                    before: None,
                    after: Some(value.clone()),
                }));
            }
            Self::Drop(list, id) => {
                let own = |index: &usize| {
                    document.get(&format!("{list}.{index}.id")).as_ref() == Some(id)
                };
                let index = (0..document.count(list)).find(own);
                let index = index.ok_or_else(|| format!("there is no {list} `{id}`"))?;
                document.remove_table(list, index).map_err(|error| error.message)?;
                let field = format!("{list}.{index}");
                changes.push(Change { field, before: Some(id.clone()), after: None });
            }
        }
        Ok(())
    }
}

/// A file of gear after an edit.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Edited {
    /// The edit in a sentence.
    pub says: String,
    /// The file.
    pub text: String,
}

/// An assembly with weak inserts of 3 ft every 60 ft over the top three quarters of each endline, counted from the buoy through
/// all the lines that the endline is made of. Gear is laid in water of `depth_m`, or of the usual depth [m].
pub fn usual_inserts(
    asked: Asked<'_>,
    depth_m: Option<f64>,
    host: &PluginHost,
) -> Result<Edited, Error> {
    let library = library_with(asked.id, asked.text, asked.sources.clone())?;
    put_into(asked.text, &of_library(asked.id, depth_m, &library, host)?.gear)
}

/// A scenario that is made of parts of its own, with the usual weak inserts.
pub fn usual_inserts_of_own(
    scenario: &str,
    library: &Library,
    host: &PluginHost,
) -> Result<Edited, Error> {
    let text = alone(scenario, &TrialGear::Own, &TrialSea::default(), library)?;
    let read = Scenario::read("scenario", &text)?;
    let made = assemble_traced(&read, library, host, &Options::default());
    put_into(scenario, &gear_of(&made?, library))
}

/// A file of gear with the usual inserts.
fn put_into(text: &str, gear: &Gear) -> Result<Edited, Error> {
    let mut document = super::parsed(text)?;
    let edit = propose::usual_inserts(&document, gear)
        .ok_or_else(|| Error::Message("the gear has no endline that takes inserts".to_owned()))?;
    edit.apply(&mut document).map_err(Error::Message)?;
    Ok(Edited { says: edit.says, text: document.text() })
}
