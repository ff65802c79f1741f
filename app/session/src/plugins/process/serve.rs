//! The side of the process: it opens the library whose bytes it receives, and answers calls of its plugins until the pipe closes.
//!
//! Before it answers, it gives up rights that a friction law, a motion or a gear type does not need: more than 2 GB of memory, and
//! those that `sandbox` names. The library's initialisers have run by then; the check has seen them too.

use std::fs::File;
use std::io::{self, BufReader, IsTerminal};
use std::path::Path;
use std::time::Duration;

use endline_sdk::{GearStep, HookError};
use rustix::process::getppid;

use super::super::check::limit_memory;
use super::super::guard::{BLANK, UNWRITTEN};
use super::super::info::{Hook, Refusal};
use super::super::library::LoadedLibrary;
use super::super::loader::open_copy;
use super::message::{Answer, Call, Declared, Opening, Orders, Question, receive, send};
use super::pipe::Pipe;
use super::sandbox;

/// Interval at which a process checks that its program still runs.
const POLL: Duration = Duration::from_secs(1);

/// Serves a library to the program that has started this process, until that program closes the pipe.
pub fn serve_here() -> Result<(), String> {
    if io::stdin().is_terminal() {
        return Err("this is for the program to call, over a pipe".to_owned());
    }
    let broken = |error: io::Error| format!("the pipe to the program is broken: {error}");
    let (mut input, mut output) = own_pipes().map_err(broken)?;
    end_with_parent();
    limit_memory();
    let mut room = Vec::new();
    let orders: Orders = receive(&mut input, &mut room).map_err(broken)?;
    let opened = open(&orders);
    let hooks: Vec<Option<Hook>> = opened
        .as_ref()
        .map(|opened| opened.hooks.iter().map(|hook| hook.clone().ok()).collect())
        .unwrap_or_default();
    send(&opening(opened), &mut output, &mut room).map_err(broken)?;
    drop(orders);
    sandbox::enter();
    loop {
        let question: Question = match receive(&mut input, &mut room) {
            Ok(question) => question,
            Err(error) if error.kind() == io::ErrorKind::UnexpectedEof => return Ok(()),
            Err(error) => return Err(broken(error)),
        };
        let answer = answer(&hooks, question);
        send(&answer, &mut output, &mut room).map_err(broken)?;
    }
}

/// Standard input and output for this process alone; the library's own output is discarded.
fn own_pipes() -> io::Result<(BufReader<Pipe>, Pipe)> {
    let (input, output) = (io::stdin(), io::stdout());
    let (own_input, own_output) = (rustix::io::dup(&input)?, rustix::io::dup(&output)?);
    let nowhere = File::options().read(true).write(true).open("/dev/null")?;
    rustix::stdio::dup2_stdin(&nowhere)?;
    rustix::stdio::dup2_stdout(&nowhere)?;
    let input = BufReader::with_capacity(1 << 16, Pipe::new(own_input, None)?);
    Ok((input, Pipe::new(own_output, None)?))
}

/// Ends this process when its program has ended, even while a library hangs.
fn end_with_parent() {
    let parent = getppid();
    std::thread::spawn(move || {
        while getppid() == parent {
            std::thread::sleep(POLL);
        }
        std::process::exit(1);
    });
}

fn open(orders: &Orders) -> Result<LoadedLibrary, Refusal> {
    if orders.version != crate::VERSION {
        return Err(Refusal::new(
            format!("its process is Endline {}, the program {}", crate::VERSION, orders.version),
            "install the two together",
        ));
    }
    open_copy(Path::new(&orders.file), &orders.bytes)
}

fn opening(opened: Result<LoadedLibrary, Refusal>) -> Opening {
    match opened {
        Ok(LoadedLibrary { about, hooks, .. }) => {
            Opening::Opened { about, plugins: hooks.into_iter().map(declared).collect() }
        }
        Err(refusal) => Opening::Refused(refusal),
    }
}

fn declared(hook: Result<Hook, Refusal>) -> Declared {
    match hook {
        Ok(Hook::Motion(motion)) => Declared::Motion(motion.descriptor().clone()),
        Ok(Hook::Friction(friction)) => Declared::Friction(friction.descriptor().clone()),
        Ok(Hook::Gear(gear)) => Declared::Gear(gear.descriptor().clone()),
        Err(refusal) => Declared::Refused(refusal),
    }
}

fn answer(hooks: &[Option<Hook>], Question { plugin, call }: Question) -> Answer {
    let hook = usize::try_from(plugin).ok().and_then(|place| hooks.get(place)?.as_ref());
    called(hook, call).unwrap_or_else(|error| Answer::Fault(error.message))
}

/// Calls a plugin. Its output holds a mark before the call, by which the program detects values left unwritten.
fn called(hook: Option<&Hook>, call: Call) -> Result<Answer, HookError> {
    match (hook, call) {
        (Some(Hook::Motion(motion)), Call::Move { attributes, input, mut state }) => {
            let output = Box::new(motion.step(&attributes, &input.lent(), &mut state)?);
            Ok(Answer::Moved { output, state })
        }
        (Some(Hook::Friction(law)), Call::Respond { attributes, contacts }) => {
            let mut out = vec![UNWRITTEN; contacts.normal_force_n.len()];
            law.respond(&attributes, &contacts.lent(), &mut out)?;
            Ok(Answer::Responses(out))
        }
        (Some(Hook::Friction(law)), Call::Advance { attributes, contacts }) => {
            let mut out = vec![BLANK; contacts.state.len()];
            law.advance(&attributes, &contacts.lent(), &mut out)?;
            Ok(Answer::Floats(out))
        }
        (Some(Hook::Gear(gear)), Call::Build { attributes, site }) => {
            gear.build(&attributes, &site).map(Answer::Built)
        }
        (
            Some(Hook::Gear(gear)),
            Call::Step { attributes, time_s, dt_s, end_tension_n, mut state },
        ) => {
            let input = GearStep { time_s, dt_s, end_tension_n: &end_tension_n };
            let mut actions = Vec::new();
            gear.step(&attributes, &input, &mut state, &mut actions)?;
            Ok(Answer::Acted { actions, state })
        }
        _ => Err(HookError::new("it has no such function")),
    }
}
