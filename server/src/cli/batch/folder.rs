//! The folder of results: names of its files, and how chunks are stored.

use super::store::ResultStore;
use crate::cli::{Exit, Failure};
use batch::catalogue::CatalogueScene;
use batch::chunk::BatchChunk;
use batch::row::{self, BatchRow, RowName};
use batch::unit::UnitList;
use formats::folder::Creation;
use formats::native;
use scene::{ContentHash, Scene};
use std::collections::BTreeSet;
use std::io::Read;
use std::ops::Deref;
use std::path::Path;

/// The document of the batch.
pub const RECORD: &str = "plan.json";
/// Folder of the chunks.
const CHUNKS: &str = "chunks";
/// Folder of the scenes.
const SCENES: &str = "scenes";
/// Extension of the tables.
const TABLE: &str = ".parquet";

/// Compression level of the scenes.
const ZSTD_LEVEL: i32 = 3;
/// Size limit of a scene document, bytes.
const MOST_SCENE: usize = 1 << 30;

/// A folder of results, on disk or in an object store.
pub struct BatchFolder(ResultStore);

impl Deref for BatchFolder {
    type Target = ResultStore;

    fn deref(&self) -> &ResultStore {
        &self.0
    }
}

impl BatchFolder {
    /// The folder at a path or a URL.
    ///
    /// # Errors
    /// Exit 2 when the path is a file, or the URL names no object store.
    pub fn new(place: &Path) -> Result<Self, Failure> {
        ResultStore::new(place).map(Self)
    }

    /// The table of a chunk. It is written last, so its existence marks a complete chunk.
    fn table(chunk: &str) -> String {
        format!("{CHUNKS}/{chunk}{TABLE}")
    }

    /// The kept results of a chunk.
    pub fn cases(chunk: &str) -> String {
        format!("{CHUNKS}/{chunk}.jsonl")
    }

    /// The motions of the kept results of a chunk.
    pub fn motions(chunk: &str) -> String {
        format!("{CHUNKS}/{chunk}.motions.jsonl")
    }

    /// Whether a chunk exists.
    ///
    /// # Errors
    /// Exit 3 when the store cannot tell.
    pub fn has_chunk(&self, chunk: &str) -> Result<bool, Failure> {
        self.has(&Self::table(chunk))
    }

    /// The rows of an existing chunk.
    ///
    /// # Errors
    /// Exit 3 for a table that cannot be read.
    pub fn rows(&self, chunk: &str) -> Result<Vec<BatchRow>, Failure> {
        let table = Self::table(chunk);
        row::read(&self.read(&table)?)
            .map_err(|error| Failure::input(format!("{}: {error}", self.shown_at(&table))))
    }

    /// The identifiers of the rows of an existing chunk.
    ///
    /// # Errors
    /// Exit 3 for a table that cannot be read.
    pub fn names(&self, chunk: &str) -> Result<Vec<RowName>, Failure> {
        let table = Self::table(chunk);
        row::names(&self.read(&table)?)
            .map_err(|error| Failure::input(format!("{}: {error}", self.shown_at(&table))))
    }

    /// Each of these chunks with its name, and whether it exists.
    ///
    /// # Errors
    /// Exit 3 when the folder cannot be listed.
    pub fn look_up(
        &self,
        chunks: impl Iterator<Item = BatchChunk>,
        list: &UnitList<'_>,
    ) -> Result<impl Iterator<Item = (BatchChunk, String, bool)>, Failure> {
        let files = self.list(CHUNKS)?;
        let tables: BTreeSet<String> =
            files.iter().filter_map(|name| Some(name.strip_suffix(TABLE)?.to_owned())).collect();
        Ok(chunks.map(move |chunk| {
            let name = chunk.name(list);
            let is_there = tables.contains(&name);
            (chunk, name, is_there)
        }))
    }

    /// Stores a chunk: its kept results with their motions, then its table.
    ///
    /// # Errors
    /// Exit 1 when one of its files exists with other bytes, or cannot be written.
    pub fn put(&self, chunk: &str, table: &[u8], cases: &[u8], motions: &[u8]) -> Result<(), Failure> {
        let files =
            [(Self::cases(chunk), cases), (Self::motions(chunk), motions), (Self::table(chunk), table)];
        for (name, bytes) in files {
            if self.create(&name, bytes)? == Creation::Different {
                let file = self.shown_at(&name);
                return Err(not_reproducible(&format!("{file} is there with other bytes")));
            }
        }
        Ok(())
    }

    /// Stores a scene and returns its hash: that of its document.
    ///
    /// # Errors
    /// Exit 1 when it cannot be written.
    pub fn put_scene(&self, scene: &Scene) -> Result<String, Failure> {
        let document = native::write(scene);
        let hash = ContentHash::of_bytes(&document).hex();
        let name = scene_file(&hash);
        // The name is the hash of the content.
        if !self.has(&name)? {
            self.create(&name, &zstd::bulk::compress(&document, ZSTD_LEVEL)?)?;
        }
        Ok(hash)
    }

    /// Reads a scene of the catalogue.
    ///
    /// # Errors
    /// Exit 3 when it is missing, or has another hash.
    pub fn read_scene(&self, entry: &CatalogueScene) -> Result<Scene, Failure> {
        let name = scene_file(&entry.sha256);
        let wrong = |reason: String| Failure::input(format!("{}: {reason}", self.shown_at(&name)));
        let packed = self.read(&name)?;
        let mut unpacked = Vec::new();
        let decoder = zstd::stream::read::Decoder::new(packed.as_slice());
        decoder
            .and_then(|decoder| decoder.take(MOST_SCENE as u64 + 1).read_to_end(&mut unpacked))
            .map_err(|error| wrong(error.to_string()))?;
        if unpacked.len() > MOST_SCENE || ContentHash::of_bytes(&unpacked).hex() != entry.sha256 {
            return Err(wrong("the content is not the one of its name".into()));
        }
        native::read(&unpacked).map_err(|error| wrong(error.to_string()))
    }

    /// Removes incomplete files of killed processes.
    ///
    /// # Errors
    /// Exit 1 when the folder cannot be read.
    pub fn sweep_all(&self) -> Result<(), Failure> {
        self.sweep(&["", CHUNKS, SCENES])
    }
}

fn scene_file(hash: &str) -> String {
    format!("{SCENES}/{hash}.json.zst")
}

/// The failure of two calls that should give equal bytes but did not.
pub fn not_reproducible(what: &str) -> Failure {
    let message = format!(
        "not-reproducible: {what}; the results come from different programs or processors, or a file was changed"
    );
    Failure::new(Exit::Failure, message)
}
