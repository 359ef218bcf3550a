//! Reduces an OpenDRIVE file to the parts that a scene shows, within limits.
//!
//! The crate that reads maps builds anything that a file requests, at any cost of time and memory. Therefore
//! each file is filtered first, element by element. Parts that a scene shows are kept, counted and limited
//! far above real maps. The rest (surfaces, boards, railways, external files) is dropped. Coordinates move to
//! the middle of the file's first road, because the crate stores them in single precision.

use super::bends::{LaneOffset, RoadBends, StraightRoads, number};
use super::short::{self, JunctionLink, LaneLink, LinkedSection, Links, RoadEnd, RoadLinks};
use crate::around::Chosen;
use crate::limits::memory_for;
use crate::problem::{FieldProblem, ReadError, at_most, code};
use crate::refusals::{self, what};
use crate::source::Source;
use crate::unpack::{self, Bounds};
use crate::xml::{Element, Scanner, XmlEvent};
use scene::Vec2;
use std::collections::{BTreeMap, HashSet};
use std::fmt::Write as _;
use std::ops::Range;

/// Most bytes of a file once decompressed.
const MAX_BYTES: u64 = 256 << 20;
/// Most bytes of one tag or one piece of text.
const MAX_TAG: usize = 1 << 20;
/// Most bytes and elements that are kept.
const MAX_KEPT_BYTES: usize = 48 << 20;
const MAX_KEPT: usize = 500_000;
/// Most lanes of a map in all lane sections, and of one lane section.
const MAX_LANES: usize = 60_000;
const MAX_SECTION_LANES: usize = 64;
/// Most signals and references to them, and most objects.
const MAX_SIGNALS: usize = 4_000;
const MAX_OBJECTS: usize = 10_000;
/// Greatest total length of reference lines, and of lanes, metres.
const MAX_LINES_M: f64 = 500_000.0;
const MAX_LANES_M: f64 = 500_000.0;
/// Most memory, bytes, for each lane of a section, each element and each kept byte, in addition to that per
/// metre of lane. It covers the fixed cost of a lane, nodes, and the text with its copy in the tree.
const LANE_OWN_MEMORY: f64 = 4_000.0;
const ELEMENT_MEMORY: f64 = 700.0;
const TEXT_MEMORY: f64 = 2.0;
/// Most steps of reading: at each metre of a road, each of its records is searched.
const MAX_STEPS: f64 = 4e8;
/// Greatest distance of a coordinate from the origin of the file, metres.
const MAX_SOURCE_M: f64 = 1e8;
/// Greatest length of a road beyond its reference line, metres.
const BEYOND_LINE_M: f64 = 1.0;
/// A kind of marks that is not paint.
const UNPAINTED: &str = "grass";
/// Text before the length in a tag.
const LENGTH: &str = " length=\"";
/// A lane that is raised by this height cannot be entered from the adjacent one, metres.
const RAISED_M: f64 = 0.05;

/// Least distance between changes of the speed limit, and to an end of a section, metres.
const LEAST_STRETCH_M: f64 = 1.0;
/// A `<laneOffset>` that begins this far from the end of the previous one is a step, metres.
const STEP_M: f64 = 0.05;
/// Positions along a road within this distance are equal, metres.
const SAME_M: f64 = 1e-4;

/// Elements that are kept, by their parent.
const KEPT: &[(&str, &[&str])] = &[
    ("OpenDRIVE", &["header", "road", "controller", "junction"]),
    ("road", &["link", "type", "planView", "elevationProfile", "lanes", "objects", "signals"]),
    ("link", &["predecessor", "successor"]),
    ("type", &["speed"]),
    ("planView", &["geometry"]),
    ("geometry", &["line", "arc", "spiral", "poly3", "paramPoly3"]),
    ("elevationProfile", &["elevation"]),
    ("lanes", &["laneOffset", "laneSection"]),
    ("laneSection", &["left", "center", "right"]),
    ("left", &["lane"]),
    ("center", &["lane"]),
    ("right", &["lane"]),
    ("lane", &["link", "width", "border", "speed", "roadMark"]),
    ("objects", &["object"]),
    ("object", &["outlines", "outline", "validity"]),
    ("outlines", &["outline"]),
    ("outline", &["cornerRoad", "cornerLocal"]),
    ("signals", &["signal", "signalReference"]),
    ("signal", &["validity"]),
    ("signalReference", &["validity"]),
    ("controller", &["control"]),
    ("junction", &["connection", "controller"]),
    ("connection", &["laneLink", "predecessor", "successor"]),
];
/// Records that apply from their position on, and the attribute with the position.
const RECORDS: &[(&str, &str)] =
    &[("laneOffset", "s"), ("elevation", "s"), ("width", "sOffset"), ("border", "sOffset")];
