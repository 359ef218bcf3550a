//! The others of a record as they might have been: in a generated scene nobody keeps to the recording.

use experts::features::INSTANTS;
use experts::net::overlap::absent;
use rand_chacha::ChaCha12Rng;

use super::sample::{Shard, unit};
use super::{LoggedBox, Record};

/// Share of neighbours that go at another pace.
const WANDERING: f64 = 0.5;
/// Slowest and fastest pace, as shares of the recorded one.
const PACES: (f64, f64) = (0.6, 1.4);

/// A shard whose neighbours go their recorded ways, some of them faster or slower.
pub(super) fn wandering(shard: &Shard, rng: &mut ChaCha12Rng) -> Shard {
    let mut changed = |logged: &LoggedBox| {
        let (draw, place) = (unit(rng), unit(rng));
        let pace = PACES.0 + (PACES.1 - PACES.0) * place;
        if draw < WANDERING { at_pace(logged, pace as f32) } else { logged.clone() }
    };
    let mut of = |record: &Record| {
        let boxes = record.boxes.iter().map(&mut changed).collect();
        Record { boxes, ..record.clone() }
    };
    Shard {
        records: shard.records.iter().map(&mut of).collect(),
        pieces: shard.pieces.clone(),
        recorded: shard.recorded.clone(),
    }
}

/// A neighbour on its recorded way at another pace; straight on where the recording ends.
fn at_pace(logged: &LoggedBox, pace: f32) -> LoggedBox {
    let poses = std::array::from_fn(|instant| {
        let place = (instant + 1) as f32 * pace - 1.0;
        let before = (place.max(0.0) as usize).min(INSTANTS - 2);
        let (a, b) = (logged.poses[before], logged.poses[before + 1]);
        if absent(&a) || absent(&b) {
            return [0.0; 4];
        }
        let share = place - before as f32;
        let heading = if share < 0.5 { a } else { b };
        [a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1]), heading[2], heading[3]]
    });
    LoggedBox { poses, half: logged.half }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pace_changes_when_not_where() {
        let poses = std::array::from_fn(|i| [2.0 * (i + 1) as f32, 1.0, 1.0, 0.0]);
        let mut logged = LoggedBox { poses, half: [2.0, 1.0] };
        assert_eq!(at_pace(&logged, 1.0), logged);
        for pace in [0.6, 1.4] {
            for (i, pose) in at_pace(&logged, pace).poses.iter().enumerate() {
                assert!((pose[0] - 2.0 * pace * (i + 1) as f32).abs() < 1e-4 && pose[1] == 1.0, "{pose:?}");
            }
        }
        // Where nothing was recorded nobody is.
        logged.poses[9] = [0.0; 4];
        let gone = at_pace(&logged, 0.6).poses.iter().filter(|p| absent(p)).count();
        assert!((1..6).contains(&gone), "{gone}");
    }
}
