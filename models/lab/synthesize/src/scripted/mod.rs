//! Manoeuvres that SUMO lacks: leaving parking places and driveways, parking, U-turns between junctions, and
//! crossing away from crosswalks. Each has its own path and is cleaned like other tracks. It is kept only
//! with enough distance from all others, because simulated road users do not react to it.

mod turning;

use super::filters::interpolate;
use super::fleet::{ActorKind, Fleet};
use super::recording::SimulatedAgent;
use super::tracks::{self, Cleaned};
use super::{DT_S, RECORDED_S, WARM_UP_S};
use formats::polyline::{arc_lengths, length, part, point_at, resample};
use formats::sumo::fcd::FcdTrack;
use formats::sumo::kerb::s_curve;
use formats::sumo::net::{EdgeFunction, LaneKind, Net};
use scene::geometry::direction;
use scene::geometry::obb::{OrientedBox, signed_gap};
use scene::random::Stream;
use scene::{AgentType, State, Vec2, wrap_angle};
use std::ops::Range;

/// Shares of parked cars that try to leave, and of free places in which a car tries to park.
const LEAVING: f64 = 0.10;
/// Expected number of cars that try a U-turn.
const TURNING_BACK: f64 = 6.0;
/// Least distance of scripted cars from all others, metres.
const CLEAR_M: f64 = 0.8;
/// The same for crossing pedestrians.
const WALK_CLEAR_M: f64 = 1.5;
/// Greatest curvature of a manoeuvre, 1/m.
const SHARPEST: f64 = 0.20;
/// Distance along the lanes before or after a manoeuvre, metres.
const ALONG_M: f64 = 110.0;

/// Adds scripted road users.
pub fn add(net: &Net, fleet: &Fleet, actors: &mut Vec<SimulatedAgent>, draw: &mut Stream) {
    let lanes = Lanes::new(net);
    let parked: Vec<usize> = (0..actors.len()).filter(|i| actors[*i].parked).collect();
    for i in parked {
        if !draw.chance(LEAVING) {
            continue;
        }
        let leaves = draw.chance(0.6);
        let found = (0..3).find_map(|_| {
            let record =
                if leaves { lanes.leaving(&actors[i], draw) } else { lanes.arriving(&actors[i], draw) }?;
            let kind = ActorKind {
                agent_type: AgentType::Vehicle,
                subtype: actors[i].subtype,
                size: actors[i].size,
                on_foot: false,
            };
            let track = tracks::clean(&record, &kind, draw)?;
            free(&track, Some(i), &actors[i].size, actors, CLEAR_M).then_some(track)
        });
        if let Some(track) = found {
            actors[i].track = track;
            actors[i].parked = false;
        }
    }
    for _ in 0..draw.poisson(TURNING_BACK) {
        let Some(kind) = fleet.kinds.get(fleet.pick(draw, "car")) else { return };
        let Some(record) = (0..40).find_map(|_| lanes.turning_back(draw)) else { continue };
        let Some(track) = tracks::clean(&record, kind, draw) else { continue };
        if free(&track, None, &kind.size, actors, CLEAR_M) {
            actors.push(SimulatedAgent::of(kind, track));
        }
    }
    let walkers = actors.iter().filter(|a| a.agent_type == AgentType::Pedestrian).count();
    for _ in 0..draw.poisson(2.0 + 0.15 * walkers as f64) {
        let Some(kind) = fleet.kinds.get(fleet.pick(draw, "walker")) else { return };
        let Some(record) = lanes.crossing(draw) else { continue };
        let Some(track) = tracks::clean(&record, kind, draw) else { continue };
        if free(&track, None, &kind.size, actors, WALK_CLEAR_M) {
            actors.push(SimulatedAgent::of(kind, track));
        }
    }
}

