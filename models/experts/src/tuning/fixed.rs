//! Numbers of planning and generation that are set and not learned, and that no call varies: thresholds, room, pace.
//!
//! All were set by hand between 2026-11-21 and 2026-11-26, on recorded and made scenes that showed what was wrong
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
        /// An agent stays where it is above this probability of it.
        STAYS_ABOVE: f64 = 0.5;
    }
    /// Of the joint choice.
    choice {
        /// A near miss that lasts for so many compared moments costs all of its price.
        MOST_MOMENTS: f64 = 2.0;
        /// Modes that are nearer to an option on average count as so far from it, metres.
        LEAST_SPREAD_M: f64 = 0.3;
        /// A road user that would meet another one within so many steps of coming in does not come in.
        COMES_IN_STEPS: usize = 5;
    }
    /// Of the future that a person has seen last. Greater faults are a reason to show another; a 5 cm move of a goal
    /// changes lesser ones.
    shown_last {
        /// Past the road's edge, metres.
        PAST_EDGE_M: f64 = 0.4;
        /// Against the traffic, metres.
        WRONG_WAY_M: f64 = 5.5;
        /// Braking and turning, m/s2.
        HARSH_MPS2: f64 = 4.5;
        /// Braking of another, m/s2.
        FORCED_MPS2: f64 = 3.5;
        /// Off the lane's direction, radians.
        ASKEW_RAD: f64 = 0.35;
    }
    /// Of swerving and stopping for what is in the way.
    replan {
        /// Metres aside that a vehicle gets on a metre of way.
        SLOPE: f64 = 0.35;
        /// A motion follows the places that it is made from within this, metres.
        SPARE_M: f64 = 0.2;
        /// Room to the sides of an agent that stops, metres.
        ROOM_M: f64 = 0.3;
        /// Room to what an agent stops before, metres: ten knots cannot follow every halt.
        SHORT_M: f64 = 1.0;
        /// Room of a walker that stops: before it and beside it, metres.
        WALKER_ROOM_M: (f64, f64) = (0.4, 0.1);
        /// Shorter ways have no sides, metres.
        LEAST_WAY_M: f64 = 2.0;
        /// Braking before what is in the way that is tried: shares of the hardest.
        BRAKES: [f64; 3] = [0.3, 0.55, 0.9];
        /// Harder braking must lead so much farther, metres.
        HARDER_M: f64 = 2.0;
        /// A motion ends at most so far short of its goal when it gets there, metres.
        THERE_M: f64 = 0.1;
    }
    /// Of agents at rest that move off.
    moving_off {
        /// An agent so near to a red line waits there, metres.
        AT_LINE_M: f64 = 5.0;
        /// An agent with so much room to one at rest ahead is in its queue, metres.
        IN_QUEUE_M: f64 = 8.0;
        /// A slower agent does not roll, m/s. Recorded vehicles that stay have a speed of exactly zero.
        ROLLS_MPS: f64 = 1e-4;
    }
    /// Of warnings.
    report {
        /// A start or goal farther from any lane is off the road, metres.
        OFF_ROAD_M: f64 = 6.0;
        /// A goal farther than top speed leads, by this factor, is out of reach.
        BEYOND_REACH: f64 = 1.1;
        /// Two boxes at the start overlap above this intersection over union.
        OVERLAP_IOU: f64 = 0.02;
    }
    /// Of rounds with feedback.
    rounds {
        /// A round's draw is at least this diverse: a person must see what there is.
        ROUND_DIVERSITY: f64 = 1.5;
    }
    /// Of variations of a draft.
    variations {
        /// Time kept from another agent at shared ground, in the order of trying, seconds.
        GAPS_S: [f64; 3] = [0.9, 0.5, 0.2];
        /// Share of the speed caps of a path that is usual.
        HURRY: f64 = 1.1;
        /// A walker that waits may lean over the kerb by this, metres.
        OVER_KERB_M: f64 = 0.4;
        /// Way kept from shared ground, metres.
        CLEAR_M: f64 = 0.4;
        /// Speed cap of walkers, m/s.
        WALKING_MPS: f64 = 2.2;
        /// A motion may exceed usual rates by this, m/s2.
        SPARE_MPS2: f64 = 0.1;
        /// And the cap by this, m/s.
        SPARE_MPS: f64 = 0.3;
        /// An agent that goes first or lets another pass brakes and speeds up so many times as hard.
        BRISK: (f64, f64) = (1.15, 1.4);
        /// Progress is not changed earlier than this, seconds.
        SOONEST_S: f64 = 0.8;
        /// Usual braking and speeding up on foot, m/s2.
        ON_FOOT_MPS2: (f64, f64) = (1.3, 1.3);
        /// The same on a bicycle, m/s2.
        RIDING_MPS2: (f64, f64) = (2.5, 1.5);
        /// The same of a vehicle, m/s2.
        DRIVING_MPS2: (f64, f64) = (3.4, 2.4);
        /// Progress is not changed so near to the time of the goal, seconds.
        NEAR_GOAL_S: f64 = 0.4;
        /// Other progress on foot to a goal in the order of trying, and another line, metres.
        ON_FOOT_TO_GOAL_M: (&[f64], f64) = (&[1.3, 2.2, 0.8], 1.1);
        /// The same without a goal, metres.
        ON_FOOT_M: (&[f64], f64) = (&[3.0, 5.0, 2.0], 3.0);
        /// Other progress on a bicycle to a goal in the order of trying, and another line, metres.
        RIDING_TO_GOAL_M: (&[f64], f64) = (&[1.3, 2.6, 4.5], 0.8);
        /// The same without a goal, metres.
        RIDING_M: (&[f64], f64) = (&[6.0, 12.0, 3.5], 0.8);
        /// Other progress of a vehicle to a goal in the order of trying, and another line, metres.
        DRIVING_TO_GOAL_M: (&[f64], f64) = (&[1.3, 2.6, 4.0, 6.0], 0.7);
        /// The same without a goal, metres.
        DRIVING_M: (&[f64], f64) = (&[8.0, 14.0, 5.0, 22.0], 0.7);
        /// Time after a goal that leaves room for another pace from there on, seconds.
        LEFT_S: f64 = 1.5;
        /// Other progress from a goal to the end of the window, metres.
        AFTER_GOAL_M: [f64; 3] = [-5.0, 5.0, -10.0];
    }
    /// Of motions through via points.
    via_steering {
        /// Share of a via point's tolerance that a motion may use before it is brought nearer.
        SURE: f64 = 0.8;
        /// Share of the tolerance that it keeps then: futures stay apart where they may.
        KEEPS: f64 = 0.5;
        /// An offset from the path shrinks towards a via point by this, metres for each metre of way.
        NARROWS: f64 = 0.15;
        /// Distance past the last via point at which an agent without a goal ends, metres.
        PAST_M: f64 = 1.0;
        /// Metres that a missed goal counts as.
        GOAL_MISSED_M: f64 = 10.0;
    }
    /// Of walkers that step out before a vehicle.
    stepping_out {
        /// Slower vehicles let people cross, m/s.
        FAST_MPS: f64 = 4.0;
        /// A walker steps out before a vehicle that would have to brake harder than this, m/s2.
        HARD_MPS2: f64 = 3.0;
        /// Time kept from a vehicle that has passed, seconds.
        AFTER_S: f64 = 0.3;
    }
    /// Of the way from a draft to its motion.
    trajectory {
        /// A front nearer to a red line than this is over it, metres.
        AT_LINE_M: f64 = 0.25;
        /// The next try stops so much farther from the line, metres.
        SHORT_OF_LINE_M: f64 = 1.2;
        /// Shares of an offset that are tried where the whole of it leaves the road.
        OFFSET_SHARES: [f64; 4] = [0.8, 0.6, 0.4, 0.2];
        /// Ending along a lane may change a motion by this, metres.
        ALONG_LANE_M: f64 = 1.5;
        /// Braking of a vehicle that rolls backwards without a reason, m/s2.
        BACKING_BRAKE_MPS2: f64 = 1.5;
        /// A goal behind is backed to within this distance, metres.
        BACKING_WAY_M: f64 = 30.0;
        /// Metres that a radian of missed heading counts as.
        RADIAN_M: f64 = 5.0;
        /// A slower agent stands in the first window and in a later one, m/s.
        RESTING_MPS: (f64, f64) = (0.3, 0.05);
    }
    /// Of the place on the road that is offered instead of a goal off it.
    remedies {
        /// A driver without hurry speeds up at this rate, m/s2.
        SPEEDING_UP_MPS2: f64 = 1.5;
        /// The pace of a driver without hurry, m/s.
        PACE_MPS: f64 = 13.9;
        /// Sideways acceleration in bends and braking ahead of them.
        BENDS: SpeedRules = SpeedRules { lateral_mps2: 3.0, brake_mps2: 2.2 };
        /// A gentle stop brakes no harder, m/s2.
        STOPPING_MPS2: f64 = 3.0;
        /// A place nearer to the goal than this is the goal, metres.
        LEAST_MOVE_M: f64 = 1.0;
    }
    /// Of what is in the way along a path.
    blocks {
        /// Boxes come no nearer than this, metres: a little more than what the choice calls close.
        CLEAR_M: f64 = CLOSE_M + 0.05;
        /// Room to what crosses the path, metres: nearer is a near miss.
        CROSSING_M: f64 = 1.1;
        /// As long as it is faster than this, m/s.
        CROSSING_MPS: f64 = 0.5;
        /// So long after the window others are looked at, seconds.
        BEYOND_S: f64 = 2.0;
        /// A stop line belongs to a path that passes it nearer than this, metres.
        LINE_BESIDE_M: f64 = 2.0;
        /// The same for the angle between the path and the lane of the line, radians.
        LINE_TURNED_RAD: f64 = 0.6;
        /// Front bumper to stop line, metres.
        LINE_GAP_M: f64 = 0.5;
    }
    /// Of the path of an agent that may react.
    path_progress {
        /// How far ahead the speed at a place is looked up where the agent stood or set off, metres.
        LOOK_AHEAD_M: f64 = 6.0;
        /// A slower agent stood or set off, m/s.
        SETTING_OFF_MPS: f64 = 2.0;
        /// An agent that goes no faster gets at most so far beyond its path, metres.
        BEYOND_M: f64 = 15.0;
        /// An agent that goes faster gets farther by this share of its way.
        HURRIED: f64 = 0.3;
        /// Least and greatest rate at which a late agent takes up its own speed again, m/s2.
        TAKES_UP_MPS2: (f64, f64) = (-3.0, 1.5);
    }
    /// Of staying behind another agent.
    following {
        /// Braking that is tried, from easy to hard: shares of the hardest.
        BRAKES: [f64; 4] = [0.25, 0.4, 0.65, 0.9];
        /// Distance to what is ahead, metres.
        GAP_M: f64 = 2.0;
        /// And time at its own speed, seconds.
        HEADWAY_S: f64 = 0.8;
        /// Speeding up again, m/s2.
        ACCELERATES_MPS2: f64 = 1.5;
    }
    /// Of giving way.
    giving_way {
        /// Braking of vehicles, from easy to what is possible: shares of the hardest.
        VEHICLE_BRAKES: [f64; 5] = [0.25, 0.375, 0.5, 0.75, 0.94];
        /// The same of people on foot and riders.
        OTHER_BRAKES: [f64; 3] = [0.4, 0.65, 0.93];
        /// The distance that a vehicle keeps with each of them, metres.
        VEHICLE_GAPS_M: [f64; 5] = [2.0, 2.0, 2.0, 1.5, 1.0];
        /// And the time at its own speed, seconds.
        VEHICLE_HEADWAYS_S: [f64; 5] = [0.6, 0.4, 0.2, 0.0, 0.0];
        /// The same of people on foot and riders, metres.
        OTHER_GAPS_M: [f64; 3] = [0.8, 0.4, 0.1];
        /// Speeds of an agent that goes first: shares of its own.
        FASTER: [f64; 2] = [1.15, 1.3];
        /// Speeds of an agent that enters later and braked before: shares of its first one.
        ENTRIES: [f64; 3] = [0.7, 0.4, 0.1];
        /// Rate at which it speeds up to them, m/s2.
        HURRIES_MPS2: f64 = 1.8;
        /// Share of the sideways limit that it may use.
        HURRIED_LATERAL: f64 = 0.7;
        /// Share of the price of an overlap that is left at no speed.
        MITIGATED: f64 = 0.4;
        /// Share of the price of a meeting with an agent that may react too.
        PASSED_ON: f64 = 0.4;
        /// Rate at which a walker takes up its speed again, m/s2.
        WALKER_SPEEDS_UP_MPS2: f64 = 0.8;
        /// The same on a bicycle, m/s2.
        CYCLIST_SPEEDS_UP_MPS2: f64 = 1.0;
        /// The same of a vehicle, m/s2.
        VEHICLE_SPEEDS_UP_MPS2: f64 = 1.5;
    }
    /// Of the motion that an agent has without a call.
    kept_motion {
        /// It goes on from a start if it is so near to where that leads in a step, metres.
        SAME_M: f64 = 0.2;
    }
    /// Of naming a reaction.
    reaction {
        /// Two places nearer than this are one place, metres.
        SAME_PLACE_M: f64 = 1.0;
        /// An agent farther than this from its kept motion keeps clear, metres.
        ASIDE_M: f64 = 1.0;
    }
    /// Of driving a path later.
    yielding {
        /// An agent that stands does not set off for less than this, metres.
        WORTH_GOING_M: f64 = 1.0;
        /// Change of acceleration in giving way, m/s3.
        JERK_MPS3: f64 = 5.0;
        /// The same where it brakes hard: below the kinematic limit of scores.
        HARD_JERK_MPS3: f64 = 14.0;
        /// Time in which the speed of a moment later is reached, seconds.
        TRACKS_S: f64 = 0.4;
        /// What is slower where it must stand halts, m/s.
        HALTS_MPS: f64 = 0.1;
        /// Harder braking is hard, m/s2.
        HARD_MPS2: f64 = 3.5;
        /// An agent that stood gets no farther than this from there, metres.
        CREEPS_M: f64 = 0.1;
        /// A slower agent that does not speed up is at rest, m/s.
        AT_REST_MPS: f64 = 0.02;
    }
    /// Of walkers and carriageways.
    crossing {
        /// Lanes farther ahead than this are left out, metres.
        AHEAD_M: f64 = 40.0;
        /// A kerb lies at most so far before the first lane, metres: parked cars and gutters lie between.
        KERB_M: f64 = 5.0;
        /// Pace of walkers that are due at a time, unless they are faster already, m/s.
        PACE_MPS: f64 = 1.8;
        /// Rate at which walkers set off, m/s2.
        SETTING_OFF_MPS2: f64 = 1.3;
        /// Walkers stop at a kerb no harder than this, m/s2.
        STOPPING_MPS2: f64 = 2.0;
        /// The way by a crosswalk may be so many times the straight one.
        DETOUR: f64 = 2.0;
        /// Or so much longer, metres.
        DETOUR_M: f64 = 15.0;
        /// A walker nearer to a crosswalk's side than this uses it, metres.
        BESIDE_M: f64 = 1.5;
        /// Room kept from the sides of a crosswalk, metres.
        INSIDE_M: f64 = 0.6;
        /// A crosswalk may be drawn so far short of the kerb, metres.
        DRAWN_SHORT_M: f64 = 4.0;
        /// Greatest distance of a crosswalk behind the stop line of its signal, metres.
        BEHIND_LINE_M: f64 = 12.0;
        /// A corner of a path is rounded off over this, metres.
        ROUNDED_M: f64 = 1.0;
        /// Lanes are looked up so far from a place, metres.
        LANE_REACH_M: f64 = 3.0;
        /// The lane that a crosswalk crosses is at most so far from its middle, metres.
        CROSSED_REACH_M: f64 = 8.0;
        /// A walker has stepped out this far past the kerb, metres.
        STEPPED_OUT_M: f64 = 0.05;
        /// A slower walker stops at the kerb at once, m/s.
        STANDING_MPS: f64 = 0.3;
        /// Least braking before a kerb: share of the hardest.
        EASY_STOP: f64 = 0.6;
    }
    /// Of ways on foot round what stands.
    around {
        /// Room kept beside the walker, metres.
        ROOM_M: f64 = 0.2;
        /// Corners of a way lie so far outside that room, metres.
        SPARE_M: f64 = 0.05;
        /// Such a way may be so many times the straight one.
        DETOUR: f64 = 1.5;
        /// Or so much longer, metres.
        DETOUR_M: f64 = 6.0;
        /// Rounds in which boxes on the way found are added to those that it goes round.
        MOST_ROUNDS: usize = 12;
        /// A corner of a way is rounded off over this, metres.
        ROUNDED_M: f64 = 0.5;
    }
    /// Of ways that keep the rules of the road.
    legal {
        /// Metres that crossing an edge of the road counts as.
        EDGE_M: f64 = 5.0;
        /// The box counts as so much narrower than it is, metres: a path is no motion yet.
        NARROWER_M: f64 = 0.2;
        /// A path may cut a corner so far beside a lane's assumed width, metres.
        BESIDE_LANES_M: f64 = 1.0;
        /// Allowed distance of a side of the box beyond an edge, metres.
        BEYOND_M: f64 = 0.3;
    }
    /// Of stop lines and signals.
    lights {
        /// Greatest mean distance from a lane's centre at which a path is on that lane, metres.
        ON_LANE_M: f64 = 2.2;
        /// Lanes whose distances differ by less count as equally near, metres.
        SAME_LANE_M: f64 = 0.3;
        /// Length of path before or after a line that decides which lane is taken, metres.
        TELLING_M: f64 = 20.0;
        /// Lines nearer to each other along a path are of one junction, metres.
        ONE_JUNCTION_M: f64 = 8.0;
        /// Length beyond its end over which a path is checked, metres: motions go on after their goal.
        BEYOND_M: f64 = 60.0;
        /// An agent that stands so little past a line waits there, metres.
        PASSED_M: f64 = 2.5;
        /// A slower agent stands at a line, m/s.
        STOPPED_MPS: f64 = 1.0;
        /// Front of a waiting agent to the line, metres.
        BEFORE_LINE_M: f64 = 1.0;
        /// Other fronts may come so near to the line, metres.
        NEAR_LINE_M: f64 = 0.5;
        /// Length of a turn at red, metres.
        TURN_M: f64 = 12.0;
        /// Usual braking for a signal, m/s2.
        BRAKE_MPS2: f64 = 2.0;
        /// Hardest braking for a signal, m/s2.
        HARDEST_MPS2: f64 = 4.0;
        /// Rate at which a waiting agent sets off, m/s2.
        SET_OFF_MPS2: f64 = 1.5;
        /// The least speed to which it sets off, m/s.
        SET_OFF_TO_MPS: f64 = 6.0;
        /// A standing agent nearer to a path than this is in the queue on it, metres.
        IN_QUEUE_M: f64 = 1.6;
        /// Speeding up and braking on the way to a goal beyond a signal: shares of the limits.
        PRESSED_SHARE: f64 = 0.85;
        /// Speeds at which a line may be passed as it turns green, so that a goal is still reached, m/s.
        ROLLING_MPS: [f64; 6] = [0.0, 2.0, 4.0, 6.0, 9.0, 13.0];
        /// Lanes reach beyond their border by this at a stop line, metres.
        BAND_SPARE_M: f64 = 0.25;
        /// A lane goes on beyond a line that is farther than this from its end, metres.
        GOES_ON_M: f64 = 5.0;
        /// Distance past a line at which the heading tells a turn to the right, metres.
        TURNED_M: f64 = 25.0;
        /// Progress less than this behind the next in a queue is not later, metres.
        LATER_M: f64 = 0.05;
        /// A front counts as over a line at this progress at least, metres.
        LEAST_WAY_M: f64 = 0.05;
        /// Braking is worked out for at least this distance, metres.
        LEAST_STOP_M: f64 = 0.3;
        /// A slower agent has stopped before it turns at red, m/s.
        HALTED_MPS: f64 = 0.3;
        /// At green a waiting agent is at least this far before the line, metres.
        AT_LINE_M: f64 = 0.1;
        /// Progress within this of a goal reaches it, metres.
        AT_GOAL_M: f64 = 0.3;
        /// A jump of one step by so much more than the hardest braking is smoothed away later, m/s2.
        JUMP_MPS2: f64 = 4.0;
    }
    /// Of runs that are stepped.
    run {
        /// An ego that brakes harder than this is expected to go on braking, m/s2.
        BRAKES_MPS2: f64 = 0.5;
        /// For so long, seconds.
        BRAKES_FOR_S: f64 = 1.5;
        /// A road user farther than this from every lane and edge beyond the end of the roads has left, metres.
        OFF_MAP_M: f64 = 2.0;
        /// A road user farther than this outside the box of the map has left, metres.
        OUTSIDE_M: f64 = 5.0;
        /// A road user nearer than this to its goal, at its time or later, has arrived, metres.
        ARRIVED_M: f64 = 2.0;
        /// Room that a road user needs to come in, metres.
        ENTRY_GAP_M: f64 = 2.0;
        /// And the time in which a faster one behind would be there, seconds.
        ENTRY_HEADWAY_S: f64 = 1.5;
        /// A corner farther than this past the edge is off the road, metres.
        PAST_EDGE_M: f64 = 0.15;
    }
    /// Of speed profiles.
    profile {
        /// Braking for a bend beyond the goal, m/s2.
        EASING_MPS2: f64 = 3.0;
        /// A speed over its cap by this factor holds it.
        OVER_CAP: f64 = 1.03;
        /// Manners of driving to a goal in the order of trying, from comfortable (0) to hurried (1). Recorded drivers are
        /// less patient than comfort alone.
        HURRY: [f64; 3] = [0.4, 0.7, 1.0];
        /// Usual speeding up and braking, m/s2.
        CRUISING_MPS2: (f64, f64) = (1.5, 2.5);
        /// Hardest braking for the caps of a path without hurry, m/s2.
        BRAKING_MPS2: f64 = 4.0;
        /// The same with a goal in time or in speed, m/s2.
        HARDEST_MPS2: f64 = 8.0;
    }
    /// Of ways through via points.
    through {
        /// A via point is passed at most so many times as fast as its lane suggests.
        PRESSED: f64 = 1.6;
        /// A leg to a via point counts as at least so long, metres.
        LEAST_LEG_M: f64 = 0.1;
        /// Least pace between via points: share of the speed off every lane.
        UNHURRIED: f64 = 0.7;
        /// The next speed that is tried: factor, and what is added, m/s.
        FASTER: (f64, f64) = (1.15, 0.3);
    }
    /// Of ways to a goal.
    to_goal {
        /// A way that counts as fast enough may miss the goal by this, metres.
        ARRIVING_M: f64 = 0.5;
        /// A way may be driven so many times as fast through its bends as is comfortable, when time presses.
        PRESSED: f64 = 1.15;
        /// A way goes on beyond its goal for so much more than it takes, metres.
        AFTER_GOAL_M: f64 = 10.0;
        /// Share of the limits of speeding up and braking that a way may need.
        PRESSED_SHARE: f64 = 0.8;
        /// Sideways acceleration in the bends of a way to a goal, m/s2.
        LATERAL_MPS2: f64 = 3.5;
        /// Metres against the rules that a late arrival counts as.
        LATE_M: f64 = 1e3;
        /// A goal that is nearer has no direction, metres.
        LEAST_CHORD_M: f64 = 0.3;
        /// A way does not wind up to this share of the straight one, and so many metres more.
        DIRECT: (f64, f64) = (1.25, 0.3);
    }
    /// Of paths and paces on foot without a goal.
    on_foot {
        /// A slower pace that is tried: share of the speed now, and what is added, m/s.
        SLOWER: (f64, f64) = (0.6, 0.2);
        /// A faster pace that is tried: share of the speed now.
        FASTER: f64 = 1.3;
        /// An even pace that is tried, m/s.
        EVEN_MPS: f64 = 1.35;
        /// A pace close to standing that is tried, m/s.
        STROLLING_MPS: f64 = 0.3;
        /// The velocity of a slower walker is sway and gives no direction, m/s.
        SWAYING_MPS: f64 = 0.3;
        /// The length of a path ahead is for this speed at least, m/s.
        LEAST_MPS: f64 = 1.4;
        /// A path ahead is longer than the way in a window: by this factor, and by so many metres.
        LONGER: (f64, f64) = (1.3, 4.0);
    }
    /// Of paths ahead.
    way {
        /// Turn of the two bent paths where no lane leads on, radians over their length.
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
        /// A place is searched on a path so far before and after its expected progress, metres.
        SEARCHED_M: (f64, f64) = (6.0, 12.0);
    }
    /// Of modes that coincide.
    duplicate_modes {
        /// A mode in place of a copy is farther from all others than copies are, by this factor.
        NO_COPY: f64 = 1.05;
        /// Ridge of the fit of knots to a change of pace, in squared metres a knot.
        RIDGE: f64 = 0.05;
    }
    /// Of plain steps downhill from drafts that conflict.
    overlaps {
        /// Shares of a step downhill that are tried, until one lowers the energy.
        STEP_SHARES: [f32; 3] = [1.0, 0.5, 0.25];
    }
    /// Of draws of further samples.
    sampling {
        /// A motion on foot of this length is drawn with the full spread, metres.
        FULL_ON_FOOT_M: f64 = 8.0;
        /// The same on a bicycle, metres.
        FULL_RIDING_M: f64 = 25.0;
        /// The same of a vehicle, metres.
        FULL_DRIVING_M: f64 = 40.0;
        /// Draws at the greatest diversity may exceed the usual share of the caps by this much more.
        MORE_HURRY: f64 = 0.15;
        /// Shares of a drawn offset along the way, in the order of trying.
        SHARES: [f64; 4] = [1.0, 0.7, 0.45, 0.2];
    }
}
