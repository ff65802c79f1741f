//! Observations of gear on real whales.
//!
//! A file in `observations/` states sites with and without rope, wraps, the order along the rope, trailing gear, and sites that
//! were not visible. A search finds encounters with a similar end. The format is described in `docs/search.md`.

mod place;

use serde::{Deserialize, Serialize};
use strum::{IntoStaticStr, VariantArray};

use crate::diagnostic::{At, Diagnostic, Place, hint};
use crate::entry::{self, Confidence};
use crate::fields::{Fields, Problems, Range, id_of, read_file, rising};
use crate::study::texts;
use crate::tree::Node;
use crate::units::Quantity;

pub use place::{PathPlace, Site};

/// An observation of gear on a whale.
#[derive(Clone, Debug, PartialEq)]
pub struct Observation {
    /// Id: the file's name without `.toml`.
    pub id: String,
    /// Name shown to the user.
    pub name: String,
    /// Remarks; may be empty.
    pub notes: String,
    /// Its source.
    pub source: String,
    /// Its confidence.
    pub confidence: Confidence,
    /// The file itself.
    pub place: Place,
    /// Id of a study with encounters that may have led to it, if any.
    pub encounters: Option<At<String>>,
    /// Id of the whale in the library, if known.
    pub whale: Option<At<String>>,
    /// Age or length of the whale, if known.
    pub size: Option<Size>,
    /// Whether the mirror image of an end is equivalent.
    pub mirrored: bool,
    /// Sites with visible rope, or without rope.
    pub sites: Vec<SeenSite>,
    /// Places along the rope, in order; empty if not reported.
    pub path: Vec<PathPlace>,
    /// Trailing gear.
    pub trailing: Option<Trailing>,
    /// Turns of the rope's two legs about each other, least and most.
    pub twist: Option<[f64; 2]>,
    /// Sites that were not visible.
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
    pub fn read(name: &str, text: &str) -> Result<Self, Vec<Diagnostic>> {
        read_file(name, text, |node, problems| Self::from_node(name, node, problems))
    }

    fn from_node(path: &str, node: &Node, problems: &Problems) -> Option<Self> {
        let fields = Fields::of(node, problems);
        let (name, notes, file) = entry::header(&fields, "observation", problems);
        if file.source.is_none() {
            fields.missing("source", "write the source of the observation");
        }
        if file.confidence.is_none() {
            fields.missing("confidence", "write measured, catalogue, derived or estimate");
        }
        let encounters = fields.text("encounters");
        let whale = fields.text("whale");
        let size = size(&fields);
        let mirrored = fields.flag("mirrored").unwrap_or(false);
        let sites = fields.each("site", site);
        let path_of_rope = rope_path(&fields);
        let trailing = fields.inside("trailing", trailing);
        let example = "such as turns = [1, 3]";
        let turns = |table: &Fields<'_>| rising(table, "turns", Quantity::Ratio, example);
        let twist = fields.inside("twist", turns).flatten();
        let hidden = fields.inside("hidden", hidden).unwrap_or_default();
        fields.finish();
        check_once(&sites, &hidden, problems);
        if fields.tables("site").is_empty() {
            fields.missing("site", "write the sites of rope under [[site]]");
        }
        Some(Self {
            id: id_of(path),
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
        let help = "keep one of them: the age determines the length";
        fields.problems().push(length.place.error("both `age` and `length` are present", help));
    }
    age.map(|age| Size::Age(age.value)).or(length.map(|length| Size::Length(length.value)))
}

/// Default probability of rope at a site.
const SURE: f64 = 0.95;

/// A site with visible rope, or without rope.
#[derive(Clone, Debug, PartialEq)]
pub struct SeenSite {
    /// The site.
    pub site: Site,
    /// Its place in the file.
    pub place: Place,
    /// Probability of rope there: 1 certain, 0 certainly none, 0.5 unknown.
    pub present: f64,
    /// Least and most wraps about it [turns].
    pub wraps: Option<[f64; 2]>,
    /// Least and most strands that lie across it without a turn.
    pub across: Option<[f64; 2]>,
    /// Whether rope was tight there, if reported.
    pub tight: Option<bool>,
    /// How it was observed; may be empty.
    pub seen_by: String,
}

/// Gear behind the whale.
#[derive(Clone, Debug, PartialEq)]
pub struct Trailing {
    /// Least and most rope behind the whale [m].
    pub length_m: Option<[f64; 2]>,
    /// The ends of the rope.
    pub ends: Vec<RopeEnd>,
}

/// The kind of an end of rope.
#[derive(
    Clone,
    Copy,
    Debug,
    PartialEq,
    Eq,
    PartialOrd,
    Ord,
    Serialize,
    Deserialize,
    IntoStaticStr,
    VariantArray,
)]
#[strum(serialize_all = "snake_case")]
#[serde(rename_all = "snake_case")]
pub enum RopeEnd {
    /// It parted there.
    Broken,
    /// A bare end.
    Bare,
    /// A buoy or high-flyer.
    Buoy,
    /// A trap.
    Trap,
    /// An anchor, a weight or a fixed object.
    Anchor,
}

