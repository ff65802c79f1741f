//! Rows and columns of results.

/// A value of a row.
#[derive(Clone, Debug, PartialEq)]
pub enum Cell {
    /// A whole number.
    Whole(i64),
    /// A number; none where there is nothing to tell.
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

/// Columns of one length, by name.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Table {
    /// Names and values, in order.
    pub columns: Vec<(String, Column)>,
}

impl Column {
    fn of(cell: &Cell) -> Self {
        match cell {
            Cell::Whole(_) => Self::Whole(Vec::new()),
            Cell::Real(_) => Self::Real(Vec::new()),
            Cell::Text(_) => Self::Text(Vec::new()),
            Cell::Flag(_) => Self::Flag(Vec::new()),
        }
    }

    fn push(&mut self, cell: Cell) {
        match (self, cell) {
            (Self::Whole(values), Cell::Whole(value)) => values.push(value),
            (Self::Real(values), Cell::Real(value)) => {
                values.push(value.filter(|number| number.is_finite()))
            }
            (Self::Text(values), Cell::Text(value)) => values.push(value),
            (Self::Flag(values), Cell::Flag(value)) => values.push(value),
            // A row has the kinds of its column: both come from one function.
            _ => {}
        }
    }

    /// How many values.
    #[must_use]
    pub fn len(&self) -> usize {
        match self {
            Self::Whole(values) => values.len(),
            Self::Real(values) => values.len(),
            Self::Text(values) => values.len(),
            Self::Flag(values) => values.len(),
        }
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// A value as written in a CSV file: nothing where there is none.
    #[must_use]
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
    /// Rows as columns; all rows have the names and kinds of the first.
    #[must_use]
    pub fn of(rows: Vec<Row>) -> Self {
        let mut table = Self::default();
        for row in rows {
            if table.columns.is_empty() {
                table.columns =
                    row.iter().map(|(name, cell)| (name.clone(), Column::of(cell))).collect();
            }
            for ((_, column), (_, cell)) in table.columns.iter_mut().zip(row) {
                column.push(cell);
            }
        }
        table
    }

    /// How many rows.
    #[must_use]
    pub fn rows(&self) -> usize {
        self.columns.first().map_or(0, |(_, column)| column.len())
    }

    /// A column by name.
    #[must_use]
    pub fn column(&self, name: &str) -> Option<&Column> {
        self.columns.iter().find(|(known, _)| known == name).map(|(_, column)| column)
    }

    /// Numbers of a column; whole numbers too. Empty where there is no such column.
    #[must_use]
    pub fn reals(&self, name: &str) -> Vec<Option<f64>> {
        match self.column(name) {
            Some(Column::Real(values)) => values.clone(),
            Some(Column::Whole(values)) => values.iter().map(|value| Some(*value as f64)).collect(),
            _ => Vec::new(),
        }
    }

    /// Texts of a column; empty where there is no such column.
    #[must_use]
    pub fn texts(&self, name: &str) -> &[String] {
        if let Some(Column::Text(values)) = self.column(name) { values } else { &[] }
    }

    /// Flags of a column; empty where there is no such column.
    #[must_use]
    pub fn flags(&self, name: &str) -> &[bool] {
        if let Some(Column::Flag(values)) = self.column(name) { values } else { &[] }
    }

    /// Whole numbers of a column; empty where there is no such column.
    #[must_use]
    pub fn wholes(&self, name: &str) -> &[i64] {
        if let Some(Column::Whole(values)) = self.column(name) { values } else { &[] }
    }

    /// Adds the rows of another of the same columns.
    pub fn append(&mut self, other: Self) {
        if self.columns.is_empty() {
            *self = other;
            return;
        }
        for ((_, own), (_, more)) in self.columns.iter_mut().zip(other.columns) {
            match (own, more) {
                (Column::Whole(own), Column::Whole(more)) => own.extend(more),
                (Column::Real(own), Column::Real(more)) => own.extend(more),
                (Column::Text(own), Column::Text(more)) => own.extend(more),
                (Column::Flag(own), Column::Flag(more)) => own.extend(more),
                _ => {}
            }
        }
    }

    /// The same as comma-separated values with a line of names.
    #[must_use]
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
