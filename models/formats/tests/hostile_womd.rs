//! Malformed and hostile record files: each is refused with the right code, at the right byte, in
//! bounded time and memory. Run with `--nocapture` to see the table.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    clippy::print_stdout,
    reason = "a test stops at the first surprise"
)]

use flate2::Compression;
use flate2::write::GzEncoder;
use formats::ExportedMotion;
use formats::womd::proto::{FeatureData, MapFeature, MapPoint, Polygon, Scenario};
use formats::womd::{self, Options, masked_crc, write_record};
use formats::{ReadError, RefusalKind};
use prost::Message;
use std::io::Write;
use std::time::{Duration, Instant};

/// Longer than any of them takes, on a busy machine too.
const PATIENCE: Duration = Duration::from_secs(20);

/// Our own small scene as a message.
fn message() -> Scenario {
    let scene = formats::native::read(include_bytes!("fixtures/junction.scene.json")).unwrap();
    womd::scenario(&scene, ExportedMotion::Log).0
}

fn framed(data: &[u8]) -> Vec<u8> {
    let mut file = Vec::new();
    write_record(&mut file, data).unwrap();
    file
}

fn gzip(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = GzEncoder::new(Vec::new(), Compression::best());
    encoder.write_all(bytes).unwrap();
    encoder.finish().unwrap()
}

/// A frame that declares a length, with a right checksum of it, before other bytes.
fn lying(length: u64, rest: &[u8]) -> Vec<u8> {
    let mut file = length.to_le_bytes().to_vec();
    file.extend(masked_crc(&length.to_le_bytes()).to_le_bytes());
    file.extend(rest);
    file
}

/// The message after a change, framed.
fn edited(change: impl FnOnce(&mut Scenario)) -> Vec<u8> {
    let mut message = message();
    change(&mut message);
    framed(&message.encode_to_vec())
}

/// The message with raw protobuf bytes after it, framed.
fn appended(bytes: &[u8]) -> Vec<u8> {
    let mut data = message().encode_to_vec();
    data.extend(bytes);
    framed(&data)
}

fn cut(mut file: Vec<u8>, length: usize) -> Vec<u8> {
    file.truncate(length);
    file
}

fn flipped(mut file: Vec<u8>, at: usize) -> Vec<u8> {
    file[at] ^= 0x10;
    file
}

fn feature(data: FeatureData) -> MapFeature {
    MapFeature { id: Some(9), feature_data: Some(data) }
}

fn points(n: usize) -> Vec<MapPoint> {
    (0..n).map(|i| MapPoint { x: Some(i as f64 * 0.01), y: Some(0.0), z: None }).collect()
}

