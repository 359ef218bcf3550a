//! Options of refinement that an evaluation may change.

use super::*;
use experts::{Refining, Shown};
use scene::geometry::obb::{OrientedBox, overlaps};

fn drawn(scene: Scene, seed: u64, refining: Refining) -> Answer {
    let mut request = ask(scene, None);
    (request.seed, request.diversity) = (seed, 1.0);
    (request.stages.shown, request.stages.guidance) = (Shown::Drawn, false);
    request.stages.refining = refining;
    run(&GENERATOR, request)
}

/// Number of steps at which two boxes of shown futures overlap, summed over pairs.
fn overlapping(scene: &Scene, answer: &Answer) -> usize {
    let boxes: Vec<Vec<OrientedBox>> = answer.samples[0]
        .agents
        .iter()
        .map(|(id, futures)| {
            let states = &futures.modes[futures.chosen].states;
            states.iter().map(|s| OrientedBox::of_state(s, &scene.agent(id).unwrap().size)).collect()
        })
        .collect();
    let pairs = (0..boxes.len()).flat_map(|i| (0..i).map(move |j| (i, j)));
    pairs.map(|(i, j)| boxes[i].iter().zip(&boxes[j]).filter(|(a, b)| overlaps(a, b, 0.0)).count()).sum()
}

#[test]
fn every_switch_shows() {
    let full = Refining::default();
    let all = drawn(crossing(), 1, full).samples;
    assert!(all == drawn(crossing(), 1, full).samples, "the same call");
    for changed in [
        Refining { start: 20, ..full },
        Refining { repulsion: false, ..full },
        Refining { resolve_overlaps: false, ..full },
    ] {
        assert!(drawn(crossing(), 1, changed).samples != all, "{changed:?}");
    }
}

#[test]
fn settling_clears_drawn_scenes_whatever_the_order_of_road_users() {
    let scene = crossing();
    let count = |settle| {
        let of = |seed| {
            overlapping(
                &scene,
                &drawn(scene.clone(), seed, Refining { resolve_overlaps: settle, ..Refining::default() }),
            )
        };
        (0..8).map(of).sum::<usize>()
    };
    let (without, with) = (count(false), count(true));
    assert!(with < without, "{without} overlapping steps to {with}");
    let mut turned = scene.clone();
    turned.agents.reverse();
    let full = Refining::default();
    assert!(drawn(turned, 3, full).samples == drawn(scene, 3, full).samples, "order");
}

#[test]
fn who_is_alone_is_neither_pushed_nor_settled() {
    let mut scene = crossing();
    scene.agents.truncate(1);
    // Nor is there a kerb.
    scene.map = Default::default();
    let full = Refining::default();
    let all = drawn(scene.clone(), 1, full).samples;
    assert!(all == drawn(scene.clone(), 1, Refining { repulsion: false, ..full }).samples);
    assert!(all == drawn(scene, 1, Refining { resolve_overlaps: false, ..full }).samples);
}
