//! One HTML page that plays the scene in any browser, without server or network.

use crate::format::{
    ExportOptions, Exported, ExportedMotion, Format, ImportOptions, Info, Scenes, one_scene, written_only,
};
use crate::loss::{Loss, code};
use crate::source::Source;
use scene::map::{Area, LaneType, TypedLine};
use scene::{Agent, Conditions, STEP_S, Scene, Shown, Signal, State, Vec2};
use serde_json::{Value, json};
use std::io;

const PAGE: &str = include_str!("page.html");
const STYLE: &str = include_str!("page.css");
const PLAYER: &str = include_str!("player.js");

/// A scene as a page that plays it.
pub struct Page;

impl Format for Page {
    fn info(&self) -> Info {
        Info {
            id: "html",
            name: "Interactive page (HTML)",
            media_type: "text/html",
            extensions: &["html"],
            import: false,
            export: true,
            many: false,
            takes_net: false,
            notes: "The scene as it plays, with names and signals; the page needs no server and no network.",
            loses: &[
                code::NO_CONDITIONS,
                code::NO_MODES,
                code::NO_NOTES,
                code::NO_JUDGEMENTS,
                code::NO_LANE_GRAPH,
            ],
        }
    }

    fn scenes<'a>(&'a self, _: &'a dyn Source, _: &'a ImportOptions) -> Scenes<'a> {
        written_only(&self.info())
    }

    fn export(&self, scenes: &[&Scene], options: &ExportOptions) -> io::Result<Exported> {
        let scene = one_scene(scenes)?;
        // Placeholders are replaced in one pass, because the name of a scene may look like one.
        let (head, rest) = PAGE.split_once("{{name}}").unwrap_or((PAGE, ""));
        let (before_style, rest) = rest.split_once("{{style}}").unwrap_or((rest, ""));
        let (before_scene, rest) = rest.split_once("{{scene}}").unwrap_or((rest, ""));
        let (before_player, foot) = rest.split_once("{{player}}").unwrap_or((rest, ""));
        let name = if scene.name.is_empty() { "Scene" } else { &scene.name };
        // `<` is escaped, so that no text in the script looks like markup.
        let data = played(scene, options.motion).to_string().replace('<', "\\u003c");
        let parts =
            [head, &escaped(name), before_style, STYLE, before_scene, &data, before_player, PLAYER, foot];
        Ok(Exported { bytes: parts.concat().into_bytes(), losses: lost(scene, options.motion) })
    }
}

/// Text as HTML.
fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

/// Rounds to centimetres, which is enough for a picture.
fn short(value: f64) -> f64 {
    (value * 1e2).round() / 1e2 + 0.0
}

/// Coordinates of points as x, y, x, y and so on.
fn flat<'a>(points: impl IntoIterator<Item = &'a Vec2>) -> Vec<f64> {
    points.into_iter().flat_map(|p| [short(p.x), short(p.y)]).collect()
}

/// The scene as JSON for the player of the page.
fn played(scene: &Scene, motion: ExportedMotion) -> Value {
    let (tracks, steps) = motion.all(scene);
    let map = &scene.map;
    let areas = |list: &[Area]| -> Vec<Vec<Vec<f64>>> {
        let rings = |area: &Area| {
            std::iter::once(&area.polygon).chain(&area.holes).map(|ring| flat(&ring.xy)).collect()
        };
        list.iter().map(rings).collect()
    };
    let lines = |list: &[TypedLine]| -> Vec<Value> {
        list.iter().map(|line| json!([line.line_type, flat(&line.points.xy)])).collect()
    };
    let lanes: Vec<Value> = map
        .lanes
        .iter()
        .map(|lane| {
            let kind = match lane.lane_type {
                // Within a junction, a cycle lane is drawn like the road.
                LaneType::BikeLane if !lane.interpolating => "bike",
                LaneType::Sidewalk => "walk",
                _ => "road",
            };
            json!([kind, short(lane.width_or_assumed_m()), flat(&lane.points.xy)])
        })
        .collect();
    let agents = scene.agents.iter().zip(&tracks);
    json!({
        "name": scene.name,
        "licence": scene.licence(),
        "step_s": STEP_S,
        "steps": steps,
        "map": {
            "lanes": lanes,
            "lines": lines(&map.road_lines),
            "edges": lines(&map.road_edges),
            "crosswalks": areas(&map.crosswalks),
            "driveways": areas(&map.driveways),
            "drivable": areas(&map.drivable),
            "stops": map.stop_signs.iter().map(|sign| flat([&sign.position])).collect::<Vec<_>>(),
        },
        "signals": scene.signals.iter().filter_map(|signal| signal_of(scene, signal)).collect::<Vec<_>>(),
        "agents": agents.map(|(agent, shown)| agent_of(scene, agent, shown)).collect::<Vec<_>>(),
    })
}

fn signal_of(scene: &Scene, signal: &Signal) -> Option<Value> {
    let at = signal.stop.or_else(|| {
        let lane = scene.map.lane_index(&signal.lane)?;
        scene.map.lanes[lane].points.xy.last().copied()
    })?;
    let runs: Vec<Value> = signal.runs.iter().map(|(step, state)| json!([step, state])).collect();
    Some(json!({"at": flat([&at]), "runs": runs}))
}

fn agent_of(scene: &Scene, agent: &Agent, shown: &Shown<'_>) -> Value {
    let future = scene.generated.as_ref().and_then(|generated| generated.chosen_future(&agent.id));
    let column = |of: fn(&State) -> f64, digits: f64| -> Vec<Option<f64>> {
        let value = |state: &State| (of(state) * digits).round() / digits + 0.0;
        shown.track.states.iter().map(|state| state.as_ref().map(value)).collect()
    };
    json!({
        "id": agent.id,
        "role": agent.role,
        "type": shown.agent_type,
        "size": [short(shown.size.length_m), short(shown.size.width_m)],
        "generated_from": future.map(|future| future.first_step),
        "goal": agent.conditions.goal.position.map(|goal| flat([&goal])),
        "first": shown.track.first_step,
        "x": column(|s| s.x_m, 1e2),
        "y": column(|s| s.y_m, 1e2),
        "heading": column(|s| s.heading_rad, 1e3),
        "speed": column(|s| s.speed_mps(), 1e2),
    })
}

fn lost(scene: &Scene, motion: ExportedMotion) -> Vec<Loss> {
    let generated = scene.generated.is_some();
    let samples = || scene.generated.iter().flat_map(|generated| &generated.samples);
    let further =
        samples().count() > 1 || samples().flat_map(|s| s.agents.values()).any(|f| f.modes.len() > 1);
    let rest = |agent: &Agent| {
        let mut rest = agent.conditions.clone();
        rest.goal.position = None;
        rest != Conditions::default()
    };
    let meta = &scene.meta;
    let noted = !meta.tags.is_empty() || !meta.notes.is_empty() || !scene.extra.is_empty();
    let all = [
        (scene.agents.iter().any(rest), code::NO_CONDITIONS, "what the user fixed, but for places of goals"),
        (
            !scene.map.lanes.is_empty(),
            code::NO_LANE_GRAPH,
            "which lanes follow each other: the page is a picture",
        ),
        (
            generated && (motion == ExportedMotion::Log || further),
            code::NO_MODES,
            "generated futures other than the exported one",
        ),
        (generated, code::NO_JUDGEMENTS, "probabilities, faults, relations and reactions"),
        (noted, code::NO_NOTES, "tags, notes and members of other tools"),
    ];
    all.into_iter().filter(|(there, ..)| *there).map(|(_, code, detail)| Loss::new(code, detail)).collect()
}
