//! Parts of an observation: sites, the path of the rope, what hung behind, what was hidden.

use serde::{Deserialize, Serialize};

use crate::diagnostic::At;
use crate::fields::{Fields, Problems, Range, rising};
use crate::nearest::hint;
use crate::study::texts;
use crate::tree::Node;
use crate::units::Quantity;

use super::place::{PathPlace, Site};

/// How sure it is that rope was there, where a site does not say.
const SURE: f64 = 0.95;

/// Rope seen at a site, or seen to be absent.
#[derive(Clone, Debug, PartialEq)]
pub struct SeenSite {
    /// The site.
    pub site: Site,
    /// Where it is named in the file.
    pub place: crate::diagnostic::Place,
    /// Probability that rope was there: 1 surely, 0 surely not, 0.5 nobody knows.
    pub present: f64,
    /// Least and most wraps about it [turns].
    pub wraps: Option<[f64; 2]>,
    /// Whether rope was tight there, where it was told.
    pub tight: Option<bool>,
    /// How it was seen; may be empty.
    pub seen_by: String,
}

/// What hung behind the whale.
#[derive(Clone, Debug, PartialEq)]
pub struct Trailing {
    /// Least and most rope behind the whale [m].
    pub length_m: Option<[f64; 2]>,
    /// What was at the ends of the rope.
    pub ends: Vec<RopeEnd>,
}

/// What is at an end of rope.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum RopeEnd {
    /// It parted there.
    Broken,
    /// It simply ends.
    Bare,
    /// A buoy or high-flyer.
    Buoy,
    /// A trap.
    Trap,
    /// An anchor or weight, or what does not move.
    Anchor,
}

impl RopeEnd {
    /// Every kind.
    pub const ALL: [Self; 5] = [Self::Broken, Self::Bare, Self::Buoy, Self::Trap, Self::Anchor];

    /// Its name in files.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Broken => "broken",
            Self::Bare => "bare",
            Self::Buoy => "buoy",
            Self::Trap => "trap",
            Self::Anchor => "anchor",
        }
    }

    /// What rope with this end does, in words: `at a buoy`.
    #[must_use]
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

/// Reads `[[site]]`.
pub(super) fn sites(fields: &Fields<'_>) -> Vec<SeenSite> {
    let problems = fields.problems();
    fields.tables("site").iter().filter_map(|node| site(node, problems)).collect()
}

fn site(node: &Node, problems: &Problems) -> Option<SeenSite> {
    let fields = Fields::of(node, problems);
    let names = Site::ALL.map(Site::name);
    fields.need_text("part", &format!("write one of {}", names.join(", ")));
    let part = fields.word("part", &names);
    let present = fields.value("present", Quantity::Ratio, Range::Between(0.0, 1.0));
    let wraps = rising(&fields, "wraps", Quantity::Ratio, "such as wraps = [0.5, 1.5]");
    let tight = fields.flag("tight");
    let seen_by = fields.text("seen_by").map(|text| text.value).unwrap_or_default();
    fields.finish();
    let part = part?;
    Some(SeenSite {
        site: Site::named(&part.value)?,
        place: part.place,
        present: present.map_or(SURE, |present| present.value),
        wraps,
        tight,
        seen_by,
    })
}

/// Reads `[path]`: places in the order in which rope passes them.
pub(super) fn path(fields: &Fields<'_>) -> Vec<PathPlace> {
    let Some(table) = fields.table("path") else { return Vec::new() };
    let places = texts(&table, "order");
    table.finish();
    let names = || Site::ALL.iter().map(|site| site.name());
    let place = |text: At<String>| {
        PathPlace::named(&text.value).or_else(|| {
            let message = format!("`{}` is no place of a whale", text.value);
            let (site, _) = text.value.split_once(':').unwrap_or((&text.value, ""));
            let help = if Site::named(site).is_some() {
                "head, mouth, body and peduncle may have `:left` or `:right`; fins have their side in their name".to_owned()
            } else {
                hint(site, names())
            };
            table.problems().push(text.place.error(message, help));
            None
        })
    };
    places.into_iter().filter_map(place).collect()
}

/// Reads `[trailing]`.
pub(super) fn trailing(table: &Fields<'_>) -> Option<Trailing> {
    let length_m =
        rising(table, "length", Quantity::Length, "such as length = [\"30 m\", \"50 m\"]");
    let names = || RopeEnd::ALL.iter().map(|end| end.name());
    let end = |text: At<String>| {
        let found = RopeEnd::ALL.into_iter().find(|end| end.name() == text.value);
        if found.is_none() {
            let message = format!("`{}` is no end of rope", text.value);
            table.problems().push(text.place.error(message, hint(&text.value, names())));
        }
        found
    };
    let ends = texts(table, "ends").into_iter().filter_map(end).collect();
    table.finish();
    Some(Trailing { length_m, ends })
}

/// Reads `[hidden]`: sites that nobody could see.
pub(super) fn hidden(table: &Fields<'_>) -> Vec<At<Site>> {
    let names = || Site::ALL.iter().map(|site| site.name());
    let site = |text: At<String>| match Site::named(&text.value) {
        Some(value) => Some(At { value, place: text.place }),
        None => {
            let message = format!("`{}` is no part of a whale", text.value);
            table.problems().push(text.place.error(message, hint(&text.value, names())));
            None
        }
    };
    let sites = texts(table, "parts").into_iter().filter_map(site).collect();
    table.finish();
    sites
}

/// A site is given once: seen with rope, seen without, or hidden.
pub(super) fn check_once(sites: &[SeenSite], hidden: &[At<Site>], problems: &Problems) {
    let seen = sites.iter().map(|seen| (seen.site, &seen.place));
    let given: Vec<_> = seen.chain(hidden.iter().map(|site| (site.value, &site.place))).collect();
    for (index, (site, place)) in given.iter().enumerate() {
        if given[..index].iter().any(|(other, _)| other == site) {
            let message = format!("`{}` is given twice", site.name());
            problems.push(place.error(message, "give each part once, under [[site]] or [hidden]"));
        }
    }
}
