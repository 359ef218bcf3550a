//! A place of a map where a pattern fits, and its road users there.

use super::document::{PatternGoal, PatternRelation, PatternUser, PatternWay, RoadPattern};
use super::number::PatternNumber;
use super::way::LaneWay;
use scene::geometry::direction;
use scene::routes::Pose;
use scene::{
    Agent, Conditions, DEFAULT_VIA_TOLERANCE_M, Goal, GoalRelation, HORIZON_STEPS, Meta, RelativePlace,
    STEP_S, Scene, Size, State, Subtype, Track, Vec2, Via, wrap_angle,
};
use std::collections::BTreeMap;
use std::f64::consts::FRAC_PI_2;

/// km/h in one m/s.
const KMH: f64 = 3.6;
/// Fastest road user, m/s.
const FASTEST_MPS: f64 = 60.0;
/// Shortest time of a goal after the start, seconds.
const SOONEST_S: f64 = 0.5;
/// Ranges of a box's length and width, metres.
const SIZE_M: [(f64, f64); 2] = [(0.2, 25.0), (0.2, 4.0)];

/// A place.
#[derive(Clone, Debug)]
pub struct PatternPlace {
    /// Id from the lane, the arc length, and the lane that it crosses or joins.
    pub id: String,
    /// Lane of the subject.
    pub lane: String,
    /// Arc length of the place on it, metres.
    pub s_m: f64,
    /// Position, metres.
    pub position: Vec2,
    pub(super) ways: BTreeMap<PatternWay, LaneWay>,
}

/// A road user placed on a path.
struct PutUser<'a> {
    user: &'a PatternUser,
    at_m: f64,
    left_m: f64,
    speed_mps: f64,
    size: Size,
}

impl PatternPlace {
    /// The road users of a pattern with their conditions, from a step on. `values` has its parameters; absent
    /// ones have their default values.
    ///
    /// # Errors
    /// A sentence about a road user that would start or end outside its path, or a number out of range.
    pub fn cast(
        &self,
        pattern: &RoadPattern,
        values: &BTreeMap<String, f64>,
        start_step: usize,
    ) -> Result<Vec<Agent>, String> {
        let mut all = pattern.standard();
        all.extend(values.iter().map(|(name, value)| (name.clone(), *value)));
        let (mut put, mut agents): (Vec<PutUser<'_>>, Vec<Agent>) = (Vec::new(), Vec::new());
        for user in &pattern.users {
            let at = self.put(user, &put, &all)?;
            let mut agent = self.agent(&at, start_step)?;
            agent.conditions = self.conditions(&at, &all, start_step)?;
            agent.role = agents.is_empty().then(|| "ego".to_owned());
            put.push(at);
            agents.push(agent);
        }
        Ok(agents)
    }

    /// The scene of a pattern at this place: map and signals of `scene`, with only these road users.
    pub fn scene(scene: &Scene, name: String, agents: Vec<Agent>, start_step: usize) -> Scene {
        let Scene { meta, time, map, signals, .. } = scene.clone();
        let meta = Meta { objects_of_interest: Vec::new(), tracks_to_predict: Vec::new(), ..meta };
        let mut made = Scene { agents, ..Scene::bare(&name, Default::default(), Vec::new()) };
        (made.meta, made.map, made.signals) = (meta, map, signals);
        made.time.steps = time.steps.max(start_step + 1);
        made.time.now_step = start_step;
        made
    }

    fn put<'a>(
        &self,
        user: &'a PatternUser,
        before: &[PutUser<'_>],
        values: &BTreeMap<String, f64>,
    ) -> Result<PutUser<'a>, String> {
        let of = |number: &Option<PatternNumber>| number.as_ref().and_then(|number| number.of(values));
        let speed_mps = of(&user.speed_kmh).unwrap_or(0.0) / KMH;
        if !(0.0..=FASTEST_MPS).contains(&speed_mps) {
            return Err(format!("{} starts at {speed_mps:.1} m/s; 0 to {FASTEST_MPS} expected", user.id));
        }
        let usual = Size::default_for(user.agent_type, user.subtype.unwrap_or_default());
        let length_m = of(&user.length_m).unwrap_or(usual.length_m);
        let width_m = of(&user.width_m).unwrap_or(usual.width_m);
        for ((least, most), metres) in SIZE_M.iter().zip([length_m, width_m]) {
            if !(*least..=*most).contains(&metres) {
                return Err(format!("the box of {} has {metres} m; {least} to {most} expected", user.id));
            }
        }
        let ahead = user.ahead_of.as_ref().and_then(|id| before.iter().find(|other| other.user.id == *id));
        let at_m = match ahead {
            Some(other) => {
                other.at_m + 0.5 * (other.size.length_m + length_m) + of(&user.gap_m).unwrap_or(0.0)
            }
            None => of(&user.at_m).or(of(&user.at_s).map(|s| s * speed_mps)).unwrap_or(0.0),
        };
        let size = Size { length_m, width_m, ..usual };
        Ok(PutUser { user, at_m, left_m: of(&user.left_m).unwrap_or(0.0), speed_mps, size })
    }

