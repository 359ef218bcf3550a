//! Ten knots represent the motion of recorded vehicles: fit, roll out, compare.
#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test stops at the first surprise")]

use lab_eval::measure::{following, mean_distance_m};
use scene::{Agent, AgentType, HORIZON_STEPS};

/// Mean distance of the rollout of the fitted knots from a vehicle's track; `None` for one that is not
/// seen throughout, does not move, or reverses.
fn fit_error_m(agent: &Agent) -> Option<f64> {
    let start = agent.state_at(0)?;
    let seen = (1..=HORIZON_STEPS).filter(|s| agent.state_at(*s).is_some()).count();
    let backwards = (0..=HORIZON_STEPS)
        .filter_map(|s| agent.state_at(s))
        .any(|s| s.velocity().dot(&scene::geometry::direction(s.heading_rad)) < -0.3);
    if agent.agent_type != AgentType::Vehicle || seen < 85 || agent.track.extent_m() < 2.0 || backwards {
        return None;
    }
    let motion = following(agent, start);
    Some(mean_distance_m(agent, |step| motion[step].position))
}

#[test]
fn fitted_knots_follow_real_vehicles() {
    let Some(folder) = samples::folder("womd/train", ".tfrecord") else { return };
    let files = lab_train::scenes::scene_files(&[folder]).unwrap();
    let scenes = files.iter().flat_map(|f| lab_train::scenes::read_scenes(f).unwrap());
    let mut errors: Vec<f64> =
        scenes.flat_map(|s| s.agents.iter().filter_map(fit_error_m).collect::<Vec<_>>()).collect();
    errors.sort_by(f64::total_cmp);
    let close = errors.iter().filter(|e| **e < 0.1).count() as f64 / errors.len() as f64;
    let mean = errors.iter().sum::<f64>() / errors.len() as f64;
    println!(
        "{} vehicles: mean {mean:.3} m, below 0.1 m {close:.3}, 95 % {:.3} m",
        errors.len(),
        errors[errors.len() * 95 / 100]
    );
    assert!(errors.len() > 100);
    assert!(close >= 0.95, "{close}");
}
