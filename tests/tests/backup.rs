//! `dragtraffic backup`: a copy of the store while a server works on it.

#![allow(clippy::unwrap_used, reason = "a failed test panics")]

use dragtraffic_tests::program::program;
use dragtraffic_tests::writers::{self, Writer};
use dragtraffic_tests::{Request, Server};
use serde_json::Value;
use std::path::Path;
use std::process::{Command, Output};
use std::time::Duration;

fn backup(db: &Path, output: &Path, flags: &[&str]) -> Output {
    let mut command = Command::new(program());
    command.args(["backup", "--db"]).arg(db).arg("-o").arg(output).args(flags).output().unwrap()
}

/// Exit code, and the single line of output.
fn told(output: &Output) -> (Option<i32>, String) {
    let said = String::from_utf8(output.stderr.clone()).unwrap();
    assert_eq!(said.lines().count(), 1, "{said}");
    (output.status.code(), said)
}

fn ids(server: &Server) -> Vec<(String, String)> {
    let list = server.get("/v1/scenes?limit=200&sort=name").unwrap().json();
    let text = |item: &Value, name: &str| item[name].as_str().unwrap().to_owned();
    let own = list["scenes"].as_array().unwrap().iter().filter(|item| item["readonly"] == false);
    own.map(|item| (text(item, "id"), text(item, "etag"))).collect()
}

#[test]
fn a_copy_taken_amid_writes_has_every_write_that_was_answered_before() {
    let folder = tempfile::tempdir().unwrap();
    let (db, copy) = (folder.path().join("scenes.sqlite"), folder.path().join("copy.sqlite"));
    let server = Server::start_at(&db, &[]).unwrap();
    // These changes end before the copy begins, and no writer touches their scenes during it.
    let mut before = Writer::crowd(2, 1);
    for writer in &mut before {
        for _ in 0..12 {
            assert_eq!(writer.change(server.address), writers::Outcome::Kept);
        }
    }
    let kept: Vec<(String, String)> = ids(&server);
    assert!(!kept.is_empty());
    // These writers continue during the copy.
    let mut amid: Vec<Writer> = Writer::crowd(6, 2).into_iter().skip(2).collect();
    let taken =
        writers::work_until(&mut amid, server.address, Duration::from_millis(100), writers::none, || {
            Ok([(); 3].map(|()| backup(&db, &copy, &["--force"])))
        });
    for output in taken.unwrap() {
        let (code, said) = told(&output);
        assert_eq!(code, Some(0), "{said}");
        assert!(said.contains("scenes") && said.contains("sound"), "{said}");
    }
    assert!(writers::tally(&amid).kept > 0);
    writers::sound(&copy).unwrap();
    let beside: Vec<_> = std::fs::read_dir(folder.path()).unwrap().flatten().map(|f| f.file_name()).collect();
    let stray = beside.iter().filter(|name| name.to_string_lossy().contains("copy")).count();
    assert_eq!(stray, 1, "the copy is one file: {beside:?}");
    let restored = Server::start_at(&copy, &[]).unwrap();
    before.iter_mut().for_each(|writer| writer.compare(&restored).unwrap());
    let there = ids(&restored);
    assert!(kept.iter().all(|scene| there.contains(scene)), "{kept:?} in {there:?}");
    let made = restored.send(&Request::new("POST", &format!("/v1/scenes/{}/duplicate", kept[0].0))).unwrap();
    assert_eq!(made.status, 201, "{}", made.text());
    before.iter_mut().for_each(|writer| writer.compare(&server).unwrap());
}

#[test]
fn a_copy_needs_no_server_and_keeps_what_is_there() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    let (db, copy) = (at("scenes.sqlite"), at("copies/copy.sqlite"));
    let mut crowd = Writer::crowd(1, 3);
    let server = Server::start_at(&db, &[]).unwrap();
    while crowd[0].present().next().is_none() {
        crowd[0].change(server.address);
    }
    // A log that is not yet merged into the file is part of the store.
    server.kill().unwrap();
    assert_eq!(told(&backup(&db, &copy, &[])).0, Some(0));
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        assert_eq!(copy.metadata().unwrap().permissions().mode() & 0o777, 0o600);
    }
    let restored = Server::start_at(&copy, &[]).unwrap();
    writers::compare(&mut crowd, &restored).unwrap();
    restored.stop().unwrap();
    std::fs::write(at("taken"), "mine").unwrap();
    std::fs::write(at("text"), "no database").unwrap();
    let refused = |db: &Path, output: &Path, flags: &[&str], code: i32, words: &str| {
        let (ended, said) = told(&backup(db, output, flags));
        assert_eq!(ended, Some(code), "{said}");
        assert!(said.contains(words), "{said}");
    };
    refused(&db, &at("taken"), &[], 8, "--force overwrites it");
    assert_eq!(std::fs::read(at("taken")).unwrap(), b"mine");
    refused(&at("none"), &at("new"), &[], 3, "no such file");
    refused(&at("text"), &at("new"), &[], 1, "not a database");
    refused(&db, &db, &["--force"], 2, "the store itself");
    refused(&db, &at("scenes.sqlite-wal"), &["--force"], 2, "the store itself");
    refused(&db, folder.path(), &["--force"], 2, "a plain file");
    refused(&db, Path::new("-"), &[], 2, "a plain file");
    refused(&db, Path::new("/dev/null/x"), &[], 1, "/dev/null/x: File exists");
    let foreign = rusqlite::Connection::open(at("foreign")).unwrap();
    foreign.execute_batch("CREATE TABLE notes (text)").unwrap();
    refused(&at("foreign"), &at("new"), &[], 1, "another program's database");
    std::fs::write(at("empty"), "").unwrap();
    refused(&at("empty"), &at("new"), &[], 1, "empty");
    assert!(!at("new").exists());
    assert_eq!(told(&backup(&db, &at("taken"), &["--force"])).0, Some(0));
    writers::sound(&at("taken")).unwrap();
}
