//! Logs and maps of nuPlan as scenes, from a writer of both after the published schema.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test stops at the first surprise")]

use formats::{ImportOptions, Imported, ReadError, Source, registry};
use rusqlite::{Connection, MAIN_DB, params};
use scene::{AgentType, Scene, SignalState, Subtype, Vec2};
use std::sync::Arc;

/// South-west corner of what is drawn: a place in Las Vegas, in metres of zone 11, and in degrees.
const CORNER: [f64; 2] = [664_000.0, 3_997_000.0];
/// Degrees of the corner, of 1 m to the east and of 1 m to the north; a plane is good for this to a few millimetres.
const DEGREES: [[f64; 2]; 3] = [
    [-115.178_061_692_660_69, 36.103_815_656_361_49],
    [1.110_431_994e-5, -1.689_561_7e-7],
    [2.081_422_37e-7, 9.011_216_088e-6],
];

fn bytes_of(mut database: Connection) -> Vec<u8> {
    database.serialize(MAIN_DB).unwrap().to_vec()
}

fn token(kind: u8, number: i64) -> [u8; 8] {
    let mut token = number.to_be_bytes();
    token[0] = kind;
    token
}

/// Columns of a log that are read, and some that are not.
const LOG: &str = "
    CREATE TABLE log (token BLOB NOT NULL, vehicle_name VARCHAR(64), date VARCHAR(64), timestamp INTEGER,
        logfile VARCHAR(64), location VARCHAR(64), map_version VARCHAR(64), PRIMARY KEY (token));
    CREATE TABLE scene (token BLOB NOT NULL, log_token BLOB NOT NULL, name TEXT, goal_ego_pose_token BLOB,
        roadblock_ids TEXT, PRIMARY KEY (token));
    CREATE TABLE lidar_pc (token BLOB NOT NULL, next_token BLOB, prev_token BLOB, ego_pose_token BLOB NOT NULL,
        lidar_token BLOB NOT NULL, scene_token BLOB, filename VARCHAR(128), timestamp INTEGER, PRIMARY KEY (token));
    CREATE TABLE ego_pose (token BLOB NOT NULL, timestamp INTEGER, x FLOAT, y FLOAT, z FLOAT, qw FLOAT, qx FLOAT,
        qy FLOAT, qz FLOAT, vx FLOAT, vy FLOAT, vz FLOAT, epsg INTEGER, log_token BLOB NOT NULL, PRIMARY KEY (token));
    CREATE TABLE lidar_box (token BLOB NOT NULL, lidar_pc_token BLOB NOT NULL, track_token BLOB NOT NULL,
        next_token BLOB, prev_token BLOB, x FLOAT, y FLOAT, z FLOAT, width FLOAT, length FLOAT, height FLOAT,
        vx FLOAT, vy FLOAT, vz FLOAT, yaw FLOAT, confidence FLOAT, PRIMARY KEY (token));
    CREATE INDEX boxes_of_sweeps ON lidar_box (lidar_pc_token);
    CREATE TABLE track (token BLOB NOT NULL, category_token BLOB NOT NULL, width FLOAT, length FLOAT, height FLOAT,
        PRIMARY KEY (token));
    CREATE TABLE category (token BLOB NOT NULL, name VARCHAR(64), description TEXT, PRIMARY KEY (token));
    CREATE TABLE scenario_tag (token BLOB NOT NULL, lidar_pc_token BLOB NOT NULL, type TEXT, agent_track_token BLOB,
        PRIMARY KEY (token));
    CREATE TABLE traffic_light_status (token BLOB NOT NULL, lidar_pc_token BLOB NOT NULL, lane_connector_id INTEGER,
        status VARCHAR(8), PRIMARY KEY (token));";

