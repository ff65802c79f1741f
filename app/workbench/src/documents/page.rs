//! The documents as HTML pages, readable without a network. Links between documents lead to their pages.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::{fs, io};

use pulldown_cmark::{CowStr, Event, Options, Parser, Tag, TagEnd, html};

use super::{Document, all, groups};
use crate::embedded;

/// Address of files that documents link to and that are not in the program.
const SOURCES: &str = concat!(env!("CARGO_PKG_REPOSITORY"), "/blob/main");

/// Style of reports, and of the list of documents beside the text.
const STYLE: &str = concat!(
    include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/../../assets/report/report.css")),
    include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/../../assets/report/document.css")),
);

/// Writes the pages of all documents and the pictures into a folder, unless they are up to date, and returns the page of one.
pub fn write(folder: &Path, document: Document) -> Result<PathBuf, String> {
    for document in all() {
        write_if_changed(&folder.join(file(document.name)), page(document).as_bytes())?;
    }
    for (name, bytes) in embedded::PICTURES {
        write_if_changed(&folder.join(name), bytes)?;
    }
    Ok(folder.join(file(document.name)))
}

/// Writes a file and creates its folder, unless the file has this content already.
fn write_if_changed(file: &Path, bytes: &[u8]) -> Result<(), String> {
    if endline_gear::read::bytes(file).is_ok_and(|there| there == bytes) {
        return Ok(());
    }
    let folder: io::Result<()> = file.parent().map_or(Ok(()), fs::create_dir_all);
    folder
        .and_then(|()| fs::write(file, bytes))
        .map_err(|error| format!("{}: cannot be written: {error}", file.display()))
}

/// File name of the page of a document.
fn file(name: &str) -> String {
    format!("{name}.html")
}

/// The page of a document, with a list of all documents.
fn page(document: Document) -> String {
    let mut list = String::new();
    for group in groups() {
        list += &format!("<h2>{}</h2>\n<ul>\n", escaped(group.title));
        for Document { name, title, contents, .. } in &group.documents {
            let shown = if *name == document.name { " aria-current=\"page\"" } else { "" };
            let (title, contents) = (escaped(title), escaped(contents));
            list += &format!(
                "<li><a href=\"{name}.html\" title=\"{contents}\"{shown}>{title}</a></li>\n"
            );
        }
        list += "</ul>\n";
    }
    format!(
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width\">\n<link rel=\"icon\" href=\"data:,\">\n\
         <title>{}: Endline</title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n<nav>\n{list}</nav>\n\
         <main>\n{}</main>\n</body>\n</html>\n",
        escaped(document.title),
        body(document.text),
    )
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('"', "&quot;")
}

/// Converts Markdown to HTML. Links lead to other pages or to the sources; headings have ids.
fn body(markdown: &str) -> String {
    let mut events: Vec<Event> = Parser::new_ext(markdown, Options::ENABLE_TABLES).collect();
    name_headings(&mut events);
    set_links(&mut events);
    let mut page = String::new();
    html::push_html(&mut page, events.into_iter());
    page
}

/// Sets the targets of links, and replaces the file name of a document in a link by its title.
fn set_links(events: &mut [Event]) {
    let mut in_link = false;
    for event in events {
        match event {
            Event::Start(Tag::Link { dest_url, .. }) => {
                *dest_url = target(dest_url).into();
                in_link = true;
            }
            Event::End(TagEnd::Link) => in_link = false,
            Event::Text(text) if in_link && text.ends_with(".md") => {
                if let Some(document) = super::find(text) {
                    *text = document.title.into();
                }
            }
            _ => {}
        }
    }
}

/// Target of a link in the page of a document.
fn target(link: &str) -> String {
    let (path, place) = link.split_at(link.find('#').unwrap_or(link.len()));
    if path.is_empty() || path.contains("://") || path.starts_with("mailto:") {
        return link.to_owned();
    }
    match path.strip_suffix(".md") {
        Some(name) if super::find(name).is_some() => format!("{}{place}", file(name)),
        _ if path.starts_with("pictures/") => link.to_owned(),
        _ => {
            let from = Path::new("docs").join(path);
            format!("{SOURCES}/{}{place}", without_dots(&from))
        }
    }
}

/// Resolves `..` in a path and joins its parts by `/`.
fn without_dots(path: &Path) -> String {
    let mut parts: Vec<String> = Vec::new();
    for part in path {
        if part == ".." {
            parts.pop();
        } else {
            parts.push(part.to_string_lossy().into_owned());
        }
    }
    parts.join("/")
}

