//! Checks of a plugin before it is accepted: it answers repeatedly with the same bits and has no hidden memory.
//!
//! | check | content |
//! |---|---|
//! | defaults | one call of each function with its own defaults |
//! | ranges | calls at attributes and inputs drawn at random within their ranges: finite, of the right length, within bounds |
//! | same rig | gear: built again from the same attributes |
//! | same bits | the same calls from the start again |
//! | restore | a run continued from floats saved on the way |
//! | pure | friction: more calls of `respond` within a step change nothing |
//! | energy | friction: over random paths the plugin returns no more energy than it receives |
//! | threads | the same calls on four threads at once |
//! | time | how long a call takes |

mod friction;
mod gear;
mod motion;

use std::time::Instant;

use endline_sdk::{Attribute, AttributeKind, AttributeValue, HookError};

use super::super::info::Hook;

/// The finding of one check.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Finding {
    /// Name of the check.
    pub check: &'static str,
    /// The result, or the failure.
    pub outcome: Result<String, String>,
}

/// Longest a call may take [s]: a run calls a plugin once a step or more.
const LONGEST_CALL_S: f64 = 2e-3;
/// Plays that are timed.
const TIMED_PLAYS: usize = 5;
/// Threads that call at once.
const THREADS: usize = 4;

/// Checks a plugin; `begin` receives the name of each check before it begins. Where its own defaults fail, no other check is made.
pub(super) fn run(hook: &Hook, begin: &dyn Fn(&'static str)) -> Vec<Finding> {
    let mut trial = Trial { begin, findings: Vec::new() };
    match hook {
        Hook::Motion(motion) => motion::run(motion.as_ref(), &mut trial),
        Hook::Friction(friction) => friction::run(friction.as_ref(), &mut trial),
        Hook::Gear(gear) => gear::run(gear.as_ref(), &mut trial),
    }
    trial.findings
}

/// The checks of one plugin so far.
struct Trial<'a> {
    begin: &'a dyn Fn(&'static str),
    findings: Vec<Finding>,
}

impl Trial<'_> {
    /// Makes a check and records its finding; returns whether it passed.
    fn check(
        &mut self,
        check: &'static str,
        work: impl FnOnce() -> Result<String, String>,
    ) -> bool {
        (self.begin)(check);
        let outcome = work();
        let sound = outcome.is_ok();
        self.findings.push(Finding { check, outcome });
        sound
    }

    /// Records the time of a call: the fastest of a few series of `calls` calls, so that a busy machine causes no failure.
    fn time(&mut self, each: &str, calls: usize, play: impl Fn() -> Result<(), HookError>) {
        self.check("time", || {
            let mut fastest = f64::INFINITY;
            for _ in 0..TIMED_PLAYS {
                let start = Instant::now();
                play().map_err(|error| error.message)?;
                fastest = fastest.min(start.elapsed().as_secs_f64() / calls as f64);
            }
            let taken = format!("{:.2} µs {each}", 1e6 * fastest);
            if fastest <= LONGEST_CALL_S {
                Ok(taken)
            } else {
                Err(format!("takes {taken}, more than {:.0} ms", 1e3 * LONGEST_CALL_S))
            }
        });
    }
}

/// An answer as bits, to be compared with another.
type Bits = Vec<u64>;

fn bits(values: impl IntoIterator<Item = f64>) -> impl Iterator<Item = u64> {
    values.into_iter().map(f64::to_bits)
}

/// Repeats the same calls, and continues from floats saved half way, which `play` takes; records the first difference.
fn plays_again(
    trial: &mut Trial<'_>,
    first: &Play,
    play: impl Fn(Option<&[f64]>) -> Result<Play, HookError>,
) {
    trial.check("same bits", || {
        let again = play(None).map_err(|error| error.message)?;
        match first_difference(&first.answers, &again.answers) {
            None => Ok(format!("the same {} calls again", first.answers.len())),
            Some(call) => {
                Err(format!("call {call} gave other bits the second time: it keeps something besides its floats, or asks clock or chance"))
            }
        }
    });
    trial.check("restore", || {
        let rest = play(Some(&first.half_way)).map_err(|error| error.message)?;
        match first_difference(&first.answers[first.answers.len() - rest.answers.len()..], &rest.answers) {
            None => Ok(format!("the same answers after its {} floats were restored half way", first.half_way.len())),
            Some(call) => {
                Err(format!("its state does not restore: from the floats saved on the way, call {call} gave other bits; it keeps something besides its floats"))
            }
        }
    });
}

/// Calls in a row: each answer, and the floats half way.
struct Play {
    answers: Vec<Bits>,
    half_way: Vec<f64>,
}

