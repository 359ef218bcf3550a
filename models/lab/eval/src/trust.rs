//! Table 9: dragged goals from the view of a traffic engineer. Faults of the shown future and of all six, by
//! whether the road leads to the goal; reactions and their causes; near copies; jumps of the shown future;
//! red-light violations.

use super::control;
use super::goal_ways::{self, InTime};
use super::measure::{goal_error, is_met};
use super::picture::{futures_svg, who};
use super::sheet::{Cell, Form, Sheet};
use super::stats::{Bootstrap, Value};
use super::table::{Made, TableSpec};
use super::{Case, Judged, Site};
use anyhow::Result;
use experts::request::ShownLast;
use experts::{Answer, Generator, React, Request};
use rayon::prelude::*;
use scene::geometry::direction;
use scene::geometry::obb::OrientedBox;
use scene::judge::{FaultKind, RelationKind};
use scene::random::Key;
use scene::{AgentFutures, AgentId, AgentType, Future, Goal, Vec2};
use std::collections::BTreeSet;

/// Most road users with dragged goals, with ten drags each.
const MOST_CASES: usize = 150;
/// Distances by which goals are moved, metres; each along the lane and across it, with alternating sign.
const MOVES_M: [f64; 5] = [2.0, -4.0, 8.0, -15.0, 30.0];
/// Shift of the goal that tests for jumps of the answer, metres.
const NUDGE_M: f64 = 0.05;
/// Futures whose mean distance is below this are copies, metres.
const COPY_M: f64 = 0.5;
/// A driver within this distance of a red stop line gets a goal that requires waiting, metres.
const BEFORE_LINE_M: f64 = 50.0;
/// Half seconds of a window.
const SHOWN: usize = 18;

/// Faults in the order of the columns.
const KINDS: [(FaultKind, &str); 15] = [
    (FaultKind::Collision, "collision"),
    (FaultKind::RedLight, "red light"),
    (FaultKind::WrongWay, "wrong way"),
    (FaultKind::OverMedian, "over median"),
    (FaultKind::OffRoad, "off road"),
    (FaultKind::OffMap, "off map"),
    (FaultKind::OnCarriageway, "on carriageway"),
    (FaultKind::Speeding, "speeding"),
    (FaultKind::HarshBraking, "harsh braking"),
    (FaultKind::HarshSteering, "harsh steering"),
    (FaultKind::Running, "running"),
    (FaultKind::Askew, "askew"),
    (FaultKind::FailsToYield, "fails to yield"),
    (FaultKind::ForcesBraking, "forces braking"),
    (FaultKind::NearMiss, "near miss"),
];

/// Table 9.
pub(super) const TABLE: TableSpec = TableSpec {
    number: 9,
    name: "trust",
    make: |trial| trust(&trial.judged, &trial.sites, &trial.boot, trial.seed, trial.pictures),
};

/// Pictures of the worst drags of each kind.
const WORST: usize = 20;

/// One drag with its result.
struct Drag {
    site: usize,
    /// Index into the site's cases, and where the goal was put.
    case: usize,
    goal: Goal,
    /// Size of the shown future's worst fault, in its unit.
    extent: f64,
    vehicle: bool,
    met: bool,
    /// How a route with the traffic leads to the goal.
    by_road: InTime,
    /// No logged road user occupies the goal when it is due.
    free: bool,
    /// Faults of the shown future.
    shown: BTreeSet<FaultKind>,
    /// Faults of each future.
    all: Vec<BTreeSet<FaultKind>>,
    /// Whether the shown future is farther past the road's edges than the tolerance, without a fault that
    /// reports it.
    unsaid: bool,
    /// Whether it collides with a road user that was absent at the start.
    hits_late: bool,
    /// Number of others with a changed motion, and the number of those without a cause.
    changed: [usize; 2],
    /// Futures that are near another one, and lists in which two have the same relations and manoeuvre.
    copies: usize,
    repeats: bool,
    /// Greatest displacement of the shown future when its goal moves by 5 cm, metres, and whether its letter
    /// changed.
    jump_m: f64,
    letter_changed: bool,
}

