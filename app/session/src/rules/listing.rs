//! The rules and areas of packs as one JSON object.

use endline_gear::{Area, Date, Parameter, Rule, RulePack};
use serde::Serialize;

use super::packs::Packs;

/// Name and version of the JSON.
const SCHEMA: &str = "endline.rules.list/1";

#[derive(Serialize)]
struct Listing<'a> {
    schema: &'static str,
    packs: Vec<Pack<'a>>,
}

#[derive(Serialize)]
struct Pack<'a> {
    id: &'a str,
    name: &'a str,
    jurisdiction: &'a str,
    notes: &'a str,
    areas: Vec<AreaOf<'a>>,
    rules: Vec<RuleOf<'a>>,
}

#[derive(Serialize)]
struct AreaOf<'a> {
    area: &'a str,
    name: &'a str,
    within: Option<&'a str>,
}

/// A rule as its pack has it; lengths in metres.
#[derive(Serialize)]
struct RuleOf<'a> {
    rule: &'a str,
    asks: &'a str,
    cite: &'a str,
    source: &'a str,
    standing: &'static str,
    binding: bool,
    confidence: &'static str,
    from: Option<String>,
    until: Option<String>,
    areas: Vec<&'a str>,
    distance_m: Option<[f64; 2]>,
    depth_m: Option<[f64; 2]>,
    traps: Option<[f64; 2]>,
    season: Option<[u16; 2]>,
    subject: &'static str,
    when: Option<&'a str>,
    check: &'a str,
    parameters: Vec<ParameterOf<'a>>,
    mend: &'a str,
    notes: &'a str,
}

/// A number of a rule: as its pack has it, and in SI units.
#[derive(Serialize)]
struct ParameterOf<'a> {
    parameter: &'a str,
    text: &'a str,
    value: f64,
    unit: &'static str,
    source: &'a str,
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
