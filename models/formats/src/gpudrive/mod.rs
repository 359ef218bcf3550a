//! JSON of GPUDrive and of Nocturne before it: what a Waymo scenario has, without links of lanes.

mod document;
mod export;
pub(crate) mod format;
mod import;
