//! Tables as Apache Arrow files (IPC file format, also called Feather 2): uncompressed, so that a program maps them into
//! memory. The same table gives the same bytes.
//!
//! Format: <https://arrow.apache.org/docs/format/Columnar.html>

use std::collections::HashMap;
use std::sync::Arc;

use arrow_array::builder::StringDictionaryBuilder;
use arrow_array::types::Int32Type;
use arrow_array::{ArrayRef, BooleanArray, Float64Array, Int64Array, RecordBatch};
use arrow_ipc::writer::FileWriter;
use arrow_schema::{ArrowError, Field, Schema};

use crate::table::{Column, Table};

/// The bytes of a file. The tag `c.unit` stands with column `c` under the name `unit`, and so for every other tag of a
/// column; the other tags stand with the table.
pub(super) fn write(table: &Table, tags: &[(String, String)]) -> Result<Vec<u8>, ArrowError> {
    let (mut fields, mut arrays) = (Vec::new(), Vec::new());
    for (name, column) in &table.columns {
        let array = array(column)?;
        let may_lack = matches!(column, Column::Real(_));
        let field = Field::new(name, array.data_type().clone(), may_lack);
        fields.push(field.with_metadata(of_column(name, tags)));
        arrays.push(array);
    }
    let schema = Arc::new(Schema::new_with_metadata(fields, of_table(table, tags)));
    let batch = RecordBatch::try_new(Arc::clone(&schema), arrays)?;
    let mut file = FileWriter::try_new(Vec::new(), &schema)?;
    file.write(&batch)?;
    file.into_inner()
}

/// The values of a column; texts by dictionary.
fn array(column: &Column) -> Result<ArrayRef, ArrowError> {
    Ok(match column {
        Column::Whole(values) => Arc::new(Int64Array::from(values.clone())),
        Column::Real(values) => Arc::new(Float64Array::from(values.clone())),
        Column::Flag(values) => Arc::new(BooleanArray::from(values.clone())),
        Column::Text(values) => {
            let mut texts = StringDictionaryBuilder::<Int32Type>::new();
            for text in values {
                texts.append(text)?;
            }
            Arc::new(texts.finish())
        }
    })
}

/// The property of a column that a tag describes, such as `unit` for `x_m.unit`; `None` for a tag of something else.
fn about<'a>(name: &str, key: &'a str) -> Option<&'a str> {
    key.strip_prefix(name)?.strip_prefix('.')
}

/// The tags of a column.
fn of_column(name: &str, tags: &[(String, String)]) -> HashMap<String, String> {
    let own = |(key, text): &(String, String)| Some((about(name, key)?.to_owned(), text.clone()));
    tags.iter().filter_map(own).collect()
}

/// The tags of the table as a whole.
fn of_table(table: &Table, tags: &[(String, String)]) -> HashMap<String, String> {
    let of_one = |key: &str| table.columns.iter().any(|(name, _)| about(name, key).is_some());
    tags.iter().filter(|(key, _)| !of_one(key)).cloned().collect()
}

#[cfg(test)]
mod tests {
    use arrow_array::cast::AsArray;
    use arrow_array::types::Float64Type;
    use arrow_array::{Array, StringArray};
    use arrow_ipc::reader::FileReader;

    use super::*;

    #[test]
    fn a_table_comes_back_with_its_units_and_its_bytes_are_its_own() {
        let texts = ["top", "bottom", "top", ""].map(str::to_owned);
        let numbers = vec![Some(1.5), None, Some(-0.0), Some(f64::MIN_POSITIVE)];
        let table = Table {
            columns: vec![
                ("node".to_owned(), Column::Whole(vec![0, -1, i64::MAX, 3])),
                ("tension_N".to_owned(), Column::Real(numbers.clone())),
                ("line".to_owned(), Column::Text(texts.to_vec())),
                ("is_cut".to_owned(), Column::Flag(vec![true, false, false, true])),
            ],
        };
        let tags =
            [("tension_N.unit", "N"), ("tension_N.meaning", "tension"), ("program", "endline")]
                .map(|(key, text)| (key.to_owned(), text.to_owned()));
        let bytes = write(&table, &tags).unwrap();
        assert_eq!(bytes, write(&table, &tags).unwrap());

        let mut file = FileReader::try_new(std::io::Cursor::new(bytes), None).unwrap();
        let schema = file.schema();
        assert_eq!(
            schema.metadata(),
            &HashMap::from([("program".to_owned(), "endline".to_owned())])
        );
        let field = schema.field_with_name("tension_N").unwrap();
        assert_eq!(field.metadata().get("unit").map(String::as_str), Some("N"));
        assert_eq!(field.metadata().len(), 2);
        let batch = file.next().unwrap().unwrap();
        let read: Vec<_> = batch["tension_N"].as_primitive::<Float64Type>().iter().collect();
        assert_eq!(
            read.iter().map(|number| number.map(f64::to_bits)).collect::<Vec<_>>(),
            numbers.iter().map(|number| number.map(f64::to_bits)).collect::<Vec<_>>()
        );
        let lines = batch["line"].as_dictionary::<Int32Type>();
        let lines = lines.downcast_dict::<StringArray>().unwrap();
        assert_eq!(lines.values().len(), 3, "each text stands once");
        assert!(lines.into_iter().map(Option::unwrap).eq(texts.iter().map(String::as_str)));
        assert_eq!(batch.num_rows(), 4);
        assert!(file.next().is_none());
    }
}
