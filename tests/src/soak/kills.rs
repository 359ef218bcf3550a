//! Kills at any moment while six writers work, every other one while the disk fails. Acknowledged writes are
//! stored, and every other write is stored completely or not at all.

use super::Tell;
use crate::faults::{Disk, Fault};
use crate::program::Server;
use crate::random::Random;
use crate::writers::{self, Tally, Writer};
use anyhow::Context;
use std::path::{Path, PathBuf};
use std::process::Stdio;
use std::time::Duration;

/// Number of writers.
const WRITERS: u64 = 6;
/// A kill comes within this time after the start, milliseconds.
const WITHIN_MS: u64 = 300;

/// Counts of a trial.
#[derive(Clone, Copy, Debug, Default)]
pub struct KillReport {
    /// Kills.
    pub kills: u64,
    /// Kills after a failed call to the disk.
    pub on_a_failing_disk: u64,
    /// Counts of the writers.
    pub writes: Tally,
}

struct Trial {
    db: PathBuf,
    disk: Disk,
    crowd: Vec<Writer>,
    random: Random,
    report: KillReport,
}

/// Kills the server this many times, each at a random moment, and compares the store after each.
///
/// # Errors
/// When an acknowledged write is lost, or the file is damaged.
pub fn kills(count: u64, seed: u64, tell: Tell<'_>) -> anyhow::Result<KillReport> {
    let folder = tempfile::tempdir()?;
    let (db, disk) = (folder.path().join("scenes.sqlite"), Disk::of(folder.path())?);
    let (crowd, random) = (Writer::crowd(WRITERS, seed), Random::new(seed));
    let mut trial = Trial { db, disk, crowd, random, report: KillReport::default() };
    for round in 0..count {
        let killed = trial.kill(round % 2 == 1);
        killed.with_context(|| format!("kill {round} of seed {seed}\n{}", trial.disk.last_words()))?;
        if round % 50 == 49 {
            tell(&format!("{:?}", trial.now()));
        }
    }
    trial.reopened()?;
    Ok(trial.now())
}

impl Trial {
    fn now(&self) -> KillReport {
        KillReport { writes: writers::tally(&self.crowd), ..self.report }
    }

    fn kill(&mut self, is_faulty: bool) -> anyhow::Result<()> {
        if self.random.below(8) == 0 {
            killed_at_the_start(&self.db, Duration::from_millis(self.random.below(80)))?;
        }
        let server = self.reopened()?;
        let (address, after) = (server.address, Duration::from_millis(self.random.below(WITHIN_MS)));
        let before = self.disk.failed()?;
        if is_faulty {
            self.disk.fails(Fault::drawn(&mut self.random))?;
        }
        let allowed = if is_faulty { writers::of_the_disk } else { writers::none };
        writers::work_until(&mut self.crowd, address, after, allowed, || server.kill())?;
        self.disk.well()?;
        self.report.kills += 1;
        self.report.on_a_failing_disk += u64::from(self.disk.failed()? > before);
        Ok(())
    }

    /// Starts a server on the files that a kill has left, and compares.
    fn reopened(&mut self) -> anyhow::Result<Server> {
        let mut command = Server::command(&self.db, &[]);
        command.stderr(self.disk.log()?);
        self.disk.put_under(&mut command)?;
        let server = Server::launch(command)?;
        writers::compare(&mut self.crowd, &server)?;
        self.crowd.iter_mut().for_each(Writer::settle);
        writers::sound(&self.db)?;
        Ok(server)
    }
}

/// Kills a server while it recovers from the last kill.
fn killed_at_the_start(db: &Path, after: Duration) -> anyhow::Result<()> {
    let mut child = Server::command(db, &[]).stdin(Stdio::null()).stdout(Stdio::null()).spawn()?;
    std::thread::sleep(after);
    child.kill()?;
    child.wait()?;
    Ok(())
}
