//! One process that serves a library: started, called, and ended where it hangs; its plugins as motion, friction model and gear type.

use std::io::{self, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::thread;
use std::time::{Duration, Instant};

use endline_sdk::{
    AttributeValue, Contacts, Descriptor, FrictionModel, FrictionResponse, GearAction, GearStep,
    GearType, HookError, MotionInput, MotionOutput, Rig, Site, WhaleMotion,
};
use rustix::process::{Pid, Signal, kill_process_group};

use super::Proxy;
use super::message::{Answer, Call, Opening, Orders, receive, send};
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
    /// The library that a process opens.
    pub orders: Orders,
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
        let opening = worker.exchange(&served.orders)?;
        Ok((worker, opening))
    }

    /// Sends a message and receives its answer.
    pub fn exchange<A: Wire>(&mut self, question: &impl Wire) -> Result<A, String> {
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
        // The group has the number of its first process, which the system does not reuse at once.
        if let Some(group) = i32::try_from(self.child.id()).ok().and_then(Pid::from_raw) {
            // One that has ended of itself is not there any more.
            let _ = kill_process_group(group, Signal::KILL);
        }
        // It was killed: the wait takes no time.
        let _ = self.child.wait();
    }
}

/// Environment variables of a process: the paths of libraries, and the folder for copies where no memory file is available.
const ENVIRONMENT: [&str; 4] = ["PATH", "LD_LIBRARY_PATH", "HOME", "XDG_CACHE_HOME"];

/// The command of a process: a minimal environment, a process group of its own, no output on the terminal.
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

impl WhaleMotion for Proxy {
    fn descriptor(&self) -> &Descriptor {
        &self.descriptor
    }

    fn step(
        &self,
        attributes: &[f64],
        input: &MotionInput<'_>,
        state: &mut [f64],
    ) -> Result<MotionOutput, HookError> {
        let attributes = attributes.to_vec();
        let call = Call::Move { attributes, input: Box::new(input.into()), state: state.to_vec() };
        let Answer::Moved { output, state: floats } = self.ask(call)? else { return unasked() };
        fill(state, &floats)?;
        Ok(*output)
    }
}

impl FrictionModel for Proxy {
    fn descriptor(&self) -> &Descriptor {
        &self.descriptor
    }

    fn respond(
        &self,
        attributes: &[f64],
        contacts: &Contacts<'_>,
        out: &mut [FrictionResponse],
    ) -> Result<(), HookError> {
        let (attributes, contacts) = (attributes.to_vec(), Box::new(contacts.into()));
        let Answer::Responses(list) = self.ask(Call::Respond { attributes, contacts })? else {
            return unasked();
        };
        fill(out, &list)
    }

    fn advance(
        &self,
        attributes: &[f64],
        contacts: &Contacts<'_>,
        out: &mut [f64],
    ) -> Result<(), HookError> {
        let (attributes, contacts) = (attributes.to_vec(), Box::new(contacts.into()));
        let Answer::Floats(list) = self.ask(Call::Advance { attributes, contacts })? else {
            return unasked();
        };
        fill(out, &list)
    }
}

impl GearType for Proxy {
    fn descriptor(&self) -> &Descriptor {
        &self.descriptor
    }

    fn build(&self, attributes: &[AttributeValue], site: &Site) -> Result<Rig, HookError> {
        let call = Call::Build { attributes: attributes.to_vec(), site: *site };
        let Answer::Built(rig) = self.ask(call)? else { return unasked() };
        Ok(rig)
    }

    fn step(
        &self,
        attributes: &[AttributeValue],
        input: &GearStep<'_>,
        state: &mut [f64],
        actions: &mut Vec<GearAction>,
    ) -> Result<(), HookError> {
        let GearStep { time_s, dt_s, end_tension_n } = *input;
        let (attributes, end_tension_n) = (attributes.to_vec(), end_tension_n.to_vec());
        let call = Call::Step { attributes, time_s, dt_s, end_tension_n, state: state.to_vec() };
        let Answer::Acted { actions: taken, state: floats } = self.ask(call)? else {
            return unasked();
        };
        fill(state, &floats)?;
        actions.extend(taken);
        Ok(())
    }
}

/// Copies the output of a process to the program's slice.
fn fill<T: Copy>(out: &mut [T], given: &[T]) -> Result<(), HookError> {
    if out.len() != given.len() {
        return unasked();
    }
    out.copy_from_slice(given);
    Ok(())
}

fn unasked<T>() -> Result<T, HookError> {
    Err(HookError::new("its process answered what was not asked"))
}
