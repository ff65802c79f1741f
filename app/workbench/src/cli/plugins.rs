//! `endline plugins`: list, check, permissions, switches, a new project.

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Duration;

use endline_sdk::{Attribute, AttributeKind};
use endline_session::load_with;
use endline_session::plugins::{
    Change, PluginInfo, PluginKind, PluginProblem, Project, Standing, file_hash, report_here,
    report_of_child, write_project,
};

use super::args::{NewPluginArgs, PluginsCommand};
use super::{Failure, host, output};

/// Where a library runs, untrusted and trusted.
const PLACES: [&str; 2] = if cfg!(unix) {
    ["a process of its own (--in-process: faster, for people you trust)", "the program's process"]
} else {
    ["the program's process"; 2]
};

/// How long a file may take to be tried.
const PATIENCE: Duration = Duration::from_secs(30);

pub(super) fn plugins(what: &PluginsCommand) -> Result<ExitCode, Failure> {
    match what {
        PluginsCommand::List => list(),
        PluginsCommand::Check { file, here: false } => check(file),
        PluginsCommand::Check { file, here: true } => check_here(file),
        PluginsCommand::New(args) => new(args),
        PluginsCommand::Serve => serve(),
        PluginsCommand::Allow { files, in_process } => allow(files, *in_process),
        PluginsCommand::Forget { files } => forget(files),
        PluginsCommand::Off { id } => switch(id, false),
        PluginsCommand::On { id } => switch(id, true),
    }
}

/// Every plugin found, and those left out; the reasons are printed on standard error.
fn list() -> Result<ExitCode, Failure> {
    let (host, problems) = host::load_reported();
    let folders: Vec<String> =
        host::folders().iter().map(|folder| folder.display().to_string()).collect();
    let mut text: String = host.list().iter().map(words).collect();
    if text.is_empty() {
        text = format!("no plugins found; searched in {}\n", folders.join(", "));
    }
    text.extend(
        host.switched_off()
            .iter()
            .map(|info| format!("switched off  {}; endline plugins on {}\n", info.id, info.id)),
    );
    text.extend(problems.iter().map(left_out));
    output::print(&text)?;
    Ok(ExitCode::SUCCESS)
}

/// A file that is not used, in a line.
fn left_out(problem: &PluginProblem) -> String {
    let file = problem.file.display();
    match &problem.standing {
        Standing::Waiting(ask) if ask.change == Change::New => {
            format!("not allowed   {file}; endline plugins allow {file}\n")
        }
        Standing::Waiting(_) => format!("changed       {file}; endline plugins allow {file}\n"),
        Standing::SetAside => format!("quarantined   {file}; endline plugins check {file}\n"),
        Standing::Unusable => format!("not usable    {file}\n"),
    }
}

/// Pins files as they are now.
fn allow(files: &[PathBuf], in_process: bool) -> Result<ExitCode, Failure> {
    let mut loader = host::loader();
    for file in files {
        let hash = file_hash(file).map_err(Failure::failed)?;
        loader.choices.keeps().map_err(Failure::failed)?;
        let (choices, place) = (&mut loader.choices, PLACES[usize::from(in_process)]);
        let kept = if in_process { choices.trust(file, &hash) } else { choices.allow(file, &hash) };
        kept.map_err(Failure::failed)?;
        output::print(&format!("{}: allowed, in {place}; hash {hash}\n", file.display()))?;
    }
    Ok(ExitCode::SUCCESS)
}

fn forget(files: &[PathBuf]) -> Result<ExitCode, Failure> {
    let mut loader = host::loader();
    for file in files {
        loader.choices.keeps().map_err(Failure::failed)?;
        let known = loader.choices.forget(file).map_err(Failure::failed)?;
        output::print(&format!(
            "{}: {}\n",
            file.display(),
            if known { "no longer allowed" } else { "was not allowed" }
        ))?;
    }
    Ok(ExitCode::SUCCESS)
}

