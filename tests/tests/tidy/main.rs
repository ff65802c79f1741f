//! The rules of the house that no compiler holds; docs/ARCHITECTURE.md says why they are there.

#![allow(
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking, in its helpers too"
)]

mod arrows;
mod code_mark;
mod documents;
mod figure_docs;
mod gear_docs;
mod language;
mod rules_docs;
mod text;

use std::path::Path;

/// A text file of the workspace.
struct Source {
    /// Path from the workspace root, with `/` between folders.
    path: String,
    text: String,
}

/// Every file of ours whose name ends in one of these, in order of path.
fn sources(endings: &[&str]) -> Vec<Source> {
    let root = endline_tests::root();
    let files = endline_tests::files_below(root).expect("the workspace can be read");
    let ours = files
        .iter()
        .filter(|file| endings.iter().any(|ending| file.to_string_lossy().ends_with(ending)));
    ours.map(|file| Source {
        path: relative(file, root),
        text: std::fs::read_to_string(file)
            .unwrap_or_else(|error| panic!("{}: {error}", file.display())),
    })
    .collect()
}

fn relative(file: &Path, root: &Path) -> String {
    let inside = file.strip_prefix(root).expect("below the root");
    inside.iter().map(|part| part.to_string_lossy()).collect::<Vec<_>>().join("/")
}

/// A file of the workspace as TOML.
fn toml_file(path: &str) -> toml::Table {
    let full = endline_tests::root().join(path);
    let text = std::fs::read_to_string(&full).unwrap_or_else(|error| panic!("{path}: {error}"));
    text.parse().unwrap_or_else(|error| panic!("{path}: {error}"))
}

/// Fails with all complaints at once.
fn none(complaints: &[String], rule: &str) {
    assert!(complaints.is_empty(), "{rule}\n  {}", complaints.join("\n  "));
}
