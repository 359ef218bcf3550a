//! Requests that no correct client sends: each is refused with its code, and the server stays up. `cargo test
//! -p dragtraffic-tests --test malformed -- --nocapture` prints the table.

#![allow(clippy::unwrap_used, clippy::panic, clippy::print_stdout, reason = "a failed test panics")]

use dragtraffic_tests::scenes::{generate, street};
use dragtraffic_tests::{Reply, Request, Server};
use serde_json::{Value, json};
use std::io::Write;

struct Case {
    what: &'static str,
    request: Request,
    status: u16,
    code: &'static str,
}

fn case(what: &'static str, request: Request, status: u16, code: &'static str) -> Case {
    Case { what, request, status, code }
}

fn post(path: &str) -> Request {
    Request::new("POST", path).header("content-type", "application/json")
}

/// A generate body with one member replaced by a value.
fn with(pointer: &str, value: Value) -> Request {
    let mut body = generate(2);
    set(&mut body, pointer, value);
    post("/v1/generate").body(body.to_string())
}

/// The same with the value as raw text, for what `Value` cannot hold.
fn with_raw(pointer: &str, raw: &str) -> Request {
    let mut body = generate(2);
    set(&mut body, pointer, json!("@@"));
    post("/v1/generate").body(body.to_string().replace("\"@@\"", raw))
}

fn set(body: &mut Value, pointer: &str, value: Value) {
    let (parent, key) = pointer.rsplit_once('/').unwrap();
    let parent = body.pointer_mut(parent).unwrap();
    match parent {
        Value::Array(items) => items[key.parse::<usize>().unwrap()] = value,
        _ => parent[key] = value,
    }
}

fn gzip(data: &[u8]) -> Vec<u8> {
    let mut encoder = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::best());
    encoder.write_all(data).unwrap();
    encoder.finish().unwrap()
}

fn json_cases() -> Vec<Case> {
    let deep = "[".repeat(200) + &"]".repeat(200);
    vec![
        case("empty body", post("/v1/generate"), 400, "malformed-json"),
        case("half a document", post("/v1/generate").body("{\"scene\":"), 400, "malformed-json"),
        case("not JSON", post("/v1/generate").body("<scene/>"), 400, "malformed-json"),
        case("invalid UTF-8", post("/v1/scenes").body(vec![b'"', 0xff, b'"']), 400, "malformed-json"),
        case("NaN token", with_raw("/conditions/0/goal/x_m", "NaN"), 400, "malformed-json"),
        case("Infinity token", with_raw("/conditions/0/goal/x_m", "Infinity"), 400, "malformed-json"),
        case("1e400", with_raw("/conditions/0/goal/x_m", "1e400"), 400, "malformed-json"),
        case("nested 200 deep", post("/v1/generate").body(deep.clone()), 422, "invalid-field"),
        case("x_ member nested 200 deep", with_raw("/scene/x_deep", &deep), 400, "malformed-json"),
        case("trailing text", post("/v1/score").body("{} {}"), 400, "malformed-json"),
        case("\"NaN\" in quotes", with("/conditions/0/goal/x_m", json!("NaN")), 422, "invalid-field"),
        case("fraction for an integer", with("/samples", json!(1.5)), 422, "invalid-field"),
        case("negative for an integer", with("/seed", json!(-1)), 422, "invalid-field"),
        case("text for a list", with("/agents", json!("nobody")), 422, "invalid-field"),
        case("list for the body", post("/v1/generate").body("[]"), 422, "invalid-field"),
        case("unknown member", with("/speed", json!(1)), 422, "invalid-field"),
        case("misspelt condition", with("/conditions/0/goal/sped_mps", json!(1)), 422, "invalid-field"),
        case("unknown member of the scene", with("/scene/agnets", json!([])), 422, "invalid-field"),
        case("duplicate member", post("/v1/generate").body("{\"seed\":1,\"seed\":2}"), 422, "invalid-field"),
        case(
            "duplicate road user in conditions",
            post("/v1/generate").body("{\"conditions\":{\"0\":{},\"0\":{}}}"),
            422,
            "invalid-field",
        ),
        case("neither scene nor scene_id", post("/v1/generate").body("{}"), 422, "invalid-field"),
        case("both scene and scene_id", with("/scene_id", json!("a")), 422, "invalid-field"),
    ]
}

