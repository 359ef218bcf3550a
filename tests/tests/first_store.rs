//! A store of the first version of the program (`stores/first.sql`): it opens, and its content is unchanged.

#![allow(clippy::unwrap_used, reason = "a failed test panics")]

use dragtraffic_tests::writers::sound;
use dragtraffic_tests::{Request, Server, program};
use rusqlite::Connection;
use serde_json::{Value, json};
use std::path::Path;
use std::process::Command;

/// Creates the file as the first version would have left it.
fn first_store(path: &Path) {
    let connection = Connection::open(path).unwrap();
    connection.pragma_update(None, "journal_mode", "WAL").unwrap();
    connection.execute_batch(include_str!("stores/first.sql")).unwrap();
    for (table, key) in [("maps", "sha"), ("scenes", "id")] {
        let mut rows = connection.prepare(&format!("SELECT {key}, body FROM {table}")).unwrap();
        let rows = rows.query_map([], |row| Ok((row.get::<_, String>(0)?, row.get::<_, Vec<u8>>(1)?)));
        let bodies: Vec<(String, Vec<u8>)> = rows.unwrap().map(Result::unwrap).collect();
        for (name, body) in bodies {
            let packed = zstd::encode_all(body.as_slice(), 3).unwrap();
            let sql = format!("UPDATE {table} SET body = ?2 WHERE {key} = ?1");
            assert_eq!(connection.execute(&sql, rusqlite::params![name, packed]).unwrap(), 1);
        }
    }
}

fn number(path: &Path, pragma: &str) -> i64 {
    Connection::open(path).unwrap().pragma_query_value(None, pragma, |row| row.get(0)).unwrap()
}

#[test]
fn a_store_of_the_first_version_lives_on() {
    let folder = tempfile::tempdir().unwrap();
    let db = folder.path().join("scenes.sqlite");
    first_store(&db);
    assert_eq!((number(&db, "application_id"), number(&db, "user_version")), (0, 1));
    let server = Server::start_at(&db, &[]).unwrap();
    let listed = server.get("/v1/scenes?sort=name").unwrap().json();
    let own: Vec<&Value> =
        listed["scenes"].as_array().unwrap().iter().filter(|item| item["readonly"] == false).collect();
    let facts =
        |item: &Value| (item["id"].clone(), item["counts"]["vehicle"].clone(), item["generated"].clone());
    let expected = [("third", 1, false), ("first", 2, false), ("second", 2, true)];
    let found: Vec<_> = own.iter().map(|item| facts(item)).collect();
    assert_eq!(found, expected.map(|(id, cars, made)| (json!(id), json!(cars), json!(made))));
    for item in own {
        let id = item["id"].as_str().unwrap();
        let path = format!("/v1/scenes/{id}");
        let whole = server.get(&path).unwrap();
        assert_eq!((whole.status, whole.header("etag")), (200, item["etag"].as_str().unwrap()), "{id}");
        assert_eq!(whole.json()["name"], item["name"]);
        assert!(!whole.json()["map"]["lanes"].as_array().unwrap().is_empty());
        assert_eq!(whole.json()["generated"].is_object(), item["generated"].as_bool().unwrap());
        let score = server.post("/v1/score", &json!({"scene_id": id})).unwrap();
        assert_eq!(score.status, 200, "{id} is a scene to all that works on scenes: {}", score.text());
        let copy = server.send(&Request::new("POST", &format!("{path}/duplicate"))).unwrap();
        assert_eq!(copy.status, 201, "{}", copy.text());
        let again = Request::new("PUT", &path).header("if-match", whole.header("etag")).json(&whole.json());
        let again = server.send(&again).unwrap();
        assert_eq!(again.status, 200, "{}", again.text());
        let patch = Request::new("PATCH", &path).header("if-match", again.header("etag"));
        let patched = server.send(&patch.json(&json!({"name": "renamed", "tags": ["later"]}))).unwrap();
        assert_eq!(patched.status, 200, "{}", patched.text());
        let mut expected = whole.json();
        (expected["name"], expected["meta"]["tags"]) = (json!("renamed"), json!(["later"]));
        assert_eq!(server.get(&path).unwrap().json(), expected, "{id}: nothing else has changed");
        let delete = Request::new("DELETE", &path).header("if-match", patched.header("etag"));
        assert_eq!(server.send(&delete).unwrap().status, 204);
    }
    assert_eq!(
        server.get("/v1/maps").unwrap().json()["maps"].as_array().unwrap().len(),
        2,
        "maps are shared"
    );
    server.stop().unwrap();
    sound(&db).unwrap();
    assert_ne!(number(&db, "application_id"), 0);
    let copy = db.with_extension("v1.sqlite");
    assert_eq!(
        (number(&db, "user_version"), number(&copy, "user_version")),
        (2, 1),
        "a copy of before is kept"
    );
    let server = Server::start_at(&db, &[]).unwrap();
    assert_eq!(server.get("/v1/scenes?q=copy").unwrap().json()["scenes"].as_array().unwrap().len(), 3);
}

#[test]
fn a_store_of_a_later_version_is_left_alone() {
    let folder = tempfile::tempdir().unwrap();
    let db = folder.path().join("scenes.sqlite");
    first_store(&db);
    Connection::open(&db).unwrap().pragma_update(None, "user_version", 99).unwrap();
    let mut serve = Command::new(program::program());
    let output = serve.args(["serve", "--port", "0", "--db"]).arg(&db).output().unwrap();
    let said = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert!(said.contains("the file has schema 99, this program knows up to 2"), "{said}");
    assert_eq!((number(&db, "application_id"), number(&db, "user_version")), (0, 99));
}
