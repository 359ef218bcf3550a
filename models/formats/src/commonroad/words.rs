//! The words of CommonRoad and their counterparts in a scene.

use crate::sides::LaneletKind;
use scene::map::LaneType;
use scene::{AgentType, SignalState, Subtype};

/// Versions of the format that are read.
pub(super) const VERSIONS: [&str; 2] = ["2018b", "2020a"];
/// The version that is written.
pub(super) const VERSION: &str = "2020a";

/// Words of a lanelet's types, the most specific first.
const LANE_TYPES: [(&str, LaneletKind); 18] = [
    ("crosswalk", LaneletKind::Crosswalk),
    ("sidewalk", LaneletKind::Lane(LaneType::Sidewalk)),
    ("bicycleLane", LaneletKind::Lane(LaneType::BikeLane)),
    ("busLane", LaneletKind::Lane(LaneType::BusLane)),
    ("parking", LaneletKind::Lane(LaneType::Parking)),
    // Areas without through traffic.
    ("shoulder", LaneletKind::Lane(LaneType::Parking)),
    ("border", LaneletKind::Lane(LaneType::Parking)),
    ("restricted", LaneletKind::Lane(LaneType::Parking)),
    ("restricted_area", LaneletKind::Lane(LaneType::Parking)),
    ("busStop", LaneletKind::Lane(LaneType::Parking)),
    ("highway", LaneletKind::Lane(LaneType::Freeway)),
    ("interstate", LaneletKind::Lane(LaneType::Freeway)),
    ("mainCarriageWay", LaneletKind::Lane(LaneType::Freeway)),
    ("accessRamp", LaneletKind::Lane(LaneType::Freeway)),
    ("exitRamp", LaneletKind::Lane(LaneType::Freeway)),
    ("urban", LaneletKind::Lane(LaneType::SurfaceStreet)),
    ("country", LaneletKind::Lane(LaneType::SurfaceStreet)),
    ("driveWay", LaneletKind::Lane(LaneType::SurfaceStreet)),
];
/// Type of a lanelet through a junction.
pub(super) const INTERSECTION: &str = "intersection";
/// Type of a lanelet without known type.
pub(super) const UNKNOWN: &str = "unknown";

/// Use of a lanelet with these types and users.
pub(super) fn lane_kind(types: &[String], users: &[String]) -> LaneletKind {
    let only = |word: &str| !users.is_empty() && users.iter().all(|user| user == word);
    let has = |word: &str| types.iter().any(|found| found == word);
    let said = LANE_TYPES.iter().find(|(word, _)| has(word)).map(|(_, kind)| *kind);
    match said {
        Some(
            kind @ (LaneletKind::Crosswalk | LaneletKind::Lane(LaneType::Sidewalk | LaneType::BikeLane)),
        ) => kind,
        _ if only("pedestrian") => LaneletKind::Lane(LaneType::Sidewalk),
        _ if only("bicycle") => LaneletKind::Lane(LaneType::BikeLane),
        Some(kind) => kind,
        None if has(UNKNOWN) => LaneletKind::Lane(LaneType::Undefined),
        None => LaneletKind::Lane(LaneType::SurfaceStreet),
    }
}

/// The word for a type of lane.
pub(super) fn lane_word(lane_type: LaneType) -> &'static str {
    match lane_type {
        LaneType::Undefined => UNKNOWN,
        LaneType::SurfaceStreet => "urban",
        LaneType::Freeway => "highway",
        LaneType::BikeLane => "bicycleLane",
        LaneType::BusLane => "busLane",
        LaneType::Sidewalk => "sidewalk",
        LaneType::Parking => "parking",
    }
}

/// Words for a marking, and the line type of each in a scene.
const MARKINGS: [(&str, &str); 8] = [
    ("dashed", "broken_single_white"),
    ("solid", "solid_single_white"),
    ("solid_solid", "solid_double_white"),
    ("broad_dashed", "broken_single_white"),
    ("broad_solid", "solid_single_white"),
    ("dashed_dashed", "broken_single_white"),
    ("solid_dashed", "solid_double_white"),
    ("dashed_solid", "solid_double_white"),
];

/// Line type of a marking; `None` if nothing is painted.
pub(super) fn line_type(marking: &str) -> Option<&'static str> {
    MARKINGS.iter().find(|(word, _)| *word == marking).map(|(_, line)| *line)
}

/// The marking of a line type.
pub(super) fn marking(line_type: &str) -> &'static str {
    match line_type {
        "broken_single_white" | "broken_single_yellow" | "broken_double_yellow" => "dashed",
        "solid_single_white" | "solid_single_yellow" => "solid",
        "solid_double_white" | "solid_double_yellow" => "solid_solid",
        "passing_double_yellow" => "solid_dashed",
        _ => UNKNOWN,
    }
}

/// Speed limit signs of all countries that the format covers.
pub(super) const MAX_SPEED_SIGNS: [&str; 10] =
    ["274", "274.1", "R2-1", "r301", "3.24", "R15", "C43", "B14", "B31", "\u{3a1}-32"];
