//! The work of a run: units in parallel; each chunk is written when it is complete.

use super::folder::BatchFolder;
use super::tally::OutcomeTally;
use super::worker::{CaseLines, UnitLines, UnitWorker};
use crate::cli::progress::Progress;
use crate::cli::{Failure, parallel};
use batch::chunk::BatchChunk;
use batch::figures;
use batch::row;
use batch::unit::BatchUnit;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, Ordering};

/// A chunk of a run.
pub struct OpenChunk {
    /// Its units.
    pub chunk: BatchChunk,
    /// Name of its files.
    pub name: String,
    /// Whether it existed when the run began.
    pub is_there: bool,
    /// Whether another process has made it since.
    taken: OnceLock<bool>,
}

impl OpenChunk {
    /// A chunk with its name, and whether it exists.
    pub fn new(chunk: BatchChunk, name: String, is_there: bool) -> Self {
        Self { chunk, name, is_there, taken: OnceLock::new() }
    }
}

/// Makes chunks, and counts the outcomes of their units.
pub struct ChunkWork<'a> {
    folder: &'a BatchFolder,
    worker: &'a UnitWorker<'a>,
    workers: usize,
    progress: Progress,
    tally: OutcomeTally,
}

impl<'a> ChunkWork<'a> {
    /// A worker with this number of threads.
    pub fn new(
        folder: &'a BatchFolder,
        worker: &'a UnitWorker<'a>,
        workers: usize,
        progress: Progress,
    ) -> Self {
        Self { folder, worker, workers, progress, tally: OutcomeTally::default() }
    }

    /// The outcomes of the units that were made.
    pub fn tally(self) -> OutcomeTally {
        self.tally
    }

    /// Makes these chunks, with all units in parallel. `unit` returns the unit with a number.
    ///
    /// # Errors
    /// Exit 1 when a chunk exists with other bytes, or cannot be written; 3 when the folder lacks a scene.
    pub fn make(
        &mut self,
        chunks: &[OpenChunk],
        unit: &(dyn Fn(u64) -> Option<BatchUnit> + Sync),
    ) -> Result<(), Failure> {
        let Self { folder, worker, workers, progress, tally } = self;
        let units: Vec<(&OpenChunk, u64)> = chunks
            .iter()
            .flat_map(|open| open.chunk.units.clone().map(move |number| (open, number)))
            .collect();
        let stopped = AtomicBool::new(false);
        let missing = |number: &u64| Failure::input(format!("{}: no unit {number}", folder.shown()));
        let end = |(open, number): &(&OpenChunk, u64)| {
            if stopped.load(Ordering::Relaxed)
                || *open.taken.get_or_init(|| folder.has_chunk(&open.name).unwrap_or(false))
            {
                return None;
            }
            Some(unit(*number).ok_or_else(|| missing(number)).and_then(|unit| worker.end(&unit)))
        };
        let (mut rows, mut cases, mut motions, mut failure) =
            (Vec::new(), String::new(), String::new(), None);
        parallel::in_order(&units, *workers, end, |(open, number), end| {
            progress.step();
            if failure.is_some() {
                return;
            }
            let put = match end {
                None => Ok(()),
                Some(Err(error)) => Err(error),
                Some(Ok(UnitLines { row, lines })) => {
                    tally.add(&row);
                    rows.push(row);
                    if let Some(CaseLines { case, motion }) = lines {
                        cases.push_str(&case);
                        motions.push_str(&motion);
                    }
                    if number + 1 == open.chunk.units.end {
                        let table = row::table(&std::mem::take(&mut rows), figures::names());
                        let (cases, motions) = (std::mem::take(&mut cases), std::mem::take(&mut motions));
                        table.map_err(Failure::from).and_then(|table| {
                            folder.put(&open.name, &table, cases.as_bytes(), motions.as_bytes())
                        })
                    } else {
                        Ok(())
                    }
                }
            };
            if let Err(error) = put {
                stopped.store(true, Ordering::Relaxed);
                failure = Some(error);
            }
        });
        failure.map_or(Ok(()), Err)
    }
}
