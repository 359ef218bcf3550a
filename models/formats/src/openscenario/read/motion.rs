//! Motion that a scenario defines without a simulation: initial poses, trajectories with times, and the times
//! at which road users appear and disappear.
//!
//! Manoeuvres (changes of speed or lane, conditions on the traffic) are skipped, with their place in the
//! file. An interpreter of the storyboard would handle them here, as further sources of samples.

use super::entities::{Catalogs, entry};
use super::parameters::{Scope, attribute, number};
use super::places::{Pose, ScenarioPlaces};
use super::unread::Unread;
use crate::problem::{FieldProblem, ReadError, code};
use crate::refusals::{self, what};
use crate::tree::XmlNode;
use std::collections::HashMap;

/// Most poses of all road users.
pub(super) const MAX_POSES: usize = 1_000_000;

/// Path of an element in the file.
pub(super) type Place<'a> = &'a str;

/// A pose at a time, seconds.
#[derive(Clone, Copy, Debug)]
pub(super) struct TracePose {
    pub time_s: f64,
    pub pose: Pose,
}

/// Effect of an action on a road user.
#[derive(Debug)]
pub(super) enum Move {
    /// Follows poses.
    Follow(Vec<TracePose>),
    /// Appears at a time.
    Comes(TracePose),
    /// Disappears at a time, seconds.
    Leaves(f64),
}

/// Time at which a trigger fires.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum When {
    /// At this time of the simulation, seconds.
    At(f64),
    /// A time that depends on the traffic.
    Unknown,
}

/// The time of a `<StartTrigger>` or `<StopTrigger>` that depends only on the clock.
///
/// # Errors
/// `invalid-field` for a value that is not a number.
pub(super) fn when(trigger: &XmlNode) -> Result<When, ReadError> {
    let mut first: Option<f64> = None;
    for group in trigger.all("ConditionGroup") {
        let mut last = 0.0_f64;
        for condition in group.all("Condition") {
            let clock = condition.at(&["ByValueCondition", "SimulationTimeCondition"]);
            let rising = |rule: &str| matches!(rule, "greaterThan" | "greaterOrEqual" | "equalTo");
            let Some(clock) = clock.filter(|clock| rising(attribute(clock, "rule"))) else {
                return Ok(When::Unknown);
            };
            let delay_s = number(condition, "delay")?.unwrap_or(0.0).max(0.0);
            last = last.max(number(clock, "value")?.unwrap_or(0.0) + delay_s);
        }
        first = Some(first.map_or(last, |first| first.min(last)));
    }
    Ok(first.map_or(When::Unknown, When::At))
}

/// References of actions, and a list of what is not read.
pub(super) struct MotionReader<'a> {
    pub places: &'a ScenarioPlaces,
    pub catalogs: &'a Catalogs,
    pub unread: &'a mut Unread,
    /// Number of poses of all moves so far.
    pub poses: &'a mut usize,
    /// Moves by the name of the road user, each with the time of its event, without the time of the act.
    pub moves: Vec<(String, Option<f64>, Move)>,
}

