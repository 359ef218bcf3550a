//! Blocks: the stretches of a path that other agents occupy, and when.

use super::path_progress::{BEYOND_M, PathProgress};
use crate::generator::motion::Sweep;
use crate::tuning::fixed::blocks::{
    BEYOND_S, CLEAR_M, CROSSING_M, CROSSING_MPS, LINE_BESIDE_M, LINE_GAP_M, LINE_TURNED_RAD,
};
use scene::geometry::obb::{OrientedBox, overlaps};
use scene::geometry::{Extent, wrap_angle};
use scene::routes::Pose;
use scene::{HORIZON_STEPS, STEP_S, Size, Vec2};
use std::f64::consts::FRAC_PI_6;

/// Distance between samples of a path, metres.
const SPACING_M: f64 = 0.5;
/// Samples per bounding circle.
const CHUNK: usize = 8;
/// Steps between the checked positions of others after the window.
const BEYOND_STRIDE: usize = 3;
/// An agent that leaves the path for fewer steps than this has not left.
const FLICKER: usize = 3;
/// Tolerance for rounding of distances, metres.
const HAIR_M: f64 = 1e-6;

/// An agent or a closed line that blocks a path for a while. Progress is that of the path's box centre.
#[derive(Clone, Debug)]
pub(super) struct PathBlock {
    /// Step of the window at which the block begins.
    pub(super) from: usize,
    /// First and last blocked progress, one entry per step.
    pub(super) taken: Vec<(f64, f64)>,
}

impl PathBlock {
    /// Whether an agent at this progress is already past the block when it begins.
    pub(super) fn comes_behind(&self, along_m: f64) -> bool {
        self.taken.first().is_some_and(|(_, last)| along_m > *last)
    }
}

/// A path with its boxes.
pub(super) struct Corridor {
    enters: usize,
    outlines: Vec<OrientedBox>,
    /// Bounding circles of the centres of every eight boxes.
    chunks: Vec<(Vec2, f64)>,
    /// Rectangle around all centres.
    extent: Extent,
}

impl Corridor {
    pub(super) fn of(path: &PathProgress, size: &Size) -> Self {
        let length = path.length_m() + if path.leaves() { 0.0 } else { BEYOND_M };
        let count = (length / SPACING_M).ceil() as usize + 1;
        let outlines: Vec<_> = (0..count).map(|i| path.outline(i as f64 * SPACING_M, size)).collect();
        let circle = |boxes: &[OrientedBox]| {
            let middle = boxes[boxes.len() / 2].center();
            (middle, boxes.iter().map(|b| (b.center() - middle).norm()).fold(0.0, f64::max))
        };
        let chunks = outlines.chunks(CHUNK).map(circle).collect();
        let extent = Extent::of(outlines.iter().map(OrientedBox::center));
        Self { enters: path.enters, outlines, chunks, extent }
    }

    /// First and last progress of the first contiguous stretch that this box blocks. A crossing box blocks a
    /// wider stretch.
    fn taken(&self, other: &OrientedBox, velocity: Vec2) -> Option<(f64, f64)> {
        let moves = velocity.norm() > CROSSING_MPS;
        let clear_m = |outline: &OrientedBox| {
            let turn = wrap_angle(outline.heading_rad() - other.heading_rad()).abs();
            let crosses = (FRAC_PI_6..=5.0 * FRAC_PI_6).contains(&turn);
            if moves && crosses { CROSSING_M } else { CLEAR_M }
        };
        let own = self.outlines.first()?.radius_m();
        // Most other agents are nowhere near the path.
        let (center, reach_m) = (other.center(), own + other.radius_m() + CROSSING_M);
        if self.extent.outside_m(center) > reach_m {
            return None;
        }
        let mut found: Option<(usize, usize)> = None;
        for (c, (middle, radius)) in self.chunks.iter().enumerate() {
            let reach = radius + reach_m;
            if (middle - center).norm_squared() > reach * reach {
                if found.is_some() {
                    break;
                }
                continue;
            }
            let from = c * CHUNK;
            for (i, outline) in self.outlines[from..].iter().take(CHUNK).enumerate() {
                match &mut found {
                    _ if !overlaps(outline, other, clear_m(outline)) => {
                        if found.is_some() {
                            return found.map(Self::progress);
                        }
                    }
                    Some((_, last)) => *last = from + i,
                    none => *none = Some((from + i, from + i)),
                }
            }
        }
        found.map(Self::progress)
    }

    fn progress((first, last): (usize, usize)) -> (f64, f64) {
        (first as f64 * SPACING_M, last as f64 * SPACING_M)
    }

    /// When and where another agent blocks the path.
    pub(super) fn blocks(&self, other: &Sweep) -> Vec<PathBlock> {
        let mut out: Vec<PathBlock> = Vec::new();
        if self.is_away_from(other) {
            return out;
        }
        let mut away = FLICKER;
        for step in self.enters..=HORIZON_STEPS {
            let Some(taken) = other.at(step).and_then(|b| self.taken(b, other.velocity(step.max(1)))) else {
                away += 1;
                continue;
            };
            match out.last_mut().filter(|_| away < FLICKER) {
                Some(block) => {
                    let last = *block.taken.last().unwrap_or(&taken);
                    block.taken.extend(std::iter::repeat_n(last, away));
                    block.taken.push(taken);
                }
                None => out.push(PathBlock { from: step, taken: vec![taken] }),
            }
            away = 0;
        }
        if out.last().is_none_or(|block| block.from + block.taken.len() <= HORIZON_STEPS) {
            out.extend(self.block_beyond(other));
        }
        out
    }

