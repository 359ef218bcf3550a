//! Reads the files of a scenario as a scene.

use super::entities::{Catalogs, Entity, entry};
use super::files::ScenarioFiles;
use super::lights::LightControllers;
use super::motion::{MAX_POSES, MotionReader, Move, TracePose, When, deepest, named, when};
use super::parameters::{Scope, attribute, number};
use super::places::{Pose, ScenarioPlaces};
use super::unread::Unread;
use crate::format::{ImportOptions, MAP_TIMING, NET_POINTER, NOW_STEP, Scenes, one};
use crate::frame::Frame;
use crate::limits::{MAX_SIGNALS, MAX_STEPS};
use crate::map_file::MapRead;
use crate::opendrive::import::read_with_roads;
use crate::problem::{FieldProblem, ImportWarning, ReadError, code};
use crate::recording::{RecordedAgent, RecordedState, Recording, Said};
use crate::refusals::{self, tag, what};
use crate::sentences;
use crate::source::Source;
use crate::tree::XmlNode;
use crate::xml::{Scanner, XmlEvent};
use scene::geometry::{direction, rotate};
use scene::{Meta, STEP_S, Timing, Vec2, wrap_angle};
use std::collections::{BTreeMap, HashMap};

/// Most bytes of one tag.
const MAX_TAG: usize = 64 << 10;
/// Most road users, and entries of catalogs.
const MAX_ENTITIES: usize = 4_096;
const MAX_ENTRIES: usize = 4_096;
/// Elements whose children are read one by one.
const CONTAINERS: [&str; 8] =
    ["OpenSCENARIO", "OpenScenario", "Entities", "Storyboard", "Init", "Actions", "Story", "Act"];
/// Text about units in files of this program, after the name.
const OWN_WORDS: &str = ". Metres, radians";
/// Longest time between two poses that is interpolated, seconds.
const LONGEST_S: f64 = 60.0;
/// A pose within this time of a sample is that sample, seconds.
const SAME_S: f64 = 1e-3;

/// The scenes of a scenario.
pub(crate) fn scenes<'a>(file: &'a dyn Source, options: &'a ImportOptions) -> Scenes<'a> {
    match read(file, options) {
        Ok(recording) => Box::new(recording.scenes().skip(options.skip).take(options.max_scenes)),
        Err(error) => one(Err(error)),
    }
}

fn read(file: &dyn Source, options: &ImportOptions) -> Result<Recording, ReadError> {
    let files = ScenarioFiles::read(file)?;
    let mut catalogs = Catalogs::new();
    let mut scenario = None;
    for (name, text) in &files.texts {
        if !catalog(text, &mut catalogs)? && scenario.is_none() {
            scenario = Some((name, text));
        }
    }
    let Some((_, text)) = scenario else {
        return Err(ReadError::other_content(refusals::file_has_no(what::ROAD_USER)));
    };
    let mut reader = OpenScenarioReader::new(&files, options, catalogs);
    reader.read(text)?;
    reader.finish()
}

/// Adds the entries of a file of catalogs. False for another file.
fn catalog(text: &[u8], to: &mut Catalogs) -> Result<bool, ReadError> {
    let mut scanner = Scanner::new(text, MAX_TAG).with_texts();
    let (mut depth, mut name) = (0, None);
    while let Some(event) = scanner.next()? {
        match event {
            XmlEvent::Start(element) if depth == 2 && name.is_some() => {
                let node = XmlNode::read(&mut scanner, element)?;
                let key = (name.clone().unwrap_or_default(), attribute(&node, "name").to_owned());
                to.insert(key, node);
                if to.len() > MAX_ENTRIES {
                    let message = refusals::more_than(MAX_ENTRIES, what::ENTRIES);
                    return Err(FieldProblem::new("", code::OUT_OF_RANGE, message).into());
                }
            }
            XmlEvent::Start(element) => {
                depth += 1;
                if element.name == "Catalog" && depth == 2 {
                    name = Some(element.get("name").unwrap_or_default().to_owned());
                } else if matches!(element.name.as_str(), "Entities" | "Storyboard") {
                    return Ok(false);
                }
            }
            XmlEvent::End => depth -= 1,
            XmlEvent::Text(_) => {}
        }
    }
    Ok(name.is_some())
}

/// Moves of an act, each with its own time, until the start of the act is known.
type ActMoves = Vec<(String, Option<f64>, Move)>;

