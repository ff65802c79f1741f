//! The packs of a library, with their areas, and as JSON.

use std::path::{Path, PathBuf};

use endline_gear::{Area, At, Date, Diagnostic, Parameter, Rule, RuleDraft, RulePack, hint};
use schemars::JsonSchema;
use serde::Serialize;

use super::expression::{Expression, Names, begins_with_function};
use super::facts::of_subject;
use super::value::Kind;
use crate::error::Error;
use crate::{json, locate};

/// Folder of the packs in a library.
const FOLDER: &str = "rules";

/// Packs of rules, which may name each other's areas.
#[derive(Clone, Debug, Default)]
pub struct Packs {
    /// The packs, by file.
    pub packs: Vec<RulePack>,
}

impl Packs {
    /// Reads the packs of a library, found as [`locate::library`] says where `library` is `None`, and others beside it.
    pub fn open(library: Option<&Path>, others: &[PathBuf]) -> Result<Self, Error> {
        let root = locate::library(None, library).map_err(Error::Message)?;
        let mut files = locate::toml_files(&root.join(FOLDER));
        files.extend(others.iter().cloned());
        Self::read(&files)
    }

    /// Reads one pack alone, beside those of the library whose areas it may name.
    pub fn check(file: &Path, library: Option<&Path>) -> Result<(), Error> {
        let own = read(file)?;
        let root = locate::library(Some(file), library);
        let files = root.map(|root| locate::toml_files(&root.join(FOLDER))).unwrap_or_default();
        let others = files.iter().filter(|other| !is_same(other, file));
        let mut all = Self { packs: others.filter_map(|other| read(other).ok()).collect() };
        all.packs.push(own);
        let name = file.display().to_string();
        let problems = all.mistakes().into_iter().filter(|problem| problem.file == name);
        refuse(problems.collect())
    }

    fn read(files: &[PathBuf]) -> Result<Self, Error> {
        let (mut all, mut problems) = (Self::default(), Vec::new());
        for file in files {
            match read(file) {
                Ok(pack) => all.packs.push(pack),
                Err(Error::Diagnostics(more)) => problems.extend(more),
                Err(other) => return Err(other),
            }
        }
        if problems.is_empty() {
            problems = all.mistakes();
        }
        refuse(problems).map(|()| all)
    }

    /// Every rule with its pack, in order.
    pub fn rules(&self) -> impl Iterator<Item = (&RulePack, &Rule)> {
        self.packs.iter().flat_map(|pack| pack.rules.iter().map(move |rule| (pack, rule)))
    }

    /// Every area.
    pub fn areas(&self) -> impl Iterator<Item = &Area> {
        self.packs.iter().flat_map(|pack| &pack.areas)
    }

    /// The name of an area, or its id where no pack declares it.
    pub fn area_name(&self, id: &str) -> String {
        let named = self.areas().find(|area| area.id.value == id);
        named.map_or_else(|| id.to_owned(), |area| area.name.clone())
    }

    /// Id of the area in which a site of the library lies; `None` if no pack names the site.
    pub fn area_of_site(&self, site: &str) -> Option<&str> {
        let area = self.areas().find(|area| area.sites.iter().any(|own| own.value == site))?;
        Some(&area.id.value)
    }

    /// An area and those that contain it, from the inside out.
    pub fn around(&self, area: &str) -> Result<Vec<&str>, String> {
        let find = |id: &str| self.areas().find(|area| area.id.value == id);
        let mut around = Vec::new();
        let mut at = Some(find(area).ok_or_else(|| {
            let known = self.areas().map(|area| area.id.value.as_str());
            format!("there is no area `{area}`; {}", hint(area, known))
        })?);
        while let Some(area) = at {
            // A circle of areas ends where it began.
            if around.contains(&area.id.value.as_str()) {
                break;
            }
            around.push(area.id.value.as_str());
            at = area.within.as_ref().and_then(|within| find(&within.value));
        }
        Ok(around)
    }