/// Elements that a scene does not show, with their names in messages.
const LEFT_OUT: &[(&str, &str)] = &[
    ("superelevation", "superelevation"),
    ("crossfall", "crossfall"),
    ("shape", "lateral shape"),
    ("CRG", "OpenCRG surface"),
    ("railroad", "railroad"),
    ("station", "railway station"),
    ("tunnel", "tunnel"),
    ("bridge", "bridge"),
    ("include", "included file"),
    ("crossPath", "cross path"),
    ("access", "lane access"),
];

/// The filtered file.
#[derive(Clone, Debug, Default)]
pub(super) struct Filtered {
    /// OpenDRIVE, well-formed.
    pub text: String,
    /// Origin in the file's frame, whole metres.
    pub origin: Vec2,
    /// Projection named by the file.
    pub projection: Option<String>,
    /// Position and rotation of the file's frame in the projection: `<offset>`.
    pub offset: Offset,
    /// Number of dropped elements, by name.
    pub left_out: BTreeMap<&'static str, usize>,
    /// Lanes that are raised above the road: road id, lane section, lane id.
    pub raised: HashSet<(String, usize, i32)>,
    /// Ids of roads with left-hand traffic.
    pub left_hand: HashSet<String>,
    /// Faults that were repaired.
    pub faults: Vec<String>,
    /// Whether no road is taken.
    pub is_empty: bool,
    /// Links of lanes at the ends of roads and at junctions.
    pub links: Links,
    /// Lanes with borders in a section with widths, and their length, metres.
    pub bordered: (usize, f64),
}

/// `<offset>` of a header, metres and radians.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Offset {
    pub at: Vec2,
    pub z_m: f64,
    pub turn_rad: f64,
}

/// Reads a file, plain or gzip.
///
/// # Errors
/// `malformed-file` for broken XML or gzip, the bounds of a file, `cannot-represent` for another sort of file,
/// `map-too-large` and `out-of-range` for what no scene can hold.
pub(super) fn read(file: &dyn Source, chosen: &mut Chosen) -> Result<Filtered, ReadError> {
    let input = file.open().and_then(|input| unpack::open(input, Bounds::of(MAX_BYTES)));
    let input = input.map_err(|error| unpack::fault(&error, 0))?;
    let mut scanner = Scanner::new(input, MAX_TAG).with_texts();
    let room = memory_for(file.encoded_len());
    let mut filter = Filter { room, chosen: std::mem::take(chosen), ..Filter::default() };
    while let Some(event) = scanner.next()? {
        match event {
            XmlEvent::Start(element) => filter.start(&element)?,
            XmlEvent::End => filter.end()?,
            XmlEvent::Text(text) => filter.text(&text),
        }
    }
    *chosen = std::mem::take(&mut filter.chosen);
    filter.out.is_empty = filter.links.roads.is_empty();
    let mut edits = filter.edits;
    edits.extend(filter.links.edits());
    filter.out.links = filter.links;
    filter.out.text = short::edited(filter.out.text, edits);
    Ok(filter.out)
}

/// The open road.
#[derive(Default)]
struct Road {
    id: String,
    /// Length stated by the file, and length of the reference line.
    length_m: f64,
    line_m: f64,
    /// Position of the length in the text.
    length_at: Range<usize>,
    /// Number of elements that are searched along it.
    records: usize,
    sections: Vec<FilteredSection>,
    /// Positions of speed limits along the road, with the limits.
    speeds: Vec<(f64, Option<String>)>,
    offsets: Vec<LaneOffset>,
    bends: RoadBends,
    ends: [Option<RoadEnd>; 2],
}

#[derive(Clone, Default)]
struct FilteredSection {
    s_m: f64,
    lanes: usize,
    drawn: usize,
    raised: Vec<i32>,
    /// Whether the section contains its right and its left side.
    gives: [bool; 2],
    /// Whether some lane has a width; lanes that have only borders.
    has_widths: bool,
    bordered: usize,
    /// Speed limits of lanes: lane, position in the section, limit.
    speeds: Vec<(i32, f64, Option<String>)>,
}

/// The open lane.
#[derive(Default)]
struct OpenLane {
    has_width: bool,
    has_border: bool,
}

/// Counters and text length before a road, to skip one that lies outside.
#[derive(Default)]
struct BeforeRoad {
    text: usize,
    edits: usize,
    origin: Option<Vec2>,
    kept: usize,
    lanes: usize,
    signals: usize,
    objects: usize,
    lines_m: f64,
}

