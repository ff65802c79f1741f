//! Problems in files, with place and correction; suggestions for misspelt names.

use std::fmt;
use std::ops::Range;
use std::sync::Arc;

use crate::limits::{Beyond, EXCERPT_CHARS};

/// Severity of a problem.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Severity {
    /// The file can be used.
    Warning,
    /// The file cannot be used.
    Error,
}

/// A problem at a place in a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// File, relative to the library's folder or as the user named it.
    pub file: String,
    /// Line, from 1; 0 for the whole file.
    pub line: usize,
    /// Column in characters, from 1; 0 for the whole file.
    pub column: usize,
    /// Dotted path of the field, such as `whale.length`; empty for the whole file.
    pub field: String,
    /// What is wrong.
    pub message: String,
    /// What was expected and how to fix it; may be empty.
    pub help: String,
    /// Severity.
    pub severity: Severity,
    /// The line, at most [`EXCERPT_CHARS`] characters; empty for the whole file.
    pub excerpt: String,
    /// Number of underlined characters.
    pub width: usize,
}

impl Diagnostic {
    /// A problem of a file as a whole, such as one that cannot be read.
    pub fn of_file(
        file: impl Into<String>,
        message: impl Into<String>,
        help: impl Into<String>,
    ) -> Self {
        Self {
            file: file.into(),
            line: 0,
            column: 0,
            field: String::new(),
            message: message.into(),
            help: help.into(),
            severity: Severity::Error,
            excerpt: String::new(),
            width: 0,
        }
    }

    /// Whether the file cannot be used.
    pub fn is_error(&self) -> bool {
        self.severity == Severity::Error
    }
}

impl fmt::Display for Diagnostic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let kind = if self.is_error() { "error" } else { "warning" };
        if self.line == 0 {
            write!(f, "{}: {kind}: {}", self.file, self.message)?;
        } else {
            write!(f, "{}:{}:{}: {kind}: {}", self.file, self.line, self.column, self.message)?;
            let gutter = " ".repeat(self.line.to_string().len());
            write!(f, "\n {} | {}", self.line, self.excerpt)?;
            // Only the excerpt of a long line is underlined.
            let room = EXCERPT_CHARS.saturating_sub(self.column);
            if self.column <= EXCERPT_CHARS {
                let indent = " ".repeat(self.column.saturating_sub(1));
                let mark = "^".repeat(self.width.clamp(1, room + 1));
                write!(f, "\n {gutter} | {indent}{mark}")?;
            }
        }
        if self.help.is_empty() { Ok(()) } else { write!(f, "\n  = {}", self.help) }
    }
}

/// A file's path and text, shared by all places in it.
#[derive(Debug, PartialEq, Eq)]
pub struct SourceText {
    /// Path as shown to the user.
    pub path: String,
    /// Content.
    pub text: String,
}

/// A place in a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    /// The file.
    pub source: Arc<SourceText>,
    /// Bytes of the text.
    pub span: Range<usize>,
    /// Dotted path of the field.
    pub field: String,
}

impl Place {
    /// An error here.
    pub fn error(&self, message: impl Into<String>, help: impl Into<String>) -> Diagnostic {
        self.problem(Severity::Error, message.into(), help.into())
    }

    /// A warning here.
    pub fn warning(&self, message: impl Into<String>, help: impl Into<String>) -> Diagnostic {
        self.problem(Severity::Warning, message.into(), help.into())
    }

    fn problem(&self, severity: Severity, message: String, help: String) -> Diagnostic {
        let text = &self.source.text;
        let start = floor_boundary(text, self.span.start);
        let line_start = text[..start].rfind('\n').map_or(0, |at| at + 1);
        let line_end = text[start..].find('\n').map_or(text.len(), |at| start + at);
        let end = floor_boundary(text, self.span.end.clamp(start, line_end));
        let line = text[line_start..line_end].trim_end_matches('\r');
        Diagnostic {
            file: self.source.path.clone(),
            line: text[..start].matches('\n').count() + 1,
            column: text[line_start..start].chars().count() + 1,
            field: self.field.clone(),
            message,
            help,
            severity,
            excerpt: line.chars().take(EXCERPT_CHARS).collect(),
            width: text[start..end].chars().take(EXCERPT_CHARS).count(),
        }
    }
}

impl Beyond {
    /// The error at a place.
    pub fn at(self, place: &Place) -> Diagnostic {
        place.error(self.message, self.help)
    }
}

fn floor_boundary(text: &str, at: usize) -> usize {
    (0..=at.min(text.len())).rev().find(|at| text.is_char_boundary(*at)).unwrap_or(0)
}

/// A value with its place in a file.
#[derive(Clone, Debug, PartialEq)]
pub struct At<T> {
    /// The value.
    pub value: T,
    /// Its place.
    pub place: Place,
}

/// The nearest of `known` of which at most a third of the letters differ.
pub fn nearest<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let lower = name.to_lowercase();
    let distance = |other: &str| strsim::damerau_levenshtein(&lower, &other.to_lowercase());
    let near = |other: &&str| distance(other) <= (other.chars().count().max(2)).div_ceil(3);
    known.into_iter().filter(near).min_by_key(|other| distance(other))
}

/// Greatest number of known names that a hint lists.
const MOST_LISTED: usize = 12;

/// Number of names that a hint lists if there are more than [`MOST_LISTED`].
const NEAREST_LISTED: usize = 3;

/// Help on an unknown name: `did you mean …?`, else `known names are …`; of many names the nearest ones.
pub fn hint<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> String {
    let mut known: Vec<&str> = known.into_iter().collect();
    if let Some(meant) = nearest(name, known.iter().copied()) {
        return format!("did you mean `{meant}`?");
    }
    match known.len() {
        0 => "there are no known names".to_owned(),
        count if count <= MOST_LISTED => format!("known names are {}", known.join(", ")),
        count => {
            let lower = name.to_lowercase();
            known.sort_by(|one, other| {
                let likeness = |name: &str| strsim::jaro_winkler(&lower, &name.to_lowercase());
                likeness(other).total_cmp(&likeness(one))
            });
            let nearest = known[..NEAREST_LISTED].join(", ");
            format!("the nearest of {count} known names are {nearest}")
        }
    }
}
