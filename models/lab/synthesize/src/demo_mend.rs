//! Corrects a demo scene without another simulation: medians end in a nose, isolated pieces of road are
//! removed, and no vehicle drives over a kerb or steers abruptly.

use super::filters::{gaussian, gradient, unwrap};
use formats::sumo::medians;
use scene::geometry::obb::OrientedBox;
use scene::geometry::{cross, direction};
use scene::map::{LaneMap, LaneType};
use scene::score::{Drivable, ScoreInput, score};
use scene::{Agent, AgentType, STEP_S, Scene, State, Vec2, wrap_angle};

/// Unconnected lanes shorter than this are remains of the cut, metres.
const FRAGMENT_M: f64 = 30.0;
/// Corners are moved this far inside the kerb, metres.
const CLEAR_M: f64 = 0.05;
/// Vehicles farther over the kerb than this are moved back, metres.
const OVER_M: f64 = 0.08;
/// Greatest distance of a corner over the kerb after that, metres.
const LET_M: f64 = 0.03;
/// Number of steps for which the correction holds before and after the place.
const HOLD: usize = 12;
/// Standard deviation of the Gaussian that smooths the correction, steps.
const SMOOTH: f64 = 7.0;
/// Smoothing of headings at unrealistically sharp turns: first value, which is also the increment, and
/// maximum, steps.
const CALM: (f64, f64) = (2.0, 8.0);
/// Most iterations of the correction.
const ROUNDS: usize = 12;

/// Corrects the scene. `half` is half a side of the square to which its map was cut, metres.
pub fn mend(mut scene: Scene, half: f64) -> Scene {
    let mut map = (*scene.map).clone();
    drop_fragments(&mut map, half);
    medians::close(&mut map, |p| p.amax() > half - 0.1);
    round(&mut map);
    let drivable = Drivable::new(&map);
    for agent in scene.agents.iter_mut().filter(|a| a.agent_type == AgentType::Vehicle) {
        keep_on_road(agent, &drivable);
    }
    scene.map = map.into();
    calm(&mut scene, &drivable);
    scene
}

/// Smooths the headings of road users that briefly turn too sharply.
fn calm(scene: &mut Scene, drivable: &Drivable) {
    let mut sigma = CALM.0;
    while sigma <= CALM.1 {
        let found = score(&ScoreInput::of_sample(scene, None, drivable)).scene;
        if found.harsh_steering.is_empty() {
            return;
        }
        let hard = |id: &str| found.harsh_steering.iter().any(|s| s.agent == id);
        for agent in scene.agents.iter_mut().filter(|a| hard(&a.id)) {
            let headings: Vec<f64> = agent.track.states.iter().flatten().map(|s| s.heading_rad).collect();
            let smooth = gaussian(&unwrap(&headings), sigma);
            for (state, heading) in agent.track.states.iter_mut().flatten().zip(smooth) {
                state.heading_rad = rounded(wrap_angle(heading), 1e4);
            }
        }
        sigma += CALM.0;
    }
}

fn rounded(value: f64, parts: f64) -> f64 {
    let value = (value * parts).round() / parts;
    if value == 0.0 { 0.0 } else { value }
}

/// Coordinates in whole centimetres.
fn round(map: &mut LaneMap) {
    for line in map.road_edges.iter_mut().chain(&mut map.road_lines) {
        line.points.xy.iter_mut().for_each(|p| *p = p.map(|v| rounded(v, 100.0)));
        line.points.xy.dedup();
    }
    for area in &mut map.drivable {
        area.polygon.xy.iter_mut().for_each(|p| *p = p.map(|v| rounded(v, 100.0)));
    }
}

/// Removes short lanes without predecessors and successors that begin or end inside the map, with their
/// surface and borders.
fn drop_fragments(map: &mut LaneMap, half: f64) {
    let inside = |p: Option<&Vec2>| p.is_some_and(|p| p.amax() < half - 0.1);
    let is_fragment = |l: &scene::map::Lane| {
        let xy = &l.points.xy;
        let long = xy.windows(2).map(|w| (w[1] - w[0]).norm()).sum::<f64>();
        let leads = !l.predecessors.is_empty() || !l.successors.is_empty();
        let beside = !l.left_neighbors.is_empty() || !l.right_neighbors.is_empty();
        let drives = matches!(l.lane_type, LaneType::Freeway | LaneType::SurfaceStreet);
        drives && !leads && !beside && long < FRAGMENT_M && (inside(xy.first()) || inside(xy.last()))
    };
    let (gone, kept): (Vec<_>, Vec<_>) = std::mem::take(&mut map.lanes).into_iter().partition(is_fragment);
    map.lanes = kept;
    for lane in &gone {
        let near = |p: &Vec2| lane.points.xy.windows(2).any(|w| off(w, *p) < lane.width_or_assumed_m());
        map.road_edges.retain(|e| !e.points.xy.iter().all(near));
        map.road_lines.retain(|e| !e.points.xy.iter().all(near));
        map.drivable.retain(|a| !a.polygon.xy.iter().all(near));
    }
}

/// Distance of a point from a segment, metres.
fn off(piece: &[Vec2], p: Vec2) -> f64 {
    let along = piece[1] - piece[0];
    let share = ((p - piece[0]).dot(&along) / along.norm_squared().max(1e-12)).clamp(0.0, 1.0);
    (piece[0] + along * share - p).norm()
}