#[derive(Default)]
struct Filter {
    out: Filtered,
    /// Open elements that are kept.
    open: Vec<String>,
    /// Number of open elements below a skipped one.
    skipped: usize,
    /// Whether the text is that of the projection.
    projection: bool,
    origin: Option<Vec2>,
    ids: HashSet<String>,
    road: Road,
    lane: Option<i32>,
    lane_shape: OpenLane,
    /// Links of the road's sections in the order of the file, and of all previous roads.
    sections: Vec<LinkedSection>,
    links: Links,
    /// The open link: its position, its lane, whether it is a successor, and the linked lane.
    link: Option<(usize, i32, bool, i32)>,
    /// The open junction and connection.
    junction: String,
    connection: (String, String, bool),
    lane_link: Option<JunctionLink>,
    /// The previous record: its name, its depth, the number of lanes so far, and its position.
    last_record: Option<(&'static str, usize, usize, f64)>,
    /// The part to read; whether the open road comes near, and the state before it.
    chosen: Chosen,
    is_near: bool,
    before: BeforeRoad,
    /// Ids of roads outside the part to read.
    outside: HashSet<String>,
    /// Changes of the text that are applied at the end.
    edits: Vec<(Range<usize>, String)>,
    kept: usize,
    lanes: usize,
    signals: usize,
    objects: usize,
    lines_m: f64,
    lanes_m: f64,
    /// Metres of drawn lanes, without the centre lanes; and memory for them, bytes.
    drawn_m: f64,
    drawn_memory: f64,
    straight: StraightRoads,
    steps: f64,
    /// Most bytes of memory.
    room: u64,
}

impl Filter {
    fn start(&mut self, element: &Element) -> Result<(), ReadError> {
        if self.skipped > 0 {
            self.skipped += 1;
            self.count_left_out(&element.name);
            return Ok(());
        }
        let Some(parent) = self.open.last().cloned() else {
            if element.name != "OpenDRIVE" {
                let message = refusals::found_expected(refusals::tag(&element.name), "<OpenDRIVE>");
                return Err(ReadError::other_content(message));
            }
            return self.keep(element, &[]);
        };
        self.road.bends.take(element);
        let known =
            KEPT.iter().any(|(name, inner)| *name == parent && inner.contains(&element.name.as_str()));
        let outside = |name| element.get(name).is_some_and(|id| self.outside.contains(id));
        let across = element.name == "connection"
            && ["incomingRoad", "connectingRoad", "linkedRoad"].into_iter().any(outside);
        if across {
            self.skipped = 1;
            return Ok(());
        }
        if !known || !self.wanted(element) {
            self.projection = parent == "header" && element.name == "geoReference";
            if parent == "header" && element.name == "offset" {
                self.out.offset = offset(element)?;
            }
            self.height(element);
            self.count_left_out(&element.name);
            self.skipped = 1;
            return Ok(());
        }
        match element.name.as_str() {
            "geometry" => {
                let moved = self.geometry(element)?;
                self.keep(element, &moved)
            }
            "road" => self.road(element),
            "roadMark" => self.keep(&unpainted(element), &[]),
            "laneSection" => {
                let s_m = number(element, "s").unwrap_or(0.0).max(0.0);
                let whole = !matches!(element.get("singleSide"), Some("true" | "1"));
                let section = FilteredSection { s_m, gives: [whole; 2], ..FilteredSection::default() };
                self.road.sections.push(section);
                self.sections.push(LinkedSection { s_m, gives: [whole; 2], ..LinkedSection::default() });
                self.keep(element, &[("s", s_m)])
            }
            "lane" => {
                self.lane(element)?;
                self.keep(element, &[])
            }
            _ => {
                let ordered = self.in_order(element);
                let element = ordered.as_ref().unwrap_or(element);
                self.note(&parent, element);
                self.keep(element, &[])
            }
        }
    }

    /// Moves a record that begins before its predecessor, by a rounding error, to the predecessor's position.
    /// The crate sorts records by position; of two at one position the later one in the file applies, as its
    /// writer meant it.
    fn in_order(&mut self, element: &Element) -> Option<Element> {
        let (name, place) = *RECORDS.iter().find(|(name, _)| *name == element.name)?;
        let at = number(element, place)?;
        // Elements with records close before others with their name open.
        let (depth, before) = (self.open.len(), self.last_record);
        self.last_record = Some((name, depth, self.lanes, at));
        let (.., before) =
            before.filter(|(other, d, lane, _)| (*other, *d, *lane) == (name, depth, self.lanes))?;
        if at >= before || before - at > SAME_M {
            return None;
        }
        self.last_record = Some((name, depth, self.lanes, before));
        let mut moved = element.clone();
        moved.attributes.retain(|(name, _)| name != place);
        moved.attributes.push((place.to_owned(), before.to_string()));
        Some(moved)
    }

