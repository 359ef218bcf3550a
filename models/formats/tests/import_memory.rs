//! Memory of reading, counted at the allocator: scenes come one by one from a file that is decompressed while
//! it is read. The only test of its process, because all allocations are counted.
#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test stops at the first surprise")]

use flate2::Compression;
use flate2::read::MultiGzDecoder;
use flate2::write::GzEncoder;
use formats::{ImportOptions, Source, registry, womd};
use peak_alloc::PeakAlloc;
use scene::{Agent, AgentType, LaneMap, Scene, State, Subtype};
use std::fmt::Write as _;
use std::io::{self, Read, Write};

#[global_allocator]
static ALLOCATOR: PeakAlloc = PeakAlloc;

const MIB: usize = 1 << 20;

/// A file in a gzip wrapping of its own, as a body with Content-Encoding is.
#[derive(Debug)]
struct Wrapped(Vec<u8>);

impl Source for Wrapped {
    fn open(&self) -> io::Result<Box<dyn Read + Send + '_>> {
        Ok(Box::new(MultiGzDecoder::new(self.0.as_slice())))
    }

    fn encoded_len(&self) -> u64 {
        self.0.len() as u64
    }
}

fn gzip(text: &[u8]) -> Vec<u8> {
    let mut encoder = GzEncoder::new(Vec::new(), Compression::fast());
    encoder.write_all(text).unwrap();
    encoder.finish().unwrap()
}

/// Parts of a file that come again and again, compressed without ever being there as a whole.
fn repeated(head: &[u8], item: &[u8], count: usize, tail: &[u8]) -> Vec<u8> {
    let mut encoder = GzEncoder::new(Vec::new(), Compression::fast());
    encoder.write_all(head).unwrap();
    (0..count).for_each(|_| encoder.write_all(item).unwrap());
    encoder.write_all(tail).unwrap();
    encoder.finish().unwrap()
}

/// Digits that do not pack well.
fn noise(seed: u64, i: u64) -> f64 {
    let mixed = (seed << 32 | i).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    ((mixed ^ mixed >> 29).wrapping_mul(0xbf58_476d_1ce4_e5b9) >> 44) as f64 / 1048.576
}

fn busy(agents: u64, steps: u64) -> Scene {
    let state = |agent: u64, step: u64| State {
        x_m: noise(agent, step),
        y_m: noise(agent + 1_000, step),
        heading_rad: noise(agent, step + 1_000) / 1_000.0,
        vx_mps: noise(agent + 2_000, step) / 100.0,
        vy_mps: 0.0,
    };
    let agents = (0..agents).map(|agent| {
        let states = (0..steps).map(|step| Some(state(agent, step))).collect();
        Agent::bare(agent.to_string(), AgentType::Vehicle, Subtype::Car, states)
    });
    let mut scene = Scene::bare("busy", LaneMap::default(), agents.collect());
    scene.time.steps = steps as usize;
    scene
}

fn records(count: usize) -> Vec<u8> {
    let mut file = Vec::new();
    womd::write(&[&busy(200, 91)], &mut file, false, formats::ExportedMotion::Log).unwrap();
    let mut encoder = GzEncoder::new(Vec::new(), Compression::fast());
    (0..count).for_each(|_| encoder.write_all(&file).unwrap());
    encoder.finish().unwrap()
}

fn fcd(steps: u64, cars: u64) -> Vec<u8> {
    let mut encoder = GzEncoder::new(Vec::new(), Compression::fast());
    encoder.write_all(b"<fcd-export>").unwrap();
    for step in 0..steps {
        let mut text = format!("<timestep time=\"{:.1}\">\n", step as f64 / 10.0);
        for car in 0..cars {
            writeln!(
                text,
                "<vehicle id=\"{car}\" x=\"{:.2}\" y=\"{car}.00\" angle=\"90.00\" type=\"car\" \
                 speed=\"{:.2}\" pos=\"{:.2}\" lane=\"edge{}_0\"/>",
                step as f64 + car as f64 * 3.0,
                noise(car, step) / 100.0,
                noise(step, car),
                car % 20
            )
            .unwrap();
        }
        text.push_str("</timestep>\n");
        encoder.write_all(text.as_bytes()).unwrap();
    }
    encoder.write_all(b"</fcd-export>").unwrap();
    encoder.finish().unwrap()
}

