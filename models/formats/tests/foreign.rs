//! Files of other programs at the edges of their formats: each is read as it is meant, and what was changed is said.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test stops at the first surprise")]

use formats::{ExportOptions, ImportOptions, Imported, ReadError, registry};
use scene::geometry::rotate;
use scene::map::{Lane, LaneMap, LaneType};
use scene::{Scene, Vec2};

fn import(bytes: &[u8], name: &str) -> Result<Imported, ReadError> {
    registry::import(bytes, name, "auto", &ImportOptions::default())?.remove(0)
}

fn map(text: &str, name: &str) -> Imported {
    import(text.as_bytes(), name).unwrap()
}

fn codes(imported: &Imported) -> Vec<&str> {
    imported.1.iter().map(|warning| warning.code).collect()
}

fn lane<'a>(map: &'a LaneMap, id: &str) -> &'a Lane {
    map.lanes.iter().find(|lane| lane.id == id).unwrap_or_else(|| panic!("no lane {id}"))
}

/// A place of the scene in the frame of its file.
fn place(scene: &Scene, p: Vec2) -> Vec2 {
    let origin = &scene.meta.origin;
    rotate(p, origin.rotation_rad) + Vec2::new(origin.x_m, origin.y_m)
}

fn written(scene: &Scene, format: &str) -> String {
    let file = registry::by_id(format).unwrap().export(&[scene], &ExportOptions::default()).unwrap();
    String::from_utf8(file.bytes).unwrap()
}

/// Links as pairs of ids.
fn links(map: &LaneMap) -> Vec<(&str, &str)> {
    let of = |lane| {
        let lane: &Lane = lane;
        lane.successors.iter().map(|next| (lane.id.as_str(), next.as_str()))
    };
    map.lanes.iter().flat_map(of).collect()
}

mod opendrive {
    use super::*;

    const MICRO: &str = include_str!("fixtures/foreign/xodr-micro-section-end.xodr");

    #[test]
    fn links_lead_through_sections_that_are_left_out() {
        let (scene, _) = map(MICRO, "a.xodr");
        // Lane 2.0.-1 leads away from road 1, to nowhere.
        assert_eq!(links(&scene.map), [("1.0.-1", "2.0.1")]);
    }

    /// Roads of one lane section each besides a short one, which renumbers lane 1 to 2; `(road, lanes)`.
    fn two_roads(first: &str, second: &str) -> String {
        let road = |id: usize, x: f64, link: &str, lanes: &str| {
            format!(
                "<road id='{id}' length='50' junction='-1'><link>{link}</link><planView><geometry s='0' x='{x}' y='0' \
                 hdg='0' length='50'><line/></geometry></planView><lanes>{lanes}</lanes></road>"
            )
        };
        let on = "<successor elementType='road' elementId='2' contactPoint='start'/>";
        let back = "<predecessor elementType='road' elementId='1' contactPoint='end'/>";
        format!("<OpenDRIVE><header/>{}{}</OpenDRIVE>", road(1, 0.0, on, first), road(2, 50.0, back, second))
    }

    fn section(s: f64, lanes: &[(i32, &str)]) -> String {
        let one = |(id, link): &(i32, &str)| {
            format!(
                "<lane id='{id}' type='driving'><link>{link}</link><width sOffset='0' a='3.5' b='0' c='0' d='0'/></lane>"
            )
        };
        let side = |left: bool| -> String {
            lanes.iter().filter(|(id, _)| (*id > 0) == left).map(one).collect::<Vec<_>>().join("")
        };
        format!(
            "<laneSection s='{s}'><left>{}</left><center><lane id='0' type='none'/></center><right>{}</right></laneSection>",
            side(true),
            side(false)
        )
    }

    #[test]
    fn a_short_section_at_a_beginning_is_passed_in_both_directions() {
        // Road 2 begins with a short section, in which lane -1 is -2 and lane 1 is 2 of what follows.
        let first = section(0.0, &[(-1, "<successor id='-1'/>"), (1, "<successor id='1'/>")]);
        let short = section(
            0.0,
            &[
                (-1, "<predecessor id='-1'/><successor id='-2'/>"),
                (1, "<predecessor id='1'/><successor id='2'/>"),
            ],
        );
        let rest = section(
            0.0005,
            &[(-2, "<predecessor id='-1'/>"), (-1, ""), (1, ""), (2, "<predecessor id='1'/>")],
        );
        // So that -2 lies where -1 of the first road does, no lanes lie between: the widths of -1 and 1 are none.
        let rest = rest.replace(
            "<lane id='-1' type='driving'><link></link><width sOffset='0' a='3.5'",
            "<lane id='-1' type='none'><link></link><width sOffset='0' a='0.0'",
        );
        let rest = rest.replace(
            "<lane id='1' type='driving'><link></link><width sOffset='0' a='3.5'",
            "<lane id='1' type='none'><link></link><width sOffset='0' a='0.0'",
        );
        let (scene, _) = map(&two_roads(&first, &(short + &rest)), "a.xodr");
        let mut found = links(&scene.map);
        found.sort_unstable();
        assert_eq!(found, [("1.0.-1", "2.1.-2"), ("2.1.2", "1.0.1")]);
    }

