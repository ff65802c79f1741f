//! Rule packs: legal requirements on fishing gear, and dates.
//!
//! A pack in `rules/` contains the rules of a jurisdiction. Conditions and checks are expressions over facts of assembled
//! gear. The caller of [`RulePack::read`] defines the facts and checks the expressions. The format is described in
//! `docs/rules.md`.

mod rule;

use std::fmt;

use crate::diagnostic::{At, Diagnostic, Place};
use crate::entry;
use crate::fields::{Fields, Problems, Provenance, id_of, read_file};
use crate::study::texts;
use crate::tree::{Content, Node};

pub use rule::{Parameter, Rule, RuleDraft, Standing, Subject};

/// The rules of a jurisdiction.
#[derive(Clone, Debug)]
pub struct RulePack {
    /// Id: the file's name without `.toml`.
    pub id: String,
    /// Name shown to the user.
    pub name: String,
    /// Remarks; may be empty.
    pub notes: String,
    /// Jurisdiction, such as `US-MA`.
    pub jurisdiction: String,
    /// Its areas.
    pub areas: Vec<Area>,
    /// Its rules, in the order of the file.
    pub rules: Vec<Rule>,
}

/// An area of rules.
#[derive(Clone, Debug)]
pub struct Area {
    /// Its id, such as `lma-1`.
    pub id: At<String>,
    /// Its name.
    pub name: String,
    /// The area that contains it, of this or another pack, whose rules also apply here.
    pub within: Option<At<String>>,
    /// Ids of the library's sites that lie in it.
    pub sites: Vec<At<String>>,
}

impl RulePack {
    /// Reads a pack's text; `name` is its path as shown in messages. `judge` checks the expressions of all rules, including
    /// those with other problems, and returns their problems.
    pub fn read(
        name: &str,
        text: &str,
        judge: &dyn Fn(&RuleDraft) -> Vec<Diagnostic>,
    ) -> Result<Self, Vec<Diagnostic>> {
        read_file(name, text, |node, problems| Self::from_node(name, node, problems, judge))
    }

    fn from_node(
        path: &str,
        node: &Node,
        problems: &Problems,
        judge: &dyn Fn(&RuleDraft) -> Vec<Diagnostic>,
    ) -> Option<Self> {
        let fields = Fields::of(node, problems);
        let (name, notes, file) = entry::header(&fields, "rules", problems);
        let jurisdiction =
            fields.need_text("jurisdiction", "write the jurisdiction, such as \"US-MA\"");
        let areas = fields.each("area", area);
        let rules = rules(&fields, &file, judge);
        fields.finish();
        if fields.tables("rule").is_empty() {
            fields.missing("rule", "write each rule under [[rule]]");
        }
        check_unique(areas.iter().map(|area| &area.id), problems);
        check_unique(rules.iter().map(|rule| &rule.id), problems);
        let (id, jurisdiction) = (id_of(path), jurisdiction?.value);
        Some(Self { id, name, notes, jurisdiction, areas, rules })
    }
}

fn rules(
    fields: &Fields<'_>,
    file: &Provenance,
    judge: &dyn Fn(&RuleDraft) -> Vec<Diagnostic>,
) -> Vec<Rule> {
    let one = |node: &Node| {
        let draft = RuleDraft::read(node, file, fields.problems());
        fields.problems().extend(judge(&draft));
        draft.finished()
    };
    fields.tables("rule").iter().filter_map(one).collect()
}

/// Reads an `[[area]]`.
fn area(fields: &Fields<'_>) -> Option<Area> {
    let id = fields.need_id("id", "write an id such as \"lma-1\"");
    let name = fields.need_text("name", "write a name in quotes");
    let (within, sites) = (fields.text("within"), texts(fields, "sites"));
    Some(Area { id: id?, name: name?.value, within, sites })
}

/// Reports duplicate ids.
fn check_unique<'a>(ids: impl Iterator<Item = &'a At<String>>, problems: &Problems) {
    let mut seen: Vec<(&str, &Place)> = Vec::new();
    for id in ids {
        if seen.iter().any(|(known, _)| *known == id.value) {
            let message = format!("`{}` occurs twice", id.value);
            problems.push(id.place.error(message, "use each id once"));
        }
        seen.push((&id.value, &id.place));
    }
}

/// A day of the Gregorian calendar; dates compare by time.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Date {
    year: u16,
    month: u8,
    day: u8,
}

