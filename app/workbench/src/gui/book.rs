//! The texts being edited: library files and the scenario, with undo, save and located problems.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use endline_gear::{Diagnostic, Document, Library, Scenario, Sources, Study, save_text};

/// Edits that can be taken back.
const UNDO_DEPTH: usize = 500;

/// One change of one text.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Change {
    path: String,
    /// The text before; `None` where the file is new.
    before: Option<String>,
    /// The text after; `None` where the file goes.
    after: Option<String>,
}

/// What one undo takes back: changes made together.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Edit {
    changes: Vec<Change>,
    /// The field held by a slider while it moves; the next value of it joins this edit.
    held: Option<String>,
}

/// All texts open in the workbench. A library file goes by its path in the library's folder, such
/// as `ropes/x.toml`; the scenario by [`SCENARIO`](Self::SCENARIO), the study by [`STUDY`](Self::STUDY).
pub struct Book {
    root: PathBuf,
    scenario_path: PathBuf,
    study_path: Option<PathBuf>,
    texts: BTreeMap<String, String>,
    saved: BTreeMap<String, String>,
    parsed: BTreeMap<String, Document>,
    undo: Vec<Edit>,
    redo: Vec<Edit>,
    problems: Vec<Diagnostic>,
    library: Arc<Library>,
    /// Counts readings of the texts: whoever has seen this number has seen these texts.
    version: u64,
    /// Texts that differ from their files, by path.
    unsaved: Vec<String>,
    /// Meshes of the library's folder, as they were when it was opened.
    meshes: Sources,
}

impl Book {
    /// Key of the scenario's text.
    pub const SCENARIO: &'static str = "scenario";

    /// Key of the study's text, where one is open.
    pub const STUDY: &'static str = "study";

    /// Opens the library in a folder and a scenario.
    ///
    /// # Errors
    /// With every file that cannot be read.
    pub fn open(root: &Path, scenario_path: &Path) -> Result<Self, String> {
        let explain = |all: Vec<Diagnostic>| {
            all.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n")
        };
        let sources = Sources::from_folder(root).map_err(explain)?;
        let mut texts: BTreeMap<String, String> =
            sources.iter().map(|(path, text)| (path.to_owned(), text.to_owned())).collect();
        texts.insert(Self::SCENARIO.to_owned(), read_text(scenario_path)?);
        let mut book = Self {
            root: root.to_owned(),
            scenario_path: scenario_path.to_owned(),
            study_path: None,
            saved: texts.clone(),
            texts,
            parsed: BTreeMap::new(),
            undo: Vec::new(),
            redo: Vec::new(),
            problems: Vec::new(),
            library: Arc::default(),
            version: 0,
            unsaved: Vec::new(),
            meshes: Sources::default().with_meshes_of(&sources),
        };
        book.read_all();
        Ok(book)
    }

    /// Opens another scenario in place of the present one.
    ///
    /// # Errors
    /// Where its file cannot be read; the present one then stays.
    pub fn open_scenario(&mut self, path: &Path) -> Result<(), String> {
        let text = read_text(path)?;
        self.scenario_path = path.to_owned();
        self.begin(Self::SCENARIO, text);
        Ok(())
    }

    /// Opens a study in place of the present one.
    ///
    /// # Errors
    /// Where its file cannot be read; the present one then stays.
    pub fn open_study(&mut self, path: &Path) -> Result<(), String> {
        let text = read_text(path)?;
        self.study_path = Some(path.to_owned());
        self.begin(Self::STUDY, text);
        Ok(())
    }

    /// Begins with a text as its file has it; edits of what went by its key before are forgotten.
    fn begin(&mut self, key: &str, text: String) {
        let elsewhere = |edit: &Edit| edit.changes.iter().all(|change| change.path != key);
        self.undo.retain(elsewhere);
        self.redo.retain(elsewhere);
        self.saved.insert(key.to_owned(), text.clone());
        self.put(key, Some(text));
        self.read_all();
    }

    /// The library's folder.
    #[must_use]
    pub fn root(&self) -> &Path {
        &self.root
    }

    /// The scenario's file.
    #[must_use]
    pub fn scenario_path(&self) -> &Path {
        &self.scenario_path
    }

    /// The study's file, where one is open.
    #[must_use]
    pub fn study_path(&self) -> Option<&Path> {
        self.study_path.as_deref()
    }

    /// The library as read from the present texts; items with errors are missing.
    #[must_use]
    pub fn library(&self) -> &Arc<Library> {
        &self.library
    }

    /// A number that grows with every change of a text.
    #[must_use]
    pub fn version(&self) -> u64 {
        self.version
    }

    /// Every problem of the present texts, by file and place; the scenario's under its file's name.
    #[must_use]
    pub fn problems(&self) -> &[Diagnostic] {
        &self.problems
    }

