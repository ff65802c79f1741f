//! One rule on one assembly: whether it applies, the measured values, the verdict.

use endline_gear::units::{self, Quantity, find, format_si};
use endline_gear::{At, Diagnostic, Rule, RulePack, Subject};
use schemars::JsonSchema;
use serde::Serialize;

use super::facts::{Part, needs, of_subject, value};
use super::gear::Gear;
use super::packs::expression;
use super::sheet::Fishing;
use super::value::{Compared, Value};

/// The verdict of a rule on an assembly.
#[derive(Clone, Copy, Debug, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Verdict {
    /// The gear meets it.
    Pass,
    /// The gear does not meet it.
    Fail,
    /// It does not apply here, now or to this gear.
    NotApplicable,
    /// It applies, and the assembly or the call does not say enough.
    CannotBeChecked,
}

/// The verdict on a rule.
#[derive(Clone, Debug, JsonSchema, Serialize)]
pub struct RuleResult {
    /// Id of the pack.
    pub pack: String,
    /// Whose rule it is.
    pub jurisdiction: String,
    /// Id of the rule.
    pub rule: String,
    /// The requirement in words.
    pub asks: String,
    /// The law, or the page, that states it.
    pub cite: String,
    /// `law`, `voluntary` or `proposed`.
    pub standing: &'static str,
    /// How sure its wording is.
    pub confidence: &'static str,
    /// Whether people are bound to it: it is law. A rule that does not bind is advice.
    pub binding: bool,
    /// Where its wording was read.
    pub source: String,
    /// First day in force; none where it is unknown.
    pub from: Option<String>,
    /// Last day in force, where it has one.
    pub until: Option<String>,
    /// The verdict.
    pub verdict: Verdict,
    /// Why it does not apply or cannot be checked; empty otherwise.
    pub why: String,
    /// The measured values, beside the limits.
    pub measured: Vec<Measured>,
    /// How to make gear that fails meet it; empty otherwise.
    pub remedy: String,
}

/// A measured value beside its limit.
#[derive(Clone, Debug, JsonSchema, Serialize)]
pub struct Measured {
    /// The piece or line it was measured on; empty for the gear as a whole.
    pub part: String,
    /// The line that the rule was checked on; empty for the gear as a whole.
    #[serde(skip)]
    pub line: String,
    /// The comparison in words, such as `57 ft; at most 60 ft allowed`.
    pub says: String,
    /// The measured value in SI units; none where there is none.
    pub value: Option<f64>,
    /// The sign between both.
    pub sign: &'static str,
    /// The limit in SI units.
    pub limit: Option<f64>,
    /// Their SI unit.
    pub unit: &'static str,
    /// Whether it holds.
    pub holds: bool,
}

/// A verdict on one part.
struct Found {
    verdict: Verdict,
    why: String,
    measured: Vec<Measured>,
}

impl Verdict {
    /// In words, for tables.
    pub fn words(self) -> &'static str {
        match self {
            Self::Pass => "pass",
            Self::Fail => "fail",
            Self::NotApplicable => "not applicable",
            Self::CannotBeChecked => "cannot be checked",
        }
    }
}

impl Found {
    fn because(verdict: Verdict, why: impl Into<String>) -> Self {
        Self { verdict, why: why.into(), measured: Vec::new() }
    }
}

/// The verdict of a rule on gear.
pub(super) fn of(
    (pack, rule): (&RulePack, &Rule),
    gear: &Gear,
    fishing: &Fishing,
    around: &[&str],
) -> Result<RuleResult, Vec<Diagnostic>> {
    let applies = applies(rule, gear, fishing, around);
    let found = match applies {
        Some(found) if found.verdict == Verdict::NotApplicable => found,
        doubt => {
            let checked = parts(rule, gear, fishing)?;
            match doubt {
                Some(doubt) if checked.verdict != Verdict::NotApplicable => doubt,
                _ => checked,
            }
        }
    };
    let fails = found.verdict == Verdict::Fail;
    Ok(RuleResult {
        pack: pack.id.clone(),
        jurisdiction: pack.jurisdiction.clone(),
        rule: rule.id.value.clone(),
        asks: rule.asks.clone(),
        cite: rule.cite.clone(),
        standing: rule.standing.word(),
        confidence: rule.confidence.word(),
        binding: rule.standing.binds(),
        source: rule.source.clone(),
        from: rule.from.map(|day| day.to_string()),
        until: rule.until.map(|day| day.to_string()),
        verdict: found.verdict,
        why: found.why,
        measured: found.measured,
        remedy: if fails { rule.remedy.clone() } else { String::new() },
    })
}

/// Why a rule does not apply, or why that is unknown; `None` where it applies.
fn applies(rule: &Rule, gear: &Gear, fishing: &Fishing, around: &[&str]) -> Option<Found> {
    let not = |why: String| Some(Found::because(Verdict::NotApplicable, why));
    if let Some(from) = rule.from.filter(|from| fishing.on < *from) {
        return not(format!("in force from {from}"));
    }
    if let Some(until) = rule.until.filter(|until| *until < fishing.on) {
        return not(format!("in force until {until}"));
    }
    if !rule.areas.is_empty() && !rule.areas.iter().any(|area| around.contains(&&*area.value)) {
        return not(format!("applies in {}", list(&rule.areas)));
    }
    if let Some([first, last]) = rule.season.filter(|season| !fishing.on.is_in(*season)) {
        return not(format!("applies from day {first} to day {last} of the year"));
    }
    #[expect(clippy::cast_precision_loss, reason = "a count of traps")]
    let traps = fishing.traps.map_or(gear.traps as f64, f64::from);
    if let Some([least, most]) = rule.traps.filter(|[least, most]| traps < *least || traps > *most)
    {
        return not(format!("applies to {least} to {most} traps, not {traps}"));
    }
    within(("distance", "nmi"), rule.distance_m, fishing.distance_m)
        .or_else(|| within(("depth", "ft"), rule.depth_m, fishing.depth_m))
}

