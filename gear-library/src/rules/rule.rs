//! A rule of a pack with its parameters: numbers with unit, source and confidence.

use crate::diagnostic::{At, Place};
use crate::entry::Confidence;
use crate::fields::{Fields, Problems, Provenance, Range, provenance_over, read_figure, rising};
use crate::study::texts;
use crate::tree::{Content, Node};
use crate::units::{self, Quantity, Unit};

use super::{Date, date};

/// The legal status of a rule.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Standing {
    /// In force by law, now or formerly.
    Law,
    /// Voluntary practice or advice.
    Voluntary,
    /// Proposed.
    Proposed,
}

/// The subject of a check.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Subject {
    /// The gear as a whole.
    Gear,
    /// Every endline: all must pass.
    EveryEndline,
    /// The endlines: one must pass.
    AnyEndline,
    /// Every groundline: all must pass.
    EveryGroundline,
}

/// A rule.
#[derive(Clone, Debug)]
pub struct Rule {
    /// Its id, such as `ma.strength`.
    pub id: At<String>,
    /// The requirement in a sentence.
    pub asks: String,
    /// The law, or the page, that states it.
    pub cite: String,
    /// Its legal status.
    pub standing: Standing,
    /// Source of the wording.
    pub source: String,
    /// Confidence in the wording: measured from the source, derived from a summary, or an estimate.
    pub confidence: Confidence,
    /// First day in force; `None` if unknown.
    pub from: Option<Date>,
    /// Last day in force, if any.
    pub until: Option<Date>,
    /// Areas where it applies; empty for everywhere.
    pub areas: Vec<At<String>>,
    /// Depths where it applies, the second excluded [m].
    pub depth_m: Option<[f64; 2]>,
    /// Distances from shore where it applies, the second excluded [m].
    pub distance_m: Option<[f64; 2]>,
    /// Numbers of traps to which it applies.
    pub traps: Option<[f64; 2]>,
    /// First and last day of the year on which it applies; a later first day means from autumn to spring.
    pub season: Option<[u16; 2]>,
    /// Subject of the check.
    pub subject: Subject,
    /// Additional condition under which it applies.
    pub when: Option<At<String>>,
    /// Required condition.
    pub check: At<String>,
    /// Its numbers.
    pub parameters: Vec<Parameter>,
    /// Remedy for gear that does not comply.
    pub remedy: String,
    /// Remarks; may be empty.
    pub notes: String,
}

/// A rule that is being read: its expressions, and the rule if it is complete.
#[derive(Clone, Debug)]
pub struct RuleDraft {
    /// Subject of the check.
    pub subject: Subject,
    /// The condition under which it applies.
    pub when: Option<At<String>>,
    /// Required condition.
    pub check: Option<At<String>>,
    /// Its numbers.
    pub parameters: Vec<Parameter>,
    rule: Option<Rule>,
}

impl Standing {
    /// The words a file uses, in the order of the variants.
    const WORDS: [(&'static str, Self); 3] =
        [("law", Self::Law), ("voluntary", Self::Voluntary), ("proposed", Self::Proposed)];

    /// Whether it is binding; other rules are advice.
    pub fn binds(self) -> bool {
        self == Self::Law
    }

    /// Its word.
    pub fn word(self) -> &'static str {
        Self::WORDS[self as usize].0
    }
}

impl Subject {
    /// The words a file uses, in the order of the variants.
    const WORDS: [(&'static str, Self); 4] = [
        ("gear", Self::Gear),
        ("every endline", Self::EveryEndline),
        ("any endline", Self::AnyEndline),
        ("every groundline", Self::EveryGroundline),
    ];

    /// Its words.
    pub fn word(self) -> &'static str {
        Self::WORDS[self as usize].0
    }
}

impl Rule {
    /// A day on which it applies: its first, or the next one in its season; `None` if there is none.
    pub fn day_in_force(&self) -> Option<Date> {
        let first = self.from.or(self.until).unwrap_or(Date::USUAL);
        let in_season = |day: &Date| self.season.is_none_or(|season| day.is_in(season));
        let in_force = |day: &Date| self.until.is_none_or(|until| *day <= until);
        std::iter::successors(Some(first), |day| Some(day.next()))
            .take(366)
            .find(|day| in_season(day) && in_force(day))
    }
}

impl RuleDraft {
    /// Reads a `[[rule]]`.
    pub(super) fn read(node: &Node, file: &Provenance, problems: &Problems) -> Self {
        let fields = Fields::of(node, problems);
        let own = provenance_over(&fields, file);
        let subject = fields.choice("subject", &Subject::WORDS);
        let subject = subject.map_or(Subject::Gear, |subject| subject.value);
        let when = fields.text("when");
        let check =
            fields.need_text("check", "write the required condition, such as \"traps >= least\"");
        let parameters = parameters(&fields, &own);
        let rule = rule(&fields, &own, subject, &check);
        fields.finish();
        let rule =
            rule.map(|rule| Rule { when: when.clone(), parameters: parameters.clone(), ..rule });
        Self { subject, when, check, parameters, rule }
    }