/// Shifts the path of a vehicle sideways and smoothly until no corner is over the kerb. Parked vehicles stay.
fn keep_on_road(agent: &mut Agent, drivable: &Drivable) {
    if agent.role.as_deref() == Some("parked") {
        return;
    }
    let Some(first) = agent.track.states.iter().position(Option::is_some) else { return };
    let mut states: Vec<State> = agent.track.states.iter().flatten().copied().collect();
    let before = states.clone();
    let over = |s: &State| drivable.box_outside_m(&OrientedBox::of_state(s, &agent.size));
    if states.iter().filter_map(over).all(|m| m <= OVER_M) {
        return;
    }
    for _ in 0..ROUNDS {
        let needs: Vec<Vec2> = states.iter().map(|s| need(s, agent, drivable)).collect();
        if needs.iter().all(|n| n.norm() == 0.0) {
            break;
        }
        let held = |i: usize| {
            let around = &needs[i.saturating_sub(HOLD)..(i + HOLD + 1).min(needs.len())];
            around.iter().copied().max_by(|p, q| p.norm().total_cmp(&q.norm())).unwrap_or_default()
        };
        let held: Vec<Vec2> = (0..needs.len()).map(held).collect();
        let part = |k: usize| gaussian(&held.iter().map(|v| v[k]).collect::<Vec<_>>(), SMOOTH);
        for (state, (x, y)) in states.iter_mut().zip(part(0).into_iter().zip(part(1))) {
            (state.x_m, state.y_m) = (state.x_m + x, state.y_m + y);
        }
    }
    if states == before {
        return;
    }
    let shift = |k: usize| -> Vec<f64> {
        states.iter().zip(&before).map(|(s, b)| (s.position() - b.position())[k]).collect()
    };
    let (by_x, by_y) = (gradient(&shift(0), STEP_S), gradient(&shift(1), STEP_S));
    for (i, state) in states.iter_mut().enumerate() {
        let by = Vec2::new(by_x[i], by_y[i]);
        let speed = state.speed_mps();
        if speed > 1.0 {
            let turn = cross(direction(state.heading_rad), by) / speed;
            state.heading_rad = wrap_angle(state.heading_rad + turn);
        }
        *state = State {
            x_m: rounded(state.x_m, 1e3),
            y_m: rounded(state.y_m, 1e3),
            heading_rad: rounded(state.heading_rad, 1e4),
            vx_mps: rounded(state.vx_mps + by.x, 1e3),
            vy_mps: rounded(state.vy_mps + by.y, 1e3),
        };
    }
    for (slot, state) in agent.track.states[first..].iter_mut().zip(states) {
        *slot = Some(state);
    }
}

/// Displacement that brings a vehicle back on the road, metres, across its heading.
fn need(state: &State, agent: &Agent, drivable: &Drivable) -> Vec2 {
    let outline = OrientedBox::of_state(state, &agent.size);
    let beyond = outline.corners().into_iter().filter_map(|c| drivable.beyond(c));
    let Some((out_m, away)) = beyond.max_by(|p, q| p.0.total_cmp(&q.0)).filter(|b| b.0 > LET_M) else {
        return Vec2::zeros();
    };
    let left = outline.left();
    let side = if away.dot(&left) > 0.0 { -left } else { left };
    side * (out_m + CLEAR_M)
}

#[cfg(test)]
mod tests {
    use super::*;
    use scene::map::{Area, Lane};
    use scene::{Conditions, Size, Subtype, Track};

    fn at(x: f64, y: f64) -> Vec2 {
        Vec2::new(x, y)
    }

    #[test]
    fn a_driver_is_brought_back_from_the_kerb() {
        let ring = vec![at(-50.0, -2.0), at(150.0, -2.0), at(150.0, 2.0), at(-50.0, 2.0)];
        let area = Area { id: "1".into(), polygon: ring.into(), holes: Vec::new() };
        let drivable = Drivable::new(&LaneMap { drivable: vec![area], ..LaneMap::default() });
        // Half a metre over the right kerb from 3 to 5 s.
        let aside = |i: usize| if (30..50).contains(&i) { -1.5 } else { -0.9 };
        let state = |i: usize| State { x_m: i as f64, y_m: aside(i), vx_mps: 10.0, ..State::default() };
        let mut agent = Agent {
            id: "1".into(),
            agent_type: AgentType::Vehicle,
            subtype: Subtype::Car,
            role: None,
            size: Size { length_m: 4.0, width_m: 2.0, height_m: None },
            track: Track { first_step: 0, states: (0..91).map(|i| Some(state(i))).collect(), z_m: None }
                .into(),
            conditions: Conditions::default(),
        };
        keep_on_road(&mut agent, &drivable);
        let worst = |a: &Agent| {
            let boxes = a.track.states.iter().flatten().map(|s| OrientedBox::of_state(s, &a.size));
            boxes.filter_map(|b| drivable.box_outside_m(&b)).fold(0.0, f64::max)
        };
        assert!(worst(&agent) < 0.1, "{}", worst(&agent));
        // Farther away, states are unchanged.
        assert_eq!(agent.track.states[90], Some(state(90)));
    }

    #[test]
    fn road_that_leads_nowhere_is_dropped() {
        let mut map = LaneMap {
            lanes: vec![
                Lane::street("1", vec![at(-125.0, 0.0), at(-110.0, 0.0)]),
                Lane::street("2", vec![at(-125.0, 50.0), at(125.0, 50.0)]),
            ],
            ..LaneMap::default()
        };
        drop_fragments(&mut map, 125.0);
        assert_eq!(map.lanes.len(), 1);
        assert_eq!(map.lanes[0].id, "2");
    }
}