struct OpenScenarioReader<'a> {
    files: &'a ScenarioFiles,
    options: &'a ImportOptions,
    catalogs: Catalogs,
    unread: Unread,
    said: Said,
    /// Parameters of the scenario and of the open story.
    scope: Scope,
    story: Scope,
    places: ScenarioPlaces,
    /// Signal controllers, and the place of their list.
    controllers: LightControllers,
    controllers_at: String,
    entities: Vec<Entity>,
    /// Initial positions that depend on another road user's.
    waiting: Vec<(String, XmlNode, String)>,
    speeds_mps: HashMap<String, f64>,
    follows: BTreeMap<String, Vec<TracePose>>,
    leaves: HashMap<String, f64>,
    poses: usize,
    /// Poses of actions, including those of acts that have not ended.
    told: usize,
    act: ActMoves,
    act_start: Option<When>,
    end_s: Option<f64>,
    /// Frame of the map in its source.
    frame: Option<Frame>,
}

impl<'a> OpenScenarioReader<'a> {
    fn new(files: &'a ScenarioFiles, options: &'a ImportOptions, catalogs: Catalogs) -> Self {
        Self {
            files,
            options,
            catalogs,
            unread: Unread::default(),
            said: Said::default(),
            scope: Scope::default(),
            story: Scope::default(),
            places: ScenarioPlaces::default(),
            controllers: LightControllers::default(),
            controllers_at: String::new(),
            entities: Vec::new(),
            waiting: Vec::new(),
            speeds_mps: HashMap::new(),
            follows: BTreeMap::new(),
            leaves: HashMap::new(),
            poses: 0,
            told: 0,
            act: ActMoves::new(),
            act_start: None,
            end_s: None,
            frame: None,
        }
    }

    fn read(&mut self, text: &[u8]) -> Result<(), ReadError> {
        let mut scanner = Scanner::new(text, MAX_TAG).with_texts();
        // Open elements, by name and by place.
        let mut open: Vec<(String, String)> = Vec::new();
        while let Some(event) = scanner.next()? {
            match event {
                XmlEvent::Start(element) if CONTAINERS.contains(&element.name.as_str()) => {
                    if open.is_empty() && !element.name.eq_ignore_ascii_case("OpenSCENARIO") {
                        let message = refusals::found_expected(tag(&element.name), "<OpenSCENARIO>");
                        return Err(ReadError::other_content(message));
                    }
                    let node = XmlNode { element, ..XmlNode::default() };
                    let place = named(open.last().map_or("", |(_, place)| place), &node);
                    open.push((node.element.name, place));
                    if open.last().is_some_and(|(name, _)| name == "Story") {
                        self.story = self.scope.clone();
                    }
                }
                XmlEvent::Start(element) => {
                    let Some((parent, place)) = open.last().cloned() else {
                        let message = refusals::found_expected(tag(&element.name), "<OpenSCENARIO>");
                        return Err(ReadError::other_content(message));
                    };
                    let node = XmlNode::read(&mut scanner, element)?;
                    self.take(&parent, &place, node)?;
                }
                XmlEvent::End => match open.pop() {
                    Some((name, _)) if name == "Init" => self.settle_places()?,
                    Some((name, place)) if name == "Act" => self.end_act(&place)?,
                    _ => {}
                },
                XmlEvent::Text(_) => {}
            }
        }
        Ok(())
    }

    fn take(&mut self, parent: &str, place: &str, mut node: XmlNode) -> Result<(), ReadError> {
        match (parent, node.name()) {
            ("OpenSCENARIO" | "OpenScenario", "ParameterDeclarations") => {
                let holder = XmlNode { children: vec![node], ..XmlNode::default() };
                self.scope = self.scope.declared(&holder, &HashMap::new())?;
                self.story = self.scope.clone();
            }
            ("Story", "ParameterDeclarations") => {
                let holder = XmlNode { children: vec![node], ..XmlNode::default() };
                self.story = self.scope.declared(&holder, &HashMap::new())?;
            }
            (_, "FileHeader") => self.header(&node),
            (_, "CatalogLocations") => {}
            (_, "RoadNetwork") => {
                self.scope.fill(&mut node);
                self.roads(&node, place)?;
            }
            ("Entities", "ScenarioObject") => self.entity(node, place)?,
            ("Actions", "Private") => {
                self.scope.fill(&mut node);
                self.initial(&node, place)?;
            }
            ("Act", "ManeuverGroup") => {
                let story = self.story.clone();
                story.fill(&mut node);
                let moves = std::mem::take(&mut self.act);
                let mut stage = self.motion(moves);
                stage.group(&node, &story, place)?;
                self.act = stage.moves;
            }
            ("Act", "StartTrigger") => {
                self.story.fill(&mut node);
                self.act_start = Some(when(&node)?);
            }
            ("Act", "StopTrigger") => {}
            ("Storyboard", "StopTrigger") => {
                self.scope.fill(&mut node);
                if let When::At(time_s) = when(&node)? {
                    self.end_s = Some(time_s);
                }
            }
            _ => self.unread.push(&deepest(place, &node)),
        }
        Ok(())
    }

