//! Ranges of the parameters: those of their schema, and the least angle between arms.

use crate::parameters::{Arm, LEAST_BETWEEN_ARMS_DEG};
use crate::{CarPark, Connections, Junction, Layout, Merge, Road, Roundabout};
use schemars::{JsonSchema, schema_for};
use serde_json::Value;
use std::collections::BTreeMap;
use std::sync::LazyLock;

/// Most faults that are listed.
const MOST_FAULTS: usize = 32;

/// A fault of a parameter.
#[derive(Clone, Debug, PartialEq)]
pub struct ParameterFault {
    /// JSON pointer below the parameters.
    pub pointer: String,
    /// The value found and the value expected, as text.
    pub reason: String,
    /// Least value, greatest value and the value found, for a number outside its range.
    pub range: Option<(f64, f64, f64)>,
}

impl ParameterFault {
    fn new(pointer: impl Into<String>, reason: impl Into<String>) -> Self {
        Self { pointer: pointer.into(), reason: reason.into(), range: None }
    }

    pub(crate) fn unreadable(error: &serde_path_to_error::Error<serde_json::Error>) -> Self {
        let mut pointer = String::new();
        for segment in error.path() {
            use serde_path_to_error::Segment::{Enum, Map, Seq, Unknown};
            match segment {
                Seq { index } => pointer.push_str(&format!("/{index}")),
                Map { key } | Enum { variant: key } => {
                    pointer.push_str(&format!("/{}", key.replace('~', "~0").replace('/', "~1")));
                }
                Unknown => {}
            }
        }
        let text = error.inner().to_string();
        let text = text.split_once(", expected struct ").map_or(text.clone(), |(found, _)| {
            // The name of the type means nothing to the author of the document.
            format!("{found}, expected an object")
        });
        Self::new(pointer, text.chars().take(300).collect::<String>())
    }
}

static SCHEMAS: LazyLock<[Value; 5]> = LazyLock::new(|| {
    fn of<T: JsonSchema>() -> Value {
        schema_for!(T).to_value()
    }
    [of::<Junction>(), of::<Roundabout>(), of::<Merge>(), of::<Road>(), of::<CarPark>()]
});

/// Range of each number among the parameters, by kind of layout and path, such as `junction` and
/// `arms.lanes_in`.
pub fn all() -> BTreeMap<&'static str, BTreeMap<String, [f64; 2]>> {
    let names = ["junction", "roundabout", "merge", "road", "car_park"];
    let of = |schema: &Value| {
        let mut ranges = BTreeMap::new();
        collect(schema, schema, "", &mut ranges);
        ranges
    };
    names.into_iter().zip(SCHEMAS.iter().map(of)).collect()
}

fn collect(root: &Value, schema: &Value, place: &str, ranges: &mut BTreeMap<String, [f64; 2]>) {
    if let Some(name) = schema["$ref"].as_str() {
        return root
            .pointer(name.trim_start_matches('#'))
            .map_or((), |schema| collect(root, schema, place, ranges));
    }
    if let (Some(least), Some(most)) = (schema["minimum"].as_f64(), schema["maximum"].as_f64()) {
        ranges.insert(place.to_owned(), [least, most]);
    }
    if schema["items"].is_object() {
        collect(root, &schema["items"], place, ranges);
    }
    for (name, member) in schema["properties"].as_object().into_iter().flatten() {
        let place = if place.is_empty() { name.clone() } else { format!("{place}.{name}") };
        collect(root, member, &place, ranges);
    }
}

/// All faults of the parameters of a layout.
pub fn faults(layout: &Layout) -> Vec<ParameterFault> {
    let schema = match layout {
        Layout::ThreeArms(_) | Layout::FourArms(_) => &SCHEMAS[0],
        Layout::Roundabout(_) => &SCHEMAS[1],
        Layout::Merge(_) => &SCHEMAS[2],
        Layout::Straight(_) | Layout::Curve(_) | Layout::SchoolStreet(_) => &SCHEMAS[3],
        Layout::CarPark(_) => &SCHEMAS[4],
    };
    let mut faults = Vec::new();
    within(schema, schema, &layout.parameters(), "", &mut faults);
    if let Layout::ThreeArms(Junction { arms, .. })
    | Layout::FourArms(Junction { arms, .. })
    | Layout::Roundabout(Roundabout { arms, .. }) = layout
    {
        if faults.is_empty() {
            keep_apart(arms, &mut faults);
        }
        for (i, arm) in arms.iter().enumerate() {
            if arm.turns.as_ref().is_some_and(|turns| turns.len() != usize::from(arm.lanes_in)) {
                let reason = format!("a list for each of the {} lanes in expected", arm.lanes_in);
                faults.push(ParameterFault::new(format!("/arms/{i}/turns"), reason));
            }
        }
        if !arms.iter().any(|arm| arm.lanes_in > 0) || !arms.iter().any(|arm| arm.lanes_out > 0) {
            faults.push(ParameterFault::new("/arms", "a lane in and a lane out expected, at any arm"));
        }
        let bare = arms.iter().position(|arm| arm.lanes_in == 0 && arm.lanes_out == 0);
        if let Some(i) = bare {
            faults.push(ParameterFault::new(format!("/arms/{i}/lanes_in"), "an arm needs a lane in or out"));
        }
    }
    if let (Layout::ThreeArms(junction) | Layout::FourArms(junction), true) = (layout, faults.is_empty()) {
        connect(junction, &mut faults);
    }
    faults.truncate(MOST_FAULTS);
    faults
}

