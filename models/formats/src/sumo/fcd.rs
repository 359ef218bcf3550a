//! Reader of floating-car data in SUMO's CSV form: one row for each road user and step.

use super::SumoError;
use crate::refusals::{quoted, wanted};
use scene::Vec2;
use std::collections::BTreeMap;
use std::io::BufRead;

/// Recorded states of one road user.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FcdTrack {
    /// SUMO's vehicle type (of the form `type@...` for distributions; cut at the `@`).
    pub vehicle_type: String,
    /// Times in ascending order, seconds.
    pub times_s: Vec<f64>,
    /// Middle of the *front* bumper of a vehicle, centre of a person.
    pub positions: Vec<Vec2>,
    /// Heading, radians counter-clockwise from +x.
    pub headings_rad: Vec<f64>,
    /// Speeds, m/s.
    pub speeds_mps: Vec<f64>,
}

/// Reads FCD rows, separated by `;`, by road user id. Persons may be in the vehicles' columns, as SUMO 1.28
/// writes them, or in their own.
///
/// # Errors
/// When a column is missing or a field is not a number. An unreadable stream counts as its end.
pub fn read_csv(input: impl BufRead) -> Result<BTreeMap<String, FcdTrack>, SumoError> {
    let mut lines = input.lines().map_while(Result::ok);
    let header = lines.next().unwrap_or_default();
    let names: Vec<&str> = header.trim().split(';').collect();
    let groups: Vec<ColumnIndices> =
        ["vehicle", "person"].iter().filter_map(|g| ColumnIndices::find(&names, g)).collect();
    let time = names.iter().position(|n| *n == "timestep_time");
    let (Some(time), false) = (time, groups.is_empty()) else {
        return Err(SumoError::content(quoted(&header), wanted::FCD_COLUMNS));
    };
    let mut records: BTreeMap<String, FcdTrack> = BTreeMap::new();
    for (i, line) in lines.enumerate() {
        let row = i as u32 + 2;
        let fields: Vec<&str> = line.trim_end().split(';').collect();
        let text = |column: usize| fields.get(column).copied().unwrap_or_default();
        let number = |column: usize| -> Result<f64, SumoError> {
            let value = text(column).parse::<f64>().ok().filter(|v| v.is_finite());
            value.ok_or_else(|| SumoError::value(text(column), wanted::NUMBER, row))
        };
        let Some(columns) = groups.iter().find(|c| !text(c.id).is_empty()) else { continue };
        if !records.contains_key(text(columns.id)) {
            let kind = columns.kind.map(text).unwrap_or_default();
            let vehicle_type = kind.split('@').next().unwrap_or_default().to_owned();
            records.insert(text(columns.id).to_owned(), FcdTrack { vehicle_type, ..FcdTrack::default() });
        }
        let Some(record) = records.get_mut(text(columns.id)) else { continue };
        record.times_s.push(number(time)?);
        record.positions.push(Vec2::new(number(columns.x)?, number(columns.y)?));
        record.headings_rad.push((90.0 - number(columns.angle)?).to_radians());
        record.speeds_mps.push(number(columns.speed)?);
    }
    Ok(records)
}

/// Indices of a group's fields in a row.
pub(super) struct ColumnIndices {
    pub id: usize,
    pub x: usize,
    pub y: usize,
    pub angle: usize,
    pub speed: usize,
    pub kind: Option<usize>,
    pub lane: Option<usize>,
    pub edge: Option<usize>,
    pub length: Option<usize>,
    pub width: Option<usize>,
}

impl ColumnIndices {
    pub fn find(names: &[&str], group: &str) -> Option<Self> {
        let column = |what: &str| {
            names.iter().position(|n| n.strip_prefix(group).and_then(|n| n.strip_prefix('_')) == Some(what))
        };
        Some(Self {
            id: column("id")?,
            x: column("x")?,
            y: column("y")?,
            angle: column("angle")?,
            speed: column("speed")?,
            kind: column("type"),
            lane: column("lane"),
            edge: column("edge"),
            length: column("length"),
            width: column("width"),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const HEAD: &str =
        "timestep_time;vehicle_angle;vehicle_id;vehicle_speed;vehicle_type;vehicle_x;vehicle_y\n";

    #[test]
    fn reads_rows_by_road_user() {
        let text =
            format!("{HEAD}90.00;90.0;v1;5.0;car3@a;1.0;2.0\n90.10;0.0;v1;5.0;car3;1.5;2.0\n90.10;;;;;;\n");
        let records = read_csv(text.as_bytes()).unwrap();
        let v1 = &records["v1"];
        assert_eq!((records.len(), v1.vehicle_type.as_str()), (1, "car3"));
        assert_eq!(v1.positions[1], Vec2::new(1.5, 2.0));
        assert!(v1.headings_rad[0].abs() < 1e-12);
        assert!((v1.headings_rad[1] - std::f64::consts::FRAC_PI_2).abs() < 1e-12);
    }

    #[test]
    fn says_where_a_number_is_missing() {
        let error = read_csv(format!("{HEAD}90.00;x;v1;5;c;1;2\n").as_bytes()).unwrap_err();
        assert_eq!(error.to_string(), "line 2: \"x\" found, a number expected");
        assert!(matches!(read_csv("a;b\n".as_bytes()), Err(SumoError::Content(_))));
    }
}
