//! The committed documents equal those of this build.

#![allow(clippy::unwrap_used, reason = "a failed test panics")]

#[test]
fn the_committed_domain_is_current() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../assets/domain.json");
    let committed = std::fs::read_to_string(path).unwrap_or_default();
    let now = api::domain::text();
    assert!(committed == now, "run: cargo run -p dragtraffic -- domain > assets/domain.json");
}