impl Play {
    /// Calls `step` with each of these steps and the state, `floats` long, whose answer it returns; begins half way where floats that
    /// were saved there are given.
    fn of<S>(
        steps: &[S],
        floats: usize,
        restored: Option<&[f64]>,
        mut step: impl FnMut(usize, &S, &mut Vec<f64>) -> Result<Bits, HookError>,
    ) -> Result<Self, HookError> {
        let middle = steps.len() / 2;
        let mut state = restored.map_or_else(|| vec![0.0; floats], <[f64]>::to_vec);
        let mut half_way = state.clone();
        let mut answers = Vec::with_capacity(steps.len());
        for (number, one) in steps.iter().enumerate().skip(restored.map_or(0, |_| middle)) {
            if number == middle {
                half_way.clone_from(&state);
            }
            answers.push(step(number, one, &mut state)?);
        }
        Ok(Self { answers, half_way })
    }
}

fn first_difference(one: &[Bits], other: &[Bits]) -> Option<usize> {
    one.iter().zip(other).position(|(one, other)| one != other).map(|place| place + 1)
}

/// Repeats the calls on several threads at once.
fn on_threads(
    first: &Play,
    play: impl Fn() -> Result<Play, HookError> + Sync,
) -> Result<String, String> {
    let plays: Vec<_> = std::thread::scope(|scope| {
        let handles: Vec<_> = (0..THREADS).map(|_| scope.spawn(&play)).collect();
        handles
            .into_iter()
            .map(|handle| handle.join().map_err(|_| "a thread failed".to_owned()))
            .collect()
    });
    for play in plays {
        let play = play?.map_err(|error| error.message)?;
        if first_difference(&first.answers, &play.answers).is_some() {
            return Err(format!("gives other bits when {THREADS} threads call it at once"));
        }
    }
    Ok(format!("{THREADS} at once"))
}

/// Attribute values at random within their ranges; of an item of the library the default.
fn drawn(attributes: &[Attribute], random: &mut Random) -> Vec<AttributeValue> {
    let value = |attribute: &Attribute| match &attribute.kind {
        AttributeKind::Number { min, max, .. } => {
            AttributeValue::Number(random.between(*min, *max))
        }
        AttributeKind::Count { min, max, .. } => AttributeValue::Number(random.whole(*min, *max)),
        AttributeKind::Choice { words, .. } => {
            AttributeValue::Choice(words[random.below(words.len())].to_string())
        }
        AttributeKind::Item { default, .. } => AttributeValue::Item(default.to_string()),
    };
    attributes.iter().map(value).collect()
}

fn numbers(values: &[AttributeValue]) -> Vec<f64> {
    values.iter().filter_map(AttributeValue::number).collect()
}

fn defaults(attributes: &[Attribute]) -> Vec<AttributeValue> {
    attributes.iter().map(Attribute::default_value).collect()
}

struct Random(pub u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    /// From `least` to `most`.
    pub fn between(&mut self, least: f64, most: f64) -> f64 {
        least + (most - least) * (self.next() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// A whole number from `least` to `most`, both counted.
    pub fn whole(&mut self, least: u32, most: u32) -> f64 {
        self.between(f64::from(least), f64::from(most) + 1.0).floor().min(f64::from(most))
    }

    /// An index below `count`.
    pub fn below(&mut self, count: usize) -> usize {
        (self.next() % count.max(1) as u64) as usize
    }

    /// Between two powers of ten, evenly by order of magnitude.
    pub fn order(&mut self, least: f64, most: f64) -> f64 {
        libm::exp10(self.between(least, most))
    }

    pub fn vector(&mut self, size: f64) -> [f64; 3] {
        std::array::from_fn(|_| self.between(-size, size))
    }

    /// A unit vector.
    pub fn direction(&mut self) -> [f64; 3] {
        loop {
            if let Some(unit) = unit(self.vector(1.0)) {
                return unit;
            }
        }
    }

    /// A unit vector across a unit normal.
    pub fn tangent(&mut self, normal: [f64; 3]) -> [f64; 3] {
        loop {
            if let Some(unit) = unit(across(normal, self.direction())) {
                return unit;
            }
        }
    }
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// The part of a vector across a unit normal.
fn across(normal: [f64; 3], vector: [f64; 3]) -> [f64; 3] {
    let along = dot(normal, vector);
    std::array::from_fn(|i| vector[i] - along * normal[i])
}

fn unit(vector: [f64; 3]) -> Option<[f64; 3]> {
    let length = dot(vector, vector).sqrt();
    (length > 0.1).then(|| vector.map(|part| part / length))
}
