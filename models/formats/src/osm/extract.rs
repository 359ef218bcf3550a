//! The parts of an extract that netconvert needs: roads, their nodes, and turn restrictions. The rest is
//! dropped, so that the other program receives a small file of our own writing.

use super::pavements;
use crate::around::Chosen;
use crate::markup::Markup;
use crate::osm_items::{Member, OsmElement, each};
use crate::problem::{ReadError, at_most};
use crate::projection::TransverseMercator;
use crate::refusals::{self, what};
use crate::source::Source;
use crate::written::{BoundedFile, FileBounds};
use scene::Vec2;
use std::collections::HashSet;

/// Most points and ways of roads, and references among them: a town of 4 km has about 30,000 points.
const MAX_POINTS: usize = 60_000;
const MAX_WAYS: usize = 20_000;
const MAX_MEMBERS: usize = 200_000;
/// Greatest latitude of netconvert's projection, degrees.
const MAX_LATITUDE_DEG: f64 = 85.0;
/// Distance outside the circle of a part up to which points are kept, metres: points of a road are no farther
/// apart.
const BESIDE_M: f64 = 300.0;
/// Greatest extent of the roads from north to south, degrees: a map is some kilometres wide.
const MAX_REACH_DEG: f64 = 0.25;

/// Roads of an extract.
#[derive(Debug)]
pub(crate) struct Extract {
    /// XML that netconvert reads.
    pub xml: Vec<u8>,
    /// Projection about the middle of the roads.
    pub projection: TransverseMercator,
    /// Latitude and longitude of the middle, degrees.
    pub middle: (f64, f64),
}

/// Whether an item is an existing road, path or way for driving, riding or walking.
fn is_road(item: &OsmElement) -> bool {
    let gone = ["proposed", "construction", "abandoned", "razed", "platform", "elevator", "corridor"];
    let surface = item.tag("area") != Some("yes") && item.tag("indoor") != Some("yes");
    item.kind == "way" && surface && item.tag("highway").is_some_and(|kind| !gone.contains(&kind))
}

