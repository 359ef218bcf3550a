//! Pictures of scenes as PNG: roads, signals, road users with their ids, chosen futures, goals, and a scale.
//!
//! Equal scenes give equal bytes: text uses built-in letters, no font of the machine.

mod glyphs;
mod paper;
mod view;

pub use view::SceneView;

use paper::{Ink, LineStyle, Paper, SIDE_PX, text_width};
use scene::geometry::direction;
use scene::geometry::obb::OrientedBox;
use scene::map::{Lane, LaneType};
use scene::{AgentType, Scene, SignalState, State, Vec2};

const GROUND: Ink = (247, 247, 244, 255);
const ROAD: Ink = (222, 225, 230, 255);
const BIKE_LANE: Ink = (201, 229, 212, 255);
const SIDEWALK: Ink = (238, 230, 219, 255);
const CENTRE_LINE: Ink = (190, 195, 203, 255);
const EDGE: Ink = (95, 99, 104, 255);
const CROSSWALK: Ink = (130, 130, 160, 255);
const VEHICLE: Ink = (56, 103, 214, 255);
const PEDESTRIAN: Ink = (150, 60, 130, 255);
const CYCLIST: Ink = (192, 106, 0, 255);
const OTHER: Ink = (120, 120, 120, 255);
const FUTURE: Ink = (217, 45, 32, 255);
const REACTION: Ink = (247, 144, 9, 255);
const GOAL: Ink = (0, 121, 76, 255);
const TEXT: Ink = (16, 24, 40, 255);

/// Pixels per square of a letter.
const LETTER_PX: f32 = 2.0;
/// Distance of arrows on a lane, metres.
const ARROWS_M: f64 = 25.0;
/// Possible lengths of the scale, metres.
const SCALES_M: [f64; 7] = [2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 500.0];

/// A scene at a step as PNG, 800 by 800 pixels; `None` if there is no memory for it.
pub fn png(scene: &Scene, view: SceneView, step: usize) -> Option<Vec<u8>> {
    let mut paper = Paper::new(view, GROUND)?;
    roads(&mut paper, scene);
    lights(&mut paper, scene, step);
    futures(&mut paper, scene);
    road_users(&mut paper, scene, step);
    scale(&mut paper, view);
    paper.png()
}

fn roads(paper: &mut Paper, scene: &Scene) {
    let map = &scene.map;
    for area in &map.drivable {
        let holes = area.holes.iter().map(|hole| &*hole.xy);
        let rings: Vec<&[Vec2]> = std::iter::once(&*area.polygon.xy).chain(holes).collect();
        paper.area(&rings, ROAD);
    }
    for lane in &map.lanes {
        let ink = match lane.lane_type {
            LaneType::BikeLane => BIKE_LANE,
            LaneType::Sidewalk => SIDEWALK,
            _ => ROAD,
        };
        let width_px = paper.px(lane.width_or_assumed_m());
        paper.line(&lane.points.xy, false, LineStyle::plain(ink, width_px));
    }
    for lane in &map.lanes {
        paper.line(&lane.points.xy, false, LineStyle::plain(CENTRE_LINE, 1.0));
        arrows(paper, lane);
    }
    for crosswalk in &map.crosswalks {
        let style = LineStyle { ink: CROSSWALK, width_px: 1.5, dash_px: Some(4.0) };
        paper.line(&crosswalk.polygon.xy, true, style);
    }
    for edge in &map.road_edges {
        paper.line(&edge.points.xy, false, LineStyle::plain(EDGE, 1.5));
    }
}

/// Small arrows along a lane, in driving direction.
fn arrows(paper: &mut Paper, lane: &Lane) {
    let mut left_m = 0.5 * ARROWS_M;
    for pair in lane.points.xy.windows(2) {
        let along = pair[1] - pair[0];
        let length = along.norm();
        while left_m <= length && length > 0.0 {
            let forward = along / length;
            let tip = pair[0] + forward * left_m;
            let side = Vec2::new(-forward.y, forward.x) * 0.7;
            let back = tip - forward * 1.4;
            paper.line(&[back + side, tip, back - side], false, LineStyle::plain(CENTRE_LINE, 1.5));
            left_m += ARROWS_M;
        }
        left_m -= length;
    }
}

fn lights(paper: &mut Paper, scene: &Scene, step: usize) {
    for signal in &scene.signals {
        let lane = || scene.map.lanes.iter().find(|lane| lane.id == signal.lane);
        let Some(place) = signal.stop.or_else(|| lane()?.points.xy.first().copied()) else { continue };
        let ink = match signal.last_known(step).0 {
            state if state.is_stop() => (214, 40, 40, 255),
            state if state.is_caution() || state == SignalState::FlashingCaution => (240, 170, 0, 255),
            SignalState::Unknown => (140, 140, 140, 255),
            _ => (30, 150, 70, 255),
        };
        paper.dot(place, 5.0, (255, 255, 255, 255));
        paper.dot(place, 4.0, ink);
    }
}

