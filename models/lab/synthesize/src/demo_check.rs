//! Requirements of a demo scene: no overlap, no road user off the road, no jump, no event that the editor
//! would report, and a clean first frame.

use formats::polyline::{contains, distance_to};
use scene::geometry::obb::{OrientedBox, signed_gap};
use scene::score::report::NearMiss;
use scene::score::{Drivable, ScoreInput, score};
use scene::{Agent, AgentType, STEP_S, Scene, Vec2, wrap_angle};

/// Largest overhang of a vehicle's corner over the kerb, metres.
const OVERHANG_M: f64 = 0.35;

/// A vehicle below this speed in the first frame is at rest, m/s.
const STANDS_MPS: f64 = 1.0;
/// Greatest angle of a vehicle at rest to its lane, radians.
const ASKEW_RAD: f64 = 0.13;

/// Removes one road user of each near miss: a pedestrian, a cyclist or a parked car. Moving vehicles stay.
pub fn without_troublemakers(mut scene: Scene) -> Scene {
    let drivable = Drivable::new(&scene.map);
    let found = score(&ScoreInput::of_sample(&scene, None, &drivable)).scene;
    let weight = |id: &str| match scene.agent(id) {
        Some(a) if a.agent_type == AgentType::Pedestrian => 0,
        Some(a) if a.agent_type == AgentType::Cyclist => 1,
        Some(a) if a.role.as_deref() == Some("parked") => 2,
        _ => 3,
    };
    let lesser = |n: &NearMiss| {
        let (a, b) = (n.a.clone(), n.b.clone());
        if weight(&a) < weight(&b) { a } else { b }
    };
    let gone: Vec<String> = found.near_misses.iter().map(lesser).filter(|id| weight(id) < 3).collect();
    scene.agents.retain(|a| !gone.contains(&a.id));
    scene
}

/// Whether a corner or the centre of a vehicle is on a crosswalk at a step; false for other types.
pub fn is_on_crosswalk(scene: &Scene, agent: &Agent, step: usize) -> bool {
    let Some(state) = agent.track.at(step).filter(|_| agent.agent_type == AgentType::Vehicle) else {
        return false;
    };
    let outline = OrientedBox::of_state(state, &agent.size);
    let nose = outline.center() + outline.forward() * outline.half_length_m();
    let places = outline.corners().into_iter().chain([outline.center(), nose]);
    places.into_iter().any(|p| scene.map.crosswalks.iter().any(|c| contains(&c.polygon.xy, p)))
}

/// Whether the agent is a vehicle, not parked, at an angle to every lane near it at a step.
pub fn is_askew(scene: &Scene, agent: &Agent, step: usize) -> bool {
    let Some(state) = agent.track.at(step).filter(|_| agent.agent_type == AgentType::Vehicle) else {
        return false;
    };
    if state.speed_mps() >= STANDS_MPS || agent.role.as_deref() == Some("parked") {
        return false;
    }
    let lanes = scene.map.lanes.iter().filter(|l| l.lane_type.carries_vehicles());
    let pieces = lanes.flat_map(|l| l.points.xy.windows(2));
    let near = pieces.filter(|w| distance_to(w, state.position()) < 2.0);
    let off = near.map(|w| {
        let way = w[1] - w[0];
        wrap_angle(way.y.atan2(way.x) - state.heading_rad).abs()
    });
    off.fold(f64::INFINITY, f64::min) > ASKEW_RAD
}

/// Removes pedestrians and cyclists that overlap others, or whose position would fail the checks.
pub fn without_overlaps(mut scene: Scene) -> Scene {
    loop {
        let Some((i, j)) = overlapping(&scene) else { return scene };
        // The less important one is removed; of two vehicles, the parked or the later one.
        let weight = |k: usize| match (scene.agents[k].agent_type, scene.agents[k].role.as_deref()) {
            (AgentType::Pedestrian, _) => 0,
            (AgentType::Cyclist, _) => 1,
            (_, Some("parked")) => 2,
            (_, None) => 3,
            _ => 4,
        };
        let out = if weight(i) < weight(j) { i } else { j };
        scene.agents.remove(out);
    }
}

fn overlapping(scene: &Scene) -> Option<(usize, usize)> {
    for step in 0..scene.time.steps {
        let boxes: Vec<Option<OrientedBox>> = scene
            .agents
            .iter()
            .map(|a| a.track.at(step).map(|s| OrientedBox::of_state(s, &a.size)))
            .collect();
        for (i, a) in boxes.iter().enumerate() {
            let Some(a) = a else { continue };
            for (j, b) in boxes.iter().enumerate().skip(i + 1) {
                let Some(b) = b else { continue };
                let near = (a.center() - b.center()).norm() < a.radius_m() + b.radius_m();
                if near && signed_gap(a, b) < 0.0 {
                    return Some((i, j));
                }
            }
        }
    }
    None
}

/// The faults of a scene as text; empty if it can be a demo.
pub fn faults(scene: &Scene) -> Vec<String> {
    let mut faults = Vec::new();
    if let Err(problems) = scene.clone().checked() {
        faults.extend(problems.iter().map(ToString::to_string));
    }
    if let Some((i, j)) = overlapping(scene) {
        faults.push(format!("{} and {} overlap", scene.agents[i].id, scene.agents[j].id));
    }
    faults.extend(events(scene));
    for agent in &scene.agents {
        let stands = agent.track.at(0).is_some_and(|s| s.speed_mps() < STANDS_MPS);
        if stands && is_on_crosswalk(scene, agent, 0) {
            faults.push(format!("{} starts on a crosswalk", agent.id));
        }
        if is_askew(scene, agent, 0) {
            faults.push(format!("{} stands askew", agent.id));
        }
        faults.extend(off_road(scene, agent));
        faults.extend(jump(agent));
    }
    faults
}

