//! Any bytes as conditions: no panic, and what is resolved is within its ranges.
#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| formats::checks::conditions(bytes));
