//! Joins tracks of one road user under two ids. A tracker that loses a road user and finds it again gives it
//! a second id, with the same place and motion, where the first track ends.

use crate::problem::ImportWarning;
use crate::sentences;
use scene::geometry::obb::{OrientedBox, iou};
use scene::{Agent, STEP_S, Scene, State, wrap_angle};

/// The second track begins at most this many steps before or after the end of the first. A road user that
/// stands at the end of one and the beginning of the other may be unseen for longer, because no other takes
/// its place.
const MOST_STEPS: usize = 10;
/// Below this speed, a road user stands, m/s.
const STANDING_MPS: f64 = 0.5;
/// Boxes of one road user share at least this much.
const LEAST_IOU: f64 = 0.4;
/// ... and differ in velocity by at most this, m/s ...
const MOST_MPS: f64 = 2.0;
/// ... and in heading by at most this, radians.
const MOST_RAD: f64 = 0.35;
/// Pairs that a warning names.
const NAMED: usize = 8;

/// Joins the tracks of road users that the recording has under two ids; the first id stays. The warning lists
/// the ids.
pub fn join(scene: &mut Scene) -> Option<ImportWarning> {
    let mut joined = Vec::new();
    while let Some((first, second)) = find(&scene.agents) {
        let second = scene.agents.remove(second);
        // The first one moves up if the second was listed before it.
        let at = scene.agents.iter().position(|agent| agent.id == first)?;
        let first = &mut scene.agents[at];
        joined.push(format!("{} and {}", first.id, second.id));
        append(first, &second);
        let (kept, gone) = (first.id.clone(), second.id);
        let meta = &mut scene.meta;
        let renamed = |id: &mut String| {
            if *id == gone {
                id.clone_from(&kept);
            }
        };
        meta.objects_of_interest.iter_mut().for_each(renamed);
        meta.tracks_to_predict.iter_mut().for_each(|(id, _)| renamed(id));
        unique(&mut meta.objects_of_interest, |id| id.clone());
        unique(&mut meta.tracks_to_predict, |(id, _)| id.clone());
    }
    if joined.is_empty() {
        return None;
    }
    let count = joined.len();
    joined.truncate(NAMED);
    let pairs = joined.join(", ");
    let message = match count.saturating_sub(NAMED) {
        0 => sentences::identities_joined_all(count, &pairs),
        more => sentences::identities_joined(count, &pairs, more),
    };
    Some(ImportWarning::new("identities-joined", message))
}

fn unique<T>(list: &mut Vec<T>, key: impl Fn(&T) -> String) {
    let mut seen = std::collections::BTreeSet::new();
    list.retain(|item| seen.insert(key(item)));
}

/// The id of a road user, and the index of the later track of the same road user.
fn find(agents: &[Agent]) -> Option<(String, usize)> {
    for first in agents {
        let Some(end) = first.track.last_valid_step() else { continue };
        let is_next = |second: &Agent| {
            let Some(begin) = second.track.valid_steps().next() else { return false };
            let begins_first = first.track.valid_steps().next() < Some(begin);
            let later = begins_first && second.track.last_valid_step() > Some(end);
            let other =
                second.role.is_none() && second.id != first.id && second.agent_type == first.agent_type;
            later && other && in_time(first, second, begin, end) && is_same(first, second, begin, end)
        };
        if let Some(at) = agents.iter().position(is_next) {
            return Some((first.id.clone(), at));
        }
    }
    None
}

/// Whether the second track begins about when the first one ends.
fn in_time(first: &Agent, second: &Agent, begin: usize, end: usize) -> bool {
    let stands = |state: Option<&State>| state.is_some_and(|s| s.speed_mps() < STANDING_MPS);
    let waits = || begin > end && stands(first.track.at(end)) && stands(second.track.at(begin));
    begin.abs_diff(end) <= MOST_STEPS || waits()
}

/// Whether both tracks coincide where both have states, or the first extrapolates to the position of the
/// second.
fn is_same(first: &Agent, second: &Agent, begin: usize, end: usize) -> bool {
    if begin > end {
        let (Some(last), Some(next)) = (first.track.at(end), second.track.at(begin)) else { return false };
        // A creeping road user that is unseen for seconds cannot be extrapolated reliably.
        let stands = last.speed_mps() < STANDING_MPS && next.speed_mps() < STANDING_MPS;
        if stands {
            return coincide((last, first), (next, second));
        }
        let gone_on = last.position() + last.velocity() * ((begin - end) as f64 * STEP_S);
        let expected = State { x_m: gone_on.x, y_m: gone_on.y, ..*last };
        return coincide((&expected, first), (next, second));
    }
    let mut common =
        (begin..=end).filter_map(|step| first.track.at(step).zip(second.track.at(step))).peekable();
    common.peek().is_some() && common.all(|(p, q)| coincide((p, first), (q, second)))
}