    /// The rule, if it is complete.
    pub(super) fn finished(self) -> Option<Rule> {
        self.rule
    }
}

/// The other fields of a rule; all keys are read before a missing one ends the function.
fn rule(
    fields: &Fields<'_>,
    own: &Provenance,
    subject: Subject,
    check: &Option<At<String>>,
) -> Option<Rule> {
    let id = fields.need_id("id", "write an id such as \"ma.strength\"");
    let asks = fields.need_text("asks", "write the requirement in a sentence");
    let cite = fields.need_text("cite", "name the law, or the page, that states it");
    let remedy = fields.need_text("remedy", "write the remedy for gear that does not comply");
    let standing =
        fields.need_choice("standing", "write law, voluntary or proposed", &Standing::WORDS);
    let (from, until) = in_force(fields);
    for (key, lacks) in [("source", own.source.is_none()), ("confidence", own.confidence.is_none())]
    {
        if lacks {
            fields.missing(key, "write the source of its wording, and the confidence");
        }
    }
    let areas = texts(fields, "areas");
    let depth_m = rising(fields, "depth", Quantity::Length, "such as depth = [\"0 m\", \"30 m\"]");
    let example = "such as distance = [\"3 nmi\", \"12 nmi\"]";
    let distance_m = rising(fields, "distance", Quantity::Length, example);
    let traps = rising(fields, "traps", Quantity::Ratio, "such as traps = [1, 5]");
    let season = season(fields);
    let notes = fields.text("notes").map(|notes| notes.value).unwrap_or_default();
    Some(Rule {
        id: id?,
        asks: asks?.value,
        cite: cite?.value,
        standing: standing?,
        source: own.source.clone()?,
        confidence: own.confidence?,
        from: from?.value,
        until,
        areas,
        depth_m,
        distance_m,
        traps,
        season,
        subject,
        when: None,
        check: check.clone()?,
        parameters: Vec::new(),
        remedy: remedy?.value,
        notes,
    })
}

/// `from` and `until`, in chronological order.
fn in_force(fields: &Fields<'_>) -> (Option<At<Option<Date>>>, Option<Date>) {
    let from = date(fields, "from", true);
    fields.require("from", "write its first day in force, such as \"2022-05-01\"");
    let until = date(fields, "until", false);
    let end = until.as_ref().and_then(|until| until.value);
    if let (Some(begin), Some(end), Some(until)) =
        (from.as_ref().and_then(|from| from.value), end, &until)
        && end < begin
    {
        let message = format!("`until` is {end}, before `from`, {begin}");
        fields.problems().push(until.place.error(message, "a rule ends after it begins"));
    }
    (from, end)
}

/// `season`: first and last day of the year.
fn season(fields: &Fields<'_>) -> Option<[u16; 2]> {
    let days = fields.values("season", Quantity::Ratio, &[2])?;
    let whole = |day: &f64| day.fract() == 0.0 && (1.0..=366.0).contains(day);
    if !days.value.iter().all(whole) {
        let help = "write two days of the year from 1 to 366, such as season = [32, 120]";
        return fields
            .refuse(days.place.error("`season` does not consist of days of the year", help));
    }
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "checked above")]
    let day = |at: usize| days.value[at] as u16;
    Some([day(0), day(1)])
}

/// A number of a rule.
#[derive(Clone, Debug)]
pub struct Parameter {
    /// The name by which expressions use it.
    pub key: String,
    /// Place of its name.
    pub place: Place,
    /// Value [SI].
    pub value: f64,
    /// Physical quantity.
    pub quantity: Quantity,
    /// Unit in the rule; `None` for a pure number.
    pub unit: Option<&'static Unit>,
    /// As written, such as `1,700 lbf`.
    pub text: String,
    /// Source.
    pub source: String,
    /// Confidence.
    pub confidence: Confidence,
}

/// Reads `[rule.parameters]`: a figure by each name.
pub(super) fn parameters(rule: &Fields<'_>, file: &Provenance) -> Vec<Parameter> {
    let Some(table) = rule.table("parameters") else { return Vec::new() };
    table.rest().into_iter().filter_map(|entry| parameter(rule, entry, file)).collect()
}

fn parameter(
    rule: &Fields<'_>,
    (key, place, node): &(String, Place, Node),
    file: &Provenance,
) -> Option<Parameter> {
    let (quantity, unit) = measured_in(node);
    let figure = read_figure(node, quantity, Range::Any, file, rule.problems())?;
    Some(Parameter {
        key: key.clone(),
        place: place.clone(),
        value: figure.value,
        quantity,
        unit,
        text: figure.text,
        source: figure.source,
        confidence: figure.confidence,
    })
}

/// Quantity and unit of a figure, from its unit; a length for an unknown unit.
fn measured_in(node: &Node) -> (Quantity, Option<&'static Unit>) {
    let value = match &node.content {
        Content::Table(entries) => entries.iter().find(|(key, ..)| key == "value"),
        _ => None,
    };
    let Content::Text(text) = &value.map_or(node, |(_, _, value)| value).content else {
        return (Quantity::Ratio, None);
    };
    let is_number = |letter: char| letter.is_ascii_digit() || " .,/+-".contains(letter);
    let unit = text.trim_start_matches(is_number).trim();
    let found = Quantity::ALL
        .iter()
        .copied()
        .find_map(|quantity| units::find(unit, quantity).map(|unit| (quantity, Some(unit))));
    found.unwrap_or((Quantity::Length, None))
}
