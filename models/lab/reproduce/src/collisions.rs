//! Table II: collision rates with all road users generated together and replanned. The scenes are those of
//! the recording with the most encounters between road users of different types.

use crate::methods::{Answerer, Entrants, Method};
use crate::paper;
use crate::sets::{Centre, Cut, Data, SetOptions, Sets, TestCase, each_case, interactive};
use crate::{Stop, scene_index};
use anyhow::Result;
use lab_eval::Site;
use lab_eval::rivals::{least_effort, replanned};
use lab_eval::sheet::{Cell, Form, Sheet};
use lab_eval::stats::{Bootstrap, Value};
use lab_eval::together::{Ask, Boxes, Motions, logged_pairs, motions_by, motions_of, motions_of_log, scenes};
use std::collections::BTreeSet;

/// Steps per second.
const STEPS_A_SECOND: usize = 10;
/// Methods that generate whole scenes.
const METHODS: [Method; 4] = [Method::Mixture, Method::Paper, Method::OursTrained, Method::OursShipped];

/// Options of Table II.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CollisionOptions {
    /// Intersection over union above which two boxes collide; the paper does not state its own.
    pub iou: f64,
    /// Scenes chosen for pedestrians and for cyclists, at most.
    pub most: [usize; 2],
    /// Draws noise and resamples.
    pub seed: u64,
}

/// Shares of colliding road users in one scene.
struct CollisionShares {
    scene: usize,
    log: f64,
    /// The path of least effort to each end, planned once.
    formula: f64,
    /// By [`paper::ROLLOUTS_S`] and [`METHODS`].
    rates: Vec<[Option<f64>; METHODS.len()]>,
}

/// The paper's Table II beside its own figures, and the number of chosen scenes.
///
/// # Errors
/// When a network fails, the data have changed, or the run is stopped.
pub fn table(
    data: &Data,
    sets_options: &SetOptions,
    sets: &Sets,
    entrants: &Entrants,
    options: CollisionOptions,
    stop: &Stop,
    progress: &dyn Fn(&str),
) -> Result<(Sheet, [usize; 2])> {
    let chosen = [Centre::Pedestrian, Centre::Cyclist].map(|centre| {
        let place = usize::from(centre == Centre::Cyclist);
        interactive(sets, centre, options.most[place])
    });
    let counts = [chosen[0].len(), chosen[1].len()];
    let cases: Vec<TestCase> = chosen.into_iter().flatten().collect();
    let index = scene_index(&cases);
    let told = |done: usize| progress(&format!("Table II: {done} of {} scenes", cases.len()));
    let shares = each_case(data, sets_options, &cases, stop, &told, |_, case, cut| {
        judge(&cut, index[&case.place()], entrants, options)
    })?;
    let boot = Bootstrap::new(index.len(), options.seed);
    let notes = [
        format!(
            "{} scenes of 9 s about a pedestrian and {} about a cyclist (the paper: 200 and 100): those in whose log most \
             pairs of different types come within 2.5 m of one place within 3 s of each other, and then those that come \
             nearest, 10 m at most. Everybody there at the \
             first frame is generated with the whole state of its log's end as condition, and planned anew from the \
             states reached after each interval, the rivals like ours: theirs by their most probable futures, ours by \
             the scene that is chosen. SCR is the mean over scenes of the share of road users whose box overlaps \
             another's by an intersection over union above {} at some third step; the paper does not say its threshold. \
             Pairs that overlap in the log are left out of all lines but its own.",
            counts[0], counts[1], options.iou
        ),
        "Plans of 9 s are made once: the 9 s rollout is a plan without replanning.".to_owned(),
    ];
    let notes: Vec<&str> = notes.iter().map(String::as_str).collect();
    let mut sheet = Sheet::new(
        "Table II: interaction reasoning",
        &notes,
        &["Rollout Interval", "Model"],
        &["SCR", "paper"],
    );
    let cell = |value: &dyn Fn(&CollisionShares) -> Option<f64>| {
        let values = shares.iter().filter_map(|s| Some(Value::new(s.scene, value(s)?)));
        Cell::of(boot.estimate(values), Form::Percent)
    };
    for (i, seconds) in paper::ROLLOUTS_S.into_iter().enumerate() {
        for (j, method) in METHODS.into_iter().enumerate() {
            let name = match method {
                Method::Mixture => "T.G. Mixture Training with Condition",
                other => other.name(),
            };
            let theirs = paper::collisions(seconds, method);
            let beside = theirs.map_or(Cell::Nothing, |value| Cell::Number { value, form: Form::Percent });
            sheet.push([format!("{seconds}s").as_str(), name], vec![cell(&|s| s.rates[i][j]), beside]);
        }
    }
    sheet.push(
        ["once", "least effort to the condition, no learning"],
        vec![cell(&|s| Some(s.formula)), Cell::Nothing],
    );
    sheet.push(["-", "the log itself"], vec![cell(&|s| Some(s.log)), Cell::Nothing]);
    Ok((sheet, counts))
}

fn judge(cut: &Cut, scene: usize, entrants: &Entrants, options: CollisionOptions) -> Result<CollisionShares> {
    let site = Site::new(scene, &cut.scene);
    let left_out = logged_pairs(&site);
    let share = |motions: &Motions, left_out: &BTreeSet<(usize, usize)>| {
        let meetings = Boxes::new(&site, motions).meetings_over(options.iou);
        let counted = meetings.iter().filter(|m| m.paper && !left_out.contains(&m.pair));
        let who: BTreeSet<usize> = counted.flat_map(|m| [m.pair.0, m.pair.1]).collect();
        who.len() as f64 / motions.iter().flatten().count().max(1) as f64
    };
    let mut rates = Vec::new();
    for seconds in paper::ROLLOUTS_S {
        let every = seconds * STEPS_A_SECOND;
        let mut row = [None; METHODS.len()];
        for (slot, method) in row.iter_mut().zip(METHODS) {
            let motions = match entrants.of(method, Centre::Ego) {
                Some(Answerer::Learned(baseline, _)) => replanned(baseline, &site, true, every)?,
                Some(Answerer::Ours(generator)) => {
                    let ask = Ask { replan_steps: Some(every), ..Ask::shipped(true, options.seed) };
                    match scenes(generator, &site, ask)?.first() {
                        Some(sample) => motions_of(&site, sample),
                        None => continue,
                    }
                }
                Some(Answerer::Spline) | None => continue,
            };
            *slot = Some(share(&motions, &left_out));
        }
        rates.push(row);
    }
    let formula = motions_by(&site, true, |i, start, goal, step| {
        least_effort(&site.blind.agents[i], start, goal, step)
    });
    Ok(CollisionShares {
        scene,
        log: share(&motions_of_log(&site), &BTreeSet::new()),
        formula: share(&formula, &left_out),
        rates,
    })
}
