//! Recordings of several tables in a zip, in the forms of public data sets, each with the map of its place.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test stops at the first surprise")]

mod zipped;

use formats::{
    FolderFiles, ImportOptions, ImportWarning, Imported, ReadError, RefusalKind, Source, registry, table,
};
use scene::{AgentType, Scene, Subtype, Vec2};
use std::sync::Arc;
use zipped::zipped;

/// Length and width of the car and its speed in m/s.
const CAR_M: (f64, f64) = (5.0, 2.0);
const SPEED_MPS: f64 = 10.0;

fn read(file: &[u8], columns: Option<&str>) -> Vec<Result<Imported, ReadError>> {
    let columns = columns.map(|text| Arc::new(text.as_bytes().to_vec()) as Arc<dyn Source>);
    let options = ImportOptions { columns, ..ImportOptions::default() };
    registry::import(file, "data.zip", "auto", &options).unwrap()
}

fn read_one(file: &[u8], columns: Option<&str>) -> Imported {
    let mut list = read(file, columns);
    assert_eq!(list.len(), 1);
    list.remove(0).unwrap()
}

fn said<'a>(warnings: &'a [ImportWarning], code: &str) -> Option<&'a str> {
    warnings.iter().find(|warning| warning.code == code).map(|warning| warning.detail.as_str())
}

