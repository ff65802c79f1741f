//! The usual weak inserts along whole endlines, asked by no rule.

use endline_gear::{Document, Library, Options, Scenario, assemble_traced};

use crate::error::Error;
use crate::plugins::PluginHost;
use crate::statics::preview::{TrialGear, TrialSea, alone};

use super::super::gear::Gear;
use super::super::sheet::of_library;
use super::super::walk::gear_of;
use super::trials::library_with;
use super::{Asked, propose};

/// A file of gear after an edit.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Edited {
    /// What was done, in a sentence.
    pub says: String,
    /// The file.
    pub text: String,
}

/// An assembly with weak inserts of 3 ft every 60 ft over the top three quarters of each endline, counted from the buoy through
/// all the lines that the endline is made of. Gear is laid in water of `depth_m`, or of the usual depth [m].
///
/// # Errors
/// Every located error of the assembly; gear without an endline that takes inserts.
pub fn usual_inserts(
    asked: Asked<'_>,
    depth_m: Option<f64>,
    host: &PluginHost,
) -> Result<Edited, Error> {
    let library = library_with(asked.id, asked.text, asked.sources.clone())?;
    put_into(asked.text, &of_library(asked.id, depth_m, &library, host)?.gear)
}

/// The same for a scenario that is made of parts of its own.
///
/// # Errors
/// Every located error of the scenario; gear without an endline that takes inserts.
pub fn usual_inserts_of_own(
    scenario: &str,
    library: &Library,
    host: &PluginHost,
) -> Result<Edited, Error> {
    let text = alone(scenario, &TrialGear::Own, &TrialSea::default(), library)?;
    let read = Scenario::read("scenario", &text).map_err(Error::Diagnostics)?;
    let made = assemble_traced(&read, library, host, &Options::default());
    put_into(scenario, &gear_of(&made.map_err(Error::Diagnostics)?, library))
}

/// A file of gear with the usual inserts.
fn put_into(text: &str, gear: &Gear) -> Result<Edited, Error> {
    let failed = |error: String| Error::Message(error);
    let mut document = Document::parse(text).map_err(|error| failed(error.to_string()))?;
    let edit = propose::usual_inserts(&document, gear)
        .ok_or_else(|| failed("the gear has no endline that takes inserts".to_owned()))?;
    edit.apply(&mut document).map_err(failed)?;
    Ok(Edited { says: edit.says, text: document.text() })
}
