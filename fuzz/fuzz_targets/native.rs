//! Any bytes as a scene document: no panic, and what is read writes back equal.
#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| formats::checks::native(bytes));