    #[test]
    fn a_short_section_in_the_middle_keeps_its_renumbering() {
        let first = section(0.0, &[(-1, "<successor id='-2'/>")])
            + &section(30.0, &[(-2, "<predecessor id='-1'/><successor id='-1'/>"), (-1, "")])
            + &section(30.0002, &[(-1, "<predecessor id='-2'/><successor id='-1'/>")]);
        let second = section(0.0, &[(-1, "<predecessor id='-1'/>")]);
        let (scene, _) = map(&two_roads(&first, &second), "a.xodr");
        assert_eq!(links(&scene.map), [("1.0.-1", "1.2.-1"), ("1.2.-1", "2.0.-1")]);
    }

    #[test]
    fn a_step_of_the_lane_offset_moves_the_next_section_alone() {
        // From 30 m on the lanes are counted from 3.5 m further left, and a lane that is none comes first.
        let step = "<laneOffset s='0' a='0'/><laneOffset s='30' a='3.5'/>".to_owned();
        let first = step
            + &section(0.0, &[(-1, "<successor id='-2'/>")])
            + &section(30.0, &[(-2, "<predecessor id='-1'/><successor id='-1'/>"), (-1, "")]);
        let second = section(0.0, &[(-1, "<predecessor id='-2'/>")]);
        let imported = map(&two_roads(&first, &second), "a.xodr");
        let scene = &imported.0;
        let before = lane(&scene.map, "1.0.-1");
        for p in before.points.xy.iter().map(|p| place(scene, *p)) {
            assert!((p.y + 1.75).abs() < 0.01, "{p:?}");
        }
        assert!((place(scene, *before.points.xy.last().unwrap()).x - 30.0).abs() < 0.01);
        assert_eq!(before.successors.len(), 1);
        let next = lane(&scene.map, &before.successors[0]);
        assert!((place(scene, next.points.xy[0]) - Vec2::new(30.0, -1.75)).norm() < 0.01);
        assert_eq!(next.successors, ["2.0.-1"]);
        assert!(!codes(&imported).contains(&"links-dropped"), "{:?}", codes(&imported));
    }

    #[test]
    fn a_lane_through_a_junction_leads_back_to_the_incoming_road() {
        let road = |id: usize, x: f64, junction: &str, link: &str| {
            format!(
                "<road id='{id}' length='20' junction='{junction}'><link>{link}</link><planView><geometry s='0' x='{x}' \
                 y='0' hdg='0' length='20'><line/></geometry></planView><lanes>{}</lanes></road>",
                section(0.0, &[(-1, ""), (1, "")])
            )
        };
        let text = format!(
            "<OpenDRIVE><header/>{}{}<junction id='9'><connection id='0' incomingRoad='1' connectingRoad='2' \
             contactPoint='start'><laneLink from='-1' to='-1'/><laneLink from='1' to='1'/></connection></junction>\
             </OpenDRIVE>",
            road(1, 0.0, "-1", "<successor elementType='junction' elementId='9'/>"),
            road(2, 20.0, "9", "<predecessor elementType='road' elementId='1' contactPoint='end'/>")
        );
        let (scene, _) = map(&text, "a.xodr");
        let mut found = links(&scene.map);
        found.sort_unstable();
        assert_eq!(found, [("1.0.-1", "2.0.-1"), ("2.0.1", "1.0.1")]);
    }

    #[test]
    fn a_link_that_one_lane_states_holds_for_both() {
        // Road 1 says nothing of what follows; lane -2 of road 2 begins beside where lane -1 ends.
        let first = section(0.0, &[(-1, ""), (1, "<predecessor id='1'/>")]);
        let second = section(0.0, &[(-2, "<predecessor id='-1'/>"), (-1, "<predecessor id='-1'/>"), (1, "")]);
        let (scene, _) = map(&two_roads(&first, &second), "a.xodr");
        assert_eq!(links(&scene.map), [("1.0.-1", "2.0.-1")]);
        assert_eq!(lane(&scene.map, "2.0.-1").predecessors, ["1.0.-1"]);
    }

    #[test]
    fn a_road_that_is_named_by_its_wrong_end_is_met_where_it_is() {
        let first = section(0.0, &[(-1, "<successor id='-1'/>")]);
        let second = section(0.0, &[(-1, "<predecessor id='-1'/><successor id='-1'/>")])
            + &section(25.0, &[(-1, "<predecessor id='-1'/>")]);
        let text = two_roads(&first, &second);
        let wrong = text.replace("elementId='2' contactPoint='start'", "elementId='2' contactPoint='end'");
        let wrong = wrong.replace("elementId='1' contactPoint='end'", "elementId='1' contactPoint='start'");
        assert_ne!(wrong, text);
        let (scene, _) = map(&wrong, "a.xodr");
        assert_eq!(links(&scene.map), [("1.0.-1", "2.0.-1"), ("2.0.-1", "2.1.-1")]);
    }

