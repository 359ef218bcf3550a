//! The road network that `netconvert` writes (`net.xml`).

mod read;

use super::programs::SignalProgram;
use scene::Vec2;

/// Users of a lane, from its permissions and its edge's function.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum LaneKind {
    /// Motor vehicles.
    Vehicle,
    /// Only bicycles.
    Bike,
    /// Only buses.
    Bus,
    /// Only pedestrians.
    Sidewalk,
    /// Crosswalk; the shape is its centre line.
    Crossing,
    /// Area that joins sidewalks and crosswalks; the shape is an outline.
    WalkingArea,
    /// Closed to road users: rails, or a strip left for parking.
    Closed,
}

/// Function of an edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum EdgeFunction {
    /// A road section between junctions.
    Normal,
    /// A connection within a junction.
    Internal,
    /// A crosswalk.
    Crossing,
    /// A walking area.
    WalkingArea,
}

/// Narrower lanes carry no road users, metres.
pub const NARROWEST_LANE_M: f64 = 0.1;

/// One lane.
#[derive(Clone, Debug)]
pub struct NetLane {
    /// SUMO's id.
    pub id: String,
    /// Index of its edge in [`Net::edges`].
    pub edge: usize,
    /// Position in its edge, 0 is the rightmost.
    pub index: usize,
    /// Its users.
    pub kind: LaneKind,
    /// Speed limit, m/s.
    pub speed_mps: f64,
    /// Width, metres.
    pub width_m: f64,
    /// Centre line, or outline of a walking area; metres, network frame.
    pub shape: Vec<Vec2>,
    /// Indices of the lanes that follow, in [`Net::lanes`].
    pub successors: Vec<usize>,
    /// Signal program and link index that control it.
    pub signal: Option<(String, usize)>,
    /// Whether it leads through a junction past a stop sign.
    pub stops: bool,
}

/// One edge: parallel lanes in one direction.
#[derive(Clone, Debug)]
pub struct NetEdge {
    /// SUMO's id.
    pub id: String,
    /// Its function.
    pub function: EdgeFunction,
    /// Junction it leaves; empty for edges within a junction.
    pub from: String,
    /// Junction it reaches; empty for edges within a junction.
    pub to: String,
    /// Free text from the network's author.
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
    pub programs: Vec<SignalProgram>,
    /// Content of the file that the fields above do not hold.
    pub notes: NetNotes,
}

/// Content of a network beside its roads.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct NetNotes {
    /// Whether some shape has heights.
    pub heights: bool,
    /// Whether traffic keeps to the left, so that the lanes of an edge are counted from the left.
    pub left_hand: bool,
    /// Projection of the coordinates, in the form of PROJ.
    pub projection: Option<String>,
    /// Offset that was added to the projected coordinates, metres.
    pub offset: Vec2,
}

impl Net {
    /// The edge of a lane.
    pub fn edge_of(&self, lane: usize) -> &NetEdge {
        &self.edges[self.lanes[lane].edge]
    }

    /// Lanes of an edge of one kind, from the right.
    pub fn lanes_of(&self, edge: &NetEdge, kind: LaneKind) -> impl Iterator<Item = usize> {
        edge.lanes.iter().copied().filter(move |&l| self.lanes[l].kind == kind)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sumo::SumoError;
    use crate::xml::Missing;

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
    fn the_order_of_the_elements_does_not_matter() {
        let (edges, links) = SMALL.split_at(SMALL.find("<connection").unwrap());
        let links = links.trim_end_matches("</net>");
        let turned = format!("<net>{links}{}</net>", edges.trim_start_matches("<net>"));
        let (first, second) = (Net::read(SMALL).unwrap(), Net::read(&turned).unwrap());
        assert_eq!(format!("{first:?}"), format!("{second:?}"));
    }

    #[test]
    fn refuses_what_is_no_network() {
        assert!(matches!(Net::read("<routes/>"), Err(SumoError::Content(_))));
        assert!(matches!(Net::read("<!DOCTYPE net><net/>"), Err(SumoError::File(_))));
        let error = Net::read(&SMALL.replace("0,0 10,0", "0,zero")).unwrap_err();
        assert_eq!(error.to_string(), "line 7: \"0,zero\" found, a point such as 1.5,-2.0 expected");
        assert!(matches!(
            Net::read("<net><edge/></net>"),
            Err(SumoError::Missing(Missing { attribute: "id", .. }))
        ));
    }
}