/// Two scenes of 2 s at 20 Hz, of which the second comes first in the tables. The ego's rear axle goes north at 8 m/s
/// from 20 m north of the corner; a car goes east at 10 m/s; an adult, a bicycle and a cone stand. The light of
/// connector 70 turns from red to green after 1 s of the first scene.
fn log() -> Connection {
    let log = Connection::open_in_memory().unwrap();
    log.execute_batch(LOG).unwrap();
    let [x, y] = CORNER;
    let log_token = token(1, 1);
    log.execute(
        "INSERT INTO log VALUES (?, 'veh-35', '2021-05-12', 0, '2021.05.12_veh-35', 'las_vegas', 'us-nv-las-vegas-strip.gpkg')",
        params![log_token],
    )
    .unwrap();
    for (number, name) in [(1, "vehicle"), (2, "pedestrian"), (3, "bicycle"), (4, "traffic_cone")] {
        log.execute("INSERT INTO category VALUES (?, ?, '')", params![token(2, number), name]).unwrap();
        let size = [(1.9, 4.6, 1.6), (0.6, 0.7, 1.8), (0.7, 1.8, 1.5), (0.3, 0.3, 0.7)][number as usize - 1];
        log.execute(
            "INSERT INTO track VALUES (?, ?, ?, ?, ?)",
            params![token(3, number), token(2, number), size.0, size.1, size.2],
        )
        .unwrap();
    }
    let mut boxes = 0;
    for scene in [2, 1] {
        log.execute(
            "INSERT INTO scene VALUES (?, ?, ?, NULL, '1,2')",
            params![token(4, scene), log_token, format!("scene-{scene:03}")],
        )
        .unwrap();
        for sweep in 0..40 {
            let number = scene * 1_000 + sweep;
            let time = 1_620_857_889_600_000 + (scene * 40 + sweep) * 50_000;
            let along = 0.05 * sweep as f64;
            log.execute(
                "INSERT INTO lidar_pc VALUES (?, NULL, NULL, ?, ?, ?, '', ?)",
                params![token(5, number), token(6, number), token(7, 1), token(4, scene), time],
            )
            .unwrap();
            let half = std::f64::consts::FRAC_PI_4;
            log.execute(
                "INSERT INTO ego_pose VALUES (?, ?, ?, ?, 600.0, ?, 0.0, 0.0, ?, 8.0, 0.0, 0.0, 32611, ?)",
                params![
                    token(6, number),
                    time + 333,
                    x + 50.0,
                    y + 20.0 + 8.0 * along,
                    half.cos(),
                    half.sin(),
                    log_token
                ],
            )
            .unwrap();
            for (track, at, vx) in [
                (1, [10.0 + 10.0 * along, 50.0], 10.0),
                (2, [60.0, 45.0], 0.0),
                (3, [40.0, 30.0], 0.0),
                (4, [55.0, 55.0], 0.0),
            ] {
                boxes += 1;
                log.execute(
                    "INSERT INTO lidar_box VALUES (?, ?, ?, NULL, NULL, ?, ?, 600.0, 2.0, 5.0, 1.5, ?, 0.0, 0.0, 0.0, 0.9)",
                    params![token(8, boxes), token(5, number), token(3, track), x + at[0], y + at[1], vx],
                )
                .unwrap();
            }
            let status = if scene == 1 && sweep < 20 { "red" } else { "green" };
            for connector in [70, 9_999] {
                log.execute(
                    "INSERT INTO traffic_light_status VALUES (?, ?, ?, ?)",
                    params![
                        token(9, 2 * number + i64::from(connector == 70)),
                        token(5, number),
                        connector,
                        status
                    ],
                )
                .unwrap();
            }
        }
    }
    for (number, sweep, kind) in
        [(1, 1_005, "near_construction_zone"), (2, 1_010, "following_lane_with_lead")]
    {
        log.execute(
            "INSERT INTO scenario_tag VALUES (?, ?, ?, ?)",
            params![token(10, number), token(5, sweep), kind, (number == 2).then(|| token(3, 1))],
        )
        .unwrap();
    }
    log
}

/// A geometry with the header of a GeoPackage, of rings or one line in metres from the corner.
fn blob(rings: &[&[[f64; 2]]], polygon: bool) -> Vec<u8> {
    let mut blob = b"GP\0\x01".to_vec();
    blob.extend(4326_u32.to_le_bytes());
    blob.push(1);
    blob.extend((2 + u32::from(polygon)).to_le_bytes());
    if polygon {
        blob.extend((rings.len() as u32).to_le_bytes());
    }
    for ring in rings {
        let closed = ring.iter().chain(ring.first().filter(|_| polygon));
        blob.extend((ring.len() as u32 + u32::from(polygon)).to_le_bytes());
        for [east, north] in closed {
            for k in 0..2 {
                let degrees = DEGREES[0][k] + DEGREES[1][k] * east + DEGREES[2][k] * north;
                blob.extend(degrees.to_le_bytes());
            }
        }
    }
    blob
}

