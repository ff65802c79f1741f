//! `endline plugins`: what is loaded, and a check of one file.

use std::fmt::Write;
use std::path::Path;
use std::process::ExitCode;

use endline_sdk::{Attribute, AttributeKind};
use endline_session::plugins::{PluginInfo, check_here};

use super::args::PluginsCommand;
use super::{Failure, host, output};

pub(super) fn plugins(what: &PluginsCommand) -> Result<ExitCode, Failure> {
    match what {
        PluginsCommand::List => list(),
        PluginsCommand::Check { file } => check(file),
    }
}

/// Every plugin found; those that failed are told on standard error as they are found.
fn list() -> Result<ExitCode, Failure> {
    let host = host::load();
    let folders: Vec<String> = host::folders().iter().map(|folder| folder.display().to_string()).collect();
    let mut text: String = host.list().iter().map(told).collect();
    if text.is_empty() {
        text = format!("no plugins found; looked in {}\n", folders.join(", "));
    }
    output::print(&text)?;
    Ok(ExitCode::SUCCESS)
}

/// Opens a file in this process, which it may crash: the check of every new plugin runs this as a child.
fn check(file: &Path) -> Result<ExitCode, Failure> {
    let plugins = check_here(file).map_err(Failure::failed)?;
    let text: String = plugins.iter().map(told).collect();
    output::print(&format!("{}: sound\n{text}", file.display()))?;
    Ok(ExitCode::SUCCESS)
}

fn told(info: &PluginInfo) -> String {
    let place = info.file.as_ref().map_or_else(|| "linked in".to_owned(), |file| file.display().to_string());
    let mut text = format!("{}  {}  {}\n  {} ({place})\n  {}\n", info.id, info.version, info.kind, info.name, info.help);
    for attribute in &info.attributes {
        // Writing into a String cannot fail.
        let _ = writeln!(text, "    {}: {}; {}", attribute.key, values(attribute), attribute.help);
    }
    for act in &info.acts {
        let _ = writeln!(text, "    act {}: {}", act.id, act.help);
    }
    text
}

fn values(attribute: &Attribute) -> String {
    match &attribute.kind {
        AttributeKind::Number { min, max, default } if attribute.unit == "1" => format!("{min} to {max}, else {default}"),
        AttributeKind::Number { min, max, default } => format!("{min} to {max} {}, else {default}", attribute.unit),
        AttributeKind::Count { min, max, default } => format!("a whole number from {min} to {max}, else {default}"),
        AttributeKind::Choice { words, default } => format!("{}, else {default}", words.join(" or ")),
        AttributeKind::Item { library, default } if default.is_empty() => format!("an item of {library}, else none"),
        AttributeKind::Item { library, default } => format!("an item of {library}, else {default}"),
    }
}
