//! The outside libraries that decide a run, with their versions, read from the dependency tree.
//!
//! All that `endline-sim`, `endline-gear` and `endline-sdk` depend on decides a run, and so do the libraries of the
//! session named in [`DECIDING`]; each with all that it depends on. Dependencies of tests decide nothing.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

use toml::{Table, Value};

/// Crates all of whose libraries decide a run, as folders of the workspace.
const CRATES: [&str; 3] = ["app/sim", "gear-library", "plugins/sdk"];

/// Libraries of the session that decide a run: the draws of a study, the local searches of a search, and the functions they use.
pub const DECIDING: [&str; 4] = ["fcmaes-core", "libm", "sobol_burley", "statrs"];

/// Libraries of the session that only store, show or load.
/// A new dependency of the session belongs here or in [`DECIDING`]; a test asks for it.
#[allow(dead_code, reason = "the build script needs only the list above; a test reads both")]
pub const REPORTING: &[&str] = &[
    "arrow-array",
    "arrow-ipc",
    "arrow-schema",
    "askama",
    "blake3",
    "bytes",
    "csv",
    "exmex",
    "glam",
    "libloading",
    "parquet",
    "plotters",
    "png",
    "postcard",
    "schemars",
    "serde",
    "serde_json",
    "strum",
    "tempfile",
];

/// Name and version of each library that decides a run, in order of name.
/// Errors: where a manifest or the lock file cannot be read or lacks what it must hold.
pub fn deciding(root: &Path) -> Result<Vec<String>, String> {
    let workspace = read(root, "Cargo.toml")?;
    let mut wanted: Vec<String> = DECIDING.map(str::to_owned).to_vec();
    for folder in CRATES {
        wanted.extend(dependencies(&read(root, &format!("{folder}/Cargo.toml"))?));
    }
    let outside = wanted.iter().filter(|name| !name.starts_with("endline"));
    let names: Vec<String> = outside.map(|name| package_name(&workspace, name)).collect();
    closure(&read(root, "Cargo.lock")?, names)
}

/// Names under `[dependencies]` of a manifest.
pub fn dependencies(manifest: &Table) -> Vec<String> {
    let table = manifest.get("dependencies").and_then(Value::as_table);
    table.into_iter().flat_map(Table::keys).cloned().collect()
}

/// A file of the workspace as TOML.
/// Errors: where it cannot be read.
pub fn read(root: &Path, file: &str) -> Result<Table, String> {
    let text = fs::read_to_string(root.join(file)).map_err(|error| format!("{file}: {error}"))?;
    text.parse().map_err(|error| format!("{file}: {error}"))
}

/// The package behind a name of the workspace's dependencies.
fn package_name(workspace: &Table, name: &str) -> String {
    let renamed = workspace
        .get("workspace")
        .and_then(|table| table.get("dependencies")?.get(name)?.get("package")?.as_str());
    renamed.unwrap_or(name).to_owned()
}

/// These packages and all they depend on, as `name version`.
fn closure(lock: &Table, names: Vec<String>) -> Result<Vec<String>, String> {
    let packages = packages(lock);
    let (mut found, mut open) = (BTreeSet::new(), names);
    while let Some(wanted) = open.pop() {
        let package = packages
            .iter()
            .find(|(known, _)| **known == wanted || known.split(' ').next() == Some(&wanted))
            .ok_or_else(|| format!("Cargo.lock has no package {wanted}"))?;
        if found.insert(package.0.clone()) {
            open.extend(package.1.iter().cloned());
        }
    }
    Ok(found.into_iter().collect())
}

/// Every package of a lock file as `name version`, with the packages it names as its dependencies.
fn packages(lock: &Table) -> BTreeMap<String, Vec<String>> {
    let all = lock.get("package").and_then(Value::as_array).into_iter().flatten();
    let entry = |package: &Value| {
        let text = |key: &str| package.get(key).and_then(Value::as_str).map(str::to_owned);
        let needs = package.get("dependencies").and_then(Value::as_array).into_iter().flatten();
        let needs = needs.filter_map(Value::as_str).map(str::to_owned).collect();
        Some((format!("{} {}", text("name")?, text("version")?), needs))
    };
    all.filter_map(entry).collect()
}