/// Lanes 1 and 2 lead north side by side (2 to the right) to y 60; connector 70 leads from lane 1 to lane 3, which begins
/// at y 80. Lane 4 lies 2 km to the east.
fn map() -> Connection {
    let map = Connection::open_in_memory().unwrap();
    map.execute_batch(
        "PRAGMA application_id = 1196444487;
        CREATE TABLE gpkg_geometry_columns (table_name TEXT, column_name TEXT, geometry_type_name TEXT, srs_id INTEGER);
        CREATE TABLE meta (fid INTEGER PRIMARY KEY, key TEXT, value TEXT);
        INSERT INTO meta VALUES (1, 'mapVersion', '9.15'), (2, 'projectedCoordSystem', 'EPSG:32611');
        CREATE TABLE baseline_paths (fid INTEGER PRIMARY KEY, geom BLOB, lane_fid INTEGER, lane_connector_fid INTEGER);
        CREATE TABLE lanes_polygons (fid INTEGER PRIMARY KEY, geom BLOB, lane_index INTEGER, lane_group_fid INTEGER,
            speed_limit_mps REAL, left_boundary_fid INTEGER, right_boundary_fid INTEGER);
        CREATE TABLE lane_connectors (fid INTEGER PRIMARY KEY, geom BLOB, exit_lane_fid INTEGER, entry_lane_fid INTEGER,
            speed_limit_mps REAL, traffic_light_stop_line_fids TEXT);
        CREATE TABLE boundaries (fid INTEGER PRIMARY KEY, geom BLOB);
        CREATE TABLE crosswalks (fid INTEGER PRIMARY KEY, geom BLOB);
        CREATE TABLE stop_polygons (fid INTEGER PRIMARY KEY, geom BLOB, stop_polygon_type_fid INTEGER);
        CREATE TABLE intersections (fid INTEGER PRIMARY KEY, geom BLOB);
        CREATE TABLE lane_groups_polygons (fid INTEGER PRIMARY KEY, geom BLOB);",
    )
    .unwrap();
    let tables = [
        "baseline_paths",
        "lanes_polygons",
        "lane_connectors",
        "boundaries",
        "crosswalks",
        "stop_polygons",
        "intersections",
        "lane_groups_polygons",
    ];
    for table in tables {
        map.execute("INSERT INTO gpkg_geometry_columns VALUES (?, 'geom', 'GEOMETRY', 4326)", [table])
            .unwrap();
    }
    let box_of = |x: f64, y: f64, width: f64, height: f64| {
        [[x, y], [x + width, y], [x + width, y + height], [x, y + height]]
    };
    let lanes = [
        (1, 50.0, 0.0, 60.0, 0),
        (2, 53.5, 0.0, 60.0, 1),
        (3, 50.0, 80.0, 60.0, 0),
        (4, 2_050.0, 0.0, 60.0, 0),
    ];
    for (fid, x, y, long, index) in lanes {
        let line = blob(&[&[[x, y], [x, y + long / 2.0], [x, y + long]]], false);
        map.execute("INSERT INTO baseline_paths VALUES (?, ?, ?, NULL)", params![fid, line, fid]).unwrap();
        let ring = blob(&[&box_of(x - 1.75, y, 3.5, long)], true);
        let (group, left, right) = (if fid < 3 { 500 } else { 500 + fid }, 600 + index, 601 + index);
        let limit = (fid != 3).then_some(11.176);
        map.execute(
            "INSERT INTO lanes_polygons VALUES (?, ?, ?, ?, ?, ?, ?)",
            params![fid, ring, index, group, limit, left, right],
        )
        .unwrap();
    }
    // A lane whose line is missing.
    map.execute("INSERT INTO lanes_polygons VALUES (5, NULL, 0, 505, NULL, NULL, NULL)", []).unwrap();
    for boundary in 0..3 {
        let x = 48.25 + 3.5 * f64::from(boundary);
        let line = blob(&[&[[x, 0.0], [x, 60.0]]], false);
        map.execute("INSERT INTO boundaries VALUES (?, ?)", params![600 + boundary, line]).unwrap();
    }
    let way = blob(&[&[[50.0, 60.0], [50.0, 80.0]]], false);
    map.execute("INSERT INTO baseline_paths VALUES (70, ?, NULL, 70)", [&way]).unwrap();
    map.execute("INSERT INTO lane_connectors VALUES (70, ?, 1, 3, 8.0, '800')", [&way]).unwrap();
    for (table, ring) in
        [("crosswalks", box_of(45.0, 62.0, 15.0, 3.0)), ("intersections", box_of(40.0, 60.0, 30.0, 20.0))]
    {
        map.execute(&format!("INSERT INTO {table} VALUES (1, ?)"), [blob(&[&ring], true)]).unwrap();
    }
    let group = blob(&[&box_of(48.25, 0.0, 7.0, 60.0), &box_of(51.0, 20.0, 1.0, 1.0)], true);
    map.execute("INSERT INTO lane_groups_polygons VALUES (500, ?)", [group]).unwrap();
    for (fid, x, kind) in [(800, 48.25, 2), (801, 51.75, 1)] {
        let ring = blob(&[&box_of(x, 58.0, 3.5, 1.0)], true);
        map.execute("INSERT INTO stop_polygons VALUES (?, ?, ?)", params![fid, ring, kind]).unwrap();
    }
    map
}

