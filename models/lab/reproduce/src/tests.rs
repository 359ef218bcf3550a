//! Small scenes and whole runs.

use crate::sets::{self, SetOptions};
use crate::*;
use experts::Engine;
use lab_train::samples::{log, scene, shifted};
use lab_train::scenes::{Crop, place_key};
use lab_train::training::{Records, is_held_out};
use scene::{Agent, AgentType, Scene, Size, Subtype};
use std::collections::BTreeSet;
use std::ops::Range;
use std::path::{Path, PathBuf};

/// The paper's sets without its least number of road users.
pub(crate) fn options() -> SetOptions {
    SetOptions {
        interval_steps: 60,
        crop: Crop { side_m: Some(120.0), least_agents: 2 },
        least_frames: 30,
        draws: 2,
        most_vehicles: 8,
        seed: 1,
    }
}

/// A pedestrian that walks east from a place for 20 s.
pub(crate) fn walker(id: &str, speed_mps: f64, (x_m, y_m): (f64, f64)) -> Agent {
    let mut agent = shifted(log(id, speed_mps, 200), x_m, y_m);
    agent.agent_type = AgentType::Pedestrian;
    agent.subtype = Subtype::Adult;
    agent.size = Size::default_for(agent.agent_type, agent.subtype);
    agent
}

/// A recording of 9.1 s at its own place: two vehicles with the ego, pedestrians, one cyclist, one crossing
/// pedestrian.
fn recording(place: usize) -> Scene {
    let pace = 5.0 + 0.1 * place as f64;
    let mut ego = log("ego", pace, 91);
    ego.role = Some("ego".into());
    let mut rider = walker("rider", 3.0, (6.0, 7.0));
    (rider.agent_type, rider.subtype) = (AgentType::Cyclist, Subtype::Unknown);
    let mut crossing = walker("crossing", 1.2, (28.0, -4.0));
    for state in crossing.track.states.iter_mut().flatten() {
        (state.x_m, state.y_m) = (28.0, state.x_m - 32.0);
        (state.vx_mps, state.vy_mps, state.heading_rad) = (0.0, 1.2, std::f64::consts::FRAC_PI_2);
    }
    let mut agents = vec![
        ego,
        shifted(log("ahead", pace + 1.0, 91), 25.0, 3.5),
        shifted(log("stands", 0.0, 91), 40.0, 0.0),
        rider,
        crossing,
        walker("walks", 1.1, (12.0, 9.0)),
    ];
    for agent in &mut agents {
        agent.track.states.truncate(91);
    }
    let mut scene = scene(agents);
    scene.name = format!("recording {place}");
    scene.meta.source_id = Some(format!("place-{place}"));
    scene
}

fn write(folder: &Path, places: Range<usize>) -> PathBuf {
    std::fs::create_dir_all(folder).unwrap();
    for place in places {
        let bytes = formats::native::write(&recording(place));
        std::fs::write(folder.join(format!("{place:03}.json")), bytes).unwrap();
    }
    folder.to_path_buf()
}

fn data(data: PathBuf, test: Option<PathBuf>) -> Data {
    Data { data: vec![data], test: test.into_iter().collect(), most_files: usize::MAX }
}

fn made(data: &Data, folder: &Path) -> Sets {
    std::fs::create_dir_all(folder.join("records")).unwrap();
    sets::make(data, &options(), folder, &Stop::default(), &|_| {}).unwrap()
}

/// Places of the records of a folder.
fn learned(folder: &Path) -> BTreeSet<u64> {
    let mut paths: Vec<PathBuf> = Centre::ALL.iter().map(|c| sets::records_path(folder, *c)).collect();
    paths.push(sets::free_records_path(folder));
    let records = Records::load(&paths).unwrap();
    (0..records.len()).map(|i| records.scene_of(i).0).collect()
}

fn judged(data: &Data, sets: &Sets) -> BTreeSet<u64> {
    let seen = sets::each_case(data, &options(), &sets.tests, &Stop::default(), &|_| {}, |_, _, cut| {
        Ok(place_key(&cut.scene))
    });
    seen.unwrap().into_iter().collect()
}

#[test]
fn places_are_learned_from_or_judged_and_never_both() {
    let folder = tempfile::tempdir().unwrap();
    let data = data(write(&folder.path().join("data"), 0..60), None);
    let sets = made(&data, folder.path());
    let (learned, judged) = (learned(folder.path()), judged(&data, &sets));
    assert!(learned.is_disjoint(&judged));
    assert_eq!(learned.len() + judged.len(), 60);
    assert_eq!((sets.places.all(), sets.places.test, sets.scenes), (60, judged.len(), 60));
    assert!((2..14).contains(&sets.places.test) && (2..14).contains(&sets.places.validation));
    assert_eq!(learned.iter().filter(|key| is_held_out(**key)).count(), sets.places.validation);
    // One square about the ego, two about pedestrians, one about the cyclist; the standing road user in the
    // ego's square is used for training too.
    let cases = |centre: Centre| sets.sets[centre.index()].cases.all();
    assert_eq!(Centre::ALL.map(cases), [60, 120, 60]);
    assert_eq!(sets.sets[0].judged.test, 2 * sets.places.test);
    assert!(sets.sets[0].judged.train > 2 * sets.places.train);
}

