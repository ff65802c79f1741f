//! The texts being edited: library files, the scenario, a study and an observation, with undo, saving and problems.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use endline_gear::{Diagnostic, Document, Library, Sources};

use super::figures;
use super::history::{Change, History};
use super::problems::{Named, Problems};
use super::saving::{free_file, slug};
use super::texts::Texts;
use crate::{save, shipped};

/// All texts that are open. The key of a library file is its path in the library's folder, such as
/// `ropes/x.toml`; the scenario's is [`SCENARIO`](Self::SCENARIO), the study's
/// [`STUDY`](Self::STUDY), the observation's [`OBSERVATION`](Self::OBSERVATION).
pub struct Documents {
    pub(super) root: PathBuf,
    pub(super) scenario_path: PathBuf,
    study_path: Option<PathBuf>,
    observation_path: Option<PathBuf>,
    pub(super) texts: Texts,
    history: History,
    problems: Problems,
    library: Arc<Library>,
    /// Texts of files that were changed on disk since they were read and have edits here too, by path, as they are on disk.
    pub(super) newer: BTreeMap<String, String>,
    /// Grows with every change of a text.
    version: u64,
    /// Meshes of the library's folder, as they were when it was opened.
    meshes: Sources,
    /// Files of the library that came with the program.
    pub(super) bundled: shipped::Files,
}

impl Documents {
    /// Key of the scenario's text.
    pub const SCENARIO: &'static str = "scenario";

    /// Key of the study's text, where one is open.
    pub const STUDY: &'static str = "study";

    /// Key of the observation's text, where one is open.
    pub const OBSERVATION: &'static str = "observation";

    /// Opens the library in a folder and a scenario.
    /// Errors: with every file that cannot be read.
    pub fn open(root: &Path, scenario_path: &Path) -> Result<Self, String> {
        let explain = |all: Vec<Diagnostic>| {
            all.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n")
        };
        let sources = Sources::from_folder(root).map_err(explain)?;
        let mut texts: BTreeMap<String, String> =
            sources.iter().map(|(path, text)| (path.to_owned(), text.to_owned())).collect();
        texts.insert(Self::SCENARIO.to_owned(), read_text(scenario_path)?);
        let mut documents = Self {
            root: root.to_owned(),
            scenario_path: scenario_path.to_owned(),
            study_path: None,
            observation_path: None,
            texts: Texts::new(texts),
            history: History::default(),
            problems: Problems::default(),
            library: Arc::default(),
            newer: BTreeMap::new(),
            version: 0,
            meshes: Sources::default().with_meshes_of(&sources),
            bundled: shipped::carried(),
        };
        documents.read_all();
        Ok(documents)
    }

    /// Opens another scenario in place of the present one.
    /// Errors: where its file cannot be read; the present one then stays.
    pub fn open_scenario(&mut self, path: &Path) -> Result<(), String> {
        let text = read_text(path)?;
        self.scenario_path = path.to_owned();
        self.begin(Self::SCENARIO, text);
        Ok(())
    }

    /// Opens a study in place of the present one.
    /// Errors: where its file cannot be read; the present one then stays.
    pub fn open_study(&mut self, path: &Path) -> Result<(), String> {
        let text = read_text(path)?;
        self.study_path = Some(path.to_owned());
        self.begin(Self::STUDY, text);
        Ok(())
    }

    /// Opens an observation in place of the present one.
    /// Errors: where its file cannot be read; the present one then stays.
    pub fn open_observation(&mut self, path: &Path) -> Result<(), String> {
        let text = read_text(path)?;
        self.observation_path = Some(path.to_owned());
        self.begin(Self::OBSERVATION, text);
        Ok(())
    }

    /// Sets the text of a key as its file has it; earlier edits under this key are forgotten.
    fn begin(&mut self, key: &str, text: String) {
        self.history.forget(key);
        self.texts.put(key, Some(text));
        self.texts.mark_saved(key);
        self.read_all();
    }

    /// The library's folder.
    pub fn root(&self) -> &Path {
        &self.root
    }

    /// The scenario's file.
    pub fn scenario_path(&self) -> &Path {
        &self.scenario_path
    }

