//! Marks events of a single road user that the log contains already: off the road, against the traffic, harsh
//! braking, red-light violations.

use super::input::{Actor, ScoreInput};
use super::report::{RedLight, Stretch};
use super::{kinematic, lane_rules, road, signals, walking};
use std::borrow::Cow;
use std::cell::OnceCell;

/// Greatest time difference to the log's event for the same event, seconds.
const SAME_S: f64 = 1.0;
/// Greatest excess over the log's stretch for the same event: metres off the road.
const SAME_OFF_ROAD_M: f64 = 0.3;
/// ... m/s2 of braking or lateral acceleration ...
const SAME_HARSH_MPS2: f64 = 1.0;
/// ... metres driven against the traffic.
const SAME_WRONG_WAY_M: f64 = 5.0;
/// ... metres from the lanes beyond the end of the map's roads ...
const SAME_OFF_MAP_M: f64 = 5.0;
/// ... metres walked on the carriageway ...
const SAME_ON_CARRIAGEWAY_M: f64 = 3.0;
/// ... m/s above the limit, or of running ...
const SAME_SPEED_MPS: f64 = 1.0;
/// ... radians askew.
const SAME_ASKEW_RAD: f64 = 0.1;

/// The road user as it was recorded, if there is a recording.
fn as_recorded<'a>(actor: &Actor<'a>) -> Option<Actor<'a>> {
    let log = actor.log.filter(|log| log.states.iter().any(Option::is_some))?;
    Some(Actor { track: Cow::Borrowed(log), generated: false, ..actor.clone() })
}

/// Marks stretches of `actor` that its recording has too; `log` finds the stretches of the recording.
fn mark(actor: &Actor<'_>, found: &mut [Stretch], worse: f64, log: impl FnOnce(&Actor<'_>) -> Vec<Stretch>) {
    if found.is_empty() {
        return;
    }
    let log =
        if actor.generated { as_recorded(actor).map(|a| log(&a)).unwrap_or_default() } else { Vec::new() };
    for stretch in found {
        let same = |l: &Stretch| {
            let at_once = stretch.time_s <= l.until_s + SAME_S && stretch.until_s >= l.time_s - SAME_S;
            let excess = stretch.worst.unwrap_or(0.0) - l.worst.unwrap_or(0.0);
            at_once && stretch.until_s - stretch.time_s <= l.until_s - l.time_s + SAME_S && excess <= worse
        };
        stretch.in_log = !actor.generated || log.iter().any(same);
    }
}

/// Marks stretches off the road and against the traffic.
pub(crate) fn mark_road(input: &ScoreInput<'_>, actor: &Actor<'_>, found: &mut road::RoadScore) {
    let log = OnceCell::new();
    let of = |recorded: &Actor<'_>| log.get_or_init(|| road::score_road(input, recorded));
    mark(actor, &mut found.off_road, SAME_OFF_ROAD_M, |a| of(a).off_road.clone());
    mark(actor, &mut found.over_median, SAME_OFF_ROAD_M, |a| of(a).over_median.clone());
    mark(actor, &mut found.wrong_way, SAME_WRONG_WAY_M, |a| of(a).wrong_way.clone());
}

/// A rule that one road user keeps or breaks independently of the others, with its own list in the score.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum MotionRule {
    Braking,
    Steering,
    OffMap,
    OnCarriageway,
    Speeding,
    Running,
    Askew,
}

impl MotionRule {
    pub(crate) const ALL: [Self; 7] = [
        Self::Braking,
        Self::Steering,
        Self::OffMap,
        Self::OnCarriageway,
        Self::Speeding,
        Self::Running,
        Self::Askew,
    ];

    /// Stretches in which a motion breaks the rule, with those of its recording marked.
    pub(crate) fn breaches(self, input: &ScoreInput<'_>, actor: &Actor<'_>) -> Vec<Stretch> {
        let mut found = self.look(input, actor);
        mark(actor, &mut found, self.same(), |a| self.look(input, a));
        found
    }

