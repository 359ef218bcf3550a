use super::*;
use crate::samples::{log, scene, shifted};
use crate::training::{Records, is_held_out};
use scene::Agent;

fn options(folder: &Path) -> PrepareOptions {
    PrepareOptions {
        inputs: vec![folder.join("scenes")],
        out: folder.join("a.records"),
        agent_type: AgentType::Vehicle,
        seed: 1,
        per_scene: 6,
        draws: 2,
        most_records: 1000,
        crop: Crop::default(),
        mirror: false,
    }
}

/// Writes scenes of these road users, each in a file and a place of its own.
fn write(folder: &Path, scenes: Vec<Vec<Agent>>) {
    std::fs::create_dir_all(folder.join("scenes")).unwrap();
    for (i, agents) in scenes.into_iter().enumerate() {
        let mut scene = scene(agents);
        scene.meta.source_id = Some(format!("place {i}"));
        let bytes = formats::native::write(&scene);
        std::fs::write(folder.join(format!("scenes/{i:03}.json")), bytes).unwrap();
    }
}

/// A moving road user, and one for each reason of exclusion.
fn mixed() -> Vec<Agent> {
    let mut walker = shifted(log("walker", 1.0, 91), 0.0, 9.0);
    walker.agent_type = AgentType::Pedestrian;
    walker.subtype = scene::Subtype::Adult;
    walker.size = scene::Size::default_for(walker.agent_type, walker.subtype);
    let mut late = shifted(log("late", 5.0, 40), 0.0, 12.0);
    late.track.first_step = 3;
    let short = shifted(log("short", 5.0, 20), 0.0, 15.0);
    let standing = (0..4).map(|i| shifted(log(&format!("stands-{i}"), 0.0, 91), 6.0 * f64::from(i), 20.0));
    [log("mover", 8.0, 91), walker, late, short].into_iter().chain(standing).collect()
}

fn adds_up(report: &PrepareReport) {
    let out = &report.left_out;
    let left = out.in_scenes_with_too_few
        + out.outside_the_crop
        + out.wrong_type
        + out.absent_at_the_start
        + out.too_short
        + out.standing
        + out.over_the_scenes_limit
        + out.over_the_files_limit;
    assert_eq!(report.used + left, report.road_users, "{report:?}");
}

#[test]
fn reasons_are_counted_apart_and_add_up() {
    let folder = tempfile::tempdir().unwrap();
    write(folder.path(), vec![mixed()]);
    std::fs::write(folder.path().join("scenes/zzz.json"), b"{ no scene").unwrap();
    let report = run(&options(folder.path()), |_| {}).unwrap();
    let out = report.left_out;
    assert_eq!((report.files, report.scenes, report.road_users), (2, 1, 8));
    assert_eq!((out.unreadable_files, out.wrong_type, out.absent_at_the_start, out.too_short), (1, 1, 1, 1));
    assert_eq!(out.standing + report.used, 5);
    adds_up(&report);

    let one = PrepareOptions { per_scene: 1, ..options(folder.path()) };
    let report = run(&one, |_| {}).unwrap();
    assert_eq!(report.used, 1);
    adds_up(&report);
    let never = PrepareOptions { most_records: 0, ..options(folder.path()) };
    let report = run(&never, |_| {}).unwrap();
    assert_eq!((report.records, report.used, report.fit.records), (0, 0, 0));
    assert!(report.left_out.over_the_files_limit > 0);
    adds_up(&report);
}

#[test]
fn crops_take_road_users_and_scenes_out() {
    let folder = tempfile::tempdir().unwrap();
    let far = shifted(log("far", 8.0, 91), 61.0, 0.0);
    write(folder.path(), vec![vec![log("a", 8.0, 91), far], vec![log("a", 8.0, 91)]]);
    let cropped = |crop| run(&PrepareOptions { crop, ..options(folder.path()) }, |_| {}).unwrap();
    let square = cropped(Crop { side_m: Some(120.0), least_agents: 0 });
    assert_eq!((square.left_out.outside_the_crop, square.used, square.split.scenes), (1, 2, 2));
    adds_up(&square);
    let two = cropped(Crop { side_m: None, least_agents: 2 });
    assert_eq!((two.left_out.scenes_with_too_few, two.left_out.in_scenes_with_too_few), (1, 1));
    assert_eq!((two.scenes, two.split.scenes, two.used), (2, 1, 2));
    adds_up(&two);
    assert_eq!(cropped(Crop::default()).used, 3);
}

#[test]
fn hash_and_split_are_those_of_the_file() {
    let folder = tempfile::tempdir().unwrap();
    write(folder.path(), (0..30).map(|_| vec![log("a", 8.0, 91)]).collect());
    let options = options(folder.path());
    let report = run(&options, |_| {}).unwrap();
    let bytes = std::fs::read(&options.out).unwrap();
    assert_eq!(report.blake3, blake3::hash(&bytes).to_hex().to_string());
    assert_eq!(run(&options, |_| {}).unwrap(), report);

    let records = Records::load(std::slice::from_ref(&options.out)).unwrap();
    let held = (0..records.len()).filter(|i| is_held_out(records.scene_of(*i).0)).count();
    assert_eq!(report.records as usize, records.len());
    let provenance = &records.provenances()[0];
    assert_eq!(
        (provenance.expert.as_str(), provenance.scenes.values().flat_map(|l| l.values()).sum()),
        ("vehicle", 30u64)
    );
    assert_eq!((report.split.places, report.split.scenes), (30, records.scenes()));
    assert_eq!(report.split.records_held_out, held);
    assert!((1..30).contains(&report.split.scenes_held_out));
    let json = serde_json::to_value(&report).unwrap();
    assert_eq!(json["split"]["records_held_out"].as_u64(), Some(held as u64));
}

#[test]
fn residuals_follow_even_motion_along_a_lane() {
    let folder = tempfile::tempdir().unwrap();
    write(folder.path(), (0..4).map(|_| vec![log("a", 8.0, 91)]).collect());
    let report = run(&options(folder.path()), |_| {}).unwrap();
    assert_eq!(report.fit.records as u64, report.records);
    assert!(report.fit.mean_m < 0.2 && report.fit.p95_m < 0.5, "{:?}", report.fit);
    assert!(report.fit.mean_m <= report.fit.p95_m);
}
