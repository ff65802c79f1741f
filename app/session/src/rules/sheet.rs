//! An assembly, where and when it is fished, with the verdict on every rule.

use std::path::Path;

use endline_gear::{Assembled, Date, Library, Options, Rule, Scenario, Setting, assemble_traced};
use schemars::JsonSchema;
use serde::Serialize;

use super::facts::{NETTING, needed};
use super::gear::{Gear, gear_of};
use super::packs::Packs;
use super::verdict::{RuleResult, Verdict, of};
use crate::error::Error;
use crate::plugins::PluginHost;
use crate::source::{AssemblyFile, written};

/// Depth in which gear is assembled where none is given: that of the shipped inshore gear [m].
const USUAL_DEPTH_M: f64 = 25.0;

/// Gear assembled for rules.
#[derive(Clone, Debug)]
pub struct RuleGear {
    /// Id of the assembly.
    pub assembly: String,
    /// Depth in which it was assembled [m].
    pub depth_m: f64,
    pub(super) gear: Gear,
}

/// Name and version of the JSON of a sheet.
const SCHEMA: &str = "endline.rules.check/1";

/// The verdict on every rule.
#[derive(Clone, Debug, JsonSchema, Serialize)]
pub struct RuleSheet {
    /// Name and version of this form.
    #[schemars(extend("const" = SCHEMA))]
    pub schema: &'static str,
    /// Id of the assembly.
    pub assembly: String,
    /// Id of the area.
    pub area: String,
    /// The day.
    pub on: String,
    /// Depth in which the gear was assembled [m].
    pub depth_m: f64,
    /// Whether that depth was taken because none was given.
    pub depth_is_usual: bool,
    /// Distance from shore, where it was given [m].
    pub distance_m: Option<f64>,
    /// Traps on one set: those given, else those counted.
    pub traps: usize,
    /// What no rule of the packs is about, in sentences, so that passes of other rules are not read as compliance.
    pub uncovered: Vec<String>,
    /// Number of rules with each verdict.
    pub counts: Counts,
    /// Every rule with its verdict, by pack.
    pub rules: Vec<RuleResult>,
}

/// The make-up of an endline.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EndlineMakeUp {
    /// Diameter of the rope at its top [m].
    pub diameter_m: f64,
    /// Strength of its strongest new rope, as its source states it [N].
    pub rated_n: f64,
    /// Whether it has weak links or weak places between its ends.
    pub has_sleeves: bool,
}

impl RuleGear {
    /// Traps of the gear.
    pub fn traps(&self) -> usize {
        self.gear.traps
    }

    /// Its first endline; none of gear without one.
    pub fn endline(&self) -> Option<EndlineMakeUp> {
        let pieces = &self.gear.endlines.first()?.pieces;
        let ropes = || pieces.iter().filter(|piece| piece.length_m > 0.0);
        Some(EndlineMakeUp {
            diameter_m: ropes().next()?.diameter_m,
            rated_n: ropes().map(|piece| piece.rated_n).fold(0.0, f64::max),
            has_sleeves: ropes().count() < pieces.len(),
        })
    }
}

/// Number of rules with each verdict.
#[derive(Clone, Copy, Debug, Default, Eq, JsonSchema, PartialEq, Serialize)]
pub struct Counts {
    /// Rules that the gear meets.
    pub pass: usize,
    /// Rules that it does not meet.
    pub fail: usize,
    /// Those of them that bind.
    pub fail_binding: usize,
    /// Rules that do not apply.
    pub not_applicable: usize,
    /// Rules that cannot be checked.
    pub cannot_be_checked: usize,
}

impl Counts {
    fn of(rules: &[RuleResult]) -> Self {
        let mut counts = Self::default();
        for rule in rules {
            match rule.verdict {
                Verdict::Pass => counts.pass += 1,
                Verdict::Fail => {
                    counts.fail += 1;
                    counts.fail_binding += usize::from(rule.binding);
                }
                Verdict::NotApplicable => counts.not_applicable += 1,
                Verdict::CannotBeChecked => counts.cannot_be_checked += 1,
            }
        }
        counts
    }
}

impl RuleSheet {
    /// Whether the gear fails a rule that binds; one that it is only advised to follow does not count.
    pub fn fails_binding(&self) -> bool {
        self.counts.fail_binding > 0
    }

