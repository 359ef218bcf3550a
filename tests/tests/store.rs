//! Saved scenes: preconditions, conditional reads, maps by hash, stops and full disks. Kills are in `soak.rs`.

#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a failed test panics")]

use dragtraffic_tests::program::program;
use dragtraffic_tests::random::Random;
use dragtraffic_tests::scenes::street;
use dragtraffic_tests::{Reply, Request, Server};
use serde_json::{Value, json};
use std::ffi::OsStr;
use std::path::Path;
use std::time::{Duration, Instant};

fn put(id: &str, precondition: (&str, &str), scene: &Value) -> Request {
    Request::new("PUT", &format!("/v1/scenes/{id}")).header(precondition.0, precondition.1).json(scene)
}

fn saved(server: &Server, id: &str, scene: &Value) -> Reply {
    let reply = server.send(&put(id, ("if-none-match", "*"), scene)).unwrap();
    assert_eq!(reply.status, 201, "{}", reply.text());
    reply
}

#[test]
fn a_scene_lives_through_create_read_change_delete() {
    let server = Server::start(&[]).unwrap();
    let made = server.post("/v1/scenes", &street(3, 20)).unwrap();
    assert_eq!(made.status, 201, "{}", made.text());
    let (at, etag) = (made.header("location").to_owned(), made.header("etag").to_owned());
    let read = server.get(&at).unwrap();
    assert_eq!(read.json()["agents"].as_array().unwrap().len(), 3);
    assert_eq!(read.json()["map"]["lanes"].as_array().unwrap().len(), 2);
    assert_eq!(read.header("etag"), etag);
    assert_eq!(read.header("cache-control"), "no-store");
    let known = Request::new("GET", &at).header("if-none-match", &etag);
    let unchanged = server.send(&known).unwrap();
    assert_eq!((unchanged.status, unchanged.body.len()), (304, 0));
    let rename = Request::new("PATCH", &at)
        .header("if-match", &etag)
        .header("content-type", "application/merge-patch+json")
        .body(json!({"name": "late", "tags": ["a", "b"], "notes": null}).to_string());
    let renamed = server.send(&rename).unwrap();
    assert_eq!(renamed.status, 200, "{}", renamed.text());
    assert_eq!(server.send(&rename).unwrap().code(), "stale-etag");
    assert_eq!(server.send(&known).unwrap().status, 200, "another version now");
    let list = server.get("/v1/scenes?q=LATE&tag=a").unwrap().json();
    assert_eq!(list["scenes"][0]["name"], "late");
    assert_eq!(list["scenes"][0]["counts"]["vehicle"], 3);
    assert_eq!(list["scenes"][0]["etag"], renamed.header("etag"));
    let delete = Request::new("DELETE", &at).header("if-match", renamed.header("etag"));
    assert_eq!(server.send(&delete).unwrap().status, 204);
    assert_eq!(server.get(&at).unwrap().status, 404);
    let head = server.send(&Request::new("HEAD", "/v1/scenes")).unwrap();
    assert_eq!((head.status, head.body.len()), (200, 0));
}

#[test]
fn of_two_writers_one_is_told() {
    let server = Server::start(&[]).unwrap();
    let first = saved(&server, "shared", &street(1, 5)).header("etag").to_owned();
    let mine = server.send(&put("shared", ("if-match", &first), &street(2, 5))).unwrap();
    let theirs = server.send(&put("shared", ("if-match", &first), &street(3, 5))).unwrap();
    assert_eq!(mine.status, 200);
    assert_eq!((theirs.status, theirs.code().as_str()), (412, "stale-etag"));
    assert_eq!(theirs.json()["etag"], mine.header("etag"));
    assert!(theirs.json()["updated_at"].is_string());
    assert_eq!(server.get("/v1/scenes/shared").unwrap().json()["agents"].as_array().unwrap().len(), 2);
}

