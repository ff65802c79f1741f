//! A study opened: its file, the baseline scenario and library, and each option as an edited copy of them.

use std::path::{Path, PathBuf};

use endline_gear::{
    Diagnostic, Document, EditError, Library, OptionSetting, Sources, Study, StudyOption, hint,
};

use crate::error::Error;
use crate::locate;
use crate::plugins::PluginHost;
use crate::source::{Overrides, Prepared, Source};

use super::draw;
use super::rest::Rests;
use super::same;

/// A study ready to run.
pub struct Opened {
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
    pub(super) host: PluginHost,
    pub(super) library: Library,
    /// The library's files, before anything is set.
    pub(super) sources: Sources,
    pub(super) rests: Rests,
    /// By option: the first option it differs from in strengths alone.
    pub(super) families: Vec<usize>,
}

/// An option as a scenario and a library.
pub struct OptionPlan {
    /// Id.
    pub id: String,
    /// Name shown to the user.
    pub name: String,
    /// Strength it stands for [N].
    pub strength_n: Option<f64>,
    /// Which curve of break-away against strength it belongs to.
    pub curve: Option<String>,
    /// Paths of all it sets, of scenario and library.
    pub(super) own: Vec<String>,
    /// The same with what they are set to, as a file has it.
    pub(super) sets: Vec<(String, String)>,
    pub(super) settings: Vec<OptionSetting>,
    pub(super) removes: Vec<String>,
    /// The baseline scenario, before anything is set.
    pub(super) scenario: Document,
    pub(super) scenario_name: String,
    pub(super) sources: Sources,
    /// The option as it stands, for its library files and its plugins.
    pub prepared: Prepared,
}

impl Opened {
    /// Reads a study, its scenario and library, and checks every option by assembling it.
    ///
    /// # Errors
    /// A file that cannot be read, or every located error of study, scenario and library.
    pub fn open(path: &Path, library: Option<&Path>, host: &PluginHost) -> Result<Self, Error> {
        let text = std::fs::read_to_string(path)
            .map_err(|error| Error::at(path, format!("cannot be read: {error}")))?;
        let study = Study::read(&path.display().to_string(), &text).map_err(Error::Diagnostics)?;
        let root = locate::library(Some(path), library).map_err(Error::Replay)?;
        let sources = host.with_clips(Sources::from_folder(&root).map_err(Error::Diagnostics)?);
        let (scenario_path, scenario_text) = scenario(&study, path, &root)?;
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
        let hash = hash(&study, &options);
        let families = families(&study, &options);
        let baseline =
            options.iter().position(|option| option.id == study.baseline.value).unwrap_or_default();
        Ok(Self {
            text,
            options,
            baseline,
            hash,
            host: host.clone(),
            library: Library::read(&sources).0,
            sources,
            rests: Rests::default(),
            families,
            study,
        })
    }

    /// Place of an option.
    ///
    /// # Errors
    /// Where there is none of that id, with the nearest.
    pub fn option(&self, id: &str) -> Result<usize, Error> {
        let known = || self.options.iter().map(|option| option.id.as_str());
        let found = known().position(|known| known == id);
        found.ok_or_else(|| {
            Error::Replay(format!(
                "{}: there is no option `{id}`; {}",
                self.study.place.source.path,
                hint(id, known())
            ))
        })
    }
}

impl Opened {
    /// Ids of the options by families: those of one differ in strengths alone, and share their runs until something parts.
    #[must_use]
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

/// Paths of all an option sets.
fn own(option: &StudyOption) -> Vec<String> {
    option.settings.iter().map(|setting| setting.field.value.clone()).collect()
}

/// By option: the first that it differs from in strengths alone, most often itself.
fn families(study: &Study, options: &[OptionPlan]) -> Vec<usize> {
    let drawn: Vec<&str> = study.priors.iter().map(super::encounter::field_of).collect();
    let first = |option: usize| {
        (0..option)
            .find(|other| same::family(&options[option], &options[*other], &drawn))
            .unwrap_or(option)
    };
    (0..options.len()).map(first).collect()
}

/// The file of the baseline scenario: of the library by its id, or beside the study by its path.
fn scenario(study: &Study, path: &Path, root: &Path) -> Result<(PathBuf, String), Error> {
    let named = &study.scenario.value;
    let file = match named.ends_with(".toml") {
        true => path.parent().unwrap_or(Path::new("")).join(named),
        false => root.join("scenarios").join(format!("{named}.toml")),
    };
    let text = std::fs::read_to_string(&file).map_err(|error| {
        let folder = std::fs::read_dir(root.join("scenarios")).into_iter().flatten().flatten();
        let mut ids: Vec<String> = folder
            .map(|entry| entry.path())
            .filter_map(|path| Some(path.file_stem()?.to_string_lossy().into_owned()))
            .collect();
        ids.sort();
        let help = hint(named, ids.iter().map(String::as_str));
        Error::Diagnostics(vec![
            study
                .scenario
                .place
                .error(format!("the scenario {} cannot be read: {error}", file.display()), help),
        ])
    })?;
    Ok((file, text))
}

/// What options are differences from.
struct Base<'a> {
    study: &'a Study,
    name: String,
    text: String,
    sources: &'a Sources,
    host: &'a PluginHost,
}

