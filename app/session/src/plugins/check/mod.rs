//! Whether a plugin file is safe to open: checked in a child process first.
//!
//! A library runs code as it is opened, and may crash, hang or lie. The child,
//! `endline plugins check FILE --here`, calls [`report_here`]; this process observes how the child ends.
//!
//! The child gets its orders on standard input: a token, and the hash of the bytes it may open. It repeats the token once every
//! check is made, so that a library that ends the process early does not pass. It runs in a process group of its own, which
//! ends with it, under a limit of memory and of time; processes that it forks cannot delay its parent.

pub mod trial;

use std::cell::RefCell;
use std::collections::BTreeSet;
use std::hash::{BuildHasher, Hasher, RandomState};
use std::io::{IsTerminal, Read, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};
use std::{fs, thread};

use endline_gear::read;
use endline_sdk::abi::table::{ABI_MAJOR, ABI_MINOR};

use super::choices::Choices;
use super::host::PluginHost;
use super::info::{Checker, PluginInfo};
use super::loader::{open_folder, open_here};
use trial::Finding;

/// A plugin of a file, and the findings of each check.
#[derive(Clone, Debug)]
pub struct Tried {
    /// The plugin.
    pub info: PluginInfo,
    /// The findings, in the order of the checks.
    pub findings: Vec<Finding>,
}