fn coincide((p, of_p): (&State, &Agent), (q, of_q): (&State, &Agent)) -> bool {
    let boxes = (OrientedBox::of_state(p, &of_p.size), OrientedBox::of_state(q, &of_q.size));
    iou(&boxes.0, &boxes.1) >= LEAST_IOU
        && (p.velocity() - q.velocity()).norm() <= MOST_MPS
        && wrap_angle(p.heading_rad - q.heading_rad).abs() <= MOST_RAD
}

/// The states of the second after the last one of the first.
fn append(first: &mut Agent, second: &Agent) {
    let Some(end) = first.track.last_valid_step() else { return };
    let track = &mut first.track;
    let length = end + 1 - track.first_step;
    track.states.truncate(length);
    let last = second.track.first_step + second.track.states.len();
    let later = end + 1..last;
    track.states.extend(later.clone().map(|step| second.track.at(step).copied()));
    let Some(z_m) = &mut track.z_m else { return };
    z_m.truncate(length);
    let heights = second.track.z_m.as_ref();
    let height = |step: usize| {
        let slot = step.checked_sub(second.track.first_step);
        heights.zip(slot).and_then(|(z, slot)| z.get(slot)).copied().unwrap_or(0.0)
    };
    z_m.extend(later.map(height));
}

#[cfg(test)]
mod tests {
    use super::*;
    use scene::{AgentType, LaneMap, Subtype};

    /// Drives east at 10 m/s, `aside` metres off, known in these steps.
    fn tracked(id: &str, steps: std::ops::Range<usize>, aside: f64) -> Agent {
        let at = |i: usize| {
            let known = steps.contains(&i);
            known.then(|| State { x_m: i as f64, y_m: aside, vx_mps: 10.0, ..State::default() })
        };
        let mut agent = Agent::bare(id, AgentType::Vehicle, Subtype::Car, (0..91).map(at).collect());
        agent.track.z_m = Some(vec![1.0; 91]);
        agent
    }

    fn joined(agents: Vec<Agent>) -> (Scene, Option<ImportWarning>) {
        let mut scene = Scene::bare("", LaneMap::default(), agents);
        scene.meta.objects_of_interest = vec!["2".into(), "1".into()];
        let warning = join(&mut scene);
        (scene.checked().unwrap(), warning)
    }

    #[test]
    fn a_second_id_is_joined_to_the_first() {
        // Once with both tracked for a while, once with a gap, three ids in all.
        let parts = vec![tracked("2", 38..60, 0.2), tracked("1", 0..41, 0.0), tracked("3", 64..91, 0.1)];
        let (scene, warning) = joined(parts);
        let detail = warning.unwrap().detail;
        assert!(detail.contains("2 road users") && detail.contains("1 and 2"), "{detail}");
        assert_eq!((scene.agents.len(), scene.agents[0].id.as_str()), (1, "1"));
        let track = &scene.agents[0].track;
        let known: Vec<usize> = track.valid_steps().collect();
        assert_eq!(known, (0..60).chain(64..91).collect::<Vec<_>>());
        assert_eq!((track.at(40).unwrap().y_m, track.at(41).unwrap().y_m), (0.0, 0.2));
        assert_eq!(scene.meta.objects_of_interest, ["1"]);
    }

    #[test]
    fn one_that_stands_unseen_for_long_is_the_same() {
        let stands = |id: &str, steps: std::ops::Range<usize>| {
            let mut agent = tracked(id, steps, 0.0);
            for state in agent.track.states.iter_mut().flatten() {
                (state.x_m, state.vx_mps) = (12.0, 0.0);
            }
            agent
        };
        let (scene, warning) = joined(vec![stands("1", 0..20), stands("2", 70..91)]);
        assert!(scene.agents.len() == 1 && warning.is_some());
        // A road user that drives through the same place seconds later is another one.
        let mut passing = tracked("2", 40..91, 0.0);
        passing.track.states.iter_mut().flatten().for_each(|state| state.x_m -= 28.0);
        let (scene, _) = joined(vec![stands("1", 0..20), passing]);
        assert_eq!(scene.agents.len(), 2);
    }

    #[test]
    fn others_stay_apart() {
        // Beside it; where it was, but later; another kind; one that is there all the time.
        let mut walker = tracked("4", 41..91, 0.0);
        walker.agent_type = AgentType::Pedestrian;
        let parked = Agent {
            track: scene::Track {
                states: vec![Some(State::default()); 91],
                ..scene::Track::clone(&tracked("5", 0..91, 0.0).track)
            }
            .into(),
            ..tracked("5", 0..91, 0.0)
        };
        let parts = vec![
            tracked("1", 0..41, 0.0),
            tracked("2", 41..91, 3.0),
            tracked("3", 60..91, 0.0),
            walker,
            parked,
        ];
        let (scene, warning) = joined(parts);
        assert_eq!((scene.agents.len(), warning), (5, None));
    }
}
