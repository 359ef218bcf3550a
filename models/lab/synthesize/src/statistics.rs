//! Statistics of traffic, to compare synthetic windows with recorded ones.
//!
//! Accelerations, jerk and yaw rate come from the given velocities and headings after a 0.2 s Gaussian, the
//! same for every source. Only road users within 80 m of the scene's origin (the ego or the window's centre)
//! count, because farther ones are only partly seen.

use crate::filters::{gaussian, gradient, unwrap};
use scene::geometry::{cross, direction};
use scene::routes::LaneGraph;
use scene::{Agent, AgentType, STANDING_MPS, STEP_S, Scene, State, Vec2, wrap_angle};
use serde::Serialize;
use std::collections::BTreeMap;
use std::fmt::Write as _;

/// Half a side of the square around the origin in which road users are measured, metres.
const NEAR_M: f64 = 80.0;
/// Half a side of the square in which road users are counted, metres.
const COUNTED_M: f64 = 60.0;
/// Standard deviation of the Gaussian before differentiation, steps.
const SMOOTHING: f64 = 2.0;
/// Least speed of a moving road user, m/s; below it, recorded headings are noise.
const MOVING_MPS: f64 = 0.5;
/// Least length of a measured part of a track, steps.
const SHORTEST: usize = 31;

/// Aggregate of a row.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
enum Aggregate {
    /// Percentiles 1, 5, 50, 95, 99.
    Spread,
    /// Share of true values.
    Share,
    /// Mean, with percentiles 5 and 95.
    Mean,
}

/// Rows in the order of the table: key, description, aggregate.
const ROWS: [(&str, &str, Aggregate); 45] = [
    ("count_vehicle", "vehicles in 120 m x 120 m", Aggregate::Mean),
    ("count_pedestrian", "pedestrians in 120 m x 120 m", Aggregate::Mean),
    ("count_cyclist", "cyclists in 120 m x 120 m", Aggregate::Mean),
    ("vehicle_stationary", "vehicles that move less than 0.8 m", Aggregate::Share),
    ("vehicle_valid", "share of the window that a vehicle is seen", Aggregate::Mean),
    ("vehicle_length", "vehicle length, m", Aggregate::Spread),
    ("vehicle_width", "vehicle width, m", Aggregate::Spread),
    ("vehicle_speed", "vehicle speed when moving, m/s", Aggregate::Spread),
    ("vehicle_distance", "distance in 9 s of a moving vehicle, m", Aggregate::Spread),
    ("vehicle_distance_from_rest", "the same from below 0.3 m/s, m", Aggregate::Spread),
    ("vehicle_distance_fast", "the same from above 12 m/s, m", Aggregate::Spread),
    ("vehicle_starts_at_rest", "moving vehicles that start below 0.3 m/s", Aggregate::Share),
    ("vehicle_drift", "distance from constant velocity after 9 s, m", Aggregate::Spread),
    ("vehicle_acceleration", "vehicle acceleration, m/s2", Aggregate::Spread),
    ("vehicle_jerk", "vehicle jerk, m/s3", Aggregate::Spread),
    ("vehicle_yaw_rate", "vehicle yaw rate, deg/s", Aggregate::Spread),
    ("vehicle_lateral", "vehicle lateral acceleration, m/s2", Aggregate::Spread),
    ("vehicle_slip", "vehicle velocity off its heading, deg", Aggregate::Spread),
    ("vehicle_turn_speed", "speed while turning, m/s", Aggregate::Spread),
    ("vehicle_turn_lateral", "lateral acceleration while turning, m/s2", Aggregate::Spread),
    ("vehicle_turn_radius", "radius while turning, m", Aggregate::Spread),
    ("vehicle_wander", "weaving in straight driving, cm", Aggregate::Spread),
    ("vehicle_lane_offset", "offset from the lane's middle, m", Aggregate::Spread),
    ("vehicle_heading_offset", "heading off the lane, deg", Aggregate::Spread),
    ("vehicle_off_lane", "moving vehicles on no lane", Aggregate::Share),
    ("vehicle_stop_and_go", "moving vehicles that also stand", Aggregate::Share),
    ("vehicle_turns", "vehicles that turn by more than 45 deg", Aggregate::Share),
    ("vehicle_turns_any", "vehicles that turn by more than 15 deg", Aggregate::Share),
    ("vehicle_u_turns", "vehicles that turn by more than 150 deg", Aggregate::Share),
    ("vehicle_has_leader", "moving vehicles with one ahead within 60 m", Aggregate::Share),
    ("vehicle_gap", "gap to it, m", Aggregate::Spread),
    ("vehicle_headway", "time to its place, s", Aggregate::Spread),
    ("pedestrian_stationary", "pedestrians that move less than 1 m", Aggregate::Share),
    ("pedestrian_speed", "pedestrian speed when moving, m/s", Aggregate::Spread),
    ("pedestrian_acceleration", "pedestrian acceleration, m/s2", Aggregate::Spread),
    ("pedestrian_yaw_rate", "pedestrian yaw rate, deg/s", Aggregate::Spread),
    ("pedestrian_slip", "pedestrian velocity off its heading, deg", Aggregate::Spread),
    ("pedestrian_wander", "pedestrian weaving in 3 s, cm", Aggregate::Spread),
    ("pedestrian_drift", "distance from constant velocity after 9 s, m", Aggregate::Spread),
    ("cyclist_stationary", "cyclists that move less than 1 m", Aggregate::Share),
    ("cyclist_speed", "cyclist speed when moving, m/s", Aggregate::Spread),
    ("cyclist_acceleration", "cyclist acceleration, m/s2", Aggregate::Spread),
    ("cyclist_yaw_rate", "cyclist yaw rate, deg/s", Aggregate::Spread),
    ("cyclist_wander", "cyclist weaving in 3 s, cm", Aggregate::Spread),
    ("cyclist_turns", "cyclists that turn by more than 45 deg", Aggregate::Share),
];

