//! A road network under construction. A graph of roads with cross-sections becomes directed edges with
//! explicit lanes, written as plain XML for `netconvert`.

use formats::polyline::{arc_lengths, length, offset_right, part, point_at, resample};
use formats::sumo::kerb::s_curve;
use scene::Vec2;
use scene::random::Stream;
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::Path;

/// One mile per hour in m/s.
pub const MPH: f64 = 0.44704;

/// Rank of a road; determines demand, parking and paint.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rank {
    /// Residential street with a low speed limit.
    Residential,
    /// Street between residential streets and arterials.
    Collector,
    /// Road with several lanes and signals.
    Arterial,
    /// Motorway without crossings.
    Motorway,
    /// Aisle of a car park.
    Lot,
    /// Ring of a roundabout.
    Roundabout,
}

impl Rank {
    /// Name in the network's files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Residential => "residential",
            Self::Collector => "collector",
            Self::Arterial => "arterial",
            Self::Motorway => "motorway",
            Self::Lot => "lot",
            Self::Roundabout => "roundabout",
        }
    }
}

/// Lanes of a road; both directions have the same widths. Widths are in metres, and zero if the element is
/// missing.
#[derive(Clone, Copy, Debug)]
pub struct CrossSection {
    /// Number of forward lanes.
    pub forward: usize,
    /// Number of backward lanes.
    pub backward: usize,
    /// Speed limit, m/s.
    pub speed: f64,
    /// Width of a traffic lane.
    pub lane: f64,
    /// Priority; the greater one has right of way.
    pub priority: i32,
    /// Width of the sidewalk.
    pub sidewalk: f64,
    /// Width of the cycle lane.
    pub bike: f64,
    /// Width of the parking strip.
    pub parking: f64,
    /// Width between the two directions.
    pub median: f64,
    /// Rank of the road.
    pub rank: Rank,
}

impl CrossSection {
    /// Lanes of one direction, from the right.
    fn strips(&self, lanes: usize) -> Vec<LaneStrip> {
        let beside = [
            LaneStrip::Sidewalk(self.sidewalk),
            LaneStrip::Parking(self.parking),
            LaneStrip::Bike(self.bike),
        ];
        let there = [self.sidewalk, self.parking, self.bike].map(|width| width > 0.0);
        let mut strips: Vec<LaneStrip> =
            beside.into_iter().zip(there).filter(|(_, there)| *there).map(|(strip, _)| strip).collect();
        strips.extend(vec![LaneStrip::Traffic(self.lane); lanes]);
        strips
    }
}

/// A junction or an end of the network.
#[derive(Clone, Debug)]
struct NodeSpec {
    position: Vec2,
    control: &'static str,
    radius: Option<f64>,
}

/// A road between two nodes.
#[derive(Clone, Debug)]
struct Road {
    from: String,
    to: String,
    middle: Vec<Vec2>,
    section: CrossSection,
    /// Left-turn lane at the start (for traffic that arrives there) and at the end.
    turn_lanes: (bool, bool),
}

/// One lane of a directed edge.
#[derive(Clone, Copy, Debug, PartialEq)]
enum LaneStrip {
    Sidewalk(f64),
    Parking(f64),
    Bike(f64),
    Traffic(f64),
}

/// A directed edge. `shape` is its left border.
#[derive(Clone, Debug)]
struct EdgeSpec {
    from: String,
    to: String,
    shape: Vec<Vec2>,
    strips: Vec<LaneStrip>,
    speed: f64,
    priority: i32,
    rank: Rank,
    merging: bool,
}

/// Properties of a generated network, for `netconvert` and for the choice of windows.
#[derive(Clone, Debug)]
pub struct Character {
    /// Name such as `cross4_arterial`.
    pub name: String,
    /// Whether signals are actuated by waiting traffic; otherwise phases have a fixed length.
    pub actuated: bool,
    /// Whether opposite arms share a phase; otherwise each arm has its own.
    pub opposites: bool,
    /// Signal cycle, seconds.
    pub cycle_s: u32,
    /// Width of crosswalks, metres.
    pub crosswalk: f64,
    /// Greatest distance from the origin of a road user at the centre of a window, metres.
    pub reach: f64,
}

/// A network under construction.
#[derive(Clone, Debug)]
pub struct Network {
    nodes: BTreeMap<String, NodeSpec>,
    roads: Vec<Road>,
    edges: Vec<(String, EdgeSpec)>,
    connections: Vec<(String, usize, String, usize)>,
    roundabouts: Vec<(Vec<String>, Vec<String>)>,
    /// Nodes where traffic enters and leaves.
    pub fringe: Vec<String>,
    /// Rows of bays: line through their centres, and heading of a car that is parked nose in.
    pub stalls: Vec<(Vec<Vec2>, f64)>,
    /// Paved areas beside the roads.
    pub paved: Vec<Vec<Vec2>>,
    /// Properties of the network.
    pub character: Character,
}