#[test]
fn copies_share_their_map() {
    let server = Server::start(&[]).unwrap();
    saved(&server, "original", &street(1, 5));
    let copy = server.send(&Request::new("POST", "/v1/scenes/original/duplicate")).unwrap();
    assert_eq!(copy.status, 201, "{}", copy.text());
    let copy = server.get(copy.header("location")).unwrap().json();
    assert_eq!(copy["meta"]["parent_id"], "original");
    assert_eq!(copy["name"], "street copy");
    assert_eq!(server.get("/v1/maps").unwrap().json()["maps"].as_array().unwrap().len(), 1);
    let by_ref = server.get("/v1/scenes/original?map=ref").unwrap().json();
    let sha = by_ref["map"]["ref"].as_str().unwrap().trim_start_matches("sha256:").to_owned();
    let map = server.get(&format!("/v1/maps/{sha}")).unwrap();
    assert_eq!(map.json(), copy["map"]);
    assert!(map.header("cache-control").contains("immutable"));
    let again = server.send(&put("by-ref", ("if-none-match", "*"), &by_ref)).unwrap();
    assert_eq!(again.status, 201, "{}", again.text());
    let children = server.get("/v1/scenes?parent=original").unwrap().json();
    assert_eq!(children["scenes"].as_array().unwrap().len(), 1);
}

#[test]
fn lists_come_in_pages() {
    let server = Server::start(&[]).unwrap();
    for i in 0..7 {
        let mut scene = street(1, 2);
        scene["name"] = json!(format!("mine {i}"));
        saved(&server, &format!("s{i}"), &scene);
    }
    let mut names = Vec::new();
    let mut after = String::new();
    loop {
        let page = server.get(&format!("/v1/scenes?q=mine&sort=name&limit=3{after}")).unwrap().json();
        names.extend(
            page["scenes"].as_array().unwrap().iter().map(|s| s["name"].as_str().unwrap().to_owned()),
        );
        match page["next"].as_str() {
            Some(next) => after = format!("&after={next}"),
            None => break,
        }
    }
    assert_eq!(names, (0..7).map(|i| format!("mine {i}")).collect::<Vec<_>>());
}

#[test]
fn a_signal_stops_it_in_order() {
    let folder = tempfile::tempdir().unwrap();
    let db = folder.path().join("scenes.sqlite");
    // Far less than the grace period of running work, because there is none.
    let server = Server::start_at(&db, &["--limit", "shutdown_s=600"]).unwrap();
    saved(&server, "kept", &street(1, 5));
    let (code, took) = server.stop().unwrap();
    assert_eq!(code, Some(0));
    assert!(took < Duration::from_secs(60), "{took:?}");
    let server = Server::start_at(&db, &[]).unwrap();
    assert_eq!(server.get("/v1/scenes/kept").unwrap().status, 200);
}

#[cfg(target_os = "linux")]
#[test]
fn a_signal_before_the_address_is_printed_stops_it_in_order() {
    use std::io::{Read, Write};
    let folder = tempfile::tempdir().unwrap();
    let socket = folder.path().join("s.sock");
    let (mut out, mut taken) = std::io::pipe().unwrap();
    // A pipe holds 64 kB, so the server waits with its address until it is read.
    taken.write_all(&[b' '; 65_536]).unwrap();
    let mut command = Server::command(&folder.path().join("scenes.sqlite"), &["--limit", "shutdown_s=600"]);
    let listen = format!("unix:{}", socket.display());
    let mut server = command.args(["--listen", &listen]).stdout(taken).spawn().unwrap();
    // The command has a copy of the pipe.
    drop(command);
    let began = Instant::now();
    while std::os::unix::net::UnixStream::connect(&socket).is_err() {
        assert!(began.elapsed() < Duration::from_secs(60), "no socket");
        std::thread::sleep(Duration::from_millis(20));
    }
    let sent = std::process::Command::new("kill").args(["-TERM", &server.id().to_string()]).status().unwrap();
    assert!(sent.success());
    let mut text = String::new();
    out.read_to_string(&mut text).unwrap();
    assert!(text.trim().starts_with("DragTraffic is at unix:"), "{}", text.trim());
    assert_eq!(server.wait().unwrap().code(), Some(0));
}

