//! Parameters of a map: one struct a kind of layout, with ranges and defaults.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Fewest and most arms that meet.
pub const ARMS: (usize, usize) = (3, 6);
/// Least width of a strip, metres; a narrower one is left out.
const LEAST_STRIP_M: f64 = 0.5;
/// Least angle between two arms, degrees.
pub const LEAST_BETWEEN_ARMS_DEG: f64 = 20.0;

/// Side of the road on which traffic drives.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
#[allow(missing_docs, reason = "the names say it")]
pub enum Traffic {
    #[default]
    RightHand,
    LeftHand,
}

/// Right of way at a junction.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Control {
    /// Traffic lights.
    #[default]
    Signals,
    /// Stop signs at the arms that are not main.
    Priority,
    /// Stop signs at all arms.
    Equal,
}

/// Left turns (right turns in left-hand traffic) while oncoming traffic has green.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum TurnAcross {
    /// They have green at the same time and give way.
    #[default]
    Permissive,
    /// They have a separate phase.
    Protected,
}

/// A direction out of a junction, as seen from the entry.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
#[allow(missing_docs, reason = "the names say it")]
pub enum Turn {
    Left,
    Straight,
    Right,
}

impl Turn {
    /// The turn in the mirror image.
    #[must_use]
    pub(crate) fn mirrored(self) -> Self {
        match self {
            Self::Left => Self::Right,
            Self::Straight => Self::Straight,
            Self::Right => Self::Left,
        }
    }
}

/// Signal program of a junction, whose phases repeat in a cycle.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Program {
    /// Green of each phase, seconds.
    #[schemars(range(min = 4.0, max = 60.0))]
    pub green_s: f64,
    /// Yellow after each green, seconds.
    #[schemars(range(min = 2.0, max = 6.0))]
    pub yellow_s: f64,
    /// All-red time before the next green, seconds.
    #[schemars(range(min = 0.5, max = 5.0))]
    pub all_red_s: f64,
    /// Time for which the first green has been on at the start of the scene, seconds.
    #[schemars(range(min = 0.0, max = 600.0))]
    pub offset_s: f64,
    /// Phases of turns across oncoming traffic.
    pub turns_across: TurnAcross,
}

impl Default for Program {
    /// Both directions have green within the first nine seconds.
    fn default() -> Self {
        Self {
            green_s: 10.0,
            yellow_s: 3.0,
            all_red_s: 1.0,
            offset_s: 7.0,
            turns_across: TurnAcross::Permissive,
        }
    }
}

/// A road that leads to a junction, as seen from the junction.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Arm {
    /// Direction from the junction, counter-clockwise from east, degrees.
    #[schemars(range(min = -360.0, max = 360.0))]
    pub angle_deg: f64,
    /// Length from the centre of the junction to the edge of the map, metres; longer where the junction needs
    /// it.
    #[schemars(range(min = 40.0, max = 200.0))]
    pub length_m: f64,
    /// Number of inbound lanes, towards the junction.
    #[schemars(range(max = 5))]
    pub lanes_in: u8,
    /// Number of outbound lanes, away from the junction.
    #[schemars(range(max = 5))]
    pub lanes_out: u8,
    /// Allowed turns of each inbound lane, in order from the middle of the road to the kerb; null selects the
    /// usual turns.
    #[schemars(length(max = 5))]
    pub turns: Option<Vec<Vec<Turn>>>,
    /// Speed limit, km/h.
    #[schemars(range(min = 10.0, max = 130.0))]
    pub speed_limit_kmh: f64,
    /// Width of the cycle lane on each side, metres; below half a metre there is none.
    #[schemars(range(min = 0.0, max = 3.0))]
    pub cycle_lane_m: f64,
    /// Width of the raised median, metres; below half a metre there is none.
    #[schemars(range(min = 0.0, max = 10.0))]
    pub median_m: f64,
    /// Width of the crosswalk across it, metres; below half a metre there is none.
    #[schemars(range(min = 0.0, max = 8.0))]
    pub crosswalk_m: f64,
    /// With `priority`: its traffic has right of way.
    pub main: bool,
}