fn condition_cases() -> Vec<Case> {
    vec![
        case("1e29 metres", with("/conditions/0/goal/x_m", json!(1e29)), 422, "out-of-range"),
        case(
            "speed just outside",
            with("/conditions/0/goal/speed_mps", json!(60.000001)),
            422,
            "out-of-range",
        ),
        case("negative speed", with("/conditions/0/goal/speed_mps", json!(-0.1)), 422, "out-of-range"),
        case("vehicle of 25.1 m", with("/conditions/0/length_m", json!(25.1)), 422, "out-of-range"),
        case("goal 1501 m away", with("/conditions/0/goal/x_m", json!(1_500.0)), 422, "out-of-range"),
        case(
            "goal time before the start",
            with("/conditions/0/goal/time_s", json!(0.2)),
            422,
            "out-of-range",
        ),
        case("goal time after the end", with("/conditions/0/goal/time_s", json!(9.2)), 422, "out-of-range"),
        case("half a position", with("/conditions/0/goal", json!({"x_m": 1})), 422, "half-position"),
        case(
            "speed and velocity",
            with("/conditions/0/goal", json!({"speed_mps": 1, "velocity": {"x_mps": 1, "y_mps": 0}})),
            422,
            "invalid-field",
        ),
        case("expert `other`", with("/conditions/0/type", json!("other")), 422, "invalid-field"),
        case(
            "no edge to cross",
            with("/conditions/0/goal/may_cross", json!(["ghost"])),
            422,
            "invalid-field",
        ),
        case(
            "a via point without a place",
            with("/conditions/0/via", json!([{"x_m": 1}])),
            422,
            "invalid-field",
        ),
        case(
            "a via point beside the world",
            with("/conditions/0/via", json!([{"x_m": 1, "y_m": 1e5}])),
            422,
            "out-of-range",
        ),
        case(
            "five via points",
            with("/conditions/0/via", vec![json!({"x_m": 1, "y_m": 1}); 5].into()),
            422,
            "invalid-field",
        ),
        case("conditions of a stranger", with("/conditions/ghost", json!({})), 422, "unknown-agent"),
        case("stranger to regenerate", with("/agents/0", json!("ghost")), 422, "unknown-agent"),
        case("nobody to regenerate", with("/agents", json!([])), 422, "invalid-field"),
        case("stranger to remove", with("/remove_agents", json!(["ghost"])), 422, "unknown-agent"),
        case("id with NUL", with("/agents/0", json!("a\u{0}b")), 422, "unknown-agent"),
        case("seed above 2^53", with("/seed", json!(1u64 << 54)), 422, "out-of-range"),
        case("33 samples", with("/samples", json!(33)), 422, "out-of-range"),
        case("no modes", with("/modes", json!(0)), 422, "out-of-range"),
        case("101 steps", with("/steps", json!(101)), 422, "out-of-range"),
        case("diversity of 2.1", with("/diversity", json!(2.1)), 422, "out-of-range"),
        case("horizon of 20.1 s", with("/horizon_s", json!(20.1)), 422, "out-of-range"),
        case("horizon of 0.4 s", with("/horizon_s", json!(0.4)), 422, "out-of-range"),
        case("goal time after the end of 20 s", late_goal(), 422, "out-of-range"),
        case("start after the scene", with("/start_s", json!(9.2)), 422, "out-of-range"),
        case("re-planning each 4 s", with("/replan_interval_s", json!(4)), 422, "invalid-field"),
        case("re-planning all the time", with("/replan_interval_s", json!(0)), 422, "invalid-field"),
        case("re-planning each \"3\"", with("/replan_interval_s", json!("3")), 422, "invalid-field"),
        case("re-planning each 30 s", with("/replan_interval_s", json!(30)), 422, "invalid-field"),
        case("client without revision", with("/client", json!("a")), 422, "invalid-field"),
        case("job id with dots", with("/job", json!("../x")), 422, "invalid-field"),
        case("reply of a million points", reply_too_large(), 422, "reply-too-large"),
        case("57 s of a core", too_much_work(), 422, "too-much-work"),
        case("129 road users to regenerate", many(), 422, "too-many-agents"),
        case("collisions 1e244 s ahead", threshold("ttc_s", 1e244), 422, "out-of-range"),
        case("a gap below nothing", threshold("gap_m", -2e12), 422, "out-of-range"),
        case("a share of 2.1", threshold("covered_share", 2.1), 422, "out-of-range"),
        case("braking of 1e16 m/s2", threshold("follow_brake_mps2", 1e16), 422, "out-of-range"),
    ]
}

