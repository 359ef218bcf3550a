//! Score of a single road user's motion, independent of the others.

use super::accuracy::{Accuracy, accuracy};
use super::goal::{GoalError, goal_error};
use super::input::{Actor, ScoreInput};
use super::kinematic::{Kinematic, score_kinematic};
use super::pairs::PairTotals;
use super::recorded::{self, MotionRule};
use super::report::{AgentScore, RedLight, SceneScore, Stretch};
use super::road::{RoadScore, score_road};
use super::signals::{SignalStopLine, crossed_at_red};

/// Score of a single road user's motion, independent of the others.
#[derive(Clone, Debug)]
pub(super) struct Single {
    road: RoadScore,
    kinematic: Option<Kinematic>,
    implausible_turns: Vec<Stretch>,
    /// Stretches by rule, in the order of [`MotionRule::ALL`].
    rules: [Vec<Stretch>; MotionRule::ALL.len()],
    red_lights: Vec<RedLight>,
    goal_error: Option<GoalError>,
    accuracy: Option<Accuracy>,
}

impl Single {
    /// The score of one road user of the input, with the stop lines of the scene.
    pub(super) fn of(input: &ScoreInput<'_>, actor: &Actor<'_>, lines: &[SignalStopLine<'_>]) -> Self {
        let mut road = score_road(input, actor);
        recorded::mark_road(input, actor, &mut road);
        let kinematic = actor.generated.then(|| score_kinematic(actor, input.steps.clone()));
        let (kinematic, turns) = kinematic.unzip();
        let mut red_lights = crossed_at_red(input, actor, lines);
        recorded::mark_red_lights(input, actor, lines, &mut red_lights);
        Self {
            road,
            kinematic,
            implausible_turns: turns.unwrap_or_default(),
            rules: MotionRule::ALL.map(|rule| rule.breaches(input, actor)),
            red_lights,
            goal_error: goal_error(actor),
            accuracy: accuracy(actor, input.steps.clone()),
        }
    }

    /// Adds its entries to the scene's lists and sums, and returns the road user's own score.
    pub(super) fn add_to(self, scene: &mut SceneScore, totals: &PairTotals) -> AgentScore {
        let road = self.road;
        scene.implausible_turns.extend(self.implausible_turns);
        for (rule, found) in MotionRule::ALL.into_iter().zip(self.rules) {
            scene.breaches_mut(rule).extend(found);
        }
        scene.red_lights.extend(self.red_lights);
        scene.off_road.extend(road.off_road);
        scene.over_median.extend(road.over_median);
        scene.wrong_way.extend(road.wrong_way);
        scene.offroad_steps += road.offroad_steps;
        scene.road_steps += road.road_steps;
        scene.wrong_way_steps += road.wrong_way_steps;
        scene.moving_steps += road.moving_steps;
        AgentScore {
            collisions: totals.collisions,
            overlaps: totals.light_overlaps,
            near_misses: totals.near_misses,
            min_ttc_s: totals.min_ttc_s,
            min_distance_m: totals.min_distance_m,
            pet_s: totals.pet_s,
            offroad_share: road.offroad_share,
            offroad_max_m: road.offroad_max_m,
            wrong_way_share: road.wrong_way_share,
            kinematic: self.kinematic,
            goal_error: self.goal_error,
            accuracy: self.accuracy,
        }
    }
}