    #[test]
    fn records_a_rounding_out_of_order_hold_in_the_order_of_the_file() {
        let lanes = section(0.0, &[(-1, "")]);
        // The second record ends before it begins; the third leads back from 30 m to 40 m.
        let offsets = "<laneOffset s='0' a='-2'/><laneOffset s='30.00000000002' a='-2'/>\
                       <laneOffset s='29.99999999998' a='-2' b='0.2'/><laneOffset s='40' a='0'/>";
        let lanes = format!("{offsets}{lanes}");
        let (scene, warnings) = map(&two_roads(&lanes, &section(0.0, &[(-1, "")])), "a.xodr");
        let at = |x: f64| {
            let places = lane(&scene.map, "1.0.-1").points.xy.iter().map(|p| place(&scene, *p));
            places.min_by(|a, b| (a.x - x).abs().total_cmp(&(b.x - x).abs())).unwrap().y
        };
        for (x, y) in [(20.0, -3.75), (35.0, -2.75), (45.0, -1.75)] {
            assert!((at(x) - y).abs() < 0.15, "{x}: {}", at(x));
        }
        assert!(warnings.iter().all(|warning| warning.code != "map-faults"), "{warnings:?}");
    }

    #[test]
    fn links_across_gaps_are_dropped_and_said() {
        let imported = map(include_str!("fixtures/foreign/xodr-link-across-40-m.xodr"), "a.xodr");
        assert!(
            imported
                .0
                .map
                .lanes
                .iter()
                .all(|lane| lane.successors.is_empty() && lane.predecessors.is_empty())
        );
        assert!(codes(&imported).contains(&"links-dropped"), "{:?}", codes(&imported));
    }

    #[test]
    fn pavements_that_end_together_have_no_link_with_a_jump() {
        let imported = map(include_str!("fixtures/foreign/xodr-sidewalk-end-to-end.xodr"), "a.xodr");
        assert_eq!(links(&imported.0.map), []);
        assert!(!codes(&imported).contains(&"links-dropped"));
        // Walkers pass in both directions.
        let graph = scene::routes::LaneGraph::new(&imported.0.map);
        let near = |p: Vec2| (place(&imported.0, p) - Vec2::new(0.0, 0.0)).norm() < 3.0;
        let passes = graph
            .lanes()
            .iter()
            .filter(|lane| lane.lane_type == LaneType::Sidewalk && near(lane.path.last().position));
        let joined: usize = passes.map(|lane| lane.successors.len()).sum();
        assert!(joined >= 2, "{joined}");
    }

    #[test]
    fn the_offset_of_a_header_places_and_turns_the_origin() {
        let (scene, _) = map(include_str!("fixtures/foreign/xodr-header-offset.xodr"), "a.xodr");
        let origin = &scene.meta.origin;
        assert_eq!((origin.x_m, origin.y_m, origin.rotation_rad), (500_030.0, 5_399_998.0, 0.0));
        assert!(origin.crs.as_ref().unwrap().contains("utm"));
        let (scene, _) = map(include_str!("fixtures/foreign/xodr-header-offset-hdg.xodr"), "a.xodr");
        // The road begins at (100, 0) of the file: 100 m north of the offset once turned.
        let start = place(&scene, lane(&scene.map, "1.0.-1").points.xy[0]);
        assert!((start - Vec2::new(1_001.75, 2_100.0)).norm() < 0.01, "{start:?}");
        let again = map(&written(&scene, "opendrive"), "b.xodr").0;
        let back = place(&again, again.map.lanes[0].points.xy[0]);
        assert!((back - start).norm() < 0.01, "{back:?}");
    }

    #[test]
    fn a_link_between_sections_that_one_of_them_states_holds() {
        for (before, after) in [("<successor id='-1'/>", ""), ("", "<predecessor id='-1'/>")] {
            // Lane -2 has no link at all: it ends.
            let first = section(0.0, &[(-1, before), (-2, "")]) + &section(25.0, &[(-1, after), (-2, "")]);
            let (scene, _) = map(&two_roads(&first, &section(0.0, &[(-1, "")])), "a.xodr");
            assert_eq!(links(&scene.map), [("1.0.-1", "1.1.-1")], "{before}{after}");
        }
    }

    #[test]
    fn declared_encodings_are_read() {
        let text = include_bytes!("fixtures/foreign/xodr-latin1.xodr");
        assert_eq!(import(text, "a.xodr").unwrap().0.map.lanes.len(), 1);
        let wide: Vec<u8> = format!("\u{feff}{MICRO}").encode_utf16().flat_map(u16::to_le_bytes).collect();
        assert_eq!(import(&wide, "a.xodr").unwrap().0.map.lanes.len(), 3);
    }

    #[test]
    fn a_taper_has_the_width_of_the_part_that_is_kept() {
        let (scene, _) = map(include_str!("fixtures/foreign/xodr-tapered-width.xodr"), "a.xodr");
        let taper = lane(&scene.map, "1.0.-2");
        assert!((taper.width_m.unwrap() - 2.5).abs() < 0.1, "{:?}", taper.width_m);
        assert_eq!(lane(&scene.map, "1.0.-1").width_m, Some(3.5));
    }

