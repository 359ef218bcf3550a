//! Relations of a motion to others: order at crossing paths, following, giving way.

use super::trace::{
    GOES_M, MOMENT_S, Moment, QUEUE_M, SAME_WAY_RAD, STRIDE, SharedGround, Trace, WINDOW_S, crossing,
};
use super::{Relation, RelationKind, rounded};
use crate::geometry::cross;
use crate::{AgentType, STANDING_MPS, STEP_S, Vec2, wrap_angle};

/// Most relations of a motion.
const MOST: usize = 4;
/// An agent farther behind than this does not follow, seconds.
const HEADWAY_S: f64 = 3.0;
/// Shortest duration of following, seconds.
const FOLLOWS_FOR_S: f64 = 1.2;
/// Distance before the shared ground within which slowing down is attributed to it, metres along the path.
const SLOWS_WITHIN_M: f64 = 30.0;
/// Share of the earlier speed below which an agent gives way.
const SLOWED: f64 = 0.6;

/// Relations of `me` to the others, at most [`MOST`]: crossing paths first, by the time at which `me` is
/// there, then its leader. `start_step` is the scene step of the first moment of all traces.
pub fn relations<'a>(
    me: &Trace,
    others: impl IntoIterator<Item = &'a Trace>,
    start_step: usize,
) -> Vec<Relation> {
    let mut found: Vec<Found<'_>> = Vec::new();
    for other in others {
        if other.id == me.id || !me.may_meet(other) {
            continue;
        }
        found.extend(relation(me, other));
    }
    // Only the most significant relations stay.
    found.sort_by(|a, b| a.weight().total_cmp(&b.weight()).then_with(|| a.with.cmp(b.with)));
    found.truncate(MOST);
    let follows = |f: &Found<'_>| f.kind == RelationKind::Follows;
    found.sort_by(|a, b| follows(a).cmp(&follows(b)).then(a.moment.cmp(&b.moment)));
    let told = |f: Found<'_>| Relation {
        kind: f.kind,
        with: f.with.to_owned(),
        time_s: rounded((start_step + f.moment * STRIDE) as f64 * STEP_S),
        x_m: rounded(f.place.x),
        y_m: rounded(f.place.y),
        gap_s: f.gap_s.map(rounded),
    };
    found.into_iter().map(told).collect()
}

struct Found<'a> {
    kind: RelationKind,
    with: &'a str,
    moment: usize,
    place: Vec2,
    gap_s: Option<f64>,
}

impl Found<'_> {
    /// Rank, lower first: giving way, then crossing with a small gap, then following.
    fn weight(&self) -> f64 {
        let gap_s = self.gap_s.unwrap_or(0.0);
        match self.kind {
            RelationKind::GivesWayTo => gap_s,
            RelationKind::Before | RelationKind::After => WINDOW_S + gap_s,
            RelationKind::Follows => 3.0 * WINDOW_S + gap_s,
        }
    }
}

fn relation<'a>(me: &Trace, other: &'a Trace) -> Option<Found<'a>> {
    let crosses = crossing(me, other).and_then(|ground| of_ground(me, other, &ground));
    crosses.or_else(|| follows(me, other))
}

fn of_ground<'a>(me: &Trace, other: &'a Trace, ground: &SharedGround) -> Option<Found<'a>> {
    let there = me.moments.get(ground.enters.0).and_then(Option::as_ref);
    let place = match there.filter(|_| !ground.beyond) {
        Some(moment) => moment.center,
        None => other.moments.get(ground.nearest.1)?.as_ref()?.center,
    };
    let gap = ground.shift.0.unsigned_abs().min(ground.shift.1.unsigned_abs());
    let gap_s = (!ground.beyond).then_some(gap as f64 * MOMENT_S);
    let found = |kind| Some(Found { kind, with: &other.id, moment: ground.enters.0, place, gap_s });
    match ground.order() {
        1 if !ground.beyond => found(RelationKind::Before),
        -1 if gives_way(me, ground) => found(RelationKind::GivesWayTo),
        -1 if !ground.beyond => found(RelationKind::After),
        _ => None,
    }
}

