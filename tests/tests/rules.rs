//! The dependencies between crates, and between the rooms inside them, as the architecture shows them: a new
//! one fails here first.

#![allow(clippy::unwrap_used, clippy::panic, clippy::print_stdout, reason = "a failed test panics")]

use dragtraffic_tests::program::root;
use dragtraffic_tests::rooms::{House, files, rings};
use dragtraffic_tests::untuned::{CONSTANTS, LITERALS, OF_FOLDERS, float_constants, float_literals};
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use std::process::Command;

/// A crate, by its name without the product's prefix, and the crates of this workspace that it may import.
const ARROWS: &[(&str, &[&str])] = &[
    ("scene", &[]),
    ("formats", &["scene"]),
    ("layouts", &["scene"]),
    ("experts", &["scene"]),
    ("api", &["scene", "formats", "layouts", "experts"]),
    ("base", &["scene", "formats", "api"]),
    ("work", &["experts", "api", "base"]),
    ("batch", &["scene", "formats", "experts", "api"]),
    ("lab-synthesize", &["scene", "formats"]),
    ("lab-train", &["scene", "formats", "experts"]),
    ("lab-eval", &["scene", "formats", "layouts", "experts", "lab-train"]),
    ("lab-reproduce", &["scene", "formats", "experts", "lab-train", "lab-eval"]),
    (
        "dragtraffic",
        &[
            "scene",
            "formats",
            "layouts",
            "experts",
            "api",
            "base",
            "work",
            "batch",
            "lab-synthesize",
            "lab-train",
            "lab-eval",
            "lab-reproduce",
        ],
    ),
    ("python", &["scene", "formats", "experts", "api", "batch", "dragtraffic"]),
    ("samples", &[]),
    ("tests", &["formats"]),
    ("xtask", &[]),
];
/// Libraries that only some crates may import: name, and these crates.
const HOMES: &[(&str, &[&str])] = &[
    ("candle-core", &["experts", "lab-train"]),
    ("candle-nn", &["experts"]),
    ("rand", &["scene"]),
    ("rand_chacha", &["scene"]),
    ("rand_distr", &["scene"]),
    ("blake3", &["scene", "lab-train"]),
    ("axum", &["base", "dragtraffic"]),
    ("tokio", &["work", "dragtraffic"]),
    // Tests read the store with the library itself; nuPlan logs are read with it.
    ("rusqlite", &["dragtraffic", "formats", "tests"]),
    // Only tests of `work` use it.
    ("shuttle", &[]),
    ("hyper", &["dragtraffic"]),
    ("rmcp", &["dragtraffic"]),
    ("tonic", &["dragtraffic"]),
    ("tiny-skia", &["dragtraffic"]),
    ("pyo3", &["python"]),
    ("numpy", &["python"]),
    ("prost", &["formats", "dragtraffic"]),
    ("xodr", &["formats"]),
    ("i_overlay", &["formats"]),
    ("parquet", &["formats"]),
    // The scanner of `formats::xml` reads XML, and explains why.
    ("roxmltree", &[]),
    ("quick-xml", &[]),
];
/// Crates with modules on floors, the lowest first: a module may import only modules on lower floors. A crate
/// gets a line here once its rooms are free of import cycles.
const HOUSES: &[House] = &[
    House {
        name: "formats",
        sources: "models/formats/src",
        module: &[],
        floors: &[
            &["refusals"],
            &[
                "limits",
                "loss",
                "files",
                "folder",
                "source",
                "polyline",
                "bounds",
                "lists",
                "numbers",
                "units",
                "projection",
                "netconvert",
                "sentences",
                "frame",
                "written",
                "driving_side",
                "encoding",
                "around",
            ],
            &["problem", "surface", "joints", "pack"],
            &["unpack", "describe", "lights", "sides", "markup", "headings", "cut"],
            &["xml", "format", "identities", "columnar", "repairs"],
            &["osm_items", "recording", "map_file", "tree", "unwritten", "settle", "kinds"],
            &["underlay"],
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
                "nuplan",
                "nuscenes",
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
        module: &[],
        floors: &[
            &["clock", "sentences", "tuning"],
            &["planning"],
            &["features"],
            &["net"],
            &["request", "weights", "maps"],
            &["placement", "generator"],
            &["run"],
            &["engine"],
        ],
    },
    House {
        name: "experts::planning",
        sources: "models/experts/src",
        module: &["planning"],
        floors: &[
            &["coordinates", "profile", "smooth", "stop_line"],
            &["world", "pullback"],
            &["legal", "lights", "way"],
            &["crossing"],
            &["around"],
            &["to_goal"],
            &["through"],
            &["anchors"],
            &["tests", "road_tests", "crossing_tests"],
        ],
    },
    House {
        name: "experts::generator",
        sources: "models/experts/src",
        module: &["generator"],
        floors: &[
            &[
                "motion",
                "slot",
                "noise",
                "workers",
                "calibration",
                "cast",
                "extrapolation",
                "kerb",
                "rounds",
                "stepping_out",
            ],
            &["subgoal", "resources", "samples"],
            &["actor", "choice", "via_steering"],
            &["trajectory", "drafts", "window_setting"],
            &[
                "others",
                "repulsion",
                "replan",
                "moving_off",
                "verdict",
                "candidates",
                "road_rules",
                "draft_traces",
                "duplicate_modes",
                "report",
            ],
            &["joint_drafts", "costs", "decisions", "guidance", "overlaps", "variations"],
            &["decide", "diversity", "draft_relations"],
            &["sampling"],
            &["drafting"],
            &["generation"],
        ],
    },
    House {
        name: "api",
        sources: "server/api/src",
        module: &[],
        floors: &[
            &["english"],
            &["code", "limits", "opened", "domain", "compact", "feedback"],
            &["problem", "events", "messages"],
            &["home", "import", "map"],
            &["export", "info", "score", "place", "runs"],
            &["generate"],
            &["operations"],
        ],
    },
    House {
        name: "dragtraffic",
        sources: "server/src",
        module: &[],
        floors: &[
            &["picture"],
            &["http"],
            &["scenes"],
            &["generation", "runs"],
            &["app"],
            &["routes", "grpc"],
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

/// Type names below a folder, each with the files that declare it, without tests and benches.
fn type_homes(sources: &str) -> BTreeMap<String, BTreeSet<String>> {
    let mut homes: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    for file in files(&root().join(sources)).unwrap() {
        let path = file.strip_prefix(root()).unwrap().to_str().unwrap().to_owned();
        if path.ends_with("tests.rs")
            || ["/tests/", "/benches/", "/target/"].iter().any(|part| path.contains(part))
        {
            continue;
        }
        for line in std::fs::read_to_string(&file).unwrap().lines() {
            let mut words =
                line.split_whitespace().skip_while(|word| word.starts_with("pub") || word.ends_with(')'));
            if matches!(words.next(), Some("struct" | "enum" | "trait")) {
                let word = words.next().unwrap_or_default();
                // A macro's fragment names begin with `$`.
                let name: String = word.chars().take_while(|c| c.is_alphanumeric()).collect();
                if !name.is_empty() {
                    homes.entry(name).or_default().insert(path.clone());
                }
            }
        }
    }
    homes
}

#[test]
fn type_names_of_the_engine_are_unique() {
    let homes = type_homes("models/experts/src");
    assert!(homes.len() > 200, "{} types", homes.len());
    let shared: Vec<_> = homes.iter().filter(|(_, files)| files.len() > 1).collect();
    assert!(shared.is_empty(), "{shared:?}");
}

/// Number of type names that several files of the program declare. It may only fall.
const SHARED_TYPE_NAMES: usize = 32;

#[test]
fn fewer_type_names_stand_in_several_files() {
    let mut homes = type_homes("models");
    for (name, files) in type_homes("server") {
        homes.entry(name).or_default().extend(files);
    }
    let shared: Vec<&String> =
        homes.iter().filter(|(_, files)| files.len() > 1).map(|(name, _)| name).collect();
    assert_eq!(
        shared.len(),
        SHARED_TYPE_NAMES,
        "set the number to {}, if that is lower: {shared:?}",
        shared.len()
    );
}

#[test]
fn tuned_numbers_stand_in_the_tables_alone() {
    let sources = root().join("models/experts/src");
    let (mut names, mut literals) = (BTreeSet::new(), BTreeSet::new());
    for file in files(&sources).unwrap() {
        let path = file.strip_prefix(&sources).unwrap().to_str().unwrap().replace('\\', "/");
        if path.starts_with("tuning/") || path.ends_with("tests.rs") || path.ends_with("samples.rs") {
            continue;
        }
        let text = std::fs::read_to_string(&file).unwrap();
        names.extend(float_constants(&text).into_iter().map(|name| format!("{path} {name}")));
        if !OF_FOLDERS.iter().any(|(folder, _)| path.starts_with(folder)) {
            literals.extend(float_literals(&text).into_iter().map(|literal| format!("{path} {literal}")));
        }
    }
    let listed = |rows: &[(&str, &str, &str)]| -> BTreeSet<String> {
        rows.iter().map(|(path, number, _)| format!("{path} {number}")).collect()
    };
    for (found, listed) in [(names, listed(CONSTANTS)), (literals, listed(LITERALS))] {
        let unlisted: Vec<_> = found.difference(&listed).collect();
        assert!(unlisted.is_empty(), "a weight or threshold belongs into experts::tuning: {unlisted:?}");
        let gone: Vec<_> = listed.difference(&found).collect();
        assert!(gone.is_empty(), "listed, but not there: {gone:?}");
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
fn the_engines_files_form_no_ring_of_imports() {
    let rings = rings(&root().join("models/experts/src"), &[]).unwrap();
    assert!(rings.is_empty(), "{rings:?}");
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

/// Paths that only a transport of the operations may use.
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
