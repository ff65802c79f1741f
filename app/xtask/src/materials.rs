//! The bill of materials of the release in the format CycloneDX, written by cargo-cyclonedx: every library in the program
//! with its version, licence and source.

use std::fs;
use std::path::{Path, PathBuf};

use crate::Outcome;
use crate::system_packages::on_path;
use crate::workspace::Workspace;

/// Writes the bill to a file; if the tool is missing, prints a message and writes nothing. `stamp` is the time of the last
/// commit.
/// Errors: when the tool fails, or a file cannot be written.
pub fn write(workspace: &Workspace, file: &Path, stamp: &str) -> Outcome {
    if !on_path("cargo-cyclonedx") {
        eprintln!(
            "skipped: the bill of materials needs cargo-cyclonedx: cargo install cargo-cyclonedx --locked"
        );
        return Ok(());
    }
    let form = ["--format", "json", "--spec-version", "1.5", "--no-build-deps"];
    let of = ["cyclonedx", "--manifest-path", "app/workbench/Cargo.toml"];
    let outcome =
        workspace.cargo_with(&[of.as_slice(), &form].concat(), &[("SOURCE_DATE_EPOCH", stamp)]);
    let own = workspace.root.join("app/workbench/endline.cdx.json");
    let bill = fs::read_to_string(&own).map_err(|error| format!("{}: {error}", own.display()));
    // The tool writes one bill beside each package of the workspace.
    written(workspace).iter().for_each(|file| drop(fs::remove_file(file)));
    outcome?;
    // The bill must not name folders of this machine.
    let bill = bill?.replace(&workspace.root.display().to_string(), "");
    fs::write(file, bill).map_err(|error| format!("{}: cannot be written: {error}", file.display()))
}

/// Returns the bills beside the packages of the workspace.
fn written(workspace: &Workspace) -> Vec<PathBuf> {
    let inside = |folder: &Path| -> Vec<PathBuf> {
        fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path()).collect()
    };
    let root = &workspace.root;
    let mut packages = vec![root.join("gear-library"), root.join("tests")];
    packages.extend(["app", "plugins"].iter().flat_map(|folder| inside(&root.join(folder))));
    let files = packages.iter().flat_map(|folder| inside(folder));
    files.filter(|file| file.to_string_lossy().ends_with(".cdx.json")).collect()
}
