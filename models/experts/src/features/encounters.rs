//! Encounters of a draft: other agents on *their* drafts, as seen from the moving draft.
//!
//! An encounter is one other agent beside one draft. Its numbers are in the frame of the draft's own box at
//! each time. They therefore do not depend on where in the world, or when in the window, two agents meet.

use crate::planning::{INSTANTS, MODES};
use scene::geometry::overlap_energy::{MovingBox, Poses, absent, gap};

/// Most encounters of a draft, nearest first.
pub const ENCOUNTERS: usize = 8;
/// Instants at which the other agent's pose is included: 1.5, 3, 4.5, 6, 7.5 and 9 s.
const POSES_AT: [usize; 6] = [2, 5, 8, 11, 14, 17];
/// Numbers of one encounter: poses (ahead, left, cosine, sine), gaps at all instants, half sizes of both boxes.
pub const ENCOUNTER: usize = 4 * POSES_AT.len() + INSTANTS + 4;

/// Agents that always stay farther than this from a draft are no encounter, metres.
const WITHIN_M: f32 = 20.0;
/// Scale of positions and of half sizes, metres.
const POSITION_M: f32 = 20.0;
const HALF_M: f32 = 3.0;
/// Range and scale of gaps, metres.
const GAP_M: [f32; 2] = [-3.0, 6.0];
const GAP_SCALE_M: f32 = 3.0;

/// Encounters of the drafts of one agent; empty if no agent is near.
pub type Encounters = [Vec<[f32; ENCOUNTER]>; MODES];

/// The encounters of one draft of a box with these half sizes, nearest first.
pub fn encounters<'a>(
    own: &Poses<INSTANTS>,
    half: [f32; 2],
    others: impl Iterator<Item = MovingBox<'a, INSTANTS>>,
) -> Vec<[f32; ENCOUNTER]> {
    let mut near: Vec<(f32, usize, MovingBox<'a, INSTANTS>)> = Vec::new();
    for (index, other) in others.enumerate() {
        let apart = nearest_m(own, other.poses) - other.half[0];
        if apart < WITHIN_M {
            near.push((apart, index, other));
        }
    }
    near.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    near.truncate(ENCOUNTERS);
    near.iter().map(|(.., other)| encounter(own, half, other)).collect()
}

/// Smallest distance of the centres; infinite for an agent that is always absent.
fn nearest_m(own: &Poses<INSTANTS>, other: &Poses<INSTANTS>) -> f32 {
    let squares = own.iter().zip(other).filter(|(a, b)| !absent(a) && !absent(b));
    let squares = squares.map(|(a, b)| (a[0] - b[0]).powi(2) + (a[1] - b[1]).powi(2));
    squares.fold(f32::INFINITY, f32::min).sqrt()
}

fn encounter(own: &Poses<INSTANTS>, half: [f32; 2], other: &MovingBox<'_, INSTANTS>) -> [f32; ENCOUNTER] {
    let mut numbers = [0.0; ENCOUNTER];
    let (poses, rest) = numbers.split_at_mut(4 * POSES_AT.len());
    let (gaps, halves) = rest.split_at_mut(INSTANTS);
    for (pose, instant) in poses.as_chunks_mut::<4>().0.iter_mut().zip(POSES_AT) {
        let (a, b) = (own[instant], other.poses[instant]);
        if absent(&a) || absent(&b) {
            continue;
        }
        let (x, y) = ((b[0] - a[0]) / POSITION_M, (b[1] - a[1]) / POSITION_M);
        let turned = |x: f32, y: f32| [x * a[2] + y * a[3], y * a[2] - x * a[3]];
        let ([ahead, left], [cos, sin]) = (turned(x, y), turned(b[2], b[3]));
        *pose = [ahead.clamp(-3.0, 3.0), left.clamp(-3.0, 3.0), cos, sin];
    }
    for ((apart, a), b) in gaps.iter_mut().zip(own).zip(other.poses) {
        let there = !absent(a) && !absent(b);
        let reach = GAP_M[1] + half[0] + half[1] + other.half[0] + other.half[1];
        let close = there && (a[0] - b[0]).abs().max((a[1] - b[1]).abs()) < reach;
        let metres = if close { gap(*a, half, *b, other.half).0 } else { GAP_M[1] };
        *apart = metres.clamp(GAP_M[0], GAP_M[1]) / GAP_SCALE_M;
    }
    halves.copy_from_slice(&[half[0], half[1], other.half[0], other.half[1]].map(|h| h / HALF_M));
    numbers
}

#[cfg(test)]
mod tests {
    use super::*;

    fn drive(x: f32, y: f32, step: f32, heading_rad: f32) -> Poses<INSTANTS> {
        let (sin, cos) = heading_rad.sin_cos();
        std::array::from_fn(|i| {
            let way = step * (i + 1) as f32;
            [x + way * cos, y + way * sin, cos, sin]
        })
    }

    #[test]
    fn an_encounter_is_the_same_wherever_it_happens() {
        let turn = |p: &Poses<INSTANTS>| -> Poses<INSTANTS> {
            let (s, c) = 0.7f32.sin_cos();
            p.map(|[x, y, a, b]| [x * c - y * s + 5.0, x * s + y * c - 2.0, a * c - b * s, a * s + b * c])
        };
        let (own, other) = (drive(0.0, 0.0, 4.0, 0.0), drive(30.0, -20.0, 3.0, 1.4));
        let of = |own: &Poses<INSTANTS>, other: &Poses<INSTANTS>| {
            encounters(own, [2.3, 1.0], [MovingBox { poses: other, half: [2.5, 1.1] }].into_iter())
        };
        let (here, there) = (of(&own, &other), of(&turn(&own), &turn(&other)));
        assert_eq!((here.len(), there.len()), (1, 1));
        for (a, b) in here[0].iter().zip(&there[0]) {
            assert!((a - b).abs() < 1e-4, "{a} {b}");
        }
    }

    #[test]
    fn the_nearest_come_first_and_those_far_away_or_absent_do_not_come() {
        let own = drive(0.0, 0.0, 4.0, 0.0);
        let beside: Vec<Poses<INSTANTS>> =
            (0..12).map(|i| drive(0.0, 30.0 - 2.5 * i as f32, 4.0, 0.0)).collect();
        let nobody = [[0.0; 4]; INSTANTS];
        let all = beside.iter().chain([&nobody]).map(|poses| MovingBox { poses, half: [2.3, 1.0] });
        let found = encounters(&own, [2.3, 1.0], all);
        assert_eq!(found.len(), ENCOUNTERS);
        let left = |e: &[f32; ENCOUNTER]| e[1] * POSITION_M;
        assert!((left(&found[0]) - 2.5).abs() < 1e-4 && (left(&found[1]) - 5.0).abs() < 1e-4);
        // Beside it by 2.5 m, both 2 m wide: half a metre between them, at every instant.
        let gaps = &found[0][4 * POSES_AT.len()..][..INSTANTS];
        assert!(gaps.iter().all(|g| (g * GAP_SCALE_M - 0.5).abs() < 1e-3), "{gaps:?}");
    }
}