    fn look(self, input: &ScoreInput<'_>, actor: &Actor<'_>) -> Vec<Stretch> {
        match self {
            Self::Braking => kinematic::harsh_braking(actor, input),
            Self::Steering => kinematic::harsh_steering(actor, input),
            Self::OffMap => lane_rules::off_map(actor, input),
            Self::OnCarriageway => walking::on_carriageway(actor, input),
            Self::Speeding => lane_rules::speeding(actor, input),
            Self::Running => walking::running(actor, input),
            Self::Askew => lane_rules::ends_askew(actor, input),
        }
    }

    /// Greatest excess over the log's stretch for the same event, in its unit.
    fn same(self) -> f64 {
        match self {
            Self::Braking | Self::Steering => SAME_HARSH_MPS2,
            Self::OffMap => SAME_OFF_MAP_M,
            Self::OnCarriageway => SAME_ON_CARRIAGEWAY_M,
            Self::Speeding | Self::Running => SAME_SPEED_MPS,
            Self::Askew => SAME_ASKEW_RAD,
        }
    }
}

/// Marks red-light violations that are in the log too.
pub(super) fn mark_red_lights(
    input: &ScoreInput<'_>,
    actor: &Actor<'_>,
    lines: &[signals::SignalStopLine<'_>],
    found: &mut [RedLight],
) {
    if found.is_empty() {
        return;
    }
    let recorded = as_recorded(actor).filter(|_| actor.generated);
    let log = recorded.map(|a| signals::crossed_at_red(input, &a, lines)).unwrap_or_default();
    for red in found {
        red.in_log = !actor.generated || log.iter().any(|l| is_same(l, red));
    }
}

fn is_same(logged: &RedLight, red: &RedLight) -> bool {
    logged.agent == red.agent && logged.lane == red.lane && (logged.time_s - red.time_s).abs() <= SAME_S
}

/// Removes red-light violations that are in the log too.
pub(crate) fn beyond_log(
    input: &ScoreInput<'_>,
    actor: &Actor<'_>,
    lines: &[signals::SignalStopLine<'_>],
    mut found: Vec<RedLight>,
) -> Vec<RedLight> {
    if !found.is_empty()
        && let Some(recorded) = as_recorded(actor)
    {
        let log = signals::crossed_at_red(input, &recorded, lines);
        found.retain(|red| !log.iter().any(|l| is_same(l, red)));
    }
    found
}

#[cfg(test)]
mod tests {
    use super::super::tests::{area, input_of, straight, track_of};
    use super::super::{Drivable, score};
    use crate::{AgentType, LaneMap, STEP_S, State, Track};

    fn road() -> Drivable {
        let road = area(&[(-10.0, -4.0), (45.0, -4.0), (45.0, 4.0), (-10.0, 4.0)]);
        Drivable::new(&LaneMap { drivable: vec![road], ..LaneMap::default() })
    }

    fn at_speed(speed_mps: f64) -> Track {
        track_of(|i| State { x_m: speed_mps * STEP_S * i as f64, vx_mps: speed_mps, ..State::default() })
    }

    #[test]
    fn what_the_recording_does_is_in_the_log() {
        let drivable = road();
        let mut car = straight("a", AgentType::Vehicle, (0.0, 0.0), 0.0, 10.0);
        car.generated = false;
        assert!(score(&input_of(vec![car], &drivable)).scene.off_road[0].in_log);
    }

    #[test]
    fn made_motion_counts_unless_the_recording_does_the_same() {
        let drivable = road();
        let off_road = |log: &Track| {
            let mut car = straight("a", AgentType::Vehicle, (0.0, 0.0), 0.0, 10.0);
            car.log = Some(log);
            score(&input_of(vec![car], &drivable)).scene.off_road[0].in_log
        };
        // The recording leaves the road too, almost as far; or stays on it.
        assert!(off_road(&at_speed(9.98)));
        assert!(!off_road(&at_speed(4.0)));
        // It goes off by one metre, the generated motion by 47 m.
        assert!(!off_road(&at_speed(4.9)));
    }
}
