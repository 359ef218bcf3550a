//! The table of formats: sniffing, import by content, export.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    clippy::print_stdout,
    reason = "a test stops at the first surprise"
)]

use formats::loss::code;
use formats::registry::{self, FORMATS};
use formats::{ExportOptions, ImportOptions};
use std::collections::BTreeSet;

const JUNCTION: &[u8] = include_bytes!("fixtures/junction.scene.json");

#[test]
fn every_format_reads_what_it_writes_and_knows_its_own() {
    let drawn = formats::native::read(JUNCTION).unwrap();
    for format in FORMATS {
        let mut scene = drawn.clone();
        if format.info().id == "sim-agents" {
            // Submissions begin at the challenge's own step.
            scene.time = scene::Timing { steps: 91, now_step: 10 };
            scene.generated = None;
        }
        let info = format.info();
        if !info.export {
            let error = format.export(&[&scene], &ExportOptions::default()).unwrap_err();
            assert_eq!(error.kind(), std::io::ErrorKind::Unsupported);
            continue;
        }
        for gzip in [false, true] {
            let exported = format.export(&[&scene], &ExportOptions { gzip, ..Default::default() }).unwrap();
            assert!(
                exported.losses.iter().all(|loss| info.loses.contains(&loss.code)),
                "{:?}",
                exported.losses
            );
            if !info.import {
                let refused = format.import(&exported.bytes, &ImportOptions::default()).remove(0);
                assert_eq!(refused.unwrap_err().code(), "format-unknown");
                continue;
            }
            let found = registry::sniff(&exported.bytes, "upload").unwrap().info().id;
            assert_eq!(found, info.id);
            let list =
                registry::import(&exported.bytes, "upload", "auto", &ImportOptions::default()).unwrap();
            let (again, _) = list.into_iter().next().unwrap().unwrap();
            // Some formats cannot hold road users that were never seen.
            let seen = scene.agents.iter().filter(|agent| agent.track.valid_steps().next().is_some()).count();
            let maps_alone = exported.losses.iter().any(|loss| loss.code == code::NO_ROAD_USERS);
            let counts = if maps_alone { [0, 0] } else { [seen, scene.agents.len()] };
            assert!(counts.contains(&again.agents.len()), "{}", info.id);
        }
    }
}

#[test]
fn ids_are_unique_and_found() {
    let ids: BTreeSet<&str> = FORMATS.iter().map(|f| f.info().id).collect();
    assert_eq!(ids.len(), FORMATS.len());
    assert!(ids.iter().all(|id| registry::by_id(id).is_some()));
    assert!(registry::by_id("nothing").is_none());
}

#[test]
fn licence_can_be_given_and_unknown_content_is_refused() {
    let options = ImportOptions { licence: Some("cc-by-4.0".into()), ..Default::default() };
    let (scene, _) = registry::import(JUNCTION, "a.json", "auto", &options).unwrap().remove(0).unwrap();
    assert_eq!(scene.meta.licence.as_deref(), Some("cc-by-4.0"));
    let error = registry::import(b"<xml/>", "a.xml", "auto", &options).unwrap_err();
    assert_eq!(error.code(), "format-unknown");
    let other = registry::import(b"[1, 2]", "tfrecord-00001.json", "auto", &options).unwrap_err();
    assert_eq!(other.code(), "format-unknown");
    assert_eq!(registry::import(JUNCTION, "", "nothing", &options).unwrap_err().code(), "format-unknown");
}

#[test]
fn a_scene_is_recognised_whatever_the_order_of_its_members() {
    // serde_json sorts members: `agents` come first.
    let mut scene: serde_json::Value = serde_json::from_slice(JUNCTION).unwrap();
    let car = scene["agents"][0].clone();
    let copy = |id: usize| {
        let mut car = car.clone();
        car["id"] = id.to_string().into();
        car
    };
    scene["agents"] = (0..40).map(copy).collect();
    let sorted = scene.to_string();
    assert!(sorted.find("dragtraffic.scene").unwrap() > 4_096);
    let (scene, _) = registry::import(sorted.as_bytes(), "upload", "auto", &ImportOptions::default())
        .unwrap()
        .remove(0)
        .unwrap();
    assert_eq!(scene.agents.len(), 40);
}

#[test]
fn a_file_of_a_known_kind_is_called_what_it_is() {
    let refused = |bytes: &[u8], name: &str| {
        let error = registry::import(bytes, name, "auto", &ImportOptions::default()).unwrap_err();
        (error.code(), error.problems[0].detail.clone())
    };
    let (code, detail) = refused(b"%PDF-1.4\n%...", "map.xodr");
    assert_eq!(code, "format-unknown");
    assert!(
        detail.starts_with("a PDF document is not read") && detail.contains("its name ends in .xodr"),
        "{detail}"
    );
    let (_, detail) = refused(b"import osc.standard.all\nscenario top:\n  do serial:\n", "cut_in.osc");
    assert_eq!(detail, "an OpenSCENARIO 2 text is not read; export XML 1.x");
    // The name decides the format only while the content does not.
    assert_eq!(registry::sniff(b"", "map.xodr").map(|format| format.info().id), Some("opendrive"));
    assert!(registry::sniff(b"PK\x03\x04", "map.xodr").is_none());
}

