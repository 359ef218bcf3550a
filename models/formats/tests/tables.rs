//! Tables of motion: what is written is read, columns of others are taken, and nothing is read twice.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test stops at the first surprise")]

use formats::registry::{self, by_id};
use formats::{ExportOptions, ExportedMotion, ImportOptions, Source};
use scene::{Scene, State, Vec2};
use std::sync::Arc;

const JUNCTION: &[u8] = include_bytes!("fixtures/junction.scene.json");

fn junction() -> Scene {
    formats::native::read(JUNCTION).unwrap()
}

fn read_all(
    format: &str,
    bytes: &[u8],
    columns: Option<&str>,
) -> Vec<Result<formats::Imported, formats::ReadError>> {
    let columns = columns.map(|text| Arc::new(text.as_bytes().to_vec()) as Arc<dyn Source>);
    by_id(format).unwrap().import(bytes, &ImportOptions { columns, ..ImportOptions::default() })
}

fn read(format: &str, bytes: &[u8], columns: Option<&str>) -> formats::Imported {
    let mut list = read_all(format, bytes, columns);
    assert_eq!(list.len(), 1);
    list.remove(0).unwrap()
}

fn codes(warnings: &[formats::ImportWarning]) -> Vec<&str> {
    warnings.iter().map(|warning| warning.code).collect()
}

#[test]
fn a_file_of_many_scenes_gives_them_one_by_one() {
    let scene = junction();
    for format in ["csv", "parquet"] {
        let file =
            by_id(format).unwrap().export(&[&scene, &scene, &scene], &ExportOptions::default()).unwrap();
        let names = |options: &ImportOptions| -> Vec<String> {
            let list = registry::import(&file.bytes, "", "auto", options).unwrap();
            list.into_iter().map(|read| read.unwrap().0.name).collect()
        };
        let own = scene.name.clone();
        let all = [own.clone(), format!("{own} (2)"), format!("{own} (3)")];
        assert_eq!(names(&ImportOptions::default()), all);
        let middle = ImportOptions { skip: 1, max_scenes: 1, ..ImportOptions::default() };
        assert_eq!(names(&middle), all[1..2]);
    }
}

#[test]
fn columns_of_others_are_named_with_units_and_words() {
    // Degrees, feet, y downwards, a clock in milliseconds, and classes by number.
    let text = "frame_ms;veh;cls;px;py;dir;len;wid\n0;7;2;0;0;0;15;6\n100;7;2;10;-10;-90;15;6\n200;7;2;20;-20;-90;15;6\n";
    let columns = r#"{"agent_id": "veh", "type": {"column": "cls", "words": {"2": "truck"}},
        "time_s": {"column": "frame_ms", "unit": "ms"}, "x_m": {"column": "px", "unit": "ft"},
        "y_m": {"column": "py", "unit": "ft", "factor": -1}, "heading_rad": {"column": "dir", "unit": "deg", "factor": -1},
        "length_m": {"column": "len", "unit": "ft"}, "width_m": {"column": "wid", "unit": "ft"}}"#;
    let (scene, warnings) = read("csv", text.as_bytes(), Some(columns));
    assert_eq!(codes(&warnings), ["velocities-derived"]);
    let agent = &scene.agents[0];
    assert_eq!((agent.id.as_str(), agent.subtype), ("7", scene::Subtype::Truck));
    assert!((agent.size.length_m - 4.572).abs() < 1e-9);
    let state = agent.track.at(1).unwrap();
    assert!((state.position() - Vec2::new(3.048, 3.048)).norm() < 1e-9);
    assert!((state.heading_rad - std::f64::consts::FRAC_PI_2).abs() < 1e-9);
    assert!((state.velocity() - Vec2::new(30.48, 30.48)).norm() < 1e-6);
}

#[test]
fn what_is_missing_is_worked_out_and_said() {
    let mut text = String::from("id,t,x,y\n");
    for i in 0..50 {
        text += &format!("a,{:.2},{},{}\n", f64::from(i) * 0.04, f64::from(i) * 0.4, 5_000);
    }
    let columns = r#"{"agent_id": "id", "time_s": "t", "x_m": "x", "y_m": "y"}"#;
    let (scene, warnings) = read("csv", text.as_bytes(), Some(columns));
    assert_eq!(
        codes(&warnings),
        ["types-assumed", "sizes-assumed", "time-resampled", "headings-derived", "velocities-derived"]
    );
    // Large coordinates move the frame, which is reported.
    assert!(scene.meta.origin.y_m > 4_900.0);
    let track = &scene.agents[0].track;
    assert_eq!(track.states.len(), 20);
    for (step, state) in track.states.iter().enumerate() {
        let state = state.unwrap();
        assert!((state.x_m + scene.meta.origin.x_m - step as f64).abs() < 1e-6);
        assert!((state.vx_mps - 10.0).abs() < 1e-6 && state.heading_rad.abs() < 1e-9);
    }
}