/// So many scenes of 200 road users.
fn table(format: &str, count: usize) -> Vec<u8> {
    let scene = busy(200, 91);
    let scenes = vec![&scene; count];
    registry::by_id(format).unwrap().export(&scenes, &Default::default()).unwrap().bytes
}

/// One road user for so many steps.
fn long_table(rows: usize) -> Vec<u8> {
    let mut encoder = GzEncoder::new(Vec::new(), Compression::fast());
    encoder.write_all(b"agent_id,type,time_s,x_m,y_m\n").unwrap();
    for row in 0..rows as u64 {
        let text =
            format!("7,car,{:.1},{:.3},{:.3}\n", row as f64 / 10.0, noise(1, row) / 1e3, noise(2, row) / 1e3);
        encoder.write_all(text.as_bytes()).unwrap();
    }
    encoder.finish().unwrap()
}

fn net(edges: usize) -> Vec<u8> {
    let mut text = String::from("<net>");
    for edge in 0..edges {
        let y = edge as f64 * 4.0 - 8_000.0;
        let shape: Vec<String> = (0..40)
            .map(|i| format!("{:.2},{:.2}", f64::from(i) * 4.0, y + noise(7, i as u64) / 1_000.0))
            .collect();
        write!(
            text,
            "<edge id=\"e{edge}\" from=\"a{edge}\" to=\"b{edge}\"><lane id=\"e{edge}_0\" index=\"0\" speed=\"13.9\" \
             length=\"160\" shape=\"{}\"/></edge>",
            shape.join(" ")
        )
        .unwrap();
    }
    text.push_str("</net>");
    gzip(text.as_bytes())
}

/// Bent roads of two lanes, so many metres long.
fn roads(count: usize, length_m: usize) -> Vec<u8> {
    let mut text = String::from("<OpenDRIVE>");
    for i in 0..count {
        let lane = |id: i32| {
            format!(
                "<lane id=\"{id}\" type=\"driving\"><width sOffset=\"0\" a=\"3.5\" b=\"0\" c=\"0\" d=\"0\"/></lane>"
            )
        };
        write!(
            text,
            "<road id=\"{i}\" length=\"{length_m}\"><planView><geometry s=\"0\" x=\"{}\" y=\"{}\" hdg=\"0\" \
             length=\"{length_m}\"><arc curvature=\"{:.6}\"/></geometry></planView><lanes><laneSection s=\"0\">\
             <left>{}</left><right>{}</right></laneSection></lanes></road>",
            i % 20 * 300,
            i / 20 * 300,
            0.008 + noise(3, i as u64) / 1e6,
            lane(1),
            lane(-1)
        )
        .unwrap();
    }
    gzip((text + "</OpenDRIVE>").as_bytes())
}

/// A ring of so many lanes, in both directions, of a road that meets itself.
fn ring(lanes: usize, length_m: usize) -> Vec<u8> {
    let lane = |id: i64| {
        format!(
            "<lane id=\"{id}\" type=\"driving\"><link><predecessor id=\"{id}\"/><successor id=\"{id}\"/></link>\
             <width sOffset=\"0\" a=\"3.5\" b=\"0\" c=\"0\" d=\"0\"/><roadMark sOffset=\"0\" type=\"broken\"/></lane>"
        )
    };
    let side = |sign: i64| (1..=lanes as i64 / 2).map(|id| lane(sign * id)).collect::<String>();
    let text = format!(
        "<OpenDRIVE><road id=\"0\" length=\"{length_m}\"><link><predecessor elementType=\"road\" elementId=\"0\" \
         contactPoint=\"end\"/><successor elementType=\"road\" elementId=\"0\" contactPoint=\"start\"/></link><planView>\
         <geometry s=\"0\" x=\"0\" y=\"0\" hdg=\"0\" length=\"{length_m}\"><arc curvature=\"{}\"/></geometry></planView>\
         <lanes><laneSection s=\"0\"><left>{}</left><right>{}</right></laneSection></lanes></road></OpenDRIVE>",
        std::f64::consts::TAU / length_m as f64,
        side(1),
        side(-1)
    );
    gzip(text.as_bytes())
}

