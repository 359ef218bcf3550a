//! Table 4: whether the distribution of generated traffic resembles that of recorded traffic. The method
//! follows the Waymo Open Sim Agents Challenge (Montali et al. 2023): the log's likelihood under histograms
//! of many rollouts, feature by feature.

mod edges;
mod features;
mod likelihood;

use super::rivals::{Together, constant_velocity, varied};
use super::sheet::{Cell, Form, Sheet};
use super::stats::{Bootstrap, Value};
use super::table::TableSpec;
use super::together::{
    Ask, Motions, generated, joint_goal, motions_by, motions_of, motions_of_log, rests, scenes,
};
use super::{Entrants, Judged, Site};
use anyhow::Result;
use edges::RoadEdges;
use features::{FEATURES, Motion, observe};
use lab_train::baselines::Baseline;
use lab_train::quantile;
use likelihood::{Likelihoods, likelihoods};
use rayon::prelude::*;
use scene::{Goal, HORIZON_STEPS};

/// Rollouts of each scene.
const ROLLOUTS: usize = 32;

/// Source of rollouts.
#[derive(Clone, Copy)]
enum Roller<'a> {
    Log,
    ConstantVelocity,
    /// Random variations of the prior, with or without goals.
    PriorNoise(bool),
    Learned(&'a Baseline, bool),
    Ours(&'a Judged, bool),
}

impl Roller<'_> {
    fn name(&self) -> String {
        let goals = |on: bool| if on { ", goals" } else { "" };
        match self {
            Self::Log => "log oracle".into(),
            Self::ConstantVelocity => "constant velocity".into(),
            Self::PriorNoise(on) => format!("prior + noise{}", goals(*on)),
            Self::Learned(baseline, on) => format!("{}{}", baseline.name, goals(*on)),
            Self::Ours(own, on) => format!("{}{}", own.name, goals(*on)),
        }
    }

    fn rollouts(&self, site: &Site<'_>, seed: u64) -> Result<Vec<Motions>> {
        Ok(match self {
            Self::Log => vec![motions_of_log(site)],
            Self::ConstantVelocity => {
                vec![motions_by(site, false, |_, start, _, _| constant_velocity(start))]
            }
            Self::PriorNoise(goals) => noisy(site, *goals, seed),
            Self::Learned(baseline, goals) => {
                let together = Together::new(baseline, site, *goals)?;
                (0..ROLLOUTS).map(|rollout| together.drawn(seed, rollout)).collect()
            }
            Self::Ours(own, goals) => {
                let ask = Ask { samples: ROLLOUTS, ..Ask::shipped(*goals, seed) };
                scenes(&own.generator, site, ask)?.iter().map(|s| motions_of(site, s)).collect()
            }
        })
    }
}

/// Variations of the prior, independent for each road user; the first rollout is a variation too.
fn noisy(site: &Site<'_>, goals: bool, seed: u64) -> Vec<Motions> {
    let mut out: Vec<Motions> = vec![vec![None; site.scene.agents.len()]; ROLLOUTS];
    for i in generated(site) {
        let agent = &site.blind.agents[i];
        let Some(start) = agent.state_at(0) else { continue };
        let goal = if goals { joint_goal(site, i) } else { Goal::default() };
        let step = goal.step_in_window(0.0);
        let all = if rests(&start, &goal) {
            vec![vec![start; HORIZON_STEPS]; ROLLOUTS]
        } else {
            varied(agent, &start, &goal, step, (seed, site.name()), ROLLOUTS).split_off(1)
        };
        for (motions, states) in out.iter_mut().zip(all) {
            motions[i] = Some(states);
        }
    }
    out
}

/// Measures of one source of rollouts in one scene.
struct RolloutMeasures {
    site: usize,
    likelihoods: Likelihoods,
    /// Vehicles' accelerations, lateral accelerations and jerks.
    motions: [Vec<f64>; 3],
}

fn look(roller: &Roller<'_>, site: &Site<'_>, seed: u64) -> Result<RolloutMeasures> {
    let edges = RoadEdges::new(&site.scene.map);
    let cases: Vec<usize> = site.cases.iter().map(|c| c.agent).collect();
    let log = observe(site, &edges, &motions_of_log(site), &cases);
    let rollouts = roller.rollouts(site, seed)?;
    let seen: Vec<Vec<Motion>> = rollouts.iter().map(|m| observe(site, &edges, m, &cases)).collect();
    let mut motions: [Vec<f64>; 3] = Default::default();
    // A few rollouts suffice to compare distributions.
    for (case, motion) in seen.iter().take(4).flat_map(|rollout| site.cases.iter().zip(rollout)) {
        if case.agent_type == scene::AgentType::Vehicle {
            for (all, values) in motions.iter_mut().zip(motion.felt()) {
                all.extend(values);
            }
        }
    }
    Ok(RolloutMeasures { site: site.index, likelihoods: likelihoods(&log, &seen), motions })
}

