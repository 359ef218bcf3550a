//! Converts recordings of SUMO to realistic tracks. Whole recordings are smoothed before windows are cut, so
//! that windows have no edge effects.

use super::filters::{gaussian, gradient, interpolate, noise, unwrap};
use super::fleet::ActorKind;
use super::{DT_S, RECORDED_S, WARM_UP_S};
use formats::polyline::{arc_lengths, point_at};
use formats::sumo::fcd::FcdTrack;
use scene::geometry::direction;
use scene::random::Stream;
use scene::{AgentType, STANDING_MPS, State, Vec2, wrap_angle};

/// Shortest recording that is used, steps.
const SHORTEST: usize = 15;
/// Spacing of the points of smoothed paths, metres.
const GRID_M: f64 = 0.25;

/// A cleaned track over the recording: `states[k]` is step `first + k`.
#[derive(Clone, Debug, Default)]
pub struct Cleaned {
    /// Step of the recording of the first state.
    pub first: usize,
    /// States without gaps.
    pub states: Vec<State>,
    /// Steps at which a vehicle jumps; windows leave these steps out.
    pub jumps: Vec<usize>,
}

impl Cleaned {
    /// State at a step of the recording.
    pub fn at(&self, step: usize) -> Option<&State> {
        self.states.get(step.checked_sub(self.first)?)
    }
}

/// Cleans one recording; `None` when it is too short or has gaps.
pub fn clean(record: &FcdTrack, kind: &ActorKind, draw: &mut Stream) -> Option<Cleaned> {
    let step = |t: f64| ((t - WARM_UP_S) / DT_S).round() as isize;
    let steps: Vec<isize> = record.times_s.iter().map(|t| step(*t)).collect();
    let last_step = (RECORDED_S / DT_S) as isize;
    let from = steps.iter().position(|s| *s >= 0)?;
    let to = steps.iter().rposition(|s| *s <= last_step)? + 1;
    if to < from + SHORTEST || steps[to - 1] - steps[from] + 1 != (to - from) as isize {
        return None;
    }
    let jump_at = |i: usize| {
        let moved = (record.positions[i + 1] - record.positions[i]).norm();
        let allowed = record.speeds_mps[i].max(record.speeds_mps[i + 1]) * DT_S;
        moved - allowed > if kind.on_foot { 1.2 } else { 0.5 }
    };
    let jumps: Vec<usize> = (from..to - 1).filter(|&i| jump_at(i)).collect();
    if !kind.on_foot {
        let states = drive(record, from..to, kind, draw);
        let jumps = jumps.iter().map(|i| steps[*i] as usize).collect();
        return Some(Cleaned { first: steps[from] as usize, states, jumps });
    }
    // Persons sometimes jump by the length of a crosswalk: the longest part between such jumps is kept.
    let mut ends = vec![from];
    ends.extend(jumps.iter().map(|i| i + 1));
    ends.push(to);
    let longest = ends.windows(2).max_by_key(|w| w[1] - w[0])?;
    if longest[1] - longest[0] < SHORTEST {
        return None;
    }
    let states = walk(record, longest[0]..longest[1], kind, draw);
    Some(Cleaned { first: steps[longest[0]] as usize, states, jumps: Vec::new() })
}

fn split(points: &[Vec2]) -> (Vec<f64>, Vec<f64>) {
    (points.iter().map(|p| p.x).collect(), points.iter().map(|p| p.y).collect())
}

fn blur(points: &[Vec2], sigma: f64) -> Vec<Vec2> {
    let (x, y) = split(points);
    gaussian(&x, sigma).into_iter().zip(gaussian(&y, sigma)).map(|(x, y)| Vec2::new(x, y)).collect()
}

/// Deviation of a driver from the lane centre.
struct Habit {
    /// Smoothing of the path, metres.
    smoothing: f64,
    /// Noise along the path: correlation and deviation, metres.
    wander: (f64, f64),
    /// Constant offset to the right, metres.
    offset: f64,
    /// Pull to the inside of bends, metres for a curvature of 1/m.
    cutting: f64,
    /// Factor on the ripple of progress.
    ripple: f64,
}

