//! Traffic demand of all types: routes for `sumo`, only to reachable goals.

use super::fleet::Fleet;
use super::network::{Network, Rank};
use super::{RECORDED_S, WARM_UP_S};
use formats::polyline::length;
use formats::sumo::net::{EdgeFunction, LaneKind, Net, NetEdge};
use scene::random::Stream;
use std::collections::{BTreeSet, HashMap};
use std::fmt::Write as _;
use std::path::Path;

/// Factors and amounts of the traffic of a seed.
#[derive(Clone, Copy, Debug)]
pub struct DemandFactors {
    /// Factor on the rate of motor vehicles.
    pub traffic: f64,
    /// Cyclists on the road, expected number.
    pub cyclists: f64,
    /// Groups of pedestrians, expected number per 1.5 km of sidewalk.
    pub people: f64,
    /// Share of buses among motor vehicles.
    pub buses: f64,
}

impl DemandFactors {
    /// Draws the factors.
    pub fn new(draw: &mut Stream) -> Self {
        Self {
            traffic: draw.between(0.5, 2.0),
            cyclists: draw.one_of([3.0, 8.0, 18.0]),
            people: draw.one_of([5.0, 18.0, 65.0]),
            buses: 0.02,
        }
    }
}

/// Vehicles per hour and lane that enter on an edge of this type.
fn rate(road_type: &str) -> f64 {
    match road_type {
        "residential" => 45.0,
        "collector" => 190.0,
        "arterial" => 330.0,
        "motorway" => 600.0,
        "lot" => 50.0,
        "roundabout" => 0.0,
        _ => 100.0,
    }
}

struct Trips<'a> {
    net: &'a Net,
    fringe: BTreeSet<&'a str>,
    /// Departure time and XML element.
    items: Vec<(f64, String)>,
}