    /// The study's file, where one is open.
    pub fn study_path(&self) -> Option<&Path> {
        self.study_path.as_deref()
    }

    /// The observation's file, where one is open.
    pub fn observation_path(&self) -> Option<&Path> {
        self.observation_path.as_deref()
    }

    /// The library as read from the present texts; items with errors are missing.
    pub fn library(&self) -> &Arc<Library> {
        &self.library
    }

    /// A number that grows with every change of a text.
    pub fn version(&self) -> u64 {
        self.version
    }

    /// Every problem of the present texts, by file and place; the scenario's under its file's name.
    pub fn problems(&self) -> &[Diagnostic] {
        self.problems.all()
    }

    /// Whether any text of gear or scenario has an error; study and observation have no part in a single run.
    pub fn any_error(&self) -> bool {
        self.problems
            .any_error_outside(&[Self::STUDY, Self::OBSERVATION].map(|key| self.shown_name(key)))
    }

    /// The worst problem at a field of a file.
    pub fn problem_at(&self, path: &str, field: &str) -> Option<&Diagnostic> {
        if self.problems.is_empty() {
            return None;
        }
        self.problems.at(&self.shown_name(path), field)
    }

    /// Whether a file has an error anywhere.
    pub fn file_has_error(&self, path: &str) -> bool {
        !self.problems.is_empty() && self.problems.any_error_in(&self.shown_name(path))
    }

    /// The name under which problems of a text are reported.
    pub fn shown_name(&self, path: &str) -> String {
        self.file_outside(path).map_or_else(|| path.to_owned(), |file| file.display().to_string())
    }

    /// The file of a text that is none of the library's gear.
    pub(super) fn file_outside(&self, key: &str) -> Option<&Path> {
        match key {
            Self::SCENARIO => Some(&self.scenario_path),
            Self::STUDY => self.study_path.as_deref(),
            Self::OBSERVATION => self.observation_path.as_deref(),
            _ => None,
        }
    }

    /// Paths of the files in a folder of the library.
    pub fn files<'a>(&'a self, folder: &'a str) -> impl Iterator<Item = &'a str> {
        let in_folder =
            move |path: &&str| path.split_once('/').is_some_and(|(before, _)| before == folder);
        self.texts.present().keys().map(String::as_str).filter(in_folder)
    }

    /// The present text of a file.
    pub fn text(&self, path: &str) -> Option<&str> {
        self.texts.get(path)
    }

    /// The text of a file as it is on disk.
    pub fn saved_text(&self, path: &str) -> Option<&str> {
        self.texts.saved(path)
    }

    /// Every present text, by path; the scenario by [`SCENARIO`](Self::SCENARIO).
    pub fn texts(&self) -> &BTreeMap<String, String> {
        self.texts.present()
    }

    /// The library's present texts.
    pub fn sources(&self) -> Sources {
        let of_library = |path: &str| is_of_run(path) && path != Self::SCENARIO;
        Sources::from_map(self.copies(of_library)).with_meshes_of(&self.meshes)
    }

    /// The texts a single run is made from: all but the study's and the observation's.
    pub fn texts_of_run(&self) -> BTreeMap<String, String> {
        self.copies(is_of_run)
    }

    fn copies(&self, wanted: impl Fn(&str) -> bool) -> BTreeMap<String, String> {
        let texts = self.texts.present().iter().filter(|(path, _)| wanted(path));
        texts.map(|(path, text)| (path.clone(), text.clone())).collect()
    }

    /// Whether these are the [texts of a run](Self::texts_of_run) as they stand.
    pub fn same_run(&self, texts: &BTreeMap<String, String>) -> bool {
        texts.iter().eq(self.texts.present().iter().filter(|(path, _)| is_of_run(path)))
    }

    /// A field as typed; `None` where it is missing.
    pub fn field(&self, path: &str, field: &str) -> Option<String> {
        self.texts.parsed(path)?.get(field)
    }

    /// Whether a text has a field, table or list of this path.
    pub fn has(&self, path: &str, field: &str) -> bool {
        self.texts.parsed(path).is_some_and(|document| document.has(field))
    }

    /// Keys of a table of a text, in the order of its file.
    pub fn keys(&self, path: &str, table: &str) -> Vec<String> {
        self.texts.parsed(path).map_or_else(Vec::new, |document| document.keys(table))
    }

