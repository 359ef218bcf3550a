//! A hosted server: tokens with rights, a proxy in front of it, probes, configuration.

#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a failed test panics")]

use dragtraffic_tests::{Request, Server, program};
use std::io::{Read, Write};
use std::time::Duration;

#[test]
fn a_proxy_can_publish_the_server_below_a_path() {
    let server = Server::start(&["--base-path", "/tools/drag/", "--trust-proxy", "127.0.0.1"]).unwrap();
    let get = |path: &str| server.get(path).unwrap();
    assert_eq!((get("/tools/drag/v1/info").status, get("/tools/drag/healthz").status), (200, 200));
    assert_eq!(
        (get("/healthz").status, get("/elsewhere").status, get("/tools/dragon/").status),
        (200, 404, 404)
    );
    let moved = get("/tools/drag?scene=a");
    assert_eq!((moved.status, moved.header("location")), (308, "/tools/drag/?scene=a"));
    assert_eq!(get("/tools/drag/docs/").header("location"), "/tools/drag/docs");
    assert!(get("/tools/drag/docs").text().contains("href=\"/tools/drag/docs/style.css\""));
    assert_eq!(get("/tools/drag/openapi.json").json()["servers"][0]["url"], "/tools/drag/");
    let problem = get("/tools/drag/v1/scenes/none").json();
    assert_eq!(problem["type"], "/tools/drag/docs/problems#not-found");
    assert_eq!(problem["instance"], "/tools/drag/v1/scenes/none");
    let scene = get("/tools/drag/v1/scenes/demo-crossing").json();
    let made = server.post("/tools/drag/v1/scenes", &scene).unwrap();
    let place = made.header("location").to_owned();
    assert!(place.starts_with("/tools/drag/v1/scenes/"), "{place}");
    assert_eq!(get(&place).status, 200);
    for path in ["tools", "/a//b", "/a/../b"] {
        assert!(Server::start(&["--base-path", path]).is_err(), "{path}");
    }
}

#[cfg(unix)]
#[test]
fn a_unix_socket_has_its_mode_and_replaces_the_one_of_a_server_that_ended() {
    use std::os::unix::fs::PermissionsExt;
    use std::os::unix::net::{UnixListener, UnixStream};
    let folder = tempfile::tempdir().unwrap();
    let socket = folder.path().join("drag.sock");
    let start = || {
        let listen = format!("unix:{}", socket.display());
        let flags = ["--listen", listen.as_str(), "--socket-mode", "660"];
        let mut command = Server::command(&folder.path().join("scenes.sqlite"), &flags);
        command.stdout(std::process::Stdio::null()).stderr(std::process::Stdio::null()).spawn().unwrap()
    };
    // The socket file that a killed server leaves behind.
    drop(UnixListener::bind(&socket).unwrap());
    let mut server = start();
    let ask = || -> std::io::Result<String> {
        let mut stream = UnixStream::connect(&socket)?;
        stream.write_all(b"GET /v1/info HTTP/1.1\r\nhost: localhost\r\nconnection: close\r\n\r\n")?;
        let mut reply = String::new();
        stream.read_to_string(&mut reply)?;
        Ok(reply)
    };
    let reply = (0..100).find_map(|_| {
        std::thread::sleep(Duration::from_millis(100));
        ask().ok()
    });
    assert!(reply.unwrap().starts_with("HTTP/1.1 200"));
    assert_eq!(std::fs::metadata(&socket).unwrap().permissions().mode() & 0o777, 0o660);
    assert_eq!(start().wait().unwrap().code(), Some(6), "another server listens there");
    let ended = std::process::Command::new("kill").arg(server.id().to_string()).status().unwrap();
    assert!(ended.success() && server.wait().unwrap().success() && !socket.exists());
    std::fs::write(&socket, "a file").unwrap();
    assert_eq!(start().wait().unwrap().code(), Some(1), "a file that is no socket");
}

