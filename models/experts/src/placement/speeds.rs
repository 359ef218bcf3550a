//! Speeds of the placed agents. They are drawn last, nearest to a conflict first and leaders before
//! followers, so that each follower knows its leader's speed.

use super::cells::Cells;
use super::checks::KindOnLane;
use super::context::SpeedContext;
use super::driving::{SpeedRange, allowed_mps, leader_ahead, usual_mps};
use super::model::{PlacementModel, SPEED_STEP, TypeModel};
use super::placed::{PlacedAgent, rounded};
use super::random::{self, stream_name};
use super::room::{DrivenBox, bend_mps, brakes_from, make_room};
use super::stop_lines::{LineAhead, STOP_LINE_M, StopControl};
use crate::tuning::placing::speeds::{CYCLIST_MPS, OFF_LANES, QUEUE_M, UNKNOWN_LEADER_MPS};
use scene::limits::Limits;
use scene::random::Stream;
use scene::routes::speed::Obstacle;
use scene::{AgentType, STANDING_MPS, Subtype};
use std::collections::{BTreeMap, HashSet};

/// Resolution of speeds, m/s.
const ROUNDING_MPS: f64 = 1e-3;

/// Draws the speeds of one answer.
pub(super) struct StartSpeeds<'a> {
    pub(super) seed: u64,
    pub(super) model: Option<&'a PlacementModel>,
    pub(super) cells: &'a Cells<'a>,
    pub(super) placed: &'a [PlacedAgent],
    /// Number of kept road users; their speeds stay.
    pub(super) kept: usize,
    /// Kept road users, then the placed ones in order.
    pub(super) obstacles: Vec<Obstacle>,
    /// For each obstacle its type, and for drivers lane and arc length.
    pub(super) kinds: &'a [KindOnLane],
    /// Range of the start speeds of moving motor vehicles; `None` keeps the drawn speeds.
    pub(super) range: Option<SpeedRange>,
}