/// File, name, code, and the offset for a broken file.
fn cases() -> Vec<(&'static str, Vec<u8>, &'static str, Option<u64>)> {
    let good = framed(&message().encode_to_vec());
    let end = good.len() as u64;
    let file = "malformed-file";
    let mut list = vec![
        ("empty file", vec![], file, Some(0)),
        ("one byte", vec![7], file, Some(0)),
        ("ends within the length", cut(good.clone(), 5), file, Some(0)),
        ("ends within the length's checksum", cut(good.clone(), 10), file, Some(8)),
        ("ends after the length's checksum", cut(good.clone(), 12), file, Some(12)),
        ("ends within the data", cut(good.clone(), 500), file, Some(12)),
        ("ends before the data's checksum", cut(good.clone(), good.len() - 4), file, Some(end - 4)),
        ("ends within the data's checksum", cut(good.clone(), good.len() - 1), file, Some(end - 4)),
        ("bit flipped in the length", flipped(good.clone(), 0), file, Some(0)),
        ("bit flipped in the length's checksum", flipped(good.clone(), 9), file, Some(0)),
        ("bit flipped in the data", flipped(good.clone(), 300), file, Some(12)),
        ("bit flipped in the data's checksum", flipped(good.clone(), good.len() - 1), file, Some(12)),
        ("declares 2^64 - 1 bytes", lying(u64::MAX, &[0; 20]), file, Some(0)),
        ("declares 1 GiB", lying(1 << 30, &[0; 20]), file, Some(0)),
        ("declares 100 MiB, has 20 bytes", lying(100 << 20, &[0; 20]), file, Some(12)),
        ("a JSON scene", include_bytes!("fixtures/junction.scene.json").to_vec(), file, Some(0)),
        ("zip archive's head", b"PK\x03\x04\x14\x00\x00\x00\x08\x00\x00\x00\x00\x00".to_vec(), file, Some(0)),
        ("zeros", vec![0; 4096], file, Some(0)),
        ("gzip of nothing", gzip(&[]), file, Some(0)),
        ("gzip's head only", cut(gzip(&good), 10), file, Some(0)),
        ("gzip cut off", cut(gzip(&good), 400), file, None),
        ("gzip with a wrong method", flipped(gzip(&good), 2), file, Some(0)),
        ("gzip of gzip", gzip(&gzip(&good)), file, Some(0)),
        (
            "gzip bomb of 100 MiB in one record",
            gzip(&lying(100 << 20, &vec![0; 100 << 20])),
            "expansion-too-high",
            None,
        ),
        (
            "record of a tf.Example",
            framed(b"\x0a\x09\x0a\x07\x0a\x01a\x12\x02\x12\x00"),
            "cannot-represent",
            None,
        ),
        ("record of an empty tf.Example", framed(&[0x0a, 0x00]), "cannot-represent", None),
        ("record of nothing", framed(&[]), "cannot-represent", None),
        ("record of text", framed(b"hello, this is text"), file, None),
        ("field longer than the record", appended(&[0x12, 0xff, 0x7f]), file, Some(end - 4 + 3)),
        ("field of 2^63 bytes", appended(b"\x12\xff\xff\xff\xff\xff\xff\xff\xff\x7f"), file, None),
        ("number without an end", appended(&[0x30, 0xff]), file, Some(end - 4 + 1)),
        ("number of eleven bytes", appended(b"\x30\xff\xff\xff\xff\xff\xff\xff\xff\xff\xff\x01"), file, None),
        ("field number zero", appended(&[0x00]), file, Some(end - 4)),
        ("wire type 7", appended(&[0x0f]), file, Some(end - 4)),
        ("group without an end", appended(&[0x63]), file, Some(end - 4)),
        ("track as a number", appended(&[0x10, 0x01]), file, Some(12)),
        ("scenario id that is not UTF-8", appended(&[0x2a, 0x02, 0xff, 0xfe]), file, Some(12)),
        ("3,000 empty tracks", appended(&[0x12, 0x00].repeat(3_000)), "too-many-agents", None),
        ("30,000 empty map features", appended(&[0x42, 0x00].repeat(30_000)), "map-too-large", None),
        ("601 empty signal steps", appended(&[0x3a, 0x00].repeat(601)), "out-of-range", None),
        ("5,000 empty predictions", appended(&[0x5a, 0x00].repeat(5_000)), "invalid-field", None),
        ("601 times", edited(|m| m.timestamps_seconds = vec![0.0; 601]), "out-of-range", None),
        (
            "a track of 601 states",
            edited(|m| {
                let state = m.tracks[0].states[0];
                m.tracks[0].states = vec![state; 601];
            }),
            "out-of-range",
            None,
        ),
        ("position NaN", edited(|m| m.tracks[1].states[0].center_x = Some(f64::NAN)), "out-of-range", None),
        (
            "ego's position infinite",
            edited(|m| m.tracks[0].states[2].center_y = Some(f64::INFINITY)),
            "out-of-range",
            None,
        ),
        ("position 1e300", edited(|m| m.tracks[1].states[0].center_y = Some(1e300)), "out-of-range", None),
        ("heading NaN", edited(|m| m.tracks[1].states[0].heading = Some(f32::NAN)), "out-of-range", None),
        ("speed 1e30", edited(|m| m.tracks[1].states[0].velocity_x = Some(1e30)), "out-of-range", None),
        (
            "length NaN",
            edited(|m| m.tracks[1].states.iter_mut().for_each(|s| s.length = Some(f32::INFINITY))),
            "out-of-range",
            None,
        ),
        (
            "speed limit NaN",
            edited(|m| {
                if let Some(FeatureData::Lane(lane)) = &mut m.map_features[0].feature_data {
                    lane.speed_limit_mph = Some(f64::NAN);
                }
            }),
            "out-of-range",
            None,
        ),
        (
            "map point NaN",
            edited(|m| {
                let mut polygon = points(3);
                polygon[1].y = Some(f64::NAN);
                m.map_features.push(feature(FeatureData::Crosswalk(Polygon { polygon })));
            }),
            "out-of-range",
            None,
        ),
        (
            "410,000 map points",
            edited(|m| {
                for _ in 0..103 {
                    m.map_features.push(feature(FeatureData::Crosswalk(Polygon { polygon: points(4_000) })));
                }
            }),
            "map-too-large",
            None,
        ),
        (
            "600 signals",
            edited(|m| {
                let one = m.dynamic_map_states[0].lane_states[0];
                m.dynamic_map_states[0].lane_states = vec![one; 600];
            }),
            "map-too-large",
            None,
        ),
        (
            "no map and no tracks",
            edited(|m| {
                m.tracks.clear();
                m.map_features.clear();
            }),
            "cannot-represent",
            None,
        ),
    ];
    let mut trailing = good.clone();
    trailing.extend(b"trailing text, longer than a frame");
    list.push(("text after a good record", trailing, file, Some(end)));
    list
}

