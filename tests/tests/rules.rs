//! The arrows between crates, as the architecture draws them: a new one fails here first.

#![allow(clippy::unwrap_used, clippy::panic, clippy::print_stdout, reason = "a failed test panics")]

use dragtraffic_tests::program::root;
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use std::process::Command;

/// Crate and the crates of this workspace that it may import.
const ARROWS: &[(&str, &[&str])] = &[
    ("scene", &[]),
    ("formats", &["scene"]),
    ("experts", &["scene"]),
    ("lab", &["scene", "formats", "experts"]),
    ("dragtraffic", &["scene", "formats", "experts", "lab"]),
    ("dragtraffic-tests", &[]),
    ("xtask", &[]),
];
/// Libraries with one home: name, and the crates that may import it.
const HOMES: &[(&str, &[&str])] = &[
    ("candle-core", &["experts", "lab"]),
    ("candle-nn", &["experts", "lab"]),
    ("axum", &["dragtraffic"]),
    ("rusqlite", &["dragtraffic"]),
    ("hyper", &["dragtraffic"]),
    ("prost", &["formats"]),
    // XML is read by the scanner of `formats::sumo`, which says why.
    ("roxmltree", &[]),
    ("quick-xml", &[]),
    ("parquet", &["formats"]),
];

fn imports() -> BTreeMap<String, BTreeSet<String>> {
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let output = Command::new(cargo)
        .args(["metadata", "--format-version", "1", "--no-deps", "--offline"])
        .current_dir(root())
        .output()
        .unwrap();
    let metadata: Value = serde_json::from_slice(&output.stdout).unwrap();
    let mut imports = BTreeMap::new();
    for package in metadata["packages"].as_array().unwrap() {
        let normal = package["dependencies"].as_array().unwrap().iter().filter(|d| d["kind"] != "dev");
        let names = normal.map(|d| d["name"].as_str().unwrap().to_owned()).collect();
        imports.insert(package["name"].as_str().unwrap().to_owned(), names);
    }
    imports
}

#[test]
fn crates_import_what_the_architecture_allows() {
    let imports = imports();
    let ours: BTreeSet<&str> = ARROWS.iter().map(|(name, _)| *name).collect();
    for (name, used) in &imports {
        let Some((_, allowed)) = ARROWS.iter().find(|(known, _)| known == name) else {
            panic!("the crate {name} has no place in the architecture");
        };
        for other in used.iter().filter(|other| ours.contains(other.as_str())) {
            assert!(allowed.contains(&other.as_str()), "{name} must not import {other}");
        }
        for (library, homes) in HOMES {
            assert!(
                !used.contains(*library) || homes.contains(&name.as_str()),
                "{name} must not import {library}"
            );
        }
    }
}

#[test]
fn only_one_file_of_the_server_knows_the_lab() {
    let mut folders = vec![root().join("server/src")];
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).unwrap().flatten() {
            let path = entry.path();
            if path.is_dir() {
                folders.push(path);
                continue;
            }
            let text = std::fs::read_to_string(&path).unwrap_or_default();
            // Elsewhere `lab::` is the module of that file.
            assert!(
                !text.contains("use lab::") || path.ends_with("cli/lab.rs"),
                "{} imports lab",
                path.display()
            );
        }
    }
}
