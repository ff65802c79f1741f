//! The rules and areas of packs as one JSON object.

use endline_gear::{Area, Date, Parameter, Rule, RulePack};
use schemars::JsonSchema;
use serde::Serialize;

use super::packs::Packs;

/// Name and version of the JSON.
const SCHEMA: &str = "endline.rules.list/1";

/// All packs.
#[derive(JsonSchema, Serialize)]
pub(crate) struct Listing<'a> {
    /// Name and version of this form.
    #[schemars(extend("const" = SCHEMA))]
    schema: &'static str,
    /// The packs, in order of id.
    packs: Vec<Pack<'a>>,
}

/// A rule pack.
#[derive(JsonSchema, Serialize)]
struct Pack<'a> {
    /// Id.
    id: &'a str,
    /// Name.
    name: &'a str,
    /// Whose rules they are.
    jurisdiction: &'a str,
    /// Notes.
    notes: &'a str,
    /// Its areas.
    areas: Vec<AreaOf<'a>>,
    /// Its rules.
    rules: Vec<RuleOf<'a>>,
}

/// An area of which rules speak.
#[derive(JsonSchema, Serialize)]
struct AreaOf<'a> {
    /// Id.
    area: &'a str,
    /// Name.
    name: &'a str,
    /// Area that it lies in; null where none holds it.
    within: Option<&'a str>,
}

/// A rule as its pack has it; lengths in metres.
#[derive(JsonSchema, Serialize)]
struct RuleOf<'a> {
    /// Id.
    rule: &'a str,
    /// What it asks, in words.
    asks: &'a str,
    /// Citation.
    cite: &'a str,
    /// Source.
    source: &'a str,
    /// Whether it binds, is voluntary or was replaced, in a word.
    standing: &'static str,
    /// Whether it binds.
    binding: bool,
    /// How sure it is.
    confidence: &'static str,
    /// First day in force.
    from: Option<String>,
    /// Last day in force; null where it still is.
    until: Option<String>,
    /// Areas in which it applies; empty for all.
    areas: Vec<&'a str>,
    /// Least and greatest distance from shore at which it applies [m].
    distance_m: Option<[f64; 2]>,
    /// Least and greatest depth at which it applies [m].
    depth_m: Option<[f64; 2]>,
    /// Fewest and most traps of the gear to which it applies.
    traps: Option<[f64; 2]>,
    /// First and last day of the year on which it applies.
    season: Option<[u16; 2]>,
    /// What of the gear it looks at.
    subject: &'static str,
    /// Expression that tells to which of these it applies; null for all.
    when: Option<&'a str>,
    /// Expression that holds where the rule is kept.
    check: &'a str,
    /// Numbers of the expressions.
    parameters: Vec<ParameterOf<'a>>,
    /// How gear comes to meet the rule, in words.
    mend: &'a str,
    /// Notes.
    notes: &'a str,
}

/// A number of a rule: as its pack has it, and in SI units.
#[derive(JsonSchema, Serialize)]
struct ParameterOf<'a> {
    /// Its name in the expressions.
    parameter: &'a str,
    /// As the pack has it.
    text: &'a str,
    /// In its SI unit.
    value: f64,
    /// SI unit; empty for a number without one.
    unit: &'static str,
    /// Source.
    source: &'a str,
    /// How sure it is.
    confidence: &'static str,
}

impl Packs {
    /// Every pack with its areas and rules, as one JSON object.
    #[must_use]
    pub fn json(&self) -> String {
        let listing = Listing { schema: SCHEMA, packs: self.packs.iter().map(pack).collect() };
        // Strings and finite numbers always become JSON.
        serde_json::to_string_pretty(&listing).unwrap_or_default()
    }
}

fn pack(pack: &RulePack) -> Pack<'_> {
    Pack {
        id: &pack.id,
        name: &pack.name,
        jurisdiction: &pack.jurisdiction,
        notes: &pack.notes,
        areas: pack.areas.iter().map(area).collect(),
        rules: pack.rules.iter().map(rule).collect(),
    }
}

fn area(area: &Area) -> AreaOf<'_> {
    let within = area.within.as_ref().map(|within| within.value.as_str());
    AreaOf { area: &area.id.value, name: &area.name, within }
}

fn rule(rule: &Rule) -> RuleOf<'_> {
    let day = |date: Option<Date>| date.map(|date| date.to_string());
    RuleOf {
        rule: &rule.id.value,
        asks: &rule.asks,
        cite: &rule.cite,
        source: &rule.source,
        standing: rule.standing.word(),
        binding: rule.standing.binds(),
        confidence: rule.confidence.word(),
        from: day(rule.from),
        until: day(rule.until),
        areas: rule.areas.iter().map(|area| area.value.as_str()).collect(),
        distance_m: rule.distance_m,
        depth_m: rule.depth_m,
        traps: rule.traps,
        season: rule.season,
        subject: rule.subject.word(),
        when: rule.when.as_ref().map(|when| when.value.as_str()),
        check: &rule.check.value,
        parameters: rule.parameters.iter().map(parameter).collect(),
        mend: &rule.mend,
        notes: &rule.notes,
    }
}

fn parameter(parameter: &Parameter) -> ParameterOf<'_> {
    ParameterOf {
        parameter: &parameter.key,
        text: &parameter.text,
        value: parameter.value,
        unit: parameter.quantity.si_unit(),
        source: &parameter.source,
        confidence: parameter.confidence.word(),
    }
}
