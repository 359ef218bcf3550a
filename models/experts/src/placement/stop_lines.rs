//! Causes for a driver on a lane to stop: signals, stop signs, junctions.

use super::context::RoadAhead;
use crate::tuning::placing::stop_lines::{
    GO_WITHIN_M, NEAR_M, PASSED_M, QUEUES_M, RED_WITHIN_M, YIELD_WITHIN_M,
};
pub(super) use crate::tuning::placing::stop_lines::{LOOK_M, STOP_LINE_M};
use scene::routes::LaneGraph;
use scene::{Scene, SignalState};
use std::collections::HashMap;

/// Number of lanes to look along.
const MAX_HOPS: usize = 12;

/// What controls the next stop line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum StopControl {
    /// A junction without signals.
    Unsignalled,
    /// A stop sign.
    StopSign,
    /// Signals, at least one of which is not red.
    NotRed,
    /// Signals that are all red.
    Red,
}

/// A place on the road as drivers see it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum LineAhead {
    /// Nothing to stop for within [`LOOK_M`].
    Nothing,
    /// A stop line at this distance, metres.
    StopLine(StopControl, f64),
    /// Inside a junction; whether its signal is red, if the state of one is known.
    Inside(Option<bool>),
}

impl LineAhead {
    /// Class of the place in the features of rates, below [`Self::CLASSES`].
    pub(super) fn class(self) -> usize {
        match self {
            Self::Nothing => 0,
            Self::Inside(None) => 1,
            Self::Inside(Some(false)) => 2,
            Self::Inside(Some(true)) => 3,
            Self::StopLine(kind, distance_m) => {
                let near = NEAR_M.iter().filter(|m| distance_m >= **m).count().min(NEAR_M.len() - 1);
                4 + kind as usize * NEAR_M.len() + near
            }
        }
    }

    pub(super) const CLASSES: usize = 4 + 4 * NEAR_M.len();

    /// Class of the place in the contexts of speeds.
    pub(super) fn road_ahead(self) -> RoadAhead {
        use StopControl::{NotRed, Red, StopSign, Unsignalled};
        match self {
            Self::Nothing => RoadAhead::Clear,
            Self::Inside(Some(true)) => RoadAhead::JunctionOnRed,
            Self::Inside(_) => RoadAhead::Junction,
            Self::StopLine(Unsignalled | StopSign, m) if m < YIELD_WITHIN_M[0] => RoadAhead::YieldWithin12M,
            Self::StopLine(Unsignalled | StopSign, m) if m < YIELD_WITHIN_M[1] => RoadAhead::YieldWithin30M,
            Self::StopLine(NotRed, m) if m < GO_WITHIN_M => RoadAhead::GoWithin30M,
            Self::StopLine(Red, m) if m < RED_WITHIN_M[0] => RoadAhead::RedWithin10M,
            Self::StopLine(Red, m) if m < RED_WITHIN_M[1] => RoadAhead::RedWithin25M,
            Self::StopLine(Red, m) if m < RED_WITHIN_M[2] => RoadAhead::RedWithin50M,
            Self::StopLine(..) => RoadAhead::Clear,
        }
    }

    /// Distance to a stop line, metres; infinite without one.
    pub(super) fn stop_m(self) -> f64 {
        match self {
            Self::StopLine(_, m) => m,
            _ => f64::INFINITY,
        }
    }

    /// Whether traffic queues here: a red signal, a stop sign or an unsignalled junction is near.
    pub(super) fn queues(self) -> bool {
        matches!(self, Self::StopLine(StopControl::Red, m) if m < QUEUES_M.0)
            || matches!(self, Self::StopLine(StopControl::StopSign | StopControl::Unsignalled, m) if m < QUEUES_M.1)
    }
}

/// Signals with a known state by lane: state, and arc length of the stop line, metres.
pub(super) struct ShownLights(HashMap<usize, (SignalState, f64)>);

impl ShownLights {
    /// Signals of a scene at a step, without those in an unknown state.
    pub(super) fn new(scene: &Scene, graph: &LaneGraph, step: usize) -> Self {
        let lit = scene.signals.iter().filter_map(|signal| {
            let lane = graph.lane_index(&signal.lane)?;
            let state = signal.at(step);
            let stop_m = signal.stop.map_or(0.0, |stop| graph.lanes()[lane].path.project(stop).s_m);
            (state != SignalState::Unknown).then_some((lane, (state, stop_m)))
        });
        Self(lit.collect())
    }

    /// Whether a signal with a known state controls a lane.
    pub(super) fn rules(&self, lane: usize) -> bool {
        self.0.contains_key(&lane)
    }

    /// What is ahead of the place at `s_m` of a lane.
    pub(super) fn ahead(&self, graph: &LaneGraph, lane: usize, s_m: f64) -> LineAhead {
        let lanes = graph.lanes();
        let kind = |red: bool| if red { StopControl::Red } else { StopControl::NotRed };
        if lanes[lane].interpolating {
            return LineAhead::Inside(self.0.get(&lane).map(|(state, _)| state.is_stop()));
        }
        let (mut at, mut s, mut travelled_m) = (lane, s_m, 0.0);
        for _ in 0..MAX_HOPS {
            let here = &lanes[at];
            if let Some((state, stop_m)) = self.0.get(&at).filter(|(_, stop)| *stop >= s - PASSED_M) {
                return stop(kind(state.is_stop()), travelled_m + stop_m - s);
            }
            if let Some(stop_m) = here.stop_sign_m.filter(|stop| *stop >= s - PASSED_M) {
                return stop(StopControl::StopSign, travelled_m + stop_m - s);
            }
            travelled_m += here.path.length_m() - s;
            if travelled_m > LOOK_M {
                return LineAhead::Nothing;
            }
            let lit = || here.successors.iter().filter_map(|next| self.0.get(next));
            if let Some(line_m) = lit().map(|(_, m)| *m).reduce(f64::min) {
                return stop(kind(lit().all(|(state, _)| state.is_stop())), travelled_m + line_m);
            }
            if here.successors.iter().any(|next| lanes[*next].interpolating) {
                return stop(StopControl::Unsignalled, travelled_m);
            }
            let Some(next) = straightest(graph, at) else { return LineAhead::Nothing };
            (at, s) = (next, 0.0);
        }
        LineAhead::Nothing
    }
}

fn stop(kind: StopControl, distance_m: f64) -> LineAhead {
    if distance_m < LOOK_M { LineAhead::StopLine(kind, distance_m.max(0.0)) } else { LineAhead::Nothing }
}

/// The successor whose end turns least.
pub(super) fn straightest(graph: &LaneGraph, lane: usize) -> Option<usize> {
    let lanes = graph.lanes();
    let turn = |next: &usize| {
        let path = &lanes[*next].path;
        (path.heading_at(path.length_m()) - path.heading_at(0.0)).abs()
    };
    lanes[lane].successors.iter().copied().min_by(|a, b| turn(a).total_cmp(&turn(b)).then(a.cmp(b)))
}
