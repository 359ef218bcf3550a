//! Cost of box gaps, energies, overlaps of six by six futures and whole-scene scores.
//!
//! Run with `cargo bench -p dragtraffic-scene --bench boxes`. Targets: a gap below 50 ns, overlaps of six by
//! six futures below 20 us, a scene of 128 road users over 91 steps below 10 ms.

use criterion::{Criterion, criterion_group, criterion_main};
use scene::geometry::obb::{OrientedBox, iou, signed_gap};
use scene::geometry::overlap_energy::{Growth, MovingBox, overlap_energy};
use scene::geometry::ttc::time_to_collision;
use scene::map::{Area, LaneMap};
use scene::score::{
    Actor, Drivable, Exclude, PairChoice, ScoreInput, SweptBoxes, Thresholds, overlap, score,
};
use scene::{AgentType, Goal, STEP_S, Size, State, Subtype, Track, Vec2};
use std::borrow::Cow;
use std::f64::consts::FRAC_PI_2;
use std::hint::black_box;

fn boxes(c: &mut Criterion) {
    let a = OrientedBox::new(Vec2::new(0.0, 0.0), 2.3, 1.0, 0.2);
    let near = OrientedBox::new(Vec2::new(4.2, 1.4), 2.3, 1.0, 0.9);
    let inside = OrientedBox::new(Vec2::new(2.0, 1.0), 2.3, 1.0, 0.9);
    let velocity = Vec2::new(8.0, 1.0);
    c.bench_function("gap apart", |b| b.iter(|| signed_gap(black_box(&a), black_box(&near))));
    c.bench_function("gap overlapping", |b| b.iter(|| signed_gap(black_box(&a), black_box(&inside))));
    c.bench_function("iou", |b| b.iter(|| iou(black_box(&a), black_box(&inside))));
    let own = [[0.0, 0.0, 1.0, 0.0]; 18];
    let other = [[2.0, 1.0, 0.8, 0.6]; 18];
    let obstacle = MovingBox { poses: &other, half: [2.3, 1.0] };
    c.bench_function("energy of 18 instants", |b| {
        b.iter(|| overlap_energy(black_box(&own), [2.3, 1.0], [black_box(obstacle)], Growth::Square));
    });
    c.bench_function("time to collision", |b| {
        b.iter(|| time_to_collision(black_box(&a), velocity, black_box(&near), -velocity, 8.0));
    });
}

/// Six futures of a car that sets off along `heading_rad`, each bent slightly more than the previous one.
fn options(x: f64, y: f64, heading_rad: f64) -> Vec<SweptBoxes> {
    let one = |mode: usize| {
        let at = |i: usize| {
            let s = i as f64 * 0.3 * 9.0;
            let heading = heading_rad + (mode as f64 - 2.5) * 0.004 * s;
            let place = Vec2::new(x, y) + scene::geometry::direction(heading) * s;
            Some(OrientedBox::new(place, 2.3, 1.0, heading))
        };
        SweptBoxes::new((0..31).map(at).collect())
    };
    (0..6).map(one).collect()
}

fn tables(c: &mut Criterion) {
    let east = options(0.0, 0.0, 0.0);
    let north = options(40.0, -52.0, FRAC_PI_2);
    let beside = options(0.0, 3.5, 0.0);
    let far = options(0.0, 300.0, 0.0);
    for (name, other) in [("crossing", north), ("beside", beside), ("far", far)] {
        c.bench_function(&format!("six by six futures {name}"), |b| {
            b.iter(|| {
                for p in black_box(&east) {
                    for q in black_box(&other) {
                        black_box(overlap(p, q));
                    }
                }
            });
        });
    }
}

/// Cars on a grid of streets, every other row east, every other column north; a third are parked.
fn traffic(count: usize) -> Vec<Actor<'static>> {
    let one = |i: usize| {
        let (row, column) = ((i / 12) as f64, (i % 12) as f64);
        let heading_rad = if i.is_multiple_of(2) { 0.0 } else { FRAC_PI_2 };
        let speed = if i.is_multiple_of(3) { 0.0 } else { 6.0 + (i % 7) as f64 };
        let velocity = scene::geometry::direction(heading_rad) * speed;
        let start = Vec2::new(column * 17.0, row * 15.0);
        let state = |k: usize| {
            let p = start + velocity * (k as f64 * STEP_S);
            Some(State { x_m: p.x, y_m: p.y, heading_rad, vx_mps: velocity.x, vy_mps: velocity.y })
        };
        Actor {
            id: Box::leak(format!("car{i}").into_boxed_str()),
            agent_type: AgentType::Vehicle,
            subtype: Subtype::Car,
            size: Size { length_m: 4.6, width_m: 2.0, height_m: None },
            track: Cow::Owned(Track { first_step: 0, states: (0..91).map(state).collect(), z_m: None }),
            log: None,
            generated: true,
            may_cross: &[],
            via: &[],
            goal: Goal::default(),
            reference: None,
            modes: &[],
        }
    };
    (0..count).map(one).collect()
}

fn scenes(c: &mut Criterion) {
    let corners = [(-20.0, -20.0), (300.0, -20.0), (300.0, 300.0), (-20.0, 300.0)];
    let polygon = corners.map(|(x, y)| Vec2::new(x, y)).to_vec();
    let area = Area { id: "all".into(), polygon: polygon.into(), holes: Vec::new() };
    let map = LaneMap { drivable: vec![area], ..LaneMap::default() };
    let drivable = Drivable::new(&map);
    for count in [8, 32, 128] {
        let input = ScoreInput {
            actors: traffic(count),
            map: &map,
            signals: &[],
            drivable: &drivable,
            steps: 0..91,
            pairs: PairChoice::All,
            exclude: Exclude::OverlapAtStart,
            thresholds: Thresholds::default(),
        };
        c.bench_function(&format!("score {count} road users"), |b| b.iter(|| score(black_box(&input))));
    }
}

criterion_group!(benches, boxes, tables, scenes);
criterion_main!(benches);
