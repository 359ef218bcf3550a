//! Tables in the forms of public data sets, each with the map of its place under it.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test stops at the first surprise")]

use formats::{ImportOptions, Imported, ReadError, Source, registry};
use scene::{AgentType, Scene, Subtype, Vec2};
use std::sync::Arc;

/// Length and width of the car, its speed in m/s, and the time from frame to frame at 25 Hz.
const CAR_M: (f64, f64) = (5.0, 2.0);
const SPEED_MPS: f64 = 10.0;
const FRAME_S: f64 = 0.04;

fn read(table: &str, preset: &str, map: &str) -> Result<Imported, ReadError> {
    let beside = |text: &str| Some(Arc::new(text.as_bytes().to_vec()) as Arc<dyn Source>);
    let options = ImportOptions { columns: beside(preset), net: beside(map), ..ImportOptions::default() };
    registry::import(table.as_bytes(), "tracks.csv", "auto", &options)?.remove(0)
}

/// A road of one lane of 4 m to the right of a line of 300 m.
fn road(x: f64, y: f64, heading_rad: f64) -> String {
    format!(
        r#"<OpenDRIVE><road id="1" length="300"><planView><geometry s="0" x="{x}" y="{y}" hdg="{heading_rad}" length="300"><line/>
        </geometry></planView><lanes><laneSection s="0"><right><lane id="-1" type="driving"><width sOffset="0" a="4" b="0" c="0" d="0"/>
        </lane></right></laneSection></lanes></road></OpenDRIVE>"#
    )
}

