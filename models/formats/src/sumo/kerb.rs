//! Borders of the carriageway, which a SUMO network does not contain: the sides of its edges, joined round
//! the corners of junctions.

use super::net::{EdgeFunction, LaneKind, Net};
use crate::polyline::{meeting, offset_right};
use scene::Vec2;
use scene::geometry::cross;
use std::collections::HashMap;

/// Radius of kerbs at corners if there is room, metres.
const CORNER_RADIUS_M: f64 = 7.5;

/// Both borders of an edge's carriageway, which includes cycle lanes and parking strips.
#[derive(Clone, Debug)]
pub struct Borders {
    /// Index in [`Net::edges`].
    pub edge: usize,
    /// Right border in driving direction.
    pub right: Vec<Vec2>,
    /// Left border in driving direction.
    pub left: Vec<Vec2>,
}

/// A section of border within a junction.
#[derive(Clone, Debug)]
pub struct Corner {
    /// From the border of one arm to that of the next, counter-clockwise.
    pub points: Vec<Vec2>,
    /// Edge that it continues from, and whether that edge leads into the junction.
    pub from: (usize, bool),
    /// Edge that it continues to, and whether that edge leads into the junction.
    pub to: (usize, bool),
    /// Change of direction, radians.
    pub turn_rad: f64,
}

/// A junction's carriageway.
#[derive(Clone, Debug)]
pub struct JunctionArea {
    /// Its outline, counter-clockwise, open.
    pub ring: Vec<Vec2>,
    /// Its corners.
    pub corners: Vec<Corner>,
    /// Number of arms.
    pub arms: usize,
}

/// Borders of all edges that have a carriageway.
pub fn borders(net: &Net) -> Vec<Borders> {
    let carriageway = |i: usize| {
        let edge = &net.edges[i];
        // An edge with only closed lanes (rails) or sidewalks has no carriageway.
        let closed = |l: &usize| matches!(net.lanes[*l].kind, LaneKind::Sidewalk | LaneKind::Closed);
        if edge.lanes.iter().all(closed) {
            return None;
        }
        let mut lanes = edge.lanes.iter().filter(|&&l| net.lanes[l].kind != LaneKind::Sidewalk);
        let (first, last) = (*lanes.next()?, lanes.next_back());
        let (right, left) = (&net.lanes[first], &net.lanes[last.copied().unwrap_or(first)]);
        Some(Borders {
            edge: i,
            right: offset_right(&right.shape, right.width_m / 2.0),
            left: offset_right(&left.shape, -left.width_m / 2.0),
        })
    };
    let normal = |i: &usize| net.edges[*i].function == EdgeFunction::Normal;
    let lines = |b: &Borders| b.right.len() > 1 && b.left.len() > 1;
    (0..net.edges.len()).filter(normal).filter_map(carriageway).filter(lines).collect()
}

/// One side of an arm at a junction, seen from outside.
#[derive(Clone, Copy)]
struct Side {
    edge: usize,
    inward: bool,
    point: Vec2,
    /// Direction into the junction.
    direction: Vec2,
}

#[derive(Default)]
struct Arm {
    incoming: Option<usize>,
    outgoing: Option<usize>,
}

impl Arm {
    /// The first side counter-clockwise round the junction, then the middle points, then the last side.
    fn sides(&self, all: &[Borders]) -> Option<(Side, Vec<Vec2>, Side)> {
        let end = |b: usize, right: bool| {
            let line = if right { &all[b].right } else { &all[b].left };
            let n = line.len();
            Side {
                edge: all[b].edge,
                inward: true,
                point: line[n - 1],
                direction: unit(line[n - 1] - line[n - 2]),
            }
        };
        let start = |b: usize, right: bool| {
            let line = if right { &all[b].right } else { &all[b].left };
            Side { edge: all[b].edge, inward: false, point: line[0], direction: unit(line[0] - line[1]) }
        };
        match (self.outgoing, self.incoming) {
            (Some(o), Some(i)) => {
                let middle = vec![start(o, false).point, end(i, false).point];
                Some((start(o, true), middle, end(i, true)))
            }
            (Some(o), None) => Some((start(o, true), Vec::new(), start(o, false))),
            (None, Some(i)) => Some((end(i, false), Vec::new(), end(i, true))),
            (None, None) => None,
        }
    }
}

fn unit(v: Vec2) -> Vec2 {
    v / v.norm().max(1e-9)
}

/// Areas of all junctions with at least two arms.
pub fn junctions(net: &Net, all: &[Borders]) -> Vec<JunctionArea> {
    let mut arms: HashMap<&str, Vec<(&str, Arm)>> = HashMap::new();
    for (b, borders) in all.iter().enumerate() {
        let edge = &net.edges[borders.edge];
        for (here, other, inward) in [(&edge.to, &edge.from, true), (&edge.from, &edge.to, false)] {
            let list = arms.entry(here).or_default();
            let taken = |arm: &Arm| if inward { arm.incoming.is_some() } else { arm.outgoing.is_some() };
            let found = list.iter().position(|(id, arm)| id == other && !taken(arm));
            let at = found.unwrap_or_else(|| {
                list.push((other, Arm::default()));
                list.len() - 1
            });
            let slot = if inward { &mut list[at].1.incoming } else { &mut list[at].1.outgoing };
            *slot = Some(b);
        }
    }
    let mut named: Vec<_> = arms.into_iter().collect();
    named.sort_by_key(|(id, _)| *id);
    named.into_iter().filter_map(|(_, list)| area(&list, all)).collect()
}

