//! What the thread of a run is asked to do.

use std::path::PathBuf;
use std::sync::Arc;
use std::sync::mpsc::Sender;

use endline_sdk::Controls;
use endline_sim::Frame;

use crate::source::Prepared;

/// All that can be asked of a run.
#[derive(Clone)]
pub enum RunCommand {
    /// Run on, from the newest moment.
    Start,
    /// Stand still.
    Pause,
    /// Take one step, then stand still.
    Step,
    /// Back to the settled gear; what was run is dropped.
    Reset,
    /// Simulated seconds wanted for each real one; infinite for as fast as the solver goes.
    Speed(f64),
    /// The pilot steers: these controls hold until the next.
    Controls(Controls),
    /// The scenario's pilot program steers.
    Autopilot,
    /// Another model, back at the start.
    Load(Box<Prepared>),
    /// Show the moment nearest to a time [s], and stand still; from the newest moment on, that.
    Seek(f64),
    /// Show the moment so many kept frames later, or earlier, and stand still.
    Shift(i64),
    /// Back to the settled gear, then these inputs as fast as it goes, then stand still.
    Inputs(Vec<Controls>),
    /// The inputs of the run up to the moment shown again, then stand still: to go on from there in another way.
    Branch,
    /// Another model, in which the inputs of the run up to the moment shown are run again; then its own pilot program steers.
    Rerun(Box<Prepared>),
    /// Make the run so far a scenario whose pilot program flies it again; controls may be off by this much [1].
    Program(f64),
    /// Save the run so far as a recording.
    SaveRecording(PathBuf),
    /// Hand over the moments that are kept, in order.
    KeptFrames(Sender<Vec<Arc<Frame>>>),
}
