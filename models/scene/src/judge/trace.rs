//! Traces of motions, and the ground that two of them share.
//!
//! Boxes are compared at different times. If the box of one at one moment overlaps that of the other at
//! another moment, the two share ground. The time shift between the moments gives their order. The
//! post-encroachment time of the score is similar, but needs paths that cross at an angle; merging counts
//! here too.

use crate::geometry::obb::{OrientedBox, overlaps};
use crate::geometry::{Extent, direction};
use crate::{AgentId, AgentType, STEP_S, Size, State, Vec2, wrap_angle};
use std::sync::OnceLock;

/// Steps between two moments.
pub(super) const STRIDE: usize = 2;
/// Seconds between two moments.
pub(super) const MOMENT_S: f64 = STRIDE as f64 * STEP_S;
/// Shared ground with a larger time shift makes no relation, seconds.
pub(super) const WINDOW_S: f64 = 6.0;
/// Paths whose headings differ by less than this have the same direction, radians: 35 degrees.
pub const SAME_WAY_RAD: f64 = 0.61;
/// Gap between bumpers below which a standing agent follows, metres.
pub(super) const QUEUE_M: f64 = 6.0;
/// A motion shorter than this has no relation, metres.
pub(super) const GOES_M: f64 = 2.0;
/// An agent that ends slower than this is assumed to continue, m/s, by this distance, metres.
const WAITING_MPS: f64 = 1.0;
const GOES_ON_M: f64 = 7.0;
/// Distance of the assumed continuation per moment, metres.
const GOES_ON_STEP_M: f64 = 1.0;

/// A road user at one moment.
#[derive(Clone, Copy, Debug)]
pub(super) struct Moment {
    pub(super) center: Vec2,
    pub(super) heading_rad: f64,
    /// Index of the moment.
    at: usize,
    pub(super) speed_mps: f64,
    /// Path length from the first moment, metres.
    pub(super) way_m: f64,
}

/// The motion of a road user as others see it. Made once, compared with many.
#[derive(Clone, Debug)]
pub struct Trace {
    pub(super) id: AgentId,
    pub(super) agent_type: AgentType,
    pub(super) size: Size,
    /// One per [`MOMENT_S`], the first at the start; `None` while the road user is absent.
    pub(super) moments: Vec<Option<Moment>>,
    /// Unit vector along the heading, by moment; computed on first use, because most traces meet no other.
    forwards: OnceLock<Box<[Vec2]>>,
    /// Assumed continuation after its last moment, for an agent that waits at its end.
    goes_on: Vec<Moment>,
    extent: Extent,
    pub(super) radius_m: f64,
    /// Longest distance between two moments, metres.
    stride_m: f64,
    pub(super) way_m: f64,
}

impl Trace {
    /// The trace of the states that `at` returns for steps 0 .. `steps`.
    pub fn new(
        id: &str,
        agent_type: AgentType,
        size: &Size,
        steps: usize,
        at: impl Fn(usize) -> Option<State>,
    ) -> Self {
        let mut trace = Self {
            id: id.to_owned(),
            agent_type,
            size: *size,
            moments: Vec::with_capacity(steps.div_ceil(STRIDE)),
            forwards: OnceLock::new(),
            goes_on: Vec::new(),
            extent: Extent::NONE,
            radius_m: 0.5 * size.length_m.hypot(size.width_m),
            stride_m: 0.0,
            way_m: 0.0,
        };
        let mut last: Option<Vec2> = None;
        for step in (0..steps).step_by(STRIDE) {
            let moment = at(step).map(|state| {
                let position = state.position();
                let moved = last.map_or(0.0, |last| (position - last).norm());
                last = Some(position);
                trace.stride_m = trace.stride_m.max(moved);
                trace.way_m += moved;
                trace.extent = trace.extent.with(position);
                Moment {
                    center: position,
                    heading_rad: state.heading_rad,
                    at: trace.moments.len(),
                    speed_mps: state.speed_mps(),
                    way_m: trace.way_m,
                }
            });
            trace.moments.push(moment);
        }
        trace
    }

