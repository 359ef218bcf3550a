//! Generations over HTTP: queued in the pool, with events and a reply made from them.

pub mod events;
mod feed;
mod outbox;
pub mod run;
pub mod search;
pub mod stream;

pub use feed::EventReader;

use api::generate::GenerationPlan;
use api::{Operations, Problem};
use base::limits::Limits;
use batch::search::one_scene::SceneSearch;
use feed::Feed;
use std::sync::Arc;
use std::time::Duration;
use work::{Caller, JobKind, JobRequest, Pool, PoolLane, Work};

/// Approximate duration of a try of a search.
const TRY_COST: Duration = Duration::from_millis(60);
/// Share of a call's time limit after which a search makes no new try.
const SHARE_OF_TIME: f64 = 0.8;

/// The operations by lane of the pool.
#[derive(Clone, Copy)]
pub struct LaneOperations<'a> {
    /// For small interactive calls.
    pub quick: &'a Operations,
    /// For all other calls.
    pub patient: &'a Operations,
}

/// Queues a generation.
///
/// # Errors
/// `shutting-down`, `exists`, `stale-revision` or `busy`.
pub fn submit(
    pool: &Arc<Pool>,
    lanes: LaneOperations<'_>,
    limits: &Limits,
    caller: Caller,
    plan: GenerationPlan,
) -> Result<EventReader, Problem> {
    let asked = JobRequest { kind: JobKind::Generate, cost: plan.cost(), caller };
    let operations = if asked.lane() == PoolLane::Quick { lanes.quick } else { lanes.patient }.clone();
    queue(pool, limits, "/v1/generate", asked, move |feed, others| {
        run::generate(feed, &operations, plan, others);
    })
}

/// Queues a search, with the expected time to prepare its map.
///
/// # Errors
/// `shutting-down`, `exists` or `busy`.
pub fn submit_search(
    pool: &Arc<Pool>,
    operations: Operations,
    limits: &Limits,
    caller: Caller,
    (search, preparation): (SceneSearch, Duration),
) -> Result<EventReader, Problem> {
    let cost = preparation + TRY_COST * u32::try_from(search.tries()).unwrap_or(u32::MAX);
    let asked = JobRequest { kind: JobKind::Search, cost, caller };
    let time = Duration::from_secs(limits.generate_s).mul_f64(SHARE_OF_TIME);
    queue(pool, limits, "/v1/search", asked, move |feed, others| {
        search::search(feed, &operations, &search, time, others);
    })
}

/// Queues work that sends events. Between two events it calls its second argument, which lets smaller calls
/// go first.
fn queue(
    pool: &Arc<Pool>,
    limits: &Limits,
    path: &'static str,
    asked: JobRequest,
    work: impl FnOnce(&Feed, &dyn Fn()) + Send + 'static,
) -> Result<EventReader, Problem> {
    let most = limits.buffered_events as usize;
    let (feed, handle) = pool.submit(asked, |ticket| {
        let feed = Arc::new(Feed::new(Arc::clone(ticket), most, path));
        let (fed, pool) = (Arc::clone(&feed), Arc::clone(pool));
        let work: Work = Box::new(move || work(&fed, &|| pool.let_others_go(&fed.ticket)));
        (feed, work)
    })?;
    Ok(EventReader::new(feed, handle))
}