#[test]
fn tokens_have_names_and_rights_and_change_without_a_restart() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("tokens");
    let path = file.to_str().unwrap();
    let [guest, anna, boss] = ["g", "a", "b"].map(|letter| letter.repeat(32));
    let write = |text: &str| {
        std::fs::write(&file, text).unwrap();
        set_mode(&file, 0o600);
    };
    write("anna write 0123456789abcdef0123456789abcdef\n");
    assert!(Server::start(&["--token-file", path]).is_err(), "an unknown right");
    write(&format!("# who may what\nguest read {guest}\nanna edit {anna}\nboss admin {boss}\n"));
    let server = Server::start(&["--token-file", path]).unwrap();
    let send = |method: &str, path: &str, token: &str| {
        let request = Request::new(method, path).header("authorization", &format!("Bearer {token}"));
        server.send(&request.header("if-match", "*")).unwrap()
    };
    let status = |method: &str, path: &str, token: &str| send(method, path, token).status;
    assert_eq!([&guest, &anna, &boss].map(|token| status("GET", "/v1/scenes", token)), [200; 3]);
    assert_eq!([&guest, &anna, &boss].map(|token| status("GET", "/metrics", token)), [403, 403, 200]);
    // 404: the token has the right, but the scene does not exist.
    assert_eq!([&guest, &anna, &boss].map(|token| status("DELETE", "/v1/scenes/a", token)), [403, 404, 404]);
    let refused = send("DELETE", "/v1/scenes/a", &guest);
    assert_eq!(refused.code(), "forbidden");
    assert_eq!(
        refused.json()["detail"],
        "The token \"guest\" has the right \"read\"; this operation needs \"edit\"."
    );
    let own = format!("http://{}", server.address);
    let form = Request::new("POST", "/").header("content-type", "application/x-www-form-urlencoded");
    let entered =
        server.send(&form.header("origin", &own).body(format!("token={anna}").into_bytes())).unwrap();
    let cookie = entered.header("set-cookie").split(';').next().unwrap().to_owned();
    let with = |method: &str, path: &str| {
        let request = Request::new(method, path).header("cookie", &cookie).header("if-match", "*");
        server.send(&request).unwrap().status
    };
    assert_eq!((with("DELETE", "/v1/scenes/a"), with("GET", "/metrics")), (404, 403));
    // A faulty file keeps the present tokens; a file without faults replaces them.
    write("anna\n");
    std::thread::sleep(Duration::from_millis(1_500));
    assert_eq!((status("GET", "/v1/scenes", &guest), with("GET", "/v1/scenes")), (200, 200));
    write(&format!("guest read {guest}\n"));
    let gone = (0..50).any(|_| {
        std::thread::sleep(Duration::from_millis(100));
        with("GET", "/v1/scenes") == 401
    });
    assert!(gone && status("GET", "/v1/scenes", &guest) == 200);
    let refused = send("GET", "/v1/scenes", &boss);
    assert_eq!(refused.json()["detail"], "The bearer token is not one of this server's.");
}

#[test]
fn probes_have_an_address_of_their_own_without_token() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("token");
    std::fs::write(&file, "0123456789abcdef0123456789abcdef").unwrap();
    set_mode(&file, 0o600);
    let free = std::net::TcpListener::bind("127.0.0.1:0").unwrap().local_addr().unwrap();
    let flags = ["--token-file", file.to_str().unwrap(), "--ops-address", &free.to_string()];
    let server = Server::start(&flags).unwrap();
    assert_eq!(server.get("/metrics").unwrap().status, 401);
    let probe = |path: &str| Request::new("GET", path).header("host", "pod-7:1").send(free).unwrap();
    assert_eq!((probe("/healthz").status, probe("/elsewhere").status), (200, 404));
    assert!([200, 503].contains(&probe("/readyz").status));
    let metrics = probe("/metrics").text();
    for name in ["dragtraffic_build_info", "process_resident_memory_bytes", "process_open_fds"] {
        assert!(metrics.contains(name) || cfg!(not(target_os = "linux")), "{name}");
    }
}