    /// Records links, and the positions from which values apply.
    fn note(&mut self, parent: &str, element: &Element) {
        let text = |name: &str| element.get(name).unwrap_or_default().to_owned();
        let id = |name: &str| element.get(name).and_then(|id| id.trim().parse::<i32>().ok());
        let from = self.out.text.len();
        let after = element.name == "successor";
        match (parent, element.name.as_str(), self.lane) {
            ("link", "predecessor" | "successor", Some(lane)) => {
                self.link = id("id").map(|to| (from, lane, after, to));
            }
            ("link", "predecessor" | "successor", None) => {
                let end = RoadEnd {
                    is_junction: element.get("elementType") == Some("junction"),
                    id: text("elementId"),
                    at_end: element.get("contactPoint") == Some("end"),
                };
                self.road.ends[usize::from(after)] = Some(end);
            }
            ("laneSection", side @ ("left" | "right"), _) => {
                let left = usize::from(side == "left");
                if let (Some(section), Some(linked)) =
                    (self.road.sections.last_mut(), self.sections.last_mut())
                {
                    (section.gives[left], linked.gives[left]) = (true, true);
                }
            }
            ("lanes", "laneOffset", _) => {
                self.road.offsets.push(LaneOffset::of(element));
            }
            ("road", "type", _) => self.road.speeds.push((number(element, "s").unwrap_or(0.0), None)),
            ("type", "speed", _) => {
                if let Some((_, limit)) = self.road.speeds.last_mut() {
                    *limit = Some(limit_of(element));
                }
            }
            ("lane", "speed", Some(lane)) => {
                let at = number(element, "sOffset").unwrap_or(0.0);
                if let Some(section) = self.road.sections.last_mut() {
                    section.speeds.push((lane, at, Some(limit_of(element))));
                }
            }
            ("lane", "width", _) => {
                self.lane_shape.has_width = true;
                if let Some(section) = self.road.sections.last_mut() {
                    section.has_widths = true;
                }
            }
            ("lane", "border", _) => self.lane_shape.has_border = true,
            ("OpenDRIVE", "junction", _) => self.junction = text("id"),
            ("junction", "connection", _) => {
                let connecting = element.get("connectingRoad").or_else(|| element.get("linkedRoad"));
                let at_end = element.get("contactPoint") == Some("end");
                self.connection = (text("incomingRoad"), connecting.unwrap_or_default().to_owned(), at_end);
            }
            ("connection", "laneLink", _) => {
                let (incoming, connecting, at_end) = self.connection.clone();
                self.lane_link = id("from").zip(id("to")).map(|(lane, to)| JunctionLink {
                    junction: self.junction.clone(),
                    incoming,
                    connecting,
                    at_end,
                    from: lane,
                    to,
                    at: from..from,
                });
            }
            _ => {}
        }
    }

    fn end(&mut self) -> Result<(), ReadError> {
        if self.skipped > 0 {
            self.skipped -= 1;
            self.projection = false;
            return Ok(());
        }
        let Some(name) = self.open.pop() else { return Ok(()) };
        if name == "road" {
            if self.chosen.is_part() && !self.is_near {
                self.pass_over();
                return Ok(());
            }
            self.end_of_road()?;
        }
        if name == "lanes" {
            self.split_at_limits()?;
            self.end_before_steps();
        }
        if name == "lane" {
            self.lane = None;
            let shape = std::mem::take(&mut self.lane_shape);
            let bordered = usize::from(shape.has_border && !shape.has_width);
            if let Some(section) = self.road.sections.last_mut() {
                section.bordered += bordered;
            }
        }
        let _ = write!(self.out.text, "</{name}>");
        let end = self.out.text.len();
        if let Some((from, lane, after, to)) =
            self.link.take_if(|_| name == "predecessor" || name == "successor")
        {
            let link = LaneLink { lane, after, to, at: from..end };
            if let Some(section) = self.sections.last_mut() {
                section.links.push(link);
            }
            return Ok(());
        }
        if let Some(mut link) = self.lane_link.take_if(|_| name == "laneLink") {
            link.at.end = end;
            self.links.junctions.push(link);
        }
        Ok(())
    }

    fn text(&mut self, text: &str) {
        if self.projection && self.out.projection.is_none() {
            self.out.projection = Some(text.chars().take(500).collect());
        }
    }

    /// False for elements of a kept kind without effect.
    fn wanted(&mut self, element: &Element) -> bool {
        let has = |attribute: &str, word: &str| {
            element.get(attribute).is_some_and(|value| value.to_ascii_lowercase().contains(word))
        };
        let known = match element.name.as_str() {
            "road" => self.ids.insert(element.get("id").unwrap_or_default().to_owned()),
            "lanes" => element.get("layer") != Some("temporary"),
            "object" => is_crosswalk(element) || is_stop_line(element),
            "signal" => {
                element.get("dynamic") == Some("yes")
                    || super::signals::is_stop_sign(element.get("type"), element.get("name"))
                    || super::signals::is_light(element.get("type"))
                    || has("type", super::signals::STOP_LINE)
            }
            _ => true,
        };
        let word = match element.name.as_str() {
            "road" => "road with the id of another",
            "lanes" => "temporary lane layer",
            "object" => "object",
            _ => "sign",
        };
        if !known {
            *self.out.left_out.entry(word).or_default() += 1;
        }
        known
    }

