//! Content of messages: entities of `foxglove.SceneUpdate`, in metres of the scene.

use super::time;
use scene::map::{Area, LaneMap};
use scene::{Agent, AgentType, Scene, Shown, Size, State, Subtype, Vec2};
use serde::{Serialize, Serializer};
use serde_json::{Value, json};

/// The frame of all entities.
const FRAME: &str = "scene";
/// Type of lines in `foxglove.LinePrimitive`.
const STRIP: u8 = 0;
const LOOP: u8 = 1;
/// Deletes all entities of a topic.
const ALL: u8 = 1;

/// Transform from the scene to its source.
pub(super) fn transform(scene: &Scene) -> Value {
    let origin = &scene.meta.origin;
    json!({
        "timestamp": time(0),
        "parent_frame_id": "source",
        "child_frame_id": FRAME,
        "translation": {"x": origin.x_m, "y": origin.y_m, "z": origin.z_m},
        "rotation": turn(origin.rotation_rad),
    })
}

/// A rotation about the vertical axis.
fn turn(angle_rad: f64) -> Value {
    let (sin, cos) = (angle_rad / 2.0).sin_cos();
    json!({"x": 0.0, "y": 0.0, "z": sin, "w": cos})
}

fn pose(p: Vec2, z_m: f64, heading_rad: f64) -> Value {
    json!({"position": {"x": p.x, "y": p.y, "z": z_m}, "orientation": turn(heading_rad)})
}

fn colour([r, g, b]: [u8; 3], a: f64) -> Value {
    let part = |value: u8| (f64::from(value) / 255.0 * 1e3).round() / 1e3;
    json!({"r": part(r), "g": part(g), "b": part(b), "a": a})
}

/// Message of a topic: what it shows from a step on.
#[derive(Serialize)]
pub(super) struct SceneUpdate<'a> {
    deletions: [Value; 1],
    entities: Vec<SceneEntity<'a>>,
}

/// An object with its primitives.
#[derive(Serialize)]
struct SceneEntity<'a> {
    timestamp: Value,
    frame_id: &'static str,
    id: String,
    lifetime: Value,
    frame_locked: bool,
    metadata: Vec<Value>,
    #[serde(flatten)]
    primitives: Primitives<'a>,
}

/// Primitives by kind; those of a kind that is not used are empty.
#[derive(Default, Serialize)]
struct Primitives<'a> {
    arrows: [Value; 0],
    cubes: Vec<Value>,
    spheres: Vec<Value>,
    cylinders: Vec<Value>,
    lines: Vec<LinePrimitive<'a>>,
    triangles: [Value; 0],
    texts: Vec<Value>,
    models: [Value; 0],
}

/// `foxglove.LinePrimitive`. Its points are written from the map: a tree of values for each takes 30 times
/// their memory.
#[derive(Serialize)]
struct LinePrimitive<'a> {
    r#type: u8,
    pose: Value,
    thickness: f64,
    scale_invariant: bool,
    #[serde(serialize_with = "on_the_ground")]
    points: &'a [Vec2],
    color: Value,
    colors: [Value; 0],
    indices: [u32; 0],
}

fn on_the_ground<S: Serializer>(points: &[Vec2], serializer: S) -> Result<S::Ok, S::Error> {
    #[derive(Serialize)]
    struct Point {
        x: f64,
        y: f64,
        z: f64,
    }
    serializer.collect_seq(points.iter().map(|p| Point { x: p.x, y: p.y, z: 0.0 }))
}

fn entity(
    id: impl Into<String>,
    step: usize,
    primitives: Primitives<'_>,
    metadata: Vec<Value>,
) -> SceneEntity<'_> {
    SceneEntity {
        timestamp: time(step),
        frame_id: FRAME,
        id: id.into(),
        lifetime: json!({"sec": 0, "nsec": 0}),
        frame_locked: false,
        metadata,
        primitives,
    }
}

fn update(step: usize, entities: Vec<SceneEntity<'_>>) -> SceneUpdate<'_> {
    SceneUpdate { deletions: [json!({"timestamp": time(step), "type": ALL, "id": ""})], entities }
}

fn line(points: &[Vec2], closed: bool, width_m: f64, colour: Value) -> LinePrimitive<'_> {
    LinePrimitive {
        r#type: if closed { LOOP } else { STRIP },
        pose: pose(Vec2::zeros(), 0.0, 0.0),
        thickness: width_m,
        scale_invariant: false,
        points,
        color: colour,
        colors: [],
        indices: [],
    }
}