#[test]
fn every_metric_says_what_it_is() {
    let server = Server::with_demos().unwrap();
    server.wait_ready().unwrap();
    let body = serde_json::json!({"scene_id": "demo-crossing", "agents": ["5"]});
    assert_eq!(server.post("/v1/generate", &body).unwrap().status, 200);
    assert_eq!(server.get("/v1/scenes/demo-crossing/export?format=csv").unwrap().status, 200);
    let scene = server.get("/v1/scenes/demo-crossing").unwrap().json();
    assert_eq!(server.post("/v1/import?dry_run=true", &scene).unwrap().status, 200);
    let metrics = server.get("/metrics").unwrap().text();
    let named = |kind: &str| {
        let names = metrics.lines().filter_map(|line| line.strip_prefix(kind)?.split(' ').next());
        names.collect::<std::collections::BTreeSet<_>>()
    };
    let (types, helps) = (named("# TYPE "), named("# HELP "));
    assert!(types.len() > 15 && types.contains("dragtraffic_imports_total"), "{types:?}");
    assert_eq!(types, helps);
}

#[test]
fn options_come_from_the_command_line_the_environment_and_a_file_in_this_order() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("server.toml");
    let check = |text: &str, variables: &[(&str, &str)], flags: &[&str]| {
        std::fs::write(&file, text).unwrap();
        let mut command = std::process::Command::new(program::program());
        command.args(["serve", "--check", "--config"]).arg(&file).args(flags);
        let output = command.envs(variables.iter().copied()).output().unwrap();
        let text = [output.stdout, output.stderr].concat();
        (output.status.code(), String::from_utf8(text).unwrap())
    };
    let has = |found: &(Option<i32>, String), part: &str| assert!(found.1.contains(part), "{found:?}");
    let text = "port = 9001\nbase_path = \"/a\"\ntrust-proxy = [\"10.0.0.1\", \"unix\"]\n";
    let found = check(text, &[], &[]);
    assert_eq!(found.0, Some(0), "{found:?}");
    has(&found, "http://127.0.0.1:9001/a/\n");
    has(&found, "10.0.0.1, unix");
    has(&check(text, &[("DRAGTRAFFIC_PORT", "9002")], &[]), "127.0.0.1:9002/a/");
    has(&check(text, &[("DRAGTRAFFIC_PORT", "9002")], &["--port", "9003"]), "127.0.0.1:9003/a/");
    // All faults are reported at once, and no server starts.
    let faulty = "bind = \"0.0.0.0\"\ndata = \"none\"\nlimit = [\"queue=x\"]\ntrust_proxy = \"proxy\"\n";
    let found = check(faulty, &[], &[]);
    assert_eq!(found.0, Some(2), "{found:?}");
    for part in ["--bind 0.0.0.0", "--data none", "queue", "\"proxy\" found"] {
        has(&found, part);
    }
    for (text, part) in [
        ("colour = \"red\"", "\"colour\" is no option of serve"),
        ("port = 1.5", "port: a text, a whole number"),
        ("port = ", "--config"),
    ] {
        let found = check(text, &[], &[]);
        assert_eq!(found.0, Some(2), "{found:?}");
        has(&found, part);
    }
}

/// The program of this name: on the path, or in Debian's folder of server programs.
#[cfg(unix)]
fn installed(name: &str) -> Option<std::path::PathBuf> {
    let path = std::env::var_os("PATH").unwrap_or_default();
    let folders = std::env::split_paths(&path).chain(["/usr/sbin".into()]);
    folders.map(|folder| folder.join(name)).find(|path| path.is_file())
}

/// The first block of a page in this language.
#[cfg(unix)]
fn block(page: &str, language: &str) -> String {
    let text = std::fs::read_to_string(program::root().join(page)).unwrap();
    let (_, rest) = text.split_once(&format!("```{language}\n")).unwrap();
    rest.split_once("```").unwrap().0.to_owned()
}

