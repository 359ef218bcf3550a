//! The page of a batch: cases with their motion, maps and coverage in one file that works offline.

use batch::coverage::dimension::CoverageDimension;
use batch::coverage::document::CoverageDocument;
use batch::coverage::table::CoverageTable;
use batch::row::BatchRow;
use formats::polyline::simplify;
use scene::map::LaneType;
use scene::{LaneMap, Vec2};
use serde_json::{Value, json};
use std::collections::BTreeMap;

const PAGE: &str = include_str!("page/page.html");
const STYLE: &str = include_str!("page/page.css");
/// The scripts, in execution order.
const SCRIPTS: [&str; 5] = [
    include_str!("page/cases.js"),
    include_str!("page/picture.js"),
    include_str!("page/table.js"),
    include_str!("page/coverage.js"),
    include_str!("page/main.js"),
];
/// Limit of the bytes of all maps; cases of further scenes are drawn without a map.
pub const MOST_MAP_BYTES: usize = 24 << 20;
/// Greatest distance of a drawn line from the map's, metres.
const TOLERANCE_M: f64 = 0.25;
/// Longest piece of a drawn line, metres.
const LONGEST_M: f64 = 1e4;

/// A case of the page.
pub struct PageCase {
    /// Id of its unit.
    pub unit: String,
    /// Hash of its scene.
    pub scene: String,
    body: Value,
}

impl PageCase {
    /// The case of a row.
    pub fn of(row: BatchRow, dimensions: &[CoverageDimension]) -> Self {
        let bucket = |of: &CoverageDimension| of.bucket(Some(&row.situation), &row.facts);
        let buckets: Vec<Option<usize>> = dimensions.iter().map(bucket).collect();
        // Two decimals are more than the page shows.
        let short = |value: f64| (value * 100.0).round() / 100.0 + 0.0;
        let number = |name: &str| row.facts.numbers.get(name).copied().map(short);
        let numbers = ["ttc_s", "pet_s", "gap_m", "actor_mps", "other_mps", "time_s"].map(number);
        let other = row.facts.words.get("other").or(row.other.as_ref());
        let body = json!([row.code, row.actor, other, row.what, row.seed, buckets, numbers]);
        Self { unit: row.unit, scene: row.scene, body }
    }
}

/// A scene of the page.
pub struct PageScene {
    /// Its name in the page.
    pub name: String,
    /// Its map as JSON.
    pub map: String,
}

impl PageScene {
    /// A scene with its map.
    pub fn of(name: &str, map: &LaneMap) -> Self {
        let lanes: Vec<Value> = (map.lanes.iter())
            .map(|lane| {
                let kind = match lane.lane_type {
                    LaneType::BikeLane => 1,
                    LaneType::Sidewalk => 2,
                    _ => 0,
                };
                json!([kind, decimetres(lane.width_or_assumed_m()), line(&lane.points.xy)])
            })
            .collect();
        let edges: Vec<Value> = map.road_edges.iter().map(|edge| line(&edge.points.xy)).collect();
        let crosswalks: Vec<Value> = map.crosswalks.iter().map(|area| line(&area.polygon.xy)).collect();
        let map = json!({"lanes": lanes, "edges": edges, "crosswalks": crosswalks});
        Self { name: name.to_owned(), map: map.to_string() }
    }

    /// The scene without its map.
    pub fn without_map(self) -> Self {
        Self { map: "null".into(), ..self }
    }
}

fn decimetres(metres: f64) -> i32 {
    (metres * 10.0).round() as i32
}

/// First point, then differences between neighbours, decimetres.
fn line(points: &[Vec2]) -> Value {
    let mut before = [0, 0];
    let flat = simplify(points, TOLERANCE_M, LONGEST_M).into_iter().flat_map(|point| {
        let now = [decimetres(point.x), decimetres(point.y)];
        let step = [now[0].saturating_sub(before[0]), now[1].saturating_sub(before[1])];
        before = now;
        step
    });
    flat.collect::<Vec<i32>>().into()
}

/// Everything that the page shows.
pub struct CasePage<'a> {
    /// Number of completed units.
    pub units: u64,
    /// Number of kept results; the page may show fewer.
    pub kept: u64,
    /// Its cases.
    pub cases: Vec<PageCase>,
    /// Their motions, one line of JSON each.
    pub motions: Vec<String>,
    /// Scenes by hash.
    pub scenes: BTreeMap<String, PageScene>,
    /// Coverage document.
    pub coverage: &'a CoverageDocument,
    /// Table of the coverage counts.
    pub table: &'a CoverageTable,
}

impl CasePage<'_> {
    /// The file. Equal results give equal bytes.
    pub fn bytes(&self) -> Vec<u8> {
        let places: BTreeMap<&String, usize> =
            self.scenes.keys().enumerate().map(|(i, key)| (key, i)).collect();
        let place = |case: &PageCase| places.get(&case.scene).copied();
        let cases: Vec<Value> =
            self.cases.iter().map(|case| json!([place(case), case.unit.get(..12), case.body])).collect();
        let names: Vec<&str> = self.scenes.values().map(|scene| scene.name.as_str()).collect();
        let space: Vec<[u64; 2]> = self.table.space.cells().collect();
        let data = json!({
            "units": self.units, "kept": self.kept, "scenes": names, "cases": cases,
            "coverage": self.coverage, "space": space,
        });
        let maps: Vec<&str> = self.scenes.values().map(|scene| scene.map.as_str()).collect();
        let parts = [
            ("/* {{style}} */", STYLE.to_owned()),
            ("{{data}}", safe(&data.to_string())),
            ("{{maps}}", safe(&maps.join("\n"))),
            ("{{motions}}", safe(&self.motions.join("\n"))),
            ("/* {{script}} */", SCRIPTS.concat()),
        ];
        // In one pass, because a scene's name may look like a placeholder.
        let (mut page, mut rest) = (String::new(), PAGE);
        for (place, text) in parts {
            let (before, after) = rest.split_once(place).unwrap_or((rest, ""));
            page.push_str(before);
            page.push_str(&text);
            rest = after;
        }
        page.push_str(rest);
        page.into_bytes()
    }
}

/// Escapes JSON for a script element, so that nothing looks like markup.
fn safe(json: &str) -> String {
    json.replace('<', "\\u003c")
}