/// A score with one threshold.
fn threshold(name: &str, value: f64) -> Request {
    post("/v1/score").json(&json!({"scene": street(2, 91), "thresholds": {name: value}}))
}

fn late_goal() -> Request {
    let mut body = generate(2);
    body["horizon_s"] = json!(20);
    body["conditions"]["0"]["goal"]["time_s"] = json!(20.1);
    post("/v1/generate").body(body.to_string())
}

fn reply_too_large() -> Request {
    let mut body = generate(100);
    body["agents"] = json!("all");
    body["samples"] = json!(32);
    post("/v1/generate").body(body.to_string())
}

fn too_much_work() -> Request {
    let mut body = generate(128);
    body["agents"] = json!("all");
    (body["samples"], body["modes"], body["steps"]) = (json!(32), json!(1), json!(100));
    post("/v1/generate").body(body.to_string())
}

fn many() -> Request {
    let mut body = generate(129);
    body["agents"] = (0..129).map(|i| json!(i.to_string())).collect();
    body["modes"] = json!(1);
    post("/v1/generate").body(body.to_string())
}

fn scene_cases() -> Vec<Case> {
    let scene = |pointer: &str, value: Value| {
        let mut body = street(2, 20);
        set(&mut body, pointer, value);
        post("/v1/scenes").body(body.to_string())
    };
    let hash = format!("sha256:{}", "0".repeat(64));
    vec![
        case("another format", scene("/format", json!("other")), 422, "invalid-field"),
        case("version 2", scene("/version", json!(2)), 422, "unsupported-version"),
        case("no steps", scene("/time/steps", json!(0)), 422, "out-of-range"),
        case("601 steps", scene("/time/steps", json!(601)), 422, "out-of-range"),
        case("step of 0.2 s", scene("/time/step_s", json!(0.2)), 422, "invalid-field"),
        case("map by unknown hash", scene("/map", json!({"ref": hash})), 422, "unknown-map"),
        case("map by no hash", scene("/map", json!({"ref": "sha256:zz"})), 422, "invalid-field"),
        case("lane of one point", scene("/map/lanes/0/points_m", json!([[0, 0]])), 422, "invalid-field"),
        case(
            "point of four numbers",
            scene("/map/lanes/0/points_m/0", json!([0, 0, 0, 0])),
            422,
            "invalid-field",
        ),
        case("point at 20 km", scene("/map/lanes/0/points_m/0", json!([20_000, 0])), 422, "out-of-range"),
        case(
            "track longer than the scene",
            scene("/agents/0/track/first_step", json!(5)),
            422,
            "invalid-field",
        ),
        case("columns of unequal length", scene("/agents/0/track/y_m", json!([0])), 422, "invalid-field"),
        case("two road users of one id", scene("/agents/1/id", json!("0")), 422, "invalid-field"),
        case("id with a slash", scene("/agents/0/id", json!("a/b")), 422, "invalid-field"),
        case("vehicle of 100 m", scene("/agents/0/length_m", json!(100)), 422, "out-of-range"),
        case("unknown type", scene("/agents/0/type", json!("ufo")), 422, "invalid-field"),
        case("257 road users", post("/v1/scenes").body(street(257, 2).to_string()), 422, "too-many-agents"),
        case("line of 5000 points", scene("/map/lanes/0/points_m", long_line()), 422, "map-too-large"),
    ]
}

