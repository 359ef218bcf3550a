//! OpenSCENARIO as scenes: what this program writes comes back, and what others write opens as far as it needs no
//! simulation.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test stops at the first surprise")]

mod zipped;

use formats::{ExportOptions, ExportedMotion, ImportOptions, Imported, ReadError, registry};
use scene::{AgentType, Scene, Signal, SignalState, Subtype, Vec2};
use std::collections::BTreeSet;
use zipped::zipped;

fn read(bytes: &[u8], name: &str) -> Result<Imported, ReadError> {
    registry::import(bytes, name, "auto", &ImportOptions::default())?.remove(0)
}

fn example(name: &str) -> Scene {
    let path = format!("{}/../../assets/scenes/demo-{name}.json", env!("CARGO_MANIFEST_DIR"));
    read(&std::fs::read(path).unwrap(), "").unwrap().0
}

#[test]
fn what_is_written_comes_back_as_the_scene_it_was() {
    for name in ["crossing", "arterial", "motorway"] {
        let scene = example(name);
        let options = ExportOptions { motion: ExportedMotion::Log, ..ExportOptions::default() };
        let file = registry::by_id("openscenario").unwrap().export(&[&scene], &options).unwrap();
        let (again, warnings) = read(&file.bytes, "a.xosc.zip").unwrap();
        assert_eq!((&again.name, again.time), (&scene.name, scene.time), "{name}");
        assert_eq!((&again.meta.source, &again.meta.licence), (&scene.meta.source, &scene.meta.licence));
        assert!(!again.map.lanes.is_empty());
        let origin = |scene: &Scene| Vec2::new(scene.meta.origin.x_m, scene.meta.origin.y_m);
        // Without a projection the map keeps the frame of the scene.
        let shift =
            origin(&again) - if scene.meta.origin.crs.is_some() { origin(&scene) } else { Vec2::zeros() };
        let seen = scene.agents.iter().filter(|agent| agent.track.valid_steps().next().is_some());
        assert_eq!(seen.clone().count(), again.agents.len(), "{name}");
        let (mut off_m, mut off_rad, mut states) = (0.0_f64, 0.0_f64, 0);
        for (a, b) in seen.zip(&again.agents) {
            assert_eq!((&a.id, a.agent_type), (&b.id, b.agent_type), "{name}");
            assert_eq!(a.role, b.role, "{name}: {}", a.id);
            assert!(
                (a.size.length_m - b.size.length_m).abs() + (a.size.width_m - b.size.width_m).abs() < 1e-5
            );
            for step in 0..scene.time.steps {
                let (Some(p), Some(q)) = (a.track.at(step), b.track.at(step)) else {
                    assert_eq!(a.track.at(step).is_some(), b.track.at(step).is_some(), "{} at {step}", a.id);
                    continue;
                };
                states += 1;
                off_m = off_m.max((p.position() - q.position() - shift).norm());
                off_rad = off_rad.max(scene::wrap_angle(p.heading_rad - q.heading_rad).abs());
            }
        }
        assert!(states > 500 && off_m < 1e-3 && off_rad < 1e-4, "{name}: {states}, {off_m} m, {off_rad} rad");
        // What differs is said: speeds that follow from the places.
        let codes: BTreeSet<&str> = warnings.iter().map(|warning| warning.code).collect();
        assert!(codes.contains("velocities-derived"), "{codes:?}");
        lights_come_back(&scene, &again, shift);
    }
}

