//! Every file of `fixtures/bad` is refused with the code and at the place that `EXPECTED.txt` names.
//! Run with `--nocapture` to see the table.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    clippy::print_stdout,
    reason = "a test stops at the first surprise"
)]

use std::collections::BTreeSet;
use std::path::Path;
use std::time::{Duration, Instant};

#[test]
fn every_bad_file_is_refused_precisely() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fixtures/bad");
    let expected = std::fs::read_to_string(folder.join("EXPECTED.txt")).unwrap();
    let mut listed = BTreeSet::new();
    let mut wrong = Vec::new();
    for line in expected.lines().filter(|l| !l.starts_with('#')) {
        let mut words = line.split(' ');
        let (file, code, pointer) = (words.next().unwrap(), words.next().unwrap(), words.next().unwrap());
        listed.insert(file.to_owned());
        let bytes = std::fs::read(folder.join(file)).unwrap();
        let start = Instant::now();
        let Err(error) = formats::native::read(&bytes) else {
            wrong.push(format!("{file}: read without a fault"));
            continue;
        };
        assert!(start.elapsed() < Duration::from_secs(1), "{file} took {:?}", start.elapsed());
        println!("{file:34} {error}");
        let first = &error.problems[0];
        let place = if first.pointer.is_empty() { "-" } else { &first.pointer };
        if error.code() != code || place != pointer {
            wrong.push(format!("{file}: expected {code} at {pointer}, got {error}"));
        }
    }
    let present: BTreeSet<String> = std::fs::read_dir(&folder)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .filter(|name| name.ends_with(".json"))
        .collect();
    assert_eq!(present, listed, "files and EXPECTED.txt differ");
    assert!(wrong.is_empty(), "{} of {}:\n{}", wrong.len(), listed.len(), wrong.join("\n"));
}
