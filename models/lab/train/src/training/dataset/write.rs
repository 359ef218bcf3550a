//! Writes records to a file.

use super::codec::Sink;
use super::{DIMENSIONS, MAGIC, Record, check};
use crate::polylines::PIECE;
use crate::provenance::Provenance;
use crate::training::TrainError;
use formats::files::Whole;
use std::io::Write;
use std::path::{Path, PathBuf};

/// Writes a file of records, scene by scene.
pub struct RecordWriter {
    path: PathBuf,
    file: Whole,
    provenance: Provenance,
    hash: blake3::Hasher,
    scenes: u32,
    records: u64,
}

impl RecordWriter {
    /// Begins a file; it appears under its name when [`RecordWriter::finish`] has succeeded.
    ///
    /// # Errors
    /// When the file cannot be created.
    pub fn create(path: &Path, provenance: Provenance) -> Result<Self, TrainError> {
        let file = Whole::create(path).map_err(TrainError::io(path))?;
        let mut writer = Self {
            path: path.to_path_buf(),
            file,
            provenance,
            hash: blake3::Hasher::new(),
            scenes: 0,
            records: 0,
        };
        let mut head = Sink::default();
        head.bytes(MAGIC);
        for dimension in DIMENSIONS {
            head.count(dimension);
        }
        writer.put(head.as_slice())?;
        Ok(writer)
    }

    /// Adds the scenes of other records to the file's provenance.
    pub fn comes_from(&mut self, more: &Provenance) {
        self.provenance.merge(more);
    }

    /// Adds a scene. The hash of `key` decides whether the scene is held out for validation: scenes that must
    /// stay together (windows of one place) share a key. Pieces that no road user sees are dropped.
    ///
    /// # Errors
    /// When a record breaks the limits of its struct, or the file cannot be written.
    pub fn scene(&mut self, key: u64, map: &[[f32; PIECE]], records: &[Record]) -> Result<(), TrainError> {
        let mut renamed: Vec<Option<usize>> = vec![None; map.len()];
        let mut used = Vec::new();
        for record in records {
            check(record, map.len()).map_err(|reason| TrainError::damaged(&self.path, reason))?;
            for seen in &record.pieces {
                if renamed[seen.piece].is_none() {
                    renamed[seen.piece] = Some(used.len());
                    used.push(seen.piece);
                }
            }
        }
        let mut sink = Sink::default();
        sink.u64(key);
        sink.count(used.len());
        for &piece in &used {
            sink.floats(&map[piece]);
        }
        self.block(b'M', sink.as_slice())?;
        for record in records {
            let mut sink = Sink::default();
            encode(record, &renamed, &mut sink);
            self.block(b'R', sink.as_slice())?;
        }
        self.scenes += 1;
        self.records += records.len() as u64;
        Ok(())
    }

    /// Writes counts and hash and gives the file its name. Returns the hash of the whole file.
    ///
    /// # Errors
    /// When the file cannot be written or renamed.
    pub fn finish(mut self) -> Result<blake3::Hash, TrainError> {
        let text = serde_json::to_vec(&self.provenance)
            .map_err(|error| TrainError::damaged(&self.path, error.to_string()))?;
        self.block(b'P', &text)?;
        let mut sink = Sink::default();
        sink.count(self.scenes as usize);
        sink.u64(self.records);
        sink.bytes(self.hash.finalize().as_bytes());
        self.block(b'E', sink.as_slice())?;
        self.file.finish().map_err(TrainError::io(&self.path))?;
        Ok(self.hash.finalize())
    }

    fn block(&mut self, tag: u8, payload: &[u8]) -> Result<(), TrainError> {
        self.put(&[tag])?;
        self.put(&(payload.len() as u32).to_le_bytes())?;
        self.put(payload)
    }

    fn put(&mut self, bytes: &[u8]) -> Result<(), TrainError> {
        self.hash.update(bytes);
        self.file.write_all(bytes).map_err(TrainError::io(&self.path))
    }
}

fn encode(record: &Record, renamed: &[Option<usize>], sink: &mut Sink) {
    let (agent, target) = (&record.agent, &record.target);
    sink.count(record.number as usize);
    sink.floats(&record.place);
    sink.floats(&[record.weight]);
    sink.floats(&agent.own);
    sink.count(record.pieces.len());
    for seen in &record.pieces {
        sink.count(renamed.get(seen.piece).copied().flatten().unwrap_or(0));
        sink.floats(&seen.pose);
    }
    sink.count(agent.neighbours.len());
    sink.floats(agent.neighbours.as_flattened());
    sink.floats(agent.anchors.as_flattened());
    sink.floats(agent.tangent.as_flattened().as_flattened());
    sink.floats(target.base_along.as_flattened());
    sink.floats(target.along.as_flattened());
    sink.floats(target.across.as_flattened());
    sink.floats(&target.valid);
    sink.floats(&[target.stays]);
    sink.floats(&record.half);
    sink.floats(&[record.centre_ahead]);
    sink.count(record.boxes.len());
    for logged in &record.boxes {
        sink.count(logged.number as usize);
        sink.floats(logged.poses.as_flattened());
        sink.floats(&logged.half);
    }
    for path in record.paths.iter() {
        sink.floats(&[path.start]);
        sink.count(path.points.len());
        sink.floats(path.points.as_flattened());
    }
}