/// The same as a lanelet from x -50 to 250, y -4 to 0, by degrees.
fn lanelet(degrees: impl Fn(f64, f64) -> (f64, f64)) -> String {
    let corners = [(-50.0, 0.0), (250.0, 0.0), (-50.0, -4.0), (250.0, -4.0)];
    let node = |(i, (x, y)): (usize, (f64, f64))| {
        let (lat, lon) = degrees(x, y);
        format!(r#"<node id="{}" lat="{lat:.12}" lon="{lon:.12}"/>"#, i + 1)
    };
    let nodes: String = corners.into_iter().enumerate().map(node).collect();
    format!(
        r#"<osm>{nodes}<way id="5"><nd ref="1"/><nd ref="2"/><tag k="type" v="line_thin"/></way>
        <way id="6"><nd ref="3"/><nd ref="4"/><tag k="type" v="line_thin"/></way>
        <relation id="7"><member type="way" ref="5" role="left"/><member type="way" ref="6" role="right"/>
        <tag k="type" v="lanelet"/><tag k="subtype" v="road"/></relation></osm>"#
    )
}

/// A table with a heading and a row for each of 51 frames: frame, and metres driven until then.
fn table(heading: &str, row: impl Fn(usize, f64) -> String) -> String {
    let rows = (0..=50).map(|frame| row(frame, SPEED_MPS * FRAME_S * frame as f64));
    std::iter::once(heading.to_owned()).chain(rows).collect::<Vec<_>>().join("\n")
}

/// The one car drives along its lane: it is where it was at 1 s, as large and fast, and the map fits.
fn drives(read: Result<Imported, ReadError>, kind: Subtype, at_1_s: [f64; 2], heading_rad: f64) -> Scene {
    let (scene, warnings) = read.unwrap();
    let car = &scene.agents[0];
    assert_eq!((car.agent_type, car.subtype), (AgentType::Vehicle, kind));
    let origin = Vec2::new(scene.meta.origin.x_m, scene.meta.origin.y_m);
    let state = car.track.at(10).unwrap();
    let place = state.position() + origin;
    assert!((place - Vec2::new(at_1_s[0], at_1_s[1])).norm() < 0.02, "{place}");
    assert!((state.heading_rad - heading_rad).abs() < 0.01, "{state:?}");
    assert!((state.vx_mps.hypot(state.vy_mps) - SPEED_MPS).abs() < 0.1, "{state:?}");
    assert_eq!(scene.map.lanes.len(), 1);
    let said = warnings.iter().find(|warning| warning.code.starts_with("map-")).unwrap();
    assert_eq!(said.code, "map-laid", "{}", said.detail);
    assert!(said.detail.starts_with("100% "), "{}", said.detail);
    scene
}

#[test]
fn drone_recordings_lie_on_the_map_of_their_place() {
    let (length, width) = CAR_M;
    // Corners and an axis that counts downwards, as pictures have them.
    let highd = table("frame,id,x,y,width,height,xVelocity,yVelocity,laneId", |frame, along| {
        format!("{frame},1,{},1,{length},{width},10,0,2", 10.0 + along - length / 2.0)
    });
    let scene = drives(read(&highd, "highd", &road(-50.0, 0.0, 0.0)), Subtype::Unknown, [20.0, -2.0], 0.0);
    assert_eq!((scene.agents[0].size.length_m, scene.agents[0].size.width_m), CAR_M);
    let heading =
        "recordingId,trackId,frame,trackLifetime,xCenter,yCenter,heading,width,length,xVelocity,yVelocity";
    let centres = table(heading, |frame, along| {
        format!("7,1,{frame},{frame},{},-2,0,{width},{length},10,0", 10.0 + along)
    });
    for preset in ["ind", "round", "exid"] {
        let scene =
            drives(read(&centres, preset, &road(-50.0, 0.0, 0.0)), Subtype::Unknown, [20.0, -2.0], 0.0);
        assert_eq!((scene.agents[0].size.length_m, scene.agents[0].size.width_m), CAR_M);
    }
    let heading =
        "track_id,frame_id,timestamp_ms,agent_type,x,y,vx,vy,yaw_rad,heading_rad,length,width,ax,ay";
    let sind = table(heading, |frame, along| {
        format!("1,{frame},{},truck,{},-2,10,0,0,0,{length},{width},0,0", 40 * frame, 10.0 + along)
    });
    drives(read(&sind, "sind", &road(-50.0, 0.0, 0.0)), Subtype::Truck, [20.0, -2.0], 0.0);
}

#[test]
fn feet_and_bumpers_become_metres_and_middles() {
    let ft = |metres: f64| metres / 0.3048;
    let heading = "Vehicle_ID,Frame_ID,Total_Frames,Global_Time,Local_X,Local_Y,Global_X,Global_Y,v_Length,v_Width,v_Class,v_Vel";
    // At 10 Hz; the place is the middle of the front bumper, and the road leads along y.
    let ngsim = (0..=20).map(|frame| {
        let front = 10.0 + f64::from(frame) + CAR_M.0 / 2.0;
        format!("2,{frame},21,0,{},{},0,0,{},{},2,32.8", ft(2.0), ft(front), ft(CAR_M.0), ft(CAR_M.1))
    });
    let ngsim = std::iter::once(heading.to_owned()).chain(ngsim).collect::<Vec<_>>().join("\n");
    let along_y = std::f64::consts::FRAC_PI_2;
    drives(read(&ngsim, "ngsim", &road(0.0, -50.0, along_y)), Subtype::Car, [2.0, 20.0], along_y);
    // At 30 Hz, with an axis that counts downwards.
    let rows = (0..=60).map(|frame| {
        let x = 10.0 + f64::from(frame) / 3.0;
        format!("{frame},1,{},{},0,0,{},{}", x * 12.0, 24.0, ft(x), ft(2.0))
    });
    let heading = "frameNum,carId,carCenterX,carCenterY,headX,headY,carCenterXft,carCenterYft".to_owned();
    let citysim = std::iter::once(heading).chain(rows).collect::<Vec<_>>().join("\n");
    drives(read(&citysim, "citysim", &road(-50.0, 0.0, 0.0)), Subtype::Car, [20.0, -2.0], 0.0);
}

#[test]
fn maps_in_degrees_meet_tables_in_metres_and_in_degrees() {
    // Local metres that went through UTM about 0, 0, as the set's maps have them.
    let no_land = |x: f64, y: f64| (9.034_831e-6 * y, 8.974_352e-6 * x);
    let heading = "track_id,frame_id,timestamp_ms,agent_type,x,y,vx,vy,psi_rad,length,width";
    let interaction =
        table(heading, |frame, along| format!("1,{frame},{},car,{},-2,10,0,0,5,2", 40 * frame, 10.0 + along));
    drives(read(&interaction, "interaction", &lanelet(no_land)), Subtype::Car, [20.0, -2.0], 0.0);
    // Degrees of the table and of the map are projected about their own middles.
    let athens = |x: f64, y: f64| (37.98 + y / 110_989.7, 23.73 + x / 87_837.4);
    let rows = (0..=50).flat_map(|frame| {
        let (lat, lon) = athens(10.0 + SPEED_MPS * FRAME_S * f64::from(frame), -2.0);
        [
            format!("{lat:.12}"),
            format!("{lon:.12}"),
            "36".into(),
            "0".into(),
            "0".into(),
            format!("{:.6}", FRAME_S * f64::from(frame)),
        ]
    });
    let rows: Vec<String> = rows.collect();
    let pneuma = format!(
        "track_id; type; traveled_d; avg_speed; lat; lon; speed; lon_acc; lat_acc; time\n1; Taxi; 20; 36; {}",
        rows.join("; ")
    );
    let (scene, warnings) = read(&pneuma, "pneuma", &lanelet(athens)).unwrap();
    let laid = warnings.iter().find(|warning| warning.code.starts_with("map-")).unwrap();
    assert!(laid.code == "map-laid" && laid.detail.starts_with("100% "), "{}", laid.detail);
    let lane = &scene.map.lanes[0].points.xy;
    let car = scene.agents[0].track.at(10).unwrap();
    assert_eq!(scene.agents[0].subtype, Subtype::Car);
    // The lane begins 70 m behind the car at 1 s, and the car keeps to its middle.
    let behind = car.position() - lane[0];
    assert!((behind.x - 70.0).abs() < 0.1 && behind.y.abs() < 0.05, "{behind}");
}

#[test]
fn a_map_of_another_place_is_said() {
    let heading = "track_id,frame_id,timestamp_ms,agent_type,x,y,vx,vy,psi_rad,length,width";
    let cars = table(heading, |frame, along| format!("1,{frame},{},car,{},60,10,0,0,5,2", 40 * frame, along));
    let (scene, warnings) = read(&cars, "interaction", &road(-50.0, 0.0, 0.0)).unwrap();
    assert!(!scene.map.lanes.is_empty());
    let said = warnings.iter().find(|warning| warning.code == "map-elsewhere").unwrap();
    assert!(said.detail.contains("Only 0%"), "{}", said.detail);
    let error = read(&cars, "interaction", "no map").unwrap_err();
    assert_eq!(error.problems[0].pointer, "/net");
}
