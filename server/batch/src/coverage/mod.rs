//! Coverage of a batch: named dimensions by buckets, pairs of dimensions, and the space of recordings and
//! results.

pub mod count;
pub mod dimension;
pub mod diversity;
pub mod document;
pub mod table;