fn switch(id: &str, on: bool) -> Result<ExitCode, Failure> {
    let mut loader = host::loader();
    let (host, _) = load_with(&mut loader);
    let mut known = host.list().iter().chain(host.switched_off());
    if !on && !known.any(|info| info.id == id) {
        let ids = host.ids();
        return Err(Failure::failed(format!(
            "no plugin `{id}`; {}",
            endline_gear::hint(id, ids.iter().map(String::as_str))
        )));
    }
    loader.choices.keeps().map_err(Failure::failed)?;
    loader.choices.switch(id, on).map_err(Failure::failed)?;
    output::print(&format!("{id}: {}\n", if on { "on" } else { "off" }))?;
    Ok(ExitCode::SUCCESS)
}

/// Checks a file in a child process, and prints its findings.
fn check(file: &Path) -> Result<ExitCode, Failure> {
    let program = std::env::current_exe()
        .map_err(|error| Failure::failed(format!("cannot find this program: {error}")))?;
    let (report, verdict) = report_of_child(&program, file, PATIENCE);
    output::print(&report)?;
    match verdict {
        Ok(()) => output::print(&format!("{}: sound\n", file.display()))?,
        Err(fault) if fault.contains(&*file.to_string_lossy()) => {
            return Err(Failure::failed(fault));
        }
        Err(fault) => return Err(Failure::failed(format!("{}: {fault}", file.display()))),
    }
    Ok(ExitCode::SUCCESS)
}

/// Opens a file in this process, which it may crash: the child of every check.
fn check_here(file: &Path) -> Result<ExitCode, Failure> {
    report_here(file, &mut std::io::stdout()).map_err(Failure::failed)?;
    Ok(ExitCode::SUCCESS)
}

/// Answers the program that has started this process to run a library in.
#[cfg(unix)]
fn serve() -> Result<ExitCode, Failure> {
    endline_session::plugins::serve_here().map_err(Failure::failed)?;
    Ok(ExitCode::SUCCESS)
}

#[cfg(not(unix))]
fn serve() -> Result<ExitCode, Failure> {
    Err(Failure::failed("on this system plugins run in the program's own process".to_owned()))
}

/// Writes a project and prints the next steps.
fn new(args: &NewPluginArgs) -> Result<ExitCode, Failure> {
    let (kind, language) = (PluginKind::from(args.kind), args.lang.into());
    let usual = || PathBuf::from(format!("my-{}", kind.word()));
    let folder = args.folder.clone().unwrap_or_else(usual);
    let Project { id, build, library } =
        write_project(&folder, kind, language, args.sdk.as_deref()).map_err(Failure::failed)?;
    let file = library.display();
    if build.is_empty() {
        output::print(&format!(
            "{}: {id}\n\n  endline plugins check {file}\n  ENDLINE_PLUGINS={file} endline plugins list\n",
            folder.display()
        ))?;
        return Ok(ExitCode::SUCCESS);
    }
    let build = build.join(" ");
    let place = library.parent().unwrap_or(&folder).display();
    let steps = format!(
        "  {build}\n  endline plugins check {file}\n  endline plugins allow {file}\n  ENDLINE_PLUGINS={place} endline plugins list\n"
    );
    output::print(&format!("{}: {id}\n\n{steps}", folder.display()))?;
    Ok(ExitCode::SUCCESS)
}

fn words(info: &PluginInfo) -> String {
    let place = info
        .file
        .as_ref()
        .map_or_else(|| "linked in".to_owned(), |file| file.display().to_string());
    let own = if info.out_of_process { ", in a process of its own" } else { "" };
    let mut text = format!(
        "{}  {}  {}\n  {} ({place}{own})\n  {}\n",
        info.id, info.version, info.kind, info.name, info.help
    );
    if !info.about.is_empty() {
        // Writing into a String cannot fail.
        let _ = writeln!(text, "  {}", info.about);
    }
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
        AttributeKind::Number { min, max, default } if attribute.unit == "1" => {
            format!("{min} to {max}, else {default}")
        }
        AttributeKind::Number { min, max, default } => {
            format!("{min} to {max} {}, else {default}", attribute.unit)
        }
        AttributeKind::Count { min, max, default } => {
            format!("a whole number from {min} to {max}, else {default}")
        }
        AttributeKind::Choice { words, default } => {
            format!("{}, else {default}", words.join(" or "))
        }
        AttributeKind::Item { library, default } if default.is_empty() => {
            format!("an item of {library}, else none")
        }
        AttributeKind::Item { library, default } => format!("an item of {library}, else {default}"),
    }
}
