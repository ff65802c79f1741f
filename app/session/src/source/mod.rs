//! From files to a model: the scenario, the gear library and the options of a run.

#[cfg(test)]
pub(crate) mod sample;

use std::path::{Path, PathBuf};
use std::sync::Arc;

use endline_gear::limits::{Beyond, STEP, amount};
use endline_gear::units::Quantity;
use endline_gear::{
    Assembled, Diagnostic, Document, EditError, Library, Options, Scenario, Setting, Sources,
    StrengthBudget, assemble_traced, hint, library_field,
};
use endline_sdk::Descriptor;
use endline_sim::Model;
use endline_sim::model::ModelError;
use serde::{Deserialize, Serialize};

use crate::error::Error;
use crate::locate;
use crate::plugins::{PluginHost, PluginUsed};

/// Values that a user sets over those of a scenario.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Overrides {
    /// Seed.
    pub seed: Option<u64>,
    /// Step between inputs [s].
    pub step_s: Option<f64>,
    /// Weak links on or off.
    pub weak_links: Option<bool>,
    /// Rating of every weak link [N].
    pub rating_n: Option<f64>,
    /// Whether the whale is kinetic.
    pub kinetic: Option<bool>,
}

impl Overrides {
    /// These values, and another's where none is set.
    pub fn or(self, other: Self) -> Self {
        Self {
            seed: self.seed.or(other.seed),
            step_s: self.step_s.or(other.step_s),
            weak_links: self.weak_links.or(other.weak_links),
            rating_n: self.rating_n.or(other.rating_n),
            kinetic: self.kinetic.or(other.kinetic),
        }
    }
}

/// All texts that a model is made from, as a recording stores them.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Source {
    /// The scenario's file as the user named it.
    pub scenario_name: String,
    /// Text of the scenario.
    pub scenario: String,
    /// Text of the files of the gear library; once prepared, of those the model is made from.
    pub library: Sources,
    /// Values set over the scenario's.
    pub overrides: Overrides,
}

/// A model ready to run, with its sources.
#[derive(Clone)]
pub struct Prepared {
    /// The files and options.
    pub source: Arc<Source>,
    /// The model.
    pub model: Arc<Model>,
    /// The plugins it runs on.
    pub plugins: Vec<PluginUsed>,
    /// The strengths of its lines and weak links, with their factors.
    pub strengths: Arc<[StrengthBudget]>,
}

impl Prepared {
    /// Whether another model differs at most in the whale's pilot program.
    pub fn differs_in_pilot_alone(&self, other: &Self) -> bool {
        let without_pilot = |source: &Source| {
            let mut document = Document::parse(&source.scenario).ok()?;
            if document.has(PILOT) {
                document.remove(PILOT).ok()?;
            }
            Some(document.text())
        };
        let (own, other_source) = (&self.source, &other.source);
        self.plugins == other.plugins
            && own.library == other_source.library
            && own.overrides == other_source.overrides
            && without_pilot(own) == without_pilot(other_source)
    }
}

/// Reads a scenario, by its file or by its id in the library, and its gear library (found as [`locate::library`] says where `library` is
/// `None`) and assembles the model.
pub fn prepare(
    scenario: &Path,
    library: Option<&Path>,
    host: &PluginHost,
    overrides: Overrides,
) -> Result<Prepared, Error> {
    Source::read(scenario, library, overrides)?.prepare_with_clips(host)
}

/// The pilot program in a scenario.
const PILOT: &str = "whale.pilot";

/// Why a field cannot be set, and how to correct it.
pub(crate) struct FieldError {
    pub message: String,
    pub help: String,
}

/// Sets a field of a scenario, or of a library file as `ropes/sink-3-8.strength`.
pub(crate) fn set_field(
    scenario: &mut Document,
    library: &mut Sources,
    field: &str,
    value: &Setting,
) -> Result<(), FieldError> {
    let failed =
        |error: EditError, help: &str| FieldError { message: error.message, help: help.to_owned() };
    let Some((file, own)) = library_field(field) else {
        let help =
            "name a field of the scenario by its dotted path, such as gear.0.attributes.buoy";
        return scenario.put(field, value).map_err(|error| failed(error, help));
    };
    let Some(text) = library.get(&file) else {
        let help = hint(&file, library.iter().map(|(path, _)| path));
        return Err(FieldError { message: format!("the library has no file {file}"), help });
    };
    let mut item = Document::parse(text).map_err(|error| failed(error, "correct the file"))?;
    item.put(own, value).map_err(|error| failed(error, "name a field of the item"))?;
    library.set(file, item.text());
    Ok(())
}

