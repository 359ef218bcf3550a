//! The whole scene and its validity checks.

use crate::geometry::crowding::Crowding;
use crate::message::Message;
use crate::sentences::{self, wanted, what};
use crate::{
    Agent, AgentId, AgentType, ContentHash, Generated, HORIZON_STEPS, LaneMap, Shared, Signal, Vec2, relation,
};
use serde::Serialize;
use std::collections::HashSet;

/// Most agents a scene may hold.
pub const MAX_AGENTS: usize = 256;
/// Most characters of a scene's name.
pub const MAX_NAME_CHARS: usize = 200;
/// Most characters of its notes.
pub const MAX_NOTES_CHARS: usize = 10_000;
/// Most steps a scene may span.
pub const MAX_STEPS: usize = 600;
/// Most map polylines.
pub const MAX_POLYLINES: usize = 20_000;
/// Most map points in all.
pub const MAX_MAP_POINTS: usize = 400_000;
/// Most corners of all areas of a map.
pub const MAX_AREA_CORNERS: usize = 250_000;
/// Most successors, predecessors or stop signs' lanes of a lane, and most stretches beside a lane.
pub const MAX_LANE_LINKS: usize = 64;
/// Most links of a map's lanes in total: to other lanes, to lines beside them, and of stop signs.
pub const MAX_MAP_LINKS: usize = 200_000;
/// Most points in one polyline.
pub const MAX_POLYLINE_POINTS: usize = 4_096;
/// Most signals.
pub const MAX_SIGNALS: usize = 512;
/// Greatest coordinate, metres.
pub const MAX_COORDINATE_M: f64 = 10_000.0;

/// Number of stretches of a lane's side that count as one link.
const BOUNDARIES_A_LINK: usize = 4;

/// The motion of an agent before the start, as far as an answer depends on it.
#[derive(Serialize)]
#[serde(untagged)]
enum Before {
    /// Hash of the recording.
    Recorded(ContentHash),
    /// A single state, for an agent that was placed there.
    Put { step: usize, position: Vec2, heading_rad: f64, speed_mps: f64 },
}

impl Before {
    fn of(agent: &Agent) -> Self {
        let mut steps = agent.track.valid_steps();
        let lone = steps.next().filter(|_| steps.next().is_none());
        let Some((step, state)) = lone.and_then(|step| Some((step, agent.track.at(step)?))) else {
            return Self::Recorded(agent.track.hash());
        };
        let fixed = &agent.conditions.start;
        Self::Put {
            step,
            position: fixed.position.unwrap_or_else(|| state.position()),
            heading_rad: fixed.heading_rad.unwrap_or(state.heading_rad),
            speed_mps: fixed.speed_mps.unwrap_or_else(|| state.speed_mps()),
        }
    }
}

/// Position of the scene in its source's frame: `source = rotate(scene, rotation) + (x, y, z)`.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
#[allow(missing_docs, reason = "the names say it")]
pub struct Origin {
    pub x_m: f64,
    pub y_m: f64,
    pub z_m: f64,
    pub rotation_rad: f64,
    /// Coordinate reference system of the source, if it has one.
    pub crs: Option<String>,
}

/// Origin of a scene, and its description.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
#[allow(missing_docs, reason = "the names say it")]
pub struct Meta {
    /// Format or tool, such as `womd`, `drawn`, `synthetic`.
    pub source: String,
    pub source_id: Option<String>,
    /// Licence of the content, such as `waymo-nc` or `cc0`.
    pub licence: Option<String>,
    pub origin: Origin,
    pub parent_id: Option<String>,
    pub tags: Vec<String>,
    pub notes: String,
    pub created_with: Option<String>,
    /// WOMD's `objects_of_interest`, by agent id.
    pub objects_of_interest: Vec<AgentId>,
    /// WOMD's `tracks_to_predict`: agent id and difficulty.
    pub tracks_to_predict: Vec<(AgentId, u32)>,
    /// Source times of the steps in seconds, if they are not exactly 0.1 s apart from zero.
    pub timestamps_s: Option<Vec<f64>>,
}

