//! Memory of writing, counted at the allocator: at most 8 bytes for each byte of a scene's JSON, and 40 MB. The only
//! test of its process, because all allocations are counted.
#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test stops at the first surprise")]

use formats::{ExportOptions, native, registry};
use peak_alloc::PeakAlloc;
use scene::map::Lane;
use scene::{Agent, AgentType, LaneMap, Scene, State, Subtype, Vec2};

#[global_allocator]
static ALLOCATOR: PeakAlloc = PeakAlloc;

/// A bound on files, as the server sets it.
fn most_bytes(json: usize) -> u64 {
    6 * json as u64 + (40 << 20)
}

fn lane(id: usize, points: Vec<Vec2>, successors: Vec<String>) -> Lane {
    let mut lane = Lane::street(format!("k{id}"), points);
    lane.successors = successors;
    lane
}

/// Short lanes in a grid, each linked to as many others as a lane may be.
fn linked(lanes: usize, links: usize) -> LaneMap {
    let lanes = (0..lanes).map(|i| {
        let start = Vec2::new((i % 60) as f64 * 3.0, (i / 60) as f64 * 4.0);
        let successors = (1..=links).map(|k| format!("k{}", (i + k) % lanes)).collect();
        lane(i, vec![start, start + Vec2::new(1.0, 0.0)], successors)
    });
    LaneMap { lanes: lanes.collect(), ..LaneMap::default() }
}

/// Long lanes of many points that cross each other.
fn crossed(lanes: usize, points: usize) -> LaneMap {
    let lanes = (0..lanes).map(|i| {
        let point = |k: usize| {
            let (along, across) = (k as f64 * 0.7 - 300.0, i as f64 * 9.3 - 200.0 + (k % 2) as f64 * 0.1);
            if i % 2 == 0 { Vec2::new(along, across) } else { Vec2::new(across, along) }
        };
        lane(i, (0..points).map(point).collect(), Vec::new())
    });
    LaneMap { lanes: lanes.collect(), ..LaneMap::default() }
}

fn moving(agents: usize, steps: usize) -> Scene {
    let state = |agent: usize, step: usize| State {
        x_m: step as f64 * 1.234_567 + agent as f64 * 0.1,
        y_m: agent as f64 * 3.456_789,
        heading_rad: 0.012_345_6,
        vx_mps: 12.345_678,
        vy_mps: 0.154_321,
    };
    let agents = (0..agents).map(|agent| {
        let states = (0..steps).map(|step| Some(state(agent, step))).collect();
        Agent::bare(agent.to_string(), AgentType::Vehicle, Subtype::Car, states)
    });
    let mut scene = Scene::bare("moving", linked(20, 1), agents.collect());
    scene.time.steps = steps;
    scene
}

#[test]
fn writing_takes_eight_times_the_scene_and_40_mb() {
    let scenes = [
        Scene::bare("linked", linked(3_000, 63), moving(1, 20).agents),
        Scene::bare("crossed", crossed(80, 900), moving(1, 20).agents),
        moving(400, 200),
    ];
    for scene in &scenes {
        let json = native::write(scene).len();
        let most = 8 * json + (40 << 20);
        for format in registry::FORMATS.iter().filter(|format| format.info().export) {
            let options = ExportOptions { most_bytes: Some(most_bytes(json)), ..ExportOptions::default() };
            let before = ALLOCATOR.current_usage();
            ALLOCATOR.reset_peak_usage();
            let file = format.export(&[scene], &options).map_or(0, |exported| exported.bytes.len());
            let taken = ALLOCATOR.peak_usage() - before;
            let format = format.info().id;
            println!("{} as {format}: {taken} bytes of memory for a file of {file}", scene.name);
            assert!(taken < most, "{} as {format}: {taken} of {most}", scene.name);
        }
    }
}
