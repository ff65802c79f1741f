//! Rules on the content, length and number of the repository's files.

use crate::{none, sources};

/// Most lines a source file may have.
const LONGEST: usize = 600;

/// Files longer than this are listed in the test's output.
const LONG: usize = 400;

/// Most source files that ship.
const FILES: usize = 750;

/// Entries of the workspace's top folder, besides a developer's dot-files.
const TOP: [&str; 18] = [
    "CHANGELOG.md",
    "CITATION.cff",
    "CONTRIBUTING.md",
    "Cargo.lock",
    "Cargo.toml",
    "LICENSE-APACHE",
    "LICENSE-MIT",
    "README.md",
    "app",
    "assets",
    "clippy.toml",
    "deny.toml",
    "docs",
    "gear-library",
    "plugins",
    "rustfmt.toml",
    "target",
    "tests",
];

/// Places of unsafe code: the two sides of the boundary to plugins, the processor's register that plugins may not change,
/// the call of EGL, a C library, for OpenGL without a display, and the request to Valgrind. Each place has the exception to the lint in one file;
/// in a folder's `mod.rs`, the exception covers the folder.
const UNSAFE: [&str; 5] = [
    "app/session/src/plugins/library/boundary.rs",
    "app/session/src/plugins/library/float_state.rs",
    "plugins/sdk/src/abi/",
    "app/workbench/src/scene/offscreen.rs",
    "gear-library/benches/encounter/count.rs",
];

#[test]
fn source_files_are_short() {
    let lengths: Vec<(usize, String)> = sources(&[".rs"])
        .into_iter()
        .map(|source| (source.text.lines().count(), source.path))
        .collect();
    for (lines, path) in lengths.iter().filter(|(lines, _)| *lines > LONG) {
        println!("{lines} lines: {path}");
    }
    let too_long = lengths.iter().filter(|(lines, _)| *lines > LONGEST);
    none(
        &too_long.map(|(lines, path)| format!("{path}: {lines}")).collect::<Vec<_>>(),
        "source files over 600 lines",
    );
}

/// A file is what one reader opens for one question: neither 600 lines nor 20.
#[test]
fn source_files_are_few() {
    let files = sources(&[".rs"]);
    let shipped = files.iter().filter(|file| ships(&file.path)).count();
    println!("{shipped} source files ship; at most {FILES} may");
    assert!(
        shipped <= FILES,
        "{shipped} source files ship, more than {FILES}: put the new code into the file of its concept"
    );
}

/// Whether a source file is no test and no benchmark.
fn ships(path: &str) -> bool {
    let (folders, name) = path.rsplit_once('/').unwrap_or(("", path));
    let is_of_tests = |folder: &str| ["tests", "benches"].contains(&folder);
    name != "tests.rs" && !folders.split('/').any(is_of_tests)
}

#[test]
fn the_top_of_the_workspace_holds_only_what_it_should() {
    let entries = std::fs::read_dir(endline_tests::root()).expect("the workspace can be read");
    let names =
        entries.map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned());
    let strays: Vec<String> =
        names.filter(|name| !name.starts_with('.') && !TOP.contains(&name.as_str())).collect();
    none(&strays, "these do not belong at the top of the workspace");
}

#[test]
fn unsafe_code_is_at_the_boundaries_to_c_only() {
    let lints = crate::toml_file("Cargo.toml");
    assert_eq!(
        lints["workspace"]["lints"]["rust"]["unsafe_code"].as_str(),
        Some("deny"),
        "each exception must be explicit"
    );
    // An exception names the lint; this file contains the name as well.
    let exceptions = sources(&[".rs"]).into_iter().filter(|source| {
        source.text.contains("(unsafe_code") && !source.path.starts_with("tests/")
    });
    let files: Vec<String> = exceptions.map(|source| source.path).collect();
    let strays = files.iter().filter(|path| !UNSAFE.iter().any(|folder| path.starts_with(folder)));
    none(&strays.cloned().collect::<Vec<_>>(), "unsafe code outside the boundaries to C");
    for folder in UNSAFE {
        assert!(
            files.iter().filter(|path| path.starts_with(folder)).count() <= 1,
            "unsafe code in more than one file of {folder}"
        );
    }
}

