//! Lists the files of the gear library for `src/inside.rs`, which includes their bytes.

use std::error::Error;
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::{env, fs};

/// The gear library, from this package.
const LIBRARY: &str = "../../gear-library";

/// What lies beside its items: its Rust package.
const PACKAGE: [&str; 5] = ["Cargo.toml", "benches", "examples", "src", "tests"];

fn main() -> Result<(), Box<dyn Error>> {
    println!("cargo::rerun-if-changed={LIBRARY}");
    let library = Path::new(LIBRARY).canonicalize()?;
    let mut files = Vec::new();
    for entry in sorted(&library)? {
        let is_package = PACKAGE.iter().any(|name| entry.ends_with(name));
        if !is_package {
            collect(&entry, &mut files)?;
        }
    }
    let mut list = String::from("&[\n");
    for file in &files {
        let name = file.strip_prefix(&library)?.to_string_lossy().replace('\\', "/");
        writeln!(list, "    ({name:?}, include_bytes!({:?})),", file.display().to_string())?;
    }
    list.push(']');
    fs::write(Path::new(&env::var("OUT_DIR")?).join("gear_library.rs"), list)?;
    Ok(())
}

/// A file, or every file below a folder.
fn collect(path: &Path, files: &mut Vec<PathBuf>) -> Result<(), Box<dyn Error>> {
    if !path.is_dir() {
        files.push(path.to_path_buf());
        return Ok(());
    }
    for entry in sorted(path)? {
        collect(&entry, files)?;
    }
    Ok(())
}

/// What a folder holds, in order, without hidden files.
fn sorted(folder: &Path) -> Result<Vec<PathBuf>, Box<dyn Error>> {
    let entries: Result<Vec<_>, _> = fs::read_dir(folder)?.collect();
    let hidden = |entry: &fs::DirEntry| entry.file_name().to_string_lossy().starts_with('.');
    let mut paths: Vec<PathBuf> =
        entries?.into_iter().filter(|entry| !hidden(entry)).map(|entry| entry.path()).collect();
    paths.sort();
    Ok(paths)
}
