//! Reader of `net.xml`, the network that `netconvert` writes.

use super::SumoError;
use super::programs::Program;
use roxmltree::{Document, Node, ParsingOptions};
use scene::Vec2;
use std::collections::HashMap;

/// Most elements that are read from one file.
const MOST_NODES: u32 = 4_000_000;

/// Who uses a lane, from its permissions and its edge's function.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum LaneKind {
    /// Motor vehicles.
    Vehicle,
    /// Bicycles alone.
    Bike,
    /// Buses alone.
    Bus,
    /// People on foot alone.
    Sidewalk,
    /// Crosswalk; the shape is its centre line.
    Crossing,
    /// Where sidewalks and crosswalks meet; the shape is an outline.
    WalkingArea,
    /// Open to nobody on the road: rails, or a strip left for parking.
    Closed,
}

/// What an edge is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum EdgeFunction {
    /// A stretch of road.
    Normal,
    /// A connection within a junction.
    Internal,
    /// A crosswalk.
    Crossing,
    /// A walking area.
    WalkingArea,
}

/// One lane.
#[derive(Clone, Debug)]
pub struct NetLane {
    /// SUMO's id.
    pub id: String,
    /// Index of its edge in [`Net::edges`].
    pub edge: usize,
    /// Position in its edge, 0 is the rightmost.
    pub index: usize,
    /// Who uses it.
    pub kind: LaneKind,
    /// Speed limit, m/s.
    pub speed_mps: f64,
    /// Metres.
    pub width_m: f64,
    /// Centre line, or outline of a walking area; metres, network frame.
    pub shape: Vec<Vec2>,
    /// Indices of the lanes that follow, in [`Net::lanes`].
    pub successors: Vec<usize>,
    /// Signal program and link index that rule it.
    pub signal: Option<(String, usize)>,
    /// Leads through a junction past a stop sign.
    pub stops: bool,
}

/// One edge: parallel lanes in one direction.
#[derive(Clone, Debug)]
pub struct NetEdge {
    /// SUMO's id.
    pub id: String,
    /// What it is for.
    pub function: EdgeFunction,
    /// Junction it leaves; empty for edges within a junction.
    pub from: String,
    /// Junction it reaches; empty for edges within a junction.
    pub to: String,
    /// Free text of whoever made the network.
    pub road_type: String,
    /// Indices in [`Net::lanes`], from the right.
    pub lanes: Vec<usize>,
}

/// One junction.
#[derive(Clone, Debug)]
pub struct NetJunction {
    /// SUMO's id.
    pub id: String,
    /// Such as `traffic_light`, `priority`, `allway_stop`, `dead_end`.
    pub kind: String,
    /// Centre, metres, network frame.
    pub position: Vec2,
}

/// A road network.
#[derive(Clone, Debug, Default)]
pub struct Net {
    /// All lanes.
    pub lanes: Vec<NetLane>,
    /// All edges.
    pub edges: Vec<NetEdge>,
    /// Junctions, without the internal ones.
    pub junctions: Vec<NetJunction>,
    /// Signal programs in the order of the file.
    pub programs: Vec<Program>,
    /// What the file says that the fields above do not hold.
    pub notes: NetNotes,
}

/// What a network has that is not read.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct NetNotes {
    /// Some shape has heights.
    pub heights: bool,
    /// Traffic keeps to the left: the lanes of an edge are counted from the left.
    pub left_hand: bool,
    /// Coordinates are projected from the globe.
    pub projected: bool,
}

impl Net {
    /// Reads a network.
    ///
    /// # Errors
    /// When the text is no XML, is no SUMO network, or a value cannot be read.
    pub fn read(text: &str) -> Result<Self, SumoError> {
        let options = ParsingOptions { allow_dtd: false, nodes_limit: MOST_NODES, ..Default::default() };
        let document = Document::parse_with_options(text, options)?;
        let root = document.root_element();
        if !root.has_tag_name("net") {
            let found = format!("<{}>", root.tag_name().name());
            return Err(SumoError::Content { expected: "a SUMO network (<net>)", found });
        }
        let mut net = Self::default();
        net.notes.left_hand = root.attribute("lefthand") == Some("true");
        for node in root.children().filter(|n| n.has_tag_name("location")) {
            net.notes.projected = !matches!(node.attribute("projParameter"), None | Some("!" | "-" | ""));
        }
        for node in root.children().filter(|n| n.has_tag_name("edge")) {
            net.add_edge(node)?;
        }
        for node in root.children().filter(|n| n.has_tag_name("tlLogic")) {
            net.programs.push(program(node)?);
        }
        for node in root.children().filter(|n| n.has_tag_name("junction")) {
            if node.attribute("type") != Some("internal") {
                let position = Vec2::new(number(node, "x")?, number(node, "y")?);
                let kind = node.attribute("type").unwrap_or_default().to_owned();
                net.junctions.push(NetJunction { id: required(node, "id")?.to_owned(), kind, position });
            }
        }
        let by_id: HashMap<String, usize> =
            net.lanes.iter().enumerate().map(|(i, l)| (l.id.clone(), i)).collect();
        for node in root.children().filter(|n| n.has_tag_name("connection")) {
            net.add_connection(node, &by_id)?;
        }
        Ok(net)
    }

