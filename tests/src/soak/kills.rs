//! Kills at any moment during the work of six writers: answered writes are stored, and every other write is
//! stored wholly or not at all.

use super::Tell;
use crate::program::Server;
use crate::random::Random;
use crate::writers::{self, Tally, Writer};
use anyhow::Context;
use std::path::Path;
use std::process::Stdio;
use std::time::Duration;

/// Writers at work.
const WRITERS: u64 = 6;
/// A kill comes within this time after the start, milliseconds.
const WITHIN_MS: u64 = 300;

/// Kills so often, each time at a moment of its own, and compares after each.
///
/// # Errors
/// When something that was answered is lost, or the file is damaged.
pub fn kills(count: u64, seed: u64, tell: Tell<'_>) -> anyhow::Result<Tally> {
    let folder = tempfile::tempdir()?;
    let db = folder.path().join("scenes.sqlite");
    let mut crowd = Writer::crowd(WRITERS, seed);
    let mut random = Random::new(seed);
    for round in 0..count {
        one(&db, &mut crowd, &mut random).with_context(|| format!("kill {round} of seed {seed}"))?;
        if round % 50 == 49 {
            tell(&format!("{} kills, {:?}", round + 1, writers::tally(&crowd)));
        }
    }
    reopened(&db, &mut crowd)?;
    Ok(writers::tally(&crowd))
}

fn one(db: &Path, crowd: &mut [Writer], random: &mut Random) -> anyhow::Result<()> {
    if random.below(8) == 0 {
        killed_at_the_start(db, Duration::from_millis(random.below(80)))?;
    }
    let server = reopened(db, crowd)?;
    let (address, after) = (server.address, Duration::from_millis(random.below(WITHIN_MS)));
    writers::work_until(crowd, address, after, writers::none, || server.kill())
}

/// Starts on what a kill has left, and compares.
fn reopened(db: &Path, crowd: &mut [Writer]) -> anyhow::Result<Server> {
    let server = Server::start_at(db, &[])?;
    writers::compare(crowd, &server)?;
    crowd.iter_mut().for_each(Writer::settle);
    writers::sound(db)?;
    Ok(server)
}

/// Kills while what the last kill left is put in order.
fn killed_at_the_start(db: &Path, after: Duration) -> anyhow::Result<()> {
    let mut child = Server::command(db, &[]).stdin(Stdio::null()).stdout(Stdio::null()).spawn()?;
    std::thread::sleep(after);
    child.kill()?;
    child.wait()?;
    Ok(())
}
