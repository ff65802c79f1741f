//! Circles of files: files of a crate that name items of each other in a loop.
//!
//! A file and the files of its modules may name each other; that is no circle.

use std::collections::{BTreeMap, BTreeSet};

use super::names::modules;
use super::resolve::Modules;
use super::tree::Crate;

/// What ties two files: the paths by which the first names items of the second.
type Edges = BTreeMap<(usize, usize), BTreeSet<String>>;

/// Files that name each other in a loop.
pub struct Circle {
    /// Their paths, in order.
    pub files: Vec<String>,
    /// Who names what of whom: first file, second file, names.
    pub ties: Vec<(String, String, Vec<String>)>,
}

/// All circles of a crate, the largest first.
pub fn circles(of: &Crate) -> Vec<Circle> {
    let edges = edges(of);
    let path = |file: usize| of.files[file].path.clone();
    let mut found: Vec<Circle> = loops(of.files.len(), &edges)
        .into_iter()
        .map(|files| {
            let inside = |(from, to): &(usize, usize)| files.contains(from) && files.contains(to);
            let ties = edges.iter().filter(|(ends, _)| inside(ends));
            Circle {
                files: files.iter().map(|&file| path(file)).collect(),
                ties: ties
                    .map(|((from, to), names)| (path(*from), path(*to), shown(names)))
                    .collect(),
            }
        })
        .collect();
    found.sort_by(|one, other| {
        (other.files.len(), &one.files).cmp(&(one.files.len(), &other.files))
    });
    found
}

/// The paths of one tie, without those that only repeat what `use` brought in.
fn shown(names: &BTreeSet<String>) -> Vec<String> {
    let is_new = |name: &&String| {
        let first = name.split("::").next().unwrap_or(name);
        !names.iter().any(|other| other != *name && other.ends_with(&format!("::{first}")))
    };
    names.iter().filter(is_new).cloned().collect()
}

/// Which file names an item of which other, but for a file and the files of its modules.
fn edges(of: &Crate) -> Edges {
    let modules = Modules(modules(of));
    let mut edges = Edges::new();
    for (place, module) in &modules {
        for named in &module.named {
            let Some(file) = modules.file_of(place, named) else { continue };
            let (from, to) = (&of.files[module.file].module, &of.files[file].module);
            if !from.starts_with(to) && !to.starts_with(from) {
                edges.entry((module.file, file)).or_default().insert(named.join("::"));
            }
        }
    }
    edges
}

/// The sets of at least two files each of which leads to every other.
fn loops(files: usize, edges: &Edges) -> Vec<Vec<usize>> {
    let reached: Vec<BTreeSet<usize>> = (0..files).map(|from| reached(from, edges)).collect();
    let all = (0..files).map(|one| {
        let back = |&other: &usize| reached[other].contains(&one);
        reached[one].iter().copied().filter(back).collect::<Vec<usize>>()
    });
    let unique: BTreeSet<Vec<usize>> = all.filter(|files| files.len() > 1).collect();
    unique.into_iter().collect()
}

/// The files that one leads to; itself only where it is in a loop.
fn reached(from: usize, edges: &Edges) -> BTreeSet<usize> {
    let (mut found, mut open) = (BTreeSet::new(), vec![from]);
    while let Some(file) = open.pop() {
        let next = edges.range((file, 0)..(file + 1, 0)).map(|((_, to), _)| *to);
        open.extend(next.filter(|&to| found.insert(to)));
    }
    found
}

/// Lists the circles of these crates, and how many there are.
pub fn list(crates: &[Crate]) -> String {
    let (mut text, mut count) = (String::new(), 0);
    for circle in crates.iter().flat_map(circles) {
        count += 1;
        text += &format!("circle {count}: {} files\n", circle.files.len());
        for (from, to, names) in circle.ties {
            text += &format!("  {from} -> {to}: {}\n", names.join(", "));
        }
    }
    text + &format!("{count} circles of files, parent and child not counted\n")
}