    /// A pose beside a path.
    fn pose(&self, way: PatternWay, at_m: f64, left_m: f64) -> Option<Pose> {
        let on = self.ways.get(&way)?.pose_on(at_m)?;
        let left = direction(on.heading_rad + FRAC_PI_2) * left_m;
        Some(Pose::new(on.position + left, wrap_angle(on.heading_rad)))
    }

    fn agent(&self, put: &PutUser<'_>, start_step: usize) -> Result<Agent, String> {
        let user = put.user;
        let pose = self.pose(user.way, put.at_m, put.left_m);
        let pose =
            pose.ok_or_else(|| format!("the way of {} has no {:.1} m from the place", user.id, put.at_m))?;
        let velocity = pose.direction() * put.speed_mps;
        let state = State {
            x_m: pose.position.x,
            y_m: pose.position.y,
            heading_rad: pose.heading_rad,
            vx_mps: velocity.x,
            vy_mps: velocity.y,
        };
        let subtype = user.subtype.unwrap_or(Subtype::Unknown);
        let mut agent = Agent::bare(user.id.clone(), user.agent_type, subtype, Vec::new());
        agent.track = Track { first_step: start_step, states: vec![Some(state)], z_m: None }.into();
        agent.size = put.size;
        Ok(agent)
    }

    fn conditions(
        &self,
        put: &PutUser<'_>,
        values: &BTreeMap<String, f64>,
        start_step: usize,
    ) -> Result<Conditions, String> {
        let user = put.user;
        let via = |number: &PatternNumber| {
            let at_m = number.of(values).unwrap_or(0.0);
            let pose = self.pose(user.way, at_m, 0.0);
            let position =
                pose.ok_or_else(|| format!("the way of {} has no {at_m:.1} m from the place", user.id))?;
            Ok(Via { position: position.position, tolerance_m: DEFAULT_VIA_TOLERANCE_M, time_s: None })
        };
        let via = user.via_m.iter().map(via).collect::<Result<Vec<Via>, String>>()?;
        let mut conditions = Conditions { via, ..Conditions::default() };
        if let Some(goal) = &user.goal {
            (conditions.goal, conditions.relation) = self.goal(put, goal, values, start_step)?;
        }
        Ok(conditions)
    }

    fn goal(
        &self,
        put: &PutUser<'_>,
        goal: &PatternGoal,
        values: &BTreeMap<String, f64>,
        start_step: usize,
    ) -> Result<(Goal, Option<GoalRelation>), String> {
        let of = |number: &Option<PatternNumber>| number.as_ref().and_then(|number| number.of(values));
        let user = put.user;
        let asked_mps = of(&goal.speed_kmh).map(|kmh| kmh / KMH);
        let speed_mps = asked_mps.unwrap_or(put.speed_mps);
        let braking_s = of(&goal.braking_mps2).map(|braking| (put.speed_mps - speed_mps) / braking);
        let after_s = of(&goal.time_s).or(braking_s).unwrap_or(0.0);
        let steps = (after_s / STEP_S).round();
        if !(SOONEST_S / STEP_S..=HORIZON_STEPS as f64).contains(&steps) {
            let most_s = HORIZON_STEPS as f64 * STEP_S;
            return Err(format!(
                "the goal of {} is due after {after_s:.1} s; {SOONEST_S} to {most_s} expected",
                user.id
            ));
        }
        if !(0.0..=FASTEST_MPS).contains(&speed_mps) {
            return Err(format!("{} ends at {speed_mps:.1} m/s; 0 to {FASTEST_MPS} expected", user.id));
        }
        let time_s = Some((start_step as f64 + steps) / (1.0 / STEP_S).round());
        if let Some(relation) = &goal.relation {
            let fixed = Goal { speed_mps: asked_mps, time_s, ..Goal::default() };
            return Ok((fixed, relation.of(values)));
        }
        let way = goal.way.unwrap_or(user.way);
        let mean_m = 0.5 * (put.speed_mps + speed_mps) * steps * STEP_S;
        let at_m = of(&goal.at_m).unwrap_or(put.at_m + mean_m);
        let left_m = of(&goal.left_m).unwrap_or(if way == user.way { put.left_m } else { 0.0 });
        let pose = self.pose(way, at_m, left_m);
        let pose = pose.ok_or_else(|| format!("the way of {} has no {at_m:.1} m from the place", user.id))?;
        let fixed = Goal {
            position: Some(pose.position),
            heading_rad: Some(pose.heading_rad),
            speed_mps: Some(speed_mps),
            time_s,
        };
        Ok((fixed, None))
    }
}

impl PatternRelation {
    fn of(&self, values: &BTreeMap<String, f64>) -> Option<GoalRelation> {
        let of = |number: &Option<PatternNumber>| number.as_ref().and_then(|number| number.of(values));
        let place = (of(&self.ahead_m).map(RelativePlace::Ahead))
            .or(of(&self.behind_m).map(RelativePlace::Behind))
            .or(of(&self.behind_s).map(RelativePlace::BehindBy))?;
        Some(GoalRelation { to: self.to.clone(), place, slower_mps: 0.0, lanes_left: self.lanes_left })
    }
}