/// Sets the id of each heading from its words, as GitHub does, so that links to `#its-words` work.
fn name_headings(events: &mut [Event]) {
    let mut seen: BTreeMap<String, usize> = BTreeMap::new();
    for start in 0..events.len() {
        if !matches!(events[start], Event::Start(Tag::Heading { .. })) {
            continue;
        }
        let words: String = events[start..]
            .iter()
            .take_while(|event| !matches!(event, Event::End(TagEnd::Heading(_))))
            .filter_map(|event| match event {
                Event::Text(text) | Event::Code(text) => Some(text.as_ref()),
                _ => None,
            })
            .collect();
        let name = words_joined(&words);
        let before = seen.entry(name.clone()).or_default();
        let named = if *before == 0 { name } else { format!("{name}-{before}") };
        *before += 1;
        if let Event::Start(Tag::Heading { id, .. }) = &mut events[start] {
            *id = Some(CowStr::from(named));
        }
    }
}

/// Lower-case letters and digits, with `-` for each space.
fn words_joined(text: &str) -> String {
    let lower = text.trim().to_lowercase();
    lower
        .chars()
        .filter(|letter| letter.is_alphanumeric() || matches!(letter, ' ' | '-' | '_'))
        .map(|letter| if letter == ' ' { '-' } else { letter })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The text between each occurrence of an opening and the next quote.
    fn after<'a>(page: &'a str, opening: &str) -> Vec<&'a str> {
        page.split(opening).skip(1).filter_map(|rest| rest.split('"').next()).collect()
    }

    #[test]
    fn every_link_and_picture_of_every_page_exists() {
        let pages: BTreeMap<String, String> =
            all().map(|document| (file(document.name), page(document))).collect();
        let mut links = 0;
        for (name, page) in &pages {
            for link in after(page, "href=\"").into_iter().filter(|link| !link.contains(':')) {
                let (to, place) = link.split_once('#').unwrap_or((link, ""));
                let to = if to.is_empty() { name } else { to };
                let there = pages.get(to).unwrap_or_else(|| panic!("{name}: {link}"));
                assert!(
                    place.is_empty() || after(there, "id=\"").contains(&place),
                    "{name}: {link}"
                );
                links += 1;
            }
            for picture in after(page, "src=\"") {
                let carried = embedded::PICTURES.iter().any(|(path, _)| *path == picture);
                assert!(carried, "{name}: {picture}");
            }
        }
        assert!(links > 100, "{links}");
    }

    #[test]
    fn unchanged_pages_and_pictures_are_not_written_again() {
        let folder = std::env::temp_dir().join(format!("endline-documents-{}", std::process::id()));
        let physics = super::super::find("physics").unwrap();
        let page = write(&folder, physics).unwrap();
        assert!(fs::read_to_string(&page).unwrap().contains("<title>Physics: what is solved"));
        let files = fs::read_dir(&folder).unwrap().count();
        assert_eq!(files, all().count() + 1, "one page per document, and the folder of pictures");
        let at = fs::metadata(&page).unwrap().modified().unwrap();
        assert_eq!(write(&folder, physics).unwrap(), page);
        assert_eq!(fs::metadata(&page).unwrap().modified().unwrap(), at);
        fs::remove_dir_all(&folder).unwrap();
        fs::write(&folder, "a file").unwrap();
        let error = write(&folder, physics).unwrap_err();
        assert!(error.contains("cannot be written"), "{error}");
        fs::remove_file(&folder).unwrap();
    }

    #[test]
    fn links_lead_to_pages_or_to_sources() {
        let shown = body("[physics.md](physics.md#rope), physics.md");
        let link = "<a href=\"physics.html#rope\">Physics: what is solved</a>, physics.md";
        assert!(shown.contains(link), "{shown}");
        assert_eq!(target("physics.md#rope"), "physics.html#rope");
        assert_eq!(target("#rope"), "#rope");
        assert_eq!(target("https://e.org/a.md"), "https://e.org/a.md");
        assert_eq!(target("../tests/window/lib.sh"), format!("{SOURCES}/tests/window/lib.sh"));
        assert_eq!(
            target("notebooks/two-links.ipynb"),
            format!("{SOURCES}/docs/notebooks/two-links.ipynb")
        );
    }

    #[test]
    fn headings_get_ids_from_their_words() {
        let page =
            body("# `endline run`: a run\n\n## A\n\n## A\n\n| a | b |\n|---|---|\n| 1 | <2 |\n");
        assert!(page.contains("<h1 id=\"endline-run-a-run\">"), "{page}");
        assert!(page.contains("<h2 id=\"a\">") && page.contains("<h2 id=\"a-1\">"), "{page}");
        assert!(page.contains("<td>&lt;2</td>"), "{page}");
    }
}