/// Whether a track keeps its distance from all others except `own`, for as long as it moves.
fn free(
    track: &Cleaned,
    own: Option<usize>,
    size: &scene::Size,
    actors: &[SimulatedAgent],
    clear_m: f64,
) -> bool {
    let moving: Vec<usize> = (0..track.states.len())
        .filter(|i| track.states[*i].speed_mps() > 0.05)
        .map(|i| track.first + i)
        .collect();
    let (Some(from), Some(to)) = (moving.first(), moving.last()) else { return false };
    (*from..=*to).step_by(3).all(|step| {
        let Some(state) = track.at(step) else { return true };
        let own_box = OrientedBox::of_state(state, size);
        actors.iter().enumerate().filter(|(i, _)| Some(*i) != own).all(|(_, other)| {
            let Some(there) = other.track.at(step) else { return true };
            let apart = (there.position() - state.position()).norm();
            let reach = own_box.radius_m() + 0.5 * other.size.length_m.hypot(other.size.width_m) + clear_m;
            // Parked neighbours may be closer than moving ones.
            let wanted = if other.parked { 0.1 } else { clear_m };
            apart > reach || signed_gap(&own_box, &OrientedBox::of_state(there, &other.size)) > wanted
        })
    })
}

/// Traffic lanes as sampled points, and sidewalks to cross from.
struct Lanes<'a> {
    net: &'a Net,
    /// Points of all carriageways with half of their lane's width.
    road: Vec<(Vec2, f64)>,
    /// Positions on traffic lanes outside junctions, 1 m apart, away from the ends of lanes.
    places: Vec<LanePlace>,
    sidewalks: Vec<usize>,
}

/// A position on a lane.
struct LanePlace {
    lane: usize,
    s_m: f64,
    position: Vec2,
    heading_rad: f64,
}

impl<'a> Lanes<'a> {
    fn new(net: &'a Net) -> Self {
        let carries = |k: LaneKind| matches!(k, LaneKind::Vehicle | LaneKind::Bike | LaneKind::Closed);
        let lanes = net.lanes.iter().filter(|l| carries(l.kind));
        let road =
            lanes.flat_map(|l| resample(&l.shape, 2.0).into_iter().map(|p| (p, 0.5 * l.width_m))).collect();
        let usable = |i: &usize| {
            let (lane, edge) = (&net.lanes[*i], net.edge_of(*i));
            let busy = matches!(edge.road_type.as_str(), "arterial" | "motorway");
            lane.kind == LaneKind::Sidewalk
                && edge.function == EdgeFunction::Normal
                && !busy
                && length(&lane.shape) > 40.0
        };
        let mut places = Vec::new();
        for (i, lane) in net.lanes.iter().enumerate() {
            if lane.kind != LaneKind::Vehicle || net.edge_of(i).function != EdgeFunction::Normal {
                continue;
            }
            let lengths = arc_lengths(&lane.shape);
            let mut s_m = 6.0;
            while s_m < lengths[lengths.len() - 1] - 12.0 {
                let position = point_at(&lane.shape, &lengths, s_m);
                places.push(LanePlace {
                    lane: i,
                    s_m,
                    position,
                    heading_rad: heading_at(&lane.shape, &lengths, s_m),
                });
                s_m += 1.0;
            }
        }
        Self { net, road, places, sidewalks: (0..net.lanes.len()).filter(usable).collect() }
    }

    /// The traffic lane beside a parked car: its index and the arc length of the foot.
    fn beside(&self, place: Vec2, heading_rad: f64) -> Option<(usize, f64)> {
        // Only positions on lanes at less than about 100° to the car.
        let fits = |p: &&LanePlace| {
            (p.position - place).norm() < 11.0 && wrap_angle(p.heading_rad - heading_rad).abs() < 1.75
        };
        let away = |p: &LanePlace| (p.position - place).norm();
        let nearest = self.places.iter().filter(fits).min_by(|a, b| away(a).total_cmp(&away(b)))?;
        Some((nearest.lane, nearest.s_m))
    }

