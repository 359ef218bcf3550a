//! Import and export of files over HTTP and on the command line.

#![allow(clippy::unwrap_used, clippy::panic, clippy::print_stdout, reason = "a failed test panics")]

use dragtraffic_tests::program::{program, root};
use dragtraffic_tests::scenes::street;
use dragtraffic_tests::{Request, Server};
use serde_json::{Value, json};
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// Real Waymo Open Motion scenes, if this machine has them.
fn womd() -> Option<PathBuf> {
    samples::folder("womd/val", ".tfrecord")
}

fn upload(path: &str, body: Vec<u8>) -> Request {
    Request::new("POST", path).header("content-type", "application/octet-stream").body(body)
}

fn run(arguments: &[&str]) -> Output {
    Command::new(program()).args(arguments).output().unwrap()
}

#[test]
fn a_scene_goes_through_the_native_format_unchanged() {
    let server = Server::start(&[]).unwrap();
    let made = upload("/v1/import", street(2, 20).to_string().into_bytes());
    let made = server.send(&made).unwrap();
    assert_eq!(made.status, 201, "{}", made.text());
    let id = made.json()["scenes"][0]["id"].as_str().unwrap().to_owned();
    let file = server.get(&format!("/v1/scenes/{id}/export")).unwrap();
    assert!(file.header("content-disposition").contains("attachment; filename=\"street"));
    assert_eq!(file.header("dragtraffic-licence"), "cc0");
    let dry = server.send(&upload("/v1/import?dry_run=true", file.body.clone())).unwrap();
    assert_eq!(dry.status, 200);
    let back = &dry.json()["scenes"][0]["scene"];
    for member in ["agents", "map", "signals", "time"] {
        assert_eq!(back[member], file.json()[member], "{member}");
    }
}

#[test]
fn demos_can_be_used_and_copied_but_not_changed() {
    let server = Server::with_demos().unwrap();
    let demo = server.get("/v1/scenes/demo-crossing").unwrap();
    let mut scene = demo.json();
    let change = Request::new("PUT", "/v1/scenes/demo-crossing").header("if-match", demo.header("etag"));
    let refused = server.send(&change.json(&scene)).unwrap();
    assert_eq!((refused.status, refused.code().as_str()), (403, "read-only"));
    let copy = server.post("/v1/scenes/demo-crossing/duplicate", &json!({"name": "mine"})).unwrap();
    let copy = server.get(copy.header("location")).unwrap().json();
    assert_eq!(
        (copy["name"].as_str(), copy["meta"]["parent_id"].as_str()),
        (Some("mine"), Some("demo-crossing"))
    );
    assert_eq!(copy["agents"], scene["agents"]);
    // A drag sends the map by its hash; the answer is the same.
    let ask = |scene: &Value| json!({"scene": scene, "agents": ["5"], "score": false});
    let inline = server.post("/v1/generate", &ask(&scene)).unwrap();
    assert_eq!(inline.status, 200, "{}", inline.text());
    scene["map"] = server.get("/v1/scenes/demo-crossing?map=ref").unwrap().json()["map"].clone();
    let by_hash = server.post("/v1/generate", &ask(&scene)).unwrap();
    assert_eq!(by_hash.json()["samples"], inline.json()["samples"]);
    let stale = json!({"scene_id": "demo-crossing", "etag": "\"1-0\""});
    assert_eq!(server.post("/v1/generate", &stale).unwrap().code(), "stale-etag");
}

#[test]
fn an_answer_can_be_saved_and_goes_stale_with_its_scene() {
    let server = Server::with_demos().unwrap();
    let mut scene = server.get("/v1/scenes/demo-crossing").unwrap().json();
    let answer = server.post("/v1/generate", &json!({"scene": scene, "agents": ["5"]})).unwrap().json();
    scene["generated"] = answer["generated"].clone();
    scene["generated"]["samples"] = answer["samples"].clone();
    let put = Request::new("PUT", "/v1/scenes/kept").header("if-none-match", "*").json(&scene);
    let saved = server.send(&put).unwrap();
    assert_eq!(saved.status, 201, "{}", saved.text());
    let kept = server.get("/v1/scenes/kept").unwrap().json();
    assert_eq!(kept["generated"]["stale"], false);
    assert_eq!(kept["generated"]["samples"], scene["generated"]["samples"]);
    scene["agents"][0]["conditions"] = json!({"goal": {"speed_mps": 3}});
    let put = Request::new("PUT", "/v1/scenes/kept").header("if-match", saved.header("etag")).json(&scene);
    assert_eq!(server.send(&put).unwrap().status, 200);
    assert_eq!(server.get("/v1/scenes/kept").unwrap().json()["generated"]["stale"], true);
}

