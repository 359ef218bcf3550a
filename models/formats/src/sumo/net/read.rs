//! Reads a network in one pass over its elements; unknown elements are dropped.

use super::{EdgeFunction, LaneKind, NARROWEST_LANE_M, Net, NetEdge, NetJunction, NetLane};
use crate::around::Chosen;
use crate::limits::MAX_POLYLINES;
use crate::problem::ReadError;
use crate::refusals::{self, wanted, what};
use crate::sumo::SumoError;
use crate::sumo::kerb::s_curve;
use crate::sumo::programs::SignalProgram;
use crate::xml::{Element, Scanner, XmlEvent};
use scene::Vec2;
use std::collections::{HashMap, HashSet};
use std::hash::{DefaultHasher, Hash, Hasher};
use std::io::BufRead;

/// Most bytes of one tag: a shape with the most points of a polyline, twice (`outlineShape`).
const MAX_TAG: usize = 1 << 20;
/// Most elements of a network.
const MAX_ELEMENTS: usize = 600_000;
/// Most attributes in a network.
const MAX_ATTRIBUTES: usize = 4_000_000;
/// Greatest width of a junction, metres.
const JUNCTION_M: f64 = 200.0;
/// Width of a lane without a stated one, metres: SUMO's default.
const LANE_WIDTH_M: f64 = 3.2;

/// Most characters of a projection.
const PROJECTION_CHARS: usize = 500;
/// Lane ends within the first distance need no connection, and those beyond the second, wider than a
/// junction, have none, metres.
const WAY_M: (f64, f64) = (0.5, 60.0);

/// The open element below the root.
#[derive(Default)]
enum OpenElement {
    /// None, or one that is skipped.
    #[default]
    Other,
    Edge(NetEdge),
    Program(SignalProgram),
}

/// A `<connection>`; it may precede the lanes that it names.
struct Connection {
    from: String,
    to: String,
    via: Option<String>,
    /// Whether it passes a stop sign.
    stops: bool,
    signal: Option<(String, usize)>,
}

#[derive(Default)]
struct Reader {
    net: Net,
    /// Number of open elements.
    depth: usize,
    open: OpenElement,
    connections: Vec<Connection>,
    elements: usize,
    attributes: usize,
    chosen: Chosen,
    /// Hashes of the ids of skipped edges.
    left_out: HashSet<u64>,
}

impl Net {
    /// Reads a network.
    ///
    /// # Errors
    /// When the text is not XML or not a SUMO network, or a value cannot be read.
    pub fn read(text: &str) -> Result<Self, SumoError> {
        Self::read_from(text.as_bytes())
    }

    /// Reads a network from a stream; its faults and limits return as [`SumoError::File`].
    pub(in crate::sumo) fn read_from(input: impl BufRead) -> Result<Self, SumoError> {
        Self::read_part(input, &mut Chosen::default())
    }

    /// Reads the chosen part of a network: edges with a lane near the circle, with the connections among
    /// them.
    pub(in crate::sumo) fn read_part(input: impl BufRead, chosen: &mut Chosen) -> Result<Self, SumoError> {
        let mut scanner = Scanner::new(input, MAX_TAG);
        let mut reader = Reader { chosen: std::mem::take(chosen), ..Reader::default() };
        while let Some(event) = scanner.next()? {
            match event {
                XmlEvent::Start(element) => reader.start(&element)?,
                XmlEvent::End => reader.end(),
                XmlEvent::Text(_) => {}
            }
        }
        *chosen = std::mem::take(&mut reader.chosen);
        Ok(reader.linked())
    }
}

