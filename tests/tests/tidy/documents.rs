//! Documents rot where nothing checks them: every path they name is there.

use crate::{none, sources};

/// Top folders whose paths our documents name.
const FOLDERS: [&str; 8] =
    ["app", "plugins", "gear-library", "assets", "tests", "docs", ".ci", ".cargo"];

/// Paths from the workspace root that a text names, in prose, code or commands: every word that starts with a top folder.
fn paths_named(text: &str) -> Vec<&str> {
    let is_path = |letter: char| letter.is_ascii_alphanumeric() || "_./-".contains(letter);
    let words = text.split(|letter| !is_path(letter)).map(|word| word.trim_end_matches(['.', '-']));
    words
        .filter(|word| {
            word.split_once('/')
                .is_some_and(|(top, rest)| FOLDERS.contains(&top) && !rest.is_empty())
        })
        .collect()
}

/// Targets of Markdown links that are not addresses.
fn links(text: &str) -> Vec<&str> {
    let targets =
        text.split("](").skip(1).filter_map(|rest| rest.split_once(')')).map(|(target, _)| target);
    targets
        .filter(|target| !target.contains("://") && !target.starts_with('#'))
        .map(|target| target.split('#').next().unwrap_or(target))
        .collect()
}

#[test]
fn every_path_a_document_names_is_there() {
    let root = endline_tests::root();
    let mut complaints = Vec::new();
    for document in sources(&[".md"]) {
        for path in paths_named(&document.text).into_iter().filter(|path| !root.join(path).exists())
        {
            complaints.push(format!("{} names {path}", document.path));
        }
        let full = root.join(&document.path);
        for link in
            links(&document.text).into_iter().filter(|link| !full.with_file_name(link).exists())
        {
            complaints.push(format!("{} links to {link}", document.path));
        }
    }
    none(&complaints, "documents name what is not there");
}

#[test]
fn the_readme_has_exactly_two_commands_of_set_up() {
    let readme =
        std::fs::read_to_string(endline_tests::root().join("README.md")).expect("README.md");
    let (_, after) = readme.split_once("## Set-up").expect("a section on set-up");
    let (_, block) = after.split_once("```sh\n").expect("a block of commands");
    let (block, _) = block.split_once("```").expect("its end");
    let commands: Vec<&str> =
        block.lines().map(|line| line.split('#').next().unwrap_or(line).trim()).collect();
    assert_eq!(commands, ["cargo xtask run", "cargo xtask test"]);
}

#[test]
fn the_index_names_every_document() {
    let docs = sources(&[".md"])
        .into_iter()
        .filter(|document| document.path.starts_with("docs/"))
        .collect::<Vec<_>>();
    let index =
        docs.iter().find(|document| document.path == "docs/README.md").expect("docs/README.md");
    let named = links(&index.text);
    let forgotten = docs
        .iter()
        .map(|document| document.path.trim_start_matches("docs/"))
        .filter(|name| *name != "README.md" && !named.contains(name));
    none(&forgotten.map(str::to_owned).collect::<Vec<_>>(), "docs/README.md does not name these");
}

#[test]
fn the_readers_of_documents_see_what_they_should() {
    assert_eq!(
        paths_named("see `app/sim/src/lib.rs`, x/app/sim, and docs/README.md."),
        ["app/sim/src/lib.rs", "docs/README.md"]
    );
    assert_eq!(links("[a](b.md#c) [d](https://e.org) [f](#g)"), ["b.md"]);
}