/// Writes `r.rou.xml` and `a.add.xml` into a folder.
///
/// # Errors
/// When a file cannot be written.
pub fn write(
    network: &Network,
    net: &Net,
    fleet: &Fleet,
    crowd: DemandFactors,
    draw: &mut Stream,
    folder: &Path,
) -> std::io::Result<()> {
    let fringe = network.fringe.iter().map(String::as_str).collect();
    let mut trips = Trips { net, fringe, items: Vec::new() };
    trips.vehicles(fleet, crowd, draw);
    if network.character.name != Rank::Motorway.name() {
        trips.cyclists(fleet, crowd, draw);
        trips.people(fleet, crowd, draw);
    }
    trips.items.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut routes = format!("<routes>\n{}", fleet.xml);
    for (_, item) in &trips.items {
        routes.push_str(item);
        routes.push('\n');
    }
    std::fs::write(folder.join("r.rou.xml"), routes + "</routes>\n")?;
    let programs: BTreeSet<&str> =
        net.lanes.iter().filter_map(|l| l.signal.as_ref()).map(|(p, _)| p.as_str()).collect();
    let mut text = String::from("<additional>\n");
    for program in programs {
        let _ = writeln!(text, r#"<timedEvent type="SaveTLSStates" source="{program}" dest="tls.xml"/>"#);
    }
    std::fs::write(folder.join("a.add.xml"), text + "</additional>\n")
}

impl Trips<'_> {
    fn lanes(&self, edge: &NetEdge, kind: LaneKind) -> usize {
        self.net.lanes_of(edge, kind).count()
    }

    fn normal(&self) -> impl Iterator<Item = usize> {
        (0..self.net.edges.len()).filter(|&e| self.net.edges[e].function == EdgeFunction::Normal)
    }

    /// Edges that follow an edge on lanes of these kinds.
    fn next_edges(&self, edge: usize, kinds: &[LaneKind]) -> BTreeSet<usize> {
        let (lanes, edges) = (&self.net.lanes, &self.net.edges);
        let mut found = BTreeSet::new();
        let mut open: Vec<usize> =
            edges[edge].lanes.iter().copied().filter(|&l| kinds.contains(&lanes[l].kind)).collect();
        let mut seen = BTreeSet::new();
        while let Some(lane) = open.pop() {
            for &next in &lanes[lane].successors {
                match edges[lanes[next].edge].function {
                    EdgeFunction::Internal if seen.insert(next) => open.push(next),
                    EdgeFunction::Normal if kinds.contains(&lanes[next].kind) => {
                        found.insert(lanes[next].edge);
                    }
                    _ => {}
                }
            }
        }
        found
    }

    /// The edges that can be reached from each edge.
    fn reachable(&self, kinds: &[LaneKind]) -> HashMap<usize, BTreeSet<usize>> {
        let next: HashMap<usize, BTreeSet<usize>> =
            self.normal().map(|e| (e, self.next_edges(e, kinds))).collect();
        let spread = |start: usize| {
            let mut seen = BTreeSet::from([start]);
            let mut open = vec![start];
            while let Some(edge) = open.pop() {
                open.extend(next[&edge].iter().copied().filter(|e| seen.insert(*e)));
            }
            seen
        };
        self.normal().map(|e| (e, spread(e))).collect()
    }

    fn vehicles(&mut self, fleet: &Fleet, crowd: DemandFactors, draw: &mut Stream) {
        let net = self.net;
        let reachable = self.reachable(&[LaneKind::Vehicle]);
        let carries = |e: &usize| self.lanes(&net.edges[*e], LaneKind::Vehicle) > 0;
        let sources: Vec<usize> = self
            .normal()
            .filter(|e| carries(e) && self.fringe.contains(net.edges[*e].from.as_str()))
            .collect();
        let sinks: Vec<usize> =
            self.normal().filter(|e| carries(e) && self.fringe.contains(net.edges[*e].to.as_str())).collect();
        let position =
            |id: &str| net.junctions.iter().find(|j| j.id == id).map(|j| j.position).unwrap_or_default();
        let mut count = 0;
        for source in sources {
            let edge = &net.edges[source];
            let goals: Vec<usize> = sinks
                .iter()
                .copied()
                .filter(|s| reachable[&source].contains(s) && net.edges[*s].to != edge.from)
                .collect();
            if goals.is_empty() {
                continue;
            }
            // Recorded windows have more turns than weights by capacity alone would give, so the weights
            // favour turns.
            let weight = |goal: &usize| {
                let (p, q) = (position(&edge.from), position(&net.edges[*goal].to));
                let straight = -p.dot(&q) / (p.norm() * q.norm() + 1e-6);
                let lanes = self.lanes(&net.edges[*goal], LaneKind::Vehicle) as f64;
                (rate(&net.edges[*goal].road_type) * lanes).sqrt() * (-0.4 * straight).exp()
            };
            let weights: Vec<f64> = goals.iter().map(weight).collect();
            let lanes = self.lanes(edge, LaneKind::Vehicle) as f64;
            // A ramp carries less traffic than a lane of its motorway.
            let ramp = if edge.road_type == Rank::Motorway.name() && lanes < 2.0 { 0.5 } else { 1.0 };
            let hourly = ramp * rate(&edge.road_type) * lanes * crowd.traffic * (0.35 * draw.normal()).exp();
            let mean_wait = 3600.0 / hourly.max(1e-3);
            let mut time = draw.exponential(mean_wait);
            while time < WARM_UP_S + RECORDED_S {
                let trucks = if edge.road_type == Rank::Motorway.name() { 0.10 } else { 0.035 };
                let cars = 1.0 - trucks - crowd.buses - 0.02;
                let groups = [("truck", trucks), ("bus", crowd.buses), ("moto", 0.02), ("car", cars)];
                let group = draw.weighted(groups);
                let Some(goal) = draw.among(weights.iter().copied()) else { break };
                let goal = &net.edges[goals[goal]];
                // Long vehicles cannot turn in the aisles of a car park.
                let narrow = edge.road_type == "lot" || goal.road_type == "lot";
                let kind = fleet.pick(draw, if narrow { "car" } else { group });
                let stop = self.stop(if kind.starts_with("bus") { 0.7 } else { 0.025 }, [edge, goal], draw);
                let goal = &goal.id;
                self.items.push((time, format!(
                    r#"<trip id="v{count}" type="{kind}" depart="{time:.1}" from="{}" to="{goal}" departLane="best" departSpeed="max" departPosLat="random_free">{stop}</trip>"#,
                    edge.id
                )));
                count += 1;
                time += draw.exponential(mean_wait);
            }
        }
    }

    /// With this probability, a stop in the rightmost lane: a bus at its stop, or a double-parked vehicle.
    fn stop(&self, chance: f64, edges: [&NetEdge; 2], draw: &mut Stream) -> String {
        let edge = edges[draw.below(2)];
        let lane = self.net.lanes_of(edge, LaneKind::Vehicle).next().map(|l| &self.net.lanes[l]);
        let Some(lane) = lane.filter(|l| length(&l.shape) > 60.0) else { return String::new() };
        if !draw.chance(chance) || matches!(edge.road_type.as_str(), "motorway" | "lot" | "roundabout") {
            return String::new();
        }
        let end = draw.between(35.0, length(&lane.shape) - 20.0);
        let seconds = draw.between(5.0, 25.0);
        format!(
            r#"<stop lane="{}" startPos="{:.1}" endPos="{end:.1}" duration="{seconds:.0}"/>"#,
            lane.id,
            end - 18.0
        )
    }

    fn cyclists(&mut self, fleet: &Fleet, crowd: DemandFactors, draw: &mut Stream) {
        let net = self.net;
        let reachable = self.reachable(&[LaneKind::Vehicle, LaneKind::Bike]);
        let usable = |e: &usize| {
            let edge = &net.edges[*e];
            let rides = self.lanes(edge, LaneKind::Vehicle) + self.lanes(edge, LaneKind::Bike) > 0;
            rides && !matches!(edge.road_type.as_str(), "lot" | "roundabout" | "motorway")
        };
        let edges: Vec<usize> = self.normal().filter(usable).collect();
        let outer: Vec<usize> =
            edges.iter().copied().filter(|e| self.fringe.contains(net.edges[*e].from.as_str())).collect();
        if edges.is_empty() || outer.is_empty() {
            return;
        }
        for k in 0..draw.poisson(crowd.cyclists) {
            let time = draw.between(20.0, WARM_UP_S + RECORDED_S - 10.0);
            let from_outside = draw.chance(0.5);
            let source =
                if from_outside { outer[draw.below(outer.len())] } else { edges[draw.below(edges.len())] };
            let edge = &net.edges[source];
            let goals: Vec<usize> = edges
                .iter()
                .copied()
                .filter(|g| reachable[&source].contains(g) && net.edges[*g].to != edge.from)
                .filter(|g| *g != source || from_outside)
                .filter(|g| self.fringe.contains(net.edges[*g].to.as_str()))
                .collect();
            let Some(&goal) = goals.get(draw.below(goals.len())) else { continue };
            let kind = fleet.pick(draw, "cycle");
            let place = if self.fringe.contains(edge.from.as_str()) { "base" } else { "random_free" };
            self.items.push((time, format!(
                r#"<trip id="b{k}" type="{kind}" depart="{time:.1}" from="{}" to="{}" departLane="best" departSpeed="max" departPos="{place}" departPosLat="right"/>"#,
                edge.id, net.edges[goal].id
            )));
        }
    }

    fn people(&mut self, fleet: &Fleet, crowd: DemandFactors, draw: &mut Stream) {
        let net = self.net;
        let walks = |l: usize| {
            matches!(net.lanes[l].kind, LaneKind::Sidewalk | LaneKind::Crossing | LaneKind::WalkingArea)
        };
        let mut parts = ConnectedEdges((0..net.edges.len()).collect());
        for (i, lane) in net.lanes.iter().enumerate().filter(|(i, _)| walks(*i)) {
            for &next in lane.successors.iter().filter(|n| walks(**n)) {
                parts.join(net.lanes[i].edge, net.lanes[next].edge);
            }
        }
        let sidewalks: Vec<(usize, f64)> = self
            .normal()
            .filter_map(|e| Some((e, net.lanes_of(&net.edges[e], LaneKind::Sidewalk).next()?)))
            .map(|(e, l)| (e, length(&net.lanes[l].shape)))
            .collect();
        let weights: Vec<f64> = sidewalks.iter().map(|s| s.1).collect();
        let groups = crowd.people * (weights.iter().sum::<f64>() / 1500.0).min(2.5);
        for k in 0..draw.poisson(groups) {
            let Some(from) = draw.among(weights.iter().copied()) else { break };
            let (from, from_length) = sidewalks[from];
            let goals: Vec<usize> = sidewalks
                .iter()
                .map(|s| s.0)
                .filter(|s| *s != from && parts.root(*s) == parts.root(from))
                .collect();
            let Some(&to) = goals.get(draw.below(goals.len())) else { continue };
            let time = draw.between(0.0, WARM_UP_S + RECORDED_S - 10.0);
            // Riders on the sidewalk and on crosswalks: for SUMO, fast persons.
            let group = draw.weighted([("sidewalk_cycle", 0.18), ("jogger", 0.03), ("walker", 0.79)]);
            let people = if group == "walker" { draw.weighted([(1, 0.72), (2, 0.22), (3, 0.06)]) } else { 1 };
            let kind = fleet.pick(draw, group);
            let start = draw.between(2.0, (from_length - 3.0).max(3.0));
            for m in 0..people {
                let (depart, place) = (time + 0.5 * m as f64, start + 0.4 * m as f64);
                self.items.push((depart, format!(
                    r#"<person id="p{k}_{m}" type="{kind}" depart="{depart:.1}" departPos="{place:.1}"><walk from="{}" to="{}" arrivalPos="random"/></person>"#,
                    net.edges[from].id, net.edges[to].id
                )));
            }
        }
    }
}

/// Edges that are connected for pedestrians.
struct ConnectedEdges(Vec<usize>);

impl ConnectedEdges {
    fn root(&mut self, mut i: usize) -> usize {
        while self.0[i] != i {
            self.0[i] = self.0[self.0[i]];
            i = self.0[i];
        }
        i
    }

    fn join(&mut self, a: usize, b: usize) {
        let (a, b) = (self.root(a), self.root(b));
        self.0[a] = b;
    }
}
