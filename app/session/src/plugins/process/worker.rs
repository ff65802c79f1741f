//! One process that serves a library, as the program sees it: started, asked, watched and ended.

use std::io::{self, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

use rustix::process::{Pid, Signal, kill_process_group};

use super::frame::{receive, send};
use super::message::{Answer, Opening, Orders, Question};
use super::wire::Wire;

/// How often a process at work is looked at.
const TICK: Duration = Duration::from_millis(50);
/// Looks after which a call is taken to hang: ten seconds in which this program runs. One that stands still does not count.
const PATIENCE: u32 = 200;
/// How long a process that has closed its pipes may take to end.
const GRACE: Duration = Duration::from_millis(500);

/// The library that a process serves.
pub(super) struct Served {
    /// The program `endline`.
    pub program: PathBuf,
    /// The library's file, as it is told its own place.
    pub file: PathBuf,
    /// Its bytes, which were hashed and allowed.
    pub bytes: Vec<u8>,
}

/// A process that serves a library.
pub(super) struct Worker {
    child: Child,
    input: ChildStdin,
    output: BufReader<ChildStdout>,
    room: Vec<u8>,
    watch: Arc<Mutex<Watch>>,
}

/// What the thread that watches a process goes by.
struct Watch {
    /// The process group, until it is ended.
    group: Option<Pid>,
    /// Looks since the call under way began; `None` between calls.
    looks: Option<u32>,
    /// Whether it was ended because a call took too long.
    timed_out: bool,
}

impl Worker {
    /// Starts a process and has it open the library.
    ///
    /// # Errors
    /// Where it cannot be started, or ends or hangs as it opens the library.
    pub fn start(served: &Served) -> Result<(Self, Opening), String> {
        let mut child = command(&served.program)
            .spawn()
            .map_err(|error| format!("cannot start {}: {error}", served.program.display()))?;
        let (Some(input), Some(output)) = (child.stdin.take(), child.stdout.take()) else {
            return Err("a process without pipes was started".to_owned());
        };
        let watch = Watch { group: group(&child), looks: None, timed_out: false };
        let watch = Arc::new(Mutex::new(watch));
        let watched = Arc::clone(&watch);
        thread::spawn(move || look_after(&watched));
        let output = BufReader::with_capacity(1 << 16, output);
        let mut worker = Self { child, input, output, room: Vec::new(), watch };
        let opening = worker.exchange(&Orders {
            version: crate::VERSION.to_owned(),
            file: served.file.display().to_string(),
            bytes: served.bytes.clone(),
        })?;
        Ok((worker, opening))
    }

    /// Calls a plugin.
    ///
    /// # Errors
    /// Where the process ended, hangs or says what cannot be understood: it is of no more use.
    pub fn ask(&mut self, question: &Question) -> Result<Answer, String> {
        self.exchange(question)
    }

    fn exchange<A: Wire>(&mut self, question: &impl Wire) -> Result<A, String> {
        lock(&self.watch).looks = Some(0);
        let answer = send(question, &mut self.input, &mut self.room)
            .and_then(|()| receive(&mut self.output, &mut self.room));
        lock(&self.watch).looks = None;
        answer.map_err(|error| self.why(&error))
    }

    /// Why there was no answer.
    fn why(&mut self, error: &io::Error) -> String {
        if lock(&self.watch).timed_out {
            let seconds = TICK.as_secs_f64() * f64::from(PATIENCE);
            return format!("its process was ended: no answer in {seconds:.0} s");
        }
        if error.kind() == io::ErrorKind::InvalidData {
            return "its process was ended: it said what no plugin says".to_owned();
        }
        let start = Instant::now();
        while start.elapsed() < GRACE {
            match self.child.try_wait() {
                Ok(Some(status)) => return format!("its process ended ({status})"),
                Ok(None) => thread::sleep(Duration::from_millis(2)),
                Err(_) => break,
            }
        }
        format!("its process was ended: it closed its pipe ({error})")
    }
}

impl Drop for Worker {
    fn drop(&mut self) {
        end(&mut lock(&self.watch));
        // It was killed: the wait takes no time.
        let _ = self.child.wait();
    }
}

/// The command of a process: no environment but the places of libraries, a process group of its own, nothing on the terminal.
fn command(program: &Path) -> Command {
    let mut command = Command::new(program);
    command
        .args(["plugins", "serve"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .env_clear()
        .envs(
            ["PATH", "LD_LIBRARY_PATH"]
                .iter()
                .filter_map(|name| Some((name, std::env::var_os(name)?))),
        );
    std::os::unix::process::CommandExt::process_group(&mut command, 0);
    command
}

fn group(child: &Child) -> Option<Pid> {
    i32::try_from(child.id()).ok().and_then(Pid::from_raw)
}

/// Ends a process whose call takes too long; returns once it is ended.
fn look_after(watch: &Mutex<Watch>) {
    loop {
        thread::sleep(TICK);
        let mut watch = lock(watch);
        if watch.group.is_none() {
            return;
        }
        if let Some(looks) = &mut watch.looks {
            *looks += 1;
            if *looks > PATIENCE {
                watch.timed_out = true;
                end(&mut watch);
            }
        }
    }
}

/// Ends the process and what it has forked. Its number is free for another process once it was waited for, and is forgotten here.
fn end(watch: &mut Watch) {
    if let Some(group) = watch.group.take() {
        // One that has ended of itself is not there any more.
        let _ = kill_process_group(group, Signal::KILL);
    }
}

fn lock(watch: &Mutex<Watch>) -> std::sync::MutexGuard<'_, Watch> {
    watch.lock().unwrap_or_else(PoisonError::into_inner)
}