#[test]
fn files_without_a_scene_are_called_what_they_are() {
    let said = |bytes: &[u8]| {
        let error = registry::import(bytes, "a.json", "auto", &ImportOptions::default()).unwrap_err();
        assert_eq!(error.code(), "format-unknown");
        error.problems[0].detail.clone()
    };
    for empty in [&b""[..], b" \n", b"\xef\xbb\xbf"] {
        assert_eq!(said(empty), "the file is empty");
    }
    assert!(said(b" []").starts_with("the file is a JSON array; a scene is a JSON object"));
    assert!(said(b"hello").starts_with("not a file of a known format"));
}

#[test]
fn a_byte_order_mark_is_no_part_of_a_scene() {
    let marked = [b"\xef\xbb\xbf", JUNCTION].concat();
    let read = |bytes: &[u8]| {
        registry::import(bytes, "a.json", "auto", &ImportOptions::default()).unwrap().remove(0).unwrap().0
    };
    assert_eq!(read(&marked), read(JUNCTION));
}

#[test]
fn losses_are_listed_once() {
    let scene = formats::native::read(JUNCTION).unwrap();
    let womd = registry::by_id("womd").unwrap();
    let exported = womd.export(&[&scene, &scene], &ExportOptions::default()).unwrap();
    assert_eq!(
        registry::loss_header(&exported.losses),
        "no-conditions, no-generated, no-licence, no-modes, no-notes, no-subtype"
    );
}

#[test]
fn a_table_has_a_line_for_each_road_user_future_and_step() {
    let mut scene = formats::native::read(JUNCTION).unwrap();
    scene.name = "a, b".into();
    let csv = registry::by_id("csv").unwrap();
    let text = |scenes: &[&scene::Scene], options: &ExportOptions| {
        String::from_utf8(csv.export(scenes, options).unwrap().bytes).unwrap()
    };
    let whole = text(&[&scene], &ExportOptions::default());
    let (head, lines) = whole.split_once('\n').unwrap();
    assert_eq!(head, formats::table::COLUMNS.join(","));
    let place = |name: &str| formats::table::COLUMNS.iter().position(|column| *column == name).unwrap();
    let generated = scene.generated.as_ref().unwrap();
    let futures = generated.samples.iter().flat_map(|s| s.agents.values()).flat_map(|f| &f.modes);
    let states: usize = futures.map(|future| future.states.len()).sum();
    let logged: usize = scene.agents.iter().map(|agent| agent.track.states.len().max(1)).sum();
    assert_eq!(lines.lines().count(), states + logged);
    assert!(lines.lines().all(|line| line.starts_with("\"a, b\",")), "{lines}");
    // The shown motion of a road user has each step once.
    let (id, futures) = generated.samples[0].agents.iter().next().unwrap();
    let chosen = futures.chosen.to_string();
    let fields = |line: &'static str| -> Vec<&'static str> {
        std::iter::once("").chain(line.trim_start_matches("\"a, b\",").split(',')).collect()
    };
    let rows = lines.to_owned().leak().lines().map(fields);
    let shown = rows.filter(|row| row[place("agent_id")] == id && row[place("chosen")] == "1");
    let shown: Vec<_> = shown
        .filter(|row| {
            row[place("source")] == "log" || (row[place("sample")] == "0" && row[place("mode")] == chosen)
        })
        .collect();
    let times: BTreeSet<&str> = shown.iter().map(|row| row[place("time_s")]).collect();
    assert_eq!(shown.len(), times.len());
    let further = ExportOptions { continued: true, label: Some("c".into()), ..Default::default() };
    let more = text(&[&scene], &further);
    assert!(more.starts_with("c,") && more.lines().count() == states + logged);
    let log = ExportOptions { motion: formats::ExportedMotion::Log, ..Default::default() };
    assert_eq!(text(&[&scene], &log).lines().count(), 1 + logged);
}

#[test]
fn no_cell_of_a_table_is_a_formula_and_names_stay() {
    let csv = registry::by_id("csv").unwrap();
    for name in ["=HYPERLINK(\"http://x\")", "+1", "-1", "@a", "'=a", "''a", "plain 'a'", " =1", "\u{ff1d}1"]
    {
        let mut scene = formats::native::read(JUNCTION).unwrap();
        scene.name = name.into();
        let bytes = csv.export(&[&scene], &ExportOptions::default()).unwrap().bytes;
        let text = String::from_utf8(bytes.clone()).unwrap();
        let cell = text.lines().nth(1).unwrap().trim_start_matches('"');
        assert!(!cell.trim_start().starts_with(['=', '+', '-', '@', '\u{ff1d}']), "{cell}");
        let again = csv.import(&bytes, &ImportOptions::default()).pop().unwrap().unwrap().0;
        assert_eq!(again.name, name);
    }
}
