//! The question of a search: an observation, and the encounters that may have led to it.

use std::path::{Path, PathBuf};

use endline_gear::{Document, EditError, Observation, Setting, Size, Sources};

use crate::error::Error;
use crate::locate;
use crate::plugins::PluginHost;
use crate::study::{Files, Opened};

/// An observation, and a study with one option whose encounters are searched.
pub struct Question {
    /// What was seen.
    pub observation: Observation,
    /// The encounters: the study's priors, with the animal that was seen.
    pub opened: Opened,
    /// Seed of the net and of the local searches.
    pub seed: u64,
    /// BLAKE3 of observation and study, hexadecimal.
    pub hash: String,
    /// BLAKE3 of the study and the animal alone, hexadecimal: observations of the same encounters share the runs of their net.
    pub net_hash: String,
}

impl Question {
    /// Reads an observation by its file, or by its id in the library, and opens the study that it names, or another.
    ///
    /// # Errors
    /// A file that cannot be read, or every located error of observation, study, scenario and library.
    pub fn open(
        named: &str,
        encounters: Option<&str>,
        library: Option<&Path>,
        host: &PluginHost,
    ) -> Result<Self, Error> {
        let path = locate::named(named, "observations", library).map_err(Error::Replay)?;
        let text = endline_gear::read::text(&path)
            .map_err(|error| Error::at(&path, format!("cannot be read: {error}")))?;
        let root = locate::library(Some(&path), library).map_err(Error::Replay)?;
        Self::of_text(&path, &text, encounters, &root, host)
    }

    /// The same of a text that may differ from what stands in its file.
    ///
    /// # Errors
    /// As [`open`](Self::open).
    pub fn of_text(
        path: &Path,
        text: &str,
        encounters: Option<&str>,
        root: &Path,
        host: &PluginHost,
    ) -> Result<Self, Error> {
        let sources = Sources::from_folder(root).map_err(Error::Diagnostics)?;
        let files = Files { root: root.to_owned(), sources, scenario: None };
        Self::of_sources((path, text), encounters, files, None, host)
    }

    /// The same with the library and the open scenario and study as they are edited.
    ///
    /// # Errors
    /// As [`open`](Self::open).
    pub fn of_sources(
        (path, text): (&Path, &str),
        encounters: Option<&str>,
        files: Files,
        open_study: Option<&(PathBuf, String)>,
        host: &PluginHost,
    ) -> Result<Self, Error> {
        let observation =
            Observation::read(&path.display().to_string(), text).map_err(Error::Diagnostics)?;
        let study = study_of(&observation, encounters, &files.root)?;
        let study_text = match open_study.filter(|(open, _)| *open == study) {
            Some((_, text)) => text.clone(),
            None => endline_gear::read::text(&study)
                .map_err(|error| Error::at(&study, format!("cannot be read: {error}")))?,
        };
        let opened = opened(&observation, (&study, &study_text), files, host)?;
        if opened.options.len() != 1 {
            let message = format!(
                "has {} options; a search takes the encounters of a study with one",
                opened.options.len()
            );
            return Err(Error::at(&study, message));
        }
        let seed = opened.study.seed;
        let hash = hash_of("endline search 2", &[text, &opened.hash]);
        let net_hash = hash_of("endline net 1", &[&opened.hash]);
        Ok(Self { observation, opened, seed, hash, net_hash })
    }
}

fn hash_of(context: &str, texts: &[&str]) -> String {
    let mut hasher = blake3::Hasher::new_derive_key(context);
    for text in texts {
        hasher.update(&(text.len() as u64).to_le_bytes());
        hasher.update(text.as_bytes());
    }
    hasher.finalize().to_hex().to_string()
}

/// The study named on the command line or by the observation.
fn study_of(observation: &Observation, given: Option<&str>, root: &Path) -> Result<PathBuf, Error> {
    let find = |name: &str| locate::named(name, "studies", Some(root));
    match (given, &observation.encounters) {
        (Some(given), _) => find(given).map_err(Error::Replay),
        (None, Some(named)) => find(&named.value)
            .map_err(|message| Error::Diagnostics(vec![named.place.error(message, "")])),
        (None, None) => {
            let help = "write the id of a study with one option, such as encounters = \"met-single\", or give --encounters";
            Err(Error::Diagnostics(vec![observation.place.error("`encounters` is missing", help)]))
        }
    }
}

/// The study with the animal that was seen in place of the animals that it draws.
fn opened(
    observation: &Observation,
    (path, text): (&Path, &str),
    files: Files,
    host: &PluginHost,
) -> Result<Opened, Error> {
    let fault = |error: EditError| Error::at(path, error.message);
    let mut study = Document::parse(text).map_err(fault)?;
    let mut fixed: Vec<(&str, String)> = Vec::new();
    match observation.size {
        Some(Size::Age(age_s)) => fixed.push(("age", format!("{age_s} s"))),
        Some(Size::Length(length_m)) => fixed.push(("length", format!("{length_m} m"))),
        None => {}
    }
    if let Some(whale) = &observation.whale {
        fixed.push(("\"whale.item\"", whale.value.clone()));
    }
    if observation.size.is_some() {
        for drawn in ["encounter.age", "encounter.length"] {
            if study.has(drawn) {
                study.remove(drawn).map_err(fault)?;
            }
        }
    }
    for (name, value) in fixed {
        let field = |key: &str| format!("encounter.{name}.{key}");
        study.put(&field("value"), &Setting::text(&value)).map_err(fault)?;
        study.put(&field("source"), &Setting::text("the observation")).map_err(fault)?;
        study.put(&field("confidence"), &Setting::text("measured")).map_err(fault)?;
    }
    Opened::of_sources(study.text(), path, files, host)
}
