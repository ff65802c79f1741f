//! What defines a study's runs, written in one order: keys sorted, options by id, words that change no run left out.

use std::fmt::Write;

use crate::confidence::FORMER_CONFIDENCE;
use crate::tree::{Content, Node};

/// Top-level tables and keys that decide what a run is.
const DEFINING: [&str; 6] = ["scenario", "seed", "run", "option", "axis", "encounter"];

/// Keys that only explain.
const EXPLAINING: [&str; 7] =
    ["confidence", "curve", "name", "notes", "source", "threat", FORMER_CONFIDENCE];

/// The text a study is hashed by.
pub(super) fn of(study: &Node) -> String {
    let Content::Table(entries) = &study.content else { return String::new() };
    let mut text = String::new();
    for key in DEFINING {
        for (_, _, node) in entries.iter().filter(|(name, _, _)| name == key) {
            let _ = writeln!(text, "{key} = {}", canonical(node));
        }
    }
    text
}

fn canonical(node: &Node) -> String {
    match &node.content {
        Content::Text(text) => format!("{text:?}"),
        Content::Number(number) => format!("{number:?}"),
        Content::Flag(flag) => flag.to_string(),
        Content::Date(date) => date.clone(),
        Content::List(items) => list(items),
        Content::Table(entries) => {
            let telling = entries.iter().filter(|(key, _, _)| !EXPLAINING.contains(&key.as_str()));
            let mut pairs: Vec<String> =
                telling.map(|(key, _, value)| format!("{key:?}={}", canonical(value))).collect();
            pairs.sort();
            format!("{{{}}}", pairs.join(","))
        }
    }
}

/// Tables of a list, such as options, have no order; other lists keep theirs.
fn list(items: &[Node]) -> String {
    let mut texts: Vec<String> = items.iter().map(canonical).collect();
    if items.iter().all(|item| matches!(item.content, Content::Table(_))) {
        texts.sort();
    }
    format!("[{}]", texts.join(","))
}
