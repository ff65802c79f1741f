//! Marks the program with the code that decides what a run is: `ENDLINE_CODE`, the first eight digits of the BLAKE3 of
//! every source file of rope, whale, contact and gear, of how a run and a study's encounter are put together, and of the
//! versions of the libraries that decide a run. Builds of the same code have the same mark, wherever they were made.
#![allow(clippy::disallowed_methods, reason = "a build script reads the repository")]

mod libraries;

use std::error::Error;
use std::fs;
use std::path::{Path, PathBuf};

/// The workspace, from this package.
const ROOT: &str = "../..";

/// Folders whose sources decide a run, from this package.
const DECIDING: [&str; 4] =
    ["../sim/src", "../../gear-library/src", "../../plugins/sdk/src", "src"];

/// Folders and files among them that only report runs.
const REPORTING: [&str; 11] = [
    "../../gear-library/src/rules",
    "src/cases",
    "src/compliance",
    "src/haul",
    "src/live",
    "src/mill.rs",
    "src/page",
    "src/rules",
    "src/study/report",
    "src/study/stats",
    "src/study/threat",
];

fn main() -> Result<(), Box<dyn Error>> {
    let mut files = Vec::new();
    for folder in DECIDING {
        println!("cargo::rerun-if-changed={folder}");
        sources(Path::new(folder), &mut files)?;
    }
    files.sort();
    let mut hasher = blake3::Hasher::new();
    for file in files {
        // A checkout may end lines in its own way; that changes no run.
        let text = fs::read_to_string(&file)?.replace("\r\n", "\n");
        for part in [file.to_string_lossy().replace('\\', "/"), text] {
            hasher.update(&(part.len() as u64).to_le_bytes());
            hasher.update(part.as_bytes());
        }
    }
    println!("cargo::rerun-if-changed={ROOT}/Cargo.lock");
    hasher.update(libraries::deciding(Path::new(ROOT))?.join("\n").as_bytes());
    println!("cargo::rustc-env=ENDLINE_CODE={}", &hasher.finalize().to_hex()[..8]);
    Ok(())
}

/// Every Rust file of a folder and those below it that decides a run.
fn sources(folder: &Path, files: &mut Vec<PathBuf>) -> Result<(), Box<dyn Error>> {
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        if REPORTING.iter().any(|reporting| path == Path::new(reporting)) {
            continue;
        }
        if path.is_dir() {
            sources(&path, files)?;
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            files.push(path);
        }
    }
    Ok(())
}
