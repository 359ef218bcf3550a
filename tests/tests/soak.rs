//! A little of each trial that `cargo xtask soak` runs without an end.

#![cfg(target_os = "linux")]
#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a failed test panics")]

use dragtraffic_tests::faults::{Disk, Fault, How};
use dragtraffic_tests::scenes::street;
use dragtraffic_tests::soak::{clients, faults, kills, schedule};
use dragtraffic_tests::{Request, Server};
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

/// The log lies on the disk that is full.
#[test]
fn a_log_that_cannot_be_written_stops_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let disk = Disk::of(folder.path()).unwrap();
    let mut command = Server::command(&folder.path().join("scenes.sqlite"), &[]);
    command.stderr(std::fs::File::create(folder.path().join("log")).unwrap());
    disk.put_under(&mut command).unwrap();
    let server = Server::launch(command).unwrap();
    server.wait_ready().unwrap();
    let put = |id: &str| {
        let put = Request::new("PUT", &format!("/v1/scenes/{id}")).header("if-none-match", "*");
        let reply = server.send(&put.json(&street(2, 10))).unwrap();
        (reply.status, reply.code())
    };
    assert_eq!(put("before"), (201, String::new()));
    for (how, refusal) in [(How::Full, (507, "store-full")), (How::Broken, (503, "store-unavailable"))] {
        disk.fails(Fault::lasting(how)).unwrap();
        assert_eq!(put("amid"), (refusal.0, refusal.1.to_owned()));
        assert_eq!(server.get("/readyz").unwrap().status, 503);
        assert_eq!(server.get("/v1/scenes/before").unwrap().status, 200);
        disk.well().unwrap();
        assert_eq!(server.get("/readyz").unwrap().status, 200);
    }
    assert_eq!(put("after"), (201, String::new()));
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
