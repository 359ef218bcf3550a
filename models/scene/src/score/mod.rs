//! Scores of whole scenes: collisions and near misses, distance and time to
//! collision, post-encroachment time, off-road and wrong-way driving, red lights, kinematic limits,
//! goals met, distance from the log.
//!
//! [`score`] takes a [`ScoreInput`] and gives a [`Score`], which serialises to the answer of
//! `POST /v1/score`. The same input gives the same score, member for member: agents are taken in the
//! order given, pairs by (first, second), lists by time.

pub mod accuracy;
pub mod drivable;
pub mod goal;
pub mod input;
pub mod kinematic;
pub mod overlap;
pub mod pairs;
pub mod pet;
pub(crate) mod recorded;
pub mod report;
pub mod road;
pub mod signals;

pub use drivable::Drivable;
pub use input::{Actor, Exclude, PairChoice, ScoreInput, Thresholds};
pub use overlap::{CLOSE_M, Overlap, SweptBoxes, overlap};
pub use report::{AgentScore, SceneScore, Score};

/// Scores a scene. Costs a few milliseconds for 128 agents over 91 steps on one core.
pub fn score(input: &ScoreInput<'_>) -> Score {
    let pairs = pairs::score_pairs(input);
    let mut agents: Vec<AgentScore> = Vec::with_capacity(input.actors.len());
    let mut scene = SceneScore::default();
    for (i, actor) in input.actors.iter().enumerate() {
        let pair = &pairs.agents[i];
        let mut road = road::score_road(input, actor);
        recorded::mark_road(input, actor, &mut road);
        let kinematic = actor.generated.then(|| kinematic::score_kinematic(actor, input.steps.clone()));
        let (kinematic, turns) = kinematic.unzip();
        scene.implausible_turns.extend(turns.into_iter().flatten());
        let mut braking = kinematic::harsh_braking(actor, input);
        recorded::mark_braking(input, actor, &mut braking);
        scene.harsh_braking.extend(braking);
        let mut steering = kinematic::harsh_steering(actor, input);
        recorded::mark_steering(input, actor, &mut steering);
        scene.harsh_steering.extend(steering);
        scene.off_road.extend(road.off_road);
        scene.over_median.extend(road.over_median);
        scene.wrong_way.extend(road.wrong_way);
        agents.push(AgentScore {
            collisions: pair.collisions,
            overlaps: pair.light_overlaps,
            near_misses: pair.near_misses,
            min_ttc_s: pair.min_ttc_s,
            min_distance_m: pair.min_distance_m,
            pet_s: pair.pet_s,
            offroad_share: road.offroad_share,
            offroad_max_m: road.offroad_max_m,
            wrong_way_share: road.wrong_way_share,
            kinematic,
            goal_error: goal::goal_error(actor),
            accuracy: accuracy::accuracy(actor, input.steps.clone()),
        });
        scene.offroad_steps += road.offroad_steps;
        scene.road_steps += road.road_steps;
        scene.wrong_way_steps += road.wrong_way_steps;
        scene.moving_steps += road.moving_steps;
    }
    scene.red_lights = signals::red_lights(input);
    recorded::mark_red_lights(input, &mut scene.red_lights);
    scene.finish(input, pairs, &agents);
    let ids = input.actors.iter().map(|a| a.id.to_owned());
    Score { scene, agents: ids.zip(agents).collect(), thresholds: input.thresholds }
}

#[cfg(test)]
mod tests;