#[test]
fn no_file_names_a_place_on_someones_machine() {
    let folders = ["home", "root", "Users", "work", "mnt"].map(|folder| format!("/{folder}/"));
    let mut complaints = Vec::new();
    for source in sources(&[".rs", ".toml", ".md", ".c", ".h", ".wgsl", ".glsl", ".ci/run"]) {
        for (number, line) in source.text.lines().enumerate() {
            let starts_path = |at: usize| {
                !line[..at]
                    .ends_with(|before: char| before.is_alphanumeric() || "._-/}>".contains(before))
            };
            if folders
                .iter()
                .any(|folder| line.match_indices(folder.as_str()).any(|(at, _)| starts_path(at)))
            {
                complaints.push(format!("{}:{}: {}", source.path, number + 1, line.trim()));
            }
        }
    }
    none(&complaints, "paths of one machine");
}

#[test]
fn nothing_is_unfinished() {
    let marks = [concat!("TO", "DO"), concat!("FIX", "ME"), concat!("X", "XX")];
    let switches = [concat!("#[", "ignore"), concat!("to", "do!("), concat!("unimpl", "emented!(")];
    let mut complaints = Vec::new();
    for source in sources(&[".rs", ".toml", ".md"]) {
        for (number, line) in source.text.lines().enumerate() {
            if marks.iter().any(|mark| has_word(line, mark))
                || switches.iter().any(|switch| line.contains(switch))
            {
                complaints.push(format!("{}:{}: {}", source.path, number + 1, line.trim()));
            }
        }
    }
    none(&complaints, "unfinished places and switched-off tests");
}

#[test]
fn gear_files_are_valid_text_files() {
    let files: Vec<_> = sources(&[".toml"])
        .into_iter()
        .filter(|file| file.path.starts_with("gear-library/"))
        .collect();
    let mut complaints = Vec::new();
    for file in &files {
        if let Err(error) = file.text.parse::<toml::Table>() {
            complaints.push(format!("{}: {error}", file.path));
        }
        if !file.text.ends_with('\n') || file.text.ends_with("\n\n") {
            complaints.push(format!("{}: ends with other than one newline", file.path));
        }
        if file.text.contains(['\r', '\t']) {
            complaints.push(format!("{}: holds tabs or carriage returns", file.path));
        }
    }
    none(&complaints, "gear files");
}

/// Folders with the dispatch of commands.
const DISPATCH: [&str; 3] = [
    "app/session/src/command/",
    "app/session/src/live/worker.rs",
    "app/workbench/src/gui/command/",
];

/// A command that reached `_ => {}` would do nothing without a message; the lint demands an arm for each command.
#[test]
fn commands_are_dispatched_without_wildcard_arms() {
    let dispatches =
        |text: &str| text.contains("match action {") || text.contains("match command {");
    let files: Vec<_> = sources(&[".rs"])
        .into_iter()
        .filter(|file| DISPATCH.iter().any(|folder| file.path.starts_with(folder)))
        .filter(|file| dispatches(&file.text))
        .collect();
    assert!(!files.is_empty(), "commands are dispatched somewhere in {DISPATCH:?}");
    let without = files
        .into_iter()
        .filter(|file| !file.text.contains("#![deny(clippy::wildcard_enum_match_arm"));
    none(
        &without.map(|file| file.path).collect::<Vec<_>>(),
        "these dispatch commands and do not deny clippy::wildcard_enum_match_arm",
    );
}

/// The suite omits doc tests, which cost a pass of rustdoc over each crate, so that examples in documentation would not be
/// tested.
#[test]
fn documentation_of_items_holds_no_code_to_run() {
    let mut complaints = Vec::new();
    for source in sources(&[".rs"]) {
        let documentation = source.text.lines().enumerate().filter_map(|(number, line)| {
            let line = line.trim_start();
            let text = line.strip_prefix("///").or_else(|| line.strip_prefix("//!"))?;
            text.trim_start().strip_prefix("```").map(|language| (number, language))
        });
        let opening = documentation.step_by(2).filter(|(_, language)| *language != "text");
        complaints.extend(opening.map(|(number, _)| format!("{}:{}", source.path, number + 1)));
    }
    none(&complaints, "a block in documentation begins with ```text");
}

/// Whether a line contains a word that is not part of a longer one.
fn has_word(line: &str, word: &str) -> bool {
    let is_inside = |letter: char| letter.is_alphanumeric() || letter == '_';
    line.match_indices(word).any(|(at, _)| {
        !line[..at].ends_with(is_inside) && !line[at + word.len()..].starts_with(is_inside)
    })
}
