//! Pictures of futures over the map, as SVG.

use super::{Subset, answer, cases};
use anyhow::Result;
use experts::{Generator, Request};
use scene::map::LaneType;
use scene::{AgentFutures, AgentType, Scene, Vec2};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;
use std::path::Path;
use std::sync::Arc;

/// Pictures of every third moving road user, without a goal and with its position fixed:
/// `SCENE-AGENT-CONDITION.svg`.
///
/// # Errors
/// When the generator fails or a file cannot be written.
pub fn write_all(generator: &Generator, scenes: &[Scene], folder: &Path) -> Result<()> {
    std::fs::create_dir_all(folder)?;
    for scene in scenes {
        for case in cases(scene).into_iter().step_by(3) {
            for subset in [Subset::None, Subset::Pos] {
                let mut changed = scene.clone();
                let agent = &mut changed.agents[case.agent];
                agent.conditions.goal = case.goal(scene, subset);
                let id = agent.id.clone();
                let Some(start) = agent.state_at(0) else { continue };
                let mut request = Request::new(Arc::new(changed.clone()));
                request.agents = Some(BTreeSet::from([id.clone()]));
                let answer = answer(generator, request)?;
                let Some(sample) = answer.samples.first() else { continue };
                let picture = futures_svg(&changed, &sample.agents, start.position());
                let place = scene.meta.source_id.as_deref().unwrap_or(&scene.name);
                std::fs::write(folder.join(format!("{place}-{id}-{}.svg", subset.name())), picture)?;
            }
        }
    }
    Ok(())
}

/// Half the side of the square that is shown, metres.
const HALF_M: f64 = 70.0;
const SIDE_PX: f64 = 900.0;

/// Lanes grey, edges dark, boxes at the start, log black, futures orange, the shown one red, goals as stars.
pub fn futures_svg(scene: &Scene, futures: &BTreeMap<String, AgentFutures>, centre: Vec2) -> String {
    let mut out = format!(
        "<svg xmlns='http://www.w3.org/2000/svg' width='{SIDE_PX}' height='{SIDE_PX}' style='background:#fff'>\n"
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
        let outline = scene::geometry::obb::OrientedBox::of_state(&start, &agent.size);
        let corners = outline.corners();
        let fill = format!("stroke='{colour}' stroke-width='1.5'");
        line(&mut out, &mut corners.iter().chain(&corners[..1]).copied(), &fill);
        if futures.contains_key(&agent.id) {
            let mut logged = agent.track.states.iter().flatten().map(scene::State::position);
            line(&mut out, &mut logged, "stroke='#000' stroke-width='1.6' stroke-dasharray='5 3'");
        }
    }
    for (id, all) in futures {
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
    out.push_str("</svg>\n");
    out
}
