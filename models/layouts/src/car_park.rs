//! A street with a car park beside it. Traffic enters from the street, follows a lane below the aisles, one
//! of the aisles and the lane above them, and returns to the street. All lanes in the park are one-way.

use crate::curve::{arc, join, straight, tidy};
use crate::draft::{MapDraft, Vehicle};
use crate::parameters::CarPark;
use crate::roadway::{Plan, Profile, Side};
use scene::Vec2;
use scene::map::LaneType;
use std::f64::consts::{FRAC_PI_2, PI};

/// Length of the street beyond the drives, metres.
const BEYOND_M: f64 = 50.0;
/// Distance between the street's kerb and the park, metres.
const SETBACK_M: f64 = 10.5;
/// Width of the drives, metres.
const DRIVE_M: f64 = 5.0;
/// Distance between a drive and the aisle beside it, and length before a corner at which turns in the park
/// begin, metres.
const DRIVE_APART_M: f64 = 14.0;
const TURN_M: f64 = 6.0;
/// Distance on both sides of a drive at which the street is cut, and behind its kerb at which drives begin,
/// metres.
const CUT_M: f64 = 9.0;
const DRIVE_FROM_M: f64 = 4.5;
/// Speed limit in the park, km/h.
const LIMIT_KMH: f64 = 15.0;

/// Lines of the plan, metres.
struct Grid {
    /// Centre lines of the aisles, and of the drives in and out.
    aisles: Vec<f64>,
    drive_in: f64,
    drive_out: f64,
    /// Centre lines of the lanes below and above the aisles.
    below: f64,
    above: f64,
    /// Ends of the bays.
    bays: [f64; 2],
    /// Corners of the park, and its left side behind the drive in.
    low: Vec2,
    high: Vec2,
    left: f64,
}

impl Grid {
    fn new(layout: &CarPark, kerb_m: f64) -> Self {
        let pitch = layout.aisle_m + 2.0 * layout.bay_length_m;
        let count = f64::from(layout.aisles);
        let wide = pitch * count;
        let first = -wide / 2.0 + pitch / 2.0;
        let aisles: Vec<f64> = (0..layout.aisles).map(|i| first + pitch * f64::from(i)).collect();
        let low_y = kerb_m + SETBACK_M;
        let below = low_y + layout.aisle_m / 2.0;
        // Turning needs room between the lanes across and the first bays.
        let bays_from = low_y + layout.aisle_m + 1.0;
        let bays_to = bays_from + f64::from(layout.bays) * layout.bay_width_m;
        let above = bays_to + 1.0 + layout.aisle_m / 2.0;
        let (drive_in, drive_out) = (first - DRIVE_APART_M, aisles[aisles.len() - 1] + DRIVE_APART_M);
        Self {
            drive_in,
            drive_out,
            low: Vec2::new(drive_in - DRIVE_M / 2.0, low_y),
            high: Vec2::new(drive_out + DRIVE_M / 2.0, above + layout.aisle_m / 2.0),
            left: -wide / 2.0 - 0.5,
            aisles,
            below,
            above,
            bays: [bays_from, bays_to],
        }
    }
}

/// Lanes of the park that are still to be linked.
struct Ways<'a> {
    draft: &'a mut MapDraft,
}

impl Ways<'_> {
    fn lane(&mut self, id: String, a: Vec2, b: Vec2, width_m: f64) -> usize {
        self.draft.lane(id, LaneType::SurfaceStreet, straight(a, b), width_m, LIMIT_KMH)
    }

    fn turn(&mut self, from: usize, to: usize) -> usize {
        let line = join(self.draft.end(from), self.draft.start(to), 2.0 * TURN_M);
        self.draft.through(from, to, line, LaneType::SurfaceStreet)
    }
}

pub fn draw(layout: &CarPark) -> MapDraft {
    let profile = Profile {
        lanes: [1, 1],
        lane_m: layout.lane_width_m,
        cycle_m: 0.0,
        parking_m: 0.0,
        median_m: 0.0,
        limit_kmh: layout.speed_limit_kmh,
    };
    let kerb_m = profile.half_m(0);
    let grid = Grid::new(layout, kerb_m);
    let radius_m = layout.kerb_radius_m.min(SETBACK_M - 1.0);
    let mut draft = MapDraft { turns: Vehicle::Car, ..MapDraft::default() };
    street(&mut draft, &profile, &grid);
    park(&mut draft, layout, &grid);
    kerbs(&mut draft, layout, &grid, kerb_m, radius_m);
    draft
}