    /// Names of areas that no pack declares, and ids given by two packs.
    fn mistakes(&self) -> Vec<Diagnostic> {
        let known: Vec<&str> = self.areas().map(|area| area.id.value.as_str()).collect();
        let of_rules = self.rules().flat_map(|(_, rule)| &rule.areas);
        let named = self.areas().filter_map(|area| area.within.as_ref()).chain(of_rules);
        let unknown = named.filter(|area| !known.contains(&area.value.as_str()));
        let mut problems: Vec<Diagnostic> = unknown
            .map(|area| {
                let message = format!("no pack declares the area `{}`", area.value);
                area.place.error(message, hint(&area.value, known.iter().copied()))
            })
            .collect();
        problems.extend(twice(self.areas().map(|area| &area.id)));
        problems.extend(twice(self.rules().map(|(_, rule)| &rule.id)));
        problems
    }
}

fn refuse(problems: Vec<Diagnostic>) -> Result<(), Error> {
    if problems.is_empty() { Ok(()) } else { Err(Error::Diagnostics(problems)) }
}

fn is_same(one: &Path, other: &Path) -> bool {
    one == other
        || one.canonicalize().ok().is_some_and(|one| other.canonicalize().ok() == Some(one))
}

fn read(file: &Path) -> Result<RulePack, Error> {
    let text = endline_gear::read::text(file).map_err(Error::on(file, "cannot be read"))?;
    read_text(&file.display().to_string(), &text).map_err(Error::Diagnostics)
}

/// Reads a pack's text with its expressions.
pub fn read_text(name: &str, text: &str) -> Result<RulePack, Vec<Diagnostic>> {
    RulePack::read(name, text, &mistakes_of)
}

/// Problems of the expressions of a rule and the names of its parameters.
fn mistakes_of(draft: &RuleDraft) -> Vec<Diagnostic> {
    let facts: Vec<&str> = of_subject(draft.subject).map(|fact| fact.name).collect();
    let mut problems = Vec::new();
    for parameter in &draft.parameters {
        let key = parameter.key.as_str();
        let why = match begins_with_function(key) {
            Some(function) => {
                Some(format!("`{key}` begins with the name of the function `{function}`"))
            }
            None if facts.contains(&key) => Some(format!("`{key}` is the name of a fact")),
            None => None,
        };
        problems
            .extend(why.map(|why| parameter.place.error(why, "give the parameter another name")));
    }
    let names = names(draft);
    for text in draft.when.iter().chain(&draft.check) {
        problems.extend(Expression::read(text, &names).err().into_iter().flatten());
    }
    problems
}

fn names(draft: &RuleDraft) -> Names {
    let facts = of_subject(draft.subject).map(|fact| (fact.name.to_owned(), fact.kind));
    let parameters = draft.parameters.iter();
    facts.chain(parameters.map(|one| (one.key.clone(), Kind::Number(one.quantity)))).collect()
}

/// An expression of a rule that was read before.
pub(super) fn expression(rule: &Rule, text: &At<String>) -> Result<Expression, Vec<Diagnostic>> {
    let facts = of_subject(rule.subject).map(|fact| (fact.name.to_owned(), fact.kind));
    let parameters = rule.parameters.iter();
    let names = facts.chain(parameters.map(|one| (one.key.clone(), Kind::Number(one.quantity))));
    Expression::read(text, &names.collect())
}

/// Ids that are given a second time.
fn twice<'a>(ids: impl Iterator<Item = &'a At<String>>) -> Vec<Diagnostic> {
    let (mut seen, mut problems) = (Vec::<&str>::new(), Vec::new());
    for id in ids {
        if seen.contains(&id.value.as_str()) {
            let message = format!("`{}` is given by another pack too", id.value);
            problems.push(id.place.error(message, "give each id once"));
        }
        seen.push(&id.value);
    }
    problems
}

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
    /// The requirement in words.
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
    /// The part of the gear that it checks.
    subject: &'static str,
    /// Expression that decides to which of these it applies; null for all.
    when: Option<&'a str>,
    /// Expression that holds where the rule is kept.
    check: &'a str,
    /// Numbers of the expressions.
    parameters: Vec<ParameterOf<'a>>,
    /// How to make gear meet the rule, in words.
    remedy: &'a str,
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
    pub fn json(&self) -> String {
        let listing = Listing { schema: SCHEMA, packs: self.packs.iter().map(pack).collect() };
        json::indented(&listing)
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
        remedy: &rule.remedy,
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
