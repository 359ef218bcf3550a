//! The committed table of sentences equals that of the program. `MESSAGES_ACCEPT=1` writes it.

#![allow(clippy::unwrap_used, reason = "a failed test panics")]

use std::collections::BTreeSet;
use std::path::Path;

#[test]
fn the_committed_table_of_sentences_is_the_programs() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../assets/messages.json");
    if std::env::var_os("MESSAGES_ACCEPT").is_some() {
        std::fs::write(&path, api::messages::text()).unwrap();
    }
    let committed = std::fs::read_to_string(&path).unwrap();
    assert_eq!(committed, api::messages::text(), "run this test with MESSAGES_ACCEPT=1");
}

#[test]
fn codes_are_unique_and_every_value_stands_in_its_sentence() {
    let mut codes = BTreeSet::new();
    for kind in api::messages::all() {
        assert!(codes.insert(kind.code), "{} stands twice", kind.code);
        for value in kind.values {
            let placed = [format!("{{{value}}}"), format!("{{{value}:")];
            for english in [Some(kind.english), kind.one].into_iter().flatten() {
                assert!(
                    placed.iter().any(|place| english.contains(place)),
                    "{}: {value} is not used",
                    kind.code
                );
            }
        }
        assert!(kind.one.is_some() || !kind.values.contains(&"count"), "{}: no singular", kind.code);
    }
    assert!(codes.len() > 90);
}
