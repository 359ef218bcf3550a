//! Rows of the store, and its queries.

use super::{Ownership, SceneShare, Store, StoreError, Viewer};
use api::Problem;
use base::limits::Limits;
use base::memory::MemoryShare;
use base::{clock, metrics};
use rusqlite::{OptionalExtension, Row, Transaction, named_params};
use scene::ContentHash;
use std::io::Read;
use std::sync::Arc;
use std::time::{Duration, SystemTime, UNIX_EPOCH};

/// Deletes maps without scenes.
const UNUSED_MAPS: &str = "DELETE FROM maps WHERE sha NOT IN (SELECT map_sha FROM scenes)";

/// Compression level of bodies: higher ones hardly reduce the size.
const LEVEL: i32 = 3;

/// Bytes of a stored text that are decoded at a time.
const PIECE: usize = 64 << 10;

/// A stored text in memory, with its share of it.
#[derive(Debug)]
pub struct StoredText {
    /// The text.
    pub json: Vec<u8>,
    /// Its share of the memory.
    pub room: MemoryShare,
}

impl StoredText {
    /// Decodes a stored text as far as there is memory.
    fn unpack(packed: &[u8], mut room: MemoryShare) -> Result<Self, StoreError> {
        let (mut json, mut decoder) = (Vec::new(), zstd::Decoder::new(packed)?);
        loop {
            if !room.grow(PIECE) {
                return Err(StoreError::NoMemory);
            }
            if decoder.by_ref().take(PIECE as u64).read_to_end(&mut json)? == 0 {
                return Ok(Self { json, room });
            }
        }
    }
}

/// A map to write.
#[derive(Clone, Debug)]
pub struct MapRecord {
    /// Content hash.
    pub sha: String,
    /// Number of its lines and areas.
    pub polylines: usize,
    /// Number of their points.
    pub points: usize,
    /// Native JSON; `None` for a map that is stored already.
    pub json: Option<Vec<u8>>,
}

/// A scene to write.
#[derive(Clone, Debug)]
pub struct SceneRecord {
    /// Display name.
    pub name: String,
    /// Tags for searches.
    pub tags: Vec<String>,
    /// Scene of which it is a variant.
    pub parent_id: Option<String>,
    /// Facts for lists, as JSON.
    pub meta: String,
    /// Native JSON with the map by reference, without id.
    pub json: Vec<u8>,
    /// What others than its owner may do from now on; `None` does not change it.
    pub shared: Option<SceneShare>,
    /// Its map.
    pub map: MapRecord,
}

impl SceneRecord {
    /// The row as it is stored, bodies compressed.
    ///
    /// # Errors
    /// When the compressor fails.
    pub fn packed(self) -> Result<PackedScene, Problem> {
        let pack = |json: Vec<u8>| zstd::encode_all(json.as_slice(), LEVEL).map_err(Problem::internal);
        let Self { name, tags, parent_id, meta, json, shared, map } = self;
        let MapRecord { sha, polylines, points, json: map_json } = map;
        let map_bytes = map_json.as_ref().map_or(0, Vec::len);
        let map =
            PackedMap { sha, polylines, points, bytes: map_bytes, body: map_json.map(pack).transpose()? };
        let tags = serde_json::to_string(&tags).map_err(Problem::internal)?;
        let hash = ContentHash::of_bytes(&json);
        Ok(PackedScene { name, tags, parent_id, meta, hash, body: pack(json)?, shared, map })
    }
}

/// A scene ready to write; its text exists only in compressed form.
#[derive(Clone, Debug)]
pub struct PackedScene {
    name: String,
    /// JSON array.
    tags: String,
    parent_id: Option<String>,
    meta: String,
    /// Hash of the text.
    hash: ContentHash,
    body: Vec<u8>,
    shared: Option<SceneShare>,
    map: PackedMap,
}

#[derive(Clone, Debug)]
struct PackedMap {
    sha: String,
    polylines: usize,
    points: usize,
    /// Bytes of the text.
    bytes: usize,
    /// `None` for a map that is stored already.
    body: Option<Vec<u8>>,
}

/// A map of the store, without its content.
#[derive(Clone, Debug)]
pub struct StoredMap {
    /// Content hash, 64 hex digits.
    pub sha256: String,
    /// Size of its JSON, bytes.
    pub bytes: u64,
    /// Number of its lines and areas.
    pub polylines: u64,
    /// Number of their points.
    pub points: u64,
}

