//! Incremental score of a scene of which a few road users change: the part of the others is computed once.

use super::input::{Actor, ScoreInput, Thresholds};
use super::pairs::{Mover, PairTally};
use super::single::Single;
use super::{Drivable, Score, put_together, score, signals};
use crate::{Scene, Track};
use std::ops::Range;
use std::sync::Arc;

/// Score of an unchanged scene over some of its steps, by road user and pair. If only a few motions change,
/// the new score needs only these road users and their pairs.
#[derive(Debug)]
pub struct BaselineScore {
    scene: Arc<Scene>,
    steps: Range<usize>,
    singles: Vec<Single>,
    movers: Vec<Mover>,
    tally: PairTally,
}

impl BaselineScore {
    /// Scores a scene with its shown motions. Costs as much as its score.
    pub fn new(scene: Arc<Scene>, drivable: &Drivable, steps: Range<usize>) -> Self {
        let (singles, movers, tally) = {
            let input = Self::input(&scene, drivable, &steps);
            let lines = signals::stop_lines(&input);
            let singles = input.actors.iter().map(|actor| Single::of(&input, actor, &lines)).collect();
            let movers: Vec<Mover> = input.actors.iter().map(|a| Mover::new(a, steps.clone())).collect();
            let tally = PairTally::of_all(&input, &movers.iter().collect::<Vec<_>>());
            (singles, movers, tally)
        };
        Self { scene, steps, singles, movers, tally }
    }

    fn input<'a>(scene: &'a Scene, drivable: &'a Drivable, steps: &Range<usize>) -> ScoreInput<'a> {
        ScoreInput { steps: steps.clone(), ..ScoreInput::of_scene(scene, drivable) }
    }

    /// The scored steps.
    pub fn steps(&self) -> Range<usize> {
        self.steps.clone()
    }

    /// The score of an input, equal to [`score`]'s member for member for any input. It is faster the more
    /// road users are unchanged.
    pub fn score(&self, input: &ScoreInput<'_>) -> Score {
        let before = Self::input(&self.scene, input.drivable, &self.steps);
        match unchanged(&before, input) {
            Some(was) => self.changed(input, &was),
            None => score(input),
        }
    }

    fn changed(&self, input: &ScoreInput<'_>, was: &[Option<usize>]) -> Score {
        let lines = signals::stop_lines(input);
        let anew = |k: usize| was[k].is_none();
        let moved: Vec<Option<Mover>> = input
            .actors
            .iter()
            .enumerate()
            .map(|(k, actor)| anew(k).then(|| Mover::new(actor, input.steps.clone())))
            .collect();
        let movers: Vec<&Mover> = moved
            .iter()
            .zip(was)
            .filter_map(|(m, old)| m.as_ref().or_else(|| self.movers.get((*old)?)))
            .collect();
        let singles = input.actors.iter().zip(was).map(|(actor, old)| {
            let known = old.and_then(|old| self.singles.get(old)).cloned();
            known.unwrap_or_else(|| Single::of(input, actor, &lines))
        });
        put_together(input, singles, self.tally.changed(input, &movers, was).scores(input))
    }
}

/// For each road user of the input, the index of the unchanged one in the other input. `None` if anything
/// other than road users has changed.
fn unchanged(before: &ScoreInput<'_>, input: &ScoreInput<'_>) -> Option<Vec<Option<usize>>> {
    let same_ground = std::ptr::eq(before.map, input.map) || before.map == input.map;
    let rules = |i: &ScoreInput<'_>| -> (Range<usize>, _, _, Thresholds) {
        (i.steps.clone(), i.pairs, i.exclude, i.thresholds)
    };
    if !same_ground || before.signals != input.signals || rules(before) != rules(input) {
        return None;
    }
    // Changes keep the order of the others, so each is searched after the previous match.
    let mut from = 0;
    let mut find = |actor: &Actor<'_>| {
        let found = from + before.actors.get(from..)?.iter().position(|a| a.id == actor.id)?;
        from = found + 1;
        is_same(&before.actors[found], actor).then_some(found)
    };
    Some(input.actors.iter().map(&mut find).collect())
}

