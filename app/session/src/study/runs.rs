//! The runs of a study: its table, and each row as a struct whose fields are the columns.

use endline_sdk::BodyPart;

use crate::table::{Column, Table, WrongCell};

/// The value of a field, for events that name their columns.
enum Field {
    Count(u64),
    Number(Option<f64>),
    Flag(bool),
    Text,
}

/// A type that the cells of a column are read as.
trait CellType: Sized {
    /// The type in words.
    const KIND: &'static str;
    /// The value in a row; `None` for a column of another kind.
    fn read(column: &Column, row: usize) -> Option<Self>;
    fn field(&self) -> Field;
}

impl CellType for u64 {
    const KIND: &'static str = "a whole number";
    fn read(column: &Column, row: usize) -> Option<Self> {
        if let Column::Whole(values) = column { values[row].try_into().ok() } else { None }
    }
    fn field(&self) -> Field {
        Field::Count(*self)
    }
}

impl CellType for Option<f64> {
    const KIND: &'static str = "a number";
    fn read(column: &Column, row: usize) -> Option<Self> {
        if let Column::Real(values) = column { Some(values[row]) } else { None }
    }
    fn field(&self) -> Field {
        Field::Number(*self)
    }
}

impl CellType for f64 {
    const KIND: &'static str = "a number";
    fn read(column: &Column, row: usize) -> Option<Self> {
        Option::read(column, row).flatten()
    }
    fn field(&self) -> Field {
        Field::Number(Some(*self))
    }
}

impl CellType for bool {
    const KIND: &'static str = "true or false";
    fn read(column: &Column, row: usize) -> Option<Self> {
        if let Column::Flag(values) = column { Some(values[row]) } else { None }
    }
    fn field(&self) -> Field {
        Field::Flag(*self)
    }
}

impl CellType for String {
    const KIND: &'static str = "a text";
    fn read(column: &Column, row: usize) -> Option<Self> {
        if let Column::Text(values) = column { Some(values[row].clone()) } else { None }
    }
    fn field(&self) -> Field {
        Field::Text
    }
}

