//! What netconvert needs of an extract: roads, the points that they have, which turns are allowed. All else is left
//! out, so that what is handed to another program is small and of our own writing.

use crate::markup::Markup;
use crate::problem::{FieldProblem, ReadError, code};
use crate::projection::Projection;
use crate::source::Source;
use crate::unpack::{self, Bounds};
use crate::xml::{Element, Event, Scanner};
use std::collections::HashSet;

/// Most bytes of a file once decompressed, and of one tag.
const MAX_BYTES: u64 = 256 << 20;
const MAX_TAG: usize = 64 << 10;
/// Most points and ways of roads, and references among them: a town of 4 km has about 30,000 points.
const MAX_POINTS: usize = 60_000;
const MAX_WAYS: usize = 20_000;
const MAX_MEMBERS: usize = 200_000;
/// Most tags of anything, and bytes of a value.
const MAX_TAGS: usize = 200;
const MAX_VALUE: usize = 255;
/// Farthest that roads may reach from north to south, degrees: a map is some kilometres wide.
const MAX_REACH_DEG: f64 = 0.25;

/// Roads of an extract.
#[derive(Debug)]
pub(crate) struct Extract {
    /// XML that netconvert reads.
    pub xml: Vec<u8>,
    /// About the middle of the roads.
    pub projection: Projection,
    /// Latitude and longitude of the middle, degrees.
    pub middle: (f64, f64),
}

/// A node, way or relation.
#[derive(Debug, Default)]
struct Item {
    kind: &'static str,
    id: i64,
    degrees: Option<(f64, f64)>,
    tags: Vec<(String, String)>,
    /// Points of a way.
    nodes: Vec<i64>,
    /// Members of a relation: sort, id, role.
    members: Vec<(String, i64, String)>,
}

impl Item {
    fn tag(&self, key: &str) -> Option<&str> {
        self.tags.iter().find(|(k, _)| k == key).map(|(_, value)| value.as_str())
    }

    /// A road, path or way that people drive, ride or walk on; not one that is planned or gone.
    fn is_road(&self) -> bool {
        let gone = ["proposed", "construction", "abandoned", "razed", "platform", "elevator", "corridor"];
        let surface = self.tag("area") != Some("yes") && self.tag("indoor") != Some("yes");
        self.kind == "way" && surface && self.tag("highway").is_some_and(|kind| !gone.contains(&kind))
    }
}

/// Hands the items of a file to `take`, one after the other.
fn each(file: &dyn Source, mut take: impl FnMut(Item) -> Result<(), ReadError>) -> Result<(), ReadError> {
    let input = file.open().and_then(|input| unpack::open(input, Bounds::of(MAX_BYTES)));
    let mut scanner = Scanner::new(input.map_err(|error| unpack::fault(&error, 0))?, MAX_TAG);
    let (mut item, mut depth) = (None, 0_usize);
    while let Some(event) = scanner.next()? {
        let element = match event {
            Event::Start(element) => element,
            Event::Text(_) => continue,
            Event::End => {
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
                let found: String = element.name.chars().take(40).collect();
                return Err(cannot(format!("expected <osm>, found <{found}>")));
            }
            (2, "node" | "way" | "relation", _) => item = begun(&element),
            (3, "tag", Some(item)) => {
                if let (Some(key), Some(value)) = (element.get("k"), element.get("v"))
                    && item.tags.len() < MAX_TAGS
                    && value.len() <= MAX_VALUE
                {
                    item.tags.push((key.to_owned(), value.to_owned()));
                }
            }
            (3, "nd", Some(item)) => {
                item.nodes.extend(number(&element, "ref"));
                bound(item.nodes.len(), MAX_POINTS, "points of a way")?;
            }
            (3, "member", Some(item)) => {
                let (sort, role) = (element.get("type"), element.get("role"));
                if let (Some(sort), Some(id)) = (sort, number(&element, "ref")) {
                    item.members.push((sort.to_owned(), id, role.unwrap_or_default().to_owned()));
                }
                bound(item.members.len(), MAX_MEMBERS, "members of a relation")?;
            }
            _ => {}
        }
    }
    Ok(())
}

/// An item, unless it was deleted or has no number.
fn begun(element: &Element) -> Option<Item> {
    let gone = element.get("action") == Some("delete") || element.get("visible") == Some("false");
    let degree = |name| element.get(name).and_then(|text| text.parse::<f64>().ok());
    let in_range = |(lat, lon): &(f64, f64)| lat.abs() < 85.0 && lon.abs() <= 180.0;
    let degrees = degree("lat").zip(degree("lon")).filter(in_range);
    let id = number(element, "id").filter(|_| !gone)?;
    let kind = ["node", "way", "relation"].into_iter().find(|kind| *kind == element.name)?;
    Some(Item { kind, id, degrees, ..Item::default() })
}

fn number(element: &Element, name: &str) -> Option<i64> {
    element.get(name)?.parse().ok()
}