/// Lights of lanes are where they were, and show the same at each step.
fn lights_come_back(scene: &Scene, again: &Scene, shift: Vec2) {
    let of_lanes = |signal: &&Signal| scene.map.lane_index(&signal.lane).is_some();
    let written: Vec<&Signal> = scene.signals.iter().filter(of_lanes).collect();
    assert_eq!(again.signals.len(), written.len(), "{}", scene.name);
    let middle = |scene: &Scene, lane: &str| {
        let lane = &scene.map.lanes[scene.map.lane_index(lane).unwrap()];
        lane.points.xy[lane.points.xy.len() / 2]
    };
    let mut far = 0;
    for signal in &written {
        let stop = signal.stop.unwrap();
        // Ways that begin at one place differ in their middle.
        let off_m = |other: &&Signal| {
            let apart = middle(scene, &signal.lane) - middle(again, &other.lane) - shift;
            (stop - other.stop.unwrap() - shift).norm() + 0.01 * apart.norm()
        };
        let found = again.signals.iter().min_by(|a, b| off_m(a).total_cmp(&off_m(b))).unwrap();
        // A way that begins beside the lane before it is bent to that, and its stop line with it.
        let moved_m = (stop - found.stop.unwrap() - shift).norm();
        far += usize::from(moved_m > 0.1);
        assert!(moved_m < 1.0, "{}: {} by {moved_m} m", scene.name, signal.lane);
        for step in 0..scene.time.steps {
            assert_eq!(found.at(step), plain(signal.at(step)), "{}: {} at {step}", scene.name, signal.lane);
        }
    }
    assert!(far * 20 <= written.len(), "{}: {far} of {}", scene.name, written.len());
}

/// Arrows are written as plain lights.
fn plain(state: SignalState) -> SignalState {
    match state {
        SignalState::ArrowGo => SignalState::Go,
        SignalState::ArrowCaution => SignalState::Caution,
        SignalState::ArrowStop => SignalState::Stop,
        other => other,
    }
}

const MAP: &str = r#"<OpenDRIVE><header revMajor="1" revMinor="6"/><road id="1" length="200" junction="-1">
<planView><geometry s="0" x="100" y="50" hdg="0" length="200"><line/></geometry></planView><lanes><laneSection s="0">
<left><lane id="1" type="driving"><width sOffset="0" a="3.5" b="0" c="0" d="0"/></lane></left>
<center><lane id="0" type="none"/></center><right>
<lane id="-1" type="driving"><width sOffset="0" a="3.5" b="0" c="0" d="0"/></lane>
<lane id="-2" type="driving"><width sOffset="0" a="3.5" b="0" c="0" d="0"/></lane></right>
</laneSection></lanes></road></OpenDRIVE>"#;

const CATALOG: &str = r#"<OpenSCENARIO><FileHeader/><Catalog name="cars"><Vehicle name="van" vehicleCategory="$kind">
<ParameterDeclarations><ParameterDeclaration name="kind" parameterType="string" value="car"/></ParameterDeclarations>
<BoundingBox><Center x="1.5" y="0" z="0.9"/><Dimensions width="2" length="5" height="1.8"/></BoundingBox>
</Vehicle></Catalog></OpenSCENARIO>"#;

