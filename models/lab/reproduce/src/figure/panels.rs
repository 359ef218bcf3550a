//! One panel: a scene, its conditions, and the generated motion.

use super::choose::{Found, Role};
use anyhow::Result;
use experts::placement::{Amount, PlaceRequest, Region};
use experts::{Cancel, Engine, ReachReport, React, Request, Resolved};
use lab_eval::Site;
use lab_eval::picture::{futures_svg, marked_svg};
use lab_eval::together::{asked, generated};
use scene::geometry::{direction, rotate};
use scene::{AgentFutures, Goal, HORIZON_STEPS, STEP_S, Sample, Scene, Vec2, wrap_angle};
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

/// Number of road users that are created, and their greatest distance from the middle, metres.
const CREATED: (usize, f64) = (28, 60.0);
/// The paper's condition of case (d): metres ahead, and velocity along and across the heading.
const AHEAD_M: f64 = 100.0;
const VELOCITY_MPS: [f64; 2] = [20.0, -2.0];
/// Greatest distance between a picture's centre and the start of its road user, metres.
const MIDDLE_M: f64 = 45.0;
/// The goal of an edited vehicle at the end is its position at this step.
const EDITED_STEP: usize = 50;

/// A picture with its words.
#[derive(Clone, Debug, PartialEq)]
pub struct Panel {
    /// Name in the page.
    pub id: String,
    /// Heading.
    pub title: String,
    /// Conditions and result, in words.
    pub words: String,
    /// Picture.
    pub svg: String,
}

/// Caption of a picture that is not yet drawn.
struct Caption<'a> {
    /// Name in the page.
    id: &'a str,
    title: &'a str,
    /// Conditions, in words.
    words: &'a str,
}

/// The panels of what was found in a scene.
///
/// # Errors
/// When the generator fails.
pub(super) fn draw(found: &Found, site: &Site<'_>, engine: &Engine, seed: u64) -> Result<Vec<Panel>> {
    let Some(who) = found.who else { return Ok(vec![creating(site, engine, seed)?]) };
    let agent = &site.scene.agents[who];
    let Some(start) = agent.state_at(0) else { return Ok(Vec::new()) };
    let everybody: BTreeSet<String> =
        generated(site).into_iter().map(|i| site.scene.agents[i].id.clone()).collect();
    let logged = |title: &str, role: Role| -> Result<Panel> {
        let scene = asked(site, true);
        let words =
            "Everybody there is generated, with the states of the first frame and of the 90th as conditions.";
        let caption = Caption { id: role.id(), title, words };
        panel(caption, &scene, site.scene, (&everybody, &agent.id), engine, seed)
    };
    Ok(match found.role {
        Role::Creating => Vec::new(),
        Role::Left => vec![logged("(a) Left turn at an intersection", Role::Left)?],
        Role::Right => vec![logged("(b) Right turn at an intersection", Role::Right)?],
        Role::Waiting => {
            let mut first = logged("(c) A vehicle waits while people move around it", Role::Waiting)?;
            first.words += &format!(" On foot or bicycles near it, moving: {:.0}.", found.score);
            let mut scene = asked(site, true);
            let [along, across] = VELOCITY_MPS;
            scene.agents[who].conditions.goal = Goal {
                position: Some(start.position() + AHEAD_M * direction(start.heading_rad)),
                heading_rad: Some(wrap_angle(start.heading_rad + across.atan2(along))),
                speed_mps: Some(along.hypot(across)),
                time_s: Some(HORIZON_STEPS as f64 * STEP_S),
            };
            let words = "The same scene; the vehicle that waited is to be 100 m ahead after 9 s, at 20 m/s along and \
                         -2 m/s across its heading.";
            let caption = Caption { id: "case-d", title: "(d) The same vehicle is told to go", words };
            let second = panel(caption, &scene, site.scene, (&everybody, &agent.id), engine, seed)?;
            vec![first, second]
        }
        Role::Editing => {
            let mut scene = site.scene.clone();
            let Some(earlier) = agent.state_at(EDITED_STEP) else { return Ok(Vec::new()) };
            scene.agents[who].conditions.goal = Goal {
                position: Some(earlier.position()),
                heading_rad: Some(earlier.heading_rad),
                speed_mps: None,
                time_s: Some(HORIZON_STEPS as f64 * STEP_S),
            };
            let words = "A vehicle's end is dragged back: it is to be only after 9 s where it was after 5 s. The others \
                         keep their logs unless they have a cause to react.";
            let caption = Caption { id: "editing", title: "Editing", words };
            vec![edited(caption, &scene, (&agent.id, true), engine, seed)?]
        }
        Role::Correcting => {
            let mut scene = site.scene.clone();
            scene.agents[who].conditions.goal = lab_eval::together::joint_goal(site, who);
            let words = "A track that no vehicle can have driven (black dashes) is generated anew from its first state to \
                         its last.";
            let caption = Caption { id: "correcting", title: "Correcting", words };
            vec![edited(caption, &scene, (&agent.id, false), engine, seed)?]
        }
    })
}