/// Whether two are the same road user with the same motion and the same reference data.
fn is_same(a: &Actor<'_>, b: &Actor<'_>) -> bool {
    let about = |x: &Actor<'_>| (x.agent_type, x.subtype, x.size, x.generated, x.goal);
    let tracks = |x: Option<&Track>, y: Option<&Track>| match (x, y) {
        (Some(x), Some(y)) => std::ptr::eq(x, y) || x == y,
        (x, y) => x.is_none() && y.is_none(),
    };
    about(a) == about(b)
        && a.may_cross == b.may_cross
        && a.via == b.via
        && tracks(Some(&a.track), Some(&b.track))
        && tracks(a.log, b.log)
        && tracks(a.reference, b.reference)
        && (std::ptr::eq(a.modes, b.modes) || a.modes == b.modes)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::map::Lane;
    use crate::score::PairChoice;
    use crate::{
        Agent, AgentFutures, AgentType, Future, Generated, LaneMap, STEP_S, Sample, SignalState, State,
        Subtype,
    };
    use proptest::prelude::*;

    const STEPS: usize = 40;

    /// Place, heading, speed (m/s) and turn (rad/s).
    type Motion = (f64, f64, f64, f64, f64);

    fn motion() -> impl Strategy<Value = Motion> {
        (-25.0..25.0f64, -25.0..25.0f64, -3.2..3.2f64, prop_oneof![Just(0.0), 0.5..14.0f64], -0.4..0.4f64)
    }

    fn states((x, y, heading, speed, turn): Motion) -> Vec<State> {
        let mut at = crate::Vec2::new(x, y);
        (0..STEPS)
            .map(|i| {
                let heading_rad = heading + turn * STEP_S * i as f64;
                let velocity = crate::geometry::direction(heading_rad) * speed;
                at += velocity * STEP_S;
                let (vx_mps, vy_mps) = (velocity.x, velocity.y);
                State { x_m: at.x, y_m: at.y, heading_rad, vx_mps, vy_mps }
            })
            .collect()
    }

    fn futures(motion: Motion) -> AgentFutures {
        AgentFutures::of(0, vec![Future::bare(1.0, 1, states(motion))])
    }

    fn agent(id: usize, (kind, motion): (usize, Motion)) -> Agent {
        let kind = [AgentType::Vehicle, AgentType::Pedestrian, AgentType::Cyclist][kind];
        Agent::bare(id.to_string(), kind, Subtype::Unknown, states(motion).into_iter().map(Some).collect())
    }

    fn crossing() -> LaneMap {
        let lane = |id: &str, points: [(f64, f64); 3]| {
            Lane::street(id, points.map(|(x, y)| crate::Vec2::new(x, y)).to_vec())
        };
        let east = lane("east", [(-40.0, 0.0), (0.0, 0.0), (40.0, 0.0)]);
        let north = lane("north", [(0.0, -40.0), (0.0, 0.0), (0.0, 40.0)]);
        LaneMap { lanes: vec![east, north], ..LaneMap::default() }
    }

    fn scene(users: &[(usize, Motion)], kept: &[Option<Motion>]) -> Scene {
        let agents: Vec<Agent> = users.iter().enumerate().map(|(i, user)| agent(i, *user)).collect();
        let mut scene = Scene::bare("", crossing(), agents);
        let stop = crate::Vec2::new(-4.0, 0.0);
        let runs = vec![(0, SignalState::Stop)];
        scene.signals = vec![crate::Signal { lane: "east".into(), stop: Some(stop), stop_z_m: None, runs }];
        let with_futures = kept.iter().enumerate().filter_map(|(i, m)| Some((i.to_string(), futures((*m)?))));
        let sample = Sample { agents: with_futures.collect(), ..Sample::default() };
        scene.generated = Some(Generated { samples: vec![sample], ..Generated::default() });
        scene
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(300))]

        #[test]
        fn what_was_worked_out_before_changes_no_score(
            users in proptest::collection::vec((0usize..3, motion()), 2..9),
            kept in proptest::collection::vec(proptest::option::weighted(0.3, motion()), 8),
            changed in proptest::collection::vec(proptest::option::weighted(0.3, motion()), 8),
            leaves in proptest::option::weighted(0.3, 0usize..8),
            comes in proptest::option::weighted(0.3, (0usize..3, motion())),
            fixed in proptest::option::weighted(0.3, 0usize..8),
            drivable_first in any::<bool>(),
        ) {
            let before = Arc::new(scene(&users, &kept[..users.len()]));
            let drivable = Drivable::new(&before.map);
            let mut after = Scene::clone(&before);
            if let Some(agent) = fixed.and_then(|k| after.agents.get_mut(k)) {
                agent.conditions.goal.speed_mps = Some(3.0);
                agent.conditions.length_m = Some(2.5);
            }
            after.agents.retain(|agent| leaves.is_none_or(|k| agent.id != k.to_string()));
            after.agents.extend(comes.map(|user| agent(99, user)));
            let mut sample = before.generated.clone().unwrap().samples.remove(0);
            for (i, motion) in changed[..users.len()].iter().enumerate() {
                sample.agents.extend(motion.map(|m| (i.to_string(), futures(m))));
            }
            let input = ScoreInput::of_sample(&after, Some(&sample), &drivable);
            let baseline = BaselineScore::new(before.clone(), &drivable, input.steps.clone());
            prop_assert_eq!(baseline.score(&input), score(&input));
            // Other rules than those of the baseline.
            let other = ScoreInput {
                pairs: if drivable_first { PairChoice::Regenerated } else { PairChoice::All },
                steps: 3..STEPS,
                ..input
            };
            prop_assert_eq!(baseline.score(&other), score(&other));
        }
    }

    #[test]
    fn only_those_who_changed_are_looked_at() {
        let row = |i: usize| (0, (-20.0 + 8.0 * i as f64, 0.0, 1.5, 6.0, 0.0));
        let users: Vec<_> = (0..6).map(row).collect();
        let before = Arc::new(scene(&users, &[]));
        let drivable = Drivable::new(&before.map);
        let sample = Sample {
            agents: [("2".to_owned(), futures((0.0, 3.0, 0.1, 5.0, 0.0)))].into(),
            ..Sample::default()
        };
        let input = ScoreInput::of_sample(&before, Some(&sample), &drivable);
        let shown = BaselineScore::input(&before, &drivable, &input.steps);
        let was = unchanged(&shown, &input).unwrap();
        assert_eq!(was, [Some(0), Some(1), None, Some(3), Some(4), Some(5)]);
    }
}
