//! ASAM OpenDRIVE: maps of roads whose lanes lie along a reference line.
//!
//! The crate `xodr` reads them, and this module converts its result to lanes, lines, edges and signals of a
//! scene. Roads are flat in their cross-section: superelevation and lateral shapes are left out, heights
//! along the road are kept.

mod bends;
mod course;
pub(crate) mod export;
mod filter;
pub(crate) mod format;
pub(crate) mod import;
mod lanes;
mod marks;
mod objects;
pub(crate) mod places;
mod roads;
mod sections;
mod short;
mod signals;