fn list(areas: &[At<String>]) -> String {
    areas.iter().map(|area| area.value.as_str()).collect::<Vec<_>>().join(", ")
}

/// Why a range keeps a rule from applying, or leaves it in doubt; `unit` is that of the range in messages.
fn within(
    (name, unit): (&str, &str),
    range: Option<[f64; 2]>,
    given: Option<f64>,
) -> Option<Found> {
    let [least, most] = range?;
    let Some(value) = given else {
        return Some(Found::because(Verdict::CannotBeChecked, needs(name)));
    };
    let unit = find(unit, Quantity::Length);
    let length = |length_m| {
        unit.map_or_else(
            || format_si(length_m, Quantity::Length),
            |unit| units::format(length_m, unit),
        )
    };
    let why = || {
        if most.is_finite() {
            format!("applies at a {name} from {} to {}", length(least), length(most))
        } else {
            format!("applies at a {name} of {} and more", length(least))
        }
    };
    (!(least..most).contains(&value)).then(|| Found::because(Verdict::NotApplicable, why()))
}

/// Checks every part of the gear that the rule is about.
fn parts(rule: &Rule, gear: &Gear, fishing: &Fishing) -> Result<Found, Vec<Diagnostic>> {
    let parts: Vec<Part<'_>> = match rule.subject {
        Subject::Gear => vec![Part::Gear],
        Subject::EveryEndline | Subject::AnyEndline => {
            gear.endlines.iter().map(Part::Endline).collect()
        }
        Subject::EveryGroundline => gear.groundlines.iter().map(Part::Groundline).collect(),
    };
    let found = parts.into_iter().map(|part| one(rule, gear, part, fishing));
    let found = found.collect::<Result<Vec<Found>, _>>()?;
    Ok(joined(found, rule.subject))
}

/// The verdict on all parts: the worst, or the best where one of them is enough.
fn joined(found: Vec<Found>, subject: Subject) -> Found {
    let order = if subject == Subject::AnyEndline {
        [Verdict::Pass, Verdict::CannotBeChecked, Verdict::Fail, Verdict::NotApplicable]
    } else {
        [Verdict::Fail, Verdict::CannotBeChecked, Verdict::Pass, Verdict::NotApplicable]
    };
    let verdict = order.into_iter().find(|order| found.iter().any(|one| one.verdict == *order));
    let Some(verdict) = verdict else {
        let what = if subject == Subject::EveryGroundline { "groundline" } else { "endline" };
        return Found::because(Verdict::NotApplicable, format!("the gear has no {what}"));
    };
    let of_verdict: Vec<Found> = found.into_iter().filter(|one| one.verdict == verdict).collect();
    let why = of_verdict.first().map(|one| one.why.clone()).unwrap_or_default();
    Found { verdict, why, measured: of_verdict.into_iter().flat_map(|one| one.measured).collect() }
}

/// Condition and check on one part.
fn one(
    rule: &Rule,
    gear: &Gear,
    part: Part<'_>,
    fishing: &Fishing,
) -> Result<Found, Vec<Diagnostic>> {
    let of = |name: &str| {
        let parameter = rule.parameters.iter().find(|parameter| parameter.key == name);
        let fact = of_subject(rule.subject).find(|fact| fact.name == name);
        parameter
            .map(|one| Value::Number {
                si: one.value,
                quantity: one.quantity,
                unit: one.unit,
                of: None,
            })
            .or_else(|| fact.map(|fact| value(fact, gear, part, fishing)))
    };
    if let Some(when) = &rule.when {
        match expression(rule, when)?.value(&of) {
            Value::Truth { holds: true, .. } => {}
            Value::Truth { .. } => {
                let why = format!("applies where {}", when.value);
                return Ok(Found::because(Verdict::NotApplicable, why));
            }
            other => return Ok(in_doubt(other)),
        }
    }
    Ok(match expression(rule, &rule.check)?.value(&of) {
        Value::Truth { holds, compared } => Found {
            verdict: if holds { Verdict::Pass } else { Verdict::Fail },
            why: String::new(),
            measured: compared.iter().map(|compared| measured(part, compared)).collect(),
        },
        other => in_doubt(other),
    })
}

fn in_doubt(value: Value) -> Found {
    match value {
        Value::Unknown { why, .. } | Value::Wrong(why) => {
            Found::because(Verdict::CannotBeChecked, why)
        }
        other => {
            Found::because(Verdict::CannotBeChecked, format!("the check gives {}", other.noun()))
        }
    }
}

fn measured(part: Part<'_>, compared: &Compared) -> Measured {
    let finite = |number: f64| number.is_finite().then_some(number);
    Measured {
        part: compared.of.clone().unwrap_or_else(|| part.name()),
        line: part.id().to_owned(),
        says: compared.to_string(),
        value: finite(compared.left),
        sign: compared.sign,
        limit: finite(compared.right),
        unit: compared.quantity.si_unit(),
        holds: compared.holds,
    }
}
