//! A scene at a step as text and numbers.

use crate::cli::generate::tell;
use scene::routes::{GraphLane, LaneGraph};
use scene::{Agent, Goal, STEP_S, Scene, State, Vec2, wrap_angle};
use std::f64::consts::FRAC_PI_4;
use std::fmt::Write as _;

/// Greatest distance from a lane that a road user is on, metres.
const ON_LANE_M: f64 = 3.0;
/// Greatest heading difference to a lane that a road user is on, radians.
const ALONG_RAD: f64 = 1.0;
/// Compass points from east, counter-clockwise, one per eighth of a turn.
const COMPASS: [&str; 8] =
    ["east", "north-east", "north", "north-west", "west", "south-west", "south", "south-east"];

/// Selection of a description.
#[derive(Clone, Copy, Debug)]
pub struct Look {
    /// Scene step.
    pub step: usize,
    /// Circle to which it is limited: centre and radius, metres.
    pub near: Option<(Vec2, f64)>,
    /// Most entries per list.
    pub most: usize,
    /// Whether it includes lanes, signals and crosswalks.
    pub with_map: bool,
}

impl Look {
    /// Only the road users at a step.
    pub fn brief(step: usize) -> Self {
        Self { step, near: None, most: 40, with_map: false }
    }

    fn shows(&self, place: Vec2) -> bool {
        self.near.is_none_or(|(centre, radius_m)| (place - centre).norm() <= radius_m)
    }
}

/// The step at which generations usually begin: the first.
pub fn first_step(scene: &Scene) -> usize {
    let there = |step: &usize| scene.agents.iter().any(|agent| agent.state_at(*step).is_some());
    (0..scene.time.steps).find(there).unwrap_or(0)
}

/// The description. `graph` belongs to the scene's map.
pub fn words(scene: &Scene, graph: &LaneGraph, look: Look) -> String {
    let mut text = head(scene);
    text.push_str(&road_users(scene, graph, &look));
    if look.with_map {
        text.push_str(&lanes(scene, graph, &look));
        text.push_str(&lights(scene, &look));
        text.push_str(&places(scene, &look));
    }
    text
}

fn head(scene: &Scene) -> String {
    let (map, steps) = (&scene.map, scene.time.steps);
    let mut text = String::new();
    let _ = writeln!(
        text,
        "\"{}\": {} steps of {STEP_S} s, {:.1} s; {} road users; {} lanes, {} crosswalks, {} stop signs, {} lights.",
        scene.name,
        steps,
        (steps - 1) as f64 * STEP_S,
        scene.agents.len(),
        map.lanes.len(),
        map.crosswalks.len(),
        map.stop_signs.len(),
        scene.signals.len()
    );
    let points = map.outlines().flat_map(|(line, _)| line);
    let bounds = points.fold(None, |known: Option<(Vec2, Vec2)>, point| {
        let (least, most) = known.unwrap_or((*point, *point));
        Some((least.inf(point), most.sup(point)))
    });
    if let Some((least, most)) = bounds {
        let _ = writeln!(
            text,
            "The map spans x {:.0} to {:.0} m, y {:.0} to {:.0} m.",
            least.x, most.x, least.y, most.y
        );
    }
    if let Some(licence) = scene.licence() {
        let _ = writeln!(text, "Licence: {licence}.");
    }
    text
}

/// A list with a heading; entries beyond `most` are only counted.
fn list(heading: &str, lines: Vec<String>, most: usize) -> String {
    let mut text = format!("{heading} ({}):\n", lines.len());
    let more = lines.len().saturating_sub(most);
    for line in lines.iter().take(most) {
        let _ = writeln!(text, "  {line}");
    }
    if more > 0 {
        let _ = writeln!(text, "  {more} more; near keeps to a circle");
    }
    text
}

fn road_users(scene: &Scene, graph: &LaneGraph, look: &Look) -> String {
    let mut lines = Vec::new();
    for agent in &scene.agents {
        let shown = scene.shown(agent);
        let Some(state) = shown.track.at(look.step).filter(|state| look.shows(state.position())) else {
            continue;
        };
        lines.push(road_user(scene, graph, agent, state));
    }
    let time_s = look.step as f64 * STEP_S;
    list(&format!("Road users at {time_s:.1} s"), lines, look.most)
}

