//! JSON of GPUDrive and of its predecessor Nocturne: the content of a Waymo scenario without links of lanes.

mod document;
mod export;
pub(crate) mod format;
mod import;