    /// Whether any text of gear or scenario has an error; a study has no part in a single run.
    #[must_use]
    pub fn any_error(&self) -> bool {
        let study = self.shown_name(Self::STUDY);
        self.problems.iter().any(|problem| problem.is_error() && problem.file != study)
    }

    /// Files of a folder of the library, by path.
    pub fn files<'a>(&'a self, folder: &'a str) -> impl Iterator<Item = &'a str> {
        self.texts
            .keys()
            .map(String::as_str)
            .filter(move |path| path.split_once('/').is_some_and(|(before, _)| before == folder))
    }

    /// The present text of a file.
    #[must_use]
    pub fn text(&self, path: &str) -> Option<&str> {
        self.texts.get(path).map(String::as_str)
    }

    /// Every present text, by path; the scenario by [`SCENARIO`](Self::SCENARIO).
    #[must_use]
    pub fn texts(&self) -> &BTreeMap<String, String> {
        &self.texts
    }

    /// The library's present texts.
    #[must_use]
    pub fn sources(&self) -> Sources {
        let library = self
            .texts
            .iter()
            .filter(|(path, _)| ![Self::SCENARIO, Self::STUDY].contains(&path.as_str()));
        Sources::from_map(library.map(|(path, text)| (path.clone(), text.clone())).collect())
            .with_meshes_of(&self.meshes)
    }

    /// The texts a single run is made from: all but the study's.
    #[must_use]
    pub fn texts_of_run(&self) -> BTreeMap<String, String> {
        self.texts
            .iter()
            .filter(|(path, _)| *path != Self::STUDY)
            .map(|(path, text)| (path.clone(), text.clone()))
            .collect()
    }

    /// Whether a single run made from these texts would be made from the present ones.
    #[must_use]
    pub fn same_run(&self, texts: &BTreeMap<String, String>) -> bool {
        texts.iter().eq(self.texts.iter().filter(|(path, _)| *path != Self::STUDY))
    }

    /// A field as typed; `None` where it is not there.
    #[must_use]
    pub fn field(&self, path: &str, field: &str) -> Option<String> {
        self.parsed.get(path)?.get(field)
    }

    /// Whether a text has a field, table or list of this path.
    #[must_use]
    pub fn has(&self, path: &str, field: &str) -> bool {
        self.parsed.get(path).is_some_and(|document| document.has(field))
    }

    /// Keys of a table of a text, in the order of its file.
    #[must_use]
    pub fn keys(&self, path: &str, table: &str) -> Vec<String> {
        self.parsed.get(path).map_or_else(Vec::new, |document| document.keys(table))
    }

    /// How many tables a list of a file has, such as `whale.pilot` of the scenario.
    #[must_use]
    pub fn count(&self, path: &str, list: &str) -> usize {
        self.parsed.get(path).map_or(0, |document| document.count(list))
    }

    /// The worst problem at a field of a file.
    #[must_use]
    pub fn problem_at(&self, path: &str, field: &str) -> Option<&Diagnostic> {
        if self.problems.is_empty() {
            return None;
        }
        let file = self.shown_name(path);
        let here = |problem: &&Diagnostic| {
            problem.file == file
                && (problem.field == field || problem.field == format!("{field}.value"))
        };
        self.problems.iter().filter(here).max_by_key(|problem| problem.severity)
    }

    /// Whether a file has an error anywhere.
    #[must_use]
    pub fn file_has_error(&self, path: &str) -> bool {
        if self.problems.is_empty() {
            return false;
        }
        let file = self.shown_name(path);
        self.problems.iter().any(|problem| problem.file == file && problem.is_error())
    }

    /// The name under which problems of a text are told.
    #[must_use]
    pub fn shown_name(&self, path: &str) -> String {
        match (path, &self.study_path) {
            (Self::SCENARIO, _) => self.scenario_path.display().to_string(),
            (Self::STUDY, Some(study)) => study.display().to_string(),
            _ => path.to_owned(),
        }
    }

    /// Whether the scenario or one of its assemblies names a library file by its id.
    #[must_use]
    pub fn in_use(&self, path: &str) -> bool {
        let id = path.rsplit('/').next().unwrap_or(path).trim_end_matches(".toml");
        let named = format!("\"{id}\"");
        let assemblies =
            (0..).map_while(|index| self.field(Self::SCENARIO, &format!("gear.{index}.assembly")));
        let files = assemblies
            .map(|assembly| format!("assemblies/{assembly}.toml"))
            .chain([Self::SCENARIO.to_owned()]);
        files.filter_map(|file| self.text(&file)).any(|text| text.contains(&named))
    }

