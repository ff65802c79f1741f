//! `endline study hindcast`: a merged study beside observations, or all studies and cases with observations on one page.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use endline_gear::Study;
use endline_session::campaign::{Control, Shard};
use endline_session::cases::{Cases, Effort, Outcome};
use endline_session::study::folder::Folder;
use endline_session::study::report::hindcast as page;
use endline_session::study::stats::Findings;
use endline_session::study::{PreparedStudy, batch, merge};
use endline_session::{Error, locate};

use super::args::{HindcastArgs, StudyArgs};
use super::status::Bar;
use super::{all_cores, lower_priority, open, stored};
use crate::cli::{Failure, host, output};

pub(super) fn hindcast(args: &HindcastArgs, library: Option<&Path>) -> Result<ExitCode, Failure> {
    match &args.study {
        Some(study) => of_one(study, args, library)?,
        None => of_all(args, library)?,
    }
    Ok(ExitCode::SUCCESS)
}

/// A merged study.
fn of_one(study: &str, args: &HindcastArgs, library: Option<&Path>) -> Result<(), Failure> {
    let at = StudyArgs { study: study.to_owned(), out: args.out.clone(), encounters: None };
    let opened = open(&at, library)?;
    if opened.study.observations.is_empty() {
        return Err(Failure::usage(format!(
            "{}: the study has no [[observation]]; docs/studies.md says how to write one",
            opened.study.id
        )));
    }
    let folder = stored(&at, args.kept, &opened)?;
    let table = merge::load(&folder)?;
    let findings = Findings::of(&opened, &table, &folder);
    output::print(&page::markdown(&opened, &findings))
}

/// Every study of the library with observations, its missing blocks run, and every case that belongs to the hindcast.
fn of_all(args: &HindcastArgs, library: Option<&Path>) -> Result<(), Failure> {
    if !args.eager {
        lower_priority();
    }
    let out = args.out.clone().unwrap_or_else(|| PathBuf::from("results"));
    let mut studies = Vec::new();
    for file in with_observations(library)? {
        studies.push(run(&file, &out, args.encounters, library)?);
    }
    output::print(&page::page(&studies, &cases(library)?))
}

/// The files of the library's studies that name observations, by name.
fn with_observations(library: Option<&Path>) -> Result<Vec<PathBuf>, Failure> {
    let folder = locate::library(None, library).map_err(Failure::failed)?.join("studies");
    let entries = std::fs::read_dir(&folder).into_iter().flatten().flatten();
    let is_study = |file: &PathBuf| file.extension().is_some_and(|ending| ending == "toml");
    let mut files: Vec<PathBuf> = entries.map(|entry| entry.path()).filter(is_study).collect();
    files.sort();
    let mut found = Vec::new();
    for file in files {
        let name = file.display().to_string();
        let text = endline_gear::read::text(&file)
            .map_err(|error| Failure::failed(format!("{name}: cannot be read: {error}")))?;
        let study = Study::read(&name, &text).map_err(Error::Diagnostics)?;
        if !study.observations.is_empty() {
            found.push(file);
        }
    }
    Ok(found)
}

/// Runs the missing blocks of a study and merges it.
fn run(
    file: &Path,
    out: &Path,
    encounters: Option<u32>,
    library: Option<&Path>,
) -> Result<(PreparedStudy, Findings), Failure> {
    let at = StudyArgs { study: file.display().to_string(), out: None, encounters: None };
    let mut opened = open(&at, library)?;
    if let Some(fewer) = encounters {
        opened.study.encounters = opened.study.encounters.min(fewer.into());
    }
    let folder = Folder::open(&out.join(&opened.study.id), &opened)?;
    let bar = Bar::new();
    let control = Control::new(move |progress| bar.at(progress));
    batch::run(&opened, &folder, Shard { part: 0, of: 1 }, all_cores(), &control)?;
    drop(control);
    let table = merge::merge(&opened, &folder)?;
    merge::save(&opened, &folder, &table)?;
    let findings = Findings::of(&opened, &table, &folder);
    Ok((opened, findings))
}

/// The cases that answer a row: the row and the outcome of the case.
fn cases(library: Option<&Path>) -> Result<Vec<(String, Outcome)>, Failure> {
    let (cases, host) = (Cases::open(library)?, host::load());
    let mut found = Vec::new();
    for id in cases.ids()? {
        let loaded = cases.load(&id)?;
        if let Some(row) = loaded.case.hindcast.clone() {
            found.push((row, cases.run(&loaded, Effort::Plain, &host)?));
        }
    }
    found.sort_by(|(one, _), (other, _)| one.cmp(other));
    Ok(found)
}
