//! A one-way carriageway with an off-ramp, an on-ramp, or both.

use crate::curve::{Pose, join, parallel, straight, tidy};
use crate::draft::MapDraft;
use crate::parameters::Merge;
use scene::Vec2;
use scene::map::LaneType;

/// Lengths before the first ramp, between the two, and after the last, metres.
const LEAD_M: f64 = 90.0;
const APART_M: f64 = 80.0;
/// Length over which a lane opens or closes, and that of a ramp, metres.
const TAPER_M: f64 = 40.0;
const RAMP_M: f64 = 90.0;
/// Radius of the bend at which a ramp joins the carriageway, metres.
const RAMP_RADIUS_M: f64 = 180.0;
/// Paved width beside the outer lanes: left, right, metres.
const SHOULDER_M: [f64; 2] = [1.0, 2.0];

/// A ramp with its positions along the carriageway.
struct Ramp {
    joins: bool,
    /// Positions along the carriageway at which the ramp's lane reaches the gore, runs parallel to the
    /// others, and has ended (or begun).
    gore_m: f64,
    parallel_m: f64,
    end_m: f64,
}

struct Road<'a> {
    layout: &'a Merge,
    ramps: Vec<Ramp>,
    length_m: f64,
    /// The right side of the through lanes.
    right_m: f64,
}

pub fn draw(layout: &Merge) -> MapDraft {
    let road = Road::new(layout);
    let mut draft = MapDraft::default();
    let cuts = road.cuts();
    let main = road.main(&mut draft, &cuts);
    let mut edge: Vec<Vec<Vec2>> = vec![vec![road.at(0.0, road.right_m - SHOULDER_M[1])]];
    let mut ground: Vec<Vec2> = edge[0].clone();
    for ramp in &road.ramps {
        road.ramp(&mut draft, ramp, &cuts, &main, &mut edge, &mut ground);
    }
    let last = road.at(road.length_m, road.right_m - SHOULDER_M[1]);
    if let Some(line) = edge.last_mut() {
        line.push(last);
    }
    ground.push(last);
    let left = straight(road.at(road.length_m, SHOULDER_M[0]), road.at(0.0, SHOULDER_M[0]));
    ground.extend(left.iter().copied());
    for line in edge {
        draft.edge("boundary", tidy(line));
    }
    draft.edge("boundary", left);
    draft.ground(tidy(ground), Vec::new());
    draft
}

impl<'a> Road<'a> {
    fn new(layout: &'a Merge) -> Self {
        let mut ramps = Vec::new();
        let mut at_m = LEAD_M;
        if layout.off_ramp {
            let parallel_m = at_m + TAPER_M;
            let gore_m = parallel_m + layout.parallel_m;
            ramps.push(Ramp { joins: false, gore_m, parallel_m, end_m: at_m });
            at_m = gore_m + RAMP_M + APART_M;
        }
        if layout.on_ramp {
            let parallel_m = at_m + layout.parallel_m;
            let end_m = parallel_m + TAPER_M;
            ramps.push(Ramp { joins: true, gore_m: at_m, parallel_m, end_m });
            at_m = end_m;
        }
        let right_m = -f64::from(layout.lanes) * layout.lane_width_m;
        Self { layout, ramps, length_m: at_m + LEAD_M, right_m }
    }

    /// The position at these distances along and to the left, with the middle of the road at the origin.
    fn at(&self, along_m: f64, left_m: f64) -> Vec2 {
        Vec2::new(along_m - self.length_m / 2.0, left_m - self.right_m / 2.0)
    }

    fn cuts(&self) -> Vec<f64> {
        let mut cuts = vec![0.0, self.length_m];
        for ramp in &self.ramps {
            cuts.extend([ramp.gore_m, ramp.parallel_m, ramp.end_m]);
        }
        cuts.sort_by(f64::total_cmp);
        cuts
    }

