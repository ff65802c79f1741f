//! `[[segments]]`: lines whose segments are shorter or longer than the others'.

use crate::diagnostic::At;
use crate::fields::{Fields, Problems, Range};
use crate::limits;
use crate::tree::Node;
use crate::units::Quantity;

/// Longest segment of some lines.
#[derive(Clone, Debug, PartialEq)]
pub struct LineSegments {
    /// Id of a line, or its begin and `*`.
    pub line: At<String>,
    /// Longest segment [m].
    pub longest_m: f64,
}

impl LineSegments {
    pub(super) fn read(node: &Node, problems: &Problems) -> Option<Self> {
        let fields = Fields::of(node, problems);
        let line = fields.need_text(
            "line",
            "write the id of a line, or its begin and `*`, such as \"endline-*\"",
        );
        let longest =
            fields.need_value("longest", Quantity::Length, Range::Within(&limits::SEGMENT));
        fields.finish();
        Some(Self { line: line?, longest_m: longest?.value })
    }

    /// Whether these are a line's.
    #[must_use]
    pub fn are_of(&self, id: &str) -> bool {
        match self.line.value.strip_suffix('*') {
            Some(begin) => id.starts_with(begin),
            None => id == self.line.value,
        }
    }

    /// Whether one line is named, which must then be there.
    #[must_use]
    pub fn name_one(&self) -> bool {
        !self.line.value.ends_with('*')
    }
}
