//! The situations by which learned distributions of speeds and poses are kept. Their names are the keys of
//! the weights file.

use crate::tuning::placing::context::{LEADER_WITHIN_M, PACES_MPS};
use serde::{Deserialize, Serialize};

/// Reason to stop ahead of a driver, in the classes by which speeds are learned.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum RoadAhead {
    /// Nothing near enough to matter.
    Clear,
    /// Inside a junction whose signal, if any, is not red.
    Junction,
    /// Inside a junction whose signal is red.
    JunctionOnRed,
    /// A stop sign or a junction without signals within 12 m.
    YieldWithin12M,
    /// The same within 30 m.
    YieldWithin30M,
    /// A signal that is not red within 30 m.
    GoWithin30M,
    /// A red signal within 10 m.
    RedWithin10M,
    /// A red signal within 25 m.
    RedWithin25M,
    /// A red signal within 50 m.
    RedWithin50M,
}

/// Gap to the leader, metres.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[allow(missing_docs, reason = "the names say it")]
pub enum LeaderGap {
    Within4M,
    Within8M,
    Within15M,
    Within25M,
    Within40M,
}

/// Speed of the leader.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum LeaderPace {
    /// Below 0.5 m/s.
    Standing,
    /// Up to 5 m/s.
    Slow,
    /// Above 5 m/s.
    Fast,
}

/// The situation that a speed is drawn for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub enum SpeedContext {
    /// A driver, by the road ahead and the leader, if one is near.
    Driver(RoadAhead, Option<(LeaderGap, LeaderPace)>),
    /// A driver by the road ahead, with any leader: replaces a situation that was too rare.
    DriverAnyLeader(RoadAhead),
    /// All drivers together.
    AnyDriver,
    /// A pedestrian on a crosswalk.
    Crosswalk,
    /// A pedestrian on a pavement.
    Pavement,
}

/// The situation that offset and heading are drawn for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum PoseContext {
    /// On a lane outside junctions.
    Lane,
    /// On a lane through a junction.
    JunctionLane,
    /// On a bicycle lane.
    BikeLane,
    /// At a kerb with less than 3.5 m beside the lane; the offset is measured from the kerb.
    NarrowKerb,
    /// At a kerb with more room; the offset is measured from the lane's border.
    WideKerb,
    /// Beside a lane without a kerb.
    NoKerb,
    /// On a crosswalk.
    Crosswalk,
    /// On a pavement.
    Pavement,
    /// In a driveway.
    Driveway,
}

const ROADS: [(RoadAhead, &str); 9] = [
    (RoadAhead::Clear, "clear"),
    (RoadAhead::Junction, "junction"),
    (RoadAhead::JunctionOnRed, "junction_on_red"),
    (RoadAhead::YieldWithin12M, "yield_within_12m"),
    (RoadAhead::YieldWithin30M, "yield_within_30m"),
    (RoadAhead::GoWithin30M, "go_within_30m"),
    (RoadAhead::RedWithin10M, "red_within_10m"),
    (RoadAhead::RedWithin25M, "red_within_25m"),
    (RoadAhead::RedWithin50M, "red_within_50m"),
];
const GAPS: [(LeaderGap, &str, f64); 5] = [
    (LeaderGap::Within4M, "leader_within_4m", LEADER_WITHIN_M[0]),
    (LeaderGap::Within8M, "leader_within_8m", LEADER_WITHIN_M[1]),
    (LeaderGap::Within15M, "leader_within_15m", LEADER_WITHIN_M[2]),
    (LeaderGap::Within25M, "leader_within_25m", LEADER_WITHIN_M[3]),
    (LeaderGap::Within40M, "leader_within_40m", LEADER_WITHIN_M[4]),
];
const PACES: [(LeaderPace, &str); 3] =
    [(LeaderPace::Standing, "standing"), (LeaderPace::Slow, "slow"), (LeaderPace::Fast, "fast")];
const ANY_DRIVER: &str = "any_driver";
const CROSSWALK: &str = "crosswalk";
const PAVEMENT: &str = "pavement";
const NO_LEADER: &str = "no_leader";

impl SpeedContext {
    /// The situation of a driver. The leader is given by its gap in metres and its speed in m/s; one 40 m or
    /// more ahead does not count.
    pub(super) fn driver(ahead: RoadAhead, leader: Option<(f64, f64)>) -> Self {
        let near = leader.and_then(|(gap_m, speed_mps)| {
            let (gap, ..) = GAPS.iter().find(|(_, _, below_m)| gap_m < *below_m)?;
            let pace = match speed_mps {
                v if v < PACES_MPS.0 => LeaderPace::Standing,
                v if v > PACES_MPS.1 => LeaderPace::Fast,
                _ => LeaderPace::Slow,
            };
            Some((*gap, pace))
        });
        Self::Driver(ahead, near)
    }