/// The road: an entity for each kind of line.
pub(super) fn map(map: &LaneMap) -> SceneUpdate<'_> {
    fn areas(list: &[Area], shade: [u8; 3]) -> Vec<LinePrimitive<'_>> {
        list.iter().map(|area| line(&area.polygon.xy, true, 0.2, colour(shade, 1.0))).collect()
    }
    let lanes =
        map.lanes.iter().map(|lane| line(&lane.points.xy, false, 0.1, colour([0x86, 0x8e, 0x98], 0.6)));
    let paint = map.road_lines.iter().map(|painted| {
        let yellow = painted.line_type.contains("yellow");
        let shade = if yellow { [0xd7, 0x9a, 0x00] } else { [0xff, 0xff, 0xff] };
        line(&painted.points.xy, false, 0.14, colour(shade, 1.0))
    });
    let edges =
        map.road_edges.iter().map(|edge| line(&edge.points.xy, false, 0.24, colour([0x83, 0x8b, 0x95], 1.0)));
    let stops = map.stop_signs.iter().map(|sign| {
        json!({
            "pose": pose(sign.position, 1.0, 0.0),
            "size": {"x": 0.6, "y": 0.6, "z": 2.0},
            "color": colour([0xc3, 0x16, 0x2b], 1.0),
            "bottom_scale": 1.0,
            "top_scale": 1.0,
        })
    });
    let lines: [(&str, Vec<LinePrimitive<'_>>); 5] = [
        ("lanes", lanes.collect()),
        ("road_lines", paint.collect()),
        ("road_edges", edges.collect()),
        ("crosswalks", areas(&map.crosswalks, [0xff, 0xff, 0xff])),
        ("drivable", areas(&map.drivable, [0xb4, 0xba, 0xc2])),
    ];
    let lines = lines.into_iter().filter(|(_, list)| !list.is_empty());
    let drawn = |lines| Primitives { lines, ..Primitives::default() };
    let mut entities: Vec<SceneEntity<'_>> =
        lines.map(|(id, list)| entity(id, 0, drawn(list), Vec::new())).collect();
    let stops = Primitives { cylinders: stops.collect(), ..Primitives::default() };
    entities.push(entity("stop_signs", 0, stops, Vec::new()));
    update(0, entities)
}

/// Signal states at a step.
pub(super) fn signals(scene: &Scene, step: usize) -> SceneUpdate<'_> {
    let lit = |(i, signal): (usize, &scene::Signal)| {
        let at = signal.stop.or_else(|| {
            let lane = scene.map.lane_index(&signal.lane)?;
            scene.map.lanes[lane].points.xy.last().copied()
        })?;
        let state = signal.at(step);
        let shade = match () {
            () if state.is_stop() => [0xd3, 0x20, 0x2f],
            () if state.is_caution() => [0xe9, 0xa1, 0x00],
            () if matches!(state, scene::SignalState::Go | scene::SignalState::ArrowGo) => [0x1f, 0x9d, 0x55],
            () => [0x87, 0x94, 0xa6],
        };
        let sphere = json!({
            "pose": pose(at, 2.0, 0.0),
            "size": {"x": 1.2, "y": 1.2, "z": 1.2},
            "color": colour(shade, 1.0),
        });
        let about = vec![
            json!({"key": "lane", "value": signal.lane}),
            json!({"key": "state", "value": json!(state).as_str().unwrap_or_default()}),
        ];
        let lamp = Primitives { spheres: vec![sphere], ..Primitives::default() };
        Some(entity(format!("signal-{i}"), step, lamp, about))
    };
    update(step, scene.signals.iter().enumerate().filter_map(lit).collect())
}

/// Road users at a step.
pub(super) fn users<'a>(tracks: &[(&Agent, Shown<'_>)], step: usize) -> SceneUpdate<'a> {
    let seen = |(agent, shown): &(&Agent, Shown<'_>)| {
        let state = shown.track.at(step)?;
        let log = &agent.track;
        let heights = log.z_m.as_ref().zip(step.checked_sub(log.first_step));
        let z_m = heights.and_then(|(z, slot)| z.get(slot)).copied();
        Some(user(agent, shown, state, z_m, step))
    };
    update(step, tracks.iter().filter_map(seen).collect())
}

/// A road user as a box that stands on the ground; recorded heights are those of its centre.
fn user<'a>(
    agent: &Agent,
    shown: &Shown<'_>,
    state: &State,
    z_m: Option<f64>,
    step: usize,
) -> SceneEntity<'a> {
    let usual = Size::default_for(shown.agent_type, agent.subtype);
    let height_m = shown.size.height_m.or(usual.height_m).unwrap_or(1.7);
    let shade = match shown.agent_type {
        AgentType::Vehicle => [0x2f, 0x68, 0xd8],
        AgentType::Cyclist => [0xb8, 0x62, 0x1b],
        AgentType::Pedestrian => [0x4f, 0x1d, 0x49],
        AgentType::Other => [0x87, 0x94, 0xa6],
    };
    let middle_m = z_m.unwrap_or(height_m / 2.0);
    let cube = json!({
        "pose": pose(state.position(), middle_m, state.heading_rad),
        "size": {"x": shown.size.length_m, "y": shown.size.width_m, "z": height_m},
        "color": colour(shade, 0.9),
    });
    let name = agent.role.as_deref().unwrap_or(&agent.id);
    let text = json!({
        "pose": pose(state.position(), middle_m + height_m / 2.0 + 0.6, 0.0),
        "billboard": true,
        "font_size": 12.0,
        "scale_invariant": true,
        "color": colour([0x14, 0x18, 0x1d], 1.0),
        "text": name,
    });
    let mut about = vec![
        json!({"key": "type", "value": json!(shown.agent_type).as_str().unwrap_or_default()}),
        json!({"key": "speed_mps", "value": format!("{:.2}", state.speed_mps())}),
        json!({"key": "heading_rad", "value": format!("{:.4}", state.heading_rad)}),
    ];
    if agent.subtype != Subtype::Unknown {
        about.push(json!({"key": "subtype", "value": json!(agent.subtype).as_str().unwrap_or_default()}));
    }
    let drawn = Primitives { cubes: vec![cube], texts: vec![text], ..Primitives::default() };
    entity(agent.id.as_str(), step, drawn, about)
}
