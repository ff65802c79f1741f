//! Paths, links and headings that documents name exist; every asset has its row with source and licence.

use std::collections::BTreeMap;
use std::path::{Component, Path};

use crate::{Source, none, sources};

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

/// Headings of a Markdown text, as the anchors by which links name them.
fn anchors(text: &str) -> Vec<String> {
    let mut in_code = false;
    let mut anchors = Vec::new();
    for line in text.lines() {
        if line.starts_with("```") {
            in_code = !in_code;
        } else if !in_code && line.starts_with('#') {
            anchors.push(anchor(line.trim_start_matches('#')));
        }
    }
    anchors
}

/// The anchor of a heading: lower case, hyphens for spaces, no punctuation.
fn anchor(heading: &str) -> String {
    let kept =
        heading.trim().chars().filter(|letter| letter.is_alphanumeric() || " -_".contains(*letter));
    kept.flat_map(char::to_lowercase)
        .map(|letter| if letter == ' ' { '-' } else { letter })
        .collect()
}

/// Links to headings in a text: file (empty for the text itself) and anchor.
fn links_to_headings(text: &str) -> Vec<(&str, &str)> {
    let targets =
        text.split("](").skip(1).filter_map(|rest| rest.split_once(')')).map(|(target, _)| target);
    targets
        .filter(|target| !target.contains("://"))
        .filter_map(|target| target.split_once('#'))
        .collect()
}

/// The path that a link in a document leads to.
fn target(document: &Source, link: &str) -> String {
    if link.is_empty() {
        return document.path.clone();
    }
    let joined = Path::new(&document.path).with_file_name(link);
    let mut parts: Vec<String> = Vec::new();
    for part in joined.components() {
        match part {
            Component::ParentDir => drop(parts.pop()),
            part => parts.push(part.as_os_str().to_string_lossy().into_owned()),
        }
    }
    parts.join("/")
}

#[test]
fn every_heading_a_document_links_to_exists() {
    let documents = sources(&[".md"]);
    let headings: BTreeMap<&str, Vec<String>> = documents
        .iter()
        .map(|document| (document.path.as_str(), anchors(&document.text)))
        .collect();
    let mut complaints = Vec::new();
    for document in &documents {
        for (link, anchor) in links_to_headings(&document.text) {
            let file = target(document, link);
            let known = headings.get(file.as_str());
            if !known.is_some_and(|known| known.iter().any(|heading| heading == anchor)) {
                complaints.push(format!("{} links to {file}#{anchor}", document.path));
            }
        }
    }
    none(&complaints, "documents link to headings that are missing");
}

#[test]
fn headings_become_anchors() {
    let text = "# A whale's size\n```toml\n# not this\n```\n## In `C`, and back: 2\n";
    assert_eq!(anchors(text), ["a-whales-size", "in-c-and-back-2"]);
    assert_eq!(links_to_headings("[a](b.md#c) [d](#e) [f](g.md)"), [("b.md", "c"), ("", "e")]);
    let document = Source { path: "docs/a.md".to_owned(), text: String::new() };
    assert_eq!(target(&document, "../tests/b.md"), "tests/b.md");
    assert_eq!(target(&document, ""), "docs/a.md");
}

#[test]
fn every_asset_stands_in_the_table_with_source_and_licence() {
    let root = endline_tests::root().join("assets");
    let readme = std::fs::read_to_string(root.join("README.md")).expect("assets/README.md");
    let rows: Vec<Vec<&str>> = readme
        .lines()
        .filter(|line| line.starts_with("| `"))
        .map(|line| line.trim_matches('|').split('|').map(str::trim).collect())
        .collect();
    let mut complaints = Vec::new();
    for file in endline_tests::files_below(&root).expect("the assets can be read") {
        let inside = file.strip_prefix(&root).expect("below assets").to_string_lossy().into_owned();
        let covers = |row: &&Vec<&str>| {
            let place = row[0].trim_matches('`');
            inside == place || (place.ends_with('/') && inside.starts_with(place))
        };
        let row = rows.iter().find(covers);
        let whole =
            row.is_some_and(|row| row.len() == 5 && row.iter().all(|cell| !cell.is_empty()));
        if !whole && inside != "README.md" {
            complaints.push(format!("assets/{inside}"));
        }
    }
    none(&complaints, "assets/README.md lacks a row with source and licence for these");
}
