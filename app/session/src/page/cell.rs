//! Tables of the report as plain text: `assets/report/parts.html` writes them as HTML and escapes every text.

/// A table with a caption.
pub(crate) struct Table {
    /// What it shows.
    pub caption: String,
    /// Heading of each column.
    pub headings: Vec<String>,
    /// Cells of each row, as many as there are headings.
    pub rows: Vec<Vec<Cell>>,
}

/// A cell: its lines of text.
pub(crate) struct Cell {
    /// From the top.
    pub lines: Vec<Line>,
}

/// A line of text and how it is set.
pub(crate) enum Line {
    /// As running text.
    Plain(String),
    /// Smaller: a source.
    Small(String),
    /// As program text: a field and its value.
    Code(String),
    /// In a frame: how sure a figure is. The word is a class of the style sheet, too.
    Tag(&'static str),
}

impl Table {
    /// A table with these headings.
    pub(crate) fn new(caption: impl Into<String>, headings: &[&str], rows: Vec<Vec<Cell>>) -> Self {
        let headings = headings.iter().map(ToString::to_string).collect();
        Self { caption: caption.into(), headings, rows }
    }
}

impl Cell {
    /// Plain lines.
    pub(crate) fn lines(lines: impl IntoIterator<Item = String>) -> Self {
        Self { lines: lines.into_iter().map(Line::Plain).collect() }
    }
}

impl<T: Into<String>> From<T> for Cell {
    fn from(text: T) -> Self {
        Self::lines([text.into()])
    }
}
