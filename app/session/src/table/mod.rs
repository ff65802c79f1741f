//! Tables of results: rows, columns, CSV; as Parquet files in `parquet`, under a seal (`seal`).

pub(crate) mod parquet;
pub(crate) mod seal;

/// A value of a row.
#[derive(Clone, Debug, PartialEq)]
pub enum Cell {
    /// A whole number.
    Whole(i64),
    /// A number, or none.
    Real(Option<f64>),
    /// A text.
    Text(String),
    /// Yes or no.
    Flag(bool),
}

/// One run: names and values, the same names in every row of a study.
pub type Row = Vec<(String, Cell)>;

/// The values of a column.
#[derive(Clone, Debug, PartialEq)]
pub enum Column {
    /// Whole numbers.
    Whole(Vec<i64>),
    /// Numbers, some of which may be missing.
    Real(Vec<Option<f64>>),
    /// Texts.
    Text(Vec<String>),
    /// Yes or no.
    Flag(Vec<bool>),
}

/// A cell that does not fit its column.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct WrongCell {
    /// Name of the column.
    pub column: String,
    /// Number of the row, from 1.
    pub row: usize,
    /// Kind of the column's cells.
    pub expected: String,
    /// The cell found there.
    pub found: String,
}

impl std::fmt::Display for WrongCell {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { column, row, expected, found } = self;
        write!(f, "column `{column}`, row {row}: expected {expected}, found {found}")
    }
}

impl WrongCell {
    pub(crate) fn new(
        column: &str,
        row: usize,
        expected: impl Into<String>,
        found: impl Into<String>,
    ) -> Self {
        let (expected, found) = (expected.into(), found.into());
        Self { column: column.to_owned(), row: row + 1, expected, found }
    }

    /// A column of another name, or none, where `column` should be.
    pub(crate) fn misplaced(column: &str, row: usize, found: Option<&str>) -> Self {
        let found = found.map_or_else(|| "no cell".to_owned(), |found| format!("`{found}`"));
        Self::new(column, row, "a cell of this column", found)
    }
}

/// Columns of one length, by name.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Table {
    /// Names and values, in order.
    pub columns: Vec<(String, Column)>,
}

impl From<Cell> for Column {
    /// A column of one value; a number that is not finite is missing.
    fn from(cell: Cell) -> Self {
        match cell {
            Cell::Whole(value) => Self::Whole(vec![value]),
            Cell::Real(value) => Self::Real(vec![value.filter(|number| number.is_finite())]),
            Cell::Text(value) => Self::Text(vec![value]),
            Cell::Flag(value) => Self::Flag(vec![value]),
        }
    }
}

impl Column {
    /// Kind of its cells, in words.
    fn kind(&self) -> &'static str {
        match self {
            Self::Whole(_) => "a whole number",
            Self::Real(_) => "a number",
            Self::Text(_) => "a text",
            Self::Flag(_) => "true or false",
        }
    }

    /// Adds the values of another column; `Err` has the kinds expected and found.
    fn extend(&mut self, other: Self) -> Result<(), [&'static str; 2]> {
        match (self, other) {
            (Self::Whole(own), Self::Whole(more)) => own.extend(more),
            (Self::Real(own), Self::Real(more)) => own.extend(more),
            (Self::Text(own), Self::Text(more)) => own.extend(more),
            (Self::Flag(own), Self::Flag(more)) => own.extend(more),
            (own, more) => return Err([own.kind(), more.kind()]),
        }
        Ok(())
    }

    /// The values in a range of rows.
    fn slice(&self, rows: std::ops::Range<usize>) -> Self {
        match self {
            Self::Whole(values) => Self::Whole(values[rows].to_vec()),
            Self::Real(values) => Self::Real(values[rows].to_vec()),
            Self::Text(values) => Self::Text(values[rows].to_vec()),
            Self::Flag(values) => Self::Flag(values[rows].to_vec()),
        }
    }

    /// Number of values.
    pub fn len(&self) -> usize {
        match self {
            Self::Whole(values) => values.len(),
            Self::Real(values) => values.len(),
            Self::Text(values) => values.len(),
            Self::Flag(values) => values.len(),
        }
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// A value in words: as in a CSV file, `nothing` for a missing one.
    pub(crate) fn describe(&self, row: usize) -> String {
        let written = self.written(row);
        if written.is_empty() { "nothing".to_owned() } else { written }
    }

    /// A value as written in a CSV file: nothing where there is none.
    pub fn written(&self, row: usize) -> String {
        match self {
            Self::Whole(values) => values[row].to_string(),
            Self::Real(values) => values[row].map(|number| number.to_string()).unwrap_or_default(),
            Self::Text(values) => quoted(&values[row]),
            Self::Flag(values) => values[row].to_string(),
        }
    }
}

