//! Targets by turns, for so long, on several threads; what came of it.

use std::any::Any;
use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};
use std::{fmt, thread};

use crate::mutate::{Dice, damaged};
use crate::targets::{self, Target};
use crate::watch::{self, AtWork, HANGS};

/// Greatest memory of the process [MB].
const MOST_MEMORY_MB: u64 = 2_000;

/// How long, from which seed.
#[derive(Clone, Copy)]
pub struct Campaign {
    pub seed: u64,
    /// How much of each target in a turn.
    pub turn: Turn,
    pub turns: u32,
    pub threads: usize,
}

/// What came of a target.
#[derive(Clone, Debug, Default)]
struct Tally {
    inputs: u64,
    /// Inputs that were read, not refused.
    read: u64,
    slowest: Duration,
}

/// What came of a campaign.
#[derive(Debug, Default)]
pub struct Report {
    tallies: BTreeMap<&'static str, Tally>,
    found: Vec<String>,
    memory_mb: Option<u64>,
}

impl Campaign {
    /// Runs it.
    pub fn run(self) -> Report {
        let done = Arc::new(AtomicBool::new(false));
        let workers: Vec<AtWork> = (0..self.threads).map(|_| AtWork::default()).collect();
        watch::over(workers.clone(), Arc::clone(&done));
        let targets = Arc::new(targets::all());
        let threads: Vec<_> = (0_u64..)
            .zip(workers)
            .map(|(number, worker)| {
                let targets = Arc::clone(&targets);
                let dice =
                    Dice::new(self.seed.wrapping_add(number.wrapping_mul(0x9e37_79b9_7f4a_7c15)));
                thread::spawn(move || self.on_thread(&targets, dice, &worker))
            })
            .collect();
        let mut report = Report::default();
        threads.into_iter().for_each(|thread| report.take(thread.join().unwrap()));
        done.store(true, Ordering::Relaxed);
        report.memory_mb = watch::most_memory_mb();
        report
    }

    fn on_thread(self, targets: &[Target], mut dice: Dice, worker: &AtWork) -> Report {
        let mut report = Report::default();
        for target in targets {
            // What was found before comes first.
            for input in &target.known {
                report.feed(target, input, worker);
            }
        }
        for _ in 0..self.turns {
            for target in targets {
                let (begun, mut fed) = (Instant::now(), 0);
                while self.turn.continues(fed, begun, target.is_slow()) {
                    let input = target.input(&mut dice);
                    report.feed(target, &input, worker);
                    fed += 1;
                }
            }
        }
        report
    }
}

/// How much of a target makes a turn.
#[derive(Clone, Copy)]
pub enum Turn {
    /// A number of inputs, and one for slow targets: equal on every machine, however busy.
    Inputs { quick: u32, slow: u32 },
    /// So long.
    Time(Duration),
}

impl Turn {
    fn continues(self, fed: u32, begun: Instant, is_slow: bool) -> bool {
        match self {
            Self::Inputs { quick, slow } => fed < if is_slow { slow } else { quick },
            Self::Time(time) => begun.elapsed() < time,
        }
    }
}

impl Target {
    /// Whether an input takes seconds: whole models are made of it.
    fn is_slow(&self) -> bool {
        matches!(self.name, "scenario" | "stepped" | "gltf")
    }

    fn input(&self, dice: &mut Dice) -> Vec<u8> {
        let [one, other] = [0, 1].map(|_| &self.seeds[dice.below(self.seeds.len())]);
        match self.damage {
            Some(damage) => damage(one, dice),
            None => damaged(one, other, dice),
        }
    }
}

impl Report {
    fn feed(&mut self, target: &Target, input: &[u8], worker: &AtWork) {
        worker.begin(target.name, input);
        let done = catch_unwind(AssertUnwindSafe(|| (target.feed)(input)));
        let took = worker.end();
        let tally = self.tallies.entry(target.name).or_default();
        tally.inputs += 1;
        tally.slowest = tally.slowest.max(took);
        let wrong = match done {
            Ok(Ok(was_read)) => {
                tally.read += u64::from(was_read);
                (took > HANGS).then(|| format!("took {:.1} s", took.as_secs_f64()))
            }
            Ok(Err(wrong)) => Some(wrong),
            Err(panic) => Some(format!("panicked: {}", said(&*panic))),
        };
        if let Some(wrong) = wrong {
            let file = watch::keep(target.name, input);
            self.found.push(format!("{}: {wrong}: {}", target.name, file.display()));
        }
    }

    fn take(&mut self, other: Self) {
        for (name, tally) in other.tallies {
            let own = self.tallies.entry(name).or_default();
            own.inputs += tally.inputs;
            own.read += tally.read;
            own.slowest = own.slowest.max(tally.slowest);
        }
        self.found.extend(other.found);
    }

    /// Inputs in all.
    pub fn inputs(&self) -> u64 {
        self.tallies.values().map(|tally| tally.inputs).sum()
    }

    /// Whether nothing was found, and memory stayed within its bound.
    pub fn is_clean(&self) -> bool {
        self.found.is_empty() && self.memory_mb.is_none_or(|mb| mb <= MOST_MEMORY_MB)
    }
}

fn said(panic: &(dyn Any + Send)) -> String {
    let text = panic.downcast_ref::<String>().map(String::as_str);
    text.or_else(|| panic.downcast_ref::<&str>().copied()).unwrap_or("without a word").to_owned()
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{:<12} {:>12} {:>12} {:>10}", "target", "inputs", "read", "slowest")?;
        for (name, Tally { inputs, read, slowest }) in &self.tallies {
            writeln!(f, "{name:<12} {inputs:>12} {read:>12} {:>8.2} s", slowest.as_secs_f64())?;
        }
        let memory = self.memory_mb.map_or_else(|| "unknown".to_owned(), |mb| format!("{mb} MB"));
        writeln!(f, "{} inputs, {} found, most memory {memory}", self.inputs(), self.found.len())?;
        self.found.iter().try_for_each(|found| writeln!(f, "  {found}"))
    }
}
