//! From folders to a host: finds, copies, checks and opens plugins at the start, and again when a plugin was rebuilt.
//!
//! An opened library stays open, and a file with the same bytes is not opened twice; so a run in progress keeps the plugins it began
//! with, and the next one has the new.
//!
//! A library is opened from a copy of its own, and the copy is of the bytes that were hashed. The system's loader returns the library
//! already mapped when it is asked for the same path again, so a rebuilt library would not be loaded. A file that is overwritten while it is
//! mapped changes the code under a run, and a file that is opened a second time may be another one. On Linux the copy lies in sealed memory,
//! which cannot be changed or replaced. Elsewhere it is a file in a folder of the user's; where the system allows it, it is removed at once.
//!
//! A truncated library, from a download that broke off, crashes the system's loader. An ELF file (Linux and most others) states in its header
//! where its table of sections ends, which linkers write last. Files of other formats are left to the loader, in the child process.

use std::collections::{BTreeMap, BTreeSet};
use std::env::consts::DLL_EXTENSION;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;
use std::{env, fs};

use endline_gear::TextPlugin;
use endline_gear::limits::LIBRARY_BYTES;
use endline_gear::read::at_most;

use super::choices::{Change, Choices};
use super::host::PluginHost;
use super::info::{Checker, Hook, PluginProblem, Refusal, Standing};
use super::library::{self, LoadedLibrary};

/// Finds, asks about, checks and opens plugins.
pub struct Loader {
    /// Folders searched.
    pub folders: Vec<PathBuf>,
    /// The user's decisions.
    pub choices: Choices,
    linked: Vec<Hook>,
    /// The program that serves libraries in processes of their own; without one, all run in this process.
    serves: Option<PathBuf>,
    /// By file, hash, and whether it runs in a process of its own.
    opened: BTreeMap<(PathBuf, String, bool), LoadedLibrary>,
}

impl Loader {
    /// A loader of these folders.
    pub fn new(folders: &[PathBuf], choices: Choices) -> Self {
        let (linked, opened) = (Vec::new(), BTreeMap::new());
        Self { folders: folders.to_vec(), choices, linked, serves: None, opened }
    }

    /// A loader with libraries that are not trusted in processes of their own, each a call of `program plugins serve`. Where the system
    /// is not a Unix, they run in this one.
    pub fn out_of_process(self, program: PathBuf) -> Self {
        Self { serves: cfg!(unix).then_some(program), ..self }
    }

    /// A loader with plugins that are linked into the program: each serves where no folder has a usable one of its id.
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
                Err(problem) => problems.push(problem),
            }
        }
        // A process ends once no run has its library any more; one that is mapped here stays.
        self.opened.retain(|key, opened| !opened.out_of_process || used.contains(key));
        for folder in text_plugins(&self.folders) {
            open_folder(&folder, &mut host, &self.choices, &mut problems);
        }
        host.add_linked(&self.linked, &self.choices, &mut problems);
        (host, problems)
    }

    fn open(
        &mut self,
        file: &Path,
        checker: &Checker<'_>,
    ) -> Result<(String, LoadedLibrary), PluginProblem> {
        let unusable = |refusal: Refusal| refusal.at(file);
        let (hash, bytes) = read(file).map_err(unusable)?;
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
            let standing = Standing::Waiting(Box::new(ask));
            return Err(PluginProblem { standing, ..unusable(Refusal::new(what, help)) });
        }
        if let Some(opened) = self.opened.get(&key) {
            return Ok((hash, opened.clone()));
        }
        checker(file, &hash).map_err(|reason| {
            let reason = format!("set aside, because it failed the check before loading: {reason}");
            let refusal = Refusal::new(reason, "remove the file or fix the plugin");
            PluginProblem { standing: Standing::SetAside, ..unusable(refusal) }
        })?;
        let opened = match serves {
            Some(program) => open_out_of_process(program, file, bytes),
            None => open_copy(file, &bytes),
        };
        let opened = opened.map_err(unusable)?;
        self.opened.insert(key, opened.clone());
        Ok((hash, opened))
    }
}

impl PluginHost {
    /// Loads every library in the folders, trusting them not to crash when opened.
    ///
    /// A folder that does not exist is passed over. Libraries stay mapped for the life of the program.
    pub fn discover(folders: &[PathBuf]) -> (Self, Vec<PluginProblem>) {
        Self::discover_checked(folders, &|_: &Path, _: &str| Ok(()))
    }

    /// Loads every library in the folders that the checker lets pass.
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
    if let Some(whole) = missing_from(&bytes) {
        let reason = format!("is cut short: {} of {whole} bytes", bytes.len());
        return Err(Refusal::new(reason, "copy or build it again"));
    }
    Ok((blake3::hash(&bytes).to_hex().to_string(), bytes))
}

#[cfg(unix)]
fn open_out_of_process(
    program: &Path,
    file: &Path,
    bytes: Vec<u8>,
) -> Result<LoadedLibrary, Refusal> {
    super::process::open(program, file, bytes)
}

