//! The fuzz corpus and every fixture through the checks that fuzzing runs.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    clippy::print_stdout,
    reason = "a test stops at the first surprise"
)]

use formats::womd;
use formats::{ExportOptions, ExportedMotion, checks, registry};
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

/// With `UPDATE_CORPUS` set, writes seeds from the fixture scene.
fn update_seeds() {
    let folder = root().join("fuzz/corpus/womd");
    let scene = formats::native::read(include_bytes!("fixtures/junction.scene.json")).unwrap();
    let mut small = scene.clone();
    small.map = Default::default();
    small.agents.truncate(1);
    for format in ["nocturne", "sumo"] {
        let folder = root().join("fuzz/corpus").join(format);
        std::fs::create_dir_all(&folder).unwrap();
        let format = registry::by_id(format).unwrap();
        for (name, scene) in [("junction", &scene), ("one", &small)] {
            let file = format.export(&[scene], &ExportOptions::default()).unwrap();
            std::fs::write(folder.join(format!("{name}.{}", format.info().extensions[0])), file.bytes)
                .unwrap();
        }
    }
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
        update_seeds();
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

#[test]
fn every_reader_is_fuzzed() {
    for info in registry::FORMATS.iter().map(|format| format.info()).filter(|info| info.import) {
        // The product's own format has other names for its files.
        let name = if info.id == registry::FORMATS[0].info().id { "native" } else { info.id };
        let (_, check) = checks::TARGETS.iter().find(|(target, _)| *target == name).unwrap_or_else(|| {
            panic!("{name} has no target in checks::TARGETS");
        });
        let seeds = files(root().join("fuzz/corpus").join(name));
        let reads = |path: &PathBuf| check(&std::fs::read(path).unwrap());
        assert!(seeds.iter().any(reads), "nothing of fuzz/corpus/{name} is read");
        let target = format!("{}.rs", name.replace('-', "_"));
        assert!(
            root().join("fuzz/fuzz_targets").join(&target).is_file(),
            "fuzz/fuzz_targets/{target} is missing"
        );
    }
}