impl Reader {
    fn start(&mut self, element: &Element) -> Result<(), SumoError> {
        self.count(element)?;
        self.depth += 1;
        match (self.depth, element.name.as_str(), &mut self.open) {
            (1, "net", _) => self.net.notes.left_hand = element.get("lefthand") == Some("true"),
            (1, ..) => {
                return Err(SumoError::content(refusals::tag(&element.name), wanted::SUMO_NET));
            }
            (2, "location", _) => {
                let projection = element.get("projParameter").map(str::trim);
                let projection = projection.filter(|text| !matches!(*text, "!" | "-" | "" | "."));
                self.net.notes.projection =
                    projection.map(|text| text.chars().take(PROJECTION_CHARS).collect());
                self.net.notes.offset = offset(element)?;
            }
            (2, "edge", open) => *open = edge(element)?.map_or(OpenElement::Other, OpenElement::Edge),
            (2, "tlLogic", open) => *open = OpenElement::Program(program(element)?),
            (2, "junction", _) if element.get("type") != Some("internal") => {
                let junction = junction(element)?;
                if self.chosen.takes_near(junction.position, JUNCTION_M) {
                    self.net.junctions.push(junction);
                }
            }
            (2, "connection", _) => {
                let outside = |end| element.get(end).is_some_and(|id| self.left_out.contains(&hash(id)));
                if !outside("from") && !outside("to") {
                    self.connections.push(connection(element)?);
                }
            }
            (3, "lane", OpenElement::Edge(edge)) => {
                let number = edge.lanes.len();
                edge.lanes.push(self.net.lanes.len());
                let lane = lane(element, edge.function, &mut self.net.notes.heights)?;
                self.net.lanes.push(NetLane { edge: self.net.edges.len(), index: number, ..lane });
            }
            (3, "phase", OpenElement::Program(program)) => add_phase(element, program)?,
            _ => {}
        }
        Ok(())
    }

    /// Limits the lists of a network.
    fn count(&mut self, element: &Element) -> Result<(), SumoError> {
        if self.chosen.is_part() {
            // A skipped edge takes only the memory of its hash.
            self.elements = self.net.lanes.len() + self.connections.len() + self.left_out.len() / 8;
        } else {
            self.elements += 1;
            self.attributes += element.attributes.len();
        }
        let counts = [
            (self.elements, MAX_ELEMENTS, what::ELEMENTS),
            (self.attributes, MAX_ATTRIBUTES, what::ATTRIBUTES),
        ];
        if let Some((most, what)) = refusals::exceeded(&counts) {
            let message = refusals::network_too_large(most, what).at_line(element.line);
            return Err(SumoError::File(ReadError::map_too_large(message)));
        }
        Ok(())
    }

    fn end(&mut self) {
        if self.depth == 2 {
            match std::mem::take(&mut self.open) {
                OpenElement::Edge(edge) => self.edge(edge),
                OpenElement::Program(program) => self.net.programs.push(program),
                OpenElement::Other => {}
            }
        }
        self.depth = self.depth.saturating_sub(1);
    }

    /// Adds an edge, or drops it with its lanes if it lies outside the chosen part.
    fn edge(&mut self, edge: NetEdge) {
        let first = self.net.lanes.len() - edge.lanes.len();
        let lanes = self.net.lanes.get(first..).unwrap_or_default();
        let travelled = |lane: &&NetLane| {
            !matches!(lane.kind, LaneKind::Crossing | LaneKind::WalkingArea | LaneKind::Closed)
        };
        let (count, mut taken) = (lanes.iter().filter(travelled).count(), false);
        for lane in lanes {
            taken |= self.chosen.takes(&lane.shape);
        }
        if taken || !self.chosen.is_part() {
            self.net.edges.push(edge);
            return;
        }
        self.net.lanes.truncate(first);
        self.chosen.left_out += count;
        self.left_out.insert(hash(&edge.id));
    }

    /// The network with linked lanes. A connection of missing lanes is ignored.
    fn linked(self) -> Net {
        let Self { mut net, connections, .. } = self;
        let by_id: HashMap<String, usize> =
            net.lanes.iter().enumerate().map(|(i, l)| (l.id.clone(), i)).collect();
        // Ways through junctions, each with its next lane: some files have no connection out of them.
        let mut unled: Vec<(usize, usize)> = Vec::new();
        // Signal links for lanes that are entered without a lane between: one, or several.
        let mut entered: HashMap<usize, Vec<Option<(String, usize)>>> = HashMap::new();
        for connection in connections {
            let (from, to) = (by_id.get(&connection.from), by_id.get(&connection.to));
            let (Some(&from), Some(&to)) = (from, to) else { continue };
            let via =
                connection.via.and_then(|id| by_id.get(&id).copied()).or_else(|| way(&mut net, from, to));
            net.lanes[from].successors.push(via.unwrap_or(to));
            unled.extend(via.map(|via| (via, to)));
            if let Some(via) = via.filter(|_| connection.stops) {
                net.lanes[via].stops = true;
            }
            let crossing = || (net.lanes[to].kind == LaneKind::Crossing).then_some(to);
            match (via.or_else(crossing), connection.signal) {
                (Some(lane), Some(signal)) => net.lanes[lane].signal = Some(signal),
                (None, signal) => entered.entry(to).or_default().push(signal),
                (Some(_), None) => {}
            }
        }
        unled.retain(|(via, _)| net.lanes[*via].successors.is_empty());
        for (via, to) in unled {
            if !net.lanes[via].successors.contains(&to) {
                net.lanes[via].successors.push(to);
            }
        }
        // In a network without ways through junctions, the signals apply to the lanes after them.
        for (lane, signals) in entered {
            if let Some(first) = signals.first().filter(|first| signals.iter().all(|signal| signal == *first))
            {
                net.lanes[lane].signal = net.lanes[lane].signal.take().or_else(|| first.clone());
            }
        }
        net
    }
}

