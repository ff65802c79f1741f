//! Tables as Parquet files, zstd inside, under a seal (`seal.rs`): the same table gives the same bytes.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;

use ::parquet::basic::{Compression, LogicalType, Repetition, Type as Physical, ZstdLevel};
use ::parquet::column::reader::get_typed_column_reader;
use ::parquet::data_type::{BoolType, ByteArray, ByteArrayType, DataType, DoubleType, Int64Type};
use ::parquet::errors::{ParquetError, Result};
use ::parquet::file::metadata::KeyValue;
use ::parquet::file::properties::WriterProperties;
use ::parquet::file::reader::{FileReader, RowGroupReader, SerializedFileReader};
use ::parquet::file::writer::{SerializedFileWriter, SerializedRowGroupWriter};
use ::parquet::schema::types::Type;

use super::{Column, Table, seal};

/// A table with texts about it.
pub(crate) type Tagged = (Table, Vec<(String, String)>);

/// The bytes of a file.
pub(crate) fn write(table: &Table, tags: &[(String, String)]) -> Result<Vec<u8>> {
    let fields = table
        .columns
        .iter()
        .map(|(name, column)| field(name, column).map(Arc::new))
        .collect::<Result<Vec<_>>>()?;
    let schema = Arc::new(Type::group_type_builder("runs").with_fields(fields).build()?);
    let own = KeyValue::new(seal::KEY.to_owned(), seal::blank());
    let tags = tags.iter().map(|(key, value)| KeyValue::new(key.clone(), value.clone()));
    let tags = tags.chain([own]).collect();
    let properties = WriterProperties::builder()
        .set_compression(Compression::ZSTD(ZstdLevel::default()))
        .set_created_by(format!("endline {}", crate::VERSION))
        .set_key_value_metadata(Some(tags))
        .build();
    let mut file = SerializedFileWriter::new(Vec::new(), schema, Arc::new(properties))?;
    let mut group = file.next_row_group()?;
    for (_, column) in &table.columns {
        write_column(&mut group, column)?;
    }
    group.close()?;
    let mut bytes = file.into_inner()?;
    seal::seal(&mut bytes);
    Ok(bytes)
}

fn field(name: &str, column: &Column) -> Result<Type> {
    let (physical, logical, repetition) = match column {
        Column::Whole(_) => (Physical::INT64, None, Repetition::REQUIRED),
        Column::Real(_) => (Physical::DOUBLE, None, Repetition::OPTIONAL),
        Column::Text(_) => (Physical::BYTE_ARRAY, Some(LogicalType::String), Repetition::REQUIRED),
        Column::Flag(_) => (Physical::BOOLEAN, None, Repetition::REQUIRED),
    };
    Type::primitive_type_builder(name, physical)
        .with_logical_type(logical)
        .with_repetition(repetition)
        .build()
}

fn write_column(group: &mut SerializedRowGroupWriter<'_, Vec<u8>>, column: &Column) -> Result<()> {
    match column {
        Column::Whole(values) => write_values::<Int64Type>(group, values, None),
        Column::Real(values) => {
            let levels: Vec<i16> = values.iter().map(|value| i16::from(value.is_some())).collect();
            let values: Vec<f64> = values.iter().flatten().copied().collect();
            write_values::<DoubleType>(group, &values, Some(&levels))
        }
        Column::Text(values) => {
            let values: Vec<ByteArray> =
                values.iter().map(|text| ByteArray::from(text.as_str())).collect();
            write_values::<ByteArrayType>(group, &values, None)
        }
        Column::Flag(values) => write_values::<BoolType>(group, values, None),
    }
}

fn write_values<T: DataType>(
    group: &mut SerializedRowGroupWriter<'_, Vec<u8>>,
    values: &[T::T],
    levels: Option<&[i16]>,
) -> Result<()> {
    let Some(mut writer) = group.next_column()? else {
        return Err(ParquetError::General("one column too many".into()));
    };
    writer.typed::<T>().write_batch(values, levels, None)?;
    writer.close()
}

/// Reads the bytes of a file, once they are known to be those that were sealed.
pub(crate) fn read(bytes: Vec<u8>) -> Result<Tagged> {
    seal::checked(&bytes).map_err(|broken| ParquetError::General(broken.to_string()))?;
    // A forged file may have a valid seal, and the library panics on some bytes that no writer produces.
    let read = catch_unwind(AssertUnwindSafe(|| read_sealed(bytes)));
    read.unwrap_or_else(|_| Err(ParquetError::General("no writer of Parquet writes it".into())))
}

