//! One process that serves a library, as the program sees it: started, asked, and ended where it hangs.

use std::io::{self, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::thread;
use std::time::{Duration, Instant};

use rustix::process::{Pid, Signal, kill_process_group};

use super::frame::{receive, send};
use super::message::{Answer, Opening, Orders, Question};
use super::pipe::Pipe;
use super::wire::Wire;

/// How long a call may take, of the time in which this program runs.
const PATIENCE: Duration = Duration::from_secs(10);
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
    input: Pipe,
    output: BufReader<Pipe>,
    room: Vec<u8>,
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
        let pipes = Pipe::new(input, Some(PATIENCE))
            .and_then(|input| Ok((input, Pipe::new(output, Some(PATIENCE))?)));
        let (input, output) = pipes.map_err(|error| format!("its pipes fail: {error}"))?;
        let output = BufReader::with_capacity(1 << 16, output);
        let mut worker = Self { child, input, output, room: Vec::new() };
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
        self.input.begin();
        self.output.get_mut().begin();
        let answer = send(question, &mut self.input, &mut self.room)
            .and_then(|()| receive(&mut self.output, &mut self.room));
        answer.map_err(|error| self.why(&error))
    }

    /// Why there was no answer.
    fn why(&mut self, error: &io::Error) -> String {
        match error.kind() {
            io::ErrorKind::TimedOut => {
                let seconds = PATIENCE.as_secs();
                return format!("its process was ended: no answer in {seconds} s");
            }
            io::ErrorKind::InvalidData => {
                return "its process was ended: it said what no plugin says".to_owned();
            }
            _ => {}
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
        // The group has the number of its first process, which the system does not give anew at once.
        if let Some(group) = i32::try_from(self.child.id()).ok().and_then(Pid::from_raw) {
            // One that has ended of itself is not there any more.
            let _ = kill_process_group(group, Signal::KILL);
        }
        // It was killed: the wait takes no time.
        let _ = self.child.wait();
    }
}

/// What a process needs of the environment: where libraries lie, and where they are copied to if no memory takes them.
const ENVIRONMENT: [&str; 4] = ["PATH", "LD_LIBRARY_PATH", "HOME", "XDG_CACHE_HOME"];

/// The command of a process: hardly an environment, a process group of its own, nothing on the terminal.
fn command(program: &Path) -> Command {
    let mut command = Command::new(program);
    command
        .args(["plugins", "serve"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .env_clear()
        .envs(ENVIRONMENT.iter().filter_map(|name| Some((name, std::env::var_os(name)?))));
    std::os::unix::process::CommandExt::process_group(&mut command, 0);
    command
}
