//! Content of messages: entities of `foxglove.SceneUpdate`, in metres of the scene.

use super::time;
use scene::map::{Area, LaneMap};
use scene::{Agent, AgentType, Scene, Shown, Size, State, Subtype, Vec2};
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

/// An entity with only these primitives.
fn entity(id: &str, step: usize, primitives: &[(&str, Vec<Value>)], metadata: Vec<Value>) -> Value {
    let mut entity = json!({
        "timestamp": time(step),
        "frame_id": FRAME,
        "id": id,
        "lifetime": {"sec": 0, "nsec": 0},
        "frame_locked": false,
        "metadata": metadata,
    });
    for kind in ["arrows", "cubes", "spheres", "cylinders", "lines", "triangles", "texts", "models"] {
        let list = primitives.iter().find(|(name, _)| *name == kind);
        entity[kind] = json!(list.map(|(_, list)| list.as_slice()).unwrap_or_default());
    }
    entity
}

fn update(step: usize, entities: &[Value]) -> Value {
    json!({"deletions": [{"timestamp": time(step), "type": ALL, "id": ""}], "entities": entities})
}

fn line(points: &[Vec2], closed: bool, width_m: f64, colour: Value) -> Value {
    let points: Vec<Value> = points.iter().map(|p| json!({"x": p.x, "y": p.y, "z": 0.0})).collect();
    json!({
        "type": if closed { LOOP } else { STRIP },
        "pose": pose(Vec2::zeros(), 0.0, 0.0),
        "thickness": width_m,
        "scale_invariant": false,
        "points": points,
        "color": colour,
        "colors": [],
        "indices": [],
    })
}

/// The road: an entity for each kind of line.
pub(super) fn map(map: &LaneMap) -> Value {
    let areas = |list: &[Area], shade: [u8; 3]| -> Vec<Value> {
        list.iter().map(|area| line(&area.polygon.xy, true, 0.2, colour(shade, 1.0))).collect()
    };
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
    let lines: [(&str, Vec<Value>); 5] = [
        ("lanes", lanes.collect()),
        ("road_lines", paint.collect()),
        ("road_edges", edges.collect()),
        ("crosswalks", areas(&map.crosswalks, [0xff, 0xff, 0xff])),
        ("drivable", areas(&map.drivable, [0xb4, 0xba, 0xc2])),
    ];
    let entities = lines.into_iter().filter(|(_, list)| !list.is_empty());
    let mut entities: Vec<Value> =
        entities.map(|(id, list)| entity(id, 0, &[("lines", list)], Vec::new())).collect();
    entities.push(entity("stop_signs", 0, &[("cylinders", stops.collect())], Vec::new()));
    update(0, &entities)
}

/// Signal states at a step.
pub(super) fn signals(scene: &Scene, step: usize) -> Value {
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
        Some(entity(&format!("signal-{i}"), step, &[("spheres", vec![sphere])], about))
    };
    let entities: Vec<Value> = scene.signals.iter().enumerate().filter_map(lit).collect();
    update(step, &entities)
}

/// Road users at a step.
pub(super) fn users(tracks: &[(&Agent, Shown<'_>)], step: usize) -> Value {
    let seen = |(agent, shown): &(&Agent, Shown<'_>)| {
        let state = shown.track.at(step)?;
        let log = &agent.track;
        let heights = log.z_m.as_ref().zip(step.checked_sub(log.first_step));
        let z_m = heights.and_then(|(z, slot)| z.get(slot)).copied();
        Some(user(agent, shown, state, z_m, step))
    };
    let entities: Vec<Value> = tracks.iter().filter_map(seen).collect();
    update(step, &entities)
}

/// A road user as a box that stands on the ground; recorded heights are those of its centre.
fn user(agent: &Agent, shown: &Shown<'_>, state: &State, z_m: Option<f64>, step: usize) -> Value {
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
    entity(&agent.id, step, &[("cubes", vec![cube]), ("texts", vec![text])], about)
}
