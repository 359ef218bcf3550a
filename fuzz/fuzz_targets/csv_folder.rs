//! `formats::checks` says what must hold for any bytes.
#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    formats::checks::folder(bytes);
});
