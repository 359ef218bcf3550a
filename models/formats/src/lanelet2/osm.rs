//! The XML of OpenStreetMap: points, lines of points, and relations of them, with what is said of each.

use crate::problem::{FieldProblem, ReadError, code};
use crate::projection::Projection;
use crate::source::Source;
use crate::unpack::{self, Bounds};
use crate::xml::{Element, Event, Scanner};
use scene::Vec2;
use std::collections::HashMap;

/// Most bytes of a file once decompressed, and of one tag.
const MAX_BYTES: u64 = 256 << 20;
const MAX_TAG: usize = 64 << 10;
/// Most points, lines, relations, and references to any of them.
const MAX_NODES: usize = 800_000;
const MAX_WAYS: usize = 100_000;
const MAX_RELATIONS: usize = 40_000;
const MAX_REFERENCES: usize = 2_000_000;
/// What is said of points, lines and relations that is looked at.
const KEYS: [&str; 14] = [
    "local_x",
    "local_y",
    "ele",
    "type",
    "subtype",
    "color",
    "one_way",
    "speed_limit",
    "turn_direction",
    "participant:vehicle",
    "participant:pedestrian",
    "participant:bicycle",
    "location",
    "sign_type",
];
/// Most characters of a value.
const VALUE_CHARS: usize = 60;
/// Farthest a local coordinate may lie from its origin, metres.
const MAX_SOURCE_M: f64 = 1e8;

/// What is said of something, by key.
pub(super) type Tags = HashMap<&'static str, String>;

/// A line of points.
#[derive(Debug, Default)]
pub(super) struct Way {
    pub nodes: Vec<i64>,
    pub tags: Tags,
}

/// A member of a relation.
#[derive(Debug)]
pub(super) struct Member {
    pub id: i64,
    pub role: String,
}

/// A relation: a lanelet, a rule.
#[derive(Debug, Default)]
pub(super) struct Relation {
    pub id: i64,
    pub members: Vec<Member>,
    pub tags: Tags,
}

impl Relation {
    /// The first member in a role.
    pub fn member(&self, role: &str) -> Option<i64> {
        self.members.iter().find(|member| member.role == role).map(|member| member.id)
    }
}

/// A file.
#[derive(Debug, Default)]
pub(super) struct Osm {
    /// Metres, in the frame of the file or of [`Osm::projection`].
    pub nodes: HashMap<i64, Vec2>,
    pub ways: HashMap<i64, Way>,
    /// In the order of the file.
    pub relations: Vec<Relation>,
    /// Where the file gives nothing but degrees.
    pub projection: Option<Projection>,
}

#[derive(Default)]
struct Node {
    degrees: Option<(f64, f64)>,
    tags: Tags,
}

#[derive(Default)]
enum Open {
    #[default]
    None,
    Node(i64, Node),
    Way(i64, Way),
    Relation(Relation),
}

