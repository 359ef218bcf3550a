//! Memory of scenes and maps in bytes, by which caches are limited. It counts every part that a client can
//! make long.

use scene::map::{Boundary, Lane, LaneMap, Neighbor, Points};
use scene::{Agent, Generated, Scene, Signal, State};
use serde_json::Value;
use std::mem::size_of;

/// Bytes of a text besides its letters, including the allocator's.
const TEXT: usize = 40;
/// Bytes of a map entry besides key and value.
const ENTRY: usize = 32;

fn text(text: &str) -> usize {
    TEXT + text.len()
}

fn texts<'a>(list: impl IntoIterator<Item = &'a String>) -> usize {
    list.into_iter().map(|entry| text(entry)).sum()
}

/// Bytes of a list, including what each entry allocates.
fn list<T>(list: &[T], beside: impl Fn(&T) -> usize) -> usize {
    TEXT + list.iter().map(|entry| size_of::<T>() + beside(entry)).sum::<usize>()
}

fn plain<T>(entries: &[T]) -> usize {
    list(entries, |_| 0)
}

/// Bytes of a value.
pub fn of_value(given: &Value) -> usize {
    size_of::<Value>()
        + match given {
            Value::Null | Value::Bool(_) | Value::Number(_) => 0,
            Value::String(letters) => text(letters),
            Value::Array(items) => TEXT + items.iter().map(of_value).sum::<usize>(),
            Value::Object(members) => {
                members.iter().map(|(key, own)| ENTRY + text(key) + of_value(own)).sum()
            }
        }
}

fn points(line: &Points) -> usize {
    plain(&line.xy) + line.z_m.as_deref().map_or(0, plain)
}

fn boundary(boundary: &Boundary) -> usize {
    text(&boundary.line)
}

fn neighbor(neighbor: &Neighbor) -> usize {
    text(&neighbor.lane) + list(&neighbor.boundaries, boundary)
}

fn lane(lane: &Lane) -> usize {
    let sides = [&lane.left_boundary, &lane.right_boundary].map(|side| list(side, boundary));
    let beside = [&lane.left_neighbors, &lane.right_neighbors].map(|side| list(side, neighbor));
    let links = texts(&lane.predecessors) + texts(&lane.successors);
    text(&lane.id) + points(&lane.points) + links + sides.iter().chain(&beside).sum::<usize>()
}

/// Bytes of a map.
pub fn of_map(map: &LaneMap) -> usize {
    let lines = [&map.road_lines, &map.road_edges]
        .map(|lines| list(lines, |line| text(&line.id) + text(&line.line_type) + points(&line.points)));
    let areas: usize =
        map.areas().map(|area| text(&area.id) + points(&area.polygon) + list(&area.holes, points)).sum();
    let signs = list(&map.stop_signs, |sign| text(&sign.id) + texts(&sign.lanes));
    list(&map.lanes, lane) + lines.iter().sum::<usize>() + areas + signs
}

fn agent(agent: &Agent) -> usize {
    let conditions = plain(&agent.conditions.via) + texts(&agent.conditions.may_cross);
    let words = text(&agent.id) + texts(&agent.role);
    words + plain(&agent.track.states) + agent.track.z_m.as_deref().map_or(0, plain) + conditions
}

fn signal(signal: &Signal) -> usize {
    text(&signal.lane) + plain(&signal.runs)
}

fn generated(generated: &Generated) -> usize {
    let futures = generated.samples.iter().flat_map(|sample| &sample.agents);
    let modes =
        futures.map(|(id, future)| ENTRY + text(id) + list(&future.modes, |mode| plain(&mode.states)));
    let scores: usize = generated.samples.iter().map(|sample| of_value(&sample.score)).sum();
    let weights: usize = generated.weights.iter().map(|(name, hash)| ENTRY + text(name) + text(hash)).sum();
    let words = texts([&generated.input_sha256, &generated.created_at]) + texts(&generated.licence);
    modes.sum::<usize>() + scores + weights + words + of_value(&generated.request)
}

