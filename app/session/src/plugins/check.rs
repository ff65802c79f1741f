//! Whether a plugin file is safe to open: tried out in a child process first.
//!
//! A library runs code as it is opened, and may crash, hang or lie. The child,
//! `endline plugins check FILE`, calls [`check_here`]; what becomes of the child is known here.

use std::cell::RefCell;
use std::collections::BTreeSet;
use std::fs;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, ExitStatus, Stdio};
use std::thread;
use std::time::{Duration, Instant};

use endline_sdk::abi::table::{ABI_MAJOR, ABI_MINOR};

use super::host::{PluginHost, open_checked};
use super::info::{Hook, PluginInfo};

mod trial;

/// Lets a file pass, or says why not.
pub type Checker<'a> = dyn Fn(&Path) -> Result<(), String> + 'a;

/// How much of what a child says is read [bytes]; the verdict is its last line.
const MOST_SAID: u64 = 65_536;

/// How often a child is looked at.
const LOOK: Duration = Duration::from_millis(4);

/// Opens a file in this process and calls each of its plugins once with its own defaults.
///
/// # Errors
/// With what is wrong. A file that crashes takes this process with it: that is what the child is for.
pub fn check_here(file: &Path) -> Result<Vec<PluginInfo>, String> {
    let (hash, hooks) = open_checked(file, &|_: &Path| Ok(())).map_err(|refusal| refusal.at(file).to_string())?;
    let mut host = PluginHost::empty();
    let mut problems = Vec::new();
    host.add_loaded(file, &hash, hooks, &mut problems);
    if let Some(problem) = problems.first() {
        return Err(problem.to_string());
    }
    for info in host.list() {
        host.hook(&info.id).map_or(Ok(()), trial_of).map_err(|error| format!("{}: {error}", file.display()))?;
    }
    Ok(host.list().to_vec())
}

fn trial_of(hook: &Hook) -> Result<(), String> {
    trial::run(hook).map_err(|error| format!("tried out with its own defaults, {error}"))
}

/// A checker that opens each file in a child: `program plugins check FILE`, killed after a time.
pub fn by_child(program: impl Into<PathBuf>, limit: Duration) -> impl Fn(&Path) -> Result<(), String> {
    let program = program.into();
    move |file| {
        let mut command = Command::new(&program);
        command
            .args(["plugins", "check"])
            .arg(file)
            .stdin(Stdio::null())
            .stdout(Stdio::null())
            .stderr(Stdio::piped())
            .env("RUST_BACKTRACE", "0");
        let mut child = command.spawn().map_err(|error| format!("cannot start {}: {error}", program.display()))?;
        let Some(status) = wait(&mut child, limit).map_err(|error| error.to_string())? else {
            return Err(format!("it hangs when opened (no answer in {:.0} s)", limit.as_secs_f64()));
        };
        verdict(status, &mut child)
    }
}

/// Waits for a child; kills it and gives `None` where it takes too long.
fn wait(child: &mut Child, limit: Duration) -> std::io::Result<Option<ExitStatus>> {
    let start = Instant::now();
    loop {
        if let Some(status) = child.try_wait()? {
            return Ok(Some(status));
        }
        if start.elapsed() > limit {
            child.kill()?;
            child.wait()?;
            return Ok(None);
        }
        thread::sleep(LOOK);
    }
}

fn verdict(status: ExitStatus, child: &mut Child) -> Result<(), String> {
    if status.success() {
        return Ok(());
    }
    let mut said = Vec::new();
    if let Some(stderr) = child.stderr.take() {
        stderr.take(MOST_SAID).read_to_end(&mut said).map_err(|error| error.to_string())?;
    }
    let said = String::from_utf8_lossy(&said);
    let last = said.lines().map(str::trim).rfind(|line| !line.is_empty());
    match (status.code(), last) {
        (Some(_), Some(last)) => Err(last.to_owned()),
        (Some(code), None) => Err(format!("the check ended with exit code {code}")),
        (None, _) => Err(format!("it crashes when opened ({status})")),
    }
}

/// A checker that asks another only about files it has not seen pass under this ABI: in this run, or, where a list
/// file is given, in any run. What cannot be read from or written to the list is checked again.
pub fn remembering<'a>(list: Option<PathBuf>, checker: &'a Checker<'a>) -> impl Fn(&Path) -> Result<(), String> + 'a {
    let known = list.as_ref().and_then(|list| fs::read_to_string(list).ok()).unwrap_or_default();
    let known = RefCell::new(known.lines().map(str::to_owned).collect::<BTreeSet<_>>());
    move |file| {
        let bytes = fs::read(file).map_err(|error| format!("cannot be read: {error}"))?;
        let passed = format!("{ABI_MAJOR}.{ABI_MINOR} {}", blake3::hash(&bytes).to_hex());
        if known.borrow().contains(&passed) {
            return Ok(());
        }
        checker(file)?;
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
    let written = list.parent().map_or(Ok(()), fs::create_dir_all).and_then(|()| fs::write(&beside, text));
    // A list that cannot be kept costs only a check at the next start.
    let _ = written.and_then(|()| fs::rename(&beside, list));
}
