//! Real files beside the checkout, when they are there: all are read, and what is written reads back
//! equal. Nothing of them is in the repository.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    clippy::print_stdout,
    reason = "a test stops at the first surprise"
)]

use formats::ExportedMotion;
use formats::womd::proto::{ObjectState, Scenario, Track};
use formats::womd::{self, Options};
use prost::Message;
use std::collections::BTreeMap;
use std::path::PathBuf;
use std::time::Instant;

/// Records of a folder of samples.
fn files(folder: &str) -> Option<Vec<PathBuf>> {
    samples::files(folder, ".tfrecord")
}

#[test]
fn every_real_file_is_read_and_comes_back_equal() {
    let mut count = 0;
    let mut warned: BTreeMap<&str, usize> = BTreeMap::new();
    let mut slowest = (0.0f64, PathBuf::new());
    for path in ["womd/train", "womd/val", "formats/waymo"].into_iter().filter_map(files).flatten() {
        let bytes = std::fs::read(&path).unwrap();
        assert!(womd::looks_like(&bytes), "{}", path.display());
        let start = Instant::now();
        let scenes = womd::read_all(&bytes, &Options::default());
        let took = start.elapsed().as_secs_f64();
        if took > slowest.0 {
            slowest = (took, path.clone());
        }
        for scene in scenes {
            let (scene, warnings) = scene.unwrap_or_else(|error| panic!("{}: {error}", path.display()));
            warnings.iter().for_each(|w| *warned.entry(w.code).or_default() += 1);
            assert_eq!(scene.meta.licence.as_deref(), Some("waymo-nc"));
            assert!(!scene.agents.is_empty() && !scene.map.lanes.is_empty());
            if let Some(ego) = scene.agents.iter().find(|a| a.role.as_deref() == Some("ego")) {
                let at = ego.track.at(scene.time.now_step).unwrap();
                assert_eq!((at.x_m, at.y_m), (0.0, 0.0));
            }
            let mut written = Vec::new();
            let losses = womd::write(&[&scene], &mut written, count % 2 == 0, ExportedMotion::Log).unwrap();
            assert_eq!(losses.iter().map(|l| l.code).collect::<Vec<_>>(), ["no-licence"]);
            let (again, _) = womd::read_all(&written, &Options::default()).remove(0).unwrap();
            assert!(scene == again, "{}: another scene after a round trip", path.display());
            let json = formats::native::write(&scene);
            assert!(formats::native::read(&json).unwrap() == scene, "{}: native", path.display());
            count += 1;
        }
    }
    println!(
        "{count} scenes, warnings {warned:?}, slowest {:.1} ms {}",
        slowest.0 * 1e3,
        slowest.1.display()
    );
}

/// Fields of two messages that may differ by the move to the ego and back: 1e-9 m.
fn same_states(a: &Track, b: &Track, sizes_vary: bool) -> bool {
    let close = |a: Option<f64>, b: Option<f64>| (a.unwrap_or(0.0) - b.unwrap_or(0.0)).abs() < 1e-9;
    let pairs = || a.states.iter().zip(&b.states).filter(|(a, _)| a.valid == Some(true));
    let sizes =
        sizes_vary || pairs().all(|(a, b)| (a.length, a.width, a.height) == (b.length, b.width, b.height));
    let valid = |s: &ObjectState| s.valid.unwrap_or(false);
    (a.id, a.object_type, a.states.len()) == (b.id, b.object_type, b.states.len())
        && a.states.iter().map(valid).eq(b.states.iter().map(valid))
        && sizes
        && pairs().all(|(a, b)| {
            (a.heading, a.velocity_x, a.velocity_y) == (b.heading, b.velocity_x, b.velocity_y)
                && a.center_z == b.center_z
                && close(a.center_x, b.center_x)
                && close(a.center_y, b.center_y)
        })
}

#[test]
fn written_messages_are_those_of_the_real_files() {
    let mut count = 0;
    for path in ["womd/val", "formats/waymo"].into_iter().filter_map(files).flatten() {
        let bytes = std::fs::read(&path).unwrap();
        for record in womd::RecordReader::new(&bytes[..], &Options::default()).unwrap() {
            let record = record.unwrap();
            let real = Scenario::decode(&record.data[..]).unwrap();
            let (scene, warnings) = womd::read_record(&record, &Options::default()).unwrap();
            let (ours, _) = womd::scenario(&scene, ExportedMotion::Log);
            let warned = |code| warnings.iter().any(|w| w.code == code);
            if warned("agents-dropped") {
                continue;
            }
            let at = path.display();
            assert_eq!(real.scenario_id, ours.scenario_id);
            assert_eq!(real.timestamps_seconds, ours.timestamps_seconds, "{at}");
            assert_eq!(real.current_time_index, ours.current_time_index);
            assert_eq!(real.sdc_track_index, ours.sdc_track_index, "{at}");
            assert_eq!(real.objects_of_interest, ours.objects_of_interest, "{at}");
            assert_eq!(real.tracks_to_predict, ours.tracks_to_predict, "{at}");
            let varies = warned("sizes-vary");
            assert!(real.tracks.iter().zip(&ours.tracks).all(|(a, b)| same_states(a, b, varies)), "{at}");
            let known = |m: &Scenario| {
                let mut ids: Vec<_> = m.map_features.iter().map(|f| f.id).collect();
                ids.sort();
                ids
            };
            if !warned("features-dropped") {
                assert_eq!(known(&real), known(&ours), "{at}");
            }
            count += 1;
        }
    }
    println!("{count} messages compared");
}

#[test]
fn truncated_and_flipped_real_files_never_panic() {
    let Some(path) = files("womd/val").and_then(|files| files.into_iter().next()) else { return };
    let bytes = std::fs::read(&path).unwrap();
    let (scene, _) = womd::read_all(&bytes, &Options::default()).remove(0).unwrap();
    let mut plain = Vec::new();
    womd::write(&[&scene], &mut plain, false, ExportedMotion::Log).unwrap();
    let options = Options { verify_crc: false, ..Options::default() };
    let mut read = 0;
    for i in 0..300 {
        let at = 12 + (i * 7_919) % (plain.len() - 16);
        let mut flipped = plain.clone();
        flipped[at] ^= 1 << (i % 8);
        let error = womd::read_all(&flipped, &Options::default()).remove(0).unwrap_err();
        assert_eq!(error.code(), "malformed-file");
        read += usize::from(womd::read_all(&flipped, &options).remove(0).is_ok());
    }
    println!("{read} of 300 records with one flipped bit are read without their checksum");
    for i in 0..100 {
        let end = (i * 104_729) % bytes.len();
        assert!(womd::read_all(&bytes[..end], &Options::default()).iter().any(Result::is_err));
    }
}
