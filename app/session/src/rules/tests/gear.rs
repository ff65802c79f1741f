//! Gear of tests as text: traps in a row, endlines from the first and the last, a second buoy.

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::sync::LazyLock;

use endline_gear::{Library, Sources};

use super::super::{RuleGear, of_library};
use crate::plugins::PluginHost;

/// Weak rope of the library.
pub const WEAK: &str = "weak-1700-3-8";

/// An insert at a third of 40 m from the buoy.
pub const ONE_INSERT: &str = "[line.inserts]\nrope = \"weak-1700-3-8\"\nlength = \"3 ft\"\nfirst = \"13 m\"\nevery = \"30 m\"\n";

/// Inserts at a quarter and at half of 40 m from the buoy.
pub const TWO_INSERTS: &str = "[line.inserts]\nrope = \"weak-1700-3-8\"\nlength = \"3 ft\"\nfirst = \"9.5 m\"\nevery = \"10 m\"\nwithin = 0.6\n";

/// A buoy that a release holds down at the first trap, with its endline.
pub const STOWED: &str = r#"[[body]]
id = "buoy"
kind = "buoy"
item = "bullet-6x14"
height = 0.1
[[line]]
id = "stowed"
rope = "pp-3-8"
from = "trap-1"
to = "buoy"
length = "40 m"
[[line]]
id = "hold"
rope = "sink-3-8"
from = "trap-1"
to = "buoy"
length = "2 m"
[[link]]
id = "release"
item = "acoustic-release"
line = "hold"
end = "to"
"#;

/// The items that gear is made of.
static ITEMS: LazyLock<Sources> = LazyLock::new(|| {
    let all = Sources::from_folder(&library()).unwrap();
    let folders =
        ["ropes/", "traps/", "buoys/", "weak-links/", "knots/", "anchors/", "sites/", "friction/"];
    let mut items = Sources::default();
    for (path, text) in all.iter().filter(|(path, _)| folders.iter().any(|f| path.starts_with(f))) {
        items.set(path, text);
    }
    items
});

/// The shipped library.
pub fn library() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../gear-library")
}

/// Assembles an assembly's text.
pub fn assembled(text: &str) -> RuleGear {
    let mut sources = ITEMS.clone();
    sources.set("assemblies/test.toml", text);
    let (library, problems) = Library::read(&sources);
    let errors: Vec<String> =
        problems.iter().filter(|one| one.is_error()).map(ToString::to_string).collect();
    assert!(errors.is_empty(), "{}", errors.join("\n"));
    of_library("test", None, &library, &PluginHost::empty())
        .unwrap_or_else(|error| panic!("{error}\n{text}"))
}

/// Rope and length of an endline.
pub fn line(rope: &str, length: &str) -> String {
    format!("rope = \"{rope}\"\nlength = \"{length}\"\n")
}

/// Weak inserts of an endline.
pub fn inserts(length: &str, first: &str, every: &str) -> String {
    format!(
        "[line.inserts]\nrope = \"{WEAK}\"\nlength = \"{length}\"\nfirst = \"{first}\"\nevery = \"{every}\"\n"
    )
}

/// A weak link at the buoy of the first endline.
pub fn link(item: &str) -> String {
    format!("[[link]]\nid = \"buoy-link\"\nitem = \"{item}\"\nline = \"endline-1\"\nend = \"to\"\n")
}

/// A second buoy on a line from the first.
pub fn flyer(item: &str, length: &str) -> String {
    format!(
        "[[body]]\nid = \"second\"\nkind = \"buoy\"\nitem = \"{item}\"\nposition = [\"5 m\", \"0 m\"]\nheight = 1\n\
         [[line]]\nid = \"surface-line\"\nrope = \"sink-3-8\"\nfrom = \"buoy-1:side\"\nto = \"second\"\nlength = \"{length}\"\n"
    )
}

/// Traps in a row with groundlines between them, and endlines from the first trap and from the last.
pub fn rig(traps: usize, groundline: &str, spacing: &str, endlines: &[String]) -> String {
    let mut text = "format = 1\nkind = \"assembly\"\nname = \"Test\"\n".to_owned();
    let mut body = |id: &str, kind: &str, item: &str, along: usize, height: u8| {
        writeln!(
            text,
            "[[body]]\nid = \"{id}\"\nkind = \"{kind}\"\nitem = \"{item}\"\nposition = [\"{along} m\", \"0 m\"]\nheight = {height}"
        )
        .unwrap();
    };
    for trap in 1..=traps {
        body(&format!("trap-{trap}"), "trap", "wire-lobster-3ft", 20 * trap, 0);
    }
    for number in 1..=endlines.len() {
        body(&format!("buoy-{number}"), "buoy", "bullet-6x14", 20 * number, 1);
    }
    for trap in 1..traps {
        writeln!(
            text,
            "[[line]]\nid = \"groundline-{trap}\"\nrope = \"{groundline}\"\nfrom = \"trap-{trap}\"\nto = \"trap-{}\"\nlength = \"{spacing}\"",
            trap + 1
        )
        .unwrap();
    }
    for (number, line) in (1..).zip(endlines) {
        let foot = if number == 1 { 1 } else { traps };
        write!(
            text,
            "[[line]]\nid = \"endline-{number}\"\nfrom = \"trap-{foot}\"\nto = \"buoy-{number}\"\n{line}"
        )
        .unwrap();
    }
    text
}