/// Events that the editor would list for the unedited scene.
fn events(scene: &Scene) -> Vec<String> {
    let drivable = Drivable::new(&scene.map);
    let found = score(&ScoreInput::of_sample(scene, None, &drivable)).scene;
    let mut events = Vec::new();
    events.extend(found.collisions.iter().map(|e| format!("{} and {} collide at {} s", e.a, e.b, e.time_s)));
    let near = |e: &NearMiss| format!("{} and {} nearly collide at {} s", e.a, e.b, e.time_s);
    events.extend(found.near_misses.iter().map(near));
    events.extend(found.red_lights.iter().map(|e| format!("{} runs a red light at {} s", e.agent, e.time_s)));
    let kinds = [
        ("is off the road", &found.off_road),
        ("is over a median", &found.over_median),
        ("drives against the traffic", &found.wrong_way),
        ("leaves the map", &found.off_map),
        ("walks on the carriageway", &found.on_carriageway),
        ("exceeds the speed limit", &found.speeding),
        ("runs", &found.running),
        ("ends askew", &found.askew),
        ("brakes hard", &found.harsh_braking),
        ("steers hard", &found.harsh_steering),
    ];
    for (what, list) in kinds {
        events.extend(list.iter().map(|e| format!("{} {what} at {} s: {:?}", e.agent, e.time_s, e.worst)));
    }
    events
}

/// Distance of a point from the nearest paved area, metres; zero inside one.
fn off_pavement(scene: &Scene, p: Vec2) -> f64 {
    let areas = scene.map.drivable.iter().chain(&scene.map.driveways);
    let distance = |ring: &[Vec2]| {
        if contains(ring, p) {
            return 0.0;
        }
        let mut closed = ring.to_vec();
        closed.extend(ring.first());
        distance_to(&closed, p)
    };
    areas.map(|a| distance(&a.polygon.xy)).fold(f64::INFINITY, f64::min)
}

fn off_road(scene: &Scene, agent: &Agent) -> Option<String> {
    if agent.agent_type != AgentType::Vehicle {
        return None;
    }
    for (step, state) in agent.track.states.iter().enumerate().step_by(5) {
        let Some(state) = state else { continue };
        let outline = OrientedBox::of_state(state, &agent.size);
        let out = outline.corners().iter().map(|c| off_pavement(scene, *c)).fold(0.0, f64::max);
        // The corners of long vehicles swing out over the kerb.
        let allowed = OVERHANG_M + 0.05 * agent.size.length_m;
        if out > allowed {
            return Some(format!("vehicle {} is {out:.1} m off the road at step {step}", agent.id));
        }
    }
    None
}

fn jump(agent: &Agent) -> Option<String> {
    let pairs = agent.track.states.windows(2).enumerate();
    for (step, pair) in pairs {
        let [Some(a), Some(b)] = pair else { continue };
        let moved = (b.position() - a.position()).norm();
        let turned = wrap_angle(b.heading_rad - a.heading_rad).abs();
        let wheels = agent.agent_type != AgentType::Pedestrian;
        if moved > a.speed_mps().max(b.speed_mps()) * STEP_S + 0.15 || wheels && turned > 0.12 {
            return Some(format!("{} jumps at step {step}: {moved:.2} m, {turned:.2} rad", agent.id));
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::super::demo::DEMOS;
    use super::*;
    use formats::native;

    fn shipped(id: &str) -> Vec<u8> {
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../../assets/scenes");
        std::fs::read(format!("{folder}/{id}.json")).unwrap()
    }

    #[test]
    fn shipped_demos_are_fit_to_be_shown() {
        for demo in &DEMOS {
            let bytes = shipped(demo.id);
            assert!(bytes.len() < 600_000, "{}: {} bytes", demo.id, bytes.len());
            let scene = native::read(&bytes).unwrap();
            assert_eq!((scene.id.as_deref(), scene.name.as_str()), (Some(demo.id), demo.name));
            assert_eq!(scene.meta.licence.as_deref(), Some("cc0"));
            assert_eq!(faults(&scene), Vec::<String>::new(), "{}", demo.id);
            let [vehicles, pedestrians, cyclists, others] = scene.counts();
            assert!(vehicles >= 10 && pedestrians >= 5 && cyclists >= 4 && others == 0, "{}", demo.id);
        }
    }

    #[test]
    fn faults_are_found() {
        let mut scene = native::read(&shipped("demo-crossing")).unwrap();
        let first = scene.agents[0].clone();
        scene.agents[1].track = first.track.clone();
        assert!(faults(&scene).iter().any(|f| f.contains("overlap")));
        let healed = without_overlaps(scene.clone());
        assert!(healed.agents.len() < scene.agents.len() && faults(&healed).is_empty());
        for state in scene.agents[0].track.states[40..].iter_mut().flatten() {
            state.y_m += 40.0;
        }
        let faults = faults(&scene);
        assert!(faults.iter().any(|f| f.contains("jumps at step 39")), "{faults:?}");
        assert!(faults.iter().any(|f| f.contains("off the road")), "{faults:?}");
    }
}