    fn count_left_out(&mut self, name: &str) {
        if let Some((_, word)) = LEFT_OUT.iter().find(|(known, _)| *known == name) {
            *self.out.left_out.entry(word).or_default() += 1;
        }
    }

    /// Writes an element with these values replaced, and counts it.
    fn keep(&mut self, element: &Element, values: &[(&str, f64)]) -> Result<(), ReadError> {
        self.kept += 1;
        self.road.records += 1;
        at_most(self.kept, MAX_KEPT, what::ROAD_ELEMENTS)?;
        match element.name.as_str() {
            "signal" | "signalReference" => self.signals += 1,
            "object" => self.objects += 1,
            _ => {}
        }
        at_most(self.signals, MAX_SIGNALS, what::SIGNALS)?;
        at_most(self.objects, MAX_OBJECTS, what::OBJECTS)?;
        let text = &mut self.out.text;
        let _ = write!(text, "<{}", element.name);
        let named = |name: &String| name.bytes().all(|b| b.is_ascii_alphanumeric()) && name != "xmlns";
        for (name, value) in element.attributes.iter().filter(|(name, _)| named(name)) {
            match values.iter().find(|(known, _)| known == name) {
                Some((_, value)) => {
                    let _ = write!(text, " {name}=\"{value}\"");
                }
                None => {
                    let _ = write!(text, " {name}=\"");
                    escape(value, text);
                    text.push('"');
                }
            }
        }
        text.push('>');
        at_most(text.len(), MAX_KEPT_BYTES, what::ROAD_BYTES)?;
        self.fits()?;
        self.open.push(element.name.clone());
        Ok(())
    }

    /// Checks that the result fits the memory for a file of this size.
    fn fits(&self) -> Result<(), ReadError> {
        let made = self.drawn_memory
            + LANE_OWN_MEMORY * self.lanes as f64
            + ELEMENT_MEMORY * self.kept as f64
            + TEXT_MEMORY * self.out.text.len() as f64;
        if made <= self.room as f64 {
            return Ok(());
        }
        let message = refusals::roads_over_memory(self.drawn_m, self.kept);
        Err(ReadError::too_large(code::DECODED_TOO_LARGE, self.room, message))
    }

    fn road(&mut self, element: &Element) -> Result<(), ReadError> {
        let id = element.get("id").unwrap_or_default().to_owned();
        let length_m = number(element, "length").unwrap_or(0.0).clamp(0.0, xodr::MAX_LENGTH);
        if element.get("rule") == Some("LHT") {
            self.out.left_hand.insert(id.clone());
        }
        self.road = Road { id, length_m, ..Road::default() };
        self.last_record = None;
        self.is_near = false;
        self.before = BeforeRoad {
            text: self.out.text.len(),
            edits: self.edits.len(),
            origin: self.origin,
            kept: self.kept,
            lanes: self.lanes,
            signals: self.signals,
            objects: self.objects,
            lines_m: self.lines_m,
        };
        let from = self.out.text.len();
        self.keep(element, &[("length", length_m)])?;
        let tag = &self.out.text[from..];
        if let Some(at) = tag.find(LENGTH) {
            let at = at + LENGTH.len();
            let end = tag[at..].find('"').map_or(tag.len(), |end| at + end);
            self.road.length_at = from + at..from + end;
        }
        Ok(())
    }

    /// Drops the road that ends, as if it had not begun.
    fn pass_over(&mut self) {
        let road = std::mem::take(&mut self.road);
        self.chosen.left_out += road.sections.iter().map(|section| section.drawn).sum::<usize>();
        self.outside.insert(road.id);
        self.sections.clear();
        let BeforeRoad { text, edits, origin, kept, lanes, signals, objects, lines_m } = self.before;
        self.out.text.truncate(text);
        self.edits.truncate(edits);
        self.origin = origin;
        (self.kept, self.lanes, self.signals, self.objects) = (kept, lanes, signals, objects);
        self.lines_m = lines_m;
    }

    /// A road is no longer than its reference line: nothing beyond it has a position.
    fn cut(&mut self, road: &mut Road) {
        if road.line_m <= 0.0 || road.length_m <= road.line_m + BEYOND_LINE_M {
            return;
        }
        let id: String = road.id.chars().take(40).collect();
        let (said, line_m) = (road.length_m, road.line_m);
        let fault = format!("road {id:?}: length {said:.3} m, but its <planView> ends at {line_m:.3} m");
        self.out.faults.push(fault);
        self.edits.push((road.length_at.clone(), line_m.to_string()));
        road.length_m = line_m;
    }

