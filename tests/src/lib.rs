//! What the checks of the whole share: where the house stands, and where the program lies.

use std::path::{Path, PathBuf};
use std::process::Command;

/// Folder of the workspace's Cargo.toml.
#[must_use]
pub fn root() -> &'static Path {
    // This crate lies one folder below it.
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap_or(Path::new("."))
}

/// Cargo's folder of this build: the tests run from `<it>/deps`, the program and `plugins` lie in it.
///
/// # Errors
/// When the operating system does not say where this test runs from.
pub fn products() -> Result<PathBuf, String> {
    let test = std::env::current_exe()
        .map_err(|error| format!("cannot tell where this test runs from: {error}"))?;
    test.ancestors()
        .nth(2)
        .map(Path::to_path_buf)
        .ok_or_else(|| format!("{} lies in no target folder", test.display()))
}

/// The program `endline` of the same build.
///
/// # Errors
/// When it has not been built; the message says how.
pub fn program() -> Result<PathBuf, String> {
    let program = products()?.join(format!("endline{}", std::env::consts::EXE_SUFFIX));
    if program.is_file() {
        Ok(program)
    } else {
        Err(format!("{} is not there: run `cargo xtask test`, or `cargo build`", program.display()))
    }
}

/// Compiles a C source of the repository to a plugin library, every warning an error; `define` are macros as `NAME=TEXT`.
///
/// # Errors
/// Where there is no compiler, and what it says of the source.
pub fn compile_c(source: &str, define: &[&str], library: &Path) -> Result<(), String> {
    let mut command = Command::new(std::env::var_os("CC").unwrap_or_else(|| "cc".into()));
    command
        .args(["-std=c99", "-Wall", "-Wextra", "-Wpedantic", "-Werror", "-shared", "-fPIC"])
        .args(define.iter().map(|text| format!("-D{text}")))
        .arg("-I")
        .arg(root().join("plugins/sdk/include"))
        .arg("-o")
        .arg(library)
        .arg(root().join(source))
        .arg("-lm");
    let output = command.output().map_err(|error| format!("no C compiler: {error}"))?;
    if output.status.success() {
        return Ok(());
    }
    Err(String::from_utf8_lossy(&output.stderr).into_owned())
}

/// Whether a row of a table in a page of `docs` has a first cell of that name and all of the words.
#[must_use]
pub fn documented(page: &str, name_and_words: &[&str]) -> bool {
    let text = std::fs::read_to_string(root().join("docs").join(page));
    let (Ok(text), Some((name, words))) = (text, name_and_words.split_first()) else {
        return false;
    };
    text.lines()
        .filter(|line| line.starts_with(&format!("| `{name}` |")))
        .any(|line| words.iter().all(|word| line.contains(word)))
}

/// Every file below a folder of the workspace, in order of name, without build products and version control.
///
/// # Errors
/// When a folder cannot be read.
pub fn files_below(folder: &Path) -> std::io::Result<Vec<PathBuf>> {
    let mut entries = std::fs::read_dir(folder)?.collect::<std::io::Result<Vec<_>>>()?;
    entries.sort_by_key(std::fs::DirEntry::file_name);
    let mut files = Vec::new();
    for entry in entries {
        let path = entry.path();
        if !entry.file_type()?.is_dir() {
            files.push(path);
        } else if entry.file_name() != "target" && entry.file_name() != ".git" {
            files.extend(files_below(&path)?);
        }
    }
    Ok(files)
}
