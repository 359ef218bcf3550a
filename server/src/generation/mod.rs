//! Generations: a task for the pool, its events, and the reply made of them.

pub mod compact;
pub mod events;
mod feed;
pub mod kept;
mod outbox;
pub mod run;
pub mod scoring;
pub mod stream;

pub use feed::Reader;

use crate::base::limits::Limits;
use crate::base::problem::Problem;
use crate::scenes::Standings;
use crate::work::{Asked, Caller, Kind, Lane, Pool, Work};
use compact::FuturesForm;
use events::GeneratedHead;
use experts::{Generator, React, Request};
use feed::Feed;
use scene::ContentHash;
use std::collections::BTreeSet;
use std::sync::Arc;
use std::time::Duration;

/// What a generation is to do.
pub struct Task {
    /// For the generator.
    pub request: Request,
    /// The caller reads all events, not the last one alone.
    pub streams: bool,
    /// All alternatives in drafts, not the chosen ones alone.
    pub all_modes: bool,
    /// Drafts that stand sooner than this after the work began are left out, until one is sent.
    pub draft_delay: Duration,
    /// Steps that follow the draft sent before sooner than this are left out.
    pub draft_interval: Duration,
    /// How futures are written.
    pub form: FuturesForm,
    /// Score each sample.
    pub score: bool,
    /// What the scene comes to without this call's changes, where it is one that stays open.
    pub standings: Option<Arc<Standings>>,
    /// Samples hold the futures of those who are not part of the call too.
    pub with_kept: bool,
    /// The rest of `generated`.
    pub head: GeneratedHead,
}

impl Task {
    /// Names what the answer follows from, in six characters: the scene with its conditions, what is kept of its
    /// futures, the options, the seed, and the engine.
    pub fn code(&self) -> String {
        let Self { request, head, .. } = self;
        let generated = request.scene.generated.as_ref();
        let sample = generated.and_then(|generated| generated.samples.get(generated.chosen_sample));
        let asked = |id: &String| request.agents.as_ref().is_none_or(|asked| asked.contains(id));
        let stays = |id: &String| !asked(id) || request.pinned.contains_key(id);
        let futures = sample.into_iter().flat_map(|sample| &sample.agents).filter(|(id, _)| stays(id));
        let kept: Vec<_> =
            futures.map(|(id, f)| (id, f.modes.get(f.chosen).map(|m| (m.first_step, &m.states)))).collect();
        let shown: Vec<_> =
            request.shown.iter().map(|(id, shown)| (id, shown.anchor, &shown.places)).collect();
        let version = env!("CARGO_PKG_VERSION");
        let of = (version, &head.input_sha256, &head.weights, head.seed, &head.request, kept, shown);
        ContentHash::of(&of).short()
    }

    /// About how long it takes one thread. Measured on two cores of 2.6 GHz, scores included: 4 ms for each road
    /// user, window and sample, and a tenth of one for each denoising step.
    fn cost(&self) -> Duration {
        let Request { agents, samples, steps, horizon_steps, replan_steps, .. } = &self.request;
        let windows = horizon_steps.div_ceil(replan_steps.unwrap_or(scene::HORIZON_STEPS).max(1));
        let concerned = concerned(&self.request);
        let asked = agents.as_ref().map_or(concerned, BTreeSet::len);
        let each_ms = 4.0 + 0.1 * *steps as f64;
        let others_ms = 0.3 * concerned.saturating_sub(asked) as f64;
        Duration::from_secs_f64(1e-3 * (windows * samples) as f64 * (each_ms * asked as f64 + others_ms))
    }
}

/// How many road users are regenerated or may react.
pub fn concerned(request: &Request) -> usize {
    match (&request.agents, &request.react) {
        (None, _) | (_, React::Everyone) => request.scene.agents.len() - request.scene.counts()[3],
        (Some(agents), React::Only(ids)) => agents.union(ids).count(),
        (Some(agents), React::Nobody) => agents.len(),
    }
}

/// The experts by the lane of a call.
#[derive(Clone, Copy)]
pub struct Experts<'a> {
    /// For small calls that people wait for.
    pub quick: &'a Arc<Generator>,
    /// For the others.
    pub patient: &'a Arc<Generator>,
}

/// Queues a generation.
///
/// # Errors
/// `shutting-down`, `exists`, `stale-revision` or `busy`.
pub fn submit(
    pool: &Arc<Pool>,
    experts: Experts<'_>,
    limits: &Limits,
    caller: Caller,
    task: Task,
) -> Result<Reader, Problem> {
    let asked = Asked { kind: Kind::Generate, cost: task.cost(), caller };
    let generator = Arc::clone(if asked.lane() == Lane::Quick { experts.quick } else { experts.patient });
    let most = limits.buffered_events as usize;
    let (feed, handle) = pool.submit(asked, |ticket| {
        let feed = Arc::new(Feed::new(Arc::clone(ticket), most));
        let (fed, pool) = (Arc::clone(&feed), Arc::clone(pool));
        let work: Work = Box::new(move || {
            run::generate(&fed, &generator, task, || pool.let_smaller_go(&fed.ticket));
        });
        (feed, work)
    })?;
    Ok(Reader::new(feed, handle))
}
