//! docs/gear-types.md says of every gear type what its plugin says of itself.
//!
//! `ENDLINE_WRITE_DOCS=1 cargo test -p endline-tests --test tidy gear_docs` writes the tables anew.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail the test")]

use std::fmt::Write;
use std::fs;

use endline_sdk::{Attribute, AttributeKind, GearType};
use endline_tests::root;

const DOCUMENT: &str = "docs/gear-types.md";
const END: &str = "<!-- end of attributes -->";

fn start(id: &str) -> String {
    format!("<!-- attributes of {id} -->")
}

/// Unit, range and default of an attribute.
fn values(attribute: &Attribute) -> [String; 2] {
    match &attribute.kind {
        AttributeKind::Number { min, max, default } => {
            let unit =
                if attribute.unit == "1" { String::new() } else { format!(" {}", attribute.unit) };
            // Fractions such as a third have four decimal places.
            let rounded = (default * 1e4).round() / 1e4;
            [format!("{min} to {max}{unit}"), format!("{rounded}{unit}")]
        }
        AttributeKind::Count { min, max, default } => {
            [format!("whole, {min} to {max}"), default.to_string()]
        }
        AttributeKind::Choice { words, default } => [words.join(", "), default.to_string()],
        AttributeKind::Item { library, default } => [
            format!("item of {library}"),
            if default.is_empty() { "none".to_owned() } else { default.to_string() },
        ],
    }
}

fn table(gear: &dyn GearType) -> String {
    let mut text = String::from("| attribute | values | default | |\n|---|---|---|---|\n");
    for attribute in &gear.descriptor().attributes {
        let [range, default] = values(attribute);
        writeln!(text, "| `{}` | {range} | {default} | {} |", attribute.key, attribute.help)
            .unwrap();
    }
    text
}

/// The document with a gear type's table put between its marks.
fn with_table(document: &str, gear: &dyn GearType) -> String {
    let start = start(&gear.descriptor().id);
    let (before, rest) =
        document.split_once(&start).unwrap_or_else(|| panic!("{DOCUMENT} lacks the mark {start}"));
    let (_, after) = rest
        .split_once(END)
        .unwrap_or_else(|| panic!("{DOCUMENT} lacks the mark {END} after {start}"));
    format!("{before}{start}\n{}{END}{after}", table(gear))
}

#[test]
fn the_document_has_every_gear_type_with_its_attributes() {
    let path = root().join(DOCUMENT);
    let document = fs::read_to_string(&path).unwrap();
    let fresh = endline_gear_types::all()
        .iter()
        .fold(document.clone(), |text, gear| with_table(&text, gear.as_ref()));
    if std::env::var_os("ENDLINE_WRITE_DOCS").is_some() {
        fs::write(&path, &fresh).unwrap();
        return;
    }
    let first = document.lines().zip(fresh.lines()).find(|(old, new)| old != new);
    assert_eq!(
        document, fresh,
        "{DOCUMENT} is out of date, first at {first:?}; the head of tests/tests/tidy/gear_docs.rs says how to write it anew"
    );
}