    /// How many tables a list of a file has, such as `whale.pilot` of the scenario.
    pub fn count(&self, path: &str, list: &str) -> usize {
        self.texts.parsed(path).map_or(0, |document| document.count(list))
    }

    /// A text as a document.
    /// Errors: where the file is not open or not TOML.
    pub fn document(&self, path: &str) -> Result<Document, String> {
        let text = self.texts.get(path).ok_or_else(|| format!("{path} is not open"))?;
        Document::parse(text).map_err(|error| format!("{path}: {error}"))
    }

    /// Ids of the assemblies that the scenario places, singly and then in fields.
    pub fn placed_assemblies(&self) -> impl Iterator<Item = String> {
        ["gear", "field"].into_iter().flat_map(move |table| {
            let of = move |index: u32| format!("{table}.{index}.assembly");
            (0..).map_while(move |index| self.field(Self::SCENARIO, &of(index)))
        })
    }

    /// Whether the scenario or one of its assemblies names a library file by its id.
    pub fn in_use(&self, path: &str) -> bool {
        let id = path.rsplit('/').next().unwrap_or(path).trim_end_matches(".toml");
        let named = format!("\"{id}\"");
        let files = self
            .placed_assemblies()
            .map(|assembly| format!("assemblies/{assembly}.toml"))
            .chain([Self::SCENARIO.to_owned()]);
        files.filter_map(|file| self.text(&file)).any(|text| text.contains(&named))
    }

    /// A path in a folder of the library that no file has, from a stem such as `my-rope`.
    pub fn fresh_path(&self, folder: &str, stem: &str) -> String {
        let taken = |path: &String| self.texts.present().contains_key(path);
        let first = format!("{folder}/{stem}.toml");
        if !taken(&first) {
            return first;
        }
        let mut numbered = (2..).map(|number| format!("{folder}/{stem}-{number}.toml"));
        numbered.find(|candidate| !taken(candidate)).unwrap_or(first)
    }

    /// Sets a field; comments and order stay. Setting a value that is already there changes nothing. A bare number takes the unit of
    /// the value before it. A figure of a library entry
    /// loses the source of its old value. Answers what else changed, in a sentence.
    /// Errors: where the file is not TOML or has no such place.
    pub fn set(&mut self, path: &str, field: &str, value: &str) -> Result<Option<String>, String> {
        let before = self.field(path, field);
        if before.as_deref() == Some(value) {
            return Ok(None);
        }
        let measured = before.and_then(|before| figures::with_unit_before(value, &before));
        let value = measured.as_deref().unwrap_or(value);
        let mut said = measured.as_ref().map(|taken| format!("read as {taken}"));
        self.alter(path, |document| {
            let also = figures::set(document, path, field, value);
            said = also.map_err(|error| error.to_string())?.or(said.take());
            Ok(())
        })?;
        Ok(said)
    }

    /// Sets a field from a control that is still moving: successive values are one edit.
    /// Errors: as [`set`](Self::set).
    pub fn set_held(&mut self, path: &str, field: &str, value: &str) -> Result<(), String> {
        let held = format!("{path}#{field}");
        let (joins, before) = (self.history.is_held(&held), self.version);
        self.set(path, field, value)?;
        if self.version != before {
            if joins {
                self.history.join();
            }
            self.history.hold(held);
        }
        Ok(())
    }

    /// A control was released: its next value is an edit of its own.
    pub fn let_go(&mut self) {
        self.history.release();
    }

    /// Changes a text as a document; comments and order stay. A change that fails leaves the text
    /// as it was.
    /// Errors: where the file is not open or not TOML, or where `change` fails.
    pub fn alter(
        &mut self,
        path: &str,
        change: impl FnOnce(&mut Document) -> Result<(), String>,
    ) -> Result<(), String> {
        let text = self.altered(path, change)?;
        self.change(vec![(path.to_owned(), Some(text))]);
        Ok(())
    }

    /// A text as a change would leave it.
    /// Errors: as [`alter`](Self::alter).
    pub fn altered(
        &self,
        path: &str,
        change: impl FnOnce(&mut Document) -> Result<(), String>,
    ) -> Result<String, String> {
        let mut document = self.document(path)?;
        change(&mut document)?;
        Ok(document.text())
    }

