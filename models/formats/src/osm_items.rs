//! The XML of OpenStreetMap, item by item: nodes, ways and relations, with their tags. Road maps and Lanelet2
//! maps share it.

use crate::encoding::Utf8;
use crate::problem::{FieldProblem, ReadError, at_most, code};
use crate::refusals::{found_expected, quoted, tag, wanted, what};
use crate::source::Source;
use crate::unpack::{self, Bounds, has_word};
use crate::xml::{Element, Scanner, XmlEvent};

/// Most bytes of a file once decompressed, and of one tag.
const MAX_BYTES: u64 = 256 << 20;
const MAX_TAG: usize = 64 << 10;
/// Most references of one item, most tags of it, and most bytes of a value.
const MAX_REFERENCES: usize = 200_000;
const MAX_TAGS: usize = 200;
const MAX_VALUE: usize = 255;

/// A node, way or relation.
#[derive(Debug, Default)]
pub(crate) struct OsmElement {
    pub kind: &'static str,
    pub id: i64,
    /// Latitude and longitude of a node.
    pub degrees: Option<(f64, f64)>,
    pub tags: Vec<(String, String)>,
    /// Points of a way.
    pub nodes: Vec<i64>,
    /// Members of a relation.
    pub members: Vec<Member>,
}

/// A member of a relation.
#[derive(Debug)]
pub(crate) struct Member {
    /// Type of the member: node, way or relation.
    pub sort: String,
    pub id: i64,
    pub role: String,
}

impl OsmElement {
    pub fn tag(&self, key: &str) -> Option<&str> {
        self.tags.iter().find(|(k, _)| k == key).map(|(_, value)| value.as_str())
    }
}

/// Passes each item of a file, plain or compressed with gzip, to `take`; deleted items are skipped.
///
/// # Errors
/// `malformed-file` for broken XML or gzip, the limits of a file, `cannot-represent` for another kind of
/// file, `invalid-field` for a value that is not a number, `map-too-large`, and those of `take`.
pub(crate) fn each(
    file: &dyn Source,
    mut take: impl FnMut(OsmElement) -> Result<(), ReadError>,
) -> Result<(), ReadError> {
    let input = file.open().and_then(|input| unpack::open(input, Bounds::of(MAX_BYTES)));
    let mut scanner = Scanner::new(input.map_err(|error| unpack::fault(&error, 0))?, MAX_TAG);
    let (mut item, mut depth) = (None, 0_usize);
    while let Some(event) = scanner.next()? {
        let element = match event {
            XmlEvent::Start(element) => element,
            XmlEvent::Text(_) => continue,
            XmlEvent::End => {
                depth = depth.saturating_sub(1);
                if depth == 1
                    && let Some(item) = item.take()
                {
                    take(item)?;
                }
                continue;
            }
        };
        depth += 1;
        match (depth, element.name.as_str(), &mut item) {
            (1, "osm", _) => {}
            (1, ..) => {
                return Err(ReadError::other_content(found_expected(tag(&element.name), "<osm>")));
            }
            (2, "node", _) => item = begun("node", &element)?,
            (2, "way", _) => item = begun("way", &element)?,
            (2, "relation", _) => item = begun("relation", &element)?,
            (3, "tag", Some(item)) => {
                if let (Some(key), Some(value)) = (element.get("k"), element.get("v"))
                    && item.tags.len() < MAX_TAGS
                    && value.len() <= MAX_VALUE
                {
                    item.tags.push((key.to_owned(), value.to_owned()));
                }
            }
            (3, "nd", Some(item)) => {
                item.nodes.push(id(&element, "ref")?);
                at_most(item.nodes.len(), MAX_REFERENCES, what::WAY_POINTS)?;
            }
            (3, "member", Some(item)) => {
                let text = |name| element.get(name).unwrap_or_default().to_owned();
                item.members.push(Member {
                    sort: text("type"),
                    id: id(&element, "ref")?,
                    role: text("role"),
                });
                at_most(item.members.len(), MAX_REFERENCES, what::MEMBERS)?;
            }
            _ => {}
        }
    }
    Ok(())
}

/// Whether a file of OpenStreetMap's XML contains lanelets (`type=lanelet`), by its whole content; for a
/// broken file, by the content before the fault.
pub(crate) fn holds_lanelets(file: &dyn Source) -> bool {
    let open = || file.open().and_then(|input| unpack::open(input, Bounds::of(MAX_BYTES))).ok();
    // The word is searched first: most extracts lack it, and bytes are searched faster than elements.
    let named = open().is_some_and(|input| has_word(Utf8::new(input), b"lanelet"));
    let Some(input) = open().filter(|_| named) else { return false };
    let mut scanner = Scanner::new(input, MAX_TAG);
    while let Ok(Some(event)) = scanner.next() {
        if let XmlEvent::Start(element) = event
            && (element.name.as_str(), element.get("k"), element.get("v"))
                == ("tag", Some("type"), Some("lanelet"))
        {
            return true;
        }
    }
    false
}

fn begun(kind: &'static str, element: &Element) -> Result<Option<OsmElement>, ReadError> {
    if element.get("action") == Some("delete") || element.get("visible") == Some("false") {
        return Ok(None);
    }
    let degree = |name| element.get(name).and_then(|text| text.parse::<f64>().ok());
    let in_range = |(lat, lon): &(f64, f64)| lat.abs() < 89.0 && lon.abs() <= 180.0;
    let degrees = degree("lat").zip(degree("lon")).filter(in_range);
    Ok(Some(OsmElement { kind, id: id(element, "id")?, degrees, ..OsmElement::default() }))
}

fn id(element: &Element, attribute: &'static str) -> Result<i64, ReadError> {
    let text = element.required(attribute)?;
    text.parse().map_err(|_| {
        let message = found_expected(quoted(text), wanted::ID_NUMBER).at_line(element.line);
        FieldProblem::new("", code::INVALID_FIELD, message).into()
    })
}
