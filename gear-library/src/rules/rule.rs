//! One rule of a pack.

use crate::confidence::Confidence;
use crate::diagnostic::At;
use crate::fields::{Fields, Problems, Provenance, provenance_over, rising};
use crate::study::texts;
use crate::tree::Node;
use crate::units::Quantity;

use super::date::{Date, date};
use super::parameter::{Parameter, parameters};

/// What binds people to a rule.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Standing {
    /// It is, or was, in force by law.
    Law,
    /// People follow it, or are advised to, without being bound.
    Voluntary,
    /// It is proposed.
    Proposed,
}

/// What a rule is checked on.
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
    /// What it asks for, in a sentence.
    pub asks: String,
    /// The law, or the page, that says so.
    pub cite: String,
    /// What binds people to it.
    pub standing: Standing,
    /// Where the wording behind it was read.
    pub source: String,
    /// How sure its wording is: measured where the source named was read, derived from a summary, else an estimate.
    pub confidence: Confidence,
    /// First day in force; `None` where nobody looked it up.
    pub from: Option<Date>,
    /// Last day in force, where it has one.
    pub until: Option<Date>,
    /// Areas where it applies; everywhere where none is named.
    pub areas: Vec<At<String>>,
    /// Depths where it applies, the second left out [m].
    pub depth_m: Option<[f64; 2]>,
    /// Distances from shore where it applies, the second left out [m].
    pub distance_m: Option<[f64; 2]>,
    /// Numbers of traps to which it applies.
    pub traps: Option<[f64; 2]>,
    /// First and last day of the year on which it applies; from autumn to spring where the first is the later.
    pub season: Option<[u16; 2]>,
    /// What it is checked on.
    pub subject: Subject,
    /// The condition under which it applies besides.
    pub when: Option<At<String>>,
    /// What must hold.
    pub check: At<String>,
    /// Its numbers.
    pub parameters: Vec<Parameter>,
    /// How to mend gear that fails.
    pub mend: String,
    /// Remarks; may be empty.
    pub notes: String,
}

/// A rule being read: what could be read of its expressions, and the rule where nothing is missing.
#[derive(Clone, Debug)]
pub struct RuleDraft {
    /// What it is checked on.
    pub subject: Subject,
    /// The condition under which it applies.
    pub when: Option<At<String>>,
    /// What must hold.
    pub check: Option<At<String>>,
    /// Its numbers.
    pub parameters: Vec<Parameter>,
    rule: Option<Rule>,
}

impl Standing {
    /// The words a file uses.
    pub const WORDS: [&'static str; 3] = ["law", "voluntary", "proposed"];

    /// Whether people are bound to follow it; a rule that does not bind is advice.
    #[must_use]
    pub fn binds(self) -> bool {
        self == Self::Law
    }

    /// Its word.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Law => "law",
            Self::Voluntary => "voluntary",
            Self::Proposed => "proposed",
        }
    }
}

impl Subject {
    /// The words a file uses, in the order of the variants.
    pub const WORDS: [&'static str; 4] =
        ["gear", "every endline", "any endline", "every groundline"];

    /// Its words.
    #[must_use]
    pub fn word(self) -> &'static str {
        Self::WORDS[self as usize]
    }

    fn named(word: &str) -> Self {
        match word {
            "every endline" => Self::EveryEndline,
            "any endline" => Self::AnyEndline,
            "every groundline" => Self::EveryGroundline,
            _ => Self::Gear,
        }
    }
}

impl Rule {
    /// A day on which it applies: its first, or a later one in its season; `None` where there is none.
    #[must_use]
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
        let subject = fields.word("subject", &Subject::WORDS);
        let subject = subject.map_or(Subject::Gear, |word| Subject::named(&word.value));
        let when = fields.text("when");
        let check = fields.need_text("check", "write what must hold, such as \"traps >= least\"");
        let parameters = parameters(&fields, &own);
        let rule = rule(&fields, &own, subject, &check);
        fields.finish();
        let rule =
            rule.map(|rule| Rule { when: when.clone(), parameters: parameters.clone(), ..rule });
        Self { subject, when, check, parameters, rule }
    }

    /// The rule, where nothing that it needs is missing.
    pub(super) fn finished(self) -> Option<Rule> {
        self.rule
    }
}

/// The rest of a rule; every key is read before one that is missing ends it.
fn rule(
    fields: &Fields<'_>,
    own: &Provenance,
    subject: Subject,
    check: &Option<At<String>>,
) -> Option<Rule> {
    let id = fields.need_id("id", "write an id such as \"ma.strength\"");
    let asks = fields.need_text("asks", "say in a sentence what it asks for");
    let cite = fields.need_text("cite", "name the law, or the page, that says so");
    let mend = fields.need_text("mend", "say in a sentence how to mend gear that fails");
    let standing = fields.need_text("standing", "write law, voluntary or proposed");
    let standing = standing.and_then(|_| fields.word("standing", &Standing::WORDS));
    let (from, until) = in_force(fields);
    for (key, lacks) in [("source", own.source.is_none()), ("confidence", own.confidence.is_none())]
    {
        if lacks {
            fields.missing(key, "say where its wording was read, and how sure it is");
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
        standing: match standing?.value.as_str() {
            "law" => Standing::Law,
            "voluntary" => Standing::Voluntary,
            _ => Standing::Proposed,
        },
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
        mend: mend?.value,
        notes,
    })
}

/// `from` and `until`, in this order in time.
fn in_force(fields: &Fields<'_>) -> (Option<At<Option<Date>>>, Option<Date>) {
    let from = date(fields, "from", true);
    if fields.get("from").is_none() {
        fields.missing("from", "write its first day in force, such as \"2022-05-01\"");
    }
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
        fields.problems().push(days.place.error("`season` has no days of a year", help));
        return None;
    }
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "checked above")]
    let day = |at: usize| days.value[at] as u16;
    Some([day(0), day(1)])
}
