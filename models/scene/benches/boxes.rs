//! Cost of box gaps, overlap tables and whole-scene scores.

fn main() {}