    #[test]
    fn a_lane_has_one_limit_from_end_to_end() {
        let lanes = section(0.0, &[(-1, "<successor id='-1'/>")]);
        let second = section(0.0, &[(-1, "<predecessor id='-1'/>")]);
        let types = "<type s='0' type='town'><speed max='50' unit='km/h'/></type><type s='20' type='town'><speed max='30' unit='km/h'/></type><planView><geometry s='0' x='0.0'";
        let text = two_roads(&lanes, &second);
        let text = text.replacen("<planView><geometry s='0' x='0'", types, 1);
        let (scene, _) = map(&text, "a.xodr");
        let limit = |id: &str| lane(&scene.map, id).speed_limit_mps.map(|v| (v * 3.6).round());
        assert_eq!((limit("1.0.-1"), limit("1.1.-1"), limit("2.0.-1")), (Some(50.0), Some(30.0), None));
        assert_eq!(links(&scene.map), [("1.0.-1", "1.1.-1"), ("1.1.-1", "2.0.-1")]);
        // A lane's own limits, too.
        let own = "<speed sOffset='0' max='20' unit='m/s'/><speed sOffset='30' max='10' unit='m/s'/></lane>";
        let (scene, _) = map(
            &two_roads(&lanes.replacen("</lane></right>", &(own.to_owned() + "</right>"), 1), &second),
            "a.xodr",
        );
        let limit = |id: &str| lane(&scene.map, id).speed_limit_mps;
        assert_eq!((limit("1.0.-1"), limit("1.1.-1")), (Some(20.0), Some(10.0)));
    }

    #[test]
    fn sections_of_a_single_side_carry_the_other_one_on() {
        let whole = section(0.0, &[(-1, ""), (1, "")]);
        let single = "<laneSection s='20' singleSide='true'><right><lane id='-1' type='driving'><link/><width sOffset='0' a='2.5' b='0' c='0' d='0'/></lane></right></laneSection>";
        let (scene, _) = map(&two_roads(&(whole + single), &section(0.0, &[(-1, "")])), "a.xodr");
        assert_eq!(
            (lane(&scene.map, "1.1.1").width_m, lane(&scene.map, "1.1.-1").width_m),
            (Some(3.5), Some(2.5))
        );
        assert!(links(&scene.map).contains(&("1.1.1", "1.0.1")));
    }

    #[test]
    fn borders_beside_widths_are_said_in_metres() {
        let lanes = section(0.0, &[(-1, ""), (1, "")]);
        let bordered = lanes.replacen("<width sOffset='0' a='3.5'", "<border sOffset='0' a='3.5'", 1);
        let imported = map(&two_roads(&bordered, &section(0.0, &[(-1, "")])), "a.xodr");
        let said = imported.1.iter().find(|warning| warning.code == "lanes-dropped").unwrap();
        assert!(said.detail.contains("(50 m)"), "{}", said.detail);
    }

    #[test]
    fn left_hand_traffic_goes_out_as_such() {
        let net = include_str!("fixtures/foreign/sumo-left-hand.net.xml");
        let text = written(&map(net, "a.net.xml").0, "opendrive");
        assert!(text.contains("rule=\"LHT\"") && !text.contains("rule=\"RHT\""));
        // It comes back as it was.
        let again = map(&text, "b.xodr").0;
        assert!(again.map.lanes.iter().zip(&map(net, "a.net.xml").0.map.lanes).all(|(a, b)| {
            let ways = [a, b].map(|lane| lane.points.xy[1] - lane.points.xy[0]);
            ways[0].dot(&ways[1]) > 0.0
        }));
    }
}

mod lanelet2 {
    use super::*;

    const SHOULDER: &str = include_str!("fixtures/foreign/lanelet2-road-shoulder.osm");
    const SIGN: &str = include_str!("fixtures/foreign/lanelet2-speed-sign.osm");

    #[test]
    fn subtypes_and_participants_decide_who_may_pass() {
        use LaneType::{BikeLane, BusLane, Sidewalk, SurfaceStreet};
        let types = |text: &str| -> Vec<LaneType> {
            map(text, "a.osm").0.map.lanes.iter().map(|lane| lane.lane_type).collect()
        };
        assert_eq!(types(SHOULDER), [SurfaceStreet]);
        let other = |tags: &str| types(&SHOULDER.replace("<tag k=\"subtype\" v=\"road_shoulder\"/>", tags));
        for (tags, expected) in [
            ("<tag k='subtype' v='emergency_lane'/>", None),
            ("<tag k='subtype' v='something_else'/>", None),
            (
                "<tag k='subtype' v='road_shoulder'/><tag k='participant:vehicle' v='yes'/>",
                Some(SurfaceStreet),
            ),
            ("<tag k='subtype' v='road_shoulder'/><tag k='participant:vehicle' v='no'/>", None),
            ("<tag k='subtype' v='road'/><tag k='participant:vehicle:emergency' v='yes'/>", None),
            ("<tag k='subtype' v='road'/><tag k='participant:vehicle:bus' v='yes'/>", Some(BusLane)),
            ("<tag k='subtype' v='road'/><tag k='participant:bicycle' v='yes'/>", Some(BikeLane)),
            ("<tag k='subtype' v='road'/><tag k='participant:pedestrian' v='yes'/>", Some(Sidewalk)),
            ("<tag k='subtype' v='play_street'/>", Some(SurfaceStreet)),
            ("<tag k='subtype' v='bus_lane'/>", Some(BusLane)),
            ("<tag k='subtype' v='shared_walkway'/>", Some(Sidewalk)),
            ("<tag k='location' v='urban'/>", Some(SurfaceStreet)),
        ] {
            let found = other(tags);
            assert_eq!(found.len(), 1 + usize::from(expected.is_some()), "{tags}: {found:?}");
            assert!(expected.is_none_or(|kind| found.contains(&kind)), "{tags}: {found:?}");
        }
    }