    /// The centre line from an arc length of a lane onwards, continued on randomly chosen lanes through
    /// junctions.
    fn onwards(&self, lane: usize, from: f64, draw: &mut Stream) -> Vec<Vec2> {
        let shape = &self.net.lanes[lane].shape;
        let mut line = part(shape, from, length(shape));
        let mut at = lane;
        while length(&line) < ALONG_M {
            let next: Vec<usize> = self.net.lanes[at]
                .successors
                .iter()
                .copied()
                .filter(|n| self.net.lanes[*n].kind == LaneKind::Vehicle)
                .collect();
            if next.is_empty() {
                break;
            }
            at = next[draw.below(next.len())];
            line.extend(self.net.lanes[at].shape.iter().skip(1));
        }
        line
    }

    /// The centre line that leads to a lane's arc length, only on this lane.
    fn towards(&self, lane: usize, to: f64) -> Vec<Vec2> {
        part(&self.net.lanes[lane].shape, (to - ALONG_M).max(0.0), to)
    }

    /// A car that leaves a parking place or driveway and continues along the lanes.
    fn leaving(&self, car: &SimulatedAgent, draw: &mut Stream) -> Option<FcdTrack> {
        let state = car.track.states.first()?;
        let (lane, foot) = self.beside(state.position(), state.heading_rad)?;
        let front = front_of(state, car);
        let line = self.onwards(lane, foot, draw);
        let lengths = arc_lengths(&line);
        let turned = wrap_angle(heading_at(&line, &lengths, 0.0) - state.heading_rad).abs();
        let join = draw.between(9.0, 15.0) + 3.0 * turned;
        if lengths[lengths.len() - 1] < join + 25.0 {
            return None;
        }
        let way = heading_at(&line, &lengths, join);
        let mut path = hermite(front, state.heading_rad, point_at(&line, &lengths, join), way)?;
        let slow_until = length(&path);
        path.extend(part(&line, join + 0.5, lengths[lengths.len() - 1]));
        let start = draw.between(1.0, RECORDED_S - 25.0);
        let (accel, top) = (draw.clipped(1.3, 0.4, 0.6, 2.4), draw.clipped(9.0, 2.0, 5.0, 13.0));
        let slow = draw.between(2.2, 4.2);
        // It leaves slowly, then accelerates.
        let speeds = progress(&path, |s, v| {
            if s < slow_until { slow.min(v + accel * DT_S) } else { (v + accel * DT_S).min(top) }
        });
        Some(record(&path, state.heading_rad, start, &speeds, 0.0))
    }

    /// A car that drives along the lane and then parks; only for places parallel to the road.
    fn arriving(&self, car: &SimulatedAgent, draw: &mut Stream) -> Option<FcdTrack> {
        let state = car.track.states.first()?;
        let (lane, foot) = self.beside(state.position(), state.heading_rad)?;
        let line = self.towards(lane, foot);
        let lengths = arc_lengths(&line);
        let total = lengths[lengths.len() - 1];
        let off = draw.between(11.0, 17.0);
        let parallel = wrap_angle(heading_at(&line, &lengths, total) - state.heading_rad).abs() < 0.3;
        if !parallel || total < off + 30.0 {
            return None;
        }
        let at = point_at(&line, &lengths, total - off);
        let curve =
            hermite(at, heading_at(&line, &lengths, total - off), front_of(state, car), state.heading_rad)?;
        let mut path = part(&line, 0.0, total - off - 0.5);
        path.extend(curve);
        let end = length(&path);
        let (top, brake) = (draw.clipped(9.0, 2.0, 5.0, 13.0), draw.clipped(1.4, 0.3, 0.8, 2.2));
        let speeds = progress(&path, |s, v| {
            let may = (2.0 * brake * (end - s - 0.02).max(0.0)).sqrt();
            if s == 0.0 { top.min(may) } else { top.min(may).max(v - 3.0 * DT_S) }
        });
        let start = draw.between(0.0, RECORDED_S - 30.0);
        let record = record(&path, heading_at(&line, &lengths, 0.0), start, &speeds, top);
        entering(&record, start)
    }

