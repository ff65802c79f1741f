//! `endline rules`: an assembly checked against rules of law, edits by which it would comply, and the list of rules.

mod args;
mod check;
mod fix;

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use endline_session::locate;
use endline_session::rules::Packs;
use endline_session::rules::remedy::Asked;
use endline_session::rules::study::{RuleOption, options, text};
use endline_session::source::AssemblyFile;

use crate::cli::table::columns;
use crate::cli::{Failure, host, output};

pub(super) use args::{FishedArgs, RulesCommand};
use args::{ListArgs, StudyArgs};

pub(super) fn rules(what: &RulesCommand, library: Option<&Path>) -> Result<ExitCode, Failure> {
    match what {
        RulesCommand::Check(args) => check::check_rules(args, library),
        RulesCommand::Fix(args) => fix::fix(args, library),
        RulesCommand::Study(args) => study(args, library),
        RulesCommand::List(args) => list(args, library),
    }
}

/// Writes a text to a new file, named by its path or by an id in a folder of the library; refuses to replace one.
fn write_new(named: &str, root: &Path, folder: &str, text: &str) -> Result<PathBuf, Failure> {
    let is_path = named.ends_with(".toml") || named.contains(['/', '\\']);
    let path = if is_path { named.into() } else { root.join(folder).join(format!("{named}.toml")) };
    locate::write_new(&path, text).map_err(|error| match error.kind() {
        std::io::ErrorKind::AlreadyExists => {
            Failure::failed(format!("{} is there already; name a new file", path.display()))
        }
        _ => Failure::failed(format!("{}: cannot be written: {error}", path.display())),
    })?;
    Ok(path)
}

fn list(args: &ListArgs, library: Option<&Path>) -> Result<ExitCode, Failure> {
    let packs = Packs::open(library, &args.pack)?;
    output::print(&if args.json { packs.json() + "\n" } else { listed(&packs) })?;
    Ok(ExitCode::SUCCESS)
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

fn study(args: &StudyArgs, library: Option<&Path>) -> Result<ExitCode, Failure> {
    let packs = Packs::open(library, &args.pack)?;
    let file = AssemblyFile::open(&args.assembly, library)?;
    let like = locate::named(&args.like, "studies", library).map_err(Failure::failed)?;
    let like = endline_gear::read::text(&like)
        .map_err(|error| Failure::failed(format!("{}: {error}", like.display())))?;
    let asked = Asked { id: &file.id, text: &file.text, sources: &file.sources };
    let options = options(asked, &args.option, args.depth, &packs, &host::load())?;
    let text = text(&file.id, &options, &like, args.depth)?;
    let path = write_new(&args.out, &file.root, "studies", &text)?;
    output::print(&words(&path, &options))?;
    Ok(ExitCode::SUCCESS)
}

fn words(path: &Path, options: &[RuleOption]) -> String {
    let mut text = String::new();
    for option in options {
        let edit = option.edit.as_ref().map_or("The gear as it stands.", |edit| &edit.says);
        text += &format!("{:26}  {edit}\n", option.rule);
    }
    let file = path.display();
    text + &format!("\nThe study is {file}; `endline study plan {file}` prints its encounters.\n")
}
