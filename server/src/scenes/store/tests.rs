use super::records::{Expect, MapRecord, PackedScene, SceneRecord};
use super::{PageQuery, Sort, Store, StoreError};
use api::{Code, Problem};
use base::limits::Limits;
use base::memory::Memory;
use std::sync::Arc;

fn record(name: &str) -> PackedScene {
    unpacked(name).packed().unwrap()
}

fn unpacked(name: &str) -> SceneRecord {
    SceneRecord {
        name: name.into(),
        tags: vec!["t".into()],
        parent_id: None,
        meta: "{}".into(),
        json: format!("{{\"name\":\"{name}\"}}").into_bytes(),
        shared: None,
        map: MapRecord { sha: "aa".into(), polylines: 1, points: 2, json: Some(b"{}".to_vec()) },
    }
}

fn store(folder: &tempfile::TempDir, limits: Limits) -> Store {
    Store::open(&folder.path().join("s.sqlite"), &Arc::new(limits)).unwrap()
}

#[tokio::test]
async fn preconditions_guard_every_change() {
    let folder = tempfile::tempdir().unwrap();
    let store = store(&folder, Limits::default());
    let first = store.put("a", Expect::Absent, record("one")).await.unwrap();
    assert!(first.created && first.etag.starts_with("\"1-"));
    let again = store.put("a", Expect::Absent, record("two")).await;
    assert!(matches!(again, Err(StoreError::Stale { .. })));
    let second = store.put("a", Expect::Etags(vec![first.etag.clone()]), record("two")).await.unwrap();
    assert!(!second.created && second.etag.starts_with("\"2-"));
    let stale = store.put("a", Expect::Etags(vec![first.etag]), record("three")).await;
    assert!(matches!(stale, Err(StoreError::Stale { etag, .. }) if etag == second.etag));
    let missing = store.put("b", Expect::Etags(vec!["*".into()]), record("x")).await;
    assert!(matches!(missing, Err(StoreError::MissingScene)));
    let (summary, text) = store.get("a").await.unwrap().unwrap();
    assert_eq!((summary.name.as_str(), text.json), ("two", unpacked("two").json));
    let poor = store.clone().within(&Memory::new(0));
    assert!(matches!(poor.get("a").await, Err(StoreError::NoMemory)));
    store.delete("a", Expect::Etags(vec![second.etag])).await.unwrap();
    assert!(store.get("a").await.unwrap().is_none());
}

#[tokio::test]
async fn scenes_share_their_map_and_survive_reopening() {
    let folder = tempfile::tempdir().unwrap();
    let limits = Limits { map_keep_s: 0, ..Limits::default() };
    {
        let store = store(&folder, limits.clone());
        store.put("a", Expect::Absent, record("one")).await.unwrap();
        store.put("b", Expect::Absent, record("two")).await.unwrap();
    }
    let store = store(&folder, limits);
    assert_eq!(store.list(page(None, 10), |_| true).await.unwrap().len(), 2);
    assert_eq!(store.maps().await.unwrap().len(), 1);
    store.drop_unused_maps().await.unwrap();
    assert_eq!(store.map("aa").await.unwrap().unwrap().json, b"{}");
}

#[tokio::test]
async fn a_scene_whose_map_is_not_stored_is_refused_as_such() {
    let folder = tempfile::tempdir().unwrap();
    let store = store(&folder, Limits::default());
    let by_hash = |sha: &str| {
        let map = MapRecord { sha: sha.into(), json: None, ..unpacked("a").map };
        SceneRecord { map, ..unpacked("a") }.packed().unwrap()
    };
    let lost = store.put("a", Expect::Absent, by_hash("bb")).await.unwrap_err();
    assert_eq!(Problem::from(lost).code, Code::UnknownMap);
    store.put("b", Expect::Absent, record("b")).await.unwrap();
    store.put("c", Expect::Absent, by_hash("aa")).await.unwrap();
}

fn page(after: Option<(&str, &str)>, most: usize) -> PageQuery {
    let after = after.map(|(key, id)| (key.to_owned(), id.to_owned()));
    PageQuery { sort: Sort { by_name: true, falls: false }, after, most }
}

#[tokio::test]
async fn pages_go_on_where_the_last_one_ended_even_when_its_scene_is_gone() {
    let folder = tempfile::tempdir().unwrap();
    let store = store(&folder, Limits::default());
    for (id, name) in [("a", "one"), ("b", "two"), ("c", "one"), ("d", "three")] {
        store.put(id, Expect::Absent, record(name)).await.unwrap();
    }
    let ids = async |page: PageQuery| {
        let rows = store.list(page, |row| row.name != "three").await.unwrap();
        rows.into_iter().map(|row| row.id).collect::<Vec<_>>()
    };
    assert_eq!(ids(page(None, 2)).await, ["a", "c"]);
    store.delete("c", Expect::Etags(vec!["*".into()])).await.unwrap();
    assert_eq!(ids(page(Some(("one", "c")), 2)).await, ["b"]);
    let falling = PageQuery { sort: Sort { by_name: true, falls: true }, ..page(Some(("two", "a")), 9) };
    assert_eq!(ids(falling).await, ["b", "a"]);
}

/// A scene with its own map, both hard to compress.
fn large(name: &str) -> PackedScene {
    let noise: Vec<u8> = (0..40_000u32).map(|i| (i.wrapping_mul(2_654_435_761) >> 11) as u8).collect();
    let mut scene = unpacked(name);
    scene.json = noise.clone();
    (scene.map.sha, scene.map.json) = (name.into(), Some(noise));
    scene.packed().unwrap()
}