fn road_user(scene: &Scene, graph: &LaneGraph, agent: &Agent, state: &State) -> String {
    let shown = scene.shown(agent);
    let kind = word(&agent.subtype).filter(|word| word != "unknown").or_else(|| word(&shown.agent_type));
    let mut text = format!("{}: {}", agent.id, kind.unwrap_or_default());
    if let Some(role) = &agent.role {
        let _ = write!(text, " ({role})");
    }
    let _ = write!(text, " at {}, {:.1} m/s", pose(state.position(), state.heading_rad), state.speed_mps());
    let hits = graph.nearest_for(state.position(), ON_LANE_M, shown.agent_type);
    let own = hits.iter().find(|hit| wrap_angle(hit.heading_rad - state.heading_rad).abs() < ALONG_RAD);
    if let Some((hit, lane)) = own.and_then(|hit| Some((hit, scene.map.lanes.get(hit.lane)?))) {
        let length_m = graph.lanes()[hit.lane].path.length_m();
        let _ = write!(text, ", lane {} at {:.0} of {length_m:.0} m", lane.id, hit.s_m);
    }
    let _ = write!(text, ", {:.1} x {:.1} m", shown.size.length_m, shown.size.width_m);
    let conditions = &agent.conditions;
    if let Some(relation) = &conditions.relation {
        let _ = write!(text, "; goal relative to {}", relation.to);
    }
    text.push_str(&goal(&conditions.goal));
    for via in &conditions.via {
        let _ = write!(text, "; passes ({:.1}, {:.1})", via.position.x, via.position.y);
    }
    let sample = scene.generated.as_ref().and_then(|made| made.samples.get(made.chosen_sample));
    if let Some(futures) = sample.and_then(|sample| sample.agents.get(&agent.id)) {
        let _ = write!(text, "; future: {}", tell::of_one(None, futures));
    }
    text
}

fn goal(goal: &Goal) -> String {
    let mut parts = Vec::new();
    parts.extend(goal.position.map(|place| format!("({:.1}, {:.1})", place.x, place.y)));
    parts.extend(goal.heading_rad.map(|heading| format!("heading {heading:.2} rad")));
    parts.extend(goal.speed_mps.map(|speed| format!("{speed:.1} m/s")));
    parts.extend(goal.time_s.map(|time| format!("at {time:.1} s")));
    if parts.is_empty() { String::new() } else { format!("; goal {}", parts.join(", ")) }
}

fn pose(place: Vec2, heading_rad: f64) -> String {
    let eighth = (heading_rad / FRAC_PI_4).round().rem_euclid(8.0) as usize;
    let point = COMPASS.get(eighth).copied().unwrap_or(COMPASS[0]);
    format!("({:.1}, {:.1}) heading {heading_rad:.2} rad ({point})", place.x, place.y)
}

fn lanes(scene: &Scene, graph: &LaneGraph, look: &Look) -> String {
    let mut lines = Vec::new();
    // The first lanes of the graph are those of the map.
    for (lane, found) in scene.map.lanes.iter().zip(graph.lanes()) {
        if lane.points.xy.iter().any(|point| look.shows(*point)) {
            lines.push(lane_words(scene, &lane.id, found));
        }
    }
    list("Lanes", lines, look.most)
}

fn lane_words(scene: &Scene, id: &str, lane: &GraphLane) -> String {
    let (first, last) = (lane.path.first(), lane.path.last());
    let mut text = format!(
        "{id}: {}, from {} to {}, {:.0} m long, limit {:.1} m/s",
        word(&lane.lane_type).unwrap_or_default(),
        pose(first.position, first.heading_rad),
        pose(last.position, last.heading_rad),
        lane.path.length_m(),
        lane.speed_limit_mps
    );
    let ids = |lanes: &mut dyn Iterator<Item = usize>| {
        let ids: Vec<&str> =
            lanes.filter_map(|i| scene.map.lanes.get(i)).map(|lane| lane.id.as_str()).collect();
        ids.join(", ")
    };
    let sides = [
        ("goes on as", ids(&mut lane.successors.iter().copied())),
        ("left of it", ids(&mut lane.left.iter().map(|beside| beside.lane))),
        ("right of it", ids(&mut lane.right.iter().map(|beside| beside.lane))),
    ];
    for (what, ids) in sides.iter().filter(|(_, ids)| !ids.is_empty()) {
        let _ = write!(text, "; {what} {ids}");
    }
    if let Some(at_m) = lane.stop_sign_m {
        let _ = write!(text, "; stop sign at {at_m:.0} m");
    }
    text
}

fn lights(scene: &Scene, look: &Look) -> String {
    let mut lines = Vec::new();
    for signal in &scene.signals {
        let lane = scene.map.lanes.iter().find(|lane| lane.id == signal.lane);
        let place = signal.stop.or_else(|| lane?.points.xy.first().copied());
        if !place.is_none_or(|place| look.shows(place)) {
            continue;
        }
        let run = |(first, state): &(usize, scene::SignalState)| {
            let from_s = *first as f64 * STEP_S;
            format!("{} from {from_s:.1} s", word(state).unwrap_or_default())
        };
        let runs: Vec<String> = signal.runs.iter().take(12).map(run).collect();
        lines.push(format!("{}: {}", signal.lane, runs.join(", ")));
    }
    list("Lights by lane", lines, look.most)
}

fn places(scene: &Scene, look: &Look) -> String {
    let mut lines = Vec::new();
    for crosswalk in &scene.map.crosswalks {
        let ring = &crosswalk.polygon.xy;
        let sum = ring.iter().fold(Vec2::zeros(), |sum, point| sum + point);
        let middle = sum / ring.len().max(1) as f64;
        if look.shows(middle) {
            lines.push(format!("{}: middle ({:.1}, {:.1})", crosswalk.id, middle.x, middle.y));
        }
    }
    list("Crosswalks", lines, look.most)
}

/// The name of a value in documents, with spaces.
fn word(value: &impl serde::Serialize) -> Option<String> {
    Some(serde_json::to_value(value).ok()?.as_str()?.replace('_', " "))
}