/// The street in three stretches with the ways into and out of the park.
fn street(draft: &mut MapDraft, profile: &Profile, grid: &Grid) {
    let half = CUT_M;
    let (x0, x3) = (grid.low.x - BEYOND_M, grid.high.x + BEYOND_M);
    let cuts =
        [x0, grid.drive_in - half, grid.drive_in + half, grid.drive_out - half, grid.drive_out + half, x3];
    let mut sides: Vec<[Side; 2]> = Vec::new();
    for (i, cut) in [[0, 1], [2, 3], [4, 5]].into_iter().enumerate() {
        let axis = straight(Vec2::new(cuts[cut[0]], 0.0), Vec2::new(cuts[cut[1]], 0.0));
        let median_m = vec![0.0; axis.len()];
        let id = format!("street{}", i + 1);
        let plan =
            Plan { id: &id, profile, axis: &axis, median_m: &median_m, raised_m: 0.0, stops: [false, false] };
        let road = plan.draw(draft);
        if i == 0 {
            road.right.lanes.iter().for_each(|lane| draft.about[*lane].open[0] = true);
            road.left.lanes.iter().for_each(|lane| draft.about[*lane].open[1] = true);
        } else if i == 2 {
            road.left.lanes.iter().for_each(|lane| draft.about[*lane].open[0] = true);
            road.right.lanes.iter().for_each(|lane| draft.about[*lane].open[1] = true);
        }
        sides.push([road.right, road.left]);
    }
    let lane = |i: usize, side: usize| sides[i][side].lanes[0];
    let mut ways = Ways { draft };
    let (x_in, x_out) = (grid.drive_in, grid.drive_out);
    let start = profile.half_m(1) + DRIVE_FROM_M;
    let drive_in = ways.lane(
        "drive-in".into(),
        Vec2::new(x_in, start),
        Vec2::new(x_in, grid.below - TURN_M),
        DRIVE_M * 0.7,
    );
    let drive_out = ways.lane(
        "drive-out".into(),
        Vec2::new(x_out, grid.above - TURN_M),
        Vec2::new(x_out, start),
        DRIVE_M * 0.7,
    );
    // Eastbound lanes on the near side, westbound on the far side; the park lies left of the eastbound lanes.
    for pair in [[0, 1], [1, 2]] {
        ways.turn(lane(pair[0], 0), lane(pair[1], 0));
        ways.turn(lane(pair[1], 1), lane(pair[0], 1));
    }
    ways.turn(lane(0, 0), drive_in);
    ways.turn(lane(1, 1), drive_in);
    let left = ways.turn(drive_out, lane(2, 0));
    let right = ways.turn(drive_out, lane(1, 1));
    let signed = [left, right].map(|lane| draft.map.lanes[lane].id.clone());
    draft.stop_sign(Vec2::new(x_out - DRIVE_M / 2.0 - 0.5, start), signed.to_vec());
}

/// Lanes and bays of the park.
fn park(draft: &mut MapDraft, layout: &CarPark, grid: &Grid) {
    let width_m = layout.aisle_m.min(4.0);
    let (Some(drive_in), Some(drive_out)) = (index(draft, "drive-in"), index(draft, "drive-out")) else {
        return;
    };
    let mut ways = Ways { draft };
    let last = grid.aisles.len() - 1;
    let mut aisles: Vec<usize> = Vec::new();
    for (i, x) in grid.aisles.iter().enumerate() {
        let (a, b) = (Vec2::new(*x, grid.below + TURN_M), Vec2::new(*x, grid.above - TURN_M));
        aisles.push(ways.lane(format!("aisle{}", i + 1), a, b, width_m));
    }
    // Along the bottom from aisle to aisle, and along the top.
    let (mut bottom, mut top): (Option<usize>, Option<usize>) = (None, None);
    for (i, x) in grid.aisles.iter().enumerate() {
        let before = if i == 0 { grid.drive_in } else { grid.aisles[i - 1] };
        let row = |y: f64| (Vec2::new(before + TURN_M, y), Vec2::new(x - TURN_M, y));
        let (a, b) = row(grid.below);
        // The first stretch is a turn where the aisle is near.
        if b.x - a.x > 1.0 {
            let lane = ways.lane(format!("below{}", i + 1), a, b, width_m);
            match bottom {
                None => ways.turn(drive_in, lane),
                Some(bottom) => ways.turn(bottom, lane),
            };
            ways.turn(lane, aisles[i]);
            bottom = Some(lane);
        } else {
            ways.turn(bottom.unwrap_or(drive_in), aisles[i]);
        }
        let next = if i == last { grid.drive_out } else { grid.aisles[i + 1] };
        let (a, b) = (Vec2::new(x + TURN_M, grid.above), Vec2::new(next - TURN_M, grid.above));
        if b.x - a.x > 1.0 {
            let lane = ways.lane(format!("above{}", i + 1), a, b, width_m);
            ways.turn(aisles[i], lane);
            if let Some(top) = top {
                ways.turn(top, lane);
            }
            if i == last {
                ways.turn(lane, drive_out);
            }
            top = Some(lane);
        } else {
            ways.turn(aisles[i], drive_out);
            if let Some(top) = top {
                ways.turn(top, drive_out);
            }
        }
    }
    bays(draft, layout, grid);
}

