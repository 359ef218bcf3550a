//! Training records on disk and in memory.
//!
//! A file is: the magic bytes, ten `u32` dimensions (so that a file of other features is refused),
//! then blocks of one tag byte, a `u32` length and that many bytes: `M` a scene's map pieces, `R` a
//! record of the scene before it, and one `E` with the counts and the BLAKE3 hash of all before it.
//! Numbers are little endian; arrays are `f32` in the order of the structs' fields.

use std::fs::File;
use std::io::{BufWriter, Read, Write};
use std::path::{Path, PathBuf};

use experts::features::{ANCHOR, AgentFeatures, GroundTruth, NEIGHBOUR, NEIGHBOURS, OWN};

use experts::planning::{INSTANTS, MODES, RESIDUAL};
use scene::KNOTS;

use super::codec::{Cursor, Sink};
use super::error::TrainError;
use crate::polylines::{PIECE, PIECE_POSE, PIECES, SeenPiece};

/// Most neighbours whose recorded boxes are kept for the overlap energy.
pub const BOXES: usize = 8;
/// Most points of an anchor's path, one a metre.
pub const PATH_POINTS: usize = 160;

const MAGIC: &[u8; 8] = b"DTRECS2\n";
const DIMENSIONS: [usize; 10] =
    [MODES, INSTANTS, RESIDUAL, OWN, PIECES, PIECE, PIECE_POSE, NEIGHBOURS, NEIGHBOUR, ANCHOR];

/// A neighbour as it was recorded, in the road user's frame at t = 0.
#[derive(Clone, Debug, PartialEq)]
pub struct LoggedBox {
    /// Centre x, centre y, cosine and sine of the heading at each instant; all zero where nothing
    /// was recorded.
    pub poses: [[f32; 4]; INSTANTS],
    /// Half length and half width, metres.
    pub half: [f32; 2],
}

/// The path of an anchor, one point a metre, in the road user's frame at t = 0.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct AnchorPath {
    /// Progress of the first point, metres on the scale of [`GroundTruth::base_along`]; may be negative.
    pub start: f32,
    /// At least two and at most [`PATH_POINTS`] points (x, y).
    pub points: Vec<[f32; 2]>,
}

/// One road user under one choice of conditions.
#[derive(Clone, Debug)]
pub struct Record {
    /// What the expert sees.
    pub agent: AgentFeatures,
    /// What a baseline sees of the map. Indices are those of the scene's pieces.
    pub pieces: Vec<SeenPiece>,
    /// What happened.
    pub target: GroundTruth,
    /// Recorded neighbours, at most [`BOXES`], nearest first.
    pub boxes: Vec<LoggedBox>,
    /// The road user's own half length and half width, metres.
    pub half: [f32; 2],
    /// Metres from the point that follows the path forward to the centre of the box.
    pub centre_ahead: f32,
    /// One path a mode.
    pub paths: Box<[AnchorPath; MODES]>,
    /// Relative chance of being drawn in training, above 0; 1 for an ordinary record.
    pub weight: f32,
}

/// Writes a file of records, scene by scene.
pub struct Writer {
    path: PathBuf,
    partial: PathBuf,
    file: BufWriter<File>,
    hash: blake3::Hasher,
    scenes: u32,
    records: u64,
}

impl Writer {
    /// Begins a file; it appears under its name when [`Writer::finish`] has succeeded.
    ///
    /// # Errors
    /// When the file cannot be created.
    pub fn create(path: &Path) -> Result<Self, TrainError> {
        let partial = path.with_extension("partial");
        let file = BufWriter::new(File::create(&partial).map_err(TrainError::io(&partial))?);
        let mut writer = Self {
            path: path.to_path_buf(),
            partial,
            file,
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

    /// Adds a scene. `key` decides, by its hash, whether the scene is held out for validation: scenes
    /// that must stay together (cut from one place) share a key. Pieces nobody sees are dropped.
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
        let mut sink = Sink::default();
        sink.count(self.scenes as usize);
        sink.u64(self.records);
        sink.bytes(self.hash.finalize().as_bytes());
        self.block(b'E', sink.as_slice())?;
        self.file.flush().map_err(TrainError::io(&self.partial))?;
        self.file.get_ref().sync_all().map_err(TrainError::io(&self.partial))?;
        std::fs::rename(&self.partial, &self.path).map_err(TrainError::io(&self.path))?;
        Ok(self.hash.finalize())
    }

    fn block(&mut self, tag: u8, payload: &[u8]) -> Result<(), TrainError> {
        self.put(&[tag])?;
        self.put(&(payload.len() as u32).to_le_bytes())?;
        self.put(payload)
    }

    fn put(&mut self, bytes: &[u8]) -> Result<(), TrainError> {
        self.hash.update(bytes);
        self.file.write_all(bytes).map_err(TrainError::io(&self.partial))
    }
}

fn check(record: &Record, pieces: usize) -> Result<(), String> {
    let agent = &record.agent;
    if record.pieces.len() > PIECES || agent.neighbours.len() > NEIGHBOURS || record.boxes.len() > BOXES {
        return Err(format!(
            "a record has {} pieces, {} neighbours, {} boxes; at most {PIECES}, {NEIGHBOURS}, {BOXES} fit",
            record.pieces.len(),
            agent.neighbours.len(),
            record.boxes.len()
        ));
    }
    if let Some(seen) = record.pieces.iter().find(|seen| seen.piece >= pieces) {
        return Err(format!("a record sees piece {} of a map of {pieces}", seen.piece));
    }
    if let Some(path) = record.paths.iter().find(|p| !(2..=PATH_POINTS).contains(&p.points.len())) {
        return Err(format!("an anchor path has {} points; 2 to {PATH_POINTS} fit", path.points.len()));
    }
    if !(record.weight > 0.0 && record.weight.is_finite()) {
        return Err(format!("a record has weight {}; it must be above 0", record.weight));
    }
    Ok(())
}

fn encode(record: &Record, renamed: &[Option<usize>], sink: &mut Sink) {
    let (agent, target) = (&record.agent, &record.target);
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
        sink.floats(logged.poses.as_flattened());
        sink.floats(&logged.half);
    }
    for path in record.paths.iter() {
        sink.floats(&[path.start]);
        sink.count(path.points.len());
        sink.floats(path.points.as_flattened());
    }
}

