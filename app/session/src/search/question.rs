//! The question of a search: an observation, and the encounters that may have led to it; stories as runs and scenarios.

use std::path::{Path, PathBuf};

use endline_gear::{Document, EditError, Observation, Setting, Size, Sources};

use crate::encounters::Encounter;
use crate::error::Error;
use crate::locate;
use crate::plugins::PluginHost;
use crate::source::Prepared;
use crate::study::prepare::until;
use crate::study::{Files, PreparedStudy};

use super::stories::Story;

/// Duration of the run of a story.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Length {
    /// To the time at which the search compared it with the observation.
    Ended,
    /// To the end of the scenario, for steering by hand or for a longer observation.
    Whole,
}

/// An observation, and a study with one option whose encounters are searched.
pub struct Question {
    /// The observation.
    pub observation: Observation,
    /// The encounters: the study's priors, with the animal that was seen.
    pub opened: PreparedStudy,
    /// Seed of the draws and of the local searches.
    pub seed: u64,
    /// BLAKE3 of observation and study, hexadecimal.
    pub hash: String,
    /// BLAKE3 of the study and the animal alone, hexadecimal: observations of the same encounters share the runs of their draws.
    pub net_hash: String,
}

impl Question {
    /// Reads an observation by its file, or by its id in the library, and opens the study that it names, or another.
    /// Errors: a file that cannot be read, or every located error of observation, study, scenario and library.
    pub fn open(
        named: &str,
        encounters: Option<&str>,
        library: Option<&Path>,
        host: &PluginHost,
    ) -> Result<Self, Error> {
        let path = locate::named(named, "observations", library).map_err(Error::Message)?;
        let text = endline_gear::read::text(&path).map_err(Error::on(&path, "cannot be read"))?;
        let root = locate::library(Some(&path), library).map_err(Error::Message)?;
        let sources = Sources::from_folder(&root)?;
        let files = Files { root, sources, scenario: None };
        Self::of_sources((&path, &text), encounters, files, None, host)
    }

    /// The question with the library and the open scenario and study as they are edited.
    /// Errors: as [`open`](Self::open).
    pub fn of_sources(
        (path, text): (&Path, &str),
        encounters: Option<&str>,
        files: Files,
        open_study: Option<&(PathBuf, String)>,
        host: &PluginHost,
    ) -> Result<Self, Error> {
        let observation = Observation::read(&path.display().to_string(), text)?;
        let study = study_of(&observation, encounters, &files.root)?;
        let study_text = match open_study.filter(|(open, _)| *open == study) {
            Some((_, text)) => text.clone(),
            None => {
                endline_gear::read::text(&study).map_err(Error::on(&study, "cannot be read"))?
            }
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

    /// The model of a story.
    /// Errors: where its scenario cannot be assembled.
    pub fn prepare(
        &self,
        story: &Story,
        length: Length,
        host: &PluginHost,
    ) -> Result<Prepared, Error> {
        let prepared = self.encounter(story)?;
        match length {
            Length::Ended => until(&prepared, story.simulated_s, host),
            Length::Whole => (*prepared.source).clone().prepare(host),
        }
    }

    /// A story as the text of a scenario, with the paths of its files that differ from those of the library.
    /// Errors: where its scenario cannot be assembled.
    pub fn scenario(&self, story: &Story) -> Result<(String, Vec<String>), Error> {
        let prepared = self.encounter(story)?;
        let mut scenario = Document::parse(&prepared.source.scenario)?;
        let acts = story.acts_in_words();
        let name = format!(
            "{}: first the {}, {acts}",
            self.observation.name,
            story.first_part.replace('_', " ")
        );
        scenario.put("name", &Setting::text(&name))?;
        let notes = format!(
            "An encounter that a search found among those of {}. Its ending is {:.2} away from what was seen.",
            self.opened.study.name, story.distance
        );
        scenario.put("notes", &Setting::text(&notes))?;
        let other = prepared.source.library.iter().filter(|(path, text)| {
            self.opened.library_text(path).is_some_and(|shipped| shipped != *text)
        });
        let other = other.map(|(path, _)| path.to_owned()).collect();
        Ok((scenario.text(), other))
    }

    fn encounter(&self, story: &Story) -> Result<Prepared, Error> {
        self.opened.prepare(0, &Encounter::at_point(&self.opened.study, &story.point))
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
        (Some(given), _) => find(given).map_err(Error::Message),
        (None, Some(named)) => {
            find(&named.value).map_err(|message| named.place.error(message, "").into())
        }
        (None, None) => {
            let help = "write the id of a study with one option, such as encounters = \"met-single\", or give --encounters";
            Err(observation.place.error("`encounters` is missing", help).into())
        }
    }
}

/// The study with the observed animal instead of drawn ones.
fn opened(
    observation: &Observation,
    (path, text): (&Path, &str),
    files: Files,
    host: &PluginHost,
) -> Result<PreparedStudy, Error> {
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
    PreparedStudy::of_sources(study.text(), path, files, host)
}
