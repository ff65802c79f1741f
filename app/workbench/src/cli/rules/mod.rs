//! `endline rules`: what laws ask of an assembly.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use endline_gear::Date;
use endline_gear::units::{self, Quantity};
use endline_session::rules::{Fishing, Packs, RuleResult, RuleSheet, Verdict, assembly, check};

use super::table::columns;
use super::{Failure, host, output};

/// Measured values shown of a rule; all are in the JSON.
const MOST_SHOWN: usize = 6;

#[derive(Debug, clap::Subcommand)]
pub(super) enum RulesCommand {
    /// Check an assembly against every rule that applies where and when it is fished.
    Check(CheckArgs),
    /// List rules with their citations, dates and standing, and the areas.
    List(ListArgs),
}

#[derive(Debug, clap::Args)]
pub(super) struct CheckArgs {
    /// Assembly file, or the id of an assembly in the gear library.
    #[arg(value_name = "ASSEMBLY")]
    assembly: String,
    /// Area in which it is fished; `endline rules list` names them.
    #[arg(long, value_name = "NAME")]
    area: String,
    /// Day on which it is fished.
    #[arg(long, value_name = "YYYY-MM-DD", value_parser = day)]
    on: Date,
    /// Depth of the water, such as "30 fathom"; gear types build for it [default: 25 m, and depth counts as not known].
    #[arg(long, value_name = "LENGTH", value_parser = length)]
    depth: Option<f64>,
    /// Distance from shore, such as "5 nmi".
    #[arg(long, value_name = "LENGTH", value_parser = length)]
    distance: Option<f64>,
    /// Traps on one set, in place of those of the assembly.
    #[arg(long, value_name = "N")]
    traps: Option<u16>,
    /// Rule pack besides those of the library; may be given several times.
    #[arg(long, value_name = "FILE")]
    pack: Vec<PathBuf>,
    /// Leave rules out that do not apply.
    #[arg(long)]
    brief: bool,
    /// Print the result as one JSON object.
    #[arg(long)]
    json: bool,
}

#[derive(Debug, clap::Args)]
pub(super) struct ListArgs {
    /// Rule pack besides those of the library; may be given several times.
    #[arg(long, value_name = "FILE")]
    pack: Vec<PathBuf>,
}

pub(super) fn rules(what: &RulesCommand, library: Option<&Path>) -> Result<ExitCode, Failure> {
    match what {
        RulesCommand::Check(args) => check_rules(args, library),
        RulesCommand::List(args) => {
            output::print(&listed(&Packs::open(library, &args.pack)?))?;
            Ok(ExitCode::SUCCESS)
        }
    }
}

/// Exit code 1 where a rule fails.
fn check_rules(args: &CheckArgs, library: Option<&Path>) -> Result<ExitCode, Failure> {
    let packs = Packs::open(library, &args.pack)?;
    packs.around(&args.area).map_err(Failure::usage)?;
    let gear = assembly(&args.assembly, args.depth, library, &host::load())?;
    let fishing = Fishing {
        area: args.area.clone(),
        on: args.on,
        depth_m: args.depth,
        distance_m: args.distance,
        traps: args.traps,
    };
    let sheet = check(&gear, &packs, &fishing)?;
    output::print(&if args.json { sheet.json() + "\n" } else { words(&sheet, args.brief) })?;
    let fails = sheet.with(Verdict::Fail).count();
    Ok(if fails == 0 { ExitCode::SUCCESS } else { ExitCode::from(1) })
}

fn words(sheet: &RuleSheet, brief: bool) -> String {
    let usual = if sheet.depth_is_usual { ", taken because --depth is not given" } else { "" };
    let mut text = format!(
        "{} in {} on {}, assembled for {} m of water{usual}\n\n",
        sheet.assembly, sheet.area, sheet.on, sheet.depth_m
    );
    let shown = |rule: &&RuleResult| !brief || rule.verdict != Verdict::NotApplicable;
    text += &sheet.rules.iter().filter(shown).map(one).collect::<String>();
    let count = |verdict| sheet.with(verdict).count();
    text + &format!(
        "\n{} pass, {} fail, {} do not apply, {} cannot be checked\n",
        count(Verdict::Pass),
        count(Verdict::Fail),
        count(Verdict::NotApplicable),
        count(Verdict::CannotBeChecked)
    )
}

fn one(rule: &RuleResult) -> String {
    let mut text = format!(
        "{:17}  {:26}  {}{}\n",
        rule.verdict.words(),
        rule.rule,
        rule.asks,
        standing(rule.standing, rule.confidence)
    );
    let indent = " ".repeat(19);
    if !rule.why.is_empty() {
        text += &format!("{indent}{}\n", rule.why);
    }
    for measured in rule.measured.iter().take(MOST_SHOWN) {
        let part =
            if measured.part.is_empty() { String::new() } else { format!("{}: ", measured.part) };
        let fails = if measured.holds { "" } else { ", which does not hold" };
        text += &format!("{indent}{part}{}{fails}\n", measured.says);
    }
    if rule.measured.len() > MOST_SHOWN {
        text += &format!("{indent}and {} more\n", rule.measured.len() - MOST_SHOWN);
    }
    if rule.verdict == Verdict::Fail {
        text += &format!("{indent}mend: {}\n{indent}{}\n", rule.mend, rule.cite);
    }
    text
}

/// What a reader must know besides: that a rule does not bind, or that nobody verified it.
fn standing(standing: &str, confidence: &str) -> String {
    match (standing, confidence) {
        ("law", "estimate") => " (not verified)".to_owned(),
        ("law", _) => String::new(),
        (other, "estimate") => format!(" ({other}, not verified)"),
        (other, _) => format!(" ({other})"),
    }
}

fn listed(packs: &Packs) -> String {
    let mut rows = vec![
        ["rule", "in force", "standing", "confidence", "applies in", "citation"]
            .map(str::to_owned)
            .to_vec(),
    ];
    for (_, rule) in packs.rules() {
        let from = rule.from.map_or("unknown".to_owned(), |from| from.to_string());
        let until = rule.until.map_or(String::new(), |until| format!(" to {until}"));
        let areas: Vec<&str> = rule.areas.iter().map(|area| area.value.as_str()).collect();
        rows.push(vec![
            rule.id.value.clone(),
            format!("{from}{until}"),
            rule.standing.word().to_owned(),
            rule.confidence.word().to_owned(),
            if areas.is_empty() { "all areas".to_owned() } else { areas.join(", ") },
            rule.cite.clone(),
        ]);
    }
    let mut areas = vec![["area", "name", "within"].map(str::to_owned).to_vec()];
    areas.extend(packs.areas().map(|area| {
        let within = area.within.as_ref().map(|within| within.value.clone()).unwrap_or_default();
        vec![area.id.value.clone(), area.name.clone(), within]
    }));
    columns(&rows) + &columns(&areas)
}

fn day(text: &str) -> Result<Date, String> {
    Date::parse(text).ok_or_else(|| "expected year, month and day, such as 2024-06-01".to_owned())
}

fn length(text: &str) -> Result<f64, String> {
    let metres = units::parse(text, Quantity::Length).map_err(|error| error.to_string())?;
    if metres >= 0.0 { Ok(metres) } else { Err("expected a length of zero or above".to_owned()) }
}
