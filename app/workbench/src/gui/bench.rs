//! Statics on a thread of its own while gear is edited: what is asked last is answered, what it replaces is dropped.

use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, channel};

use endline_gear::Library;
use endline_session::rest::{Rest, TrialSea, alone, rest};
use endline_session::{Error, PluginHost};

use super::engine::Waker;

/// One rig in one sea.
#[derive(Clone, Debug, PartialEq)]
pub struct Trial {
    /// Id of the assembly.
    pub assembly: String,
    /// Its sea.
    pub sea: TrialSea,
}

/// What came of a trial: gear at rest, or why there is none.
pub type Answer = Result<Arc<Rest>, String>;

/// Requests to the thread, and its answers: number of the request, index of the trial, what came of it.
type Telephone = (Sender<Request>, Receiver<(u64, usize, Answer)>);

/// Trials asked for together.
struct Request {
    number: u64,
    scenario: String,
    library: Arc<Library>,
    trials: Vec<Trial>,
}

/// Rigs settled in the background. A new request takes the place of one under way.
#[derive(Default)]
pub struct Bench {
    line: Option<Telephone>,
    number: u64,
    trials: Vec<Trial>,
    answers: Vec<Option<Answer>>,
    /// Answers of requests before for the same gear, shown until the new ones are there.
    before: Vec<Option<Answer>>,
}

impl Bench {
    /// Asks for trials in the sea of a scenario's text; those under way are dropped.
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
            self.trials.get(index).is_some_and(|before| before.assembly == trials[index].assembly)
        };
        self.before = (0..trials.len())
            .map(|index| self.answer(index).filter(|_| same(index)).cloned())
            .collect();
        (self.answers, self.trials) = (vec![None; trials.len()], trials.clone());
        let request = Request {
            number: self.number,
            scenario: scenario.to_owned(),
            library: Arc::clone(library),
            trials,
        };
        if self.line.is_none() {
            self.line = open(Arc::clone(host), Arc::clone(waker));
        }
        let sent = self.line.as_ref().is_some_and(|(sender, _)| sender.send(request).is_ok());
        if !sent {
            self.line = None;
            self.answers.iter_mut().for_each(|answer| {
                *answer = Some(Err("the system gives no thread for the statics".into()))
            });
        }
    }

    /// Drops what is under way; answers that are there stay.
    pub fn cancel(&mut self) {
        self.number += 1;
        if let Some((sender, _)) = &self.line {
            // A thread that is gone has nothing left to drop.
            let nothing = Request {
                number: self.number,
                scenario: String::new(),
                library: Arc::default(),
                trials: Vec::new(),
            };
            let _ = sender.send(nothing);
        }
    }

    /// Takes in answers; once a frame.
    pub fn poll(&mut self) {
        let Some((_, answers)) = &self.line else { return };
        for (number, index, answer) in answers.try_iter() {
            if let (true, Some(slot)) = (number == self.number, self.answers.get_mut(index)) {
                *slot = Some(answer);
            }
        }
    }

    /// Answer of a trial: of the newest request, or of the one before while that is under way.
    #[must_use]
    pub fn answer(&self, index: usize) -> Option<&Answer> {
        let now = self.answers.get(index).and_then(Option::as_ref);
        now.or_else(|| self.before.get(index).and_then(Option::as_ref))
    }

    /// Answer of a trial of the newest request alone.
    #[must_use]
    pub fn newest(&self, index: usize) -> Option<&Answer> {
        self.answers.get(index).and_then(Option::as_ref)
    }

    /// Trials answered, and asked for.
    #[must_use]
    pub fn progress(&self) -> (usize, usize) {
        (self.answers.iter().flatten().count(), self.answers.len())
    }
}

fn open(host: Arc<PluginHost>, waker: Waker) -> Option<Telephone> {
    let (sender, requests) = channel();
    let (answering, answers) = channel();
    let work = move || work(&requests, &answering, &host, &waker);
    std::thread::Builder::new().name("endline-statics".into()).spawn(work).ok()?;
    Some((sender, answers))
}

/// Settles what is asked for until nobody asks any more.
fn work(
    requests: &Receiver<Request>,
    answers: &Sender<(u64, usize, Answer)>,
    host: &PluginHost,
    waker: &Waker,
) {
    while let Ok(first) = requests.recv() {
        let mut request = requests.try_iter().last().unwrap_or(first);
        let mut next = 0;
        while let Some(trial) = request.trials.get(next) {
            let answer = answer(&request, trial, host);
            if answers.send((request.number, next, answer)).is_err() {
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
    let told = |error: Error| match error {
        Error::Diagnostics(problems) => {
            problems.first().map_or_else(String::new, super::fields::told)
        }
        other => other.to_string(),
    };
    let text =
        alone(&request.scenario, &trial.assembly, &trial.sea, &request.library).map_err(told)?;
    rest(&trial.assembly, &text, &request.library, host).map(Arc::new).map_err(told)
}