impl StartSpeeds<'_> {
    /// Speed of each placed agent, m/s; `None` if no speed in the range is possible, or if none leaves room
    /// to brake. The second value counts the latter by type.
    pub(super) fn draw(mut self) -> (Vec<Option<f64>>, BTreeMap<AgentType, usize>) {
        let mut order: Vec<(f64, usize)> = Vec::new();
        for (i, placed) in self.placed.iter().enumerate() {
            let ahead = placed.lane.map(|l| self.cells.lights.ahead(self.cells.graph, l, placed.pose.s_m));
            let distance_m = match ahead {
                Some(LineAhead::Inside(_)) => 0.0,
                Some(ahead) => ahead.stop_m(),
                None => 0.0,
            };
            self.obstacles[self.kept + i].speed_mps =
                if placed.lane.is_some() { UNKNOWN_LEADER_MPS } else { 0.0 };
            order.push((distance_m, i));
        }
        order.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let mut begun = HashSet::new();
        for (_, i) in order {
            self.draw_after_leader(i, &mut begun);
        }
        let mut movers: Vec<DrivenBox> = (0..self.obstacles.len()).map(|i| self.mover(i)).collect();
        let left_out = make_room(self.cells.graph, &mut movers);
        let (movers, left_out) = (&movers[self.kept..], &left_out[self.kept..]);
        let mut no_room = BTreeMap::new();
        for (mover, _) in movers.iter().zip(left_out).filter(|(_, out)| **out) {
            *no_room.entry(mover.agent_type).or_default() += 1;
        }
        let speeds = movers.iter().zip(left_out).zip(self.placed).map(|((mover, out), placed)| {
            // Rounded down, because rounding up could take away the room.
            let speed_mps = rounded((mover.speed_mps / ROUNDING_MPS + 1e-6).floor() * ROUNDING_MPS, 1e3);
            (!out && self.may_start(placed, speed_mps)).then_some(speed_mps)
        });
        (speeds.collect(), no_room)
    }

    /// An obstacle as a road user that needs room.
    fn mover(&self, i: usize) -> DrivenBox {
        let Obstacle { outline, speed_mps } = self.obstacles[i];
        let (agent_type, lane) = self.kinds[i];
        let subtype = i.checked_sub(self.kept).map_or_else(Subtype::default, |at| self.placed[at].subtype);
        let limits = Limits::of(agent_type, subtype, 2.0 * outline.half_length_m());
        DrivenBox { agent_type, limits, outline, speed_mps, lane, kept: i < self.kept }
    }

    /// Draws the speed of one road user, after that of its leader. A ring of leaders is cut where it began.
    fn draw_after_leader(&mut self, i: usize, begun: &mut HashSet<usize>) {
        if !begun.insert(i) {
            return;
        }
        let placed = &self.placed[i];
        let mut stream = random::stream(self.seed, &format!("{} speed", stream_name(placed.agent_type)), i);
        let own = self.kept + i;
        let speed_mps = match placed.lane {
            Some(lane) => {
                let s_m = placed.pose.s_m;
                let outline = self.obstacles[own].outline;
                // The path to the leader begins at the agent's own centre, where nothing else can be. Its own
                // box is too near to count as ahead.
                let leader = leader_ahead(self.cells.graph, lane, s_m, &outline, &self.obstacles);
                if let Some(index) = leader.and_then(|l| l.index.checked_sub(self.kept)) {
                    self.draw_after_leader(index, begun);
                }
                let leader = leader.map(|l| {
                    let aligned = l.speed_mps > 0.0;
                    (l.gap_m, if aligned { self.obstacles[l.index].speed_mps } else { 0.0 })
                });
                self.drive_speed(i, lane, leader, &mut stream)
            }
            None => self.walk_speed(i, &mut stream),
        };
        self.obstacles[own].speed_mps = rounded(speed_mps, 1e3);
    }

    /// Whether a speed is allowed: a motor vehicle on a lane stands, or is at least as fast as the range demands.
    fn may_start(&self, placed: &PlacedAgent, speed_mps: f64) -> bool {
        let asked = placed.lane.is_some() && placed.agent_type == AgentType::Vehicle;
        let slow = |range: SpeedRange| speed_mps > 0.0 && speed_mps < range.min_mps - ROUNDING_MPS;
        !(asked && self.range.is_some_and(slow))
    }

    fn drive_speed(&self, i: usize, lane: usize, leader: Option<(f64, f64)>, stream: &mut Stream) -> f64 {
        let placed = &self.placed[i];
        let limits = Limits::of(placed.agent_type, placed.subtype, placed.size.length_m);
        let range = self.range.filter(|_| placed.agent_type == AgentType::Vehicle);
        let model = self.model.and_then(|m| m.types.get(&placed.agent_type));
        if model.is_none() && placed.free_mps.is_none() {
            let limit_mps = self.cells.graph.lanes()[lane].speed_limit_mps;
            let most = if placed.agent_type == AgentType::Cyclist { CYCLIST_MPS } else { limits.speed_mps };
            let speed_mps = limit_mps.min(most);
            return range.map_or(speed_mps, |r| speed_mps.clamp(r.min_mps, r.max_mps).min(most));
        }
        let ahead = self.cells.lights.ahead(self.cells.graph, lane, placed.pose.s_m);
        let unit_mps = allowed_mps(self.cells.graph, lane, placed.pose.s_m, placed.agent_type);
        let mut most = limits.speed_mps.min(bend_mps(self.cells.graph, &self.mover(self.kept + i)));
        if let LineAhead::StopLine(StopControl::Red | StopControl::StopSign, m) = ahead {
            most = most.min(brakes_from(&limits, m - 0.5 * placed.size.length_m - STOP_LINE_M, 0.0));
        }
        let drawn = match (placed.free_mps, model) {
            (Some(free_mps), _) => free_mps,
            (None, Some(model)) => {
                let context = SpeedContext::driver(ahead.road_ahead(), leader);
                // An agent stands on a free road or inside a junction only for a cause in the scene.
                let queues = leader.is_some_and(|(gap_m, _)| gap_m < QUEUE_M);
                let free = matches!(ahead, LineAhead::Inside(_)) || !ahead.queues() && !queues;
                let slowest = usize::from(free);
                drawn_speed(model, context, slowest, unit_mps, f64::INFINITY, stream)
            }
            (None, None) => unit_mps,
        };
        // Standing agents stay: the speed range does not dissolve a queue.
        let wanted = match range {
            Some(range) if drawn > 0.0 => drawn.clamp(range.min_mps, range.max_mps),
            _ => drawn,
        };
        standing_or(wanted.min(most))
    }

    fn walk_speed(&self, i: usize, stream: &mut Stream) -> f64 {
        let placed = &self.placed[i];
        if placed.agent_type == AgentType::Vehicle {
            return 0.0;
        }
        let most = Limits::of(placed.agent_type, placed.subtype, placed.size.length_m).speed_mps;
        let unit_mps = usual_mps(placed.agent_type);
        match self.model.and_then(|m| m.types.get(&placed.agent_type)) {
            Some(model) => placed
                .kind
                .speed_context()
                .map_or(0.0, |context| drawn_speed(model, context, 0, unit_mps, most, stream)),
            None => OFF_LANES * unit_mps,
        }
    }
}