/// Result of a write.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Written {
    /// New ETag, with quotes.
    pub etag: String,
    /// Whether it was created, not replaced.
    pub created: bool,
}

/// A scene in a list.
#[derive(Clone, Debug)]
pub struct SceneSummary {
    /// Id.
    pub id: String,
    /// Display name.
    pub name: String,
    /// ETag, with quotes.
    pub etag: String,
    /// JSON array.
    pub tags: String,
    /// Scene of which it is a variant.
    pub parent_id: Option<String>,
    /// Content hash.
    pub map_sha: String,
    /// Facts for lists, as JSON.
    pub meta: String,
    /// Size of the stored body.
    pub bytes: u64,
    /// RFC 3339.
    pub created_at: String,
    /// RFC 3339.
    pub updated_at: String,
    /// Owner and sharing.
    pub ownership: Ownership,
}

/// Precondition of a write.
#[derive(Clone, Debug)]
pub enum Expect {
    /// The id must be unused.
    Absent,
    /// One of these must be the stored scene's ETag; `*` matches any.
    Etags(Vec<String>),
}

pub(super) const SUMMARY: &str =
    "id, name, etag, tags, parent_id, map_sha, meta, length(body), created_at, updated_at, owner, shared";

pub(super) fn summary(row: &Row<'_>) -> rusqlite::Result<SceneSummary> {
    Ok(SceneSummary {
        id: row.get(0)?,
        name: row.get(1)?,
        etag: row.get(2)?,
        tags: row.get(3)?,
        parent_id: row.get(4)?,
        map_sha: row.get(5)?,
        meta: row.get(6)?,
        bytes: row.get::<_, i64>(7)?.unsigned_abs(),
        created_at: row.get(8)?,
        updated_at: row.get(9)?,
        ownership: ownership(row, 10)?,
    })
}

/// The ownership in two columns of a row, from `at` on.
fn ownership(row: &Row<'_>, at: usize) -> rusqlite::Result<Ownership> {
    Ok(Ownership { owner: row.get(at)?, shared: SceneShare::of(&row.get::<_, String>(at + 1)?) })
}

impl Store {
    /// A scene's facts and its JSON (map by reference).
    pub async fn get(&self, id: &str) -> Result<Option<(SceneSummary, StoredText)>, StoreError> {
        let (id, viewer, room) = (id.to_owned(), self.viewer.clone(), self.memory.nothing());
        self.read(move |connection| {
            let sql = format!("SELECT {SUMMARY}, body FROM scenes WHERE id = ?1");
            let mut query = connection.prepare_cached(&sql)?;
            let row =
                query.query_row([id], |row| Ok((summary(row)?, row.get::<_, Vec<u8>>(12)?))).optional()?;
            let seen = row.filter(|(summary, _)| viewer.sees(&summary.ownership));
            let Some((summary, packed)) = seen else { return Ok(None) };
            Ok(Some((summary, StoredText::unpack(&packed, room)?)))
        })
        .await
    }

    /// The ETag of a scene; `None` if the id is unused.
    pub async fn etag(&self, id: &str) -> Result<Option<String>, StoreError> {
        let (id, viewer) = (id.to_owned(), self.viewer.clone());
        self.read(move |connection| {
            let mut query =
                connection.prepare_cached("SELECT etag, owner, shared FROM scenes WHERE id = ?1")?;
            let row = query.query_row([id], |row| Ok((row.get(0)?, ownership(row, 1)?))).optional()?;
            Ok(row.filter(|(_, of)| viewer.sees(of)).map(|(etag, _)| etag))
        })
        .await
    }

    /// Writes a scene under an id; checks the precondition in the same transaction.
    pub async fn put(&self, id: &str, expect: Expect, scene: PackedScene) -> Result<Written, StoreError> {
        let (id, limits, viewer) = (id.to_owned(), Arc::clone(&self.limits), self.viewer.clone());
        let written = self.add(move |tx| put(tx, (&limits, &viewer), &id, &expect, &scene)).await?;
        self.tell_size().await;
        Ok(written)
    }

