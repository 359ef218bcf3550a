//! Writes a scene as a scenario, in the frame of its source.

use super::document::{Document, Light, Lights, Metadata, Object, Point, Prediction, Road};
use super::format::Flavour;
use super::import::{FIRST_EDGE, FIRST_LINE};
use crate::format::{EGO, ExportOptions, Exported};
use crate::loss::{Loss, code};
use crate::numbers::Numbers;
use crate::unwritten;
use scene::geometry::rotate;
use scene::map::{Area, LaneType, Points, ROAD_EDGE_TYPES, ROAD_LINE_TYPES};
use scene::{Agent, AgentType, Origin, Scene, Shown, Signal, Subtype, Vec2, wrap_angle};
use std::collections::{BTreeSet, HashMap};
use std::io;

/// Value of steps at which a road user was not seen.
const UNSEEN: f64 = -10_000.0;

/// Writes a scene.
///
/// # Errors
/// Those of JSON, which has no NaN or infinite numbers.
pub(super) fn write(scene: &Scene, options: &ExportOptions, flavour: Flavour) -> io::Result<Exported> {
    let mut losses = BTreeSet::new();
    let frame = SourceFrame { origin: &scene.meta.origin, flat: flavour == Flavour::Nocturne };
    let (shown, steps) = options.motion.all(scene);
    losses.extend(unwritten::length(scene, steps));
    let mut ids = Numbers::of(scene.agents.iter().map(|agent| &agent.id));
    let numbers: Vec<i64> = scene.agents.iter().map(|agent| ids.take(&agent.id)).collect();
    let (roads, lanes, renumbered) = roads(scene, frame);
    let index: HashMap<&str, usize> =
        scene.agents.iter().enumerate().map(|(i, agent)| (agent.id.as_str(), i)).collect();
    let at = |id: &String| index.get(id.as_str()).copied();
    let ego = scene.agents.iter().position(|agent| agent.role.as_deref() == Some(EGO));
    let metadata = Metadata {
        sdc_track_index: ego.map(|ego| ego as i64),
        objects_of_interest: scene
            .meta
            .objects_of_interest
            .iter()
            .filter_map(|id| numbers.get(at(id)?).copied())
            .collect(),
        tracks_to_predict: (scene.meta.tracks_to_predict.iter())
            .filter_map(|(id, difficulty)| {
                Some(Prediction { track_index: at(id)? as i64, difficulty: *difficulty })
            })
            .collect(),
    };
    let id = scene.meta.source_id.clone().or_else(|| scene.id.clone()).unwrap_or_else(|| scene.name.clone());
    let full = flavour == Flavour::GpuDrive;
    let objects = scene.agents.iter().zip(&shown).zip(&numbers);
    let document = Document {
        name: scene.name.clone(),
        scenario_id: full.then(|| id.clone()),
        objects: objects.map(|((agent, shown), id)| object(agent, shown, *id, steps, frame)).collect(),
        roads,
        tl_states: Lights(lights(&scene.signals, &lanes, steps, frame)),
        metadata: full.then_some(metadata),
    };
    tell(scene, options, full, renumbered || ids.renumbered, &mut losses);
    let bytes = serde_json::to_vec(&document).map_err(io::Error::other)?;
    Ok(Exported { bytes, losses: losses.into_iter().collect() })
}

/// Converts positions and directions to the source's frame.
#[derive(Clone, Copy)]
struct SourceFrame<'a> {
    origin: &'a Origin,
    /// Whether to omit heights, ids and kinds of map elements, and to write headings in degrees.
    flat: bool,
}

impl SourceFrame<'_> {
    fn turn(self, v: Vec2) -> Vec2 {
        if self.origin.rotation_rad == 0.0 { v } else { rotate(v, self.origin.rotation_rad) }
    }

    fn point(self, p: Vec2, z_m: Option<f64>) -> Point {
        let p = self.turn(p) + Vec2::new(self.origin.x_m, self.origin.y_m);
        let z = (!self.flat).then(|| z_m.unwrap_or(0.0) + self.origin.z_m);
        Point { x: p.x, y: p.y, z }
    }

    fn points(self, points: &Points) -> Vec<Point> {
        let height = |i: usize| points.z_m.as_ref().and_then(|z| z.get(i)).copied();
        points.xy.iter().enumerate().map(|(i, p)| self.point(*p, height(i))).collect()
    }

    fn heading(self, heading_rad: f64) -> f64 {
        let heading = wrap_angle(heading_rad + self.origin.rotation_rad);
        if self.flat { heading.to_degrees() } else { heading }
    }
}