impl RopeEnd {
    /// Every kind.
    pub const ALL: &'static [Self] = Self::VARIANTS;

    /// Its name in files.
    pub fn name(self) -> &'static str {
        self.into()
    }

    /// The end in words: `at a buoy`.
    pub fn words(self) -> &'static str {
        match self {
            Self::Broken => "where it broke",
            Self::Bare => "bare",
            Self::Buoy => "at a buoy",
            Self::Trap => "at a trap",
            Self::Anchor => "at an anchor",
        }
    }
}

/// Reads a `[[site]]`.
fn site(fields: &Fields<'_>) -> Option<SeenSite> {
    let sites: Vec<_> = Site::ALL.iter().map(|site| (site.name(), *site)).collect();
    let names: Vec<_> = Site::ALL.iter().map(|site| site.name()).collect();
    fields.require("part", format!("write one of {}", names.join(", ")));
    let part = fields.choice("part", &sites);
    let present = fields.value("present", Quantity::Ratio, Range::Between(0.0, 1.0));
    let wraps = rising(fields, "wraps", Quantity::Ratio, "such as wraps = [0.5, 1.5]");
    let across = across(fields);
    let tight = fields.flag("tight");
    let seen_by = fields.text("seen_by").map(|text| text.value).unwrap_or_default();
    let part = part?;
    if let (Some(across), Site::Mouth) = (&across, part.value) {
        let help = "write it at the part \"head\", for rope outside the mouth";
        return fields.refuse(across.place.error("rope in the mouth lies across nothing", help));
    }
    Some(SeenSite {
        site: part.value,
        place: part.place,
        present: present.map_or(SURE, |present| present.value),
        wraps,
        across: across.map(|across| across.value),
        tight,
        seen_by,
    })
}

/// Strands that lie across a part: two whole numbers.
fn across(fields: &Fields<'_>) -> Option<At<[f64; 2]>> {
    let value = rising(fields, "across", Quantity::Ratio, "such as across = [1, 1]")?;
    let place = fields.get("across")?.place.clone();
    if value.iter().any(|end| end.fract() != 0.0) {
        let help = "write whole numbers of strands, such as across = [1, 1]";
        return fields.refuse(place.error("`across` is not two counts of strands", help));
    }
    Some(At { value, place })
}

/// Reads `[path]`: places in the order in which rope passes them.
fn rope_path(fields: &Fields<'_>) -> Vec<PathPlace> {
    let order = |table: &Fields<'_>| texts(table, "order");
    let places = fields.inside("path", order).unwrap_or_default();
    let names = || Site::ALL.iter().map(|site| site.name());
    let place = |text: At<String>| {
        PathPlace::named(&text.value).or_else(|| {
            let message = format!("`{}` is not a place of a whale", text.value);
            let (site, _) = text.value.split_once(':').unwrap_or((&text.value, ""));
            let help = if Site::named(site).is_some() {
                "head, mouth, body and peduncle may have `:left` or `:right`; the names of fins contain their side".to_owned()
            } else {
                hint(site, names())
            };
            fields.refuse(text.place.error(message, help))
        })
    };
    places.into_iter().filter_map(place).collect()
}