fn long_line() -> Value {
    (0..5_000).map(|i| json!([i, 0])).collect()
}

fn http_cases() -> Vec<Case> {
    let get = |path: &str| Request::new("GET", path);
    let one = street(1, 5).to_string();
    let put = |path: &str| Request::new("PUT", path).header("content-type", "application/json");
    let skippable = [0x50, 0x2a, 0x4d, 0x18, 4, 0, 0, 0, 1, 2, 3, 4];
    let encoded =
        |coding: &str, body: Vec<u8>| post("/v1/scenes").header("content-encoding", coding).body(body);
    vec![
        case("foreign Host", get("/healthz").header("host", "evil.example"), 421, "host-not-allowed"),
        case(
            "Host with another port",
            get("/v1/scenes").header("host", "localhost:1"),
            421,
            "host-not-allowed",
        ),
        case("no Host", get("/healthz").without_host(), 400, "bad-host"),
        case(
            "foreign Origin",
            post("/v1/scenes").header("origin", "http://evil.example").body(one.clone()),
            403,
            "bad-origin",
        ),
        case("Origin null", post("/v1/scenes").header("origin", "null").body(one.clone()), 403, "bad-origin"),
        case("cross-site read", get("/v1/scenes").header("sec-fetch-site", "cross-site"), 403, "cross-site"),
        case("unknown address", get("/v1/nothing"), 404, "not-found"),
        case("no such scene", get("/v1/scenes/nothing"), 404, "not-found"),
        case("dots for an id", get("/v1/scenes/.."), 404, "not-found"),
        case("escaped dots for an id", get("/v1/scenes/%2e%2e%2fetc"), 404, "not-found"),
        case("NUL in an id", get("/v1/scenes/a%00b"), 404, "not-found"),
        case("invalid UTF-8 in an id", get("/v1/scenes/%ff"), 404, "not-found"),
        case("id of 65 letters", get(&format!("/v1/scenes/{}", "a".repeat(65))), 404, "not-found"),
        case("no such map", get(&format!("/v1/maps/{}", "0".repeat(64))), 404, "not-found"),
        case("map by a name", get("/v1/maps/../../etc/passwd"), 404, "not-found"),
        case("wrong method", Request::new("PUT", "/v1/scenes"), 405, "method-not-allowed"),
        case("wrong method on a page", Request::new("POST", "/"), 405, "method-not-allowed"),
        case(
            "Accept: image/png",
            post("/v1/generate").header("accept", "image/png").body("{}"),
            406,
            "not-acceptable",
        ),
        case(
            "body of a form",
            Request::new("POST", "/v1/scenes").header("content-type", "text/plain").body("{}"),
            415,
            "unsupported-media-type",
        ),
        case("no Content-Type", Request::new("POST", "/v1/scenes").body("{}"), 415, "unsupported-media-type"),
        case("unknown Content-Encoding", encoded("br", b"x".to_vec()), 415, "unsupported-media-type"),
        case("two Content-Encodings", encoded("gzip, gzip", b"x".to_vec()), 415, "unsupported-media-type"),
        case("gzip bomb", encoded("gzip", gzip(&vec![b' '; 32 << 20])), 413, "expansion-too-high"),
        case(
            "zstd bomb",
            encoded("zstd", zstd::encode_all(&vec![b' '; 32 << 20][..], 3).unwrap()),
            413,
            "expansion-too-high",
        ),
        case("broken gzip", encoded("gzip", b"not gzip at all".to_vec()), 400, "malformed-file"),
        case(
            "zstd frame that decodes to nothing",
            encoded("zstd", skippable.to_vec()),
            400,
            "malformed-json",
        ),
        case("body above the limit", post("/v1/scenes").body(vec![b' '; 2 << 20]), 413, "body-too-large"),
        case(
            "Content-Length above the limit",
            post("/v1/scenes").length("99999999999"),
            413,
            "body-too-large",
        ),
        case("Content-Length that lies", post("/v1/scenes").length("5000").body("{}"), 408, "body-timeout"),
        case("address of 9 kB", get(&format!("/v1/scenes?q={}", "a".repeat(9_000))), 414, "uri-too-long"),
        case(
            "header of 20 kB",
            get("/v1/scenes").header("x-a", &"a".repeat(20_000)),
            431,
            "headers-too-large",
        ),
        case(
            "70 headers",
            (0..70).fold(get("/v1/scenes"), |r, i| r.header(&format!("x-{i}"), "1")),
            431,
            "headers-too-large",
        ),
        case("limit of 0", get("/v1/scenes?limit=0"), 422, "out-of-range"),
        case("limit in words", get("/v1/scenes?limit=ten"), 422, "invalid-field"),
        case("unknown parameter", get("/v1/scenes?colour=red"), 422, "invalid-field"),
        case("unknown cursor", get("/v1/scenes?after=zzz"), 422, "invalid-field"),
        case(
            "PUT without precondition",
            put("/v1/scenes/kept").body(one.clone()),
            428,
            "precondition-required",
        ),
        case(
            "PUT over an existing id",
            put("/v1/scenes/kept").header("if-none-match", "*").body(one.clone()),
            412,
            "stale-etag",
        ),
        case(
            "PUT with a stale ETag",
            put("/v1/scenes/kept").header("if-match", "\"1-aa\"").body(one.clone()),
            412,
            "stale-etag",
        ),
        case(
            "PUT of nothing with If-Match",
            put("/v1/scenes/gone").header("if-match", "*").body(one),
            412,
            "stale-etag",
        ),
        case(
            "DELETE without precondition",
            Request::new("DELETE", "/v1/scenes/kept"),
            428,
            "precondition-required",
        ),
        case(
            "PATCH of agents",
            Request::new("PATCH", "/v1/scenes/kept")
                .header("if-match", "*")
                .header("content-type", "application/merge-patch+json")
                .body("{\"agents\":[]}"),
            422,
            "invalid-field",
        ),
        case("export to an unknown format", get("/v1/scenes/kept/export?format=doc"), 422, "format-unknown"),
        case("export of sample 3", get("/v1/scenes/kept/export?sample=3"), 422, "out-of-range"),
    ]
}