    /// What is missing for verdicts on rules that bind; `None` if all of them were checked.
    pub fn missing(&self) -> Option<String> {
        let open: Vec<&RuleResult> =
            self.with(Verdict::CannotBeChecked).filter(|rule| rule.binding).collect();
        let (by_place, by_gear): (Vec<&RuleResult>, Vec<&RuleResult>) =
            open.into_iter().partition(|rule| needed(&rule.why).next().is_some());
        let mut names: Vec<&str> = by_place.iter().flat_map(|rule| needed(&rule.why)).collect();
        names.sort_unstable();
        names.dedup();
        let counted = |count: usize| match count {
            1 => "1 needs".to_owned(),
            count => format!("{count} need"),
        };
        let place = (!by_place.is_empty())
            .then(|| format!("{} {}", counted(by_place.len()), names.join(" or ")));
        let gear = (!by_gear.is_empty())
            .then(|| format!("{} facts that the assembly does not state", counted(by_gear.len())));
        let both: Vec<String> = [place, gear].into_iter().flatten().collect();
        (!both.is_empty()).then(|| both.join(", "))
    }

    /// Rules with a verdict.
    pub fn with(&self, verdict: Verdict) -> impl Iterator<Item = &RuleResult> {
        self.rules.iter().filter(move |rule| rule.verdict == verdict)
    }
}

/// Assembles an assembly of the library, by its id or its file, alone in still water.
pub fn assembly(
    named: &str,
    depth_m: Option<f64>,
    library: Option<&Path>,
    host: &PluginHost,
) -> Result<RuleGear, Error> {
    let file = AssemblyFile::open(named, library)?;
    let library = file.library()?;
    of_library(&file.id, depth_m, &library, host)
}

/// Assembles an assembly of a library that was read.
pub fn of_library(
    id: &str,
    depth_m: Option<f64>,
    library: &Library,
    host: &PluginHost,
) -> Result<RuleGear, Error> {
    let depth_m = depth_m.unwrap_or(USUAL_DEPTH_M);
    let text = alone(id, depth_m, library)?;
    let scenario = Scenario::read("scenario", &text)?;
    let made: Assembled = assemble_traced(&scenario, library, host, &Options::default())?;
    Ok(RuleGear { assembly: id.to_owned(), depth_m, gear: gear_of(&made, library) })
}

/// The text of a scenario with one assembly in still water.
fn alone(id: &str, depth_m: f64, library: &Library) -> Result<String, Error> {
    let head = "format = 1\nkind = \"scenario\"\nname = \"rules\"\nduration = \"1 s\"\nsegment = \"1 m\"\nstrength_scatter = false\n";
    let site = library.sites.first().map_or("", |site| site.entry.id.as_str());
    let depth = format!("{depth_m} m");
    let settings = [("site.item", site), ("site.depth", &depth), ("gear.0.assembly", id)];
    written(head, &settings.map(|(field, text)| (field, Setting::text(text))))
}

/// Checks every rule of the packs on gear.
pub fn check(gear: &RuleGear, packs: &Packs, fishing: &Fishing) -> Result<RuleSheet, Error> {
    let around = packs.around(&fishing.area).map_err(Error::Message)?;
    let rules = packs.rules().map(|rule| of(rule, &gear.gear, fishing, &around));
    let rules: Vec<RuleResult> = rules.collect::<Result<_, _>>()?;
    Ok(RuleSheet {
        schema: SCHEMA,
        assembly: gear.assembly.clone(),
        area: fishing.area.clone(),
        on: fishing.on.to_string(),
        depth_m: gear.depth_m,
        depth_is_usual: fishing.depth_m.is_none(),
        distance_m: fishing.distance_m,
        traps: fishing.traps.map_or(gear.gear.traps, usize::from),
        uncovered: uncovered(&gear.gear, packs),
        counts: Counts::of(&rules),
        rules,
    })
}

/// Kinds of gear that no rule of the packs names.
fn uncovered(gear: &Gear, packs: &Packs) -> Vec<String> {
    let names = |rule: &Rule| {
        let of = |text: &str| {
            text.split(|one: char| !one.is_alphanumeric() && one != '_').any(|word| word == NETTING)
        };
        of(&rule.check.value) || rule.when.as_ref().is_some_and(|when| of(&when.value))
    };
    if gear.netting_lines == 0 || packs.rules().any(|(_, rule)| names(rule)) {
        return Vec::new();
    }
    let says = "no gillnet rule is in any pack: rules on net panels, their weak links and anchors are not checked, and passes of other rules are no compliance of the net";
    vec![says.to_owned()]
}

/// Where, when and how gear is fished.
#[derive(Clone, Debug)]
pub struct Fishing {
    /// Id of the area.
    pub area: String,
    /// The day.
    pub on: Date,
    /// Depth of the water, where it is given [m].
    pub depth_m: Option<f64>,
    /// Distance from shore, where it is given [m].
    pub distance_m: Option<f64>,
    /// Traps on one set, in place of those counted.
    pub traps: Option<u16>,
}
