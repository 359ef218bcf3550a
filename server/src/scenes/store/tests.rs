use super::records::{Expect, MapRecord, PackedScene, SceneRecord};
use super::{Store, StoreError};
use crate::base::limits::Limits;
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
    assert!(matches!(missing, Err(StoreError::Missing)));
    let (summary, json) = store.get("a").await.unwrap().unwrap();
    assert_eq!((summary.name.as_str(), json), ("two", unpacked("two").json));
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
    assert_eq!(store.list().await.unwrap().len(), 2);
    assert_eq!(store.maps().await.unwrap().len(), 1);
    store.drop_unused_maps().await.unwrap();
    assert_eq!(store.map("aa").await.unwrap().unwrap(), b"{}");
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
