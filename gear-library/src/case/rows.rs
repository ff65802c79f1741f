//! A case over rows of measurements: the scenario is set anew for each row, and settled or run.

use crate::diagnostic::At;
use crate::fields::{Fields, Range};
use crate::tree::Content;
use crate::units::Quantity;

use super::{Table, choices};
use crate::diagnostic::Diagnostic;

/// Which rows of a table are taken, what each sets, and what is compared with what.
#[derive(Clone, Debug, PartialEq)]
pub struct Rows {
    /// Column that names the group a row belongs to, such as a set of gear.
    pub by: At<String>,
    /// The groups taken, in order.
    pub groups: Vec<String>,
    /// Column and least value of the rows taken, if only some are.
    pub least: Option<(At<String>, f64)>,
    /// Id of the probe that is read.
    pub read: At<String>,
    /// Where the scenario is run: from when on its reading is averaged [s]; else the gear at rest is read.
    pub mean_from_s: Option<f64>,
    /// Column of what it should read [SI].
    pub measured: At<String>,
    /// Fields over the scenario's, with `{column}`, `{-column}` or `{column/column}` for a row's numbers.
    pub set: Vec<(At<String>, String)>,
}

/// Reads `[rows]`; `None` where something needed is missing, which is reported.
pub(super) fn read(fields: &Fields<'_>) -> Option<Rows> {
    let by = fields.need_text("by", "write the column that names the set of gear");
    let groups = groups(fields);
    let least_of = fields.text("least_of");
    let least = fields.value("least", Quantity::Ratio, Range::Any);
    let read = fields.need_text("read", "write the id of a probe");
    let mean_from = fields.value("mean_from", Quantity::Time, Range::NotNegative);
    let measured = fields.need_text("measured", "write the column of the measurements");
    let set = choices(fields, "set");
    fields.finish();
    let least = least_of.zip(least.map(|least| least.value));
    let mean_from_s = mean_from.map(|from| from.value);
    Some(Rows {
        by: by?,
        groups: groups?,
        least,
        read: read?,
        mean_from_s,
        measured: measured?,
        set,
    })
}

/// Numbers or texts.
fn groups(fields: &Fields<'_>) -> Option<Vec<String>> {
    let Some(node) = fields.get("groups") else {
        fields.missing("groups", "list the values of the column `by` that are taken, as [16, 18]");
        return None;
    };
    let Content::List(items) = &node.content else {
        fields.problems().push(node.place.error("`groups` is no list", "write [16, 18]"));
        return None;
    };
    let text = |content: &Content| match content {
        Content::Number(number) => Some(number.to_string()),
        Content::Text(text) => Some(text.clone()),
        _ => None,
    };
    items.iter().map(|item| text(&item.content)).collect()
}

impl Rows {
    /// The rows of a table that belong to a group.
    ///
    /// # Errors
    /// Where a column is not there or holds no number.
    pub fn of_group(&self, table: &Table, group: &str) -> Result<Vec<usize>, Box<Diagnostic>> {
        let mut rows = Vec::new();
        for row in 0..table.len() {
            let high = match &self.least {
                Some((column, least)) => table.number(row, &column.value)? >= *least,
                None => true,
            };
            if high && table.text(row, &self.by.value)? == group {
                rows.push(row);
            }
        }
        Ok(rows)
    }

    /// The fields to set for a row, with its numbers in place.
    ///
    /// # Errors
    /// Where a column is not there, or what is needed is no number.
    pub fn fields(
        &self,
        table: &Table,
        row: usize,
    ) -> Result<Vec<(String, String)>, Box<Diagnostic>> {
        self.set
            .iter()
            .map(|(field, text)| Ok((field.value.clone(), filled(text, table, row)?)))
            .collect()
    }
}

/// A text with `{column}`, `{-column}` and `{column/column}` replaced by a row's numbers.
fn filled(text: &str, table: &Table, row: usize) -> Result<String, Box<Diagnostic>> {
    let mut whole = String::new();
    let mut rest = text;
    while let Some((before, after)) = rest.split_once('{') {
        let (inside, behind) = after.split_once('}').unwrap_or((after, ""));
        whole += before;
        let (sign, name) = inside.strip_prefix('-').map_or((1.0, inside), |name| (-1.0, name));
        let number = match name.split_once('/') {
            Some((above, below)) => table.number(row, above)? / table.number(row, below)?,
            None => table.number(row, name)?,
        };
        whole += &(sign * number).to_string();
        rest = behind;
    }
    Ok(whole + rest)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rows_numbers_fill_a_text() {
        let table = Table::read("t.csv", "mass,length\n3,60\n").unwrap();
        assert_eq!(filled("{mass} kg", &table, 0).unwrap(), "3 kg");
        assert_eq!(filled("{-length} m", &table, 0).unwrap(), "-60 m");
        assert_eq!(filled("{mass/length} kg/m", &table, 0).unwrap(), "0.05 kg/m");
        assert!(filled("{width} m", &table, 0).is_err());
    }
}
