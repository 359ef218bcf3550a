//! Generations: a task for the pool, its events, and the reply made of them.

pub mod compact;
pub mod events;
mod feed;
pub mod kept;
mod outbox;
mod run;
pub mod scoring;
pub mod stream;

pub use feed::Reader;

use crate::base::limits::Limits;
use crate::base::problem::Problem;
use crate::scenes::Standings;
use crate::work::{Caller, Kind, Pool, Work};
use compact::FuturesForm;
use events::GeneratedHead;
use experts::{Generator, Request};
use feed::Feed;
use std::sync::Arc;

/// What a generation is to do.
pub struct Task {
    /// For the generator.
    pub request: Request,
    /// The caller reads all events, not the last one alone.
    pub streams: bool,
    /// All alternatives in drafts, not the chosen ones alone.
    pub all_modes: bool,
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

/// Queues a generation.
///
/// # Errors
/// `shutting-down`, `exists`, `stale-revision` or `busy`.
pub fn submit(
    pool: &Arc<Pool>,
    generator: &Arc<Generator>,
    limits: &Limits,
    caller: Caller,
    task: Task,
) -> Result<Reader, Problem> {
    let generator = Arc::clone(generator);
    let most = limits.buffered_events as usize;
    let (feed, handle) = pool.submit(Kind::Generate, caller, |ticket| {
        let feed = Arc::new(Feed::new(Arc::clone(ticket), most));
        let fed = Arc::clone(&feed);
        let work: Work = Box::new(move || run::generate(&fed, &generator, task));
        (feed, work)
    })?;
    Ok(Reader::new(feed, handle))
}