fn trust(judged: &[Judged], sites: &[Site<'_>], boot: &Bootstrap, seed: u64, pictures: bool) -> Result<Made> {
    let mut drawn = Vec::new();
    let picked = control::picked(sites, seed, MOST_CASES);
    let mut sheets = [faults_sheet(), steadiness_sheet(), lights_sheet()];
    for own in judged {
        let drags: Result<Vec<Vec<Drag>>> =
            picked.par_iter().map(|&(s, c)| drags(&own.generator, &sites[s], c, seed)).collect();
        let drags: Vec<Drag> = drags?.into_iter().flatten().collect();
        let met: Vec<&Drag> = drags.iter().filter(|d| d.met && d.vehicle).collect();
        type Holds = fn(InTime) -> bool;
        let rows: [(&str, Holds); 3] = [
            ("a road leads there", |way| way >= InTime::Pressed),
            ("the same by the limits", |way| way == InTime::Lawful),
            ("none does", |way| way == InTime::No),
        ];
        for (name, holds) in rows {
            let mine: Vec<&Drag> = met.iter().copied().filter(|d| holds(d.by_road)).collect();
            sheets[0].push([own.name.as_str(), name, "shown"], fault_cells(boot, &mine, true));
            sheets[0].push([own.name.as_str(), name, "all six"], fault_cells(boot, &mine, false));
        }
        let others: Vec<&Drag> = drags.iter().filter(|d| d.met && !d.vehicle).collect();
        sheets[0]
            .push([own.name.as_str(), "on foot and bicycles", "shown"], fault_cells(boot, &others, true));
        let all: Vec<&Drag> = drags.iter().collect();
        sheets[1].push([own.name.as_str()], steadiness_cells(boot, &all));
        sheets[2].push([own.name.as_str()], light_cells(boot, &before_red(&own.generator, sites, seed)?));
        if pictures && drawn.is_empty() {
            drawn = worst(&own.generator, sites, &drags, seed)?;
        }
    }
    Ok(Made { sheets: sheets.into(), pictures: drawn, ..Made::default() })
}

/// The worst drags of each kind as pictures: what a person would see.
fn worst(
    generator: &Generator,
    sites: &[Site<'_>],
    drags: &[Drag],
    seed: u64,
) -> Result<Vec<(String, String)>> {
    let road = [FaultKind::WrongWay, FaultKind::OverMedian, FaultKind::OffRoad];
    let forced = [FaultKind::FailsToYield, FaultKind::ForcesBraking];
    let has = |d: &Drag, kinds: &[FaultKind]| kinds.iter().any(|k| d.shown.contains(k));
    type Measure<'a> = &'a dyn Fn(&Drag) -> Option<f64>;
    let kinds: [(&str, Measure<'_>); 13] = [
        ("collision", &|d| (d.free && has(d, &[FaultKind::Collision])).then_some(d.extent)),
        ("foot", &|d| (!d.vehicle && d.met && has(d, &[FaultKind::Collision])).then_some(d.extent)),
        ("road", &|d| {
            (d.met && d.vehicle && d.by_road >= InTime::Pressed && has(d, &road)).then_some(d.extent)
        }),
        ("near", &|d| {
            (d.met && d.by_road >= InTime::Pressed && has(d, &[FaultKind::NearMiss])).then_some(-d.extent)
        }),
        ("steering", &|d| {
            (d.met && d.by_road >= InTime::Pressed && has(d, &[FaultKind::HarshSteering])).then_some(d.extent)
        }),
        ("map", &|d| {
            (d.met && d.by_road >= InTime::Pressed && has(d, &[FaultKind::OffMap])).then_some(d.extent)
        }),
        ("carriageway", &|d| (d.met && has(d, &[FaultKind::OnCarriageway])).then_some(d.extent)),
        ("speeding", &|d| {
            (d.met && d.by_road >= InTime::Pressed && has(d, &[FaultKind::Speeding])).then_some(d.extent)
        }),
        ("running", &|d| (d.met && has(d, &[FaultKind::Running])).then_some(d.extent)),
        ("askew", &|d| {
            (d.met && d.by_road >= InTime::Pressed && has(d, &[FaultKind::Askew])).then_some(d.extent)
        }),
        ("forces", &|d| (d.met && has(d, &forced)).then_some(d.extent)),
        ("jump", &|d| (d.jump_m > 1.0).then_some(d.jump_m)),
        ("copies", &|d| (d.copies > 1).then_some(d.copies as f64)),
    ];
    let mut wanted: Vec<(String, &Drag)> = Vec::new();
    for (name, measure) in kinds {
        let mut found: Vec<(f64, &Drag)> = drags.iter().filter_map(|d| Some((measure(d)?, d))).collect();
        found.sort_by(|a, b| b.0.total_cmp(&a.0));
        let named = |(i, (_, d)): (usize, (f64, _))| (format!("trust-{name}-{:02}", i + 1), d);
        wanted.extend(found.into_iter().take(WORST).enumerate().map(named));
    }
    wanted
        .par_iter()
        .map(|(name, drag)| {
            let site = &sites[drag.site];
            let case = &site.cases[drag.case];
            let request = asked(site, case, drag.goal, seed);
            let scene = request.scene.clone();
            let answer = generator.answer(request)?;
            let futures = answer.samples.into_iter().next().map(|s| s.agents).unwrap_or_default();
            let name = format!("{name}-{}.svg", who(site, &site.log(case).id));
            Ok((name, futures_svg(&scene, &futures, case.start.position())))
        })
        .collect()
}

/// Request of a drag: all road users may react.
fn asked(site: &Site<'_>, case: &Case, goal: Goal, seed: u64) -> Request {
    let mut request = control::request(site.scene.clone(), case, goal, seed);
    request.react = React::Everyone;
    request
}

fn drags(generator: &Generator, site: &Site<'_>, index: usize, seed: u64) -> Result<Vec<Drag>> {
    let case = &site.cases[index];
    let mut draw = Key::default().number(seed).words(&["trust", site.name(), &site.log(case).id]).stream();
    let mut out = Vec::new();
    for (along, metres) in [true, false].into_iter().flat_map(|a| MOVES_M.map(|m| (a, m))) {
        let Some(goal) = control::dragged_goal(site, case, along, metres) else { continue };
        let nudge = direction(std::f64::consts::TAU * draw.unit()) * NUDGE_M;
        out.push(drag(generator, site, index, goal, nudge, seed)?);
    }
    Ok(out)
}

fn drag(
    generator: &Generator,
    site: &Site<'_>,
    index: usize,
    goal: Goal,
    nudge: Vec2,
    seed: u64,
) -> Result<Drag> {
    let case = &site.cases[index];
    let log = site.log(case);
    let first = generator.answer(asked(site, case, goal, seed))?;
    let futures = futures(&first, &log.id);
    let shown = futures.and_then(|f| f.modes.get(f.chosen));
    let nudged = Goal { position: goal.position.map(|p| p + nudge), ..goal };
    let mut again = asked(site, case, nudged, seed);
    again.shown = shown.map(|s| (log.id.clone(), last_shown(s))).into_iter().collect();
    let again = generator.answer(again)?;
    let after = self::futures(&again, &log.id).and_then(|f| f.modes.get(f.chosen));
    let states = shown.map_or(&[][..], |f| &f.states);
    let apart = states.iter().zip(after.map_or(&[][..], |f| &f.states));
    let jump_m = apart.map(|(a, b)| (a.position() - b.position()).norm()).fold(0.0, f64::max);
    let kinds = |f: &Future| f.about.faults.iter().map(|fault| fault.kind).collect::<BTreeSet<_>>();
    let end = states.get(case.goal_step - 1).copied().unwrap_or(case.start);
    let vehicle = case.agent_type == AgentType::Vehicle;
    let late = |id: &AgentId| site.scene.agent(id).is_some_and(|a| a.state_at(0).is_none());
    let hits = |f: &Future| {
        f.about
            .faults
            .iter()
            .filter(|f| f.kind == FaultKind::Collision)
            .any(|f| f.with.as_ref().is_some_and(late))
    };
    let reactions =
        first.samples.first().into_iter().flat_map(|s| &s.agents).filter(|(id, _)| **id != log.id);
    let changed: Vec<bool> = reactions.map(|(_, f)| f.reaction.is_none()).collect();
    Ok(Drag {
        site: site.index,
        case: index,
        goal,
        extent: shown.and_then(|f| f.about.faults.first()?.extent).unwrap_or(0.0),
        vehicle,
        met: is_met(goal_error(&goal, &end)),
        by_road: goal_ways::in_time(site, case, &goal),
        free: goal_ways::is_free(site, case, &goal),
        shown: shown.map(kinds).unwrap_or_default(),
        all: futures.map(|f| f.modes.iter().map(kinds).collect()).unwrap_or_default(),
        unsaid: vehicle && shown.is_some_and(|f| leaves_unsaid(site, case, f)),
        hits_late: shown.is_some_and(hits),
        changed: [changed.len(), changed.iter().filter(|without| **without).count()],
        copies: futures.map_or(0, copies),
        repeats: futures.is_some_and(repeats),
        jump_m,
        letter_changed: shown.map(|f| f.anchor) != after.map(|f| f.anchor),
    })
}

fn futures<'a>(answer: &'a Answer, id: &str) -> Option<&'a AgentFutures> {
    answer.samples.first()?.agents.get(id)
}

/// As the editor sends it.
fn last_shown(future: &Future) -> ShownLast {
    let places = future.states.iter().skip(4).step_by(5).take(SHOWN).map(scene::State::position);
    ShownLast { anchor: future.anchor, places: places.collect() }
}

/// Whether it goes past the road's edges by half a metre or more, from inside them, without a fault that
/// reports it.
fn leaves_unsaid(site: &Site<'_>, case: &Case, future: &Future) -> bool {
    let size = site.log(case).size;
    let outside = |state: &scene::State| {
        site.drivable.box_outside_m(&OrientedBox::of_state(state, &size)).unwrap_or(0.0)
    };
    let said = |f: &scene::judge::Fault| matches!(f.kind, FaultKind::OffRoad | FaultKind::OverMedian);
    outside(&case.start) < 0.15
        && future.states.iter().any(|s| outside(s) > 0.5)
        && !future.about.faults.iter().any(said)
}

/// Number of futures that are a copy of an earlier one.
fn copies(futures: &AgentFutures) -> usize {
    let apart = |a: &Future, b: &Future| {
        let pairs = a.states.iter().zip(&b.states).step_by(5);
        let (sum, n) =
            pairs.fold((0.0, 0.0), |(s, n), (a, b)| (s + (a.position() - b.position()).norm(), n + 1.0));
        if n > 0.0 { sum / n } else { 0.0 }
    };
    let modes = &futures.modes;
    (1..modes.len()).filter(|&i| (0..i).any(|j| apart(&modes[i], &modes[j]) < COPY_M)).count()
}

/// Whether two futures have the same manoeuvre and relations to the same road users.
fn repeats(futures: &AgentFutures) -> bool {
    let key = |f: &Future| {
        let relations: BTreeSet<(RelationKind, AgentId)> =
            f.about.relations.iter().map(|r| (r.kind, r.with.clone())).collect();
        (relations, f.about.manoeuvre.map(|m| format!("{m:?}")))
    };
    let keys: BTreeSet<_> = futures.modes.iter().map(key).collect();
    keys.len() < futures.modes.len()
}

/// A driver before a line that is red at the start. Holds its probability of crossing the line at red without
/// a goal, and whether the shown future does.
struct RedLightCase {
    site: usize,
    runs: f64,
    shown: bool,
}

fn before_red(generator: &Generator, sites: &[Site<'_>], seed: u64) -> Result<Vec<RedLightCase>> {
    let found: Result<Vec<Vec<RedLightCase>>> = sites
        .par_iter()
        .map(|site| {
            let ids: BTreeSet<AgentId> =
                site.scene.agents.iter().filter(|a| is_before_red(site, a)).map(|a| a.id.clone()).collect();
            if ids.is_empty() {
                return Ok(Vec::new());
            }
            let mut request = Request::new(std::sync::Arc::new(site.scene.clone()));
            (request.agents, request.seed) = (Some(ids.clone()), seed);
            let answer = generator.answer(request)?;
            let runs = |f: &Future| f.about.faults.iter().any(|f| f.kind == FaultKind::RedLight);
            let waiting = |id: &AgentId| {
                let futures = futures(&answer, id)?;
                let running = futures.modes.iter().filter(|f| runs(f)).map(|f| f.probability).sum();
                let shown = futures.modes.get(futures.chosen).is_some_and(runs);
                Some(RedLightCase { site: site.index, runs: running, shown })
            };
            Ok(ids.iter().filter_map(waiting).collect())
        })
        .collect();
    Ok(found?.into_iter().flatten().collect())
}

/// Whether a vehicle is within this distance before a stop line that is red at the start, on its lane.
fn is_before_red(site: &Site<'_>, agent: &scene::Agent) -> bool {
    let Some(state) = agent.state_at(0).filter(|_| agent.agent_type == AgentType::Vehicle) else {
        return false;
    };
    let forward = direction(state.heading_rad);
    let front = state.position() + forward * (0.5 * agent.size.length_m);
    site.scene.signals.iter().any(|signal| {
        let Some(stop) = signal.stop.filter(|_| signal.at(0).is_stop()) else { return false };
        let to = stop - front;
        let (ahead, beside) = (to.dot(&forward), scene::geometry::cross(forward, to).abs());
        (0.0..BEFORE_LINE_M).contains(&ahead) && beside < 1.5
    })
}

fn faults_sheet() -> Sheet {
    let mut columns = vec!["reached"];
    columns.extend(KINDS.map(|(_, name)| name));
    columns.extend(["any fault", "road left or wrong way", "off road, not said"]);
    Sheet::new(
        "9a Trust: faults of dragged goals that are reached",
        &[
            "Goals moved by 2 to 30 m along and across the lane, ten for each of at most 150 road users drawn by the \
             seed, everybody reacting. Share of reached goals whose future has each fault (`all six`: share of all \
             futures), by whether a route with the traffic leads to the goal \
             in the time; by the limits: also at the speed limit, without harsh braking, and without harsh steering \
             in its bends. Any fault: one of these kinds at least.",
        ],
        &["ours", "goals of vehicles", "futures"],
        &columns,
    )
}

fn fault_cells(boot: &Bootstrap, drags: &[&Drag], shown: bool) -> Vec<Cell> {
    let share = |holds: &dyn Fn(&BTreeSet<FaultKind>) -> bool| {
        let values = drags.iter().map(|d| {
            if shown {
                Value::flag(d.site, holds(&d.shown))
            } else {
                let with = d.all.iter().filter(|kinds| holds(kinds)).count();
                Value::share(d.site, with as f64, d.all.len() as f64)
            }
        });
        Cell::of(boot.estimate(values), Form::Percent)
    };
    let mut cells = vec![Cell::Count(drags.len() as u64)];
    cells.extend(KINDS.map(|(kind, _)| share(&|kinds| kinds.contains(&kind))));
    cells.push(share(&|kinds| KINDS.iter().any(|(kind, _)| kinds.contains(kind))));
    let leaves = [FaultKind::WrongWay, FaultKind::OverMedian, FaultKind::OffRoad];
    cells.push(share(&|kinds| leaves.iter().any(|kind| kinds.contains(kind))));
    let unsaid = drags.iter().filter(|_| shown).map(|d| Value::flag(d.site, d.unsaid));
    cells.push(Cell::of(boot.estimate(unsaid), Form::Percent));
    cells
}

fn steadiness_sheet() -> Sheet {
    Sheet::new(
        "9b Trust: others, copies, steadiness",
        &[
            "The same drags of everybody. Goal missed: out of reach, or somebody is in the way. Collision on free ground: \
             nobody's log is where the goal is when it is due. \
             Changed: others that got another motion. Copies: futures within 0.5 m of another on average. Alike: \
             lists in which two futures have the same relations and manoeuvre. Jump: farthest that the shown future \
             moves when its goal moves by 5 cm and the call carries what was shown, metres.",
        ],
        &["ours"],
        &[
            "drags",
            "goal missed",
            "collision on free ground",
            "with a late arrival",
            "others changed a drag",
            "without a cause",
            "copies",
            "lists with alike",
            "jumps over 1 m",
            "letter changes",
        ],
    )
}

fn steadiness_cells(boot: &Bootstrap, drags: &[&Drag]) -> Vec<Cell> {
    let percent = |values: Vec<Value>| Cell::of(boot.estimate(values), Form::Percent);
    let flags = |holds: fn(&Drag) -> bool| drags.iter().map(|d| Value::flag(d.site, holds(d))).collect();
    let free: Vec<&&Drag> = drags.iter().filter(|d| d.free).collect();
    let collides = |d: &&&Drag| Value::flag(d.site, d.shown.contains(&FaultKind::Collision));
    let changed = |i: usize| drags.iter().map(move |d| Value::new(d.site, d.changed[i] as f64));
    vec![
        Cell::Count(drags.len() as u64),
        percent(drags.iter().map(|d| Value::flag(d.site, !d.met)).collect()),
        percent(free.iter().map(collides).collect()),
        percent(free.iter().map(|d| Value::flag(d.site, d.hits_late)).collect()),
        Cell::of(boot.estimate(changed(0)), Form::Plain),
        Cell::of(boot.estimate(changed(1)), Form::Plain),
        percent(drags.iter().map(|d| Value::share(d.site, d.copies as f64, d.all.len() as f64)).collect()),
        percent(flags(|d| d.repeats)),
        percent(flags(|d| d.jump_m > 1.0)),
        percent(flags(|d| d.letter_changed)),
    ]
}

fn lights_sheet() -> Sheet {
    Sheet::new(
        "9c Trust: drivers before a red light, nothing asked",
        &[
            "Vehicles whose front is at most 50 m before a stop line that is red at the start. Probability of futures \
             that cross it, or a later one, at red within 9 s; share of shown futures that do.",
        ],
        &["ours"],
        &["drivers", "probability of running it", "shown runs it"],
    )
}

fn light_cells(boot: &Bootstrap, waiting: &[RedLightCase]) -> Vec<Cell> {
    vec![
        Cell::Count(waiting.len() as u64),
        Cell::of(boot.estimate(waiting.iter().map(|w| Value::new(w.site, w.runs))), Form::Percent),
        Cell::of(boot.estimate(waiting.iter().map(|w| Value::flag(w.site, w.shown))), Form::Percent),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use lab_train::samples::straight;

    #[test]
    fn copies_and_repeats_are_told_from_futures_that_differ() {
        let alike = AgentFutures::of(0, vec![straight(0.5, 10.0, 0.0), straight(0.5, 10.0, 0.3)]);
        assert_eq!((copies(&alike), repeats(&alike)), (1, true));
        let apart = AgentFutures::of(0, vec![straight(0.5, 10.0, 0.0), straight(0.5, 10.0, 3.0)]);
        assert_eq!(copies(&apart), 0);
    }
}