/// Stop signs.
pub(super) const STOP_SIGNS: [&str; 3] = ["206", "R1-1", "r2"];

/// Signal state of a colour.
pub(super) fn signal_state(color: &str) -> Option<SignalState> {
    Some(match color {
        // Red-yellow still forbids crossing the stop line.
        "red" | "redYellow" => SignalState::Stop,
        "yellow" => SignalState::Caution,
        "green" => SignalState::Go,
        "inactive" => SignalState::Unknown,
        _ => return None,
    })
}

/// The colour of a signal state.
pub(super) fn color(state: SignalState) -> &'static str {
    match state {
        SignalState::Unknown => "inactive",
        SignalState::Stop | SignalState::ArrowStop | SignalState::FlashingStop => "red",
        SignalState::Caution | SignalState::ArrowCaution | SignalState::FlashingCaution => "yellow",
        SignalState::Go | SignalState::ArrowGo => "green",
    }
}

/// Words for road users. The first word of a kind is written.
const ROAD_USERS: [(&str, AgentType, Subtype); 13] = [
    ("car", AgentType::Vehicle, Subtype::Car),
    ("truck", AgentType::Vehicle, Subtype::Truck),
    ("bus", AgentType::Vehicle, Subtype::Bus),
    ("motorcycle", AgentType::Vehicle, Subtype::Motorcycle),
    ("priorityVehicle", AgentType::Vehicle, Subtype::Emergency),
    ("taxi", AgentType::Vehicle, Subtype::Car),
    ("parkedVehicle", AgentType::Vehicle, Subtype::Car),
    ("pedestrian", AgentType::Pedestrian, Subtype::Unknown),
    ("bicycle", AgentType::Cyclist, Subtype::Unknown),
    ("unknown", AgentType::Other, Subtype::Unknown),
    ("train", AgentType::Other, Subtype::Unknown),
    ("constructionZone", AgentType::Other, Subtype::Unknown),
    ("roadBoundary", AgentType::Other, Subtype::Unknown),
];

/// Type and subtype of a road user's word.
pub(super) fn road_user(word: &str) -> (AgentType, Subtype) {
    let found = ROAD_USERS.iter().find(|(known, ..)| *known == word);
    found.map_or((AgentType::Other, Subtype::Unknown), |(_, agent_type, subtype)| (*agent_type, *subtype))
}

/// Word of a road user, and whether it preserves the subtype.
pub(super) fn road_user_word(agent_type: AgentType, subtype: Subtype) -> (&'static str, bool) {
    let of_type = || ROAD_USERS.iter().filter(|(_, known, _)| *known == agent_type);
    let exact = of_type().find(|(.., known)| *known == subtype);
    exact.or_else(|| of_type().next()).map_or((UNKNOWN, false), |(word, ..)| (*word, exact.is_some()))
}

/// Tags of a scenario that the format has words for.
pub(super) const TAGS: [&str; 28] = [
    "interstate",
    "highway",
    "urban",
    "comfort",
    "critical",
    "evasive",
    "cut_in",
    "illegal_cutin",
    "intersection",
    "lane_change",
    "lane_following",
    "merging_lanes",
    "multi_lane",
    "no_oncoming_traffic",
    "oncoming_traffic",
    "parallel_lanes",
    "race_track",
    "roundabout",
    "rural",
    "simulated",
    "single_lane",
    "slip_road",
    "speed_limit",
    "traffic_jam",
    "turn_left",
    "turn_right",
    "two_lane",
    "emergency_braking",
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_that_are_written_are_read() {
        let types = [
            LaneType::Undefined,
            LaneType::Freeway,
            LaneType::SurfaceStreet,
            LaneType::BikeLane,
            LaneType::BusLane,
            LaneType::Sidewalk,
            LaneType::Parking,
        ];
        for lane_type in types {
            assert_eq!(lane_kind(&[lane_word(lane_type).to_owned()], &[]), LaneletKind::Lane(lane_type));
        }
        for (word, agent_type, subtype) in &ROAD_USERS[..5] {
            assert_eq!(road_user_word(*agent_type, *subtype), (*word, true));
        }
        assert_eq!(road_user_word(AgentType::Vehicle, Subtype::Van), ("car", false));
        assert_eq!(road_user_word(AgentType::Pedestrian, Subtype::Child), ("pedestrian", false));
        for line in scene::map::ROAD_LINE_TYPES {
            let white = line.replace("yellow", "white").replace("broken_double", "broken_single");
            let white = white.replace("passing_double", "solid_double");
            assert_eq!(line_type(marking(line)).unwrap_or("unknown"), white);
        }
        let users = |word: &str| vec![word.to_owned()];
        assert_eq!(lane_kind(&[], &users("pedestrian")), LaneletKind::Lane(LaneType::Sidewalk));
        assert_eq!(lane_kind(&users("crosswalk"), &users("pedestrian")), LaneletKind::Crosswalk);
    }
}