fn area(list: &[(&str, Arm)], all: &[Borders]) -> Option<JunctionArea> {
    let mut sides: Vec<_> = list.iter().filter_map(|(_, arm)| arm.sides(all)).collect();
    if sides.len() < 2 {
        return None;
    }
    let middle = |s: &(Side, Vec<Vec2>, Side)| (s.0.point + s.2.point) / 2.0;
    let centre = sides.iter().map(middle).sum::<Vec2>() / sides.len() as f64;
    let angle = |s: &(Side, Vec<Vec2>, Side)| {
        let v = middle(s) - centre;
        v.y.atan2(v.x)
    };
    sides.sort_by(|a, b| angle(a).total_cmp(&angle(b)));
    let (mut ring, mut corners) = (Vec::new(), Vec::new());
    for i in 0..sides.len() {
        let (first, middle, last) = &sides[i];
        ring.push(first.point);
        ring.extend(middle);
        ring.push(last.point);
        let next = &sides[(i + 1) % sides.len()].0;
        let outward = -next.direction;
        let turn_rad = cross(last.direction, outward).atan2(last.direction.dot(&outward));
        // A road that only bends gets the greatest possible radius.
        let radius = if turn_rad.abs() < 0.9 { f64::INFINITY } else { CORNER_RADIUS_M };
        let points = corner(last.point, last.direction, next.point, outward, radius);
        ring.extend(points.iter().skip(1).take(points.len().saturating_sub(2)));
        corners.push(Corner {
            points,
            from: (last.edge, last.inward),
            to: (next.edge, next.inward),
            turn_rad,
        });
    }
    Some(JunctionArea { ring, corners, arms: sides.len() })
}

/// A border from `p` in direction `d` to `q` in direction `e`: a straight piece, an arc of about `radius`, a
/// straight piece; an S-curve if the two directions are nearly equal.
pub fn corner(p: Vec2, d: Vec2, q: Vec2, e: Vec2, radius: f64) -> Vec<Vec2> {
    let gap = (q - p).norm();
    if gap < 0.05 {
        return vec![p, q];
    }
    let turn = cross(d, e).atan2(d.dot(&e));
    let meet = meeting(p, d, q, e).filter(|(s, t)| *s > 0.0 && *t < 0.0 && *s < 4.0 * gap);
    let Some((s, t)) = meet.filter(|_| turn.abs() > 0.15) else {
        if turn.abs() > 2.4 {
            return vec![p, q];
        }
        return s_curve(p, d * gap, q, e * gap, 10);
    };
    let reach = (radius * (turn.abs() / 2.0).tan()).min(s).min(-t);
    let apex = p + d * s;
    let (a, b) = (apex - d * reach, apex + e * reach);
    let weight = (turn / 2.0).cos();
    let arc = (0..=10).map(|i| {
        let u = f64::from(i) / 10.0;
        let (wa, wm, wb) = ((1.0 - u) * (1.0 - u), 2.0 * u * (1.0 - u) * weight, u * u);
        (a * wa + apex * wm + b * wb) / (wa + wm + wb)
    });
    let mut points = vec![p];
    points.extend(arc);
    points.push(q);
    points.dedup_by(|x, y| (*x - *y).norm() < 0.02);
    points
}

/// Cubic Hermite curve with `n` pieces.
pub fn s_curve(p: Vec2, dp: Vec2, q: Vec2, dq: Vec2, n: usize) -> Vec<Vec2> {
    (0..=n)
        .map(|i| {
            let t = i as f64 / n as f64;
            let (t2, t3) = (t * t, t * t * t);
            p * (2.0 * t3 - 3.0 * t2 + 1.0)
                + dp * (t3 - 2.0 * t2 + t)
                + q * (3.0 * t2 - 2.0 * t3)
                + dq * (t3 - t2)
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn right_angle_corner_is_an_arc() {
        let (x, y) = (Vec2::new(1.0, 0.0), Vec2::new(0.0, 1.0));
        let points = corner(Vec2::new(-20.0, 0.0), x, Vec2::new(0.0, 20.0), y, 5.0);
        assert_eq!((points[0], points[points.len() - 1]), (Vec2::new(-20.0, 0.0), Vec2::new(0.0, 20.0)));
        let centre = Vec2::new(-5.0, 5.0);
        for p in &points[1..points.len() - 1] {
            assert!(((p - centre).norm() - 5.0).abs() < 1e-9, "{p:?}");
        }
    }

    #[test]
    fn parallel_borders_are_joined_smoothly() {
        let x = Vec2::new(1.0, 0.0);
        let points = corner(Vec2::zeros(), x, Vec2::new(20.0, 3.5), x, 5.0);
        assert!(points.windows(2).all(|w| w[1].x > w[0].x && w[1].y >= w[0].y));
    }
}