    #[test]
    fn limits_come_from_signs_and_their_types() {
        let limit = |text: &str| map(text, "a.osm").0.map.lanes[0].speed_limit_mps;
        let kmh = |kmh: f64| Some((kmh / 3.6 * 1e3).round() / 1e3);
        assert_eq!(limit(SIGN), kmh(60.0));
        for (sign, expected) in [
            ("de274-5", kmh(5.0)),
            ("de274", kmh(30.0)),
            ("de310", kmh(50.0)),
            ("70 km/h", kmh(70.0)),
            ("usR2-1-25", Some(11.176)),
            ("de206", None),
        ] {
            assert_eq!(limit(&SIGN.replace("de274-60", sign)), expected, "{sign}");
        }
        // The type may stand in the rule itself.
        let rule = "<tag k=\"subtype\" v=\"speed_limit\"/>";
        let stated = SIGN.replace(rule, &format!("{rule}<tag k='sign_type' v='de274-80'/>"));
        assert_eq!(limit(&stated), kmh(80.0));
    }

    #[test]
    fn a_side_of_several_lines_is_one() {
        let whole = map(SIGN, "a.osm").0;
        // The left side in two lines, the second one drawn backwards and listed first.
        let line = "<way id=\"102\"><nd ref=\"4\"/><nd ref=\"5\"/><nd ref=\"6\"/><tag k=\"type\" v=\"line_thin\"/><tag k=\"subtype\" v=\"dashed\"/></way>";
        assert!(SIGN.contains(line));
        let two = "<way id='108'><nd ref='4'/><nd ref='5'/></way><way id='109'><nd ref='6'/><nd ref='5'/><tag k='type' v='line_thin'/><tag k='subtype' v='dashed'/></way>";
        let member = "<member type=\"way\" role=\"left\" ref=\"102\"/>";
        let members = "<member type='way' role='left' ref='109'/><member type='way' role='left' ref='108'/>";
        let pieces = map(&SIGN.replace(line, two).replace(member, members), "a.osm").0;
        assert_eq!(pieces.map.lanes[0].points, whole.map.lanes[0].points);
        let boundary = &pieces.map.lanes[0].left_boundary;
        assert_eq!(boundary.len(), 1);
        assert_eq!((boundary[0].line.as_str(), boundary[0].from, boundary[0].to), ("109", 50, 100));
    }

    #[test]
    fn what_is_in_a_file_decides_and_not_the_program_that_wrote_it() {
        let source = |text: &str| map(text, "a.osm").0.meta.source;
        assert_eq!(source(include_str!("fixtures/foreign/lanelet2-josm-bounds.osm")), "lanelet2");
        // Lanelets may stand far behind.
        let far =
            SIGN.replace("<node id=\"1\"", &format!("<!-- {} --><node id=\"1\"", "CGImap ".repeat(60_000)));
        assert_eq!(source(&far), "lanelet2");
        // Roads without lanelets go to the other reader, which asks for netconvert.
        let saved = include_str!("fixtures/foreign/osm-saved-by-josm.osm");
        let error = import(saved.as_bytes(), "a.osm").unwrap_err();
        assert!(error.to_string().contains("netconvert"), "{error}");
    }
}

mod sumo {
    use super::*;

    const LEFT: &str = include_str!("fixtures/foreign/sumo-left-hand.net.xml");

    #[test]
    fn left_hand_traffic_is_drawn_on_its_side() {
        let imported = map(LEFT, "a.net.xml");
        let scene = &imported.0;
        assert!(codes(&imported).contains(&"left-hand"));
        let ys = |points: &[Vec2]| -> (f64, f64) {
            points
                .iter()
                .map(|p| place(scene, *p).y)
                .fold((f64::MAX, f64::MIN), |(a, b), y| (a.min(y), b.max(y)))
        };
        let ground: Vec<(f64, f64)> = scene.map.drivable.iter().map(|area| ys(&area.polygon.xy)).collect();
        let (low, high) =
            ground.iter().fold((0.0_f64, 0.0_f64), |(a, b), (low, high)| (a.min(*low), b.max(*high)));
        assert!((low + 6.4).abs() < 0.05 && (high - 6.4).abs() < 0.05, "{ground:?}");
        for lane in &scene.map.lanes {
            let inside =
                lane.points.xy.iter().all(|p| scene.map.drivable.iter().any(|area| area.is_near(*p, 0.01)));
            assert!(inside, "lane {}", lane.id);
        }
        // The middle line lies between the directions, kerbs at the sides.
        let middle = scene.map.road_lines.iter().find(|line| line.line_type.contains("yellow")).unwrap();
        assert!(ys(&middle.points.xy).1.abs() < 0.05);
        assert!(scene.map.road_edges.iter().all(|edge| (ys(&edge.points.xy).0.abs() - 6.4).abs() < 0.05));
    }