fn object(agent: &Agent, shown: &Shown<'_>, id: i64, steps: usize, frame: SourceFrame<'_>) -> Object {
    let unseen = Point { x: UNSEEN, y: UNSEEN, z: (!frame.flat).then_some(UNSEEN) };
    let plane = Point { z: None, ..unseen };
    let height = |step: usize| {
        let slot = step.checked_sub(agent.track.first_step)?;
        agent.track.z_m.as_ref()?.get(slot).copied()
    };
    let states: Vec<_> = (0..steps).map(|step| shown.track.at(step)).collect();
    let at = |step: usize| states[step].map(|s| frame.point(s.position(), height(step)));
    let velocity = |s: &scene::State| {
        let v = frame.turn(s.velocity());
        Point { x: v.x, y: v.y, z: None }
    };
    let last = (0..steps).rev().find_map(at);
    Object {
        position: (0..steps).map(|step| at(step).unwrap_or(unseen)).collect(),
        width: shown.size.width_m,
        length: shown.size.length_m,
        height: shown.size.height_m.filter(|_| !frame.flat),
        heading: states.iter().map(|s| s.map_or(UNSEEN, |s| frame.heading(s.heading_rad))).collect(),
        velocity: states.iter().map(|s| s.map_or(plane, velocity)).collect(),
        valid: states.iter().map(Option::is_some).collect(),
        goal: Some(last.unwrap_or(unseen)),
        kind: match shown.agent_type {
            AgentType::Vehicle => "vehicle",
            AgentType::Pedestrian => "pedestrian",
            AgentType::Cyclist => "cyclist",
            AgentType::Other => "other",
        }
        .to_owned(),
        id: (!frame.flat).then_some(id),
        mark_as_expert: (!frame.flat).then_some(false),
    }
}

/// The map, the numbers of its lanes, and whether some elements got numbers other than their ids.
fn roads(scene: &Scene, frame: SourceFrame<'_>) -> (Vec<Road>, HashMap<String, i64>, bool) {
    let map = &scene.map;
    let lines = || map.road_lines.iter().chain(&map.road_edges);
    let areas = || map.crosswalks.iter().chain(&map.speed_bumps).chain(&map.driveways);
    let ids = map.lanes.iter().map(|lane| &lane.id).chain(lines().map(|line| &line.id));
    let ids = ids.chain(areas().map(|area| &area.id)).chain(map.stop_signs.iter().map(|sign| &sign.id));
    let mut numbers = Numbers::of(ids);
    let mut roads = Vec::new();
    let mut push = |id: i64, kind: &str, element: i64, geometry: Vec<Point>| {
        roads.push(Road {
            geometry,
            kind: kind.to_owned(),
            map_element_id: (!frame.flat).then_some(element),
            id: (!frame.flat).then_some(id),
        });
    };
    let mut lanes = HashMap::new();
    for lane in &map.lanes {
        let element = match lane.lane_type {
            LaneType::Freeway => 1,
            LaneType::SurfaceStreet => 2,
            LaneType::BikeLane => 3,
            LaneType::Undefined | LaneType::BusLane | LaneType::Sidewalk | LaneType::Parking => 0,
        };
        let id = numbers.take(&lane.id);
        lanes.insert(lane.id.clone(), id);
        push(id, "lane", element, frame.points(&lane.points));
    }
    let place =
        |words: &[&str], word: &str| words.iter().position(|known| *known == word).unwrap_or(0) as i64;
    for line in &map.road_lines {
        let element = FIRST_LINE + place(&ROAD_LINE_TYPES, &line.line_type);
        push(numbers.take(&line.id), "road_line", element, frame.points(&line.points));
    }
    for edge in &map.road_edges {
        let element = FIRST_EDGE + place(ROAD_EDGE_TYPES.get(..3).unwrap_or_default(), &edge.line_type);
        push(numbers.take(&edge.id), "road_edge", element, frame.points(&edge.points));
    }
    for sign in &map.stop_signs {
        push(numbers.take(&sign.id), "stop_sign", 17, vec![frame.point(sign.position, sign.z_m)]);
    }
    let areas: [(&str, i64, &[Area]); 3] = [
        ("crosswalk", 18, &map.crosswalks),
        ("speed_bump", 19, &map.speed_bumps),
        ("driveway", 20, &map.driveways),
    ];
    for (kind, element, list) in areas {
        for area in list {
            push(numbers.take(&area.id), kind, element, frame.points(&area.polygon));
        }
    }
    (roads, lanes, numbers.renumbered)
}

/// Lights by their lane; each lane has at most one.
fn lights(
    signals: &[Signal],
    lanes: &HashMap<String, i64>,
    steps: usize,
    frame: SourceFrame<'_>,
) -> Vec<(String, Light)> {
    let mut lights: Vec<(String, Light)> = Vec::new();
    for signal in signals {
        let Some(id) = lanes.get(&signal.lane) else { continue };
        let lane = id.to_string();
        if lights.iter().any(|(known, _)| *known == lane) {
            continue;
        }
        let word = |step: usize| {
            let word = serde_json::to_value(signal.at(step)).ok();
            word.and_then(|word| word.as_str().map(str::to_owned)).unwrap_or_default()
        };
        let stop = signal.stop.map(|stop| frame.point(stop, signal.stop_z_m));
        let each = |of: fn(Point) -> Option<f64>| match stop.and_then(of) {
            Some(number) => vec![number; steps],
            None => Vec::new(),
        };
        let light = Light {
            state: (0..steps).map(word).collect(),
            x: each(|p| Some(p.x)),
            y: each(|p| Some(p.y)),
            z: each(|p| p.z),
            time_index: (0..steps).collect(),
            lane_id: if frame.flat { Vec::new() } else { vec![*id; steps] },
        };
        lights.push((lane, light));
    }
    lights
}