/// Values by row key, collected scene by scene.
#[derive(Clone, Debug, Default)]
pub struct Statistics {
    scenes: usize,
    values: BTreeMap<String, Vec<f64>>,
}

/// Summary of a row.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Summary {
    /// Number of values.
    pub count: usize,
    /// Mean; for booleans, the share of true values.
    pub mean: f64,
    /// Percentiles 1, 5, 50, 95, 99.
    pub percentiles: [f64; 5],
}

impl Statistics {
    /// Adds a scene.
    pub fn add(&mut self, scene: &Scene) {
        self.scenes += 1;
        let graph = LaneGraph::new(&scene.map);
        let now = scene.time.now_step;
        for (agent_type, name) in TYPES {
            let counted = scene.agents.iter().filter(|a| a.agent_type == agent_type && counted(a, now));
            self.push("count", name, counted.count() as f64);
        }
        for agent in &scene.agents {
            if let Some((_, name)) = TYPES.iter().find(|(t, _)| *t == agent.agent_type) {
                self.agent(scene, &graph, agent, name);
            }
        }
    }

    fn push(&mut self, what: &str, name: &str, value: f64) {
        let key = if what == "count" { format!("count_{name}") } else { format!("{name}_{what}") };
        if value.is_finite() {
            self.values.entry(key).or_default().push(value);
        }
    }

    fn flag(&mut self, what: &str, name: &str, value: bool) {
        self.push(what, name, f64::from(u8::from(value)));
    }

    fn extend(&mut self, what: &str, name: &str, values: impl IntoIterator<Item = f64>) {
        for value in values {
            self.push(what, name, value);
        }
    }

    fn agent(&mut self, scene: &Scene, graph: &LaneGraph, agent: &Agent, name: &str) {
        let near = |s: &State| s.x_m.abs() < NEAR_M && s.y_m.abs() < NEAR_M;
        let steps = scene.time.steps;
        let seen: Vec<Option<State>> = (0..steps).map(|step| agent.state_at(step).filter(near)).collect();
        let valid = seen.iter().flatten().count();
        if valid < SHORTEST {
            return;
        }
        let extent = {
            let first = seen.iter().flatten().next().map(State::position).unwrap_or_default();
            seen.iter().flatten().map(|s| (s.position() - first).norm()).fold(0.0, f64::max)
        };
        if valid >= 60 && counted(agent, scene.time.now_step) {
            let still = if agent.agent_type == AgentType::Vehicle { 0.8 } else { 1.0 };
            self.flag("stationary", name, extent < still);
            self.push("valid", name, valid as f64 / steps as f64);
            self.push("length", name, agent.size.length_m);
            self.push("width", name, agent.size.width_m);
        }
        self.whole_window(agent, name);
        let Some(stretch) = longest(&seen) else { return };
        if stretch.iter().all(|s| (s.position() - stretch[0].position()).norm() < 1.5) {
            return;
        }
        self.stretch(scene, graph, agent, name, &stretch);
    }