    /// A pedestrian who crosses the road away from crosswalks.
    fn crossing(&self, draw: &mut Stream) -> Option<FcdTrack> {
        if self.sidewalks.is_empty() {
            return None;
        }
        let shape = &self.net.lanes[self.sidewalks[draw.below(self.sidewalks.len())]].shape;
        let lengths = arc_lengths(shape);
        let total = lengths[lengths.len() - 1];
        let along = draw.between(14.0, total - 14.0);
        let from = point_at(shape, &lengths, along);
        let lane = heading_at(shape, &lengths, along);
        // A sidewalk lies to the right of its road; pedestrians cross at a slight angle.
        let way = direction(lane + std::f64::consts::FRAC_PI_2 + draw.normal_about(0.0, 0.25));
        let on_road = |p: Vec2| self.road.iter().any(|(q, half)| (p - q).norm() < half + 0.9);
        let (mut reach, mut entered) = (0.0, false);
        while reach < 32.0 {
            reach += 0.5;
            let there = on_road(from + way * reach);
            entered |= there;
            if entered && !there {
                break;
            }
        }
        if !entered || reach >= 32.0 {
            return None;
        }
        // A few steps along the sidewalk before and after.
        let side = direction(lane) * if draw.chance(0.5) { 1.0 } else { -1.0 };
        let (before, after) = (draw.between(2.0, 8.0), draw.between(3.0, 10.0));
        let over = from + way * (reach + 0.8);
        let path = resample(&[from - side * before, from, over, over + side * after], 0.25);
        let pace = draw.clipped(1.45, 0.25, 0.9, 2.6);
        let end = length(&path);
        let speeds = progress(&path, |s, _| if s + 0.05 < end { pace } else { 0.0 });
        let start = draw.between(0.0, RECORDED_S - end / pace - 1.0);
        let record = record(&path, heading_at(&path, &arc_lengths(&path), 0.0), start, &speeds, pace);
        let first = record.times_s.iter().position(|t| *t >= WARM_UP_S + start)?;
        let last = record.speeds_mps.iter().rposition(|v| *v > 0.0)?;
        Some(cut(&record, first..last + 1))
    }
}

fn front_of(state: &State, car: &SimulatedAgent) -> Vec2 {
    state.position() + direction(state.heading_rad) * (0.5 * car.size.length_m)
}

fn heading_at(line: &[Vec2], lengths: &[f64], s: f64) -> f64 {
    let total = lengths[lengths.len() - 1];
    let s = s.clamp(0.0, (total - 0.5).max(0.0));
    let chord = point_at(line, lengths, (s + 0.5).min(total)) - point_at(line, lengths, s);
    chord.y.atan2(chord.x)
}

/// A cubic curve from one pose to another; `None` if its curvature is too great.
fn hermite(from: Vec2, from_rad: f64, to: Vec2, to_rad: f64) -> Option<Vec<Vec2>> {
    let points = cubic(from, from_rad, to, to_rad, (to - from).norm());
    (sharpest(&points) < SHARPEST).then_some(points)
}

/// A cubic curve from one pose to another, with tangents of length `reach`.
fn cubic(from: Vec2, from_rad: f64, to: Vec2, to_rad: f64, reach: f64) -> Vec<Vec2> {
    s_curve(from, direction(from_rad) * reach, to, direction(to_rad) * reach, 40)
}

/// Greatest curvature of a line, 1/m.
fn sharpest(points: &[Vec2]) -> f64 {
    let bend = |w: &[Vec2]| {
        let (p, q) = (w[1] - w[0], w[2] - w[1]);
        let turned = wrap_angle(q.y.atan2(q.x) - p.y.atan2(p.x)).abs();
        turned / (0.5 * (p.norm() + q.norm())).max(1e-6)
    };
    points.windows(3).map(bend).fold(0.0, f64::max)
}