#[cfg(not(unix))]
fn open_out_of_process(_: &Path, file: &Path, bytes: Vec<u8>) -> Result<LoadedLibrary, Refusal> {
    open_copy(file, &bytes)
}

pub(super) fn open_copy(file: &Path, bytes: &[u8]) -> Result<LoadedLibrary, Refusal> {
    with_copy(file, bytes, |copy| library::open(copy, file))?
}

/// Opens one file unasked and unchecked, of the hash wanted where that is not empty: the child process does.
pub(super) fn open_here(file: &Path, wanted: &str) -> Result<(String, LoadedLibrary), Refusal> {
    let (hash, bytes) = read(file)?;
    if !wanted.is_empty() && wanted != hash {
        return Err(Refusal::new("has changed as it was checked", "load the plugins again"));
    }
    Ok((hash, open_copy(file, &bytes)?))
}

/// Adds a plugin without code, or every problem of its files as one.
pub(super) fn open_folder(
    folder: &Path,
    host: &mut PluginHost,
    choices: &Choices,
    problems: &mut Vec<PluginProblem>,
) {
    match TextPlugin::from_folder(folder) {
        Ok(plugin) => host.add_text(folder, &plugin, choices, problems),
        Err(found) => {
            let found: Vec<String> = found.iter().map(ToString::to_string).collect();
            let reason = format!("this plugin without code cannot be used:\n{}", found.join("\n"));
            problems.push(Refusal::new(reason, "fix the files").at(folder));
        }
    }
}

/// BLAKE3 of a file, hexadecimal, as [`Choices::allow`] takes it.
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

/// Does something with a copy of a file.
pub(super) fn with_copy<T>(
    file: &Path,
    bytes: &[u8],
    work: impl FnOnce(&Path) -> T,
) -> Result<T, Refusal> {
    #[cfg(target_os = "linux")]
    if let Ok(copy) = in_memory::write(bytes) {
        return Ok(work(&in_memory::path(copy)));
    }
    on_disk::with_copy(file, bytes, work)
}

#[cfg(target_os = "linux")]
mod in_memory {
    use std::fs::File;
    use std::io::Write;
    use std::os::fd::IntoRawFd;
    use std::path::PathBuf;

    use rustix::fs::{MemfdFlags, SealFlags, fcntl_add_seals, memfd_create};

    /// The bytes in memory that can no longer be written.
    pub(super) fn write(bytes: &[u8]) -> std::io::Result<File> {
        let flags = MemfdFlags::CLOEXEC | MemfdFlags::ALLOW_SEALING;
        let mut file = File::from(memfd_create("endline-plugin", flags)?);
        file.write_all(bytes)?;
        fcntl_add_seals(
            &file,
            SealFlags::WRITE | SealFlags::GROW | SealFlags::SHRINK | SealFlags::SEAL,
        )?;
        Ok(file)
    }

    /// The path of such bytes. They stay open, as a library stays mapped: the loader takes the same path for the same library.
    pub(super) fn path(file: File) -> PathBuf {
        PathBuf::from(format!("/proc/self/fd/{}", file.into_raw_fd()))
    }
}

mod on_disk {
    use std::fs::{self, OpenOptions};
    use std::io::Write;
    use std::path::{Path, PathBuf};
    use std::sync::atomic::{AtomicU64, Ordering};
    use std::time::Duration;

    use super::{Refusal, copies_folder};

    /// Copies made by this program: each has a name that was never used.
    static COPIES: AtomicU64 = AtomicU64::new(0);

    /// Copies left by programs that ended are removed after this time.
    const LEFT_BEHIND: Duration = Duration::from_secs(24 * 3600);

    pub(super) fn with_copy<T>(
        file: &Path,
        bytes: &[u8],
        work: impl FnOnce(&Path) -> T,
    ) -> Result<T, Refusal> {
        let help =
            "a library is opened from a copy in your cache folder: set HOME, or make it writable";
        let folder = copies_folder().ok_or_else(|| {
            Refusal::new("cannot be copied, because there is no home folder", help)
        })?;
        let copy = write(file, bytes, &folder)
            .map_err(|error| Refusal::new(format!("cannot be copied: {error}"), help))?;
        let done = work(&copy);
        // Where an open file cannot be removed it is left for a later start.
        let _ = fs::remove_file(&copy);
        Ok(done)
    }

    fn write(file: &Path, bytes: &[u8], folder: &Path) -> std::io::Result<PathBuf> {
        let number = COPIES.fetch_add(1, Ordering::Relaxed);
        let name = file.file_name().unwrap_or_default().to_string_lossy();
        let copy = folder.join(format!("{}-{number}-{name}", std::process::id()));
        make_own(folder)?;
        clear(folder);
        // A copy of that name was left by a program of the same number, or is a link that somebody put there.
        let _ = fs::remove_file(&copy);
        OpenOptions::new().write(true).create_new(true).open(&copy)?.write_all(bytes)?;
        Ok(copy)
    }

