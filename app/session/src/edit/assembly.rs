//! Edits of an assembly that is written out part by part: bodies, lines, weak links, splices.

use endline_gear::units::{Quantity, parse};
use endline_gear::{Document, EditError, Setting};

/// Weak inserts as they are put into a line: 3 ft every 60 ft over the top three quarters.
const USUAL_INSERTS: [(&str, &str); 5] = [
    ("rope", "weak-1700-3-8"),
    ("length", "3 ft"),
    ("first", "12 ft"),
    ("every", "60 ft"),
    ("within", "0.75"),
];

fn message(error: EditError) -> String {
    error.message
}

/// Ids of the tables of a list, such as `body`.
pub fn ids(document: &Document, list: &str) -> Vec<String> {
    (0..).map_while(|index| document.get(&format!("{list}.{index}.id"))).collect()
}

/// An id with this stem that no part of a list has.
fn fresh_id(document: &Document, list: &str, stem: &str) -> String {
    let taken = ids(document, list);
    let numbered = (2..).map(|number| format!("{stem}-{number}"));
    let mut candidates = std::iter::once(stem.to_owned()).chain(numbered);
    candidates.find(|id| !taken.contains(id)).unwrap_or_default()
}

/// Adds a body of a kind, such as `trap`, with an item of the library. `height` is the first guess
/// of its height, as a share of the depth.
/// Errors: where `body` is no list of tables.
pub fn add_body(
    document: &mut Document,
    kind: &str,
    item: &str,
    height: &str,
) -> Result<(), String> {
    let id = fresh_id(document, "body", kind);
    let fields = [
        ("id", id.as_str()),
        ("kind", kind),
        ("item", item),
        ("position", "[\"0 m\", \"0 m\"]"),
        ("height", height),
    ];
    document.push_table("body", &fields).map(|_| ()).map_err(message)
}

/// Adds a line between two bodies.
/// Errors: where `line` is no list of tables.
pub fn add_line(document: &mut Document, from: &str, to: &str) -> Result<(), String> {
    let id = fresh_id(document, "line", "line");
    let fields = [
        ("id", id.as_str()),
        ("rope", "sink-3-8"),
        ("from", from),
        ("to", to),
        ("length", "20 fathom"),
    ];
    document.push_table("line", &fields).map(|_| ()).map_err(message)
}

/// Adds a weak link at an end, `from` or `to`, of a line. `strength` is a field with its value: an
/// `item` of the library, or a `rating` such as `600 lbf`.
/// Errors: where `link` is no list of tables.
pub fn add_link(
    document: &mut Document,
    line: &str,
    end: &str,
    strength: (&str, &str),
) -> Result<(), String> {
    let id = fresh_id(document, "link", &format!("{}-link", line.replace('/', "-")));
    let fields = [("id", id.as_str()), strength, ("line", line), ("end", end)];
    document.push_table("link", &fields).map(|_| ()).map_err(message)
}

/// Puts weak inserts into a line by its path, such as `line.1`.
/// Errors: where there is no such line.
pub fn add_inserts(document: &mut Document, line: &str) -> Result<(), String> {
    let mut put = |(key, value): &(&str, &str)| {
        document.put(&format!("{line}.inserts.{key}"), &Setting::plain(value))
    };
    USUAL_INSERTS.iter().try_for_each(&mut put).map_err(message)
}

/// Replaces a line by two lines of half its length with a splice between them.
/// Errors: where there is no such line, or its length cannot be read.
pub fn split_line(document: &mut Document, index: usize) -> Result<(), String> {
    let at = format!("line.{index}");
    let field = |key: &str| document.get(&format!("{at}.{key}")).unwrap_or_default();
    let length_m = parse(&field("length"), Quantity::Length).map_err(|error| error.to_string())?;
    let (id, rope, from, to) = (field("id"), field("rope"), field("from"), field("to"));
    let splice = fresh_id(document, "joint", &format!("{id}-splice"));
    let upper = fresh_id(document, "line", &format!("{id}-top"));
    let ends = [&from, &to].map(|part| place_of(document, part));
    let middle = |axis: usize| f64::midpoint(ends[0][axis], ends[1][axis]);
    let half = format!("{:.2} m", length_m / 2.0);
    let position = format!("[\"{:.1} m\", \"0 m\"]", middle(0));
    let height = format!("{:.2}", middle(1));
    let joint = [("id", splice.as_str()), ("position", &position), ("height", &height)];
    document.push_table("joint", &joint).map_err(message)?;
    document.set(&format!("{at}.to"), &splice).map_err(message)?;
    document.set(&format!("{at}.length"), &half).map_err(message)?;
    let line = [
        ("id", upper.as_str()),
        ("rope", &rope),
        ("from", &splice),
        ("to", &to),
        ("length", &half),
    ];
    document.push_table("line", &line).map(|_| ()).map_err(message)
}

/// First guess of a part's place along the gear [m] and of its height as a share of the depth.
fn place_of(document: &Document, part: &str) -> [f64; 2] {
    let part = part.split(':').next().unwrap_or(part);
    let found = ["body", "joint"].iter().find_map(|list| {
        let index = ids(document, list).iter().position(|id| id == part)?;
        Some(format!("{list}.{index}"))
    });
    let Some(at) = found else { return [0.0; 2] };
    let read = |key: &str, quantity| {
        let text = document.get(&format!("{at}.{key}"));
        text.and_then(|text| parse(&text, quantity).ok()).unwrap_or(0.0)
    };
    [read("position.0", Quantity::Length), read("height", Quantity::Ratio)]
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "[[body]]\nid = \"trap\"\nposition = [\"0 m\", \"0 m\"]\nheight = \"0\"\n\n[[body]]\nid = \"buoy\"\nposition = [\"10 m\", \"0 m\"]\nheight = \"1\"\n\n[[line]]\nid = \"endline\"\nrope = \"sink-3-8\"\nfrom = \"trap\"\nto = \"buoy\"\nlength = \"40 m\"\n";

    #[test]
    fn a_split_line_keeps_its_length_and_ends_and_has_a_splice_in_the_middle() {
        let mut document = Document::parse(TEXT).unwrap();
        split_line(&mut document, 0).unwrap();
        let read = |field: &str| document.get(field).unwrap();
        assert_eq!(ids(&document, "line"), ["endline", "endline-top"]);
        assert_eq!([read("line.0.length"), read("line.1.length")], ["20.00 m", "20.00 m"]);
        assert_eq!(
            [read("line.0.from"), read("line.0.to"), read("line.1.from"), read("line.1.to")],
            ["trap", "endline-splice", "endline-splice", "buoy"]
        );
        assert_eq!([read("joint.0.position.0"), read("joint.0.height")], ["5.0 m", "0.50"]);
        assert!(split_line(&mut document, 7).is_err());
    }

    #[test]
    fn added_parts_have_ids_of_their_own() {
        let mut document = Document::parse(TEXT).unwrap();
        add_body(&mut document, "trap", "lobster-trap", "0").unwrap();
        add_line(&mut document, "trap", "trap-2").unwrap();
        add_link(&mut document, "pair/endline", "to", ("rating", "600 lbf")).unwrap();
        add_link(&mut document, "pair/endline", "from", ("item", "weak-link-600")).unwrap();
        assert_eq!(ids(&document, "body"), ["trap", "buoy", "trap-2"]);
        assert_eq!(ids(&document, "link"), ["pair-endline-link", "pair-endline-link-2"]);
        add_inserts(&mut document, "line.0").unwrap();
        assert_eq!(document.get("line.0.inserts.within").as_deref(), Some("0.75"));
    }
}
