//! Parquet files, whatever table they hold: flat columns in, row by row.
//!
//! The library that decodes them trusts what a file says of itself: it reserves what a header declares, and some
//! lies end it. So everything that it would believe is looked at first (`vet`), and a page at a time of each column
//! is in memory.

mod read;
mod thrift;
mod vet;
mod write;

pub(crate) use read::{ColumnValue, ParquetTable, is_parquet, names_in};
pub(crate) use write::{Column, ColumnValues, write};