    #[test]
    fn projection_and_offset_place_the_origin() {
        let location = "<location netOffset=\"-500000.00,-5400000.00\" convBoundary=\"0,0,1,1\" origBoundary=\"0,0,1,1\" projParameter=\"+proj=utm +zone=32 +ellps=WGS84 +datum=WGS84 +units=m +no_defs\"/>";
        let (from, to) = (LEFT.find("<location").unwrap(), LEFT.find("<edge").unwrap());
        let placed = format!("{}{location}{}", &LEFT[..from], &LEFT[to..]);
        let (plain, (scene, warnings)) = (map(LEFT, "a.net.xml").0, map(&placed, "a.net.xml"));
        let (a, b) = (&plain.meta.origin, &scene.meta.origin);
        assert_eq!((b.x_m - a.x_m, b.y_m - a.y_m), (500_000.0, 5_400_000.0));
        assert!(b.crs.as_ref().unwrap().contains("+zone=32") && a.crs.is_none());
        assert!(warnings.iter().all(|warning| !warning.code.contains("projection")));
    }

    #[test]
    fn a_lane_without_width_is_left_out_and_said() {
        let net = r#"<net><edge id="a" from="w" to="e">
            <lane id="a_0" index="0" speed="13.9" length="50" width="0" shape="0,-3.2 50,-3.2"/>
            <lane id="a_1" index="1" speed="13.9" length="50" width="-1" shape="0,-1.6 50,-1.6"/></edge></net>"#;
        let imported = map(net, "a.net.xml");
        let lanes = &imported.0.map.lanes;
        assert_eq!((lanes.len(), lanes[0].width_m), (1, Some(3.2)));
        assert!(codes(&imported).contains(&"lanes-dropped"), "{:?}", codes(&imported));
    }

    #[test]
    fn a_way_through_a_junction_leads_where_its_connection_does() {
        // No connection leaves the inner lane.
        let net = r#"<net><edge id=":c_0" function="internal">
            <lane id=":c_0_0" index="0" speed="8" length="5" shape="50,-1.6 55,-1.6"/></edge>
            <edge id="a" from="w" to="c"><lane id="a_0" index="0" speed="13.9" length="50" shape="0,-1.6 50,-1.6"/></edge>
            <edge id="b" from="c" to="e"><lane id="b_0" index="0" speed="13.9" length="50" shape="55,-1.6 99,-1.6"/></edge>
            <junction id="c" type="priority" x="52" y="0"/>
            <connection from="a" to="b" fromLane="0" toLane="0" via=":c_0_0" dir="s" state="M"/></net>"#;
        let (scene, _) = map(net, "a.net.xml");
        assert_eq!(links(&scene.map), [("1", "3"), ("2", "1")]);
    }

    #[test]
    fn networks_without_inner_lanes_turn_within_the_junction() {
        let net = r#"<net><edge id="a" from="w" to="c"><lane id="a_0" index="0" speed="13.9" length="50" shape="-60,-1.6 -10,-1.6"/></edge>
            <edge id="b" from="c" to="n"><lane id="b_0" index="0" speed="13.9" length="50" shape="1.6,10 1.6,60"/></edge>
            <edge id="d" from="s" to="c"><lane id="d_0" index="0" speed="13.9" length="50" shape="1.6,-60 1.6,-10"/></edge>
            <junction id="c" type="traffic_light" x="0" y="0"/>
            <tlLogic id="c" type="static" programID="0" offset="0"><phase duration="30" state="G"/></tlLogic>
            <connection from="a" to="b" fromLane="0" toLane="0" tl="c" linkIndex="0" dir="l" state="o"/></net>"#;
        let imported = map(net, "a.net.xml");
        let scene = &imported.0;
        assert!(!codes(&imported).contains(&"links-dropped"));
        assert_eq!(links(&scene.map), [("1", "4"), ("4", "2")]);
        let way = lane(&scene.map, "4");
        assert!(way.interpolating && scene.signals[0].lane == "4");
        let ends = (place(scene, way.points.xy[0]), place(scene, *way.points.xy.last().unwrap()));
        assert!(
            (ends.0 - Vec2::new(-10.0, -1.6)).norm() < 0.01 && (ends.1 - Vec2::new(1.6, 10.0)).norm() < 0.01
        );
        let within = |p: &Vec2| {
            (-10.1..=2.0).contains(&place(scene, *p).x) && (-2.0..=10.1).contains(&place(scene, *p).y)
        };
        assert!(way.points.xy.iter().all(within));
    }

