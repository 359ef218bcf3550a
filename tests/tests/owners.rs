//! Scenes with owners (`--owners`): other users see shared scenes, and change those that are shared for
//! changes; quotas.

#![allow(clippy::unwrap_used, reason = "a failed test panics")]

use dragtraffic_tests::scenes::street;
use dragtraffic_tests::{Reply, Request, Server};
use serde_json::{Value, json};
use std::os::unix::fs::PermissionsExt;
use tempfile::TempDir;

/// A server with users, and the folder of its token file.
struct Group {
    server: Server,
    _folder: TempDir,
}

fn token(name: &str) -> String {
    name.repeat(32)[..32].to_owned()
}

impl Group {
    fn with(flags: &[&str]) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("tokens");
        let lines = ["anna edit", "maria edit", "guest read", "boss admin"];
        let lines = lines.map(|line| format!("{line} {}\n", token(line.split(' ').next().unwrap())));
        std::fs::write(&file, lines.concat()).unwrap();
        std::fs::set_permissions(&file, std::fs::Permissions::from_mode(0o600)).unwrap();
        let own = ["--owners", "--token-file", file.to_str().unwrap()];
        Self { server: Server::start(&[&own, flags].concat()).unwrap(), _folder: folder }
    }

    fn send(&self, who: &str, method: &str, path: &str, body: Option<&Value>) -> Reply {
        let request = Request::new(method, path).header("authorization", &format!("Bearer {}", token(who)));
        let request =
            if ["PATCH", "DELETE"].contains(&method) { request.header("if-match", "*") } else { request };
        let request = match body {
            Some(body) => request.json(body),
            None => request,
        };
        self.server.send(&request).unwrap()
    }

    fn made(&self, who: &str) -> String {
        let made = self.send(who, "POST", "/v1/scenes", Some(&street(2, 20)));
        assert_eq!(made.status, 201, "{}", made.text());
        made.json()["id"].as_str().unwrap().to_owned()
    }

    fn listed(&self, who: &str) -> Vec<Value> {
        let listed = self.send(who, "GET", "/v1/scenes?limit=200", None).json();
        let saved = listed["scenes"].as_array().unwrap().iter().filter(|scene| scene["readonly"] == false);
        saved.cloned().collect()
    }
}

/// The status that a user gets for each access to a scene.
fn ways(group: &Group, who: &str, id: &str) -> Vec<u16> {
    let path = format!("/v1/scenes/{id}");
    let about = json!({"scene_id": id});
    let one = json!({"scene_id": id, "agents": ["0"]});
    let run = json!({"scene_id": id, "egos": ["0"]});
    let search = json!({"scene_id": id, "where": "collisions == 0", "tries": 1,
        "situation": {"template": "brake", "parameters": {}}});
    let status = |method, path: &str, body| group.send(who, method, path, body).status;
    vec![
        status("GET", &path, None),
        status("GET", &format!("{path}/preview"), None),
        status("GET", &format!("{path}/export?format=csv"), None),
        status("POST", "/v1/score", Some(&about)),
        status("POST", "/v1/generate", Some(&one)),
        status("POST", "/v1/runs", Some(&run)),
        status("POST", "/v1/search", Some(&search)),
        status("PATCH", &path, Some(&json!({"notes": "seen"}))),
        status("PATCH", &path, Some(&json!({"shared": "edit"}))),
        status("DELETE", &path, None),
    ]
}

