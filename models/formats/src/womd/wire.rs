//! Checks a record's protobuf bytes before they become structs: every length fits, and no repeated message is
//! more frequent than a scene can use. A two-byte message becomes a struct of up to a hundred bytes, so
//! without this check a small file could allocate gigabytes.

use crate::limits::{MAX_MAP_POINTS, MAX_POLYLINES, MAX_SIGNALS, MAX_STEPS};
use crate::problem::{FieldProblem, ReadError, code};
use crate::refusals::{self, more_than, wanted, what};
use scene::message::Word;

/// Most tracks that are read; the nearest 256 become road users.
pub const MAX_TRACKS: usize = 2_048;

/// Message type, as far as nesting and counting need it.
#[derive(Clone, Copy, PartialEq, Eq)]
enum ScenarioMessage {
    Scenario,
    Track,
    State,
    Prediction,
    Step,
    LaneState,
    Feature,
    Lane,
    Neighbor,
    Boundary,
    Line,
    StopSign,
    Area,
    Point,
}

impl ScenarioMessage {
    /// Kind of the message in a field of this message; `None` for a scalar or unknown field.
    fn child(self, field: u64) -> Option<Self> {
        Some(match (self, field) {
            (Self::Scenario, 2) => Self::Track,
            (Self::Scenario, 7) => Self::Step,
            (Self::Scenario, 8) => Self::Feature,
            (Self::Scenario, 11) => Self::Prediction,
            (Self::Track, 3) => Self::State,
            (Self::Step, 1) => Self::LaneState,
            (Self::LaneState, 3) | (Self::Lane, 8) | (Self::Line | Self::StopSign, 2) | (Self::Area, 1) => {
                Self::Point
            }
            (Self::Feature, 3) => Self::Lane,
            (Self::Feature, 4 | 5) => Self::Line,
            (Self::Feature, 7) => Self::StopSign,
            (Self::Feature, 8..=10) => Self::Area,
            (Self::Lane, 11 | 12) => Self::Neighbor,
            (Self::Lane, 13 | 14) | (Self::Neighbor, 6) => Self::Boundary,
            _ => return None,
        })
    }

    /// Most messages of this type in a record, and the refusal beyond it.
    fn limit(self) -> (usize, &'static str, &'static str) {
        match self {
            Self::Track => (MAX_TRACKS, "/tracks", code::TOO_MANY_AGENTS),
            Self::State => (MAX_TRACKS * MAX_STEPS, "/tracks", code::OUT_OF_RANGE),
            Self::Step => (MAX_STEPS, "/dynamic_map_states", code::OUT_OF_RANGE),
            Self::LaneState => (MAX_SIGNALS * MAX_STEPS, "/dynamic_map_states", code::MAP_TOO_LARGE),
            Self::Prediction => (MAX_TRACKS, "/tracks_to_predict", code::INVALID_FIELD),
            Self::Point => (MAX_MAP_POINTS + MAX_SIGNALS * MAX_STEPS, "/map_features", code::MAP_TOO_LARGE),
            Self::Neighbor | Self::Boundary => (10 * MAX_POLYLINES, "/map_features", code::MAP_TOO_LARGE),
            _ => (MAX_POLYLINES, "/map_features", code::MAP_TOO_LARGE),
        }
    }
}

const KINDS: usize = ScenarioMessage::Point as usize + 1;

/// Checks one record that begins at `offset` of the decoded file.
pub fn check(bytes: &[u8], offset: u64) -> Result<(), ReadError> {
    let mut counts = [0; KINDS];
    walk(ScenarioMessage::Scenario, WireCursor { bytes, at: 0, offset }, &mut counts)
}

