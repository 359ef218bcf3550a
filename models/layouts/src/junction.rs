//! Roads that meet at grade: kerbs round the corners, lanes, crosswalks, stop lines, stop signs and signals.

use crate::connect::{self, Bends};
use crate::curve::{Pose, arc, join, left_of, straight, tidy};
use crate::draft::{ArmPlace, CornerPlace, MapDraft, place};
use crate::lights::{self, SignalledCrosswalk};
use crate::parameters::{Arm, Connection, Connections, Control, Junction, Traffic};
use crate::roadway::{Plan, Profile, Roadway};
use crate::turns::{mirrored, names, of_lanes};
use scene::Vec2;
use scene::geometry::{cross, direction};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// A kerb bends round a corner up to this angle between two arms; beyond it, the kerb goes straight on or
/// outwards.
const CORNER_RAD: f64 = 2.9;
/// Greatest length of an arm that a bend takes, metres.
const MOST_BEND_M: f64 = 12.0;
/// Least distance from the middle to the beginning of an arm, metres.
const LEAST_MOUTH_M: f64 = 4.0;
/// Distance between bend and crosswalk, and between crosswalk and stop line, metres.
const BEFORE_CROSSWALK_M: f64 = 0.4;
const STOP_LINE_M: f64 = 1.2;
/// Least length of every arm beyond the junction, metres.
const LEAST_ROAD_M: f64 = 30.0;

/// Geometry of a drawn arm.
#[derive(Clone, Debug)]
pub struct Spoke {
    pub arm: Arm,
    pub profile: Profile,
    pub way: Vec2,
    /// Distances of the end of the bends, of the stop line, and of the edge of the map from the middle,
    /// metres.
    pub mouth_m: f64,
    pub stop_m: f64,
    pub end_m: f64,
}

impl Spoke {
    fn new(arm: &Arm, lane_m: f64) -> Self {
        let profile = Profile {
            lanes: [usize::from(arm.lanes_out), usize::from(arm.lanes_in)],
            lane_m,
            cycle_m: arm.cycle_lane_m,
            parking_m: 0.0,
            median_m: arm.median_m,
            limit_kmh: arm.speed_limit_kmh,
        };
        let way = direction(arm.angle_deg.to_radians());
        Self { arm: arm.clone(), profile, way, mouth_m: LEAST_MOUTH_M, stop_m: 0.0, end_m: 0.0 }
    }

    /// The position at this distance outwards and to the left, as seen from the middle.
    pub fn at(&self, out_m: f64, left_m: f64) -> Vec2 {
        self.way * out_m + left_of(self.way) * left_m
    }

    /// Kerbs beside the lanes in and beside the lanes out.
    pub fn kerbs_m(&self) -> [f64; 2] {
        [self.profile.half_m(1), self.profile.half_m(0)]
    }
}

/// A kerb from the edge of the map along an arm, round a corner, and along the next arm (counter-clockwise)
/// to the edge.
struct Corner {
    /// By the order of the spokes.
    arms: [usize; 2],
    /// Centre and radius of its bend.
    bend: Option<(Vec2, f64)>,
}

/// The spokes of the arms by their angle, and the index of each spoke's arm.
pub fn spokes(arms: &[Arm], lane_m: f64, traffic: Traffic) -> (Vec<Spoke>, Vec<usize>) {
    let turned: Vec<Arm> = arms
        .iter()
        .map(|arm| match traffic {
            Traffic::RightHand => arm.clone(),
            // The drawing is mirrored at the end.
            Traffic::LeftHand => {
                Arm { angle_deg: -arm.angle_deg, turns: arm.turns.as_deref().map(mirrored), ..arm.clone() }
            }
        })
        .collect();
    let mut order: Vec<usize> = (0..arms.len()).collect();
    order.sort_by(|a, b| {
        turned[*a].angle_deg.rem_euclid(360.0).total_cmp(&turned[*b].angle_deg.rem_euclid(360.0))
    });
    (order.iter().map(|i| Spoke::new(&turned[*i], lane_m)).collect(), order)
}

/// Angle from an arm to the next, counter-clockwise.
pub fn between(a: &Spoke, b: &Spoke) -> f64 {
    let angle = cross(a.way, b.way).atan2(a.way.dot(&b.way));
    if angle <= 0.0 { angle + TAU } else { angle }
}

