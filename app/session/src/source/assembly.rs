//! One assembly of the library, and scenarios written around it.

use std::path::Path;

use endline_gear::{Diagnostic, Document, Library, Setting, Sources};

use crate::error::Error;
use crate::locate;

/// The id of an assembly, named by its id or its file, the library's files with it among them, and these read.
///
/// # Errors
/// A file that cannot be read, no library, or every located error of the assembly.
pub(crate) fn open_assembly(
    named: &str,
    library: Option<&Path>,
) -> Result<(String, Sources, Library), Error> {
    let path = locate::named(named, "assemblies", library).map_err(Error::Replay)?;
    let root = locate::library(Some(&path), library).map_err(Error::Replay)?;
    let mut sources = Sources::from_folder(&root).map_err(Error::Diagnostics)?;
    let text = std::fs::read_to_string(&path)
        .map_err(|error| Error::at(&path, format!("cannot be read: {error}")))?;
    let id = path.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default();
    let file = format!("assemblies/{id}.toml");
    sources.set(file.as_str(), text);
    let (library, problems) = Library::read(&sources);
    let own: Vec<Diagnostic> =
        problems.into_iter().filter(|problem| problem.is_error() && problem.file == file).collect();
    if !own.is_empty() {
        return Err(Error::Diagnostics(own));
    }
    Ok((id, sources, library))
}

/// The text of a scenario: a head, with settings put into it by field.
///
/// # Errors
/// A head or a field that is no TOML.
pub(crate) fn written(head: &str, settings: &[(&str, Setting)]) -> Result<String, Error> {
    let failed =
        |message: String| Error::Diagnostics(vec![Diagnostic::of_file("scenario", message, "")]);
    let mut document = Document::parse(head).map_err(|error| failed(error.to_string()))?;
    for (field, value) in settings {
        document.put(field, value).map_err(|error| failed(error.to_string()))?;
    }
    Ok(document.text())
}
