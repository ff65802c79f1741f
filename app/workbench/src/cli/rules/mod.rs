//! `endline rules`: what laws ask of an assembly, and what would bring it to comply.

mod args;
mod check;
mod fix;
mod list;
mod study;

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use endline_session::locate;

use super::Failure;

pub(super) use args::{FishedArgs, RulesCommand};

pub(super) fn rules(what: &RulesCommand, library: Option<&Path>) -> Result<ExitCode, Failure> {
    match what {
        RulesCommand::Check(args) => check::check_rules(args, library),
        RulesCommand::Fix(args) => fix::fix(args, library),
        RulesCommand::Study(args) => study::study(args, library),
        RulesCommand::List(args) => list::list(args, library),
    }
}

/// Writes a text to a new file, named by its path or by an id in a folder of the library; never over one that is there.
fn write_new(named: &str, root: &Path, folder: &str, text: &str) -> Result<PathBuf, Failure> {
    let is_path = named.ends_with(".toml") || named.contains(['/', '\\']);
    let path = if is_path { named.into() } else { root.join(folder).join(format!("{named}.toml")) };
    locate::write_new(&path, text).map_err(|error| match error.kind() {
        std::io::ErrorKind::AlreadyExists => {
            Failure::failed(format!("{} is there already; name a new file", path.display()))
        }
        _ => Failure::failed(format!("{}: cannot be written: {error}", path.display())),
    })?;
    Ok(path)
}