fn walk(
    kind: ScenarioMessage,
    mut wire: WireCursor<'_>,
    counts: &mut [usize; KINDS],
) -> Result<(), ReadError> {
    let mut states = 0;
    while let Some((field, value)) = wire.next_field()? {
        let (Some(child), Some(inner)) = (kind.child(field), value) else { continue };
        if let Some(count) = counts.get_mut(child as usize) {
            *count += 1;
            let (limit, pointer, code) = child.limit();
            if *count > limit {
                return Err(FieldProblem::new(pointer, code, more_than(limit, what::MESSAGES)).into());
            }
        }
        states += usize::from(child == ScenarioMessage::State);
        if states > MAX_STEPS {
            let message = more_than(MAX_STEPS, what::TRACK_STATES);
            return Err(FieldProblem::new("/tracks", code::OUT_OF_RANGE, message).into());
        }
        // Depth is at most five: scenario, feature, lane, neighbour, boundary.
        walk(child, inner, counts)?;
    }
    Ok(())
}

/// A cursor over the fields of one message.
#[derive(Clone, Copy)]
struct WireCursor<'a> {
    bytes: &'a [u8],
    at: usize,
    offset: u64,
}

impl<'a> WireCursor<'a> {
    /// Field number, and its content if it is length-delimited.
    fn next_field(&mut self) -> Result<Option<(u64, Option<WireCursor<'a>>)>, ReadError> {
        if self.at >= self.bytes.len() {
            return Ok(None);
        }
        let start = self.at;
        let key = self.varint()?;
        let (field, wire_type) = (key >> 3, key & 7);
        if field == 0 || field > 0x1fff_ffff {
            return Err(self.fault(start, wanted::FIELD_NUMBER));
        }
        let value = match wire_type {
            0 => {
                self.varint()?;
                None
            }
            1 => self.take(8)?,
            5 => self.take(4)?,
            2 => {
                let length = self.varint()?;
                self.take(length)?
            }
            _ => return Err(self.fault(start, wanted::WIRE_TYPE)),
        };
        Ok(Some((field, value.filter(|_| wire_type == 2))))
    }

    fn take(&mut self, length: u64) -> Result<Option<WireCursor<'a>>, ReadError> {
        let start = self.at;
        let rest = (self.bytes.len() - start) as u64;
        if length > rest {
            let message = refusals::at_most(length, what::FIELD_BYTES, rest);
            return Err(ReadError::malformed(self.offset + start as u64, message));
        }
        self.at = start + length as usize;
        let bytes = self.bytes.get(start..self.at).unwrap_or_default();
        Ok(Some(WireCursor { bytes, at: 0, offset: self.offset + start as u64 }))
    }

    fn varint(&mut self) -> Result<u64, ReadError> {
        let start = self.at;
        let mut value = 0u64;
        for shift in (0..70).step_by(7) {
            let Some(byte) = self.bytes.get(self.at) else {
                return Err(self.fault(start, wanted::WHOLE_NUMBER));
            };
            self.at += 1;
            value |= u64::from(byte & 0x7f).checked_shl(shift).unwrap_or(0);
            if byte & 0x80 == 0 {
                return Ok(value);
            }
        }
        Err(self.fault(start, wanted::NUMBER_10))
    }

    fn fault(&self, at: usize, wanted: Word) -> ReadError {
        ReadError::malformed(self.offset + at as u64, refusals::expected(wanted))
    }
}

#[cfg(test)]
mod tests {
    use super::check;
    use crate::problem::RefusalKind;

    #[test]
    fn faults_have_their_byte() {
        for (bytes, at) in [
            (&[0x12, 0x05, 0x08][..], 2),
            (&[0x08, 0xff, 0xff], 1),
            (&[0x12, 0x02, 0x1a, 0x09], 4),
            (&[0x0b], 0),
            (&[0x00], 0),
            (&[0x08, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0x01], 1),
            (&[0x62, 0xff, 0xff, 0xff, 0xff, 0x0f], 6),
        ] {
            let error = check(bytes, 100).expect_err("broken");
            assert_eq!(error.kind, RefusalKind::MalformedFile { offset: 100 + at }, "{bytes:x?}");
        }
    }

    #[test]
    fn small_messages_cannot_become_many_structs() {
        let bytes = [0x12, 0x00].repeat(5_000);
        assert_eq!(check(&bytes, 0).expect_err("too many").code(), "too-many-agents");
        let mut track = vec![0x12, 0xd4, 0x0b];
        track.extend([0x1a, 0x00].repeat(746));
        assert_eq!(check(&track, 0).expect_err("too many").code(), "out-of-range");
    }
}