impl Habit {
    fn new(kind: &ActorKind, draw: &mut Stream) -> Self {
        if kind.agent_type == AgentType::Cyclist {
            return Self {
                smoothing: 1.6,
                wander: (5.0, 0.15),
                offset: draw.normal_about(0.0, 0.1),
                cutting: draw.clipped(1.0, 1.0, 0.0, 3.0),
                ripple: 2.0,
            };
        }
        let long = kind.size.length_m > 7.0;
        Self {
            smoothing: 2.2,
            wander: (38.0, 0.16),
            offset: draw.normal_about(0.0, 0.24),
            // A mean of 10 brings lane centres closest to recorded bends. Long vehicles swing out instead.
            cutting: if long { 0.0 } else { draw.clipped(10.0, 5.0, 0.0, 20.0) },
            ripple: 1.0,
        }
    }
}

/// A vehicle, or a cyclist on the road. The recorded front bumper gives a smooth path and the progress along
/// it; the rear axle follows the path.
fn drive(
    record: &FcdTrack,
    range: std::ops::Range<usize>,
    kind: &ActorKind,
    draw: &mut Stream,
) -> Vec<State> {
    let body = kind.size.length_m;
    let habit = Habit::new(kind, draw);
    let (points, speeds) = (&record.positions[range.clone()], &record.speeds_mps[range.clone()]);
    let headings = &record.headings_rad[range];
    let travelled = arc_lengths(points);
    let (path, grid) = smooth_path(points, &travelled, speeds, headings, body, &habit, draw);
    let along = arc_lengths(&path);

    // Progress: low-pass filtered, with a ripple in position (a ripple in speed would drift by metres), never
    // backwards.
    let n = points.len();
    let raw: Vec<f64> = travelled.iter().map(|s| interpolate(&grid, &along, *s)).collect();
    let mut progress = gaussian(&raw, 2.5);
    let speed = gradient(&progress, DT_S);
    let moving: Vec<f64> = speed.iter().map(|v| if *v > 0.4 { 1.0 } else { 0.0 }).collect();
    let moving = gaussian(&moving, 3.0);
    let (quick, slow) = (noise(draw, n, 2.6, 0.028), noise(draw, n, 9.0, 0.11));
    let mut furthest = f64::NEG_INFINITY;
    for i in 0..n {
        let scale =
            (0.5 + 0.05 * speed[i].clamp(0.0, 20.0)) * moving[i].clamp(0.0, 1.0).powi(2) * habit.ripple;
        furthest = furthest.max(progress[i] + (quick[i] + slow[i]) * scale);
        progress[i] = furthest;
    }

    // Kinematic bicycle model: the heading is the direction of the path at the rear axle, and the centre lies
    // ahead of it.
    let rear_to_centre = 0.28 * body;
    let at = |s: f64| point_at(&path, &along, s);
    let mut heading = Vec::with_capacity(n);
    let mut centre = Vec::with_capacity(n);
    for s in &progress {
        let rear = s - body / 2.0 - rear_to_centre;
        let chord = at(rear + 0.12 * body) - at(rear - 0.08 * body);
        let h = chord.y.atan2(chord.x);
        heading.push(h);
        centre.push(at(rear) + direction(h) * rear_to_centre);
    }
    states(&centre, &gaussian(&unwrap(&heading), 1.0))
}