fn library_at(scenario: Option<&Path>, given: Option<&Path>) -> Result<Sources, Error> {
    let root: PathBuf = locate::library(scenario, given).map_err(Error::Message)?;
    Sources::from_folder(&root).map_err(Error::Diagnostics)
}

impl Source {
    /// The texts of a scenario and its library, without overrides; `name` is the scenario's in messages.
    pub fn new(name: impl ToString, scenario: String, library: Sources) -> Self {
        let (scenario_name, overrides) = (name.to_string(), Overrides::default());
        Self { scenario_name, scenario, library, overrides }
    }

    /// Reads the files.
    pub fn read(
        scenario: &Path,
        library: Option<&Path>,
        overrides: Overrides,
    ) -> Result<Self, Error> {
        let by_id = match scenario.is_file() {
            true => None,
            false => {
                let id = scenario.to_string_lossy();
                Some(locate::named(&id, "scenarios", library).map_err(Error::Message)?)
            }
        };
        let scenario = by_id.as_deref().unwrap_or(scenario);
        let text =
            endline_gear::read::text(scenario).map_err(Error::on(scenario, "cannot be read"))?;
        let library = library_at(Some(scenario), library)?;
        Ok(Self {
            scenario_name: scenario.display().to_string(),
            scenario: text,
            library,
            overrides,
        })
    }

    /// A scenario that is a text and no file, such as standard input; `name` is its name in errors and in the summary.
    pub fn of_text(
        (name, text): (&str, String),
        library: Option<&Path>,
        overrides: Overrides,
    ) -> Result<Self, Error> {
        let library = library_at(None, library)?;
        Ok(Self { scenario_name: name.to_owned(), scenario: text, library, overrides })
    }

    /// Sets fields as the options of a study do: of the scenario, such as `current.speed`, or of a library file, such as
    /// `ropes/sink-3-8.strength`.
    /// Errors: a field that cannot be there, or a library file that does not exist.
    pub fn set(&mut self, changes: &[(String, Setting)]) -> Result<(), Error> {
        if changes.is_empty() {
            return Ok(());
        }
        let message =
            |error: FieldError| Error::Message(format!("{}; {}", error.message, error.help));
        let mut scenario = Document::parse(&self.scenario)?;
        for (field, value) in changes {
            set_field(&mut scenario, &mut self.library, field, value).map_err(message)?;
        }
        self.scenario = scenario.text();
        Ok(())
    }

    /// Prepares with the clips of the host's plugins in the library.
    pub fn prepare_with_clips(mut self, host: &PluginHost) -> Result<Prepared, Error> {
        self.library = host.with_clips(self.library);
        self.prepare(host)
    }

    /// Reads the texts and assembles the model.
    pub fn prepare(self, host: &PluginHost) -> Result<Prepared, Error> {
        self.prepare_with(host, true)
    }

    /// Prepares one of many runs, without a balance of momentum and energy unless the scenario asks for it.
    pub fn prepare_for_study(self, host: &PluginHost) -> Result<Prepared, Error> {
        self.prepare_with(host, false)
    }

    fn prepare_with(mut self, host: &PluginHost, balance: bool) -> Result<Prepared, Error> {
        let (model, used, strengths) = self.model(host, balance)?;
        self.library = self.library.only(&used);
        let plugins = plugins_of(&model, host);
        Ok(Prepared {
            source: Arc::new(self),
            model: Arc::new(model),
            plugins,
            strengths: strengths.into(),
        })
    }

    /// BLAKE3 of everything the model is made from, hexadecimal.
    pub fn hash(&self) -> String {
        let mut hasher = blake3::Hasher::new();
        let mut text = |text: &str| {
            hasher.update(&(text.len() as u64).to_le_bytes());
            hasher.update(text.as_bytes());
        };
        text(&self.scenario);
        for (path, content) in self.library.iter() {
            text(path);
            text(content);
        }
        text(&format!("{:?}", self.overrides));
        for (path, bytes) in self.library.meshes() {
            hasher.update(path.as_bytes());
            hasher.update(blake3::hash(bytes).as_bytes());
        }
        hasher.finalize().to_hex().to_string()
    }
}