/// Steps of the scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Timing {
    /// Number of steps of the scene, 1 ..= [`MAX_STEPS`].
    pub steps: usize,
    /// The source's "current" step, kept for export.
    pub now_step: usize,
}

/// A traffic scene.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[allow(missing_docs, reason = "the names say it")]
pub struct Scene {
    pub id: Option<String>,
    pub name: String,
    pub meta: Meta,
    pub time: Timing,
    pub map: Shared<LaneMap>,
    pub signals: Vec<Signal>,
    pub agents: Vec<Agent>,
    pub generated: Option<Generated>,
    /// Members under `x_` keys that other tools wrote; preserved unchanged.
    pub extra: std::collections::BTreeMap<String, serde_json::Value>,
}

/// Why values do not form a scene. `at` is a JSON pointer into the native form.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{at}: {message}")]
pub struct SceneError {
    /// JSON pointer to the value.
    pub at: String,
    /// Machine-readable code: `out-of-range`, `duplicate`, `too-many-agents`, `map-too-large`,
    /// `map-too-complex`, `invalid-field`.
    pub code: &'static str,
    /// What was found and what was expected.
    pub message: Message,
}

impl SceneError {
    /// A problem at a JSON pointer.
    pub fn new(at: impl Into<String>, code: &'static str, message: Message) -> Self {
        Self { at: at.into(), code, message }
    }
}

impl Scene {
    /// Road users on a map for one window from the first step on, without anything else.
    pub fn bare(name: &str, map: LaneMap, agents: Vec<Agent>) -> Self {
        Self {
            id: None,
            name: name.to_owned(),
            meta: Meta::default(),
            time: Timing { steps: HORIZON_STEPS + 1, now_step: 0 },
            map: map.into(),
            signals: Vec::new(),
            agents,
            generated: None,
            extra: std::collections::BTreeMap::new(),
        }
    }

    /// Checks everything that the types cannot guarantee. Scenes enter the program only through this
    /// function.
    ///
    /// # Errors
    /// Up to 32 problems, each with its place: counts over their limits, coordinates that are not finite or
    /// out of bounds, duplicate ids, lanes with fewer than two points, tracks and runs beyond the scene's
    /// steps.
    pub fn checked(self) -> Result<Self, Vec<SceneError>> {
        let mut problems = Vec::new();
        self.check_words(&mut problems);
        self.check_time(&mut problems);
        self.check_map(&mut problems);
        self.check_complexity(&mut problems);
        self.check_signals(&mut problems);
        self.check_agents(&mut problems);
        problems.truncate(32);
        if problems.is_empty() { Ok(self) } else { Err(problems) }
    }

    /// Licence of the scene including its futures: the stricter of the two.
    pub fn licence(&self) -> Option<String> {
        let generated = self.generated.as_ref().and_then(|generated| generated.licence.as_deref());
        crate::licence::strictest(self.meta.licence.as_deref().into_iter().chain(generated))
    }

    /// The agent with this id.
    pub fn agent(&self, id: &str) -> Option<&Agent> {
        self.agents.iter().find(|a| a.id == id)
    }

    /// Agents by type: vehicles, pedestrians, cyclists, others.
    pub fn counts(&self) -> [usize; 4] {
        let count = |t| self.agents.iter().filter(|a| a.agent_type == t).count();
        [
            count(AgentType::Vehicle),
            count(AgentType::Pedestrian),
            count(AgentType::Cyclist),
            count(AgentType::Other),
        ]
    }

    /// Hash of the user's part: everything that determines an answer, without the generated futures, the id
    /// and the name. Map and recordings enter by their own hashes, which clones of the scene share. A
    /// condition replaces the value below it, so a scene with conditions passed separately has the hash of
    /// the scene that contains them.
    pub fn input_hash(&self) -> ContentHash {
        let agents: Vec<_> = self
            .agents
            .iter()
            .map(|a| (&a.id, a.agent_type, a.subtype, a.shown_size(), Before::of(a), &a.conditions))
            .collect();
        ContentHash::of(&(self.time, self.map.hash(), &self.signals, agents))
    }

