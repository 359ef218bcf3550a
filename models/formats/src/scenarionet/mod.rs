//! ScenarioNet scenarios: pickled Python dictionaries with arrays, the format of MetaDrive.

mod array;
mod export;
mod export_map;
pub(crate) mod format;
mod import;
mod import_map;
mod machine;
mod value;
mod words;
mod writer;