    /// Puts another scenario in the place of the open one, to be saved as a file of its own: named after the scenario and `what`,
    /// beside the open one, and none that is there. One undo brings the text of the open one back.
    pub(crate) fn put_scenario_as_new(&mut self, text: String, what: &str) -> &Path {
        let name = Document::parse(&text).ok().and_then(|document| document.get("name"));
        let stem = slug(&format!("{} {what}", name.unwrap_or_default()));
        let folder = self.scenario_path.parent().unwrap_or(&self.root);
        // A save asks before it writes over a file, should every name be taken.
        let free = free_file(folder, &stem);
        self.scenario_path = free.unwrap_or_else(|| folder.join(format!("{stem}.toml")));
        self.texts.read(Self::SCENARIO, None);
        self.put_all(vec![(Self::SCENARIO.to_owned(), text)]);
        &self.scenario_path
    }

    /// Gives the scenario, the study or the observation another file, which is not there yet.
    pub(super) fn move_outside(&mut self, key: &str, file: PathBuf) {
        match key {
            Self::STUDY => self.study_path = Some(file),
            Self::OBSERVATION => self.observation_path = Some(file),
            _ => self.scenario_path = file,
        }
        self.texts.read(key, None);
    }

    /// Sets several texts at once, new files among them; one undo takes all of it back.
    pub fn put_all(&mut self, texts: Vec<(String, String)>) {
        self.change(texts.into_iter().map(|(path, text)| (path, Some(text))).collect());
    }

    /// Sets and removes texts at once, such as those kept over a crash; one undo takes all of it
    /// back.
    pub fn restore(&mut self, texts: Vec<(String, Option<String>)>) {
        self.change(texts);
    }

    /// Removes a file; undo brings it back. Saving deletes it from the disk.
    pub fn remove(&mut self, path: &str) {
        self.change(vec![(path.to_owned(), None)]);
    }

    /// Adds a copy of a library file under a fresh id and returns its path. Its figures are marked as copied and not verified.
    /// Errors: where there is no such file or it is not TOML.
    pub fn duplicate(&mut self, path: &str) -> Result<String, String> {
        let mut document = self.document(path)?;
        let (folder, file) = path.split_once('/').unwrap_or(("", path));
        let id = file.trim_end_matches(".toml");
        let fresh = self.fresh_path(folder, id);
        let original = document.clone();
        figures::mark_copied(&mut document, id, &original).map_err(|error| error.to_string())?;
        let name = document.get("name").unwrap_or_default();
        document.set("name", &format!("{name} (copy)")).map_err(|error| error.to_string())?;
        self.change(vec![(fresh.clone(), Some(document.text()))]);
        Ok(fresh)
    }

    /// Writes a copy of the open study to a fresh file in the library and opens it; returns its path.
    /// Errors: where no study is open, or the copy cannot be written.
    pub fn duplicate_study(&mut self) -> Result<PathBuf, String> {
        let path = self.study_path.as_deref().ok_or("open a study first")?;
        let fresh = self.copy_beside(Self::STUDY, path, "studies")?;
        self.open_study(&fresh)?;
        Ok(fresh)
    }

    /// Writes a copy of the open observation to a fresh file in the library and opens it; returns its path.
    /// Errors: where no observation is open, or the copy cannot be written.
    pub fn duplicate_observation(&mut self) -> Result<PathBuf, String> {
        let path = self.observation_path.as_deref().ok_or("open an observation first")?;
        let fresh = self.copy_beside(Self::OBSERVATION, path, "observations")?;
        self.open_observation(&fresh)?;
        Ok(fresh)
    }

    /// Writes a new observation to a fresh file in the library and opens it; returns its path.
    /// Errors: where it cannot be written.
    pub fn new_observation(&mut self, text: &str) -> Result<PathBuf, String> {
        let fresh = self.fresh_file("observations", "observation")?;
        save::atomically(&fresh, text.as_bytes())
            .map_err(|error| format!("{}: {error}", fresh.display()))?;
        self.open_observation(&fresh)?;
        Ok(fresh)
    }