    fn check_words(&self, problems: &mut Vec<SceneError>) {
        let words =
            [("/name", &self.name, MAX_NAME_CHARS), ("/meta/notes", &self.meta.notes, MAX_NOTES_CHARS)];
        for (at, text, most) in words {
            let count = text.chars().count();
            if count > most {
                let message = sentences::at_most(count, what::CHARACTERS, most);
                problems.push(SceneError::new(at, "out-of-range", message));
            }
        }
    }

    fn check_time(&self, problems: &mut Vec<SceneError>) {
        if self.time.steps == 0 || self.time.steps > MAX_STEPS {
            let message = sentences::out_of_range(self.time.steps as f64, 1.0, MAX_STEPS as f64);
            problems.push(SceneError::new("/time/steps", "out-of-range", message));
        }
        let last_step = self.time.steps.max(1) - 1;
        if self.time.now_step > last_step {
            let message = sentences::out_of_range(self.time.now_step as f64, 0.0, last_step as f64);
            problems.push(SceneError::new("/time/now_step", "out-of-range", message));
        }
    }

    fn check_map(&self, problems: &mut Vec<SceneError>) {
        let map = &*self.map;
        let lines = [("road_lines", &map.road_lines), ("road_edges", &map.road_edges)];
        let areas = [
            ("crosswalks", &map.crosswalks),
            ("speed_bumps", &map.speed_bumps),
            ("driveways", &map.driveways),
            ("drivable", &map.drivable),
        ];
        let mut total = (0usize, 0usize);
        let mut polyline = |at: String, points: &[Vec2], least: usize, problems: &mut Vec<SceneError>| {
            total = (total.0 + 1, total.1 + points.len());
            check_points(&at, points, least, problems);
        };
        for (i, lane) in map.lanes.iter().enumerate() {
            polyline(format!("/map/lanes/{i}/points_m"), &lane.points.xy, 2, problems);
            let bad_width = lane.width_m.is_some_and(|w| !(0.1..=50.0).contains(&w));
            let bad_limit = lane.speed_limit_mps.is_some_and(|v| !(0.0..=100.0).contains(&v));
            if bad_width || bad_limit {
                let message = sentences::expected(wanted::LANE_RANGES);
                problems.push(SceneError::new(format!("/map/lanes/{i}"), "out-of-range", message));
            }
        }
        for (kind, list) in lines {
            for (i, line) in list.iter().enumerate() {
                polyline(format!("/map/{kind}/{i}/points_m"), &line.points.xy, 1, problems);
            }
        }
        for (kind, list) in areas {
            for (i, area) in list.iter().enumerate() {
                polyline(format!("/map/{kind}/{i}/polygon_m"), &area.polygon.xy, 1, problems);
                for (h, hole) in area.holes.iter().enumerate() {
                    polyline(format!("/map/{kind}/{i}/holes_m/{h}"), &hole.xy, 1, problems);
                }
            }
        }
        total.0 += map.stop_signs.len();
        for (i, sign) in map.stop_signs.iter().enumerate() {
            check_points(&format!("/map/stop_signs/{i}/position_m"), &[sign.position], 1, problems);
        }
        if total.0 > MAX_POLYLINES || total.1 > MAX_MAP_POINTS {
            let message = sentences::map_over_limit(total.0, total.1, MAX_POLYLINES, MAX_MAP_POINTS);
            problems.push(SceneError::new("/map", "map-too-large", message));
        }
        let lane_ids = map.lanes.iter().map(|l| &l.id);
        check_ids("/map/lanes", lane_ids, problems);
        for (kind, list) in lines {
            check_ids(&format!("/map/{kind}"), list.iter().map(|l| &l.id), problems);
        }
        for (kind, list) in areas {
            check_ids(&format!("/map/{kind}"), list.iter().map(|a| &a.id), problems);
        }
    }