/// Declares a row: fields with their types and the names of their columns, and what is no column.
macro_rules! row {
    ($(#[$of:meta])* $row:ident {
        $($(#[$what:meta])* $field:ident: $kind:ty = $name:literal,)*
    } $({ $(#[$more:meta])* $besides:ident: $type:ty })?) => {
        $(#[$of])*
        #[derive(Clone, Debug, Default, PartialEq)]
        pub struct $row {
            $($(#[$what])* pub $field: $kind,)*
            $($(#[$more])* pub $besides: $type,)?
        }

        impl $row {
            /// Every row of a table, from the columns whose names begin with `prefix`.
            fn read(table: &Table, prefix: &str) -> Result<Vec<Self>, WrongCell> {
                $(let $field = find(table, prefix, $name)?;)*
                let row = |row: usize| -> Result<Self, WrongCell> {
                    Ok(Self {
                        $($field: cell($field, row)?,)*
                        $($besides: <$type>::default(),)?
                    })
                };
                (0..table.rows()).map(row).collect()
            }

            /// The value of a column by its name; `None` for a column that is no field.
            fn field(&self, name: &str) -> Option<Field> {
                match name {
                    $($name => Some(self.$field.field()),)*
                    _ => None,
                }
            }

            /// The number in a column by its name.
            pub(super) fn number(&self, name: &str) -> Option<f64> {
                match self.field(name) {
                    Some(Field::Number(number)) => number,
                    Some(Field::Count(count)) => Some(count as f64),
                    Some(Field::Flag(_) | Field::Text) | None => {
                        debug_assert!(false, "`{name}` is no column of numbers");
                        None
                    }
                }
            }
        }
    };
}

row! {
    /// One run of a study. Columns are the figures that statistics and panels read; `figures` declares all.
    RunRow {
        /// Index of the encounter.
        encounter: u64 = "encounter",
        /// Id of the option.
        option: String = "option",
        /// Weight of the encounter; weights have mean 1.
        weight: f64 = "weight",
        /// Whether the run counts.
        valid: bool = "valid",
        /// Whether the run ends where something parts.
        until_parted: bool = "until_parted",
        /// Why there is no run, or why it does not count.
        fault: String = "fault",
        /// Time simulated [s].
        simulated_s: Option<f64> = "simulated_s",
        /// Hash of the last state.
        state_hash: String = "state_hash",
        /// Outcome.
        outcome: String = "outcome",
        /// Whether the run was long enough for its outcome to be final.
        decided: bool = "decided",
        /// First contact of rope with the whale [s].
        first_contact_s: Option<f64> = "first_contact_s",
        /// Last contact of rope with the whale [s].
        last_contact_s: Option<f64> = "last_contact_s",
        /// Whether rope was lodged in the mouth at some time.
        was_lodged_in_mouth: bool = "was_lodged_in_mouth",
        /// Whether a trap, buoy or anchor was caught on the whale at some time.
        was_body_caught: bool = "was_body_caught",
        /// Whether rope was lodged in the mouth at the end.
        lodged_in_mouth: bool = "lodged_in_mouth",
        /// Speed made good at the end [m/s].
        speed_made_good_m_s: Option<f64> = "speed_made_good_m_s",
        /// Whether it was anchored at the end.
        anchored: bool = "anchored",
        /// Whether it was held with rope at the mouth or head at the end.
        rope_on_head: bool = "rope_on_head",
        /// Whether it was held with rope at a flipper at the end.
        rope_on_flipper: bool = "rope_on_flipper",
        /// Whether it was held with rope at peduncle or flukes at the end.
        rope_on_tail: bool = "rope_on_tail",
        /// Whether it was held with half a turn about some part at the end.
        wraps_present: bool = "wraps_present",
        /// Whether it was held with a part constricted at the end.
        constricting: bool = "constricting",
        /// Whether it was held and trailed gear at the end.
        trailing: bool = "trailing",
        /// Rope from the whale to loose ends [m].
        trailing_m: Option<f64> = "trailing_m",
        /// Traps to which rope from the whale leads.
        carried_traps: u64 = "carried_traps",
        /// Buoys to which rope from the whale leads.
        carried_buoys: u64 = "carried_buoys",
        /// Greatest tension [N].
        peak_tension_n: Option<f64> = "peak_tension_N",
        /// Link or line that parted first.
        parted: String = "parted",
        /// Checks of segment lengths near the whale.
        resolution_looks: u64 = "resolution_looks",
        /// Checks that left a segment longer than requested by a quarter or more.
        resolution_missed: u64 = "resolution_missed",
        /// Strength that every line must deliver for nothing to part [N].
        needed_rope_n: Option<f64> = "needed_rope_N",
        /// Rating that every weak link must have for nothing to part [N].
        needed_link_n: Option<f64> = "needed_link_N",
        /// Strength that the weak places of every line must have for none to part; none without weak places [N].
        needed_place_n: Option<f64> = "needed_place_N",
    } {
        /// Rope on the parts of the whale, in the order of [`BodyPart::ALL`].
        parts: Vec<PartRow>
    }
}

row! {
    /// Rope on a part of the whale in one run.
    PartRow {
        /// Wraps at the end [turns].
        wraps: Option<f64> = "wraps",
        /// Greatest wraps [turns].
        peak_wraps: Option<f64> = "peak_wraps",
        /// Greatest normal force [N].
        peak_normal_n: Option<f64> = "peak_normal_N",
        /// Greatest pressure [Pa].
        peak_pressure_pa: Option<f64> = "peak_pressure_Pa",
    }
}

/// A column by its prefix and name.
fn find<'a>(table: &'a Table, prefix: &str, name: &str) -> Result<&'a (String, Column), WrongCell> {
    let is_it = |known: &str| known.strip_prefix(prefix) == Some(name);
    let found = table.columns.iter().find(|(known, _)| is_it(known));
    found.ok_or_else(|| WrongCell::misplaced(&format!("{prefix}{name}"), 0, None))
}

/// The value of a column in a row.
fn cell<T: CellType>((name, column): &(String, Column), row: usize) -> Result<T, WrongCell> {
    let wrong = || WrongCell::new(name, row, T::KIND, column.describe(row));
    T::read(column, row).ok_or_else(wrong)
}

impl RunRow {
    /// Whether a column by its name is true.
    pub(super) fn flag(&self, name: &str) -> bool {
        let flag = match self.field(name) {
            Some(Field::Flag(flag)) => Some(flag),
            Some(Field::Count(_) | Field::Number(_) | Field::Text) | None => None,
        };
        debug_assert!(flag.is_some(), "`{name}` is no column of flags");
        flag.unwrap_or_default()
    }

    /// Greatest wraps about any part of the whale [turns].
    pub fn peak_wraps(&self) -> f64 {
        let wraps = self.parts.iter().map(|part| part.peak_wraps.unwrap_or_default());
        wraps.fold(0.0, f64::max)
    }

    /// Its encounter, as an index.
    pub(super) fn index(&self) -> usize {
        usize::try_from(self.encounter).unwrap_or(usize::MAX)
    }
}

/// The runs of a study.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Runs {
    /// The table as it is stored.
    table: Table,
    /// Its rows.
    rows: Vec<RunRow>,
}

impl Runs {
    /// The runs of a table.
    /// Errors: a column that is missing, or has a cell of another kind.
    pub fn read(table: Table) -> Result<Self, WrongCell> {
        if table.columns.is_empty() {
            return Ok(Self::default());
        }
        let mut rows = RunRow::read(&table, "")?;
        for part in BodyPart::ALL {
            let own = PartRow::read(&table, &format!("{}_", part.name()))?;
            rows.iter_mut().zip(own).for_each(|(row, part)| row.parts.push(part));
        }
        Ok(Self { table, rows })
    }

    /// Runs that are not stored, for tests of statistics.
    #[cfg(test)]
    pub(crate) fn of_rows(rows: Vec<RunRow>) -> Self {
        Self { table: Table::default(), rows }
    }

    /// The table as it is stored.
    pub fn table(&self) -> &Table {
        &self.table
    }

    /// Its rows.
    pub fn rows(&self) -> &[RunRow] {
        &self.rows
    }

    /// Values drawn from a prior, by row.
    pub fn drawn(&self, prior: &str) -> Option<&Column> {
        self.table.column(&format!("drawn_{prior}"))
    }

    /// The runs of an option that count.
    pub fn valid_of(&self, option: &str) -> impl Iterator<Item = &RunRow> {
        self.rows.iter().filter(move |run| run.valid && run.option == option)
    }

    /// By encounter: a value of an option's run there; `None` if the run does not count or is missing.
    pub(super) fn by_encounter<T: Clone>(
        &self,
        option: &str,
        of: impl Fn(&RunRow) -> Option<T>,
    ) -> Vec<Option<T>> {
        let mut found = vec![None; self.encounters()];
        self.valid_of(option).for_each(|run| found[run.index()] = of(run));
        found
    }

    /// The run of an option in an encounter.
    pub fn find(&self, option: &str, encounter: u32) -> Option<&RunRow> {
        let is_it = |run: &&RunRow| run.encounter == u64::from(encounter) && run.option == option;
        self.rows.iter().find(is_it)
    }

    /// Number of encounters, from the first to the last that has a run.
    pub fn encounters(&self) -> usize {
        self.rows.iter().map(|run| run.index() + 1).max().unwrap_or(0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::table::Cell;

    #[test]
    fn a_missing_column_and_a_cell_of_another_kind_are_located() {
        let row = |encounter: Cell| vec![("encounter".to_owned(), encounter)];
        let read = |cell| Runs::read(Table::of(vec![row(cell)]).unwrap()).unwrap_err().to_string();
        assert!(read(Cell::Whole(0)).starts_with("column `option`"), "{}", read(Cell::Whole(0)));
        let column = ("encounter".to_owned(), Column::Whole(vec![0, -1]));
        let error = cell::<u64>(&column, 1).unwrap_err().to_string();
        assert_eq!(error, "column `encounter`, row 2: expected a whole number, found -1");
        let column = ("encounter".to_owned(), Column::Flag(vec![true]));
        let error = cell::<u64>(&column, 0).unwrap_err().to_string();
        assert_eq!(error, "column `encounter`, row 1: expected a whole number, found true");
        assert_eq!(Runs::read(Table::default()).unwrap().encounters(), 0);
    }
}
