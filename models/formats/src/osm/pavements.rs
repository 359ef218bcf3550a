//! Pavements of roads: the information of a way's tags in the form that netconvert accepts, and a guess if
//! there are none. netconvert's own guess would override tags.

use crate::osm_items::OsmElement;
use crate::units::MPS_PER_MPH;

/// Roads without a tag have pavements between these speed limits, km/h, as netconvert guesses.
const GUESSED_KMH: (f64, f64) = (20.9, 50.1);

/// Whether a tag is about pavements.
pub(super) fn is_tag(key: &str) -> bool {
    key == "sidewalk" || key.starts_with("sidewalk:")
}

/// The value of `sidewalk` for a road; nothing for a way that is not for cars.
pub(super) fn value(way: &OsmElement) -> Option<&'static str> {
    let both = way.tag("sidewalk:both").or(way.tag("sidewalk"));
    let side = |own: &str, word: &str| -> Option<bool> {
        match way.tag(own).or(both)? {
            "yes" | "both" => Some(true),
            // Pavements that are separate ways are drawn as such.
            "no" | "none" | "separate" => Some(false),
            other @ ("left" | "right") => Some(other == word),
            _ => None,
        }
    };
    let sides = [side("sidewalk:left", "left"), side("sidewalk:right", "right")];
    let stated = sides.contains(&Some(true));
    // A tag for one side means that the other side has none; without tags, both are guessed.
    let guess = !stated && is_guessed(way);
    Some(match sides.map(|side| side.unwrap_or(guess)) {
        _ if sides == [None, None] && !guess => return None,
        [true, true] => "both",
        [true, false] => "left",
        [false, true] => "right",
        [false, false] => "none",
    })
}

/// Whether a road without tags of pavements has them, by its speed limit.
fn is_guessed(way: &OsmElement) -> bool {
    let usual_kmh = match way.tag("highway").unwrap_or_default() {
        "residential" => 50.0,
        "unclassified" | "tertiary" | "tertiary_link" => 80.0,
        "secondary" | "secondary_link" | "primary" | "primary_link" | "trunk_link" => 100.0,
        _ => return false,
    };
    let kmh = way.tag("maxspeed").and_then(limit_kmh).unwrap_or(usual_kmh);
    kmh > GUESSED_KMH.0 && kmh < GUESSED_KMH.1
}

fn limit_kmh(text: &str) -> Option<f64> {
    let (number, unit) =
        text.split_at(text.find(|c: char| !c.is_ascii_digit() && c != '.').unwrap_or(text.len()));
    let factor = if unit.trim() == "mph" { 3.6 * MPS_PER_MPH } else { 1.0 };
    number.parse::<f64>().ok().map(|value| value * factor)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn said(tags: &[(&str, &str)]) -> Option<&'static str> {
        let owned = |(key, value): &(&str, &str)| ((*key).to_owned(), (*value).to_owned());
        value(&OsmElement { kind: "way", tags: tags.iter().map(owned).collect(), ..OsmElement::default() })
    }

    #[test]
    fn tags_come_before_the_guess() {
        let street = ("highway", "residential");
        for (tags, expected) in [
            (&[][..], Some("both")),
            (&[("sidewalk:left", "yes"), ("sidewalk:right", "no")], Some("left")),
            (&[("sidewalk:right", "yes")], Some("right")),
            (&[("sidewalk:both", "yes")], Some("both")),
            (&[("sidewalk:both", "no")], Some("none")),
            (&[("sidewalk", "no")], Some("none")),
            (&[("sidewalk", "none")], Some("none")),
            (&[("sidewalk", "separate")], Some("none")),
            (&[("sidewalk:left", "separate"), ("sidewalk:right", "yes")], Some("right")),
            (&[("sidewalk", "left")], Some("left")),
            (&[("sidewalk:right", "no")], Some("left")),
            (&[("maxspeed", "30 mph")], Some("both")),
            (&[("maxspeed", "70")], None),
            (&[("maxspeed", "70"), ("sidewalk", "right")], Some("right")),
        ] {
            assert_eq!(said(&[&[street], tags].concat()), expected, "{tags:?}");
        }
        assert_eq!(said(&[("highway", "motorway")]), None);
        assert_eq!(said(&[("highway", "secondary")]), None);
        assert_eq!(said(&[("highway", "secondary"), ("maxspeed", "50")]), Some("both"));
    }
}