    /// Limits the cost drivers of work on the map other than its size: links, corners of areas, overlapping
    /// lines.
    fn check_complexity(&self, problems: &mut Vec<SceneError>) {
        let map = &*self.map;
        let mut links = 0;
        let mut check = |at: &dyn Fn() -> String, count: usize, problems: &mut Vec<SceneError>| {
            links += count;
            if count > MAX_LANE_LINKS {
                let message = sentences::at_most(count, what::LINKS, MAX_LANE_LINKS);
                problems.push(SceneError::new(at(), "map-too-complex", message));
            }
        };
        for (i, lane) in map.lanes.iter().enumerate() {
            let beside = lane.left_neighbors.iter().chain(&lane.right_neighbors);
            let between = beside.clone().map(|neighbor| neighbor.boundaries.len());
            let lists = [
                ("successors", lane.successors.len()),
                ("predecessors", lane.predecessors.len()),
                ("left_neighbors", lane.left_neighbors.len()),
                ("right_neighbors", lane.right_neighbors.len()),
            ];
            for (name, count) in lists {
                check(&|| format!("/map/lanes/{i}/{name}"), count, problems);
            }
            let lists = [
                ("left_boundary", lane.left_boundary.len()),
                ("right_boundary", lane.right_boundary.len()),
                ("neighbors", between.sum()),
            ];
            for (name, count) in lists {
                // A line may bound a lane from point to point.
                check(&|| format!("/map/lanes/{i}/{name}"), count.div_ceil(BOUNDARIES_A_LINK), problems);
            }
        }
        for (i, sign) in map.stop_signs.iter().enumerate() {
            check(&|| format!("/map/stop_signs/{i}/lanes"), sign.lanes.len(), problems);
        }
        if links > MAX_MAP_LINKS {
            let message = sentences::at_most(links, what::LANE_LINKS, MAX_MAP_LINKS);
            problems.push(SceneError::new("/map/lanes", "map-too-complex", message));
        }
        let rings = map.outlines().filter(|(_, closed)| *closed);
        let corners: usize = rings.map(|(ring, _)| ring.len()).sum();
        if corners > MAX_AREA_CORNERS {
            let message = sentences::at_most(corners, what::AREA_CORNERS, MAX_AREA_CORNERS);
            problems.push(SceneError::new("/map", "map-too-complex", message));
        }
        // Only if all coordinates are finite and within their bounds.
        if problems.is_empty()
            && let Some(message) = Crowding::of(map.outlines()).excess()
        {
            problems.push(SceneError::new("/map", "map-too-complex", message));
        }
    }

    fn check_signals(&self, problems: &mut Vec<SceneError>) {
        if self.signals.len() > MAX_SIGNALS {
            let message = sentences::at_most(self.signals.len(), what::SIGNALS, MAX_SIGNALS);
            problems.push(SceneError::new("/signals", "map-too-large", message));
        }
        for (i, signal) in self.signals.iter().enumerate() {
            let rising = signal.runs.windows(2).all(|w| w[0].0 < w[1].0);
            let inside = signal.runs.last().is_some_and(|r| r.0 < self.time.steps);
            if !rising || !inside {
                let message = sentences::expected(wanted::RUNS);
                problems.push(SceneError::new(format!("/signals/{i}/states"), "invalid-field", message));
            }
            if let Some(stop) = signal.stop {
                check_points(&format!("/signals/{i}/stop_m"), &[stop], 1, problems);
            }
        }
    }

