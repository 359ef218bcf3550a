//! Parsing of the outermost object. Serde's flatten would hold every unknown member in memory before it could
//! be refused.

use super::any::{AnyDoc, AnyValues, MAX_VALUES};
use super::document::SceneDoc;
use super::value::{MAX_MEMBERS, Members};
use crate::limits::{MAX_AGENTS, MAX_SIGNALS};
use crate::lists::Capped;
use serde::de::{Deserialize, Deserializer, Error, MapAccess, Visitor};
use std::collections::BTreeMap;
use std::fmt;

const MEMBERS: [&str; 10] =
    ["format", "version", "id", "name", "meta", "time", "map", "signals", "agents", "generated"];

impl<'de> Deserialize<'de> for SceneDoc {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_map(SceneVisitor)
    }
}

struct SceneVisitor;

/// Fails on any value, so that the fault has the place of the member.
struct Refused;

impl<'de> Deserialize<'de> for Refused {
    fn deserialize<D: Deserializer<'de>>(_: D) -> Result<Self, D::Error> {
        let known = MEMBERS.map(|name| format!("`{name}`")).join(", ");
        Err(D::Error::custom(format_args!("unknown member; {known} or names that begin with x_ expected")))
    }
}

/// Fills a slot; a second value for it is a fault.
fn once<'de, A: MapAccess<'de>, T: Deserialize<'de>>(
    slot: &mut Option<T>,
    name: &'static str,
    map: &mut A,
) -> Result<(), A::Error> {
    if slot.is_some() {
        return Err(A::Error::duplicate_field(name));
    }
    *slot = Some(map.next_value()?);
    Ok(())
}

impl<'de> Visitor<'de> for SceneVisitor {
    type Value = SceneDoc;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("an object")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<SceneDoc, A::Error> {
        let (mut format, mut version, mut id, mut name) = (None, None, None, None);
        let (mut meta, mut time, mut map_field, mut generated) = (None, None, None, None);
        let mut signals: Option<Capped<_, { MAX_SIGNALS + 1 }>> = None;
        let mut agents: Option<Capped<_, { MAX_AGENTS + 1 }>> = None;
        let (mut extra, mut values) = (BTreeMap::new(), AnyValues::up_to(MAX_VALUES));
        while let Some(key) = map.next_key::<String>()? {
            match key.as_str() {
                "format" => once(&mut format, "format", &mut map)?,
                "version" => once(&mut version, "version", &mut map)?,
                "id" => once(&mut id, "id", &mut map)?,
                "name" => once(&mut name, "name", &mut map)?,
                "meta" => once(&mut meta, "meta", &mut map)?,
                "time" => once(&mut time, "time", &mut map)?,
                "map" => once(&mut map_field, "map", &mut map)?,
                "signals" => once(&mut signals, "signals", &mut map)?,
                "agents" => once(&mut agents, "agents", &mut map)?,
                "generated" => once(&mut generated, "generated", &mut map)?,
                own if own.starts_with("x_") => {
                    if extra.contains_key(own) {
                        return Err(A::Error::custom(format_args!("duplicate field `{own}`")));
                    }
                    if extra.len() >= MAX_MEMBERS {
                        return Err(A::Error::custom(format_args!("more than {MAX_MEMBERS} own members")));
                    }
                    let value = map.next_value_seed(values.read())?;
                    extra.insert(key, AnyDoc(value));
                }
                _ => {
                    map.next_value::<Refused>()?;
                }
            }
        }
        let missing = A::Error::missing_field;
        Ok(SceneDoc {
            format: format.ok_or_else(|| missing("format"))?,
            version: version.ok_or_else(|| missing("version"))?,
            id: id.unwrap_or_default(),
            name: name.unwrap_or_default(),
            meta: meta.unwrap_or_default(),
            time: time.ok_or_else(|| missing("time"))?,
            map: map_field.ok_or_else(|| missing("map"))?,
            signals: signals.map_or_else(Vec::new, |list| list.0),
            agents: agents.map_or_else(Vec::new, |list| list.0),
            generated: generated.unwrap_or_default(),
            extra: Members(extra),
        })
    }
}