    /// Adds the position 9 s after the first step, whether near the origin or not.
    fn whole_window(&mut self, agent: &Agent, name: &str) {
        let (Some(first), Some(last)) = (agent.state_at(0), agent.state_at(scene::HORIZON_STEPS)) else {
            return;
        };
        if first.x_m.abs() > NEAR_M || first.y_m.abs() > NEAR_M || agent.track.extent_m() < 2.0 {
            return;
        }
        let seconds = scene::HORIZON_STEPS as f64 * STEP_S;
        let states = (0..=scene::HORIZON_STEPS).filter_map(|s| agent.state_at(s));
        let points: Vec<Vec2> = states.map(|s| s.position()).collect();
        let distance: f64 = points.windows(2).map(|w| (w[1] - w[0]).norm()).sum();
        self.push("distance", name, distance);
        self.flag("starts_at_rest", name, first.speed_mps() < STANDING_MPS);
        if first.speed_mps() < STANDING_MPS {
            self.push("distance_from_rest", name, distance);
        }
        if first.speed_mps() > 12.0 {
            self.push("distance_fast", name, distance);
        }
        let kept = first.position() + first.velocity() * seconds;
        self.push("drift", name, (last.position() - kept).norm());
    }

    fn stretch(&mut self, scene: &Scene, graph: &LaneGraph, agent: &Agent, name: &str, track: &[State]) {
        let driving = agent.agent_type == AgentType::Vehicle;
        let speed: Vec<f64> = track.iter().map(State::speed_mps).collect();
        let heading = gaussian(&unwrap(&track.iter().map(|s| s.heading_rad).collect::<Vec<_>>()), SMOOTHING);
        let smooth = gaussian(&speed, SMOOTHING);
        let acceleration = gradient(&smooth, STEP_S);
        let jerk = gradient(&gaussian(&acceleration, SMOOTHING), STEP_S);
        let yaw = gradient(&heading, STEP_S);
        let when = |keep: &dyn Fn(usize) -> bool, every: usize, of: &dyn Fn(usize) -> f64| -> Vec<f64> {
            (0..track.len()).filter(|i| keep(*i)).step_by(every).map(of).collect()
        };
        let moving = |i: usize| speed[i] > MOVING_MPS;
        if (0..track.len()).filter(|i| moving(*i)).count() < 10 {
            return;
        }
        self.extend("speed", name, when(&moving, 5, &|i| speed[i]));
        self.extend("acceleration", name, when(&moving, 3, &|i| acceleration[i]));
        self.extend("jerk", name, when(&moving, 3, &|i| jerk[i]));
        let rolling = |i: usize| speed[i] > if driving { 1.5 } else { MOVING_MPS };
        self.extend("yaw_rate", name, when(&rolling, 3, &|i| yaw[i].to_degrees()));
        self.extend("lateral", name, when(&rolling, 3, &|i| smooth[i] * yaw[i]));
        let slip = |i: usize| {
            let s = &track[i];
            wrap_angle(s.vy_mps.atan2(s.vx_mps) - s.heading_rad).abs().to_degrees()
        };
        let fast = if driving { 2.0 } else { MOVING_MPS };
        self.extend("slip", name, when(&|i| speed[i] > fast, 5, &slip));
        let turned = (heading[heading.len() - 1] - heading[0]).abs().to_degrees();
        if track.len() >= 60 {
            let stands = speed.iter().any(|v| *v < STANDING_MPS);
            self.flag("stop_and_go", name, stands && speed.iter().any(|v| *v > 2.0));
            self.flag("turns", name, turned > 45.0);
            self.flag("turns_any", name, turned > 15.0);
            self.flag("u_turns", name, turned > 150.0);
        }
        if !driving {
            self.extend("wander", name, weaving(track, if name == "cyclist" { 1.0 } else { 0.4 }));
            return;
        }
        let turning = |i: usize| yaw[i].abs().to_degrees() > 8.0 && speed[i] > 1.5;
        self.extend("turn_speed", name, when(&turning, 3, &|i| speed[i]));
        self.extend("turn_lateral", name, when(&turning, 3, &|i| (smooth[i] * yaw[i]).abs()));
        self.extend("turn_radius", name, when(&turning, 3, &|i| smooth[i] / yaw[i].abs()));
        let straight = speed.iter().all(|v| *v > 4.0) && turned < 3.0;
        if straight && track.len() >= 60 {
            let mean = heading.iter().sum::<f64>() / heading.len() as f64;
            let across: Vec<f64> = track.iter().map(|s| cross(direction(mean), s.position())).collect();
            self.push("wander", name, 100.0 * off_parabola(&across));
        }
        self.on_lanes(graph, name, track);
        self.behind(scene, agent, name);
    }