    fn check_agents(&self, problems: &mut Vec<SceneError>) {
        if self.agents.len() > MAX_AGENTS {
            let message = sentences::agents_over_limit(self.agents.len(), MAX_AGENTS);
            problems.push(SceneError::new("/agents", "too-many-agents", message));
        }
        check_ids("/agents", self.agents.iter().map(|a| &a.id), problems);
        for (i, message) in relation::faults(&self.agents) {
            let at = format!("/agents/{i}/conditions/goal/relation/to");
            problems.push(SceneError::new(at, "invalid-field", message));
        }
        for (i, agent) in self.agents.iter().enumerate() {
            let size = [agent.size.length_m, agent.size.width_m];
            if size.iter().any(|v| !(0.05..=60.0).contains(v))
                || agent.size.height_m.is_some_and(|h| !(0.0..=60.0).contains(&h))
            {
                let found = format!("{} m x {} m", size[0], size[1]);
                let message = sentences::outside(&found, "0.05 m", "60 m");
                problems.push(SceneError::new(format!("/agents/{i}/length_m"), "out-of-range", message));
            }
            let track = &agent.track;
            let end = track.first_step + track.states.len();
            if end > self.time.steps {
                let message = sentences::track_beyond_scene(end, self.time.steps);
                problems.push(SceneError::new(format!("/agents/{i}/track"), "invalid-field", message));
            }
            for k in agent.conditions.unknown_edges(&self.map) {
                let at = format!("/agents/{i}/conditions/goal/may_cross/{k}");
                problems.push(SceneError::new(at, "invalid-field", sentences::expected(wanted::ROAD_EDGE)));
            }
            if track.z_m.as_ref().is_some_and(|z| z.len() != track.states.len()) {
                let message = sentences::expected(wanted::AS_LONG_AS_X);
                problems.push(SceneError::new(format!("/agents/{i}/track/z_m"), "invalid-field", message));
            }
            let bad = track.states.iter().flatten().position(|s| {
                let far = s.x_m.abs() > MAX_COORDINATE_M || s.y_m.abs() > MAX_COORDINATE_M;
                let values = [s.x_m, s.y_m, s.heading_rad, s.vx_mps, s.vy_mps];
                far || values.iter().any(|v| !v.is_finite()) || s.velocity().norm() > 150.0
            });
            if let Some(step) = bad {
                let message = sentences::state_expected(step, wanted::STATE_RANGES);
                problems.push(SceneError::new(format!("/agents/{i}/track"), "out-of-range", message));
            }
        }
    }
}

fn check_points(at: &str, points: &[Vec2], least: usize, problems: &mut Vec<SceneError>) {
    if points.len() < least || points.len() > MAX_POLYLINE_POINTS {
        let message = sentences::points_out_of_range(points.len(), least, MAX_POLYLINE_POINTS);
        let code = if points.len() < least { "invalid-field" } else { "map-too-large" };
        problems.push(SceneError::new(at, code, message));
    }
    let out = |p: &Vec2| !(p.x.abs() <= MAX_COORDINATE_M && p.y.abs() <= MAX_COORDINATE_M);
    if let Some(i) = points.iter().position(out) {
        let found = format!("({}, {})", points[i].x, points[i].y);
        let message = sentences::found_expected(found, wanted::COORDINATES);
        problems.push(SceneError::new(format!("{at}/{i}"), "out-of-range", message));
    }
}