/// A lanelet by the degrees of its corners: left line from and to, right line from and to.
fn lanelet(corners: [(f64, f64); 4], more: &str) -> String {
    let node =
        |(i, (lat, lon)): (usize, (f64, f64))| format!(r#"<node id="{}" lat="{lat}" lon="{lon}"/>"#, i + 1);
    let nodes: String = corners.into_iter().enumerate().map(node).collect();
    format!(
        r#"<osm>{nodes}<way id="5"><nd ref="1"/><nd ref="2"/><tag k="type" v="line_thin"/></way>
        <way id="6"><nd ref="3"/><nd ref="4"/><tag k="type" v="line_thin"/></way>
        <relation id="7"><member type="way" ref="5" role="left"/><member type="way" ref="6" role="right"/>
        <tag k="type" v="lanelet"/><tag k="subtype" v="road"/>{more}</relation></osm>"#
    )
}

/// A road of one lane of 4 m to the right of a line of 300 m along x.
fn road(x: f64, y: f64, header: &str) -> String {
    format!(
        r#"<OpenDRIVE>{header}<road id="1" length="300"><planView><geometry s="0" x="{x}" y="{y}" hdg="0" length="300"><line/>
        </geometry></planView><lanes><laneSection s="0"><right><lane id="-1" type="driving"><width sOffset="0" a="4" b="0" c="0" d="0"/>
        </lane></right></laneSection></lanes></road></OpenDRIVE>"#
    )
}

/// A heading, and rows of frames with the metres driven until then.
fn table(heading: &str, frames: usize, rate_hz: f64, row: impl Fn(usize, f64) -> String) -> String {
    let rows = (0..frames).map(|frame| row(frame, SPEED_MPS * frame as f64 / rate_hz));
    std::iter::once(heading.to_owned()).chain(rows).collect::<Vec<_>>().join("\n")
}

/// Tables of inD and its kin: a car from x 10 along y -2, and somebody on a bicycle that stands beside.
fn drone(recording: usize, rate_hz: f64, utm: (f64, f64), place: (f64, f64)) -> [String; 3] {
    let (length, width) = CAR_M;
    let heading = "recordingId,trackId,frame,trackLifetime,xCenter,yCenter,heading,width,length,xVelocity,yVelocity,\
        xAcceleration,yAcceleration,lonVelocity,latVelocity,lonAcceleration,latAcceleration";
    let frames = (2.0 * rate_hz) as usize + 1;
    let tracks = table(heading, frames, rate_hz, |frame, along| {
        format!(
            "{recording},0,{frame},{frame},{:.5},-2.0,0.0,{width},{length},10.0,0.0,0.0,0.0,10.0,0.0,0.0,0.0\n\
             {recording},1,{frame},{frame},20.0,1.0,90.0,0.6,1.8,0.0,0.0,0.0,0.0,0.0,0.0,0.0,0.0",
            10.0 + along
        )
    });
    let last = frames - 1;
    let agents = format!(
        "recordingId,trackId,initialFrame,finalFrame,numFrames,width,length,class\n\
         {recording},0,0,{last},{frames},{width},{length},truck_bus\n{recording},1,0,{last},{frames},0.6,1.8,bicycle\n"
    );
    let about = format!(
        "recordingId,locationId,frameRate,speedLimit,weekday,startTime,duration,numTracks,numVehicles,numVRUs,\
         latLocation,lonLocation,xUtmOrigin,yUtmOrigin,orthoPxToMeter\n\
         {recording},4,{rate_hz},13.88889,tuesday,7,2.0,2,1,1,{},{},{},{},0.00814636\n",
        place.0, place.1, utm.0, utm.1
    );
    [tracks, agents, about]
}

/// East and north, or latitude and longitude.
type Pair = (f64, f64);
/// The zero of a recording in UTM, its degrees, and those of the corners of a lane.
type Place = (Pair, Pair, [Pair; 4]);

/// The zero of a recording of inD in UTM, its degrees, and those of the corners of a lane from x -50 to 250, y -4 to 0.
/// By PROJ.
const IND: Place = (
    (293_487.122_4, 5_629_711.581_63),
    (50.782_329, 6.070_377),
    [
        (50.782_311_631_33, 6.069_668_235_05),
        (50.782_418_406_48, 6.073_918_151_65),
        (50.782_275_707_06, 6.069_670_482_31),
        (50.782_382_482_08, 6.073_920_395_66),
    ],
);
const ROUND: Place = (
    (300_127.085_3, 5_629_091.058_7),
    (50.779_083, 6.164_784),
    [
        (50.779_065_309_92, 6.164_075_917_61),
        (50.779_168_640_68, 6.168_325_892_6),
        (50.779_029_382_65, 6.164_078_092_28),
        (50.779_132_713_28, 6.168_328_064_01),
    ],
);
const EXID: Place = (
    (352_930.8, 5_649_780.1),
    (50.980_807, 6.904_857),
    [
        (50.980_794_079_56, 6.904_145_544_86),
        (50.980_870_654_64, 6.908_416_284_03),
        (50.980_758_133_52, 6.904_147_163_9),
        (50.980_834_708_51, 6.908_417_899_78),
    ],
);

/// The truck drives in the middle of the one lane, and is where it was at 1 s.
fn drives(scene: &Scene, at_1_s: Vec2) {
    let truck = &scene.agents[0];
    assert_eq!((truck.agent_type, truck.subtype), (AgentType::Vehicle, Subtype::Truck));
    assert_eq!((truck.size.length_m, truck.size.width_m), CAR_M);
    let state = truck.track.at(10).unwrap();
    let origin = Vec2::new(scene.meta.origin.x_m, scene.meta.origin.y_m);
    assert!((state.position() + origin - at_1_s).norm() < 0.01, "{state:?}");
    assert_eq!(scene.map.lanes.len(), 1);
    let lane = &scene.map.lanes[0].points.xy;
    let beside = state.position() - lane[0];
    assert!((beside.x - 70.0).abs() < 0.05 && beside.y.abs() < 0.05, "{beside}");
}

#[test]
fn meta_tables_say_classes_frame_rate_and_place() {
    let other = lanelet(EXID.2, "");
    for (preset, (utm, place, corners), rate_hz) in
        [("ind", IND, 25.0), ("round", ROUND, 50.0), ("exid", EXID, 30.0)]
    {
        let [tracks, agents, about] = drone(7, rate_hz, utm, place);
        let far = if preset == "exid" { lanelet(IND.2, "") } else { other.clone() };
        let zip = zipped(&[
            ("set/data/07_recordingMeta.csv", &about),
            ("set/data/07_tracks.csv", &tracks),
            ("set/data/07_tracksMeta.csv", &agents),
            ("set/data/07_background.png", "no picture"),
            ("set/maps/a_elsewhere.osm", &far),
            ("set/maps/b_here.osm", &lanelet(corners, "")),
        ]);
        // With the preset, and by the columns alone.
        for columns in [Some(preset), None] {
            let (scene, warnings) = read_one(&zip, columns);
            assert_eq!(said(&warnings, "columns-recognised").is_some(), columns.is_none());
            drives(&scene, Vec2::new(utm.0 + 20.0, utm.1 - 2.0));
            let cyclist = &scene.agents[1];
            assert_eq!((cyclist.agent_type, cyclist.subtype), (AgentType::Cyclist, Subtype::Bicycle));
            assert_eq!(scene.meta.origin.crs.as_deref(), Some("+proj=utm +zone=32 +datum=WGS84 +units=m"));
            assert_eq!((scene.name.as_str(), scene.time.steps), ("7", 21));
            assert!(said(&warnings, "map-laid").unwrap().starts_with("100% "), "{warnings:?}");
            assert!(said(&warnings, "map-chosen").unwrap().contains("b_here"), "{warnings:?}");
            assert!((scene.map.lanes[0].speed_limit_mps.unwrap() - 13.888_89).abs() < 1e-9);
            assert_eq!(said(&warnings, "tables-missing"), None);
        }
    }
}

#[test]
fn maps_in_the_frame_of_the_tables_or_of_the_zone_fit() {
    let (utm, place, _) = IND;
    let [tracks, agents, about] = drone(0, 25.0, utm, place);
    let zone = format!(
        "<geoReference>+proj=utm +zone=32 +datum=WGS84</geoReference><offset x=\"{}\" y=\"{}\" z=\"0\" hdg=\"0\"/>",
        utm.0, utm.1
    );
    let maps = [
        road(-50.0, 0.0, ""),
        road(utm.0 - 50.0, utm.1, ""),
        road(-50.0, 0.0, &format!("<header revMajor=\"1\" revMinor=\"6\">{zone}</header>")),
    ];
    for map in maps {
        let zip = zipped(&[
            ("00_tracks.csv", &tracks),
            ("00_tracksMeta.csv", &agents),
            ("00_recordingMeta.csv", &about),
            ("place.xodr", &map),
        ]);
        let (scene, warnings) = read_one(&zip, Some("ind"));
        assert!(
            said(&warnings, "map-laid").is_some_and(|said| said.starts_with("100% ")),
            "{map} {warnings:?}"
        );
        drives(&scene, Vec2::new(utm.0 + 20.0, utm.1 - 2.0));
    }
}

#[test]
fn tables_and_maps_may_stand_beside_a_table() {
    let (utm, place, corners) = IND;
    let [tracks, agents, about] = drone(0, 25.0, utm, place);
    let there = [
        ("00_recordingMeta.csv", about),
        ("00_tracksMeta.csv", agents),
        ("01_tracksMeta.csv", "trackId\n".to_owned()),
        ("here.osm", lanelet(corners, "")),
        ("nothing.xodr", "<OpenDRIVE".to_owned()),
        ("notes.txt", String::new()),
    ];
    let names = || Ok::<_, ()>(there.iter().map(|(name, _)| (*name).to_owned()).collect());
    let names = table::beside("00_tracks.csv", None, names).unwrap();
    assert_eq!(names, ["00_recordingMeta.csv", "00_tracksMeta.csv", "here.osm", "nothing.xodr"]);
    let other = |name: String| {
        let text = &there.iter().find(|(known, _)| *known == name).unwrap().1;
        (name, Arc::new(text.clone().into_bytes()) as Arc<dyn Source>)
    };
    let others: Vec<_> = names.into_iter().map(other).collect();
    let zip: Vec<(&str, &str)> = there.iter().map(|(name, text)| (*name, text.as_str())).collect();
    let (in_zip, of_zip) =
        read_one(&zipped(&[&[("00_tracks.csv", tracks.as_str())], zip.as_slice()].concat()), None);
    let folder = Some(FolderFiles { name: "00_tracks.csv".to_owned(), others });
    let options = ImportOptions { folder, ..ImportOptions::default() };
    let read = |options: &ImportOptions| {
        registry::import(tracks.as_bytes(), "00_tracks.csv", "auto", options).unwrap().remove(0).unwrap()
    };
    let (scene, mut warnings) = read(&options);
    drives(&scene, Vec2::new(utm.0 + 20.0, utm.1 - 2.0));
    let told = warnings.remove(0);
    assert_eq!(
        (told.code, told.detail.as_str()),
        (
            "files-beside",
            "4 files from the same folder are read with the table: 00_recordingMeta.csv, 00_tracksMeta.csv, here.osm, \
             nothing.xodr"
        )
    );
    // The zip of the folder is the same scene with the same words.
    assert_eq!((scene, warnings), (in_zip, of_zip));
    // The map that is given comes before those of the folder.
    let net = Some(Arc::new(lanelet(EXID.2, "").into_bytes()) as Arc<dyn Source>);
    let (_, warnings) = read(&ImportOptions { net, ..options.clone() });
    assert!(said(&warnings, "files-beside").unwrap().starts_with("2 files"), "{warnings:?}");
    assert!(said(&warnings, "map-elsewhere").is_some(), "{warnings:?}");
    // A table with a name of its own takes the maps that it is given alone.
    let folder = options.folder.clone().map(|folder| FolderFiles { name: "own.csv".to_owned(), ..folder });
    let (alone, warnings) = read(&ImportOptions { folder, ..ImportOptions::default() });
    assert!(
        said(&warnings, "files-beside").unwrap().ends_with("table: here.osm, nothing.xodr"),
        "{warnings:?}"
    );
    assert_eq!((said(&warnings, "tables-missing").is_some(), alone.name.as_str()), (true, "0"));
}

/// A file that says to have so many bytes.
#[derive(Debug)]
struct Said(u64);

impl Source for Said {
    fn open(&self) -> std::io::Result<Box<dyn std::io::Read + Send + '_>> {
        panic!("it is not read")
    }

    fn encoded_len(&self) -> u64 {
        self.0
    }
}

