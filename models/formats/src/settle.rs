//! Turns recordings in the frame of their source into scenes about the ego.

use crate::format::{EGO, ImportOptions};
use crate::identities;
use crate::limits::MAX_AGENTS;
use crate::problem::{ImportWarning, Imported, ReadError};
use crate::repairs::{self, checked};
use crate::sentences;
use scene::geometry::{Extent, rotate};
use scene::map::{LaneMap, Points};
use scene::message::Word;
use scene::{Agent, Scene, State, Vec2};
use std::collections::HashSet;

/// A scene of a recording and its map, in the frame of their source. If there are too many road users, the
/// nearest are kept; tracks with two ids are joined; the ego's present position becomes the origin.
///
/// # Errors
/// The faults of a scene.
pub(crate) fn settled(
    mut scene: Scene,
    mut map: LaneMap,
    mut warnings: Vec<ImportWarning>,
    options: &ImportOptions,
) -> Result<Imported, ReadError> {
    let now = scene.time.now_step;
    warnings.extend(repairs::notice_boxes(&scene.agents));
    warnings.extend(nearest(&mut scene.agents, now));
    let by = origin(&scene, &map);
    shift(&mut scene, &mut map, by);
    let turned = rotate(by, scene.meta.origin.rotation_rad);
    (scene.meta.origin.x_m, scene.meta.origin.y_m) =
        (scene.meta.origin.x_m + turned.x, scene.meta.origin.y_m + turned.y);
    warnings.extend(repairs::join_lanes(&mut map));
    scene.map = map.into();
    if options.join_identities {
        warnings.extend(identities::join(&mut scene));
    }
    if let Some(licence) = &options.licence {
        scene.meta.licence = Some(licence.clone());
    }
    checked(scene, warnings)
}

/// The state nearest in time to a step.
fn state_about(agent: &Agent, step: usize) -> Option<&State> {
    agent.track.valid_steps().min_by_key(|i| i.abs_diff(step)).and_then(|i| agent.track.at(i))
}

/// Keeps the road users that a scene has room for: the ego and those nearest to it, or to the first one
/// without an ego.
pub(crate) fn nearest(agents: &mut Vec<Agent>, now: usize) -> Option<ImportWarning> {
    let count = agents.len();
    if count <= MAX_AGENTS {
        return None;
    }
    let is_ego = |agent: &Agent| agent.role.as_deref() == Some(EGO);
    let ego = agents.iter().position(is_ego).unwrap_or(0);
    let centre =
        agents.get(ego).and_then(|agent| state_about(agent, now)).map(State::position).unwrap_or_default();
    let distance = |(i, agent): (usize, &Agent)| {
        let away = state_about(agent, now).map_or(f64::INFINITY, |state| (state.position() - centre).norm());
        (if i == ego { -1.0 } else { away }, i)
    };
    let mut order: Vec<(f64, usize)> = agents.iter().enumerate().map(distance).collect();
    order.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let near: HashSet<usize> = order.into_iter().take(MAX_AGENTS).map(|(_, i)| i).collect();
    let mut i = 0..;
    agents.retain(|_| i.next().is_some_and(|i| near.contains(&i)));
    Some(ImportWarning::new("agents-dropped", sentences::agents_near_ego(count, MAX_AGENTS)))
}

/// Position of the ego at the present step, otherwise the middle of all. Whole metres, so that a round trip
/// gives the same origin.
fn origin(scene: &Scene, map: &LaneMap) -> Vec2 {
    let now = scene.time.now_step;
    let ego = scene.agents.iter().find(|agent| agent.role.as_deref() == Some(EGO));
    if let Some(state) = ego.and_then(|ego| state_about(ego, now)) {
        return finite(state.position());
    }
    let states = scene.agents.iter().filter_map(|agent| state_about(agent, now)).map(State::position);
    let lines = map.lanes.iter().map(|lane| &lane.points);
    let lines = lines.chain(map.road_lines.iter().chain(&map.road_edges).map(|line| &line.points));
    let areas = map.crosswalks.iter().chain(&map.speed_bumps).chain(&map.driveways).map(|area| &area.polygon);
    let lines = lines.chain(areas);
    let places = states.chain(lines.flat_map(|line| line.xy.iter().copied())).filter(|p| finite(*p) == *p);
    Extent::about(places).map_or(Vec2::zeros(), |extent| finite(extent.middle().map(f64::round)))
}

fn finite(p: Vec2) -> Vec2 {
    if p.x.is_finite() && p.y.is_finite() { p } else { Vec2::zeros() }
}

/// Moves all points of a map.
pub(crate) fn place(map: &mut LaneMap, to: impl Fn(Vec2) -> Vec2) {
    let line = |points: &mut Points| points.xy.iter_mut().for_each(|p| *p = to(*p));
    map.lanes.iter_mut().for_each(|lane| line(&mut lane.points));
    map.road_lines.iter_mut().chain(&mut map.road_edges).for_each(|edge| line(&mut edge.points));
    let areas = map.crosswalks.iter_mut().chain(&mut map.speed_bumps).chain(&mut map.driveways);
    for area in areas.chain(&mut map.drivable) {
        line(&mut area.polygon);
        area.holes.iter_mut().for_each(line);
    }
    map.stop_signs.iter_mut().for_each(|sign| sign.position = to(sign.position));
}

/// Moves all positions.
fn shift(scene: &mut Scene, map: &mut LaneMap, by: Vec2) {
    place(map, |p| p - by);
    scene.signals.iter_mut().filter_map(|signal| signal.stop.as_mut()).for_each(|stop| *stop -= by);
    for agent in &mut scene.agents {
        for state in agent.track.states.iter_mut().flatten() {
            (state.x_m, state.y_m) = (state.x_m - by.x, state.y_m - by.y);
        }
    }
}

/// Gives each element a valid id of its own.
#[derive(Default)]
pub(crate) struct Ids {
    taken: HashSet<String>,
    pub changed: usize,
}

impl Ids {
    /// The id itself if it is valid and not yet taken.
    pub fn take(&mut self, id: &str) -> String {
        let legal = |c: char| if c.is_ascii_alphanumeric() || "_.:-".contains(c) { c } else { '_' };
        let mut clean: String = id.chars().map(legal).take(64).collect();
        if clean.is_empty() {
            clean.push('_');
        }
        let mut name = clean.clone();
        // Most ids are free. For the others, the counter starts at the number of ids changed so far.
        let mut count = 1 + self.changed;
        while !self.taken.insert(name.clone()) {
            count += 1;
            clean.truncate(50);
            name = format!("{clean}.{count}");
        }
        self.changed += usize::from(name != id);
        name
    }

    /// Warns about changed ids.
    pub fn warning(&self, subject: Word) -> Option<ImportWarning> {
        let message = || sentences::ids_replaced(self.changed, subject);
        (self.changed > 0).then(|| ImportWarning::new("ids-changed", message()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ids_become_legal_and_single() {
        let mut ids = Ids::default();
        let taken: Vec<String> = ["a", "a", "lane 7/b", "", "a.2"].iter().map(|id| ids.take(id)).collect();
        assert_eq!(taken.iter().collect::<HashSet<_>>().len(), 5, "{taken:?}");
        assert_eq!(
            (taken[0].as_str(), taken[2].as_str(), ids.take(&"x".repeat(90)).len()),
            ("a", "lane_7_b", 64)
        );
        assert!(ids.warning(sentences::subject::MAP_FEATURES).is_some());
    }
}