/// Arc length at every step, from a rule for the next speed; ends with the path or the recording.
fn progress(path: &[Vec2], next: impl Fn(f64, f64) -> f64) -> Vec<f64> {
    let end = length(path);
    let (mut s, mut v) = (0.0, 0.0);
    let mut out = vec![0.0];
    while s < end - 1e-3 && out.len() < (RECORDED_S / DT_S) as usize {
        let wanted = next(s, v).max(0.0);
        if wanted <= 1e-3 && s > 0.0 {
            break;
        }
        v = wanted;
        s = (s + v * DT_S).min(end);
        out.push(s);
    }
    out
}

/// A recording of a road user that enters: its states before `start_s` are removed.
fn entering(record: &FcdTrack, start_s: f64) -> Option<FcdTrack> {
    let first = record.times_s.iter().position(|t| *t >= WARM_UP_S + start_s)?;
    Some(cut(record, first..record.times_s.len()))
}

/// A part of a recording.
fn cut(record: &FcdTrack, range: Range<usize>) -> FcdTrack {
    FcdTrack {
        vehicle_type: record.vehicle_type.clone(),
        times_s: record.times_s[range.clone()].to_vec(),
        positions: record.positions[range.clone()].to_vec(),
        headings_rad: record.headings_rad[range.clone()].to_vec(),
        speeds_mps: record.speeds_mps[range].to_vec(),
    }
}

/// A recording that stands at the path's start until `start_s`, follows the path, and stands at its end
/// when it is reached at rest.
fn record(path: &[Vec2], first_heading: f64, start_s: f64, progress: &[f64], first_speed: f64) -> FcdTrack {
    let lengths = arc_lengths(path);
    let total = lengths[lengths.len() - 1];
    let steps: Vec<f64> = (0..progress.len()).map(|i| i as f64).collect();
    let begin = (start_s / DT_S).round();
    let last_speed = progress.windows(2).next_back().map_or(0.0, |w| (w[1] - w[0]) / DT_S);
    let stays = last_speed < 0.6;
    let mut out = FcdTrack { vehicle_type: "scripted".into(), ..FcdTrack::default() };
    for i in 0..=(RECORDED_S / DT_S) as usize {
        let t = i as f64 - begin;
        if t > (progress.len() - 1) as f64 && !stays {
            break;
        }
        let s = interpolate(&steps, progress, t.clamp(0.0, (progress.len() - 1) as f64));
        let before = interpolate(&steps, progress, (t - 1.0).clamp(0.0, (progress.len() - 1) as f64));
        out.times_s.push(WARM_UP_S + i as f64 * DT_S);
        out.positions.push(point_at(path, &lengths, s));
        out.headings_rad.push(if s <= 0.0 {
            first_heading
        } else {
            heading_at(path, &lengths, s.min(total))
        });
        out.speeds_mps.push(if t == 0.0 { first_speed } else { (s - before) / DT_S });
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cubics_meet_both_poses_or_are_refused() {
        let path = hermite(Vec2::zeros(), 0.0, Vec2::new(12.0, 3.0), 0.0).unwrap();
        assert!((path[40] - Vec2::new(12.0, 3.0)).norm() < 1e-9);
        assert!((path[1] - path[0]).y.abs() < 0.1);
        assert!(hermite(Vec2::zeros(), 0.0, Vec2::new(3.0, 3.0), 3.0).is_none());
    }

    #[test]
    fn a_recording_waits_then_drives_then_stands() {
        let path: Vec<Vec2> = (0..=40).map(|i| Vec2::new(f64::from(i), 0.0)).collect();
        let driven = progress(&path, |s, v| (v + 0.2).min((2.0 * (40.0 - s - 0.02).max(0.0)).sqrt()));
        let record = record(&path, 0.0, 10.0, &driven, 0.0);
        assert_eq!(record.positions[50].x, 0.0);
        assert!(record.positions[140].x > 1.0);
        let last = record.positions.last().unwrap();
        assert!(last.x > 39.0, "{last}");
        assert_eq!(record.positions.len(), 1201);
        assert!(record.positions.windows(2).all(|w| w[1].x >= w[0].x));
    }
}