#[test]
fn examples_of_the_document_work() {
    let server = Server::with_demos().unwrap();
    let document = server.get("/openapi.json").unwrap().json();
    for (path, operation) in [("/v1/generate", "post"), ("/v1/place", "post"), ("/v1/score", "post")] {
        let body =
            &document["paths"][path][operation]["requestBody"]["content"]["application/json"]["example"];
        let reply = server.post(path, body).unwrap();
        assert_eq!(reply.status, 200, "{path}: {}", reply.text());
    }
}

#[test]
fn a_form_may_carry_the_file() {
    let server = Server::start(&[]).unwrap();
    let form = format!(
        "--b\r\ncontent-disposition: form-data; name=\"file\"; filename=\"../../a.json\"\r\n\r\n{}\r\n--b--\r\n",
        street(1, 5)
    );
    let post = |body: &str| {
        let request =
            Request::new("POST", "/v1/import").header("content-type", "multipart/form-data; boundary=b");
        server.send(&request.body(body)).unwrap()
    };
    let made = post(&form);
    assert_eq!(made.status, 201, "{}", made.text());
    assert_eq!(post(&form.replace("name=\"file\"", "name=\"other\"")).code(), "invalid-field");
    assert_eq!(post("no form at all").code(), "malformed-file");
}

#[test]
fn a_scene_goes_through_womd() {
    let server = Server::start(&[]).unwrap();
    let scene = street(2, 91);
    let file = server.post("/v1/export?format=womd", &scene).unwrap();
    assert_eq!(file.status, 200, "{}", file.text());
    let back = server.send(&upload("/v1/import?dry_run=true", file.body.clone())).unwrap();
    assert_eq!(back.status, 200, "{}", back.text());
    assert_eq!(back.json()["format"], "womd");
    assert_eq!(back.json()["scenes"][0]["counts"]["vehicle"], 2);
    let mut broken = file.body;
    let middle = broken.len() / 2;
    broken[middle] ^= 0x55;
    let refused = server.send(&upload("/v1/import", broken)).unwrap();
    assert_eq!((refused.status, refused.code().as_str()), (400, "malformed-file"), "{}", refused.text());
    assert!(refused.json()["offset"].is_u64());
}

#[test]
fn real_scenes_are_listed_opened_scored_and_copied() {
    let Some(folder) = womd() else { return };
    let server = Server::start(&["--data", folder.to_str().unwrap()]).unwrap();
    let mut scenes = Vec::new();
    for _ in 0..600 {
        let page = server.get("/v1/scenes?limit=200&q=&sort=name").unwrap().json();
        scenes = page["scenes"].as_array().unwrap().clone();
        scenes.retain(|s| s["source"] == "womd");
        if !scenes.is_empty() {
            break;
        }
        std::thread::sleep(std::time::Duration::from_millis(100));
    }
    let first = &scenes[0];
    let id = first["id"].as_str().unwrap();
    assert!(id.starts_with("womd-") && first["readonly"] == true && first["licence"] == "waymo-nc");
    let scene = server.get(&format!("/v1/scenes/{id}")).unwrap();
    assert_eq!(scene.status, 200, "{}", scene.text());
    assert!(!scene.json()["map"]["lanes"].as_array().unwrap().is_empty());
    let by_ref = server.get(&format!("/v1/scenes/{id}?map=ref")).unwrap();
    assert!(by_ref.body.len() < scene.body.len());
    assert_eq!(by_ref.json()["map"]["ref"], format!("sha256:{}", first["map_sha256"].as_str().unwrap()));
    let score = server.post("/v1/score", &json!({"scene_id": id})).unwrap();
    assert_eq!(score.status, 200, "{}", score.text());
    let change = Request::new("DELETE", &format!("/v1/scenes/{id}")).header("if-match", "*");
    assert_eq!(server.send(&change).unwrap().code(), "read-only");
    let copy = server.send(&Request::new("POST", &format!("/v1/scenes/{id}/duplicate"))).unwrap();
    assert_eq!(copy.status, 201, "{}", copy.text());
}