#[cfg(unix)]
struct Ended(std::process::Child);

#[cfg(unix)]
impl Drop for Ended {
    fn drop(&mut self) {
        let _ = std::process::Command::new("kill").arg(self.0.id().to_string()).status();
        let _ = self.0.wait();
    }
}

#[cfg(unix)]
#[test]
fn with_nginx_the_server_and_the_proxy_of_the_documentation_work_together() {
    let given = std::env::var_os("NGINX").map(std::path::PathBuf::from);
    let Some(nginx) = given.or_else(|| installed("nginx")) else {
        println!("skipped: no nginx (apt install nginx-light)");
        return;
    };
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name).display().to_string();
    let token = "a".repeat(32);
    std::fs::write(at("tokens"), format!("anna edit {token}\n")).unwrap();
    set_mode(&folder.path().join("tokens"), 0o600);
    let [listen, probes] =
        [(); 2].map(|()| std::net::TcpListener::bind("127.0.0.1:0").unwrap().local_addr().unwrap());
    let options = block("docs/hosting.md", "toml")
        .replace("/run/dragtraffic/", &at(""))
        .replace("/etc/dragtraffic/", &at(""))
        .replace("/var/lib/dragtraffic/", &at(""))
        .replace("127.0.0.1:9090", &probes.to_string());
    std::fs::write(at("server.toml"), options).unwrap();
    let mut command = std::process::Command::new(program::program());
    command.args(["serve", "--config", &at("server.toml")]).stdout(std::process::Stdio::null());
    let _server = Ended(command.spawn().unwrap());
    let site = block("docs/hosting.md", "nginx")
        .replace("listen 443 ssl;", &format!("listen {listen};"))
        .replace("/run/dragtraffic/", &at(""));
    let plain: String =
        site.lines().filter(|line| !line.contains("ssl_certificate")).map(|l| l.to_owned() + "\n").collect();
    let temporary = ["client_body", "proxy", "fastcgi", "uwsgi", "scgi"]
        .map(|name| format!("{name}_temp_path {};\n", at(name)));
    let user = if std::process::Command::new("id").arg("-u").output().unwrap().stdout == b"0\n" {
        "user root;\n"
    } else {
        ""
    };
    let whole = format!(
        "{user}daemon off;\nerror_log {};\npid {};\nevents {{}}\nhttp {{ access_log off;\n{}{plain}}}\n",
        at("error.log"),
        at("nginx.pid"),
        temporary.concat()
    );
    std::fs::write(at("nginx.conf"), whole).unwrap();
    let mut command = std::process::Command::new(nginx);
    command.args(["-p", &at(""), "-e", &at("error.log"), "-c", &at("nginx.conf")]);
    let _proxy = Ended(command.spawn().unwrap());
    let send = |method: &str, path: &str| {
        let request = Request::new(method, path).header("host", "scenes.example").header("if-match", "*");
        request.header("authorization", &format!("Bearer {token}")).send(listen)
    };
    let ready = (0..100).any(|_| {
        std::thread::sleep(Duration::from_millis(100));
        send("GET", "/tools/drag/v1/info").is_ok_and(|reply| reply.status == 200)
    });
    let log = || std::fs::read_to_string(at("error.log")).unwrap_or_default();
    assert!(ready, "{}", log());
    assert_eq!(send("DELETE", "/tools/drag/v1/scenes/gone").unwrap().status, 404);
    let page = Request::new("GET", "/tools/drag/").header("host", "scenes.example").send(listen).unwrap();
    assert!(page.status == 401 && page.text().contains("This server needs a token"));
    let probe = Request::new("GET", "/healthz").send(probes).unwrap();
    assert_eq!(probe.status, 200);
    let line = (0..50).find_map(|_| {
        std::thread::sleep(Duration::from_millis(100));
        std::fs::read_to_string(at("audit.log")).ok().filter(|text| text.contains("gone"))
    });
    let line: serde_json::Value = serde_json::from_str(line.unwrap().lines().next().unwrap()).unwrap();
    assert_eq!((&line["who"], &line["from"]), (&"anna".into(), &"127.0.0.1".into()));
}

