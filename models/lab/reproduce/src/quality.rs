//! Table I: distance between the best of six futures and the recording, one road user at a time.

use crate::methods::{Answerer, Entrants, Method};
use crate::paper;
use crate::sets::{Centre, Cut, Data, SetOptions, Sets, TestCase, each_case};
use crate::{Stop, scene_index};
use anyhow::Result;
use lab_eval::measure::{Measured, measure};
use lab_eval::quality::alone;
use lab_eval::rivals::{Rival, learned};
use lab_eval::sheet::{Cell, Form, Sheet};
use lab_eval::stats::{Bootstrap, Value};
use lab_eval::{Case, Site, Subset};
use scene::{AgentFutures, Future};

/// Errors of one road user under all methods, in the order of [`Method::ALL`]; `None` without an answer.
struct AgentErrors {
    centre: Centre,
    scene: usize,
    errors: [Option<Measured>; Method::ALL.len()],
}

/// The paper's Table I beside its own figures, and the number of road users.
///
/// # Errors
/// When a network fails, the data have changed, or the run is stopped.
pub fn table(
    data: &Data,
    options: &SetOptions,
    sets: &Sets,
    entrants: &Entrants,
    seed: u64,
    stop: &Stop,
    progress: &dyn Fn(&str),
) -> Result<Sheet> {
    let scenes = scene_index(&sets.tests);
    let told = |done: usize| progress(&format!("Table I: {done} of {} squares", sets.tests.len()));
    let judged: Vec<AgentErrors> = each_case(data, options, &sets.tests, stop, &told, |_, case, cut| {
        judge(case, &cut, scenes[&case.place()], options, entrants, seed)
    })?
    .into_iter()
    .flatten()
    .collect();
    let boot = Bootstrap::new(scenes.len(), seed);
    let mut sheet = Sheet::new(
        "Table I: scene generation quality",
        &[
            "One road user at a time, of the others the first frame alone; the condition is position, speed and heading \
             at the interval's end. All four figures are of the future (of six) that ends nearest to the recording, \
             taken at the point before the last, as the paper has it. Metres; radians while the log moves; m/s. In \
             brackets 95 % intervals, resampled by scene. The paper's figures stand beside; it gives no units for \
             heading and speed.",
            "Plain TrafficGen learned from vehicles and is asked of all types. Futures that all meet the condition end \
             equally near, so the paper's rule takes any of them; the last column has the least mean distance of the six \
             instead.",
        ],
        &["Dataset", "Model"],
        &[
            "Min ADE6",
            "paper",
            "Min FDE6",
            "paper",
            "Heading Error",
            "paper",
            "Speed Error",
            "paper",
            "least ADE of the six",
        ],
    );
    for centre in Centre::ALL {
        for (place, method) in Method::ALL.into_iter().enumerate() {
            let mine = || {
                let own = judged.iter().filter(move |j| j.centre == centre);
                own.filter_map(move |j| Some((j.scene, j.errors[place]?)))
            };
            let of = |value: fn(&Measured) -> Option<f64>, form| {
                let values = mine().filter_map(|(scene, m)| Some(Value::new(scene, value(&m)?)));
                Cell::of(boot.estimate(values), form)
            };
            let theirs = paper::quality(centre, method);
            let beside =
                |i: usize| theirs.map_or(Cell::Nothing, |t| Cell::Number { value: t[i], form: Form::Plain });
            let cells = vec![
                of(|m| Some(m.closest_ade), Form::Plain),
                beside(0),
                of(|m| Some(m.min_fde), Form::Plain),
                beside(1),
                of(|m| m.heading_rad, Form::Fine),
                beside(2),
                of(|m| Some(m.speed_mps), Form::Plain),
                beside(3),
                of(|m| Some(m.min_ade), Form::Plain),
            ];
            let mut name = centre.expert().to_owned();
            name[..1].make_ascii_uppercase();
            sheet.push([name.as_str(), method.name()], cells);
        }
    }
    Ok(sheet)
}

/// Evaluates all road users of one square.
fn judge(
    case: &TestCase,
    cut: &Cut,
    scene: usize,
    options: &SetOptions,
    entrants: &Entrants,
    seed: u64,
) -> Result<Vec<AgentErrors>> {
    let interval = cut.interval(options.interval_steps);
    let site = Site::new(scene, &interval);
    let mut out = Vec::new();
    for &agent in &cut.judged {
        // The cut kept every agent: all road users of the square are present at its first frame.
        let Some(start) = interval.agents.get(agent).and_then(|a| a.state_at(0)) else { continue };
        let agent_type = case.centre.judged();
        let own = Case { agent, agent_type, goal_step: options.interval_steps, start };
        let mut errors = [None; Method::ALL.len()];
        for (slot, method) in errors.iter_mut().zip(Method::ALL) {
            let Some(futures) = answer(entrants, method, case.centre, &site, &own, seed)? else { continue };
            // All methods are measured on the same condition, whatever part of it they saw.
            let subset = Subset::PosSpeedHeading;
            *slot = Some(measure(site.log(&own), &own, subset, &futures.modes, futures.chosen));
        }
        out.push(AgentErrors { centre: case.centre, scene, errors });
    }
    Ok(out)
}

fn answer(
    entrants: &Entrants,
    method: Method,
    centre: Centre,
    site: &Site<'_>,
    case: &Case,
    seed: u64,
) -> Result<Option<AgentFutures>> {
    let asked = Subset::PosSpeedHeading;
    let first = |modes: Vec<Future>| (!modes.is_empty()).then(|| AgentFutures::of(0, modes));
    Ok(match entrants.of(method, centre) {
        None => None,
        Some(Answerer::Learned(baseline, shown)) => {
            first(learned(baseline, site, case, if shown { asked } else { Subset::None })?)
        }
        Some(Answerer::Ours(generator)) => {
            alone(generator, site, case, asked, true, seed)?.map(|(futures, _)| futures)
        }
        Some(Answerer::Spline) => first(Rival::Spline.futures(site, case, asked, seed)),
    })
}