    fn on_lanes(&mut self, graph: &LaneGraph, name: &str, track: &[State]) {
        for state in track.iter().step_by(10).filter(|s| s.speed_mps() > 1.5) {
            let hits = graph.nearest_for(state.position(), 4.0, AgentType::Vehicle);
            let hit = hits.iter().find(|h| wrap_angle(state.heading_rad - h.heading_rad).abs() < 0.5);
            self.flag("off_lane", name, hit.is_none());
            if let Some(hit) = hit {
                self.push("lane_offset", name, hit.lateral_m);
                let off = wrap_angle(state.heading_rad - hit.heading_rad).to_degrees();
                self.push("heading_offset", name, off);
            }
        }
    }

    /// Adds the gap to the vehicle ahead in the same direction, every 1.5 s.
    fn behind(&mut self, scene: &Scene, agent: &Agent, name: &str) {
        let others =
            || scene.agents.iter().filter(|o| o.agent_type == AgentType::Vehicle && o.id != agent.id);
        for step in (0..scene.time.steps).step_by(15) {
            let Some(own) = agent.state_at(step).filter(|s| s.speed_mps() > MOVING_MPS) else { continue };
            if own.x_m.abs() > NEAR_M || own.y_m.abs() > NEAR_M {
                continue;
            }
            let ahead = direction(own.heading_rad);
            let gap = others()
                .filter_map(|o| {
                    let s = o.state_at(step)?;
                    let apart = s.position() - own.position();
                    let (along, across) = (apart.dot(&ahead), cross(ahead, apart));
                    let same = wrap_angle(s.heading_rad - own.heading_rad).abs() < 0.5;
                    (same && across.abs() < 1.3 && along > 0.0 && along < 60.0)
                        .then_some(along - 0.5 * (agent.size.length_m + o.size.length_m))
                })
                .min_by(f64::total_cmp);
            self.flag("has_leader", name, gap.is_some());
            if let Some(gap) = gap {
                self.push("gap", name, gap);
                if own.speed_mps() > 3.0 {
                    self.push("headway", name, gap / own.speed_mps());
                }
            }
        }
    }

    /// Summary of a row; `None` without values.
    pub fn summary(&self, key: &str) -> Option<Summary> {
        let mut values = self.values.get(key)?.clone();
        values.sort_by(f64::total_cmp);
        let at = |share: f64| values[((values.len() - 1) as f64 * share).round() as usize];
        Some(Summary {
            count: values.len(),
            mean: values.iter().sum::<f64>() / values.len() as f64,
            percentiles: [0.01, 0.05, 0.5, 0.95, 0.99].map(at),
        })
    }

    /// Summaries of all rows, by key.
    pub fn summaries(&self) -> BTreeMap<&'static str, Summary> {
        ROWS.iter().filter_map(|(key, _, _)| Some((*key, self.summary(key)?))).collect()
    }
}

/// Types with rows, and their names in keys.
const TYPES: [(AgentType, &str); 3] =
    [(AgentType::Vehicle, "vehicle"), (AgentType::Pedestrian, "pedestrian"), (AgentType::Cyclist, "cyclist")];

/// Whether a road user is in the counted square at step `now`.
fn counted(agent: &Agent, now: usize) -> bool {
    agent.state_at(now).is_some_and(|s| s.x_m.abs() < COUNTED_M && s.y_m.abs() < COUNTED_M)
}

/// The longest part without a gap; `None` if it is too short.
fn longest(seen: &[Option<State>]) -> Option<Vec<State>> {
    let runs = seen.split(Option::is_none);
    let run = runs.max_by_key(|run| run.len()).filter(|run| run.len() >= SHORTEST)?;
    Some(run.iter().flatten().copied().collect())
}

/// Deviation of samples from their best-fitting parabola.
fn off_parabola(values: &[f64]) -> f64 {
    let n = values.len();
    let t = |i: usize| 2.0 * i as f64 / (n - 1) as f64 - 1.0;
    let basis = nalgebra::DMatrix::from_fn(n, 3, |i, j| t(i).powi(j as i32));
    let wanted = nalgebra::DVector::from_column_slice(values);
    let Some(inverse) = (basis.transpose() * &basis).try_inverse() else { return 0.0 };
    let rest = &wanted - &basis * (inverse * basis.transpose() * &wanted);
    (rest.norm_squared() / n as f64).sqrt()
}