/// Straight roads on each other, in sections of 1.9 km with as many points as a lane may have.
fn straight_roads(count: usize, lanes: usize, length_m: usize) -> Vec<u8> {
    let mut text = String::from("<OpenDRIVE>");
    let lane = |id: usize| {
        format!(
            "<lane id=\"-{id}\" type=\"driving\"><width sOffset=\"0\" a=\"3.5\" b=\"0\" c=\"0\" d=\"0\"/>\
             <roadMark sOffset=\"0\" type=\"broken\" color=\"white\" width=\"0.12\"/></lane>"
        )
    };
    let lanes: String = (1..=lanes).map(lane).collect();
    for i in 0..count {
        let sections = (0..length_m.div_ceil(1_900))
            .map(|k| format!("<laneSection s=\"{}\"><right>{lanes}</right></laneSection>", k * 1_900));
        let sections: String = sections.collect();
        write!(
            text,
            "<road id=\"{i}\" length=\"{length_m}\"><planView><geometry s=\"0\" x=\"0\" y=\"{i}\" hdg=\"0\" \
             length=\"{length_m}\"><line/></geometry></planView><lanes>{sections}</lanes></road>"
        )
        .unwrap();
    }
    gzip((text + "</OpenDRIVE>").as_bytes())
}

/// Straight roads that cross in one place, with lanes that nobody drives on between those of traffic.
fn star(count: usize, lanes: usize, length_m: usize) -> Vec<u8> {
    let lane = |id: usize| {
        let kind = if id.is_multiple_of(2) { "median" } else { "driving" };
        format!(
            "<lane id=\"-{id}\" type=\"{kind}\"><width sOffset=\"0\" a=\"3.5\" b=\"0\" c=\"0\" d=\"0\"/></lane>"
        )
    };
    let lanes: String = (1..=lanes).map(lane).collect();
    let road = |i: usize| {
        let (sin, cos) = (std::f64::consts::PI * i as f64 / count as f64).sin_cos();
        let half_m = length_m as f64 / 2.0;
        format!(
            "<road id=\"{i}\" length=\"{length_m}\"><planView><geometry s=\"0\" x=\"{}\" y=\"{}\" hdg=\"{}\" \
             length=\"{length_m}\"><line/></geometry></planView><lanes><laneSection s=\"0\"><right>{lanes}</right>\
             </laneSection></lanes></road>",
            -half_m * cos,
            -half_m * sin,
            sin.atan2(cos)
        )
    };
    gzip(format!("<OpenDRIVE>{}</OpenDRIVE>", (0..count).map(road).collect::<String>()).as_bytes())
}

