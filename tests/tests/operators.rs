//! Commands and limits for operators of a server: doctor, health, export-all, the mode of the token file,
//! memory.

#![allow(clippy::unwrap_used, reason = "a failed test panics")]

use dragtraffic_tests::program::program;
use dragtraffic_tests::scenes::{generate, street};
use dragtraffic_tests::{Request, Server};
use serde_json::{Value, json};
use std::path::Path;
use std::process::{Command, Output};

fn run(arguments: &[&str], variables: &[(&str, &str)]) -> (Option<i32>, String, String) {
    let mut command = Command::new(program());
    let Output { status, stdout, stderr } =
        command.args(arguments).envs(variables.iter().copied()).output().unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (status.code(), text(stdout), text(stderr))
}

#[test]
fn health_is_an_exit_code() {
    let free = std::net::TcpListener::bind("127.0.0.1:0").unwrap().local_addr().unwrap().to_string();
    let server = Server::start(&["--ops-address", &free]).unwrap();
    server.wait_ready().unwrap();
    let own = format!("http://{}", server.address);
    assert_eq!(run(&["health", &own], &[]), (Some(0), "ready\n".into(), String::new()));
    assert_eq!(run(&["health", &own, "--alive"], &[]).1, "ok\n");
    let variables = [("DRAGTRAFFIC_OPS_ADDRESS", free.replace("127.0.0.1", "0.0.0.0"))];
    let [(name, address)] = &variables;
    assert_eq!(
        run(&["health"], &[(name, address)]).0,
        Some(0),
        "a server on all addresses is asked by the loopback"
    );
    let port = server.address.port().to_string();
    assert_eq!(run(&["health"], &[("DRAGTRAFFIC_PORT", &port)]).0, Some(0));
    drop(server);
    let (code, told, why) = run(&["health", &own, "--timeout", "2"], &[]);
    assert_eq!((code, told.as_str()), (Some(1), ""));
    assert!(why.contains(&own) && why.contains("refused"), "{why}");
    assert_eq!(run(&["health", "https://a"], &[]).0, Some(2));
}

#[cfg(unix)]
#[test]
fn health_asks_a_socket_and_says_what_fails() {
    let folder = tempfile::tempdir().unwrap();
    let socket = format!("unix:{}", folder.path().join("drag.sock").display());
    let mut server = Server::command(&folder.path().join("s.sqlite"), &["--listen", &socket])
        .stdout(std::process::Stdio::null())
        .spawn()
        .unwrap();
    let ready = (0..200).any(|_| {
        std::thread::sleep(std::time::Duration::from_millis(100));
        run(&["health", &socket], &[]).0 == Some(0)
    });
    assert!(ready && run(&["health"], &[("DRAGTRAFFIC_LISTEN", &socket)]).0 == Some(0));
    std::fs::remove_file(folder.path().join("s.sqlite")).unwrap();
    let (code, _, why) = run(&["health", &socket], &[]);
    assert!(code == Some(1) && why.contains("503: Not ready: store."), "{why}");
    assert_eq!(run(&["health", &socket, "--alive"], &[]).0, Some(0));
    let _ = server.kill();
    let _ = server.wait();
}

#[cfg(target_os = "linux")]
#[test]
fn as_root_a_token_file_may_be_for_the_group_of_the_server() {
    use std::os::unix::fs::{MetadataExt, PermissionsExt, chown};
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("tokens");
    std::fs::write(&file, "0123456789abcdef0123456789abcdef").unwrap();
    let check = |mode: u32| {
        std::fs::set_permissions(&file, std::fs::Permissions::from_mode(mode)).unwrap();
        let (code, _, why) = run(&["serve", "--check", "--token-file", file.to_str().unwrap()], &[]);
        (code, why)
    };
    let is_roots = file.metadata().unwrap().uid() == 0;
    assert_eq!(check(0o440).0, Some(if is_roots { 0 } else { 2 }));
    let (code, why) = check(0o644);
    assert!(code == Some(2) && why.contains("mode 644: others may use it"), "{why}");
    assert_eq!(check(0o600).0, Some(0));
    if is_roots {
        chown(&file, Some(65_532), Some(65_532)).unwrap();
        let (code, why) = check(0o440);
        assert!(code == Some(2) && why.contains("its group may use it; chmod 600"), "{why}");
    }
}

