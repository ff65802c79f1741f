//! The scenario that a command is given: a file, an id of the library, or `-` for standard input.

use std::io;
use std::path::Path;

use endline_session::{Overrides, PluginHost, Prepared, locate, prepare, prepare_text};

use super::output::Told;
use super::{Failure, output};

/// Prepares the scenario that the command line names.
pub(super) fn prepared(
    named: &Path,
    library: Option<&Path>,
    host: &PluginHost,
    over: Overrides,
) -> Result<Prepared, Failure> {
    let is_stream = named == Path::new("-");
    if output::is_told(Told::Details) {
        let file = named.is_file().then_some(named);
        if let Ok(folder) = locate::library(file, library) {
            output::detail(&format!("gear library: {}", folder.display()));
        }
    }
    if !is_stream {
        return Ok(prepare(named, library, host, over)?);
    }
    let text = endline_gear::read::stream(io::stdin().lock())
        .map_err(|error| Failure::failed(format!("standard input cannot be read: {error}")))?;
    Ok(prepare_text(("standard input", text), library, host, over)?)
}
