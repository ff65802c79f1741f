//! `endline docs`: the documents in the terminal.

use std::process::ExitCode;

use super::table::columns;
use super::{Failure, output};
use crate::documents::{self, Document};

/// Prints a document as Markdown, or the documents there are.
pub(super) fn docs(named: Option<&str>) -> Result<ExitCode, Failure> {
    let Some(named) = named else {
        output::print(&listed())?;
        return Ok(ExitCode::SUCCESS);
    };
    let document = documents::find(named).ok_or_else(|| {
        let names: Vec<&str> = documents::all().map(|document| document.name).collect();
        Failure::usage(format!("no document `{named}`; there are {}", names.join(", ")))
    })?;
    output::print(document.text)?;
    Ok(ExitCode::SUCCESS)
}

fn listed() -> String {
    let row = |document: Document| [document.name, document.title].map(str::to_owned).to_vec();
    let mut rows = vec![["document", "about"].map(str::to_owned).to_vec()];
    rows.extend(documents::all().map(row));
    columns(&rows)
}