/// Reads the roads of an extract, plain or compressed with gzip.
///
/// # Errors
/// `malformed-file` for broken XML or gzip, the limits of a file, `cannot-represent` for a map of lanelets
/// and one without roads, `map-too-large`.
pub(crate) fn read(file: &dyn Source, chosen: &mut Chosen) -> Result<Extract, ReadError> {
    let (mut ways, mut used) = (HashSet::new(), HashSet::new());
    let near = near(file, chosen)?;
    each(file, |item| {
        if item.kind == "relation" && item.tag("type") == Some("lanelet") {
            return Err(ReadError::other_content(refusals::lanelets_in_extract()));
        }
        if is_road(&item) {
            let nodes = part_of(&item.nodes, near.as_ref());
            if nodes.is_empty() && near.is_some() {
                chosen.left_out += 1;
                return Ok(());
            }
            ways.insert(item.id);
            used.extend(nodes.iter().copied());
            at_most(ways.len(), MAX_WAYS, what::ROADS)?;
            at_most(used.len(), MAX_POINTS, what::ROAD_POINTS)?;
        }
        Ok(())
    })?;
    if ways.is_empty() {
        let message = chosen.nothing().filter(|_| chosen.left_out > 0);
        let message = message.unwrap_or_else(|| refusals::file_has_no(what::HIGHWAY));
        return Err(ReadError::other_content(message));
    }
    let mut out = Markup::new(FileBounds::default());
    out.open("osm", &[("version", "0.6")]);
    let mut places = Vec::new();
    let mut members = 0;
    each(file, |mut item| {
        if item.kind == "way" {
            item.nodes = part_of(&item.nodes, near.as_ref()).to_vec();
        }
        let kept = match item.kind {
            "node" => {
                used.contains(&item.id)
                    && item.degrees.is_some_and(|(latitude, _)| latitude.abs() < MAX_LATITUDE_DEG)
            }
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
    let (Some(projection), true) =
        (TransverseMercator::about(places.into_iter()), reach_deg <= MAX_REACH_DEG)
    else {
        return Err(ReadError::map_too_large(refusals::roads_too_far(reach_deg * 111.0)));
    };
    let xml = out.finish().and_then(BoundedFile::whole).map_err(|error| crate::unpack::fault(&error, 0))?;
    Ok(Extract { xml, projection, middle: ((low.0 + high.0) / 2.0, (low.1 + high.1) / 2.0) })
}

/// Points near the circle of a part; nothing if the whole file is read.
fn near(file: &dyn Source, chosen: &mut Chosen) -> Result<Option<HashSet<i64>>, ReadError> {
    if !chosen.is_part() {
        return Ok(None);
    }
    let mut near = HashSet::new();
    each(file, |item| {
        if let (Some((lat, lon)), "node") = (item.degrees, item.kind)
            && chosen.takes_degrees(&[Vec2::new(lon, lat)], BESIDE_M)
        {
            near.insert(item.id);
        }
        Ok(())
    })?;
    Ok(Some(near))
}

/// Points of a way from the one before the first near point to the one after the last.
fn part_of<'a>(nodes: &'a [i64], near: Option<&HashSet<i64>>) -> &'a [i64] {
    let Some(near) = near else { return nodes };
    let is_near = |node: &i64| near.contains(node);
    let Some(first) = nodes.iter().position(is_near) else { return &[] };
    let last = nodes.iter().rposition(is_near).unwrap_or(first);
    nodes.get(first.saturating_sub(1)..(last + 2).min(nodes.len())).unwrap_or_default()
}

/// Writes an item in the form of OpenStreetMap.
fn write(item: &OsmElement, out: &mut Markup) {
    let id = item.id.to_string();
    let (lat, lon) = item.degrees.map(|(lat, lon)| (lat.to_string(), lon.to_string())).unzip();
    let mut attributes = vec![("id", id.as_str())];
    attributes.extend(lat.as_deref().map(|lat| ("lat", lat)));
    attributes.extend(lon.as_deref().map(|lon| ("lon", lon)));
    out.open(item.kind, &attributes);
    item.nodes.iter().for_each(|node| out.empty("nd", &[("ref", &node.to_string())]));
    for Member { sort, id, role } in &item.members {
        out.empty("member", &[("type", sort), ("ref", &id.to_string()), ("role", role)]);
    }
    let tags = item.tags.iter().filter(|(key, _)| !pavements::is_tag(key));
    tags.for_each(|(key, value)| out.empty("tag", &[("k", key), ("v", value)]));
    if let Some(sides) = pavements::value(item) {
        out.empty("tag", &[("k", "sidewalk"), ("v", sides)]);
    }
    out.close();
}

#[cfg(test)]
mod tests {
    use super::*;

    fn extract(text: &str) -> Result<Extract, ReadError> {
        read(&text.as_bytes(), &mut Chosen::default())
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
        // The written file reads back unchanged.
        assert_eq!(extract(text).unwrap().xml, found.xml);
    }

    #[test]
    fn a_part_has_the_ways_near_its_place() {
        let node = |id: i64, lon: f64| format!(r#"<node id="{id}" lat="48.1" lon="{lon}"/>"#);
        // Points 743 m apart along one way, and another way far away.
        let nodes: String = (0..100).map(|i| node(i, 11.0 + 0.01 * i as f64)).collect();
        let way = |id: i64, from: i64, to: i64| {
            let points: String = (from..to).map(|i| format!(r#"<nd ref="{i}"/>"#)).collect();
            format!(r#"<way id="{id}">{points}<tag k="highway" v="primary"/></way>"#)
        };
        let text = format!("<osm>{nodes}{}{}</osm>", way(500, 0, 60), way(501, 70, 100));
        let mut chosen = Chosen::of("11.3,48.1,100".parse().ok());
        let found = read(&text.as_bytes(), &mut chosen).unwrap();
        let xml = std::str::from_utf8(&found.xml).unwrap();
        assert_eq!((xml.matches("<node").count(), xml.matches("<way").count()), (3, 1));
        assert_eq!(chosen.left_out, 1);
        let mut chosen = Chosen::of("12.5,48.1,100".parse().ok());
        let error = read(&text.as_bytes(), &mut chosen).unwrap_err().to_string();
        assert!(error.contains("x 11 to 11.99 and y 48.1 to 48.1"), "{error}");
        assert_eq!(extract(&text).unwrap_err().code(), "map-too-large", "the whole is 73 km wide");
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