#[test]
fn hostile_files_are_refused_precisely() {
    let mut wrong = Vec::new();
    let cases = cases();
    let count = cases.len();
    for (name, bytes, code, offset) in cases {
        let start = Instant::now();
        let results = womd::read_all(&bytes, &Options::default());
        let took = start.elapsed();
        let errors: Vec<&ReadError> = results.iter().filter_map(|r| r.as_ref().err()).collect();
        let Some(error) = errors.first() else {
            wrong.push(format!("{name}: read without a fault"));
            continue;
        };
        println!("{name:38} {error}");
        let at = match error.kind {
            RefusalKind::MalformedFile { offset } => Some(offset),
            _ => None,
        };
        if error.code() != code || (offset.is_some() && at != offset) {
            wrong.push(format!("{name}: expected {code} at {offset:?}, got {error:?}"));
        }
        assert!(took < PATIENCE, "{name} took {took:?}");
    }
    println!("{count} files");
    assert!(wrong.is_empty(), "{} of {count}:\n{}", wrong.len(), wrong.join("\n"));
    if let Some(peak_mb) = peak_memory_mb() {
        // This test builds the bomb from 100 MiB of zeros, which count too.
        println!("peak memory {peak_mb} MB");
        assert!(peak_mb < 500, "{peak_mb} MB");
    }
}

/// Peak resident memory of this process, where the system reports it.
fn peak_memory_mb() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    Some(line.trim().strip_suffix(" kB")?.parse::<u64>().ok()? / 1024)
}

#[test]
fn a_broken_record_does_not_stop_the_next() {
    let good = framed(&message().encode_to_vec());
    let mut file = flipped(good.clone(), 300);
    file.extend(&good);
    file.extend(edited(|m| m.tracks[1].states[0].heading = Some(f32::NAN)));
    file.extend(&good);
    for bytes in [file.clone(), gzip(&file)] {
        let results = womd::read_all(&bytes, &Options::default());
        assert_eq!(results.iter().map(Result::is_ok).collect::<Vec<_>>(), [false, true, false, true]);
        let options = Options { skip: 1, max_scenes: 1, ..Options::default() };
        assert!(matches!(&womd::read_all(&bytes, &options)[..], [Ok(_)]));
    }
}

#[test]
fn every_truncation_is_an_error() {
    let good = framed(&message().encode_to_vec());
    for bytes in [good.clone(), gzip(&good)] {
        for end in 0..bytes.len() {
            let results = womd::read_all(&bytes[..end], &Options::default());
            assert!(results.iter().any(Result::is_err), "cut at {end} of {}", bytes.len());
        }
    }
}

#[test]
fn bounds_can_be_lowered() {
    let good = framed(&message().encode_to_vec());
    let options = Options { max_decoded_bytes: 1_000, ..Options::default() };
    for bytes in [good.clone(), gzip(&good)] {
        let error = womd::read_all(&bytes, &options).remove(0).unwrap_err();
        assert_eq!((error.code(), error.kind), ("decoded-too-large", RefusalKind::TooLarge { limit: 1_000 }));
    }
}

#[test]
fn repeated_ids_get_suffixes() {
    let bytes = edited(|m| {
        let twin = m.tracks[1].clone();
        m.tracks.extend([twin.clone(), twin]);
        let twin = m.map_features[0].clone();
        m.map_features.push(twin);
    });
    let (scene, warnings) = womd::read_all(&bytes, &Options::default()).remove(0).unwrap();
    let ids: Vec<&str> = scene.agents.iter().map(|a| a.id.as_str()).collect();
    assert_eq!(ids, ["1", "2", "3", "4", "2.2", "2.3"]);
    assert_eq!(scene.map.lanes.last().unwrap().id, "101.2");
    assert_eq!(warnings.iter().filter(|w| w.code == "duplicate-ids").count(), 2);
}

#[test]
fn more_than_256_tracks_keep_the_nearest() {
    let bytes = edited(|m| {
        let far = m.tracks[1].clone();
        for i in 0..300 {
            let mut track = far.clone();
            track.id = Some(100 + i);
            track.states.iter_mut().for_each(|s| s.center_x = s.center_x.map(|x| x + f64::from(300 - i)));
            m.tracks.insert(0, track);
        }
        m.sdc_track_index = m.sdc_track_index.map(|i| i + 300);
    });
    let (scene, warnings) = womd::read_all(&bytes, &Options::default()).remove(0).unwrap();
    assert_eq!(scene.agents.len(), 256);
    assert!(warnings.iter().any(|w| w.code == "agents-dropped"));
    assert!(scene.agents.iter().any(|a| a.role.as_deref() == Some("ego")));
    // Of 300 copies of one car, those moved farthest are left out; so is the cyclist without states.
    assert!(scene.agent("100").is_none() && scene.agent("399").is_some() && scene.agent("3").is_some());
    assert!(scene.agent("4").is_none());
}
