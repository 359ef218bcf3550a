//! Searches: each chunk of a group follows from the rows of the previous ones, which are read from the
//! folder.

use super::folder::BatchFolder;
use super::work::{ChunkWork, OpenChunk};
use crate::cli::Failure;
use batch::chunk::BatchChunk;
use batch::search::GroupSearch;
use batch::unit::UnitList;

/// Makes chunks of searches, those of one group one after the other.
///
/// # Errors
/// Exit 1 when a chunk exists with other bytes, 3 for one that cannot be read.
pub fn work(
    work: &mut ChunkWork<'_>,
    folder: &BatchFolder,
    list: &UnitList<'_>,
    chunks: &[OpenChunk],
) -> Result<(), Failure> {
    for group in chunks.chunk_by(|a, b| a.chunk.share == b.chunk.share) {
        let due = group.iter().rposition(|open| !open.is_there).map_or(0, |last| last + 1);
        let searches = group.first().and_then(|open| GroupSearch::new(list, open.chunk.share));
        let Some(mut searches) = searches.filter(|_| due > 0) else { continue };
        for open in group.iter().take(due) {
            if !open.is_there {
                work.make(std::slice::from_ref(open), &|number| searches.unit(number))?;
            }
            searches.learn(&folder.rows(&open.name)?);
        }
    }
    Ok(())
}

/// The state of the searches of a chunk's group before the chunk; `None` for a plan without searches.
///
/// # Errors
/// Exit 3 for an earlier chunk that cannot be read.
pub fn before<'a>(
    folder: &BatchFolder,
    list: &'a UnitList<'a>,
    chunk: &BatchChunk,
) -> Result<Option<GroupSearch<'a>>, Failure> {
    let Some(mut searches) = GroupSearch::new(list, chunk.share) else { return Ok(None) };
    let earlier = list.chunks().filter(|of| of.share == chunk.share && of.number < chunk.number);
    for earlier in earlier {
        searches.learn(&folder.rows(&earlier.name(list))?);
    }
    Ok(Some(searches))
}