/// A text as CSV wants it (RFC 4180).
fn quoted(text: &str) -> String {
    if text.contains([',', '"', '\n', '\r']) {
        format!("\"{}\"", text.replace('"', "\"\""))
    } else {
        text.to_owned()
    }
}

impl Table {
    /// Rows as columns.
    pub fn of(rows: Vec<Row>) -> Result<Self, WrongCell> {
        let mut table = Self::default();
        for row in rows {
            let columns = row.into_iter().map(|(name, cell)| (name, Column::from(cell))).collect();
            table.append(Self { columns })?;
        }
        Ok(table)
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.columns.first().map_or(0, |(_, column)| column.len())
    }

    /// A column by name.
    pub fn column(&self, name: &str) -> Option<&Column> {
        self.columns.iter().find(|(known, _)| known == name).map(|(_, column)| column)
    }

    /// A range of rows as a table.
    pub(crate) fn slice(&self, rows: std::ops::Range<usize>) -> Self {
        let column = |(name, column): &(String, Column)| (name.clone(), column.slice(rows.clone()));
        Self { columns: self.columns.iter().map(column).collect() }
    }

    /// Adds the rows of another table.
    pub fn append(&mut self, other: Self) -> Result<(), WrongCell> {
        if self.columns.is_empty() {
            *self = other;
            return Ok(());
        }
        let row = self.rows();
        let mut more = other.columns.into_iter();
        for (name, own) in &mut self.columns {
            match more.next() {
                Some((other, values)) if other == *name => own
                    .extend(values)
                    .map_err(|[expected, found]| WrongCell::new(name, row, expected, found))?,
                other => {
                    let found = other.as_ref().map(|(name, _)| name.as_str());
                    return Err(WrongCell::misplaced(name, row, found));
                }
            }
        }
        match more.next() {
            None => Ok(()),
            Some((name, _)) => Err(WrongCell::new(&name, row, "no such column", "a cell")),
        }
    }

    /// The table as comma-separated values with a line of names.
    pub fn csv(&self) -> String {
        let names: Vec<String> = self.columns.iter().map(|(name, _)| quoted(name)).collect();
        let mut text = names.join(",") + "\n";
        for row in 0..self.rows() {
            let cells: Vec<String> =
                self.columns.iter().map(|(_, column)| column.written(row)).collect();
            text += &(cells.join(",") + "\n");
        }
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(number: i64, drawn: Cell) -> Row {
        vec![("encounter".to_owned(), Cell::Whole(number)), ("drawn_depth".to_owned(), drawn)]
    }

    #[test]
    fn a_cell_of_another_kind_is_an_error_at_its_column_and_row() {
        let rows = vec![row(0, Cell::Real(Some(2.0))), row(1, Cell::Text("deep".to_owned()))];
        let error = Table::of(rows).unwrap_err();
        assert_eq!(
            error.to_string(),
            "column `drawn_depth`, row 2: expected a number, found a text"
        );
        let mut table = Table::of(vec![row(0, Cell::Real(None))]).unwrap();
        let other = Table::of(vec![row(1, Cell::Flag(true))]).unwrap();
        let error = table.append(other).unwrap_err();
        assert_eq!(
            error.to_string(),
            "column `drawn_depth`, row 2: expected a number, found true or false"
        );
    }

    #[test]
    fn a_row_with_another_column_is_an_error() {
        let mut short = row(1, Cell::Real(None));
        short.pop();
        let mut long = row(1, Cell::Real(None));
        long.push(("drawn_speed".to_owned(), Cell::Real(None)));
        for (wrong, column) in [(short, "drawn_depth"), (long, "drawn_speed")] {
            let error = Table::of(vec![row(0, Cell::Real(None)), wrong]).unwrap_err();
            assert_eq!((error.column.as_str(), error.row), (column, 2));
        }
    }
}