impl Default for Arm {
    fn default() -> Self {
        Self {
            angle_deg: 0.0,
            length_m: 90.0,
            lanes_in: 1,
            lanes_out: 1,
            turns: None,
            speed_limit_kmh: 50.0,
            cycle_lane_m: 0.0,
            median_m: 0.0,
            crosswalk_m: 3.0,
            main: false,
        }
    }
}

impl Arm {
    /// An arm with this angle and these numbers of lanes.
    pub(crate) fn leading(angle_deg: f64, lanes_in: u8, lanes_out: u8) -> Self {
        Self { angle_deg, lanes_in, lanes_out, ..Self::default() }
    }
}

/// A path from an inbound lane to an outbound lane, which for a U-turn is of the same arm. Arms count in the order of
/// the parameters, lanes from the middle of the road to the kerb: from 0 here, from 1 in the ids of lanes that documents
/// have.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(try_from = "LaneIds", into = "LaneIds")]
#[schemars(with = "LaneIds")]
pub struct Connection {
    /// Arm and lane that it comes from.
    pub from: [usize; 2],
    /// Arm and lane that it leads to.
    pub to: [usize; 2],
}

/// A way through a junction by the ids of its lanes.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Connection")]
struct LaneIds {
    /// Inbound lane, such as `arm2.in1`: the lane of the second arm next to the middle of the road.
    #[schemars(regex(pattern = r"^arm[1-6]\.in[1-5]$"))]
    from: String,
    /// Outbound lane, such as `arm3.out1`.
    #[schemars(regex(pattern = r"^arm[1-6]\.out[1-5]$"))]
    to: String,
}

impl TryFrom<LaneIds> for Connection {
    type Error = String;

    fn try_from(ids: LaneIds) -> Result<Self, String> {
        let lane = |id: &str, word: &str| {
            let (arm, lane) = id.strip_prefix("arm")?.split_once(word)?;
            let index = |count: &str| count.parse::<u8>().ok()?.checked_sub(1).map(usize::from);
            Some([index(arm)?, index(lane)?])
        };
        match (lane(&ids.from, ".in"), lane(&ids.to, ".out")) {
            (Some(from), Some(to)) => Ok(Self { from, to }),
            _ => Err("ids of lanes expected, such as arm2.in1 in from and arm3.out1 in to".into()),
        }
    }
}

impl From<Connection> for LaneIds {
    fn from(Connection { from, to }: Connection) -> Self {
        Self {
            from: format!("arm{}.in{}", from[0] + 1, from[1] + 1),
            to: format!("arm{}.out{}", to[0] + 1, to[1] + 1),
        }
    }
}

impl Connection {
    /// Whether the arms have its lane towards the junction, and its lane away from it.
    pub(crate) fn is_of(&self, arms: &[Arm]) -> [bool; 2] {
        let lanes = |[arm, lane]: [usize; 2], count: fn(&Arm) -> u8| {
            arms.get(arm).is_some_and(|arm| lane < usize::from(count(arm)))
        };
        [lanes(self.from, |arm| arm.lanes_in), lanes(self.to, |arm| arm.lanes_out)]
    }
}

/// Paths through a junction that are added to, or removed from, those of its turn lanes.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Connections {
    /// Added paths.
    #[schemars(length(max = 64))]
    pub added: Vec<Connection>,
    /// Removed paths.
    #[schemars(length(max = 64))]
    pub removed: Vec<Connection>,
}

impl Connections {
    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.added.is_empty() && self.removed.is_empty()
    }
}