impl Date {
    /// A day written as `2022-05-01`; `None` where the calendar has no such day.
    pub fn parse(text: &str) -> Option<Self> {
        let mut parts = text.split('-');
        let mut part = |digits: usize| {
            let part = parts.next()?;
            let is_number = part.len() == digits && part.bytes().all(|byte| byte.is_ascii_digit());
            if is_number { part.parse::<u16>().ok() } else { None }
        };
        let (year, month, day) = (part(4)?, part(2)?, part(2)?);
        if parts.next().is_some() || !(1..=12).contains(&month) {
            return None;
        }
        let (month, day) = (u8::try_from(month).ok()?, u8::try_from(day).ok()?);
        (1..=days_of(year, month)).contains(&day).then_some(Self { year, month, day })
    }

    /// Day for rules without a known start.
    const USUAL: Self = Self { year: 2024, month: 1, day: 1 };

    /// The day a number of days after 1 January 1970.
    pub fn after_1970(days: u64) -> Self {
        (0..days).fold(Self { year: 1970, month: 1, day: 1 }, |day, _| day.next())
    }

    /// The day after.
    fn next(self) -> Self {
        let Self { year, month, day } = self;
        if day < days_of(year, month) {
            Self { day: day + 1, ..self }
        } else if month < 12 {
            Self { month: month + 1, day: 1, ..self }
        } else {
            Self { year: year + 1, month: 1, day: 1 }
        }
    }

    /// Whether it is in a season, from a first to a last day of the year; the season includes the turn of the year if the
    /// first day is later than the last.
    pub fn is_in(self, [first, last]: [u16; 2]) -> bool {
        let day = self.day_of_year();
        if first <= last { (first..=last).contains(&day) } else { day >= first || day <= last }
    }

    /// Its number in the year: 1 is 1 January.
    pub fn day_of_year(self) -> u16 {
        let before = (1..self.month).map(|month| u16::from(days_of(self.year, month)));
        before.sum::<u16>() + u16::from(self.day)
    }
}

impl fmt::Display for Date {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:04}-{:02}-{:02}", self.year, self.month, self.day)
    }
}

fn days_of(year: u16, month: u8) -> u8 {
    let is_leap = year.is_multiple_of(4) && (!year.is_multiple_of(100) || year.is_multiple_of(400));
    match month {
        2 => 28 + u8::from(is_leap),
        4 | 6 | 9 | 11 => 30,
        _ => 31,
    }
}

/// Reads a date, with or without quotes; `unknown` is valid if it may be written.
fn date(fields: &Fields<'_>, key: &'static str, may_be_unknown: bool) -> Option<At<Option<Date>>> {
    let node = fields.get(key)?;
    let (Content::Text(text) | Content::Date(text)) = &node.content else {
        let message = format!("`{key}` is {}, not a date", node.content.noun());
        return fields.refuse(node.place.error(message, "write a day such as \"2022-05-01\""));
    };
    let value = Date::parse(text);
    if value.is_none() && !(may_be_unknown && text == "unknown") {
        let unknown = if may_be_unknown { ", or \"unknown\"" } else { "" };
        let help = format!("write year, month and day, such as \"2022-05-01\"{unknown}");
        return fields.refuse(node.place.error(format!("`{text}` is not a date"), help));
    }
    Some(At { value, place: node.place.clone() })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn days_are_those_of_the_calendar() {
        let day = |text: &str| Date::parse(text).map(Date::day_of_year);
        assert_eq!(day("2022-05-01"), Some(31 + 28 + 31 + 30 + 1));
        assert_eq!((day("2024-12-31"), day("2024-02-29")), (Some(366), Some(60)));
        for wrong in ["2023-02-29", "1900-02-29", "2022-13-01", "2022-5-1", "22-05-01", "May"] {
            assert_eq!(day(wrong), None, "{wrong}");
        }
        assert!(Date::parse("2022-04-30") < Date::parse("2022-05-01"));
        assert_eq!(Date::parse("2022-05-01").unwrap().to_string(), "2022-05-01");
        for (day, after) in [
            ("2024-02-28", "2024-02-29"),
            ("2023-02-28", "2023-03-01"),
            ("2023-12-31", "2024-01-01"),
        ] {
            assert_eq!(Date::parse(day).map(Date::next), Date::parse(after));
        }
        // 20,000 days of 86,400 s: `date -u -d @1728000000`.
        assert_eq!(Date::after_1970(20_000).to_string(), "2024-10-04");
        let in_winter = |text: &str| Date::parse(text).unwrap().is_in([305, 90]);
        assert_eq!(
            ["2023-11-01", "2023-03-31", "2023-10-31", "2023-04-01"].map(in_winter),
            [true, true, false, false]
        );
    }
}