    /// A reader of motion, with the moves so far.
    fn motion(&mut self, moves: ActMoves) -> MotionReader<'_> {
        MotionReader {
            places: &self.places,
            catalogs: &self.catalogs,
            unread: &mut self.unread,
            poses: &mut self.told,
            moves,
        }
    }

    fn header(&mut self, header: &XmlNode) {
        let described = attribute(header, "description");
        let name = described.split_once(OWN_WORDS).map_or(described, |(name, _)| name);
        let plain: String = name.chars().filter(|c| !c.is_control()).take(scene::MAX_NAME_CHARS).collect();
        plain.trim().clone_into(&mut self.said.name);
        let properties = header.all("Properties").flat_map(|list| list.all("Property"));
        let mut stated = Meta { source: "openscenario".into(), ..Meta::default() };
        for property in properties {
            let value = attribute(property, "value").to_owned();
            match attribute(property, "name") {
                "source" => stated.source = value,
                "source_id" => stated.source_id = Some(value),
                _ => {}
            }
        }
        let licence = header.child("License").map(|licence| attribute(licence, "name").to_owned());
        stated.licence = self.options.licence.clone().or(licence.filter(|name| !name.is_empty()));
        self.said.meta = stated;
    }

    fn roads(&mut self, network: &XmlNode, place: &str) -> Result<(), ReadError> {
        let place = named(place, network);
        for child in network.children.iter().filter(|child| child.name() != "LogicFile") {
            let way = format!("{place}/{}", child.name());
            if child.name() == "TrafficSignals" {
                self.controllers.read(child)?;
                self.controllers_at = way;
            } else if !child.children.is_empty() {
                // An empty list means nothing; models of the ground are only its appearance.
                self.unread.push(&way);
            }
        }
        let path = network.child("LogicFile").map_or("", |file| attribute(file, "filepath"));
        let read = match (self.options.net.as_ref(), self.files.map(path)) {
            (Some(net), _) => read_with_roads(net, self.options.around).map_err(|e| e.under(NET_POINTER)),
            (None, Some(map)) => read_with_roads(map, self.options.around),
            (None, None) => {
                if !path.is_empty() {
                    self.unread.push(&format!("{place}/LogicFile[{path}]"));
                }
                return Ok(());
            }
        };
        let (MapRead { map, origin, warnings, .. }, roads) = read?;
        self.said.map = map;
        // Default signal timings would contradict the motion: those of the scenario apply.
        self.said.warnings.extend(warnings.into_iter().filter(|warning| warning.code != "signals-made"));
        self.frame = Some(Frame::of(&origin));
        self.said.origin = Some(origin);
        self.places.roads = Some(roads);
        Ok(())
    }

    fn entity(&mut self, mut object: XmlNode, place: &str) -> Result<(), ReadError> {
        let place = named(place, &object);
        self.scope.fill(&mut object);
        let name = attribute(&object, "name").to_owned();
        let mut found = None;
        for child in &object.children {
            let entity = match child.name() {
                "CatalogReference" => match entry(&self.catalogs, &self.scope, child)? {
                    Some((node, _)) => Entity::of(&name, &node)?,
                    None => None,
                },
                _ => Entity::of(&name, child)?,
            };
            match entity {
                Some(entity) => found = Some(entity),
                None if child.name() == "CatalogReference" => {
                    let entry = attribute(child, "entryName");
                    self.unread.push(&format!("{place}/CatalogReference[{entry}]"));
                    // A road user whose catalog is missing is read as a default vehicle.
                    let mut vehicle = XmlNode::default();
                    vehicle.element.name = "Vehicle".into();
                    found = found.or(Entity::of(&name, &vehicle)?);
                }
                None => self.unread.push(&format!("{place}/{}", child.name())),
            }
        }
        self.entities.extend(found);
        if self.entities.len() > MAX_ENTITIES {
            let message = refusals::more_than(MAX_ENTITIES, what::ROAD_USERS);
            return Err(FieldProblem::new("", code::OUT_OF_RANGE, message).into());
        }
        Ok(())
    }

    /// Adds the initial actions of a road user.
    fn initial(&mut self, private: &XmlNode, place: &str) -> Result<(), ReadError> {
        let place = named(place, private);
        let name = attribute(private, "entityRef").to_owned();
        for action in private.all("PrivateAction") {
            let Some(inner) = action.children.first() else { continue };
            let position = inner.child("Position").filter(|_| inner.name() == "TeleportAction");
            if let Some(position) = position {
                let way = format!("{place}/PrivateAction/TeleportAction/Position");
                self.waiting.push((name.clone(), position.clone(), way));
                continue;
            }
            let speed = inner.at(&["SpeedAction", "SpeedActionTarget", "AbsoluteTargetSpeed"]);
            if let Some(speed) = speed.filter(|_| inner.name() == "LongitudinalAction") {
                self.speeds_mps.extend(number(speed, "value")?.map(|value| (name.clone(), value)));
                continue;
            }
            let follow = inner.child("FollowTrajectoryAction").filter(|_| inner.name() == "RoutingAction");
            let way = format!("{place}/PrivateAction");
            let Some(follow) = follow else {
                self.unread.push(&deepest(&way, inner));
                continue;
            };
            let way = format!("{way}/RoutingAction/FollowTrajectoryAction");
            let scope = self.scope.clone();
            if let Some(poses) = self.motion(Vec::new()).trajectory(follow, 0.0, &scope, &way)? {
                self.follow(&name, poses)?;
            }
        }
        Ok(())
    }

    /// Resolves initial positions, those relative to other road users last.
    fn settle_places(&mut self) -> Result<(), ReadError> {
        loop {
            let before = self.waiting.len();
            for (name, position, way) in std::mem::take(&mut self.waiting) {
                match self.places.of(&position)? {
                    Some(pose) => drop(self.places.entities.insert(name, pose)),
                    None => self.waiting.push((name, position, way)),
                }
            }
            if self.waiting.len() == before || self.waiting.is_empty() {
                break;
            }
        }
        for (_, position, way) in std::mem::take(&mut self.waiting) {
            let kind = position.children.first().map_or("", |kind| kind.name());
            self.unread.push(&format!("{way}/{kind}"));
        }
        Ok(())
    }

    /// Gives the moves of an act their times, or skips the whole act.
    fn end_act(&mut self, place: &str) -> Result<(), ReadError> {
        let moves = std::mem::take(&mut self.act);
        let start_s = match self.act_start.take() {
            Some(When::At(start_s)) => start_s,
            None => 0.0,
            Some(When::Unknown) => {
                self.unread.push(place);
                return Ok(());
            }
        };
        for (name, time_s, moved) in moves {
            // An event waits for its act.
            let late_s = (start_s - time_s.unwrap_or(0.0)).max(0.0);
            match moved {
                Move::Follow(poses) => self.follow(&name, poses)?,
                Move::Comes(timed) => {
                    let time_s = timed.time_s + late_s;
                    self.follow(&name, vec![TracePose { time_s, ..timed }])?;
                }
                Move::Leaves(time_s) => {
                    let first = self.leaves.entry(name).or_insert(f64::INFINITY);
                    *first = first.min(time_s + late_s);
                }
            }
        }
        Ok(())
    }

    fn follow(&mut self, name: &str, poses: Vec<TracePose>) -> Result<(), ReadError> {
        self.poses += poses.len();
        if self.poses > MAX_POSES {
            let message = refusals::more_than(MAX_POSES, what::POSITIONS);
            return Err(FieldProblem::new("", code::OUT_OF_RANGE, message).into());
        }
        self.follows.entry(name.to_owned()).or_default().extend(poses);
        Ok(())
    }

    /// The recording of all stated motion.
    fn finish(mut self) -> Result<Recording, ReadError> {
        if self.entities.is_empty() {
            return Err(ReadError::other_content(refusals::file_has_no(what::ROAD_USER)));
        }
        let frame = self.frame.unwrap_or_else(|| Frame::of(&scene::Origin::default()));
        let mut users = Vec::new();
        let mut last_s = 0.0_f64;
        for entity in std::mem::take(&mut self.entities) {
            let samples = self.samples(&entity, frame);
            last_s = samples.iter().map(|sample| sample.time_s).fold(last_s, f64::max);
            let Entity { name: id, agent_type, subtype, role, size_m, .. } = entity;
            users.push(RecordedAgent { id, agent_type, subtype, role, size_m, samples });
        }
        self.said.start_s = Some(0.0);
        self.said.spacing_s = (last_s <= 0.0).then_some(STEP_S);
        // A scenario with initial states only begins at its present; with motion it is a recording of its
        // length.
        self.said.timing = match (last_s > 0.0, self.end_s) {
            (false, _) => Some(Timing { now_step: 0, ..MAP_TIMING }),
            (true, Some(end_s)) => {
                let steps = (end_s.max(0.0) / STEP_S).round().min(1e9) as usize + 1;
                let now_step = NOW_STEP.min(steps - 1);
                (steps <= MAX_STEPS).then_some(Timing { steps, now_step })
            }
            (true, None) => None,
        };
        let steps = self.said.timing.map_or(0, |timing| timing.steps);
        let span_s = last_s.max(steps as f64 * STEP_S);
        let heads = self.places.roads.as_ref().map_or(&[][..], |roads| &roads.lights);
        let at = &self.controllers_at;
        let (lights, left_out) = self.controllers.lights(heads, span_s, at, &mut self.unread);
        self.said.lights = lights;
        let over =
            || ImportWarning::new("signals-dropped", sentences::signals_over_limit(left_out, MAX_SIGNALS));
        self.said.warnings.extend((left_out > 0).then(over));
        self.said.warnings.extend(self.unread.warning());
        Ok(Recording { said: self.said, users, futures: Vec::new() })
    }

    fn samples(&self, entity: &Entity, frame: Frame) -> Vec<RecordedState> {
        let mut poses = self.follows.get(&entity.name).cloned().unwrap_or_default();
        poses.sort_by(|a, b| a.time_s.total_cmp(&b.time_s));
        poses.dedup_by(|later, before| (later.time_s - before.time_s).abs() < SAME_S);
        let mut poses = at_steps(&poses);
        let initial = self.places.entities.get(&entity.name);
        let speed_mps = self.speeds_mps.get(&entity.name).copied();
        let begun = poses.first().is_none_or(|first| first.time_s > SAME_S);
        if let Some(pose) = initial.filter(|_| begun) {
            poses.insert(0, TracePose { time_s: 0.0, pose: *pose });
        }
        let leaves_s = self.leaves.get(&entity.name).copied().unwrap_or(f64::INFINITY);
        poses.retain(|timed| timed.time_s < leaves_s - SAME_S);
        let headings = headings(&poses);
        let sample = |(i, timed): (usize, &TracePose)| {
            let heading_rad = headings.get(i).copied().unwrap_or_default();
            let at = timed.pose.at + rotate(entity.middle, heading_rad);
            let first = speed_mps.filter(|_| timed.time_s == 0.0 && initial.is_some());
            let velocity = first.map_or(Vec2::repeat(f64::NAN), |speed| direction(heading_rad) * speed);
            RecordedState {
                time_s: timed.time_s,
                at: frame.place(at),
                heading_rad: frame.heading(heading_rad),
                velocity: frame.turn(velocity),
                z_m: f64::NAN,
            }
        };
        poses.iter().enumerate().map(sample).collect()
    }
}