#[test]
fn tests_of_their_own_take_their_places_out_of_training() {
    let folder = tempfile::tempdir().unwrap();
    let (first, second) = (folder.path().join("data"), folder.path().join("test"));
    let data = data(write(&first, 0..30), Some(write(&second, 25..40)));
    let sets = made(&data, folder.path());
    let (learned, judged) = (learned(folder.path()), judged(&data, &sets));
    assert!(learned.is_disjoint(&judged));
    // In this case, no tenth of the data is reserved for tests.
    assert_eq!((learned.len(), judged.len(), sets.shared_places), (25, 15, 5));
}

#[test]
fn the_scenes_where_most_meet_are_chosen() {
    let folder = tempfile::tempdir().unwrap();
    let data = data(write(&folder.path().join("data"), 0..30), None);
    let sets = made(&data, folder.path());
    let chosen = sets::interactive(&sets, Centre::Pedestrian, 100);
    // One per recording: the square about the crossing pedestrian, or about the other pedestrian with the
    // crossing one in it.
    assert_eq!(chosen.len(), sets.places.test);
    assert!(chosen.iter().all(|case| case.interest.is_some_and(|i| i.encounters > 0)));
    assert!(
        chosen
            .windows(2)
            .all(|pair| pair[0].interest.unwrap().nearest_m <= pair[1].interest.unwrap().nearest_m)
    );
    assert_eq!(sets::interactive(&sets, Centre::Pedestrian, 1).len(), 1);
}

fn run_options(data: &Data, out: PathBuf) -> RunOptions {
    let few = Length::Steps(2);
    RunOptions {
        data: data.clone(),
        out,
        sets: options(),
        schedule: Schedule { denoiser: few, regressor: few, joint: few, batch: 8, ..Schedule::QUICK },
        condition_width: 16,
        collisions: CollisionOptions { iou: 0.02, most: [2, 1], seed: 1 },
        parts: Parts { tables: true, figure: true },
        seed: 1,
        threads: 2,
        stop: Stop::default(),
    }
}

fn results(folder: &Path) -> Vec<Vec<u8>> {
    let files = [TABLES_FILE, "table-1.csv", "table-2.csv", FIGURE_FILE];
    files.iter().map(|name| std::fs::read(folder.join(name)).unwrap()).collect()
}

#[test]
fn a_run_repeats_goes_on_where_it_was_stopped_and_knows_its_folder() {
    let folder = tempfile::tempdir().unwrap();
    let (first, second) = (folder.path().join("data"), folder.path().join("test"));
    let data = data(write(&first, 0..8), Some(write(&second, 20..22)));
    let of = |name: &str| run_options(&data, folder.path().join(name));
    let go =
        |options: &RunOptions, progress: &dyn Fn(&str)| run(options, Engine::built_in().unwrap(), progress);
    let straight = of("straight");
    let text = go(&straight, &|_| {}).unwrap();
    let expected = results(&straight.out);
    // Stopped in the second training: the final files are the same.
    let stopped = of("stopped");
    let ended = go(&stopped, &|line| {
        if line.starts_with("mixture") {
            stopped.stop.store(true, Ordering::Relaxed);
        }
    });
    assert!(ended.unwrap_err().is::<Stopped>());
    assert!(!stopped.out.join(TABLES_FILE).exists());
    stopped.stop.store(false, Ordering::Relaxed);
    go(&stopped, &|line| assert!(!line.starts_with("trafficgen:"), "{line}")).unwrap();
    assert!(results(&stopped.out) == expected);
    // Another run changes nothing, and trains nothing.
    go(&stopped, &|line| assert!(!line.contains("steps"), "{line}")).unwrap();
    assert!(results(&stopped.out) == expected);
    let other = go(&RunOptions { condition_width: 24, ..stopped.clone() }, &|_| {}).unwrap_err();
    assert!(other.is::<OtherRun>() && other.to_string().contains("condition width"), "{other}");
    forget(&stopped.out).unwrap();
    assert!(!stopped.out.join("weights").exists() && stopped.out.join(TABLES_FILE).exists());

    // The paper's shape and order.
    let rows: Vec<&str> = text.lines().filter(|line| line.starts_with("| Vehicle |")).collect();
    assert!(rows[0].starts_with("| Vehicle | TrafficGen |") && rows[0].contains("| 3.32 |"), "{text}");
    assert!(rows[1].contains("Mixture Training with Condition") && rows[1].contains("| 4.40 |"));
    assert!(rows[2].contains("| DragTraffic with Condition |") && rows[2].contains("| 2.53 |"));
    for (line, theirs) in [("| 3s | T.G. Mix", "15.0 %"), ("| 9s | DragTraffic with", "3.3 %")] {
        let row = text.lines().find(|row| row.starts_with(line)).unwrap();
        assert!(row.ends_with(&format!("| {theirs} |")), "{row}");
    }
    let csv = String::from_utf8(expected[1].clone()).unwrap();
    // Outside of quotes.
    let width = |line: &str| line.split('"').step_by(2).map(|part| part.matches(',').count()).sum::<usize>();
    assert!(csv.lines().all(|line| width(line) == width(csv.lines().next().unwrap())), "{csv}");
    assert_eq!(csv.lines().count(), 1 + 18);
    assert!(text.contains("10 scenes of") && text.contains("Licence of what was trained"), "{text}");
    let page = String::from_utf8(expected[3].clone()).unwrap();
    assert!(page.contains("id=\"creating\"") && page.contains("id=\"editing\""), "{}", &page[..600]);
}
