//! Scenes that placement fills are a safe start: no fault occurs before any road user could react, and nobody
//! collides after that.
#![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

use experts::Engine;
use lab_eval::filled::{eval, maps, markdown};

#[test]
fn filled_maps_have_no_collisions_and_no_near_misses_at_the_start() {
    let engine = Engine::built_in().unwrap();
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../../assets/scenes/demo-roundabout.json");
    let roundabout = formats::native::read(&std::fs::read(path).unwrap()).unwrap();
    let filled = eval(&engine, &maps(&[roundabout]).unwrap(), 40).unwrap();
    let users: usize = filled.iter().map(|f| f.scene.agents.len()).sum();
    assert!(users > 40 * 30, "{users} road users");
    let sooner = |kind: &str, than_s: f64| -> Vec<&str> {
        let faults = filled.iter().flat_map(|f| &f.faults);
        faults.filter(|f| f.kind == kind && f.time_s < than_s).map(|f| f.what.as_str()).collect()
    };
    // Draws 18 and 25 have conflicts that only several drivers can resolve together.
    assert_eq!(sooner("collision", f64::INFINITY), Vec::<&str>::new());
    // One road user may begin a lane change at once.
    assert!(sooner("near miss", 0.35).len() <= 1, "{:#?}", sooner("near miss", 0.35));
    assert!(markdown(&filled, false).contains("40 filled scenes"));
}