/// Reads the roads of an extract, plain or gzip.
///
/// # Errors
/// `malformed-file` for broken XML or gzip, the bounds of a file, `cannot-represent` for a map of lanelets and one
/// without roads, `map-too-large`.
pub(crate) fn read(file: &dyn Source) -> Result<Extract, ReadError> {
    let (mut ways, mut used) = (HashSet::new(), HashSet::new());
    each(file, |item| {
        if item.kind == "relation" && item.tag("type") == Some("lanelet") {
            return Err(cannot("it has lanelets: a Lanelet2 map, which is read as lanelet2".into()));
        }
        if item.is_road() {
            ways.insert(item.id);
            used.extend(item.nodes);
            bound(ways.len(), MAX_WAYS, "roads")?;
            bound(used.len(), MAX_POINTS, "points of roads")?;
        }
        Ok(())
    })?;
    if ways.is_empty() {
        return Err(cannot("no roads: nothing in it is tagged `highway`".into()));
    }
    let mut out = Markup::new();
    out.open("osm", &[("version", "0.6")]);
    let mut places = Vec::new();
    let mut members = 0;
    each(file, |item| {
        let kept = match item.kind {
            "node" => used.contains(&item.id) && item.degrees.is_some(),
            "way" => ways.contains(&item.id),
            _ => {
                item.tag("type") == Some("restriction") && {
                    members += item.members.len();
                    members <= MAX_MEMBERS
                }
            }
        };
        if kept {
            places.extend(item.degrees);
            write(&item, &mut out);
        }
        Ok(())
    })?;
    let corner = |pick: fn(f64, f64) -> f64| {
        let first = places.first().copied().unwrap_or_default();
        places.iter().fold(first, |a, b| (pick(a.0, b.0), pick(a.1, b.1)))
    };
    let (low, high) = (corner(f64::min), corner(f64::max));
    let reach_deg = (high.0 - low.0).max((high.1 - low.1) * high.0.to_radians().cos());
    let (Some(projection), true) = (Projection::about(places.into_iter()), reach_deg <= MAX_REACH_DEG) else {
        let detail = format!("roads over {:.0} km; cut out some kilometres", reach_deg * 111.0);
        return Err(FieldProblem::new("", code::MAP_TOO_LARGE, detail).into());
    };
    Ok(Extract { xml: out.finish(), projection, middle: ((low.0 + high.0) / 2.0, (low.1 + high.1) / 2.0) })
}

/// Writes an item as OpenStreetMap does.
fn write(item: &Item, out: &mut Markup) {
    let id = item.id.to_string();
    let (lat, lon) = item.degrees.map(|(lat, lon)| (lat.to_string(), lon.to_string())).unzip();
    let mut attributes = vec![("id", id.as_str())];
    attributes.extend(lat.as_deref().map(|lat| ("lat", lat)));
    attributes.extend(lon.as_deref().map(|lon| ("lon", lon)));
    out.open(item.kind, &attributes);
    item.nodes.iter().for_each(|node| out.empty("nd", &[("ref", &node.to_string())]));
    for (sort, id, role) in &item.members {
        out.empty("member", &[("type", sort), ("ref", &id.to_string()), ("role", role)]);
    }
    item.tags.iter().for_each(|(key, value)| out.empty("tag", &[("k", key), ("v", value)]));
    out.close();
}

fn bound(count: usize, most: usize, what: &str) -> Result<(), ReadError> {
    if count > most {
        return Err(FieldProblem::new("", code::MAP_TOO_LARGE, format!("more than {most} {what}")).into());
    }
    Ok(())
}

fn cannot(detail: String) -> ReadError {
    FieldProblem::new("", code::CANNOT_REPRESENT, detail).into()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn extract(text: &str) -> Result<Extract, ReadError> {
        read(&text.as_bytes())
    }

    #[test]
    fn roads_and_their_points_are_kept_and_nothing_else() {
        let found = extract(
            r#"<osm><node id="1" lat="48.1" lon="11.5"/><node id="2" lat="48.101" lon="11.5"><tag k="name" v="a &amp; &quot;b&quot;"/></node>
            <node id="3" lat="48.2" lon="11.9"/><node id="4" lat="48.1" lon="11.5" action="delete"/>
            <way id="7"><nd ref="1"/><nd ref="2"/><tag k="highway" v="residential"/></way>
            <way id="8"><nd ref="3"/><tag k="building" v="yes"/></way>
            <way id="9"><nd ref="3"/><tag k="highway" v="proposed"/></way>
            <relation id="5"><member type="way" ref="7" role="from"/><tag k="type" v="restriction"/></relation>
            <relation id="6"><member type="way" ref="8" role="outer"/><tag k="type" v="multipolygon"/></relation></osm>"#,
        )
        .unwrap();
        let text = std::str::from_utf8(&found.xml).unwrap();
        assert_eq!(text.matches("<node").count(), 2);
        assert_eq!(text.matches("<way").count(), 1);
        assert_eq!(text.matches("<relation").count(), 1);
        assert!(text.contains(r#"v="a &amp; &quot;b&quot;""#));
        assert!((found.middle.0 - 48.1005).abs() < 1e-9);
        // What was written reads again to the same.
        assert_eq!(extract(text).unwrap().xml, found.xml);
    }

    #[test]
    fn other_maps_are_refused() {
        let code = |text: &str| extract(text).unwrap_err().code();
        assert_eq!(code("<net/>"), "cannot-represent");
        assert_eq!(code("<osm/>"), "cannot-represent");
        let lanelet = r#"<osm><relation id="1"><tag k="type" v="lanelet"/></relation></osm>"#;
        assert_eq!(code(lanelet), "cannot-represent");
        let wide = r#"<osm><node id="1" lat="48" lon="11"/><node id="2" lat="49" lon="11"/><way id="7"><nd ref="1"/><nd ref="2"/><tag k="highway" v="primary"/></way></osm>"#;
        assert_eq!(code(wide), "map-too-large");
    }
}