    /// A folder that only its user may change.
    fn make_own(folder: &Path) -> std::io::Result<()> {
        let mut builder = fs::DirBuilder::new();
        builder.recursive(true);
        #[cfg(unix)]
        std::os::unix::fs::DirBuilderExt::mode(&mut builder, 0o700);
        builder.create(folder)
    }

    /// Removes copies that earlier programs could not remove.
    fn clear(folder: &Path) {
        let old = |path: &Path| {
            fs::metadata(path)
                .and_then(|about| about.modified())
                .is_ok_and(|at| at.elapsed().is_ok_and(|age| age > LEFT_BEHIND))
        };
        for path in fs::read_dir(folder)
            .into_iter()
            .flatten()
            .flatten()
            .map(|entry| entry.path())
            .filter(|path| old(path))
        {
            // One still in use stays.
            let _ = fs::remove_file(path);
        }
    }
}

/// How many bytes a library should have, where it has fewer.
pub(super) fn missing_from(bytes: &[u8]) -> Option<u64> {
    const ELF_64_LITTLE: [u8; 6] = [0x7f, b'E', b'L', b'F', 2, 1];
    if !bytes.starts_with(&ELF_64_LITTLE) {
        return None;
    }
    let Some(header) = bytes.get(..64) else { return Some(64) };
    let number = |from: usize, length: usize| {
        header[from..from + length]
            .iter()
            .rev()
            .fold(0_u64, |number, byte| number << 8 | u64::from(*byte))
    };
    let (sections_at, each, count) = (number(0x28, 8), number(0x3a, 2), number(0x3c, 2));
    let whole = sections_at.saturating_add(each * count);
    (whole > bytes.len() as u64).then_some(whole)
}

/// The program `endline` where another program, such as an interpreter, has loaded Endline as a module.
static PROGRAM: OnceLock<PathBuf> = OnceLock::new();

/// Folders searched, in order: beside the program, the user's own, and those `ENDLINE_PLUGINS` names
/// (separated as `PATH` is).
pub fn default_folders() -> Vec<PathBuf> {
    let own = data_folder().map(|folder| folder.join("plugins"));
    let named = env::var_os("ENDLINE_PLUGINS");
    let named =
        named.iter().flat_map(env::split_paths).filter(|folder| !folder.as_os_str().is_empty());
    program_folder().into_iter().chain(own).chain(named).collect()
}

/// The folder of plugins that ship with the program, beside it: its libraries need no permission.
pub fn program_folder() -> Option<PathBuf> {
    program().ok().and_then(|program| program.parent().map(|folder| folder.join("plugins")))
}

/// Sets once, before any plugin is loaded, the file of the program `endline` that this process acts for: plugins and library
/// are searched for beside that file, and it checks new plugins. A second call has no effect.
pub fn stands_for(program: PathBuf) {
    let _ = PROGRAM.set(program);
}

/// The file of the program: the one this process acts for, else its own.
pub fn program() -> std::io::Result<PathBuf> {
    PROGRAM.get().cloned().map_or_else(env::current_exe, Ok)
}

/// File in the user's data folder with the user's decisions about plugins.
pub fn chosen_file() -> Option<PathBuf> {
    data_folder().map(|folder| folder.join("plugins-chosen"))
}

/// The user's data folder of Endline; none where the system names no home.
pub(crate) fn data_folder() -> Option<PathBuf> {
    user_folder("XDG_DATA_HOME", ".local/share")
}

/// Folder that libraries are copied to as they are opened, where the system opens none from memory; none without a home, for a
/// folder that others can foresee is no place for code.
pub(super) fn copies_folder() -> Option<PathBuf> {
    user_folder("XDG_CACHE_HOME", ".cache").map(|folder| folder.join("plugins-open"))
}

/// File in the user's cache folder that lists the hashes of files that passed the check.
pub fn known_file() -> Option<PathBuf> {
    user_folder("XDG_CACHE_HOME", ".cache").map(|folder| folder.join("plugins-checked"))
}

fn user_folder(variable: &str, under_home: &str) -> Option<PathBuf> {
    let named = env::var_os(variable).map(PathBuf::from).filter(|folder| folder.is_absolute());
    let home = || {
        env::var_os("HOME")
            .or_else(|| env::var_os("USERPROFILE"))
            .map(|home| Path::new(&home).join(under_home))
    };
    named.or_else(home).map(|folder| folder.join("endline"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_cut_anywhere_is_known() {
        let program = fs::read(env::current_exe().unwrap()).unwrap();
        if program.starts_with(b"\x7fELF") {
            assert_eq!(missing_from(&program), None);
            for share in [5, 63, 64, 4096, program.len() / 2, program.len() - 1] {
                assert!(missing_from(&program[..share]).is_some() == (share >= 6), "{share} bytes");
            }
        }
        assert_eq!(missing_from(b"not a library"), None);
    }
}