fn import_cases() -> Vec<Case> {
    let upload = |body: Vec<u8>| {
        Request::new("POST", "/v1/import").header("content-type", "application/octet-stream").body(body)
    };
    // The head of a TFRecord: length, its checksum, then missing or wrong data.
    let mut truncated = 1_000u64.to_le_bytes().to_vec();
    truncated.extend([1, 2, 3, 4, 5]);
    let mut huge = (u64::MAX / 2).to_le_bytes().to_vec();
    huge.extend([0; 8]);
    let named = |body: Vec<u8>, format: &str| {
        Request::new("POST", &format!("/v1/import?format={format}"))
            .header("content-type", "application/octet-stream")
            .body(body)
    };
    vec![
        case("import of nothing", upload(Vec::new()), 422, "format-unknown"),
        case("import of noise", upload((0..=255).collect()), 422, "format-unknown"),
        case("import as an unknown format", named(vec![1], "pickle"), 422, "format-unknown"),
        case("import of half a TFRecord", named(truncated, "womd"), 400, "malformed-file"),
        case("TFRecord that promises exabytes", named(huge, "womd"), 400, "malformed-file"),
        case(
            "TFRecord of gzip garbage",
            named([&[0x1f, 0x8b, 8, 0][..], &[0xaa; 60]].concat(), "womd"),
            400,
            "malformed-file",
        ),
        case(
            "import as a form",
            Request::new("POST", "/v1/import")
                .header("content-type", "application/x-www-form-urlencoded")
                .body("a=b"),
            415,
            "unsupported-media-type",
        ),
        case(
            "index backwards",
            Request::new("POST", "/v1/import?index=5..2")
                .header("content-type", "application/octet-stream")
                .body("x"),
            422,
            "invalid-field",
        ),
    ]
}