#[test]
fn a_long_recording_is_cut() {
    let mut text = String::from("agent_id,type,time_s,x_m,y_m\n");
    for i in 0..1_000 {
        text += &format!("a,car,{:.1},{},0\n", f64::from(i) * 0.1, f64::from(i) * 0.01);
    }
    let scenes = read_all("csv", text.as_bytes(), None);
    assert_eq!(scenes.len(), 11);
    for read in scenes {
        let (scene, warnings) = read.unwrap();
        assert!(codes(&warnings).contains(&"cut"));
        assert!(scene.time.steps <= 91 && scene.agents[0].track.states.iter().all(Option::is_some));
    }
}

#[test]
fn futures_come_back_with_their_probabilities() {
    let scene = junction();
    for format in ["csv", "parquet"] {
        let file = by_id(format).unwrap().export(&[&scene], &ExportOptions::default()).unwrap();
        let (again, _) = read(format, &file.bytes, None);
        // CSV has no place for the origin: its frame is that of the source.
        let (own, its) = (&scene.meta.origin, &again.meta.origin);
        let shift = Vec2::new(own.x_m - its.x_m, own.y_m - its.y_m);
        let (own, its) = (scene.generated.as_ref().unwrap(), again.generated.as_ref().unwrap());
        assert_eq!(own.samples.len(), its.samples.len());
        for (own, its) in own.samples.iter().zip(&its.samples) {
            assert_eq!(own.agents.keys().collect::<Vec<_>>(), its.agents.keys().collect::<Vec<_>>());
            for (own, its) in own.agents.values().zip(its.agents.values()) {
                assert_eq!((own.chosen, own.modes.len()), (its.chosen, its.modes.len()));
                for (own, its) in own.modes.iter().zip(&its.modes) {
                    assert!((own.probability - its.probability).abs() < 1e-6);
                    assert_eq!((own.first_step, own.states.len()), (its.first_step, its.states.len()));
                    let near = |p: &State, q: &State| (p.position() + shift - q.position()).norm() < 1e-5;
                    assert!(own.states.iter().zip(&its.states).all(|(p, q)| near(p, q)));
                }
            }
        }
        let log = ExportOptions { motion: ExportedMotion::Log, ..ExportOptions::default() };
        let file = by_id(format).unwrap().export(&[&scene], &log).unwrap();
        assert!(read(format, &file.bytes, None).0.generated.is_none());
    }
}

#[test]
fn faults_are_told_with_their_row() {
    let head = "agent_id,time_s,x_m,y_m\n";
    for (rows, code, at) in [
        ("a,0,1,1\na,0.1,one,1\n", "invalid-field", "/line/3/x_m"),
        ("a,0,1,\n", "invalid-field", "/line/2/y_m"),
        (",0,1,1\n", "invalid-field", "/line/2/agent_id"),
        ("a,,1,1\n", "invalid-field", "/line/2/time_s"),
        ("a,0,1e300,1\n", "invalid-field", "/line/2/x_m"),
        ("a,0,inf,1\n", "invalid-field", "/line/2/x_m"),
        ("", "cannot-represent", ""),
    ] {
        let error = read_all("csv", format!("{head}{rows}").as_bytes(), None).remove(0).unwrap_err();
        assert_eq!((error.code(), error.problems[0].pointer.as_str()), (code, at), "{rows}");
    }
    let error = read_all("csv", b"a,b\n1,2\n", None).remove(0).unwrap_err();
    assert!(
        error.to_string().contains("agent_id, x_m, y_m, time_s or step")
            && error.to_string().contains("a, b")
    );
    let error = read_all("csv", head.as_bytes(), Some(r#"{"type": "klass"}"#)).remove(0).unwrap_err();
    assert_eq!(error.problems[0].pointer, "/columns/type");
    let apart = format!("scenario_id,{head}s,a,0,1,1\nt,a,0,1,1\ns,a,0.1,1,1\n");
    let list = read_all("csv", apart.as_bytes(), None);
    assert!(list[..2].iter().all(Result::is_ok) && list[2].is_err());
}

#[test]
fn damaged_parquet_is_refused() {
    let scene = junction();
    let file = by_id("parquet").unwrap().export(&[&scene], &ExportOptions::default()).unwrap().bytes;
    for end in (0..file.len()).step_by(397) {
        assert!(read_all("parquet", &file[..end], None).iter().all(Result::is_err), "{end}");
    }
    // All of the description, and some of the pages.
    let described = file.len() - file.len().min(6_000);
    for at in (0..described).step_by(37).chain((described..file.len()).step_by(2)) {
        let mut bent = file.clone();
        bent[at] ^= 1 << (at / 2 % 8);
        for (scene, _) in read_all("parquet", &bent, None).into_iter().flatten() {
            formats::native::read(&formats::native::write(&scene)).unwrap();
        }
    }
}
