//! A short run of each trial of `cargo xtask soak`.

#![cfg(target_os = "linux")]
#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a failed test panics")]

use dragtraffic_tests::faults::{Disk, Fault, How};
use dragtraffic_tests::power::{DiskModel, Unsynced};
use dragtraffic_tests::random::Random;
use dragtraffic_tests::scenes::street;
use dragtraffic_tests::soak::{clients, faults, kills, power, schedule};
use dragtraffic_tests::{Request, Server};
use std::collections::BTreeSet;
use std::time::Duration;

fn tell(line: &str) {
    println!("{line}");
}

#[test]
fn nothing_that_was_answered_is_lost_by_kills() {
    // Only a failing disk refuses a write.
    let report = kills::kills(8, 11, &tell).unwrap();
    assert!(report.writes.kept > 0 && report.kills == 8 && report.on_a_failing_disk > 0, "{report:?}");
}

#[test]
fn nothing_that_was_answered_is_lost_by_power_cuts() {
    let report = power::power(12, 3, false, &tell).unwrap();
    assert!(report.cuts == 12 && report.writes.kept > 0 && report.writes.refused == 0, "{report:?}");
    assert!(report.at_the_start.min(report.at_a_copy).min(report.at_a_return) > 0, "{report:?}");
}

/// A defect that the trial above must detect.
#[test]
fn a_disk_that_only_says_that_it_syncs_loses_what_was_answered() {
    let lost = power::power(12, 3, true, &tell).unwrap_err();
    let lost = format!("{lost:#}");
    let told = ["was answered", "a copy that was reported", "the store cannot be opened", "malformed"];
    assert!(told.iter().any(|words| lost.contains(words)), "{lost}");
}

#[test]
fn a_disk_without_power_has_what_was_synced_under_names_that_were_synced() {
    let folder = tempfile::tempdir().unwrap();
    let disk = Disk::with_journal(folder.path()).unwrap();
    let mut model = DiskModel::of(folder.path()).unwrap();
    let mut random = Random::new(1);
    let run = |command: &str| {
        let mut shell = std::process::Command::new("sh");
        shell.args(["-c", command]).current_dir(folder.path());
        disk.put_under(&mut shell).unwrap();
        assert!(shell.output().unwrap().status.success(), "{command}");
    };
    let write = |letter: &str, name: &str, how: &str| {
        run(&format!("head -c 2000 /dev/zero | tr '\\0' {letter} | dd of={name} bs=2000 {how}"));
    };
    let mut cut = |unsynced| {
        model.replay(disk.journal().unwrap()).unwrap();
        model.agrees(folder.path()).unwrap();
        model.cut(unsynced, &mut random);
        model.rebuild(folder.path()).unwrap();
        model = DiskModel::of(folder.path()).unwrap();
        disk.begin_journal().unwrap();
        let file = |entry: std::io::Result<std::fs::DirEntry>| {
            let path = entry.unwrap().path();
            (path.file_name().unwrap().to_str().unwrap().to_owned(), std::fs::read(path).unwrap())
        };
        std::fs::read_dir(folder.path()).unwrap().map(file).collect::<std::collections::BTreeMap<_, _>>()
    };
    write("a", "nameless", "conv=fsync");
    assert!(cut(Unsynced::Lost).is_empty(), "a name that was not synced");
    write("a", "empty", "");
    run("sync .");
    assert_eq!(cut(Unsynced::Lost)["empty"], b"", "bytes that were not synced");
    write("a", "whole", "conv=fsync");
    run("sync .");
    write("b", "whole", "conv=notrunc");
    let left = cut(Unsynced::Lost);
    assert_eq!(left["whole"], [b'a'; 2000], "later bytes are lost alone");
    write("b", "whole", "conv=notrunc");
    run(&format!("unlink {}/empty", folder.path().canonicalize().unwrap().display()));
    let left = cut(Unsynced::Kept);
    assert_eq!((left.len(), &left["whole"]), (1, &vec![b'b'; 2000]));
    // Sectors are whole, and any of them may be present.
    let seen: BTreeSet<Vec<u8>> = (0..40)
        .map(|_| {
            write("c", "whole", "conv=notrunc");
            let left = cut(Unsynced::Drawn)["whole"].clone();
            assert_eq!(left.len(), 2000);
            assert!(left.chunks(512).all(|sector| sector.iter().all(|byte| *byte == sector[0])));
            write("b", "whole", "conv=notrunc,fsync");
            cut(Unsynced::Lost);
            left
        })
        .collect();
    assert!(seen.len() > 4, "{} ways", seen.len());
}

#[test]
fn a_failing_disk_is_told_and_survived() {
    let report = faults::faults(20, 5, &tell).unwrap();
    assert!(report.failed >= 20 && report.writes.kept > 0 && report.writes.refused > 0, "{report:?}");
    assert_eq!(report.writes.lost, 0, "{report:?}");
}

/// The log is on the full disk.
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