fn check(server: &Server, case: &Case) -> Result<Reply, String> {
    let reply = server.send(&case.request).map_err(|error| format!("no reply: {error:#}"))?;
    if (reply.status, reply.code().as_str()) != (case.status, case.code) {
        return Err(format!("{} {}: {}", reply.status, reply.code(), reply.text()));
    }
    let body = reply.json();
    let complete = ["type", "title", "detail", "instance", "request_id"].iter().all(|m| body[*m].is_string());
    let leaks =
        ["/root", "/home", ".rs:", "SELECT", "panicked"].iter().any(|word| reply.text().contains(word));
    if !complete
        || leaks
        || body["status"] != case.status
        || reply.header("x-request-id") != body["request_id"]
    {
        return Err(format!("not a clean problem: {body}"));
    }
    if case.status == 405 && reply.header("allow").is_empty() {
        return Err("405 without Allow".into());
    }
    Ok(reply)
}

#[test]
fn every_malformed_request_is_refused_with_its_code() {
    let flags = ["--limit", "json_encoded_bytes=1048576", "--limit", "body_read_s=1"];
    let server = Server::start(&flags).unwrap();
    let kept = Request::new("PUT", "/v1/scenes/kept").header("if-none-match", "*").json(&street(1, 5));
    assert_eq!(server.send(&kept).unwrap().status, 201);
    let groups = [json_cases(), condition_cases(), scene_cases(), http_cases(), import_cases()];
    let cases: Vec<Case> = groups.into_iter().flatten().collect();
    let mut failures = Vec::new();
    for case in &cases {
        let verdict = check(&server, case);
        println!("{:<44} {} {}", case.what, case.status, case.code);
        if let Err(why) = verdict {
            failures.push(format!("{}: expected {} {}, got {why}", case.what, case.status, case.code));
        }
        assert_eq!(server.get("/healthz").unwrap().status, 200, "after {}", case.what);
    }
    println!("{} malformed requests", cases.len());
    assert!(failures.is_empty(), "{}", failures.join("\n"));
    assert!(cases.len() >= 45);
}

#[test]
fn faults_of_a_scene_are_named_by_their_place_in_the_body() {
    let server = Server::start(&[]).unwrap();
    let mut scene = street(1, 5);
    scene["agents"][0]["length_m"] = json!(-1.0);
    for path in ["/v1/generate", "/v1/place", "/v1/score"] {
        let reply = server.post(path, &json!({ "scene": scene })).unwrap();
        assert_eq!(reply.status, 422, "{path}: {}", reply.text());
        assert_eq!(reply.json()["errors"][0]["pointer"], "/scene/agents/0/length_m", "{path}");
    }
}