    #[test]
    fn lanes_with_more_points_than_a_scene_holds_are_read() {
        let shape: Vec<String> =
            (0..6_000).map(|i| format!("{:.2},{:.2}", f64::from(i) * 0.1, f64::from(i % 2) * 0.1)).collect();
        let net = format!(
            "<net><edge id=\"a\" from=\"w\" to=\"e\"><lane id=\"a_0\" index=\"0\" speed=\"13.9\" length=\"600\" shape=\"{}\"/></edge></net>",
            shape.join(" ")
        );
        assert!(map(&net, "a.net.xml").0.map.lanes[0].points.xy.len() > 100);
    }
}

mod engines {
    use super::*;

    #[test]
    fn joined_lanes_are_linked_in_the_scene_and_its_exports() {
        let imported = map(include_str!("fixtures/foreign/gpudrive-lanes.json"), "a.json");
        assert!(codes(&imported).contains(&"no-lane-graph"));
        assert_eq!(links(&imported.0.map).len(), 2);
        assert_eq!(imported.0.map.lanes[0].successors.len(), 2);
        let net = written(&imported.0, "sumo-net");
        let connections =
            net.lines().filter(|line| line.contains("<connection") && !line.contains("from=\":"));
        assert_eq!(connections.count(), 2, "{net}");
    }

    #[test]
    fn one_heading_past_a_turn_leaves_all_others_as_they_are() {
        let text = include_str!("../../../fuzz/corpus/gpudrive/gpudrive.json");
        let (plain, _) = map(text, "a.json");
        let angle = plain.agent("7").unwrap().track.at(0).unwrap().heading_rad;
        let turned = angle + std::f64::consts::TAU + 0.5;
        let start = text.find("\"heading\": [").unwrap() + "\"heading\": [".len();
        let end = start + text[start..].find(',').unwrap();
        let imported = map(&format!("{}{turned}{}", &text[..start], &text[end..]), "a.json");
        assert!(codes(&imported).contains(&"headings-wrapped"));
        let heading = |id: &str| imported.0.agent(id).unwrap().track.at(1).unwrap().heading_rad;
        assert_eq!(heading("8"), plain.agent("8").unwrap().track.at(1).unwrap().heading_rad);
        let first = imported.0.agent("7").unwrap().track.at(0).unwrap().heading_rad;
        assert!((first - scene::wrap_angle(turned)).abs() < 1e-9);
    }
}

mod argoverse {
    use super::*;

    #[test]
    fn a_link_that_one_segment_states_holds_for_both() {
        let segment = |id: i64, x: f64, before: &str, after: &str| {
            let side = |y: f64| format!("[{{\"x\": {x}, \"y\": {y}}}, {{\"x\": {}, \"y\": {y}}}]", x + 20.0);
            format!(
                "\"{id}\": {{\"id\": {id}, \"lane_type\": \"VEHICLE\", \"left_lane_boundary\": {}, \
                 \"right_lane_boundary\": {}, \"predecessors\": {before}, \"successors\": {after}}}",
                side(1.75),
                side(-1.75)
            )
        };
        let lanes =
            [segment(1, 0.0, "[]", "[2, 9]"), segment(2, 20.0, "[]", "[]"), segment(3, 40.0, "[2]", "[]")];
        let text = format!(
            "{{\"pedestrian_crossings\": {{}}, \"lane_segments\": {{{}}}, \"drivable_areas\": {{}}}}",
            lanes.join(", ")
        );
        let (scene, _) = map(&text, "log_map_archive_a.json");
        assert_eq!(links(&scene.map), [("1", "2"), ("2", "3")]);
        let (marked, _) = map(&format!("\u{feff}{text}"), "log_map_archive_a.json");
        assert_eq!(marked.map, scene.map, "a byte order mark is no part of the text");
        let before = |id: &str| lane(&scene.map, id).predecessors.clone();
        assert_eq!(
            (before("1"), before("2"), before("3")),
            (vec![], vec!["1".to_owned()], vec!["2".to_owned()])
        );
    }
}

mod scenarionet {
    use super::*;
    use scene::map::TypedLine;

    #[test]
    fn a_number_summary_of_metadrive_is_harmless() {
        let bytes = include_bytes!("../../../fuzz/corpus/scenarionet/number-summary.pkl");
        let (scene, _) = import(bytes, "sd.pkl").unwrap();
        assert!(!scene.agents.is_empty());
    }

    #[test]
    fn painted_lines_of_many_points_are_thinned() {
        let points = |i: i32| Vec2::new(f64::from(i) * 0.1, (f64::from(i) * 0.01).sin());
        let line: Vec<Vec2> = (0..5_000).map(points).collect();
        let street = Lane::street("1", vec![Vec2::zeros(), Vec2::new(50.0, 0.0)]);
        let painted =
            TypedLine { id: "7".into(), line_type: "solid_single_white".into(), points: line.clone().into() };
        let map = LaneMap { lanes: vec![street], road_lines: vec![painted], ..LaneMap::default() };
        let states = vec![Some(scene::State::default()); 11];
        let car = scene::Agent::bare("1", scene::AgentType::Vehicle, scene::Subtype::Car, states);
        let scene = Scene::bare("a", map, vec![car]);
        let file =
            registry::by_id("scenarionet").unwrap().export(&[&scene], &ExportOptions::default()).unwrap();
        let imported = import(&file.bytes, "sd.pkl").unwrap();
        assert_eq!(codes(&imported), ["lines-thinned"]);
        let found = &imported.0.map.road_lines[0].points.xy;
        assert!((20..=4_096).contains(&found.len()), "{}", found.len());
        let off = line
            .iter()
            .map(|p| formats::polyline::distance_to(found, p - line[0] + found[0]))
            .fold(0.0, f64::max);
        assert!(off < 0.1, "{off}");
    }
}