/// The path on its grid, and the recorded arc length at each grid point.
fn smooth_path(
    points: &[Vec2],
    travelled: &[f64],
    speeds: &[f64],
    headings: &[f64],
    body: f64,
    habit: &Habit,
    draw: &mut Stream,
) -> (Vec<Vec2>, Vec<f64>) {
    let last = points.len() - 1;
    let (back, ahead) = (body + 8.0, 6.0);
    // One point per grid cell that was reached: standstill adds none.
    let mut xs = vec![-back];
    let mut ps = vec![points[0] - direction(headings[0]) * back];
    for i in 0..=last {
        let new_cell =
            i == 0 || i == last || (travelled[i] / GRID_M).floor() > (travelled[i - 1] / GRID_M).floor();
        if new_cell && xs[xs.len() - 1] + 1e-6 < travelled[i] {
            xs.push(travelled[i]);
            ps.push(points[i]);
        }
    }
    xs.push(travelled[last] + ahead);
    ps.push(points[last] + direction(headings[last]) * ahead);
    let (px, py) = split(&ps);
    let count = ((xs[xs.len() - 1] + back) / GRID_M) as usize;
    let grid: Vec<f64> = (0..count).map(|i| -back + GRID_M * i as f64).collect();
    let raw: Vec<Vec2> =
        grid.iter().map(|s| Vec2::new(interpolate(&xs, &px, *s), interpolate(&xs, &py, *s))).collect();
    // Longer smoothing at speed, so that a lane change takes seconds instead of one step.
    let sigma = habit.smoothing / GRID_M;
    let (near, far) = (blur(&raw, sigma), blur(&raw, 3.2 * sigma));
    let speed: Vec<f64> = grid.iter().map(|s| interpolate(travelled, speeds, *s)).collect();
    let speed = gaussian(&speed, 20.0);
    let blended: Vec<Vec2> = (0..count)
        .map(|i| {
            let share = ((speed[i] - 6.0) / 10.0).clamp(0.0, 1.0);
            near[i] * (1.0 - share) + far[i] * share
        })
        .collect();
    let (x, y) = split(&blended);
    let (dx, dy) = (gradient(&x, GRID_M), gradient(&y, GRID_M));
    let way: Vec<f64> = unwrap(&dx.iter().zip(&dy).map(|(x, y)| y.atan2(*x)).collect::<Vec<_>>());
    // Drivers start to cut a bend before it and continue after it, so the pull follows the smoothed
    // curvature.
    let pull = gaussian(&gradient(&way, GRID_M), 5.0 / GRID_M);
    let wander = noise(draw, count, habit.wander.0 / GRID_M, habit.wander.1);
    let path = (0..count)
        .map(|i| {
            let right = Vec2::new(way[i].sin(), -way[i].cos());
            let cut = (pull[i] * habit.cutting).clamp(-1.6, 1.6);
            blended[i] + right * (wander[i] + habit.offset - cut)
        })
        .collect();
    (path, grid)
}

/// A pedestrian, or a cyclist on the sidewalk.
fn walk(record: &FcdTrack, range: std::ops::Range<usize>, kind: &ActorKind, draw: &mut Stream) -> Vec<State> {
    let heading_0 = record.headings_rad[range.start];
    let points = blur(&record.positions[range], 5.0);
    let n = points.len();
    let (x, y) = split(&points);
    let (vx, vy) = (gradient(&x, DT_S), gradient(&y, DT_S));
    let speed: Vec<f64> = vx.iter().zip(&vy).map(|(x, y)| x.hypot(*y)).collect();
    let (wx, wy) = (gaussian(&vx, 3.0), gaussian(&vy, 3.0));
    // Direction of motion, held while standing.
    let first_moving = speed.iter().position(|v| *v >= 0.15);
    let mut way = vec![heading_0; n];
    if let Some(first) = first_moving {
        way[first] = wy[first].atan2(wx[first]);
        for i in 0..n {
            way[i] = if i <= first {
                way[first]
            } else if speed[i] < 0.15 {
                way[i - 1]
            } else {
                wy[i].atan2(wx[i])
            };
        }
    }
    let way = unwrap(&way);
    let moving: Vec<f64> = speed.iter().map(|v| if *v > STANDING_MPS { 1.0 } else { 0.0 }).collect();
    let moving: Vec<f64> = gaussian(&moving, 8.0).into_iter().map(|m| m.clamp(0.0, 1.0)).collect();
    let stride = if kind.agent_type == AgentType::Cyclist { 1.5 } else { 1.0 };
    let (drift, slow, quick) =
        (noise(draw, n, 40.0, 0.22), noise(draw, n, 14.0, 0.12), noise(draw, n, 4.0, 0.027));
    let (pace, gait) = (noise(draw, n, 7.0, 0.09), noise(draw, n, 2.5, 0.023));
    let turn = noise(draw, n, 3.5, 0.028);
    let placed: Vec<Vec2> = (0..n)
        .map(|i| {
            let (d, left) = (direction(way[i]), Vec2::new(-way[i].sin(), way[i].cos()));
            points[i]
                + left * ((slow[i] + quick[i] + drift[i] * stride) * moving[i])
                + d * ((pace[i] + gait[i]) * moving[i])
        })
        .collect();
    let heading: Vec<f64> =
        gaussian(&way, 4.0).iter().enumerate().map(|(i, h)| h + turn[i] * (0.3 + 0.7 * moving[i])).collect();
    states(&placed, &heading)
}