#[test]
fn a_scene_is_its_owners_until_it_is_shared() {
    let group = Group::with(&[]);
    let id = group.made("anna");
    let own = &group.listed("anna")[0];
    assert_eq!((&own["owner"], &own["shared"]), (&json!("anna"), &json!("nobody")));
    assert!(group.listed("maria").is_empty() && group.listed("guest").is_empty());
    assert_eq!(group.listed("boss").len(), 1, "an administrator sees all");
    // As if the scene did not exist.
    assert_eq!(ways(&group, "maria", &id), [404; 10]);
    assert!(group.send("maria", "GET", "/v1/maps", None).json()["maps"].as_array().unwrap().is_empty());
    assert_eq!(group.send("anna", "GET", "/v1/maps", None).json()["maps"].as_array().unwrap().len(), 1);
    let share = |with: &str| {
        let shared = group.send("anna", "PATCH", &format!("/v1/scenes/{id}"), Some(&json!({"shared": with})));
        assert_eq!(shared.status, 200, "{}", shared.text());
    };
    share("read");
    let seen = ways(&group, "maria", &id);
    assert_eq!(seen[7..], [403; 3], "{seen:?}");
    assert!(seen[..6].iter().all(|status| [200, 201].contains(status)) && seen[6] != 404, "{seen:?}");
    let refused = group.send("maria", "DELETE", &format!("/v1/scenes/{id}"), None);
    assert_eq!(refused.code(), "forbidden");
    assert!(refused.text().contains(r#"belongs to \"anna\""#), "{}", refused.text());
    share("edit");
    assert_eq!(ways(&group, "maria", &id)[7..], [200, 403, 403]);
    assert_eq!(group.send("guest", "PATCH", &format!("/v1/scenes/{id}"), Some(&json!({}))).status, 403);
    // Her copy is her own.
    let copy = group.send("maria", "POST", &format!("/v1/scenes/{id}/duplicate"), None).json()["id"].clone();
    assert_eq!(
        group.send("anna", "GET", &format!("/v1/scenes/{}", copy.as_str().unwrap()), None).status,
        404
    );
    share("nobody");
    assert_eq!(group.send("maria", "GET", &format!("/v1/scenes/{id}"), None).status, 404);
    // She cannot create a scene under the id of a scene that she does not see.
    let put =
        Request::new("PUT", &format!("/v1/scenes/{id}")).header("if-none-match", "*").json(&street(1, 20));
    let put = put.header("authorization", &format!("Bearer {}", token("maria")));
    assert_eq!(group.server.send(&put).unwrap().status, 412);
    assert_eq!(group.send("boss", "DELETE", &format!("/v1/scenes/{id}"), None).status, 204);
}

#[test]
fn each_user_has_a_quota_of_scenes_and_bytes() {
    let group = Group::with(&["--limit", "user_scenes=2"]);
    group.made("anna");
    let second = group.made("anna");
    let full = group.send("anna", "POST", "/v1/scenes", Some(&street(2, 20)));
    assert_eq!((full.status, full.code().as_str()), (507, "store-full"));
    assert!(full.text().contains("anna has 2 scenes; at most 2."), "{}", full.text());
    let patched = group.send("anna", "PATCH", &format!("/v1/scenes/{second}"), Some(&json!({"name": "b"})));
    assert_eq!(patched.status, 200, "{}", patched.text());
    group.made("maria");
    (0..3).for_each(|_| drop(group.made("boss")));
    assert_eq!(group.send("anna", "DELETE", &format!("/v1/scenes/{second}"), None).status, 204);
    group.made("anna");
    let group = Group::with(&["--limit", "user_bytes=100"]);
    let full = group.send("anna", "POST", "/v1/scenes", Some(&street(2, 20)));
    assert_eq!(full.status, 507, "{}", full.text());
    assert!(full.text().contains("at most 100."), "{}", full.text());
}

#[test]
fn owners_need_users() {
    assert!(Server::start(&["--owners"]).is_err());
    let server = Server::start(&["--owners", "--trust-proxy", "127.0.0.1"]).unwrap();
    let as_user =
        |request: Request, user: &str| server.send(&request.header("x-forwarded-user", user)).unwrap();
    let made = as_user(Request::new("POST", "/v1/scenes").json(&street(1, 20)), "anna").json();
    let path = format!("/v1/scenes/{}", made["id"].as_str().unwrap());
    let seen = ["anna", "maria", ""].map(|user| as_user(Request::new("GET", &path), user).status);
    assert_eq!(seen, [200, 404, 404]);
}
