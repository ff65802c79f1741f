//! Files of a library that a user chooses among.

use std::path::{Path, PathBuf};

/// The scenarios of a library, by name.
#[must_use]
pub fn scenarios(root: &Path) -> Vec<PathBuf> {
    toml_files(&root.join("scenarios"))
}

/// The studies of a library, by name.
#[must_use]
pub fn studies(root: &Path) -> Vec<PathBuf> {
    toml_files(&root.join("studies"))
}

/// The name of a file without folder and ending.
#[must_use]
pub fn stem(path: &Path) -> String {
    path.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default()
}

fn toml_files(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let mut files: Vec<PathBuf> = entries
        .map(|entry| entry.path())
        .filter(|path| path.extension().is_some_and(|end| end == "toml"))
        .collect();
    files.sort();
    files
}
