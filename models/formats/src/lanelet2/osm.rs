//! A file of lanelets: points, lines of points, and relations between them.

use crate::around::Chosen;
use crate::osm_items::{Member, OsmElement, each};
use crate::problem::{FieldProblem, ReadError, at_most};
use crate::projection::TransverseMercator;
use crate::refusals::what;
use crate::source::Source;
use scene::Vec2;
use std::collections::{HashMap, HashSet};

/// Most points, lines, relations, and references to any of them.
const MAX_NODES: usize = 800_000;
const MAX_WAYS: usize = 100_000;
const MAX_RELATIONS: usize = 40_000;
const MAX_REFERENCES: usize = 2_000_000;
/// Keys of the tags that are read.
const KEYS: [&str; 11] = [
    "local_x",
    "local_y",
    "ele",
    "type",
    "subtype",
    "color",
    "one_way",
    "speed_limit",
    "turn_direction",
    "speed_limit:vehicle",
    "sign_type",
];
/// Prefix of the tags that state who may pass.
const PARTICIPANT: &str = "participant";
/// Most of these tags of one relation.
const MAX_PARTICIPANTS: usize = 16;
/// Most characters of a value.
const VALUE_CHARS: usize = 60;
/// Distance outside the circle of a part up to which points are read, metres.
const BESIDE_M: f64 = 60.0;
/// Greatest distance of a local coordinate from its origin, metres.
const MAX_SOURCE_M: f64 = 1e8;

/// Tags by key.
pub(super) type Tags = HashMap<&'static str, String>;

/// A line of points.
#[derive(Debug, Default)]
pub(super) struct OsmWay {
    pub nodes: Vec<i64>,
    pub tags: Tags,
}

/// A relation: a lanelet, a rule.
#[derive(Debug, Default)]
pub(super) struct OsmRelation {
    pub id: i64,
    pub members: Vec<Member>,
    pub tags: Tags,
    /// Road users that may or may not pass: the text after `participant:`.
    pub participants: Vec<(String, bool)>,
}

impl OsmRelation {
    /// All members in a role.
    pub fn all<'a>(&'a self, role: &'a str) -> impl Iterator<Item = i64> + 'a {
        self.members.iter().filter(move |member| member.role == role).map(|member| member.id)
    }

    /// The first member in a role.
    pub fn member(&self, role: &str) -> Option<i64> {
        self.members.iter().find(|member| member.role == role).map(|member| member.id)
    }
}

/// A file.
#[derive(Debug, Default)]
pub(super) struct Osm {
    /// Positions in metres, in the frame of the file or of [`Osm::projection`].
    pub nodes: HashMap<i64, Vec2>,
    pub ways: HashMap<i64, OsmWay>,
    /// In the order of the file.
    pub relations: Vec<OsmRelation>,
    /// Set if the file has only degrees.
    pub projection: Option<TransverseMercator>,
}

/// Reads a file, plain or compressed with gzip.
///
/// # Errors
/// `malformed-file` for broken XML or gzip, the limits of a file, `cannot-represent` for another kind of
/// file, `invalid-field` for a value that is not a number, `map-too-large`.
pub(super) fn read(file: &dyn Source, chosen: &mut Chosen) -> Result<Osm, ReadError> {
    let near = Near::of(file, chosen)?;
    let mut osm = Osm::default();
    let mut local: HashMap<i64, Vec2> = HashMap::new();
    let mut degrees: HashMap<i64, (f64, f64)> = HashMap::new();
    let mut references = 0;
    each(file, |item| {
        if near.as_ref().is_some_and(|near| !near.takes(&item)) {
            return Ok(());
        }
        let tags = known(&item.tags);
        references += item.nodes.len() + item.members.len();
        match item.kind {
            "node" => {
                if let Some(p) = local_of(&tags)? {
                    local.insert(item.id, p);
                } else if let Some(p) = item.degrees {
                    degrees.insert(item.id, p);
                }
            }
            "way" => drop(osm.ways.insert(item.id, OsmWay { nodes: item.nodes, tags })),
            _ => {
                let participants = participants(&item.tags);
                osm.relations.push(OsmRelation { id: item.id, members: item.members, tags, participants });
            }
        }
        at_most(local.len() + degrees.len(), MAX_NODES, what::POINTS)?;
        at_most(osm.ways.len(), MAX_WAYS, what::LINES)?;
        at_most(osm.relations.len(), MAX_RELATIONS, what::RELATIONS)?;
        at_most(references, MAX_REFERENCES, what::REFERENCES)
    })?;
    osm.nodes = local;
    // Degrees are used only if no point has metres: two frames do not mix.
    let places = || degrees.values().copied();
    let projection = TransverseMercator::of_no_land(places()).or_else(|| TransverseMercator::about(places()));
    let projection = projection.filter(|_| osm.nodes.is_empty() && !degrees.is_empty());
    if let Some(projection) = projection {
        osm.nodes = degrees.iter().map(|(id, (lat, lon))| (*id, projection.metres(*lat, *lon))).collect();
        osm.projection = Some(projection);
    }
    Ok(osm)
}

