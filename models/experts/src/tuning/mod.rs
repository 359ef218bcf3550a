//! The tuned numbers, the part of the model that is not learned, in one place.
//!
//! Each one states its meaning, its unit, and what it was fitted on: data, metric, date. "The 71 scenes" are
//! the recorded scenes of the weights' card that are neither in the training data nor in its tables. All were
//! fitted, or set by hand, between 2026-11-21 and 2026-11-27. [`Tuning::hash`] is part of every answer,
//! beside the weights' hashes. `dragtraffic lab eval --ablate NAME[=VALUE]` varies one of them by its name in
//! [`NUMBERS`]. Constants that no call varies are in [`fixed`], and those of placement in [`placing`].

use scene::ContentHash;
use std::fmt::Write;

/// One tuned number by name.
pub struct Number {
    /// Name, `group.name`.
    pub name: &'static str,
    /// The value that disables the number's effect; `None` if there is none.
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
    /// A value is needed, because none disables the number's effect.
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

        /// The shipped values.
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

// After the macro, because both use it.
pub(crate) mod fixed;
pub(crate) mod placing;
pub mod published;

tuning! {
    /// Shapes and paces of anchors.
    anchors: AnchorTuning {
        /// Time over which a walker's initial velocity, mostly sway, decays, seconds. Error of base paths to
        /// goals on the 71 scenes: 0.33 m without it, 0.29 m with it. 2026-11-22.
        walkers_relax_s = 0.8;
        /// Time over which a rider's initial velocity decays, seconds. Error of base paths on the 71 scenes.
        /// 2026-11-22.
        riders_relax_s = 5.0;
        /// Greatest distance of a rider's smooth path to a goal from the route's, metres. Error of base paths
        /// on the 71 scenes. 2026-11-22.
        riders_berth_m = 3.0;
        /// Acceleration of a standing vehicle that sets off towards a goal, m/s2. Longitudinal error of 62
        /// cases of the 71 scenes: 2.2 m if it leaves at once, 1.2 m with this; 1.0 to 1.2 are as good.
        /// 2026-11-22.
        setting_off_mps2 = 1.1;
        /// Length against the rules of the road below which a path to a goal counts as legal, metres: bends
        /// are cut, boxes swing. Set by hand. 2026-11-22.
        broken_m = 2.0;
        /// Metres against the rules to which a metre of additional length is equivalent. Set by hand.
        /// 2026-11-22.
        detour = 0.1, off 0.0;
        /// Greatest heading difference at which a goal on a lane with a free heading is met along the lane,
        /// radians. Set by hand. 2026-11-22.
        along_lane_rad = 1.0, off 0.0;
        /// Time for which learned offsets continue after a goal, seconds. The path follows the lane after the
        /// goal, and few learned cases changed to a lane early. Vehicles on a straight road with a goal in
        /// the other lane before 6 s: without it 74 % of six futures left the road. With it none does, and
        /// they stay in the lane. With goals of recordings 4 s ahead on 30 of the 71 scenes: 8 % left the
        /// road without it, 3 % with it. They are as near to the log (mean of six 10.7 m and 10.6 m).
        /// 2026-11-26.
        after_goal_s = 0.5, off 1e9;
        /// Pace of drivers on a long detour to a goal, m/s. Set by hand. 2026-11-22.
        easy_mps = 13.0;
        /// Factor of the map's speed limit that counts as allowed. Set by hand. 2026-11-21.
        over_limit = 1.15, off 1.0;
    }
    /// Calibration of the modes' probabilities.
    probability: ProbabilityTuning {
        /// Temperature of the probabilities without a fixed goal position: weights learned from simulated
        /// drivers are overconfident on recorded ones. Log loss on the 71 scenes: 1.96 without it, 1.78 with
        /// it. 2026-11-22.
        temperature = 2.5, off 1.0;
        /// Temperature of an answer's probabilities without a goal position, in addition to
        /// [`ProbabilityTuning::temperature`]. Log loss of vehicles on the 71 scenes. 2026-11-27.
        answer_temperature = 1.5, off 1.0;
        /// Share of the probability that is spread evenly over the futures of an answer with a goal position. Log loss of
        /// vehicles on the 71 scenes. 2026-11-27.
        spread_with_goal = 0.5, off 0.0;
        /// Weight of broken rules ([`ChoiceTuning`]) in the logarithm of a future's probability. Error of the
        /// likeliest future of vehicles on the 71 scenes: 6.90 m without a goal, 6.77 m with it, with a speed
        /// as goal 4.98 m and 4.72 m; log loss 1.68 and 1.67, 1.80 and 1.78. Half the weight is as near but
        /// overconfident. 2026-11-26.
        unlawful = 0.25, off 0.0;
    }
    /// Of two coinciding modes the less probable one stops or starts. All on the 71 scenes, minADE of six
    /// without a goal: 0.14 m nearer for vehicles, 0.06 m on foot; neighbouring values are slightly worse.
    /// 2026-11-22.
    duplicates: DuplicateTuning {
        /// Probability of the mode that stops or starts. More would match recorded scenes, where drivers do
        /// so, but draws in which only one agent does so overlap.
        probability = 0.02, off 0.0;
        /// Mean distance below which two modes of a vehicle coincide, metres.
        vehicle_same_m = 2.0, off 0.0;
        /// Mean distance of the changed mode of a vehicle from all others, metres.
        vehicle_apart_m = 3.0;
        /// Rate at which it changes its speed, m/s2.
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
        /// Mean distance below which two modes are copies, metres, without a goal position. One of them then
        /// passes before or after another agent, or takes another pace or line. Set by hand. 2026-11-22.
        copy_m = 1.1, off 0.0;
        /// The same with a goal position. Set by hand. 2026-11-22.
        copy_with_goal_m = 0.55, off 0.0;
    }
    /// Additional spread of futures at the greatest diversity, mean metres in a window; it grows with the
    /// square of the setting. Spread of six at diversity 2 over that at 0.5. 2026-11-22.
    diversity: DiversityTuning {
        /// Longitudinal, for a vehicle without a goal.
        driving_m = 20.0, off 0.0;
        /// Longitudinal, for a rider without a goal.
        riding_m = 9.0, off 0.0;
        /// Longitudinal, on foot without a goal.
        on_foot_m = 2.0, off 0.0;
        /// Longitudinal, to a goal 9 s away, for vehicles and riders.
        goal_m = 4.0, off 0.0;
        /// Longitudinal, to a goal 9 s away, on foot.
        goal_on_foot_m = 1.5, off 0.0;
        /// Lateral, for vehicles and riders.
        aside_m = 0.3, off 0.0;
        /// Lateral, on foot.
        aside_on_foot_m = 0.8, off 0.0;
    }
    /// Speed range over which the networks' output fades out: above it only the anchors' paths and speed
    /// profiles remain.
    speeds: SpeedTuning {
        /// Speed up to which the networks have full weight, m/s. Above it the six futures of a car on an
        /// empty straight motorway begin to leave its lane. 2026-11-26.
        known_mps = 21.0, off 1e3;
        /// Speed from which the networks have no weight, m/s. 2026-11-26.
        unknown_mps = 24.0, off 2e3;
    }
    /// Composition of the mode in the middle of the distribution.
    middle: MiddleTuning {
        /// Share of the learned residual in it; the rest is its anchor's own base. Recorded road users are
        /// closer to the formula than simulated ones. Error of the first answer with a goal position on the
        /// 71 scenes. 2026-11-22.
        learned = 0.5, off 1.0;
        /// The same on foot.
        learned_on_foot = 0.4, off 1.0;
        /// Greatest distance of the end of the last shown motion to the goal for it to stay a candidate,
        /// metres. Set by hand. 2026-11-22.
        same_goal_m = 0.75, off 0.0;
    }
    /// Costs of a candidate in the joint choice; distances to the other modes cost about 1.
    choice: ChoiceTuning {
        /// Two overlapping boxes, on top of [`ChoiceTuning::close`]. Set by hand. 2026-11-21.
        overlap = 5.0, off 0.0;
        /// Two boxes closer than half a metre. Set by hand. 2026-11-21.
        close = 1.5, off 0.0;
        /// Two motions that would soon touch if both continued, at two moments or more: a near miss. Set by
        /// hand. 2026-11-27.
        near_miss = 1.5, off 0.0;
        /// A vehicle off every lane, by the share of the time. Set by hand. 2026-11-21.
        off_lanes = 8.0, off 0.0;
        /// Distance from a lane that counts as off, metres. Set by hand. 2026-11-21.
        off_lanes_m = 2.5;
        /// A vehicle with a corner beyond the road's edges, by the share of the time. Set by hand. 2026-11-21.
        past_edges = 8.0, off 0.0;
        /// Distance beyond the edge that counts, metres. Set by hand. 2026-11-21.
        past_edge_m = 0.1;
        /// A vehicle that leaves the road, or drives against every lane, at any time. It costs as much as a
        /// close approach, so that vehicles do not pass a queue over the kerb. Set by hand. 2026-11-25.
        leaving_the_road = 1.5, off 0.0;
        /// A missed goal: worse than anything but an overlap. Set by hand. 2026-11-21.
        goal_missed = 3.0, off 0.0;
        /// A vehicle against the direction of every lane there, by the share of the time. Set by hand.
        /// 2026-11-22.
        wrong_way = 8.0, off 0.0;
        /// A stop line crossed at red. Set by hand. 2026-11-22.
        red_light = 4.0, off 0.0;
        /// Braking or lateral acceleration above which a wheeled motion is harsh, as in the judge, m/s2. Set
        /// by hand. 2026-11-23.
        harsh_mps2 = 4.0;
        /// A harsh motion of any duration. Set by hand. 2026-11-23.
        harsh = 0.4, off 0.0;
        /// Each second of harsh motion. Set by hand. 2026-11-23.
        harsh_second = 0.4, off 0.0;
        /// A walker that steps out in front of a vehicle that would have to brake hard. Set by hand.
        /// 2026-11-23.
        stepping_out = 1.5, off 0.0;
        /// Switching from the last shown future while the user drags a goal: less than an overlap, more than
        /// the difference between modes. Jumps over 1 m when a goal moves by 5 cm, on drags of the 71 scenes:
        /// 2.7 % at 3, 2.3 % at 4. 2026-11-23.
        switching = 4.0, off 0.0;
        /// The same for a road user of a run that leaves its present motion. It is less than a close
        /// approach, so that road users change their motion only for a reason. Set by hand. 2026-11-27.
        leaving_course = 1.0, off 0.0;
        /// Mean distance from which a motion counts as another one, metres.
        switching_m = 1.0;
        /// Another mode than the last shown one, however near. Set by hand. 2026-11-22.
        other_mode = 0.1, off 0.0;
        /// An agent that stays at rest but is moved: more than an overlap, which the other agent avoids. Set
        /// by hand. 2026-11-27.
        leaving_rest = 7.0, off 0.0;
        /// A reacting road user that gives up its motion. Set by hand. 2026-11-21.
        deviating = 0.6, off 0.0;
        /// Mean distance from its motion that costs 1, metres. Set by hand. 2026-11-21.
        deviation_m = 4.0;
        /// Share of `switching` for a motion whose rule cost is lower by [`ChoiceTuning::lawful_by`] than
        /// that of the last shown future. Set by hand. 2026-11-24.
        unlawful_binds = 0.4, off 1.0;
        /// That difference of rule costs. Set by hand. 2026-11-24.
        lawful_by = 0.6;
        /// Greatest cost of a swerving motion for its distance from the modes. Set by hand. 2026-11-24.
        most_swerving = 3.0, off 1e9;
        /// A motion that follows another agent, besides a missed goal. Set by hand. 2026-11-27.
        following = 0.8, off 0.0;
        /// Greatest cost of a mode for its distance from the modes: less than an encounter. Set by hand.
        /// 2026-11-27.
        most_central = 3.0, off 1e9;
        /// A motion that stops before an obstacle, besides a missed goal. Set by hand. 2026-11-24.
        stopping = 1.0, off 0.0;
        /// Extra weight of the mode that a scene is built around; the probabilities of all modes sum to 1.
        /// Errors and overlaps of further samples on the 71 scenes. 2026-11-22.
        around = 2.0, off 0.0;
    }
    /// Gradient steps that move conflicting drafts of a chosen scene apart.
    guidance: GuidanceTuning {
        /// Most steps; a whole number. Set by hand. 2026-11-21.
        steps = 12.0, off 0.0;
        /// Share of the gradient taken at each step. Set by hand. 2026-11-21.
        share = 0.35, off 0.0;
    }
    /// Gradient steps from conflicting drafts, after the last refinement step. Overlaps of a random draw on
    /// 35 of the 71 scenes: 6.1 points fewer without goals, 1.4 with. 2026-11-21.
    overlaps: OverlapTuning {
        /// Most rounds; a whole number.
        rounds = 12.0, off 0.0;
        /// Largest share of the gradient taken at each step; a half and a quarter of it are tried next.
        share = 0.7;
        /// Weight of boxes that will soon be too close.
        soon = 0.3, off 0.0;
        /// Time ahead at the present velocity that counts as soon: intervals of half a second between
        /// instants.
        soon_intervals = 2.0;
        /// Weight per square metre of a corner past the road's edge.
        kerb = 0.3, off 0.0;
    }
    /// Costs of each half second of a swerving motion in the search for the cheapest one.
    replan: ReplanTuning {
        /// A box that overlaps another agent's. Set by hand. 2026-11-24.
        met = 8.0, off 0.0;
        /// A box that comes close to another agent's. Set by hand. 2026-11-24.
        close = 0.7, off 0.0;
        /// A corner off the road. Set by hand. 2026-11-24.
        off_road = 2.0, off 0.0;
        /// A lane in the opposite direction. Set by hand. 2026-11-25.
        against = 1.0, off 0.0;
        /// A place off the lanes. Set by hand. 2026-11-24.
        off_lanes = 0.5, off 0.0;
        /// Lateral shift, per square metre. Set by hand. 2026-11-24.
        aside = 0.01, off 0.0;
        /// Longitudinal shift, per square metre. Set by hand. 2026-11-24.
        ahead = 0.004, off 0.0;
        /// Change of the lateral shift, per square metre. Set by hand. 2026-11-24.
        drift = 0.25, off 0.0;
        /// Change of the longitudinal shift, per square metre. Set by hand. 2026-11-24.
        pace = 0.12, off 0.0;
    }
    /// Which agents may react to regenerated agents, and at what cost.
    reacting: ReactingTuning {
        /// For agents with conditions: motions whose boxes come closer than this within three seconds are
        /// checked, metres. Set by hand. 2026-11-21.
        near_m = 5.0;
        /// Each second later or earlier than without the others. Set by hand. 2026-11-22.
        late = 0.08, off 0.0;
        /// Braking above which giving way costs more, m/s2. Set by hand. 2026-11-22.
        easily_mps2 = 3.0;
        /// Each m/s2 beyond that. Set by hand. 2026-11-22.
        hard = 0.15, off 0.0;
        /// Each second at a time headway below 0.9 s. Set by hand. 2026-12-01.
        tailgating = 0.2, off 0.0;
    }
}

impl Default for Tuning {
    fn default() -> Self {
        SHIPPED
    }
}

impl Tuning {
    /// The same with one number changed; without a value, with the number's effect disabled.
    ///
    /// # Errors
    /// An unknown name, a value that is not finite, or a missing value that is needed.
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

    /// One line per number: its name and its value.
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