/// Lanelets of 20 points a side.
fn lanelets(count: usize) -> Vec<u8> {
    let (mut nodes, mut ways, mut relations) = (String::new(), String::new(), String::new());
    for i in 0..count {
        let y = i as f64 * 4.0 - 6_000.0;
        for side in 0..2 {
            let id = i * 2 + side + 1;
            write!(ways, "<way id=\"{id}\">").unwrap();
            for k in 0..20 {
                let node = id * 100 + k;
                let (x, y) = (k as f64 * 4.0, y - side as f64 * 3.0 + noise(5, node as u64) / 1e4);
                write!(
                    nodes,
                    "<node id=\"{node}\"><tag k=\"local_x\" v=\"{x}\"/><tag k=\"local_y\" v=\"{y:.3}\"/></node>"
                )
                .unwrap();
                write!(ways, "<nd ref=\"{node}\"/>").unwrap();
            }
            ways.push_str("</way>");
        }
        write!(
            relations,
            "<relation id=\"{i}\"><member type=\"way\" ref=\"{}\" role=\"left\"/><member type=\"way\" ref=\"{}\" \
             role=\"right\"/><tag k=\"type\" v=\"lanelet\"/></relation>",
            i * 2 + 1,
            i * 2 + 2
        )
        .unwrap();
    }
    gzip(format!("<osm>{nodes}{ways}{relations}</osm>").as_bytes())
}

/// A street of lanelets of 20 points a side, and cars with 200 states.
fn scenario(lanelets: usize, cars: usize) -> Vec<u8> {
    let mut text =
        String::from("<commonRoad commonRoadVersion=\"2020a\" timeStepSize=\"0.1\" benchmarkID=\"ZAM_a-1\">");
    let point = |x: f64, y: f64| format!("<point><x>{x:.3}</x><y>{y:.3}</y></point>");
    for i in 0..lanelets {
        let y = i as f64 * 4.0 - 4_000.0;
        let side = |off: f64| -> String {
            (0..20)
                .map(|k| point(f64::from(k) * 4.0, y + off + noise(5, i as u64 * 20 + k as u64) / 1e4))
                .collect()
        };
        write!(
            text,
            "<lanelet id=\"{}\"><leftBound>{}</leftBound><rightBound>{}</rightBound><laneletType>urban</laneletType></lanelet>",
            i + 1,
            side(3.0),
            side(0.0)
        )
        .unwrap();
    }
    for car in 0..cars {
        write!(
            text,
            "<dynamicObstacle id=\"{}\"><type>car</type><shape><rectangle><length>4</length><width>2</width></rectangle></shape>",
            car + 100_000
        )
        .unwrap();
        for step in 0..200 {
            let name = if step == 0 { "initialState" } else { "state" };
            let begin = if step == 1 { "<trajectory>" } else { "" };
            write!(
                text,
                "{begin}<{name}><position>{}</position><orientation><exact>0</exact></orientation><time><exact>{step}</exact></time>\
                 <velocity><exact>{:.3}</exact></velocity></{name}>",
                point(f64::from(step), car as f64 * 4.0 - 600.0),
                noise(car as u64, step as u64) / 100.0
            )
            .unwrap();
        }
        text.push_str("</trajectory></dynamicObstacle>");
    }
    gzip((text + "</commonRoad>").as_bytes())
}

/// Export of many road users over many steps.
fn exported(format: &str) -> Vec<u8> {
    let scene = busy(256, 600);
    registry::by_id(format).unwrap().export(&[&scene], &formats::ExportOptions::default()).unwrap().bytes
}

/// Reads a file, one scene after another: how many there are, the first fault, and the most bytes that were
/// allocated beside the file.
fn read(file: &dyn Source, format: &str) -> (usize, Option<&'static str>, usize) {
    let before = ALLOCATOR.current_usage();
    ALLOCATOR.reset_peak_usage();
    let options = ImportOptions::default();
    let (mut count, mut fault) = (0, None);
    for read in registry::scenes(file, "", format, &options).unwrap() {
        match read {
            Ok(_) => count += 1,
            Err(error) => fault = fault.or(Some(error.code())),
        }
    }
    (count, fault, ALLOCATOR.peak_usage() - before)
}

