//! Running results of the pairs: the smallest values of each road user, and the events.

use super::{Measures, Meeting, Mover, PairBounds, PairScores, PairTotals, is_excluded, log, look_at};
use crate::STEP_S;
use crate::geometry::Vec2;
use crate::geometry::ttc::LOOK_AHEAD_S;
use crate::score::input::{Actor, PairChoice, ScoreInput};
use crate::score::pet::post_encroachment_s;
use crate::score::report::{BoxOverlap, Collision, Encounter, NearMiss};

/// A smallest value of one road user, and the other road user of that pair.
#[derive(Clone, Copy, Debug)]
struct Least {
    value: f64,
    with: usize,
}

/// The smallest values of one road user over its pairs.
#[derive(Clone, Copy, Debug, Default)]
struct Leasts {
    ttc_s: Option<Least>,
    distance_m: Option<Least>,
    pet_s: Option<Least>,
}

impl Leasts {
    fn all_mut(&mut self) -> [&mut Option<Least>; 3] {
        [&mut self.ttc_s, &mut self.distance_m, &mut self.pet_s]
    }
}

/// A pair that overlaps or interacts.
#[derive(Clone, Debug)]
struct PairEvent {
    pair: (usize, usize),
    /// Whether the boxes overlap at a step, however little.
    overlaps: bool,
    meeting: Option<Meeting>,
    in_log: bool,
    /// Place of the interaction, with its measures and those of its recording.
    measured: Option<(Vec2, Measures, Option<Measures>)>,
}

/// Totals over pairs so far, independent of the order of the pairs.
#[derive(Clone, Debug, Default)]
pub(in crate::score) struct PairTally {
    leasts: Vec<Leasts>,
    events: Vec<PairEvent>,
}

impl PairTally {
    /// The tally of all pairs that the input selects.
    pub(in crate::score) fn of_all(input: &ScoreInput<'_>, movers: &[&Mover]) -> Self {
        let mut tally = Self { leasts: vec![Leasts::default(); movers.len()], events: Vec::new() };
        for i in 0..movers.len() {
            for j in i + 1..movers.len() {
                tally.add(input, movers, (i, j), true);
            }
        }
        tally
    }

    /// The tally after some road users have changed, left or entered. `was` gives the index in this tally of
    /// each unchanged one; their order has not changed.
    pub(in crate::score) fn changed(
        &self,
        input: &ScoreInput<'_>,
        movers: &[&Mover],
        was: &[Option<usize>],
    ) -> Self {
        let mut now = vec![None; self.leasts.len()];
        for (new, old) in was.iter().enumerate() {
            if let Some(slot) = old.and_then(|old| now.get_mut(old)) {
                *slot = Some(new);
            }
        }
        let mut tally = Self { leasts: vec![Leasts::default(); movers.len()], events: Vec::new() };
        let stays = |event: &PairEvent| Some((now[event.pair.0]?, now[event.pair.1]?));
        let kept = self.events.iter().filter_map(|e| Some(PairEvent { pair: stays(e)?, ..e.clone() }));
        tally.events.extend(kept);
        // A road user that lost its nearest partner to a change needs all its pairs again.
        let mut orphans = Vec::new();
        for (new, old) in was.iter().enumerate() {
            let Some(old) = *old else { continue };
            let mut leasts = self.leasts[old];
            let mut lost = false;
            for least in leasts.all_mut() {
                let known = least.and_then(|l| Some(Least { with: now[l.with]?, ..l }));
                lost |= known.is_none() && least.is_some();
                *least = known;
            }
            tally.leasts[new] = leasts;
            orphans.extend(lost.then_some(new));
        }
        let all = 0..movers.len();
        for orphan in orphans {
            for other in all.clone().filter(|k| *k != orphan && was[*k].is_some()) {
                tally.add(input, movers, (orphan.min(other), orphan.max(other)), false);
            }
        }
        for changed in all.clone().filter(|k| was[*k].is_none()) {
            for other in all.clone().filter(|k| was[*k].is_some() || *k > changed) {
                tally.add(input, movers, (changed.min(other), changed.max(other)), true);
            }
        }
        tally.events.sort_by_key(|event| event.pair);
        tally
    }

    /// Bounds beyond which nothing can change the score of these two.
    fn known(&self, (i, j): (usize, usize)) -> PairBounds {
        let larger = |of: fn(&Leasts) -> Option<Least>, most: f64| {
            let value = |k: usize| of(&self.leasts[k]).map_or(most, |l| l.value);
            value(i).max(value(j))
        };
        PairBounds {
            gap_m: larger(|l| l.distance_m, f64::INFINITY),
            ttc_s: larger(|l| l.ttc_s, LOOK_AHEAD_S),
        }
    }