/// Elements of a file that belong to lanelets near the circle of a part.
struct Near {
    nodes: HashSet<i64>,
    ways: HashSet<i64>,
    relations: HashSet<i64>,
}

impl Near {
    /// Nothing if the whole file is read.
    fn of(file: &dyn Source, chosen: &mut Chosen) -> Result<Option<Self>, ReadError> {
        if !chosen.is_part() {
            return Ok(None);
        }
        let (mut nodes, mut near_ways) = (HashSet::new(), HashSet::new());
        each(file, |item| {
            if item.kind == "node" {
                let is_near = match (local_of(&known(&item.tags))?, item.degrees) {
                    (Some(p), _) => chosen.takes_near(p, 0.0),
                    (None, Some((lat, lon))) => chosen.takes_degrees(&[Vec2::new(lon, lat)], BESIDE_M),
                    (None, None) => false,
                };
                nodes.extend(is_near.then_some(item.id));
            }
            Ok(())
        })?;
        each(file, |item| {
            if item.kind == "way" && item.nodes.iter().any(|node| nodes.contains(node)) {
                near_ways.insert(item.id);
            }
            Ok(())
        })?;
        let (mut ways, mut relations) = (HashSet::new(), HashSet::new());
        each(file, |item| {
            let member = |sort: &str| {
                let members = item.members.iter().filter(move |member| member.sort == sort);
                members.map(|member| member.id).collect::<Vec<_>>()
            };
            if item.kind == "relation" && item.tag("type") == Some("lanelet") {
                if member("way").iter().any(|way| near_ways.contains(way)) {
                    relations.insert(item.id);
                    relations.extend(member("relation"));
                    ways.extend(member("way"));
                } else {
                    chosen.left_out += 1;
                }
            }
            Ok(())
        })?;
        // The rules of the lanelets refer to signs and lines.
        each(file, |item| {
            if item.kind == "relation" && relations.contains(&item.id) {
                ways.extend(item.members.iter().filter(|m| m.sort == "way").map(|member| member.id));
            }
            Ok(())
        })?;
        nodes.clear();
        each(file, |item| {
            if item.kind == "way" && ways.contains(&item.id) {
                nodes.extend(item.nodes);
            }
            Ok(())
        })?;
        Ok(Some(Self { nodes, ways, relations }))
    }

    fn takes(&self, item: &OsmElement) -> bool {
        match item.kind {
            "node" => self.nodes.contains(&item.id),
            "way" => self.ways.contains(&item.id),
            _ => self.relations.contains(&item.id),
        }
    }
}

fn known(tags: &[(String, String)]) -> Tags {
    let known = |key: &str| KEYS.iter().copied().find(|known| *known == key);
    let cut = |value: &str| value.chars().take(VALUE_CHARS).collect();
    tags.iter().filter_map(|(key, value)| Some((known(key)?, cut(value)))).collect()
}

fn participants(tags: &[(String, String)]) -> Vec<(String, bool)> {
    let stated = |(key, value): &(String, String)| {
        let who = key.strip_prefix(PARTICIPANT)?;
        let yes = matches!(value.to_ascii_lowercase().as_str(), "yes" | "true" | "1");
        Some((who.trim_start_matches(':').chars().take(VALUE_CHARS).collect(), yes))
    };
    tags.iter().filter_map(stated).take(MAX_PARTICIPANTS).collect()
}

fn local_of(tags: &Tags) -> Result<Option<Vec2>, ReadError> {
    let number = |key| tags.get(key).and_then(|text| text.parse::<f64>().ok()).filter(|v| v.is_finite());
    let Some((x, y)) = number("local_x").zip(number("local_y")) else { return Ok(None) };
    match [x, y].into_iter().find(|v| v.abs() > MAX_SOURCE_M) {
        Some(far) => Err(FieldProblem::range("", -MAX_SOURCE_M, MAX_SOURCE_M, far).into()),
        None => Ok(Some(Vec2::new(x, y))),
    }
}
