//! A prepared study: its file, the baseline scenario and library, and the plan of each option; what it will run, as JSON.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};

use endline_gear::{Document, Library, Prior, Sources, Study, hint, referenced_folder};
use schemars::JsonSchema;
use serde::Serialize;

use crate::error::Error;
use crate::plugins::PluginHost;
use crate::{json, locate};

use super::equivalence;
use super::folder::BLOCK;
use super::forecast::Forecast;
use super::plan::{Base, OptionPlan};
use crate::encounters::aim::lines_aimed_at;
use crate::encounters::equilibria::Equilibria;
use crate::encounters::fitted::Fitted;
use crate::encounters::priors::field_of;

/// A study ready to run.
pub struct PreparedStudy {
    /// The study as read.
    pub study: Study,
    /// Text of its file.
    pub text: String,
    /// The options, by id.
    pub options: Vec<OptionPlan>,
    /// Place of the baseline among them.
    pub baseline: usize,
    /// BLAKE3 of all that defines its runs, hexadecimal: study, scenario, library, plugins, version.
    pub hash: String,
    /// Folder of the gear library.
    pub(super) root: PathBuf,
    pub(super) host: PluginHost,
    pub(super) library: Library,
    /// The library's files, before anything is set.
    pub(super) sources: Sources,
    pub(super) equilibria: Equilibria,
    /// By option: the first option that it differs from in strengths alone, itself if there is none.
    pub(super) families: Vec<usize>,
    /// Proposals of the stages after the first, as far as they were fitted.
    pub(super) fitted: Mutex<Vec<Arc<Fitted>>>,
}

/// Files that a study is read with.
#[derive(Clone, Debug)]
pub struct Files {
    /// Folder of the gear library.
    pub root: PathBuf,
    /// Its files.
    pub sources: Sources,
    /// File and text of a scenario that is open and may differ from its file.
    pub scenario: Option<(PathBuf, String)>,
}

impl PreparedStudy {
    /// Reads a study, its scenario and library, and checks every option by assembling it.
    /// Errors: a file that cannot be read, or every located error of study, scenario and library.
    pub fn open(path: &Path, library: Option<&Path>, host: &PluginHost) -> Result<Self, Error> {
        let text = endline_gear::read::text(path).map_err(Error::on(path, "cannot be read"))?;
        let root = locate::library(Some(path), library).map_err(Error::Message)?;
        let sources = Sources::from_folder(&root)?;
        Self::of_sources(text, path, Files { root, sources, scenario: None }, host)
    }

    /// Reads a study with the library's files as they are edited.
    /// Errors: as [`open`](Self::open).
    pub fn of_sources(
        text: String,
        path: &Path,
        files: Files,
        host: &PluginHost,
    ) -> Result<Self, Error> {
        let study = Study::read(&path.display().to_string(), &text)?;
        let sources = host.with_clips(files.sources);
        let named = scenario_path(&study, path, &files.root);
        let open = files.scenario.filter(|(open, _)| *open == named);
        let (scenario_path, scenario_text) = match open {
            Some(scenario) => scenario,
            None => scenario(&study, named, &files.root)?,
        };
        let base = Base {
            study: &study,
            name: scenario_path.display().to_string(),
            text: scenario_text,
            sources: &sources,
            host,
        };
        let mut options = Vec::new();
        let mut problems = Vec::new();
        for option in &study.options {
            match base.option(option) {
                Ok(plan) => options.push(plan),
                Err(Error::Diagnostics(found)) => problems.extend(
                    found
                        .into_iter()
                        .filter(|problem| !problems.contains(problem))
                        .collect::<Vec<_>>(),
                ),
                Err(error) => return Err(error),
            }
        }
        if !problems.is_empty() {
            return Err(Error::Diagnostics(problems));
        }
        if let Some(option) =
            study.options.iter().find(|option| option.id.value == study.baseline.value)
        {
            base.check_words(option)?;
        }
        let hash = hash(&study, &options);
        let families = families(&study, &options);
        let baseline =
            options.iter().position(|option| option.id == study.baseline.value).unwrap_or_default();
        lines_aimed_at(&options[baseline].prepared.model, &study.aim.lines)?;
        Ok(Self {
            text,
            options,
            baseline,
            hash,
            host: host.clone(),
            root: files.root,
            library: Library::read(&sources).0,
            sources,
            equilibria: Equilibria::default(),
            families,
            fitted: Mutex::default(),
            study,
        })
    }

    /// A drawn value in words: a number as the study's file has it, an item of the library or a plugin by its name.
    pub fn value_words(&self, prior: &Prior, value: &str) -> String {
        if let Ok(number) = value.parse() {
            return prior.law.written(number);
        }
        let field = prior.name.value.as_str();
        let item = || {
            let text = self.sources.get(&format!("{}/{value}.toml", referenced_folder(field)?))?;
            Document::parse(text).ok()?.get("name")
        };
        let plugin = || match field {
            "whale.motion" => Some(self.host.motion(value)?.descriptor().name.to_string()),
            "friction.model" => Some(self.host.friction(value)?.descriptor().name.to_string()),
            _ => None,
        };
        item().or_else(plugin).unwrap_or_else(|| value.to_owned())
    }

    /// Place of an option.
    /// Errors: an id that no option has, with the nearest one.
    pub fn option(&self, id: &str) -> Result<usize, Error> {
        let known = || self.options.iter().map(|option| option.id.as_str());
        let found = known().position(|known| known == id);
        found.ok_or_else(|| {
            Error::Message(format!(
                "{}: there is no option `{id}`; {}",
                self.study.place.source.path,
                hint(id, known())
            ))
        })
    }

