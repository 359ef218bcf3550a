//! Reads a scenario as a scene.

use super::document::{self, CommonRoadDocument};
use super::motion::{Changed, Clock};
use super::{goals, map, motion, signals};
use crate::describe;
use crate::format::{EGO, ImportOptions, MAP_TIMING};
use crate::limits::MAX_STEPS;
use crate::map_file;
use crate::problem::{ImportWarning, Imported, ReadError};
use crate::repairs::{self, checked};
use crate::sentences;
use crate::settle;
use crate::source::Source;
use scene::geometry::rotate;
use scene::message::Message;
use scene::{Agent, MAX_COORDINATE_M, Meta, Origin, Scene, Shared, Timing, Vec2};
use std::collections::{BTreeMap, HashSet};

/// Text before the licence in the source of a file written by this program.
pub(super) const LICENCE: &str = "; licence ";

/// Affiliation of a file whose planning problem this program made, because a scenario has one at least.
pub(super) const MADE: &str = "planning problem made by DragTraffic";

/// Reads a file, plain or compressed with gzip.
///
/// # Errors
/// Those of [`document::read`]; `map-too-large`; the faults of a scene.
pub(super) fn read(file: &dyn Source, options: &ImportOptions) -> Result<Imported, ReadError> {
    let mut document = document::read(file)?;
    if document.affiliation == MADE {
        document.problems.clear();
    }
    let shift = about_the_middle(&mut document)?;
    let mut warnings = Vec::new();
    let (map, lanes) = map::lane_map(&document, &mut warnings);
    let clock = clock(&document, &mut warnings);
    let mut changed = Changed::default();
    let (mut regions, mut sizes) = (0, 0);
    let mut agents: Vec<Agent> = Vec::new();
    let mut planned = HashSet::new();
    for (i, problem) in document.problems.iter().enumerate() {
        let (mut agent, is_region) = goals::agent(problem, (&map, &lanes), clock);
        // Some files also contain the recorded track of the problem's road user.
        let driven = document.obstacles.iter().find(|obstacle| obstacle.id == problem.id);
        match driven.and_then(|obstacle| motion::agent(obstacle, clock, &mut changed)) {
            Some(driven) => {
                agent = Agent { conditions: goals::from_start(agent.conditions, &driven), ..driven }
            }
            None => sizes += 1,
        }
        planned.insert(problem.id);
        agent.role = (i == 0).then(|| EGO.to_owned());
        regions += usize::from(is_region);
        agents.push(agent);
    }
    let others = document.obstacles.iter().filter(|obstacle| !planned.contains(&obstacle.id));
    agents.extend(others.filter_map(|obstacle| motion::agent(obstacle, clock, &mut changed)));
    agents = kept(agents, &mut warnings);
    let signals = signals::signals(&document, (&map, &lanes), clock.first, clock.steps, &mut warnings);
    tell(&document, &changed, (regions, sizes), &mut warnings);
    let (source, licence) = match document.source.split_once(LICENCE) {
        Some((source, licence)) => (source.to_owned(), Some(licence.to_owned())),
        None => ("commonroad".to_owned(), None),
    };
    let turned = rotate(shift, document.origin.rotation_rad);
    let origin = Origin {
        x_m: document.origin.x_m + turned.x,
        y_m: document.origin.y_m + turned.y,
        ..document.origin
    };
    let name =
        if document.name.is_empty() { "CommonRoad scenario".to_owned() } else { document.name.clone() };
    let now_step =
        if document.obstacles.is_empty() && document.problems.is_empty() { MAP_TIMING.now_step } else { 0 };
    let mut map = Shared::from(map);
    warnings.extend(repairs::drop_far_links(&mut map));
    let scene = Scene {
        id: None,
        name,
        meta: describe::fitted(Meta {
            source,
            source_id: Some(document.name).filter(|name| !name.is_empty()),
            licence: options.licence.clone().or(licence),
            origin,
            tags: document.tags,
            ..Meta::default()
        })?,
        time: Timing { steps: clock.steps, now_step },
        map,
        signals,
        agents,
        generated: None,
        extra: BTreeMap::new(),
    };
    checked(scene, warnings)
}

/// All positions of a document.
fn places(document: &mut CommonRoadDocument) -> impl Iterator<Item = &mut Vec2> {
    let lanelets = document.lanelets.iter_mut().flat_map(|lanelet| {
        let stop = lanelet.stop.iter_mut().flatten().flat_map(|(a, b)| [a, b]);
        lanelet.left.points.iter_mut().chain(&mut lanelet.right.points).chain(stop)
    });
    let signs = document.signs.values_mut().filter_map(|sign| sign.position.as_mut());
    let states =
        document.obstacles.iter_mut().flat_map(|obstacle| &mut obstacle.states).map(|state| &mut state.at);
    let problems = document.problems.iter_mut().flat_map(|problem| {
        let goals = problem.goals.iter_mut().flat_map(|goal| &mut goal.places).map(|place| &mut place.centre);
        std::iter::once(&mut problem.start.at).chain(goals)
    });
    lanelets.chain(signs).chain(states).chain(problems)
}

