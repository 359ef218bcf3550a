//! Numbers of placement that are set and not learned.
//!
//! All were set by hand between 2026-11-21 and 2026-11-26; what was counted on recorded scenes is a table beside the
//! weights. No generated future depends on them, so they are no part of [`Tuning::hash`](super::Tuning::hash).

use scene::AgentType;
use std::f64::consts::PI;

numbers! {
    /// Of `placement::arms`.
    arms {
        /// Lanes whose headings differ by more belong to different roads, radians.
        SAME_ROAD_RAD: f64 = 0.6;
        /// As before, for their distance across and along the road, metres.
        SAME_ROAD_M: (f64, f64) = (10.0, 30.0);
        /// A lane that opens beside another has that one beside it so far behind its beginning, metres.
        BEHIND_M: f64 = 4.0;
        /// Lanes of one road that the map's edge cuts may begin so far apart, metres.
        RAGGED_M: f64 = 15.0;
        /// A shorter lane is no way in, metres.
        SHORTEST_M: f64 = 5.0;
        /// Greatest length over which an arm is followed, metres.
        LONGEST_M: f64 = 3_000.0;
        /// Free traffic drives at this share of what limit and bends allow.
        FREE_SHARE: f64 = 0.95;
        /// The lane beside an opening one is looked up within this, metres.
        BESIDE_REACH_M: f64 = 8.0;
    }
    /// Of `placement::arrivals`.
    arrivals {
        /// Least time between two vehicles of a lane, seconds: 2,400 an hour at most.
        LEAST_HEADWAY_S: f64 = 1.5;
        /// A car and a little, metres: where free traffic is slow the length counts, not the time.
        CAR_M: f64 = 5.5;
        /// Range of speeds of free drivers, as shares of the speed of free traffic.
        SHARES: (f64, f64) = (0.96, 1.04);
        /// An agent without room is tried farther back by this, metres.
        BACK_M: f64 = 1.5;
        /// An agent that enters later waits outside until there is room, at most so long, seconds.
        WAIT_S: f64 = 6.0;
        /// Room to the agent ahead that an entering one needs, metres.
        ENTRY_GAP_M: f64 = 3.0;
        /// A vehicle that enters inside the map begins so far along its way, metres.
        ENTRY_M: f64 = 0.05;
        /// Room about the box of an entering vehicle, metres.
        ENTRY_SIDE_M: f64 = 0.1;
        /// A way is followed as far as this speed leads, m/s.
        REACH_MPS: f64 = 40.0;
        /// For at most so long, seconds.
        REACH_S: f64 = 60.0;
        /// And so much farther, metres.
        REACH_M: f64 = 50.0;
    }
    /// Of `placement::assign`.
    assign {
        /// A road user farther from a crosswalk's middle line than its half width and this is not on it, metres.
        CROSSWALK_M: f64 = 0.5;
        /// Farthest from a road edge that still counts as its pavement, metres.
        PAVEMENT_M: f64 = 7.0;
        /// Farthest centre of a parked vehicle from the lane it stands beside, metres.
        PARKED_M: f64 = 12.0;
        /// A vehicle that moves less than this in the recording is parked when it stands off the lanes, metres.
        PARKED_EXTENT_M: f64 = 1.0;
        /// The lane that an agent drives on is looked up within this, metres.
        LANE_REACH_M: f64 = 4.0;
        /// A rider so far beyond a lane's border is still on it, metres.
        BESIDE_RIDING_M: f64 = 0.8;
        /// The same of a vehicle's middle, metres.
        BESIDE_DRIVING_M: f64 = 0.2;
        /// Metres that a radian of turn from a lane counts as.
        RADIAN_M: f64 = 3.0;
    }
    /// Of `placement::checks`.
    checks {
        /// Room around every box, metres.
        MARGIN_M: f64 = 0.1;
        /// The same to the side between two that drive, metres: lanes keep them farther apart than doors need.
        SIDE_M: f64 = 0.4;
        /// The same about a driver that another one crosses, metres: a little more than the gap of a near miss.
        CROSSING_M: f64 = 1.2;
        /// A corner of a vehicle on a lane is at most so far past the edge of the road, metres.
        PAST_EDGE_M: f64 = 0.05;
        /// A vehicle is at least so far before the end of a lane that leaves the map, metres: it must be seen for a while.
        END_M: f64 = 8.0;
        /// Vehicles longer than this stand straight on their lane only where nose and tail are on a lane too, metres.
        LONG_M: f64 = 6.0;
        /// Nose and tail of a long vehicle turn from their lane by this at most, radians.
        LONG_TURN_RAD: f64 = 0.5;
        /// Nobody is on foot so far before a driver's nose, metres.
        BEFORE_M: f64 = 3.0;
        /// The same beside a driver, metres.
        WALK_SIDE_M: f64 = 1.0;
        /// Nobody on a pavement heads for a lane that is nearer than this, metres.
        WALK_AHEAD_M: f64 = 4.0;
        /// Share of a lane's half width that stays free of parked and standing agents.
        BAND: f64 = 0.9;
        /// Lanes are looked up so far from a point, metres.
        LANE_REACH_M: f64 = 4.0;
    }
    /// Of `placement::driving`.
    driving {
        /// How far ahead bends are braked for, metres.
        BEND_LOOK_M: f64 = 20.0;
        /// How far ahead a leader matters, metres.
        LEADER_LOOK_M: f64 = 45.0;
        /// Sideways acceleration in bends and braking ahead of them, m/s2 (the figure that routes use).
        BEND_MPS2: f64 = 2.2;
        /// Greatest speed that is expected of a cyclist, m/s.
        CYCLIST_MPS: f64 = 7.0;
        /// A bend is measured over this length, metres.
        BEND_OVER_M: f64 = 6.0;
        /// Speed that is usual of cyclists off the lanes, m/s.
        RIDING_MPS: f64 = 4.0;
        /// The same of walkers, m/s.
        WALKING_MPS: f64 = 2.0;
        /// Boxes whose middles are this much farther than a leader matters are left out, metres.
        BOX_REACH_M: f64 = 15.0;
        /// The way ahead is followed so much farther than a leader matters, metres.
        BEYOND_LOOK_M: f64 = 10.0;
    }
    /// Of `placement::following`.
    following {
        /// Room to a standing leader, metres.
        STANDING_GAP_M: f64 = 2.0;
        /// Headway that followers keep, seconds.
        HEADWAY_S: f64 = 1.2;
        /// Speeding up, m/s2.
        SPEEDING_UP_MPS2: f64 = 1.5;
        /// Comfortable braking, m/s2.
        BRAKING_MPS2: f64 = 2.0;
        /// Hardest braking, m/s2.
        HARDEST_MPS2: f64 = 5.0;
        /// An agent whose centre lies farther from the own path is not an obstacle, metres.
        BESIDE_M: f64 = 1.8;
        /// Greatest distance of a leader, metres.
        LOOK_M: f64 = 80.0;
        /// A red line counts as a leader that stands so far beyond it, metres.
        RED_GAP_M: f64 = 1.5;
        /// An agent so far behind a driver is no leader, metres.
        BEHIND_M: f64 = 10.0;
    }
    /// Of `placement::parking`.
    parking {
        /// Length of a place at the kerb, metres: a car and room to leave.
        PLACE_M: f64 = 6.0;
        /// The longest vehicle that parks in one, metres.
        LONGEST_M: f64 = 5.3;
        /// The widest vehicle that parks in one, metres.
        WIDEST_M: f64 = 2.1;
        /// A parking lane up to this length is one bay, metres.
        BAY_M: f64 = 7.5;
        /// Room beside a lane in which cars park along the kerb, metres. More is another road or a square.
        ROOM_M: (f64, f64) = (2.0, 6.0);
        /// From the kerb to the car, and how much that varies, metres.
        KERB_M: (f64, f64) = (0.15, 0.2);
        /// Cars are not quite parallel to the kerb, radians.
        ASKEW_RAD: f64 = 0.02;
        /// Least distance of parked cars from a junction, a stop line or a crosswalk, metres.
        CLEAR_M: f64 = 5.0;
        /// A driveway within this of a lane opens to it and stays free of parked cars, metres.
        DRIVEWAY_M: f64 = 14.0;
        /// The same to its sides, metres.
        DRIVEWAY_SIDE_M: f64 = 1.0;
        /// Driveways farther away have nothing to do with a place, metres.
        NEAR_M: f64 = 30.0;
        /// Faster roads have no parked cars along them, m/s.
        FAST_MPS: f64 = 14.0;
        /// Share of the cars in bays that stand with the nose in.
        NOSE_IN: f64 = 0.7;
        /// Length and width of a parked car where none that was drawn fits, metres.
        CAR_M: (f64, f64) = (4.4, 1.8);
        /// Room that a place leaves at both ends together, metres.
        END_ROOM_M: f64 = 0.6;
        /// Room that a place leaves at both sides together, metres.
        SIDE_ROOM_M: f64 = 0.2;
        /// From the kerb to the middle of a parked car, metres.
        MIDDLE_M: f64 = 1.1;
        /// Parking lanes are looked up so far from a place, metres.
        LANE_REACH_M: f64 = 4.0;
    }
    /// Of `placement::pose`.
    pose {
        /// From a driver's box to its lane's border, metres.
        LANE_SIDE_M: f64 = 0.3;
        /// Straight on for this, a driver stays in its lane, metres.
        STRAIGHT_M: f64 = 6.0;
        /// Room between a driveway's end and a car's, metres.
        DRIVEWAY_END_M: f64 = 0.3;
        /// In a strip narrower than this parked vehicles keep to the kerb, in a wider one to the lane, metres.
        NARROW_KERB_M: f64 = 3.5;
        /// A vehicle of unknown length has this one, metres.
        USUAL_M: f64 = 4.7;
        /// A shorter vehicle is a motorcycle, metres.
        MOTORCYCLE_M: f64 = 3.0;
        /// A longer vehicle is a truck, metres.
        TRUCK_M: f64 = 6.5;
        /// A longer vehicle is a bus, metres.
        BUS_M: f64 = 10.0;
        /// The lane that a driveway opens to is looked up within this, metres.
        DRIVEWAY_REACH_M: f64 = 40.0;
        /// Half the width of a lane that is not known, metres.
        HALF_LANE_M: f64 = 1.75;
        /// Walkers keep to this share of a sidewalk's half width.
        SIDEWALK_SHARE: f64 = 0.7;
        /// Walkers on a pavement start so far from the kerb without learned offsets, metres.
        PAVEMENT_M: f64 = 1.5;
        /// Offsets on lanes: lower bound and width of a class, metres, and number of classes.
        LANE_OFFSETS: (f64, f64, usize) = (-2.0, 0.1, 60);
        /// The same at kerbs, metres.
        KERB_OFFSETS: (f64, f64, usize) = (-1.0, 0.2, 40);
        /// The same on crosswalks, in half widths.
        CROSSWALK_OFFSETS: (f64, f64, usize) = (-1.0, 0.1, 20);
        /// The same on pavements and driveways, metres.
        PAVEMENT_OFFSETS: (f64, f64, usize) = (-2.0, 0.25, 40);
        /// Turns from a lane: lower bound and width of a class, radians, and number of classes.
        LANE_TURNS: (f64, f64, usize) = (-20f64.to_radians(), 1f64.to_radians(), 40);
        /// The same off the lanes, radians.
        OTHER_TURNS: (f64, f64, usize) = (-PI, PI / 36.0, 72);
    }
    /// Of `placement::room`.
    room {
        /// Braking begins so long after the start, seconds.
        REACTION_S: f64 = 0.8;
        /// Room that stays to a road user ahead, metres.
        STANDING_GAP_M: f64 = 2.0;
        /// Room that stays to the way of another, metres.
        BEFORE_M: f64 = 1.0;
        /// Two pass the place where their ways cross one so long after the other, unless one can stop, seconds.
        APART_S: f64 = 2.0;
        /// Room beside a driver on its way, metres.
        SIDE_M: f64 = 0.2;
        /// Headings that differ by less (cosine) lead the same way.
        SAME_WAY: f64 = 0.85;
        /// Middles of ways that lead the same way or against each other conflict when nearer than this, metres.
        SAME_LINE_M: f64 = 1.5;
        /// Drivers stop for where a walker is so soon, seconds.
        WALK_AHEAD_S: f64 = 3.0;
        /// Room about a walker, metres.
        WALK_SIDE_M: f64 = 0.6;
        /// Nobody looks farther ahead, metres.
        LONGEST_M: f64 = 200.0;
    }
    /// Of `placement::speeds`.
    speeds {
        /// Nobody stands on a free road: not without a road user so near ahead, metres.
        QUEUE_M: f64 = 15.0;
        /// Until it is drawn, a leader on a lane is taken to drive so fast, m/s: only that it moves matters.
        UNKNOWN_LEADER_MPS: f64 = 5.0;
        /// Greatest speed of cyclists without learned speeds, m/s.
        CYCLIST_MPS: f64 = 5.0;
        /// Speed off the lanes without learned speeds: share of the usual one.
        OFF_LANES: f64 = 0.7;
    }
    /// Of `placement::stop_lines`.
    stop_lines {
        /// How far drivers look, metres.
        LOOK_M: f64 = 80.0;
        /// A stop line so little behind still counts as ahead, metres.
        PASSED_M: f64 = 0.5;
        /// Room that a driver keeps to a red light's stop line, metres.
        STOP_LINE_M: f64 = 0.3;
        /// Upper bounds of the distance classes, metres.
        NEAR_M: [f64; 6] = [4.0, 10.0, 18.0, 30.0, 50.0, LOOK_M];
        /// Upper bounds of the speed classes before a stop sign or an unsignalled junction, metres; their names say them.
        YIELD_WITHIN_M: [f64; 2] = [12.0, 30.0];
        /// The same before a light that is not red, metres.
        GO_WITHIN_M: f64 = 30.0;
        /// The same before a red light, metres.
        RED_WITHIN_M: [f64; 3] = [10.0, 25.0, 50.0];
        /// Traffic queues so near before a red light, and before a stop sign or an unsignalled junction, metres.
        QUEUES_M: (f64, f64) = (50.0, 18.0);
    }
    /// Of `placement::cells`.
    cells {
        /// Longest look from a lane to the kerb, metres.
        KERB_LOOK_M: f64 = 12.0;
        /// A road edge farther from any lane borders nothing that people walk along, metres.
        EDGE_REACH_M: f64 = 15.0;
        /// A look to the side that ends on another lane's band meets no kerb, metres beyond the own border.
        NEXT_LANE_M: f64 = 1.2;
        /// Upper bounds of the classes of distance to the leader, centre to centre, metres.
        LEADER_M: [f64; 7] = [7.0, 10.0, 14.0, 20.0, 30.0, 40.0, f64::INFINITY];
        /// Farthest leader that counts, metres.
        LEADER_REACH_M: f64 = 40.0;
        /// A driveway that holds a point has its middle within this of it, metres.
        DRIVEWAY_REACH_M: f64 = 40.0;
        /// Bounds of the classes of speed limits, m/s.
        LIMITS_MPS: [f64; 6] = [6.5, 10.0, 12.5, 15.0, 19.0, 26.0];
        /// Speed limit of a pavement without a lane, m/s.
        UNKNOWN_LIMIT_MPS: f64 = 13.4;
        /// A bend is measured over this length, metres.
        BEND_OVER_M: f64 = 6.0;
        /// Bounds of the classes of bends, 1/m.
        BENDS_PER_M: [f64; 4] = [0.005, 0.02, 0.06, 0.12];
        /// Bounds of the classes of room at the kerb, metres.
        KERB_ROOM_M: [f64; 6] = [0.5, 1.5, 2.5, 3.5, 5.0, 8.0];
        /// Bounds of the classes of distance from a kerb to a stop line ahead, metres.
        STOPS_M: [f64; 3] = [10.0, 20.0, 40.0];
        /// Lanes are looked up so far from a point, metres.
        LANE_REACH_M: f64 = 4.0;
        /// Share of a crosswalk's length at each end that counts as its end.
        NEAR_END: f64 = 0.25;
        /// Crosswalks are looked up so far from a pavement, metres.
        CROSSWALK_REACH_M: f64 = 30.0;
        /// Bounds of the classes of distance from a pavement to a crosswalk, metres.
        CROSSWALKS_M: [f64; 3] = [4.0, 12.0, 30.0];
        /// Bounds of the classes of distance from a pavement to a lane, metres.
        LANES_M: [f64; 4] = [2.5, 4.0, 6.0, 9.0];
    }
    /// Of `placement::context`.
    context {
        /// Upper bounds of the classes of room to the leader, metres; the names of the classes say them.
        LEADER_WITHIN_M: [f64; 5] = [4.0, 8.0, 15.0, 25.0, 40.0];
        /// A slower leader stands, and a faster one is fast, m/s.
        PACES_MPS: (f64, f64) = (0.5, 5.0);
    }
    /// Of `placement::request`.
    request {
        /// Density of a request that says none, road users a kilometre of lane.
        PER_LANE_KM: f64 = 12.0;
        /// Shares of the types in such a request.
        TYPES: [(AgentType, f64); 3] =
            [(AgentType::Vehicle, 0.8), (AgentType::Pedestrian, 0.15), (AgentType::Cyclist, 0.05)];
    }
}
