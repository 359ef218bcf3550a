//! Parquet files with any table: reads flat columns, row by row.
//!
//! The library that decodes them trusts the file's own metadata: it reserves what a header declares, and some
//! false values make it panic. Therefore everything that it would trust is checked first (`vet`), and memory
//! holds one page at a time of each column.

mod read;
mod thrift;
mod vet;
mod write;

pub use read::{ColumnValue, ParquetTable};
pub(crate) use read::{is_parquet, names_in};
pub use write::{Column, ColumnValues, write};
