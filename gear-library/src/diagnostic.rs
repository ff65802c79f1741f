//! Problems in files: where, what, and how to fix them.

use std::fmt;
use std::ops::Range;
use std::sync::Arc;

use crate::limits::{Beyond, EXCERPT_CHARS};

/// How bad a problem is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Severity {
    /// Worth a look; the file still serves.
    Warning,
    /// The file cannot serve as it is.
    Error,
}

/// A problem at a place in a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// File, relative to the library's folder or as the user named it.
    pub file: String,
    /// Line, from 1; 0 where the problem is the file itself.
    pub line: usize,
    /// Column in characters, from 1; 0 where the problem is the file itself.
    pub column: usize,
    /// Dotted path of the field, such as `whale.length`; empty for the file itself.
    pub field: String,
    /// What is wrong.
    pub message: String,
    /// What was expected and how to fix it; may be empty.
    pub help: String,
    /// How bad it is.
    pub severity: Severity,
    /// The offending line, of a long one its first [`EXCERPT_CHARS`] characters; empty where the problem is the file itself.
    pub excerpt: String,
    /// How many characters of the line to underline.
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

    /// Whether the file cannot serve as it is.
    #[must_use]
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
            // Beyond what is shown of a long line there is nothing to underline.
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

/// A place in a file: where a value was read from.
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
    /// The same as a problem at a place.
    #[must_use]
    pub fn at(self, place: &Place) -> Diagnostic {
        place.error(self.message, self.help)
    }
}

fn floor_boundary(text: &str, at: usize) -> usize {
    (0..=at.min(text.len())).rev().find(|at| text.is_char_boundary(*at)).unwrap_or(0)
}

/// A value with the place it was read from.
#[derive(Clone, Debug, PartialEq)]
pub struct At<T> {
    /// The value.
    pub value: T,
    /// Where it stands.
    pub place: Place,
}