/// Roads that meet at grade.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Junction {
    /// 3 to 6 arms, at least 20 degrees apart.
    #[schemars(length(min = 3, max = 6))]
    pub arms: Vec<Arm>,
    /// Single connections through the junction, in addition to those of the turn lanes.
    #[serde(skip_serializing_if = "Connections::is_empty")]
    pub connections: Connections,
    /// Right of way at the junction.
    pub control: Control,
    /// Signal program, with `signals`.
    pub program: Program,
    /// Radius of the kerbs at corners, metres; less where arms are too close for it.
    #[schemars(range(min = 3.0, max = 20.0))]
    pub kerb_radius_m: f64,
    /// Width of lanes, metres.
    #[schemars(range(min = 2.5, max = 4.0))]
    pub lane_width_m: f64,
    /// Width of the pavements, metres; below half a metre there are none.
    #[schemars(range(min = 0.0, max = 4.0))]
    pub sidewalk_m: f64,
    /// Side of the road on which traffic drives.
    pub traffic: Traffic,
}

impl Default for Junction {
    fn default() -> Self {
        let wide = |angle_deg| Arm { cycle_lane_m: 1.8, main: true, ..Arm::leading(angle_deg, 2, 2) };
        Self {
            arms: vec![wide(3.0), Arm::leading(92.0, 2, 1), wide(182.0), Arm::leading(272.0, 1, 1)],
            connections: Connections::default(),
            control: Control::Signals,
            program: Program::default(),
            kerb_radius_m: 8.0,
            lane_width_m: 3.25,
            sidewalk_m: 2.5,
            traffic: Traffic::RightHand,
        }
    }
}

impl Junction {
    pub(crate) fn three_arms() -> Self {
        let main = |angle_deg| Arm { main: true, ..Arm::leading(angle_deg, 1, 1) };
        let side = Arm { speed_limit_kmh: 30.0, ..Arm::leading(270.0, 1, 1) };
        Self { arms: vec![main(0.0), main(180.0), side], control: Control::Priority, ..Self::default() }
    }
}

/// Roads that meet at a ring.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Roundabout {
    /// 3 to 6 arms, at least 20 degrees apart.
    #[schemars(length(min = 3, max = 6))]
    pub arms: Vec<Arm>,
    /// Radius of the island in the middle, metres; more where the arms need it.
    #[schemars(range(min = 6.0, max = 40.0))]
    pub island_radius_m: f64,
    /// Number of lanes of the ring.
    #[schemars(range(min = 1, max = 2))]
    pub ring_lanes: u8,
    /// Width of the lanes of the ring, metres.
    #[schemars(range(min = 3.5, max = 6.0))]
    pub ring_lane_width_m: f64,
    /// Speed limit of the ring, km/h.
    #[schemars(range(min = 10.0, max = 60.0))]
    pub ring_speed_limit_kmh: f64,
    /// Radius of the kerbs at corners, metres; less where arms are too close for it.
    #[schemars(range(min = 3.0, max = 20.0))]
    pub kerb_radius_m: f64,
    /// Width of lanes, metres.
    #[schemars(range(min = 2.5, max = 4.0))]
    pub lane_width_m: f64,
    /// Width of the pavements, metres; below half a metre there are none.
    #[schemars(range(min = 0.0, max = 4.0))]
    pub sidewalk_m: f64,
    /// Side of the road on which traffic drives.
    pub traffic: Traffic,
}

impl Default for Roundabout {
    fn default() -> Self {
        let arm = |angle_deg| Arm { median_m: 2.0, ..Arm::leading(angle_deg, 1, 1) };
        Self {
            arms: vec![arm(0.0), arm(90.0), arm(180.0), arm(270.0)],
            island_radius_m: 12.0,
            ring_lanes: 1,
            ring_lane_width_m: 5.0,
            ring_speed_limit_kmh: 30.0,
            kerb_radius_m: 12.0,
            lane_width_m: 3.25,
            sidewalk_m: 2.5,
            traffic: Traffic::RightHand,
        }
    }
}