#[test]
fn folders_have_the_bounds_of_zips() {
    let [tracks, ..] = drone(0, 25.0, IND.0, IND.1);
    let others = vec![("00_tracksMeta.csv".to_owned(), Arc::new(Said((4 << 30) + 1)) as Arc<dyn Source>)];
    let folder = Some(FolderFiles { name: "00_tracks.csv".to_owned(), others });
    let options = ImportOptions { folder, ..ImportOptions::default() };
    let refused = registry::import(tracks.as_bytes(), "00_tracks.csv", "csv", &options).unwrap_err();
    assert_eq!(
        (refused.code(), refused.kind),
        ("decoded-too-large", RefusalKind::TooLarge { limit: 4 << 30 })
    );
}

#[test]
fn maps_beyond_the_bounds_are_left_out_and_said() {
    let (utm, place, corners) = IND;
    let [tracks, agents, about] = drone(0, 25.0, utm, place);
    let map = lanelet(corners, "");
    let tables = [("00_tracks.csv", tracks), ("00_tracksMeta.csv", agents), ("00_recordingMeta.csv", about)];
    let many: Vec<(String, String)> = (10..80).map(|at| (format!("{at}.osm"), map.clone())).collect();
    let large = vec![("a.osm".to_owned(), map.clone()), ("b.xodr".to_owned(), " ".repeat(9 << 20))];
    for (maps, why) in [
        (many, "The map 74.osm cannot be read: more than 64 maps that come with a table"),
        (large, "The map b.xodr"),
    ] {
        let files = tables.iter().map(|(name, text)| (*name, text.as_str()));
        let files: Vec<_> =
            files.chain(maps.iter().map(|(name, text)| (name.as_str(), text.as_str()))).collect();
        let (scene, warnings) = read_one(&zipped(&files), None);
        drives(&scene, Vec2::new(utm.0 + 20.0, utm.1 - 2.0));
        let unread: Vec<_> = warnings.iter().filter(|warning| warning.code == "map-unread").collect();
        assert!(unread.len() == 1 && unread[0].detail.starts_with(why), "{unread:?}");
        assert!(said(&warnings, "map-laid").unwrap().starts_with("100% "), "{warnings:?}");
    }
}