#[test]
fn a_real_file_is_imported() {
    let Some(folder) = womd() else { return };
    let file = std::fs::read_dir(folder).unwrap().flatten().map(|f| f.path()).min().unwrap();
    let bytes = std::fs::read(&file).unwrap();
    let server = Server::start(&[]).unwrap();
    let made = server.send(&upload("/v1/import", bytes.clone())).unwrap();
    assert_eq!(made.status, 201, "{}", made.text());
    let made = made.json();
    assert_eq!(made["skipped"], json!([]));
    let id = made["scenes"][0]["id"].as_str().unwrap();
    let exported = server.get(&format!("/v1/scenes/{id}/export?format=womd&mode=log")).unwrap();
    assert_eq!(exported.status, 200);
    let refusing = Server::start(&["--refuse-nc"]).unwrap();
    assert_eq!(refusing.send(&upload("/v1/import", bytes)).unwrap().code(), "licence-refused");
}

#[test]
fn scoring_takes_given_motion() {
    let server = Server::start(&[]).unwrap();
    let steps = 90;
    let still = vec![0.0; steps];
    // Car 0 stands in the way of car 2.
    let body = json!({"scene": street(4, 91), "trajectories": {"0": {"first_step": 1,
        "x_m": vec![-30.0; steps], "y_m": still, "heading_rad": still, "vx_mps": still, "vy_mps": still}}});
    let score = server.post("/v1/score", &body).unwrap();
    assert_eq!(score.status, 200, "{}", score.text());
    let collisions = score.json()["scene"]["collisions"].as_array().unwrap().clone();
    assert!(collisions.iter().any(|c| c["a"] == "0" && c["b"] == "2"), "{collisions:?}");
    let stranger = json!({"scene": street(1, 5), "trajectories": {"ghost": {"first_step": 0,
        "x_m": [0], "y_m": [0], "heading_rad": [0], "vx_mps": [0], "vy_mps": [0]}}});
    assert_eq!(server.post("/v1/score", &stranger).unwrap().code(), "unknown-agent");
}

/// A trial import of a form with parts of these names.
fn form(parts: &[(&str, &str)]) -> Request {
    form_to("/v1/import?dry_run=true", parts)
}

fn form_to(target: &str, parts: &[(&str, &str)]) -> Request {
    let part = |(name, text): &(&str, &str)| {
        format!(
            "--cut\r\ncontent-disposition: form-data; name=\"{name}\"; filename=\"{name}.xml\"\r\n\r\n{text}\r\n"
        )
    };
    let body: String = parts.iter().map(part).collect();
    let request = Request::new("POST", target);
    request.header("content-type", "multipart/form-data; boundary=cut").body(body + "--cut--\r\n")
}

#[test]
fn sumo_files_are_imported_with_their_network() {
    let fixture = |name: &str| {
        std::fs::read_to_string(root().join("models/formats/tests/fixtures").join(name)).unwrap()
    };
    let (net, fcd) = (fixture("street.net.xml"), fixture("street.fcd.xml"));
    let server = Server::start(&[]).unwrap();
    let made = server.send(&upload("/v1/import", net.clone().into_bytes())).unwrap();
    assert_eq!((made.status, made.json()["format"].as_str()), (201, Some("sumo-net")), "{}", made.text());
    let both = server.send(&form(&[("net", &net), ("file", &fcd)])).unwrap();
    assert_eq!(both.status, 200, "{}", both.text());
    let scenes = both.json()["scenes"].as_array().unwrap().clone();
    assert_eq!((scenes.len(), both.json()["format"].as_str()), (2, Some("sumo-fcd")));
    assert!(!scenes[0]["scene"]["map"]["lanes"].as_array().unwrap().is_empty());
    let wrong = server.send(&form(&[("net", &net), ("file", &net)])).unwrap();
    assert_eq!((wrong.status, wrong.code()), (422, "invalid-field".to_owned()));
    // A second network is refused, not ignored.
    let two = server.send(&form(&[("net", &net), ("net", &net), ("file", &fcd)])).unwrap();
    assert_eq!((two.status, two.code()), (422, "invalid-field".to_owned()));
    assert_eq!(two.json()["errors"][0]["pointer"], "/net");
}

