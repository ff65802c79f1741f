//! Edited copies of an assembly, assembled and checked in memory.

use endline_gear::{Library, Sources};

use crate::error::Error;
use crate::plugins::PluginHost;

use super::super::fishing::Fishing;
use super::super::gear::{Gear, Piece};
use super::super::packs::Packs;
use super::super::sheet::{RuleGear, RuleSheet, check, of_library};

/// Folders of what gear is made of: nothing else is read again for each copy.
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
    ///
    /// # Errors
    /// Every located error of the text as assembled.
    pub fn tried(&self, text: &str) -> Result<Tried, Error> {
        let library = library_with(self.id, text, self.sources.clone())?;
        let gear: RuleGear = of_library(self.id, self.fishing.depth_m, &library, self.host)?;
        let sheet = check(&gear, self.packs, self.fishing)?;
        Ok(Tried { gear: gear.gear, sheet, library })
    }
}

/// The library with a text of an assembly.
///
/// # Errors
/// Every located error of the text.
pub(super) fn library_with(id: &str, text: &str, mut sources: Sources) -> Result<Library, Error> {
    let file = format!("assemblies/{id}.toml");
    sources.set(file.as_str(), text);
    let (library, problems) = Library::read(&sources);
    let own = problems.into_iter().filter(|problem| problem.is_error() && problem.file == file);
    let own: Vec<_> = own.collect();
    if own.is_empty() { Ok(library) } else { Err(Error::Diagnostics(own)) }
}

/// How much of the gear an edit changes: share of its rope that is replaced or taken off, and how many traps, endlines, floats
/// and reflectors come or go.
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