/// Opens a file, or the folder of a plugin without code, in this process and tries each of its plugins; `begin` is called with a plugin's id and a check before each begins.
pub fn try_here(file: &Path, begin: &dyn Fn(&str, &'static str)) -> Result<Vec<Tried>, String> {
    try_file(file, "", begin)
}

/// Checks a file with these bytes; any file where the hash is empty.
fn try_file(
    file: &Path,
    hash: &str,
    begin: &dyn Fn(&str, &'static str),
) -> Result<Vec<Tried>, String> {
    let mut host = PluginHost::empty();
    let mut problems = Vec::new();
    if file.is_dir() {
        open_folder(file, &mut host, &Choices::everything(), &mut problems);
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
pub fn check_here(file: &Path) -> Result<Vec<PluginInfo>, String> {
    let tried = try_here(file, &|_, _| ())?;
    sound(file, &tried)?;
    Ok(tried.into_iter().map(|tried| tried.info).collect())
}

/// The first failure of a plugin that was checked.
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

/// The child's work: checks the plugins of a file and announces each check on `out`, then writes the report.
pub fn report_here(file: &Path, out: &mut dyn Write) -> Result<(), String> {
    let orders = Orders::received();
    let out = RefCell::new(out);
    // A closed output is no failure: the verdict alone counts.
    let say = |line: &str| {
        let mut out = out.borrow_mut();
        let _ = writeln!(out, "{line}").and_then(|()| out.flush());
    };
    let begin = |id: &str, check: &str| say(&format!("{BEGINS}{check}` of `{id}`"));
    let tried = try_file(file, &orders.hash, &begin)?;
    lines(&tried).iter().for_each(|line| say(line));
    sound(file, &tried)?;
    orders.signature().iter().for_each(|signature| say(signature));
    Ok(())
}

/// The first failure in a file, as an error.
fn sound(file: &Path, tried: &[Tried]) -> Result<(), String> {
    tried.iter().find_map(fault).map_or(Ok(()), |fault| Err(format!("{}: {fault}", file.display())))
}

/// Start of a line that announces a check.
const BEGINS: &str = "trying the check `";

/// A checker that opens each file in a child: `program plugins check FILE --here`, killed after a time.
pub fn by_child(
    program: impl Into<PathBuf>,
    limit: Duration,
) -> impl Fn(&Path, &str) -> Result<(), String> {
    let program = program.into();
    move |file, hash| reported_by_child(&program, file, hash, limit).1
}

/// The child's report on a file, without the lines that announce checks, and the verdict. A folder without code needs no child.
pub fn report_of_child(
    program: &Path,
    file: &Path,
    limit: Duration,
) -> (String, Result<(), String>) {
    if file.is_dir() {
        return match try_here(file, &|_, _| ()) {
            Ok(tried) => (
                lines(&tried).iter().map(|line| format!("{line}\n")).collect(),
                sound(file, &tried),
            ),
            Err(problem) => (String::new(), Err(problem)),
        };
    }
    reported_by_child(program, file, "", limit)
}

/// Checks a file with these bytes.
fn reported_by_child(
    program: &Path,
    file: &Path,
    hash: &str,
    limit: Duration,
) -> (String, Result<(), String>) {
    let orders = Orders::new(hash);
    let Ended { status, out, error } = match run(program, file, &orders, limit) {
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
/// file is given, in any run. A file that cannot be read from or written to the list is checked again.
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

/// Writes the list beside its file, then renames it over that.
fn note(list: &Path, known: &BTreeSet<String>) {
    let text = known.iter().fold(String::new(), |text, passed| text + passed + "\n");
    let beside = list.with_extension(format!("{}.new", std::process::id()));
    let written =
        list.parent().map_or(Ok(()), fs::create_dir_all).and_then(|()| fs::write(&beside, text));
    // A list that cannot be kept costs only a check at the next start.
    let _ = written.and_then(|()| fs::rename(&beside, list));
}

/// Longest output of a child that is stored [bytes]: room for the report of a library with a thousand plugins.
const MOST_SAID: usize = 1 << 20;
/// Interval at which a child is polled.
const POLL: Duration = Duration::from_millis(4);
/// How long its pipes may stay open after it has ended: something that it forked holds them.
const GRACE: Duration = Duration::from_millis(500);
/// Most memory a child may ask for [bytes].
#[cfg(unix)]
const MOST_MEMORY: u64 = 2 << 30;

/// Orders to a child.
#[derive(Clone, Debug, Default, PartialEq)]
struct Orders {
    /// The word it repeats once every check is made; empty where none is asked for.
    pub token: String,
    /// Hash of the bytes that it may open; empty for any.
    pub hash: String,
}

/// How a child ended.
struct Ended {
    /// How it ended; `None` where it took too long.
    pub status: Option<ExitStatus>,
    /// Its standard output.
    pub out: String,
    /// Its standard error.
    pub error: String,
}

impl Orders {
    /// Orders to open these bytes, with a token that no library can know.
    pub fn new(hash: &str) -> Self {
        let random = || RandomState::new().build_hasher().finish();
        Self { token: format!("{:016x}{:016x}", random(), random()), hash: hash.to_owned() }
    }

    /// Reads the orders of this process, which is the child, and takes on its limit of memory; none where a person calls it.
    pub fn received() -> Self {
        if std::io::stdin().is_terminal() {
            return Self::default();
        }
        limit_memory();
        let mut text = String::new();
        // A child without orders signs nothing off.
        let _ = std::io::stdin().take(1024).read_to_string(&mut text);
        let mut lines = text.lines().map(str::to_owned);
        Self { token: lines.next().unwrap_or_default(), hash: lines.next().unwrap_or_default() }
    }

    /// The line of a child that has made every check.
    pub fn signature(&self) -> Option<String> {
        (!self.token.is_empty()).then(|| format!("signed off {}", self.token))
    }
}

/// From here on this process has a limit of memory.
#[cfg(unix)]
pub(in crate::plugins) fn limit_memory() {
    use rustix::process::{Resource, getrlimit, setrlimit};
    let mut limit = getrlimit(Resource::As);
    limit.current = Some(limit.current.map_or(MOST_MEMORY, |now| now.min(MOST_MEMORY)));
    // A system that refuses leaves the limit of time.
    let _ = setrlimit(Resource::As, limit);
}

#[cfg(not(unix))]
fn limit_memory() {}

/// Runs `program plugins check --here FILE` with these orders to its end, or for at most `limit`.
fn run(program: &Path, file: &Path, orders: &Orders, limit: Duration) -> Result<Ended, String> {
    let mut command = Command::new(program);
    command
        .args(["plugins", "check", "--here"])
        .arg(file)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .env("RUST_BACKTRACE", "0");
    #[cfg(unix)]
    std::os::unix::process::CommandExt::process_group(&mut command, 0);
    let mut child =
        command.spawn().map_err(|error| format!("cannot start {}: {error}", program.display()))?;
    if let Some(mut input) = child.stdin.take() {
        // A child that does not listen signs nothing off.
        let _ = writeln!(input, "{}\n{}", orders.token, orders.hash);
    }
    let (out, error) = (Said::by(child.stdout.take()), Said::by(child.stderr.take()));
    let status = wait(&mut child, limit).map_err(|error| error.to_string())?;
    end_group(&child);
    Ok(Ended { status, out: out.text(), error: error.text() })
}

/// Ends the processes that the child has forked.
#[cfg(unix)]
fn end_group(child: &Child) {
    use rustix::process::{Pid, Signal, kill_process_group};
    if let Some(group) = i32::try_from(child.id()).ok().and_then(Pid::from_raw) {
        // As a rule nothing is left.
        let _ = kill_process_group(group, Signal::KILL);
    }
}

#[cfg(not(unix))]
fn end_group(_: &Child) {}

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
        thread::sleep(POLL);
    }
}

/// The output of a pipe, read on a thread of its own so that the child never waits for a reader.
struct Said {
    bytes: Arc<Mutex<Vec<u8>>>,
    /// Closed at the end of the pipe.
    open: Option<Receiver<()>>,
}

impl Said {
    fn by<R: Read + Send + 'static>(pipe: Option<R>) -> Self {
        let bytes = Arc::new(Mutex::new(Vec::new()));
        let open = pipe.map(|mut pipe| {
            let (ends, open) = channel();
            let kept = Arc::clone(&bytes);
            thread::spawn(move || {
                let _ends = ends;
                let mut room = [0_u8; 8192];
                // What cannot be read was not said.
                while let Ok(read @ 1..) = pipe.read(&mut room) {
                    let mut kept = kept.lock().unwrap_or_else(PoisonError::into_inner);
                    let left = MOST_SAID.saturating_sub(kept.len());
                    kept.extend_from_slice(&room[..read.min(left)]);
                }
            });
            open
        });
        Self { bytes, open }
    }

    /// The output until its end, or until the grace period is over.
    fn text(self) -> String {
        if let Some(open) = self.open {
            // Nothing is ever sent: the wait ends as the reader does.
            let _ = open.recv_timeout(GRACE);
        }
        let bytes = self.bytes.lock().unwrap_or_else(PoisonError::into_inner);
        String::from_utf8_lossy(&bytes).into_owned()
    }
}

/// A line for each plugin and each check.
fn lines(tried: &[Tried]) -> Vec<String> {
    let mut lines = Vec::new();
    for Tried { info, findings } in tried {
        lines.push(format!("{}  {}  {}: {}", info.id, info.version, info.kind, info.name));
        let (attributes, acts) =
            (counted(info.attributes.len(), "attribute"), counted(info.acts.len(), "act"));
        lines.push(format!("  {:<10}  ok     {attributes}, {acts}", "declared"));
        for finding in findings {
            let (word, detail) = match &finding.outcome {
                Ok(detail) => ("ok", detail),
                Err(fault) => ("FAULT", fault),
            };
            lines.push(
                format!("  {:<10}  {word:<5}  {detail}", finding.check).trim_end().to_owned(),
            );
        }
    }
    lines
}

fn counted(count: usize, what: &str) -> String {
    if count == 1 { format!("1 {what}") } else { format!("{count} {what}s") }
}