mod tables {
    use super::*;
    use std::sync::Arc;

    fn read(text: &str, columns: &str) -> Imported {
        let columns: Arc<dyn formats::Source> = Arc::new(columns.as_bytes().to_vec());
        let options = ImportOptions { columns: Some(columns), ..ImportOptions::default() };
        registry::import(text.as_bytes(), "a.csv", "csv", &options).unwrap().remove(0).unwrap()
    }

    fn centre(scene: &Scene, id: &str) -> Vec2 {
        let state = scene.agent(id).unwrap().track.states.iter().flatten().next().unwrap();
        place(scene, state.position())
    }

    #[test]
    fn corners_become_centres() {
        let text = "frame,id,x,y,width,height,xVelocity,yVelocity\n0,1,10.0,20.0,5.0,2.0,25,0\n1,1,11.0,20.0,5.0,2.0,25,0\n";
        let columns = r#"{"agent_id": "id", "time_s": {"column": "frame", "factor": 0.04},
            "x_m": {"column": "x", "add_half": "length_m"}, "y_m": {"column": "y", "add_half": "width_m"},
            "length_m": "width", "width_m": "height"}"#;
        assert_eq!(centre(&read(text, columns).0, "1"), Vec2::new(12.5, 21.0));
        // The set counts downwards from the upper edge of its pictures.
        let (scene, _) = read(text, "highd");
        assert_eq!(centre(&scene, "1"), Vec2::new(12.5, -21.0));
        let size = scene.agent("1").unwrap().size;
        assert_eq!((size.length_m, size.width_m), (5.0, 2.0));
    }

    #[test]
    fn degrees_become_metres() {
        let rows: Vec<String> = (0..5)
            .map(|i| format!("a,{},48.1,{:.9}", f64::from(i) * 0.1, 11.5 + f64::from(i) * 1.342_62e-5))
            .collect();
        let text = format!("agent_id,time_s,lat_deg,lon_deg\n{}\n", rows.join("\n"));
        let (scene, _) = map(&text, "a.csv");
        assert!(scene.meta.origin.crs.as_ref().unwrap().contains("tmerc"));
        let states = &scene.agent("a").unwrap().track.states;
        let step = states[1].unwrap().position() - states[0].unwrap().position();
        assert!((step - Vec2::new(1.0, 0.0)).norm() < 1e-3, "{step:?}");
    }

    #[test]
    fn a_row_for_each_road_user_is_read() {
        let text = "track_id; type; traveled_d; avg_speed; lat; lon; speed; lon_acc; lat_acc; time\n\
             1; Car; 48.85; 9.77; 37.977391; 23.737688; 4.9; 0; 0; 0.0; 37.977392; 23.737689; 4.9; 0; 0; 0.1; \n\
             2; Bus; 98.09; 19.84; 37.977642; 23.737400; 16.9; 0; 0; 0.0; 37.977643; 23.737402; 16.9; 0; 0; 0.1; 37.977644; 23.737404; 16.9; 0; 0; 0.2; \n";
        let (scene, _) = read(text, "pneuma");
        let lengths: Vec<usize> =
            scene.agents.iter().map(|agent| agent.track.valid_steps().count()).collect();
        assert_eq!((scene.agents.len(), lengths), (2, vec![2, 3]));
        assert_eq!(scene.agents[1].subtype, scene::Subtype::Bus);
    }

    #[test]
    fn rows_of_one_time_are_said() {
        let text = "agent_id,time_s,x_m,y_m\na,0,0,0\na,0.1,1,0\na,0.1,1,0\na,0.2,2,0\n";
        assert!(codes(&map(text, "a.csv")).contains(&"rows-repeated"));
    }

    #[test]
    fn cells_that_a_spreadsheet_would_run_are_quoted() {
        let mut scene = map("agent_id,time_s,x_m,y_m\na,0,0,0\na,0.1,1,0\n", "a.csv").0;
        for name in ["=1+1", "+cmd", "-cmd", "@cmd"] {
            scene.name = name.to_owned();
            let options = ExportOptions { label: Some(name.to_owned()), ..ExportOptions::default() };
            let file = registry::by_id("csv").unwrap().export(&[&scene], &options).unwrap();
            let text = String::from_utf8(file.bytes.clone()).unwrap();
            assert!(text.lines().skip(1).all(|line| line.starts_with('\'')), "{text}");
            assert_eq!(map(&text, "a.csv").0.name, name);
        }
    }
}
