//! Reads files of records.

use super::codec::Cursor;
use super::{AnchorPath, BOXES, DIMENSIONS, LoggedBox, MAGIC, MAGIC_BEFORE, PATH_POINTS, Record, check};
use crate::polylines::{PIECE, PIECE_POSE, PIECES, SeenPiece};
use crate::provenance::Provenance;
use crate::training::TrainError;
use experts::features::{ANCHOR, AgentFeatures, GroundTruth, NEIGHBOUR, NEIGHBOURS, OWN};
use experts::planning::{INSTANTS, MODES};
use scene::KNOTS;
use std::fs::File;
use std::io::Read;
use std::path::PathBuf;

fn decode(bytes: &[u8]) -> Result<Record, String> {
    let mut cursor = Cursor::new(bytes);
    let number = cursor.count(u32::MAX as usize)? as u32;
    let place = cursor.array::<4>()?;
    let weight = cursor.float()?;
    let own = cursor.array::<OWN>()?;
    let pieces = (0..cursor.count(PIECES)?)
        .map(|_| Ok(SeenPiece { piece: cursor.count(usize::MAX)?, pose: cursor.array::<PIECE_POSE>()? }))
        .collect::<Result<Vec<_>, String>>()?;
    let count = cursor.count(NEIGHBOURS)?;
    let neighbours = (0..count).map(|_| cursor.array::<NEIGHBOUR>()).collect::<Result<Vec<_>, _>>()?;
    let mut anchors = Box::new([[0.0; ANCHOR]; MODES]);
    cursor.fill(anchors.as_flattened_mut())?;
    let mut tangent = Box::new([[[0.0; KNOTS]; KNOTS]; 2]);
    cursor.fill(tangent.as_flattened_mut().as_flattened_mut())?;
    let mut target = GroundTruth {
        base_along: [[0.0; INSTANTS]; MODES],
        along: [[0.0; INSTANTS]; MODES],
        across: [[0.0; INSTANTS]; MODES],
        valid: [0.0; INSTANTS],
        stays: 0.0,
    };
    cursor.fill(target.base_along.as_flattened_mut())?;
    cursor.fill(target.along.as_flattened_mut())?;
    cursor.fill(target.across.as_flattened_mut())?;
    cursor.fill(&mut target.valid)?;
    target.stays = cursor.float()?;
    let half = cursor.array::<2>()?;
    let centre_ahead = cursor.float()?;
    let count = cursor.count(BOXES)?;
    let boxes = (0..count).map(|_| decode_box(&mut cursor)).collect::<Result<Vec<_>, _>>()?;
    let mut paths = Box::new(std::array::from_fn(|_| AnchorPath::default()));
    for path in paths.iter_mut() {
        *path = decode_path(&mut cursor)?;
    }
    cursor.end()?;
    let agent = AgentFeatures { own, neighbours, anchors, tangent };
    Ok(Record { number, place, agent, pieces, target, boxes, half, centre_ahead, paths, weight })
}

fn decode_box(cursor: &mut Cursor<'_>) -> Result<LoggedBox, String> {
    let number = cursor.count(u32::MAX as usize)? as u32;
    let mut poses = [[0.0; 4]; INSTANTS];
    cursor.fill(poses.as_flattened_mut())?;
    Ok(LoggedBox { poses, half: cursor.array::<2>()?, number })
}

fn decode_path(cursor: &mut Cursor<'_>) -> Result<AnchorPath, String> {
    let start = cursor.float()?;
    let count = cursor.count(PATH_POINTS)?;
    let mut points = vec![[0.0; 2]; count];
    cursor.fill(points.as_flattened_mut())?;
    Ok(AnchorPath { start, points })
}

struct RecordEntry {
    file: usize,
    scene: usize,
    at: std::ops::Range<usize>,
}

struct SceneEntry {
    key: u64,
    file: usize,
    /// Offset of the pieces' numbers, and number of pieces.
    at: usize,
    pieces: usize,
}

/// Records in memory, as compact as on disk; each is decoded on demand.
pub struct Records {
    files: Vec<Vec<u8>>,
    scenes: Vec<SceneEntry>,
    entries: Vec<RecordEntry>,
    /// By file.
    provenances: Vec<Provenance>,
    hash: blake3::Hash,
}

impl Records {
    /// Reads complete files and checks their hashes and every record.
    ///
    /// # Errors
    /// When a file cannot be read, is damaged, or was written for other features.
    pub fn load(paths: &[PathBuf]) -> Result<Self, TrainError> {
        let mut records = Self {
            files: Vec::new(),
            scenes: Vec::new(),
            entries: Vec::new(),
            provenances: Vec::new(),
            hash: blake3::hash(b""),
        };
        let mut all = blake3::Hasher::new();
        for path in paths {
            let mut bytes = Vec::new();
            File::open(path)
                .and_then(|mut file| file.read_to_end(&mut bytes))
                .map_err(TrainError::io(path))?;
            let hash = records.index(&bytes).map_err(|reason| TrainError::damaged(path, reason))?;
            all.update(hash.as_bytes());
            records.files.push(bytes);
        }
        records.hash = all.finalize();
        Ok(records)
    }

