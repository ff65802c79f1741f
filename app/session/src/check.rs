//! Checks of the paths that a user names: a library file, a scenario, a folder of either.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use endline_gear::{Diagnostic, Document, Library, Sources, read};

use crate::cases::Cases;
use crate::error::Error;
use crate::locate;
use crate::plugins::PluginHost;
use crate::rules::Packs;
use crate::search::Question;
use crate::source::{Overrides, prepare};
use crate::study::PreparedStudy;

/// The findings of a check.
#[derive(Clone, Debug, Default)]
pub struct Checked {
    /// Files checked.
    pub files: usize,
    /// All problems, file by file.
    pub problems: Vec<Diagnostic>,
    /// Folders visited, by the system's path: links may lead back.
    seen: BTreeSet<PathBuf>,
}

/// Checks a path: a folder that is a library with its scenarios, any other folder with the
/// scenarios and library files under it, a scenario, or one library file.
pub fn check_path(path: &Path, library: Option<&Path>, host: &PluginHost) -> Checked {
    let mut checked = Checked::default();
    if path.is_dir() {
        checked.folder(path, library, host);
    } else {
        checked.file(&in_its_folder(path), library, host);
    }
    checked
}

/// A file named without its folder, with the folder where that is one of a library's and decides the file's kind.
fn in_its_folder(path: &Path) -> PathBuf {
    let whole = std::path::absolute(path).unwrap_or_default();
    let folder = whole.parent().and_then(Path::file_name).unwrap_or_default().to_string_lossy();
    let decides = OTHERS.contains(&&*folder) || endline_gear::Kind::in_folder(&folder).is_some();
    if path.parent() == Some(Path::new("")) && decides { whole } else { path.to_owned() }
}

/// Folders of a library that hold other files than items and scenarios.
const OTHERS: [&str; 4] = ["cases", "observations", "rules", "studies"];

impl Checked {
    fn folder(&mut self, folder: &Path, library: Option<&Path>, host: &PluginHost) {
        if !self.enters(folder) {
            return;
        }
        if locate::is_library(folder) {
            self.library(folder);
            self.scenarios(&folder.join("scenarios"), Some(folder), host);
            self.cases(folder, host);
            self.studies(folder, host);
            self.observations(folder, host);
            self.rules(folder);
            return;
        }
        let before = self.files;
        for entry in entries(folder) {
            if entry.is_dir() {
                self.folder(&entry, library, host);
            } else if entry.extension().is_some_and(|end| end == "toml") {
                self.file(&entry, library, host);
            }
        }
        if self.files == before && self.problems.is_empty() {
            self.report(
                folder,
                "nothing to check here",
                "expected a gear library, a scenario or a library file (.toml)",
            );
        }
    }

    /// Records a folder as visited; false where it was already.
    fn enters(&mut self, folder: &Path) -> bool {
        let whole = folder.canonicalize().unwrap_or_else(|_| folder.to_path_buf());
        self.seen.insert(whole)
    }

    /// Every item of a library; references between items too.
    fn library(&mut self, root: &Path) {
        match Sources::from_folder(root) {
            Ok(sources) => {
                self.files += sources.iter().count();
                self.problems.extend(
                    Library::read(&sources).1.into_iter().map(|problem| under(root, problem)),
                );
            }
            Err(problems) => self.problems.extend(problems),
        }
    }

    fn scenarios(&mut self, folder: &Path, library: Option<&Path>, host: &PluginHost) {
        if !self.enters(folder) {
            return;
        }
        for entry in entries(folder) {
            if entry.is_dir() {
                self.scenarios(&entry, library, host);
            } else if entry.extension().is_some_and(|end| end == "toml") {
                self.scenario(&entry, library, host);
            }
        }
    }

    fn file(&mut self, path: &Path, library: Option<&Path>, host: &PluginHost) {
        let parent = path
            .parent()
            .and_then(Path::file_name)
            .map(|name| name.to_string_lossy().into_owned())
            .unwrap_or_default();
        if parent == "cases" {
            return self.case(path, library, host);
        }
        if parent == "studies" {
            return self.study(path, library, host);
        }
        if parent == "observations" || kind(path).as_deref() == Some("observation") {
            return self.observation(path, library, host);
        }
        if parent == "rules" || kind(path).as_deref() == Some("rules") {
            return self.rule_pack(path, library);
        }
        if endline_gear::Kind::in_folder(&parent).is_none() {
            return self.scenario(path, library, host);
        }
        self.files += 1;
        let text = match read::text(path) {
            Ok(text) => text,
            Err(error) => return self.report(path, &format!("cannot be read: {error}"), ""),
        };
        let file = path.file_name().unwrap_or_default().to_string_lossy();
        let (meshes, unread) = Sources::beside(path);
        let found = Library::check_file_with(&format!("{parent}/{file}"), &text, &meshes);
        let root = path.ancestors().nth(2).unwrap_or(Path::new(""));
        let all = unread.into_iter().chain(found);
        self.problems.extend(all.map(|problem| under(root, problem)));
    }

