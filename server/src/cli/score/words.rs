//! A score in one line, with the terms of `docs/metrics.md`.

use scene::score::Score;

/// A score in one line, after the name of the scored scene.
pub fn line(place: &str, score: &Score) -> String {
    let number = |value: Option<f64>, unit: &str| value.map_or("-".into(), |v| format!("{v:.2} {unit}"));
    let scene = &score.scene;
    let list = |one: &str, many: &str, in_log: Vec<bool>| {
        let (all, log) = (in_log.len(), in_log.iter().filter(|in_log| **in_log).count());
        let of_log = if log > 0 { format!(" (and {log} in the recording)") } else { String::new() };
        format!("{} {}{of_log}", all - log, if all - log == 1 { one } else { many })
    };
    // Without a threshold every overlap is a collision.
    let overlaps = || list("overlap", "overlaps", scene.overlaps.iter().map(|c| c.in_log).collect()) + ", ";
    let overlaps = if score.thresholds.iou > 0.0 { overlaps() } else { String::new() };
    format!(
        "{place}: {}, {overlaps}{}, minimum TTC {}, minimum gap {}, off road {}",
        list("collision", "collisions", scene.collisions.iter().map(|c| c.in_log).collect()),
        list("near miss", "near misses", scene.near_misses.iter().map(|c| c.in_log).collect()),
        number(scene.min_ttc_s, "s"),
        number(scene.min_distance_m, "m"),
        scene.offroad_share.map_or("-".into(), |share| format!("{:.1} %", share * 100.0)),
    )
}