    /// Sets a field; comments and order stay. Setting what is there already changes nothing.
    ///
    /// # Errors
    /// Where the file is not TOML or has no such place.
    pub fn set(&mut self, path: &str, field: &str, value: &str) -> Result<(), String> {
        if self.field(path, field).as_deref() == Some(value) {
            return Ok(());
        }
        self.alter(path, |document| document.set(field, value).map_err(|error| error.to_string()))
    }

    /// Sets a field from a control that is still moving: values in a row are one edit.
    ///
    /// # Errors
    /// As [`set`](Self::set).
    pub fn set_held(&mut self, path: &str, field: &str, value: &str) -> Result<(), String> {
        let held = format!("{path}#{field}");
        let before = self.undo.len();
        let joins = self.undo.last().is_some_and(|edit| edit.held.as_deref() == Some(&held));
        self.set(path, field, value)?;
        if self.undo.len() > before || joins {
            self.join(joins && self.undo.len() > before, held);
        }
        Ok(())
    }

    /// Joins the last edit to the one before, and notes what holds it.
    fn join(&mut self, to_the_one_before: bool, held: String) {
        let Some(mut last) = self.undo.pop() else { return };
        if to_the_one_before && let Some(first) = self.undo.pop() {
            for (change, earlier) in last.changes.iter_mut().zip(first.changes) {
                change.before = earlier.before;
            }
        }
        last.held = Some(held);
        self.undo.push(last);
    }

    /// A slider was let go: its next value is an edit of its own.
    pub fn let_go(&mut self) {
        self.undo.iter_mut().rev().take(1).for_each(|edit| edit.held = None);
    }

    /// Changes a text as a document; comments and order stay. A change that fails leaves it as it was.
    ///
    /// # Errors
    /// Where the file is not open or not TOML, or what `change` answers.
    pub fn alter(
        &mut self,
        path: &str,
        change: impl FnOnce(&mut Document) -> Result<(), String>,
    ) -> Result<(), String> {
        let mut document = self.document(path)?;
        change(&mut document)?;
        self.change(vec![(path.to_owned(), Some(document.text()))]);
        Ok(())
    }

    /// A text as a document.
    ///
    /// # Errors
    /// Where the file is not open or not TOML.
    pub fn document(&self, path: &str) -> Result<Document, String> {
        let text = self.texts.get(path).ok_or_else(|| format!("{path} is not open"))?;
        Document::parse(text).map_err(|error| format!("{path}: {error}"))
    }

    /// Sets several texts at once, new files among them; one undo takes all of it back.
    pub fn put_all(&mut self, texts: Vec<(String, String)>) {
        self.change(texts.into_iter().map(|(path, text)| (path, Some(text))).collect());
    }

    /// Sets and takes away texts at once, such as those kept over a crash; one undo takes all of it back.
    pub fn restore(&mut self, texts: Vec<(String, Option<String>)>) {
        self.change(texts);
    }

    /// Takes a file away; undo brings it back, and its file goes when all is saved.
    pub fn remove(&mut self, path: &str) {
        self.change(vec![(path.to_owned(), None)]);
    }

    /// A path in a folder of the library that no file has, from a stem such as `my-rope`.
    #[must_use]
    pub fn fresh_path(&self, folder: &str, stem: &str) -> String {
        let first = format!("{folder}/{stem}.toml");
        if !self.texts.contains_key(&first) {
            return first;
        }
        let fresh = (2..)
            .map(|number| format!("{folder}/{stem}-{number}.toml"))
            .find(|candidate| !self.texts.contains_key(candidate));
        fresh.unwrap_or(first)
    }

    /// The text of a file as it is on disk.
    #[must_use]
    pub fn saved_text(&self, path: &str) -> Option<&str> {
        self.saved.get(path).map(String::as_str)
    }

    /// Adds a copy of a library file under a fresh id and answers its path.
    ///
    /// # Errors
    /// Where there is no such file or it is not TOML.
    pub fn duplicate(&mut self, path: &str) -> Result<String, String> {
        let text = self.texts.get(path).ok_or_else(|| format!("{path} is not open"))?;
        let mut document = Document::parse(text).map_err(|error| error.to_string())?;
        let (folder, file) = path.split_once('/').unwrap_or(("", path));
        let fresh = self.fresh_path(folder, file.trim_end_matches(".toml"));
        let name = document.get("name").unwrap_or_default();
        document.set("name", &format!("{name} (copy)")).map_err(|error| error.to_string())?;
        self.change(vec![(fresh.clone(), Some(document.text()))]);
        Ok(fresh)
    }

    /// Takes the last edit back; false where there is none.
    pub fn undo(&mut self) -> bool {
        let Some(edit) = self.undo.pop() else { return false };
        edit.changes.iter().rev().for_each(|change| self.put(&change.path, change.before.clone()));
        self.redo.push(edit);
        self.read_all();
        true
    }

