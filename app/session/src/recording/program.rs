//! A recorded run as a scenario whose pilot program flies it again, to be edited as text.
//!
//! The program has an entry wherever a recorded control changes, with the very numbers recorded: run with the same
//! gear library, it gives the same bits. Thinned, a control changes only where it would be off by more than a
//! tolerance, or comes to rest.

use std::fmt::Write;

use endline_gear::{Document, EditError};
use endline_sdk::{Act, Controls};

use super::Recording;
use crate::error::Error;
use crate::plugins::PluginHost;
use crate::source::Overrides;

/// A scenario made of a recording.
#[derive(Clone, Debug, PartialEq)]
pub struct Program {
    /// Text of the scenario.
    pub scenario: String,
    /// Entries of its pilot program.
    pub entries: usize,
    /// What `endline run` must be given besides the scenario for the same bits, such as `--seed 3`; may be empty.
    pub options: String,
}

/// The recorded scenario with the recorded inputs as its pilot program; controls may be off by `thin` [1], acts never.
///
/// # Errors
/// A recording whose inputs were changed, whose model cannot be made here, or that has no whale.
pub fn program(recording: &Recording, host: &PluginHost, thin: f64) -> Result<Program, Error> {
    if let Some(damage) = &recording.damage {
        return Err(Error::Replay(damage.clone()));
    }
    let prepared = recording.source.clone().prepare(host)?;
    let Some(whale) = &prepared.model.spec.whale else {
        return Err(Error::Replay(
            "the recorded scenario has no whale, so nothing was flown".into(),
        ));
    };
    let changes = changes(&recording.inputs, thin);
    let mut scenario = without_pilot(recording)?;
    let options = options(&recording.source.overrides, recording.header.unsettled);
    let _ = write!(
        scenario,
        "\n# Flown: {} steps of {} s; run with: endline run FILE{options}\n",
        recording.inputs.len(),
        recording.header.dt_s
    );
    for change in &changes {
        scenario.push_str(&entry(change, recording.header.dt_s, &whale.motion.descriptor().acts));
    }
    Ok(Program { scenario, entries: changes.len(), options })
}

/// Controls that change at a step.
struct Change {
    step: usize,
    /// Number of each control that changes, by its place in [`Controls::NAMES`].
    to: Vec<(usize, f64)>,
}

/// Where controls change by more than `thin`, or come to rest; all are 0 before the first step.
fn changes(inputs: &[Controls], thin: f64) -> Vec<Change> {
    let mut held = [0.0_f64; Controls::COUNT];
    let mut changes = Vec::new();
    for (step, controls) in inputs.iter().enumerate() {
        let mut to = Vec::new();
        for (index, (held, now)) in held.iter_mut().zip(controls.to_array()).enumerate() {
            let exact = thin <= 0.0 || index == Controls::ACT || now == 0.0;
            if now.to_bits() != held.to_bits() && (exact || (now - *held).abs() > thin) {
                *held = now;
                to.push((index, now));
            }
        }
        if !to.is_empty() {
            changes.push(Change { step, to });
        }
    }
    changes
}

/// The recorded scenario, as long as the recording, without its own pilot program.
fn without_pilot(recording: &Recording) -> Result<String, Error> {
    let as_error = |error: EditError| {
        Error::Replay(format!("the recorded scenario cannot be edited: {error}"))
    };
    let mut document = Document::parse(&recording.source.scenario).map_err(as_error)?;
    if document.has("whale.pilot") {
        document.remove("whale.pilot").map_err(as_error)?;
    }
    let duration_s = seconds(recording.inputs.len(), recording.header.dt_s);
    document.set("duration", &format!("{duration_s} s")).map_err(as_error)?;
    Ok(document.text())
}

/// Time of a step's start, without the last bits of the product [s]; the program meets times to a tenth of a microsecond.
fn seconds(step: usize, dt_s: f64) -> f64 {
    (step as f64 * dt_s * 1e9).round() / 1e9
}

fn entry(change: &Change, dt_s: f64, acts: &[Act]) -> String {
    let mut text = format!("\n[[whale.pilot]]\nat = \"{} s\"\n", seconds(change.step, dt_s));
    for (index, number) in &change.to {
        let name = Controls::NAMES[*index];
        // Writing into a String cannot fail. A float is written with its point, so that -0.0 keeps its sign.
        let _ = match act_id(*index, *number, acts) {
            Some(id) => writeln!(text, "{name} = \"{id}\""),
            None => writeln!(text, "{name} = {number:?}"),
        };
    }
    text
}

/// Id of an act by its number; `None` for the other controls.
fn act_id(control: usize, number: f64, acts: &[Act]) -> Option<&str> {
    (control == Controls::ACT).then(|| {
        let chosen = acts
            .iter()
            .enumerate()
            .find(|(index, _)| ((*index + 1) as f64).to_bits() == number.to_bits());
        chosen.map_or("none", |(_, act)| act.id.as_ref())
    })
}

fn options(over: &Overrides, unsettled: bool) -> String {
    let mut text = String::new();
    let mut add = |option: Option<String>| {
        option.into_iter().for_each(|option| text = format!("{text} {option}"))
    };
    add(over.seed.map(|seed| format!("--seed {seed}")));
    add(over.step_s.map(|step_s| format!("--dt {step_s}")));
    add(over.weak_links.map(|on| format!("--weak-links {}", if on { "on" } else { "off" })));
    add(over.rating_n.map(|rating_n| format!("--rating {rating_n}")));
    add(unsettled.then(|| "--allow-unsettled".to_owned()));
    text
}
