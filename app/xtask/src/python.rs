//! Builds the Python package as a wheel that contains the command, its plugins and the gear library; installs and tests it
//! in a virtual environment.

use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::workspace::{Profile, Workspace, announce};
use crate::{Outcome, plugins};

/// The package's folder.
const FOLDER: &str = "app/python";

/// The package that builds the wheel, as in `requirements.txt`.
const BUILDER: &str = "maturin>=1.7,<2";

/// Folders of the gear library that hold code of its crate.
const CODE: [&str; 4] = ["src", "tests", "benches", "examples"];

/// Builds the wheel, installs it and runs its tests.
/// Errors: when Python is missing, a package cannot be installed, or a test fails.
pub fn test(workspace: &Workspace, profile: Profile) -> Outcome {
    let needs = format!("{FOLDER}/requirements.txt");
    let environment = environment(workspace, &["--requirement", &needs])?;
    let wheel = wheel(workspace, profile, &environment)?;
    let install = ["install", "--quiet", "--force-reinstall", "--no-deps"];
    let wheel = wheel.display().to_string();
    call(&tool(&environment, "pip"), &[install.as_slice(), &[&wheel]].concat(), workspace)?;
    call(&tool(&environment, "pytest"), &["--quiet", "app/python/tests"], workspace)
}

/// Builds the wheel without installing or testing it.
/// Errors: when Python is missing, or a package that builds it cannot be installed.
pub fn build(workspace: &Workspace, profile: Profile) -> Outcome {
    let environment = environment(workspace, &[BUILDER])?;
    wheel(workspace, profile, &environment).map(drop)
}

/// Builds the wheel; returns its path.
fn wheel(workspace: &Workspace, profile: Profile, environment: &Path) -> Outcome<PathBuf> {
    // The command without its window, and the drawing code of the module.
    let parts =
        ["--package", "endline-python", "--package", "endline", "--lib", "--bin", "endline"];
    let features = ["--no-default-features", "--features", "endline/scene"];
    workspace.cargo(&[&["build", profile.flag()], parts.as_slice(), &features].concat())?;
    plugins::build(workspace, profile)?;
    copy_contents(workspace, profile)?;
    let wheels = workspace.target.join("wheels");
    // An earlier call may have written a wheel of another version.
    let _ = fs::remove_dir_all(&wheels);
    let out = wheels.display().to_string();
    let manifest = format!("{FOLDER}/Cargo.toml");
    let build = ["build", "--manifest-path", &manifest, "--out", &out, profile.flag()];
    call(&tool(environment, "maturin"), &build, workspace)?;
    let mut files = fs::read_dir(&wheels).into_iter().flatten().flatten().map(|file| file.path());
    let wheel = files.find(|file| file.extension() == Some(OsStr::new("whl")));
    let wheel = wheel.ok_or_else(|| format!("maturin wrote no wheel to {out}"))?;
    let bytes = fs::metadata(&wheel).map_or(0, |file| file.len());
    eprintln!("{} ({:.1} MB)", wheel.display(), bytes as f64 / 1e6);
    Ok(wheel)
}

/// Copies command, plugins and gear library into the package.
fn copy_contents(workspace: &Workspace, profile: Profile) -> Outcome {
    let package = workspace.root.join(FOLDER).join("python/endline");
    let (bin, library) = (package.join("bin"), package.join("gear-library"));
    for folder in [&bin, &library] {
        let _ = fs::remove_dir_all(folder);
    }
    copy(&workspace.products(profile).join("plugins"), &bin.join("plugins"))?;
    let program = workspace.program(profile);
    let name = program.file_name().unwrap_or_default();
    fs::copy(&program, bin.join(name))
        .map_err(|error| format!("cannot copy {}: {error}", program.display()))?;
    let items = workspace.root.join("gear-library");
    for entry in entries(&items)? {
        let name = entry.file_name().unwrap_or_default();
        if entry.is_dir() && !CODE.iter().any(|code| name == *code) {
            copy(&entry, &library.join(name))?;
        }
    }
    Ok(())
}

/// Copies a folder with its contents.
fn copy(from: &Path, to: &Path) -> Outcome {
    fs::create_dir_all(to).map_err(|error| format!("cannot create {}: {error}", to.display()))?;
    for entry in entries(from)? {
        let place = to.join(entry.file_name().unwrap_or_default());
        if entry.is_dir() {
            copy(&entry, &place)?;
        } else {
            fs::copy(&entry, &place)
                .map_err(|error| format!("cannot copy {}: {error}", entry.display()))?;
        }
    }
    Ok(())
}

fn entries(folder: &Path) -> Outcome<Vec<PathBuf>> {
    let entries = fs::read_dir(folder)
        .map_err(|error| format!("cannot read {}: {error}", folder.display()))?;
    Ok(entries.flatten().map(|entry| entry.path()).collect())
}

/// Returns a virtual environment with packages as pip takes them; creates it if it is missing.
fn environment(workspace: &Workspace, packages: &[&str]) -> Outcome<PathBuf> {
    let environment = workspace.target.join("python-env");
    let path = environment.display().to_string();
    if !tool(&environment, "pip").is_file() {
        let python = if cfg!(windows) { "python" } else { "python3" };
        call(Path::new(python), &["-m", "venv", &path], workspace).map_err(|error| {
            format!("{error}; Python 3.10 or later with venv is needed (Debian: apt-get install python3-venv)")
        })?;
    }
    let install = ["install", "--quiet", "--disable-pip-version-check"];
    call(&tool(&environment, "pip"), &[install.as_slice(), packages].concat(), workspace)?;
    Ok(environment)
}

/// Returns the path of a program in a virtual environment.
fn tool(environment: &Path, name: &str) -> PathBuf {
    let folder = if cfg!(windows) { "Scripts" } else { "bin" };
    environment.join(folder).join(format!("{name}{}", std::env::consts::EXE_SUFFIX))
}

fn call(program: &Path, arguments: &[&str], workspace: &Workspace) -> Outcome {
    announce(&program.display().to_string(), arguments);
    let mut command = Command::new(program);
    command.args(arguments).current_dir(&workspace.root);
    command.env("CARGO_TARGET_DIR", &workspace.target);
    match command.status() {
        Ok(status) if status.success() => Ok(()),
        Ok(_) => Err(format!("`{}` failed, see above", program.display())),
        Err(error) => Err(format!("cannot start {}: {error}", program.display())),
    }
}