#[test]
fn several_files_of_a_form_are_told_one_by_one() {
    const BROKEN: &str = "{\"format\": \"dragtraffic.scene\",";
    let server = Server::start(&[]).unwrap();
    let net = std::fs::read_to_string(root().join("models/formats/tests/fixtures/street.net.xml")).unwrap();
    let (scene, noncommercial) = (street(2, 5), {
        let mut scene = street(1, 5);
        scene["meta"]["licence"] = "waymo-nc".into();
        scene.to_string()
    });
    let parts = [("file", "not a scene"), ("file", &scene.to_string()), ("file", BROKEN), ("file", &net)];
    let names = |reply: &Value, member: &str| {
        let files = reply["files"].as_array().unwrap().iter();
        files.map(|file| file[member].as_str().unwrap_or_default().to_owned()).collect::<Vec<_>>()
    };
    // A trial reports the scenes of each file, and so does the store.
    let tried = server.send(&form(&parts)).unwrap();
    assert_eq!(tried.status, 200, "{}", tried.text());
    let tried = tried.json();
    assert_eq!(names(&tried, "format"), ["", "dragtraffic", "", "sumo-net"]);
    assert_eq!(names(&tried, "name"), ["file.xml"; 4]);
    assert_eq!(tried["files"][1]["scenes"][0]["scene"]["agents"].as_array().unwrap().len(), 2);
    assert_eq!(tried["files"][0]["problem"]["code"], "format-unknown");
    assert_eq!(tried["files"][2]["problem"]["code"], "malformed-json");
    let made = server.send(&form_to("/v1/import", &parts)).unwrap();
    assert_eq!(made.status, 201, "{}", made.text());
    let ids: Vec<String> =
        [1, 3].map(|at| made.json()["files"][at]["scenes"][0]["id"].as_str().unwrap().into()).into();
    assert_eq!(made.header("location"), format!("/v1/scenes/{}", ids[0]));
    for id in &ids {
        assert_eq!(server.get(&format!("/v1/scenes/{id}")).unwrap().status, 200);
    }
    // If nothing can be read, the call is refused, with each reason.
    let none = server.send(&form(&[("file", "not a scene"), ("file", BROKEN)])).unwrap();
    let pointers: Vec<Value> =
        none.json()["errors"].as_array().unwrap().iter().map(|error| error["pointer"].clone()).collect();
    assert_eq!(
        (none.code().as_str(), pointers),
        ("format-unknown", vec!["/file/0".into(), "/file/1".into()])
    );
    let many = server.send(&form(&vec![("file", "x"); 33])).unwrap();
    assert_eq!((many.code().as_str(), many.json()["limit"].as_u64()), ("invalid-field", Some(32)));
    // A file with a refused licence does not affect the others.
    let strict = Server::start(&["--refuse-nc"]).unwrap();
    let reply = strict.send(&form(&[("file", &noncommercial), ("file", &scene.to_string())])).unwrap().json();
    assert_eq!(reply["files"][0]["problem"]["code"], "licence-refused");
    assert_eq!(reply["files"][1]["scenes"].as_array().unwrap().len(), 1);
}

#[test]
fn commands_and_their_exit_codes() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let (scene, record, back) = (at("a.json"), at("a.tfrecord"), at("b.json"));
    std::fs::write(&scene, street(3, 91).to_string()).unwrap();
    let convert = ["convert", &scene, "--to", "womd", "-o", &record];
    assert_eq!(run(&convert).status.code(), Some(0));
    assert_eq!(run(&convert).status.code(), Some(8), "never overwritten without --force");
    assert_eq!(run(&["import", &record, "-o", &back]).status.code(), Some(0));
    let read: Value = serde_json::from_slice(&std::fs::read(&back).unwrap()).unwrap();
    assert_eq!(read["agents"].as_array().unwrap().len(), 3);
    assert_eq!(run(&["convert", &scene, "--to", "womd", "-o", &at("c"), "--strict"]).status.code(), Some(5));
    std::fs::write(at("bad.json"), "{\"format\":").unwrap();
    assert_eq!(run(&["import", &at("bad.json")]).status.code(), Some(3));
    assert_eq!(run(&["import", &at("missing.json")]).status.code(), Some(3));
    assert_eq!(run(&["import"]).status.code(), Some(2));
    assert_eq!(run(&["nonsense"]).status.code(), Some(2));
    let scored = run(&["score", "--json", &scene, &at("bad.json")]);
    assert_eq!(scored.status.code(), Some(4));
    let line: Value = serde_json::from_slice(&scored.stdout).unwrap();
    assert!(line["scene"]["collisions"].is_array());
    let out = at("out.json");
    let made = run(&["generate", &scene, "--agents", "0", "--goal", "0=20,0,10", "--seed", "7", "-o", &out]);
    assert_eq!(made.status.code(), Some(0), "{}", String::from_utf8_lossy(&made.stderr));
    let made: Value = serde_json::from_slice(&std::fs::read(&out).unwrap()).unwrap();
    assert_eq!(made["generated"]["samples"][0]["agents"]["0"]["modes"].as_array().unwrap().len(), 6);
    assert_eq!(made["generated"]["stale"], false);
    let info: Value = serde_json::from_slice(&run(&["info"]).stdout).unwrap();
    assert_eq!(info["name"], "dragtraffic");
    let document = root().join("assets/openapi.json");
    assert_eq!(run(&["openapi", "--check", document.to_str().unwrap()]).status.code(), Some(0));
}