    /// Does the last edit taken back again; false where there is none.
    pub fn redo(&mut self) -> bool {
        let Some(edit) = self.redo.pop() else { return false };
        edit.changes.iter().for_each(|change| self.put(&change.path, change.after.clone()));
        self.undo.push(edit);
        self.read_all();
        true
    }

    /// Whether there is an edit to take back, and one to do again.
    #[must_use]
    pub fn can_undo_redo(&self) -> (bool, bool) {
        (!self.undo.is_empty(), !self.redo.is_empty())
    }

    /// Texts that differ from their files.
    #[must_use]
    pub fn unsaved(&self) -> &[String] {
        &self.unsaved
    }

    fn compare(&mut self) {
        let all: BTreeSet<&String> = self.texts.keys().chain(self.saved.keys()).collect();
        self.unsaved = all
            .into_iter()
            .filter(|path| self.texts.get(*path) != self.saved.get(*path))
            .cloned()
            .collect();
    }

    /// Whether a text differs from its file.
    #[must_use]
    pub fn is_unsaved(&self, path: &str) -> bool {
        self.texts.get(path) != self.saved.get(path)
    }

    /// Writes every changed text to its file, each whole or not at all; answers how many.
    ///
    /// # Errors
    /// With the files that could not be written; the others are saved.
    pub fn save(&mut self) -> Result<usize, String> {
        let (mut count, mut failed) = (0, Vec::new());
        for path in self.unsaved.clone() {
            let file = match (path.as_str(), &self.study_path) {
                (Self::SCENARIO, _) => self.scenario_path.clone(),
                (Self::STUDY, Some(study)) => study.clone(),
                _ => self.root.join(&path),
            };
            let written = match self.texts.get(&path) {
                Some(text) => save_text(&file, text),
                None => std::fs::remove_file(&file),
            };
            match written {
                Ok(()) => {
                    count += 1;
                    replace(&mut self.saved, &path, self.texts.get(&path).cloned());
                }
                Err(error) => failed.push(format!("{}: {error}", file.display())),
            }
        }
        self.compare();
        if failed.is_empty() { Ok(count) } else { Err(failed.join("\n")) }
    }

    /// Writes the scenario to another file, and goes on with that; the one before stays as it was saved.
    ///
    /// # Errors
    /// Where the file cannot be written.
    pub fn save_scenario_as(&mut self, path: &Path) -> Result<(), String> {
        let text = self.texts.get(Self::SCENARIO).cloned().unwrap_or_default();
        save_text(path, &text).map_err(|error| format!("{}: {error}", path.display()))?;
        self.scenario_path = path.to_owned();
        self.saved.insert(Self::SCENARIO.to_owned(), text);
        self.read_all();
        Ok(())
    }

    fn change(&mut self, texts: Vec<(String, Option<String>)>) {
        let change = |(path, after): (String, Option<String>)| Change {
            before: self.texts.get(&path).cloned(),
            path,
            after,
        };
        let changes: Vec<Change> =
            texts.into_iter().map(change).filter(|change| change.before != change.after).collect();
        if changes.is_empty() {
            return;
        }
        if self.undo.len() == UNDO_DEPTH {
            self.undo.remove(0);
        }
        changes.iter().for_each(|change| self.put(&change.path, change.after.clone()));
        self.undo.push(Edit { changes, held: None });
        self.redo.clear();
        self.read_all();
    }

    fn put(&mut self, path: &str, text: Option<String>) {
        self.parsed.remove(path);
        replace(&mut self.texts, path, text);
    }

    fn read_all(&mut self) {
        for (path, text) in &self.texts {
            if !self.parsed.contains_key(path)
                && let Ok(document) = Document::parse(text)
            {
                self.parsed.insert(path.clone(), document);
            }
        }
        self.compare();
        let (library, problems) = Library::read(&self.sources());
        (self.library, self.problems) = (Arc::new(library), problems);
        self.version += 1;
        let name = self.shown_name(Self::SCENARIO);
        if let Some(Err(problems)) =
            self.text(Self::SCENARIO).map(|text| Scenario::read(&name, text))
        {
            self.problems.extend(problems);
        }
        let name = self.shown_name(Self::STUDY);
        if let Some(Err(problems)) = self.text(Self::STUDY).map(|text| Study::read(&name, text)) {
            self.problems.extend(problems);
        }
    }
}

fn replace(map: &mut BTreeMap<String, String>, path: &str, text: Option<String>) {
    match text {
        Some(text) => map.insert(path.to_owned(), text),
        None => map.remove(path),
    };
}

fn read_text(path: &Path) -> Result<String, String> {
    std::fs::read_to_string(path)
        .map_err(|error| format!("{}: cannot be read: {error}", path.display()))
}