    /// The edge of a lane.
    pub fn edge_of(&self, lane: usize) -> &NetEdge {
        &self.edges[self.lanes[lane].edge]
    }

    /// Lanes of an edge of one kind, from the right.
    pub fn lanes_of(&self, edge: &NetEdge, kind: LaneKind) -> impl Iterator<Item = usize> {
        edge.lanes.iter().copied().filter(move |&l| self.lanes[l].kind == kind)
    }

    fn add_edge(&mut self, node: Node<'_, '_>) -> Result<(), SumoError> {
        let function = match node.attribute("function").unwrap_or("normal") {
            "normal" | "connector" => EdgeFunction::Normal,
            "internal" => EdgeFunction::Internal,
            "crossing" => EdgeFunction::Crossing,
            "walkingarea" => EdgeFunction::WalkingArea,
            _ => return Ok(()),
        };
        let text = |name| node.attribute(name).unwrap_or_default().to_owned();
        let mut edge = NetEdge {
            id: required(node, "id")?.to_owned(),
            function,
            from: text("from"),
            to: text("to"),
            road_type: text("type"),
            lanes: Vec::new(),
        };
        for lane in node.children().filter(|n| n.has_tag_name("lane")) {
            edge.lanes.push(self.lanes.len());
            self.lanes.push(NetLane {
                id: required(lane, "id")?.to_owned(),
                edge: self.edges.len(),
                index: edge.lanes.len() - 1,
                kind: kind_of(function, lane),
                speed_mps: number(lane, "speed")?,
                width_m: if lane.has_attribute("width") { number(lane, "width")? } else { 3.2 },
                shape: shape(lane, &mut self.notes.heights)?,
                successors: Vec::new(),
                signal: None,
                stops: false,
            });
        }
        self.edges.push(edge);
        Ok(())
    }

    fn add_connection(
        &mut self,
        node: Node<'_, '_>,
        by_id: &HashMap<String, usize>,
    ) -> Result<(), SumoError> {
        let end = |edge, lane| -> Result<Option<usize>, SumoError> {
            let id = format!("{}_{}", required(node, edge)?, required(node, lane)?);
            Ok(by_id.get(&id).copied())
        };
        let (Some(from), Some(to)) = (end("from", "fromLane")?, end("to", "toLane")?) else { return Ok(()) };
        let via = node.attribute("via").and_then(|id| by_id.get(id).copied());
        self.lanes[from].successors.push(via.unwrap_or(to));
        if let Some(via) = via.filter(|_| matches!(node.attribute("state"), Some("s" | "w"))) {
            self.lanes[via].stops = true;
        }
        if let Some(program) = node.attribute("tl") {
            let link = number(node, "linkIndex")?.max(0.0) as usize;
            let ruled = match via {
                Some(via) => Some(via),
                None => (self.lanes[to].kind == LaneKind::Crossing).then_some(to),
            };
            if let Some(lane) = ruled {
                self.lanes[lane].signal = Some((program.to_owned(), link));
            }
        }
        Ok(())
    }
}

fn kind_of(function: EdgeFunction, lane: Node<'_, '_>) -> LaneKind {
    match function {
        EdgeFunction::Crossing => return LaneKind::Crossing,
        EdgeFunction::WalkingArea => return LaneKind::WalkingArea,
        _ => {}
    }
    let Some(allow) = lane.attribute("allow").filter(|a| !a.is_empty() && *a != "all") else {
        let closed = lane.attribute("disallow") == Some("all");
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

fn line_of(node: Node<'_, '_>) -> u32 {
    node.document().text_pos_at(node.range().start).row
}

fn required<'a>(node: Node<'a, '_>, attribute: &'static str) -> Result<&'a str, SumoError> {
    node.attribute(attribute).ok_or_else(|| SumoError::Missing {
        element: node.tag_name().name().to_owned(),
        attribute,
        line: line_of(node),
    })
}