    /// Writes a new study to a fresh file in the library; returns its path.
    /// Errors: where it cannot be written.
    pub fn new_study(&self, stem: &str, text: &str) -> Result<PathBuf, String> {
        let fresh = self.fresh_file("studies", stem)?;
        save::atomically(&fresh, text.as_bytes())
            .map_err(|error| format!("{}: {error}", fresh.display()))?;
        Ok(fresh)
    }

    /// Writes a copy of a text to a fresh file in a folder of the library.
    fn copy_beside(&self, key: &str, path: &Path, folder: &str) -> Result<PathBuf, String> {
        let stem = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let fresh = self.fresh_file(folder, &stem)?;
        let failed = |message: String| format!("{}: {message}", fresh.display());
        let mut document = self.document(key)?;
        let name = document.get("name").unwrap_or_default();
        document.set("name", &format!("{name} (copy)")).map_err(|error| failed(error.message))?;
        save::atomically(&fresh, document.text().as_bytes())
            .map_err(|error| failed(error.to_string()))?;
        Ok(fresh)
    }

    /// A file in a folder of the library that is not there yet; the folder is made.
    fn fresh_file(&self, folder: &str, stem: &str) -> Result<PathBuf, String> {
        let folder = self.root.join(folder);
        std::fs::create_dir_all(&folder)
            .map_err(|error| format!("{}: {error}", folder.display()))?;
        let numbered = (2..1000).map(|number| folder.join(format!("{stem}-{number}.toml")));
        let mut files = std::iter::once(folder.join(format!("{stem}.toml"))).chain(numbered);
        files.find(|path| !path.exists()).ok_or_else(|| "there are 1000 copies already".to_owned())
    }

    pub(super) fn change(&mut self, texts: Vec<(String, Option<String>)>) {
        let change = |(path, after): (String, Option<String>)| Change {
            before: self.texts.get(&path).map(str::to_owned),
            path,
            after,
        };
        let changes: Vec<Change> =
            texts.into_iter().map(change).filter(|change| change.before != change.after).collect();
        if changes.is_empty() {
            return;
        }
        changes.iter().for_each(|change| self.texts.put(&change.path, change.after.clone()));
        self.history.record(changes);
        self.read_all();
    }

    /// Takes the last edit back; false where there is none.
    pub fn undo(&mut self) -> bool {
        let Some(changes) = self.history.undo() else { return false };
        for change in changes.iter().rev() {
            self.texts.put(&change.path, change.before.clone());
        }
        self.read_all();
        true
    }

    /// Makes the edit again that was taken back last; false where there is none.
    pub fn redo(&mut self) -> bool {
        let Some(changes) = self.history.redo() else { return false };
        changes.iter().for_each(|change| self.texts.put(&change.path, change.after.clone()));
        self.read_all();
        true
    }

    /// Whether there is an edit to undo, and one to redo.
    pub fn can_undo_redo(&self) -> (bool, bool) {
        self.history.can_undo_redo()
    }

    /// Paths of texts that differ from their files.
    pub fn unsaved(&self) -> &[String] {
        self.texts.unsaved()
    }

    /// Whether a text differs from its file.
    pub fn is_unsaved(&self, path: &str) -> bool {
        self.texts.get(path) != self.texts.saved(path)
    }

    /// Reads all texts again: the library, and every problem.
    pub(super) fn read_all(&mut self) {
        self.texts.refresh();
        let outside = [Self::SCENARIO, Self::STUDY, Self::OBSERVATION]
            .map(|key| (self.shown_name(key), self.texts.get(key)));
        let named = outside.each_ref().map(|(name, text)| text.map(|text| Named { name, text }));
        let (library, problems) = Problems::of(&self.sources(), named);
        (self.library, self.problems) = (Arc::new(library), problems);
        self.version += 1;
    }
}

/// Whether a text has a part in a single run.
fn is_of_run(path: &str) -> bool {
    ![Documents::STUDY, Documents::OBSERVATION].contains(&path)
}

fn read_text(path: &Path) -> Result<String, String> {
    endline_gear::read::text(path)
        .map_err(|error| format!("{}: cannot be read: {error}", path.display()))
}
