//! ScenarioNet scenarios: Python dictionaries with arrays, as MetaDrive keeps them.

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