/// Checks numbers and lengths of lists against the schema.
fn within(root: &Value, schema: &Value, value: &Value, pointer: &str, faults: &mut Vec<ParameterFault>) {
    if let Some(name) = schema["$ref"].as_str() {
        let at = name.trim_start_matches('#');
        return root.pointer(at).map_or((), |schema| within(root, schema, value, pointer, faults));
    }
    match value {
        // JSON has no infinite numbers or NaN: serde writes them as null.
        Value::Null if !optional(schema) => {
            faults.push(ParameterFault::new(pointer, "a finite number expected"));
        }
        Value::Number(number) => {
            let (least, most) = (schema["minimum"].as_f64(), schema["maximum"].as_f64());
            let got = number.as_f64().unwrap_or(f64::MAX);
            let (least, most) = (least.unwrap_or(f64::MIN), most.unwrap_or(f64::MAX));
            if !(least..=most).contains(&got) {
                let reason = format!("{got} found, {least} to {most} expected");
                faults.push(ParameterFault {
                    pointer: pointer.to_owned(),
                    reason,
                    range: Some((least, most, got)),
                });
            }
        }
        Value::Array(items) => {
            let (least, most) = (schema["minItems"].as_u64(), schema["maxItems"].as_u64());
            let (least, most) = (least.unwrap_or(0), most.unwrap_or(u64::MAX));
            if !(least..=most).contains(&(items.len() as u64)) {
                let reason = format!("{} found, {least} to {most} expected", items.len());
                faults.push(ParameterFault::new(pointer, reason));
            }
            for (i, item) in items.iter().enumerate().take(MOST_FAULTS) {
                within(root, &schema["items"], item, &format!("{pointer}/{i}"), faults);
            }
        }
        Value::Object(members) => {
            for (name, member) in members {
                within(root, &schema["properties"][name], member, &format!("{pointer}/{name}"), faults);
            }
        }
        _ => {}
    }
}

fn optional(schema: &Value) -> bool {
    schema["type"].as_array().is_some_and(|types| types.iter().any(|kind| kind == "null"))
}

/// Checks that lanes of connections exist, and that none is both added and removed.
fn connect(junction: &Junction, faults: &mut Vec<ParameterFault>) {
    let Connections { added, removed } = &junction.connections;
    for (list, connections) in [("added", added), ("removed", removed)] {
        for (i, connection) in connections.iter().enumerate() {
            for (end, is) in ["from", "to"].into_iter().zip(connection.is_of(&junction.arms)) {
                if !is {
                    let pointer = format!("/connections/{list}/{i}/{end}");
                    faults.push(ParameterFault::new(pointer, "there is no such lane"));
                }
            }
            if list == "removed" && added.contains(connection) {
                let pointer = format!("/connections/{list}/{i}");
                faults.push(ParameterFault::new(pointer, "it is added as well"));
            }
        }
    }
}

fn keep_apart(arms: &[Arm], faults: &mut Vec<ParameterFault>) {
    for (i, arm) in arms.iter().enumerate() {
        let near = |other: &Arm| {
            let between = (arm.angle_deg - other.angle_deg).rem_euclid(360.0);
            between.min(360.0 - between) < LEAST_BETWEEN_ARMS_DEG - 1e-9
        };
        if arms[..i].iter().any(near) {
            let reason = format!("Arms need {LEAST_BETWEEN_ARMS_DEG}° between them");
            faults.push(ParameterFault::new(format!("/arms/{i}/angle_deg"), reason));
        }
    }
}
