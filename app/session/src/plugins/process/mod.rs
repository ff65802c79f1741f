//! A library in a process of its own: it may crash, hang or take memory, and ends a run with a reason, not the program.
//!
//! Plugins keep nothing between calls, so that any process of a library can answer any call. As many are started as calls are made
//! at once; each serves one call at a time over a pipe. One that fails is not used again, and the next call has a new one.
//!
//! | file | content |
//! |---|---|
//! | `serve` | the side of the process |
//! | `sandbox` | the rights it gives up before it answers |
//! | `worker` | the program's side of one process, and its plugins as motion, friction model and gear type |
//! | `message`, `wire` | the messages between the two, and their bytes |
//! | `pipe` | the pipe that carries them |

mod message;
mod pipe;
mod sandbox;
mod serve;
mod wire;
mod worker;

use std::path::Path;
use std::sync::{Arc, Mutex, PoisonError};

use endline_sdk::{Descriptor, HookError};

use super::info::{Hook, Refusal};
use super::library::LoadedLibrary;
use message::{Answer, Call, Declared, Opening, Orders, Question};
use worker::{Served, Worker};

pub use serve::serve_here;

/// Opens a library in a process of its own, which `program plugins serve` is, and gives its plugins.
pub(super) fn open(program: &Path, file: &Path, bytes: Vec<u8>) -> Result<LoadedLibrary, Refusal> {
    let (version, name) = (crate::VERSION.to_owned(), file.display().to_string());
    let orders = Orders { version, file: name, bytes };
    let served = Served { program: program.to_path_buf(), orders };
    let (worker, opening) = Worker::start(&served)
        .map_err(|reason| Refusal::new(reason, "tell the plugin's author"))?;
    let processes = Arc::new(Processes { served, idle: Mutex::new(vec![worker]) });
    match opening {
        Opening::Refused(refusal) => Err(refusal),
        Opening::Opened { about, plugins } => {
            let hooks = (0..).zip(plugins).map(|(place, plugin)| hook(plugin, place, &processes));
            Ok(LoadedLibrary { about, out_of_process: true, hooks: hooks.collect() })
        }
    }
}

fn hook(plugin: Declared, place: u32, processes: &Arc<Processes>) -> Result<Hook, Refusal> {
    let proxy = |descriptor| Proxy { descriptor, place, processes: Arc::clone(processes) };
    match plugin {
        Declared::Motion(descriptor) => Ok(Hook::Motion(Arc::new(proxy(descriptor)))),
        Declared::Friction(descriptor) => Ok(Hook::Friction(Arc::new(proxy(descriptor)))),
        Declared::Gear(descriptor) => Ok(Hook::Gear(Arc::new(proxy(descriptor)))),
        Declared::Refused(refusal) => Err(refusal),
    }
}

/// The processes of a library.
struct Processes {
    served: Served,
    /// Those that wait for a call.
    idle: Mutex<Vec<Worker>>,
}

impl Processes {
    /// Has a call answered by a process that waits, or by a new one.
    fn ask(&self, question: &Question) -> Result<Answer, HookError> {
        let waiting = self.idle.lock().unwrap_or_else(PoisonError::into_inner).pop();
        let mut worker = match waiting {
            Some(worker) => worker,
            None => Worker::start(&self.served).map_err(HookError::new)?.0,
        };
        let answer = worker.exchange(question).map_err(HookError::new)?;
        self.idle.lock().unwrap_or_else(PoisonError::into_inner).push(worker);
        match answer {
            Answer::Fault(message) => Err(HookError::new(message)),
            answer => Ok(answer),
        }
    }
}

/// A plugin in another process.
struct Proxy {
    descriptor: Descriptor,
    place: u32,
    processes: Arc<Processes>,
}

impl Proxy {
    fn ask(&self, call: Call) -> Result<Answer, HookError> {
        self.processes.ask(&Question { plugin: self.place, call })
    }
}