#[test]
fn a_part_of_a_map_is_read_on_request() {
    let lane = |id: &str, y: f64| {
        format!(
            r#"<edge id="{id}" from="a{id}" to="b{id}"><lane id="{id}_0" index="0" speed="13.9" length="900" width="3.2" shape="0,{y} 900,{y}"/></edge>"#
        )
    };
    let net = format!("<net>{}{}</net>", lane("near", 0.0), lane("far", 500.0));
    let server = Server::start(&[]).unwrap();
    let ask = |query: &str, file: &str| {
        let target = format!("/v1/import?dry_run=true&around={query}");
        server.send(&upload(&target, file.as_bytes().to_vec())).unwrap()
    };
    let read = ask("400,0,150", &net);
    assert_eq!(read.status, 200, "{}", read.text());
    let scene = &read.json()["scenes"][0];
    assert_eq!(scene["scene"]["map"]["lanes"].as_array().unwrap().len(), 1);
    let said = scene["warnings"].as_array().unwrap().iter().find(|w| w["code"] == "cut-around").unwrap();
    assert_eq!(
        (said["message"]["values"]["kept"].as_f64(), said["message"]["values"]["outside"].as_f64()),
        (Some(1.0), Some(1.0))
    );
    for (query, file) in [("400,0", net.as_str()), ("400,0,150", "agent_id,time_s,x_m,y_m\n1,0,0,0\n")] {
        let refused = ask(query, file);
        assert_eq!((refused.status, refused.code()), (422, "invalid-field".to_owned()), "{}", refused.text());
        assert_eq!(refused.json()["errors"][0]["pointer"], "/query/around");
    }
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    std::fs::write(at("a.net.xml"), &net).unwrap();
    let made = run(&["convert", &at("a.net.xml"), "--around", "-400,0,150", "-o", &at("a.json")]);
    assert_eq!(made.status.code(), Some(3), "a circle beside the map");
    let made = run(&["convert", &at("a.net.xml"), "--around", "400,0,150", "-o", &at("a.json")]);
    assert_eq!(made.status.code(), Some(0), "{}", String::from_utf8_lossy(&made.stderr));
    assert!(String::from_utf8_lossy(&made.stderr).contains("within 150 m of 400, 0: lanes kept 1"));
}

/// Recordings 00 and 01 in the form of inD with the map of their place: a truck that drives in the middle of
/// the lane.
fn recordings(folder: &Path) {
    for recording in ["00", "01"] {
        let heading = "recordingId,trackId,frame,xCenter,yCenter,heading,width,length,xVelocity,yVelocity";
        let row = |frame: u32| format!("0,0,{frame},{},-2,0,2,5,10,0", f64::from(frame) / 2.5);
        let rows: Vec<String> = std::iter::once(heading.to_owned()).chain((0..=50).map(row)).collect();
        let tables = [
            ("tracks", rows.join("\n")),
            ("tracksMeta", "trackId,class\n0,truck_bus\n".to_owned()),
            ("recordingMeta", "recordingId,frameRate,speedLimit\n0,25,13.9\n".to_owned()),
        ];
        for (table, text) in tables {
            std::fs::write(folder.join(format!("{recording}_{table}.csv")), text).unwrap();
        }
    }
    let road = r#"<OpenDRIVE><road id="1" length="300"><planView><geometry s="0" x="-50" y="0" hdg="0" length="300"><line/>
        </geometry></planView><lanes><laneSection s="0"><right><lane id="-1" type="driving"><width sOffset="0" a="4" b="0" c="0" d="0"/>
        </lane></right></laneSection></lanes></road></OpenDRIVE>"#;
    std::fs::write(folder.join("place.xodr"), road).unwrap();
}