/// Chosen futures with a dot per second, and goals.
fn futures(paper: &mut Paper, scene: &Scene) {
    for agent in &scene.agents {
        if let Some(goal) = agent.conditions.goal.position {
            paper.ring(goal, 7.0, GOAL);
            paper.dot(goal, 2.0, GOAL);
        }
        for via in &agent.conditions.via {
            paper.ring(via.position, 4.0, GOAL);
        }
        let Some(generated) = &scene.generated else { continue };
        let sample = generated.samples.get(generated.chosen_sample);
        let Some(futures) = sample.and_then(|sample| sample.agents.get(&agent.id)) else { continue };
        let Some(future) = futures.modes.get(futures.chosen) else { continue };
        let ink = if futures.reaction.is_some() { REACTION } else { FUTURE };
        let line: Vec<Vec2> = future.states.iter().map(State::position).collect();
        paper.line(&line, false, LineStyle::plain(ink, 2.5));
        for second in future.states.iter().skip(9).step_by(10) {
            paper.dot(second.position(), 2.5, ink);
        }
    }
}

fn road_users(paper: &mut Paper, scene: &Scene, step: usize) {
    let mut names = Vec::new();
    for agent in &scene.agents {
        let shown = scene.shown(agent);
        let Some(state) = shown.track.at(step) else { continue };
        let ink = match shown.agent_type {
            AgentType::Vehicle => VEHICLE,
            AgentType::Pedestrian => PEDESTRIAN,
            AgentType::Cyclist => CYCLIST,
            AgentType::Other => OTHER,
        };
        let corners = OrientedBox::of_state(state, &shown.size).corners();
        paper.area(&[&corners], ink);
        let forward = direction(state.heading_rad);
        let front = state.position() + forward * (0.5 * shown.size.length_m);
        let middle = state.position() + forward * (0.15 * shown.size.length_m);
        paper.line(&[middle, front], false, LineStyle::plain((255, 255, 255, 255), 2.0));
        names.push((state.position(), shown.size.length_m, agent.id.as_str()));
    }
    // Drawn after all boxes, so that none covers a name.
    for (place, length_m, name) in names {
        let (x, y) = paper.at(place);
        let beside = paper.px(0.5 * length_m).min(14.0) + 3.0;
        paper.text((x + beside, y - beside - 8.0), name, LETTER_PX, TEXT);
    }
}

/// The scale at the lower left, and the coordinates of the lower left and the upper right corner.
fn scale(paper: &mut Paper, view: SceneView) {
    let fitting = SCALES_M.iter().rev().find(|length| **length <= 0.25 * view.width_m);
    let length_m = fitting.copied().unwrap_or(SCALES_M[0]);
    let side = SIDE_PX as f32;
    let length = paper.px(length_m);
    paper.rectangle((12.0, side - 34.0), (length, 4.0), TEXT);
    paper.text((16.0 + length, side - 38.0), &format!("{length_m:.0} m"), LETTER_PX, TEXT);
    let half = 0.5 * view.width_m;
    let corner = |sign: f64| {
        let place = view.centre + Vec2::new(sign * half, sign * half);
        format!("x {:.0} y {:.0}", place.x, place.y)
    };
    paper.text((12.0, side - 18.0), &corner(-1.0), LETTER_PX, TEXT);
    let upper = corner(1.0);
    paper.text((side - 12.0 - text_width(&upper, LETTER_PX), 10.0), &upper, LETTER_PX, TEXT);
}

#[cfg(test)]
mod tests {
    use super::*;
    use scene::{Agent, LaneMap, Subtype};

    fn scene() -> Scene {
        let road = Lane::street("road", vec![Vec2::new(-40.0, 0.0), Vec2::new(40.0, 0.0)]);
        let car = vec![Some(State { x_m: 5.0, vx_mps: 3.0, ..State::default() })];
        let agents = vec![Agent::bare("a:1", AgentType::Vehicle, Subtype::Car, car)];
        Scene::bare("road", LaneMap { lanes: vec![road], ..LaneMap::default() }, agents)
    }

    fn pixel(bytes: &[u8], x: u32, y: u32) -> (u8, u8, u8) {
        let picture = tiny_skia::Pixmap::decode_png(bytes).unwrap();
        let colour = picture.pixel(x, y).unwrap();
        (colour.red(), colour.green(), colour.blue())
    }

    #[test]
    fn a_picture_shows_the_road_and_who_is_on_it() {
        let scene = scene();
        let view = SceneView::around(Vec2::new(5.0, 0.0), 80.0);
        let bytes = png(&scene, view, 0).unwrap();
        assert_eq!(bytes, png(&scene, view, 0).unwrap());
        let of = |(red, green, blue, _): Ink| (red, green, blue);
        // Ten pixels per metre, the car in the middle.
        assert_eq!(pixel(&bytes, 385, 400), of(VEHICLE));
        assert_eq!(pixel(&bytes, 300, 410), of(ROAD));
        assert_eq!(pixel(&bytes, 300, 300), of(GROUND));
        // At a later step it is gone.
        assert_ne!(pixel(&png(&scene, view, 50).unwrap(), 385, 400), of(VEHICLE));
    }

    #[test]
    fn a_view_holds_all_road_users_or_the_map() {
        let mut scene = scene();
        scene.agents.push(Agent { id: "b".into(), ..scene.agents[0].clone() });
        let far = vec![Some(State { x_m: 105.0, y_m: 20.0, ..State::default() })];
        scene.agents[1].track = scene::Track { first_step: 0, states: far, z_m: None }.into();
        let view = SceneView::whole(&scene, 0);
        assert_eq!((view.centre, view.width_m), (Vec2::new(55.0, 10.0), 140.0));
        scene.agents.clear();
        assert_eq!(SceneView::whole(&scene, 0), SceneView { centre: Vec2::zeros(), width_m: 80.0 });
        let empty = Scene::bare("", LaneMap::default(), Vec::new());
        assert!(png(&empty, SceneView::whole(&empty, 0), 0).is_some());
    }
}
