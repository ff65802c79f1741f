//! The documents compiled into the program, in the order and groups of their index, `docs/README.md`.

#[cfg(feature = "gui")]
pub mod page;

use std::sync::LazyLock;

use crate::embedded;

/// File name of the index.
const INDEX: &str = "README.md";

/// A document.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Document {
    /// Its name, such as `gear-format`.
    pub name: &'static str,
    /// Its first heading.
    pub title: &'static str,
    /// Its content, as described in the index.
    pub contents: &'static str,
    /// Its text in Markdown.
    pub text: &'static str,
}

/// Documents under a heading of the index.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Group {
    /// The heading.
    pub title: &'static str,
    /// The documents under it.
    pub documents: Vec<Document>,
}

/// The groups, in the order of the index.
pub fn groups() -> &'static [Group] {
    static GROUPS: LazyLock<Vec<Group>> =
        LazyLock::new(|| read(text_of(INDEX).unwrap_or_default()));
    &GROUPS
}

/// Every document, in the order of the index.
pub fn all() -> impl Iterator<Item = Document> {
    groups().iter().flat_map(|group| group.documents.iter().copied())
}

/// Finds a document by name, in any case, with or without `.md`.
pub fn find(named: &str) -> Option<Document> {
    let named = named.strip_suffix(".md").unwrap_or(named);
    all().find(|document| document.name.eq_ignore_ascii_case(named))
}

/// Text of a file in the folder of documents.
fn text_of(file: &str) -> Option<&'static str> {
    let (_, bytes) = embedded::DOCUMENTS.iter().find(|(name, _)| *name == file)?;
    std::str::from_utf8(bytes).ok()
}

/// Reads an index: headings, and below each a table with one row per document.
fn read(index: &'static str) -> Vec<Group> {
    let mut groups: Vec<Group> = Vec::new();
    for line in index.lines() {
        if let Some(title) = line.strip_prefix("## ") {
            groups.push(Group { title, documents: Vec::new() });
        }
        if let (Some(group), Some(document)) = (groups.last_mut(), row(line)) {
            group.documents.push(document);
        }
    }
    groups
}

/// Reads the document of a row `| [physics.md](physics.md) | contents |`.
fn row(line: &'static str) -> Option<Document> {
    let (file, rest) = line.strip_prefix("| [")?.split_once(']')?;
    let (_, contents) = rest.split_once(" | ")?;
    let text = text_of(file)?;
    Some(Document {
        name: file.strip_suffix(".md")?,
        title: text.lines().next()?.strip_prefix("# ")?,
        contents: contents.strip_suffix(" |")?,
        text,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_document_is_in_exactly_one_group_of_the_index() {
        let mut listed: Vec<&str> = all().map(|document| document.name).collect();
        listed.sort_unstable();
        let mut carried: Vec<&str> = embedded::DOCUMENTS
            .iter()
            .filter_map(|(file, _)| file.strip_suffix(".md").filter(|_| *file != INDEX))
            .collect();
        carried.sort_unstable();
        assert_eq!(listed, carried);
        assert!(groups().iter().all(|group| !group.documents.is_empty()));
    }

    #[test]
    fn a_document_is_found_by_its_name() {
        let physics = find("physics").unwrap();
        assert_eq!(physics.title, "Physics: what is solved");
        assert!(physics.text.contains("tension") && physics.contents.contains("equations"));
        assert_eq!(find("Physics.md"), Some(physics));
        assert_eq!(find("zeppelins"), None);
    }
}