fn decode(bytes: &[u8]) -> Result<Record, String> {
    let mut cursor = Cursor::new(bytes);
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
    Ok(Record { agent, pieces, target, boxes, half, centre_ahead, paths, weight })
}

fn decode_box(cursor: &mut Cursor<'_>) -> Result<LoggedBox, String> {
    let mut poses = [[0.0; 4]; INSTANTS];
    cursor.fill(poses.as_flattened_mut())?;
    Ok(LoggedBox { poses, half: cursor.array::<2>()? })
}

fn decode_path(cursor: &mut Cursor<'_>) -> Result<AnchorPath, String> {
    let start = cursor.float()?;
    let count = cursor.count(PATH_POINTS)?;
    let mut points = vec![[0.0; 2]; count];
    cursor.fill(points.as_flattened_mut())?;
    Ok(AnchorPath { start, points })
}

struct Entry {
    file: usize,
    scene: usize,
    at: std::ops::Range<usize>,
}

struct SceneEntry {
    key: u64,
    file: usize,
    /// Where the pieces' numbers lie, and how many pieces there are.
    at: usize,
    pieces: usize,
}

/// Records in memory, as compact as on disk; one is decoded when it is asked for.
pub struct Records {
    files: Vec<Vec<u8>>,
    scenes: Vec<SceneEntry>,
    entries: Vec<Entry>,
    hash: blake3::Hash,
}

impl Records {
    /// Reads files whole and checks their hashes and every record.
    ///
    /// # Errors
    /// When a file cannot be read, is damaged, or was written for other features.
    pub fn load(paths: &[PathBuf]) -> Result<Self, TrainError> {
        let mut records =
            Self { files: Vec::new(), scenes: Vec::new(), entries: Vec::new(), hash: blake3::hash(b"") };
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
        if cursor.take(MAGIC.len())? != MAGIC {
            return Err("not a file of training records".into());
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
                    self.entries.push(Entry { file, scene, at: at..at + length });
                }
                b'E' => {
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

    /// Number of records.
    pub fn len(&self) -> usize {
        self.entries.len()
    }

    /// Whether there are none.
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
    /// Never for an index below [`Records::len`]: all were checked when they were loaded.
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::train::toy;

    #[test]
    fn a_file_gives_back_what_was_written() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.records");
        let scenes = toy::scenes(3, 4, 7);
        toy::write(&path, &scenes);
        let records = Records::load(&[path.clone(), path]).unwrap();
        assert_eq!((records.len(), records.scenes()), (24, 6));
        for index in 0..12 {
            let (written, read) = (&scenes[index / 4].2[index % 4], records.get(index).unwrap());
            assert_eq!(read.agent.own, written.agent.own);
            assert_eq!(read.agent.anchors, written.agent.anchors);
            assert_eq!(read.boxes, written.boxes);
            assert_eq!(read.paths, written.paths);
            assert_eq!(read.target.along, written.target.along);
            let (key, scene) = records.scene_of(index);
            assert_eq!((key, scene), (scenes[index / 4].0, index / 4));
            for (seen, original) in read.pieces.iter().zip(&written.pieces) {
                assert_eq!(seen.pose, original.pose);
                assert_eq!(records.piece(scene, seen.piece), scenes[index / 4].1[original.piece]);
            }
        }
    }

    #[test]
    fn damage_is_found() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.records");
        toy::write(&path, &toy::scenes(1, 2, 7));
        let good = std::fs::read(&path).unwrap();
        let refused = |bytes: &[u8], word: &str| {
            std::fs::write(&path, bytes).unwrap();
            let message = Records::load(std::slice::from_ref(&path)).err().unwrap().to_string();
            assert!(message.contains(word), "{message}");
        };
        refused(&good[..good.len() - 1], "ends early");
        let mut flipped = good.clone();
        flipped[100] ^= 1;
        refused(&flipped, "hash");
        refused(b"something else entirely", "not a file of training records");
        let mut other = good;
        other[8] = 7;
        refused(&other, "dimensions");
    }
}
