//! Parked cars: along kerbs with room beside the lane, and in bays and parking lanes. A parking place is
//! clear of everything that is driven, walked or ridden on, and of junctions, crosswalks and driveways.

use super::cells::{CellKind, MapCell};
use super::checks::{around, on_lane};
use super::place::Sampler;
use super::placed::{PlacedAgent, rounded};
use super::pose::{Pose, draw_size};
use super::random;
use super::region::in_ring;
use super::request::{Parked, counted};
use crate::request::GenerateError;
use crate::tuning::placing::parking::{
    ASKEW_RAD, BAY_M, CAR_M, CLEAR_M, DRIVEWAY_M, DRIVEWAY_SIDE_M, END_ROOM_M, FAST_MPS, KERB_M,
    LANE_REACH_M, LONGEST_M, MIDDLE_M, NEAR_M, NOSE_IN, PLACE_M, ROOM_M, SIDE_ROOM_M, WIDEST_M,
};
use scene::Cancel;
use scene::map::LaneType;
use scene::random::Stream;
use scene::routes::graph::{GraphLane, LaneSource};
use scene::{AgentType, Size, Subtype, Vec2, wrap_angle};
use std::f64::consts::{FRAC_PI_2, PI};

/// Draws of a box for one place.
const TRIES: usize = 6;

/// A place where a car can park.
#[derive(Clone, Copy, Debug)]
struct ParkingPlace {
    /// Middle of the place; for a kerb place, the middle of its kerb side.
    at: Vec2,
    heading_rad: f64,
    length_m: f64,
    width_m: f64,
    /// Side of the kerb: +1 left of the heading, -1 right; `None` in a bay.
    kerb: Option<f64>,
}

/// Result of placing parked cars.
#[derive(Default)]
pub(super) struct ParkingResult {
    /// Number of parking places; `None` if the request has no parked cars.
    pub(super) places: Option<usize>,
    pub(super) unplaced: usize,
    pub(super) reason: Option<String>,
}

