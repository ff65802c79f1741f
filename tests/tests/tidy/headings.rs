//! Links to a heading of a document: the heading exists.

use std::collections::BTreeMap;
use std::path::{Component, Path};

use crate::{Source, none, sources};

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
