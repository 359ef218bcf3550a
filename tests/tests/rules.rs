//! The arrows between crates, and between the rooms inside them, as the architecture draws them: a new one
//! fails here first.

#![allow(clippy::unwrap_used, clippy::panic, clippy::print_stdout, reason = "a failed test panics")]

use dragtraffic_tests::program::root;
use dragtraffic_tests::rooms::{House, files};
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use std::process::Command;

/// Crate, by its name without the product's before it, and the crates of this workspace that it may import.
const ARROWS: &[(&str, &[&str])] = &[
    ("scene", &[]),
    ("formats", &["scene"]),
    ("layouts", &["scene"]),
    ("experts", &["scene"]),
    ("api", &["scene", "formats", "layouts", "experts"]),
    ("lab-synthesize", &["scene", "formats"]),
    ("lab-train", &["scene", "formats", "experts"]),
    ("lab-eval", &["scene", "formats", "experts", "lab-train"]),
    ("lab-reproduce", &["scene", "formats", "experts", "lab-train", "lab-eval"]),
    (
        "dragtraffic",
        &[
            "scene",
            "formats",
            "layouts",
            "experts",
            "api",
            "lab-synthesize",
            "lab-train",
            "lab-eval",
            "lab-reproduce",
        ],
    ),
    ("samples", &[]),
    ("tests", &["formats"]),
    ("xtask", &[]),
];
/// Libraries with one home: name, and the crates that may import it.
const HOMES: &[(&str, &[&str])] = &[
    ("candle-core", &["experts", "lab-train"]),
    ("candle-nn", &["experts"]),
    ("rand", &["scene"]),
    ("rand_chacha", &["scene"]),
    ("rand_distr", &["scene"]),
    ("blake3", &["scene", "lab-train"]),
    ("axum", &["dragtraffic"]),
    ("tokio", &["dragtraffic"]),
    // Tests look into the store with the library itself.
    ("rusqlite", &["dragtraffic", "tests"]),
    ("shuttle", &["dragtraffic"]),
    ("hyper", &["dragtraffic"]),
    ("prost", &["formats"]),
    ("xodr", &["formats"]),
    ("i_overlay", &["formats"]),
    ("parquet", &["formats"]),
    // XML is read by the scanner of `formats::xml`, which says why.
    ("roxmltree", &[]),
    ("quick-xml", &[]),
];
/// Crates whose modules stand on floors, the lowest first: a module knows those below it alone. A crate gets a
/// line here when its rooms are free of rings.
const HOUSES: &[House] = &[
    House {
        name: "formats",
        sources: "models/formats/src",
        floors: &[
            &[
                "limits",
                "loss",
                "files",
                "source",
                "polyline",
                "bounds",
                "lists",
                "numbers",
                "units",
                "projection",
                "netconvert",
                "frame",
                "joints",
                "pack",
            ],
            &["problem", "surface"],
            &["unpack", "describe", "lights", "sides", "markup"],
            &["xml", "format", "identities", "columnar"],
            &["osm_items", "recording", "map_file", "tree", "unwritten", "settle", "kinds"],
            &[
                "native",
                "womd",
                "sumo",
                "opendrive",
                "lanelet2",
                "commonroad",
                "scenarionet",
                "gpudrive",
                "table",
                "av2",
                "geojson",
                "html",
                "foxglove",
            ],
            &["openscenario", "osm"],
            &["registry"],
            &["checks"],
        ],
    },
    House {
        name: "experts",
        sources: "models/experts/src",
        floors: &[
            &["clock", "tuning"],
            &["planning"],
            &["features"],
            &["net"],
            &["request", "weights", "maps"],
            &["placement", "generator"],
            &["engine"],
        ],
    },
    House {
        name: "api",
        sources: "server/api/src",
        floors: &[
            &["code", "english", "limits", "opened", "domain", "compact", "feedback"],
            &["problem", "events"],
            &["home", "import", "map"],
            &["export", "info", "score", "place"],
            &["generate"],
            &["operations"],
        ],
    },
    House {
        name: "dragtraffic",
        sources: "server/src",
        floors: &[
            &["base"],
            &["work"],
            &["http"],
            &["scenes"],
            &["generation"],
            &["app"],
            &["routes"],
            &["cli"],
        ],
    },
];

fn short_name(package: &Value) -> String {
    let name = package.as_str().unwrap();
    name.strip_prefix("dragtraffic-").unwrap_or(name).to_owned()
}

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
        let names = normal.map(|dependency| short_name(&dependency["name"])).collect();
        imports.insert(short_name(&package["name"]), names);
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
fn rooms_import_those_below_them_alone() {
    for house in HOUSES {
        let faults = house.faults(root()).unwrap();
        assert!(faults.is_empty(), "{}", faults.join("\n"));
    }
}

#[test]
fn only_the_labs_commands_of_the_server_know_the_lab() {
    let source = root().join("server/src");
    let commands = [source.join("cli/lab")];
    let mut folders = vec![source];
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).unwrap().flatten() {
            let path = entry.path();
            if commands.contains(&path) {
                continue;
            }
            if path.is_dir() {
                folders.push(path);
                continue;
            }
            let text = std::fs::read_to_string(&path).unwrap_or_default();
            for lab in ["lab_synthesize", "lab_train", "lab_eval", "lab_reproduce"] {
                assert!(!text.contains(&format!("{lab}::")), "{} imports {lab}", path.display());
            }
        }
    }
}

/// What only a carrier of the operations may use.
const OF_CARRIERS: &[&str] = &[
    "std::fs",
    "std::thread",
    "std::net",
    "std::env::",
    "std::process",
    "std::io",
    "Instant",
    "SystemTime",
    "axum",
    "tokio",
    "rusqlite",
    "tracing",
    "StatusCode",
];

#[test]
fn the_operations_use_no_file_thread_clock_or_socket() {
    let sources = root().join("server/api/src");
    let files = files(&sources).unwrap();
    assert!(files.len() > 20, "{files:?}");
    for path in files {
        let text = std::fs::read_to_string(&path).unwrap();
        for word in OF_CARRIERS {
            assert!(!text.contains(word), "{} uses {word}", path.display());
        }
    }
}

#[test]
fn a_handler_has_a_file_that_is_read_at_a_glance() {
    for path in files(&root().join("server/src/routes")).unwrap() {
        let lines = std::fs::read_to_string(&path).unwrap().lines().count();
        assert!(lines <= 250, "{} has {lines} lines", path.display());
    }
}

#[test]
fn the_formats_of_the_readme_are_those_of_the_registry() {
    let readme = std::fs::read_to_string(root().join("README.md")).unwrap();
    let (_, rest) = readme.split_once("<!-- formats:").unwrap();
    let (_, rest) = rest.split_once("-->\n").unwrap();
    let (table, _) = rest.split_once("<!-- end of formats -->").unwrap();
    assert!(
        table == formats::registry::markdown(),
        "README.md: put between the marks what `dragtraffic info formats --markdown` prints"
    );
}