    /// Writes new scenes, all of them or none; their ETags in the same order.
    pub async fn put_new(&self, scenes: Vec<(String, PackedScene)>) -> Result<Vec<String>, StoreError> {
        let (limits, viewer) = (Arc::clone(&self.limits), self.viewer.clone());
        let put_one = move |tx: &Transaction<'_>, (id, scene): &(String, PackedScene)| {
            put(tx, (&limits, &viewer), id, &Expect::Absent, scene).map(|written| written.etag)
        };
        let etags = self.add(move |tx| scenes.iter().map(|scene| put_one(tx, scene)).collect()).await?;
        self.tell_size().await;
        Ok(etags)
    }

    /// Writes something new. On a full disk it deletes unused maps and tries again.
    async fn add<T: Send + 'static>(
        &self,
        task: impl Fn(&Transaction<'_>) -> Result<T, StoreError> + Send + Sync + 'static,
    ) -> Result<T, StoreError> {
        let task = Arc::new(task);
        let again = Arc::clone(&task);
        match self.write(move |tx| task(tx)).await {
            Err(error) if error.is_disk_full() => {
                let unused = self.read(|connection| {
                    let sql = "SELECT count(*) FROM maps WHERE sha NOT IN (SELECT map_sha FROM scenes)";
                    Ok(connection.query_row(sql, [], |row| row.get::<_, i64>(0))?)
                });
                if unused.await? == 0 {
                    return Err(error);
                }
                // Many maps need more of the log than the reserve holds.
                self.reserve.give_up();
                let dropped = self.write(|tx| Ok(tx.execute(UNUSED_MAPS, [])?)).await;
                self.emptied().await;
                self.reserve.restore();
                dropped?;
                self.write(move |tx| again(tx)).await
            }
            done => done,
        }
    }

    /// Deletes a scene, even on a full disk: then the reserve is released first, and the freed space goes
    /// back to the disk.
    pub async fn delete(&self, id: &str, expect: Expect) -> Result<(), StoreError> {
        let delete = |id: String, expect: Expect, with_maps: bool| {
            let viewer = self.viewer.clone();
            self.write(move |tx| {
                let stored = current(tx, &id)?.ok_or(StoreError::MissingScene)?;
                viewer.check(&stored.ownership, true)?;
                check(&expect, Some(&stored))?;
                tx.execute("DELETE FROM scenes WHERE id = ?1", [&id])?;
                if with_maps {
                    tx.execute(UNUSED_MAPS, [])?;
                }
                Ok(())
            })
        };
        let is_short = !self.reserve.is_kept();
        let deleted = match delete(id.to_owned(), expect.clone(), is_short).await {
            Err(error) if error.is_disk_full() => {
                self.reserve.give_up();
                // The content of the log takes the space first.
                self.emptied().await;
                delete(id.to_owned(), expect, true).await
            }
            done => done,
        };
        if deleted.is_ok() && !self.reserve.is_kept() {
            self.emptied().await;
            self.reserve.restore();
        }
        deleted?;
        self.tell_size().await;
        Ok(())
    }

    /// JSON of a map.
    pub async fn map(&self, sha: &str) -> Result<Option<StoredText>, StoreError> {
        let (sha, room) = (sha.to_owned(), self.memory.nothing());
        self.read(move |connection| {
            let mut query = connection.prepare_cached("SELECT body FROM maps WHERE sha = ?1")?;
            let packed: Option<Vec<u8>> = query.query_row([sha], |row| row.get(0)).optional()?;
            packed.map(|packed| StoredText::unpack(&packed, room)).transpose()
        })
        .await
    }

    /// All maps of visible scenes, without their content.
    pub async fn maps(&self) -> Result<Vec<StoredMap>, StoreError> {
        let viewer = self.viewer.clone();
        self.read(move |connection| {
            let mut query = connection.prepare_cached(
                "SELECT sha, bytes, polylines, points FROM maps WHERE ?2 OR sha IN
                    (SELECT map_sha FROM scenes WHERE owner IS NULL OR owner = ?1 OR shared <> 'nobody') ORDER BY sha",
            )?;
            let number = |row: &Row<'_>, i| row.get::<_, i64>(i).map(i64::unsigned_abs);
            let rows = query.query_map(viewer.parts(), |row| {
                let (bytes, polylines, points) = (number(row, 1)?, number(row, 2)?, number(row, 3)?);
                Ok(StoredMap { sha256: row.get(0)?, bytes, polylines, points })
            })?;
            Ok(rows.collect::<Result<_, _>>()?)
        })
        .await
    }

    /// Deletes maps that no scene has used for a while.
    pub async fn drop_unused_maps(&self) -> Result<usize, StoreError> {
        let before = seconds_now().saturating_sub_unsigned(self.limits.map_keep_s);
        self.write(move |tx| {
            let sql = "DELETE FROM maps WHERE used_at < ?1 AND sha NOT IN (SELECT map_sha FROM scenes)";
            Ok(tx.execute(sql, [before])?)
        })
        .await
    }

    /// Deletes scenes that have not changed for `scene_keep_days`, and returns their ids.
    pub async fn drop_old_scenes(&self) -> Result<Vec<String>, StoreError> {
        let days = self.limits.scene_keep_days;
        let kept = Duration::from_secs(days.saturating_mul(86_400));
        let Some(before) = SystemTime::now().checked_sub(kept).filter(|_| days > 0) else {
            return Ok(Vec::new());
        };
        let before = clock::text(before);
        self.write(move |tx| {
            let mut query = tx.prepare("DELETE FROM scenes WHERE updated_at < ?1 RETURNING id")?;
            let ids = query.query_map([before], |row| row.get(0))?;
            Ok(ids.collect::<Result<_, _>>()?)
        })
        .await
    }

    /// Returns space to the disk if possible.
    async fn emptied(&self) {
        if let Err(error) = self.give_back().await {
            tracing::warn!(%error, "the log keeps its room");
        }
    }

    /// Puts the store's size into the metrics.
    pub async fn measure(&self) -> Result<(), StoreError> {
        self.reserve.restore();
        self.read(|connection| {
            let scenes: i64 = connection.query_row("SELECT count(*) FROM scenes", [], |row| row.get(0))?;
            metrics::store(scenes.unsigned_abs(), used_bytes(connection)?);
            Ok(())
        })
        .await
    }

    /// The same after a write, which succeeds even if the size is unknown.
    async fn tell_size(&self) {
        if let Err(error) = self.measure().await {
            tracing::warn!(%error, "the store's size cannot be told");
        }
    }
}

