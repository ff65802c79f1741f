//! Marks the program with the code that decides what a run is: `ENDLINE_CODE`, the first eight digits of the BLAKE3 of
//! every source file of rope, whale, contact and gear, of how a run and a study's encounter are put together, and of the
//! versions of the libraries that calculate. Builds of the same code have the same mark, wherever they were made.

use std::error::Error;
use std::fs;
use std::path::{Path, PathBuf};

/// Folders whose sources decide a run, from this package.
const DECIDING: [&str; 4] =
    ["../sim/src", "../../gear-library/src", "../../plugins/sdk/src", "src"];

/// What of them only tells of runs.
const TELLING: [&str; 4] = ["src/cases", "src/live", "src/study/report", "src/study/stats"];

/// Libraries whose version may change a bit of a run.
const CALCULATING: [&str; 8] =
    ["glam", "glamx", "libm", "nalgebra", "parry3d-f64", "rapier3d-f64", "simba", "sobol_burley"];

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
    hasher.update(versions("../../Cargo.lock")?.as_bytes());
    println!("cargo::rustc-env=ENDLINE_CODE={}", &hasher.finalize().to_hex()[..8]);
    Ok(())
}

/// Every Rust file of a folder and those below it.
fn sources(folder: &Path, files: &mut Vec<PathBuf>) -> Result<(), Box<dyn Error>> {
    if TELLING.iter().any(|telling| folder == Path::new(telling)) {
        return Ok(());
    }
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        if path.is_dir() {
            sources(&path, files)?;
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            files.push(path);
        }
    }
    Ok(())
}

/// Name and version of each library that calculates, as the lock file has them.
fn versions(lock: &str) -> Result<String, Box<dyn Error>> {
    println!("cargo::rerun-if-changed={lock}");
    let text = fs::read_to_string(lock)?.replace("\r\n", "\n");
    let packages = text.split("[[package]]\n").skip(1);
    let named = packages.filter(|package| {
        CALCULATING.iter().any(|name| package.starts_with(&format!("name = \"{name}\"\n")))
    });
    Ok(named.flat_map(|package| package.lines().take(2).chain(["\n"])).collect())
}