impl Base<'_> {
    fn option(&self, option: &StudyOption) -> Result<OptionPlan, Error> {
        let scenario = Document::parse(&self.text)
            .map_err(|error| Error::Replay(format!("{}: {}", self.name, error.message)))?;
        let mut sources = self.sources.clone();
        let mut edited = scenario.clone();
        self.put(option, &mut edited, &mut sources)?;
        let prepared = self.prepare(option, &edited, &sources)?;
        let settings = option
            .settings
            .iter()
            .filter(|setting| setting.library_field().is_none())
            .cloned()
            .collect();
        Ok(OptionPlan {
            id: option.id.value.clone(),
            name: option.name.clone(),
            strength_n: option.strength_n,
            curve: option.curve.clone(),
            own: own(option),
            sets: option
                .settings
                .iter()
                .map(|setting| (setting.field.value.clone(), setting.value.written()))
                .collect(),
            settings,
            removes: option.removes.iter().map(|field| field.value.clone()).collect(),
            scenario,
            scenario_name: self.name.clone(),
            sources,
            prepared,
        })
    }

    fn put(
        &self,
        option: &StudyOption,
        scenario: &mut Document,
        sources: &mut Sources,
    ) -> Result<(), Error> {
        let told = |field: &endline_gear::At<String>, error: EditError, help: &str| {
            Error::Diagnostics(vec![field.place.error(error.message, help)])
        };
        for field in &option.removes {
            scenario
                .remove(&field.value)
                .map_err(|error| told(field, error, "name a field of the baseline scenario"))?;
        }
        for setting in &option.settings {
            let Some((file, field)) = setting.library_field() else {
                let help = "name a field of the scenario by its dotted path, such as gear.0.attributes.buoy";
                scenario
                    .put(&setting.field.value, &setting.value)
                    .map_err(|error| told(&setting.field, error, help))?;
                continue;
            };
            let Some(text) = sources.get(&file) else {
                let known: Vec<&str> = sources.iter().map(|(path, _)| path).collect();
                return Err(Error::Diagnostics(vec![
                    setting
                        .field
                        .place
                        .error(format!("the library has no file {file}"), hint(&file, known)),
                ]));
            };
            let mut item =
                Document::parse(text).map_err(|error| told(&setting.field, error, ""))?;
            item.put(field, &setting.value)
                .map_err(|error| told(&setting.field, error, "name a field of the item"))?;
            let text = item.text();
            sources.set(file, text);
        }
        Ok(())
    }

    /// The option assembled as it stands; a fault that one of its settings brought in is told at that setting.
    fn prepare(
        &self,
        option: &StudyOption,
        scenario: &Document,
        sources: &Sources,
    ) -> Result<Prepared, Error> {
        // What is drawn stands in the place of what the option leaves open, so that drawn values are checked too.
        let mut text = scenario.clone();
        let drawn = draw::draw(&self.study.priors, self.study.seed, 0);
        let mut sources = sources.clone();
        super::encounter::put_drawn(
            &mut text,
            &mut sources,
            &self.study.priors,
            &drawn,
            &own(option),
        )?;
        let source = Source {
            scenario_name: self.name.clone(),
            scenario: text.text(),
            library: sources,
            overrides: Overrides::default(),
        };
        source.prepare(self.host).map_err(|error| match error {
            Error::Diagnostics(problems) => Error::Diagnostics(
                problems.into_iter().map(|problem| self.relocate(option, problem)).collect(),
            ),
            error => error,
        })
    }

    fn relocate(&self, option: &StudyOption, problem: Diagnostic) -> Diagnostic {
        let leads_to = |field: &str| {
            !problem.field.is_empty()
                && (field == problem.field || field.starts_with(&format!("{}.", problem.field)))
        };
        let by_option = option.settings.iter().find(|setting| {
            let field =
                setting.library_field().map_or(setting.field.value.as_str(), |(_, field)| field);
            leads_to(field)
        });
        let by_prior =
            self.study.priors.iter().find(|prior| leads_to(super::encounter::field_of(prior)));
        let place = by_option
            .map(|setting| &setting.field.place)
            .or(by_prior.map(|prior| &prior.name.place));
        place.map_or(problem.clone(), |place| {
            place.error(
                format!("option `{}`: {}", option.id.value, problem.message),
                problem.help.clone(),
            )
        })
    }
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