/// Moves all positions by whole metres into the range of a scene; most files already lie about their origin.
fn about_the_middle(document: &mut CommonRoadDocument) -> Result<Vec2, ReadError> {
    let corners = places(document).fold(None, |corners: Option<(Vec2, Vec2)>, p| {
        Some(corners.map_or((*p, *p), |(low, high)| (low.inf(p), high.sup(p))))
    });
    let (low, high) = corners.unwrap_or_default();
    if low.amax().max(high.amax()) < MAX_COORDINATE_M / 2.0 {
        return Ok(Vec2::zeros());
    }
    let (middle, half) = (((low + high) / 2.0).map(f64::round), (high - low) / 2.0);
    if map_file::is_too_wide(half) {
        return Err(ReadError::map_too_large(map_file::extent(half)));
    }
    places(document).for_each(|p| *p -= middle);
    Ok(middle)
}

/// The steps of the scene: to the last state or the end of the first goal. They begin at step zero of the
/// file if that is not too long before the first state, otherwise at the first state.
fn clock(document: &CommonRoadDocument, warnings: &mut Vec<ImportWarning>) -> Clock {
    let moving = document.obstacles.iter().filter(|obstacle| !obstacle.fixed);
    let starts = document.problems.iter().map(|problem| problem.start.step);
    let states = moving.flat_map(|obstacle| &obstacle.states).map(|state| state.step);
    let goals = document.problems.iter().flat_map(|problem| problem.goals.first());
    let ends = goals.filter_map(|goal| goal.time).map(|(_, to)| to.ceil().clamp(-1e9, 1e9) as i64);
    let seen: Vec<i64> = states.chain(starts).collect();
    let (Some(first), Some(last)) = (seen.iter().min(), seen.iter().copied().chain(ends).max()) else {
        return Clock { step_s: document.step_s, first: 0, steps: MAP_TIMING.steps };
    };
    let since_zero = Clock { step_s: document.step_s, first: 0, steps: 0 };
    let near = *first >= 0 && since_zero.step(last) < MAX_STEPS;
    let clock = if near { since_zero } else { Clock { first: *first, ..since_zero } };
    let all_s = clock.seconds(last as f64);
    let steps = clock.step(last) + 1;
    if steps > MAX_STEPS {
        warnings.push(ImportWarning::new("steps-dropped", sentences::steps_beyond_limit(all_s, MAX_STEPS)));
    }
    if !clock.is_even() {
        warnings.push(ImportWarning::new("time-resampled", sentences::time_interpolated(document.step_s)));
    }
    Clock { steps: steps.min(MAX_STEPS), ..clock }
}

/// The road users that a scene has room for; the first one of two with the same id.
fn kept(mut agents: Vec<Agent>, warnings: &mut Vec<ImportWarning>) -> Vec<Agent> {
    let count = agents.len();
    let mut ids = HashSet::new();
    agents.retain(|agent| ids.insert(agent.id.clone()));
    if agents.len() < count {
        let message = sentences::agents_with_used_id(count - agents.len());
        warnings.push(ImportWarning::new("agents-dropped", message));
    }
    warnings.extend(settle::nearest(&mut agents, 0));
    agents
}

/// Warnings about changed and dropped content.
fn tell(
    document: &CommonRoadDocument,
    changed: &Changed,
    (regions, sizes): (usize, usize),
    warnings: &mut Vec<ImportWarning>,
) {
    let further: usize = document.problems.iter().map(|problem| problem.goals.len().saturating_sub(1)).sum();
    let mut warn = |count: usize, code, message: fn(usize) -> Message| {
        if count > 0 {
            warnings.push(ImportWarning::new(code, message(count)));
        }
    };
    warn(regions, "goal-interval", sentences::goals_are_regions);
    warn(further, "goals-dropped", sentences::goals_beyond_first);
    warn(sizes, "sizes-assumed", sentences::sizes_assumed_car);
    warn(changed.uncertain, "uncertain-states", sentences::obstacles_uncertain);
    warn(changed.sets, "occupancy-sets", sentences::obstacles_are_sets);
    warn(changed.shapes, "shapes-approximated", sentences::shapes_boxed);
    warn(changed.dropped, "obstacles-dropped", sentences::obstacles_unplaced);
    warn(changed.cut, "obstacles-empty", sentences::obstacles_absent);
    warn(document.others, "elements-dropped", sentences::elements_unread);
    if document.lanelets.is_empty() {
        warnings.push(ImportWarning::new("no-map", sentences::map_lacks_lanelets()));
    }
}
