//! Sources by number: a page names each once, at its foot, and its figures name the number.

use super::cell::{Cell, Line};

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
    fn a_source_has_one_number_and_stands_once() {
        let mut citations = Citations::default();
        let marks = ["a law", "a table", "a law"].map(|source| citations.mark(source));
        assert_eq!(marks, ["[1]", "[2]", "[1]"]);
        assert_eq!(citations.listed(), ["[1] a law", "[2] a table"]);
    }
}