/// Whether the agent slows down or waits before the shared ground until the other has passed it.
fn gives_way(me: &Trace, ground: &SharedGround) -> bool {
    let enters = ground.enters.0;
    let Some(at) = me.moments.get(enters).and_then(Option::as_ref) else { return false };
    let until = enters.min(ground.theirs.1 + (1.0 / MOMENT_S) as usize);
    let near = |moment: &Moment| at.way_m - moment.way_m < SLOWS_WITHIN_M;
    let slowest = (0..=until)
        .filter_map(|k| Some((k, me.moments.get(k)?.as_ref()?)))
        .filter(|(_, m)| near(m))
        .min_by(|a, b| a.1.speed_mps.total_cmp(&b.1.speed_mps));
    let Some((when, slowest)) = slowest else { return false };
    let before = (0..when).filter_map(|k| me.speed_at(k)).fold(slowest.speed_mps, f64::max);
    let drop_mps = if me.agent_type == AgentType::Pedestrian { 0.4 } else { 1.0 };
    let slowed = slowest.speed_mps < SLOWED * before && before - slowest.speed_mps > drop_mps;
    let after = (when..me.moments.len()).filter_map(|k| me.speed_at(k)).fold(0.0, f64::max);
    // An agent that stands counts as waiting only if it slowed down before or continues afterwards.
    let waits = slowest.speed_mps < STANDING_MPS && (slowed || after > drop_mps);
    slowed || waits
}

/// Whether the agent is behind the other on the same path for long enough.
fn follows<'a>(me: &Trace, other: &'a Trace) -> Option<Found<'a>> {
    if me.way_m < GOES_M || me.agent_type == AgentType::Pedestrian {
        return None;
    }
    let mut nearest: Option<(f64, usize, Vec2)> = None;
    let mut count = 0;
    for (i, moment) in me.moments.iter().enumerate() {
        let Some(moment) = moment else { continue };
        let Some(gap) = gap_behind(me, i, moment, other) else { continue };
        count += 1;
        if nearest.is_none_or(|n| gap < n.0) {
            nearest = Some((gap, i, moment.center));
        }
    }
    let (gap_s, moment, place) = nearest?;
    let long = count as f64 * MOMENT_S >= FOLLOWS_FOR_S;
    let gap_s = gap_s.is_finite().then_some(gap_s);
    long.then_some(Found { kind: RelationKind::Follows, with: &other.id, moment, place, gap_s })
}