#[test]
fn every_call_about_a_scene_can_name_its_version() {
    let server = Server::start(&[]).unwrap();
    let kept = Request::new("PUT", "/v1/scenes/kept").header("if-none-match", "*").json(&street(2, 20));
    let etag = server.send(&kept).unwrap().header("etag").to_owned();
    for path in ["/v1/generate", "/v1/place", "/v1/score"] {
        let known = server.post(path, &json!({"scene_id": "kept", "etag": etag})).unwrap();
        assert_eq!(known.status, 200, "{path}: {}", known.text());
        let stale = server.post(path, &json!({"scene_id": "kept", "etag": "\"0-0\""})).unwrap();
        assert_eq!((stale.status, stale.code().as_str()), (412, "stale-etag"), "{path}");
        assert_eq!(stale.json()["etag"], etag, "{path}");
    }
}

/// Status and pointer of the refusal of a malformed member.
fn place_of_fault(request: &Request, server: &Server) -> (u16, String) {
    let reply = server.send(request).unwrap();
    let pointer = reply.json().pointer("/errors/0/pointer").and_then(Value::as_str).map(str::to_owned);
    (reply.status, pointer.unwrap_or_else(|| reply.text()))
}

#[test]
fn a_list_is_never_read_as_an_object_and_null_is_no_map() {
    let server = Server::start(&[]).unwrap();
    let place = |request: Request| place_of_fault(&request, &server);
    let scene = |pointer: &str, value: Value| {
        let mut body = street(2, 20);
        set(&mut body, pointer, value);
        post("/v1/scenes").body(body.to_string())
    };
    let refused = |pointer: &str| (422, pointer.to_owned());
    assert_eq!(place(with("/conditions/0/goal", json!([61, 3.4]))), refused("/conditions/0/goal"));
    assert_eq!(place(with("/conditions/0", json!([]))), refused("/conditions/0"));
    assert_eq!(place(scene("/time", json!([0.1, 20, 10]))), refused("/time"));
    assert_eq!(place(scene("/meta", json!([]))), refused("/meta"));
    assert_eq!(place(scene("/agents/1", json!(["1", "vehicle"]))), refused("/agents/1"));
    assert_eq!(place(scene("/agents/0/track", json!([0]))), refused("/agents/0/track"));
    assert_eq!(place(scene("/map", json!({"ref": null}))), refused("/map/ref"));
    assert_eq!(place(scene("/map/ref", json!(null))), refused("/map/ref"));
    let demo = json!([null, "demo-crossing"]).to_string();
    for path in ["/v1/generate", "/v1/score", "/v1/place"] {
        assert_eq!(place(post(path).body(demo.clone())), refused(""), "{path}");
    }
    assert_eq!(place(post("/v1/scenes/demo-crossing/duplicate").body("[]")), refused(""));
    let track = json!({"scene_id": "demo-crossing", "reference": {"1": [0, [1.0]]}}).to_string();
    assert_eq!(place(post("/v1/score").body(track)), refused("/reference/1"));
}

#[test]
fn a_member_of_several_forms_says_which_it_takes() {
    let server = Server::start(&[]).unwrap();
    for (pointer, value, expected) in [
        ("/agents", json!(5), "\"all\" or a list of ids of road users is expected"),
        ("/agents", json!([null]), "\"all\" or a list of ids of road users is expected"),
        ("/react", json!(null), "true, false or a list of ids of road users is expected"),
    ] {
        let refused = server.send(&with(pointer, value)).unwrap().json();
        assert_eq!(refused["detail"], json!(format!("{pointer}: {expected}")));
    }
}

#[test]
fn names_and_notes_have_a_length() {
    let server = Server::start(&[]).unwrap();
    let named = |pointer: &str, length: usize| {
        let mut body = street(1, 5);
        body["meta"] = json!({"notes": ""});
        set(&mut body, pointer, json!("ü".repeat(length)));
        place_of_fault(&post("/v1/scenes").body(body.to_string()), &server)
    };
    assert_eq!((named("/name", 200).0, named("/meta/notes", 10_000).0), (201, 201));
    assert_eq!(named("/name", 201), (422, "/name".to_owned()));
    assert_eq!(named("/meta/notes", 10_001), (422, "/meta/notes".to_owned()));
}