#[test]
fn trouble_at_the_start_has_its_exit_code() {
    let run = |flags: &[&str]| std::process::Command::new(program()).args(flags).output().unwrap();
    let folder = tempfile::tempdir().unwrap();
    let db = folder.path().join("s.sqlite");
    let db = db.to_str().unwrap();
    let server = Server::start(&[]).unwrap();
    let port = server.address.port().to_string();
    assert_eq!(run(&["serve", "--db", db, "--port", &port]).status.code(), Some(6), "port taken");
    assert_eq!(run(&["serve", "--db", db, "--bind", "0.0.0.0", "--port", "0"]).status.code(), Some(2));
    assert_eq!(run(&["serve", "--db", db, "--limit", "nonsense=1"]).status.code(), Some(2));
    assert_eq!(
        run(&["serve", "--db", db, "--port", "0", "--weights", "/nonexistent"]).status.code(),
        Some(7)
    );
    assert_eq!(run(&["serve", "--db", "/nonexistent/x.sqlite", "--port", "0"]).status.code(), Some(2));
    std::fs::write(folder.path().join("broken.sqlite"), "this is no database, not at all").unwrap();
    let broken = folder.path().join("broken.sqlite");
    assert_eq!(run(&["serve", "--port", "0", "--db", broken.to_str().unwrap()]).status.code(), Some(1));
}

/// A small separate disk; `None`, with a printed reason, if mounting is not allowed.
#[cfg(target_os = "linux")]
fn small_disk(folder: &Path, size: &str) -> Option<SmallDisk> {
    let mount = std::process::Command::new("mount")
        .args(["-t", "tmpfs", "-o", &format!("size={size}"), "none"])
        .arg(folder)
        .output();
    match mount {
        Ok(output) if output.status.success() => Some(SmallDisk(folder.to_owned())),
        _ => {
            println!("skipped: no small disk can be mounted here");
            None
        }
    }
}

#[cfg(target_os = "linux")]
struct SmallDisk(std::path::PathBuf);

#[cfg(target_os = "linux")]
impl Drop for SmallDisk {
    fn drop(&mut self) {
        let _ = std::process::Command::new("umount").arg("-l").arg(&self.0).status();
    }
}

#[cfg(target_os = "linux")]
#[test]
fn where_disks_can_be_mounted_a_full_one_lets_scenes_be_deleted_and_saved_again() {
    let folder = tempfile::tempdir().unwrap();
    let Some(_disk) = small_disk(folder.path(), "6m") else { return };
    let server = Server::start_at(&folder.path().join("scenes.sqlite"), &[]).unwrap();
    let ready = || server.get("/readyz").unwrap().status;
    let started = Instant::now();
    while ready() != 200 && started.elapsed() < Duration::from_secs(30) {
        std::thread::sleep(Duration::from_millis(50));
    }
    let mut etags = Vec::new();
    let full = loop {
        let k = etags.len();
        let mut scene = street(20, 90);
        // Text that compresses badly, so that a few scenes fill the disk.
        let noise: String = (0..9_000u32)
            .map(|i| char::from(b'!' + (i.wrapping_mul(2_654_435_761 + k as u32) >> 25) as u8 % 90))
            .collect();
        scene["meta"] = json!({"notes": noise});
        let reply = server.send(&put(&format!("s{k}"), ("if-none-match", "*"), &scene)).unwrap();
        if reply.status != 201 {
            break reply;
        }
        etags.push(reply.header("etag").to_owned());
        assert!(k < 2_000, "the disk never fills");
    };
    assert_eq!((full.status, full.code().as_str()), (507, "store-full"), "{}", full.text());
    assert_eq!(ready(), 503, "not ready while the disk is full");
    for (k, etag) in etags.iter().enumerate() {
        let delete = Request::new("DELETE", &format!("/v1/scenes/s{k}")).header("if-match", etag);
        let gone = server.send(&delete).unwrap();
        assert_eq!(gone.status, 204, "scene {k} of {}: {}", etags.len(), gone.text());
    }
    let again = server.send(&put("again", ("if-none-match", "*"), &street(5, 20))).unwrap();
    assert_eq!(again.status, 201, "{}", again.text());
    assert_eq!(ready(), 200);
}