    fn index(&mut self, bytes: &[u8]) -> Result<blake3::Hash, String> {
        let file = self.files.len();
        let (scenes_before, entries_before) = (self.scenes.len(), self.entries.len());
        let mut cursor = Cursor::new(bytes);
        match cursor.take(MAGIC.len())? {
            magic if magic == MAGIC => {}
            magic if magic == MAGIC_BEFORE => {
                return Err(
                    "records of an earlier program, which do not say where road users are; prepare them again"
                        .into(),
                );
            }
            _ => return Err("not a file of training records".into()),
        }
        let mut found = [0; DIMENSIONS.len()];
        for dimension in &mut found {
            *dimension = cursor.count(usize::MAX)?;
        }
        if found != DIMENSIONS {
            return Err(format!("written for dimensions {found:?}, this program has {DIMENSIONS:?}"));
        }
        loop {
            let before = cursor.position();
            let tag = cursor.take(1)?[0];
            let length = cursor.count(usize::MAX)?;
            let at = cursor.position();
            let payload = cursor.take(length)?;
            match tag {
                b'M' => {
                    let mut inner = Cursor::new(payload);
                    let (key, pieces) = (inner.u64()?, inner.count(usize::MAX)?);
                    inner.take(pieces * PIECE * 4)?;
                    inner.end()?;
                    self.scenes.push(SceneEntry { key, file, at: at + 12, pieces });
                }
                b'R' => {
                    let scene = self.scenes.len().checked_sub(1).ok_or("a record before any scene")?;
                    check(&decode(payload)?, self.scenes[scene].pieces)?;
                    self.entries.push(RecordEntry { file, scene, at: at..at + length });
                }
                b'P' => {
                    let found =
                        serde_json::from_slice(payload).map_err(|e| format!("where it comes from: {e}"))?;
                    self.provenances.push(found);
                }
                b'E' => {
                    if self.provenances.len() != file + 1 {
                        return Err("it does not say once where its records come from".into());
                    }
                    let mut inner = Cursor::new(payload);
                    let (scenes, records) = (inner.count(usize::MAX)?, inner.u64()? as usize);
                    let hash = blake3::hash(&bytes[..before]);
                    if inner.take(32)? != hash.as_bytes() {
                        return Err("the hash at the end does not match the content".into());
                    }
                    let counts = (self.scenes.len() - scenes_before, self.entries.len() - entries_before);
                    if counts != (scenes, records) {
                        return Err(format!(
                            "counts {counts:?} differ from ({scenes}, {records}) at the end"
                        ));
                    }
                    cursor.end()?;
                    return Ok(hash);
                }
                other => return Err(format!("unknown block tag {other} at byte {before}")),
            }
        }
    }

    /// Provenance of the records of each file.
    pub fn provenances(&self) -> &[Provenance] {
        &self.provenances
    }

    /// Number of records.
    pub fn len(&self) -> usize {
        self.entries.len()
    }

    /// Whether it has no records.
    pub fn is_empty(&self) -> bool {
        self.entries.is_empty()
    }

    /// Number of scenes.
    pub fn scenes(&self) -> usize {
        self.scenes.len()
    }

    /// Number of files.
    pub fn files(&self) -> usize {
        self.files.len()
    }

    /// Index of the file that a record is in.
    pub fn file_of(&self, index: usize) -> usize {
        self.entries[index].file
    }

    /// Hash over all files.
    pub fn hash(&self) -> blake3::Hash {
        self.hash
    }

    /// Key of a record's scene, and the scene's index.
    pub fn scene_of(&self, index: usize) -> (u64, usize) {
        let scene = self.entries[index].scene;
        (self.scenes[scene].key, scene)
    }

    /// Decodes a record.
    ///
    /// # Errors
    /// Never for an index below [`Records::len`]: all records were checked when they were loaded.
    pub fn get(&self, index: usize) -> Result<Record, TrainError> {
        let entry = &self.entries[index];
        decode(&self.files[entry.file][entry.at.clone()]).map_err(TrainError::Invalid)
    }

    /// One piece of a scene's map.
    pub fn piece(&self, scene: usize, piece: usize) -> [f32; PIECE] {
        let entry = &self.scenes[scene];
        let at = entry.at + piece * PIECE * 4;
        let bytes = &self.files[entry.file][at..at + PIECE * 4];
        std::array::from_fn(|i| {
            f32::from_le_bytes([bytes[4 * i], bytes[4 * i + 1], bytes[4 * i + 2], bytes[4 * i + 3]])
        })
    }
}
