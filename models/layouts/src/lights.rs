//! Signal programs: movements of one phase do not conflict, or one of them gives way.

use crate::draft::MapDraft;
use crate::parameters::{Program, Turn, TurnAcross};
use crate::turns::Movement;
use scene::geometry::segments::{Segment, SegmentIndex, pieces};
use scene::{HORIZON_STEPS, STEP_S, Signal, SignalState, Vec2, wrap_angle};

/// Movements with green at the same time, by index in the draft's list.
type Phase = Vec<usize>;

/// A signalled crosswalk: its id, the arm that it crosses, and the waiting positions.
#[derive(Clone, Debug)]
pub struct SignalledCrosswalk {
    pub id: String,
    pub arm: usize,
    pub from: Vec2,
}

/// Whether two paths meet: they cross, or end in one lane.
pub fn meet(draft: &MapDraft, a: &Movement, b: &Movement) -> bool {
    if a.from == b.from {
        return false;
    }
    let (here, there) = (&draft.map.lanes[a.lane], &draft.map.lanes[b.lane]);
    if here.successors == there.successors {
        return true;
    }
    let index = SegmentIndex::new(pieces(&here.points.xy, 0).collect());
    pieces(&there.points.xy, 1).any(|piece: Segment| {
        let middle = 0.5 * (piece.from + piece.to);
        let reach = 0.5 * (piece.to - piece.from).norm() + 1.0;
        index.near(middle, reach).any(|other| other.crosses(piece.from, piece.to))
    })
}

/// Whether one of two paths gives way to the other while both have green: at least one of them turns.
pub fn gives_way(a: &Movement, b: &Movement) -> bool {
    a.turn != Turn::Straight || b.turn != Turn::Straight
}

/// A movement that bends less than this looks straight to its driver, radians.
const LOOKS_STRAIGHT_RAD: f64 = 0.3;

/// Whether two movements of opposite arms may have green together: they do not meet, or the turning driver
/// sees whom to yield to. The latter is so before oncoming traffic, into the same arm, and if both turn. It
/// is not so if a movement that looks straight is crossed from the side.
fn go_together(draft: &MapDraft, a: &Movement, b: &Movement) -> bool {
    let bends = |m: &Movement| {
        let path = draft.points(m.lane);
        let direction = |pair: &[Vec2]| (pair[1] - pair[0]).y.atan2((pair[1] - pair[0]).x);
        let (first, last) = (path.windows(2).next(), path.windows(2).last());
        let change = first.zip(last).map_or(0.0, |(f, l)| wrap_angle(direction(l) - direction(f)));
        change.abs() > LOOKS_STRAIGHT_RAD
    };
    let oncoming = a.to == b.from || b.to == a.from || a.to == b.to;
    oncoming || (bends(a) && bends(b)) || !meet(draft, a, b)
}

/// The phases of a junction with this many arms.
fn phases(draft: &MapDraft, arms: usize, turns_across: TurnAcross) -> Vec<Phase> {
    let movements = &draft.movements;
    let of = |arm: usize| (0..movements.len()).filter(move |i| movements[*i].from == arm);
    let straight = |arm: usize| {
        let ahead = movements.iter().find(|m| m.from == arm && m.turn == Turn::Straight);
        ahead.map(|m| m.to)
    };
    let mut done = vec![false; arms];
    let mut phases = Vec::new();
    for arm in 0..arms {
        if done[arm] || of(arm).next().is_none() {
            continue;
        }
        done[arm] = true;
        let fit = |other: usize| {
            of(arm).all(|i| of(other).all(|j| go_together(draft, &movements[i], &movements[j])))
        };
        let opposite =
            straight(arm).filter(|other| straight(*other) == Some(arm) && !done[*other] && fit(*other));
        let Some(other) = opposite else {
            phases.push(of(arm).collect());
            continue;
        };
        done[other] = true;
        let both = || of(arm).chain(of(other));
        match turns_across {
            TurnAcross::Permissive => phases.push(both().collect()),
            TurnAcross::Protected => protected(draft, both().collect(), [arm, other], &mut phases),
        }
    }
    phases
}

/// Turns across oncoming traffic get their own phase if they have their own lanes; otherwise the arms go one
/// after the other.
fn protected(draft: &MapDraft, both: Phase, arms: [usize; 2], phases: &mut Vec<Phase>) {
    let movements = &draft.movements;
    let across = |i: &usize| movements[*i].turn == Turn::Left;
    let lane_in = |i: &usize| draft.map.lanes[movements[*i].lane].predecessors.first();
    let (lefts, rest): (Phase, Phase) = both.iter().copied().partition(across);
    let shared = lefts.iter().any(|i| rest.iter().any(|j| lane_in(i) == lane_in(j)));
    let cross = lefts.iter().any(|i| lefts.iter().any(|j| meet(draft, &movements[*i], &movements[*j])));
    if lefts.is_empty() {
        phases.push(rest);
    } else if shared || cross {
        phases.extend(
            arms.map(|arm| both.iter().copied().filter(|i| movements[*i].from == arm).collect::<Phase>()),
        );
    } else {
        phases.push(rest);
        phases.push(lefts);
    }
}

/// Adds the signals of a junction's paths.
pub fn draw(draft: &mut MapDraft, arms: usize, program: &Program, crossings: &[SignalledCrosswalk]) {
    let phases = phases(draft, arms, program.turns_across);
    let mut signals = Vec::new();
    for (i, movement) in draft.movements.iter().enumerate() {
        let green: Vec<bool> = phases.iter().map(|phase| phase.contains(&i)).collect();
        let stop = draft.points(movement.lane).first().copied();
        let runs = runs(&green, program, true);
        signals.push(Signal { lane: draft.map.lanes[movement.lane].id.clone(), stop, stop_z_m: None, runs });
    }
    for crossing in crossings {
        // Whether no traffic leaves the arm, and none enters it straight.
        let quiet = |phase: &Phase| {
            phase
                .iter()
                .map(|i| &draft.movements[*i])
                .all(|m| m.from != crossing.arm && !(m.to == crossing.arm && m.turn == Turn::Straight))
        };
        let green: Vec<bool> = phases.iter().map(quiet).collect();
        let runs = runs(&green, program, false);
        signals.push(Signal { lane: crossing.id.clone(), stop: Some(crossing.from), stop_z_m: None, runs });
    }
    draft.signals = signals;
}

/// Signal states for green in these phases, over one planning window.
fn runs(green: &[bool], program: &Program, yellow: bool) -> Vec<(usize, SignalState)> {
    let turn_s = program.green_s + program.yellow_s + program.all_red_s;
    // A junction with one phase is red for as long as a second phase would take.
    let cycle_s = turn_s * green.len().max(2) as f64;
    let mut runs: Vec<(usize, SignalState)> = Vec::new();
    for step in 0..=HORIZON_STEPS {
        // In the middle of a step, so that rounding of sums has no effect.
        let at_s = ((step as f64 + 0.5) * STEP_S + program.offset_s).rem_euclid(cycle_s);
        let phase = (at_s / turn_s) as usize;
        let in_turn_s = at_s - phase as f64 * turn_s;
        let state = match in_turn_s {
            _ if !green.get(phase).copied().unwrap_or(false) => SignalState::Stop,
            s if s < program.green_s => SignalState::Go,
            s if yellow && s < program.green_s + program.yellow_s => SignalState::Caution,
            _ => SignalState::Stop,
        };
        if runs.last().is_none_or(|(_, last)| *last != state) {
            runs.push((step, state));
        }
    }
    runs
}