    /// Draws the through lanes, by stretch and from the left, and their paint.
    fn main(&self, draft: &mut MapDraft, cuts: &[f64]) -> Vec<Vec<usize>> {
        let (width_m, lanes) = (self.layout.lane_width_m, usize::from(self.layout.lanes));
        let mut all: Vec<Vec<usize>> = Vec::new();
        for (k, cut) in cuts.windows(2).enumerate() {
            let line = |left_m: f64| straight(self.at(cut[0], left_m), self.at(cut[1], left_m));
            let mut row: Vec<usize> = Vec::new();
            for i in 0..lanes {
                let left_m = -(i as f64 + 0.5) * width_m;
                let id = format!("main{}.{}", i + 1, k + 1);
                let lane =
                    draft.lane(id, LaneType::Freeway, line(left_m), width_m, self.layout.speed_limit_kmh);
                draft.about[lane].open = [k == 0, k + 2 == cuts.len()];
                if let Some(before) = all.last() {
                    draft.link(before[i], lane);
                }
                if let Some(left) = row.last() {
                    draft.beside(*left, lane);
                }
                row.push(lane);
            }
            all.push(row);
        }
        let whole = |left_m: f64| straight(self.at(0.0, left_m), self.at(self.length_m, left_m));
        let left = draft.line("solid_single_yellow", whole(0.0));
        let between: Vec<String> =
            (1..lanes).map(|i| draft.line("broken_single_white", whole(-(i as f64) * width_m))).collect();
        for row in &all {
            draft.bound(row[0], true, &left);
            for (i, line) in between.iter().enumerate() {
                draft.bound(row[i], false, line);
                draft.bound(row[i + 1], true, line);
            }
        }
        // The right side is solid except beside the lane of a ramp.
        let mut from = 0.0;
        for ramp in &self.ramps {
            let (first, last) = (ramp.gore_m.min(ramp.end_m), ramp.gore_m.max(ramp.end_m));
            let solid = straight(self.at(from, self.right_m), self.at(first, self.right_m));
            draft.line("solid_single_white", solid);
            let broken = straight(self.at(first, self.right_m), self.at(last, self.right_m));
            draft.line("broken_single_white", broken);
            from = last;
        }
        let rest = straight(self.at(from, self.right_m), self.at(self.length_m, self.right_m));
        draft.line("solid_single_white", rest);
        all
    }

