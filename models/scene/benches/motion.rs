//! Rollout, fit and projection of one future.
#![allow(missing_docs, clippy::unwrap_used)]

use criterion::{Criterion, criterion_group, criterion_main};
use scene::motion::{Knots, MotionModel, Sampled, Smoothing, Target, fit, project};
use scene::{AgentType, Size, State, Subtype, Vec2};
use std::hint::black_box;

fn motion(c: &mut Criterion) {
    let size = Size::default_for(AgentType::Vehicle, Subtype::Car);
    let start = State { vx_mps: 8.0, ..State::default() };
    let model = MotionModel::new(AgentType::Vehicle, Subtype::Car, size, start);
    let u = Knots { first: [0.4; 10], second: [0.02; 10] };
    let truth = model.rollout(&u);
    let samples: Vec<_> = (1..=18)
        .map(|i| Sampled {
            step: 5 * i,
            position: truth[5 * i].position,
            heading_rad: truth[5 * i].heading_rad,
        })
        .collect();
    let end = truth[90];
    let target = Target {
        step: 90,
        position: Some(end.position),
        heading_rad: Some(end.heading_rad),
        speed_mps: Some(end.speed_mps()),
    };
    let near = Knots { first: [0.3; 10], second: [0.019; 10] };
    c.bench_function("rollout", |b| b.iter(|| model.rollout(black_box(&u))));
    c.bench_function("fit 18 samples", |b| b.iter(|| fit(&model, black_box(&samples), Smoothing::WISHED)));
    c.bench_function("project, knots near", |b| b.iter(|| project(&model, black_box(&near), &target, None)));
    c.bench_function("project, from coasting", |b| {
        b.iter(|| project(&model, black_box(&model.coasting()), &target, None))
    });
    let walk_size = Size::default_for(AgentType::Pedestrian, Subtype::Adult);
    let start = State { vx_mps: 1.3, ..State::default() };
    let walker = MotionModel::new(AgentType::Pedestrian, Subtype::Adult, walk_size, start);
    let target = Target { step: 90, position: Some(Vec2::new(9.0, 4.0)), ..Target::default() };
    c.bench_function("project, walking", |b| {
        b.iter(|| project(&walker, black_box(&walker.coasting()), &target, None))
    });
}

criterion_group!(benches, motion);
criterion_main!(benches);