/// Likeness of rollouts of a scene to the log: the composite likelihood, and the near collisions. The latter
/// are summed over rollouts: moving road users within `soon_s` of a collision, and the number of all.
pub(super) fn closeness(site: &Site<'_>, rollouts: &[Motions], soon_s: f64) -> (Option<f64>, (f64, f64)) {
    let edges = RoadEdges::new(&site.scene.map);
    let cases: Vec<usize> = site.cases.iter().map(|c| c.agent).collect();
    let log = observe(site, &edges, &motions_of_log(site), &cases);
    let seen: Vec<Vec<Motion>> = rollouts.iter().map(|m| observe(site, &edges, m, &cases)).collect();
    let soon = |motion: &Motion| motion.time_to_collision_s().is_some_and(|s| s < soon_s);
    let all = seen.iter().flatten();
    let (near, count) = all.fold((0.0, 0.0), |(near, n), m| (near + f64::from(u8::from(soon(m))), n + 1.0));
    (likelihoods(&log, &seen).composite(), (near, count))
}

/// Table 4.
pub(super) const TABLE: TableSpec = TableSpec {
    number: 4,
    name: "realism",
    make: |trial| Ok(realism(trial.entrants(), &trial.sites, &trial.boot, trial.seed)?.into()),
};

/// Both sheets.
///
/// # Errors
/// When a generator fails.
fn realism(entrants: Entrants<'_>, sites: &[Site<'_>], boot: &Bootstrap, seed: u64) -> Result<Vec<Sheet>> {
    let names: Vec<&str> = FEATURES.iter().map(|f| f.name).collect();
    let columns: Vec<&str> = ["composite"].into_iter().chain(names).collect();
    let mut sheet = Sheet::new(
        "4a Realism: likelihood of the log under many rollouts",
        &["After the Waymo Open Sim Agents Challenge, with its published histograms and 2024 weights, 32 \
             rollouts (log and constant velocity have one); mean over scenes. Other than published: 9 s from \
             one frame without history; moving road users alone are looked at; kinematics every step, the rest \
             every third; time to collision from boxes that keep their velocities; distance to the road edge in \
             the plane; no traffic lights. Figures are not comparable with the leader board. The log oracle is \
             the most that can be had with one rollout."],
        &["who"],
        &columns,
    );
    let mut felt = Sheet::new(
        "4b What vehicles feel",
        &[
            "Quantiles over steps of moving vehicles above 0.5 m/s, central differences over 0.2 s: acceleration \
           along, m/s2; lateral acceleration, absolute, m/s2; jerk, absolute, m/s3. Positions of \
           the log shake by centimetres, which its jerk shows.",
        ],
        &["who", "what"],
        &["1 %", "5 %", "50 %", "95 %", "99 %"],
    );
    let sites: Vec<&Site<'_>> = sites.iter().filter(|s| !s.cases.is_empty()).collect();
    let mut rollers =
        vec![Roller::Log, Roller::ConstantVelocity, Roller::PriorNoise(false), Roller::PriorNoise(true)];
    for baseline in entrants.baselines {
        rollers.push(Roller::Learned(baseline, false));
        rollers.extend(baseline.has_condition().then_some(Roller::Learned(baseline, true)));
    }
    rollers
        .extend(entrants.judged.iter().flat_map(|own| [Roller::Ours(own, false), Roller::Ours(own, true)]));
    for roller in rollers {
        let seen: Result<Vec<RolloutMeasures>> =
            sites.par_iter().map(|site| look(&roller, site, seed)).collect();
        let seen = seen?;
        let figure = |value: &dyn Fn(&Likelihoods) -> Option<f64>| {
            let values = seen.iter().filter_map(|s| Some(Value::new(s.site, value(&s.likelihoods)?)));
            Cell::of(boot.estimate(values), Form::Fine)
        };
        let mut cells = vec![figure(&Likelihoods::composite)];
        cells.extend((0..FEATURES.len()).map(|i| figure(&|l| l.by_feature[i])));
        sheet.push([roller.name()], cells);
        for (i, what) in ["acceleration", "lateral", "jerk"].into_iter().enumerate() {
            let mut all: Vec<f64> = seen.iter().flat_map(|s| s.motions[i].iter().copied()).collect();
            all.sort_by(f64::total_cmp);
            let at = |share: f64| Cell::Number { value: quantile(&all, share), form: Form::Plain };
            let cells = [0.01, 0.05, 0.5, 0.95, 0.99].map(at);
            felt.push([roller.name(), what.into()], cells.into());
        }
    }
    Ok(vec![sheet, felt])
}
