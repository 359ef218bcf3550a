//! Filled scenes: placement fills empty maps of templates and recordings, and the road users are generated
//! together without goals. The scores show the faults that placement causes.

use anyhow::{Result, anyhow};
use experts::placement::{Amount, PlaceRequest};
use experts::{Cancel, Engine, Request};
use rayon::prelude::*;
use scene::geometry::wrap_angle;
use scene::random::Key;
use scene::score::report::{Collision, NearMiss, SceneScore, Stretch};
use scene::score::{Drivable, ScoreInput, score};
use scene::{Agent, Scene, State};
use std::f64::consts::FRAC_PI_6;
use std::fmt::Write as _;
use std::ops::RangeInclusive;
use std::sync::Arc;

/// A fault sooner than this is already in the placement, seconds.
const SOON_S: f64 = 1.0;
/// Range of the number of road users of a draw.
const COUNTS: RangeInclusive<usize> = 20..=80;

/// One filled scene with its futures and faults.
pub struct Filled {
    /// The scene; its name contains map and seed.
    pub scene: Scene,
    /// Its faults in the order of time.
    pub faults: Vec<FilledFault>,
}

/// A fault of a filled scene.
pub struct FilledFault {
    /// Word for it.
    pub kind: &'static str,
    /// Scene time at which it begins, seconds.
    pub time_s: f64,
    /// Road users, place and kind, for people.
    pub what: String,
}

/// The scenes of the templates, then the given scenes without their road users.
///
/// # Errors
/// When a template cannot be drawn.
pub fn maps(given: &[Scene]) -> Result<Vec<Scene>> {
    let drawn = layouts::TEMPLATES.iter().map(|template| {
        let built = layouts::scene(&template.layout(), template.name());
        built.map(|(scene, _)| scene).map_err(|faults| anyhow!("{}: {faults:?}", template.name()))
    });
    let emptied =
        given.iter().map(|scene| Ok(Scene { agents: Vec::new(), generated: None, ..scene.clone() }));
    drawn.chain(emptied).collect()
}

/// Fills the maps in turn, `draws` times, and scores 9 s of each.
///
/// # Errors
/// When placement or generation fails.
pub fn eval(engine: &Engine, maps: &[Scene], draws: u64) -> Result<Vec<Filled>> {
    (0..draws).into_par_iter().map(|seed| filled(engine, &maps[seed as usize % maps.len()], seed)).collect()
}

fn filled(engine: &Engine, map: &Scene, seed: u64) -> Result<Filled> {
    let mut scene = map.clone();
    let mut request = PlaceRequest::new(Arc::new(map.clone()));
    let more = Key::default().text("filled").number(seed).stream().below(COUNTS.end() - COUNTS.start() + 1);
    (request.amount, request.seed) = (Amount::Count(COUNTS.start() + more), seed);
    scene.agents = engine.placer.place(&request, &Cancel::default())?.agents;
    scene.name = format!("{} {seed}", map.name);
    let answer = engine.generator.answer(Request { seed, ..Request::new(Arc::new(scene.clone())) })?;
    let drivable = Drivable::new(&scene.map);
    let input = ScoreInput::of_sample(&scene, answer.samples.first(), &drivable);
    let score = score(&input).scene;
    let state = |id: &str, time_s: f64| {
        let actor = input.actors.iter().find(|a| a.id == id)?;
        actor.state((time_s / scene::STEP_S).round() as usize).copied()
    };
    let faults = faults(&scene, &score, &state);
    Ok(Filled { scene, faults })
}

type StateAt<'a> = dyn Fn(&str, f64) -> Option<State> + 'a;

