//! Lists the files embedded by `src/embedded.rs`: the gear library, the documents and their pictures.

use std::error::Error;
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::{env, fs};

/// The gear library, from this package.
const LIBRARY: &str = "../../gear-library";

/// What the folder of the library contains besides items: its Rust package.
const PACKAGE: [&str; 5] = ["Cargo.toml", "benches", "examples", "src", "tests"];

/// The documents and their pictures, from this package.
const DOCUMENTS: &str = "../../docs";

fn main() -> Result<(), Box<dyn Error>> {
    let mut items = Vec::new();
    for entry in entries(LIBRARY)? {
        let is_package = PACKAGE.iter().any(|name| entry.ends_with(name));
        if !is_package {
            collect(&entry, &mut items)?;
        }
    }
    list(LIBRARY, &items, "gear_library.rs")?;

    let mut documents = entries(DOCUMENTS)?;
    documents.retain(|path| is_one_of(path, &["md"]));
    list(DOCUMENTS, &documents, "documents.rs")?;
    let mut pictures = Vec::new();
    collect(&Path::new(DOCUMENTS).canonicalize()?.join("pictures"), &mut pictures)?;
    pictures.retain(|path| is_one_of(path, &["png", "svg"]));
    list(DOCUMENTS, &pictures, "pictures.rs")
}

/// Whether a file has one of these extensions.
fn is_one_of(path: &Path, endings: &[&str]) -> bool {
    path.extension().is_some_and(|ending| endings.iter().any(|wanted| ending == *wanted))
}

/// Writes the list of files of a folder for `src/embedded.rs`: path and bytes of each.
fn list(folder: &str, files: &[PathBuf], to: &str) -> Result<(), Box<dyn Error>> {
    println!("cargo::rerun-if-changed={folder}");
    let folder = Path::new(folder).canonicalize()?;
    let mut list = String::from("&[\n");
    for file in files {
        let name = file.strip_prefix(&folder)?.to_string_lossy().replace('\\', "/");
        writeln!(list, "    ({name:?}, include_bytes!({:?})),", file.display().to_string())?;
    }
    list.push(']');
    fs::write(Path::new(&env::var("OUT_DIR")?).join(to), list)?;
    Ok(())
}

/// Collects a file, or all files below a folder.
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

/// Entries of a folder of the workspace, in order, without hidden files.
fn entries(folder: &str) -> Result<Vec<PathBuf>, Box<dyn Error>> {
    sorted(&Path::new(folder).canonicalize()?)
}

/// Entries of a folder, in order, without hidden files.
fn sorted(folder: &Path) -> Result<Vec<PathBuf>, Box<dyn Error>> {
    let entries: Result<Vec<_>, _> = fs::read_dir(folder)?.collect();
    let hidden = |entry: &fs::DirEntry| entry.file_name().to_string_lossy().starts_with('.');
    let mut paths: Vec<PathBuf> =
        entries?.into_iter().filter(|entry| !hidden(entry)).map(|entry| entry.path()).collect();
    paths.sort();
    Ok(paths)
}