    /// Every validation case of a library.
    fn cases(&mut self, root: &Path, host: &PluginHost) {
        for file in locate::toml_files(&root.join("cases")) {
            self.case(&file, Some(root), host);
        }
    }

    /// Every study of a library.
    fn studies(&mut self, root: &Path, host: &PluginHost) {
        for file in locate::toml_files(&root.join("studies")) {
            self.study(&file, Some(root), host);
        }
    }

    /// A study is checked by assembling every option with the first encounter drawn.
    fn study(&mut self, path: &Path, library: Option<&Path>, host: &PluginHost) {
        self.files += 1;
        self.note(path, PreparedStudy::open(path, library, host).map(|_| ()));
    }

    /// Every observation of a library.
    fn observations(&mut self, root: &Path, host: &PluginHost) {
        for file in locate::toml_files(&root.join("observations")) {
            self.observation(&file, Some(root), host);
        }
    }

    /// An observation is checked with the study whose encounters it names.
    fn observation(&mut self, path: &Path, library: Option<&Path>, host: &PluginHost) {
        self.files += 1;
        let named = path.display().to_string();
        self.note(path, Question::open(&named, None, library, host).map(|_| ()));
    }

    /// Every rule pack of a library.
    fn rules(&mut self, root: &Path) {
        for file in locate::toml_files(&root.join("rules")) {
            self.rule_pack(&file, Some(root));
        }
    }

    /// A rule pack is checked with its expressions, and with the areas of the library's other packs.
    fn rule_pack(&mut self, path: &Path, library: Option<&Path>) {
        self.files += 1;
        self.note(path, Packs::check(path, library));
    }

    /// A case is checked with its table and its scenario: a file in the folder `cases` of a library.
    fn case(&mut self, path: &Path, library: Option<&Path>, host: &PluginHost) {
        self.files += 1;
        let around = path.ancestors().nth(2).filter(|folder| locate::is_library(folder));
        let id =
            path.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default();
        let checked = Cases::open(around.or(library)).and_then(|cases| cases.check(&id, host));
        self.note(path, checked);
    }

    /// A scenario is checked by assembling it: references, plugins and the model itself are then checked too.
    fn scenario(&mut self, path: &Path, library: Option<&Path>, host: &PluginHost) {
        self.files += 1;
        self.note(path, prepare(path, library, host, Overrides::default()).map(|_| ()));
    }

    /// Adds the problems of a file, each once.
    fn note(&mut self, path: &Path, checked: Result<(), Error>) {
        match checked {
            Ok(()) => {}
            Err(Error::Diagnostics(problems)) => {
                let fresh: Vec<Diagnostic> = problems
                    .into_iter()
                    .filter(|problem| !self.problems.contains(problem))
                    .collect();
                self.problems.extend(fresh);
            }
            Err(Error::File { file, message }) => {
                self.problems.push(Diagnostic::of_file(file, message, ""))
            }
            Err(error) => self.report(path, &error.to_string(), ""),
        }
    }

    fn report(&mut self, path: &Path, message: &str, help: &str) {
        self.problems.push(Diagnostic::of_file(path.display().to_string(), message, help));
    }
}

/// The kind that a file says it is: observations and rule packs lie anywhere.
fn kind(path: &Path) -> Option<String> {
    let text = read::text(path).unwrap_or_default();
    Document::parse(&text).ok()?.get("kind")
}

/// A library's problems name files within it; a user needs their paths.
fn under(root: &Path, mut problem: Diagnostic) -> Diagnostic {
    problem.file = root.join(&problem.file).display().to_string();
    problem
}

/// The entries of a folder, by name.
fn entries(folder: &Path) -> Vec<PathBuf> {
    let mut entries: Vec<PathBuf> = std::fs::read_dir(folder)
        .into_iter()
        .flatten()
        .flatten()
        .map(|entry| entry.path())
        .collect();
    entries.sort();
    entries
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;
    use std::os::unix::fs::symlink;

    /// A pipe and a device named as files are refused, and links that lead back end.
    #[test]
    fn a_folder_of_pipes_devices_and_loops_is_checked_to_its_end() {
        let folder = std::env::temp_dir().join(format!("endline-hostile-{}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        for link in ["a", "b"] {
            symlink(".", folder.join(link)).unwrap();
        }
        symlink("/dev/zero", folder.join("zero.toml")).unwrap();
        let pipe = folder.join("pipe.toml");
        assert!(std::process::Command::new("mkfifo").arg(&pipe).status().unwrap().success());
        let checked = check_path(&folder, None, &PluginHost::empty());
        std::fs::remove_dir_all(&folder).unwrap();
        assert_eq!((checked.files, checked.problems.len()), (2, 2), "{:?}", checked.problems);
        let refused = |one: &Diagnostic| one.message.contains("not a regular file");
        assert!(checked.problems.iter().all(refused), "{:?}", checked.problems);
    }
}
