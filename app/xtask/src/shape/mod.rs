//! `cargo xtask shape`: how large files and functions are, and which files name each other in circles.
//!
//! It reads what ships: every file that the roots of the packages lead to, without `#[cfg(test)]`.

mod circles;
mod code;
mod functions;
#[cfg(test)]
mod house;
mod names;
mod resolve;
mod sizes;
#[cfg(test)]
mod tests;
mod tokens;
mod tree;

use std::fs;
use std::io::{ErrorKind, Write};
use std::path::Path;

use crate::Outcome;
use crate::workspace::Workspace;
use tree::Crate;

/// Half the files are no longer [lines].
const FILE_MEDIAN: usize = 200;
/// No file is longer [lines].
const FILE_MAX: usize = 600;
/// Half the functions are no longer [lines].
const FUNCTION_MEDIAN: usize = 10;
/// One function of twenty may be longer [lines].
const FUNCTION_P95: usize = 50;
/// No function is longer [lines].
const FUNCTION_MAX: usize = 100;
/// No function takes more arguments.
const ARGUMENTS_MAX: usize = 6;

/// What to print.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Part {
    /// Sizes and circles.
    All,
    /// Sizes of files and functions, and numbers of arguments.
    Sizes,
    /// Circles of files.
    Circles,
}

impl Part {
    /// The part of this name on the command line.
    pub fn named(name: &str) -> Option<Self> {
        match name {
            "all" => Some(Self::All),
            "sizes" => Some(Self::Sizes),
            "circles" => Some(Self::Circles),
            _ => None,
        }
    }
}

/// Prints the shape of the workspace, or of the package in one folder.
///
/// # Errors
/// When the workspace's Cargo.toml cannot be read, or names no such package.
pub fn print(workspace: &Workspace, part: Part, package: Option<&str>) -> Outcome {
    let crates = read(&workspace.root, package)?;
    let sizes = if part == Part::Circles { String::new() } else { sizes::list(&crates) };
    let circles = if part == Part::Sizes { String::new() } else { circles::list(&crates) };
    // A reader such as `head` may leave early, which is no failure.
    let written = std::io::stdout().write_all((sizes + &circles).as_bytes());
    written.or_else(|error| match error.kind() {
        ErrorKind::BrokenPipe => Ok(()),
        _ => Err(format!("cannot print: {error}")),
    })
}

/// Reads all packages of a workspace, or the one whose folder ends in this name.
fn read(root: &Path, package: Option<&str>) -> Outcome<Vec<Crate>> {
    let manifest = fs::read_to_string(root.join("Cargo.toml"))
        .map_err(|error| format!("cannot read Cargo.toml: {error}"))?;
    let all = tree::members(&manifest);
    let chosen: Vec<String> = all
        .iter()
        .filter(|folder| package.is_none_or(|package| Path::new(folder).ends_with(package)))
        .cloned()
        .collect();
    if chosen.is_empty() {
        return Err(format!("there is no such package; there are {}", all.join(", ")));
    }
    Ok(tree::crates(&chosen, &|path| fs::read_to_string(root.join(path)).ok()))
}