/// A carriageway of one direction with a ramp that joins it, one that leaves it, or both.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Merge {
    /// Through lanes.
    #[schemars(range(min = 1, max = 5))]
    pub lanes: u8,
    /// Whether a ramp joins.
    pub on_ramp: bool,
    /// Whether a ramp leaves, upstream of the one that joins.
    pub off_ramp: bool,
    /// Length of the parallel lane for acceleration or deceleration, metres.
    #[schemars(range(min = 40.0, max = 400.0))]
    pub parallel_m: f64,
    /// Angle between ramp and carriageway, degrees.
    #[schemars(range(min = 4.0, max = 30.0))]
    pub ramp_angle_deg: f64,
    /// Speed limit, km/h.
    #[schemars(range(min = 30.0, max = 130.0))]
    pub speed_limit_kmh: f64,
    /// Speed limit of the ramps, km/h.
    #[schemars(range(min = 20.0, max = 100.0))]
    pub ramp_speed_limit_kmh: f64,
    /// Width of lanes, metres.
    #[schemars(range(min = 2.5, max = 4.0))]
    pub lane_width_m: f64,
    /// Side of the road on which traffic drives.
    pub traffic: Traffic,
}

impl Default for Merge {
    fn default() -> Self {
        Self {
            lanes: 2,
            on_ramp: true,
            off_ramp: false,
            parallel_m: 150.0,
            ramp_angle_deg: 10.0,
            speed_limit_kmh: 100.0,
            ramp_speed_limit_kmh: 60.0,
            lane_width_m: 3.5,
            traffic: Traffic::RightHand,
        }
    }
}

/// One road, straight or bent.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Road {
    /// Length, metres; more where the bend needs it.
    #[schemars(range(min = 40.0, max = 800.0))]
    pub length_m: f64,
    /// Change of direction, degrees, positive to the left; 0 is straight.
    #[schemars(range(min = -170.0, max = 170.0))]
    pub bend_deg: f64,
    /// Radius of the bend in the middle of the road, metres; more where the road is too wide for it.
    #[schemars(range(min = 15.0, max = 500.0))]
    pub radius_m: f64,
    /// Lanes in the forward direction, which is east at the start of the road.
    #[schemars(range(min = 1, max = 5))]
    pub lanes_forward: u8,
    /// Lanes in the opposite direction.
    #[schemars(range(max = 5))]
    pub lanes_backward: u8,
    /// Speed limit, km/h.
    #[schemars(range(min = 10.0, max = 130.0))]
    pub speed_limit_kmh: f64,
    /// Width of the cycle lane on each side, metres; below half a metre there is none.
    #[schemars(range(min = 0.0, max = 3.0))]
    pub cycle_lane_m: f64,
    /// Width of the parking strip on each side, metres; below half a metre there is none.
    #[schemars(range(min = 0.0, max = 3.0))]
    pub parking_m: f64,
    /// Width of the raised median, metres; below half a metre there is none.
    #[schemars(range(min = 0.0, max = 10.0))]
    pub median_m: f64,
    /// Width of the crosswalk half way along the road, metres; below half a metre there is none.
    #[schemars(range(min = 0.0, max = 8.0))]
    pub crosswalk_m: f64,
    /// Whether speed bumps lie before and after the crosswalk.
    pub speed_bumps: bool,
    /// Width of lanes, metres.
    #[schemars(range(min = 2.5, max = 4.0))]
    pub lane_width_m: f64,
    /// Width of the pavements, metres; below half a metre there are none.
    #[schemars(range(min = 0.0, max = 4.0))]
    pub sidewalk_m: f64,
    /// Side of the road on which traffic drives.
    pub traffic: Traffic,
}

impl Default for Road {
    fn default() -> Self {
        Self {
            length_m: 200.0,
            bend_deg: 0.0,
            radius_m: 60.0,
            lanes_forward: 2,
            lanes_backward: 2,
            speed_limit_kmh: 50.0,
            cycle_lane_m: 0.0,
            parking_m: 0.0,
            median_m: 0.0,
            crosswalk_m: 0.0,
            speed_bumps: false,
            lane_width_m: 3.25,
            sidewalk_m: 2.5,
            traffic: Traffic::RightHand,
        }
    }
}

