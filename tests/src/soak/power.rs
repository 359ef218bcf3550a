//! Power cuts while six writers work, at the start, during copies and while a copy is restored. Acknowledged
//! writes are on the disk, regardless of the unsynced changes that the disk has kept.

use super::Tell;
use crate::faults::Disk;
use crate::power::{DiskModel, Unsynced};
use crate::program::{Server, program};
use crate::random::Random;
use crate::writers::{self, Tally, Writer};
use anyhow::{Context, ensure};
use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// Number of writers.
const WRITERS: u64 = 6;
/// The power fails at one of this many changes of files; saving a scene takes about ten.
const CHANGES: u64 = 600;
/// The same for phases with few writes: the start, and a copy.
const FEW_CHANGES: u64 = 60;
/// The power fails at the latest after this time.
const WITHIN: Duration = Duration::from_secs(2);
/// Time until a writing server makes its next change.
const NEXT_CHANGE: Duration = Duration::from_millis(300);

/// Counts of a trial.
#[derive(Clone, Copy, Debug, Default)]
pub struct PowerReport {
    /// Cuts.
    pub cuts: u64,
    /// Cuts at the start of the server.
    pub at_the_start: u64,
    /// Cuts during a copy of the store.
    pub at_a_copy: u64,
    /// Cuts while a copy is restored.
    pub at_a_return: u64,
    /// Changes of files.
    pub changes: u64,
    /// Counts of the writers.
    pub writes: Tally,
}

/// A trial under way.
struct Trial {
    folder: tempfile::TempDir,
    disk: Disk,
    model: DiskModel,
    crowd: Vec<Writer>,
    random: Random,
    report: PowerReport,
}

/// Cuts the power this many times, and compares the store after each. With `lies`, the disk reports syncs
/// that it did not make.
///
/// # Errors
/// When an acknowledged write is lost, a file is damaged, or the server does not start.
pub fn power(count: u64, seed: u64, lies: bool, tell: Tell<'_>) -> anyhow::Result<PowerReport> {
    let folder = tempfile::tempdir()?;
    let (disk, model) = (Disk::with_journal(folder.path())?, DiskModel::of(folder.path())?);
    if lies {
        disk.lies()?;
    }
    let (crowd, random) = (Writer::crowd(WRITERS, seed), Random::new(seed));
    let mut trial = Trial { folder, disk, model, crowd, random, report: PowerReport::default() };
    while trial.report.cuts < count {
        let round = trial.report.cuts;
        trial.round().with_context(|| format!("cut {round} of seed {seed}"))?;
        if round % 50 == 49 {
            tell(&format!("{:?}", trial.now()));
        }
    }
    trial.reopened()?;
    Ok(trial.now())
}

impl Trial {
    fn now(&self) -> PowerReport {
        PowerReport { writes: writers::tally(&self.crowd), ..self.report }
    }

    fn db(&self) -> PathBuf {
        self.folder.path().join("scenes.sqlite")
    }

    fn copy(&self) -> PathBuf {
        self.folder.path().join("copy.sqlite")
    }

    fn round(&mut self) -> anyhow::Result<()> {
        match self.report.cuts % 10 {
            3 => self.at_the_start(),
            5 => self.at_a_copy(),
            7 => self.at_a_return(),
            _ => self.at_work(),
        }
    }

    fn power_goes(&mut self, within: u64) -> anyhow::Result<()> {
        self.disk.power_goes(1 + self.random.below(within))
    }

    /// A program that uses the disk; its output is kept apart.
    fn on_the_disk(&self, mut command: Command) -> anyhow::Result<Command> {
        self.disk.put_under(&mut command)?;
        command.stdin(Stdio::null()).stderr(self.disk.log()?);
        Ok(command)
    }

    fn server(&self) -> anyhow::Result<Command> {
        self.on_the_disk(Server::command(&self.db(), &[]))
    }

    /// Copies the store, or restores the copy; returns whether success was reported.
    fn tool(&self, name: &str, from: &Path, to: &Path) -> anyhow::Result<bool> {
        let mut command = Command::new(program());
        let (db, out) = (OsStr::new("--db"), OsStr::new("-o"));
        let name_of = OsStr::new(name);
        match name {
            "backup" => command.args([name_of, db, from.as_os_str(), out, to.as_os_str()]),
            _ => command.args([name_of, from.as_os_str(), db, to.as_os_str()]),
        };
        Ok(self.on_the_disk(command)?.arg("--force").stdout(Stdio::null()).status()?.success())
    }