#[test]
fn motorways_of_corners_and_limits_are_read_with_their_tables() {
    let (length, width) = CAR_M;
    let heading = "frame,id,x,y,width,height,xVelocity,yVelocity,xAcceleration,yAcceleration,frontSightDistance,\
        backSightDistance,dhw,thw,ttc,precedingXVelocity,precedingId,followingId,leftPrecedingId,leftAlongsideId,\
        leftFollowingId,rightPrecedingId,rightAlongsideId,rightFollowingId,laneId";
    // Frames count from 1.
    let tracks = table(heading, 51, 25.0, |frame, along| {
        format!(
            "{},1,{:.3},1.0,{length},{width},10.00,0.00,0.00,0.00,0,0,0,0,0,0,0,0,0,0,0,0,0,0,5",
            frame + 1,
            10.0 + along - length / 2.0
        )
    });
    let agents = "id,width,height,initialFrame,finalFrame,numFrames,class,drivingDirection,traveledDistance,minXVelocity,\
        maxXVelocity,meanXVelocity,minDHW,minTHW,minTTC,numLaneChanges\n\
        1,5.0,2.0,1,51,51,Truck,2,20,10,10,10,-1,-1,-1,0\n";
    let about = |limit: f64| {
        format!(
            "id,frameRate,locationId,speedLimit,month,weekDay,startTime,duration,totalDrivenDistance,totalDrivenTime,\
             numVehicles,numCars,numTrucks,upperLaneMarkings,lowerLaneMarkings\n\
             1,25,2,{limit},9.2017,Tue,08:38,2.0,20,2,1,0,1,8.51;12.59;16.43,0.00;4.00\n"
        )
    };
    for (limit_mps, expected) in [(33.33, Some(33.33)), (-1.0, None)] {
        let zip = zipped(&[
            ("01_tracks.csv", &tracks),
            ("01_tracksMeta.csv", agents),
            ("01_recordingMeta.csv", &about(limit_mps)),
            ("highD_2.xodr", &road(-50.0, 0.0, "")),
        ]);
        let (scene, warnings) = read_one(&zip, Some("highd"));
        drives(&scene, Vec2::new(20.0, -2.0));
        assert_eq!(scene.map.lanes[0].speed_limit_mps, expected);
        assert_eq!(said(&warnings, "speed-limit-of-recording").is_some(), expected.is_some());
        assert_eq!(scene.name, "01");
    }
}