fn index(draft: &MapDraft, id: &str) -> Option<usize> {
    draft.map.lanes.iter().position(|lane| lane.id == id)
}

fn bays(draft: &mut MapDraft, layout: &CarPark, grid: &Grid) {
    for (i, x) in grid.aisles.iter().enumerate() {
        for (word, sign) in [("w", -1.0), ("e", 1.0)] {
            let near = x + sign * layout.aisle_m / 2.0;
            let far = near + sign * layout.bay_length_m;
            for k in 0..=layout.bays {
                let y = grid.bays[0] + f64::from(k) * layout.bay_width_m;
                draft.line("solid_single_white", vec![Vec2::new(near, y), Vec2::new(far, y)]);
                if k < layout.bays {
                    let y = y + layout.bay_width_m / 2.0;
                    let line = vec![Vec2::new(near, y), Vec2::new(far, y)];
                    let id = format!("bay{}{word}{}", i + 1, k + 1);
                    draft.lane(id, LaneType::Parking, line, layout.bay_width_m, 0.0);
                }
            }
            draft
                .line("solid_single_white", vec![Vec2::new(far, grid.bays[0]), Vec2::new(far, grid.bays[1])]);
        }
    }
}

/// The far kerb of the street, its near kerb with the openings of the drives, and the outline of the park.
fn kerbs(draft: &mut MapDraft, layout: &CarPark, grid: &Grid, kerb_m: f64, radius_m: f64) {
    let (x0, x3) = (grid.low.x - BEYOND_M, grid.high.x + BEYOND_M);
    let half = DRIVE_M / 2.0;
    // Round the corner from the street up a drive.
    let up = |x: f64| arc(Vec2::new(x - radius_m, kerb_m + radius_m), radius_m, -FRAC_PI_2, 0.0);
    let down = |x: f64| arc(Vec2::new(x + radius_m, kerb_m + radius_m), radius_m, PI, PI + FRAC_PI_2);
    let (low, high) = (grid.low, grid.high);
    let mut outer = vec![Vec2::new(x0, kerb_m)];
    outer.extend(up(grid.drive_in - half));
    let corner_y = grid.below + layout.aisle_m / 2.0;
    outer.push(Vec2::new(low.x, corner_y));
    outer.extend([Vec2::new(grid.left, corner_y), Vec2::new(grid.left, high.y), high]);
    outer.extend(down(grid.drive_out + half));
    outer.push(Vec2::new(x3, kerb_m));
    let mut inner = vec![Vec2::new(grid.drive_in + half, low.y)];
    inner.extend(down(grid.drive_in + half));
    inner.extend(up(grid.drive_out - half));
    inner.push(Vec2::new(grid.drive_out - half, low.y));
    inner.push(inner[0]);
    let far = straight(Vec2::new(x3, -kerb_m), Vec2::new(x0, -kerb_m));
    let mut ring = tidy(outer.clone());
    ring.extend(far.iter().copied());
    let mut hole = tidy(inner.clone());
    hole.pop();
    draft.ground(ring, vec![hole]);
    for line in [outer, inner, far] {
        draft.edge("boundary", tidy(line));
    }
    if layout.sidewalk_m > 0.0 {
        let aside = layout.sidewalk_m / 2.0 + 0.2 + kerb_m;
        let walk = |draft: &mut MapDraft, a: f64, b: f64, y: f64| {
            draft.sidewalk(straight(Vec2::new(a, y), Vec2::new(b, y)), layout.sidewalk_m, false)
        };
        walk(draft, x0, x3, -aside);
        let mouth = half + radius_m;
        walk(draft, x0, grid.drive_in - mouth, aside);
        walk(draft, grid.drive_in + mouth, grid.drive_out - mouth, aside);
        walk(draft, grid.drive_out + mouth, x3, aside);
    }
}
