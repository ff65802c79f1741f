//! Where plugins are looked for, and where it is noted which files passed the check.

use std::env;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

/// The program that other programs stand for, such as an interpreter that has loaded Endline as a module.
static PROGRAM: OnceLock<PathBuf> = OnceLock::new();

/// Folders searched, in order: beside the program, the user's own, and those `ENDLINE_PLUGINS` names
/// (separated as `PATH` is).
#[must_use]
pub fn default_folders() -> Vec<PathBuf> {
    let own = data_folder().map(|folder| folder.join("plugins"));
    let named = env::var_os("ENDLINE_PLUGINS");
    let named =
        named.iter().flat_map(env::split_paths).filter(|folder| !folder.as_os_str().is_empty());
    program_folder().into_iter().chain(own).chain(named).collect()
}

/// The folder of what came with the program, beside it: its libraries are opened unasked.
#[must_use]
pub fn program_folder() -> Option<PathBuf> {
    program().ok().and_then(|program| program.parent().map(|folder| folder.join("plugins")))
}

/// Says once, before anything is loaded, that this process stands for the program `endline` at a place: plugins and library
/// are looked for beside that file, and it checks new plugins. Said before, it stays as it was.
pub fn stands_for(program: PathBuf) {
    let _ = PROGRAM.set(program);
}

/// The file of the program: the one this process stands for, else the one it is.
///
/// # Errors
/// Where the system does not tell.
pub fn program() -> std::io::Result<PathBuf> {
    PROGRAM.get().cloned().map_or_else(env::current_exe, Ok)
}

/// File in the user's data folder that holds what the user has decided about plugins.
#[must_use]
pub fn chosen_file() -> Option<PathBuf> {
    data_folder().map(|folder| folder.join("plugins-chosen"))
}

/// Folder of what the user keeps for Endline; none where the system names no home.
pub(crate) fn data_folder() -> Option<PathBuf> {
    user_folder("XDG_DATA_HOME", ".local/share")
}

/// Folder that libraries are copied to as they are opened, where the system opens none from memory; none without a home, for a
/// folder that others can foresee is no place for code.
pub(super) fn copies_folder() -> Option<PathBuf> {
    user_folder("XDG_CACHE_HOME", ".cache").map(|folder| folder.join("plugins-open"))
}

/// File in the user's cache folder that lists the hashes of files that passed the check.
#[must_use]
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
