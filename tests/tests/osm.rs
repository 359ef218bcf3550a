//! An extract of OpenStreetMap through the real netconvert, which `cargo xtask test maps` installs and names in the
//! environment.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a failed test panics")]

use dragtraffic_tests::program::{program, root};
use serde_json::Value;
use std::path::Path;
use std::process::{Command, Output};

/// Names the program; if it is set, the program must exist.
const VARIABLE: &str = "DRAGTRAFFIC_NETCONVERT";

fn extract() -> String {
    std::fs::read_to_string(root().join("models/formats/tests/fixtures/crossing.osm")).unwrap()
}

/// `dragtraffic convert` with this text, and `set` for its environment.
fn convert(folder: &Path, text: &str, set: &dyn Fn(&mut Command)) -> Output {
    std::fs::write(folder.join("town.osm"), text).unwrap();
    let mut command = Command::new(program());
    command.args(["convert", "town.osm", "-o", "town.json", "--force"]).current_dir(folder);
    set(&mut command);
    command.output().unwrap()
}

fn said(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

#[test]
fn without_netconvert_it_is_said_how_to_get_it() {
    let folder = tempfile::tempdir().unwrap();
    let output = convert(folder.path(), &extract(), &|command| {
        command.env_remove(VARIABLE).env_remove("SUMO_HOME").env("PATH", "");
    });
    assert_eq!(output.status.code(), Some(3));
    assert!(said(&output).contains("pip install eclipse-sumo"), "{}", said(&output));
}

#[test]
fn a_program_that_fails_is_told() {
    let folder = tempfile::tempdir().unwrap();
    let output = convert(folder.path(), &extract(), &|command| {
        // Any program that knows none of the flags.
        command.env(VARIABLE, std::env::current_exe().unwrap());
    });
    assert_eq!(output.status.code(), Some(3));
    assert!(said(&output).contains("netconvert could not make a network from the file"), "{}", said(&output));
}

#[test]
#[ignore = "needs netconvert: cargo xtask test maps installs it and runs this test"]
fn roads_become_a_crossing_with_lanes_crossings_and_signals() {
    let folder = tempfile::tempdir().unwrap();
    let read = |text: &str| -> (Value, String) {
        let output = convert(folder.path(), text, &|_| {});
        assert!(output.status.success(), "{}", said(&output));
        let bytes = std::fs::read(folder.path().join("town.json")).unwrap();
        (serde_json::from_slice(&bytes).unwrap(), said(&output))
    };
    let (scene, told) = read(&extract());
    assert!(!told.contains("left"), "{told}");
    assert_eq!(scene["meta"]["licence"], "odbl");
    assert!(scene["meta"]["notes"].as_str().unwrap().contains("OpenStreetMap contributors"));
    let crs = scene["meta"]["origin"]["crs"].as_str().unwrap();
    assert!(crs.contains("+lat_0=48.1 +lon_0=11.5"), "{crs}");
    let lanes = scene["map"]["lanes"].as_array().unwrap();
    let of = |kind: &str| lanes.iter().filter(|lane| lane["type"] == kind).count();
    assert!(of("surface_street") > 20 && of("sidewalk") > 10, "{} lanes", lanes.len());
    assert!(scene["map"]["crosswalks"].as_array().unwrap().len() >= 4);
    assert!(scene["map"]["road_edges"].as_array().unwrap().len() >= 4);
    let signals = scene["signals"].as_array().unwrap();
    let shows = |state: &str| signals.iter().any(|signal| signal["states"][0][1] == state);
    assert!(signals.len() >= 8 && shows("go") && shows("stop"), "{signals:?}");
    // The same roads in England: eastbound traffic is north of westbound traffic.
    let (mirrored, told) =
        read(&extract().replace("lat=\"48.", "lat=\"52.").replace("lon=\"11.", "lon=\"-1."));
    assert!(told.contains("left-hand"), "{told}");
    let east_north = |scene: &Value| {
        let lanes = scene["map"]["lanes"].as_array().unwrap().iter();
        let mut east: Vec<f64> = Vec::new();
        let mut west: Vec<f64> = Vec::new();
        for lane in lanes.filter(|lane| lane["type"] == "surface_street") {
            let points = lane["points_m"].as_array().unwrap();
            let at = |i: usize, axis: usize| points[i][axis].as_f64().unwrap();
            let last = points.len() - 1;
            let way = at(last, 0) - at(0, 0);
            // The long straight lanes of the main street.
            if way.abs() > 60.0 && at(0, 1).abs().max(at(last, 1).abs()) < 12.0 {
                if way > 0.0 { &mut east } else { &mut west }.push(at(0, 1));
            }
        }
        let mean = |all: &[f64]| all.iter().sum::<f64>() / all.len() as f64;
        mean(&east) > mean(&west)
    };
    assert!(!east_north(&scene) && east_north(&mirrored));
}