    /// Ends a section just before a `<laneOffset>` that moves all lanes aside begins with the next one: the
    /// crate would place the end of the section by that record. The gap is too short for lanes.
    fn end_before_steps(&mut self) {
        let road = &mut self.road;
        road.offsets.sort_by(|a, b| a.s_m.total_cmp(&b.s_m));
        let steps = road.offsets.windows(2).filter(|pair| pair[0].step_m(&pair[1]) > STEP_M);
        let mut added = Vec::new();
        for s_m in steps.map(|pair| pair[1].s_m) {
            let at = road.sections.partition_point(|section| section.s_m < s_m - SAME_M);
            let next = road.sections.get(at);
            let begins = next.map_or(road.length_m, |section| section.s_m);
            let Some(before) = at.checked_sub(1).and_then(|i| road.sections.get(i)) else { continue };
            let place = s_m - short::SHORT_M / 2.0;
            // The previous section must stay long enough for lanes; a side that continues does not end here.
            let ends = next.is_none_or(|section| section.gives == [true; 2]);
            if !ends || (begins - s_m).abs() > SAME_M || place - before.s_m < 2.0 * short::SHORT_M {
                continue;
            }
            let _ = write!(self.out.text, "<laneSection s=\"{place}\"></laneSection>");
            self.sections.push(LinkedSection { s_m: place, ..LinkedSection::default() });
            added.push(FilteredSection { s_m: place, ..FilteredSection::default() });
        }
        self.kept += added.len();
        road.sections.append(&mut added);
    }

    /// Begins a section at each change of the speed limit, with the lanes of the previous one, so that each
    /// lane has one limit.
    fn split_at_limits(&mut self) -> Result<(), ReadError> {
        let road = &mut self.road;
        road.sections.sort_by(|a, b| a.s_m.total_cmp(&b.s_m));
        let length_m = if road.line_m > 0.0 { road.length_m.min(road.line_m) } else { road.length_m };
        let changes = road.speeds.windows(2).filter(|pair| pair[0].1 != pair[1].1).map(|pair| pair[1].0);
        let mut places: Vec<f64> = changes.collect();
        for section in &road.sections {
            for (i, (lane, at, limit)) in section.speeds.iter().enumerate() {
                let before = section.speeds[..i].iter().rev().find(|(other, ..)| other == lane);
                if before.is_none_or(|(.., other)| other != limit) && *at > 0.0 {
                    places.push(section.s_m + at);
                }
            }
        }
        places.sort_by(f64::total_cmp);
        for place in places {
            let at = road.sections.partition_point(|section| section.s_m <= place);
            let end_m = road.sections.get(at).map_or(length_m, |next| next.s_m.min(length_m));
            let Some(before) = at.checked_sub(1).and_then(|i| road.sections.get(i)).cloned() else {
                continue;
            };
            if place - before.s_m < LEAST_STRETCH_M || end_m - place < LEAST_STRETCH_M {
                continue;
            }
            self.lanes += before.lanes;
            self.kept += 1;
            at_most(self.lanes, MAX_LANES, what::LANES)?;
            let _ = write!(self.out.text, "<laneSection s=\"{place}\" singleSide=\"true\"></laneSection>");
            self.sections.push(LinkedSection { s_m: place, ..LinkedSection::default() });
            road.sections.insert(at, FilteredSection { s_m: place, gives: [false; 2], ..before });
        }
        self.fits()
    }

    /// A segment of the reference line, relative to the file's own middle.
    fn geometry(&mut self, element: &Element) -> Result<Vec<(&'static str, f64)>, ReadError> {
        let length_m = number(element, "length").unwrap_or(0.0).max(0.0);
        self.lines_m += length_m;
        if self.lines_m > MAX_LINES_M {
            return Err(ReadError::map_too_large(refusals::more_than(MAX_LINES_M, what::LINE_METRES)));
        }
        let (Some(x), Some(y)) = (number(element, "x"), number(element, "y")) else {
            return Ok(Vec::new());
        };
        if let Some(far) = [x, y].into_iter().find(|v| v.abs() > MAX_SOURCE_M) {
            return Err(FieldProblem::range("", -MAX_SOURCE_M, MAX_SOURCE_M, far).into());
        }
        self.is_near |= self.chosen.takes_near(Vec2::new(x, y), length_m);
        let origin = *self.origin.get_or_insert(Vec2::new(x.round(), y.round()));
        self.out.origin = origin;
        let s_m = number(element, "s").unwrap_or(0.0).clamp(0.0, xodr::MAX_LENGTH);
        self.road.line_m = self.road.line_m.max(s_m + length_m).min(xodr::MAX_LENGTH);
        Ok(vec![("s", s_m), ("x", x - origin.x), ("y", y - origin.y), ("length", length_m)])
    }