/// A scenario of five road users, with these positions at the start and this story.
fn scenario(positions: &[(&str, &str)], story: &str) -> String {
    let reference = r#"<CatalogReference catalogName="cars" entryName="van"><ParameterAssignments><ParameterAssignment parameterRef="kind" value="van"/></ParameterAssignments></CatalogReference>"#;
    let mut entities = String::new();
    let mut init = String::new();
    for (name, position) in positions {
        entities += &format!(r#"<ScenarioObject name="{name}">{reference}</ScenarioObject>"#);
        init += &format!(
            r#"<Private entityRef="{name}"><PrivateAction><TeleportAction><Position>{position}</Position></TeleportAction></PrivateAction>
            <PrivateAction><LongitudinalAction><SpeedAction><SpeedActionDynamics dynamicsShape="step" value="0" dynamicsDimension="time"/><SpeedActionTarget><AbsoluteTargetSpeed value="${{$v / 2}}"/></SpeedActionTarget></SpeedAction></LongitudinalAction></PrivateAction></Private>"#
        );
    }
    format!(
        r#"<OpenSCENARIO><FileHeader revMajor="1" revMinor="2" description="made by hand"/>
        <ParameterDeclarations><ParameterDeclaration name="v" parameterType="double" value="20"/><ParameterDeclaration name="s" parameterType="double" value="${{$v + 10}}"/></ParameterDeclarations>
        <CatalogLocations/><RoadNetwork><LogicFile filepath="../maps/road.xodr"/></RoadNetwork>
        <Entities>{entities}</Entities><Storyboard><Init><Actions>{init}</Actions></Init>{story}<StopTrigger/></Storyboard></OpenSCENARIO>"#
    )
}

#[test]
fn positions_follow_from_the_road_network_and_from_others() {
    let positions = [
        // Refers to one that comes later.
        ("behind", r#"<RelativeObjectPosition entityRef="ego" dx="-10" dy="2"/>"#),
        ("ego", r#"<LanePosition roadId="1" laneId="-2" s="$s" offset="0.5"/>"#),
        ("oncoming", r#"<LanePosition roadId="1" laneId="1" s="100"/>"#),
        (
            "turned",
            r#"<RoadPosition roadId="1" s="40" t="-1.75"><Orientation type="relative" h="0.5"/></RoadPosition>"#,
        ),
        ("beside", r#"<RelativeLanePosition entityRef="ego" dLane="1" ds="20" offset="0"/>"#),
        (
            "world",
            r#"<RelativeWorldPosition entityRef="turned" dx="1" dy="1"><Orientation type="absolute" h="1.25"/></RelativeWorldPosition>"#,
        ),
        ("lost", r#"<GeoPosition latitude="48" longitude="11"/>"#),
    ];
    let text = scenario(&positions, "");
    let bytes =
        zipped(&[("a/scenario.xosc", &text), ("a/catalogs/cars.xosc", CATALOG), ("a/maps/road.xodr", MAP)]);
    let (scene, warnings) = read(&bytes, "set.zip").unwrap();
    assert_eq!((scene.name.as_str(), scene.time.now_step), ("made by hand", 0));
    let origin = Vec2::new(scene.meta.origin.x_m, scene.meta.origin.y_m);
    let expected = [
        ("ego", 130.0, 50.0 - 5.25 + 0.5, 0.0),
        ("behind", 120.0, 50.0 - 4.75 + 2.0, 0.0),
        ("oncoming", 200.0, 51.75, std::f64::consts::PI),
        ("turned", 140.0, 48.25, 0.5),
        ("beside", 150.0, 48.25, 0.0),
        ("world", 141.0, 49.25, 1.25),
    ];
    for (id, x, y, heading) in expected {
        let agent = scene.agents.iter().find(|agent| agent.id == id).unwrap();
        let state = agent.track.at(0).unwrap();
        // The middle of the box is 1.5 m ahead of the place that is stated.
        let ahead = scene::geometry::direction(heading) * 1.5;
        let off = (state.position() + origin - ahead - Vec2::new(x, y)).norm();
        assert!(
            off < 1e-3 && scene::wrap_angle(state.heading_rad - heading).abs() < 1e-3,
            "{id}: {off} {state:?}"
        );
        assert!((state.velocity().norm() - 10.0).abs() < 1e-9);
        assert_eq!((agent.subtype, agent.size.length_m), (Subtype::Van, 5.0));
    }
    let roles: Vec<&str> = scene.agents.iter().filter(|a| a.role.is_some()).map(|a| a.id.as_str()).collect();
    assert_eq!(roles, ["ego"]);
    let unread = warnings.iter().find(|warning| warning.code == "parts-unread").unwrap();
    assert_eq!(
        unread.detail,
        "1 element is not read: /OpenSCENARIO/Storyboard/Init/Actions/Private[lost]/PrivateAction/TeleportAction/Position/GeoPosition"
    );
}

const START: &str = r#"<StartTrigger><ConditionGroup><Condition name="t" delay="0.5" conditionEdge="none"><ByValueCondition><SimulationTimeCondition value="1.5" rule="greaterThan"/></ByValueCondition></Condition></ConditionGroup></StartTrigger>"#;

fn event(name: &str, action: &str, trigger: &str) -> String {
    format!(
        r#"<Event name="{name}" priority="parallel"><Action name="a"><PrivateAction>{action}</PrivateAction></Action>{trigger}</Event>"#
    )
}

fn follow(shape: &str, time: &str) -> String {
    format!(
        r#"<RoutingAction><FollowTrajectoryAction><TrajectoryRef><Trajectory name="t" closed="false"><Shape>{shape}</Shape></Trajectory></TrajectoryRef><TimeReference>{time}</TimeReference><TrajectoryFollowingMode followingMode="position"/></FollowTrajectoryAction></RoutingAction>"#
    )
}

#[test]
fn trajectories_are_followed_and_manoeuvres_listed_by_their_place() {
    let vertex = |time: f64, x: f64| {
        format!(r#"<Vertex time="{time}"><Position><WorldPosition x="{x}" y="$y"/></Position></Vertex>"#)
    };
    let line = format!("<Polyline>{}{}{}</Polyline>", vertex(0.0, 0.0), vertex(1.0, 10.0), vertex(2.0, 30.0));
    let relative = r#"<Timing domainAbsoluteRelative="relative" scale="1" offset="0"/>"#;
    let events = [
        event("goes", &follow(&line, relative), START),
        event("bends", &follow("<Clothoid length=\"9\"/>", relative), START),
        event("brakes", "<LongitudinalAction><SpeedAction/></LongitudinalAction>", START),
        event(
            "reacts",
            &follow(&line, relative),
            "<StartTrigger><ConditionGroup><Condition name=\"c\"><ByEntityCondition/></Condition></ConditionGroup></StartTrigger>",
        ),
    ];
    let story = format!(
        r#"<Story name="s"><ParameterDeclarations><ParameterDeclaration name="y" parameterType="double" value="7"/></ParameterDeclarations><Act name="a"><ManeuverGroup name="g" maximumExecutionCount="1"><Actors selectTriggeringEntities="false"><EntityRef entityRef="ego"/></Actors><Maneuver name="m">{}</Maneuver></ManeuverGroup></Act></Story>"#,
        events.concat()
    );
    let text = scenario(&[("ego", r#"<WorldPosition x="-50" y="7" h="0"/>"#)], &story);
    let (scene, warnings) = read(text.as_bytes(), "a.xosc").unwrap();
    let ego = &scene.agents[0];
    assert_eq!(ego.agent_type, AgentType::Vehicle);
    // The act begins at 2.0 s: from then on in steps of a tenth of a second.
    let origin = Vec2::new(scene.meta.origin.x_m, scene.meta.origin.y_m);
    let at = |step: usize| ego.track.at(step).map(|state| state.position() + origin);
    assert_eq!(
        (at(20), at(25), at(40)),
        (Some(Vec2::new(0.0, 7.0)), Some(Vec2::new(5.0, 7.0)), Some(Vec2::new(30.0, 7.0)))
    );
    assert_eq!((at(0), at(41)), (Some(Vec2::new(-50.0, 7.0)), None));
    let unread = &warnings.iter().find(|warning| warning.code == "parts-unread").unwrap().detail;
    let group = "/OpenSCENARIO/Storyboard/Story[s]/Act[a]/ManeuverGroup[g]/Maneuver[m]";
    for place in [
        "/OpenSCENARIO/RoadNetwork/LogicFile[../maps/road.xodr]".to_owned(),
        "/OpenSCENARIO/Entities/ScenarioObject[ego]/CatalogReference[van]".to_owned(),
        format!(
            "{group}/Event[bends]/Action[a]/PrivateAction/RoutingAction/FollowTrajectoryAction/Trajectory/Shape/Clothoid"
        ),
        format!("{group}/Event[brakes]/Action[a]/PrivateAction/LongitudinalAction/SpeedAction"),
        format!("{group}/Event[reacts]"),
    ] {
        assert!(unread.contains(&place), "{place} is not in {unread}");
    }
    assert!(unread.starts_with("5 elements"), "{unread}");
}

#[test]
fn broken_scenarios_are_refused_with_their_place() {
    let fault = |text: &str| read(text.as_bytes(), "a.xosc").unwrap_err().problems[0].detail.clone();
    let text = scenario(&[("ego", r#"<WorldPosition x="$w" y="0"/>"#)], "");
    assert!(fault(&text).contains("\"$w\" found in <WorldPosition>, the name of a declared parameter"));
    let text = scenario(&[("ego", r#"<WorldPosition x="far" y="0"/>"#)], "");
    assert!(fault(&text).contains("\"far\" found in <WorldPosition>, a number"), "{}", fault(&text));
    assert_eq!(fault("<OpenSCENARIO><Entities/></OpenSCENARIO>"), "the file has no road user");
    assert!(fault("<OpenSCENARIO><Entities>").contains("the file ends inside"));
    let whole = scenario(&[("ego", r#"<WorldPosition x="1" y="0"/>"#)], "");
    // Cut anywhere, a file is refused or read, never more.
    for end in (0..whole.len()).step_by(37).filter(|end| whole.is_char_boundary(*end)) {
        let _ = read(&whole.as_bytes()[..end], "a.xosc");
    }
    let bytes = zipped(&[("a.xosc", &whole), ("road.xodr", "<OpenDRIVE>")]);
    assert!(read(&bytes, "a.zip").is_err(), "a map that cannot be read is no map that is missing");
}

#[test]
fn lights_follow_the_phases_of_their_controllers() {
    let light = |id: &str, s: u32| {
        format!(
            r#"<signal s="{s}" t="-4" id="{id}" name="light" dynamic="yes" orientation="+" zOffset="3" type="1000001" subtype="-1"/>"#
        )
    };
    let signals = format!("</lanes><signals>{}{}</signals>", light("7", 150), light("8", 160));
    let map = MAP.replace("</lanes>", &signals);
    let state =
        |id: &str, state: &str| format!(r#"<TrafficSignalState trafficSignalId="{id}" state="{state}"/>"#);
    let phase = |name: &str, duration: &str, states: String| {
        format!(r#"<Phase name="{name}" duration="{duration}">{states}</Phase>"#)
    };
    let first = phase("a", "2", state("7", "off;off;on"))
        + &phase("b", "1", state("7", "off;on;off"))
        + &phase("stop", "3", state("7", ""));
    let controllers = format!(
        r#"<TrafficSignals><TrafficSignalController name="one">{first}</TrafficSignalController>
        <TrafficSignalController name="late" reference="one" delay="1.5">{}</TrafficSignalController>
        <TrafficSignalController name="elsewhere">{}</TrafficSignalController></TrafficSignals>"#,
        first.replace("\"7\"", "\"7b\""),
        phase("go", "INF", state("nowhere", "green")),
    );
    let ego = [("ego", r#"<LanePosition roadId="1" laneId="-1" s="20"/>"#)];
    let text = scenario(&ego, "").replace("</RoadNetwork>", &format!("{controllers}</RoadNetwork>"));
    let opened = |text: &str| {
        read(&zipped(&[("a.xosc", text), ("cars.xosc", CATALOG), ("road.xodr", &map)]), "set.zip").unwrap()
    };
    let (scene, warnings) = opened(&text);
    let shown = |scene: &Scene, step: usize| -> Vec<SignalState> {
        scene.signals.iter().map(|signal| signal.at(step)).collect()
    };
    // Both lanes of the direction obey the light, whose cycle lasts 6 s.
    use SignalState::{Caution, Go, Stop};
    for (step, state) in [(0, Go), (19, Go), (20, Caution), (30, Stop), (59, Stop), (60, Go), (80, Caution)] {
        assert_eq!(shown(&scene, step), [state; 2], "at {step}");
    }
    let stop_x = |signal: &Signal| signal.stop.unwrap().x + scene.meta.origin.x_m;
    assert!(scene.signals.iter().all(|signal| (stop_x(signal) - 250.0).abs() < 0.01));
    let unread = warnings.iter().find(|warning| warning.code == "parts-unread").unwrap().detail.clone();
    for place in ["TrafficSignalController[late]", "TrafficSignalController[elsewhere]"] {
        assert!(unread.contains(place), "{unread}");
    }
    assert!(!unread.contains("[one]"), "{unread}");
    // The same cycle, 1.5 s later.
    let (late, _) = opened(&text.replace("\"7\"", "\"9\"").replace("\"7b\"", "\"7\""));
    for (step, state) in [(0, Stop), (14, Stop), (15, Go), (34, Go), (35, Caution), (45, Stop), (75, Go)] {
        assert_eq!(shown(&late, step), [state; 2], "at {step}");
    }
}
