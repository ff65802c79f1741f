//! The usual weak inserts along whole endlines, asked by no rule.

use endline_gear::Document;

use crate::error::Error;
use crate::plugins::PluginHost;

use super::super::sheet::of_library;
use super::bench::library_with;
use super::{Asked, propose};

/// An assembly's file after an edit.
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
    let gear = of_library(asked.id, depth_m, &library, host)?.gear;
    let failed = |error: String| Error::Replay(error);
    let mut document = Document::parse(asked.text).map_err(|error| failed(error.to_string()))?;
    let edit = propose::usual_inserts(&document, &gear)
        .ok_or_else(|| failed("the gear has no endline that takes inserts".to_owned()))?;
    edit.apply(&mut document).map_err(failed)?;
    Ok(Edited { says: edit.says, text: document.text() })
}