/// Reads a file, plain or gzip.
///
/// # Errors
/// `malformed-file` for broken XML or gzip, the bounds of a file, `cannot-represent` for another sort of file,
/// `invalid-field` for what is no number, `map-too-large`.
pub(super) fn read(file: &dyn Source) -> Result<Osm, ReadError> {
    let input = file.open().and_then(|input| unpack::open(input, Bounds::of(MAX_BYTES)));
    let mut scanner = Scanner::new(input.map_err(|error| unpack::fault(&error, 0))?, MAX_TAG);
    let (mut osm, mut open, mut depth) = (Osm::default(), Open::None, 0_usize);
    let mut local: HashMap<i64, Vec2> = HashMap::new();
    let mut degrees: HashMap<i64, (f64, f64)> = HashMap::new();
    let mut references = 0;
    while let Some(event) = scanner.next()? {
        let element = match event {
            Event::Start(element) => element,
            Event::Text(_) => continue,
            Event::End => {
                depth = depth.saturating_sub(1);
                if depth == 1 {
                    match std::mem::take(&mut open) {
                        Open::Node(id, node) => {
                            if let Some(p) = local_of(&node.tags)? {
                                local.insert(id, p);
                            } else if let Some(p) = node.degrees {
                                degrees.insert(id, p);
                            }
                        }
                        Open::Way(id, way) => {
                            osm.ways.insert(id, way);
                        }
                        Open::Relation(relation) => osm.relations.push(relation),
                        Open::None => {}
                    }
                    bound(local.len() + degrees.len(), MAX_NODES, "points")?;
                    bound(osm.ways.len(), MAX_WAYS, "lines")?;
                    bound(osm.relations.len(), MAX_RELATIONS, "relations")?;
                }
                continue;
            }
        };
        depth += 1;
        match (depth, element.name.as_str(), &mut open) {
            (1, "osm", _) => {}
            (1, ..) => {
                let found: String = element.name.chars().take(40).collect();
                let detail = format!("expected <osm>, found <{found}>");
                return Err(FieldProblem::new("", code::CANNOT_REPRESENT, detail).into());
            }
            (2, "node", _) => {
                let number = |name| element.get(name).and_then(|text| text.parse::<f64>().ok());
                let in_range = |(lat, lon): &(f64, f64)| lat.abs() < 89.0 && lon.abs() <= 180.0;
                let degrees = number("lat").zip(number("lon")).filter(in_range);
                open = Open::Node(id(&element, "id")?, Node { degrees, tags: Tags::new() });
            }
            (2, "way", _) => open = Open::Way(id(&element, "id")?, Way::default()),
            (2, "relation", _) => {
                open = Open::Relation(Relation { id: id(&element, "id")?, ..Relation::default() });
            }
            (3, "nd", Open::Way(_, way)) => {
                references += 1;
                way.nodes.push(id(&element, "ref")?);
            }
            (3, "member", Open::Relation(relation)) => {
                references += 1;
                let role = element.get("role").unwrap_or_default().chars().take(VALUE_CHARS).collect();
                relation.members.push(Member { id: id(&element, "ref")?, role });
            }
            (3, "tag", Open::Node(_, Node { tags, .. }) | Open::Way(_, Way { tags, .. })) => {
                say(tags, &element)
            }
            (3, "tag", Open::Relation(relation)) => say(&mut relation.tags, &element),
            _ => {}
        }
        bound(references, MAX_REFERENCES, "references")?;
    }
    osm.nodes = local;
    // Points without metres are placed only where none has them: two frames do not mix.
    let projection = Projection::about(degrees.values().copied()).filter(|_| osm.nodes.is_empty());
    if let Some(projection) = projection {
        osm.nodes = degrees.iter().map(|(id, (lat, lon))| (*id, projection.metres(*lat, *lon))).collect();
        osm.projection = Some(projection);
    }
    Ok(osm)
}

fn bound(count: usize, most: usize, what: &str) -> Result<(), ReadError> {
    if count > most {
        return Err(FieldProblem::new("", code::MAP_TOO_LARGE, format!("more than {most} {what}")).into());
    }
    Ok(())
}

fn id(element: &Element, attribute: &'static str) -> Result<i64, ReadError> {
    let text = element.required(attribute)?;
    text.parse().map_err(|_| {
        let found: String = text.chars().take(40).collect();
        let detail = format!("line {}: \"{found}\" found where an id was expected", element.line);
        FieldProblem::new("", code::INVALID_FIELD, detail).into()
    })
}

fn say(tags: &mut Tags, element: &Element) {
    let (Some(key), Some(value)) = (element.get("k"), element.get("v")) else { return };
    if let Some(key) = KEYS.iter().find(|known| **known == key) {
        tags.insert(key, value.chars().take(VALUE_CHARS).collect());
    }
}

fn local_of(tags: &Tags) -> Result<Option<Vec2>, ReadError> {
    let number = |key| tags.get(key).and_then(|text| text.parse::<f64>().ok()).filter(|v| v.is_finite());
    let Some((x, y)) = number("local_x").zip(number("local_y")) else { return Ok(None) };
    match [x, y].into_iter().find(|v| v.abs() > MAX_SOURCE_M) {
        Some(far) => Err(FieldProblem::range("", -MAX_SOURCE_M, MAX_SOURCE_M, far).into()),
        None => Ok(Some(Vec2::new(x, y))),
    }
}
