//! `endline check`: every problem of files, libraries and projects.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use endline_gear::Diagnostic;
use endline_session::check::check_path;
use endline_session::locate;

use super::args::CheckArgs;
use super::{Failure, host, output};

pub(super) fn check(args: &CheckArgs, library: Option<&Path>) -> Result<ExitCode, Failure> {
    let host = host::load();
    let paths = if args.paths.is_empty() {
        vec![locate::library(None, library).map_err(Failure::failed)?]
    } else {
        args.paths.clone()
    };
    let (mut files, mut problems) = (0, Vec::new());
    for path in &paths {
        let checked = check_path(path, library, &host);
        files += checked.files;
        problems.extend(checked.problems);
    }
    let errors = problems.iter().filter(|problem| problem.is_error()).count();
    output::print(&words(&paths, files, &problems, errors))?;
    if errors == 0 {
        Ok(ExitCode::SUCCESS)
    } else {
        Err(Failure::failed(format!("{errors} of the problems are errors")))
    }
}

fn words(paths: &[PathBuf], files: usize, problems: &[Diagnostic], errors: usize) -> String {
    let mut text: String = problems.iter().map(|problem| format!("{problem}\n\n")).collect();
    let names: Vec<String> = paths.iter().map(|path| path.display().to_string()).collect();
    let counted = |count: usize, noun: &str| match count {
        1 => format!("1 {noun}"),
        count => format!("{count} {noun}s"),
    };
    text += &format!(
        "{}: {} checked, {}, {}\n",
        names.join(", "),
        counted(files, "file"),
        counted(errors, "error"),
        counted(problems.len() - errors, "warning")
    );
    text
}