#[test]
fn a_copy_takes_the_place_of_a_store_that_nobody_uses() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name).display().to_string();
    let (db, copy) = (at("scenes.sqlite"), at("copy.sqlite"));
    let server = Server::start_at(Path::new(&db), &[]).unwrap();
    let save = |server: &Server| server.post("/v1/scenes", &street(1, 20)).unwrap().json()["id"].clone();
    let first = save(&server);
    assert_eq!(run(&["backup", "--db", &db, "-o", &copy], &[]).0, Some(0));
    let second = save(&server);
    assert_eq!(run(&["restore", &copy, "--db", &db], &[]).0, Some(8), "the store is kept");
    let (code, _, why) = run(&["restore", &copy, "--db", &db, "--force"], &[]);
    assert!(code == Some(1) && why.contains("another process uses the store"), "{why}");
    let status = |server: &Server, id: &Value| {
        server.get(&format!("/v1/scenes/{}", id.as_str().unwrap())).unwrap().status
    };
    assert_eq!((status(&server, &first), status(&server, &second)), (200, 200));
    // The log that a kill leaves belongs to the replaced store, not to the copy.
    server.kill().unwrap();
    let (code, _, told) = run(&["restore", &copy, "--db", &db, "--force"], &[]);
    assert!(code == Some(0) && told.contains("1 scenes, sound"), "{told}");
    let server = Server::start_at(Path::new(&db), &[]).unwrap();
    assert_eq!((status(&server, &first), status(&server, &second)), (200, 404));
    assert_eq!(run(&["restore", &copy, "--db", &at("new.sqlite")], &[]).0, Some(0));
    assert_eq!(run(&["restore", &db, "--db", &db, "--force"], &[]).0, Some(2));
    std::fs::write(at("broken"), "no database").unwrap();
    assert_eq!(run(&["restore", &at("broken"), "--db", &at("newer.sqlite")], &[]).0, Some(1));
    assert!(!Path::new(&at("newer.sqlite")).exists());
}

/// Findings of the doctor by subject, with its exit code.
fn doctor(flags: &[&str]) -> (Option<i32>, Vec<(String, String, String)>) {
    let (code, text, _) = run(&[&["doctor", "--json"], flags].concat(), &[]);
    let report: Value = serde_json::from_str(&text).unwrap();
    assert_eq!(report["ok"], code == Some(0));
    let text = |finding: &Value, name: &str| finding[name].as_str().unwrap().to_owned();
    let findings = report["findings"].as_array().unwrap().iter();
    (code, findings.map(|f| (text(f, "what"), text(f, "verdict"), text(f, "detail"))).collect())
}

#[cfg(target_os = "linux")]
#[test]
fn the_doctor_says_what_a_machine_lacks() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name).display().to_string();
    let db = at("scenes.sqlite");
    let (code, found) = doctor(&["--port", "0", "--db", &db, "--data", folder.path().to_str().unwrap()]);
    assert_eq!(code, Some(0), "{found:?}");
    let names: Vec<&str> = found.iter().map(|(what, ..)| what.as_str()).collect();
    for what in ["options", "weights", "address", "store", "disk", "data", "descriptors", "memory", "clock"] {
        assert!(names.contains(&what), "{what} of {names:?}");
    }
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0, "it leaves nothing");
    let has = |flags: &[&str], what: &str, verdict: &str, part: &str| {
        let (code, found) = doctor(flags);
        let fits = |f: &(String, String, String)| f.0 == what && f.1 == verdict && f.2.contains(part);
        assert!(found.iter().any(fits), "{what}, {part}: {found:?}");
        assert_eq!(code, Some(i32::from(found.iter().any(|f| f.1 == "fault"))));
    };
    let taken = std::net::TcpListener::bind("127.0.0.1:0").unwrap();
    let port = taken.local_addr().unwrap().port().to_string();
    has(&["--db", &db, "--port", &port], "address", "fault", "in use");
    has(&["--db", &db, "--port", "0", "--memory", "900g"], "memory", "warning", "less with --memory");
    has(
        &["--db", &db, "--port", "0", "--limit", "connections=9000000000"],
        "descriptors",
        "warning",
        "ulimit -n",
    );
    has(
        &["--db", &db, "--port", "0", "--limit", "store_bytes=9000000000000000"],
        "disk",
        "warning",
        "store_bytes",
    );
    has(&["--db", "/proc/scenes.sqlite", "--port", "0"], "store", "fault", "/proc: making a file");
    std::fs::write(at("tokens"), "short").unwrap();
    std::fs::write(at("server.toml"), format!("token-file = \"{}\"\nlimit = \"queue=x\"\n", at("tokens")))
        .unwrap();
    let config = at("server.toml");
    has(&["--config", &config], "options", "fault", "others may use it");
    has(&["--config", &config], "options", "fault", "limit queue");
    std::fs::write(&db, "no database").unwrap();
    has(&["--db", &db, "--port", "0"], "store", "fault", "not a database");
    let (code, text, _) = run(&["doctor", "--db", &db, "--port", "0"], &[]);
    assert!(code == Some(1) && text.contains("listens on") && text.contains("FAULT   store"), "{text}");
}