/// Reads `[trailing]`.
fn trailing(table: &Fields<'_>) -> Trailing {
    let length_m =
        rising(table, "length", Quantity::Length, "such as length = [\"30 m\", \"50 m\"]");
    let names = || RopeEnd::ALL.iter().map(|end| end.name());
    let end = |text: At<String>| {
        let found = RopeEnd::ALL.iter().copied().find(|end| end.name() == text.value);
        if found.is_none() {
            let message = format!("`{}` is not an end of rope", text.value);
            table.problems().push(text.place.error(message, hint(&text.value, names())));
        }
        found
    };
    let ends = texts(table, "ends").into_iter().filter_map(end).collect();
    Trailing { length_m, ends }
}

/// Reads `[hidden]`: sites that were not visible.
fn hidden(table: &Fields<'_>) -> Vec<At<Site>> {
    let names = || Site::ALL.iter().map(|site| site.name());
    let site = |text: At<String>| match Site::named(&text.value) {
        Some(value) => Some(At { value, place: text.place }),
        None => {
            let message = format!("`{}` is not a part of a whale", text.value);
            table.refuse(text.place.error(message, hint(&text.value, names())))
        }
    };
    texts(table, "parts").into_iter().filter_map(site).collect()
}

/// Reports sites that occur more than once.
fn check_once(sites: &[SeenSite], hidden: &[At<Site>], problems: &Problems) {
    let seen = sites.iter().map(|seen| (seen.site, &seen.place));
    let all: Vec<_> = seen.chain(hidden.iter().map(|site| (site.value, &site.place))).collect();
    for (index, (site, place)) in all.iter().enumerate() {
        if all[..index].iter().any(|(other, _)| other == site) {
            let message = format!("`{}` occurs twice", site.name());
            problems.push(place.error(message, "write each part once, under [[site]] or [hidden]"));
        }
    }
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
    fn an_observation_is_read() {
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
    fn all_problems_are_reported_with_their_places() {
        for (from, to, expected, line) in [
            ("\"mouth\"", "\"mouht\"", "`mouht` is not a value of `part`", 10),
            ("present = 0.99", "present = 1.2", "`present`", 11),
            ("[0.5, 1.5]", "[1.5, 0.5]", "do not rise", 12),
            ("\"mouth:left\"", "\"mouth:up\"", "`mouth:up` is not a place", 17),
            ("\"flipper\"", "\"mouth\"", "`mouth` occurs twice", 14),
            ("present = 0\n", "present = 1\nacross = [1, 1.5]\n", "two counts of strands", 16),
            ("present = 0\n", "present = 1\nacross = [2, 1]\n", "`across` do not rise", 16),
            ("present = 0.99", "across = [1, 1]", "lies across nothing", 11),
            ("\"right_fluke\"", "\"mouth\"", "`mouth` occurs twice", 24),
            ("\"broken\"", "\"torn\"", "`torn` is not an end of rope", 20),
            ("age = \"1 yr\"", "age = \"1 yr\"\nlength = \"9 m\"", "are present", 8),
            ("present = 0\n", "presnt = 0\n", "unknown field `presnt`", 15),
        ] {
            let problems = Observation::read("o.toml", &TEXT.replacen(from, to, 1)).unwrap_err();
            let found = problems.iter().find(|problem| problem.message.contains(expected));
            let found = found.unwrap_or_else(|| panic!("{expected}: {problems:?}"));
            assert_eq!(found.line, line, "{found:?}");
        }
        let many = TEXT.replacen("\"mouth\"", "\"mouht\"", 1).replacen("\"broken\"", "\"torn\"", 1);
        assert_eq!(Observation::read("o.toml", &many).unwrap_err().len(), 2);
    }
}
