//! The child process that tries a file, as its parent sees it.
//!
//! The child gets its orders on standard input: a token, and the hash of the bytes it may open. It repeats the token once every
//! check is made, so that a library that ends the process early does not pass. It runs in a process group of its own, which
//! ends with it, under a limit of memory and of time; what it forks cannot hold its parent up.

use std::hash::{BuildHasher, Hasher, RandomState};
use std::io::{IsTerminal, Read, Write};
use std::path::Path;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

/// How much of what a child says is kept [bytes]: room for the report of a library with a thousand plugins.
const MOST_SAID: usize = 1 << 20;
/// How often a child is looked at.
const LOOK: Duration = Duration::from_millis(4);
/// How long its pipes may stay open after it has ended: something that it forked holds them.
const GRACE: Duration = Duration::from_millis(500);
/// Most memory a child may ask for [bytes].
#[cfg(unix)]
const MOST_MEMORY: u64 = 2 << 30;

/// What a child is told.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Orders {
    /// What it repeats once every check is made; empty where nobody asks.
    pub token: String,
    /// Hash of the bytes that it may open; empty for any.
    pub hash: String,
}

/// What became of a child.
pub(super) struct Ended {
    /// How it ended; `None` where it took too long.
    pub status: Option<ExitStatus>,
    /// What it said on standard output.
    pub out: String,
    /// What it said on standard error.
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

    /// The line by which a child says that every check was made.
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

/// Runs `program plugins check --here FILE` with these orders to its end, or for at most so long.
///
/// # Errors
/// Where it cannot be started or waited for.
pub(super) fn run(
    program: &Path,
    file: &Path,
    orders: &Orders,
    limit: Duration,
) -> Result<Ended, String> {
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

/// Ends what the child has forked and left behind.
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
        thread::sleep(LOOK);
    }
}

/// What comes out of a pipe, read on a thread of its own so that the child never waits for a reader.
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

    /// What was said until its end, or until the grace is over.
    fn text(self) -> String {
        if let Some(open) = self.open {
            // Nothing is ever sent: the wait ends as the reader does.
            let _ = open.recv_timeout(GRACE);
        }
        let bytes = self.bytes.lock().unwrap_or_else(PoisonError::into_inner);
        String::from_utf8_lossy(&bytes).into_owned()
    }
}