fn faults(scene: &Scene, score: &SceneScore, state: &StateAt<'_>) -> Vec<FilledFault> {
    let collided = |c: &Collision| (c.time_s, c.a.clone(), c.b.clone(), format!("iou {:.2}", c.iou));
    let missed = |m: &NearMiss| {
        let what =
            format!("gap {:.2} m closing {:.1} ttc {:.1?}", m.distance_m, m.closing_speed_mps, m.ttc_s);
        (m.time_s, m.a.clone(), m.b.clone(), what)
    };
    let pairs = (score.collisions.iter().filter(|c| !c.in_log).map(|c| ("collision", collided(c))))
        .chain(score.near_misses.iter().filter(|m| !m.in_log).map(|m| ("near miss", missed(m))));
    let pairs = pairs.map(|(kind, (time_s, a, b, what))| FilledFault {
        kind,
        time_s,
        what: format!("{}: {what}", pair(scene, state, time_s, [&a, &b])),
    });
    let stretch = |kind: &'static str, list: &[Stretch]| -> Vec<FilledFault> {
        let own = list.iter().filter(|s| !s.in_log);
        own.map(|s| FilledFault {
            kind,
            time_s: s.time_s,
            what: format!("{} at {:.0}, {:.0}: {:.1?}", who(scene, &s.agent), s.x_m, s.y_m, s.worst),
        })
        .collect()
    };
    let red = score.red_lights.iter().filter(|r| !r.in_log).map(|r| FilledFault {
        kind: "red light",
        time_s: r.time_s,
        what: format!("{} at {:.1} m/s", who(scene, &r.agent), r.speed_mps),
    });
    pairs
        .chain(red)
        .chain(stretch("off the road", &score.off_road))
        .chain(stretch("over a median", &score.over_median))
        .chain(stretch("wrong way", &score.wrong_way))
        .chain(stretch("hard braking", &score.harsh_braking))
        .chain(stretch("hard steering", &score.harsh_steering))
        .collect()
}

/// Describes two road users: their relation, speeds and positions at the start and at the given time.
fn pair(scene: &Scene, state: &StateAt<'_>, time_s: f64, ids: [&str; 2]) -> String {
    let [Some(a), Some(b)] = ids.map(|id| state(id, time_s)) else { return String::new() };
    let turn = wrap_angle(a.heading_rad - b.heading_rad).abs();
    let relation = if turn < FRAC_PI_6 {
        "same way"
    } else if turn > 5.0 * FRAC_PI_6 {
        "oncoming"
    } else {
        "crossing"
    };
    let one = |id: &str, now: &State| {
        let start = state(id, 0.0).unwrap_or(*now);
        format!(
            "{} from {:.0}, {:.0} at {:.1} to {:.0}, {:.0} at {:.1} m/s",
            who(scene, id),
            start.x_m,
            start.y_m,
            start.speed_mps(),
            now.x_m,
            now.y_m,
            now.speed_mps()
        )
    };
    format!("{relation}: {} x {}", one(ids[0], &a), one(ids[1], &b))
}

fn who(scene: &Scene, id: &str) -> String {
    let parked = |a: &Agent| a.conditions.start.position.is_none();
    let kind = scene.agent(id).map(|a| format!("{:?}{}", a.subtype, if parked(a) { " parked" } else { "" }));
    format!("{id} {}", kind.unwrap_or_default().to_lowercase())
}

/// Share of draws with each kind of fault, and each fault where `listed`.
pub fn markdown(all: &[Filled], listed: bool) -> String {
    let users: usize = all.iter().map(|f| f.scene.agents.len()).sum();
    let mut text = format!("{} filled scenes with {users} road users.\n\n", all.len());
    let _ = writeln!(text, "| fault | scenes | faults | scenes within {SOON_S} s |\n|---|---|---|---|");
    let mut kinds: Vec<&str> = vec!["collision", "near miss"];
    kinds.extend(all.iter().flat_map(|f| &f.faults).map(|fault| fault.kind));
    let mut seen = Vec::new();
    for kind in kinds {
        if seen.contains(&kind) {
            continue;
        }
        seen.push(kind);
        let of = |f: &Filled, until_s: f64| {
            f.faults.iter().filter(|fault| fault.kind == kind && fault.time_s <= until_s).count()
        };
        let scenes = |until_s: f64| all.iter().filter(|f| of(f, until_s) > 0).count();
        let faults: usize = all.iter().map(|f| of(f, f64::INFINITY)).sum();
        let (any, soon) = (scenes(f64::INFINITY), scenes(SOON_S));
        let share = 100.0 * any as f64 / all.len().max(1) as f64;
        let _ = writeln!(text, "| {kind} | {any} ({share:.1} %) | {faults} | {soon} |");
    }
    for filled in all.iter().filter(|_| listed) {
        for fault in &filled.faults {
            let FilledFault { kind, time_s, what } = fault;
            let _ = write!(text, "\n- {}, {kind}: {time_s:.1} s {what}", filled.scene.name);
        }
    }
    text.push('\n');
    text
}