fn read(bytes: &[u8], net: Option<Vec<u8>>) -> Vec<Result<Imported, ReadError>> {
    let net = net.map(|net| Arc::new(net) as Arc<dyn Source>);
    registry::import(bytes, "x.db", "auto", &ImportOptions { net, ..ImportOptions::default() }).unwrap()
}

fn lane<'a>(scene: &'a Scene, id: &str) -> &'a scene::map::Lane {
    scene.map.lanes.iter().find(|lane| lane.id == id).unwrap_or_else(|| panic!("no lane {id}"))
}

#[test]
fn scenes_have_their_road_users_lights_and_the_map_round_them() {
    let mut list = read(&bytes_of(log()), Some(bytes_of(map())));
    assert_eq!(list.len(), 2);
    let (second, _) = list.pop().unwrap().unwrap();
    let (scene, warnings) = list.pop().unwrap().unwrap();
    assert_eq!((scene.name.as_str(), scene.time.steps), ("2021.05.12_veh-35 scene-001", 20));
    assert!(second.name.ends_with("scene-002"), "in the order of their times: {}", second.name);
    assert_eq!(scene.meta.licence.as_deref(), Some("cc-by-nc-sa-4.0"));
    assert_eq!(scene.meta.source_id.as_deref(), Some("0400000000000001"));
    assert_eq!(
        scene.meta.tags,
        ["city:us-nv-las-vegas-strip", "following_lane_with_lead", "near_construction_zone"]
    );
    assert_eq!(scene.meta.objects_of_interest, ["0300000000000001"]);
    assert!(second.meta.tags.len() == 1 && second.meta.objects_of_interest.is_empty());
    let kinds: Vec<_> = scene.agents.iter().map(|a| (a.agent_type, a.subtype)).collect();
    assert_eq!(
        kinds,
        [
            (AgentType::Vehicle, Subtype::Car),
            (AgentType::Vehicle, Subtype::Unknown),
            (AgentType::Pedestrian, Subtype::Unknown),
            (AgentType::Cyclist, Subtype::Bicycle),
            (AgentType::Other, Subtype::Unknown),
        ]
    );
    let origin = Vec2::new(scene.meta.origin.x_m, scene.meta.origin.y_m);
    assert_eq!(scene.meta.origin.crs.as_deref(), Some("+proj=utm +zone=11 +datum=WGS84 +units=m"));
    let from_corner = |p: Vec2| p + origin - Vec2::new(CORNER[0], CORNER[1]);
    let state = |agent: usize, step: usize| scene.agents[agent].track.at(step).unwrap();
    // The box of the ego lies ahead of its rear axle; its speed is along its heading.
    assert!((from_corner(state(0, 10).position()) - Vec2::new(50.0, 29.461)).norm() < 1e-6);
    let ego = state(0, 10);
    assert!(
        (ego.vx_mps.abs() < 1e-9)
            && (ego.vy_mps - 8.0).abs() < 1e-9
            && (ego.heading_rad - std::f64::consts::FRAC_PI_2).abs() < 1e-5
    );
    assert_eq!((scene.agents[0].size.length_m, scene.agents[0].role.as_deref()), (5.176, Some("ego")));
    assert!((from_corner(state(1, 5).position()) - Vec2::new(15.0, 50.0)).norm() < 1e-6);
    assert_eq!((state(1, 5).vx_mps, scene.agents[1].size.length_m), (10.0, 4.6));
    let (one, two, way, on) = (lane(&scene, "1"), lane(&scene, "2"), lane(&scene, "70"), lane(&scene, "3"));
    assert!(scene.map.lanes.len() == 4, "the one 2 km away is left out");
    // Degrees are projected: the line of lane 1 lies 50 m east of the corner, to a few millimetres.
    for point in &one.points.xy {
        assert!((from_corner(*point).x - 50.0).abs() < 0.02, "{}", from_corner(*point));
    }
    assert!((from_corner(*one.points.xy.last().unwrap()).y - 60.0).abs() < 0.02);
    assert_eq!((&one.successors[0], &way.successors[0], &on.predecessors[0]), (&way.id, &on.id, &way.id));
    assert!(way.interpolating && two.successors.is_empty());
    assert_eq!((&one.right_neighbors[0].lane, &two.left_neighbors[0].lane), (&two.id, &one.id));
    assert!(one.left_neighbors.is_empty() && on.right_neighbors.is_empty());
    assert_eq!(
        (one.right_boundary[0].line.as_str(), two.left_boundary[0].line.as_str()),
        ("boundary-601", "boundary-601")
    );
    assert!((one.width_m.unwrap() - 3.5).abs() < 0.01);
    assert_eq!(
        (one.speed_limit_mps, on.speed_limit_mps, way.speed_limit_mps),
        (Some(11.176), None, Some(8.0))
    );
    assert_eq!((scene.map.crosswalks.len(), scene.map.road_lines.len(), scene.map.drivable.len()), (1, 3, 2));
    assert!(scene.map.drivable.iter().any(|area| area.holes.len() == 1));
    assert_eq!(
        scene.map.stop_signs.iter().map(|sign| sign.lanes.as_slice()).collect::<Vec<_>>(),
        [["2".to_owned()]]
    );
    // The light of a connector that is not on the map is left out.
    assert_eq!(scene.signals.len(), 1);
    let light = &scene.signals[0];
    assert_eq!((light.lane.as_str(), light.at(0), light.at(9)), ("70", SignalState::Stop, SignalState::Stop));
    assert_eq!((light.at(10), second.signals[0].at(0)), (SignalState::Go, SignalState::Go));
    assert!((from_corner(light.stop.unwrap()) - Vec2::new(50.0, 60.0)).norm() < 0.02);
    let codes: Vec<&str> = warnings.iter().map(|warning| warning.code).collect();
    assert!(codes.contains(&"lanes-dropped") && codes.contains(&"cut-around"), "{codes:?}");
}