/// The truck of a recording on the lane of its map.
fn is_whole(scene: &Value) {
    assert_eq!(scene["agents"][0]["subtype"], "truck");
    assert_eq!(scene["map"]["lanes"].as_array().unwrap().len(), 1);
    assert_eq!(scene["map"]["lanes"][0]["speed_limit_mps"], 13.9);
}

#[test]
fn a_recording_of_a_folder_is_read_with_its_tables_and_map() {
    let folder = tempfile::tempdir().unwrap();
    recordings(folder.path());
    let at = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let json = |path: String| -> Value { serde_json::from_slice(&std::fs::read(path).unwrap()).unwrap() };
    let converted = run(&["convert", &at("00_tracks.csv"), "-o", &at("out.json")]);
    let said = String::from_utf8_lossy(&converted.stderr).into_owned();
    assert_eq!(converted.status.code(), Some(0), "{said}");
    let files = "files-beside: 3 files from the same folder are read with the table: 00_recordingMeta.csv, 00_tracksMeta.csv, \
                 place.xodr";
    assert!(said.contains(files) && said.contains("100% of the vehicle positions"), "{said}");
    is_whole(&json(at("out.json")));
    std::fs::remove_file(at("out.json")).unwrap();
    // A folder gives its recordings; the map is not a scene of its own.
    let whole = folder.path().to_str().unwrap();
    let converted = run(&["convert", whole, "-o", &at("scenes/")]);
    assert_eq!(converted.status.code(), Some(0), "{}", String::from_utf8_lossy(&converted.stderr));
    let mut made: Vec<_> =
        std::fs::read_dir(at("scenes")).unwrap().map(|file| file.unwrap().path()).collect();
    made.sort();
    assert_eq!(made.len(), 2, "{made:?}");
    made.iter().for_each(|path| is_whole(&json(path.to_str().unwrap().to_owned())));
    let mined = run(&["mine", whole, "--json"]);
    assert_eq!(mined.status.code(), Some(0), "{}", String::from_utf8_lossy(&mined.stderr));
    let scored = run(&["score", "--json", &at("01_tracks.csv")]);
    let line: Value = serde_json::from_slice(&scored.stdout).unwrap();
    assert_eq!(line["scene"]["off_road"].as_array().map(Vec::len), Some(0), "{line}");
    // With the columns of another data set, nothing is read.
    let alone = run(&["convert", &at("00_tracks.csv"), "--columns", "highd", "-o", &at("out.json")]);
    assert_eq!(alone.status.code(), Some(3), "{}", String::from_utf8_lossy(&alone.stderr));
}

#[test]
fn the_data_folder_has_recordings_with_their_tables_and_maps() {
    let folder = tempfile::tempdir().unwrap();
    recordings(folder.path());
    let server = Server::start(&["--data", folder.path().to_str().unwrap()]).unwrap();
    let listed = || {
        let page = server.get("/v1/scenes?limit=200").unwrap().json();
        let id = |scene: &Value| scene["id"].as_str().unwrap().to_owned();
        let mut ids: Vec<String> = page["scenes"].as_array().unwrap().iter().map(id).collect();
        ids.retain(|id| id.starts_with("file-"));
        ids.sort();
        ids
    };
    let mut ids = Vec::new();
    for _ in 0..300 {
        ids = listed();
        if ids.len() == 3 {
            break;
        }
        std::thread::sleep(std::time::Duration::from_millis(100));
    }
    assert_eq!(ids, ["file-00_tracks-0", "file-01_tracks-0", "file-place-0"]);
    let first = server.get("/v1/scenes/file-00_tracks-0").unwrap();
    assert_eq!(first.status, 200, "{}", first.text());
    is_whole(&first.json());
    // A scene depends on all its files: when one has changed, the scene is gone.
    std::fs::write(folder.path().join("01_tracksMeta.csv"), "trackId,class\n0,car\n").unwrap();
    assert_eq!(server.get("/v1/scenes/file-01_tracks-0").unwrap().code(), "not-found");
}