fn hash(id: &str) -> u64 {
    let mut hasher = DefaultHasher::new();
    id.hash(&mut hasher);
    hasher.finish()
}

/// A way through a junction between the ends of two lanes, for networks without them (`--no-internal-links`);
/// nothing if the lanes meet or carry no traffic.
fn way(net: &mut Net, from: usize, to: usize) -> Option<usize> {
    let travelled = |lane: usize| {
        let kind = net.lanes[lane].kind;
        net.edge_of(lane).function == EdgeFunction::Normal
            && matches!(kind, LaneKind::Vehicle | LaneKind::Bike | LaneKind::Bus)
    };
    if !travelled(from) || !travelled(to) || net.lanes.len() > MAX_POLYLINES {
        return None;
    }
    let ([.., before, end], [start, after, ..]) = (&net.lanes[from].shape[..], &net.lanes[to].shape[..])
    else {
        return None;
    };
    let gap_m = (start - end).norm();
    if !(WAY_M.0..=WAY_M.1).contains(&gap_m) {
        return None;
    }
    let reach = |way: Vec2| way * (gap_m / way.norm().max(1e-9));
    let pieces = gap_m.ceil().clamp(4.0, 60.0) as usize;
    let shape = s_curve(*end, reach(end - before), *start, reach(after - start), pieces);
    let (lane, edge) = (net.lanes.len(), net.edges.len());
    let id = format!(":{}>{}", net.lanes[from].id, net.lanes[to].id);
    net.edges.push(NetEdge {
        id: id.clone(),
        function: EdgeFunction::Internal,
        from: String::new(),
        to: String::new(),
        road_type: String::new(),
        lanes: vec![lane],
    });
    let (first, second) = (&net.lanes[from], &net.lanes[to]);
    net.lanes.push(NetLane {
        id,
        edge,
        index: 0,
        kind: if first.kind == LaneKind::Vehicle { second.kind } else { first.kind },
        speed_mps: first.speed_mps.min(second.speed_mps),
        width_m: first.width_m.min(second.width_m),
        shape,
        successors: vec![to],
        signal: None,
        stops: false,
    });
    Some(lane)
}

/// The offset that was added to the projected coordinates.
fn offset(location: &Element) -> Result<Vec2, SumoError> {
    let Some(text) = location.get("netOffset") else { return Ok(Vec2::zeros()) };
    point(text).map(|(offset, _)| offset).ok_or_else(|| SumoError::value(text, wanted::POINT, location.line))
}

fn owned(element: &Element, attribute: &'static str) -> Result<String, SumoError> {
    Ok(element.required(attribute)?.to_owned())
}

fn number(element: &Element, attribute: &'static str) -> Result<f64, SumoError> {
    let text = element.required(attribute)?;
    let value: Option<f64> = text.parse().ok().filter(|v: &f64| v.is_finite());
    value.ok_or_else(|| SumoError::value(text, wanted::NUMBER, element.line))
}

/// An edge without its lanes; `None` for one of an unknown function.
fn edge(element: &Element) -> Result<Option<NetEdge>, SumoError> {
    let function = match element.get("function").unwrap_or("normal") {
        "normal" | "connector" => EdgeFunction::Normal,
        "internal" => EdgeFunction::Internal,
        "crossing" => EdgeFunction::Crossing,
        "walkingarea" => EdgeFunction::WalkingArea,
        _ => return Ok(None),
    };
    let text = |name| element.get(name).unwrap_or_default().to_owned();
    Ok(Some(NetEdge {
        id: owned(element, "id")?,
        function,
        from: text("from"),
        to: text("to"),
        road_type: text("type"),
        lanes: Vec::new(),
    }))
}

