//! The observation: what was seen of gear on a real whale, as data.
//!
//! An observation file lies in `observations/`. It says where rope was and was not, how often it went round, in which order,
//! what hung behind, and what could not be seen. A search looks for encounters that end like it. The format is described in
//! `docs/search.md`.

mod place;
mod seen;

use crate::confidence::Confidence;
use crate::diagnostic::{At, Diagnostic, Place};
use crate::entry;
use crate::fields::{Fields, Problems, Range, rising};
use crate::tree::{self, Node};
use crate::units::Quantity;

pub use place::{PathPlace, Site};
pub use seen::{RopeEnd, SeenSite, Trailing};

/// What was seen of gear on a whale.
#[derive(Clone, Debug, PartialEq)]
pub struct Observation {
    /// Id: the file's name without `.toml`.
    pub id: String,
    /// Name shown to the user.
    pub name: String,
    /// Remarks; may be empty.
    pub notes: String,
    /// Who saw it.
    pub source: String,
    /// How well it is known.
    pub confidence: Confidence,
    /// The file itself.
    pub place: Place,
    /// Id of the study whose encounters may have led to it, where one is named.
    pub encounters: Option<At<String>>,
    /// Id of the whale in the library, where it is known.
    pub whale: Option<At<String>>,
    /// How old or how long the whale was, where either is known.
    pub size: Option<Size>,
    /// Whether an ending that is its mirror image is as much like it.
    pub mirrored: bool,
    /// Places at which rope was seen, or seen to be absent.
    pub sites: Vec<SeenSite>,
    /// Places that rope passes, in its order; empty where it was not told.
    pub path: Vec<PathPlace>,
    /// What hung behind.
    pub trailing: Option<Trailing>,
    /// Turns of the rope's two legs about each other, least and most.
    pub twist: Option<[f64; 2]>,
    /// Places that nobody could see.
    pub hidden: Vec<Site>,
}

/// Age or length of a whale.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Size {
    /// Age [s].
    Age(f64),
    /// Length [m].
    Length(f64),
}

impl Observation {
    /// Reads an observation's text; `name` is its path as shown in messages.
    ///
    /// # Errors
    /// Everything wrong with it that can be seen without the library.
    pub fn read(name: &str, text: &str) -> Result<Self, Vec<Diagnostic>> {
        let problems = Problems::default();
        let node = tree::read(name, text).map_err(|problem| vec![*problem])?;
        match Self::from_node(name, &node, &problems) {
            Some(observation) if !problems.any_error() => Ok(observation),
            _ => Err(problems.into_sorted()),
        }
    }

    fn from_node(path: &str, node: &Node, problems: &Problems) -> Option<Self> {
        let fields = Fields::of(node, problems);
        let (name, notes, file) = entry::header(&fields, "observation", problems);
        if file.source.is_none() {
            fields.missing("source", "say who saw it");
        }
        if file.confidence.is_none() {
            fields.missing("confidence", "write measured, derived or estimate");
        }
        let encounters = fields.text("encounters");
        let whale = fields.text("whale");
        let size = size(&fields);
        let mirrored = fields.flag("mirrored").unwrap_or(false);
        let sites = seen::sites(&fields);
        let path_of_rope = seen::path(&fields);
        let trailing = fields.table("trailing").and_then(|table| seen::trailing(&table));
        let twist = fields.table("twist").and_then(|table| twist(&table));
        let hidden = fields.table("hidden").map(|table| seen::hidden(&table)).unwrap_or_default();
        fields.finish();
        seen::check_once(&sites, &hidden, problems);
        if fields.tables("site").is_empty() {
            fields.missing("site", "write under [[site]] where rope was seen");
        }
        Some(Self {
            id: path.rsplit('/').next().unwrap_or(path).trim_end_matches(".toml").to_owned(),
            name,
            notes,
            source: file.source?,
            confidence: file.confidence?,
            place: node.place.clone(),
            encounters,
            whale,
            size,
            mirrored,
            sites,
            path: path_of_rope,
            trailing,
            twist,
            hidden: hidden.into_iter().map(|site| site.value).collect(),
        })
    }
}

