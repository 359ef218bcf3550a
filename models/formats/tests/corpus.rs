//! The fuzz corpus and every fixture through the checks that fuzzing runs.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    clippy::print_stdout,
    reason = "a test stops at the first surprise"
)]

use formats::ExportedMotion;
use formats::checks;
use formats::womd;
use std::path::{Path, PathBuf};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn files(folder: PathBuf) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(&folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    let mut list: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).filter(|p| p.is_file()).collect();
    list.sort();
    list
}

/// With `UPDATE_CORPUS` set, writes the record seeds from the fixture scene.
fn update_womd_seeds() {
    let folder = root().join("fuzz/corpus/womd");
    let scene = formats::native::read(include_bytes!("fixtures/junction.scene.json")).unwrap();
    let mut small = scene.clone();
    small.map = Default::default();
    small.agents.truncate(1);
    for (name, scene, gzip) in [
        ("junction.tfrecord", &scene, false),
        ("junction.tfrecord.gz", &scene, true),
        ("one.tfrecord", &small, false),
    ] {
        let file = std::fs::File::create(folder.join(name)).unwrap();
        womd::write(&[scene], file, gzip, ExportedMotion::Chosen).unwrap();
    }
}

#[test]
fn corpus_and_fixtures_keep_the_promises() {
    if std::env::var_os("UPDATE_CORPUS").is_some() {
        update_womd_seeds();
    }
    let fixtures = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fixtures");
    let all = checks::TARGETS.iter().map(|(target, _)| files(root().join("fuzz/corpus").join(target)));
    let all = all.flatten().chain(files(fixtures.clone())).chain(files(fixtures.join("bad")));
    let mut count = 0;
    for path in all {
        let bytes = std::fs::read(&path).unwrap();
        for (_, check) in checks::TARGETS {
            check(&bytes);
        }
        count += 1;
    }
    println!("{count} inputs");
    assert!(count > 100);
}