/// A speed for the situation, or for the next more general one that is known. Its class is `slowest` (0
/// stands) or faster, and the speed at most `most` m/s.
fn drawn_speed(
    model: &TypeModel,
    context: SpeedContext,
    slowest: usize,
    unit_mps: f64,
    most: f64,
    stream: &mut Stream,
) -> f64 {
    let rows = context.with_broader().filter_map(|context| model.speed.get(&context));
    let mut rows = rows.map(|row| row.iter().enumerate().map(|(c, w)| if c < slowest { 0.0 } else { *w }));
    let known = rows.find(|row| row.clone().any(|weight| weight > 0.0));
    let class = known.and_then(|row| stream.among(row)).unwrap_or(0);
    let part = stream.unit();
    if class == 0 {
        return 0.0;
    }
    standing_or((unit_mps * SPEED_STEP * (class as f64 - 1.0 + part)).min(most))
}

fn standing_or(speed_mps: f64) -> f64 {
    if speed_mps < STANDING_MPS { 0.0 } else { speed_mps }
}

#[cfg(test)]
mod tests {
    use super::*;

    use crate::placement::context::RoadAhead;
    use crate::placement::model::SPEED_CLASSES;

    fn only(class: usize) -> Vec<f64> {
        (0..SPEED_CLASSES).map(|c| f64::from(u8::from(c == class))).collect()
    }

    #[test]
    fn an_unknown_situation_falls_back_on_a_more_general_one() {
        let known = SpeedContext::driver(RoadAhead::Clear, None);
        let mut model = TypeModel::default();
        model.speed.insert(known, only(0));
        model.speed.insert(SpeedContext::DriverAnyLeader(RoadAhead::Clear), only(10));
        model.speed.insert(SpeedContext::AnyDriver, only(3));
        let mut stream = random::stream(1, "test", 0);
        let mut drawn = |context, most| drawn_speed(&model, context, 0, 10.0, most, &mut stream);
        assert_eq!(drawn(known, 40.0), 0.0);
        let follows = drawn(SpeedContext::driver(RoadAhead::Clear, Some((3.0, 0.0))), 40.0);
        assert!((6.3..=7.0).contains(&follows), "class 10 of 10 m/s, {follows} found");
        let red = drawn(SpeedContext::driver(RoadAhead::RedWithin10M, None), 40.0);
        assert!((1.4..=2.1).contains(&red), "class 3 of 10 m/s, {red} found");
        assert_eq!(drawn(SpeedContext::Pavement, 40.0), 0.0, "nothing was learned there");
        assert_eq!(drawn(SpeedContext::driver(RoadAhead::Clear, Some((3.0, 0.0))), 2.5), 2.5);
        assert_eq!(drawn(SpeedContext::driver(RoadAhead::Clear, Some((3.0, 0.0))), 0.1), 0.0, "it stands");
    }

    #[test]
    fn who_does_not_stand_is_drawn_from_the_rest_of_what_is_known() {
        let known = SpeedContext::driver(RoadAhead::Junction, None);
        let mut model = TypeModel::default();
        model.speed.insert(known, only(0));
        model
            .speed
            .insert(SpeedContext::AnyDriver, (0..SPEED_CLASSES).map(|c| [8.0, 0.0, 2.0][c.min(2)]).collect());
        let mut stream = random::stream(1, "test", 0);
        for _ in 0..50 {
            let speed_mps = drawn_speed(&model, known, 1, 10.0, 40.0, &mut stream);
            assert!(speed_mps >= 0.7, "{speed_mps} m/s");
        }
    }
}
