//! Previews of rigs on a thread of their own: the newest request is answered, earlier ones are
//! dropped.

use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, channel};

use endline_gear::Library;

use crate::edit::problems;
use crate::error::Error;
use crate::plugins::PluginHost;
use crate::task::Waker;

use super::{RigAtRest, TrialGear, TrialSea, alone, settled};

/// One rig in one sea.
#[derive(Clone, Debug, PartialEq)]
pub struct Trial {
    /// The gear.
    pub gear: TrialGear,
    /// Its sea.
    pub sea: TrialSea,
}

/// The result of a trial: the rig at rest, or why there is none.
pub type Answer = Result<Arc<RigAtRest>, String>;

/// The result of one trial of a request.
struct Answered {
    /// Number of the request.
    number: u64,
    /// Index of the trial in it.
    index: usize,
    answer: Answer,
}

/// The thread: requests go in, answers come out.
struct Channels {
    requests: Sender<Request>,
    answers: Receiver<Answered>,
}

/// Trials requested together.
struct Request {
    number: u64,
    scenario: String,
    library: Arc<Library>,
    trials: Vec<Trial>,
}

/// Settles rigs in the background. A new request replaces the one in progress.
#[derive(Default)]
pub struct StaticsWorker {
    channels: Option<Channels>,
    number: u64,
    trials: Vec<Trial>,
    answers: Vec<Option<Answer>>,
    /// The last rest of the same gear, shown until there is a newer one.
    last: Vec<Option<Arc<RigAtRest>>>,
}

impl StaticsWorker {
    /// Requests trials in the sea of a scenario's text; those in progress are dropped.
    pub fn ask(
        &mut self,
        scenario: &str,
        library: &Arc<Library>,
        trials: Vec<Trial>,
        host: &Arc<PluginHost>,
        waker: &Waker,
    ) {
        self.number += 1;
        let same = |index: usize| {
            self.trials.get(index).is_some_and(|before| before.gear == trials[index].gear)
        };
        self.last = (0..trials.len())
            .map(|index| self.rest(index).filter(|_| same(index)).cloned())
            .collect();
        (self.answers, self.trials) = (vec![None; trials.len()], trials.clone());
        let request = Request {
            number: self.number,
            scenario: scenario.to_owned(),
            library: Arc::clone(library),
            trials,
        };
        if self.channels.is_none() {
            self.channels = open(Arc::clone(host), Arc::clone(waker));
        }
        let sent =
            self.channels.as_ref().is_some_and(|channels| channels.requests.send(request).is_ok());
        if !sent {
            self.channels = None;
            self.answers.iter_mut().for_each(|answer| {
                *answer = Some(Err("the system gives no thread for the statics".into()))
            });
        }
    }

    /// Drops the request in progress; existing answers stay.
    pub fn cancel(&mut self) {
        self.number += 1;
        if let Some(channels) = &self.channels {
            // A thread that has ended has nothing left to drop.
            let nothing = Request {
                number: self.number,
                scenario: String::new(),
                library: Arc::default(),
                trials: Vec::new(),
            };
            let _ = channels.requests.send(nothing);
        }
    }

    /// Takes in answers; called regularly.
    pub fn poll(&mut self) {
        let Some(channels) = &self.channels else { return };
        for Answered { number, index, answer } in channels.answers.try_iter() {
            if let (true, Some(slot)) = (number == self.number, self.answers.get_mut(index)) {
                *slot = Some(answer);
            }
        }
    }

    /// Rest of a trial: of the newest request, or the last one of the same gear while that is in progress or finds no rest.
    pub fn rest(&self, index: usize) -> Option<&Arc<RigAtRest>> {
        let now = self.newest(index).and_then(|answer| answer.as_ref().ok());
        now.or_else(|| self.last.get(index).and_then(Option::as_ref))
    }

    /// Answer of a trial of the newest request alone.
    pub fn newest(&self, index: usize) -> Option<&Answer> {
        self.answers.get(index).and_then(Option::as_ref)
    }

    /// How many trials are answered, and how many were requested.
    pub fn progress(&self) -> (usize, usize) {
        (self.answers.iter().flatten().count(), self.answers.len())
    }
}

fn open(host: Arc<PluginHost>, waker: Waker) -> Option<Channels> {
    let (sender, requests) = channel();
    let (answering, answers) = channel();
    let work = move || work(&requests, &answering, &host, &waker);
    std::thread::Builder::new().name("endline-statics".into()).spawn(work).ok()?;
    Some(Channels { requests: sender, answers })
}

/// Settles the requests until the worker is dropped.
fn work(
    requests: &Receiver<Request>,
    answers: &Sender<Answered>,
    host: &PluginHost,
    waker: &Waker,
) {
    while let Ok(first) = requests.recv() {
        let mut request = requests.try_iter().last().unwrap_or(first);
        let mut next = 0;
        while let Some(trial) = request.trials.get(next) {
            let answer = answer(&request, trial, host);
            let answered = Answered { number: request.number, index: next, answer };
            if answers.send(answered).is_err() {
                return;
            }
            waker();
            next += 1;
            if let Some(newer) = requests.try_iter().last() {
                (request, next) = (newer, 0);
            }
        }
    }
}

fn answer(request: &Request, trial: &Trial, host: &PluginHost) -> Answer {
    let reason = |error: Error| match error {
        Error::Diagnostics(all) => all.first().map_or_else(String::new, problems::message),
        other => other.to_string(),
    };
    let text =
        alone(&request.scenario, &trial.gear, &trial.sea, &request.library).map_err(reason)?;
    settled(trial.gear.name(), &text, &request.library, host).map(Arc::new).map_err(reason)
}