    fn lane(&mut self, element: &Element) -> Result<(), ReadError> {
        self.lanes += 1;
        at_most(self.lanes, MAX_LANES, what::LANES)?;
        self.lane = element.get("id").and_then(|id| id.trim().parse().ok());
        if let Some(section) = self.road.sections.last_mut() {
            section.lanes += 1;
            section.drawn += usize::from(self.lane != Some(0));
            at_most(section.lanes, MAX_SECTION_LANES, what::SECTION_LANES)?;
        }
        Ok(())
    }

    /// Records that a lane is raised above the road; its height is dropped.
    fn height(&mut self, element: &Element) {
        let (Some(lane), "height") = (self.lane, element.name.as_str()) else { return };
        let raised =
            ["inner", "outer"].iter().any(|side| number(element, side).is_some_and(|h| h >= RAISED_M));
        if let (true, Some(section)) = (raised, self.road.sections.last_mut()) {
            section.raised.push(lane);
        }
    }

    fn end_of_road(&mut self) -> Result<(), ReadError> {
        let mut road = std::mem::take(&mut self.road);
        self.cut(&mut road);
        // In the order of their numbers: along the road.
        road.sections.sort_by(|a, b| a.s_m.total_cmp(&b.s_m));
        let mut links =
            RoadLinks { sections: std::mem::take(&mut self.sections), ends: std::mem::take(&mut road.ends) };
        links.close(road.length_m);
        self.links.roads.insert(road.id.clone(), links);
        for i in 1..road.sections.len() {
            let gives = road.sections[i].gives;
            let raised = road.sections[i - 1].raised.clone();
            let carried = raised.into_iter().filter(|lane| !gives[usize::from(*lane > 0)]);
            road.sections[i].raised.extend(carried);
        }
        let widest = road.sections.iter().map(|section| section.lanes).max().unwrap_or(0);
        let (lane_memory, crossing_memory) = self.straight.take(&road.bends, road.length_m, widest);
        self.drawn_memory += crossing_memory;
        for (i, section) in road.sections.iter().enumerate() {
            let end_m = road.sections.get(i + 1).map_or(road.length_m, |next| next.s_m).min(road.length_m);
            self.lanes_m += (end_m - section.s_m).max(0.0) * section.lanes as f64;
            let drawn_m = (end_m - section.s_m).max(0.0) * section.drawn as f64;
            self.drawn_m += drawn_m;
            self.drawn_memory += lane_memory * drawn_m;
            let raised = section.raised.iter().map(|lane| (road.id.clone(), i, *lane));
            self.out.raised.extend(raised);
            if section.has_widths && section.bordered > 0 {
                self.out.bordered.0 += section.bordered;
                self.out.bordered.1 += (end_m - section.s_m).max(0.0) * section.bordered as f64;
            }
        }
        if self.lanes_m > MAX_LANES_M {
            return Err(ReadError::map_too_large(refusals::more_than(MAX_LANES_M, what::LANE_METRES)));
        }
        self.fits()?;
        self.steps += road.records as f64 * road.length_m * widest as f64 / 8.0;
        if self.steps > MAX_STEPS {
            let message = refusals::road_over_limit(&refusals::shown(&road.id), road.records);
            return Err(ReadError::map_too_large(message));
        }
        Ok(())
    }
}

/// The limit of a `<speed>`, for comparisons.
fn limit_of(speed: &Element) -> String {
    format!("{} {}", speed.get("max").unwrap_or_default(), speed.get("unit").unwrap_or_default())
}

fn offset(element: &Element) -> Result<Offset, ReadError> {
    let value = |name| number(element, name).unwrap_or(0.0);
    let offset = Offset { at: Vec2::new(value("x"), value("y")), z_m: value("z"), turn_rad: value("hdg") };
    match [offset.at.x, offset.at.y, offset.z_m].into_iter().find(|v| v.abs() > MAX_SOURCE_M) {
        Some(far) => Err(FieldProblem::range("", -MAX_SOURCE_M, MAX_SOURCE_M, far).into()),
        None => Ok(offset),
    }
}

fn is_crosswalk(element: &Element) -> bool {
    element.get("type").is_some_and(|kind| kind.eq_ignore_ascii_case("crosswalk"))
}

/// The mark as a kind that the crate does not paint, with its own kind as its material. Otherwise the crate
/// would cut broken lines into all of their dashes, which no scene shows, and on a long road that takes
/// seconds.
fn unpainted(mark: &Element) -> Element {
    let mut mark = mark.clone();
    let sort = mark.get("type").unwrap_or_default().to_owned();
    mark.attributes.retain(|(name, _)| name != "type" && name != "material");
    mark.attributes.extend([("type".to_owned(), UNPAINTED.to_owned()), ("material".to_owned(), sort)]);
    mark
}

/// Whether paint is a stop line. There is no type for it: the name or the subtype tells.
pub(super) fn is_stop_line(element: &Element) -> bool {
    let says = |attribute| {
        let letters = element.get(attribute).unwrap_or_default().chars().filter(char::is_ascii_alphabetic);
        letters.collect::<String>().to_ascii_lowercase().contains("stopline")
    };
    says("name") || says("subtype")
}

/// Writes an attribute's value escaped for XML; a character that XML does not allow becomes a space.
fn escape(value: &str, out: &mut String) {
    for c in value.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '"' => out.push_str("&quot;"),
            '\u{0}'..='\u{1f}' | '\u{fffe}' | '\u{ffff}' => out.push(' '),
            c => out.push(c),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn filtered(text: &str) -> Result<Filtered, ReadError> {
        read(&text.as_bytes(), &mut Chosen::default())
    }

    #[test]
    fn keeps_what_scenes_show() {
        let file = filtered(
            "<OpenDRIVE xmlns='a'><header><geoReference><![CDATA[+proj=utm]]></geoReference></header>\
             <road id='a&amp;\"' length='9' rule='LHT'><surface><CRG/></surface><planView>\
             <geometry s='0' x='500000.4' y='7' hdg='0' length='9'><line/></geometry></planView><lanes>\
             <laneSection s=' 1 '><right><lane id='-1' type='driving'><width a='3'/><height inner='0' outer='0.1'/>\
             </lane></right></laneSection></lanes><objects><object type='tree'/></objects></road></OpenDRIVE>",
        )
        .unwrap();
        let expected = "<OpenDRIVE><header></header><road id=\"a&amp;&quot;\" length=\"9\" rule=\"LHT\"><planView>\
             <geometry s=\"0\" x=\"0.40000000002328306\" y=\"0\" hdg=\"0\" length=\"9\"><line></line></geometry>\
             </planView><lanes><laneSection s=\"1\"><right><lane id=\"-1\" type=\"driving\"><width a=\"3\"></width>\
             </lane></right></laneSection></lanes><objects></objects></road></OpenDRIVE>";
        assert_eq!(file.text, expected);
        assert_eq!(file.origin, Vec2::new(500_000.0, 7.0));
        assert_eq!(file.projection.as_deref(), Some("+proj=utm"));
        assert_eq!(file.left_out.into_iter().collect::<Vec<_>>(), [("OpenCRG surface", 1), ("object", 1)]);
        assert!(file.raised.contains(&("a&\"".to_owned(), 0, -1)));
        assert!(file.left_hand.contains("a&\""));
    }

    #[test]
    fn roads_end_with_their_lines_and_marks_paint_no_dashes() {
        let road = |length: &str| {
            let text = format!(
                "<OpenDRIVE><road id='7' length='{length}'><planView><geometry s='0' x='0' y='0' length='20.5'/>\
                 <geometry s='20.5' x='20.5' y='0' length='9.5'/></planView><lanes><laneSection s='0'><center>\
                 <lane id='0'><roadMark type='broken' material='standard' color='yellow'/></lane></center>\
                 </laneSection></lanes></road></OpenDRIVE>"
            );
            filtered(&text).unwrap()
        };
        let cut = road("1000001");
        assert!(cut.text.contains("<road id=\"7\" length=\"30\">"), "{}", cut.text);
        assert_eq!(cut.faults, ["road \"7\": length 100000.000 m, but its <planView> ends at 30.000 m"]);
        let whole = road("30.2");
        assert!(whole.text.contains("length=\"30.2\">") && whole.faults.is_empty());
        assert!(
            whole.text.contains("<roadMark color=\"yellow\" type=\"grass\" material=\"broken\">"),
            "{}",
            whole.text
        );
    }

    #[test]
    fn bounds_what_a_map_asks_for() {
        let line = |length: &str| {
            format!(
                "<OpenDRIVE><road id='1' length='{length}'><planView><geometry x='0' y='0' length='{length}'/>\
                 </planView></road></OpenDRIVE>"
            )
        };
        assert!(filtered(&line("1e5")).is_ok());
        assert_eq!(filtered(&line("1e6")).unwrap_err().code(), code::MAP_TOO_LARGE);
        let lanes = "<lane id='-1'/>".repeat(MAX_SECTION_LANES + 1);
        let text = format!(
            "<OpenDRIVE><road><lanes><laneSection><right>{lanes}</right></laneSection></lanes></road></OpenDRIVE>"
        );
        assert_eq!(filtered(&text).unwrap_err().code(), code::MAP_TOO_LARGE);
        let far = line("9").replace("x='0'", "x='1e9'");
        assert_eq!(filtered(&far).unwrap_err().code(), code::OUT_OF_RANGE);
        assert_eq!(filtered("<net/>").unwrap_err().code(), code::CANNOT_REPRESENT);
    }
}
