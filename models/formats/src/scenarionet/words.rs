//! The words of ScenarioNet and their counterparts in a scene.

use scene::map::{LaneType, ROAD_EDGE_TYPES, ROAD_LINE_TYPES};
use scene::{AgentType, SignalState};

const LANE_TYPES: [(&str, LaneType); 10] = [
    ("LANE_SURFACE_STREET", LaneType::SurfaceStreet),
    ("LANE_SURFACE_UNSTRUCTURE", LaneType::SurfaceStreet),
    ("LANE_FREEWAY", LaneType::Freeway),
    ("LANE_BIKE_LANE", LaneType::BikeLane),
    ("LANE_BUS_LANE", LaneType::BusLane),
    ("LANE_EMERGENCY_LANE", LaneType::Parking),
    ("LANE_EXIT_ONLY", LaneType::SurfaceStreet),
    ("LANE_PARKING", LaneType::Parking),
    ("LANE_SIDEWALK", LaneType::Sidewalk),
    ("LANE_UNKNOWN", LaneType::Undefined),
];

/// Kind of a map feature.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Feature {
    Lane(LaneType),
    Line(&'static str),
    Edge(&'static str),
    StopSign,
    Crosswalk,
    SpeedBump,
    Driveway,
}

/// Kind of a map feature by its word; `None` if a scene cannot hold it.
pub(super) fn feature(word: &str) -> Option<Feature> {
    let lane =
        LANE_TYPES.iter().find(|(known, _)| *known == word).map(|(_, lane_type)| Feature::Lane(*lane_type));
    let named = |prefix: &str, words: &[&'static str]| {
        let rest = word.strip_prefix(prefix)?.to_ascii_lowercase();
        Some(words.iter().find(|known| **known == rest).copied().unwrap_or("unknown"))
    };
    let simple = || {
        Some(match word {
            "STOP_SIGN" => Feature::StopSign,
            "CROSSWALK" => Feature::Crosswalk,
            "SPEED_BUMP" => Feature::SpeedBump,
            "DRIVEWAY" => Feature::Driveway,
            _ if word.starts_with("LANE_") => Feature::Lane(LaneType::Undefined),
            _ => return None,
        })
    };
    lane.or_else(|| named("ROAD_LINE_", &ROAD_LINE_TYPES).map(Feature::Line))
        .or_else(|| named("ROAD_EDGE_", &ROAD_EDGE_TYPES).map(Feature::Edge))
        .or_else(simple)
}

/// The word for a lane, and whether the format has this kind of lane.
pub(super) fn lane_word(lane_type: LaneType) -> (&'static str, bool) {
    match lane_type {
        LaneType::SurfaceStreet => ("LANE_SURFACE_STREET", true),
        LaneType::Freeway => ("LANE_FREEWAY", true),
        LaneType::BikeLane => ("LANE_BIKE_LANE", true),
        LaneType::Undefined => ("LANE_UNKNOWN", true),
        LaneType::BusLane | LaneType::Sidewalk | LaneType::Parking => ("LANE_UNKNOWN", false),
    }
}

/// The word for a line or an edge.
pub(super) fn line_word(prefix: &str, line_type: &str) -> String {
    format!("{prefix}{}", line_type.to_ascii_uppercase())
}

const STATES: [(&str, SignalState); 13] = [
    ("LANE_STATE_UNKNOWN", SignalState::Unknown),
    ("LANE_STATE_ARROW_STOP", SignalState::ArrowStop),
    ("LANE_STATE_ARROW_CAUTION", SignalState::ArrowCaution),
    ("LANE_STATE_ARROW_GO", SignalState::ArrowGo),
    ("LANE_STATE_STOP", SignalState::Stop),
    ("LANE_STATE_CAUTION", SignalState::Caution),
    ("LANE_STATE_GO", SignalState::Go),
    ("LANE_STATE_FLASHING_STOP", SignalState::FlashingStop),
    ("LANE_STATE_FLASHING_CAUTION", SignalState::FlashingCaution),
    // Additional states of MetaDrive.
    ("TRAFFIC_LIGHT_RED", SignalState::Stop),
    ("TRAFFIC_LIGHT_YELLOW", SignalState::Caution),
    ("TRAFFIC_LIGHT_GREEN", SignalState::Go),
    ("TRAFFIC_LIGHT_UNKNOWN", SignalState::Unknown),
];

/// Signal state of a word.
pub(super) fn signal_state(word: &str) -> SignalState {
    STATES.iter().find(|(known, _)| *known == word).map_or(SignalState::Unknown, |(_, state)| *state)
}

/// The word for a signal state.
pub(super) fn signal_word(state: SignalState) -> &'static str {
    STATES.iter().find(|(_, known)| *known == state).map_or("LANE_STATE_UNKNOWN", |(word, _)| word)
}

/// Agent type of a word.
pub(super) fn agent_type(word: &str) -> AgentType {
    match word {
        "VEHICLE" => AgentType::Vehicle,
        "PEDESTRIAN" => AgentType::Pedestrian,
        "CYCLIST" => AgentType::Cyclist,
        _ => AgentType::Other,
    }
}

/// The word for a road user.
pub(super) fn agent_word(agent_type: AgentType) -> &'static str {
    match agent_type {
        AgentType::Vehicle => "VEHICLE",
        AgentType::Pedestrian => "PEDESTRIAN",
        AgentType::Cyclist => "CYCLIST",
        AgentType::Other => "OTHER",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_that_are_written_are_read() {
        for (_, state) in STATES {
            assert_eq!(signal_state(signal_word(state)), state);
        }
        for lane_type in [LaneType::SurfaceStreet, LaneType::Freeway, LaneType::BikeLane, LaneType::Undefined]
        {
            assert_eq!(feature(lane_word(lane_type).0), Some(Feature::Lane(lane_type)));
        }
        for line in ROAD_LINE_TYPES {
            assert_eq!(feature(&line_word("ROAD_LINE_", line)), Some(Feature::Line(line)));
        }
        for agent in [AgentType::Vehicle, AgentType::Pedestrian, AgentType::Cyclist, AgentType::Other] {
            assert_eq!(agent_type(agent_word(agent)), agent);
        }
        assert_eq!(feature("ROAD_EDGE_MEDIAN"), Some(Feature::Edge("median")));
        assert_eq!((feature("ROAD_LINE_NEW"), feature("GUARDRAIL")), (Some(Feature::Line("unknown")), None));
    }
}