#[test]
fn logs_are_read_without_a_map_and_maps_without_a_log() {
    let (scene, warnings) = read(&bytes_of(log()), None).remove(0).unwrap();
    assert!(scene.map.lanes.is_empty() && scene.signals.is_empty() && scene.agents.len() == 5);
    assert!(warnings.iter().any(|warning| warning.code == "no-network"));
    let map = bytes_of(map());
    let around = |around: &str| {
        let options = ImportOptions { around: Some(around.parse().unwrap()), ..ImportOptions::default() };
        registry::import(&map, "map.gpkg", "auto", &options).unwrap().remove(0)
    };
    let degrees = around(&format!("{},{},150", DEGREES[0][0], DEGREES[0][1])).unwrap().0;
    let metres = around(&format!("{},{},150", CORNER[0], CORNER[1])).unwrap().0;
    assert!(degrees.map == metres.map && metres.map.lanes.len() == 4 && metres.agents.is_empty());
    assert!(around("0.5,0.5,100").unwrap_err().to_string().contains("no lane lies within 100 m"));
    assert_eq!(read(&map, None).remove(0).unwrap().0.map.lanes.len(), 5, "a small map is read whole");
}

#[test]
fn logs_without_scenes_or_tags_are_one_recording() {
    let log = log();
    log.execute_batch(
        "UPDATE lidar_pc SET scene_token = NULL; DROP TABLE scene; DROP TABLE scenario_tag; DROP TABLE log;",
    )
    .unwrap();
    let mut list = read(&bytes_of(log), None);
    let (scene, _) = list.pop().unwrap().unwrap();
    assert!(list.is_empty());
    assert_eq!((scene.time.steps, scene.meta.source_id, scene.meta.tags.len()), (40, None, 0));
}

