//! `dragtraffic place`: the operation of `POST /v1/place`, from file to file.

use super::inputs::{Inputs, Item, Reading, Source, no_ids};
use super::output::{self, Folder};
use super::progress::Progress;
use super::tally::Tally;
use super::values::{For, for_one, index, share, whole, within};
use super::{Common, Failure, parallel, pointers};
use api::Operations;
use api::place::PlaceBody;
use api::place::request::{ArrivalsDoc, DensityDoc, ParkedDoc, RegionDoc, SpeedsDoc};
use clap::Args;
use experts::Cancel;
use experts::placement::{ArmTraffic, MAX_COUNT, MAX_GAP_M, MAX_PER_HOUR, MAX_PER_LANE_KM, MAX_SPEED_MPS};
use formats::native::{self, MAX_SAFE_INTEGER, MapForm, Members, SceneDoc};
use serde_json::Value;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Flags of `place`.
#[derive(Args, Clone, Debug)]
pub struct PlaceArgs {
    #[command(flatten)]
    inputs: Inputs,
    /// Scenes to take from each file, counted from 0: a number, or FIRST..LAST (both included). Default: the
    /// first for one output file, all for a folder.
    #[arg(long, value_name = "WHICH", value_parser = index)]
    index: Option<Range<usize>>,
    /// Road users per kilometre of lane. Default: 12, unless --count is given.
    #[arg(long, conflicts_with = "count", value_name = "PER_KM", value_parser = within(0.0, MAX_PER_LANE_KM, "for a kilometre"))]
    density: Option<f64>,
    /// Number of road users.
    #[arg(long, value_parser = clap::value_parser!(u64).range(1..=MAX_COUNT as u64))]
    count: Option<u64>,
    /// Share of each type, such as vehicle=0.8,pedestrian=0.15,cyclist=0.05. Default: the learned shares.
    #[arg(long, value_delimiter = ',', value_name = "TYPE=SHARE", value_parser = for_one(share))]
    types: Vec<For<f64>>,
    /// File with a GeoJSON polygon in the frame of the scene, m. Default: the whole map.
    #[arg(long, value_name = "FILE")]
    region: Option<PathBuf>,
    /// Scene time at which the road users start, s.
    #[arg(long, value_name = "SECONDS", default_value_t = PlaceBody::default().start_s, value_parser = within(0.0, 59.9, "seconds"))]
    start_time: f64,
    /// Seed of the random draws; equal seeds give equal answers.
    #[arg(long, allow_negative_numbers = true, default_value_t = PlaceBody::default().seed, value_parser = whole(0, MAX_SAFE_INTEGER))]
    seed: u64,
    /// Road users of the scene to keep (--keep=6,7); --keep alone keeps none. Default: all.
    #[arg(long, value_delimiter = ',', num_args = 0..=1, require_equals = true, default_missing_value = "", value_name = "ID")]
    keep: Option<Vec<String>>,
    /// Minimum gap between vehicles along a lane, m.
    #[arg(long, default_value_t = PlaceBody::default().min_gap_m, value_name = "METRES", value_parser = within(0.0, MAX_GAP_M, "metres"))]
    min_gap: f64,
    /// Range of start speeds of moving motor vehicles, such as 8..14, m/s. Default: the speeds typical of
    /// each road.
    #[arg(long, value_name = "FROM..TO", value_parser = speeds)]
    speeds: Option<[f64; 2]>,
    /// Motor vehicles per hour that arrive on an arm, such as north=600,west-2=300; --arms lists the arms.
    /// All other road users then need --count or --density.
    #[arg(long, value_delimiter = ',', value_name = "ARM=PER_HOUR", value_parser = for_one(per_hour))]
    arrivals: Vec<For<f64>>,
    /// Share of the parking places at kerbs and in car parks that are occupied, 0 to 1.
    #[arg(long, value_name = "SHARE", value_parser = within(0.0, 1.0, ""))]
    parked: Option<f64>,
    /// Print the arms of the first scene as a CSV table; place no road user.
    #[arg(long)]
    arms: bool,
    /// File for the scene with its road users, or a folder (DIR/) for one file per scene; - is standard
    /// output.
    #[arg(short, long, value_name = "FILE|DIR/")]
    output: Option<PathBuf>,
    /// Print the scene as JSON, also on a terminal.
    #[arg(long, conflicts_with = "output")]
    json: bool,
    /// Overwrite the output.
    #[arg(long)]
    force: bool,
}

/// Places road users and writes the scenes with them.
///
/// # Errors
/// Exit 2, 3, 4, 7, 8.
pub fn run(args: PlaceArgs, common: &Common) -> Result<(), Failure> {
    let sources = args.inputs.sources()?;
    if args.keep.is_some() {
        no_ids(&sources, "--keep")?;
    }
    let body = request(&args)?;
    let operations = common.operations()?;
    let work = Work { args: &args, body: &body, operations: &operations };
    let reading = Reading { index: args.index.clone(), ..Reading::default() };
    if args.arms {
        return tell_arms(&work, &sources, &reading);
    }
    let folder = args.output.as_deref().filter(|path| Folder::named(path));
    let Some(path) = folder else {
        let [source] = sources.as_slice() else {
            return Err(Failure::usage(
                "several scenes: give a folder, --output DIR/, for one file per scene",
            ));
        };
        let (bytes, told) = work.place(source, source.first(&reading)?)?;
        told.iter().for_each(|line| common.say(line));
        return output::write_scene(args.output.as_deref(), &bytes, args.force, args.json);
    };
    let folder = Folder::new(path, args.force)?;
    let progress = Progress::new("files", sources.len() as u64, common.quiet);
    let mut tally = Tally::default();
    let one = |source: &Source| {
        let mut lines = Vec::new();
        source.each(&reading, &mut |item| {
            let name = format!("{}.json", item.name);
            let (bytes, told) = work.place(source, item)?;
            let path = folder.write(&name, &bytes)?;
            lines.push(format!("{}: {}", path.display(), told.join("; ")));
            Ok(())
        })?;
        Ok(lines)
    };
    parallel::in_order(&sources, args.inputs.workers(), one, |_, done: Result<Vec<String>, Failure>| {
        let done = done.map(|lines| lines.iter().for_each(|line| progress.line(line)));
        tally.add(done, sources.len() == 1, &progress);
        progress.step();
    });
    drop(progress);
    tally.end("files")
}

