//! Texts as they stand and as their files have them.

use std::collections::{BTreeMap, BTreeSet};

use endline_gear::Document;

/// Texts by path.
#[derive(Debug, Default)]
pub(super) struct Texts {
    present: BTreeMap<String, String>,
    saved: BTreeMap<String, String>,
    /// The present texts that are TOML.
    parsed: BTreeMap<String, Document>,
    /// Paths of texts that differ from their files.
    unsaved: Vec<String>,
}

impl Texts {
    /// Texts as their files have them.
    pub(super) fn new(texts: BTreeMap<String, String>) -> Self {
        let mut new = Self { saved: texts.clone(), present: texts, ..Self::default() };
        new.refresh();
        new
    }

    /// Every present text.
    pub(super) fn present(&self) -> &BTreeMap<String, String> {
        &self.present
    }

    /// The present text of a file.
    pub(super) fn get(&self, path: &str) -> Option<&str> {
        self.present.get(path).map(String::as_str)
    }

    /// The text of a file as it is on disk.
    pub(super) fn saved(&self, path: &str) -> Option<&str> {
        self.saved.get(path).map(String::as_str)
    }

    /// The present text of a file as a document, where it is TOML.
    pub(super) fn parsed(&self, path: &str) -> Option<&Document> {
        self.parsed.get(path)
    }

    /// Paths of texts that differ from their files.
    pub(super) fn unsaved(&self) -> &[String] {
        &self.unsaved
    }

    /// Sets or removes a present text; [`refresh`](Self::refresh) follows the last of several.
    pub(super) fn put(&mut self, path: &str, text: Option<String>) {
        self.parsed.remove(path);
        replace(&mut self.present, path, text);
    }

    /// The file of a text now has the present text.
    pub(super) fn mark_saved(&mut self, path: &str) {
        replace(&mut self.saved, path, self.present.get(path).cloned());
    }

    /// The file of a text was found to be so on disk; it is not there where `None`.
    pub(super) fn read(&mut self, path: &str, on_disk: Option<String>) {
        replace(&mut self.saved, path, on_disk);
    }

    /// Parses what has changed and compares the present texts with those of the files.
    pub(super) fn refresh(&mut self) {
        for (path, text) in &self.present {
            if !self.parsed.contains_key(path)
                && let Ok(document) = Document::parse(text)
            {
                self.parsed.insert(path.clone(), document);
            }
        }
        let all: BTreeSet<&String> = self.present.keys().chain(self.saved.keys()).collect();
        self.unsaved = all
            .into_iter()
            .filter(|path| self.present.get(*path) != self.saved.get(*path))
            .cloned()
            .collect();
    }
}

fn replace(map: &mut BTreeMap<String, String>, path: &str, text: Option<String>) {
    match text {
        Some(text) => map.insert(path.to_owned(), text),
        None => map.remove(path),
    };
}