impl MotionReader<'_> {
    /// Adds the events of a `<ManeuverGroup>`.
    ///
    /// # Errors
    /// `invalid-field`, with the line.
    pub fn group(&mut self, group: &XmlNode, scope: &Scope, place: Place<'_>) -> Result<(), ReadError> {
        let place = named(place, group);
        let actors = group.child("Actors");
        if actors.is_some_and(|actors| attribute(actors, "selectTriggeringEntities") == "true") {
            self.unread.push(&place);
            return Ok(());
        }
        let actors = actors.into_iter().flat_map(|actors| actors.all("EntityRef"));
        let actors: Vec<&str> = actors.map(|actor| attribute(actor, "entityRef")).collect();
        for child in &group.children {
            match child.name() {
                "Maneuver" => {
                    let scope = scope.declared(child, &HashMap::new())?;
                    let mut maneuver = child.clone();
                    scope.fill(&mut maneuver);
                    self.maneuver(&maneuver, &actors, &scope, &place)?;
                }
                "CatalogReference" => match entry(self.catalogs, scope, child)? {
                    Some((maneuver, scope)) if maneuver.name() == "Maneuver" => {
                        self.maneuver(&maneuver, &actors, &scope, &place)?;
                    }
                    _ => self.unread.push(&named(&place, child)),
                },
                _ => {}
            }
        }
        Ok(())
    }

    fn maneuver(
        &mut self,
        maneuver: &XmlNode,
        actors: &[&str],
        scope: &Scope,
        place: Place<'_>,
    ) -> Result<(), ReadError> {
        let place = named(place, maneuver);
        for event in maneuver.all("Event") {
            let place = named(&place, event);
            let start = match event.child("StartTrigger").map(when).transpose()? {
                Some(When::Unknown) => {
                    self.unread.push(&place);
                    continue;
                }
                Some(When::At(time_s)) => Some(time_s),
                // Without a trigger an event begins with its act.
                None => None,
            };
            for action in event.all("Action") {
                let place = named(&place, action);
                for child in &action.children {
                    self.action(child, actors, start, scope, &place)?;
                }
            }
        }
        Ok(())
    }

    fn action(
        &mut self,
        action: &XmlNode,
        actors: &[&str],
        start: Option<f64>,
        scope: &Scope,
        place: Place<'_>,
    ) -> Result<(), ReadError> {
        let place = format!("{place}/{}", action.name());
        let Some(inner) = action.children.first() else { return Ok(()) };
        match (action.name(), inner.name()) {
            ("PrivateAction", _) => {
                let follow = inner.child("FollowTrajectoryAction");
                let Some(follow) = follow.filter(|_| inner.name() == "RoutingAction") else {
                    self.unread.push(&deepest(&place, inner));
                    return Ok(());
                };
                let place = format!("{place}/{}/{}", inner.name(), follow.name());
                if let Some(poses) = self.trajectory(follow, start.unwrap_or(0.0), scope, &place)? {
                    *self.poses += poses.len().saturating_mul(actors.len());
                    if *self.poses > MAX_POSES {
                        let message = refusals::more_than(MAX_POSES, what::POSITIONS);
                        return Err(FieldProblem::new("", code::OUT_OF_RANGE, message).into());
                    }
                    for actor in actors {
                        self.moves.push(((*actor).to_owned(), start, Move::Follow(poses.clone())));
                    }
                }
            }
            ("GlobalAction", "EntityAction") => {
                let name = attribute(inner, "entityRef").to_owned();
                let time_s = start.unwrap_or(0.0);
                let comes = inner.child("AddEntityAction");
                let pose = match comes.and_then(|comes| comes.child("Position")) {
                    Some(position) => self.places.of(position)?,
                    None => None,
                };
                match pose {
                    Some(pose) => {
                        self.moves.push((name, start, Move::Comes(TracePose { time_s, pose })));
                    }
                    None if inner.child("DeleteEntityAction").is_some() => {
                        self.moves.push((name, start, Move::Leaves(time_s)));
                    }
                    None => self.unread.push(&deepest(&place, inner)),
                }
            }
            _ => self.unread.push(&deepest(&place, inner)),
        }
        Ok(())
    }

    /// Poses of a `<FollowTrajectoryAction>` that begins at a time; nothing for a trajectory without times or
    /// with curves.
    ///
    /// # Errors
    /// `invalid-field`, with the line.
    pub fn trajectory(
        &mut self,
        follow: &XmlNode,
        start_s: f64,
        scope: &Scope,
        place: Place<'_>,
    ) -> Result<Option<Vec<TracePose>>, ReadError> {
        let reference = follow.child("TrajectoryRef").unwrap_or(follow);
        let catalogued = match reference.child("CatalogReference") {
            Some(reference) => entry(self.catalogs, scope, reference)?.map(|(node, _)| node),
            None => None,
        };
        let trajectory = reference.child("Trajectory").or(catalogued.as_ref());
        let timing = follow.at(&["TimeReference", "Timing"]);
        let shape = trajectory.and_then(|trajectory| trajectory.at(&["Shape"]));
        let Some(polyline) = shape.and_then(|shape| shape.child("Polyline")) else {
            let curve = shape.and_then(|shape| shape.children.first()).map_or("", |curve| curve.name());
            self.unread.push(&format!("{place}/Trajectory/Shape/{curve}"));
            return Ok(None);
        };
        let Some(timing) = timing else {
            self.unread.push(&format!("{place}/TimeReference"));
            return Ok(None);
        };
        let scale = number(timing, "scale")?.unwrap_or(1.0);
        let offset_s = number(timing, "offset")?.unwrap_or(0.0);
        let from_s = if attribute(timing, "domainAbsoluteRelative") == "relative" { start_s } else { 0.0 };
        let mut poses = Vec::new();
        for (i, vertex) in polyline.all("Vertex").enumerate() {
            let time_s = number(vertex, "time")?.unwrap_or(0.0) * scale + offset_s + from_s;
            match vertex.child("Position").map(|position| self.places.of(position)).transpose()?.flatten() {
                Some(pose) => poses.push(TracePose { time_s, pose }),
                None => {
                    self.unread.push(&format!("{place}/Trajectory/Shape/Polyline/Vertex[{}]", i + 1));
                    return Ok(None);
                }
            }
        }
        Ok(Some(poses))
    }
}

/// The place of a named element within another.
pub(super) fn named(place: Place<'_>, node: &XmlNode) -> String {
    match node.element.get("name").or_else(|| node.element.get("entityRef")) {
        Some(name) => format!("{place}/{}[{name}]", node.name()),
        None => format!("{place}/{}", node.name()),
    }
}

/// The place of an action including its kind.
pub(super) fn deepest(place: Place<'_>, node: &XmlNode) -> String {
    let mut place = named(place, node);
    if let Some(inner) = node.children.first().filter(|_| node.name().ends_with("Action")) {
        place = named(&place, inner);
    }
    place
}