    /// Evaluates one pair; its events are recorded only if they are not known already.
    fn add(&mut self, input: &ScoreInput<'_>, movers: &[&Mover], pair: (usize, usize), note: bool) {
        let (i, j) = pair;
        let known = self.known(pair);
        let known_m = known.gap_m.max(input.thresholds.near_gap_m());
        if movers[i].bounds.stay_apart(&movers[j].bounds, known_m) {
            return;
        }
        let (a, b) = (&input.actors[i], &input.actors[j]);
        let asked = input.pairs == PairChoice::All || a.generated || b.generated;
        if !asked || is_excluded(input, a, b) {
            return;
        }
        let found = look_at(input, movers[i], movers[j], known);
        let pet_s = post_encroachment_s(movers[i], movers[j]);
        for (k, with) in [(i, j), (j, i)] {
            let leasts = &mut self.leasts[k];
            let values = [found.min_ttc_s, found.min_distance_m, pet_s];
            for (least, value) in leasts.all_mut().into_iter().zip(values) {
                let Some(value) = value else { continue };
                // Among equal values the first pair's, whatever the order of the pairs.
                if least.is_none_or(|l| value < l.value || value == l.value && with < l.with) {
                    *least = Some(Least { value, with });
                }
            }
        }
        let meeting = Meeting::of(&found, input.steps.start);
        if note && (found.overlaps || meeting.is_some()) {
            let in_log = meeting.is_some() && log::is_in_log(input, a, b, &found);
            // Boxes may touch between two steps; the following step shows it.
            let steps = |m: Meeting| (m.time_s() / STEP_S - 1e-6).ceil() as usize;
            let step = meeting.map(|m| steps(m).saturating_sub(input.steps.start));
            let measured = step.and_then(|step| measured(input, (a, movers[i]), (b, movers[j]), step));
            self.events.push(PairEvent { pair, overlaps: found.overlaps, meeting, in_log, measured });
        }
    }

    /// The results of all pairs.
    pub(in crate::score) fn scores(self, input: &ScoreInput<'_>) -> PairScores {
        let value = |least: Option<Least>| least.map(|l| l.value);
        let totals = |l: &Leasts| PairTotals {
            min_ttc_s: value(l.ttc_s),
            min_ttc_with: l.ttc_s.map(|l| l.with),
            min_distance_m: value(l.distance_m),
            pet_s: value(l.pet_s),
            ..PairTotals::default()
        };
        let mut scores =
            PairScores { agents: self.leasts.iter().map(totals).collect(), ..PairScores::default() };
        for PairEvent { pair: (i, j), overlaps, meeting, in_log, measured } in self.events {
            for k in [i, j] {
                let totals = &mut scores.agents[k];
                totals.overlaps |= overlaps;
                let count = match meeting {
                    Some(Meeting::Collision { .. }) if in_log => &mut totals.logged_collisions,
                    Some(Meeting::Collision { .. }) => &mut totals.collisions,
                    Some(Meeting::Overlap { .. }) if !in_log => &mut totals.light_overlaps,
                    Some(Meeting::Near { .. }) if !in_log => &mut totals.near_misses,
                    _ => continue,
                };
                *count += 1;
            }
            let (a, b) = (input.actors[i].id.to_owned(), input.actors[j].id.to_owned());
            if let (Some(meeting), Some((place, measures, log))) = (meeting, measured) {
                let (kind, time_s) = (meeting.kind(), meeting.time_s());
                let (a, b, x_m, y_m) = (a.clone(), b.clone(), place.x, place.y);
                scores.encounters.push(Encounter { a, b, kind, time_s, x_m, y_m, measures, log, in_log });
            }
            match meeting {
                Some(Meeting::Collision { time_s, iou, closing_speed_mps }) => {
                    scores.collisions.push(Collision { a, b, time_s, iou, closing_speed_mps, in_log });
                }
                Some(Meeting::Overlap { time_s, depth_m }) => {
                    scores.overlaps.push(BoxOverlap { a, b, time_s, depth_m, in_log });
                }
                Some(Meeting::Near { time_s, distance_m, ttc_s, closing_speed_mps }) => {
                    let miss = NearMiss { a, b, time_s, distance_m, ttc_s, closing_speed_mps, in_log };
                    scores.near_misses.push(miss);
                }
                None => {}
            }
        }
        scores
    }
}

/// Midpoint of the two at a step of their interaction, with the measures of their motions and of their
/// recordings.
fn measured(
    input: &ScoreInput<'_>,
    (a, mover_a): (&Actor<'_>, &Mover),
    (b, mover_b): (&Actor<'_>, &Mover),
    step: usize,
) -> Option<(Vec2, Measures, Option<Measures>)> {
    let center = |mover: &Mover| Some(mover.moments.get(step)?.as_ref()?.outline.center());
    let place = 0.5 * (center(mover_a)? + center(mover_b)?);
    let whole = input.steps.len();
    let log = log::logged(input, a, b).map(|(p, q)| Measures::of(&p, &q, whole));
    Some((place, Measures::of(mover_a, mover_b, step), log))
}