    /// Starts a server on the files that a cut has left, and compares.
    fn reopened(&mut self) -> anyhow::Result<Server> {
        let server = Server::launch(self.server()?).context("the store cannot be opened")?;
        writers::compare(&mut self.crowd, &server)?;
        self.crowd.iter_mut().for_each(Writer::settle);
        writers::sound(&self.db())?;
        Ok(server)
    }

    /// After the end of all programs, the files become those on the disk.
    fn power_is_gone(&mut self) -> anyhow::Result<()> {
        self.report.changes += self.model.replay(self.disk.journal()?)?;
        self.model.agrees(self.folder.path())?;
        let unsynced = Unsynced::drawn(&mut self.random);
        self.model.cut(unsynced, &mut self.random);
        self.model.rebuild(self.folder.path())?;
        self.model = DiskModel::of(self.folder.path())?;
        self.disk.begin_journal()?;
        self.disk.power_goes(u64::MAX)?;
        self.report.cuts += 1;
        Ok(())
    }

    /// Cuts the power while all writers work.
    fn at_work(&mut self) -> anyhow::Result<()> {
        let server = self.reopened()?;
        self.power_goes(CHANGES)?;
        let (address, disk) = (server.address, &self.disk);
        writers::work_until(&mut self.crowd, address, Duration::ZERO, writers::none, || {
            let began = Instant::now();
            while !disk.is_without_power()? && began.elapsed() < WITHIN {
                std::thread::sleep(Duration::from_millis(2));
            }
            ended(disk, server)
        })?;
        self.power_is_gone()
    }

    /// Cuts the power while the server recovers from the last cut.
    fn at_the_start(&mut self) -> anyhow::Result<()> {
        self.report.at_the_start += 1;
        self.power_goes(FEW_CHANGES)?;
        match Server::launch(self.server()?) {
            Ok(server) => ended(&self.disk, server)?,
            Err(error) => ensure!(self.disk.is_without_power()?, "{error:#}"),
        }
        self.power_is_gone()
    }

    /// Cuts the power while the store is copied beside the server. A reported copy must exist and be
    /// complete.
    fn at_a_copy(&mut self) -> anyhow::Result<()> {
        self.report.at_a_copy += 1;
        let server = self.reopened()?;
        let expected: usize = self.crowd.iter().map(|writer| writer.present().count()).sum();
        self.power_goes(FEW_CHANGES)?;
        let is_made = self.tool("backup", &self.db(), &self.copy())?;
        ended(&self.disk, server)?;
        self.power_is_gone()?;
        if is_made {
            let found = scenes(&self.copy()).context("a copy that was reported")?;
            ensure!(found == expected, "a copy has {found} scenes in place of {expected}");
        }
        Ok(())
    }

    /// Cuts the power while a copy replaces the store: it does so completely, or not at all.
    fn at_a_return(&mut self) -> anyhow::Result<()> {
        self.report.at_a_return += 1;
        let server = self.reopened()?;
        ensure!(self.tool("backup", &self.db(), &self.copy())?, "the store cannot be copied");
        let mut copied = self.crowd.clone();
        let (address, disk) = (server.address, &self.disk);
        let a_while = Duration::from_millis(100);
        writers::work_until(&mut self.crowd, address, a_while, writers::none, || ended(disk, server))?;
        // The restore itself recovers the log that a killed server leaves.
        self.power_goes(FEW_CHANGES)?;
        let is_made = self.tool("restore", &self.copy(), &self.db())?;
        self.power_is_gone()?;
        copied.iter_mut().zip(&self.crowd).for_each(|(copied, now)| copied.tally = now.tally);
        let before = std::mem::replace(&mut self.crowd, copied);
        if let Err(error) = self.reopened() {
            ensure!(!is_made, "a return that was reported: {error:#}");
            self.crowd = before;
            self.reopened()?;
        }
        Ok(())
    }
}

/// Ends a server at its next change: a kill from outside may come between a change and its record.
fn ended(disk: &Disk, mut server: Server) -> anyhow::Result<()> {
    disk.power_goes(0)?;
    let began = Instant::now();
    while server.is_up() && began.elapsed() < NEXT_CHANGE {
        std::thread::sleep(Duration::from_millis(2));
    }
    server.kill()
}

/// Number of scenes in a complete copy.
fn scenes(copy: &Path) -> anyhow::Result<usize> {
    writers::sound(copy)?;
    let connection = rusqlite::Connection::open_with_flags(copy, rusqlite::OpenFlags::SQLITE_OPEN_READ_ONLY)?;
    Ok(connection.query_row("SELECT count(*) FROM scenes", [], |row| row.get::<_, i64>(0))?.unsigned_abs()
        as usize)
}