#[tokio::test]
async fn a_store_that_was_full_takes_scenes_again_after_deletes() {
    let folder = tempfile::tempdir().unwrap();
    let limits = Limits { store_bytes: 400_000, ..Limits::default() };
    let mut store = store(&folder, limits.clone());
    for round in 0..3 {
        let mut count = 0;
        loop {
            match store.put(&format!("s{count}"), Expect::Absent, large(&format!("{round}-{count}"))).await {
                Ok(_) => count += 1,
                Err(StoreError::Full(_)) => break,
                Err(other) => panic!("{other}"),
            }
        }
        assert!(count >= 3, "{count} scenes in round {round}");
        // A stored scene may be rewritten if it does not grow.
        let again = store.put("s0", Expect::Etags(vec!["*".into()]), record("small")).await;
        assert!(matches!(again, Ok(_) | Err(StoreError::Full(_))));
        for k in 0..count {
            store.delete(&format!("s{k}"), Expect::Etags(vec!["*".into()])).await.unwrap();
        }
        if round == 1 {
            drop(store);
            store = Store::open(&folder.path().join("s.sqlite"), &Arc::new(limits.clone())).unwrap();
        }
    }
}

#[test]
fn another_programs_file_and_a_damaged_one_are_left_alone() {
    let folder = tempfile::tempdir().unwrap();
    let open = |name: &str| Store::open(&folder.path().join(name), &Arc::new(Limits::default()));
    for (name, version, id) in [("plain", 0, 0), ("versioned", 1, 0), ("marked", 0, 77)] {
        let path = folder.path().join(name);
        let connection = rusqlite::Connection::open(&path).unwrap();
        connection.execute_batch("CREATE TABLE notes (text); INSERT INTO notes VALUES ('mine')").unwrap();
        connection.pragma_update(None, "user_version", version).unwrap();
        connection.pragma_update(None, "application_id", id).unwrap();
        drop(connection);
        let before = std::fs::read(&path).unwrap();
        assert!(matches!(open(name), Err(StoreError::Foreign)), "{name}");
        assert_eq!(std::fs::read(&path).unwrap(), before, "{name} is as it was");
    }
    drop(open("own").unwrap());
    let path = folder.path().join("own");
    let connection = rusqlite::Connection::open(&path).unwrap();
    let id: i64 = connection.pragma_query_value(None, "application_id", |row| row.get(0)).unwrap();
    assert_ne!(id, 0);
    // A file of the first schema, without a mark, is recognised.
    connection.pragma_update(None, "application_id", 0).unwrap();
    drop(connection);
    drop(open("own").unwrap());
    // Its threads close the file a moment later, and with it the log.
    while folder.path().join("own-wal").exists() {
        std::thread::yield_now();
    }
    let mut bytes = std::fs::read(&path).unwrap();
    let half = bytes.len() / 2;
    bytes[half..].fill(0x5a);
    std::fs::write(&path, bytes).unwrap();
    assert!(open("own").is_err());
}

#[cfg(unix)]
#[tokio::test]
async fn only_its_owner_may_read_the_file() {
    use std::os::unix::fs::PermissionsExt;
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("s.sqlite");
    std::fs::write(&path, "").unwrap();
    std::fs::set_permissions(&path, std::fs::Permissions::from_mode(0o644)).unwrap();
    let store = store(&folder, Limits::default());
    store.put("a", Expect::Absent, record("one")).await.unwrap();
    for file in std::fs::read_dir(folder.path()).unwrap().flatten() {
        assert_eq!(file.metadata().unwrap().permissions().mode() & 0o077, 0, "{:?}", file.file_name());
    }
}

#[tokio::test]
async fn a_full_store_says_so() {
    let folder = tempfile::tempdir().unwrap();
    let store = store(&folder, Limits { stored_scenes: 1, ..Limits::default() });
    store.put("a", Expect::Absent, record("one")).await.unwrap();
    let refused = store.put("b", Expect::Absent, record("two")).await;
    assert!(matches!(refused, Err(StoreError::Full(_))));
}

#[test]
fn a_newer_file_is_left_alone() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("s.sqlite");
    let connection = rusqlite::Connection::open(&path).unwrap();
    connection.pragma_update(None, "user_version", 99).unwrap();
    let opened = Store::open(&path, &Arc::new(Limits::default()));
    assert!(matches!(opened, Err(StoreError::Newer(99))));
}

#[tokio::test]
async fn scenes_that_did_not_change_for_days_are_deleted_only_if_that_is_set() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("s.sqlite");
    {
        let store = store(&folder, Limits::default());
        for id in ["old", "new"] {
            store.put(id, Expect::Absent, record(id)).await.unwrap();
        }
        rusqlite::Connection::open(&path)
            .and_then(|file| {
                file.execute("UPDATE scenes SET updated_at = '2020-01-01T00:00:00.000Z' WHERE id = 'old'", [])
            })
            .unwrap();
        assert!(store.drop_old_scenes().await.unwrap().is_empty());
    }
    let store = store(&folder, Limits { scene_keep_days: 180, ..Limits::default() });
    assert_eq!(store.drop_old_scenes().await.unwrap(), ["old"]);
    assert!(store.get("old").await.unwrap().is_none() && store.get("new").await.unwrap().is_some());
    let endless = Limits { scene_keep_days: u64::MAX, ..Limits::default() };
    assert!(Store::open(&path, &Arc::new(endless)).unwrap().drop_old_scenes().await.unwrap().is_empty());
}