impl Road {
    pub(crate) fn curve() -> Self {
        Self { bend_deg: 80.0, lanes_forward: 1, lanes_backward: 1, lane_width_m: 3.5, ..Self::default() }
    }

    pub(crate) fn school_street() -> Self {
        Self {
            length_m: 160.0,
            lanes_forward: 1,
            lanes_backward: 1,
            speed_limit_kmh: 30.0,
            parking_m: 2.3,
            crosswalk_m: 4.0,
            speed_bumps: true,
            lane_width_m: 3.0,
            sidewalk_m: 3.0,
            ..Self::default()
        }
    }
}

/// A street with a car park beside it: its entrance is at one end, its exit at the other, with aisles between
/// them.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct CarPark {
    /// Number of aisles with bays on both sides.
    #[schemars(range(min = 1, max = 6))]
    pub aisles: u8,
    /// Number of bays along each side of an aisle.
    #[schemars(range(min = 3, max = 30))]
    pub bays: u8,
    /// Width of a bay, metres.
    #[schemars(range(min = 2.3, max = 3.5))]
    pub bay_width_m: f64,
    /// Length of a bay, metres.
    #[schemars(range(min = 4.5, max = 6.5))]
    pub bay_length_m: f64,
    /// Width of the aisles, metres.
    #[schemars(range(min = 3.5, max = 7.0))]
    pub aisle_m: f64,
    /// Speed limit of the street, km/h.
    #[schemars(range(min = 10.0, max = 130.0))]
    pub speed_limit_kmh: f64,
    /// Radius of the kerbs at corners, metres.
    #[schemars(range(min = 3.0, max = 12.0))]
    pub kerb_radius_m: f64,
    /// Width of the lanes of the street, metres.
    #[schemars(range(min = 2.5, max = 4.0))]
    pub lane_width_m: f64,
    /// Width of the pavements, metres; below half a metre there are none.
    #[schemars(range(min = 0.0, max = 4.0))]
    pub sidewalk_m: f64,
    /// Side of the road on which traffic drives.
    pub traffic: Traffic,
}

impl Default for CarPark {
    fn default() -> Self {
        Self {
            aisles: 3,
            bays: 12,
            bay_width_m: 2.5,
            bay_length_m: 5.0,
            aisle_m: 5.5,
            speed_limit_kmh: 50.0,
            kerb_radius_m: 6.0,
            lane_width_m: 3.25,
            sidewalk_m: 2.5,
            traffic: Traffic::RightHand,
        }
    }
}

/// Removes a strip that is too narrow.
fn strip(width_m: &mut f64) {
    if *width_m < LEAST_STRIP_M {
        *width_m = 0.0;
    }
}

fn arm_strips(arms: &mut [Arm]) {
    for arm in arms {
        [&mut arm.cycle_lane_m, &mut arm.median_m, &mut arm.crosswalk_m].into_iter().for_each(strip);
    }
}

impl Junction {
    pub(crate) fn without_slivers(mut self) -> Self {
        arm_strips(&mut self.arms);
        strip(&mut self.sidewalk_m);
        self
    }
}

impl Roundabout {
    pub(crate) fn without_slivers(mut self) -> Self {
        arm_strips(&mut self.arms);
        strip(&mut self.sidewalk_m);
        self
    }
}

impl Road {
    pub(crate) fn without_slivers(mut self) -> Self {
        let widths = [&mut self.cycle_lane_m, &mut self.parking_m, &mut self.median_m, &mut self.crosswalk_m];
        widths.into_iter().chain([&mut self.sidewalk_m]).for_each(strip);
        self
    }
}

impl CarPark {
    pub(crate) fn without_slivers(mut self) -> Self {
        strip(&mut self.sidewalk_m);
        self
    }
}