/// Parses `8..14`.
fn speeds(text: &str) -> Result<[f64; 2], String> {
    let speed = within(0.0, MAX_SPEED_MPS, "m/s");
    let (from, to) = text.split_once("..").ok_or("FROM..TO expected, as in 8..14")?;
    let [from, to] = [speed(from)?, speed(to)?];
    if from <= to { Ok([from, to]) } else { Err("the lower speed first".into()) }
}

fn per_hour(text: &str) -> Result<f64, String> {
    within(0.0, MAX_PER_HOUR, "vehicles an hour")(text)
}

struct Work<'a> {
    args: &'a PlaceArgs,
    body: &'a PlaceBody,
    operations: &'a Operations,
}

impl Work<'_> {
    /// The scene with its new road users as a file, and lines about them.
    fn place(&self, source: &Source, item: Item) -> Result<(Vec<u8>, Vec<String>), Failure> {
        let scene = Arc::new(item.scene);
        let placement = self
            .operations
            .place(self.body, &scene, &Cancel::default())
            .map_err(|problem| pointers::refused(source, &problem))?;
        let mut told = vec![format!("{} placed", placement.agents.len())];
        for ArmTraffic { arm, placed, later, .. } in placement.arms.iter().filter(|a| a.placed + a.later > 0)
        {
            told.push(format!("{}: {placed} at the start, {later} later", arm.id));
        }
        if let Some(reason) = &placement.reason {
            let unplaced: usize = placement.unplaced.values().sum();
            told.push(if unplaced > 0 { format!("{unplaced} not placed: {reason}") } else { reason.clone() });
        }
        let scene = self.body.placed(&scene, placement);
        Ok((native::write_doc(&SceneDoc::from_scene(&scene, MapForm::Inline)), told))
    }
}

/// Prints the arms of one scene, one line each.
fn tell_arms(work: &Work<'_>, sources: &[Source], reading: &Reading) -> Result<(), Failure> {
    let [source] = sources else { return Err(Failure::usage("--arms takes one scene")) };
    let scene = Arc::new(source.first(reading)?.scene);
    let placement = work.operations.place(work.body, &scene, &Cancel::default());
    let placement = placement.map_err(|problem| pointers::refused(source, &problem))?;
    let mut text = String::from("arm,x_m,y_m,lanes,length_m,most_per_hour\n");
    for ArmTraffic { arm, length_m, most_per_hour, .. } in &placement.arms {
        let (x, y) = (arm.position.x, arm.position.y);
        text += &format!("{},{x:.1},{y:.1},{},{length_m:.0},{most_per_hour}\n", arm.id, arm.lanes.len());
    }
    output::write(work.args.output.as_deref(), text.as_bytes(), work.args.force)
}

/// The request of the flags.
fn request(args: &PlaceArgs) -> Result<PlaceBody, Failure> {
    let density = match (args.count, args.density) {
        (None, None) => None,
        (count, per_lane_km) => Some(DensityDoc { per_lane_km, count }),
    };
    let shares = args.types.iter().map(|given| (given.id.clone(), given.value)).collect();
    let arrivals = args.arrivals.iter();
    let named = |keep: &Vec<String>| keep.iter().filter(|id| !id.is_empty()).cloned().collect();
    Ok(PlaceBody {
        region: args.region.as_deref().map(region).transpose()?,
        density,
        types: (!args.types.is_empty()).then_some(Members(shares)),
        keep: args.keep.as_ref().map(named),
        start_s: args.start_time,
        seed: args.seed,
        min_gap_m: args.min_gap,
        speeds: args.speeds.map(|[min_mps, max_mps]| SpeedsDoc { min_mps, max_mps }),
        arrivals: arrivals
            .map(|given| ArrivalsDoc { arm: given.id.clone(), per_hour: given.value })
            .collect(),
        parked: args.parked.map(|share| ParkedDoc { share: Some(share), per_100m: None }),
        ..PlaceBody::default()
    })
}

fn region(path: &Path) -> Result<RegionDoc, Failure> {
    let value: Option<Value> = serde_json::from_slice(&output::read(path)?).ok();
    let ring = value.as_ref().and_then(polygon).ok_or_else(|| not_a_polygon(path))?;
    Ok(RegionDoc { polygon_m: Some(ring), circle: None })
}

fn not_a_polygon(path: &Path) -> Failure {
    let message =
        format!("{}: a GeoJSON Polygon without holes expected, in metres of the scene", path.display());
    Failure::input(message)
}

/// Open outer ring of a Polygon, of a Feature with one, or of a collection with one such feature.
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
            // GeoJSON rings repeat their first point.
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