/// Seconds behind the other at a moment, if the other is ahead on the same path and within [`HEADWAY_S`].
fn gap_behind(me: &Trace, i: usize, moment: &Moment, other: &Trace) -> Option<f64> {
    let now = other.moments.get(i)?.as_ref()?;
    let speed = moment.speed_mps.max(0.5);
    let between = now.center - moment.center;
    let reach = HEADWAY_S * speed + QUEUE_M + me.radius_m + other.radius_m;
    if between.norm_squared() > reach * reach {
        return None;
    }
    let turned = wrap_angle(now.heading_rad - moment.heading_rad).abs();
    if turned > 2.0 * SAME_WAY_RAD {
        return None;
    }
    // Straight ahead, or where the other will be within the headway.
    let facing = me.forward(moment);
    let (along, aside) = (between.dot(&facing), cross(facing, between));
    let bumper = along - 0.5 * (me.size.length_m + other.size.length_m);
    let beside = 0.5 * (me.size.width_m + other.size.width_m);
    let ahead = bumper > 0.0 && aside.abs() < 0.7 * beside && turned < SAME_WAY_RAD;
    let on_the_way = || {
        let to = (i + (HEADWAY_S / MOMENT_S) as usize).min(me.moments.len().saturating_sub(1));
        (i + 1..=to).find(|k| {
            me.moments[*k].as_ref().is_some_and(|m| {
                let way = wrap_angle(m.heading_rad - now.heading_rad).abs();
                way < SAME_WAY_RAD && me.overlaps(m, other, now)
            })
        })
    };
    if ahead && (bumper < HEADWAY_S * moment.speed_mps || bumper < QUEUE_M) {
        // Both stand, so the gap has no value in seconds.
        return Some(if moment.speed_mps > STANDING_MPS { bumper / moment.speed_mps } else { f64::INFINITY });
    }
    if along <= 0.0 {
        return None;
    }
    on_the_way().map(|k| (k - i) as f64 * MOMENT_S)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::direction;
    use crate::{Size, State, Subtype};
    use std::f64::consts::{FRAC_PI_2, PI};

    fn size(agent_type: AgentType) -> Size {
        Size::default_for(agent_type, Subtype::Unknown)
    }

    /// Along a straight line, at the given speed of each time.
    fn ride(from: (f64, f64), heading_rad: f64, speed: impl Fn(f64) -> f64) -> Vec<State> {
        let (mut at, ahead) = (Vec2::new(from.0, from.1), direction(heading_rad));
        (0..90)
            .map(|i| {
                let v = ahead * speed(i as f64 * STEP_S);
                let state = State { x_m: at.x, y_m: at.y, heading_rad, vx_mps: v.x, vy_mps: v.y };
                at += v * STEP_S;
                state
            })
            .collect()
    }

    fn trace(id: &str, agent_type: AgentType, states: &[State]) -> Trace {
        let at = |step: usize| states.get(step).copied();
        Trace::new(id, agent_type, &size(agent_type), states.len(), at).going_on()
    }

    fn car(id: &str, states: &[State]) -> Trace {
        trace(id, AgentType::Vehicle, states)
    }

    fn walker(id: &str, states: &[State]) -> Trace {
        trace(id, AgentType::Pedestrian, states)
    }

    /// Eastwards through x = 40 at 10 m/s, at 4 s.
    fn east() -> Vec<State> {
        ride((0.0, 0.0), 0.0, |_| 10.0)
    }

    fn kinds(me: &Trace, others: &[Trace]) -> Vec<(RelationKind, String)> {
        relations(me, others, 0).into_iter().map(|r| (r.kind, r.with)).collect()
    }

    #[test]
    fn who_is_first_where_paths_cross() {
        let north = |passes_s: f64| ride((40.0, -10.0 * passes_s), FRAC_PI_2, |_| 10.0);
        let me = car("me", &east());
        let later = relations(&me, &[car("late", &north(6.0))], 10);
        assert_eq!(later[0].kind, RelationKind::Before);
        // 2 s between the centres, of which the boxes take 0.67 s.
        let gap_s = later[0].gap_s.unwrap();
        assert!((gap_s - 1.4).abs() < 0.21, "{gap_s}");
        assert!((later[0].time_s - 4.7).abs() < 0.4 && (later[0].x_m - 37.0).abs() < 3.0, "{later:?}");
        assert_eq!(kinds(&me, &[car("early", &north(2.0))]), [(RelationKind::After, "early".into())]);
        // There is no order where they collide, nor if ten seconds lie between them.
        assert!(kinds(&me, &[car("meets", &north(4.0))]).is_empty());
        assert!(kinds(&me, &[car("never", &north(12.0))]).is_empty());
    }

    #[test]
    fn slowing_down_for_somebody_is_giving_way() {
        let braking = |t: f64| if t < 3.0 { 10.0 - 3.0 * t } else { 1.0 + 2.0 * (t - 3.0) };
        let me = car("me", &ride((0.0, 0.0), 0.0, braking));
        // At 26 m when it crosses at 5 s, ahead of the braking car.
        let crossing = car("x", &ride((26.0, -40.0), FRAC_PI_2, |_| 10.0));
        assert_eq!(kinds(&me, &[crossing]), [(RelationKind::GivesWayTo, "x".into())]);
    }

    #[test]
    fn waiting_for_a_walker_until_the_end_is_giving_way() {
        // Stops at x = 20 after 4 s and stays there; a pedestrian crosses at x = 26.
        let stopping = |t: f64| (10.0 - 2.5 * t).max(0.0);
        let me = car("me", &ride((0.0, 0.0), 0.0, stopping));
        let over = walker("7", &ride((26.0, -8.0), FRAC_PI_2, |_| 1.4));
        let found = relations(&me, &[over], 0);
        assert_eq!((found[0].kind, found[0].gap_s), (RelationKind::GivesWayTo, None));
        let away = walker("8", &ride((60.0, -8.0), FRAC_PI_2, |_| 1.4));
        assert!(relations(&me, &[away], 0).is_empty());
    }

    #[test]
    fn walkers_cross_before_and_after_cars_but_not_each_other() {
        // Over the lane at 1.4 m/s: on it from about 1.2 to 3.4 s.
        let me = walker("me", &ride((30.0, -3.2), FRAC_PI_2, |_| 1.4));
        let from = |x: f64| car("c", &ride((x, 0.0), 0.0, |_| 10.0));
        assert_eq!(kinds(&me, &[from(-25.0)]), [(RelationKind::Before, "c".into())]);
        assert_eq!(kinds(&me, &[from(22.0)]), [(RelationKind::After, "c".into())]);
        let other = walker("w", &ride((30.0, 5.0), -FRAC_PI_2, |_| 1.4));
        assert!(kinds(&me, &[other]).is_empty());
    }

    #[test]
    fn behind_on_the_same_way_is_following() {
        let me = car("me", &east());
        let ahead = |x: f64| car("a", &ride((x, 0.3), 0.0, |_| 10.0));
        assert_eq!(kinds(&me, &[ahead(20.0)]), [(RelationKind::Follows, "a".into())]);
        assert!(kinds(&me, &[ahead(60.0)]).is_empty());
        // Behind, beside and oncoming.
        assert!(kinds(&me, &[ahead(-20.0)]).is_empty());
        assert!(kinds(&me, &[car("b", &ride((15.0, 3.5), 0.0, |_| 10.0))]).is_empty());
        assert!(kinds(&me, &[car("o", &ride((90.0, 3.5), PI, |_| 10.0))]).is_empty());
        // In the queue behind a standing agent.
        let queue = car("me", &ride((0.0, 0.0), 0.0, |t| (6.0 - 1.5 * t).max(0.0)));
        let stands = car("s", &ride((18.5, 0.0), 0.0, |_| 0.0));
        assert_eq!(kinds(&queue, &[stands]), [(RelationKind::Follows, "s".into())]);
    }

    #[test]
    fn merging_has_an_order() {
        let me = car("me", &east());
        // From the side onto the same lane, 3 s after the other.
        let mut merging = ride((10.0, -30.0), FRAC_PI_2, |_| 5.0);
        for (i, state) in merging.iter_mut().enumerate().skip(60) {
            let x = 10.0 + 0.5 * (i as f64 - 60.0);
            *state = State { x_m: x, y_m: 0.0, heading_rad: 0.0, vx_mps: 5.0, vy_mps: 0.0 };
        }
        assert_eq!(kinds(&me, &[car("m", &merging)]), [(RelationKind::Before, "m".into())]);
    }

    #[test]
    fn the_most_telling_four_are_told_in_order_of_time() {
        let me = car("me", &east());
        let cross =
            |id: &str, x: f64, passes_s: f64| car(id, &ride((x, -10.0 * passes_s), FRAC_PI_2, |_| 10.0));
        let others = [
            cross("far", 70.0, 2.0),
            cross("b", 50.0, 7.0),
            cross("c", 60.0, 8.0),
            cross("d", 30.0, 5.0),
            cross("e", 20.0, 4.0),
        ];
        let told: Vec<String> = kinds(&me, &others).into_iter().map(|r| r.1).collect();
        assert_eq!(told, ["e", "d", "b", "c"]);
    }
}