#[test]
fn vehicles_and_pedestrians_of_two_tables_are_one_scene() {
    // Local metres that went through UTM about 0, 0, as these sets' maps have them.
    let no_land = |x: f64, y: f64| (9.034_831e-6 * y, 8.974_352e-6 * x);
    let map =
        lanelet([(-50.0, 0.0), (250.0, 0.0), (-50.0, -4.0), (250.0, -4.0)].map(|(x, y)| no_land(x, y)), "");
    let vehicle = |heading: &str, middle: &str, end: &str| {
        table(heading, 21, 10.0, |frame, along| {
            format!("1,{frame},{},truck,{},-2,10,0,{middle}5.0,2.0{end}", 100 * frame, 10.0 + along)
        })
    };
    let walker = |heading: &str, end: &str| {
        table(heading, 21, 10.0, |frame, along| {
            format!("P1,{frame},{},pedestrian,{},3,1.0,0{end}", 100 * frame, 10.0 + along / 10.0)
        })
    };
    let interaction = [
        ("maps/DR_X.osm".to_owned(), map.clone()),
        (
            "recorded_trackfiles/DR_X/vehicle_tracks_003.csv".to_owned(),
            vehicle("track_id,frame_id,timestamp_ms,agent_type,x,y,vx,vy,psi_rad,length,width", "0.0,", ""),
        ),
        (
            "recorded_trackfiles/DR_X/pedestrian_tracks_003.csv".to_owned(),
            walker("track_id,frame_id,timestamp_ms,agent_type,x,y,vx,vy", ""),
        ),
    ];
    let sind = [
        ("Tianjin/map_relink_law_save.osm".to_owned(), map),
        (
            "Tianjin/8_2_1/Veh_smoothed_tracks.csv".to_owned(),
            vehicle(
                "track_id,frame_id,timestamp_ms,agent_type,x,y,vx,vy,yaw_rad,heading_rad,length,width,ax,ay,v_lon,\
                 v_lat,a_lon,a_lat",
                "0.0,0.0,",
                ",0,0,10,0,0,0",
            ),
        ),
        (
            "Tianjin/8_2_1/Ped_smoothed_tracks.csv".to_owned(),
            walker("track_id,frame_id,timestamp_ms,agent_type,x,y,vx,vy,ax,ay", ",0,0"),
        ),
    ];
    for (preset, files, name) in [("interaction", interaction, "003"), ("sind", sind, "8_2_1")] {
        let files: Vec<(&str, &str)> =
            files.iter().map(|(name, text)| (name.as_str(), text.as_str())).collect();
        let zip = zipped(&files);
        for columns in [Some(preset), None] {
            let (scene, warnings) = read_one(&zip, columns);
            let by_id = |id: &str| scene.agent(id).unwrap_or_else(|| panic!("{preset}: {id}"));
            assert_eq!(scene.agents.len(), 2);
            assert_eq!(by_id("1").subtype, Subtype::Truck);
            assert_eq!(by_id("P1").agent_type, AgentType::Pedestrian);
            assert!((by_id("P1").track.at(10).unwrap().x_m - 11.0).abs() < 1e-6);
            assert_eq!(scene.name, name);
            assert!(said(&warnings, "map-laid").unwrap().starts_with("100% "), "{warnings:?}");
        }
    }
}