pub fn draw(junction: &Junction) -> MapDraft {
    let (mut spokes, order) = spokes(&junction.arms, junction.lane_width_m, junction.traffic);
    let corners = corners(&mut spokes, junction.kerb_radius_m);
    for spoke in &mut spokes {
        spoke.mouth_m += BEFORE_CROSSWALK_M;
        let crosswalk = spoke.arm.crosswalk_m;
        spoke.stop_m = spoke.mouth_m + if crosswalk > 0.0 { crosswalk + STOP_LINE_M } else { 0.5 };
        spoke.end_m = spoke.arm.length_m.max(spoke.stop_m + LEAST_ROAD_M);
    }
    let mut draft = MapDraft::default();
    let kerbs: Vec<Vec<Vec2>> = corners.iter().map(|corner| kerb(&spokes, corner, 0.0)).collect();
    let edges: Vec<String> = kerbs.iter().map(|kerb| draft.edge("boundary", kerb.clone())).collect();
    let roads: Vec<Roadway> =
        spokes.iter().zip(&order).map(|(spoke, i)| road(&mut draft, spoke, *i)).collect();
    for (k, corner) in corners.iter().enumerate() {
        let [a, b] = corner.arms;
        let beside = [roads[a].left.all().last().copied(), roads[b].right.all().last().copied()];
        beside.into_iter().flatten().for_each(|lane| draft.bound(lane, false, &edges[k]));
    }
    let islands = std::mem::take(&mut draft.islands);
    draft.ground(tidy(kerbs.concat()), islands);

    let arms: Vec<Arm> = spokes.iter().map(|spoke| spoke.arm.clone()).collect();
    let bends: Vec<Bends> = corners
        .iter()
        .map(|corner| Bends { next: corner.arms[1], radius_m: corner.bend.map(|bend| bend.1) })
        .collect();
    let kerbs_m: Vec<[f64; 2]> = spokes.iter().map(Spoke::kerbs_m).collect();
    let connections = by_spoke(&junction.connections, &order);
    connect::draw(&mut draft, &arms, &connections, &roads, &bends, &kerbs_m, junction.lane_width_m);
    let crossings = crosswalks(&mut draft, &spokes);
    if junction.sidewalk_m > 0.0 {
        sidewalks(&mut draft, &spokes, &corners, junction.sidewalk_m);
    }
    match junction.control {
        Control::Signals => lights::draw(&mut draft, arms.len(), &junction.program, &crossings),
        Control::Priority => {
            let main = main_arms(&arms);
            signs(&mut draft, &spokes, |arm| !main[arm]);
        }
        Control::Equal => signs(&mut draft, &spokes, |_| true),
    }
    finish(&mut draft, &spokes, &roads, &order, &corners_of(&spokes, &corners));
    draft
}

/// The connections with arms numbered as the spokes are.
fn by_spoke(connections: &Connections, order: &[usize]) -> Connections {
    let spoke = |[arm, lane]: [usize; 2]| Some([order.iter().position(|i| *i == arm)?, lane]);
    let moved = |list: &[Connection]| {
        let moved = |c: &Connection| Some(Connection { from: spoke(c.from)?, to: spoke(c.to)? });
        list.iter().filter_map(moved).collect()
    };
    Connections { added: moved(&connections.added), removed: moved(&connections.removed) }
}

fn corners_of(spokes: &[Spoke], corners: &[Corner]) -> Vec<(CornerPlace, [usize; 2])> {
    let place_of = |corner: &Corner| {
        let (centre, radius_m) = corner.bend?;
        let [a, b] = corner.arms;
        let inwards = -(spokes[a].way + spokes[b].way);
        let at = centre + inwards / inwards.norm().max(1e-9) * radius_m;
        Some((CornerPlace { at_m: place(at), radius_m, arms: corner.arms }, corner.arms))
    };
    corners.iter().filter_map(place_of).collect()
}