    /// Whether no box of the other agent is near the path in the window or soon after it.
    fn is_away_from(&self, other: &Sweep) -> bool {
        let Some(own) = self.outlines.first() else { return true };
        let Size { length_m, width_m, .. } = *other.size();
        let reach_m = own.radius_m() + 0.5 * length_m.hypot(width_m) + CROSSING_M + HAIR_M;
        !self.extent.is_near(&other.extent(BEYOND_S), reach_m)
    }

    /// Block by another agent soon after the window, if it continues as at the window's end.
    fn block_beyond(&self, other: &Sweep) -> Option<PathBlock> {
        let steps = 1..=(BEYOND_S / STEP_S) as usize;
        steps.step_by(BEYOND_STRIDE).find_map(|later| {
            let taken = self.taken(&other.beyond(later as f64 * STEP_S)?, other.velocity(HORIZON_STEPS))?;
            Some(PathBlock { from: HORIZON_STEPS + later, taken: vec![taken] })
        })
    }

    /// Where the path passes a stop line of a lane: the progress at which the front is at the line.
    pub(super) fn line(&self, at: Pose) -> Option<f64> {
        let distance = |b: &OrientedBox| (b.center() - at.position).norm();
        let nearest = (0..self.outlines.len())
            .min_by(|a, b| distance(&self.outlines[*a]).total_cmp(&distance(&self.outlines[*b])))?;
        let outline = &self.outlines[nearest];
        // The path comes near the line but does not pass it.
        if nearest + 1 == self.outlines.len() {
            return None;
        }
        let turned = wrap_angle(outline.heading_rad() - at.heading_rad).abs();
        let beside = distance(outline) < LINE_BESIDE_M && turned < LINE_TURNED_RAD;
        let front = nearest as f64 * SPACING_M - outline.half_length_m() - LINE_GAP_M;
        (beside && front > 0.0).then_some(front)
    }
}

/// The times at which a line is closed, as blocks.
pub(super) fn closed(line_m: f64, is_closed: impl Fn(usize) -> bool) -> Vec<PathBlock> {
    let mut out: Vec<PathBlock> = Vec::new();
    let mut open = true;
    for step in 0..=HORIZON_STEPS {
        let closed = is_closed(step);
        if closed && open {
            out.push(PathBlock { from: step, taken: Vec::new() });
        }
        if let Some(block) = out.last_mut().filter(|_| closed) {
            block.taken.push((line_m, line_m));
        }
        open = !closed;
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use scene::State;

    const CAR: Size = Size { length_m: 4.0, width_m: 2.0, height_m: None };

    fn path(speed_mps: f64) -> PathProgress {
        let at = |i: usize| State { x_m: 0.1 * speed_mps * i as f64, vx_mps: speed_mps, ..State::default() };
        let known: Vec<_> = (0..=HORIZON_STEPS).map(|i| Some(at(i))).collect();
        PathProgress::of(&known, 0.5).unwrap()
    }

    #[test]
    fn who_crosses_takes_the_places_of_its_width_for_a_while() {
        let corridor = Corridor::of(&path(8.0), &CAR);
        let north = |i: usize| State {
            x_m: 40.0,
            y_m: -20.0 + 0.5 * i as f64,
            heading_rad: std::f64::consts::FRAC_PI_2,
            ..State::default()
        };
        let crossing: Vec<State> = (0..=HORIZON_STEPS).map(north).collect();
        let blocks = corridor.blocks(&Sweep::entering(0, &crossing, &CAR));
        assert_eq!(blocks.len(), 1);
        let (from, until) = (blocks[0].from, blocks[0].from + blocks[0].taken.len());
        assert!((31..=33).contains(&from) && (48..=50).contains(&until), "{from} to {until}");
        let (first, last) = blocks[0].taken[7];
        assert!((35.5..=36.5).contains(&first) && (43.5..=44.5).contains(&last), "{first} to {last}");
        assert!(blocks[0].comes_behind(45.0) && !blocks[0].comes_behind(40.0));
    }

    #[test]
    fn what_crosses_soon_after_the_window_is_in_the_way() {
        let corridor = Corridor::of(&path(8.0), &CAR);
        // At the window's end: 8 m beside the path at 80 m, moving towards it at 5 m/s.
        let north = |i: usize| State {
            x_m: 80.0,
            y_m: -53.0 + 0.5 * i as f64,
            heading_rad: std::f64::consts::FRAC_PI_2,
            ..State::default()
        };
        let crossing: Vec<State> = (0..=HORIZON_STEPS).map(north).collect();
        let blocks = corridor.blocks(&Sweep::entering(0, &crossing, &CAR));
        assert_eq!(blocks.len(), 1, "{blocks:?}");
        assert!((HORIZON_STEPS + 5..HORIZON_STEPS + 15).contains(&blocks[0].from), "{}", blocks[0].from);
        let leaves: Vec<State> = crossing.iter().take(60).copied().collect();
        assert!(corridor.blocks(&Sweep::entering(0, &leaves, &CAR)).is_empty());
    }

    #[test]
    fn a_line_is_closed_while_its_light_says_so() {
        let corridor = Corridor::of(&path(8.0), &CAR);
        let line = corridor.line(Pose::xyh(30.2, 0.5, 0.1)).unwrap();
        assert!((27.0..=28.0).contains(&line), "{line}");
        assert!(corridor.line(Pose::xyh(30.2, 3.5, 0.1)).is_none());
        assert!(corridor.line(Pose::xyh(30.2, 0.5, 3.0)).is_none());
        let blocks = closed(line, |step| (20..50).contains(&step));
        assert_eq!((blocks.len(), blocks[0].from, blocks[0].taken.len()), (1, 20, 30));
    }
}
