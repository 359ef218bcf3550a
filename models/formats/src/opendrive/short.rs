//! Links of lanes through sections that are too short to have lanes. The OpenDRIVE crate drops such sections
//! together with their renumbering of lanes. This module joins the links before and after them.

use std::collections::{HashMap, HashSet};
use std::fmt::Write as _;
use std::ops::Range;

/// Sections shorter than this have no lanes in the OpenDRIVE crate, metres.
pub(super) const SHORT_M: f64 = 1e-3;

/// A lane at an end of a road: id of the road, and number of the lane.
pub(super) type RoadLane<'a> = (&'a str, i32);

/// A `<predecessor>` or `<successor>` of a lane.
#[derive(Clone, Debug)]
pub(super) struct LaneLink {
    pub lane: i32,
    /// Whether it is the successor.
    pub after: bool,
    pub to: i32,
    /// Byte range of the element in the text.
    pub at: Range<usize>,
}

/// Links of a lane section.
#[derive(Clone, Debug, Default)]
pub(super) struct LinkedSection {
    pub s_m: f64,
    /// Whether the section defines its right and its left side; a side that it does not define continues from
    /// the previous section.
    pub gives: [bool; 2],
    pub links: Vec<LaneLink>,
    pub is_short: bool,
}

/// Target of a road's end.
#[derive(Clone, Debug)]
pub(super) struct RoadEnd {
    pub is_junction: bool,
    pub id: String,
    /// Whether it is the end of that road; otherwise its start.
    pub at_end: bool,
}

/// Links of a road.
#[derive(Clone, Debug, Default)]
pub(super) struct RoadLinks {
    pub sections: Vec<LinkedSection>,
    /// Targets at the start and at the end.
    pub ends: [Option<RoadEnd>; 2],
}

impl RoadLinks {
    /// Sorts the sections along the road and marks those without lanes.
    pub fn close(&mut self, length_m: f64) {
        self.sections.sort_by(|a, b| a.s_m.total_cmp(&b.s_m));
        let ends: Vec<f64> = self.sections.iter().skip(1).map(|next| next.s_m).chain([length_m]).collect();
        for (section, end_m) in self.sections.iter_mut().zip(ends) {
            section.is_short = end_m.min(length_m) - section.s_m < SHORT_M;
        }
    }

    /// The lane after the short sections that begin with `section`, and whether it lies on the next road.
    fn through(&self, mut section: usize, mut lane: i32, after: bool) -> Option<(i32, bool)> {
        while let Some(found) = self.sections.get(section) {
            if !found.is_short {
                return Some((lane, false));
            }
            lane = found.step(lane, after)?;
            section = if after { section + 1 } else { section.wrapping_sub(1) };
        }
        Some((lane, true))
    }

    /// The lane of the next road to which a link of the first or last section with lanes leads.
    fn beyond(&self, link: &LaneLink) -> Option<i32> {
        let own = |section: &LinkedSection| section.links.iter().any(|other| std::ptr::eq(other, link));
        let at = self.sections.iter().position(own)?;
        let next = if link.after { at + 1 } else { at.wrapping_sub(1) };
        self.through(next, link.to, link.after).filter(|(_, beyond)| *beyond).map(|(lane, _)| lane)
    }

    /// The lane of the first section with lanes that continues a lane at an end of the road.
    fn inward(&self, at_end: bool, lane: i32) -> Option<i32> {
        let first = if at_end { self.sections.len().saturating_sub(1) } else { 0 };
        self.through(first, lane, !at_end).filter(|(_, beyond)| !beyond).map(|(lane, _)| lane)
    }
}

impl LinkedSection {
    fn step(&self, lane: i32, after: bool) -> Option<i32> {
        if !self.gives[usize::from(lane > 0)] {
            return Some(lane);
        }
        self.links.iter().find(|link| link.lane == lane && link.after == after).map(|link| link.to)
    }
}

/// A `<laneLink>` of a junction.
#[derive(Clone, Debug)]
pub(super) struct JunctionLink {
    pub junction: String,
    pub incoming: String,
    pub connecting: String,
    /// Whether the connecting road is entered at its end.
    pub at_end: bool,
    pub from: i32,
    pub to: i32,
    pub at: Range<usize>,
}

/// Links of a file.
#[derive(Clone, Debug, Default)]
pub(super) struct Links {
    pub roads: HashMap<String, RoadLinks>,
    pub junctions: Vec<JunctionLink>,
}

impl Links {
    /// Changes of the text: byte ranges with their replacements.
    pub fn edits(&self) -> Vec<(Range<usize>, String)> {
        let mut edits = Vec::new();
        if !self.roads.values().any(|road| road.sections.iter().any(|section| section.is_short)) {
            return edits;
        }
        for road in self.roads.values() {
            self.of_road(road, &mut edits);
        }
        for link in &self.junctions {
            let ends = (self.incoming(link), self.inward(&link.connecting, link.at_end, link.to));
            if ends == (Some(link.from), Some(link.to)) {
                continue;
            }
            let text = match ends {
                (Some(from), Some(to)) => format!("<laneLink from=\"{from}\" to=\"{to}\"></laneLink>"),
                _ => String::new(),
            };
            edits.push((link.at.clone(), text));
        }
        edits
    }

