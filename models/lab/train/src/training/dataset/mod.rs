//! Training records on disk and in memory.
//!
//! A file begins with the magic bytes and ten `u32` dimensions, so that a file of other features is refused.
//! Blocks of one tag byte, a `u32` length and that many bytes follow:
//! - `M`: a scene's map pieces.
//! - `R`: a record of the preceding scene.
//! - `P`: the provenance of the records ([`crate::provenance`], JSON), once.
//! - `E`: the counts and the BLAKE3 hash of everything before it, at the end.
//!
//! Numbers are little endian; arrays are `f32` in the order of the structs' fields.
//!
//! Safetensors is no alternative. Its header comes first and has every tensor's length, so scenes could not
//! be appended as they are read. Records (0 to 24 neighbours, 0 to 48 pieces, paths of 2 to 160 points) would
//! be padded or cut into tensors with offset tables.

mod codec;
mod read;
mod write;

pub use read::Records;
pub use write::RecordWriter;

use crate::polylines::{PIECE, PIECE_POSE, PIECES, SeenPiece};
use experts::features::{ANCHOR, AgentFeatures, GroundTruth, NEIGHBOUR, NEIGHBOURS, OWN};
use experts::planning::{INSTANTS, MODES, RESIDUAL};

/// Most neighbours with recorded boxes for the overlap energy.
pub const BOXES: usize = 16;
/// Most points of an anchor's path, one per metre.
pub const PATH_POINTS: usize = 160;

const MAGIC: &[u8; 8] = b"DTRECS4\n";
/// First bytes of files of the previous version, which lack the position of a road user in its scene.
const MAGIC_BEFORE: &[u8; 8] = b"DTRECS3\n";
const DIMENSIONS: [usize; 10] =
    [MODES, INSTANTS, RESIDUAL, OWN, PIECES, PIECE, PIECE_POSE, NEIGHBOURS, NEIGHBOUR, ANCHOR];

/// A recorded neighbour, in the road user's frame at t = 0.
#[derive(Clone, Debug, PartialEq)]
pub struct LoggedBox {
    /// Centre x, centre y, cosine and sine of the heading at each instant; all zero if nothing was recorded.
    pub poses: [[f32; 4]; INSTANTS],
    /// Half length and half width, metres.
    pub half: [f32; 2],
    /// Index of the road user in its scene.
    pub number: u32,
}

/// The path of an anchor, one point per metre, in the road user's frame at t = 0.
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
    /// Index of the road user in its scene.
    pub number: u32,
    /// Its frame at t = 0 in the scene: x and y, cosine and sine of the heading.
    pub place: [f32; 4],
    /// Inputs of the expert.
    pub agent: AgentFeatures,
    /// Map pieces that a baseline sees, by their indices in the scene.
    pub pieces: Vec<SeenPiece>,
    /// Recorded future.
    pub target: GroundTruth,
    /// Recorded neighbours, at most [`BOXES`], nearest first.
    pub boxes: Vec<LoggedBox>,
    /// The road user's own half length and half width, metres.
    pub half: [f32; 2],
    /// Distance from the point that follows the path forward to the centre of the box, metres.
    pub centre_ahead: f32,
    /// One path per mode.
    pub paths: Box<[AnchorPath; MODES]>,
    /// Relative probability of being drawn in training, above 0; 1 for an ordinary record.
    pub weight: f32,
}

/// Checks a record against the limits of its struct.
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::training::toy;

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
            assert_eq!((read.number, read.place), (written.number, written.place));
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
        refused(b"DTRECS3\n then what an older program wrote", "prepare them again");
        let mut other = good;
        other[8] = 7;
        refused(&other, "dimensions");
    }
}
