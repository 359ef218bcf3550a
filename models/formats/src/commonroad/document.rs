//! A scenario in the form of its file.

use super::shapes::{self, Shape};
use super::words::VERSIONS;
use crate::limits::{MAX_MAP_POINTS, MAX_POLYLINES};
use crate::problem::{FieldProblem, ReadError, code};
use crate::refusals::{self, wanted, what};
use crate::source::Source;
use crate::tree::XmlNode;
use crate::unpack::{self, Bounds};
use crate::xml::{Element, Scanner, XmlEvent};
use scene::message::Word;
use scene::{Origin, Vec2};
use std::collections::HashMap;

/// Most bytes of a file once decompressed, and of one tag or text.
const MAX_BYTES: u64 = 256 << 20;
const MAX_TAG: usize = 64 << 10;
/// Most obstacles and planning problems, and most states of them together.
const MAX_OBSTACLES: usize = 4_096;
const MAX_STATES: usize = 600_000;
/// Most references, signs and signals.
const MAX_OTHERS: usize = 200_000;
/// Most characters of a word or name.
const MAX_WORD: usize = 200;

/// The first element of a file.
pub(super) const ROOT: &str = "commonRoad";

/// One side of a lanelet.
#[derive(Debug, Default)]
pub(super) struct Side {
    pub points: Vec<Vec2>,
    pub marking: String,
    /// The adjacent lanelet, and whether it runs the same way.
    pub beside: Option<(i64, bool)>,
}

/// A lanelet.
#[derive(Debug, Default)]
pub(super) struct Lanelet {
    pub id: i64,
    pub left: Side,
    pub right: Side,
    pub predecessors: Vec<i64>,
    pub successors: Vec<i64>,
    pub types: Vec<String>,
    pub one_way: Vec<String>,
    pub both_ways: Vec<String>,
    pub signs: Vec<i64>,
    pub lights: Vec<i64>,
    /// Ends of the stop line, or that the stop line is at the end of the lanelet.
    pub stop: Option<Option<(Vec2, Vec2)>>,
    /// Limit of version 2018b, m/s.
    pub speed_mps: Option<f64>,
}

/// A sign.
#[derive(Debug)]
pub(super) struct Sign {
    /// Kinds of signs with their numbers.
    pub elements: Vec<(String, Option<f64>)>,
    pub position: Option<Vec2>,
}

/// A traffic light.
#[derive(Debug)]
pub(super) struct TrafficLight {
    /// Colours with their durations in steps.
    pub cycle: Vec<(String, u64)>,
    pub offset: i64,
    pub direction: String,
    pub active: bool,
}

/// State of an obstacle at a time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct ObstacleState {
    /// Step of the file.
    pub step: i64,
    pub at: Vec2,
    pub heading_rad: Option<f64>,
    pub velocity: Option<Vec2>,
    /// Whether the state is the middle of a set of possible states.
    pub uncertain: bool,
}

/// An obstacle.
#[derive(Debug)]
pub(super) struct Obstacle {
    pub id: i64,
    pub word: String,
    pub fixed: bool,
    /// Shape; unknown size if absent.
    pub shape: Option<Shape>,
    /// In the order of the file.
    pub states: Vec<ObstacleState>,
    /// Whether the file has occupied sets instead of states.
    pub sets: bool,
}

/// A range of numbers.
pub(super) type Range = (f64, f64);

/// End of a planning problem.
#[derive(Debug, Default)]
pub(super) struct GoalState {
    pub places: Vec<Shape>,
    pub lanelets: Vec<i64>,
    pub heading_rad: Option<Range>,
    pub speed_mps: Option<Range>,
    /// Time in steps of the file.
    pub time: Option<Range>,
}

/// A planning problem.
#[derive(Debug)]
pub(super) struct PlanningProblem {
    pub id: i64,
    pub start: ObstacleState,
    pub goals: Vec<GoalState>,
}

