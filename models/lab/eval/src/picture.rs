//! Pictures of futures over the map, as SVG.

use super::quality::{AnswerSource, Outcome, alone};
use super::{Site, Subset, type_name};
use anyhow::Result;
use experts::Generator;
use rayon::prelude::*;
use scene::geometry::obb::OrientedBox;
use scene::map::LaneType;
use scene::random::Key;
use scene::{AgentFutures, AgentType, Scene, Size, Vec2};
use std::collections::BTreeMap;
use std::fmt::Write as _;

/// Number of pictures of each kind.
const EACH: usize = 10;

/// The ten best, ten worst and ten random cases of each type by minADE, without a goal and with its position
/// fixed: name (`vehicle-pos-worst-01-SCENE-AGENT.svg`) and SVG.
///
/// # Errors
/// When the generator fails.
pub fn of_outcomes(
    generator: &Generator,
    sites: &[Site<'_>],
    outcomes: &[Outcome],
    seed: u64,
) -> Result<Vec<(String, String)>> {
    let mut wanted: Vec<(String, &Outcome)> = Vec::new();
    for agent_type in [AgentType::Vehicle, AgentType::Pedestrian, AgentType::Cyclist] {
        for subset in [Subset::None, Subset::Pos] {
            let mine = |o: &&Outcome| {
                o.method == AnswerSource::Refined(0) && o.agent_type == agent_type && o.subset == subset
            };
            let mut all: Vec<&Outcome> = outcomes.iter().filter(mine).collect();
            all.sort_by(|a, b| a.measured.min_ade.total_cmp(&b.measured.min_ade));
            let best: Vec<&Outcome> = all.iter().take(EACH).copied().collect();
            let worst: Vec<&Outcome> = all.iter().rev().take(EACH).copied().collect();
            Key::default()
                .number(seed)
                .words(&["pictures", type_name(agent_type), subset.name()])
                .stream()
                .shuffle(&mut all);
            all.truncate(EACH);
            for (word, list) in [("best", best), ("worst", worst), ("random", all)] {
                for (i, outcome) in list.into_iter().enumerate() {
                    let name = format!("{}-{}-{word}-{:02}", type_name(agent_type), subset.name(), i + 1);
                    wanted.push((name, outcome));
                }
            }
        }
    }
    let drawn: Result<Vec<_>> = wanted
        .par_iter()
        .map(|(name, outcome)| Ok((name, drawn(generator, &sites[outcome.site], outcome, seed)?)))
        .collect();
    let drawn = drawn?.into_iter();
    Ok(drawn.filter_map(|(name, found)| found.map(|(who, svg)| (format!("{name}-{who}.svg"), svg))).collect())
}

/// Scene and road user as words of a file name, and the picture.
fn drawn(
    generator: &Generator,
    site: &Site<'_>,
    outcome: &Outcome,
    seed: u64,
) -> Result<Option<(String, String)>> {
    let case = &site.cases[outcome.case];
    let Some((futures, _)) = alone(generator, site, case, outcome.subset, true, seed)? else {
        return Ok(None);
    };
    // The picture shows the log, which the experts did not see.
    let mut scene = site.scene.clone();
    let agent = &mut scene.agents[case.agent];
    agent.conditions.goal = case.goal(site.scene, outcome.subset);
    let id = agent.id.clone();
    let who = who(site, &id);
    let futures = BTreeMap::from([(id, futures)]);
    Ok(Some((who, futures_svg(&scene, &futures, case.start.position()))))
}

/// Scene and road user as words of a file name.
pub(super) fn who(site: &Site<'_>, id: &str) -> String {
    let plain: String = site.name().chars().filter(|c| c.is_ascii_alphanumeric() || *c == '-').collect();
    format!("{}-{}", if plain.is_empty() { "scene" } else { &plain }, id.replace(':', "_"))
}

/// Half the side of the visible square, metres.
const HALF_M: f64 = 70.0;
const SIDE_PX: f64 = 900.0;

/// Lanes grey, edges dark, boxes at the start, log black, futures orange, the shown one red with its box each
/// second and its faults, goals as circles.
pub fn futures_svg(scene: &Scene, futures: &BTreeMap<String, AgentFutures>, centre: Vec2) -> String {
    marked_svg(scene, futures, centre, None)
}

/// The same picture with a ring at the start of one road user, and its id.
pub fn marked_svg(
    scene: &Scene,
    futures: &BTreeMap<String, AgentFutures>,
    centre: Vec2,
    marked: Option<&str>,
) -> String {
    let mut out = format!(
        "<svg xmlns='http://www.w3.org/2000/svg' width='{SIDE_PX}' height='{SIDE_PX}' viewBox='0 0 {SIDE_PX} {SIDE_PX}' style='background:#fff'>\n"
    );
    let scale = SIDE_PX / (2.0 * HALF_M);
    let at = |p: Vec2| ((p.x - centre.x + HALF_M) * scale, (HALF_M - (p.y - centre.y)) * scale);
    let line = |out: &mut String, points: &mut dyn Iterator<Item = Vec2>, style: &str| {
        let mut path = String::new();
        for p in points {
            let (x, y) = at(p);
            let _ = write!(path, "{x:.1},{y:.1} ");
        }
        let _ = writeln!(out, "<polyline points='{path}' fill='none' {style}/>");
    };
    for lane in &scene.map.lanes {
        let colour = match lane.lane_type {
            LaneType::BikeLane => "#bfe3cd",
            LaneType::Sidewalk => "#efe6da",
            _ => "#dcdfe4",
        };
        let style =
            format!("stroke='{colour}' stroke-width='{:.1}'", lane.width_or_assumed_m() * 0.8 * scale);
        line(&mut out, &mut lane.points.xy.iter().copied(), &style);
    }
    for edge in &scene.map.road_edges {
        line(&mut out, &mut edge.points.xy.iter().copied(), "stroke='#777' stroke-width='1.2'");
    }
    for crosswalk in &scene.map.crosswalks {
        line(&mut out, &mut crosswalk.polygon.xy.iter().copied(), "stroke='#99a' stroke-dasharray='3 3'");
    }
    for agent in &scene.agents {
        let Some(start) = agent.state_at(0) else { continue };
        let colour = match agent.agent_type {
            AgentType::Pedestrian => "#7a4b6e",
            AgentType::Cyclist => "#c06a00",
            _ => "#3867d6",
        };
        let outline = OrientedBox::of_state(&start, &agent.size);
        let corners = outline.corners();
        let fill = format!("stroke='{colour}' stroke-width='1.5'");
        line(&mut out, &mut corners.iter().chain(&corners[..1]).copied(), &fill);
        if futures.contains_key(&agent.id) {
            for (at_s, shown) in boxes_of(&futures[&agent.id], &agent.size) {
                let corners = shown.corners();
                let width = if at_s % 3 == 0 { 1.2 } else { 0.5 };
                let style = format!("stroke='#d92d20' stroke-width='{width}'");
                line(&mut out, &mut corners.iter().chain(&corners[..1]).copied(), &style);
            }
            let mut logged = agent.track.states.iter().flatten().map(scene::State::position);
            line(&mut out, &mut logged, "stroke='#000' stroke-width='1.6' stroke-dasharray='5 3'");
        }
    }
    for (id, all) in futures {
        for fault in all.modes.get(all.chosen).map_or(&[][..], |f| &f.about.faults) {
            let (x, y) = at(Vec2::new(fault.x_m, fault.y_m));
            let (kind, time_s) = (fault.kind, fault.time_s);
            let with = fault.with.as_deref().unwrap_or_default();
            let extent = fault.extent.map(|e| format!(" {e:.1}")).unwrap_or_default();
            let _ = writeln!(
                out,
                "<text x='{x:.1}' y='{y:.1}' font-size='13' fill='#7a1009'>{id}: {kind:?}{extent} {with} \
                 {time_s:.1} s</text>"
            );
        }
        for (i, future) in all.modes.iter().enumerate().rev() {
            let style = if i == all.chosen {
                "stroke='#d92d20' stroke-width='2.4'".to_owned()
            } else {
                format!(
                    "stroke='#f79009' stroke-width='{:.1}' stroke-opacity='0.75'",
                    1.0 + 2.0 * future.probability
                )
            };
            line(&mut out, &mut future.states.iter().map(scene::State::position), &style);
            for second in future.states.iter().skip(9).step_by(10) {
                let (x, y) = at(second.position());
                let _ = writeln!(out, "<circle cx='{x:.1}' cy='{y:.1}' r='1.6' fill='#444'/>");
            }
        }
        if let Some(goal) = scene.agent(id).and_then(|a| a.conditions.goal.position) {
            let (x, y) = at(goal);
            let _ = writeln!(
                out,
                "<circle cx='{x:.1}' cy='{y:.1}' r='5' fill='none' stroke='#00794c' stroke-width='2'/>"
            );
        }
    }
    if let Some(start) = marked.and_then(|id| scene.agent(id)).and_then(|agent| agent.state_at(0)) {
        let ((x, y), id) = (at(start.position()), marked.unwrap_or_default());
        let _ = writeln!(
            out,
            "<circle cx='{x:.1}' cy='{y:.1}' r='26' fill='none' stroke='#101828' stroke-width='2.5'/>\n\
             <text x='{:.1}' y='{:.1}' font-size='22' font-weight='bold' fill='#101828'>{id}</text>",
            x + 30.0,
            y - 14.0
        );
    }
    out.push_str("</svg>\n");
    out
}

/// Second and box of the shown future at each full second.
fn boxes_of(futures: &AgentFutures, size: &Size) -> Vec<(usize, OrientedBox)> {
    let shown = futures.modes.get(futures.chosen).map_or(&[][..], |f| &f.states);
    let seconds = shown.iter().skip(9).step_by(10).enumerate();
    seconds.map(|(i, state)| (i + 1, OrientedBox::of_state(state, size))).collect()
}
