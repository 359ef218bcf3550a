//! Lane sections of a network, each with its adjacent lanes and the borders between them.

use super::filter::Filtered;
use scene::Vec2;
use scene::geometry::Extent;
use std::collections::BTreeMap;
use xodr::{Direction, LaneId, LaneType, Point, RoadNetwork};

/// Most segments of a lane; in longer lanes only every second or third point is kept, and so on.
pub(super) const MAX_PIECES: usize = 2_000;

/// A stretch of road over which the number of lanes does not change.
pub(super) struct Section {
    /// The road's id in the file.
    pub road: String,
    /// Index of the section in its road.
    pub number: usize,
    /// The junction through which the road leads.
    pub junction: Option<String>,
    /// Whether traffic keeps to the left.
    pub left_hand: bool,
    /// Lanes from the right, looking along the road.
    pub lanes: Vec<SectionLane>,
    /// Number of the network's points from one point of these to the next.
    pub stride: usize,
    /// Right border of each lane and, last, the left border of the last one; with a point for each point of
    /// the lanes.
    pub borders: Vec<Vec<Vec2>>,
}

/// One lane of a section.
pub(super) struct SectionLane {
    pub id: LaneId,
    /// Number in the file: negative to the right of the road's reference line.
    pub number: i32,
    pub kind: LaneType,
    /// Whether traffic goes along the road, against it, or both ways.
    pub direction: Direction,
    /// Centre line along the road.
    pub center: Vec<Vec2>,
    /// Unit tangents of the centre line.
    pub tangents: Vec<Vec2>,
    /// Heights of the centre line, metres.
    pub z_m: Vec<f64>,
    /// Widths at the points, metres.
    pub widths_m: Vec<f64>,
    /// Whether it is raised above the adjacent road.
    pub raised: bool,
}

impl SectionLane {
    /// Mean width over the points, metres; if positions between the points are given, over that stretch of
    /// the lane.
    pub fn mean_width_over(&self, places: &[f64]) -> f64 {
        let at = |place: f64| {
            let width = |i: usize| self.widths_m.get(i).or(self.widths_m.last()).copied().unwrap_or_default();
            let (i, share) = (place.floor().max(0.0) as usize, place.fract());
            width(i) + (width(i + 1) - width(i)) * share
        };
        let ends = places.iter().fold((f64::INFINITY, 0.0_f64), |(a, b), p| (a.min(*p), b.max(*p)));
        let last = self.widths_m.len().saturating_sub(1) as f64;
        if ends.0 <= 0.0 && ends.1 >= last {
            return self.widths_m.iter().sum::<f64>() / self.widths_m.len().max(1) as f64;
        }
        places.iter().map(|place| at(*place)).sum::<f64>() / places.len().max(1) as f64
    }

    /// Greatest width, metres.
    pub fn widest_m(&self) -> f64 {
        self.widths_m.iter().copied().fold(0.0, f64::max)
    }
}

/// Conversion from the network's frame to that of the scene.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct NetworkFrame {
    /// The scene's origin in the network's frame, whole metres.
    pub middle: Vec2,
    /// Half the size of the bounding box of all lanes, metres.
    pub half: Vec2,
}

impl NetworkFrame {
    /// A frame about the middle of all lanes.
    pub fn of(network: &RoadNetwork) -> Self {
        let points = network.lanes().iter().flat_map(|lane| lane.center.points());
        let points = points.map(|p| Vec2::new(f64::from(p.x), f64::from(p.y)));
        let (middle, size) = Extent::about(points).map(|all| (all.middle(), all.size())).unwrap_or_default();
        Self { middle: middle.map(f64::round), half: size / 2.0 }
    }

    /// A point of the network.
    pub fn point(&self, p: Point) -> Vec2 {
        Vec2::new(f64::from(p.x), f64::from(p.y)) - self.middle
    }
}

/// All sections with lanes, in the order of the file.
pub(super) fn sections(network: &RoadNetwork, file: &Filtered, frame: &NetworkFrame) -> Vec<Section> {
    let mut found: BTreeMap<(usize, usize), Vec<(i32, &xodr::Lane)>> = BTreeMap::new();
    for lane in network.lanes() {
        if let Some(at) = network.road_lane(lane.id) {
            found.entry((at.road.0, at.section)).or_default().push((at.od_id, lane));
        }
    }
    let section = |((road, number), mut lanes): ((usize, usize), Vec<(i32, &xodr::Lane)>)| {
        let road = network.road(xodr::RoadId(road))?;
        lanes.sort_by_key(|(number, _)| *number);
        // All lanes of a section are sampled at the same positions along the road.
        let points = lanes.iter().map(|(_, lane)| lane.center.points().len()).min()?;
        let stride = points.div_ceil(MAX_PIECES).max(1);
        let id = road.od_id().to_owned();
        let kept: Vec<usize> = (0..points).filter(|i| i % stride == 0 || i + 1 == points).collect();
        let lane_of = |(lane_number, lane): &(i32, &xodr::Lane)| {
            let raised = file.raised.contains(&(id.clone(), number, *lane_number));
            section_lane(*lane_number, lane, &kept, raised, frame)
        };
        let lanes: Vec<SectionLane> = lanes.iter().map(lane_of).collect();
        let borders = borders(&lanes, kept.len());
        let junction = road.junction().map(str::to_owned);
        let left_hand = file.left_hand.contains(&id);
        Some(Section { road: id, number, junction, left_hand, lanes, stride, borders })
    };
    found.into_iter().filter_map(section).collect()
}