/// Hermite curve with tangents of the length of its chord.
pub fn hermite(p: Vec2, way_p: Vec2, q: Vec2, way_q: Vec2) -> Vec<Vec2> {
    let gap = (q - p).norm();
    s_curve(p, way_p * gap, q, way_q * gap, ((gap / 3.0) as usize).max(2))
}

/// The unit vector of `v`.
pub fn unit(v: Vec2) -> Vec2 {
    v / v.norm().max(1e-9)
}

/// `v` rotated by 90° to the left.
pub fn left_of(v: Vec2) -> Vec2 {
    Vec2::new(-v.y, v.x)
}

impl Network {
    /// An empty network.
    pub fn new(character: Character) -> Self {
        Self {
            nodes: BTreeMap::new(),
            roads: Vec::new(),
            edges: Vec::new(),
            connections: Vec::new(),
            roundabouts: Vec::new(),
            fringe: Vec::new(),
            stalls: Vec::new(),
            paved: Vec::new(),
            character,
        }
    }

    /// Adds a node; `control` is SUMO's junction type.
    pub fn node(&mut self, id: &str, position: Vec2, control: &'static str, radius: Option<f64>) {
        self.nodes.insert(id.to_owned(), NodeSpec { position, control, radius });
    }

    /// Adds a node where traffic enters and leaves.
    pub fn end(&mut self, id: &str, position: Vec2) {
        self.node(id, position, "priority", None);
        self.fringe.push(id.to_owned());
    }

    /// Position of a node; the origin if there is none.
    pub fn position(&self, id: &str) -> Vec2 {
        self.nodes.get(id).map_or_else(Vec2::zeros, |n| n.position)
    }

    /// Adds a road along `middle`, with a left-turn lane at its start or end if the median has room.
    pub fn road(
        &mut self,
        from: &str,
        to: &str,
        middle: Vec<Vec2>,
        section: CrossSection,
        turn_lanes: (bool, bool),
    ) {
        self.roads.push(Road { from: from.to_owned(), to: to.to_owned(), middle, section, turn_lanes });
    }

    /// Adds a straight road.
    pub fn straight(&mut self, from: &str, to: &str, section: CrossSection) {
        let middle = vec![self.position(from), self.position(to)];
        self.road(from, to, middle, section, (false, false));
    }

    /// Adds a directed edge without neighbours; `shape` is its left border.
    pub fn edge(
        &mut self,
        id: &str,
        [from, to]: [&str; 2],
        shape: Vec<Vec2>,
        lanes: usize,
        section: CrossSection,
        merging: bool,
    ) {
        self.edges.push((
            id.to_owned(),
            EdgeSpec {
                from: from.to_owned(),
                to: to.to_owned(),
                shape,
                strips: section.strips(lanes),
                speed: section.speed,
                priority: section.priority,
                rank: section.rank,
                merging,
            },
        ));
    }

    /// Connects two lanes of directed edges.
    pub fn connect(&mut self, from: &str, from_lane: usize, to: &str, to_lane: usize) {
        self.connections.push((from.to_owned(), from_lane, to.to_owned(), to_lane));
    }

    /// Declares a roundabout.
    pub fn roundabout(&mut self, nodes: Vec<String>, edges: Vec<String>) {
        self.roundabouts.push((nodes, edges));
    }