/// A map without road users, then placed road users, then their motion.
fn creating(site: &Site<'_>, engine: &Engine, seed: u64) -> Result<Panel> {
    let mut scene = site.blind.clone();
    let middle = scene.agents.iter().find(|a| a.role.as_deref() == Some("ego")).or(scene.agents.first());
    let middle = middle.and_then(|a| a.state_at(0)).map_or(Vec2::zeros(), |s| s.position());
    scene.agents.clear();
    let (count, radius_m) = CREATED;
    let request = PlaceRequest {
        region: Region::Circle { center: middle, radius_m },
        amount: Amount::Count(count),
        seed,
        ..PlaceRequest::new(Arc::new(scene.clone()))
    };
    scene.agents = engine.placer.place(&request, &Cancel::default())?.agents;
    let all: BTreeSet<String> = scene.agents.iter().map(|a| a.id.clone()).collect();
    let words = format!(
        "{} road users are placed within {radius_m:.0} m on the empty map, then driven without any condition.",
        all.len()
    );
    let mut request = Request::new(Arc::new(scene.clone()));
    (request.agents, request.seed) = (Some(all), seed);
    let done = engine.generator.answer(request)?;
    let sample = done.samples.into_iter().next().unwrap_or_default();
    Ok(Panel {
        id: "creating".into(),
        title: "Creating".into(),
        words: format!("{words} {}", faults(&sample)),
        svg: futures_svg(&scene, &shown(&sample), middle),
    })
}

/// All road users generated together, without their logs.
fn panel(
    caption: Caption<'_>,
    scene: &Scene,
    log: &Scene,
    (everybody, who): (&BTreeSet<String>, &String),
    engine: &Engine,
    seed: u64,
) -> Result<Panel> {
    let mut request = Request::new(Arc::new(scene.clone()));
    (request.agents, request.seed) = (Some(everybody.clone()), seed);
    let done = engine.generator.answer(request)?;
    let sample = done.samples.into_iter().next().unwrap_or_default();
    let reached = done.resolved.get(who).map(|r| outcome(r, scene, &sample, who)).unwrap_or_default();
    let mut drawn = log.clone();
    for (own, asked) in drawn.agents.iter_mut().zip(&scene.agents) {
        // Rings only for moving goals; the ring of a goal at the start would hide the box.
        let goal = asked.conditions.goal;
        let moves = |p: Vec2| own.state_at(0).is_some_and(|s| (p - s.position()).norm() > 2.0);
        if goal.position.is_some_and(moves) {
            own.conditions.goal = goal;
        }
    }
    Ok(Panel {
        id: caption.id.into(),
        title: caption.title.into(),
        words: format!("{} {reached} {}", caption.words, faults(&sample)),
        svg: marked_svg(&drawn, &shown(&sample), middle(scene, who), Some(who)),
    })
}