/// Fills the places of arms and corners in the draft, in the order of the parameters.
pub fn finish(
    draft: &mut MapDraft,
    spokes: &[Spoke],
    roads: &[Roadway],
    order: &[usize],
    corners: &[(CornerPlace, [usize; 2])],
) {
    let arms: Vec<Arm> = spokes.iter().map(|spoke| spoke.arm.clone()).collect();
    for movement in &mut draft.movements {
        movement.from = order[movement.from];
        movement.to = order[movement.to];
    }
    let mut places: Vec<Option<ArmPlace>> = vec![None; order.len()];
    for (k, spoke) in spokes.iter().enumerate() {
        places[order[k]] = Some(ArmPlace {
            name: String::new(),
            mouth_m: place(spoke.at(spoke.stop_m, 0.0)),
            end_m: place(spoke.at(spoke.end_m, 0.0)),
            kerbs_m: spoke.kerbs_m(),
            turns: of_lanes(&arms, k),
            ins_m: roads[k].left.lanes.iter().map(|lane| place(draft.end(*lane).at)).collect(),
            outs_m: roads[k].right.lanes.iter().map(|lane| place(draft.start(*lane).at)).collect(),
        });
    }
    draft.arms = places.into_iter().flatten().collect();
    draft.corners = corners
        .iter()
        .map(|(place, arms)| CornerPlace { arms: arms.map(|k| order[k]), ..place.clone() })
        .collect();
}

/// Names the arms by their final positions.
pub fn named(draft: &mut MapDraft, arms: &[Arm]) {
    for (place, name) in draft.arms.iter_mut().zip(names(arms)) {
        place.name = name;
    }
}

/// Finds the corners, and the beginning of each arm.
fn corners(spokes: &mut [Spoke], radius_m: f64) -> Vec<Corner> {
    let count = spokes.len();
    (0..count)
        .map(|a| {
            let b = (a + 1) % count;
            let angle = between(&spokes[a], &spokes[b]);
            let mut bend = None;
            if angle < CORNER_RAD {
                let (p, q) =
                    (spokes[a].at(0.0, spokes[a].kerbs_m()[0]), spokes[b].at(0.0, -spokes[b].kerbs_m()[1]));
                let (u, v) = (spokes[a].way, spokes[b].way);
                let det = cross(u, v);
                let (s, t) = (cross(q - p, v) / det, cross(q - p, u) / det);
                let half = (angle / 2.0).tan();
                let radius_m = radius_m.min(MOST_BEND_M.max(radius_m.min(3.0) / half) * half).max(0.5);
                let reach = radius_m / half;
                spokes[a].mouth_m = spokes[a].mouth_m.max(s + reach);
                spokes[b].mouth_m = spokes[b].mouth_m.max(t + reach);
                bend = Some((p + u * (s + reach) + left_of(u) * radius_m, radius_m));
            }
            Corner { arms: [a, b], bend }
        })
        .collect()
}

/// The line of a corner at this distance behind its kerb.
fn kerb(spokes: &[Spoke], corner: &Corner, behind_m: f64) -> Vec<Vec2> {
    let [a, b] = corner.arms.map(|k| &spokes[k]);
    let (left_m, right_m) = (a.kerbs_m()[0] + behind_m, -b.kerbs_m()[1] - behind_m);
    let mut line = straight(a.at(a.end_m, left_m), a.at(a.stop_m, left_m));
    line.extend(round(a, b, corner, behind_m));
    line.extend(straight(b.at(b.stop_m, right_m), b.at(b.end_m, right_m)));
    tidy(line)
}

/// The line of its bend only.
fn round(a: &Spoke, b: &Spoke, corner: &Corner, behind_m: f64) -> Vec<Vec2> {
    let (left_m, right_m) = (a.kerbs_m()[0] + behind_m, -b.kerbs_m()[1] - behind_m);
    if let Some((centre, radius_m)) = corner.bend {
        let radius_m = (radius_m - behind_m).max(0.3);
        let from = a.way.y.atan2(a.way.x) - FRAC_PI_2;
        let by = PI - between(a, b);
        // A tighter bend has its centre where both lines are at the same distance.
        let centre =
            if radius_m > 0.3 { centre } else { nearer(a, b, [left_m, right_m], radius_m).unwrap_or(centre) };
        return arc(centre, radius_m, from, from - by);
    }
    let inwards = a.arm.angle_deg.to_radians() + PI;
    let from = Pose { at: a.at(a.mouth_m, left_m), heading_rad: inwards };
    let to = Pose { at: b.at(b.mouth_m, right_m), heading_rad: b.arm.angle_deg.to_radians() };
    join(from, to, 1e3)
}

/// Centre of a circle that touches two lines along the arms.
fn nearer(a: &Spoke, b: &Spoke, aside_m: [f64; 2], radius_m: f64) -> Option<Vec2> {
    let (p, q) = (a.at(0.0, aside_m[0] + radius_m), b.at(0.0, aside_m[1] - radius_m));
    let det = cross(a.way, b.way);
    (det.abs() > 0.05).then(|| p + a.way * (cross(q - p, b.way) / det))
}

