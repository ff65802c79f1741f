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

/// Weak places as they are put into a line.
const USUAL_WEAK_PLACES: [(&str, &str); 3] =
    [("strength", "1,700 lbf"), ("every", "60 ft"), ("first", "30 ft")];

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

/// Puts weak places into a line by its path, such as `line.1`.
/// Errors: where there is no such line.
pub fn add_weak_places(document: &mut Document, line: &str) -> Result<(), String> {
    let mut put = |(key, value): &(&str, &str)| {
        document.put(&format!("{line}.weak_places.{key}"), &Setting::plain(value))
    };
    USUAL_WEAK_PLACES.iter().try_for_each(&mut put).map_err(message)
}

/// Replaces weak places at equal distances by a list of their lengths from the line's `from` end, on a line of this length [m].
/// Errors: where there are none, or their distances cannot be read.
pub fn list_weak_places(document: &mut Document, line: &str, length_m: f64) -> Result<(), String> {
    let places = weak_lengths(document, line, length_m)?;
    put_weak_lengths(document, line, &places)
}

/// Replaces a list of weak places by places at equal distances.
/// Errors: where there is no list.
pub fn space_weak_places(document: &mut Document, line: &str) -> Result<(), String> {
    document.remove(&format!("{line}.weak_places.at")).map_err(message)?;
    let spaced = USUAL_WEAK_PLACES.iter().filter(|(key, _)| *key != "strength");
    let mut put = |(key, value): &(&str, &str)| {
        document.put(&format!("{line}.weak_places.{key}"), &Setting::plain(value))
    };
    spaced.into_iter().try_for_each(&mut put).map_err(message)
}

/// Most weak places that are written as a list.
const MOST_LISTED: u32 = 1000;

/// Lengths of the weak places of a line from its `from` end [m].
fn weak_lengths(document: &Document, line: &str, length_m: f64) -> Result<Vec<f64>, String> {
    let weak = format!("{line}.weak_places");
    let read = |key: &str| {
        let text = document.get(&format!("{weak}.{key}"))?;
        Some(parse(&text, Quantity::Length).map_err(|error| format!("`{key}`: {error}")))
    };
    if document.has(&format!("{weak}.at")) {
        let listed = (0..).map_while(|index| read(&format!("at.{index}")));
        return listed.collect();
    }
    let every_m = read("every").ok_or("the weak places have no `every`")??;
    let first_m = read("first").transpose()?.unwrap_or(0.5 * every_m);
    if every_m <= 0.0 {
        return Err("`every` is not above zero".to_owned());
    }
    let places = (0..MOST_LISTED).map(|index| first_m + f64::from(index) * every_m);
    Ok(places.take_while(|at_m| *at_m < length_m).collect())
}

/// Writes lengths of weak places from the `from` end [m] in place of `every` and `first`.
fn put_weak_lengths(document: &mut Document, line: &str, at_m: &[f64]) -> Result<(), String> {
    let weak = format!("{line}.weak_places");
    if at_m.is_empty() {
        return Err("no weak place is on the line".to_owned());
    }
    let texts: Vec<String> = at_m.iter().map(|at_m| format!("{at_m:.2} m")).collect();
    for key in ["every", "first"] {
        if document.has(&format!("{weak}.{key}")) {
            document.remove(&format!("{weak}.{key}")).map_err(message)?;
        }
    }
    document.put(&format!("{weak}.at"), &Setting::texts(&texts)).map_err(message)
}

/// Distributes the weak places of a line that was split over its two halves, `lower` and `upper`.
fn split_weak_places(
    document: &mut Document,
    [lower, upper]: [&str; 2],
    half_m: f64,
) -> Result<(), String> {
    let weak = format!("{lower}.weak_places");
    let Some(strength) = document.get(&format!("{weak}.strength")) else { return Ok(()) };
    let places = weak_lengths(document, lower, 2.0 * half_m)?;
    let (below, above): (Vec<f64>, Vec<f64>) = places.into_iter().partition(|at_m| *at_m < half_m);
    if !above.is_empty() {
        let field = format!("{upper}.weak_places.strength");
        document.put(&field, &Setting::text(&strength)).map_err(message)?;
        // A place at the splice is just above it.
        let above: Vec<f64> = above.iter().map(|at_m| (at_m - half_m).max(0.01)).collect();
        put_weak_lengths(document, upper, &above)?;
    }
    if below.is_empty() {
        return document.remove(&weak).map_err(message);
    }
    put_weak_lengths(document, lower, &below)
}

/// Replaces a line by two lines of half its length with a splice between them. Each keeps its own weak places.
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
    let number = document.push_table("line", &line).map_err(message)?;
    split_weak_places(document, [&at, &format!("line.{number}")], length_m / 2.0)
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
    fn weak_places_are_added_listed_spaced_and_split_with_their_line() {
        let mut document = Document::parse(TEXT).unwrap();
        add_weak_places(&mut document, "line.0").unwrap();
        let read = |document: &Document, field: &str| document.get(&format!("line.{field}"));
        assert_eq!(read(&document, "0.weak_places.every").as_deref(), Some("60 ft"));
        assert_eq!(read(&document, "0.weak_places.strength").as_deref(), Some("1,700 lbf"));
        let mut split = document.clone();
        list_weak_places(&mut document, "line.0", 40.0).unwrap();
        // 30 and 90 ft of 131 ft.
        let listed = "[\"9.14 m\", \"27.43 m\"]";
        assert_eq!(read(&document, "0.weak_places.at").as_deref(), Some(listed));
        assert!(
            !document.has("line.0.weak_places.every") && !document.has("line.0.weak_places.first")
        );
        space_weak_places(&mut document, "line.0").unwrap();
        assert!(!document.has("line.0.weak_places.at"));
        assert_eq!(read(&document, "0.weak_places.first").as_deref(), Some("30 ft"));

        split_line(&mut split, 0).unwrap();
        assert_eq!(read(&split, "0.weak_places.at").as_deref(), Some("[\"9.14 m\"]"));
        assert_eq!(read(&split, "1.weak_places.at").as_deref(), Some("[\"7.43 m\"]"));
        assert_eq!(read(&split, "1.weak_places.strength").as_deref(), Some("1,700 lbf"));
        let mut bare = Document::parse(TEXT).unwrap();
        assert!(list_weak_places(&mut bare, "line.0", 40.0).is_err());
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