/// A file.
#[derive(Debug, Default)]
pub(super) struct CommonRoadDocument {
    pub name: String,
    pub source: String,
    pub affiliation: String,
    pub step_s: f64,
    pub tags: Vec<String>,
    pub origin: Origin,
    pub lanelets: Vec<Lanelet>,
    pub signs: HashMap<i64, Sign>,
    pub lights: HashMap<i64, TrafficLight>,
    /// Lanelets through junctions by their turn direction.
    pub turns: Vec<(&'static str, i64)>,
    pub obstacles: Vec<Obstacle>,
    pub problems: Vec<PlanningProblem>,
    /// Number of elements that a scene cannot hold.
    pub others: usize,
}

/// Reads a file, plain or compressed with gzip.
///
/// # Errors
/// `malformed-file` for broken XML or gzip, the limits of a file, `cannot-represent` for another kind of file
/// or an unknown version, `invalid-field` for what is missing or no number, `map-too-large`,
/// `too-many-agents`.
pub(super) fn read(file: &dyn Source) -> Result<CommonRoadDocument, ReadError> {
    let input = file.open().and_then(|input| unpack::open(input, Bounds::of(MAX_BYTES)));
    let input = input.map_err(|error| unpack::fault(&error, 0))?;
    let mut scanner = Scanner::new(input, MAX_TAG).with_texts();
    let mut document = match scanner.next()? {
        Some(XmlEvent::Start(root)) => head(&root)?,
        _ => CommonRoadDocument::default(),
    };
    let (mut points, mut states, mut others) = (0, 0, 0);
    while let Some(event) = scanner.next()? {
        let XmlEvent::Start(element) = event else { continue };
        let node = XmlNode::read(&mut scanner, element)?;
        match node.name() {
            "lanelet" => {
                let lanelet = lanelet(&node)?;
                points += lanelet.left.points.len() + lanelet.right.points.len();
                others += lanelet.predecessors.len() + lanelet.successors.len() + lanelet.signs.len();
                others += lanelet.lights.len() + lanelet.types.len();
                document.lanelets.push(lanelet);
            }
            "trafficSign" => {
                document.signs.insert(node.whole("id")?, sign(&node)?);
            }
            "trafficLight" => {
                let light = light(&node)?;
                others += light.cycle.len();
                document.lights.insert(node.whole("id")?, light);
            }
            "intersection" => turns(&node, &mut document.turns)?,
            "staticObstacle" | "dynamicObstacle" | "obstacle" => {
                let obstacle = obstacle(&node)?;
                states += obstacle.states.len();
                document.obstacles.push(obstacle);
            }
            "planningProblem" => document.problems.push(problem(&node)?),
            "scenarioTags" => {
                document.tags = node.children.iter().map(|tag| word(tag.name())).take(64).collect();
            }
            "location" => document.origin = origin(&node)?,
            _ => document.others += 1,
        }
        bound(document.lanelets.len(), MAX_POLYLINES, what::LANELETS, code::MAP_TOO_LARGE)?;
        bound(points, 2 * MAX_MAP_POINTS, what::LANELET_POINTS, code::MAP_TOO_LARGE)?;
        let listed = others + document.turns.len() + document.signs.len() + document.lights.len();
        bound(listed, MAX_OTHERS, what::SIGNS, code::MAP_TOO_LARGE)?;
        let who = document.obstacles.len() + document.problems.len();
        bound(who, MAX_OBSTACLES, what::OBSTACLES, code::TOO_MANY_AGENTS)?;
        bound(states, MAX_STATES, what::STATES, code::OUT_OF_RANGE)?;
    }
    Ok(document)
}

fn bound(count: usize, most: usize, what: Word, code: &'static str) -> Result<(), ReadError> {
    if count > most {
        return Err(FieldProblem::new("", code, refusals::more_than(most, what)).into());
    }
    Ok(())
}

fn word(text: &str) -> String {
    text.trim().chars().take(MAX_WORD).collect()
}

fn head(root: &Element) -> Result<CommonRoadDocument, ReadError> {
    if root.name != ROOT {
        let message = refusals::found_expected(refusals::tag(&root.name), refusals::tag(ROOT));
        return Err(ReadError::other_content(message));
    }
    let version = root.get("commonRoadVersion").unwrap_or_default();
    if !VERSIONS.contains(&version) {
        let found = format!("commonRoadVersion={}", word(version));
        return Err(ReadError::other_content(refusals::found_one_of(&found, &VERSIONS.join(", "))));
    }
    let text = root.required("timeStepSize")?;
    let step_s = text.trim().parse().ok().filter(|step: &f64| (0.001..=10.0).contains(step));
    let Some(step_s) = step_s else {
        let message = refusals::found_in_element(&word(text), "timeStepSize", wanted::STEP_SIZE);
        return Err(FieldProblem::new("", code::INVALID_FIELD, message.at_line(root.line)).into());
    };
    let get = |name: &str| word(root.get(name).unwrap_or_default());
    Ok(CommonRoadDocument {
        name: get("benchmarkID"),
        source: get("source"),
        affiliation: get("affiliation"),
        tags: get("tags").split_whitespace().map(str::to_owned).collect(),
        step_s,
        ..CommonRoadDocument::default()
    })
}

/// Origin of the file's frame.
fn origin(node: &XmlNode) -> Result<Origin, ReadError> {
    let Some(place) = node.child("geoTransformation") else { return Ok(Origin::default()) };
    let crs = place.child("geoReference").map(|text| word(&text.text)).filter(|text| !text.is_empty());
    let number = |name: &str| match place.at(&["additionalTransformation", name]) {
        Some(node) => node.number(),
        None => Ok(0.0),
    };
    let rotation_rad = scene::wrap_angle(number("zRotation")?);
    Ok(Origin { x_m: number("xTranslation")?, y_m: number("yTranslation")?, z_m: 0.0, rotation_rad, crs })
}

/// References to others.
fn refs(node: &XmlNode, name: &str) -> Result<Vec<i64>, ReadError> {
    node.all(name).map(|node| node.whole("ref")).collect()
}

fn words(node: &XmlNode, name: &str) -> Vec<String> {
    node.all(name).map(|node| word(&node.text)).collect()
}

fn side(node: &XmlNode, bound: &str, adjacent: &str) -> Result<Side, ReadError> {
    let line = node.required(bound)?;
    let points = line.all("point").map(shapes::point).collect::<Result<Vec<_>, _>>()?;
    if points.len() < 2 {
        return Err(line.wrong(&format!("{} points", points.len()), wanted::BOUNDS));
    }
    let marking = line.child("lineMarking").map(|node| word(&node.text)).unwrap_or_default();
    let beside = node.child(adjacent).map(|node| {
        let same = node.element.get("drivingDir") != Some("opposite");
        node.whole("ref").map(|id| (id, same))
    });
    Ok(Side { points, marking, beside: beside.transpose()? })
}

fn lanelet(node: &XmlNode) -> Result<Lanelet, ReadError> {
    let stop = node.child("stopLine").map(|line| {
        let ends = line.all("point").map(shapes::point).collect::<Result<Vec<_>, _>>()?;
        Ok(if let [a, b] = ends.as_slice() { Some((*a, *b)) } else { None })
    });
    let speed_mps = node.child("speedLimit").map(XmlNode::number).transpose()?;
    Ok(Lanelet {
        id: node.whole("id")?,
        left: side(node, "leftBound", "adjacentLeft")?,
        right: side(node, "rightBound", "adjacentRight")?,
        predecessors: refs(node, "predecessor")?,
        successors: refs(node, "successor")?,
        types: words(node, "laneletType"),
        one_way: words(node, "userOneWay"),
        both_ways: words(node, "userBidirectional"),
        signs: refs(node, "trafficSignRef")?,
        lights: refs(node, "trafficLightRef")?,
        stop: stop.transpose().map_err(|error: ReadError| error)?,
        speed_mps,
    })
}

fn sign(node: &XmlNode) -> Result<Sign, ReadError> {
    let elements = node.all("trafficSignElement").map(|element| {
        let kind = element.child("trafficSignID").map(|id| word(&id.text)).unwrap_or_default();
        let value = element.child("additionalValue").and_then(|value| value.number().ok());
        (kind, value)
    });
    let position = node.at(&["position", "point"]).map(shapes::point).transpose()?;
    Ok(Sign { elements: elements.take(64).collect(), position })
}

fn light(node: &XmlNode) -> Result<TrafficLight, ReadError> {
    let steps = |node: &XmlNode| match node.text.parse::<i64>() {
        Ok(steps) => Ok(steps),
        Err(_) => Err(node.wrong(&node.text, wanted::STEPS)),
    };
    let mut cycle = Vec::new();
    for element in node.child("cycle").into_iter().flat_map(|cycle| cycle.all("cycleElement")) {
        let duration = element.required("duration")?;
        let length = steps(duration)?;
        let length = u64::try_from(length).map_err(|_| duration.wrong(&duration.text, wanted::STEPS))?;
        cycle.push((word(&element.required("color")?.text), length.min(1 << 40)));
    }
    let offset = node.at(&["cycle", "timeOffset"]).map(steps).transpose()?.unwrap_or(0);
    let active = node.child("active").is_none_or(|node| node.text != "false");
    let direction = node.child("direction").map(|node| word(&node.text)).unwrap_or_default();
    Ok(TrafficLight { cycle, offset, direction, active })
}

fn turns(node: &XmlNode, turns: &mut Vec<(&'static str, i64)>) -> Result<(), ReadError> {
    let ways = [("successorsLeft", "left"), ("successorsStraight", "straight"), ("successorsRight", "right")];
    for incoming in node.all("incoming") {
        for (name, turn) in ways {
            turns.extend(refs(incoming, name)?.into_iter().map(|id| (turn, id)));
        }
    }
    Ok(())
}

/// A number, or the middle of an interval; whether it is an interval.
fn value(node: &XmlNode) -> Result<(f64, bool), ReadError> {
    let (from, to) = range(node)?;
    Ok(((from + to) / 2.0, from != to))
}

/// The bounds of an interval.
fn range(node: &XmlNode) -> Result<Range, ReadError> {
    if let Some(exact) = node.child("exact") {
        return exact.number().map(|value| (value, value));
    }
    Ok((node.required("intervalStart")?.number()?, node.required("intervalEnd")?.number()?))
}

/// A state; nothing if its position is missing or not a position.
fn state(node: &XmlNode) -> Result<Option<ObstacleState>, ReadError> {
    let places = shapes::all(node.required("position")?)?;
    let Some(place) = places.first() else { return Ok(None) };
    let optional = |name: &str| node.child(name).map(value).transpose();
    let heading = optional("orientation")?;
    let (speed, slip, across) = (optional("velocity")?, optional("slipAngle")?, optional("velocityY")?);
    let time = value(node.required("time")?)?.0;
    if !(-1e9..=1e9).contains(&time) {
        return Err(node.wrong(&time.to_string(), wanted::TIME));
    }
    let values = [heading, speed, slip, across];
    let uncertain = place.is_area || values.iter().flatten().any(|(_, between)| *between);
    let heading_rad = heading.map(|(heading, _)| scene::wrap_angle(heading));
    let velocity = speed.zip(heading_rad).map(|((speed, _), heading)| {
        let way = heading + slip.map_or(0.0, |(slip, _)| slip);
        let along = scene::geometry::direction(way) * speed;
        let side = scene::geometry::direction(heading + std::f64::consts::FRAC_PI_2);
        along + side * across.map_or(0.0, |(across, _)| across)
    });
    Ok(Some(ObstacleState { step: time.round() as i64, at: place.centre, heading_rad, velocity, uncertain }))
}

fn obstacle(node: &XmlNode) -> Result<Obstacle, ReadError> {
    let role = node.child("role").map_or("", |role| role.text.as_str());
    let shape = node.child("shape").map(|shape| shapes::all(shape).map(|all| shapes::enclosing(&all)));
    let mut states = Vec::new();
    states.extend(node.child("initialState").map(state).transpose()?.flatten());
    for next in node.child("trajectory").into_iter().flat_map(|trajectory| trajectory.all("state")) {
        states.extend(state(next)?);
    }
    Ok(Obstacle {
        id: node.whole("id")?,
        word: node.child("type").map(|word_of| word(&word_of.text)).unwrap_or_default(),
        fixed: node.name() == "staticObstacle" || role == "static",
        shape: shape.transpose()?.flatten(),
        states,
        sets: node.child("occupancySet").is_some(),
    })
}

fn problem(node: &XmlNode) -> Result<PlanningProblem, ReadError> {
    let initial = node.required("initialState")?;
    let start = state(initial)?.ok_or_else(|| initial.wrong("no place", wanted::PLACE))?;
    let goal = |node: &XmlNode| -> Result<GoalState, ReadError> {
        let between = |name: &str| node.child(name).map(range).transpose();
        let position = node.child("position");
        Ok(GoalState {
            places: position.map(shapes::all).transpose()?.unwrap_or_default(),
            lanelets: position.map(|node| refs(node, "lanelet")).transpose()?.unwrap_or_default(),
            heading_rad: between("orientation")?,
            speed_mps: between("velocity")?,
            time: between("time")?,
        })
    };
    let goals = node.all("goalState").take(64).map(goal).collect::<Result<Vec<_>, _>>()?;
    Ok(PlanningProblem { id: node.whole("id")?, start, goals })
}