fn number(node: Node<'_, '_>, attribute: &'static str) -> Result<f64, SumoError> {
    let text = required(node, attribute)?;
    let value: Option<f64> = text.parse().ok().filter(|v: &f64| v.is_finite());
    value.ok_or_else(|| SumoError::value(text, "a number", line_of(node)))
}

fn program(node: Node<'_, '_>) -> Result<Program, SumoError> {
    let mut phases = Vec::new();
    let mut jumps = false;
    for phase in node.children().filter(|n| n.has_tag_name("phase")) {
        let duration_s = number(phase, "duration")?;
        if duration_s < 0.0 {
            let found = phase.attribute("duration").unwrap_or_default();
            return Err(SumoError::value(found, "a duration in seconds", line_of(phase)));
        }
        jumps |= phase.has_attribute("next");
        phases.push((duration_s, required(phase, "state")?.as_bytes().to_vec()));
    }
    Ok(Program {
        id: required(node, "id")?.to_owned(),
        kind: node.attribute("type").unwrap_or("static").to_owned(),
        offset_s: match node.attribute("offset") {
            // The word means the time at which the simulation begins.
            None | Some("begin") => 0.0,
            Some(_) => number(node, "offset")?,
        },
        phases,
        jumps,
    })
}

fn shape(node: Node<'_, '_>, heights: &mut bool) -> Result<Vec<Vec2>, SumoError> {
    let mut point = |text: &str| {
        let mut values = text.split(',').map(|v| v.parse::<f64>().ok().filter(|v| v.is_finite()));
        let point = Vec2::new(values.next()??, values.next()??);
        *heights |= values.next().is_some();
        Some(point)
    };
    let read = |text: &str| {
        point(text).ok_or_else(|| SumoError::value(text, "a point such as 1.5,-2.0", line_of(node)))
    };
    required(node, "shape")?.split_whitespace().map(read).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const SMALL: &str = r#"<net><edge id=":c_0" function="internal">
        <lane id=":c_0_0" index="0" disallow="pedestrian" speed="6.5" length="3" shape="10,0 13,0"/></edge>
      <edge id="a" from="w" to="c" type="arterial">
        <lane id="a_0" index="0" allow="pedestrian" speed="1.4" length="10" width="2.0" shape="0,-3 10,-3"/>
        <lane id="a_1" index="1" disallow="all" speed="13.9" length="10" width="2.6" shape="0,-2 10,-2"/>
        <lane id="a_2" index="2" allow="bicycle" speed="13.9" length="10" width="1.5" shape="0,-1 10,-1"/>
        <lane id="a_3" index="3" disallow="pedestrian" speed="13.9" length="10" shape="0,0 10,0"/></edge>
      <edge id="b" from="c" to="e"><lane id="b_0" index="0" speed="13.9" length="10" shape="13,0 20,0"/></edge>
      <junction id="c" type="traffic_light" x="11.5" y="0"/>
      <connection from="a" to="b" fromLane="3" toLane="0" via=":c_0_0" tl="c" linkIndex="2" dir="s" state="o"/>
      <connection from=":c_0" to="b" fromLane="0" toLane="0" dir="s" state="M"/></net>"#;

    #[test]
    fn reads_kinds_links_and_signals() {
        let net = Net::read(SMALL).unwrap();
        let kinds: Vec<_> = net.lanes.iter().map(|l| l.kind).collect();
        use LaneKind::*;
        assert_eq!(kinds, [Vehicle, Sidewalk, Closed, Bike, Vehicle, Vehicle]);
        assert_eq!(net.lanes[4].successors, [0]);
        assert_eq!(net.lanes[0].successors, [5]);
        assert_eq!(net.lanes[0].signal, Some(("c".to_owned(), 2)));
        assert_eq!(net.junctions[0].position, Vec2::new(11.5, 0.0));
    }

    #[test]
    fn refuses_what_is_no_network() {
        assert!(matches!(Net::read("<routes/>"), Err(SumoError::Content { .. })));
        assert!(matches!(Net::read("<!DOCTYPE net><net/>"), Err(SumoError::Xml(_))));
        let error = Net::read(&SMALL.replace("0,0 10,0", "0,zero")).unwrap_err();
        assert_eq!(error.to_string(), "line 7: \"0,zero\" found where a point such as 1.5,-2.0 was expected");
        assert!(matches!(Net::read("<net><edge/></net>"), Err(SumoError::Missing { attribute: "id", .. })));
    }
}