fn tell(scene: &Scene, options: &ExportOptions, full: bool, renumbered: bool, losses: &mut BTreeSet<Loss>) {
    let (map, agents, meta) = (&scene.map, &scene.agents, &scene.meta);
    let linked = map.lanes.iter().any(|lane| {
        let lists = [&lane.predecessors, &lane.successors];
        let beside = [&lane.left_neighbors, &lane.right_neighbors];
        let sides = [&lane.left_boundary, &lane.right_boundary];
        lane.interpolating
            || lists.iter().any(|list| !list.is_empty())
            || beside.iter().any(|list| !list.is_empty())
            || sides.iter().any(|list| !list.is_empty())
    });
    let signs = map.stop_signs.iter().any(|sign| !sign.lanes.is_empty());
    let foreign = |t: LaneType| matches!(t, LaneType::BusLane | LaneType::Sidewalk | LaneType::Parking);
    let untyped = map.lanes.iter().any(|lane| foreign(lane.lane_type) || !full)
        || map.road_edges.iter().any(|edge| edge.line_type == "sidewalk")
        || !(full || map.road_lines.is_empty() && map.road_edges.is_empty());
    let known: BTreeSet<&str> = scene.signals.iter().map(|signal| signal.lane.as_str()).collect();
    let lost_lights =
        known.len() < scene.signals.len() || known.iter().any(|lane| map.lane_index(lane).is_none());
    let heights = agents.iter().any(|agent| agent.track.z_m.is_none())
        || map.lanes.iter().any(|l| l.points.z_m.is_none());
    let flat = agents.iter().any(|agent| agent.track.z_m.is_some())
        || map.lanes.iter().any(|l| l.points.z_m.is_some());
    let egos = agents.iter().filter(|a| a.role.as_deref() == Some(EGO)).count();
    let others = agents.iter().any(|a| a.role.as_deref().is_some_and(|role| role != EGO));
    let noted = !meta.tags.is_empty()
        || !meta.notes.is_empty()
        || meta.parent_id.is_some()
        || !scene.extra.is_empty();
    let asked = !(full || meta.objects_of_interest.is_empty() && meta.tracks_to_predict.is_empty());
    let guessed = usize::from(scene.time.steps == 91) * 10;
    let all = [
        (
            linked || signs,
            code::NO_LANE_GRAPH,
            "which lane follows which or lies beside it, lines that bound lanes, lanes of stop signs",
        ),
        (map.lanes.iter().any(|l| l.width_m.is_some()), code::NO_LANE_WIDTH, "widths of lanes"),
        (map.lanes.iter().any(|l| l.speed_limit_mps.is_some()), code::NO_SPEED_LIMITS, "speed limits"),
        (untyped, code::NO_LANE_TYPE, "types of lanes, lines and edges that the format has no number for"),
        (!map.drivable.is_empty(), code::NO_DRIVABLE, "drivable areas"),
        (lost_lights, code::NO_SIGNALS, "signals of no lane, and all but one of each lane"),
        (
            !full && !known.is_empty(),
            code::NO_SIGNALS,
            "which lanes signals are for: lanes have no ids there",
        ),
        (
            if full { heights } else { flat },
            code::NO_Z,
            if full { "unknown heights become zero" } else { "heights" },
        ),
        (!full && agents.iter().any(|a| a.size.height_m.is_some()), code::NO_SIZES, "heights of boxes"),
        (agents.iter().any(|a| a.subtype != Subtype::Unknown), code::NO_SUBTYPE, "finer kinds such as truck"),
        (if full { egos > 1 || others } else { egos > 0 || others }, code::NO_ROLES, "roles"),
        (scene.licence().is_some(), code::NO_LICENCE, "the file has no place for a licence"),
        (noted || asked, code::NO_NOTES, "tags, notes, what was to be predicted, members of other tools"),
        (
            meta.timestamps_s.is_some() || scene.time.now_step != guessed,
            code::NO_TIMING,
            "the present step, times of the recording",
        ),
        (
            renumbered,
            code::IDS_RENUMBERED,
            "ids that are no whole numbers above zero, or not unique, got new ones",
        ),
        (!(full || agents.is_empty() && map.lanes.is_empty()), code::NO_IDS, "ids"),
        (!full && meta.source_id.is_some(), code::NO_NOTES, "the id in its source"),
    ];
    losses.extend(
        all.into_iter().filter(|(there, ..)| *there).map(|(_, code, detail)| Loss::new(code, detail)),
    );
    losses.extend(unwritten::conditions(scene, options.motion));
    losses.extend(unwritten::futures(scene, options.motion));
}