#[test]
fn a_request_sent_again_with_its_key_makes_nothing_twice() {
    let server = Server::with_demos().unwrap();
    let scene = server.get("/v1/scenes/demo-crossing").unwrap().json();
    let mut other = scene.clone();
    other["name"] = "another".into();
    let send = |body: &serde_json::Value, key: &str| {
        let request = Request::new("POST", "/v1/scenes").json(body).header("idempotency-key", key);
        server.send(&request).unwrap()
    };
    let first = send(&scene, "a");
    let again = send(&scene, "a");
    assert_eq!((first.status, again.status), (201, 201));
    assert_eq!((first.json(), first.header("location")), (again.json(), again.header("location")));
    assert_eq!(send(&other, "a").code(), "idempotency-key-reused");
    let made = send(&scene, "b");
    assert_ne!(made.json()["id"], first.json()["id"]);
    let copy = |key: &str| {
        let path = format!("/v1/scenes/{}/duplicate", first.json()["id"].as_str().unwrap());
        server.send(&Request::new("POST", &path).header("idempotency-key", key)).unwrap()
    };
    assert_eq!(copy("c").json(), copy("c").json());
    // The key of another address, a failure that can be retried, and no key.
    assert_eq!(copy("b").code(), "idempotency-key-reused");
    assert_eq!(send(&serde_json::json!({}), "d").status, 422);
    assert_eq!(send(&scene, "d").status, 201);
    assert_eq!(send(&scene, "").code(), "bad-header");
    let stored = server.get("/v1/scenes?limit=200").unwrap().json();
    let own = stored["scenes"].as_array().unwrap().iter().filter(|scene| scene["read_only"] != true);
    assert_eq!(own.filter(|scene| !scene["id"].as_str().unwrap().starts_with("demo-")).count(), 4);
}

#[test]
fn changes_and_refusals_are_in_the_audit_log() {
    let folder = tempfile::tempdir().unwrap();
    let [file, log] = ["tokens", "audit.log"].map(|name| folder.path().join(name));
    let [anna, guest] = ["a", "g"].map(|letter| letter.repeat(32));
    std::fs::write(&file, format!("anna edit {anna}\nguest read {guest}\n")).unwrap();
    set_mode(&file, 0o600);
    let flags = ["--token-file", file.to_str().unwrap(), "--audit", log.to_str().unwrap()];
    let server = Server::start(&[&flags[..], &["--trust-proxy", "127.0.0.1"]].concat()).unwrap();
    let send = |method: &str, path: &str, token: &str| {
        let request = Request::new(method, path).header("authorization", &format!("Bearer {token}"));
        server.send(&request.header("if-match", "*").header("x-forwarded-for", "192.0.2.7")).unwrap()
    };
    assert_eq!(send("GET", "/v1/scenes", &anna).status, 200);
    assert_eq!(send("DELETE", "/v1/scenes/gone", &anna).status, 404);
    assert_eq!(send("DELETE", "/v1/scenes/gone", &guest).status, 403);
    assert_eq!(send("GET", "/v1/scenes", "wrong").status, 401);
    let lines = (0..50).find_map(|_| {
        std::thread::sleep(Duration::from_millis(100));
        let text = std::fs::read_to_string(&log).ok()?;
        (text.lines().count() == 3).then_some(text)
    });
    let lines: Vec<serde_json::Value> =
        lines.unwrap().lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    let told = |i: usize, name: &str| lines[i][name].as_str().unwrap_or_default().to_owned();
    assert_eq!(
        (told(0, "who"), told(0, "scene"), told(0, "from")),
        ("anna".into(), "gone".into(), "192.0.2.7".into())
    );
    assert_eq!((told(0, "what"), &lines[0]["status"]), ("DELETE /v1/scenes/{id}".into(), &404.into()));
    assert_eq!(
        (told(1, "who"), &lines[1]["status"], &lines[2]["status"]),
        ("guest".into(), &403.into(), &401.into())
    );
    assert!(!told(0, "time").is_empty() && !told(0, "request_id").is_empty());
}