fn read_sealed(bytes: Vec<u8>) -> Result<Tagged> {
    let file = SerializedFileReader::new(bytes::Bytes::from(bytes))?;
    let metadata = file.metadata().file_metadata();
    let tags = metadata.key_value_metadata().into_iter().flatten();
    let tags = tags.map(|tag| (tag.key.clone(), tag.value.clone().unwrap_or_default())).collect();
    let columns: Vec<(String, Physical)> = metadata
        .schema_descr()
        .columns()
        .iter()
        .map(|column| (column.name().to_owned(), column.physical_type()))
        .collect();
    let mut table = Table::default();
    for group in 0..file.num_row_groups() {
        let group = file.get_row_group(group)?;
        let read = columns
            .iter()
            .enumerate()
            .map(|(index, (name, kind))| Ok((name.clone(), read_column(&*group, index, *kind)?)));
        table
            .append(Table { columns: read.collect::<Result<_>>()? })
            .map_err(|wrong| ParquetError::General(wrong.to_string()))?;
    }
    let rows = table.rows();
    if table.columns.iter().any(|(_, column)| column.len() != rows) {
        return Err(ParquetError::General("its columns differ in length".into()));
    }
    Ok((table, tags))
}

fn read_column(group: &dyn RowGroupReader, index: usize, kind: Physical) -> Result<Column> {
    Ok(match kind {
        Physical::INT64 => Column::Whole(read_values::<Int64Type>(group, index, false)?.0),
        Physical::BOOLEAN => Column::Flag(read_values::<BoolType>(group, index, false)?.0),
        Physical::BYTE_ARRAY => {
            let texts = read_values::<ByteArrayType>(group, index, false)?.0;
            Column::Text(
                texts
                    .iter()
                    .map(|text| text.as_utf8().map(str::to_owned))
                    .collect::<Result<_>>()?,
            )
        }
        Physical::DOUBLE => {
            let (values, levels) = read_values::<DoubleType>(group, index, true)?;
            let mut values = values.into_iter();
            Column::Real(
                levels
                    .into_iter()
                    .map(|level| if level > 0 { values.next() } else { None })
                    .collect(),
            )
        }
        other => return Err(ParquetError::General(format!("no column of ours holds {other}"))),
    })
}

fn read_values<T: DataType>(
    group: &dyn RowGroupReader,
    index: usize,
    may_lack: bool,
) -> Result<(Vec<T::T>, Vec<i16>)> {
    let rows = usize::try_from(group.metadata().num_rows()).unwrap_or_default();
    let mut reader = get_typed_column_reader::<T>(group.get_column_reader(index)?);
    let (mut values, mut levels) = (Vec::new(), Vec::new());
    reader.read_records(rows, may_lack.then_some(&mut levels), None, &mut values)?;
    Ok((values, levels))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sample() -> Table {
        let columns = vec![
            ("encounter".to_owned(), Column::Whole(vec![0, 1, 2])),
            ("peak_tension_N".to_owned(), Column::Real(vec![Some(1.5), None, Some(-0.0)])),
            ("option".to_owned(), Column::Text(vec!["a".into(), String::new(), "\u{e9}".into()])),
            ("valid".to_owned(), Column::Flag(vec![true, false, true])),
        ];
        Table { columns }
    }

    #[test]
    fn a_table_comes_back_as_it_went_and_its_bytes_are_its_own() {
        let tags = vec![("study".to_owned(), "abc".to_owned())];
        let bytes = write(&sample(), &tags).unwrap();
        assert_eq!(bytes, write(&sample(), &tags).unwrap());
        let (table, read_tags) = read(bytes).unwrap();
        assert_eq!(table, sample());
        assert_eq!(
            read_tags.iter().find(|(key, _)| key == "study").map(|(_, value)| value.as_str()),
            Some("abc")
        );
    }

    #[test]
    fn a_torn_file_is_an_error() {
        let bytes = write(&sample(), &[]).unwrap();
        assert!(read(bytes[..bytes.len() / 2].to_vec()).is_err());
        assert!(read(Vec::new()).is_err());
    }
}