    /// The next more general situation, which replaces an unknown one.
    pub fn broader(self) -> Option<Self> {
        match self {
            Self::Driver(ahead, _) => Some(Self::DriverAnyLeader(ahead)),
            Self::DriverAnyLeader(_) => Some(Self::AnyDriver),
            Self::AnyDriver | Self::Crosswalk | Self::Pavement => None,
        }
    }

    /// This situation and the more general ones, the most general last.
    pub fn with_broader(self) -> impl Iterator<Item = Self> {
        std::iter::successors(Some(self), |context| context.broader())
    }
}

fn name_of<T: PartialEq>(value: T, names: &[(T, &'static str)]) -> &'static str {
    names.iter().find(|(known, _)| *known == value).map_or("", |(_, name)| *name)
}

impl From<SpeedContext> for String {
    fn from(context: SpeedContext) -> Self {
        match context {
            SpeedContext::Driver(ahead, None) => format!("{}.{NO_LEADER}", name_of(ahead, &ROADS)),
            SpeedContext::Driver(ahead, Some((gap, pace))) => {
                let gap = GAPS.iter().find(|(known, ..)| *known == gap).map_or("", |(_, name, _)| *name);
                format!("{}.{gap}.{}", name_of(ahead, &ROADS), name_of(pace, &PACES))
            }
            SpeedContext::DriverAnyLeader(ahead) => name_of(ahead, &ROADS).to_owned(),
            SpeedContext::AnyDriver => ANY_DRIVER.to_owned(),
            SpeedContext::Crosswalk => CROSSWALK.to_owned(),
            SpeedContext::Pavement => PAVEMENT.to_owned(),
        }
    }
}

impl TryFrom<String> for SpeedContext {
    type Error = String;

    fn try_from(text: String) -> Result<Self, String> {
        let road = |name| ROADS.iter().find(|(_, known)| *known == name).map(|(road, _)| *road);
        let gap = |name| GAPS.iter().find(|(_, known, _)| *known == name).map(|(gap, ..)| *gap);
        let pace = |name| PACES.iter().find(|(_, known)| *known == name).map(|(pace, _)| *pace);
        let words: Vec<&str> = text.split('.').collect();
        let found = match *words.as_slice() {
            [ANY_DRIVER] => Some(Self::AnyDriver),
            [CROSSWALK] => Some(Self::Crosswalk),
            [PAVEMENT] => Some(Self::Pavement),
            [ahead] => road(ahead).map(Self::DriverAnyLeader),
            [ahead, NO_LEADER] => road(ahead).map(|ahead| Self::Driver(ahead, None)),
            [ahead, near, speed] => road(ahead)
                .zip(gap(near).zip(pace(speed)))
                .map(|(ahead, leader)| Self::Driver(ahead, Some(leader))),
            _ => None,
        };
        found.ok_or_else(|| {
            let shown: String = text.chars().take(40).collect();
            format!("\"{shown}\" is no speed context, such as clear.leader_within_8m.slow")
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_name_reads_back() {
        let leaders = GAPS.iter().flat_map(|(gap, ..)| PACES.iter().map(|(pace, _)| Some((*gap, *pace))));
        let leaders: Vec<_> = leaders.chain([None]).collect();
        let mut all = vec![SpeedContext::AnyDriver, SpeedContext::Crosswalk, SpeedContext::Pavement];
        for (ahead, _) in ROADS {
            all.push(SpeedContext::DriverAnyLeader(ahead));
            all.extend(leaders.iter().map(|leader| SpeedContext::Driver(ahead, *leader)));
        }
        for context in all {
            let name = String::from(context);
            assert_eq!(SpeedContext::try_from(name.clone()), Ok(context), "{name}");
        }
        for wrong in ["", "1003", "clear.fast", "clear.no_leader.slow", "lane"] {
            assert!(SpeedContext::try_from(wrong.to_owned()).is_err(), "{wrong}");
        }
    }

    #[test]
    fn leaders_fall_into_their_classes() {
        let of =
            |gap_m, speed_mps| String::from(SpeedContext::driver(RoadAhead::Clear, Some((gap_m, speed_mps))));
        assert_eq!(of(3.9, 0.4), "clear.leader_within_4m.standing");
        assert_eq!(of(4.0, 5.0), "clear.leader_within_8m.slow");
        assert_eq!(of(39.9, 5.1), "clear.leader_within_40m.fast");
        assert_eq!(of(40.0, 5.1), "clear.no_leader");
        let chain: Vec<String> =
            SpeedContext::driver(RoadAhead::RedWithin10M, None).with_broader().map(String::from).collect();
        assert_eq!(chain, ["red_within_10m.no_leader", "red_within_10m", "any_driver"]);
    }
}