impl Sampler<'_> {
    /// Parks cars at kerbs and in lots. `free` is the number of agents that the scene can still hold.
    pub(super) fn park(&mut self, free: &mut usize, cancel: &Cancel) -> Result<ParkingResult, GenerateError> {
        let Some(asked) = self.request.parked else { return Ok(ParkingResult::default()) };
        let places = self.places();
        let share = match asked {
            Parked::Share(share) => share,
            Parked::Per100M(count) => (count * PLACE_M / 100.0).min(1.0),
        };
        let wanted = (share * places.len() as f64).round() as usize;
        if places.is_empty() {
            let none = "the map has no room for parked cars at its kerbs and no lots".to_owned();
            return Ok(ParkingResult { places: Some(0), unplaced: 0, reason: (share > 0.0).then_some(none) });
        }
        // Each place has its own draw, so a larger number of cars keeps those already placed.
        let mut order: Vec<(f64, usize)> = (0..places.len())
            .map(|at| (random::stream(self.request.seed, "parked", at).unit(), at))
            .collect();
        order.sort_by(|a, b| a.0.total_cmp(&b.0));
        let (mut done, mut full) = (0, false);
        for (_, at) in order {
            if cancel.is_cancelled() {
                return Err(GenerateError::Cancelled);
            }
            full = done < wanted && *free == 0;
            if done >= wanted || full {
                break;
            }
            let mut stream = random::stream(self.request.seed, "parked car", at);
            if let Some(car) = self.car_in(&places[at], &mut stream) {
                self.settle(car);
                done += 1;
                *free -= 1;
            }
        }
        let unplaced = wanted - done;
        let why = if full { "a scene holds no more road users" } else { "no free place to park" };
        let reason =
            (unplaced > 0).then(|| format!("{why}: {} fewer", counted(unplaced, AgentType::Vehicle)));
        Ok(ParkingResult { places: Some(places.len()), unplaced, reason })
    }

    /// A car in a place where it touches no other agent.
    fn car_in(&self, place: &ParkingPlace, stream: &mut Stream) -> Option<PlacedAgent> {
        for number in 0..TRIES {
            let (size, subtype) = match self.of_type(AgentType::Vehicle) {
                Some(model) if number + 1 < TRIES => {
                    draw_size(model, AgentType::Vehicle, CellKind::Kerb, stream)
                }
                _ => (
                    Size {
                        length_m: CAR_M.0,
                        width_m: CAR_M.1,
                        ..Size::default_for(AgentType::Vehicle, Subtype::Car)
                    },
                    Subtype::Car,
                ),
            };
            let from_kerb_m = stream.between(KERB_M.0, KERB_M.0 + KERB_M.1);
            let askew_rad = stream.between(-ASKEW_RAD, ASKEW_RAD);
            let along_m = 0.5 * (place.length_m - END_ROOM_M - size.length_m) * stream.between(-1.0, 1.0);
            let turned = place.kerb.is_none() && !stream.chance(NOSE_IN);
            let fits = size.length_m <= LONGEST_M.min(place.length_m - 0.5)
                && size.width_m <= WIDEST_M.min(place.width_m - SIDE_ROOM_M)
                && subtype == Subtype::Car;
            if !fits {
                continue;
            }
            let forward = scene::geometry::direction(place.heading_rad);
            let left = Vec2::new(-forward.y, forward.x);
            let aside_m = place.kerb.map_or(0.0, |side| -side * (from_kerb_m + 0.5 * size.width_m));
            let position = (place.at + forward * along_m + left * aside_m).map(|v| rounded(v, 1e3));
            let heading_rad = place.heading_rad + askew_rad + if turned { PI } else { 0.0 };
            let pose = Pose { position, heading_rad: wrap_angle(rounded(heading_rad, 1e4)), s_m: 0.0 };
            let car = PlacedAgent {
                agent_type: AgentType::Vehicle,
                subtype,
                size,
                pose,
                kind: CellKind::Kerb,
                lane: None,
                free_mps: None,
                parked: true,
            };
            let outline = car.outline();
            let clear = !around(&outline).any(|p| self.is_in_use(p));
            if clear && self.fits(&car) {
                return Some(car);
            }
        }
        None
    }

    /// All places of the region, in an order that does not depend on the seed.
    fn places(&self) -> Vec<ParkingPlace> {
        let mut places = self.bays();
        let mut run: Vec<&MapCell> = Vec::new();
        let mut kerbs: Vec<&MapCell> =
            self.cells.all.iter().filter(|cell| cell.kind == CellKind::Kerb).collect();
        kerbs.sort_by(|a, b| {
            a.line.cmp(&b.line).then(a.side.total_cmp(&b.side)).then(a.from_m.total_cmp(&b.from_m))
        });
        for cell in kerbs {
            let goes_on = run.last().is_some_and(|last| {
                last.line == cell.line && last.side == cell.side && (last.to_m - cell.from_m).abs() < 1e-6
            });
            if !goes_on {
                self.along(&run, &mut places);
                run.clear();
            }
            if self.has_room(cell) {
                run.push(cell);
            }
        }
        self.along(&run, &mut places);
        places.retain(|place| {
            let middle = place.at;
            self.request.region.contains(middle) && middle.amax() <= scene::MAX_COORDINATE_M
        });
        places
    }

    /// Places in bays, and in parking lanes cut into pieces.
    fn bays(&self) -> Vec<ParkingPlace> {
        let mut places = Vec::new();
        let lanes = self.cells.graph.lanes().iter();
        for lane in
            lanes.filter(|l| l.lane_type == LaneType::Parking && matches!(l.source, LaneSource::Lane(_)))
        {
            let length_m = lane.path.length_m();
            let count = if length_m <= BAY_M { 1 } else { (length_m / PLACE_M) as usize };
            let each_m = length_m / count as f64;
            for i in 0..count.min(1_000) {
                let middle = lane.path.sample((i as f64 + 0.5) * each_m);
                let place = ParkingPlace {
                    at: middle.position,
                    heading_rad: middle.heading_rad,
                    length_m: each_m,
                    width_m: lane.width_m,
                    kerb: None,
                };
                if length_m <= BAY_M || !self.is_kept_clear(middle.position) {
                    places.push(place);
                }
            }
        }
        places
    }

    /// Whether cars can park along the kerb of this cell.
    fn has_room(&self, cell: &MapCell) -> bool {
        let lane = &self.cells.graph.lanes()[cell.line];
        let room = (ROOM_M.0..=ROOM_M.1).contains(&cell.free_m);
        room && lane.carries(AgentType::Vehicle) && lane.speed_limit_mps <= FAST_MPS
    }

    /// Places along one kerb, from its contiguous cells with room.
    fn along(&self, run: &[&MapCell], places: &mut Vec<ParkingPlace>) {
        let (Some(first), Some(last)) = (run.first(), run.last()) else { return };
        let lane = &self.cells.graph.lanes()[first.line];
        let beside = |list: &[usize]| list.iter().any(|l| self.cells.graph.lanes()[*l].interpolating);
        let length_m = lane.path.length_m();
        let (mut from_m, mut to_m) = (first.from_m, last.to_m);
        if beside(&lane.predecessors) {
            from_m = from_m.max(CLEAR_M);
        }
        if beside(&lane.successors) || lane.stop_sign_m.is_some() {
            to_m = to_m.min(lane.stop_sign_m.unwrap_or(length_m) - CLEAR_M);
        }
        let count = ((to_m - from_m) / PLACE_M).max(0.0) as usize;
        for i in 0..count {
            let start_m = from_m + i as f64 * PLACE_M;
            let over = run.iter().filter(|c| c.to_m > start_m && c.from_m < start_m + PLACE_M);
            let free_m = over.map(|c| c.free_m).fold(f64::INFINITY, f64::min);
            let middle = lane.path.sample(start_m + 0.5 * PLACE_M);
            let left = scene::geometry::direction(middle.heading_rad + FRAC_PI_2);
            let kerb = middle.position + left * (first.side * (0.5 * lane.width_m + free_m));
            let place = ParkingPlace {
                at: kerb,
                heading_rad: middle.heading_rad,
                length_m: PLACE_M,
                width_m: free_m,
                kerb: Some(first.side),
            };
            let centre = kerb - left * (first.side * MIDDLE_M);
            let ends = [-0.5, 0.0, 0.5].map(|part| centre + middle.direction() * (part * PLACE_M));
            // A parking lane has its own places.
            let parks = |_: usize, lane: &GraphLane| lane.lane_type == LaneType::Parking;
            let told = self.cells.graph.nearest_lanes(centre, LANE_REACH_M, parks);
            if told.iter().any(|hit| hit.distance_m < 0.5 * self.cells.graph.lanes()[hit.lane].width_m) {
                continue;
            }
            let in_the_way = |p: &Vec2| self.is_in_use(*p) || self.is_kept_clear(*p);
            if !ends.iter().any(in_the_way) && !self.is_before_driveway(first.line, &place, start_m) {
                places.push(place);
            }
        }
    }

    /// Whether a lane or a crosswalk covers the point.
    fn is_in_use(&self, point: Vec2) -> bool {
        on_lane(point, self.cells.graph)
            || self.cells.scene.map.crosswalks.iter().any(|area| in_ring(&area.polygon.xy, point))
    }

    /// Whether a crosswalk or a path through a junction is so near that its view must stay clear.
    fn is_kept_clear(&self, point: Vec2) -> bool {
        let crosses = |ring: &[Vec2]| {
            let ends = ring.iter().zip(ring.iter().cycle().skip(1));
            let near = |a: &Vec2, b: &Vec2| {
                let way = b - a;
                let share = ((point - a).dot(&way) / way.norm_squared().max(1e-9)).clamp(0.0, 1.0);
                (point - a - way * share).norm() < CLEAR_M
            };
            in_ring(ring, point) || ends.into_iter().any(|(a, b)| near(a, b))
        };
        self.cells.scene.map.crosswalks.iter().any(|area| crosses(&area.polygon.xy))
    }

    /// Whether a driveway opens to a lane at the place that begins at `start_m`.
    fn is_before_driveway(&self, lane: usize, place: &ParkingPlace, start_m: f64) -> bool {
        let path = &self.cells.graph.lanes()[lane].path;
        let side = place.kerb.unwrap_or(1.0);
        let is_near = |ring: &[Vec2]| ring.iter().any(|p| (p - place.at).norm() < NEAR_M);
        self.cells.scene.map.driveways.iter().filter(|area| is_near(&area.polygon.xy)).any(|area| {
            let near = area.polygon.xy.iter().filter_map(|p| {
                let foot = path.project_within(*p, DRIVEWAY_M)?;
                (side * foot.lateral_m > 0.0).then_some(foot.s_m)
            });
            let (low, high) =
                near.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), s| (low.min(s), high.max(s)));
            low - DRIVEWAY_SIDE_M < start_m + PLACE_M && high + DRIVEWAY_SIDE_M > start_m
        })
    }
}