/// Age or length; not both.
fn size(fields: &Fields<'_>) -> Option<Size> {
    let age = fields.value("age", Quantity::Time, Range::Positive);
    let length = fields.value("length", Quantity::Length, Range::Positive);
    if let (Some(_), Some(length)) = (&age, &length) {
        let help = "keep one of them: a whale's length follows from its age";
        fields.problems().push(length.place.error("`age` and `length` are both given", help));
    }
    age.map(|age| Size::Age(age.value)).or(length.map(|length| Size::Length(length.value)))
}

/// `[twist]`: turns of the rope's two legs about each other.
fn twist(table: &Fields<'_>) -> Option<[f64; 2]> {
    let turns = rising(table, "turns", Quantity::Ratio, "such as turns = [1, 3]");
    table.finish();
    turns
}

#[cfg(test)]
mod tests {
    use endline_sdk::Side;

    use super::*;

    const TEXT: &str = r#"
format = 1
kind = "observation"
name = "Eg 1"
source = "a paper"
confidence = "measured"
age = "1 yr"
encounters = "met-single"
[[site]]
part = "mouth"
present = 0.99
wraps = [0.5, 1.5]
[[site]]
part = "flipper"
present = 0
[path]
order = ["mouth:left", "head", "mouth:right"]
[trailing]
length = ["30 m", "50 m"]
ends = ["broken", "buoy"]
[twist]
turns = [1, 3]
[hidden]
parts = ["right_fluke"]
"#;

    #[test]
    fn what_was_seen_is_read() {
        let seen = Observation::read("observations/eg-1.toml", TEXT)
            .unwrap_or_else(|problems| panic!("{problems:?}"));
        assert_eq!((seen.id.as_str(), seen.sites.len()), ("eg-1", 2));
        assert_eq!(seen.sites[0].wraps, Some([0.5, 1.5]));
        assert_eq!(seen.sites[1].site, Site::Flipper);
        assert_eq!(seen.path[0], PathPlace { site: Site::Mouth, side: Some(Side::Left) });
        let trailing = seen.trailing.unwrap();
        assert_eq!(trailing.length_m, Some([30.0, 50.0]));
        assert_eq!(trailing.ends, [RopeEnd::Broken, RopeEnd::Buoy]);
        assert_eq!((seen.twist, seen.hidden), (Some([1.0, 3.0]), vec![Site::RightFluke]));
        let Some(Size::Age(age_s)) = seen.size else { panic!("{:?}", seen.size) };
        assert!((age_s / crate::items::YEAR_S - 1.0).abs() < 1e-9);
    }

    #[test]
    fn mistakes_are_told_all_at_once_each_where_it_stands() {
        for (from, to, told, line) in [
            ("\"mouth\"", "\"mouht\"", "`mouht` is no value of `part`", 10),
            ("present = 0.99", "present = 1.2", "`present`", 11),
            ("[0.5, 1.5]", "[1.5, 0.5]", "are no two rising values", 12),
            ("\"mouth:left\"", "\"mouth:up\"", "`mouth:up` is no place", 17),
            ("\"flipper\"", "\"mouth\"", "`mouth` is given twice", 14),
            ("\"right_fluke\"", "\"mouth\"", "`mouth` is given twice", 24),
            ("\"broken\"", "\"torn\"", "`torn` is no end of rope", 20),
            ("age = \"1 yr\"", "age = \"1 yr\"\nlength = \"9 m\"", "are both given", 8),
            ("present = 0\n", "presnt = 0\n", "unknown field `presnt`", 15),
        ] {
            let problems = Observation::read("o.toml", &TEXT.replacen(from, to, 1)).unwrap_err();
            let found = problems.iter().find(|problem| problem.message.contains(told));
            let found = found.unwrap_or_else(|| panic!("{told}: {problems:?}"));
            assert_eq!(found.line, line, "{found:?}");
        }
        let many = TEXT.replacen("\"mouth\"", "\"mouht\"", 1).replacen("\"broken\"", "\"torn\"", 1);
        assert_eq!(Observation::read("o.toml", &many).unwrap_err().len(), 2);
    }
}