fn check_ids<'a>(at: &str, ids: impl Iterator<Item = &'a String>, problems: &mut Vec<SceneError>) {
    let mut seen = HashSet::new();
    for (i, id) in ids.enumerate() {
        let legal = |c: char| c.is_ascii_alphanumeric() || "_.:-".contains(c);
        if id.is_empty() || id.len() > 64 || !id.chars().all(legal) {
            let message = sentences::expected(wanted::ID_CHARACTERS);
            problems.push(SceneError::new(format!("{at}/{i}/id"), "invalid-field", message));
        } else if !seen.insert(id) {
            let message = sentences::appears_twice(what::ID, id);
            problems.push(SceneError::new(format!("{at}/{i}/id"), "duplicate", message));
        }
        if problems.len() > 64 {
            return;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::map::{Area, Lane, Points, StopSign};
    use crate::{Size, State, Subtype};

    fn scene_of(agent: Agent) -> Scene {
        Scene::bare("one", LaneMap::default(), vec![agent])
    }

    fn put_at(x_m: f64) -> Agent {
        let mut agent =
            Agent::bare("1", AgentType::Vehicle, Subtype::Car, vec![Some(State { x_m, ..State::default() })]);
        let start = &mut agent.conditions.start;
        (start.position, start.heading_rad, start.speed_mps) =
            (Some(Vec2::new(7.0, 0.0)), Some(0.0), Some(5.0));
        (agent.conditions.length_m, agent.conditions.width_m) = (Some(4.0), Some(1.8));
        agent
    }

    #[test]
    fn who_was_put_somewhere_is_known_by_what_is_fixed_wherever_it_was_before() {
        let moved = scene_of(put_at(7.0)).input_hash();
        assert_eq!(scene_of(put_at(3.0)).input_hash(), moved);
        let sized = Agent { size: Size { length_m: 4.0, width_m: 1.8, ..put_at(7.0).size }, ..put_at(7.0) };
        assert_eq!(scene_of(sized).input_hash(), moved);
        let mut elsewhere = put_at(7.0);
        elsewhere.conditions.start.position = Some(Vec2::new(8.0, 0.0));
        assert_ne!(scene_of(elsewhere).input_hash(), moved);
        let mut free = put_at(3.0);
        free.conditions.start.heading_rad = None;
        assert_ne!(scene_of(free).input_hash(), moved, "a free field is what lies below it");
    }

    #[test]
    fn a_recording_counts_whatever_is_fixed() {
        let recorded = |x_m: f64| {
            let states =
                vec![Some(State { x_m, ..State::default() }), Some(State { x_m: 9.0, ..State::default() })];
            Agent { track: crate::Track { first_step: 0, states, z_m: None }.into(), ..put_at(0.0) }
        };
        assert_ne!(scene_of(recorded(1.0)).input_hash(), scene_of(recorded(2.0)).input_hash());
    }

    fn refused(map: LaneMap) -> Option<(String, &'static str)> {
        let problems = Scene { map: map.into(), ..scene_of(put_at(0.0)) }.checked().err()?;
        problems.into_iter().next().map(|problem| (problem.at, problem.code))
    }

    fn street(i: usize, y_m: f64) -> Lane {
        Lane::street(i.to_string(), vec![Vec2::new(0.0, y_m), Vec2::new(1.0, y_m)])
    }

    #[test]
    fn links_of_lanes_and_signs_are_bounded_each_and_in_all() {
        let ids = |count: usize| (0..count).map(|i| i.to_string()).collect::<Vec<_>>();
        let lane = |links: usize| Lane { successors: ids(links), ..street(0, 0.0) };
        assert_eq!(refused(LaneMap { lanes: vec![lane(MAX_LANE_LINKS)], ..LaneMap::default() }), None);
        let too_many = refused(LaneMap { lanes: vec![lane(MAX_LANE_LINKS + 1)], ..LaneMap::default() });
        assert_eq!(too_many, Some(("/map/lanes/0/successors".into(), "map-too-complex")));
        let sign = |i: usize, links: usize| StopSign {
            id: i.to_string(),
            position: Vec2::zeros(),
            z_m: None,
            lanes: ids(links),
        };
        let signs = |count: usize, links: usize| {
            let stop_signs = (0..count).map(|i| sign(i, links)).collect();
            refused(LaneMap { stop_signs, ..LaneMap::default() })
        };
        assert_eq!(signs(1, MAX_LANE_LINKS + 1).unwrap().1, "map-too-complex");
        assert_eq!(signs(MAX_MAP_LINKS / 50, 50), None);
        assert_eq!(signs(MAX_MAP_LINKS / 50 + 1, 50), Some(("/map/lanes".into(), "map-too-complex")));
        assert_eq!(signs(MAX_POLYLINES + 1, 0), Some(("/map".into(), "map-too-large")));
    }

    #[test]
    fn corners_of_areas_and_lines_over_each_other_are_bounded() {
        let ring = |corners: usize| {
            let corner = |i: usize| {
                crate::geometry::direction(i as f64 / corners as f64 * std::f64::consts::TAU) * 3_000.0
            };
            Points::from((0..corners).map(corner).collect::<Vec<_>>())
        };
        let area = |holes: usize| Area {
            id: "a".into(),
            polygon: ring(4_000),
            holes: (0..holes).map(|_| ring(4_000)).collect(),
        };
        let with = |holes: usize| refused(LaneMap { driveways: vec![area(holes)], ..LaneMap::default() });
        assert_eq!((with(61), with(62)), (None, Some(("/map".into(), "map-too-complex"))));
        let lanes = |count: usize, apart_m: f64| {
            let lanes = (0..count).map(|i| street(i, apart_m * i as f64)).collect();
            refused(LaneMap { lanes, ..LaneMap::default() })
        };
        assert_eq!(lanes(5_000, 0.5), None);
        assert_eq!(lanes(10_000, 0.0), Some(("/map".into(), "map-too-complex")));
    }
}
