//! A recorded run as a scenario whose pilot program flies it again, to be edited as text.
//!
//! The program has an entry at each change of a recorded control, with exactly the recorded numbers:
//! with the same gear library, the run has the same bits. A thinned program changes a control only
//! where the control would be off by more than a tolerance, or where it becomes zero.

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
    /// Options of `endline run` for the same bits, such as `--seed 3`; may be empty.
    pub options: String,
}

/// The recorded scenario with the recorded inputs as its pilot program; controls may be off by `thin` [1], acts never.
pub fn program(recording: &Recording, host: &PluginHost, thin: f64) -> Result<Program, Error> {
    if let Some(damage) = &recording.damage {
        return Err(Error::Message(damage.clone()));
    }
    let prepared = recording.source.clone().prepare(host)?;
    let Some(whale) = &prepared.model.spec.whale else {
        return Err(Error::Message(
            "the recorded scenario has no whale, so nothing was flown".into(),
        ));
    };
    let changes = changes(&recording.inputs, thin);
    let options = options(&recording.source.overrides, recording.header.unsettled);
    let mut scenario = without_pilot(recording, &options).map_err(not_edited)?;
    let (dt_s, acts) = (recording.header.dt_s, &whale.motion.descriptor().acts);
    for change in &changes {
        add_entry(&mut scenario, change, dt_s, acts).map_err(not_edited)?;
    }
    Ok(Program { scenario: scenario.text(), entries: changes.len(), options })
}

/// Controls that change at a step.
struct Change {
    step: usize,
    /// Number of each control that changes, by its place in [`Controls::NAMES`].
    to: Vec<(usize, f64)>,
}

/// Where controls change by more than `thin`, or settle; all are 0 before the first step.
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

fn not_edited(error: EditError) -> Error {
    Error::Message(format!("the recorded scenario cannot be edited: {error}"))
}

/// The recorded scenario, as long as the recording, without its own pilot program. A comment at its
/// head names the recording and the command that runs it.
fn without_pilot(recording: &Recording, options: &str) -> Result<Document, EditError> {
    let (steps, dt_s) = (recording.inputs.len(), recording.header.dt_s);
    let head = format!("# Flown: {steps} steps of {dt_s} s; run with: endline run FILE{options}");
    // A scenario that was itself made of a recording has such a comment already.
    let before = &recording.source.scenario;
    let rest = match before.split_once('\n') {
        Some((first, rest)) if first.starts_with("# Flown:") => rest,
        _ => before,
    };
    let mut document = Document::parse(&format!("{head}\n{rest}"))?;
    if document.has("whale.pilot") {
        document.remove("whale.pilot")?;
    }
    document.set("duration", &format!("{} s", seconds(steps, dt_s)))?;
    Ok(document)
}

/// Time of a step's start, without the last bits of the product [s]; the program meets times to a tenth of a microsecond.
fn seconds(step: usize, dt_s: f64) -> f64 {
    (step as f64 * dt_s * 1e9).round() / 1e9
}

/// Adds the entry of a change to the pilot program.
fn add_entry(
    scenario: &mut Document,
    change: &Change,
    dt_s: f64,
    acts: &[Act],
) -> Result<(), EditError> {
    let mut fields = vec![("at", format!("{} s", seconds(change.step, dt_s)))];
    fields.extend(change.to.iter().map(|(index, number)| {
        // A float is written with its point, so that -0.0 keeps its sign.
        let value =
            act_id(*index, *number, acts).map_or_else(|| format!("{number:?}"), str::to_owned);
        (Controls::NAMES[*index], value)
    }));
    let fields: Vec<(&str, &str)> =
        fields.iter().map(|(key, text)| (*key, text.as_str())).collect();
    scenario.push_table("whale.pilot", &fields).map(|_| ())
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
    add(over.step_s.map(|step_s| format!("--dt {step_s}s")));
    add(over.weak_links.map(|on| format!("--weak-links {}", if on { "on" } else { "off" })));
    add(over.rating_n.map(|rating_n| format!("--rating {rating_n}N")));
    add(unsettled.then(|| "--allow-unsettled".to_owned()));
    text
}