impl Source {
    /// The model, the library files it was made from, and the strengths of its lines and weak links.
    fn model(
        &self,
        host: &PluginHost,
        balance: bool,
    ) -> Result<(Model, Vec<String>, Vec<StrengthBudget>), Error> {
        let name = &self.scenario_name;
        let scenario = Scenario::read(name, &self.scenario)?;
        let (library, problems) = Library::read(&self.library);
        let Overrides { seed, step_s, weak_links, rating_n, kinetic } = self.overrides;
        if let Some(step_s) = step_s {
            let beyond =
                |beyond: Beyond| Error::Message(format!("{}; {}", beyond.message, beyond.help));
            STEP.check("the step asked for", step_s).map_err(beyond)?;
        }
        let options = Options { seed, step_s, weak_links, kinetic, balance, ..Options::default() };
        // An item with errors is missing from the library; its own errors say why, so they come first.
        let Assembled { mut spec, files, mut strengths } =
            assemble_traced(&scenario, &library, host, &options).map_err(|missing| {
                Error::Diagnostics(
                    problems.into_iter().filter(Diagnostic::is_error).chain(missing).collect(),
                )
            })?;
        if let Some(rating_n) = rating_n {
            let whole = scenario.place.clone();
            amount(Quantity::Force)
                .check("rating", rating_n)
                .map_err(|beyond| beyond.at(&whole))?;
            spec.links.iter_mut().for_each(|link| link.rating_n = rating_n);
            // A rating that is given has no budget.
            strengths.retain(|budget| spec.links.iter().all(|link| link.id != budget.part));
        }
        let model = Model::new(spec).map_err(|errors| {
            let as_error = |error: ModelError| {
                Diagnostic::of_file(name, format!("{}: {}", error.part, error.message), "")
            };
            Error::Diagnostics(errors.into_iter().map(as_error).collect())
        })?;
        Ok((model, files, strengths))
    }
}

/// The plugins a model runs on, by id.
fn plugins_of(model: &Model, host: &PluginHost) -> Vec<PluginUsed> {
    let spec = &model.spec;
    let motion = spec.whale.iter().map(|whale| whale.motion.descriptor());
    let friction =
        spec.friction.iter().flat_map(|friction| &friction.laws).map(|law| law.model.descriptor());
    let gear = spec.gear.iter().map(|hook| hook.gear.descriptor());
    let used = |descriptor: &Descriptor| PluginUsed {
        id: descriptor.id.to_string(),
        version: descriptor.version.to_string(),
        file_hash: file_hash(host, &descriptor.id),
    };
    let mut plugins: Vec<PluginUsed> = motion.chain(friction).chain(gear).map(used).collect();
    plugins.sort();
    plugins.dedup();
    plugins
}

/// Hash of the file a plugin was loaded from; empty where it is linked in.
fn file_hash(host: &PluginHost, id: &str) -> String {
    host.list()
        .iter()
        .find(|plugin| plugin.id == id)
        .and_then(|plugin| plugin.hash.clone())
        .unwrap_or_default()
}

/// The file of an assembly, with the library around it.
pub struct AssemblyFile {
    /// Id of the assembly.
    pub id: String,
    /// Text of its file.
    pub text: String,
    /// The library, this text in it.
    pub sources: Sources,
    /// The library's folder.
    pub root: PathBuf,
}

impl AssemblyFile {
    /// Opens an assembly by its id in the library, or by its file.
    pub fn open(named: &str, library: Option<&Path>) -> Result<Self, Error> {
        let path = locate::named(named, "assemblies", library).map_err(Error::Message)?;
        let root = locate::library(Some(&path), library).map_err(Error::Message)?;
        let mut sources = Sources::from_folder(&root)?;
        let text = endline_gear::read::text(&path).map_err(Error::on(&path, "cannot be read"))?;
        let id =
            path.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default();
        sources.set(format!("assemblies/{id}.toml"), text.clone());
        Ok(Self { id, text, sources, root })
    }

    /// The library read.
    pub fn library(&self) -> Result<Library, Error> {
        library_of(&self.id, &self.sources)
    }
}

/// A library read whose assembly of this id is without error.
pub(crate) fn library_of(id: &str, sources: &Sources) -> Result<Library, Error> {
    let file = format!("assemblies/{id}.toml");
    let (library, problems) = Library::read(sources);
    let own: Vec<Diagnostic> =
        problems.into_iter().filter(|problem| problem.is_error() && problem.file == file).collect();
    if own.is_empty() { Ok(library) } else { Err(Error::Diagnostics(own)) }
}

/// The text of a scenario: a head, with settings put into it by field.
pub(crate) fn written(head: &str, settings: &[(&str, Setting)]) -> Result<String, Error> {
    let failed = |error: EditError| Diagnostic::of_file("scenario", error.message, "");
    let mut document = Document::parse(head).map_err(failed)?;
    for (field, value) in settings {
        document.put(field, value).map_err(failed)?;
    }
    Ok(document.text())
}