    /// Draws a ramp: its lane, the lane beside the others, and the changed kerb and ground.
    fn ramp(
        &self,
        draft: &mut MapDraft,
        ramp: &Ramp,
        cuts: &[f64],
        main: &[Vec<usize>],
        edge: &mut Vec<Vec<Vec2>>,
        ground: &mut Vec<Vec2>,
    ) {
        let (width_m, limit) = (self.layout.lane_width_m, self.layout.speed_limit_kmh);
        let aside_m = self.right_m - width_m / 2.0;
        let word = if ramp.joins { "on" } else { "off" };
        // Both ramps are drawn as an on-ramp; an off-ramp is one in reverse.
        let sign = if ramp.joins { 1.0 } else { -1.0 };
        let place = |back_m: f64, left_m: f64| self.at(ramp.gore_m + sign * back_m, left_m);
        let slope = self.layout.ramp_angle_deg.to_radians();
        let way = Vec2::new(sign * slope.cos(), slope.sin());
        let bend_m = RAMP_RADIUS_M * (slope / 2.0).tan();
        let apex = place(-bend_m, aside_m);
        let outer = apex - way * RAMP_M;
        let heading = |v: Vec2| v.y.atan2(v.x);
        let from = Pose { at: outer, heading_rad: heading(way) };
        let to = Pose { at: place(0.0, aside_m), heading_rad: heading(Vec2::new(sign, 0.0)) };
        let line = join(from, to, RAMP_RADIUS_M);
        let driven = |mut line: Vec<Vec2>| {
            if !ramp.joins {
                line.reverse();
            }
            line
        };
        let stretch =
            |at_m: f64| cuts.windows(2).position(|cut| cut[0] <= at_m && at_m < cut[1]).unwrap_or(0);
        let ramp_limit = self.layout.ramp_speed_limit_kmh;
        let ramp_lane =
            draft.lane(format!("{word}-ramp"), LaneType::Freeway, driven(line.clone()), width_m, ramp_limit);
        draft.about[ramp_lane].open = [ramp.joins, !ramp.joins];
        let beside = driven(straight(place(0.0, aside_m), self.at(ramp.parallel_m, aside_m)));
        let beside = draft.lane(format!("{word}-beside"), LaneType::Freeway, beside, width_m, limit);
        let lowest_m = ramp.gore_m.min(ramp.parallel_m);
        if let Some(last) = main[stretch(lowest_m)].last() {
            draft.beside(*last, beside);
        }
        let last_m = self.right_m + width_m / 2.0;
        let (near, far) = (self.at(ramp.parallel_m, aside_m), self.at(ramp.end_m, last_m));
        let flat = |at: Vec2| Pose { at, heading_rad: 0.0 };
        let (a, b) = if ramp.joins { (near, far) } else { (far, near) };
        let taper = join(flat(a), flat(b), 1e4);
        let taper = draft.lane(format!("{word}-taper"), LaneType::Freeway, taper, width_m, limit);
        draft.map.lanes[taper].interpolating = true;
        let through = |k: usize| main[k].last().copied();
        if ramp.joins {
            draft.link(ramp_lane, beside);
            draft.link(beside, taper);
            through(stretch(ramp.end_m)).into_iter().for_each(|lane| draft.link(taper, lane));
        } else {
            through(stretch(ramp.end_m) - 1).into_iter().for_each(|lane| draft.link(lane, taper));
            draft.link(taper, beside);
            draft.link(beside, ramp_lane);
        }

        // Paint and kerb on both sides of the ramp; `left` is the side of the carriageway.
        let left = |m: f64| if ramp.joins { m } else { -m };
        let toward = parallel(&line, left(width_m / 2.0));
        let away = parallel(&line, -left(width_m / 2.0));
        draft.line("solid_single_white", driven(toward));
        let mut outside = away;
        outside.push(self.at(ramp.parallel_m, aside_m - width_m / 2.0));
        outside.push(self.at(ramp.end_m, self.right_m));
        draft.line("solid_single_white", driven(outside));

        let shoulder_m = self.right_m - SHOULDER_M[1];
        // The kerb towards the carriageway ends where it meets the kerb of the carriageway.
        let level_m = self.at(0.0, shoulder_m).y;
        let inner = clipped(&parallel(&line, left(width_m / 2.0 + 0.5)), level_m);
        let mut outer = parallel(&line, -left(width_m / 2.0 + SHOULDER_M[1]));
        let low_m = aside_m - width_m / 2.0 - SHOULDER_M[1];
        outer.push(self.at(ramp.parallel_m, low_m));
        let closing = [self.at(ramp.parallel_m, low_m), self.at(ramp.end_m, shoulder_m)];
        outer.extend(join(flat_way(closing[0], sign), flat_way(closing[1], sign), 1e4));
        let (first, then) = if ramp.joins {
            // The kerb of the carriageway, back along the ramp; a gap; then along the ramp and on.
            let mut back = inner;
            back.reverse();
            (back, outer)
        } else {
            outer.reverse();
            (outer, inner)
        };
        ground.extend(first.iter().copied());
        ground.extend(then.iter().copied());
        if let Some(line) = edge.last_mut() {
            line.extend(first);
        }
        edge.push(then);
    }
}

fn flat_way(at: Vec2, sign: f64) -> Pose {
    Pose { at, heading_rad: if sign > 0.0 { 0.0 } else { std::f64::consts::PI } }
}

/// The part of a line before it rises above a level.
fn clipped(line: &[Vec2], level_m: f64) -> Vec<Vec2> {
    let mut kept: Vec<Vec2> = Vec::new();
    for p in line {
        if p.y > level_m {
            if let Some(last) = kept.last().copied() {
                let share = (level_m - last.y) / (p.y - last.y).max(1e-9);
                kept.push(last + (p - last) * share);
            }
            break;
        }
        kept.push(*p);
    }
    kept
}
