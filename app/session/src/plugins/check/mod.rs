//! Whether a plugin file is safe to open: tried out in a child process first.
//!
//! A library runs code as it is opened, and may crash, hang or lie. The child,
//! `endline plugins check FILE --here`, calls [`report_here`]; what becomes of the child is known here.

use std::cell::RefCell;
use std::collections::BTreeSet;
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::ExitStatus;
use std::time::Duration;

use endline_gear::read;
use endline_sdk::abi::table::{ABI_MAJOR, ABI_MINOR};

use super::choices::Choices;
use super::host::PluginHost;
use super::info::{Checker, PluginInfo};
use super::loader::{open_folder, open_here};
#[cfg(unix)]
pub(super) use child::limit_memory;
use child::{Ended, Orders};
use trial::Finding;

mod child;
mod report;
pub mod trial;

/// A plugin of a file that was tried, and what each check found.
#[derive(Clone, Debug)]
pub struct Tried {
    /// The plugin.
    pub info: PluginInfo,
    /// What each check found, in the order made.
    pub findings: Vec<Finding>,
}

/// Opens a file, or the folder of a plugin without code, in this process and tries each of its plugins; `begin` is called with a plugin's id and a check before each begins.
///
/// # Errors
/// Where the file or a plugin's declaration cannot be used. A file that crashes takes this process with it: that is what the child is for.
pub fn try_here(file: &Path, begin: &dyn Fn(&str, &'static str)) -> Result<Vec<Tried>, String> {
    try_file(file, "", begin)
}

/// The same of a file with these bytes; of any where the hash is empty.
fn try_file(
    file: &Path,
    hash: &str,
    begin: &dyn Fn(&str, &'static str),
) -> Result<Vec<Tried>, String> {
    let mut host = PluginHost::empty();
    let mut problems = Vec::new();
    if file.is_dir() {
        open_folder(file, &mut host, &mut problems);
    } else {
        let (hash, opened) =
            open_here(file, hash).map_err(|refusal| refusal.at(file).to_string())?;
        host.add_loaded(file, &hash, opened, &Choices::everything(), &mut problems);
    }
    if let Some(problem) = problems.first() {
        return Err(problem.to_string());
    }
    let tried = host.list().iter().map(|info| {
        let findings =
            host.hook(&info.id).map(|hook| trial::run(hook, &|check| begin(&info.id, check)));
        // Motion clips are tried as they are read: keys in order, within the joints, closed where they repeat.
        Tried { info: info.clone(), findings: findings.unwrap_or_default() }
    });
    Ok(tried.collect())
}

/// Opens a file in this process and tries each of its plugins.
///
/// # Errors
/// With what is wrong first.
pub fn check_here(file: &Path) -> Result<Vec<PluginInfo>, String> {
    let tried = try_here(file, &|_, _| ())?;
    sound(file, &tried)?;
    Ok(tried.into_iter().map(|tried| tried.info).collect())
}

/// The first thing wrong with a plugin that was tried.
fn fault(tried: &Tried) -> Option<String> {
    let (check, fault) = tried
        .findings
        .iter()
        .find_map(|finding| Some((finding.check, finding.outcome.as_ref().err()?)))?;
    let named = format!("plugin `{}`: ", tried.info.id);
    let fault = if fault.starts_with(&named) { fault.clone() } else { named + fault };
    Some(if check == "defaults" {
        format!("tried out with its own defaults, {fault}")
    } else {
        format!("at the check `{check}`, {fault}")
    })
}

/// What the child does: tries the plugins of a file and tells of each check on `out`, then the report.
///
/// # Errors
/// With what is wrong first, the last line a program reads of its child.
pub fn report_here(file: &Path, out: &mut dyn Write) -> Result<(), String> {
    let orders = Orders::received();
    let out = RefCell::new(out);
    // Where nobody reads any more, the verdict is all that counts.
    let say = |line: &str| {
        let mut out = out.borrow_mut();
        let _ = writeln!(out, "{line}").and_then(|()| out.flush());
    };
    let begin = |id: &str, check: &str| say(&format!("{BEGINS}{check}` of `{id}`"));
    let tried = try_file(file, &orders.hash, &begin)?;
    report::lines(&tried).iter().for_each(|line| say(line));
    sound(file, &tried)?;
    orders.signature().iter().for_each(|signature| say(signature));
    Ok(())
}

/// The first thing wrong in a file, as an error.
fn sound(file: &Path, tried: &[Tried]) -> Result<(), String> {
    tried.iter().find_map(fault).map_or(Ok(()), |fault| Err(format!("{}: {fault}", file.display())))
}

/// What is found of a plugin without code, which has nothing that could crash this process.
fn report_of_folder(folder: &Path) -> (String, Result<(), String>) {
    match try_here(folder, &|_, _| ()) {
        Ok(tried) => (
            report::lines(&tried).iter().map(|line| format!("{line}\n")).collect(),
            sound(folder, &tried),
        ),
        Err(problem) => (String::new(), Err(problem)),
    }
}

/// How a line begins that tells of a check before it is made.
const BEGINS: &str = "trying the check `";

/// A checker that opens each file in a child: `program plugins check FILE --here`, killed after a time.
pub fn by_child(
    program: impl Into<PathBuf>,
    limit: Duration,
) -> impl Fn(&Path, &str) -> Result<(), String> {
    let program = program.into();
    move |file, hash| told_by_child(&program, file, hash, limit).1
}

/// What the child says of a file, without its lines about each check, and the verdict. A folder without code needs no child.
pub fn report_of_child(
    program: &Path,
    file: &Path,
    limit: Duration,
) -> (String, Result<(), String>) {
    if file.is_dir() {
        return report_of_folder(file);
    }
    told_by_child(program, file, "", limit)
}

/// The same, of a file with these bytes.
fn told_by_child(
    program: &Path,
    file: &Path,
    hash: &str,
    limit: Duration,
) -> (String, Result<(), String>) {
    let orders = Orders::new(hash);
    let Ended { status, out, error } = match child::run(program, file, &orders, limit) {
        Ok(ended) => ended,
        Err(error) => return (String::new(), Err(error)),
    };
    let signature = orders.signature();
    let is_signature = |line: &str| Some(line) == signature.as_deref();
    let at = out
        .lines()
        .rev()
        .find_map(|line| line.strip_prefix("trying "))
        .map_or_else(|| "when opened".to_owned(), |check| format!("at {check}"));
    let verdict = match status {
        None => Err(format!("it hangs {at} (no answer in {:.0} s)", limit.as_secs_f64())),
        Some(status) if status.success() && !out.lines().any(is_signature) => {
            Err(format!("it ends the program {at}, before every check was made"))
        }
        Some(status) => verdict(status, &error, &at),
    };
    let report = out
        .lines()
        .filter(|line| !line.starts_with(BEGINS) && !is_signature(line))
        .fold(String::new(), |text, line| text + line + "\n");
    (report, verdict)
}

fn verdict(status: ExitStatus, said: &str, at: &str) -> Result<(), String> {
    if status.success() {
        return Ok(());
    }
    let last = said
        .lines()
        .map(|line| line.trim().trim_start_matches("endline: "))
        .rfind(|line| !line.is_empty());
    match (status.code(), last) {
        (Some(_), Some(last)) => Err(last.to_owned()),
        (Some(code), None) => Err(format!("the check ended with exit code {code}")),
        (None, _) => Err(format!("it crashes {at} ({status})")),
    }
}

/// A checker that asks another only about files it has not seen pass under this ABI: in this run, or, where a list
/// file is given, in any run. What cannot be read from or written to the list is checked again.
pub fn remembering<'a>(
    list: Option<PathBuf>,
    checker: &'a Checker<'a>,
) -> impl Fn(&Path, &str) -> Result<(), String> + 'a {
    let known = list.as_ref().and_then(|list| read::text(list).ok()).unwrap_or_default();
    let known = RefCell::new(known.lines().map(str::to_owned).collect::<BTreeSet<_>>());
    move |file, hash| {
        let passed = format!("{ABI_MAJOR}.{ABI_MINOR} {hash}");
        if known.borrow().contains(&passed) {
            return Ok(());
        }
        checker(file, hash)?;
        known.borrow_mut().insert(passed);
        if let Some(list) = &list {
            note(list, &known.borrow());
        }
        Ok(())
    }
}

/// Writes the list beside its place and renames it there.
fn note(list: &Path, known: &BTreeSet<String>) {
    let text = known.iter().fold(String::new(), |text, passed| text + passed + "\n");
    let beside = list.with_extension(format!("{}.new", std::process::id()));
    let written =
        list.parent().map_or(Ok(()), fs::create_dir_all).and_then(|()| fs::write(&beside, text));
    // A list that cannot be kept costs only a check at the next start.
    let _ = written.and_then(|()| fs::rename(&beside, list));
}