    /// The first option in which nothing can part.
    pub(super) fn unbreakable(&self) -> Option<&OptionPlan> {
        self.options.iter().find(|option| option.prepared.model.spec.settings.unbreakable)
    }

    /// The options as a reader expects them: in the order of the file, or by id where axes make them.
    pub(super) fn reading_order(&self) -> Vec<usize> {
        let place = |option: &usize| self.study.options[*option].id.place.span.start;
        let mut order: Vec<usize> = (0..self.options.len()).collect();
        order.sort_by_key(place);
        if order.windows(2).all(|pair| place(&pair[0]) < place(&pair[1])) {
            return order;
        }
        (0..self.options.len()).collect()
    }

    /// Text of a library file before anything is set in it.
    pub(crate) fn library_text(&self, path: &str) -> Option<&str> {
        self.sources.get(path)
    }

    /// Options that differ from the baseline in more than one thing, with what these are ([`OptionPlan::differs_in`]).
    pub fn several_differences(&self) -> impl Iterator<Item = (&str, Vec<String>)> {
        let baseline = &self.options[self.baseline];
        let of = move |option: &usize| {
            let option = &self.options[*option];
            (option.id.as_str(), option.differs_in(baseline))
        };
        self.reading_order()
            .into_iter()
            .map(move |option| of(&option))
            .filter(|(_, things)| things.len() > 1)
    }

    /// Ids of the options by families. Options of a family differ in strengths alone, and share their runs until something parts.
    pub fn families(&self) -> Vec<Vec<&str>> {
        let of = |family: usize| {
            (0..self.options.len()).filter(move |option| self.families[*option] == family)
        };
        let ids = |family: usize| {
            of(family).map(|option| self.options[option].id.as_str()).collect::<Vec<_>>()
        };
        (0..self.options.len()).map(ids).filter(|ids| !ids.is_empty()).collect()
    }
}

/// By option: the first option that it differs from in strengths alone, itself if there is none.
fn families(study: &Study, options: &[OptionPlan]) -> Vec<usize> {
    let drawn: Vec<&str> = study.priors.iter().map(field_of).collect();
    let first = |option: usize| {
        (0..option)
            .find(|other| equivalence::family(&options[option], &options[*other], &drawn))
            .unwrap_or(option)
    };
    (0..options.len()).map(first).collect()
}

/// The file of the baseline scenario: of the library by its id, or beside the study by its path.
fn scenario_path(study: &Study, path: &Path, root: &Path) -> PathBuf {
    let named = &study.scenario.value;
    match named.ends_with(".toml") {
        true => path.parent().unwrap_or(Path::new("")).join(named),
        false => root.join("scenarios").join(format!("{named}.toml")),
    }
}

/// The baseline scenario, read.
fn scenario(study: &Study, file: PathBuf, root: &Path) -> Result<(PathBuf, String), Error> {
    let named = &study.scenario.value;
    let text = endline_gear::read::text(&file).map_err(|error| {
        let folder = std::fs::read_dir(root.join("scenarios")).into_iter().flatten().flatten();
        let mut ids: Vec<String> = folder
            .map(|entry| entry.path())
            .filter_map(|path| Some(path.file_stem()?.to_string_lossy().into_owned()))
            .collect();
        ids.sort();
        let help = hint(named, ids.iter().map(String::as_str));
        let message = format!("the scenario {} cannot be read: {error}", file.display());
        Error::from(study.scenario.place.error(message, help))
    })?;
    Ok((file, text))
}

/// BLAKE3 of what defines the runs.
fn hash(study: &Study, options: &[OptionPlan]) -> String {
    let mut hasher = blake3::Hasher::new_derive_key("endline study 1");
    let mut text = |text: &str| {
        hasher.update(&(text.len() as u64).to_le_bytes());
        hasher.update(text.as_bytes());
    };
    text(crate::VERSION);
    text(&study.canonical);
    for option in options {
        text(&option.id);
        text(&option.prepared.source.hash());
        option.prepared.plugins.iter().for_each(|plugin| text(&format!("{plugin:?}")));
    }
    hasher.finalize().to_hex().to_string()
}

/// Name and version of the form.
const SCHEMA: &str = "endline.study_plan/1";

/// The plan of a study.
#[derive(JsonSchema, Serialize)]
pub(crate) struct Plan<'a> {
    /// Name and version of this form.
    #[schemars(extend("const" = SCHEMA))]
    schema: &'static str,
    /// Id of the study.
    study: &'a str,
    /// Hash of all that defines its runs.
    hash: &'a str,
    /// Number of encounters.
    encounters: u64,
    /// Number of blocks of encounters that are run and stored as one.
    blocks: u64,
    /// Ids of the options, in order.
    options: Vec<&'a str>,
    /// Id of the option that the others are compared with.
    baseline: &'a str,
    /// Options that share their runs until something parts.
    families: Vec<Vec<&'a str>>,
    /// By option that differs from the baseline in more than one thing: what these are.
    several_differences: BTreeMap<&'a str, Vec<String>>,
    /// Cost and precision, once some encounters were run.
    forecast: Option<&'a Forecast>,
}

impl PreparedStudy {
    /// One line of JSON.
    pub fn plan_json(&self, forecast: Option<&Forecast>) -> String {
        let plan = Plan {
            schema: SCHEMA,
            study: &self.study.id,
            hash: &self.hash,
            encounters: self.study.encounters,
            blocks: self.study.encounters.div_ceil(u64::from(BLOCK)),
            options: self.options.iter().map(|option| option.id.as_str()).collect(),
            baseline: &self.options[self.baseline].id,
            families: self.families(),
            several_differences: self.several_differences().collect(),
            forecast,
        };
        json::line(&plan)
    }
}
