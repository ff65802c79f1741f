//! `endline rules list`: rules and areas.

use std::path::Path;
use std::process::ExitCode;

use endline_session::rules::Packs;

use super::args::ListArgs;
use crate::cli::table::columns;
use crate::cli::{Failure, output};

pub(super) fn list(args: &ListArgs, library: Option<&Path>) -> Result<ExitCode, Failure> {
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