    /// Turns roads into directed edges. A left-turn lane is taken out of the median: the edge is split
    /// before the junction, with a gap in the shapes that becomes a long, gentle shift of the lanes
    /// (a shift within a short node would be a lateral snap).
    pub fn expand(&mut self, draw: &mut Stream) {
        for (k, road) in std::mem::take(&mut self.roads).into_iter().enumerate() {
            let middle = resample(&road.middle, 3.0);
            let total = length(&middle);
            let s = road.section;
            for back in [false, true] {
                let lanes = if back { s.backward } else { s.forward };
                if lanes == 0 {
                    continue;
                }
                let mut line = middle.clone();
                let (mut from, mut to, mut turn) = (road.from.clone(), road.to.clone(), road.turn_lanes.1);
                if back {
                    line.reverse();
                    (from, to, turn) = (to, from, road.turn_lanes.0);
                }
                let strips = s.strips(lanes);
                let beside = strips.len() - lanes;
                let make = |from: String, to: String, shape: Vec<Vec2>, strips: Vec<LaneStrip>| EdgeSpec {
                    from,
                    to,
                    shape,
                    strips,
                    speed: s.speed,
                    priority: s.priority,
                    rank: s.rank,
                    merging: false,
                };
                let name = format!("e{k}{}", if back { "b" } else { "f" });
                let pocket = draw.between(35.0, 65.0);
                if !(turn && total > pocket + 50.0 && s.median >= 2.8) {
                    self.edges.push((name, make(from, to, offset_right(&line, s.median / 2.0), strips)));
                    continue;
                }
                let split = total - pocket;
                let node = format!("m{k}{}", if back { "b" } else { "f" });
                self.node(&node, point_at(&line, &arc_lengths(&line), split), "priority", None);
                let (one, two) = (format!("{name}1"), format!("{name}2"));
                let first = offset_right(&part(&line, 0.0, split - 9.0), s.median / 2.0);
                let second = offset_right(&part(&line, split + 9.0, total), s.median / 2.0 - s.lane);
                for (i, strip) in strips.iter().enumerate() {
                    if !matches!(strip, LaneStrip::Parking(_)) {
                        self.connect(&one, i, &two, i);
                    }
                }
                self.connect(&one, beside + lanes - 1, &two, beside + lanes);
                let mut wider = strips.clone();
                wider.push(LaneStrip::Traffic(s.lane));
                self.edges.push((one, make(from, node.clone(), first, strips)));
                self.edges.push((two, make(node, to, second, wider)));
            }
        }
    }

    /// Writes `n.nod.xml`, `n.edg.xml` and `n.con.xml` into a folder.
    ///
    /// # Errors
    /// When a file cannot be written.
    pub fn write(&self, folder: &Path) -> std::io::Result<()> {
        let mut text = String::from("<nodes>\n");
        for (id, node) in &self.nodes {
            let radius = node.radius.map(|r| format!(" radius=\"{r:.1}\"")).unwrap_or_default();
            let (p, control) = (node.position, node.control);
            let _ =
                writeln!(text, r#"<node id="{id}" x="{:.2}" y="{:.2}" type="{control}"{radius}/>"#, p.x, p.y);
        }
        std::fs::write(folder.join("n.nod.xml"), text + "</nodes>\n")?;
        let mut text = String::from("<edges>\n");
        for (id, edge) in &self.edges {
            edge.write(id, &mut text);
        }
        for (nodes, edges) in &self.roundabouts {
            let _ =
                writeln!(text, r#"<roundabout nodes="{}" edges="{}"/>"#, nodes.join(" "), edges.join(" "));
        }
        std::fs::write(folder.join("n.edg.xml"), text + "</edges>\n")?;
        let mut text = String::from("<connections>\n");
        for (from, i, to, j) in &self.connections {
            let _ = writeln!(text, r#"<connection from="{from}" to="{to}" fromLane="{i}" toLane="{j}"/>"#);
        }
        std::fs::write(folder.join("n.con.xml"), text + "</connections>\n")
    }
}

impl EdgeSpec {
    fn write(&self, id: &str, text: &mut String) {
        let shape: Vec<String> = self.shape.iter().map(|p| format!("{:.2},{:.2}", p.x, p.y)).collect();
        let _ = writeln!(
            text,
            r#"<edge id="{id}" from="{}" to="{}" priority="{}" numLanes="{}" speed="{:.2}" spreadType="right" shape="{}" type="{}">"#,
            self.from,
            self.to,
            self.priority,
            self.strips.len(),
            self.speed,
            shape.join(" "),
            self.rank.name()
        );
        let traffic = |s: &LaneStrip| matches!(s, LaneStrip::Traffic(_));
        let first = self.strips.iter().position(traffic).unwrap_or(0);
        for (i, strip) in self.strips.iter().enumerate() {
            let rail = "tram rail rail_urban rail_fast rail_electric ship";
            let (width, rule) = match strip {
                LaneStrip::Sidewalk(w) => (w, "allow=\"pedestrian\"".to_owned()),
                LaneStrip::Parking(w) => (w, "disallow=\"all\"".to_owned()),
                LaneStrip::Bike(w) => (w, "allow=\"bicycle\"".to_owned()),
                LaneStrip::Traffic(w) if self.rank == Rank::Motorway => {
                    (w, format!("disallow=\"pedestrian bicycle {rail}\""))
                }
                LaneStrip::Traffic(w) => (w, format!("disallow=\"pedestrian {rail}\"")),
            };
            let merging = if self.merging && i == first { " acceleration=\"1\"" } else { "" };
            let _ = writeln!(text, r#"  <lane index="{i}" {rule} width="{width:.2}"{merging}/>"#);
        }
        text.push_str("</edge>\n");
    }
}
