//! Scenes as rows of the store.

use super::item::Facts;
use super::store::{MapRecord, SceneRecord};
use api::Problem;
use formats::native::{MapDoc, MapForm, SceneDoc};
use scene::map::Area;
use scene::{LaneMap, Scene};
use serde::de::{MapAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use serde_json::value::RawValue;
use std::fmt;

/// The row of a scene under an id. Marks its futures stale if they were made for another scene.
///
/// # Errors
/// When something cannot be written as JSON.
pub fn of_scene(mut scene: Scene, id: &str) -> Result<SceneRecord, Problem> {
    let input = scene.input_hash().hex();
    if let Some(generated) = &mut scene.generated {
        generated.stale = generated.input_sha256 != input;
    }
    scene.meta.created_with.get_or_insert_with(|| env!("CARGO_PKG_VERSION").to_owned());
    scene.id = Some(id.to_owned());
    let doc = SceneDoc::from_scene(&scene, MapForm::Ref);
    let (polylines, points) = size(&scene.map);
    let map = MapRecord { sha: scene.map.hash().hex(), polylines, points, json: Some(map_json(&scene.map)?) };
    Ok(SceneRecord {
        name: scene.name.clone(),
        tags: scene.meta.tags.clone(),
        parent_id: scene.meta.parent_id.clone(),
        meta: serde_json::to_string(&Facts::of(&scene)).map_err(Problem::internal)?,
        json: serde_json::to_vec(&doc).map_err(Problem::internal)?,
        shared: None,
        map,
    })
}

/// The row of a document whose map is stored.
///
/// # Errors
/// When it cannot be written as JSON.
pub fn of_doc(
    doc: &SceneDoc,
    parent_id: Option<String>,
    meta: String,
    map_sha: String,
) -> Result<SceneRecord, Problem> {
    Ok(SceneRecord {
        name: doc.name.clone(),
        tags: doc.meta.tags.clone(),
        parent_id,
        meta,
        json: serde_json::to_vec(doc).map_err(Problem::internal)?,
        shared: None,
        map: MapRecord { sha: map_sha, polylines: 0, points: 0, json: None },
    })
}

/// Native JSON of a map.
///
/// # Errors
/// When it cannot be written as JSON.
pub fn map_json(map: &LaneMap) -> Result<Vec<u8>, Problem> {
    serde_json::to_vec(&MapDoc::from_map(map)).map_err(Problem::internal)
}

/// Number of lines (with areas) and points of a map.
pub fn size(map: &LaneMap) -> (usize, usize) {
    let lines = map.road_lines.iter().chain(&map.road_edges).map(|l| l.points.xy.len());
    let area =
        |area: &Area| area.polygon.xy.len() + area.holes.iter().map(|hole| hole.xy.len()).sum::<usize>();
    let areas = map.areas().map(area);
    let counts = map.lanes.iter().map(|l| l.points.xy.len()).chain(lines).chain(areas);
    counts.fold((0, 0), |(lines, points), n| (lines + 1, points + n))
}

/// A stored document with the reference replaced by its map; all other bytes stay unchanged.
///
/// # Errors
/// When the text is not a document with a map.
pub fn with_map(json: &[u8], map: &[u8]) -> Result<Vec<u8>, Problem> {
    let map: &RawValue = serde_json::from_slice(map).map_err(Problem::internal)?;
    let mut doc: OrderedObject<'_> = serde_json::from_slice(json).map_err(Problem::internal)?;
    let slot = doc.0.iter_mut().find(|(name, _)| name == "map");
    let (_, value) = slot.ok_or_else(|| Problem::internal("a stored scene has no map"))?;
    *value = map;
    serde_json::to_vec(&doc).map_err(Problem::internal)
}

/// Members of an object in their order, their values as text.
struct OrderedObject<'a>(Vec<(String, &'a RawValue)>);

impl<'de> Deserialize<'de> for OrderedObject<'de> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct OrderedVisitor;

        impl<'de> Visitor<'de> for OrderedVisitor {
            type Value = OrderedObject<'de>;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("an object")
            }

            fn visit_map<A: MapAccess<'de>>(self, mut access: A) -> Result<Self::Value, A::Error> {
                let mut members = Vec::new();
                while let Some(member) = access.next_entry()? {
                    members.push(member);
                }
                Ok(OrderedObject(members))
            }
        }

        deserializer.deserialize_map(OrderedVisitor)
    }
}

impl Serialize for OrderedObject<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().map(|(name, value)| (name, value)))
    }
}

#[cfg(test)]
mod tests {
    use super::with_map;

    #[test]
    fn the_map_takes_the_place_of_its_reference() {
        let stored =
            br#"{"name":"a \"map\":{\"ref\":1}","n":1.50,"map":{"ref":"sha256:aa"},"x_map":{"map":1}}"#;
        let whole = with_map(stored, br#"{"lanes":[]}"#).unwrap();
        let expected = r#"{"name":"a \"map\":{\"ref\":1}","n":1.50,"map":{"lanes":[]},"x_map":{"map":1}}"#;
        assert_eq!(String::from_utf8(whole).unwrap(), expected);
    }

    #[test]
    fn a_document_without_a_map_is_a_defect() {
        assert!(with_map(br#"{"name":"a"}"#, b"{}").is_err());
        assert!(with_map(br#"{"map":{}"#, b"{}").is_err());
        assert!(with_map(br#"{"map":{}}"#, b"").is_err());
    }
}