/// One road user is generated in the recording; the others react or keep their logs.
fn edited(
    caption: Caption<'_>,
    scene: &Scene,
    (who, react): (&String, bool),
    engine: &Engine,
    seed: u64,
) -> Result<Panel> {
    let mut request = Request::new(Arc::new(scene.clone()));
    (request.agents, request.seed) = (Some(BTreeSet::from([who.clone()])), seed);
    request.react = if react { React::Everyone } else { React::Nobody };
    let done = engine.generator.answer(request)?;
    let sample = done.samples.into_iter().next().unwrap_or_default();
    let reached = done.resolved.get(who).map(|r| outcome(r, scene, &sample, who)).unwrap_or_default();
    let others = match sample.agents.len().saturating_sub(1) {
        _ if !react => String::new(),
        0 => "Nobody else has a cause to change.".to_owned(),
        1 => "One other changes its motion.".to_owned(),
        n => format!("{n} others change their motion."),
    };
    Ok(Panel {
        id: caption.id.into(),
        title: caption.title.into(),
        words: format!("{} {reached} {others} {}", caption.words, faults(&sample)),
        svg: marked_svg(scene, &shown(&sample), middle(scene, who), Some(who)),
    })
}

/// A point between the start and the requested end, so that both are visible.
fn middle(scene: &Scene, who: &str) -> Vec2 {
    let agent = scene.agent(who);
    let start = agent.and_then(|a| a.state_at(0)).map_or(Vec2::zeros(), |s| s.position());
    let end = agent.and_then(|a| a.conditions.goal.position).unwrap_or(start);
    let way = end - start;
    start + way * (0.5_f64).min(MIDDLE_M / way.norm().max(1e-6))
}

/// Only the shown futures.
fn shown(sample: &Sample) -> BTreeMap<String, AgentFutures> {
    let one = |futures: &AgentFutures| {
        let mode = futures.modes.get(futures.chosen).cloned();
        AgentFutures::of(0, mode.into_iter().collect())
    };
    sample.agents.iter().map(|(id, futures)| (id.clone(), one(futures))).collect()
}

/// Result of the condition on the panel's road user.
fn outcome(resolved: &Resolved, scene: &Scene, sample: &Sample, who: &str) -> String {
    let end = sample.agents.get(who).and_then(|f| f.modes.get(f.chosen)).and_then(|m| m.states.last());
    let start = scene.agent(who).and_then(|a| a.state_at(0));
    let way = match (start, end) {
        (Some(start), Some(end)) => {
            let local = |v: Vec2| rotate(v, -start.heading_rad);
            // Rounded here: nothing is "-0.0" m away.
            let tidy = |v: Vec2| v.map(|x| (10.0 * x).round() / 10.0 + 0.0);
            let moved = tidy(local(end.position() - start.position()));
            let velocity = tidy(local(end.velocity()));
            format!(
                "Road user {who} ends {:.1} m ahead and {:.1} m to the left, at {:.1} m/s along and {:.1} m/s across its \
                 first heading",
                moved.x, moved.y, velocity.x, velocity.y
            )
        }
        _ => format!("Road user {who}"),
    };
    match &resolved.reach {
        ReachReport::Reached { position_m, .. } => format!("{way}: {position_m:.2} m from what was asked."),
        ReachReport::Unreachable { words, .. } => format!("{way}; what was asked is out of reach: {words}"),
    }
}

/// Number of shown futures with each kind of fault.
fn faults(sample: &Sample) -> String {
    let mut kinds: BTreeMap<String, usize> = BTreeMap::new();
    for futures in sample.agents.values() {
        let found = futures.modes.get(futures.chosen).map_or(&[][..], |mode| &mode.about.faults);
        let own: BTreeSet<String> = found.iter().map(|fault| word(&format!("{:?}", fault.kind))).collect();
        own.into_iter().for_each(|kind| *kinds.entry(kind).or_default() += 1);
    }
    let all = sample.agents.len();
    if kinds.is_empty() {
        return format!("The judge finds nothing wrong with the {all} that are generated.");
    }
    let list: Vec<String> = kinds.iter().map(|(kind, count)| format!("{kind} {count}")).collect();
    format!("Of {all} generated the judge finds: {}.", list.join(", "))
}

/// `NearMiss` as `near miss`.
fn word(name: &str) -> String {
    let mut out = String::new();
    for c in name.chars() {
        if c.is_uppercase() && !out.is_empty() {
            out.push(' ');
        }
        out.extend(c.to_lowercase());
    }
    out
}