#[test]
fn every_scene_of_a_store_is_written_as_a_file() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name).display().to_string();
    let db = folder.path().join("scenes.sqlite");
    let server = Server::start_at(&db, &[]).unwrap();
    let mut ids = Vec::new();
    for number in 0..3 {
        let mut scene = street(2, 20);
        scene["name"] = json!(format!("../{number}/ä"));
        let made = server.post("/v1/scenes", &scene).unwrap();
        ids.push(made.json()["id"].as_str().unwrap().to_owned());
    }
    // Beside the running server, whose log has the newest scene.
    let (code, _, told) = run(&["export-all", &at("scenes.sqlite"), "-o", &at("out")], &[]);
    assert!(code == Some(0) && told.contains("3 scenes"), "{told}");
    let list = std::fs::read_to_string(folder.path().join("out/scenes.ndjson")).unwrap();
    let lines: Vec<Value> = list.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    assert_eq!(lines.len(), 3);
    for (line, number) in lines.iter().zip(0..) {
        let id = line["id"].as_str().unwrap();
        assert!(ids.iter().any(|own| own == id) && line["name"] == format!("../{number}/ä"));
        let file = folder.path().join("out").join(line["file"].as_str().unwrap());
        let scene: Value = serde_json::from_slice(&std::fs::read(&file).unwrap()).unwrap();
        assert_eq!(scene, server.get(&format!("/v1/scenes/{id}")).unwrap().json());
        assert_eq!(run(&["score", file.to_str().unwrap()], &[]).0, Some(0), "it is a file like any other");
    }
    let names =
        || std::fs::read_dir(folder.path()).unwrap().map(|e| e.unwrap().file_name()).collect::<Vec<_>>();
    let before = names().len();
    let again = run(&["export-all", &at("scenes.sqlite"), "-o", &at("out")], &[]);
    assert!(again.0 == Some(8) && again.2.contains("exists; export-all makes a new folder"), "{}", again.2);
    let (code, _, told) =
        run(&["export-all", &at("scenes.sqlite"), "-o", &at("xosc"), "--format", "openscenario"], &[]);
    assert_eq!((code, std::fs::read_dir(at("xosc")).unwrap().count()), (Some(0), 4), "{told}");
    assert_eq!(run(&["export-all", &at("none"), "-o", &at("new")], &[]).0, Some(3));
    std::fs::write(at("other"), "no database").unwrap();
    assert_eq!(run(&["export-all", &at("other"), "-o", &at("new")], &[]).0, Some(1));
    assert!(!Path::new(&at("new")).exists() && names().len() == before + 2, "nothing half written stays");
}

#[cfg(target_os = "linux")]
#[test]
fn what_does_not_fit_into_the_memory_is_refused_and_the_server_goes_on() {
    // The least memory of a server: 128 MB for requests.
    let flags = ["--memory", "384m", "--limit", "body_grace_s=120", "--limit", "body_read_s=120"];
    let server = Server::start(&flags).unwrap();
    server.wait_ready().unwrap();
    let held = server.post("/v1/generate", &{
        let mut body = generate(2);
        body["hold"] = json!(true);
        body
    });
    assert_eq!(held.unwrap().status, 200);
    // Bodies that take long: each has sent 15 MB of 16.
    let part = vec![b' '; 15 << 20];
    let long = Request::new("POST", "/v1/generate").header("content-type", "application/json");
    let long = long.body(part).length("16000000");
    let slow: Vec<_> = (0..8).map(|_| long.open(server.address).unwrap()).collect();
    let small = generate(2);
    let refused = (0..200).find_map(|_| {
        std::thread::sleep(std::time::Duration::from_millis(50));
        let mut scene = small["scene"].clone();
        scene["x_long"] = json!("x".repeat(12 << 20));
        let reply = server.post("/v1/export", &scene).unwrap();
        (reply.status != 200).then_some(reply)
    });
    let refused = refused.unwrap();
    assert_eq!((refused.status, refused.code().as_str()), (503, "busy"), "{}", refused.text());
    assert!(refused.json()["retry_after_ms"].is_u64() && !refused.header("retry-after").is_empty());
    // A drag still fits.
    assert_eq!(
        server.post("/v1/generate", &json!({"scene_id": "demo-crossing", "agents": ["5"]})).unwrap().status,
        200
    );
    assert_eq!(server.get("/readyz").unwrap().status, 200);
    let taken = server.metric("dragtraffic_memory_taken_bytes").unwrap();
    assert!(taken > 110e6 && taken <= server.metric("dragtraffic_memory_budget_bytes").unwrap(), "{taken}");
    drop(slow);
    let free = (0..100).any(|_| {
        std::thread::sleep(std::time::Duration::from_millis(50));
        server.post("/v1/export", &small["scene"]).unwrap().status == 200
    });
    assert!(free, "the memory is given back");
    // A file that can never fit: half of the budget is for one import.
    let file = vec![b'x'; 129 << 20];
    let upload =
        Request::new("POST", "/v1/import?dry_run=true").header("content-type", "text/csv").body(file);
    let refused = upload.send(server.address).unwrap();
    assert_eq!((refused.status, refused.code().as_str()), (413, "body-too-large"), "{}", refused.text());
    assert_eq!(refused.json()["limit"], 128 << 20);
    let peak = server.peak_memory().unwrap();
    assert!(peak < 384 << 20, "{peak} bytes");
}
