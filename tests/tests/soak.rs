//! A little of each trial that `cargo xtask soak` runs without an end.

#![cfg(target_os = "linux")]
#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a failed test panics")]

use dragtraffic_tests::soak::{clients, faults, kills, schedule};
use std::collections::BTreeSet;
use std::time::Duration;

fn tell(line: &str) {
    println!("{line}");
}

#[test]
fn nothing_that_was_answered_is_lost_by_kills() {
    let tally = kills::kills(5, 11, &tell).unwrap();
    assert!(tally.kept > 0 && tally.refused == 0, "{tally:?}");
}

#[test]
fn a_failing_disk_is_told_and_survived() {
    let report = faults::faults(20, 5, &tell).unwrap();
    assert!(report.failed >= 20 && report.writes.kept > 0 && report.writes.refused > 0, "{report:?}");
    assert_eq!(report.writes.lost, 0, "{report:?}");
}

#[test]
fn a_schedule_is_gone_through() {
    assert!(schedule::schedules(1, 3, &tell).unwrap() > 20);
}

#[test]
fn a_seed_is_a_schedule() {
    assert_eq!(schedule::steps(8), schedule::steps(8));
    assert_ne!(schedule::steps(8), schedule::steps(9));
    let all: Vec<schedule::Step> = (0..200).flat_map(schedule::steps).collect();
    let sorts: BTreeSet<String> =
        all.iter().map(|step| format!("{step:?}").split('(').next().unwrap_or_default().to_owned()).collect();
    assert_eq!(sorts.len(), 17, "{sorts:?}");
}

#[test]
fn clients_of_all_sorts_get_what_they_may() {
    let report = clients::clients(Duration::from_secs(4), 2, &tell).unwrap();
    println!("{report}");
    let answered: BTreeSet<&str> =
        report.replies.iter().filter(|(key, _)| key.1 < 300).map(|(key, _)| key.0).collect();
    for name in ["cancel", "drag", "export", "import", "place", "react", "score", "write"] {
        assert!(answered.contains(name), "{name} was never answered: {report}");
    }
}
