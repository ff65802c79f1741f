//! A recording: all inputs of a run, and the hash of every state.
//!
//! It holds no states but their hashes; a moment is seen again by running again, which gives the
//! same bits ([`replay`]). The file format is described in `docs/recording.md`.

mod file;
pub mod kept;
pub mod program;
pub mod replay;

use std::io::{self, Write};
use std::path::Path;

use endline_sdk::Controls;
use serde::{Deserialize, Serialize};

use crate::error::Error;
use crate::hash::StateHash;
use crate::plugins::PluginUsed;
use crate::source::Source;

pub(crate) use file::{Rows, bytes};

/// Ending of recording files.
pub const EXTENSION: &str = "endline";

/// A recorded run.
#[derive(Clone, Debug, PartialEq)]
pub struct Recording {
    /// Program, plugins and settings.
    pub header: Header,
    /// The files and options the model was made from.
    pub source: Source,
    /// Controls of each step; where the run was stopped, the last is that of the step refused.
    pub inputs: Vec<Controls>,
    /// Hash of the settled state, then of the state after each step.
    pub hashes: Vec<StateHash>,
    /// Parts found changed since the file was saved; only the inputs may be, as the hash of
    /// each step guards them.
    pub damage: Option<String>,
}

/// Program, plugins and settings of a recording.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Header {
    /// Version of Endline.
    pub program: String,
    /// BLAKE3 of the source, hexadecimal.
    pub model_hash: String,
    /// The plugins of the model.
    pub plugins: Vec<PluginUsed>,
    /// Seed.
    pub seed: u64,
    /// Step between inputs [s].
    pub dt_s: f64,
    /// Whether the run was allowed to start from statics that had not converged.
    pub unsettled: bool,
    /// Why the run stopped before its end, if it did.
    pub stopped: Option<String>,
}

impl Recording {
    /// Steps taken.
    pub fn steps(&self) -> usize {
        self.hashes.len().saturating_sub(1)
    }

    /// Simulated time it covers [s].
    pub fn duration_s(&self) -> f64 {
        self.steps() as f64 * self.header.dt_s
    }

    /// Saves it, so that a crash leaves the old file whole.
    pub fn save(&self, path: &Path) -> Result<(), Error> {
        save(path, |out| self.write(out))
    }

    fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        let inputs = bytes(self.inputs.iter().map(words));
        let hashes = bytes(self.hashes.iter().map(|hash| hash.parts));
        file::write(out, &self.header, &self.source, [&inputs, &hashes])
    }

    /// Loads a recording. Changed inputs do not hinder it: they are reported in `damage`, and
    /// [`replay::verify`] names the first step they change.
    pub fn load(path: &Path) -> Result<Self, Error> {
        let bytes = endline_gear::read::bytes(path).map_err(Error::on(path, "cannot be read"))?;
        file::read(&bytes).map_err(|message| Error::at(path, message))
    }
}

/// Saves a recording as it is written, so that a long run is never in memory as a whole.
pub(crate) fn save_rows(
    path: &Path,
    header: &Header,
    source: &Source,
    rows: [&dyn Rows; 2],
) -> Result<(), Error> {
    save(path, |out| file::write(out, header, source, rows))
}

/// Controls as the words of a row.
pub(crate) fn words(controls: &Controls) -> [u64; Controls::COUNT] {
    controls.to_array().map(f64::to_bits)
}

fn save(path: &Path, write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<(), Error> {
    crate::save::atomically_with(path, write).map_err(Error::on(path, "cannot be written"))
}
