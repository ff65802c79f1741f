//! From folders to a host, as often as asked: at the start, and again when a plugin was built anew.
//!
//! What was opened stays open, and a file whose bytes are the same is not opened twice; so a run under way keeps the plugins it began
//! with, and the next one has the new.

use std::collections::{BTreeMap, BTreeSet};
use std::env::consts::DLL_EXTENSION;
use std::fs;
use std::path::{Path, PathBuf};

use endline_gear::limits::LIBRARY_BYTES;
use endline_gear::read::at_most;
use endline_gear::{Diagnostic, TextPlugin};

use super::choices::{Change, Choices};
use super::copy::with_copy;
use super::cut_short;
use super::host::PluginHost;
use super::info::{Checker, Hook, PluginProblem, Refusal, Standing};
use super::library::{self, Opened};

/// Finds, asks about, checks and opens plugins.
pub struct Loader {
    /// Folders searched.
    pub folders: Vec<PathBuf>,
    /// What the user has decided.
    pub choices: Choices,
    linked: Vec<Hook>,
    /// The program that serves libraries in processes of their own; without one, all run in this process.
    serves: Option<PathBuf>,
    /// By file, hash, and whether it runs in a process of its own.
    opened: BTreeMap<(PathBuf, String, bool), Opened>,
}

impl Loader {
    /// A loader of these folders.
    #[must_use]
    pub fn new(folders: &[PathBuf], choices: Choices) -> Self {
        let (linked, opened) = (Vec::new(), BTreeMap::new());
        Self { folders: folders.to_vec(), choices, linked, serves: None, opened }
    }

    /// The same, with libraries that are not trusted in processes of their own, which `program plugins serve` is. Where the system
    /// is not a Unix, they run in this one.
    #[must_use]
    pub fn out_of_process(self, program: PathBuf) -> Self {
        Self { serves: cfg!(unix).then_some(program), ..self }
    }

    /// The same with plugins that are linked into the program: each serves where no folder has a usable one of its id.
    #[must_use]
    pub fn with_linked(self, linked: Vec<Hook>) -> Self {
        Self { linked, ..self }
    }

    /// Every usable plugin of the folders as they are now, and why each other file is not used. The checker sees each file that the
    /// choices allow before it is opened here.
    pub fn load(&mut self, checker: &Checker<'_>) -> (PluginHost, Vec<PluginProblem>) {
        let (mut host, mut problems) = (PluginHost::empty(), Vec::new());
        let mut used = BTreeSet::new();
        for file in libraries(&self.folders, &mut problems) {
            match self.open(&file, checker) {
                Ok((hash, opened)) => {
                    used.insert((file.clone(), hash.clone(), opened.out_of_process));
                    host.add_loaded(&file, &hash, opened, &self.choices, &mut problems)
                }
                Err(refusal) => problems.push(refusal.at(file)),
            }
        }
        // A process ends once no run has its library any more; one that is mapped here stays.
        self.opened.retain(|key, opened| !opened.out_of_process || used.contains(key));
        for folder in text_plugins(&self.folders) {
            match TextPlugin::from_folder(&folder) {
                Ok(plugin) => host.add_text(&folder, &plugin, &self.choices, &mut problems),
                Err(found) => problems.push(refusal(&found).at(folder)),
            }
        }
        host.add_linked(&self.linked, &self.choices, &mut problems);
        (host, problems)
    }

    fn open(&mut self, file: &Path, checker: &Checker<'_>) -> Result<(String, Opened), Refusal> {
        let (hash, bytes) = read(file)?;
        let serves = self.serves.as_ref().filter(|_| !self.choices.is_trusted(file));
        let key = (file.to_path_buf(), hash.clone(), serves.is_some());
        if let Some(ask) = self.choices.ask(file, &hash) {
            let what = if ask.change == Change::New {
                "has not been allowed yet"
            } else {
                "has changed since it was allowed"
            };
            let help = format!(
                "a plugin runs with your rights; if you trust it: endline plugins allow {}",
                file.display()
            );
            return Err(Refusal {
                standing: Standing::Waiting(Box::new(ask)),
                ..Refusal::new(what, help)
            });
        }
        if let Some(opened) = self.opened.get(&key) {
            return Ok((hash, opened.clone()));
        }
        checker(file, &hash).map_err(|reason| {
            let reason = format!("set aside, because it failed the check before loading: {reason}");
            Refusal {
                standing: Standing::SetAside,
                ..Refusal::new(reason, "remove the file or fix the plugin")
            }
        })?;
        let opened = match serves {
            Some(program) => open_out_of_process(program, file, bytes),
            None => open_copy(file, &bytes),
        }?;
        self.opened.insert(key, opened.clone());
        Ok((hash, opened))
    }
}