fn put(
    tx: &Transaction<'_>,
    (limits, viewer): (&Limits, &Viewer),
    id: &str,
    expect: &Expect,
    scene: &PackedScene,
) -> Result<Written, StoreError> {
    let stored = current(tx, id)?;
    if let Some(stored) = &stored {
        viewer.check(&stored.ownership, scene.shared.is_some())?;
    }
    check(expect, stored.as_ref())?;
    if stored.is_none() {
        let count: i64 = tx.query_row("SELECT count(*) FROM scenes", [], |row| row.get(0))?;
        if count.unsigned_abs() >= limits.stored_scenes {
            return Err(StoreError::Full(format!("{count} scenes are stored.")));
        }
    }
    let before = stored.as_ref().map_or(0, |s| s.bytes);
    let map_bytes = scene.map.body.as_ref().map_or(0, Vec::len) as u64;
    let grows = (scene.body.len() as u64).saturating_sub(before);
    viewer.check_quota(tx, limits, (grows, stored.is_none()))?;
    make_room(tx, grows + map_bytes, limits.store_bytes)?;
    keep_map(tx, &scene.map)?;
    let rev = stored.as_ref().map_or(1, |s| s.rev + 1);
    let etag = etag(rev, &scene.hash);
    save(tx, (id, rev, &etag), viewer, scene)?;
    Ok(Written { etag, created: stored.is_none() })
}

struct Stored {
    rev: i64,
    etag: String,
    updated_at: String,
    /// Bytes of the stored body.
    bytes: u64,
    ownership: Ownership,
}

fn current(tx: &Transaction<'_>, id: &str) -> Result<Option<Stored>, StoreError> {
    let mut query = tx.prepare_cached(
        "SELECT rev, etag, updated_at, length(body), owner, shared FROM scenes WHERE id = ?1",
    )?;
    let stored = query.query_row([id], |row| {
        let bytes = row.get::<_, i64>(3)?.unsigned_abs();
        let ownership = ownership(row, 4)?;
        Ok(Stored { rev: row.get(0)?, etag: row.get(1)?, updated_at: row.get(2)?, bytes, ownership })
    });
    Ok(stored.optional()?)
}