    /// Pairs of lanes that the file links across the end of a road, by a link of the lane or by a junction.
    pub fn stated(&self) -> Vec<(RoadLane<'_>, RoadLane<'_>)> {
        let mut pairs = Vec::new();
        let mut joined = HashSet::new();
        for link in &self.junctions {
            let (incoming, connecting) = (link.incoming.as_str(), link.connecting.as_str());
            joined.insert((incoming, connecting));
            let ends = (self.incoming(link), self.inward(connecting, link.at_end, link.to));
            if let (Some(from), Some(to)) = ends {
                pairs.push(((incoming, from), (connecting, to)));
            }
        }
        let mut roads: Vec<_> = self.roads.iter().collect();
        roads.sort_by_key(|(id, _)| id.as_str());
        for (id, road) in roads {
            for (after, end) in road.ends.iter().enumerate() {
                let Some(end) = end.as_ref().filter(|end| !end.is_junction) else { continue };
                // A junction that links lanes of the two roads lists all of these links.
                let other = end.id.as_str();
                if joined.contains(&(id.as_str(), other)) || joined.contains(&(other, id.as_str())) {
                    continue;
                }
                let mut own = road.sections.iter().filter(|section| !section.is_short);
                let section = if after == 1 { own.next_back() } else { own.next() };
                let links = section.into_iter().flat_map(|section| &section.links);
                for link in links.filter(|link| usize::from(link.after) == after) {
                    let to = road.beyond(link).and_then(|lane| self.inward(other, end.at_end, lane));
                    pairs.extend(to.map(|to| ((id.as_str(), link.lane), (other, to))));
                }
            }
        }
        pairs
    }

    /// Pairs of lanes that the file links within a road: id of the road, and for each lane its section and
    /// its number.
    pub fn stated_within(&self) -> Vec<(&str, [(usize, i32); 2])> {
        let mut pairs = Vec::new();
        let mut roads: Vec<_> = self.roads.iter().collect();
        roads.sort_by_key(|(id, _)| id.as_str());
        for (id, road) in roads {
            for (i, section) in road.sections.iter().enumerate().filter(|(_, section)| !section.is_short) {
                for link in &section.links {
                    let onward = |at: usize| if link.after { at + 1 } else { at.wrapping_sub(1) };
                    let Some((to, false)) = road.through(onward(i), link.to, link.after) else { continue };
                    let mut next = onward(i);
                    while road.sections.get(next).is_some_and(|section| section.is_short) {
                        next = onward(next);
                    }
                    pairs.push((id.as_str(), [(i, link.lane), (next, to)]));
                }
            }
        }
        pairs
    }

    fn of_road(&self, road: &RoadLinks, edits: &mut Vec<(Range<usize>, String)>) {
        for (i, section) in road.sections.iter().enumerate().filter(|(_, section)| !section.is_short) {
            for link in &section.links {
                let next = if link.after { i + 1 } else { i.wrapping_sub(1) };
                let through = road.through(next, link.to, link.after);
                let to = match (through, &road.ends[usize::from(link.after)]) {
                    (Some((lane, true)), Some(end)) if !end.is_junction => {
                        self.inward(&end.id, end.at_end, lane)
                    }
                    // Across a junction, the links of the junction apply.
                    (_, Some(end)) if end.is_junction && through.is_none_or(|(_, beyond)| beyond) => {
                        Some(link.to)
                    }
                    (through, _) => through.map(|(lane, _)| lane),
                };
                if to == Some(link.to) {
                    continue;
                }
                let name = if link.after { "successor" } else { "predecessor" };
                let mut text = String::new();
                if let Some(to) = to {
                    let _ = write!(text, "<{name} id=\"{to}\"></{name}>");
                }
                edits.push((link.at.clone(), text));
            }
        }
    }

    /// The lane within a road that continues a lane at its end, past its short sections; for a missing road
    /// the lane itself.
    fn inward(&self, road: &str, at_end: bool, lane: i32) -> Option<i32> {
        self.roads.get(road).map_or(Some(lane), |road| road.inward(at_end, lane))
    }

    /// The lane at which a link of a junction starts.
    fn incoming(&self, link: &JunctionLink) -> Option<i32> {
        let connecting = self.roads.get(&link.connecting);
        let behind = connecting.and_then(|road| road.ends[usize::from(link.at_end)].as_ref());
        let behind = behind.filter(|end| !end.is_junction && end.id == link.incoming).map(|end| end.at_end);
        let to_junction = |end: &Option<RoadEnd>| {
            end.as_ref().is_some_and(|end| end.is_junction && end.id == link.junction)
        };
        let own = || self.roads.get(&link.incoming).and_then(|road| road.ends.iter().position(to_junction));
        let at_end = behind.or_else(|| own().map(|end| end == 1)).unwrap_or(true);
        self.inward(&link.incoming, at_end, link.from)
    }
}

/// The text with these byte ranges replaced.
pub(super) fn edited(text: String, mut edits: Vec<(Range<usize>, String)>) -> String {
    if edits.is_empty() {
        return text;
    }
    edits.sort_by_key(|(at, _)| at.start);
    let (mut out, mut from) = (String::with_capacity(text.len()), 0);
    for (at, new) in edits {
        out.push_str(text.get(from..at.start).unwrap_or_default());
        out.push_str(&new);
        from = from.max(at.end);
    }
    out.push_str(text.get(from..).unwrap_or_default());
    out
}
