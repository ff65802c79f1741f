//! A run that goes on from a moment of a recording under another pilot.
//!
//! The recorded inputs are stepped through again up to that moment and every step is compared, so that what went
//! before is what was recorded, to the bit; then the scenario's own pilot program steers.

use super::Recording;
use super::replay::{Verdict, compare, refuse_damage, step_at};
use crate::error::Error;
use crate::run::{Run, RunOptions};
use crate::source::Prepared;

/// The recorded run up to a time, in a scenario that differs from the recorded one in its pilot program at most.
///
/// # Errors
/// A recording whose inputs were changed, a time outside it, another step; and a scenario that does not come to the
/// recorded states, with the first step and part that differ.
pub fn take_over(
    recording: &Recording,
    prepared: Prepared,
    options: RunOptions,
    time_s: f64,
    mut progress: impl FnMut(u64, u64),
) -> Result<Run, Error> {
    refuse_damage(recording)?;
    let steps = step_at(recording, time_s)?;
    let (recorded_s, here_s) = (recording.header.dt_s, prepared.model.spec.settings.step_s);
    if recorded_s.to_bits() != here_s.to_bits() {
        return Err(Error::Message(format!(
            "the recording has a step of {recorded_s} s, the scenario one of {here_s} s; give --dt {recorded_s}s"
        )));
    }
    let mut run = Run::new(prepared, options)?;
    let mut tell = |step, steps| {
        progress(step, steps);
        true
    };
    match compare(recording, &mut run, steps, &mut tell) {
        Verdict::Same { .. } => Ok(run),
        Verdict::Differs { step, time_s, part } => Err(Error::Message(format!(
            "the scenario is not the one recorded: at step {step} ({time_s:.3} s) its {part} differs from the recording\n\
             up to the moment taken over, nothing but [[whale.pilot]] may differ"
        ))),
    }
}
