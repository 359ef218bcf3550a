//! Scenes that placement fills are a safe start: no fault occurs before any road user could react.
#![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

use experts::Engine;
use lab_eval::filled::{eval, maps, markdown};

#[test]
fn filled_templates_start_without_collisions_and_near_misses() {
    let engine = Engine::built_in().unwrap();
    let filled = eval(&engine, &maps(&[]).unwrap(), 40).unwrap();
    let users: usize = filled.iter().map(|f| f.scene.agents.len()).sum();
    assert!(users > 40 * 30, "{users} road users");
    let sooner = |kind: &str, than_s: f64| -> Vec<&str> {
        let faults = filled.iter().flat_map(|f| &f.faults);
        faults.filter(|f| f.kind == kind && f.time_s < than_s).map(|f| f.what.as_str()).collect()
    };
    assert_eq!(sooner("collision", 1.0), Vec::<&str>::new());
    // One road user may begin a lane change at once.
    assert!(sooner("near miss", 0.35).len() <= 1, "{:#?}", sooner("near miss", 0.35));
    assert!(markdown(&filled, false).contains("40 filled scenes"));
}
