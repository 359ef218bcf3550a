//! Writes columns as a Parquet file.

use parquet::basic::Compression;
use parquet::data_type::{BoolType, ByteArray, ByteArrayType, DataType, DoubleType, Int64Type};
use parquet::errors::ParquetError;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::{EnabledStatistics, WriterProperties};
use parquet::file::writer::{SerializedFileWriter, SerializedRowGroupWriter};
use parquet::schema::parser::parse_message_type;
use std::io;
use std::sync::Arc;

/// Compression level of zstd.
#[cfg(not(target_family = "wasm"))]
const ZSTD_LEVEL: i32 = 3;

/// Values of a column; `None` is null if the column is optional.
#[allow(missing_docs, reason = "the names say it")]
pub enum ColumnValues {
    Text(Vec<Option<String>>),
    Whole(Vec<Option<i64>>),
    Number(Vec<Option<f64>>),
    Flag(Vec<Option<bool>>),
}

/// A column of a table.
pub struct Column {
    /// Its name.
    pub name: &'static str,
    /// Every row has a value.
    pub required: bool,
    /// One value per row.
    pub values: ColumnValues,
}

#[cfg(not(target_family = "wasm"))]
fn compression() -> Result<Compression, ParquetError> {
    parquet::basic::ZstdLevel::try_new(ZSTD_LEVEL).map(Compression::ZSTD)
}

#[cfg(target_family = "wasm")]
fn compression() -> Result<Compression, ParquetError> {
    Ok(Compression::SNAPPY)
}

/// Writes tables with the same columns, one row group each, and notes as metadata.
///
/// # Errors
/// Those of the library; none is expected.
pub fn write(
    groups: impl IntoIterator<Item = Vec<Column>>,
    notes: Vec<(String, String)>,
) -> io::Result<Vec<u8>> {
    let mut groups = groups.into_iter().peekable();
    let columns = groups.peek().map_or(&[][..], Vec::as_slice);
    let schema = parse_message_type(&schema(columns)).map_err(io::Error::other)?;
    let notes = notes.into_iter().map(|(key, value)| KeyValue::new(key, value)).collect();
    let properties = WriterProperties::builder()
        .set_compression(compression().map_err(io::Error::other)?)
        .set_statistics_enabled(EnabledStatistics::Chunk)
        .set_created_by("dragtraffic".into())
        .set_key_value_metadata(Some(notes))
        .build();
    let mut bytes = Vec::new();
    let written = (|| -> Result<(), ParquetError> {
        let mut file = SerializedFileWriter::new(&mut bytes, Arc::new(schema), Arc::new(properties))?;
        for columns in groups {
            let mut group = file.next_row_group()?;
            columns.into_iter().try_for_each(|column| put(&mut group, column))?;
            group.close()?;
        }
        file.close().map(drop)
    })();
    written.map_err(io::Error::other)?;
    Ok(bytes)
}

fn schema(columns: &[Column]) -> String {
    let field = |column: &Column| {
        let kind = match column.values {
            ColumnValues::Text(_) => "BYTE_ARRAY",
            ColumnValues::Whole(_) => "INT64",
            ColumnValues::Number(_) => "DOUBLE",
            ColumnValues::Flag(_) => "BOOLEAN",
        };
        let note = if matches!(column.values, ColumnValues::Text(_)) { " (STRING)" } else { "" };
        let need = if column.required { "REQUIRED" } else { "OPTIONAL" };
        format!("{need} {kind} {}{note};", column.name)
    };
    format!("message schema {{ {} }}", columns.iter().map(field).collect::<Vec<_>>().join(" "))
}

type Group<'a, 'b> = SerializedRowGroupWriter<'a, &'b mut Vec<u8>>;

fn put(group: &mut Group<'_, '_>, column: Column) -> Result<(), ParquetError> {
    let required = column.required;
    match column.values {
        ColumnValues::Text(list) => {
            let text = |text: Option<String>| text.map(|text| ByteArray::from(text.into_bytes()));
            put_typed::<ByteArrayType>(group, required, list.into_iter().map(text))
        }
        ColumnValues::Whole(list) => put_typed::<Int64Type>(group, required, list.into_iter()),
        ColumnValues::Number(list) => put_typed::<DoubleType>(group, required, list.into_iter()),
        ColumnValues::Flag(list) => put_typed::<BoolType>(group, required, list.into_iter()),
    }
}

fn put_typed<T: DataType>(
    group: &mut Group<'_, '_>,
    required: bool,
    list: impl Iterator<Item = Option<T::T>>,
) -> Result<(), ParquetError> {
    let (mut values, mut levels) = (Vec::new(), Vec::new());
    for value in list {
        levels.push(i16::from(value.is_some()));
        values.extend(value);
    }
    let missing = || ParquetError::General("more columns than the schema has".into());
    let mut writer = group.next_column()?.ok_or_else(missing)?;
    writer.typed::<T>().write_batch(&values, (!required).then_some(levels.as_slice()), None)?;
    writer.close()
}