fn road(draft: &mut MapDraft, spoke: &Spoke, number: usize) -> Roadway {
    let axis = straight(spoke.at(spoke.stop_m, 0.0), spoke.at(spoke.end_m, 0.0));
    let median_m = vec![spoke.arm.median_m; axis.len()];
    let id = format!("arm{}", number + 1);
    let plan = Plan {
        id: &id,
        profile: &spoke.profile,
        axis: &axis,
        median_m: &median_m,
        raised_m: f64::INFINITY,
        stops: [true, false],
    };
    let road = plan.draw(draft);
    open(draft, &road);
    road
}

/// Marks that the road continues beyond the map.
pub fn open(draft: &mut MapDraft, road: &Roadway) {
    road.left.all().into_iter().for_each(|lane| draft.about[lane].open[0] = true);
    road.right.all().into_iter().for_each(|lane| draft.about[lane].open[1] = true);
}

/// Crosswalks over the arms that have one.
pub fn crosswalks(draft: &mut MapDraft, spokes: &[Spoke]) -> Vec<SignalledCrosswalk> {
    let mut crossings = Vec::new();
    for (arm, spoke) in spokes.iter().enumerate().filter(|(_, spoke)| spoke.arm.crosswalk_m > 0.0) {
        let [left_m, right_m] = spoke.kerbs_m();
        let (near, far) = (spoke.mouth_m, spoke.mouth_m + spoke.arm.crosswalk_m);
        let ring = [
            spoke.at(near, -right_m),
            spoke.at(far, -right_m),
            spoke.at(far, left_m),
            spoke.at(near, left_m),
        ];
        let from = spoke.at(0.5 * (near + far), -right_m);
        crossings.push(SignalledCrosswalk { id: draft.crosswalk(ring), arm, from });
    }
    crossings
}

/// Pavements along the arms and round the corners.
fn sidewalks(draft: &mut MapDraft, spokes: &[Spoke], corners: &[Corner], width_m: f64) {
    let behind_m = width_m / 2.0 + 0.2;
    for corner in corners {
        let [a, b] = corner.arms.map(|k| &spokes[k]);
        let (left_m, right_m) = (a.kerbs_m()[0] + behind_m, -b.kerbs_m()[1] - behind_m);
        let from_m = |spoke: &Spoke| spoke.mouth_m + spoke.arm.crosswalk_m / 2.0;
        let mut corner_line = vec![a.at(from_m(a), left_m)];
        corner_line.extend(round(a, b, corner, behind_m));
        corner_line.push(b.at(from_m(b), right_m));
        let parts = [
            straight(a.at(a.end_m, left_m), a.at(from_m(a), left_m)),
            corner_line,
            straight(b.at(from_m(b), right_m), b.at(b.end_m, right_m)),
        ];
        let mut before: Option<usize> = None;
        for (i, part) in parts.into_iter().enumerate() {
            let lane = draft.sidewalk(part, width_m, i == 1);
            if let Some(before) = before {
                draft.link(before, lane);
            }
            before = Some(lane);
        }
    }
}

/// The main arms: the marked ones, otherwise the two that are closest to a straight line.
fn main_arms(arms: &[Arm]) -> Vec<bool> {
    if arms.iter().any(|arm| arm.main) {
        return arms.iter().map(|arm| arm.main).collect();
    }
    let mut best = (f64::INFINITY, [0, 0]);
    for a in 0..arms.len() {
        for b in 0..a {
            let between = (arms[a].angle_deg - arms[b].angle_deg).rem_euclid(360.0);
            if (between - 180.0).abs() < best.0 {
                best = ((between - 180.0).abs(), [a, b]);
            }
        }
    }
    (0..arms.len()).map(|arm| best.1.contains(&arm)).collect()
}

/// Stop signs at the arms that have to stop.
fn signs(draft: &mut MapDraft, spokes: &[Spoke], stops: impl Fn(usize) -> bool) {
    for (arm, spoke) in spokes.iter().enumerate().filter(|(arm, _)| stops(*arm)) {
        let from = draft.movements.iter().filter(|movement| movement.from == arm);
        let lanes: Vec<String> = from.map(|movement| draft.map.lanes[movement.lane].id.clone()).collect();
        if !lanes.is_empty() {
            draft.stop_sign(spoke.at(spoke.stop_m, spoke.kerbs_m()[0] + 0.5), lanes);
        }
    }
}
