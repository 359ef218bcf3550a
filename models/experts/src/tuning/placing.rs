//! Constants of placement that are not learned.
//!
//! All were set by hand between 2026-11-21 and 2026-11-26; statistics of recorded scenes are a table beside
//! the weights. No generated future depends on them, so they are not part of
//! [`Tuning::hash`](super::Tuning::hash).

use scene::AgentType;
use std::f64::consts::PI;

numbers! {
    /// Of `placement::arms`.
    arms {
        /// Heading difference beyond which lanes belong to different roads, radians.
        SAME_ROAD_RAD: f64 = 0.6;
        /// Distance across and along the road beyond which lanes belong to different roads, metres.
        SAME_ROAD_M: (f64, f64) = (10.0, 30.0);
        /// Distance behind the beginning of an opening lane at which its neighbour already exists, metres.
        BEHIND_M: f64 = 4.0;
        /// Greatest distance between the beginnings of one road's lanes at the map's edge, metres.
        RAGGED_M: f64 = 15.0;
        /// Shortest lane by which vehicles enter, metres.
        SHORTEST_M: f64 = 5.0;
        /// Greatest length of an arm, metres.
        LONGEST_M: f64 = 3_000.0;
        /// Speed of free traffic as a share of what the limit and bends allow.
        FREE_SHARE: f64 = 0.95;
        /// Radius of the search for the lane beside an opening one, metres.
        BESIDE_REACH_M: f64 = 8.0;
    }
    /// Of `placement::arrivals`.
    arrivals {
        /// Shortest time between two vehicles of a lane, seconds: at most 2,400 per hour.
        LEAST_HEADWAY_S: f64 = 1.5;
        /// Length of a car and a margin, metres: in slow traffic the length limits the flow, not the time.
        CAR_M: f64 = 5.5;
        /// Range of the speeds of free drivers, as shares of the speed of free traffic.
        SHARES: (f64, f64) = (0.96, 1.04);
        /// Step by which an agent without room is tried farther back, metres.
        BACK_M: f64 = 1.5;
        /// Longest wait outside of an agent that enters later and has no room, seconds.
        WAIT_S: f64 = 6.0;
        /// Gap that an entering agent needs to the one ahead, metres.
        ENTRY_GAP_M: f64 = 3.0;
        /// Place of a vehicle that enters inside the map, along its path, metres.
        ENTRY_M: f64 = 0.05;
        /// Margin around the box of an entering vehicle, metres.
        ENTRY_SIDE_M: f64 = 0.1;
        /// Speed by which the length of a followed path is computed, m/s.
        REACH_MPS: f64 = 40.0;
        /// Time by which it is computed, at most, seconds.
        REACH_S: f64 = 60.0;
        /// Additional length, metres.
        REACH_M: f64 = 50.0;
    }
    /// Of `placement::assign`.
    assign {
        /// Margin beyond a crosswalk's half width within which a road user is on it, metres.
        CROSSWALK_M: f64 = 0.5;
        /// Greatest distance from a road edge that counts as its pavement, metres.
        PAVEMENT_M: f64 = 7.0;
        /// Greatest distance of a parked vehicle's centre from the lane beside it, metres.
        PARKED_M: f64 = 12.0;
        /// Recorded extent below which a vehicle off the lanes is parked, metres.
        PARKED_EXTENT_M: f64 = 1.0;
        /// Radius of the search for an agent's lane, metres.
        LANE_REACH_M: f64 = 4.0;
        /// Distance beyond a lane's border within which a rider is on it, metres.
        BESIDE_RIDING_M: f64 = 0.8;
        /// Distance beyond a lane's border within which a vehicle's middle is on it, metres.
        BESIDE_DRIVING_M: f64 = 0.2;
        /// Metres to which a radian of turn from a lane is equivalent.
        RADIAN_M: f64 = 3.0;
    }
    /// Of `placement::checks`.
    checks {
        /// Margin around every box, metres.
        MARGIN_M: f64 = 0.1;
        /// Lateral margin between two drivers, metres: lanes keep them farther apart than doors need.
        SIDE_M: f64 = 0.4;
        /// Margin between crossing drivers, metres: slightly more than the gap of a near miss.
        CROSSING_M: f64 = 1.2;
        /// Greatest distance of a corner of a vehicle on a lane past the road's edge, metres.
        PAST_EDGE_M: f64 = 0.05;
        /// Smallest distance of a vehicle before the end of a lane that leaves the map, metres: it should be
        /// visible for a while.
        END_M: f64 = 8.0;
        /// Length above which a vehicle stands on a lane only if front and rear are on a lane too, metres.
        LONG_M: f64 = 6.0;
        /// Greatest turn of front and rear of a long vehicle from their lane, radians.
        LONG_TURN_RAD: f64 = 0.5;
        /// Length of the zone in front of a driver without pedestrians, metres.
        BEFORE_M: f64 = 3.0;
        /// Width of the zone beside a driver without pedestrians, metres.
        WALK_SIDE_M: f64 = 1.0;
        /// Distance to a lane below which a pedestrian on a pavement does not head for it, metres.
        WALK_AHEAD_M: f64 = 4.0;
        /// Share of a lane's half width that is free of parked and standing agents.
        BAND: f64 = 0.9;
        /// Radius of the search for lanes, metres.
        LANE_REACH_M: f64 = 4.0;
    }
    /// Of `placement::driving`.
    driving {
        /// Distance ahead in which bends are braked for, metres.
        BEND_LOOK_M: f64 = 20.0;
        /// Distance ahead within which a leader matters, metres.
        LEADER_LOOK_M: f64 = 45.0;
        /// Lateral acceleration in bends and braking ahead of them, m/s2 (the value that routes use).
        BEND_MPS2: f64 = 2.2;
        /// Highest expected speed of a cyclist, m/s.
        CYCLIST_MPS: f64 = 7.0;
        /// Length over which a bend is measured, metres.
        BEND_OVER_M: f64 = 6.0;
        /// Usual speed of cyclists off the lanes, m/s.
        RIDING_MPS: f64 = 4.0;
        /// Usual speed of walkers, m/s.
        WALKING_MPS: f64 = 2.0;
        /// Additional radius beyond which boxes are ignored, metres.
        BOX_REACH_M: f64 = 15.0;
        /// Additional length of the path ahead, metres.
        BEYOND_LOOK_M: f64 = 10.0;
    }
    /// Of `placement::following`.
    following {
        /// Gap to a standing leader, metres.
        STANDING_GAP_M: f64 = 2.0;
        /// Time headway of followers, seconds.
        HEADWAY_S: f64 = 1.2;
        /// Acceleration, m/s2.
        SPEEDING_UP_MPS2: f64 = 1.5;
        /// Comfortable braking, m/s2.
        BRAKING_MPS2: f64 = 2.0;
        /// Hardest braking, m/s2.
        HARDEST_MPS2: f64 = 5.0;
        /// Distance from the path beyond which an agent's centre is no obstacle, metres.
        BESIDE_M: f64 = 1.8;
        /// Greatest distance of a leader, metres.
        LOOK_M: f64 = 80.0;
        /// Distance beyond a red line at which it counts as a standing leader, metres.
        RED_GAP_M: f64 = 1.5;
        /// Distance behind a driver from which an agent is no leader, metres.
        BEHIND_M: f64 = 10.0;
    }
    /// Of `placement::parking`.
    parking {
        /// Length of a parking place at the kerb, metres: a car and room to leave.
        PLACE_M: f64 = 6.0;
        /// Longest vehicle in a place, metres.
        LONGEST_M: f64 = 5.3;
        /// Widest vehicle in a place, metres.
        WIDEST_M: f64 = 2.1;
        /// Longest parking lane that is a single bay, metres.
        BAY_M: f64 = 7.5;
        /// Range of room beside a lane in which cars park along the kerb, metres. More is another road or a
        /// square.
        ROOM_M: (f64, f64) = (2.0, 6.0);
        /// Distance from the kerb to the car, and its variation, metres.
        KERB_M: (f64, f64) = (0.15, 0.2);
        /// Deviation of parked cars from the kerb's direction, radians.
        ASKEW_RAD: f64 = 0.02;
        /// Smallest distance of parked cars from a junction, a stop line or a crosswalk, metres.
        CLEAR_M: f64 = 5.0;
        /// A driveway within this distance of a lane opens to it and stays free of parked cars, metres.
        DRIVEWAY_M: f64 = 14.0;
        /// Margin at its sides, metres.
        DRIVEWAY_SIDE_M: f64 = 1.0;
        /// Radius beyond which driveways do not affect a place, metres.
        NEAR_M: f64 = 30.0;
        /// Speed limit above which roads have no parked cars, m/s.
        FAST_MPS: f64 = 14.0;
        /// Share of the cars in bays that are parked nose in.
        NOSE_IN: f64 = 0.7;
        /// Length and width of a parked car if no drawn one fits, metres.
        CAR_M: (f64, f64) = (4.4, 1.8);
        /// Margin of a place at both ends together, metres.
        END_ROOM_M: f64 = 0.6;
        /// Margin of a place at both sides together, metres.
        SIDE_ROOM_M: f64 = 0.2;
        /// Distance from the kerb to the middle of a parked car, metres.
        MIDDLE_M: f64 = 1.1;
        /// Radius of the search for parking lanes, metres.
        LANE_REACH_M: f64 = 4.0;
    }
    /// Of `placement::pose`.
    pose {
        /// Smallest distance of a driver's box to its lane's border, metres.
        LANE_SIDE_M: f64 = 0.3;
        /// Distance that a driver stays in its lane if it goes straight on, metres.
        STRAIGHT_M: f64 = 6.0;
        /// Margin between a driveway's end and a car's, metres.
        DRIVEWAY_END_M: f64 = 0.3;
        /// In strips narrower than this parked vehicles keep to the kerb, in wider ones to the lane, metres.
        NARROW_KERB_M: f64 = 3.5;
        /// Length of a vehicle of unknown length, metres.
        USUAL_M: f64 = 4.7;
        /// Shorter vehicles are motorcycles, metres.
        MOTORCYCLE_M: f64 = 3.0;
        /// Longer vehicles are trucks, metres.
        TRUCK_M: f64 = 6.5;
        /// Longer vehicles are buses, metres.
        BUS_M: f64 = 10.0;
        /// Radius of the search for the lane that a driveway opens to, metres.
        DRIVEWAY_REACH_M: f64 = 40.0;
        /// Half width of an unknown lane, metres.
        HALF_LANE_M: f64 = 1.75;
        /// Share of a sidewalk's half width that walkers use.
        SIDEWALK_SHARE: f64 = 0.7;
        /// Distance of walkers on a pavement from the kerb, without learned offsets, metres.
        PAVEMENT_M: f64 = 1.5;
        /// Offsets on lanes: lower bound and width of a class, metres, and number of classes.
        LANE_OFFSETS: (f64, f64, usize) = (-2.0, 0.1, 60);
        /// Offsets at kerbs, metres.
        KERB_OFFSETS: (f64, f64, usize) = (-1.0, 0.2, 40);
        /// Offsets on crosswalks, in half widths.
        CROSSWALK_OFFSETS: (f64, f64, usize) = (-1.0, 0.1, 20);
        /// Offsets on pavements and driveways, metres.
        PAVEMENT_OFFSETS: (f64, f64, usize) = (-2.0, 0.25, 40);
        /// Turns from a lane: lower bound and width of a class, radians, and number of classes.
        LANE_TURNS: (f64, f64, usize) = (-20f64.to_radians(), 1f64.to_radians(), 40);
        /// Turns off the lanes, radians.
        OTHER_TURNS: (f64, f64, usize) = (-PI, PI / 36.0, 72);
    }
    /// Of `placement::room`.
    room {
        /// Reaction time before braking, seconds.
        REACTION_S: f64 = 0.8;
        /// Gap to a road user ahead, metres.
        STANDING_GAP_M: f64 = 2.0;
        /// Gap to the path of another, metres.
        BEFORE_M: f64 = 1.0;
        /// Time between two at the crossing of their paths, unless one can stop, seconds.
        APART_S: f64 = 2.0;
        /// Margin beside a driver on its path, metres.
        SIDE_M: f64 = 0.2;
        /// Cosine above which headings lead in the same direction.
        SAME_WAY: f64 = 0.85;
        /// Distance below which paths in the same or opposite direction conflict, metres.
        SAME_LINE_M: f64 = 1.5;
        /// Time ahead of a walker for which drivers stop, seconds.
        WALK_AHEAD_S: f64 = 3.0;
        /// Margin around a walker, metres.
        WALK_SIDE_M: f64 = 0.6;
        /// Longest look-ahead, metres.
        LONGEST_M: f64 = 200.0;
    }
    /// Of `placement::speeds`.
    speeds {
        /// An agent stands on a free road only if a road user is within this distance ahead, metres.
        QUEUE_M: f64 = 15.0;
        /// Assumed speed of a leader whose speed is not drawn yet, m/s: only that it moves matters.
        UNKNOWN_LEADER_MPS: f64 = 5.0;
        /// Highest speed of cyclists without learned speeds, m/s.
        CYCLIST_MPS: f64 = 5.0;
        /// Speed off the lanes without learned speeds, as a share of the usual one.
        OFF_LANES: f64 = 0.7;
    }
    /// Of `placement::stop_lines`.
    stop_lines {
        /// Distance that drivers look ahead, metres.
        LOOK_M: f64 = 80.0;
        /// Distance behind within which a stop line still counts as ahead, metres.
        PASSED_M: f64 = 0.5;
        /// Distance of a driver to the stop line of a red signal, metres.
        STOP_LINE_M: f64 = 0.3;
        /// Upper bounds of the distance classes, metres.
        NEAR_M: [f64; 6] = [4.0, 10.0, 18.0, 30.0, 50.0, LOOK_M];
        /// Upper bounds of the distance classes before a stop sign or an unsignalled junction, metres; the
        /// class names contain them.
        YIELD_WITHIN_M: [f64; 2] = [12.0, 30.0];
        /// Upper bound of the class before a signal that is not red, metres.
        GO_WITHIN_M: f64 = 30.0;
        /// Upper bounds of the classes before a red signal, metres.
        RED_WITHIN_M: [f64; 3] = [10.0, 25.0, 50.0];
        /// Distances within which traffic queues before a red signal, and before a stop sign or an
        /// unsignalled junction, metres.
        QUEUES_M: (f64, f64) = (50.0, 18.0);
    }
    /// Of `placement::cells`.
    cells {
        /// Greatest distance from a lane to the kerb, metres.
        KERB_LOOK_M: f64 = 12.0;
        /// Distance to the nearest lane beyond which a road edge has no pavement, metres.
        EDGE_REACH_M: f64 = 15.0;
        /// A search to the side that ends on another lane's band finds no kerb, metres beyond the own border.
        NEXT_LANE_M: f64 = 1.2;
        /// Upper bounds of the classes of distance to the leader, centre to centre, metres.
        LEADER_M: [f64; 7] = [7.0, 10.0, 14.0, 20.0, 30.0, 40.0, f64::INFINITY];
        /// Greatest distance of a leader, metres.
        LEADER_REACH_M: f64 = 40.0;
        /// Radius of the search for the driveway of a point, metres.
        DRIVEWAY_REACH_M: f64 = 40.0;
        /// Bounds of the classes of speed limits, m/s.
        LIMITS_MPS: [f64; 6] = [6.5, 10.0, 12.5, 15.0, 19.0, 26.0];
        /// Speed limit of a pavement without a lane, m/s.
        UNKNOWN_LIMIT_MPS: f64 = 13.4;
        /// Length over which a bend is measured, metres.
        BEND_OVER_M: f64 = 6.0;
        /// Bounds of the classes of bends, 1/m.
        BENDS_PER_M: [f64; 4] = [0.005, 0.02, 0.06, 0.12];
        /// Bounds of the classes of room at the kerb, metres.
        KERB_ROOM_M: [f64; 6] = [0.5, 1.5, 2.5, 3.5, 5.0, 8.0];
        /// Bounds of the classes of distance from a kerb to a stop line ahead, metres.
        STOPS_M: [f64; 3] = [10.0, 20.0, 40.0];
        /// Radius of the search for lanes, metres.
        LANE_REACH_M: f64 = 4.0;
        /// Share of a crosswalk's length at each end that counts as its end.
        NEAR_END: f64 = 0.25;
        /// Radius of the search for crosswalks from a pavement, metres.
        CROSSWALK_REACH_M: f64 = 30.0;
        /// Bounds of the classes of distance from a pavement to a crosswalk, metres.
        CROSSWALKS_M: [f64; 3] = [4.0, 12.0, 30.0];
        /// Bounds of the classes of distance from a pavement to a lane, metres.
        LANES_M: [f64; 4] = [2.5, 4.0, 6.0, 9.0];
    }
    /// Of `placement::context`.
    context {
        /// Upper bounds of the classes of the gap to the leader, metres; the class names contain them.
        LEADER_WITHIN_M: [f64; 5] = [4.0, 8.0, 15.0, 25.0, 40.0];
        /// Speeds below which a leader stands, and above which it is fast, m/s.
        PACES_MPS: (f64, f64) = (0.5, 5.0);
    }
    /// Of `placement::request`.
    request {
        /// Default density, road users per kilometre of lane.
        PER_LANE_KM: f64 = 12.0;
        /// Default shares of the types.
        TYPES: [(AgentType, f64); 3] =
            [(AgentType::Vehicle, 0.8), (AgentType::Pedestrian, 0.15), (AgentType::Cyclist, 0.05)];
    }
}