    /// Adds the assumed continuation, for the trace whose relations are wanted.
    #[must_use]
    pub fn going_on(mut self) -> Self {
        if let Some(last) = self.moments.iter().rev().flatten().next().copied()
            && last.speed_mps < WAITING_MPS
        {
            let forward = direction(last.heading_rad);
            let count = (GOES_ON_M / GOES_ON_STEP_M) as usize;
            let on = |i: usize| {
                let center = last.center + forward * (GOES_ON_STEP_M * i as f64);
                Moment { center, ..last }
            };
            self.goes_on = (1..=count).map(on).collect();
            self.extent = self.extent.with(last.center + forward * GOES_ON_M);
        }
        self
    }

    /// The agent's id.
    pub fn id(&self) -> &str {
        &self.id
    }

    /// Its type.
    pub fn agent_type(&self) -> AgentType {
        self.agent_type
    }

    /// Its box.
    pub fn size(&self) -> &Size {
        &self.size
    }

    /// Seconds from the first moment to this one.
    pub fn seconds(moment: usize) -> f64 {
        moment as f64 * MOMENT_S
    }

    /// Whether the two are ever near each other, at any times.
    pub fn may_meet(&self, other: &Self) -> bool {
        let reach = self.radius_m + other.radius_m + QUEUE_M;
        self.extent.is_near(&other.extent, reach)
    }

    /// Whether the boxes overlap at some moment after the first.
    pub fn meets(&self, other: &Self) -> bool {
        let reach = self.radius_m + other.radius_m;
        let closing_m = (self.stride_m + other.stride_m).max(1e-6);
        let count = self.moments.len().min(other.moments.len());
        let mut i = 1;
        while i < count {
            if let (Some(a), Some(b)) = (&self.moments[i], &other.moments[i]) {
                let apart = (a.center - b.center).norm() - reach;
                if apart > 0.0 {
                    i += 1 + (apart / closing_m) as usize;
                    continue;
                }
                if self.overlaps(a, other, b) {
                    return true;
                }
            }
            i += 1;
        }
        false
    }

    /// Unit vector along the heading of one of its moments.
    pub(super) fn forward(&self, moment: &Moment) -> Vec2 {
        let of = |moment: &Option<Moment>| moment.map_or(Vec2::zeros(), |m| direction(m.heading_rad));
        self.forwards.get_or_init(|| self.moments.iter().map(of).collect())[moment.at]
    }

    fn outline(&self, moment: &Moment) -> OrientedBox {
        let half_m = (0.5 * self.size.length_m, 0.5 * self.size.width_m);
        OrientedBox::facing(moment.center, half_m, moment.heading_rad, self.forward(moment))
    }

    /// Whether the boxes of two traces at these moments overlap.
    pub(super) fn overlaps(&self, mine: &Moment, other: &Self, theirs: &Moment) -> bool {
        let reach = self.radius_m + other.radius_m;
        (mine.center - theirs.center).norm_squared() < reach * reach
            && overlaps(&self.outline(mine), &other.outline(theirs), 0.0)
    }

    /// Speed at a moment, m/s.
    pub fn speed_at(&self, moment: usize) -> Option<f64> {
        self.moments.get(moment)?.as_ref().map(|m| m.speed_mps)
    }
}

/// Ground that two agents use within [`WINDOW_S`] of each other, as moments of both.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SharedGround {
    /// The moment at which the first agent gets there, and the moment of the other whose box it then
    /// overlaps.
    pub(super) enters: (usize, usize),
    /// The pair of moments with the smallest time shift.
    pub(super) nearest: (usize, usize),
    /// First and last moment of the first agent there.
    pub mine: (usize, usize),
    /// First and last moment of the other agent there.
    pub theirs: (usize, usize),
    /// Least and greatest shift in moments; positive if the first agent is there first.
    pub(super) shift: (i64, i64),
    /// The first agent gets there only in its assumed continuation.
    pub(super) beyond: bool,
}

