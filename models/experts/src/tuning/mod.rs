//! The numbers that are tuned and not learned: the second half of the model, in one place.
//!
//! Each says what it is, in which unit, and what it was fitted on: data, metric, date. "The 71 scenes" are the
//! recorded scenes of the weights' card that are neither in the training data nor in its tables. All were
//! fitted, or set by hand, between 2026-11-21 and 2026-11-26. [`Tuning::hash`] stands beside the weights' hashes
//! in every answer; `dragtraffic lab eval --ablate NAME[=VALUE]` varies one of them by its name in [`NUMBERS`]. What is set
//! and no call varies stands in [`fixed`], and for placement in [`placing`].

use scene::ContentHash;
use std::fmt::Write;

/// One tuned number by name.
pub struct Number {
    /// `group.name`.
    pub name: &'static str,
    /// The value that leaves out what the number is for; `None` where there is no such value.
    pub off: Option<f64>,
    of: fn(&Tuning) -> f64,
    of_mut: fn(&mut Tuning) -> &mut f64,
}

/// Why a number cannot be set.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum TuningError {
    /// No number has this name.
    #[error("no tuned number is called \"{0}\"")]
    Unknown(String),
    /// A value is needed: none leaves out what the number is for.
    #[error("\"{0}\" cannot be left out; give it a value")]
    NeedsValue(&'static str),
    /// The value is not finite.
    #[error("\"{0}\" must be a finite number")]
    NotFinite(&'static str),
}

/// Groups of numbers, and the table of their names, made from one list.
macro_rules! tuning {
    ($($(#[$group_doc:meta])* $group:ident: $Group:ident {
        $($(#[$doc:meta])* $name:ident = $value:expr $(, off $off:expr)?;)*
    })*) => {
        $(
            $(#[$group_doc])*
            #[derive(Clone, Copy, Debug, PartialEq)]
            pub struct $Group { $($(#[$doc])* pub $name: f64,)* }
        )*

        /// All tuned numbers.
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct Tuning { $($(#[$group_doc])* pub $group: $Group,)* }

        /// What the program ships with.
        pub static SHIPPED: Tuning = Tuning { $($group: $Group { $($name: $value,)* },)* };

        /// All numbers by name.
        pub const NUMBERS: &[Number] = &[$($(Number {
            name: concat!(stringify!($group), ".", stringify!($name)),
            off: tuning!(@off $($off)?),
            of: |tuning| tuning.$group.$name,
            of_mut: |tuning| &mut tuning.$group.$name,
        },)*)*];
    };
    (@off) => { None };
    (@off $off:expr) => { Some($off) };
}

/// Constants by group, and the table of their names with their values as text.
macro_rules! numbers {
    ($($(#[$group_doc:meta])* $group:ident {
        $($(#[$doc:meta])* $name:ident: $type:ty = $value:expr;)*
    })*) => {
        $(
            $(#[$group_doc])*
            pub(crate) mod $group {
                #[allow(unused_imports, reason = "few groups need what the values are made of")]
                use super::*;
                $($(#[$doc])* pub(crate) const $name: $type = $value;)*
            }
        )*

        /// All numbers by name.
        #[allow(dead_code, reason = "the hash of generation leaves placement out")]
        pub(super) const ALL: &[(&str, fn() -> String)] = &[$($(
            (concat!(stringify!($group), ".", stringify!($name)), || format!("{:?}", $group::$name)),
        )*)*];
    };
}

// Behind the macro, which both are written with.
pub(crate) mod fixed;
pub(crate) mod placing;
pub mod published;

tuning! {
    /// Where anchors lead and how fast.
    anchors: AnchorTuning {
        /// How long the velocity of the moment lasts on foot, where it is mostly sway, seconds. Error of base
        /// paths to goals on the 71 scenes: 0.33 m without it, 0.29 m with it. 2026-11-22.
        walkers_relax_s = 0.8;
        /// The same on a bicycle, seconds. Error of base paths on the 71 scenes. 2026-11-22.
        riders_relax_s = 5.0;
        /// How far a rider's smooth way to a goal may be from the route's, metres. Error of base paths on the
        /// 71 scenes. 2026-11-22.
        riders_berth_m = 3.0;
        /// How a standing vehicle sets off towards a goal, m/s2. Along-road error of 62 cases of the 71
        /// scenes: 2.2 m when it leaves at once, 1.2 m with this; 1.0 to 1.2 are as good. 2026-11-22.
        setting_off_mps2 = 1.1;
        /// A way to a goal that breaks the rules of the road on less than this passes for legal, metres: bends are
        /// cut, boxes swing. Set by hand. 2026-11-22.
        broken_m = 2.0;
        /// Metres against the rules that a metre of a longer way is worth. Set by hand. 2026-11-22.
        detour = 0.1, off 0.0;
        /// A goal on a lane with its heading free is met along the lane where the path there is within this of it,
        /// radians. Set by hand. 2026-11-22.
        along_lane_rad = 1.0, off 0.0;
        /// How long what was learned of the line to a goal goes on after it, seconds: the way goes on along the lane there,
        /// and to a lane that is changed to early little was learned. Vehicles on a straight road with a goal in the other
        /// lane before 6 s: of six futures 74 % left the road, none does, and they stay in the lane; with goals of
        /// recordings 4 s ahead on 30 of the 71 scenes 8 % left it, now 3 %, and are as near to the log (mean of six
        /// 10.7 m, now 10.6). 2026-11-26.
        after_goal_s = 0.5, off 1e9;
        /// Pace of drivers on a long way round to a goal, m/s. Set by hand. 2026-11-22.
        easy_mps = 13.0;
        /// Speed that is taken for allowed, over the limit that the map names. Set by hand. 2026-11-21.
        over_limit = 1.15, off 1.0;
    }
    /// How sure the answer is of its modes.
    probability: ProbabilityTuning {
        /// Temperature of the probabilities where no goal position is fixed: what was learned from simulated
        /// drivers is surer than recorded ones warrant. Log loss on the 71 scenes: 1.96 without, 1.78 with
        /// it. 2026-11-22.
        temperature = 2.5, off 1.0;
        /// Temperature of what an answer says without a goal position, besides [`ProbabilityTuning::temperature`].
        /// Log loss of vehicles on the 71 scenes. 2026-11-27.
        answer_temperature = 1.5, off 1.0;
        /// Share of the probability that is spread evenly over the futures of an answer with a goal position. Log loss of
        /// vehicles on the 71 scenes. 2026-11-27.
        spread_with_goal = 0.5, off 0.0;
        /// What it costs a future to break rules ([`ChoiceTuning`]), in the logarithm of its probability. Error of the
        /// likeliest future of vehicles on the 71 scenes: 6.90 m without a goal, 6.77 m with it, with a speed as goal
        /// 4.98 m and 4.72 m; log loss 1.68 and 1.67, 1.80 and 1.78. Half is as near and surer than it may be.
        /// 2026-11-26.
        unlawful = 0.25, off 0.0;
    }
    /// Of two modes that coincide the less probable one halts or goes. All on the 71 scenes, minADE of six
    /// without a goal: 0.14 m nearer for vehicles, 0.06 m on foot, the numbers beside these by little worse.
    /// 2026-11-22.
    duplicates: DuplicateTuning {
        /// Probability of the mode that halts or goes. More would be as likely on recorded scenes, where
        /// drivers do it, yet draws that do it while all others do as expected overlap.
        probability = 0.02, off 0.0;
        /// Mean distance below which two modes of a vehicle coincide, metres.
        vehicle_same_m = 2.0, off 0.0;
        /// Mean distance that the changed mode of a vehicle keeps from all others, metres.
        vehicle_apart_m = 3.0;
        /// How fast it changes its pace, m/s2.
        vehicle_rate_mps2 = 1.5;
        /// See [`DuplicateTuning::vehicle_same_m`].
        pedestrian_same_m = 1.0, off 0.0;
        /// See [`DuplicateTuning::vehicle_apart_m`].
        pedestrian_apart_m = 0.5;
        /// See [`DuplicateTuning::vehicle_rate_mps2`].
        pedestrian_rate_mps2 = 0.7;
        /// Speed of a pedestrian that starts, m/s. Vehicles go as fast as their path allows.
        pedestrian_going_mps = 1.6;
        /// See [`DuplicateTuning::vehicle_same_m`].
        cyclist_same_m = 1.0, off 0.0;
        /// See [`DuplicateTuning::vehicle_apart_m`].
        cyclist_apart_m = 2.0;
        /// See [`DuplicateTuning::vehicle_rate_mps2`].
        cyclist_rate_mps2 = 1.0;
        /// Speed of a cyclist that starts, where caps allow, m/s.
        cyclist_going_mps = 7.0;
        /// Mean distance below which two modes are copies of each other, metres, without a goal position: one
        /// of them goes before or after another agent, or takes another pace or line. Set by hand.
        /// 2026-11-22.
        copy_m = 1.1, off 0.0;
        /// The same with a goal position. Set by hand. 2026-11-22.
        copy_with_goal_m = 0.55, off 0.0;
    }
    /// How much wider futures are drawn at the greatest diversity, mean metres in a window; less with the square of
    /// the setting. Spread of six at diversity 2 over that at 0.5. 2026-11-22.
    diversity: DiversityTuning {
        /// Along the way of a vehicle without a goal.
        driving_m = 20.0, off 0.0;
        /// Along the way of a rider without a goal.
        riding_m = 9.0, off 0.0;
        /// Along the way on foot without a goal.
        on_foot_m = 2.0, off 0.0;
        /// Along the way to a goal 9 s away on wheels.
        goal_m = 4.0, off 0.0;
        /// Along the way to a goal 9 s away on foot.
        goal_on_foot_m = 1.5, off 0.0;
        /// Aside on wheels.
        aside_m = 0.3, off 0.0;
        /// Aside on foot.
        aside_on_foot_m = 0.8, off 0.0;
    }
    /// Speed range over which the networks' output fades out: above it only the anchors' paths and speed
    /// profiles remain.
    speeds: SpeedTuning {
        /// Full weight of the networks up to this speed, m/s. Above it the six futures of a car on an empty
        /// straight motorway begin to leave its lane. 2026-11-26.
        known_mps = 21.0, off 1e3;
        /// No weight of the networks from this speed on, m/s. 2026-11-26.
        unknown_mps = 24.0, off 2e3;
    }
    /// What the mode in the middle of what may happen is made of.
    middle: MiddleTuning {
        /// Share of what was learned in it, the rest is its anchor's own base: recorded road users keep nearer
        /// to the formula than simulated ones do. Error of the first answer with a goal position on the 71
        /// scenes. 2026-11-22.
        learned = 0.5, off 1.0;
        /// The same on foot.
        learned_on_foot = 0.4, off 1.0;
        /// What was shown last stays a candidate while its end is this near to the goal, metres. Set by hand.
        /// 2026-11-22.
        same_goal_m = 0.75, off 0.0;
    }
    /// What a candidate costs in the joint choice; distances to the other modes cost about 1.
    choice: ChoiceTuning {
        /// Two boxes that overlap, on top of [`ChoiceTuning::close`]. Set by hand. 2026-11-21.
        overlap = 5.0, off 0.0;
        /// Two boxes closer than half a metre. Set by hand. 2026-11-21.
        close = 1.5, off 0.0;
        /// Two motions that would soon touch if both went on as they do, at two moments or more: a near miss. Set by
        /// hand. 2026-11-27.
        near_miss = 1.5, off 0.0;
        /// A vehicle that is away from every lane all the time, by the share of the time. Set by hand.
        /// 2026-11-21.
        off_lanes = 8.0, off 0.0;
        /// How far from a lane that is, metres. Set by hand. 2026-11-21.
        off_lanes_m = 2.5;
        /// A vehicle with a corner beyond the road's edges, by the share of the time. Set by hand. 2026-11-21.
        past_edges = 8.0, off 0.0;
        /// How far beyond counts, metres. Set by hand. 2026-11-21.
        past_edge_m = 0.1;
        /// A vehicle that leaves the road, or drives against every lane, at any time: as bad as a close
        /// approach, so that the kerb is no way past a queue. Set by hand. 2026-11-25.
        leaving_the_road = 1.5, off 0.0;
        /// A goal that is missed: worse than anything but an overlap. Set by hand. 2026-11-21.
        goal_missed = 3.0, off 0.0;
        /// A vehicle against the direction of every lane there, by the share of the time. Set by hand.
        /// 2026-11-22.
        wrong_way = 8.0, off 0.0;
        /// A stop line that is crossed at red. Set by hand. 2026-11-22.
        red_light = 4.0, off 0.0;
        /// Braking or steering harder than this, on wheels, m/s2: what the judge calls harsh. Set by hand. 2026-11-23.
        harsh_mps2 = 4.0;
        /// A motion that does so at all. Set by hand. 2026-11-23.
        harsh = 0.4, off 0.0;
        /// Each second of it. Set by hand. 2026-11-23.
        harsh_second = 0.4, off 0.0;
        /// A walker that steps out before a vehicle that would have to brake hard. Set by hand. 2026-11-23.
        stepping_out = 1.5, off 0.0;
        /// Switching from the future shown last, while a goal is dragged: less than an overlap, more than the
        /// difference between modes. Jumps over 1 m when a goal moves by 5 cm on drags of the 71 scenes: 2.7
        /// % at 3, 2.3 % at 4. 2026-11-23.
        switching = 4.0, off 0.0;
        /// The same for a road user of a run that leaves the motion it is driving: less than a close approach, so that it
        /// changes its mind for a reason only. Set by hand. 2026-11-27.
        leaving_course = 1.0, off 0.0;
        /// Mean distance from it from which on a motion is another one, metres.
        switching_m = 1.0;
        /// Another mode than the one shown last, however near. Set by hand. 2026-11-22.
        other_mode = 0.1, off 0.0;
        /// An agent that stays at rest and is moved after all: more than an overlap, which the other agent avoids. Set
        /// by hand. 2026-11-27.
        leaving_rest = 7.0, off 0.0;
        /// A reacting road user that gives up the motion it has. Set by hand. 2026-11-21.
        deviating = 0.6, off 0.0;
        /// Mean distance from the motion that it has which costs as much as 1, metres. Set by hand.
        /// 2026-11-21.
        deviation_m = 4.0;
        /// A motion whose rule cost is lower by [`ChoiceTuning::lawful_by`] than that of the future shown
        /// last pays only this share of `switching`. Set by hand. 2026-11-24.
        unlawful_binds = 0.4, off 1.0;
        /// How much less that is, in costs of this choice. Set by hand. 2026-11-24.
        lawful_by = 0.6;
        /// Most that a motion that swerves costs for being another than what was meant. Set by hand. 2026-11-24.
        most_swerving = 3.0, off 1e9;
        /// A motion that stays behind another agent, besides a goal that it misses. Set by hand. 2026-11-27.
        following = 0.8, off 0.0;
        /// Most that a mode costs for being another than what was meant: less than a meeting. Set by hand. 2026-11-27.
        most_central = 3.0, off 1e9;
        /// A motion that stops before what is in the way, besides a goal that it misses. Set by hand. 2026-11-24.
        stopping = 1.0, off 0.0;
        /// Extra weight of the mode that a scene is built around; the probabilities of all modes sum to 1.
        /// Errors and overlaps of further samples on the 71 scenes. 2026-11-22.
        around = 2.0, off 0.0;
    }
    /// Steps of a chosen scene's conflicting drafts out of each other's way.
    guidance: GuidanceTuning {
        /// At most so many; a whole number. Set by hand. 2026-11-21.
        steps = 12.0, off 0.0;
        /// Share of the way downhill taken at each. Set by hand. 2026-11-21.
        share = 0.35, off 0.0;
    }
    /// Plain steps downhill from drafts that conflict, after the last refinement step. Overlaps of a random draw
    /// on 35 of the 71 scenes: 6.1 points fewer without goals, 1.4 with. 2026-11-21.
    overlaps: OverlapTuning {
        /// Rounds; a whole number.
        rounds = 12.0, off 0.0;
        /// Longest share of the way downhill taken at each; a half and a quarter of it are tried after it.
        share = 0.7;
        /// Weight of boxes that soon will be too close.
        soon = 0.3, off 0.0;
        /// A meeting so soon at the velocity of the moment counts: intervals of half a second between instants.
        soon_intervals = 2.0;
        /// Weight of a square metre that a corner is past the road's edge.
        kerb = 0.3, off 0.0;
    }
    /// What each half second of a swerving motion costs in the search for the cheapest one.
    replan: ReplanTuning {
        /// A box that meets another agent's. Set by hand. 2026-11-24.
        met = 8.0, off 0.0;
        /// A box that comes close to another agent's. Set by hand. 2026-11-24.
        close = 0.7, off 0.0;
        /// A corner off the road. Set by hand. 2026-11-24.
        off_road = 2.0, off 0.0;
        /// A lane against the traffic. Set by hand. 2026-11-25.
        against = 1.0, off 0.0;
        /// A place off the lanes. Set by hand. 2026-11-24.
        off_lanes = 0.5, off 0.0;
        /// A square metre aside. Set by hand. 2026-11-24.
        aside = 0.01, off 0.0;
        /// A square metre along the path. Set by hand. 2026-11-24.
        ahead = 0.004, off 0.0;
        /// A square metre of change aside. Set by hand. 2026-11-24.
        drift = 0.25, off 0.0;
        /// A square metre of change along the path. Set by hand. 2026-11-24.
        pace = 0.12, off 0.0;
    }
    /// Which agents may react to regenerated agents, and at what cost.
    reacting: ReactingTuning {
        /// For agents with conditions: motions whose boxes come closer than this within three seconds are
        /// checked, metres. Set by hand. 2026-11-21.
        near_m = 5.0;
        /// Cost of each second later or earlier than without the others. Set by hand. 2026-11-22.
        late = 0.08, off 0.0;
        /// Braking harder than this costs more, m/s2. Set by hand. 2026-11-22.
        easily_mps2 = 3.0;
        /// What each m/s2 beyond costs. Set by hand. 2026-11-22.
        hard = 0.15, off 0.0;
    }
}

impl Default for Tuning {
    fn default() -> Self {
        SHIPPED
    }
}

impl Tuning {
    /// The same with one number changed; without a value, with what the number is for left out.
    ///
    /// # Errors
    /// A name that no number has, a value that is not finite, or none where one is needed.
    pub fn with(mut self, name: &str, value: Option<f64>) -> Result<Self, TuningError> {
        let number = NUMBERS.iter().find(|number| number.name == name);
        let number = number.ok_or_else(|| TuningError::Unknown(name.to_owned()))?;
        let value = value.or(number.off).ok_or(TuningError::NeedsValue(number.name))?;
        if !value.is_finite() {
            return Err(TuningError::NotFinite(number.name));
        }
        *(number.of_mut)(&mut self) = value;
        Ok(self)
    }

    /// Hash of all numbers of planning and generation with their names.
    pub fn hash(&self) -> ContentHash {
        ContentHash::of_bytes(self.text().as_bytes())
    }

    /// One line a number: its name and its value.
    fn text(&self) -> String {
        let mut text = String::new();
        for number in NUMBERS {
            // Writing to a string cannot fail.
            let _ = writeln!(text, "{}={:?}", number.name, (number.of)(self));
        }
        for (name, value) in fixed::ALL {
            let _ = writeln!(text, "{name}={}", value());
        }
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_number_has_its_own_name_and_changes_the_hash() {
        for (i, number) in NUMBERS.iter().enumerate() {
            assert!(NUMBERS[..i].iter().all(|other| other.name != number.name), "{}", number.name);
            let changed = SHIPPED.with(number.name, Some((number.of)(&SHIPPED) + 1.0)).unwrap();
            assert_eq!((number.of)(&changed), (number.of)(&SHIPPED) + 1.0);
            assert_ne!(changed.hash(), SHIPPED.hash(), "{}", number.name);
            let others = NUMBERS.iter().filter(|other| other.name != number.name);
            assert!(others.into_iter().all(|other| (other.of)(&changed) == (other.of)(&SHIPPED)));
        }
    }

    #[test]
    fn constants_are_part_of_the_hash_by_their_own_names() {
        let text = SHIPPED.text();
        let mut names: Vec<&str> = text.lines().filter_map(|line| line.split('=').next()).collect();
        assert_eq!(names.len(), NUMBERS.len() + fixed::ALL.len());
        names.sort_unstable();
        names.dedup();
        assert_eq!(names.len(), NUMBERS.len() + fixed::ALL.len());
        assert!(
            text.contains("\ngiving_way.MITIGATED=0.4\n") && text.contains("\nlights.ROLLING_MPS=[0.0, 2.0,")
        );
    }

    #[test]
    fn a_number_is_left_out_or_given_a_value() {
        assert_eq!(SHIPPED.with("probability.temperature", None).unwrap().probability.temperature, 1.0);
        assert_eq!(SHIPPED.with("choice.overlap", Some(2.0)).unwrap().choice.overlap, 2.0);
        assert_eq!(SHIPPED.with("choice.nothing", None), Err(TuningError::Unknown("choice.nothing".into())));
        let needs = SHIPPED.with("overlaps.share", None);
        assert_eq!(needs, Err(TuningError::NeedsValue("overlaps.share")));
        assert!(SHIPPED.with("overlaps.share", Some(f64::NAN)).is_err());
    }
}