/// Poses with those at the steps between them: a polyline is straight, with constant speed between two poses.
fn at_steps(poses: &[TracePose]) -> Vec<TracePose> {
    let mut filled = Vec::with_capacity(poses.len());
    for pair in poses.windows(2) {
        let (a, b) = (pair[0], pair[1]);
        filled.push(a);
        let span_s = b.time_s - a.time_s;
        let first = (a.time_s / STEP_S + 0.01).floor() as i64 + 1;
        let steps = if (STEP_S * 1.5..LONGEST_S).contains(&span_s) { MAX_STEPS as i64 } else { 0 };
        for step in first..first.saturating_add(steps) {
            let time_s = step as f64 * STEP_S;
            if time_s > b.time_s - SAME_S {
                break;
            }
            let share = (time_s - a.time_s) / span_s;
            let turn = a.pose.heading_rad.zip(b.pose.heading_rad);
            let heading_rad = turn.map(|(from, to)| from + share * wrap_angle(to - from));
            let at = a.pose.at + (b.pose.at - a.pose.at) * share;
            filled.push(TracePose { time_s, pose: Pose { at, heading_rad } });
        }
        if filled.len() > MAX_POSES {
            break;
        }
    }
    filled.extend(poses.last());
    filled
}

/// Headings of poses; a missing one is the direction to the next pose, or from the previous one at the end.
fn headings(poses: &[TracePose]) -> Vec<f64> {
    let way = |a: &Pose, b: &Pose| {
        let way = b.at - a.at;
        (way.norm() > 0.01).then(|| way.y.atan2(way.x))
    };
    let mut before = 0.0;
    let heading = |i: usize| {
        let pose = &poses[i].pose;
        let next = poses.get(i + 1).and_then(|next| way(pose, &next.pose));
        let last = || i.checked_sub(1).and_then(|i| way(&poses[i].pose, pose));
        before = pose.heading_rad.or(next).or_else(last).unwrap_or(before);
        before
    };
    (0..poses.len()).map(heading).collect()
}