/// What is read of a log after some statements.
fn after(statements: &str) -> Result<Imported, ReadError> {
    let log = log();
    log.execute_batch(statements).unwrap();
    let options = ImportOptions::default();
    registry::by_id("nuplan").unwrap().import(&bytes_of(log), &options).remove(0)
}

#[test]
fn nothing_of_a_database_is_executed() {
    let told = |statements: &str| after(statements).unwrap_err().to_string();
    assert!(told("DROP TABLE track").contains("no table track"));
    // A view is no table, whatever it would compute.
    let endless = "WITH RECURSIVE n(x) AS (SELECT 1 UNION ALL SELECT x + 1 FROM n) SELECT x AS token, x AS category_token FROM n";
    assert!(told(&format!("DROP TABLE track; CREATE VIEW track AS {endless}")).contains("no table track"));
    // Columns that are computed are not read: the tracks have no category.
    let computed =
        "DROP TABLE category; CREATE TABLE category (token BLOB, name TEXT AS (hex(zeroblob(400000000))));
        INSERT INTO category (token) SELECT category_token FROM track";
    let (scene, _) = after(computed).unwrap();
    assert!(scene.agents.iter().skip(1).all(|agent| agent.agent_type == AgentType::Other));
    // Values of other types than the schema has are none.
    let (scene, _) =
        after("UPDATE lidar_box SET x = 'far', vx = zeroblob(100) WHERE track_token = x'0300000000000001'")
            .unwrap();
    assert!(scene.agents[1].track.states.iter().all(Option::is_none));
    let (scene, _) = after("UPDATE ego_pose SET x = 9e999, qw = NULL").unwrap();
    assert!(scene.agents.len() == 5 && scene.agents[0].track.valid_steps().count() == 0);
    assert!(after("DELETE FROM lidar_pc").is_err());
}

#[test]
fn broken_databases_are_refused_and_wal_is_read() {
    let whole = bytes_of(log());
    let nuplan = registry::by_id("nuplan").unwrap();
    let read = |bytes: &[u8]| nuplan.import(bytes, &ImportOptions::default()).remove(0);
    let mut wal = whole.clone();
    wal[18..20].fill(2);
    assert_eq!(read(&wal).unwrap().0, read(&whole).unwrap().0);
    for end in [0, 20, 99, 100, 4_096, whole.len() / 2, whole.len() - 5_000] {
        assert!(read(&whole[..end]).is_err(), "cut at {end}");
    }
    for page in (0..whole.len()).step_by(4_096).skip(1) {
        let mut broken = whole.clone();
        // Its kind, its first free byte, its count of cells and the child on the right.
        broken[page..page + 12].fill(0x05);
        let _ = read(&broken);
    }
    let words = registry::import(
        b"SQLite format 3\0 of something else",
        "bag.db3",
        "auto",
        &ImportOptions::default(),
    );
    assert!(words.unwrap_err().to_string().contains("neither a log nor a map of nuPlan"));
}

#[test]
fn faults_of_the_map_lie_beside_the_log() {
    let pointer =
        |net: Vec<u8>| read(&bytes_of(log()), Some(net)).remove(0).unwrap_err().problems[0].pointer.clone();
    assert_eq!(pointer(b"nothing".to_vec()), "/net");
    let changed = |statements: &str| {
        let map = map();
        map.execute_batch(statements).unwrap();
        bytes_of(map)
    };
    assert_eq!(pointer(changed("DROP TABLE gpkg_geometry_columns")), "/net");
    // Without its projection that of the log is taken.
    let (scene, _) = read(&bytes_of(log()), Some(changed("DROP TABLE meta"))).remove(0).unwrap();
    assert_eq!(scene.map.lanes.len(), 4);
    let alone = registry::import(&changed("DROP TABLE meta"), "map.gpkg", "auto", &ImportOptions::default());
    assert!(alone.unwrap().remove(0).unwrap_err().to_string().contains("names no UTM zone"));
    let (scene, _) =
        read(&bytes_of(log()), Some(changed("UPDATE lanes_polygons SET geom = x'4750'"))).remove(0).unwrap();
    assert!(scene.map.lanes.iter().all(|lane| lane.width_m.is_none()), "a broken polygon gives no width");
}