/// A lane at some of its points.
fn section_lane(
    number: i32,
    lane: &xodr::Lane,
    kept: &[usize],
    raised: bool,
    frame: &NetworkFrame,
) -> SectionLane {
    let (points, tangents) = (lane.center.points(), lane.center.tangents());
    let center = kept.iter().filter_map(|i| points.get(*i));
    let tangent = |v: &xodr::Vector| {
        let v = Vec2::new(f64::from(v.x), f64::from(v.y));
        v / v.norm().max(1e-9)
    };
    let width =
        |i: &usize| f64::from(lane.widths.get(*i).or(lane.widths.last()).copied().unwrap_or(lane.width));
    SectionLane {
        id: lane.id,
        number,
        kind: lane.kind,
        direction: lane.direction,
        center: center.clone().map(|p| frame.point(*p)).collect(),
        tangents: kept.iter().filter_map(|i| tangents.get(*i)).map(tangent).collect(),
        z_m: center.map(|p| f64::from(p.z)).collect(),
        widths_m: kept.iter().map(width).collect(),
        raised,
    }
}

/// Borders of adjacent lanes. Their centres lie on a line across the road, so that two lanes share one line.
fn borders(lanes: &[SectionLane], points: usize) -> Vec<Vec<Vec2>> {
    let (Some(first), Some(last)) = (lanes.first(), lanes.last()) else { return Vec::new() };
    let across = |i: usize| {
        let between = last.center[i] - first.center[i];
        let tangent = first.tangents.get(i).copied().unwrap_or_else(Vec2::zeros);
        if between.norm() > 0.05 { between / between.norm() } else { Vec2::new(-tangent.y, tangent.x) }
    };
    let across: Vec<Vec2> = (0..points).map(across).collect();
    let side = |lane: &SectionLane, sign: f64| -> Vec<Vec2> {
        (0..points).map(|i| lane.center[i] + across[i] * (sign * lane.widths_m[i] / 2.0)).collect()
    };
    let lefts = lanes.iter().map(|lane| side(lane, 1.0));
    std::iter::once(side(first, -1.0)).chain(lefts).collect()
}

/// Points at most `step_m` apart on the smooth line through these, each with its segment and share of it.
pub(super) fn dense(points: &[Vec2], tangents: &[Vec2], step_m: f64) -> Vec<(Vec2, usize, f64)> {
    let mut out = Vec::new();
    for (i, ends) in points.windows(2).enumerate() {
        let length_m = (ends[1] - ends[0]).norm();
        let pieces = ((length_m / step_m) - 1e-3).ceil().max(1.0) as usize;
        let ways = (tangents.get(i), tangents.get(i + 1));
        for k in 0..pieces {
            let share = k as f64 / pieces as f64;
            out.push((between(ends, ways, length_m, share), i, share));
        }
    }
    if let Some(last) = points.last() {
        out.push((*last, points.len().saturating_sub(2), 1.0));
    }
    out
}

/// A point of the cubic with these ends and tangents.
fn between(ends: &[Vec2], ways: (Option<&Vec2>, Option<&Vec2>), length_m: f64, t: f64) -> Vec2 {
    let (p, q) = (ends[0], ends[1]);
    let (Some(d), Some(e)) = ways else { return p + (q - p) * t };
    let (t2, t3) = (t * t, t * t * t);
    p * (2.0 * t3 - 3.0 * t2 + 1.0)
        + d * (length_m * (t3 - 2.0 * t2 + t))
        + q * (3.0 * t2 - 2.0 * t3)
        + e * (length_m * (t3 - t2))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn dense_points_lie_on_the_curve() {
        let at = |angle: f64| Vec2::new(20.0 * angle.cos(), 20.0 * angle.sin());
        let angles: Vec<f64> = (0..=10).map(|i| f64::from(i) * PI / 20.0).collect();
        let points: Vec<Vec2> = angles.iter().map(|a| at(*a)).collect();
        let tangents: Vec<Vec2> = angles.iter().map(|a| Vec2::new(-a.sin(), a.cos())).collect();
        let line = dense(&points, &tangents, 1.0);
        assert!(line.windows(2).all(|w| (w[1].0 - w[0].0).norm() <= 1.0 + 1e-2));
        assert!(line.iter().all(|(p, ..)| (p.norm() - 20.0).abs() < 0.002));
        assert_eq!(line.last().map(|(p, ..)| *p), points.last().copied());
    }
}