/// Saves scenes with their own maps until the disk is full; returns their ETags.
#[cfg(target_os = "linux")]
fn fill(server: &Server, seed: u64) -> Vec<String> {
    let mut random = Random::new(seed);
    let mut etags = Vec::new();
    loop {
        let mut scene = street(2, 20);
        let points: Vec<[f64; 2]> =
            (0..2_000).map(|i| [f64::from(i), random.below(1_000_000) as f64 / 1e3]).collect();
        scene["map"]["lanes"][0]["points_m"] = json!(points);
        let reply = server.send(&put(&format!("m{}", etags.len()), ("if-none-match", "*"), &scene)).unwrap();
        if reply.status != 201 {
            assert_eq!((reply.status, reply.code().as_str()), (507, "store-full"), "{}", reply.text());
            return etags;
        }
        etags.push(reply.header("etag").to_owned());
        assert!(etags.len() < 5_000, "the disk never fills");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn where_disks_can_be_mounted_a_store_alone_on_a_full_one_frees_all_of_it_again() {
    let folder = tempfile::tempdir().unwrap();
    let Some(_disk) = small_disk(folder.path(), "6m") else { return };
    let db = folder.path().join("scenes.sqlite");
    let mut counts = Vec::new();
    for round in 0..3 {
        // A new server finds the scenes of the previous one.
        let server = Server::start_at(&db, &[]).unwrap();
        server.wait_ready().unwrap();
        let etags = fill(&server, round);
        assert_eq!(server.get("/readyz").unwrap().status, 503);
        for (k, etag) in etags.iter().enumerate() {
            let delete = Request::new("DELETE", &format!("/v1/scenes/m{k}")).header("if-match", etag);
            let gone = server.send(&delete).unwrap();
            assert_eq!(gone.status, 204, "round {round}, scene {k} of {}: {}", etags.len(), gone.text());
        }
        assert_eq!(server.get("/readyz").unwrap().status, 200);
        counts.push(etags.len());
    }
    assert!(
        counts.iter().all(|count| 2 * count >= counts[0]),
        "room is lost from round to round: {counts:?}"
    );
}

#[cfg(target_os = "linux")]
#[test]
fn where_disks_can_be_mounted_a_server_starts_on_a_full_one() {
    let folder = tempfile::tempdir().unwrap();
    let Some(_disk) = small_disk(folder.path(), "6m") else { return };
    let db = folder.path().join("scenes.sqlite");
    let server = Server::start_at(&db, &[]).unwrap();
    server.wait_ready().unwrap();
    let etags = fill(&server, 1);
    drop(server);
    // Another program takes what is left.
    let mut other = std::fs::File::create(folder.path().join("other")).unwrap();
    while std::io::Write::write_all(&mut other, &[0; 4_096]).is_ok() {}
    let server = Server::start_at(&db, &[]).unwrap();
    for (k, etag) in etags.iter().enumerate() {
        let delete = Request::new("DELETE", &format!("/v1/scenes/m{k}")).header("if-match", etag);
        let gone = server.send(&delete).unwrap();
        assert_eq!(gone.status, 204, "scene {k} of {}: {}", etags.len(), gone.text());
    }
}

fn backed_up(db: &Path, copy: &Path) {
    let args = [OsStr::new("backup"), OsStr::new("--db"), db.as_os_str(), OsStr::new("-o"), copy.as_os_str()];
    assert!(std::process::Command::new(program()).args(args).status().unwrap().success());
}

#[test]
fn another_program_may_write_to_the_store_through_sqlite() {
    let folder = tempfile::tempdir().unwrap();
    let db = folder.path().join("scenes.sqlite");
    let server = Server::start_at(&db, &[]).unwrap();
    saved(&server, "a", &street(2, 20));
    backed_up(&db, &folder.path().join("copy"));
    saved(&server, "b", &street(2, 20));
    let other = rusqlite::Connection::open(&db).unwrap();
    other.execute("DELETE FROM scenes WHERE id = 'a'", []).unwrap();
    drop(other);
    assert_eq!(server.get("/v1/scenes/a").unwrap().status, 404);
    saved(&server, "c", &street(2, 20));
}

#[cfg(target_os = "linux")]
#[test]
fn a_store_that_is_gone_is_not_written_into() {
    type Fault = fn(&Path) -> std::io::Result<()>;
    let faults: [(&str, Fault); 7] = [
        ("removed", |db| std::fs::remove_file(db)),
        ("replaced", |db| std::fs::remove_file(db).and_then(|()| std::fs::write(db, b"other"))),
        ("emptied", |db| std::fs::write(db, b"")),
        ("without its log", |db| std::fs::remove_file(db.with_extension("sqlite-wal"))),
        ("without the index of its log", |db| std::fs::remove_file(db.with_extension("sqlite-shm"))),
        // In place, so that name and inode stay.
        ("overwritten by an older copy", |db| std::fs::copy(db.with_extension("older"), db).map(drop)),
        ("with an emptied log", |db| std::fs::write(db.with_extension("sqlite-wal"), b"")),
    ];
    for (name, fault) in faults {
        let folder = tempfile::tempdir().unwrap();
        let db = folder.path().join("scenes.sqlite");
        let server = Server::start_at(&db, &[]).unwrap();
        server.wait_ready().unwrap();
        saved(&server, "old", &street(2, 20));
        backed_up(&db, &db.with_extension("older"));
        saved(&server, "kept", &street(2, 20));
        // Times of files advance with the kernel's clock, every 1 to 10 ms. A change of equal length in the same tick as
        // the server's own write is not seen.
        std::thread::sleep(Duration::from_millis(20));
        fault(&db).unwrap();
        let refused = server.send(&put("lost", ("if-none-match", "*"), &street(2, 20))).unwrap();
        let told = (refused.status, refused.code());
        assert_eq!(told, (503, "store-unavailable".to_owned()), "{name}: {}", refused.text());
        let ready = server.get("/readyz").unwrap();
        assert_eq!((ready.status, &ready.json()["failing"][0]), (503, &json!("store")), "{name}");
    }
}

#[test]
fn a_scene_travels_compressed_under_an_etag_of_its_own() {
    let server = Server::start(&[]).unwrap();
    let made = saved(&server, "big", &street(9, 60));
    let plain = server.get("/v1/scenes/big").unwrap();
    let asked = Request::new("GET", "/v1/scenes/big").header("accept-encoding", "gzip");
    let packed = server.send(&asked).unwrap();
    assert_eq!((packed.header("content-encoding"), packed.header("vary")), ("gzip", "accept-encoding"));
    assert!(packed.body.len() * 3 < plain.body.len());
    assert_eq!(packed.json(), plain.json());
    let etag = packed.header("etag");
    assert_ne!(etag, made.header("etag"));
    for known in [etag, made.header("etag")] {
        assert_eq!(server.send(&asked.clone().header("if-none-match", known)).unwrap().status, 304);
    }
    // A scene read in compressed form can be replaced.
    let replaced = server.send(&put("big", ("if-match", etag), &street(2, 20))).unwrap();
    assert_eq!(replaced.status, 200, "{}", replaced.text());
    assert_eq!(server.send(&put("big", ("if-match", etag), &street(3, 20))).unwrap().code(), "stale-etag");
}

#[test]
fn a_preview_is_a_small_scene_of_those_who_are_there_at_first() {
    let server = Server::start(&[]).unwrap();
    let mut scene = street(3, 20);
    scene["time"]["steps"] = json!(25);
    scene["agents"][2]["track"]["first_step"] = json!(5);
    let made = saved(&server, "whole", &scene);
    let preview = server.get("/v1/scenes/whole/preview").unwrap();
    assert_eq!((preview.status, preview.header("etag")), (200, made.header("etag")));
    assert_eq!(preview.header("cache-control"), "private, no-cache");
    let small = preview.json();
    let agents = small["agents"].as_array().unwrap();
    assert_eq!(agents.len(), 2);
    for (agent, whole) in agents.iter().zip(scene["agents"].as_array().unwrap()) {
        assert_eq!(agent["id"], whole["id"]);
        let x = agent["track"]["x_m"].as_array().unwrap();
        assert_eq!(x.len(), 2);
        assert_eq!(x[0], whole["track"]["x_m"][0]);
    }
    assert_eq!(small["map"]["lanes"].as_array().unwrap().len(), 2);
    assert!(small["map"]["lanes"][0]["points_m"].as_array().unwrap().len() <= 3);
    let again = server.post("/v1/scenes", &small).unwrap();
    assert_eq!(again.status, 201, "a scene like any other: {}", again.text());
    let known =
        Request::new("GET", "/v1/scenes/whole/preview").header("if-none-match", preview.header("etag"));
    assert_eq!(server.send(&known).unwrap().status, 304);
    let demo = server.get("/v1/scenes/demo-crossing/preview").unwrap();
    let whole = server.get("/v1/scenes/demo-crossing").unwrap();
    assert!(demo.body.len() * 3 < whole.body.len(), "{} of {}", demo.body.len(), whole.body.len());
    assert_eq!(server.get("/v1/scenes/none/preview").unwrap().code(), "not-found");
}
