//! Stop lines of signals, with their states in a window.

use crate::tuning::fixed::lights::{BAND_SPARE_M, GOES_ON_M, TELLING_M};
use scene::geometry::cross;
use scene::routes::{LaneGraph, Polyline, Pose};
use scene::{HORIZON_STEPS, Signal, SignalState, Vec2};

/// Number of sections of `TELLING_M` at whose ends a path is compared with a lane.
const TELLING_PLACES: i32 = 8;

/// Steps of a window as bits, the start first.
pub(crate) type Steps = u128;

/// The stop line of a signal.
#[derive(Clone, Debug)]
pub struct StopLine {
    at: Pose,
    lane: usize,
    half_width_m: f64,
    /// The signal's lane continues behind the line, through the junction; otherwise it ends there.
    goes_on: bool,
    /// Steps of the window at which it is red and not flashing.
    red: Steps,
    /// Steps at which passing is known to be allowed; flashing red allows it.
    open: Steps,
    /// Steps at which the lane has green or yellow.
    go: Steps,
}

impl StopLine {
    /// The stop line of a signal in a window that starts at scene step `step`.
    pub fn of(signal: &Signal, graph: &LaneGraph, step: usize) -> Option<Self> {
        let lane = graph.lane_index(&signal.lane)?;
        let lit = &graph.lanes()[lane];
        // Without a stop point: lanes through a junction are controlled at their start, others at their end.
        let default_m = if lit.interpolating { 0.0 } else { lit.path.length_m() };
        let s_m = signal.stop.map_or(default_m, |p| lit.path.project(p).s_m);
        let mut at = lit.path.sample(s_m);
        at.position = signal.stop.unwrap_or(at.position);
        let must_stop = |state: SignalState| state.is_stop() && state != SignalState::FlashingStop;
        let steps = |is: &dyn Fn(SignalState) -> bool| {
            (0..=HORIZON_STEPS).filter(|i| is(signal.at(step + i))).fold(0, |bits, i| bits | 1 << i)
        };
        Some(Self {
            at,
            lane,
            half_width_m: 0.5 * lit.width_m + BAND_SPARE_M,
            goes_on: lit.path.length_m() - s_m > GOES_ON_M,
            red: steps(&must_stop),
            open: steps(&|state| state != SignalState::Unknown && !must_stop(state)),
            go: steps(&|state| matches!(state, SignalState::Go | SignalState::ArrowGo) || state.is_caution()),
        })
    }

    /// The ends of a straight segment of this length behind the line.
    pub(super) fn behind(&self, reach_m: f64) -> (Vec2, Vec2) {
        let ahead = self.at.direction();
        (self.at.position - ahead, self.at.position + ahead * reach_m)
    }

    /// Middle of the line, with the heading of its lane.
    pub(crate) fn at(&self) -> Pose {
        self.at
    }

    /// Steps of the window at which its lane has green or yellow.
    pub(super) fn go(&self) -> Steps {
        self.go
    }

    /// Steps of the window at which it is known to be red and not flashing.
    pub(crate) fn red(&self) -> Steps {
        self.red
    }

    /// Steps of the window at which passing is known to be allowed.
    pub(super) fn open(&self) -> Steps {
        self.open
    }

    /// Arc length at which a path crosses the line in the lane's direction.
    pub(super) fn crossed_by(&self, path: &Polyline) -> Option<f64> {
        let foot = path.project(self.at.position);
        let here = path.sample(foot.s_m);
        let ahead = self.at.direction();
        let inside = foot.distance_m <= self.half_width_m + 0.5
            && cross(ahead, here.position - self.at.position).abs() <= self.half_width_m;
        (inside && here.direction().dot(&ahead) > 0.5).then_some(foot.s_m)
    }

    /// Mean distance of a path that crosses the line at `s_m` from the signal's lane, metres.
    pub(super) fn off_lane_m(&self, path: &Polyline, s_m: f64, graph: &LaneGraph) -> f64 {
        let lane = &graph.lanes()[self.lane].path;
        let side = if self.goes_on { 1.0 } else { -1.0 };
        let places =
            (0..=TELLING_PLACES).map(|i| s_m + side * TELLING_M * f64::from(i) / f64::from(TELLING_PLACES));
        let places: Vec<f64> = places.filter(|s| (0.0..=path.length_m()).contains(s)).collect();
        let off = |s: &f64| lane.project(path.position_at(*s)).lateral_m.abs();
        places.iter().map(off).sum::<f64>() / places.len().max(1) as f64
    }
}
