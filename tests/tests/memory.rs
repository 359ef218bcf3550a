//! Memory of the server during parallel uploads, and its release.

#![cfg(target_os = "linux")]
#![allow(clippy::unwrap_used, clippy::panic, clippy::print_stdout, reason = "a failed test panics")]

use dragtraffic_tests::{Request, Server};
use flate2::Compression;
use flate2::write::GzEncoder;
use scene::{Agent, AgentType, LaneMap, Scene, State, Subtype};
use std::io::Write;
use std::time::{Duration, Instant};

const MIB: u64 = 1 << 20;

/// Highest (`VmHWM`) or present (`VmRSS`) resident memory of a server, bytes.
fn resident(server: &Server, which: &str) -> u64 {
    let status = std::fs::read_to_string(format!("/proc/{}/status", server.pid())).unwrap();
    let line = status.lines().find_map(|line| line.strip_prefix(which)?.strip_prefix(':')).unwrap();
    line.trim().strip_suffix(" kB").unwrap().parse::<u64>().unwrap() * 1024
}

fn gzip(parts: impl Iterator<Item = Vec<u8>>) -> Vec<u8> {
    let mut encoder = GzEncoder::new(Vec::new(), Compression::fast());
    parts.for_each(|part| encoder.write_all(&part).unwrap());
    encoder.finish().unwrap()
}

/// A record of many road users with poorly compressible motion.
fn record(number: u64) -> Vec<u8> {
    let noise = |agent: u64, i: u64| {
        let mixed = (number << 40 | agent << 20 | i).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        ((mixed ^ mixed >> 29).wrapping_mul(0xbf58_476d_1ce4_e5b9) >> 44) as f64 / 1048.576
    };
    let state = |agent, i| {
        let (x_m, y_m) = (noise(agent, i), noise(agent, i + 100));
        Some(State { x_m, y_m, heading_rad: 0.0, vx_mps: noise(agent, i + 200) / 100.0, vy_mps: 0.0 })
    };
    let agents = (0..200).map(|agent| {
        let states = (0..91).map(|i| state(agent, i)).collect();
        Agent::bare(agent.to_string(), AgentType::Vehicle, Subtype::Car, states)
    });
    let scene = Scene::bare("busy", LaneMap::default(), agents.collect());
    let mut file = Vec::new();
    formats::womd::write(&[&scene], &mut file, false, formats::ExportedMotion::Log).unwrap();
    file
}

/// A recording of many positions that compresses well.
fn recording(steps: u64) -> Vec<u8> {
    let step = |step: u64| {
        let cars = (0..200).map(|car| {
            let x = step as f64 * 1.5 + car as f64 * 7.25;
            format!(
                "<vehicle id=\"car{car}\" x=\"{x:.2}\" y=\"{car}.00\" angle=\"90.00\" speed=\"15.00\"/>\n"
            )
        });
        let time = step as f64 / 10.0;
        format!("<timestep time=\"{time:.1}\">{}</timestep>\n", cars.collect::<String>()).into_bytes()
    };
    let (head, tail) = (b"<fcd-export>".to_vec(), b"</fcd-export>".to_vec());
    gzip(std::iter::once(head).chain((0..steps).map(step)).chain([tail]))
}

/// A document with the longest whitespace that the compression ratio allows.
fn hollow() -> Vec<u8> {
    let head = br#"{"format":"dragtraffic.scene","version":1,"time":{"steps":9},"#.to_vec();
    // Blanks, line ends and tabs in an order that compresses about 20 to 1.
    let blank = |i: u64| b"  \n \t\r  "[(i.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 61) as usize];
    let mixed: Vec<u8> = (0..4_096).map(blank).collect();
    let space = (0..3_600u64).map(|i| {
        let mut piece = mixed.repeat(16);
        (0..64).for_each(|k| piece[(i * 911 + k * 1_021) as usize % (64 << 10)] = b' ');
        piece
    });
    gzip(std::iter::once(head).chain(space).chain([br#""map":{}}"#.to_vec()]))
}

/// Four uploads at once; refused ones are repeated. Returns the memory above the initial level: the peak, and
/// the rest after its release or one minute.
fn four(file: &[u8], query: &str, encoding: Option<&str>) -> (u64, u64) {
    // One caller may use half of the places.
    let server = Server::start(&["--limit", "uploads=8"]).unwrap();
    server.wait_ready().unwrap();
    let before = resident(&server, "VmRSS");
    let address = server.address;
    std::thread::scope(|scope| {
        for _ in 0..4 {
            scope.spawn(|| {
                let request = Request::new("POST", &format!("/v1/import?index=0..150{query}"));
                let mut request = request.header("content-type", "application/octet-stream").body(file);
                if let Some(encoding) = encoding {
                    request = request.header("content-encoding", encoding);
                }
                let reply = request.send(address).unwrap();
                assert!([200, 201].contains(&reply.status), "{}", reply.text());
            });
        }
    });
    let peak = resident(&server, "VmHWM") - before;
    let began = Instant::now();
    loop {
        let left = resident(&server, "VmRSS").saturating_sub(before);
        if left < 96 * MIB || began.elapsed() > Duration::from_secs(60) {
            return (peak, left);
        }
        std::thread::sleep(Duration::from_millis(500));
    }
}

#[test]
fn four_uploads_at_once_stay_within_their_bound_and_are_given_back() {
    let records = gzip((0..40).map(record));
    let files = [
        ("records", records.clone(), "", None),
        ("records, wrapped", records.clone(), "", Some("gzip")),
        ("records, tried", records, "&dry_run=true", None),
        ("recording", recording(3_640), "", None),
        ("hollow", hollow(), "", Some("gzip")),
    ];
    for (name, file, query, encoding) in files {
        let (peak, left) = four(&file, query, encoding);
        let size = file.len() as u64;
        println!(
            "{name:18} {:5.1} MiB: peak {} MiB, left {} MiB",
            size as f64 / MIB as f64,
            peak / MIB,
            left / MIB
        );
        // Four bodies, and two imports at a time.
        let bound = 4 * size + 2 * (7 * size + 64 * MIB);
        assert!(peak <= bound, "{name}: {peak} bytes, {bound} expected");
        assert!(left <= 96 * MIB, "{name}: {left} bytes are not given back");
    }
}