/// A standing pedestrian.
pub fn stand(place: Vec2, heading_rad: f64, draw: &mut Stream) -> Cleaned {
    let n = (RECORDED_S / DT_S) as usize + 1;
    let (x, y, h) = (noise(draw, n, 25.0, 0.05), noise(draw, n, 25.0, 0.05), noise(draw, n, 60.0, 0.25));
    let points: Vec<Vec2> = (0..n).map(|i| place + Vec2::new(x[i], y[i])).collect();
    let headings: Vec<f64> = h.iter().map(|v| heading_rad + v).collect();
    Cleaned { first: 0, states: states(&points, &headings), jumps: Vec::new() }
}

/// A box that never moves.
pub fn still(place: Vec2, heading_rad: f64) -> Cleaned {
    let n = (RECORDED_S / DT_S) as usize + 1;
    let state =
        State { x_m: place.x, y_m: place.y, heading_rad: wrap_angle(heading_rad), ..State::default() };
    Cleaned { first: 0, states: vec![state; n], jumps: Vec::new() }
}

fn states(points: &[Vec2], headings: &[f64]) -> Vec<State> {
    let (x, y) = split(points);
    let (vx, vy) = (gradient(&x, DT_S), gradient(&y, DT_S));
    (0..points.len())
        .map(|i| {
            let stands = vx[i].hypot(vy[i]) < 0.03;
            State {
                x_m: x[i],
                y_m: y[i],
                heading_rad: wrap_angle(headings[i]),
                vx_mps: if stands { 0.0 } else { vx[i] },
                vy_mps: if stands { 0.0 } else { vy[i] },
            }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::super::random::Purpose;
    use super::*;
    use scene::{Size, Subtype};

    fn kind(on_foot: bool) -> ActorKind {
        let agent_type = if on_foot { AgentType::Pedestrian } else { AgentType::Vehicle };
        let size = Size { length_m: 4.7, width_m: 2.0, height_m: None };
        ActorKind { agent_type, subtype: Subtype::Unknown, size, on_foot }
    }

    /// 10 m/s east, then a stop.
    fn record() -> FcdTrack {
        let speed = |i: usize| (10.0 - 0.03 * i as f64 * DT_S * 30.0).max(0.0);
        let mut record = FcdTrack { vehicle_type: "car0".into(), ..FcdTrack::default() };
        let mut x = 0.0;
        for i in 0..300 {
            record.times_s.push(WARM_UP_S + i as f64 * DT_S);
            record.positions.push(Vec2::new(x, 5.0));
            record.headings_rad.push(0.0);
            record.speeds_mps.push(speed(i));
            x += speed(i) * DT_S;
        }
        record
    }

    #[test]
    fn a_car_stays_near_its_recording() {
        let record = record();
        let cleaned = clean(&record, &kind(false), &mut Purpose::Motion.stream(5)).unwrap();
        assert_eq!((cleaned.first, cleaned.states.len()), (0, 300));
        for (state, front) in cleaned.states.iter().zip(&record.positions) {
            let centre = front - Vec2::new(2.35, 0.0);
            assert!((state.position() - centre).norm() < 1.6, "{state:?} {centre:?}");
            assert!(state.heading_rad.abs() < 0.1);
        }
        let forward = cleaned.states.windows(2).all(|w| w[1].x_m >= w[0].x_m - 1e-9);
        assert!(forward);
    }

    #[test]
    fn a_walker_is_cut_at_a_jump() {
        let mut record = record();
        for (i, p) in record.positions.iter_mut().enumerate() {
            *p = Vec2::new(0.13 * i as f64 + if i >= 100 { 20.0 } else { 0.0 }, 0.0);
        }
        record.speeds_mps = vec![1.3; 300];
        let cleaned = clean(&record, &kind(true), &mut Purpose::Motion.stream(5)).unwrap();
        assert_eq!((cleaned.first, cleaned.states.len()), (100, 200));
    }

    #[test]
    fn gaps_and_short_records_are_refused() {
        let mut short = record();
        short.times_s.truncate(10);
        assert!(clean(&short, &kind(false), &mut Purpose::Motion.stream(5)).is_none());
        let mut gap = record();
        for t in &mut gap.times_s[100..] {
            *t += 5.0;
        }
        assert!(clean(&gap, &kind(false), &mut Purpose::Motion.stream(5)).is_none());
    }
}
