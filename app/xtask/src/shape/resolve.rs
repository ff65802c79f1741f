//! Finds the file that defines what a path names.

use std::collections::BTreeMap;

use super::names::{Module, Path};

/// All modules of a crate, by path from its root.
pub struct Modules(pub BTreeMap<Path, Module>);

/// What a path leads to.
enum Found {
    /// An item, or something within one: the file that defines the item.
    Item(usize),
    /// A module, by path from the root.
    Module(Path),
}

/// Imports that lead to each other end here.
const DEEPEST: usize = 40;

impl<'a> IntoIterator for &'a Modules {
    type Item = (&'a Path, &'a Module);
    type IntoIter = std::collections::btree_map::Iter<'a, Path, Module>;

    fn into_iter(self) -> Self::IntoIter {
        self.0.iter()
    }
}

impl Modules {
    /// The file that defines what a path written in a module names.
    ///
    /// `None` for a module, and for what is not of this crate. What a macro writes cannot be seen: a
    /// name that its module does not show is taken for an item of that module.
    pub fn file_of(&self, place: &[String], path: &[String]) -> Option<usize> {
        match self.find(place, path, 0) {
            Some(Found::Item(file)) => return Some(file),
            Some(Found::Module(_)) => return None,
            None => {}
        }
        let shorter = (1..path.len()).rev().filter_map(|end| self.find(place, &path[..end], 0));
        shorter.take(1).find_map(|found| match found {
            Found::Item(file) => Some(file),
            Found::Module(module) => self.0.get(&module).map(|module| module.file),
        })
    }

    fn find(&self, place: &[String], path: &[String], depth: usize) -> Option<Found> {
        let Some((first, rest)) = path.split_first() else {
            return Some(Found::Module(place.to_vec()));
        };
        let module = self.0.get(place).filter(|_| depth < DEEPEST)?;
        match first.as_str() {
            "crate" => return self.find(&[], rest, depth + 1),
            "self" => return self.find(place, rest, depth + 1),
            "super" => return self.find(place.split_last()?.1, rest, depth + 1),
            _ => {}
        }
        if module.items.contains(first) {
            return Some(Found::Item(module.file));
        }
        let child = [place, std::slice::from_ref(first)].concat();
        if self.0.contains_key(&child) {
            return self.find(&child, rest, depth + 1);
        }
        if let Some(imported) = module.imports.get(first).filter(|imported| imported[0] != *first) {
            return self.find(place, &[imported, rest].concat(), depth + 1);
        }
        let from_glob = |glob: &Path| self.find(place, &[glob, path].concat(), depth + 1);
        module.globs.iter().find_map(from_glob)
    }
}