/// Name, format, file; scenes, the first fault, and most MiB beside the file.
type Tried = (&'static str, &'static str, Box<dyn Source>, usize, Option<&'static str>, usize);

#[test]
fn reading_takes_little_beside_the_file() {
    let native = formats::native::write(&busy(256, 600));
    let record = |item: &[u8]| {
        let mut file = Vec::new();
        womd::write_record(&mut file, item).unwrap();
        file
    };
    let own = r#"{"format":"dragtraffic.scene","version":1,"time":{"steps":9},"#;
    let agents = format!("{own}\"map\":{{}},\"agents\":[{{\"id\":\"a\",\"type\":\"other\"}}");
    let points = format!("{own}\"map\":{{\"lanes\":[{{\"id\":\"a\",\"points_m\":[[0,0]");
    let columns =
        format!("{own}\"map\":{{}},\"agents\":[{{\"id\":\"a\",\"type\":\"other\",\"track\":{{\"x_m\":[0");
    let zeros = vec![0; 120 * MIB];
    // A map feature of 12 MiB and a byte, in it a lane, in it points without coordinates.
    let mut hollow = vec![0x42, 0x81, 0x80, 0x80, 0x06, 0x1a, 0xfc, 0xff, 0xff, 0x05];
    hollow.extend([0x42, 0].repeat(6 * MIB - 2));
    // All keep to `limits::memory_for` their bytes, which is looked at below.
    let files: Vec<Tried> = vec![
        ("native", "dragtraffic", Box::new(Wrapped(gzip(&native))), 1, None, 64),
        ("records", "womd", Box::new(records(100)), 100, None, 16),
        ("records, wrapped", "womd", Box::new(Wrapped(gzip(&records(100)))), 100, None, 16),
        ("fcd", "sumo-fcd", Box::new(fcd(1_820, 200)), 20, None, 24),
        ("net", "sumo-net", Box::new(net(1_500)), 1, None, 32),
        ("opendrive", "opendrive", Box::new(roads(250, 150)), 1, None, 64),
        // As long lanes as are let through, over and over each other: where roads do, their edges cross.
        ("long roads", "opendrive", Box::new(roads(8, 4_900)), 1, None, 64),
        // Two motorways on each other, as long as are let through.
        ("straight roads", "opendrive", Box::new(straight_roads(2, 8, 11_000)), 1, None, 64),
        // A motorway in as many pieces; roads that cut each other as often as is let through, and more often.
        ("shorter straight roads", "opendrive", Box::new(straight_roads(16, 8, 1_300)), 1, None, 64),
        ("star", "opendrive", Box::new(star(14, 16, 400)), 1, None, 64),
        ("dense star", "opendrive", Box::new(star(64, 16, 100)), 0, Some("decoded-too-large"), 64),
        // One lane after the other round a ring of 6 km, in a file of some KiB.
        ("ring of 16 lanes", "opendrive", Box::new(ring(16, 6_000)), 1, None, 64),
        (
            "more straight roads",
            "opendrive",
            Box::new(straight_roads(12, 8, 11_000)),
            0,
            Some("decoded-too-large"),
            16,
        ),
        // A line of text says how a curve goes on for kilometres.
        ("longer roads", "opendrive", Box::new(roads(50, 4_900)), 0, Some("decoded-too-large"), 16),
        (
            "empty roads",
            "opendrive",
            Box::new(repeated(
                b"<OpenDRIVE>",
                b"<road id='1'><userData code='a'/></road>",
                1 << 20,
                b"</OpenDRIVE>",
            )),
            0,
            Some("expansion-too-high"),
            16,
        ),
        // A table of one scenario as long as is let through, plain columns and repeated ones.
        ("csv", "csv", Box::new(gzip(&table("csv", 16))), 16, None, 16),
        ("parquet", "parquet", Box::new(table("parquet", 16)), 16, None, 64),
        ("one long scenario", "csv", Box::new(long_table(900_000)), 200, None, 128),
        // More rows than are held for its size: those before a time are read.
        ("more than is held", "csv", Box::new(long_table(1_100_000)), 200, None, 128),
        (
            "a row without end",
            "csv",
            Box::new(repeated(b"agent_id,time_s,x_m,y_m\n\"", &[b'a'; MIB], 90, b"")),
            0,
            Some("decoded-too-large"),
            8,
        ),
        ("av2", "av2", Box::new(table("av2", 1)), 1, None, 64),
        ("lanelets", "lanelet2", Box::new(lanelets(1_500)), 1, None, 64),
        ("scenario", "commonroad", Box::new(scenario(1_500, 250)), 1, None, 96),
        (
            "empty obstacles",
            "commonroad",
            Box::new(repeated(
                b"<commonRoad commonRoadVersion='2020a' timeStepSize='0.1'><lanelet>",
                b"<a/>",
                8 << 20,
                b"</lanelet></commonRoad>",
            )),
            0,
            Some("out-of-range"),
            96,
        ),
        ("pickle", "scenarionet", Box::new(exported("scenarionet")), 1, None, 112),
        (
            "lists in a pickle",
            "scenarionet",
            Box::new([&b"\x80\x02]("[..], &b"]".repeat(4 << 20)].concat()),
            0,
            Some("decoded-too-large"),
            96,
        ),
        ("gpudrive", "gpudrive", Box::new(Wrapped(gzip(&exported("gpudrive")))), 1, None, 64),
        (
            "points of a road",
            "gpudrive",
            Box::new(Wrapped(repeated(
                b"{\"objects\":[],\"roads\":[{\"type\":\"lane\",\"geometry\":[{\"x\":0,\"y\":0}",
                b",{\"x\":0,\"y\":0}",
                6 << 20,
                b"]}]}",
            ))),
            0,
            Some("invalid-field"),
            96,
        ),
        (
            "white space",
            "dragtraffic",
            Box::new(Wrapped(repeated(own.as_bytes(), &[b' '; MIB], 256, b"\"map\":{}}"))),
            1,
            None,
            32,
        ),
        (
            "agents",
            "dragtraffic",
            Box::new(Wrapped(repeated(agents.as_bytes(), br#",{"id":"a","type":"other"}"#, 1 << 20, b"]}"))),
            0,
            Some("too-many-agents"),
            32,
        ),
        (
            "points",
            "dragtraffic",
            Box::new(Wrapped(repeated(points.as_bytes(), b",[0,1]", 18 << 20, b"]}]}}"))),
            0,
            Some("decoded-too-large"),
            64,
        ),
        (
            "columns",
            "dragtraffic",
            Box::new(Wrapped(repeated(columns.as_bytes(), b",0", 36 << 20, b"]}}]}"))),
            0,
            Some("decoded-too-large"),
            64,
        ),
        ("a record of zeros", "womd", Box::new(gzip(&record(&zeros))), 0, Some("malformed-file"), 24),
        (
            "a record of points",
            "womd",
            Box::new(Wrapped(gzip(&record(&hollow)))),
            0,
            Some("map-too-large"),
            64,
        ),
        (
            "records of zeros",
            "womd",
            Box::new(repeated(&[], &record(&zeros[..8 * MIB]), 4, &[])),
            0,
            Some("expansion-too-high"),
            24,
        ),
        (
            "empty steps",
            "sumo-fcd",
            Box::new(repeated(b"<fcd-export>", &[b' '; MIB], 512, b"</fcd-export>")),
            0,
            Some("expansion-too-high"),
            8,
        ),
    ];
    drop(zeros);
    let mut wrong = Vec::new();
    for (name, format, file, scenes, fault, most) in files {
        let (count, found, peak) = read(&*file, format);
        println!("{name:20} peak {:7.2} MiB, {count} scenes {found:?}", peak as f64 / MIB as f64);
        let allowed = formats::limits::memory_for(file.encoded_len()).min((most * MIB) as u64);
        if (count, found) != (scenes, fault) || peak as u64 > allowed {
            wrong.push(format!("{name}: {count} scenes, {found:?}, {peak} bytes"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