impl PluginHost {
    /// Loads every library in the folders, trusting them not to crash when opened.
    ///
    /// A folder that does not exist is passed over. Libraries stay mapped for the life of the program.
    #[must_use]
    pub fn discover(folders: &[PathBuf]) -> (Self, Vec<PluginProblem>) {
        Self::discover_checked(folders, &|_: &Path, _: &str| Ok(()))
    }

    /// Loads every library in the folders that the checker lets pass.
    #[must_use]
    pub fn discover_checked(
        folders: &[PathBuf],
        checker: &Checker<'_>,
    ) -> (Self, Vec<PluginProblem>) {
        Loader::new(folders, Choices::everything()).load(checker)
    }
}

/// The hash of a library file and its bytes, all of them.
fn read(file: &Path) -> Result<(String, Vec<u8>), Refusal> {
    let bytes = at_most(file, LIBRARY_BYTES).map_err(|error| {
        Refusal::new(format!("cannot be read: {error}"), "check its permissions")
    })?;
    if let Some(whole) = cut_short::missing_from(&bytes) {
        let reason = format!("is cut short: {} of {whole} bytes", bytes.len());
        return Err(Refusal::new(reason, "copy or build it again"));
    }
    Ok((blake3::hash(&bytes).to_hex().to_string(), bytes))
}

#[cfg(unix)]
fn open_out_of_process(program: &Path, file: &Path, bytes: Vec<u8>) -> Result<Opened, Refusal> {
    super::process::open(program, file, bytes)
}

#[cfg(not(unix))]
fn open_out_of_process(_: &Path, file: &Path, bytes: Vec<u8>) -> Result<Opened, Refusal> {
    open_copy(file, &bytes)
}

pub(super) fn open_copy(file: &Path, bytes: &[u8]) -> Result<Opened, Refusal> {
    with_copy(file, bytes, |copy| library::open(copy, file))?
}

/// Opens one file unasked and unchecked, of the hash wanted where that is not empty: the child process does.
pub(super) fn open_here(file: &Path, wanted: &str) -> Result<(String, Opened), Refusal> {
    let (hash, bytes) = read(file)?;
    if !wanted.is_empty() && wanted != hash {
        return Err(Refusal::new("has changed as it was checked", "load the plugins again"));
    }
    Ok((hash, open_copy(file, &bytes)?))
}

/// A plugin without code, as the check of its author reads it.
pub(super) fn open_folder(folder: &Path, host: &mut PluginHost, problems: &mut Vec<PluginProblem>) {
    match TextPlugin::from_folder(folder) {
        Ok(plugin) => host.add_text(folder, &plugin, &Choices::everything(), problems),
        Err(found) => problems.push(refusal(&found).at(folder)),
    }
}

/// Every problem of a folder's files, as one.
fn refusal(problems: &[Diagnostic]) -> Refusal {
    let problems: Vec<String> = problems.iter().map(ToString::to_string).collect();
    Refusal::new(
        format!("this plugin without code cannot be used:\n{}", problems.join("\n")),
        "fix the files",
    )
}

/// BLAKE3 of a file, hexadecimal, as [`Choices::allow`] takes it.
///
/// # Errors
/// A file that cannot be read or is cut short.
pub fn file_hash(file: &Path) -> Result<String, String> {
    read(file).map(|(hash, _)| hash).map_err(|refusal| refusal.at(file).to_string())
}

/// Library files of the folders, by folder and then by name; the same file twice counts once.
fn libraries(folders: &[PathBuf], problems: &mut Vec<PluginProblem>) -> Vec<PathBuf> {
    let (mut found, mut seen) = (Vec::new(), BTreeSet::new());
    for folder in folders.iter().filter(|folder| folder.exists()) {
        match libraries_in(folder) {
            Ok(files) => found.extend(files.into_iter().filter(|file| seen.insert(file.clone()))),
            Err(error) => {
                let refusal = Refusal::new(
                    format!("cannot be searched for plugins: {error}"),
                    "name a folder that can be read",
                );
                problems.push(refusal.at(folder));
            }
        }
    }
    found
}

/// Plugins without code: the folders themselves, and those in them.
fn text_plugins(folders: &[PathBuf]) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for folder in folders {
        let mut inner: Vec<PathBuf> = fs::read_dir(folder)
            .into_iter()
            .flatten()
            .flatten()
            .map(|entry| entry.path())
            .collect();
        inner.sort();
        let here =
            std::iter::once(folder.clone()).chain(inner).filter(|folder| TextPlugin::is_in(folder));
        found.extend(here.map(|folder| folder.canonicalize().unwrap_or(folder)));
    }
    let mut seen = BTreeSet::new();
    found.retain(|folder| seen.insert(folder.clone()));
    found
}

fn libraries_in(folder: &Path) -> std::io::Result<Vec<PathBuf>> {
    let mut files = Vec::new();
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        if path.extension().is_some_and(|extension| extension == DLL_EXTENSION) {
            files.push(path.canonicalize().unwrap_or(path));
        }
    }
    files.sort();
    Ok(files)
}