/// Bytes of a scene.
pub fn of_scene(scene: &Scene) -> usize {
    let meta = &scene.meta;
    let words = texts(&meta.tags)
        + texts(&meta.objects_of_interest)
        + meta.tracks_to_predict.iter().map(|(id, _)| text(id)).sum::<usize>()
        + texts([&scene.name, &meta.notes, &meta.source])
        + texts(
            [&scene.id, &meta.source_id, &meta.licence, &meta.parent_id, &meta.created_with]
                .into_iter()
                .flatten(),
        )
        + texts(&meta.origin.crs)
        + meta.timestamps_s.as_deref().map_or(0, plain);
    let extra: usize = scene.extra.iter().map(|(key, own)| ENTRY + text(key) + of_value(own)).sum();
    let moving = list(&scene.agents, agent) + list(&scene.signals, signal);
    let made = scene.generated.as_ref().map_or(0, generated);
    size_of::<Scene>() + of_map(&scene.map) + moving + made + words + extra
}

/// Bytes of an open scene, including the cached scores of its motion.
pub fn of_open(scene: &Scene) -> usize {
    let states: usize = scene.agents.iter().map(|agent| agent.track.states.len()).sum();
    of_scene(scene) + 4 * states * size_of::<Option<State>>()
}

#[cfg(test)]
mod tests {
    use super::*;
    use scene::map::StopSign;
    use scene::{AgentType, LaneMap, Subtype, Vec2};
    use serde_json::json;

    #[test]
    fn whatever_a_client_makes_long_counts() {
        let bare = || {
            let agent = Agent::bare("1", AgentType::Vehicle, Subtype::Car, vec![Some(State::default())]);
            let map =
                LaneMap { lanes: vec![Lane::street("1", vec![Vec2::zeros(); 2])], ..LaneMap::default() };
            Scene::bare("", map, vec![agent])
        };
        let small = of_open(&bare());
        assert!(small < 4_096, "{small}");
        let grown: [fn(&mut Scene); 14] = [
            |scene| scene.agents[0].role = Some("x".repeat(8_000)),
            |scene| scene.meta.origin.crs = Some("x".repeat(8_000)),
            |scene| scene.meta.created_with = Some("x".repeat(8_000)),
            |scene| {
                let sample = scene::Sample { score: json!(vec!["letters"; 1_000]), ..Default::default() };
                scene.generated = Some(Generated { samples: vec![sample], ..Default::default() });
            },
            |scene| drop(scene.extra.insert("x_a".into(), json!(vec!["letters"; 1_000]))),
            |scene| scene.meta.notes = "x".repeat(8_000),
            |scene| scene.meta.tags = vec![String::new(); 1_000],
            |scene| scene.meta.timestamps_s = Some(vec![0.0; 1_000]),
            |scene| scene.map.lanes[0].points.xy = vec![Vec2::zeros(); 1_000],
            |scene| scene.map.lanes[0].points.z_m = Some(vec![0.0; 1_000]),
            |scene| scene.map.lanes[0].successors = vec![String::new(); 1_000],
            |scene| {
                let sign = StopSign { id: "s".into(), position: Vec2::zeros(), z_m: None, lanes: Vec::new() };
                scene.map.stop_signs = vec![sign; 1_000];
            },
            |scene| scene.agents[0].track.states = vec![Some(State::default()); 1_000],
            |scene| {
                scene.signals = vec![Signal { runs: vec![(0, scene::SignalState::Go); 1_000], ..light() }]
            },
        ];
        for (i, grow) in grown.iter().enumerate() {
            let mut scene = bare();
            grow(&mut scene);
            assert!(of_open(&scene) >= small + 8_000, "{i}: {} and {small}", of_open(&scene));
        }
    }

    fn light() -> Signal {
        Signal { lane: "1".into(), runs: Vec::new(), stop: None, stop_z_m: None }
    }
}
