//! One road network that a foreign program wrote in several formats is the same lane graph here. The folder with
//! its files is made by `cargo xtask test maps` (`tests/equal_maps.py`), which names it in the environment.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    clippy::print_stdout,
    reason = "a test stops at the first surprise"
)]

use formats::{ImportOptions, registry};
use scene::Vec2;
use scene::map::LaneType;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

const VARIABLE: &str = "DRAGTRAFFIC_EQUAL_MAPS";
/// Tolerance of lengths, widths and ends, metres.
const SAME_M: f64 = 0.05;
/// Lanes of two maps match if both ends are within this distance, metres.
const MATCH_M: f64 = 0.5;

struct Lane {
    ends: [Vec2; 2],
    length_m: f64,
    width_m: Option<f64>,
    limit_mps: Option<f64>,
    successors: Vec<String>,
    through: bool,
}

type Lanes = BTreeMap<String, Lane>;

/// Parts of the lane graph that a format keeps.
struct Carries {
    /// Ways through junctions as they are.
    ways: bool,
    widths: bool,
    /// Which lane follows which, and limits.
    graph: bool,
}

/// The lanes of a file, and what the file lacks according to its reader.
fn lanes(path: &Path) -> (Lanes, Vec<&'static str>) {
    let bytes = std::fs::read(path).unwrap();
    let name = path.file_name().unwrap().to_string_lossy();
    let list = registry::import(&bytes, &name, "auto", &ImportOptions::default()).unwrap();
    let (scene, warnings) = list.into_iter().next().unwrap().unwrap();
    let origin = Vec2::new(scene.meta.origin.x_m, scene.meta.origin.y_m);
    let driven = scene.map.lanes.iter().filter(|lane| lane.lane_type != LaneType::Sidewalk);
    let lane = |lane: &scene::map::Lane| {
        let points = &lane.points.xy;
        let length_m = formats::polyline::length(points);
        Lane {
            ends: [points[0] + origin, points[points.len() - 1] + origin],
            length_m,
            width_m: lane.width_m,
            limit_mps: lane.speed_limit_mps,
            successors: lane.successors.clone(),
            through: lane.interpolating,
        }
    };
    (driven.map(|l| (l.id.clone(), lane(l))).collect(), warnings.iter().map(|warning| warning.code).collect())
}

/// The lane of `other` with the same ends, by the id of each lane.
fn matched<'a>(
    lanes: &'a Lanes,
    other: &'a Lanes,
    keep: impl Fn(&Lane) -> bool,
) -> BTreeMap<&'a str, &'a str> {
    let gap = |a: &Lane, b: &Lane| (a.ends[0] - b.ends[0]).norm().max((a.ends[1] - b.ends[1]).norm());
    let nearest = |lane: &Lane| other.iter().min_by(|a, b| gap(lane, a.1).total_cmp(&gap(lane, b.1)));
    let same = |(id, lane): (&'a String, &'a Lane)| {
        let (found, candidate) = nearest(lane)?;
        (keep(lane) && gap(lane, candidate) < MATCH_M).then_some((id.as_str(), found.as_str()))
    };
    lanes.iter().filter_map(same).collect()
}

/// Lanes of `names` that are reached from each of them, by whatever lies between.
fn links<'a>(lanes: &'a Lanes, names: &BTreeMap<&'a str, &'a str>) -> BTreeSet<(String, String)> {
    let mut found = BTreeSet::new();
    for (id, own) in names {
        let (mut open, mut seen) = (lanes[*id].successors.clone(), BTreeSet::new());
        while let Some(next) = open.pop() {
            let Some(lane) = lanes.get(&next).filter(|_| seen.insert(next.clone())) else { continue };
            match names.get(next.as_str()) {
                Some(other) => drop(found.insert(((*own).to_owned(), (*other).to_owned()))),
                None => open.extend(lane.successors.iter().cloned()),
            }
        }
    }
    found
}

#[test]
#[ignore = "needs maps of netconvert: cargo xtask test maps writes them and runs this test"]
fn one_network_in_several_formats_is_one_lane_graph() {
    let folder = std::env::var_os(VARIABLE).unwrap();
    let folder = Path::new(&folder);
    let (first, _) = lanes(&folder.join("map.xodr"));
    assert_eq!((first.len(), first.values().filter(|lane| lane.through).count()), (30, 14));
    let own: BTreeMap<&str, &str> = first.keys().map(|id| (id.as_str(), id.as_str())).collect();
    let carries = |ways, widths, graph| Carries { ways, widths, graph };
    // SUMO redraws the ways through junctions and shortens some, so only the lanes of roads are equal.
    // Waymo's messages have no widths. GPUDrive has only lane centre lines.
    let files = [
        ("map.osm", carries(true, true, true)),
        ("map.tfrecord", carries(true, false, true)),
        ("map.net.xml", carries(false, true, true)),
        ("map.json", carries(true, false, false)),
    ];
    for (file, carries) in files {
        let (other, lost) = lanes(&folder.join(file));
        assert_eq!(lost.contains(&"no-lane-graph"), !carries.graph, "{file}: {lost:?}");
        assert!(other.values().all(|lane| lane.width_m.is_some() == carries.widths), "{file}: widths");
        assert!(other.values().all(|lane| lane.limit_mps.is_some() == carries.graph), "{file}: limits");
        let compared = |lane: &Lane| carries.ways || !lane.through;
        let pairs = matched(&first, &other, compared);
        assert_eq!(pairs.len(), first.values().filter(|lane| compared(lane)).count(), "{file}: lanes");
        let (mut longest, mut widest) = (0.0_f64, 0.0_f64);
        for (id, found) in &pairs {
            let (a, b) = (&first[*id], &other[*found]);
            longest = longest.max((a.length_m - b.length_m).abs());
            for k in 0..2 {
                longest = longest.max((a.ends[k] - b.ends[k]).norm());
            }
            if carries.widths {
                widest = widest.max((a.width_m.unwrap() - b.width_m.unwrap()).abs());
            }
            if carries.graph {
                assert!((a.limit_mps.unwrap() - b.limit_mps.unwrap()).abs() < 0.02, "{file}: limit of {id}");
            }
        }
        let widths = if carries.widths { format!("{widest:.3} m") } else { "not carried".to_owned() };
        println!("{file}: {} lanes, lengths within {longest:.3} m, widths: {widths}", pairs.len());
        assert!(longest < SAME_M && widest < SAME_M, "{file}: {longest} m long, {widest} m wide");
        let names: BTreeMap<&str, &str> = pairs.iter().map(|(id, found)| (*found, *id)).collect();
        assert_eq!(names.len(), pairs.len(), "{file}: two lanes are the same one");
        let kept = own.iter().filter(|(id, _)| pairs.contains_key(*id)).map(|(a, b)| (*a, *b)).collect();
        let (found, expected) = (links(&other, &names), links(&first, &kept));
        println!("{file}: {} of {} links", found.len(), expected.len());
        assert_eq!(found, expected, "{file}: links");
    }
}
