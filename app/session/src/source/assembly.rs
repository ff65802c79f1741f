//! One assembly of the library, and scenarios written around it.

use std::path::{Path, PathBuf};

use endline_gear::{Diagnostic, Document, Library, Setting, Sources};

use crate::error::Error;
use crate::locate;

/// The file of an assembly, with the library around it.
pub struct AssemblyFile {
    /// Id of the assembly.
    pub id: String,
    /// Text of its file.
    pub text: String,
    /// The library, this text in it.
    pub sources: Sources,
    /// The library's folder.
    pub root: PathBuf,
}

impl AssemblyFile {
    /// Opens an assembly by its id in the library, or by its file.
    ///
    /// # Errors
    /// A file that cannot be read, or no library.
    pub fn open(named: &str, library: Option<&Path>) -> Result<Self, Error> {
        let path = locate::named(named, "assemblies", library).map_err(Error::Message)?;
        let root = locate::library(Some(&path), library).map_err(Error::Message)?;
        let mut sources = Sources::from_folder(&root).map_err(Error::Diagnostics)?;
        let text = endline_gear::read::text(&path)
            .map_err(|error| Error::at(&path, format!("cannot be read: {error}")))?;
        let id =
            path.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default();
        sources.set(format!("assemblies/{id}.toml"), text.clone());
        Ok(Self { id, text, sources, root })
    }

    /// The library read.
    ///
    /// # Errors
    /// Every located error of the assembly.
    pub fn library(&self) -> Result<Library, Error> {
        library_of(&self.id, &self.sources)
    }
}

/// A library read whose assembly of this id is without error.
///
/// # Errors
/// Every located error of the assembly.
pub(crate) fn library_of(id: &str, sources: &Sources) -> Result<Library, Error> {
    let file = format!("assemblies/{id}.toml");
    let (library, problems) = Library::read(sources);
    let own: Vec<Diagnostic> =
        problems.into_iter().filter(|problem| problem.is_error() && problem.file == file).collect();
    if own.is_empty() { Ok(library) } else { Err(Error::Diagnostics(own)) }
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