/// A lane; the caller knows its position in the network.
fn lane(element: &Element, function: EdgeFunction, heights: &mut bool) -> Result<NetLane, SumoError> {
    let has_width = element.get("width").is_some();
    // A negative width stands for the default.
    let told_m = if has_width { Some(number(element, "width")?) } else { None };
    let width_m = told_m.filter(|width| *width >= 0.0).unwrap_or(LANE_WIDTH_M);
    Ok(NetLane {
        id: owned(element, "id")?,
        edge: 0,
        index: 0,
        kind: if width_m < NARROWEST_LANE_M { LaneKind::Closed } else { kind_of(function, element) },
        speed_mps: number(element, "speed")?,
        width_m,
        shape: shape(element, heights)?,
        successors: Vec::new(),
        signal: None,
        stops: false,
    })
}

fn junction(element: &Element) -> Result<NetJunction, SumoError> {
    let position = Vec2::new(number(element, "x")?, number(element, "y")?);
    let kind = element.get("type").unwrap_or_default().to_owned();
    Ok(NetJunction { id: owned(element, "id")?, kind, position })
}

fn connection(element: &Element) -> Result<Connection, SumoError> {
    let lane = |edge, index| -> Result<String, SumoError> {
        Ok(format!("{}_{}", element.required(edge)?, element.required(index)?))
    };
    let signal = match element.get("tl") {
        Some(program) => Some((program.to_owned(), number(element, "linkIndex")?.max(0.0) as usize)),
        None => None,
    };
    Ok(Connection {
        from: lane("from", "fromLane")?,
        to: lane("to", "toLane")?,
        via: element.get("via").map(str::to_owned),
        stops: matches!(element.get("state"), Some("s" | "w")),
        signal,
    })
}

/// A signal program without its phases.
fn program(element: &Element) -> Result<SignalProgram, SumoError> {
    Ok(SignalProgram {
        id: owned(element, "id")?,
        kind: element.get("type").unwrap_or("static").to_owned(),
        offset_s: match element.get("offset") {
            // `begin` means the start of the simulation.
            None | Some("begin") => 0.0,
            Some(_) => number(element, "offset")?,
        },
        phases: Vec::new(),
        jumps: false,
    })
}

fn add_phase(element: &Element, program: &mut SignalProgram) -> Result<(), SumoError> {
    let duration_s = number(element, "duration")?;
    if duration_s < 0.0 {
        let found = element.required("duration")?;
        return Err(SumoError::value(found, wanted::DURATION, element.line));
    }
    program.jumps |= element.get("next").is_some();
    program.phases.push((duration_s, element.required("state")?.as_bytes().to_vec()));
    Ok(())
}

fn kind_of(function: EdgeFunction, lane: &Element) -> LaneKind {
    match function {
        EdgeFunction::Crossing => return LaneKind::Crossing,
        EdgeFunction::WalkingArea => return LaneKind::WalkingArea,
        _ => {}
    }
    let Some(allow) = lane.get("allow").filter(|a| !a.is_empty() && *a != "all") else {
        let closed = lane.get("disallow") == Some("all");
        return if closed { LaneKind::Closed } else { LaneKind::Vehicle };
    };
    let only = |names: &[&str]| allow.split_whitespace().all(|class| names.contains(&class));
    match allow {
        _ if only(&["pedestrian", "wheelchair"]) => LaneKind::Sidewalk,
        _ if only(&["bicycle", "scooter", "pedestrian", "wheelchair"]) => LaneKind::Bike,
        _ if only(&["bus", "coach", "taxi"]) => LaneKind::Bus,
        _ if only(&[
            "tram",
            "rail",
            "rail_urban",
            "rail_fast",
            "rail_electric",
            "subway",
            "cable_car",
            "ship",
        ]) =>
        {
            LaneKind::Closed
        }
        _ => LaneKind::Vehicle,
    }
}

/// A point, and whether it has a height.
fn point(text: &str) -> Option<(Vec2, bool)> {
    let mut values = text.split(',').map(|v| v.parse::<f64>().ok().filter(|v| v.is_finite()));
    Some((Vec2::new(values.next()??, values.next()??), values.next().is_some()))
}

fn shape(lane: &Element, heights: &mut bool) -> Result<Vec<Vec2>, SumoError> {
    let read = |text: &str| {
        let (point, high) = point(text).ok_or_else(|| SumoError::value(text, wanted::POINT, lane.line))?;
        *heights |= high;
        Ok(point)
    };
    lane.required("shape")?.split_whitespace().map(read).collect()
}
