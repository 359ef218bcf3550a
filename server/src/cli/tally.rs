//! Outcome of work on many files: each failure is printed when it happens, and the exit code follows from all
//! of them.

use super::inputs::{Item, Reading, Source};
use super::progress::Progress;
use super::{Exit, Failure, parallel};

/// Outcomes of the items so far.
#[derive(Default)]
pub struct Tally {
    done: usize,
    first: Option<Failure>,
    failed: usize,
}

impl Tally {
    /// Adds the outcome of one item. A failure is printed at once, unless it is the only item: then it ends
    /// the command.
    pub fn add(&mut self, result: Result<(), Failure>, only: bool, progress: &Progress) {
        match result {
            Ok(()) => self.done += 1,
            Err(failure) => {
                if !only {
                    progress.error(&failure.message);
                }
                self.failed += 1;
                self.first.get_or_insert(failure);
            }
        }
    }

    /// The result of the command; `what` names the items, such as "files".
    ///
    /// # Errors
    /// Exit 4 when some failed; when all did, the code of the first.
    pub fn end(self, what: &str) -> Result<(), Failure> {
        let all = self.done + self.failed;
        match self.first {
            None => Ok(()),
            Some(only) if all == 1 => Err(only),
            Some(first) if self.done == 0 => {
                Err(Failure::new(first.exit, format!("none of {all} {what} could be worked on")))
            }
            Some(_) => Err(Failure::new(Exit::Partly, format!("{} of {all} {what} failed", self.failed))),
        }
    }
}

/// Maps `of_scene` over the scenes of files, in the order of the files, with the outcome of each file.
/// `of_scene` gets the file, the index of the scene in it, and the scene.
pub fn survey<T: Send>(
    sources: &[Source],
    workers: usize,
    quiet: bool,
    of_scene: impl Fn(&Source, u64, Item) -> Result<T, Failure> + Sync,
) -> (Vec<T>, Tally) {
    let progress = Progress::new("files", sources.len() as u64, quiet);
    let of_file = |source: &Source| {
        let mut found = Vec::new();
        source.each(&Reading::default(), &mut |item| {
            found.push(of_scene(source, found.len() as u64, item)?);
            Ok(())
        })?;
        Ok(found)
    };
    let (mut tally, mut all) = (Tally::default(), Vec::new());
    parallel::in_order(sources, workers, of_file, |_, found: Result<Vec<T>, Failure>| {
        tally.add(found.map(|found| all.extend(found)), sources.len() == 1, &progress);
        progress.step();
    });
    (all, tally)
}