#[test]
fn each_request_is_logged_with_peer_user_bytes_and_trace_and_drags_are_sampled() {
    let folder = tempfile::tempdir().unwrap();
    let [file, log] = ["tokens", "log"].map(|name| folder.path().join(name));
    let anna = "a".repeat(32);
    std::fs::write(&file, format!("anna edit {anna}\n")).unwrap();
    set_mode(&file, 0o600);
    let mut command = std::process::Command::new(program::program());
    command
        .args(["--log-format", "json", "--log-level", "info", "serve", "--port", "0"])
        .args(["--trust-proxy", "127.0.0.1", "--token-file", file.to_str().unwrap(), "--db"])
        .arg(folder.path().join("s.sqlite"))
        .stderr(std::fs::File::create(&log).unwrap());
    let server = Server::launch(command).unwrap();
    let (trace, span) = ("4bf92f3577b34da6a3ce929d0e0e4736", "00f067aa0ba902b7");
    let with = |request: Request| {
        let request = request.header("authorization", &format!("Bearer {anna}"));
        let request = request.header("x-forwarded-for", "192.0.2.7").header("x-forwarded-user", "maria");
        server.send(&request.header("traceparent", &format!("00-{trace}-{span}-01"))).unwrap()
    };
    let body = serde_json::json!({"scene_id": "demo-crossing", "agents": ["5"], "score": false});
    let bytes = serde_json::to_vec(&body).unwrap().len();
    let replies: Vec<_> = (0..12).map(|_| with(Request::new("POST", "/v1/generate").json(&body))).collect();
    assert!(replies.iter().all(|reply| reply.status == 200));
    let missing = with(Request::new("GET", "/v1/scenes/gone").header("x-request-id", "mine"));
    assert_eq!(missing.status, 404);
    server.stop().unwrap();
    let text = std::fs::read_to_string(&log).unwrap();
    let lines = text.lines().map(|line| serde_json::from_str::<serde_json::Value>(line).unwrap());
    let lines: Vec<_> =
        lines.filter(|line| line["target"] == "access").map(|line| line["fields"].clone()).collect();
    let of = |route: &'static str| lines.iter().filter(move |line| line["route"] == route);
    let first = of("/v1/generate").next().unwrap();
    assert_eq!((&first["peer"], &first["user"]), (&"192.0.2.7".into(), &"maria".into()), "{first}");
    assert_eq!((&first["trace_id"], &first["span_id"]), (&trace.into(), &span.into()));
    assert_eq!(
        (first["received"].as_u64(), first["sent"].as_u64()),
        (Some(bytes as u64), Some(replies[0].body.len() as u64))
    );
    assert!(first["sent_ms"].as_f64() >= first["ms"].as_f64(), "{first}");
    // Requests without a line are counted by the next line, or came after the last one.
    let (logged, left_out) = of("/v1/generate")
        .fold((0, 0), |(n, left), line| (n + 1, left + line["left_out"].as_u64().unwrap_or(0)));
    assert!(logged < 12 && logged + left_out <= 12, "{logged} lines, {left_out} left out");
    let refused = of("/v1/scenes/{id}").next().unwrap();
    assert_eq!((&refused["status"], &refused["request_id"]), (&404.into(), &"mine".into()));
    assert_eq!(refused["sent"].as_u64(), Some(missing.body.len() as u64));
}

fn set_mode(path: &std::path::Path, mode: u32) {
    use std::os::unix::fs::PermissionsExt;
    std::fs::set_permissions(path, std::fs::Permissions::from_mode(mode)).unwrap();
}
