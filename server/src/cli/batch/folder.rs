//! The folder of results: where each file is, and how a chunk gets there.

use crate::cli::{Exit, Failure, output};
use batch::catalogue::CatalogueScene;
use batch::chunk::BatchChunk;
use batch::row::{self, BatchRow, RowName};
use batch::unit::UnitList;
use formats::folder::{self, Creation};
use formats::native;
use scene::{ContentHash, Scene};
use std::io::Read;
use std::path::{Path, PathBuf};

/// Compression level of the scenes.
const ZSTD_LEVEL: i32 = 3;
/// Largest document of a scene, bytes.
const MOST_SCENE: usize = 1 << 30;

/// A folder of results.
pub struct BatchFolder(PathBuf);

impl BatchFolder {
    /// At a path.
    ///
    /// # Errors
    /// Exit 2 when a file is there.
    pub fn new(path: &Path) -> Result<Self, Failure> {
        if path.exists() && !path.is_dir() {
            return Err(Failure::usage(format!("{}: a folder expected, this is a file", path.display())));
        }
        Ok(Self(path.to_path_buf()))
    }

    /// As messages name it.
    pub fn shown(&self) -> String {
        self.0.display().to_string()
    }

    /// `plan.json`.
    pub fn record(&self) -> PathBuf {
        self.0.join("plan.json")
    }

    /// A file beside it.
    pub fn at(&self, name: &str) -> PathBuf {
        self.0.join(name)
    }

    /// The table of a chunk. It is written last: with it the chunk is there.
    pub fn table(&self, chunk: &str) -> PathBuf {
        self.0.join(format!("chunks/{chunk}.parquet"))
    }

    /// The kept results of a chunk.
    pub fn cases(&self, chunk: &str) -> PathBuf {
        self.0.join(format!("chunks/{chunk}.jsonl"))
    }

    /// The motions of the kept results of a chunk.
    pub fn motions(&self, chunk: &str) -> PathBuf {
        self.0.join(format!("chunks/{chunk}.motions.jsonl"))
    }

    /// Is a chunk there?
    pub fn has(&self, chunk: &str) -> bool {
        self.table(chunk).exists()
    }

    /// The rows of a chunk that is there.
    ///
    /// # Errors
    /// Exit 3 for a table that cannot be read.
    pub fn rows(&self, chunk: &str) -> Result<Vec<BatchRow>, Failure> {
        let path = self.table(chunk);
        let bytes = output::read(&path)?;
        row::read(&bytes).map_err(|error| Failure::input(format!("{}: {error}", path.display())))
    }

    /// The names of the rows of a chunk that is there.
    ///
    /// # Errors
    /// Exit 3 for a table that cannot be read.
    pub fn names(&self, chunk: &str) -> Result<Vec<RowName>, Failure> {
        let path = self.table(chunk);
        let bytes = output::read(&path)?;
        row::names(&bytes).map_err(|error| Failure::input(format!("{}: {error}", path.display())))
    }

    /// Each of these chunks with its name, and whether it is there.
    pub fn look_up(
        &self,
        chunks: impl Iterator<Item = BatchChunk>,
        list: &UnitList<'_>,
    ) -> impl Iterator<Item = (BatchChunk, String, bool)> {
        chunks.map(|chunk| {
            let name = chunk.name(list);
            let is_there = self.has(&name);
            (chunk, name, is_there)
        })
    }

    /// Creates a file, unless it is there.
    ///
    /// # Errors
    /// Exit 1 when it cannot be written.
    pub fn create(&self, path: &Path, bytes: &[u8]) -> Result<Creation, Failure> {
        let failed =
            |error: std::io::Error| Failure::new(Exit::Failure, format!("{}: {error}", path.display()));
        folder::create(path, bytes).map_err(failed)
    }

    /// Puts a chunk into the folder: its kept results with their motions, then its table.
    ///
    /// # Errors
    /// Exit 1 when a file of it is there with other bytes, or cannot be written.
    pub fn put(&self, chunk: &str, table: &[u8], cases: &[u8], motions: &[u8]) -> Result<(), Failure> {
        let files = [(self.cases(chunk), cases), (self.motions(chunk), motions), (self.table(chunk), table)];
        for (path, bytes) in files {
            if self.create(&path, bytes)? == Creation::Different {
                let path = path.display();
                return Err(not_reproducible(&format!("{path} is there with other bytes")));
            }
        }
        Ok(())
    }

    /// Puts a scene into the folder and gives its hash: that of its document.
    ///
    /// # Errors
    /// Exit 1 when it cannot be written.
    pub fn put_scene(&self, scene: &Scene) -> Result<String, Failure> {
        let document = native::write(scene);
        let hash = ContentHash::of_bytes(&document).hex();
        let path = self.scene(&hash);
        // The name says the content.
        if !path.exists() {
            self.create(&path, &zstd::bulk::compress(&document, ZSTD_LEVEL)?)?;
        }
        Ok(hash)
    }

    /// Reads a scene of the catalogue.
    ///
    /// # Errors
    /// Exit 3 when it is not there, or is another one.
    pub fn read_scene(&self, entry: &CatalogueScene) -> Result<Scene, Failure> {
        let path = self.scene(&entry.sha256);
        let wrong = |reason: String| Failure::input(format!("{}: {reason}", path.display()));
        let packed = std::fs::read(&path).map_err(|error| wrong(error.to_string()))?;
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

    fn scene(&self, hash: &str) -> PathBuf {
        self.0.join(format!("scenes/{hash}.json.zst"))
    }

    /// Removes what killed processes left half written.
    ///
    /// # Errors
    /// Exit 1 when the folder cannot be read.
    pub fn sweep(&self) -> Result<(), Failure> {
        for part in [self.0.clone(), self.0.join("chunks"), self.0.join("scenes")] {
            if part.is_dir() {
                folder::sweep(&part)?;
            }
        }
        Ok(())
    }
}

/// Two calls that should give equal bytes did not.
pub fn not_reproducible(what: &str) -> Failure {
    let message = format!(
        "not-reproducible: {what}; the results come from different programs or processors, or a file was changed"
    );
    Failure::new(Exit::Failure, message)
}
