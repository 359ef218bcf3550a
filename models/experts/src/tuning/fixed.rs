//! Constants of planning and generation that are neither learned nor varied by a call: thresholds, margins,
//! paces.
//!
//! All were set by hand between 2026-11-21 and 2026-11-26, on recorded and hand-made scenes that failed
//! without them. They are part of [`Tuning::hash`](super::Tuning::hash).

use scene::routes::SpeedRules;
use scene::score::CLOSE_M;

numbers! {
    /// Of actors.
    actor {
        /// A vehicle farther from its lane's middle than this is beside the lane, metres.
        BESIDE_LANE_M: f64 = 1.4;
    }
    /// Of first drafts.
    drafting {
        /// Probability of standing still above which an agent stays.
        STAYS_ABOVE: f64 = 0.5;
    }
    /// Of the joint choice.
    choice {
        /// Number of compared moments from which a near miss costs its full price.
        MOST_MOMENTS: f64 = 2.0;
        /// Lower bound of an option's mean distance to modes, metres.
        LEAST_SPREAD_M: f64 = 0.3;
        /// Steps after its entry within which a road user must not meet another; otherwise it does not enter.
        COMES_IN_STEPS: usize = 5;
    }
    /// Of the future that the user saw last. Larger faults than these are a reason to show another future; a
    /// goal that moves by 5 cm changes smaller ones.
    shown_last {
        /// Distance past the road's edge, metres.
        PAST_EDGE_M: f64 = 0.4;
        /// Distance against the traffic, metres.
        WRONG_WAY_M: f64 = 5.5;
        /// Braking and lateral acceleration, m/s2.
        HARSH_MPS2: f64 = 4.5;
        /// Braking forced on another, m/s2.
        FORCED_MPS2: f64 = 3.5;
        /// Deviation from the lane's direction, radians.
        ASKEW_RAD: f64 = 0.35;
    }
    /// Of swerving around obstacles and stopping before them.
    replan {
        /// Metres that a vehicle moves aside per metre of path.
        SLOPE: f64 = 0.35;
        /// Tolerance with which a motion follows the places that it is made from, metres.
        SPARE_M: f64 = 0.2;
        /// Margin to the sides of an agent that stops, metres.
        ROOM_M: f64 = 0.3;
        /// Margin before an obstacle at which an agent stops, metres: ten knots cannot follow every halt.
        SHORT_M: f64 = 1.0;
        /// Margin of a walker that stops, ahead and to the side, metres.
        WALKER_ROOM_M: (f64, f64) = (0.4, 0.1);
        /// Shorter paths are not shifted, metres.
        LEAST_WAY_M: f64 = 2.0;
        /// Braking rates tried before an obstacle, as shares of the hardest.
        BRAKES: [f64; 3] = [0.3, 0.55, 0.9];
        /// Harder braking must lead at least this much farther, metres.
        HARDER_M: f64 = 2.0;
        /// Greatest distance short of the goal at which a motion has arrived, metres.
        THERE_M: f64 = 0.1;
    }
    /// Of agents at rest that move off.
    moving_off {
        /// Distance to a red line within which an agent waits there, metres.
        AT_LINE_M: f64 = 5.0;
        /// Distance to a standing agent ahead within which an agent is in its queue, metres.
        IN_QUEUE_M: f64 = 8.0;
        /// Speed below which an agent does not roll, m/s. Recorded vehicles that stay have a speed of exactly
        /// zero.
        ROLLS_MPS: f64 = 1e-4;
    }
    /// Of warnings.
    report {
        /// Distance to the nearest lane beyond which a start or goal is off the road, metres.
        OFF_ROAD_M: f64 = 6.0;
        /// A goal farther than the top speed leads, times this, is out of reach.
        BEYOND_REACH: f64 = 1.1;
        /// Intersection over union above which two boxes overlap at the start.
        OVERLAP_IOU: f64 = 0.02;
    }
    /// Of rounds with feedback.
    rounds {
        /// Least diversity of a round's draw, so that a person sees the range of futures.
        ROUND_DIVERSITY: f64 = 1.5;
    }
    /// Of variations of a draft.
    variations {
        /// Time gaps to another agent at shared ground, in the order of trying, seconds.
        GAPS_S: [f64; 3] = [0.9, 0.5, 0.2];
        /// Usual share of the speed caps of a path.
        HURRY: f64 = 1.1;
        /// Distance by which a waiting walker may lean over the kerb, metres.
        OVER_KERB_M: f64 = 0.4;
        /// Distance kept from shared ground, metres.
        CLEAR_M: f64 = 0.4;
        /// Speed cap of walkers, m/s.
        WALKING_MPS: f64 = 2.2;
        /// Tolerance by which a motion may exceed usual rates, m/s2.
        SPARE_MPS2: f64 = 0.1;
        /// Tolerance by which it may exceed the cap, m/s.
        SPARE_MPS: f64 = 0.3;
        /// Factors of braking and of acceleration for an agent that goes first or lets another pass.
        BRISK: (f64, f64) = (1.15, 1.4);
        /// Earliest change of progress, seconds.
        SOONEST_S: f64 = 0.8;
        /// Usual braking and acceleration on foot, m/s2.
        ON_FOOT_MPS2: (f64, f64) = (1.3, 1.3);
        /// Usual braking and acceleration on a bicycle, m/s2.
        RIDING_MPS2: (f64, f64) = (2.5, 1.5);
        /// Usual braking and acceleration of a vehicle, m/s2.
        DRIVING_MPS2: (f64, f64) = (3.4, 2.4);
        /// Time around the goal's time in which progress is not changed, seconds.
        NEAR_GOAL_S: f64 = 0.4;
        /// Changes of progress tried on foot with a goal, and lateral offset, metres.
        ON_FOOT_TO_GOAL_M: (&[f64], f64) = (&[1.3, 2.2, 0.8], 1.1);
        /// Changes of progress tried on foot without a goal, and lateral offset, metres.
        ON_FOOT_M: (&[f64], f64) = (&[3.0, 5.0, 2.0], 3.0);
        /// Changes of progress tried on a bicycle with a goal, and lateral offset, metres.
        RIDING_TO_GOAL_M: (&[f64], f64) = (&[1.3, 2.6, 4.5], 0.8);
        /// Changes of progress tried on a bicycle without a goal, and lateral offset, metres.
        RIDING_M: (&[f64], f64) = (&[6.0, 12.0, 3.5], 0.8);
        /// Changes of progress tried by a vehicle with a goal, and lateral offset, metres.
        DRIVING_TO_GOAL_M: (&[f64], f64) = (&[1.3, 2.6, 4.0, 6.0], 0.7);
        /// Changes of progress tried by a vehicle without a goal, and lateral offset, metres.
        DRIVING_M: (&[f64], f64) = (&[8.0, 14.0, 5.0, 22.0], 0.7);
        /// Time after a goal that leaves room for another pace, seconds.
        LEFT_S: f64 = 1.5;
        /// Changes of progress tried between a goal and the end of the window, metres.
        AFTER_GOAL_M: [f64; 3] = [-5.0, 5.0, -10.0];
    }
    /// Of motions through via points.
    via_steering {
        /// Share of a via point's tolerance that a motion may use before it is moved closer.
        SURE: f64 = 0.8;
        /// Share of the tolerance that it then keeps, so that futures stay apart.
        KEEPS: f64 = 0.5;
        /// Rate at which the allowed offset shrinks towards a via point, metres per metre of path.
        NARROWS: f64 = 0.15;
        /// Distance beyond the last via point at which an agent without a goal ends, metres.
        PAST_M: f64 = 1.0;
        /// Metres to which a missed goal is equivalent.
        GOAL_MISSED_M: f64 = 10.0;
    }
    /// Of walkers that step out before a vehicle.
    stepping_out {
        /// Speed below which vehicles let pedestrians cross, m/s.
        FAST_MPS: f64 = 4.0;
        /// Braking above which a walker counts as stepping out in front of a vehicle, m/s2.
        HARD_MPS2: f64 = 3.0;
        /// Time gap after a vehicle has passed, seconds.
        AFTER_S: f64 = 0.3;
    }
    /// Of the conversion of a draft to its motion.
    trajectory {
        /// Distance to a red line within which a front counts as over it, metres.
        AT_LINE_M: f64 = 0.25;
        /// Distance by which the next try stops farther from the line, metres.
        SHORT_OF_LINE_M: f64 = 1.2;
        /// Shares of an offset that are tried if the full offset leaves the road.
        OFFSET_SHARES: [f64; 4] = [0.8, 0.6, 0.4, 0.2];
        /// Largest change of a motion for ending along a lane, metres.
        ALONG_LANE_M: f64 = 1.5;
        /// Braking of a vehicle that rolls backwards without a goal there, m/s2.
        BACKING_BRAKE_MPS2: f64 = 1.5;
        /// Greatest distance to a goal behind that is reached in reverse, metres.
        BACKING_WAY_M: f64 = 30.0;
        /// Metres to which a radian of missed heading is equivalent.
        RADIAN_M: f64 = 5.0;
        /// Speed below which an agent stands, in the first window and in later ones, m/s.
        RESTING_MPS: (f64, f64) = (0.3, 0.05);
    }
    /// Of the place on the road that is offered instead of a goal off it.
    remedies {
        /// Acceleration of an unhurried driver, m/s2.
        SPEEDING_UP_MPS2: f64 = 1.5;
        /// Pace of an unhurried driver, m/s.
        PACE_MPS: f64 = 13.9;
        /// Lateral acceleration in bends, and braking ahead of them.
        BENDS: SpeedRules = SpeedRules { lateral_mps2: 3.0, brake_mps2: 2.2 };
        /// Hardest braking of a gentle stop, m/s2.
        STOPPING_MPS2: f64 = 3.0;
        /// Distance to the goal below which a place counts as the goal, metres.
        LEAST_MOVE_M: f64 = 1.0;
    }
    /// Of blocks along a path.
    blocks {
        /// Smallest distance between boxes, metres: slightly more than the choice's threshold of close.
        CLEAR_M: f64 = CLOSE_M + 0.05;
        /// Margin to agents that cross the path, metres: nearer is a near miss.
        CROSSING_M: f64 = 1.1;
        /// Speed above which that margin applies, m/s.
        CROSSING_MPS: f64 = 0.5;
        /// Time after the window for which others are considered, seconds.
        BEYOND_S: f64 = 2.0;
        /// A stop line belongs to a path that passes it within this distance, metres.
        LINE_BESIDE_M: f64 = 2.0;
        /// Greatest angle between the path and the line's lane, radians.
        LINE_TURNED_RAD: f64 = 0.6;
        /// Front bumper to stop line, metres.
        LINE_GAP_M: f64 = 0.5;
    }
    /// Of the path of an agent that may react.
    path_progress {
        /// Look-ahead for the speed at a place where the agent stood or set off, metres.
        LOOK_AHEAD_M: f64 = 6.0;
        /// Speed below which an agent stood or set off, m/s.
        SETTING_OFF_MPS: f64 = 2.0;
        /// Greatest distance beyond its path of an agent that goes no faster, metres.
        BEYOND_M: f64 = 15.0;
        /// Additional share of its path for an agent that goes faster.
        HURRIED: f64 = 0.3;
        /// Smallest and greatest rate at which a late agent returns to its own speed, m/s2.
        TAKES_UP_MPS2: (f64, f64) = (-3.0, 1.5);
    }
    /// Of following a leader.
    following {
        /// Braking rates tried, from easy to hard, as shares of the hardest.
        BRAKES: [f64; 4] = [0.25, 0.4, 0.65, 0.9];
        /// Distance to a leader, metres.
        GAP_M: f64 = 2.0;
        /// Time headway in addition, at the agent's own speed, seconds.
        HEADWAY_S: f64 = 0.8;
        /// Acceleration afterwards, m/s2.
        ACCELERATES_MPS2: f64 = 1.5;
    }
    /// Of giving way.
    giving_way {
        /// Braking rates of vehicles, from easy to the limit, as shares of the hardest.
        VEHICLE_BRAKES: [f64; 5] = [0.25, 0.375, 0.5, 0.75, 0.94];
        /// Braking rates of pedestrians and riders.
        OTHER_BRAKES: [f64; 3] = [0.4, 0.65, 0.93];
        /// Distance that a vehicle keeps at each rate, metres.
        VEHICLE_GAPS_M: [f64; 5] = [2.0, 2.0, 2.0, 1.5, 1.0];
        /// Time headway in addition, at its own speed, seconds.
        VEHICLE_HEADWAYS_S: [f64; 5] = [0.9, 0.9, 0.6, 0.2, 0.0];
        /// Distance that pedestrians and riders keep at each rate, metres.
        OTHER_GAPS_M: [f64; 3] = [0.8, 0.4, 0.1];
        /// Speeds of an agent that goes first, as factors of its own.
        FASTER: [f64; 2] = [1.15, 1.3];
        /// Speeds of an agent that enters later and has braked before, as shares of its first speed.
        ENTRIES: [f64; 3] = [0.7, 0.4, 0.1];
        /// Rate at which an agent accelerates to go first, m/s2.
        HURRIES_MPS2: f64 = 1.8;
        /// Share of the lateral limit that it may use.
        HURRIED_LATERAL: f64 = 0.7;
        /// Share of the price of an overlap that remains at zero closing speed.
        MITIGATED: f64 = 0.4;
        /// Share of the price of an encounter with an agent that may react too.
        PASSED_ON: f64 = 0.4;
        /// Rate at which a walker returns to its speed, m/s2.
        WALKER_SPEEDS_UP_MPS2: f64 = 0.8;
        /// Rate at which a cyclist returns to its speed, m/s2.
        CYCLIST_SPEEDS_UP_MPS2: f64 = 1.0;
        /// Rate at which a vehicle returns to its speed, m/s2.
        VEHICLE_SPEEDS_UP_MPS2: f64 = 1.5;
    }
    /// Of the motion that an agent has without a call.
    kept_motion {
        /// Greatest distance between a start and the motion's state for the motion to continue from it,
        /// metres.
        SAME_M: f64 = 0.2;
    }
    /// Of the description of a reaction.
    reaction {
        /// Two places nearer than this are one, metres.
        SAME_PLACE_M: f64 = 1.0;
        /// Distance from its kept motion beyond which an agent keeps clear, metres.
        ASIDE_M: f64 = 1.0;
    }
    /// Of driving a path with a delay.
    yielding {
        /// Shortest distance for which a standing agent sets off, metres.
        WORTH_GOING_M: f64 = 1.0;
        /// Jerk in giving way, m/s3.
        JERK_MPS3: f64 = 5.0;
        /// Jerk in hard braking, below the kinematic limit of scores, m/s3.
        HARD_JERK_MPS3: f64 = 14.0;
        /// Time in which the path's speed is reached, seconds.
        TRACKS_S: f64 = 0.4;
        /// Speed below which an agent halts where it has to stand, m/s.
        HALTS_MPS: f64 = 0.1;
        /// Braking above this is hard, m/s2.
        HARD_MPS2: f64 = 3.5;
        /// Greatest distance by which an agent may creep on from where it stood, metres.
        CREEPS_M: f64 = 0.1;
        /// Speed below which an agent that does not accelerate is at rest, m/s.
        AT_REST_MPS: f64 = 0.02;
    }
    /// Of walkers and carriageways.
    crossing {
        /// Distance ahead within which lanes are considered, metres.
        AHEAD_M: f64 = 40.0;
        /// Greatest distance of a kerb before the first lane, metres: parked cars and gutters lie between.
        KERB_M: f64 = 5.0;
        /// Pace of walkers with a goal time, unless they are faster already, m/s.
        PACE_MPS: f64 = 1.8;
        /// Rate at which walkers set off, m/s2.
        SETTING_OFF_MPS2: f64 = 1.3;
        /// Hardest braking of walkers at a kerb, m/s2.
        STOPPING_MPS2: f64 = 2.0;
        /// Greatest length of the path by a crosswalk, as a factor of the straight one.
        DETOUR: f64 = 2.0;
        /// Alternatively its greatest additional length, metres.
        DETOUR_M: f64 = 15.0;
        /// Distance to a crosswalk's side within which a walker uses it, metres.
        BESIDE_M: f64 = 1.5;
        /// Margin to the sides of a crosswalk, metres.
        INSIDE_M: f64 = 0.6;
        /// Distance by which a crosswalk may be drawn short of the kerb, metres.
        DRAWN_SHORT_M: f64 = 4.0;
        /// Greatest distance of a crosswalk behind the stop line of its signal, metres.
        BEHIND_LINE_M: f64 = 12.0;
        /// Radius with which a corner of a path is rounded, metres.
        ROUNDED_M: f64 = 1.0;
        /// Radius of the search for lanes, metres.
        LANE_REACH_M: f64 = 3.0;
        /// Radius of the search for the crossed lane from a crosswalk's middle, metres.
        CROSSED_REACH_M: f64 = 8.0;
        /// Distance past the kerb at which a walker has stepped out, metres.
        STEPPED_OUT_M: f64 = 0.05;
        /// Speed below which a walker stops at the kerb at once, m/s.
        STANDING_MPS: f64 = 0.3;
        /// Smallest braking before a kerb, as a share of the hardest.
        EASY_STOP: f64 = 0.6;
    }
    /// Of paths on foot around standing obstacles.
    around {
        /// Margin beside the walker, metres.
        ROOM_M: f64 = 0.2;
        /// Distance of a path's corners outside that margin, metres.
        SPARE_M: f64 = 0.05;
        /// Greatest length of such a path, as a factor of the straight one.
        DETOUR: f64 = 1.5;
        /// Alternatively its greatest additional length, metres.
        DETOUR_M: f64 = 6.0;
        /// Rounds in which boxes on the path found are added to those that it goes around.
        MOST_ROUNDS: usize = 12;
        /// Radius with which a corner of a path is rounded, metres.
        ROUNDED_M: f64 = 0.5;
    }
    /// Of paths that keep the rules of the road.
    legal {
        /// Metres to which crossing an edge of the road is equivalent.
        EDGE_M: f64 = 5.0;
        /// Amount by which the box is narrowed, metres: a path is not yet a motion.
        NARROWER_M: f64 = 0.2;
        /// Distance by which a path may cut a corner beyond a lane's assumed width, metres.
        BESIDE_LANES_M: f64 = 1.0;
        /// Allowed distance of a side of the box beyond an edge, metres.
        BEYOND_M: f64 = 0.3;
    }
    /// Of stop lines and signals.
    lights {
        /// Greatest mean distance between a path and the lane that it is on, metres.
        ON_LANE_M: f64 = 2.2;
        /// Lanes whose distances differ by less count as equally near, metres.
        SAME_LANE_M: f64 = 0.3;
        /// Length of path before or after a line that decides which lane is taken, metres.
        TELLING_M: f64 = 20.0;
        /// Lines closer than this along a path belong to one junction, metres.
        ONE_JUNCTION_M: f64 = 8.0;
        /// Length beyond its end over which a path is checked, metres: motions continue after their goal.
        BEYOND_M: f64 = 60.0;
        /// Distance past a line within which a standing agent still waits there, metres.
        PASSED_M: f64 = 2.5;
        /// Speed below which an agent stands at a line, m/s.
        STOPPED_MPS: f64 = 1.0;
        /// Distance between the front of a waiting agent and the line, metres.
        BEFORE_LINE_M: f64 = 1.0;
        /// Smallest distance of other fronts to the line, metres.
        NEAR_LINE_M: f64 = 0.5;
        /// Length of a turn at red, metres.
        TURN_M: f64 = 12.0;
        /// Usual braking for a signal, m/s2.
        BRAKE_MPS2: f64 = 2.0;
        /// Hardest braking for a signal, m/s2.
        HARDEST_MPS2: f64 = 4.0;
        /// Rate at which a waiting agent sets off, m/s2.
        SET_OFF_MPS2: f64 = 1.5;
        /// Lowest speed to which it sets off, m/s.
        SET_OFF_TO_MPS: f64 = 6.0;
        /// Distance to a path within which a standing agent is in the queue on it, metres.
        IN_QUEUE_M: f64 = 1.6;
        /// Acceleration and braking on the way to a goal beyond a signal, as shares of the limits.
        PRESSED_SHARE: f64 = 0.85;
        /// Speeds at which a line may be passed as it turns green, so that a goal is still reached, m/s.
        ROLLING_MPS: [f64; 6] = [0.0, 2.0, 4.0, 6.0, 9.0, 13.0];
        /// Distance by which lanes extend beyond their border at a stop line, metres.
        BAND_SPARE_M: f64 = 0.25;
        /// A lane continues beyond a line that is farther than this from its end, metres.
        GOES_ON_M: f64 = 5.0;
        /// Distance past a line at which the heading shows a right turn, metres.
        TURNED_M: f64 = 25.0;
        /// A smaller lag behind the next agent in a queue is ignored, metres.
        LATER_M: f64 = 0.05;
        /// Least progress of a front that counts as over a line, metres.
        LEAST_WAY_M: f64 = 0.05;
        /// Least distance for which braking is computed, metres.
        LEAST_STOP_M: f64 = 0.3;
        /// Speed below which an agent has stopped before a turn at red, m/s.
        HALTED_MPS: f64 = 0.3;
        /// Distance of a waiting agent before the line when it turns green, at least, metres.
        AT_LINE_M: f64 = 0.1;
        /// Distance of a progress to a goal below which it reaches it, metres.
        AT_GOAL_M: f64 = 0.3;
        /// A jump of one step that exceeds the hardest braking by this is smoothed away later, m/s2.
        JUMP_MPS2: f64 = 4.0;
    }
    /// Of runs that are stepped.
    run {
        /// Braking above which an ego is expected to continue braking, m/s2.
        BRAKES_MPS2: f64 = 0.5;
        /// Duration of that expected braking, seconds.
        BRAKES_FOR_S: f64 = 1.5;
        /// Distance to every lane and edge, beyond the end of the roads, at which a road user has left,
        /// metres.
        OFF_MAP_M: f64 = 2.0;
        /// Distance outside the map's rectangle at which a road user has left, metres.
        OUTSIDE_M: f64 = 5.0;
        /// Distance to its goal at which a road user has arrived, at its time or later, metres.
        ARRIVED_M: f64 = 2.0;
        /// Gap that a road user needs to enter, metres.
        ENTRY_GAP_M: f64 = 2.0;
        /// Time to the gap's end for a faster road user behind, seconds.
        ENTRY_HEADWAY_S: f64 = 1.5;
        /// Distance past the edge beyond which a corner is off the road, metres.
        PAST_EDGE_M: f64 = 0.15;
    }
    /// Of speed profiles.
    profile {
        /// Braking for a bend beyond the goal, m/s2.
        EASING_MPS2: f64 = 3.0;
        /// Factor of a cap that a speed may exceed and still keep it.
        OVER_CAP: f64 = 1.03;
        /// Manners of driving to a goal in the order of trying, from comfortable (0) to hurried (1). Recorded
        /// drivers are less patient than comfort alone.
        HURRY: [f64; 3] = [0.4, 0.7, 1.0];
        /// Usual acceleration and braking, m/s2.
        CRUISING_MPS2: (f64, f64) = (1.5, 2.5);
        /// Hardest braking for the caps of a path, without hurry, m/s2.
        BRAKING_MPS2: f64 = 4.0;
        /// Hardest braking with a goal in time or speed, m/s2.
        HARDEST_MPS2: f64 = 8.0;
    }
    /// Of paths through via points.
    through {
        /// Greatest speed at a via point, as a factor of its lane's usual speed.
        PRESSED: f64 = 1.6;
        /// Least length of a leg to a via point, metres.
        LEAST_LEG_M: f64 = 0.1;
        /// Lowest pace between via points, as a share of the speed off the lanes.
        UNHURRIED: f64 = 0.7;
        /// The next speed that is tried: factor, and addition, m/s.
        FASTER: (f64, f64) = (1.15, 0.3);
    }
    /// Of paths to a goal.
    to_goal {
        /// Distance by which a path that counts as fast enough may miss the goal, metres.
        ARRIVING_M: f64 = 0.5;
        /// Factor of comfortable speed in bends under time pressure.
        PRESSED: f64 = 1.15;
        /// Length by which a path continues beyond its goal, in addition to what it takes, metres.
        AFTER_GOAL_M: f64 = 10.0;
        /// Share of the acceleration and braking limits that a path may need.
        PRESSED_SHARE: f64 = 0.8;
        /// Lateral acceleration in the bends of a path to a goal, m/s2.
        LATERAL_MPS2: f64 = 3.5;
        /// Metres against the rules to which a late arrival is equivalent.
        LATE_M: f64 = 1e3;
        /// A nearer goal has no direction, metres.
        LEAST_CHORD_M: f64 = 0.3;
        /// Greatest length of a path that does not wind: factor of the straight one, and addition, metres.
        DIRECT: (f64, f64) = (1.25, 0.3);
    }
    /// Of paths and paces on foot without a goal.
    on_foot {
        /// A slower pace that is tried: share of the present speed, and addition, m/s.
        SLOWER: (f64, f64) = (0.6, 0.2);
        /// A faster pace that is tried, as a factor of the present speed.
        FASTER: f64 = 1.3;
        /// A constant pace that is tried, m/s.
        EVEN_MPS: f64 = 1.35;
        /// A pace near standing that is tried, m/s.
        STROLLING_MPS: f64 = 0.3;
        /// Speed below which a walker's velocity is sway and gives no direction, m/s.
        SWAYING_MPS: f64 = 0.3;
        /// Lowest speed for which the length of a path ahead is computed, m/s.
        LEAST_MPS: f64 = 1.4;
        /// Length of a path ahead relative to the distance walked in a window: factor, and addition, metres.
        LONGER: (f64, f64) = (1.3, 4.0);
    }
    /// Of paths ahead.
    way {
        /// Turn of the two bent paths where no lane continues, radians over their length.
        BEND_RAD: f64 = 0.6;
        /// Speed on foot off every lane, m/s.
        OFF_LANES_ON_FOOT_MPS: f64 = 1.6;
        /// Speed on a bicycle off every lane, m/s.
        OFF_LANES_RIDING_MPS: f64 = 5.0;
        /// Speed of a vehicle off every lane, m/s.
        OFF_LANES_DRIVING_MPS: f64 = 8.0;
        /// Cap of a path without a speed limit, m/s: above every limit of a map.
        WITHOUT_LIMIT_MPS: f64 = 60.0;
        /// Pace on a path without a speed limit, m/s.
        ASSUMED_LIMIT_MPS: f64 = 15.0;
        /// Range of the search for a place around its expected progress, before and after, metres.
        SEARCHED_M: (f64, f64) = (6.0, 12.0);
    }
    /// Of modes that coincide.
    duplicate_modes {
        /// Distance of a replacement mode from all others, as a factor of the copy threshold.
        NO_COPY: f64 = 1.05;
        /// Ridge in the fit of knots to a change of pace, squared metres per knot.
        RIDGE: f64 = 0.05;
    }
    /// Of gradient steps from conflicting drafts.
    overlaps {
        /// Shares of a gradient step that are tried until one lowers the energy.
        STEP_SHARES: [f32; 3] = [1.0, 0.5, 0.25];
    }
    /// Of draws of further samples.
    sampling {
        /// Length of a motion on foot from which the full spread applies, metres.
        FULL_ON_FOOT_M: f64 = 8.0;
        /// Length of a motion on a bicycle from which the full spread applies, metres.
        FULL_RIDING_M: f64 = 25.0;
        /// Length of a motion of a vehicle from which the full spread applies, metres.
        FULL_DRIVING_M: f64 = 40.0;
        /// Additional share of the caps that draws at the greatest diversity may use.
        MORE_HURRY: f64 = 0.15;
        /// Shares of a drawn longitudinal offset, in the order of trying.
        SHARES: [f64; 4] = [1.0, 0.7, 0.45, 0.2];
    }
}