impl SharedGround {
    /// Order: 1 if the first agent goes first, -1 if the other does, 0 if they meet.
    pub fn order(&self) -> i64 {
        match self.shift {
            (least, _) if least > 0 => 1,
            (_, most) if most < 0 => -1,
            _ => 0,
        }
    }

    /// Smallest number of moments between the two; zero if they meet.
    pub fn least_shift(&self) -> i64 {
        if self.order() == 0 { 0 } else { self.shift.0.abs().min(self.shift.1.abs()) }
    }
}

/// Ground where the paths of two agents cross or merge. `None` for two agents that follow each other from the
/// start on, and for two pedestrians.
pub fn crossing(me: &Trace, other: &Trace) -> Option<SharedGround> {
    let walkers = me.agent_type == AgentType::Pedestrian && other.agent_type == AgentType::Pedestrian;
    if walkers || other.way_m < GOES_M || !me.may_meet(other) {
        return None;
    }
    if came_the_same_way(me, other) { None } else { ground(me, other) }
}

/// Whether one of the two starts on the path of the other: they follow each other from the start and do not
/// merge.
fn came_the_same_way(me: &Trace, other: &Trace) -> bool {
    let starts_on = |a: &Trace, b: &Trace| {
        let Some(start) = a.moments.iter().flatten().next() else { return false };
        b.moments.iter().flatten().any(|m| {
            b.overlaps(m, a, start) && wrap_angle(m.heading_rad - start.heading_rad).abs() < SAME_WAY_RAD
        })
    };
    starts_on(other, me) || starts_on(me, other)
}

fn ground(me: &Trace, other: &Trace) -> Option<SharedGround> {
    let window = (WINDOW_S / MOMENT_S) as usize;
    let reach = me.radius_m + other.radius_m;
    let mut found: Option<SharedGround> = None;
    let mine = me.moments.iter().enumerate().filter_map(|(i, m)| Some((i, m.as_ref()?, false)));
    let last = me.moments.len().saturating_sub(1);
    let beyond = me.goes_on.iter().map(|moment| (last, moment, true));
    for (i, here, beyond) in mine.chain(beyond) {
        if beyond && found.is_some_and(|f| !f.beyond) {
            break;
        }
        // Far from all places of the other motion.
        if other.extent.outside_m(here.center) > reach {
            continue;
        }
        let from = if beyond { 0 } else { i.saturating_sub(window) };
        let to = (i + window).min(other.moments.len().saturating_sub(1));
        let mut j = from;
        while j <= to {
            let Some(Some(moment)) = other.moments.get(j) else {
                j += 1;
                continue;
            };
            let apart = (moment.center - here.center).norm() - reach;
            if apart > 0.0 {
                // The other cannot be here before it has covered this distance.
                j += 1 + if other.stride_m > 0.0 { (apart / other.stride_m) as usize } else { to };
                continue;
            }
            if other.overlaps(moment, me, here) {
                let shift = j as i64 - i as i64;
                let now = SharedGround {
                    enters: (i, j),
                    nearest: (i, j),
                    mine: (i, i),
                    theirs: (j, j),
                    shift: (shift, shift),
                    beyond,
                };
                found = Some(found.map_or(now, |known| known.and(&now)));
            }
            j += 1;
        }
    }
    found
}

impl SharedGround {
    fn and(self, more: &Self) -> Self {
        let span = |a: (usize, usize), b: (usize, usize)| (a.0.min(b.0), a.1.max(b.1));
        let nearer = more.shift.0.abs() < (self.nearest.1 as i64 - self.nearest.0 as i64).abs();
        Self {
            nearest: if nearer { more.nearest } else { self.nearest },
            mine: span(self.mine, more.mine),
            theirs: span(self.theirs, more.theirs),
            shift: (self.shift.0.min(more.shift.0), self.shift.1.max(more.shift.1)),
            ..self
        }
    }
}