#[test]
fn each_recording_of_a_zip_is_read_whatever_the_others_are() {
    let [tracks, agents, about] = drone(0, 25.0, IND.0, IND.1);
    let [second, ..] = drone(2, 25.0, IND.0, IND.1);
    let wrong = about.replace(",25,", ",fast,");
    let zip = zipped(&[
        ("00_tracks.csv", &tracks),
        ("00_tracksMeta.csv", &agents),
        ("00_recordingMeta.csv", &about),
        ("01_tracks.csv", &tracks),
        ("01_recordingMeta.csv", &wrong),
        ("02_tracks.csv", &second),
        ("map.osm", "<osm><node id=\"1\""),
    ]);
    let mut list = read(&zip, Some("ind"));
    assert_eq!(list.len(), 3);
    let problem = list.remove(1).unwrap_err();
    let first = &problem.problems[0];
    assert_eq!(
        (problem.code(), first.pointer.as_str()),
        ("invalid-field", "/01_recordingMeta.csv/frameRate")
    );
    assert!(
        first.detail.contains("\"fast\"") && first.detail.contains("frames a second"),
        "{}",
        first.detail
    );
    let [(whole, warnings), (alone, more)] = [list.remove(0).unwrap(), list.remove(0).unwrap()];
    assert_eq!((whole.name.as_str(), alone.name.as_str()), ("0", "2"));
    assert!(said(&warnings, "map-unread").is_some_and(|said| said.contains("map.osm")), "{warnings:?}");
    // Without its tables, types are unknown and the place is that of the table; both are said.
    assert_eq!(more.iter().filter(|warning| warning.code == "tables-missing").count(), 2);
    assert_eq!((alone.agents[0].subtype, alone.meta.origin.x_m), (Subtype::Unknown, 0.0));
    // A fault in the rows names its file and line.
    let zip = zipped(&[("00_tracks.csv", &tracks.replacen("10.00000", "far", 1))]);
    let problem = read(&zip, Some("ind")).remove(0).unwrap_err();
    assert_eq!(problem.problems[0].pointer, "/00_tracks.csv/line/2/x_m");
}

#[test]
fn damaged_and_foreign_zips_are_refused() {
    let [tracks, ..] = drone(0, 25.0, IND.0, IND.1);
    let mut zip = zipped(&[("00_tracks.csv", &tracks)]);
    // The checksum in the list of files.
    let list = zip.windows(4).position(|part| part == b"PK\x01\x02").unwrap();
    zip[list + 16] ^= 0x55;
    let problem = read(&zip, Some("ind")).remove(0).unwrap_err();
    assert_eq!(problem.code(), "malformed-file", "{problem:?}");
    let empty = zipped(&[("readme.txt", "nothing")]);
    let error = registry::import(&empty, "data.zip", "auto", &ImportOptions::default()).unwrap_err();
    assert_eq!(error.code(), "format-unknown");
    let none = registry::import(&empty, "data.zip", "csv", &ImportOptions::default()).unwrap();
    assert_eq!(none[0].as_ref().unwrap_err().code(), "cannot-represent");
}

#[test]
fn a_column_file_takes_a_set_and_changes_it() {
    let [tracks, agents, about] = drone(0, 25.0, IND.0, IND.1);
    let zip = zipped(&[
        ("00_tracks.csv", &tracks),
        ("00_tracksMeta.csv", &agents),
        ("00_recordingMeta.csv", &about),
    ]);
    let told = r#"{"set": "ind", "only": {"agent_id": [1]}, "frame_rate_hz": {"value": 50}}"#;
    let (scene, _) = read_one(&zip, Some(told));
    assert_eq!((scene.agents.len(), scene.agents[0].id.as_str(), scene.time.steps), (1, "1", 11));
    let told = r#"{"set": "ind", "only": {"time_s": [0.5, 1.5]}}"#;
    let (scene, _) = read_one(&zip, Some(told));
    assert_eq!((scene.agents.len(), scene.time.steps), (2, 10));
}
