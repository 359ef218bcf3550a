//! `dragtraffic place`: the same work as `POST /v1/place`, from file to file.

use super::files::read_scene;
use super::{Common, Exit, Failure, output};
use crate::routes::place::PlaceBody;
use clap::Args;
use experts::Cancel;
use formats::native::{self, MapForm, SceneDoc};
use scene::Scene;
use serde_json::{Map, Value, json};
use std::collections::HashSet;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Flags of `place`.
#[derive(Args, Clone, Debug)]
pub struct PlaceArgs {
    /// Scene to read, of any format; - is stdin.
    scene: PathBuf,
    /// Road users for each kilometre of lane.
    #[arg(long, conflicts_with = "count", value_name = "PER_KM")]
    density: Option<f64>,
    /// Road users in all.
    #[arg(long)]
    count: Option<u64>,
    /// Share of each type, such as vehicle=0.8,pedestrian=0.15,cyclist=0.05.
    #[arg(long, value_delimiter = ',', value_name = "TYPE=SHARE")]
    types: Vec<String>,
    /// GeoJSON polygon in metres of the scene; the whole map when absent.
    #[arg(long, value_name = "FILE")]
    region: Option<PathBuf>,
    /// Scene time at which they start, seconds.
    #[arg(long, default_value_t = 0.0)]
    at: f64,
    /// The same seed gives the same answer.
    #[arg(long, default_value_t = 0)]
    seed: u64,
    /// Road users of the scene that stay, with commas; without ids nobody, without the flag all.
    #[arg(long, value_delimiter = ',', num_args = 0.., value_name = "ID")]
    keep: Option<Vec<String>>,
    /// Least room along the lane between those who drive, metres.
    #[arg(long, default_value_t = 2.0, value_name = "METRES")]
    min_gap: f64,
    /// File to write the scene with its new road users to; - or absent is stdout.
    #[arg(short, long)]
    output: Option<PathBuf>,
    /// Overwrite the output.
    #[arg(long)]
    force: bool,
}

/// Places road users and writes the scene with them.
///
/// # Errors
/// Exit 2, 3, 7, 8.
pub fn run(args: PlaceArgs, common: &Common) -> Result<(), Failure> {
    let mut scene = read_scene(&args.scene)?;
    let body: PlaceBody = serde_json::from_value(body(&args)?)
        .map_err(|error| Failure::new(Exit::Usage, format!("options: {error}")))?;
    let placer = super::engine(common)?.placer;
    let shared = Arc::new(scene.clone());
    let placement = body
        .run(&shared, &placer, &Cancel::default())
        .map_err(|problem| super::files::refused(&args.scene, &problem))?;
    if let Some(reason) = &placement.reason {
        let unplaced: usize = placement.unplaced.values().sum();
        output::complain(&format!("{unplaced} not placed: {reason}"));
    }
    if let Some(keep) = &args.keep {
        let keep: HashSet<&String> = keep.iter().collect();
        scene.agents.retain(|agent| keep.contains(&agent.id));
    }
    scene.agents.extend(placement.agents);
    // Futures of a scene with other road users in it mean nothing.
    scene.generated = None;
    write(&scene, &args)
}

fn write(scene: &Scene, args: &PlaceArgs) -> Result<(), Failure> {
    let bytes = native::write_doc(&SceneDoc::from_scene(scene, MapForm::Inline));
    output::write(args.output.as_deref(), &bytes, args.force)
}

/// The body of `POST /v1/place` that says the same.
fn body(args: &PlaceArgs) -> Result<Value, Failure> {
    let mut body = Map::new();
    body.insert("at_s".into(), json!(args.at));
    body.insert("seed".into(), json!(args.seed));
    body.insert("min_gap_m".into(), json!(args.min_gap));
    if let Some(keep) = &args.keep {
        body.insert("keep".into(), json!(keep.iter().filter(|id| !id.is_empty()).collect::<Vec<_>>()));
    }
    if let Some(count) = args.count {
        body.insert("density".into(), json!({ "count": count }));
    } else if let Some(density) = args.density {
        body.insert("density".into(), json!({ "per_lane_km": density }));
    }
    if !args.types.is_empty() {
        let mut types = Map::new();
        for text in &args.types {
            let wrong = || Failure::new(Exit::Usage, format!("--types {text}: TYPE=SHARE expected"));
            let (name, share) = text.split_once('=').ok_or_else(wrong)?;
            let share: f64 = share.trim().parse().ok().filter(|v: &f64| v.is_finite()).ok_or_else(wrong)?;
            types.insert(name.trim().to_owned(), json!(share));
        }
        body.insert("types".into(), Value::Object(types));
    }
    if let Some(path) = &args.region {
        let bytes = output::read(path)?;
        let ring = serde_json::from_slice(&bytes).ok().as_ref().and_then(polygon);
        let ring = ring.ok_or_else(|| not_a_polygon(path))?;
        body.insert("region".into(), json!({ "polygon_m": ring }));
    }
    Ok(Value::Object(body))
}

fn not_a_polygon(path: &Path) -> Failure {
    let message =
        format!("{}: a GeoJSON Polygon without holes expected, in metres of the scene", path.display());
    Failure::new(Exit::Input, message)
}

/// Open outer ring of a Polygon, of a Feature that is one, or of a collection of one such feature.
fn polygon(value: &Value) -> Option<Vec<[f64; 2]>> {
    match value.get("type")?.as_str()? {
        "FeatureCollection" => match value.get("features")?.as_array()?.as_slice() {
            [one] => polygon(one),
            _ => None,
        },
        "Feature" => value.get("geometry").filter(|g| g["type"] == "Polygon").and_then(polygon),
        "Polygon" => {
            let [ring] = value.get("coordinates")?.as_array()?.as_slice() else { return None };
            let corner = |c: &Value| Some([c.get(0)?.as_f64()?, c.get(1)?.as_f64()?]);
            let mut ring = ring.as_array()?.iter().map(corner).collect::<Option<Vec<_>>>()?;
            // GeoJSON closes its rings.
            if ring.len() > 1 && ring.first() == ring.last() {
                ring.pop();
            }
            Some(ring)
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::polygon;
    use serde_json::json;

    #[test]
    fn rings_of_geojson() {
        let ring = json!([[[0, 0], [4, 0], [4, 3], [0, 0]]]);
        let shape = json!({"type": "Polygon", "coordinates": ring});
        let feature = json!({"type": "Feature", "properties": {}, "geometry": shape});
        let expected = Some(vec![[0.0, 0.0], [4.0, 0.0], [4.0, 3.0]]);
        assert_eq!(polygon(&shape), expected);
        assert_eq!(polygon(&json!({"type": "FeatureCollection", "features": [feature]})), expected);
        assert_eq!(polygon(&json!({"type": "FeatureCollection", "features": [feature, feature]})), None);
        assert_eq!(polygon(&json!({"type": "Polygon", "coordinates": [[[0, 0]], [[1, 1]]]})), None);
        assert_eq!(polygon(&json!({"type": "Point", "coordinates": [0, 0]})), None);
        assert_eq!(polygon(&json!({"type": "Polygon", "coordinates": [[[0, "a"]]]})), None);
    }
}
