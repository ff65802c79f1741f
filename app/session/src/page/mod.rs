//! What the HTML pages of studies, searches and compliance sheets share: style sheet, tables of cells, numbered sources, and pictures
//! as SVG (`svg`). Cells are plain text: `assets/report/parts.html` writes them as HTML and escapes every text.

pub(crate) mod svg;

/// The style sheet of a page.
pub(crate) const STYLE: &str =
    include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/../../assets/report/report.css"));

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

/// Sources in the order in which they are first named.
#[derive(Default)]
pub(crate) struct Citations(Vec<String>);

impl Citations {
    /// The mark of a source, `[1]` for the first.
    pub(crate) fn mark(&mut self, source: &str) -> String {
        let known = self.0.iter().position(|known| known == source);
        let place = known.unwrap_or_else(|| {
            self.0.push(source.to_owned());
            self.0.len() - 1
        });
        format!("[{}]", place + 1)
    }

    /// The mark of a source and how sure it is.
    pub(crate) fn cell(&mut self, source: &str, confidence: &str) -> Cell {
        Cell { lines: vec![Line::Small(format!("{} {confidence}", self.mark(source)))] }
    }

    /// Every source, with its mark.
    pub(crate) fn listed(self) -> Vec<String> {
        (1..).zip(self.0).map(|(number, source)| format!("[{number}] {source}")).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_source_has_one_number_and_is_listed_once() {
        let mut citations = Citations::default();
        let marks = ["a law", "a table", "a law"].map(|source| citations.mark(source));
        assert_eq!(marks, ["[1]", "[2]", "[1]"]);
        assert_eq!(citations.listed(), ["[1] a law", "[2] a table"]);
    }
}
