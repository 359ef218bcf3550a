//! Cost of the data that is computed once per map: linear in its size, not quadratic.
//!
//! Run with `cargo bench -p dragtraffic-scene --bench maps`. Target: when the size doubles, the time per
//! piece of a lane grows by a factor of at most 1.5.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use scene::geometry::crowding::Crowding;
use scene::map::{Lane, LaneMap};
use scene::random::Key;
use scene::routes::LaneGraph;
use scene::score::Drivable;
use scene::{Scene, Vec2};
use std::hint::black_box;

/// Streets of 200 m with a bend every 5 m, in blocks of 100 m x 100 m, four of them a block.
fn town(lanes: usize) -> LaneMap {
    let mut random = Key::default().text("town").stream();
    let mut street = |i: usize| {
        let (block, side) = (i / 4, (lanes as f64 / 4.0).sqrt().ceil() as usize);
        let corner = Vec2::new((block % side) as f64, (block / side) as f64) * 100.0;
        let (mut at, way) = (corner, random.between(0.0, std::f64::consts::TAU));
        let mut points = vec![at];
        for _ in 0..40 {
            at += scene::geometry::direction(way + random.between(-0.3, 0.3)) * 5.0;
            points.push(at);
        }
        Lane::street(i.to_string(), points)
    };
    LaneMap { lanes: (0..lanes).map(&mut street).collect(), ..LaneMap::default() }
}

fn maps(c: &mut Criterion) {
    let mut group = c.benchmark_group("town");
    group.sample_size(10);
    for lanes in [500, 1_000, 2_000, 4_000] {
        let map = town(lanes);
        group.throughput(Throughput::Elements(40 * lanes as u64));
        let id = |name: &str| BenchmarkId::new(name, lanes);
        group.bench_function(id("crowding"), |b| b.iter(|| Crowding::of(black_box(&map).outlines())));
        group.bench_function(id("lane graph"), |b| b.iter(|| LaneGraph::new(black_box(&map))));
        group.bench_function(id("ground"), |b| b.iter(|| Drivable::new(black_box(&map))));
        let scene = Scene::bare("town", map, Vec::new());
        group.bench_function(id("checks"), |b| b.iter(|| black_box(scene.clone()).checked()));
    }
}

criterion_group!(benches, maps);
criterion_main!(benches);