fn check(expect: &Expect, stored: Option<&Stored>) -> Result<(), StoreError> {
    let fits = match (expect, stored) {
        (Expect::Absent, None) => true,
        (Expect::Absent, Some(_)) => false,
        (Expect::Etags(_), None) => return Err(StoreError::MissingScene),
        (Expect::Etags(tags), Some(stored)) => tags.iter().any(|t| t == "*" || *t == stored.etag),
    };
    match stored {
        Some(stored) if !fits => {
            Err(StoreError::Stale { etag: stored.etag.clone(), updated_at: stored.updated_at.clone() })
        }
        _ => Ok(()),
    }
}

fn keep_map(tx: &Transaction<'_>, map: &PackedMap) -> Result<(), StoreError> {
    let Some(body) = &map.body else {
        let sql = "UPDATE maps SET used_at = ?2 WHERE sha = ?1";
        let found = tx.execute(sql, rusqlite::params![map.sha, seconds_now()])?;
        return if found == 1 { Ok(()) } else { Err(StoreError::MissingMap) };
    };
    let sql = "INSERT INTO maps (sha, bytes, polylines, points, body, used_at)
        VALUES (:sha, :bytes, :polylines, :points, :body, :now) ON CONFLICT (sha) DO UPDATE SET used_at = :now";
    tx.execute(
        sql,
        named_params! {
            ":sha": map.sha, ":bytes": as_i64(map.bytes), ":polylines": as_i64(map.polylines),
            ":points": as_i64(map.points), ":body": body, ":now": seconds_now(),
        },
    )?;
    Ok(())
}

fn save(
    tx: &Transaction<'_>,
    (id, rev, etag): (&str, i64, &str),
    viewer: &Viewer,
    scene: &PackedScene,
) -> Result<(), StoreError> {
    let sql = "INSERT INTO scenes (id, rev, etag, name, tags, parent_id, map_sha, meta, body, created_at, updated_at,
            owner, shared)
        VALUES (:id, :rev, :etag, :name, :tags, :parent, :map, :meta, :body, :now, :now, :owner,
            ifnull(:shared, 'nobody'))
        ON CONFLICT (id) DO UPDATE SET rev = :rev, etag = :etag, name = :name, tags = :tags,
            parent_id = :parent, map_sha = :map, meta = :meta, body = :body, updated_at = :now,
            shared = ifnull(:shared, shared)";
    tx.execute(
        sql,
        named_params! {
            ":id": id, ":rev": rev, ":etag": etag, ":name": scene.name, ":tags": scene.tags,
            ":parent": scene.parent_id, ":map": scene.map.sha, ":meta": scene.meta, ":body": scene.body,
            ":now": clock::now(), ":owner": viewer.owner(), ":shared": scene.shared.map(SceneShare::word),
        },
    )?;
    Ok(())
}

/// Strong ETag of a revision of a scene.
fn etag(rev: i64, text: &ContentHash) -> String {
    let hash = text.hex();
    format!("\"{rev}-{}\"", hash.get(..16).unwrap_or_default())
}

/// Refuses to exceed the store's size. Unused maps are kept for a while, but not if there is no room.
fn make_room(tx: &Transaction<'_>, grows: u64, most: u64) -> Result<(), StoreError> {
    let fits = |used: u64| grows == 0 || used.saturating_add(grows) <= most;
    if fits(used_bytes(tx)?) {
        return Ok(());
    }
    tx.execute(UNUSED_MAPS, [])?;
    if fits(used_bytes(tx)?) {
        Ok(())
    } else {
        Err(StoreError::Full("The file has reached its size.".into()))
    }
}

/// Pages of the file in use: those of deleted rows can be written again.
fn used_bytes(connection: &rusqlite::Connection) -> Result<u64, StoreError> {
    let number = |name: &str| connection.pragma_query_value(None, name, |row| row.get::<_, i64>(0));
    let pages = number("page_count")? - number("freelist_count")?;
    Ok((pages * number("page_size")?).unsigned_abs())
}

fn seconds_now() -> i64 {
    let since = SystemTime::now().duration_since(UNIX_EPOCH).unwrap_or_default();
    i64::try_from(since.as_secs()).unwrap_or(i64::MAX)
}

fn as_i64(count: usize) -> i64 {
    i64::try_from(count).unwrap_or(i64::MAX)
}
