//! Generations over HTTP: a plan for the pool, its events, and the reply made of them.

pub mod events;
mod feed;
mod outbox;
pub mod run;
pub mod stream;

pub use feed::EventReader;

use crate::base::limits::Limits;
use crate::work::{Caller, JobKind, JobRequest, Pool, PoolLane, Work};
use api::generate::GenerationPlan;
use api::{Operations, Problem};
use feed::Feed;
use std::sync::Arc;

/// The operations by the lane of a call.
#[derive(Clone, Copy)]
pub struct LaneOperations<'a> {
    /// For small calls that people wait for.
    pub quick: &'a Operations,
    /// For the others.
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
    let most = limits.buffered_events as usize;
    let (feed, handle) = pool.submit(asked, |ticket| {
        let feed = Arc::new(Feed::new(Arc::clone(ticket), most));
        let (fed, pool) = (Arc::clone(&feed), Arc::clone(pool));
        let work: Work = Box::new(move || {
            run::generate(&fed, &operations, plan, || pool.let_smaller_go(&fed.ticket));
        });
        (feed, work)
    })?;
    Ok(EventReader::new(feed, handle))
}
