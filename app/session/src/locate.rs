//! Where the gear library of a scenario is, and the library inside the program, written to the user's data folder where no other is found.

use std::env;
use std::path::{Path, PathBuf};

use crate::{plugins, shipped};

/// Name of the shipped library's folder.
const LIBRARY: &str = "gear-library";

/// Finds the gear library for a scenario: `given` (`--library`) if set, else the folder around
/// the scenario that is a library, else `ENDLINE_LIBRARY`, else a `gear-library` beside the
/// program, above it (a build in a source folder), or in the working folder, else the user's copy of
/// the one that the program [carries](shipped::carry).
pub fn library(scenario: Option<&Path>, given: Option<&Path>) -> Result<PathBuf, String> {
    if let Some(folder) = given {
        return if is_library(folder) {
            Ok(folder.to_path_buf())
        } else {
            Err(no_library(&[folder.to_path_buf()]))
        };
    }
    let mut searched = Vec::new();
    around(scenario, &mut searched);
    searched.extend(env::var_os("ENDLINE_LIBRARY").map(PathBuf::from));
    let program = plugins::program().ok();
    searched.extend(
        program.iter().flat_map(|exe| exe.ancestors().skip(1).map(|folder| folder.join(LIBRARY))),
    );
    searched.push(PathBuf::from(LIBRARY));
    if let Some(found) = searched.iter().find(|folder| is_library(folder)) {
        return Ok(found.clone());
    }
    match shipped::library() {
        Some(Ok(folder)) => Ok(folder),
        Some(Err(reason)) => {
            Err(format!("{}\nand its own cannot be written: {reason}", no_library(&searched)))
        }
        None => Err(no_library(&searched)),
    }
}

/// The folders above a scenario, each also with a `gear-library` in it.
fn around(scenario: Option<&Path>, searched: &mut Vec<PathBuf>) {
    let Some(scenario) = scenario else { return };
    let whole = std::path::absolute(scenario).unwrap_or_else(|_| scenario.to_path_buf());
    searched.extend(whole.ancestors().skip(1).map(Path::to_path_buf));
}

/// A folder with ropes and scenarios in it.
pub(crate) fn is_library(folder: &Path) -> bool {
    folder.join("ropes").is_dir() && folder.join("scenarios").is_dir()
}

fn no_library(searched: &[PathBuf]) -> String {
    let places: Vec<String> =
        searched.iter().map(|folder| format!("  {}", folder.display())).collect();
    format!(
        "no gear library found: expected a folder that holds `ropes` and `scenarios`\nlooked in:\n{}\nname one with --library FOLDER or ENDLINE_LIBRARY",
        places.join("\n")
    )
}

/// The file that a user names: itself, or that of an item of a library's folder (`studies`, `observations`) by its id.
pub fn named(name: &str, folder: &str, library: Option<&Path>) -> Result<PathBuf, String> {
    if Path::new(name).is_file() || name.ends_with(".toml") {
        return Ok(PathBuf::from(name));
    }
    let items = self::library(None, library)?.join(folder);
    let path = items.join(format!("{name}.toml"));
    if path.is_file() {
        return Ok(path);
    }
    let ids = ids_in(&items);
    let help = endline_gear::hint(name, ids.iter().map(String::as_str));
    Err(format!("there is no file `{name}` and no `{name}.toml` in {}; {help}", items.display()))
}

/// Whether a scenario is named, by its file or its id, and not a recording.
pub fn is_scenario(file: &Path) -> bool {
    let extension = file.extension();
    extension.is_some_and(|extension| extension == "toml")
        || (extension.is_none() && !file.is_file())
}

/// Ids of the items in one folder of a library, such as `ropes`, in order.
pub fn ids(root: &Path, folder: &str) -> Result<Vec<String>, String> {
    let items = root.join(folder);
    let (ids, inside) = (ids_in(&items), Path::new(folder).components().count() == 1);
    if inside && !ids.is_empty() {
        return Ok(ids);
    }
    let entries = std::fs::read_dir(root).into_iter().flatten().flatten();
    let with_items = entries.filter(|entry| !toml_files(&entry.path()).is_empty());
    let mut known: Vec<String> =
        with_items.map(|entry| entry.file_name().to_string_lossy().into_owned()).collect();
    known.sort();
    let help = endline_gear::hint(folder, known.iter().map(String::as_str));
    Err(format!("{} has no folder of items `{folder}`; {help}", root.display()))
}

fn ids_in(folder: &Path) -> Vec<String> {
    let stem = |path: &PathBuf| Some(path.file_stem()?.to_string_lossy().into_owned());
    toml_files(folder).iter().filter_map(stem).collect()
}

/// Writes a text to a new file; refuses to replace one.
pub fn write_new(path: &Path, text: &str) -> std::io::Result<()> {
    use std::io::Write;
    let mut file = std::fs::File::create_new(path)?;
    file.write_all(text.as_bytes())?;
    file.sync_all()
}

/// Files of the scenarios of a library, by name.
pub fn scenarios(root: &Path) -> Vec<PathBuf> {
    toml_files(&root.join("scenarios"))
}

/// Files of the studies of a library, by name.
pub fn studies(root: &Path) -> Vec<PathBuf> {
    toml_files(&root.join("studies"))
}

/// Files of the observations of a library, by name.
pub fn observations(root: &Path) -> Vec<PathBuf> {
    toml_files(&root.join("observations"))
}

/// Files of a folder that end in `.toml`, by name.
pub(crate) fn toml_files(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let toml = |path: &PathBuf| path.extension().is_some_and(|extension| extension == "toml");
    let mut files: Vec<PathBuf> = entries.map(|entry| entry.path()).filter(toml).collect();
    files.sort();
    files
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    #[test]
    fn a_scenario_inside_a_library_finds_it() {
        let root = env::temp_dir().join(format!("endline-locate-{}", std::process::id()));
        for folder in ["ropes", "scenarios/deep"] {
            fs::create_dir_all(root.join(folder)).unwrap();
        }
        let found = library(Some(&root.join("scenarios/deep/case.toml")), None).unwrap();
        assert_eq!(found, root);
        fs::remove_dir_all(&root).unwrap();
    }

    #[test]
    fn a_given_folder_that_is_no_library_is_refused_by_name() {
        let message = library(None, Some(Path::new("/no/such/library"))).unwrap_err();
        assert!(message.contains("/no/such/library") && message.contains("--library"), "{message}");
    }
}