/// Deviation across the main direction in parts of 3 s without standstill, cm.
fn weaving(track: &[State], slowest_mps: f64) -> Vec<f64> {
    let pieces = track.windows(30).step_by(15).filter(|p| p.iter().all(|s| s.speed_mps() > slowest_mps));
    pieces
        .map(|piece| {
            let middle = piece.iter().map(State::position).sum::<Vec2>() / piece.len() as f64;
            let (mut xx, mut xy, mut yy) = (0.0, 0.0, 0.0);
            for d in piece.iter().map(|s| s.position() - middle) {
                xx += d.x * d.x;
                xy += d.x * d.y;
                yy += d.y * d.y;
            }
            // The smaller eigenvalue of the scatter matrix.
            let least = 0.5 * (xx + yy - ((xx - yy).powi(2) + 4.0 * xy * xy).sqrt());
            100.0 * (least.max(0.0) / piece.len() as f64).sqrt()
        })
        .collect()
}

/// Sources side by side as a Markdown table.
pub fn markdown(sources: &[(String, Statistics)]) -> String {
    let mut out = String::from("| quantity |");
    for (name, statistics) in sources {
        let _ = write!(out, " {name} ({} scenes) |", statistics.scenes);
    }
    out.push_str("\n|---|");
    out.push_str(&"---|".repeat(sources.len()));
    out.push('\n');
    for (key, words, form) in ROWS {
        let _ = write!(out, "| {}: {words} |", key.replace('_', " "));
        for (_, statistics) in sources {
            let text = statistics.summary(key).map_or("-".to_owned(), |s| s.text(form));
            let _ = write!(out, " {text} |");
        }
        out.push('\n');
    }
    out
}

impl Summary {
    fn text(&self, form: Aggregate) -> String {
        let [p1, p5, p50, p95, p99] = self.percentiles;
        match form {
            Aggregate::Spread => format!("{p1:.2} {p5:.2} {p50:.2} {p95:.2} {p99:.2}"),
            Aggregate::Share => format!("{:.1} % of {}", 100.0 * self.mean, self.count),
            Aggregate::Mean => format!("{:.2} [{p5:.2}, {p95:.2}]", self.mean),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use scene::{Size, Subtype, Track};

    fn car(id: &str, speed: f64, acceleration: f64) -> Agent {
        let states = (0..91).map(|i| {
            let t = i as f64 * STEP_S;
            Some(State {
                x_m: -40.0 + speed * t + 0.5 * acceleration * t * t,
                vx_mps: speed + acceleration * t,
                ..State::default()
            })
        });
        Agent {
            id: id.into(),
            agent_type: AgentType::Vehicle,
            subtype: Subtype::Car,
            role: None,
            size: Size { length_m: 4.0, width_m: 2.0, height_m: None },
            track: Track { first_step: 0, states: states.collect(), z_m: None }.into(),
            conditions: scene::Conditions::default(),
        }
    }

    #[test]
    fn known_motions_give_known_numbers() {
        let mut ahead = car("b", 6.0, 0.0);
        ahead.track.states.iter_mut().flatten().for_each(|s| s.x_m += 20.0);
        let scene = Scene::bare("two cars", scene::LaneMap::default(), vec![car("a", 2.0, 1.0), ahead]);
        let mut statistics = Statistics::default();
        statistics.add(&scene);
        let row = |key: &str| statistics.summary(key).unwrap();
        assert_eq!(row("count_vehicle").mean, 2.0);
        assert_eq!(row("vehicle_stationary").mean, 0.0);
        // 2 t + t^2 / 2 and 6 t after 9 s.
        let distance = row("vehicle_distance");
        assert!((distance.percentiles[4] - 58.5).abs() < 0.2, "{distance:?}");
        assert!((distance.percentiles[0] - 54.0).abs() < 1e-6);
        assert!((row("vehicle_drift").percentiles[4] - 40.5).abs() < 0.2);
        let acceleration = row("vehicle_acceleration");
        assert!((acceleration.percentiles[3] - 1.0).abs() < 0.02, "{acceleration:?}");
        assert_eq!(row("vehicle_off_lane").mean, 1.0);
        // The first gap is 20 m between centres, less one length.
        assert!((row("vehicle_gap").percentiles[3] - 21.0).abs() < 6.0);
        let table = markdown(&[("mine".into(), statistics)]);
        assert_eq!(table.lines().count(), 2 + ROWS.len());
    }

    #[test]
    fn a_parabola_has_no_weaving_and_a_wave_has() {
        let parabola: Vec<f64> = (0..90).map(|i| 3.0 + 0.2 * i as f64 + 0.01 * (i * i) as f64).collect();
        assert!(off_parabola(&parabola) < 1e-6);
        let wave: Vec<f64> = (0..90).map(|i| (i as f64 * 0.7).sin()).collect();
        assert!((off_parabola(&wave) - 0.7).abs() < 0.05);
    }
}
