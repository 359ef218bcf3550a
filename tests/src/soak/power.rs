//! Power cuts during the work of six writers, at the start, during copies and their return: what was answered is on the
//! disk, whatever the disk made of that which was not synced.

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

/// Writers at work.
const WRITERS: u64 = 6;
/// The power goes with one of so many changes of files; a saved scene takes about ten.
const CHANGES: u64 = 600;
/// The same where little is written: at the start, and by a copy.
const FEW_CHANGES: u64 = 60;
/// The power goes at the latest after this time.
const WITHIN: Duration = Duration::from_secs(2);
/// Time in which a server that writes comes to its next change.
const NEXT_CHANGE: Duration = Duration::from_millis(300);

/// Counts of a trial.
#[derive(Clone, Copy, Debug, Default)]
pub struct PowerReport {
    /// Cuts.
    pub cuts: u64,
    /// Those at the start of the server.
    pub at_the_start: u64,
    /// Those during a copy of the store.
    pub at_a_copy: u64,
    /// Those during the return to a copy.
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

/// Cuts the power so often, and compares after each time. A disk that lies says that it has synced, and has not.
///
/// # Errors
/// When something that was answered is lost, a file is damaged, or the server does not start.
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

    /// A program that uses the disk; what it says is kept apart.
    fn on_the_disk(&self, mut command: Command) -> anyhow::Result<Command> {
        self.disk.put_under(&mut command)?;
        command.stdin(Stdio::null()).stderr(self.disk.log()?);
        Ok(command)
    }

    fn server(&self) -> anyhow::Result<Command> {
        self.on_the_disk(Server::command(&self.db(), &[]))
    }

    /// Copies the store, or returns to the copy; true when that was reported.
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

    /// Starts on what a cut has left, and compares.
    fn reopened(&mut self) -> anyhow::Result<Server> {
        let server = Server::launch(self.server()?).context("the store cannot be opened")?;
        writers::compare(&mut self.crowd, &server)?;
        self.crowd.iter_mut().for_each(Writer::settle);
        writers::sound(&self.db())?;
        Ok(server)
    }

    /// No program runs any more: the files become what the disk has of them.
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

    /// While all writers work.
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

    /// While what the last cut has left is put in order.
    fn at_the_start(&mut self) -> anyhow::Result<()> {
        self.report.at_the_start += 1;
        self.power_goes(FEW_CHANGES)?;
        match Server::launch(self.server()?) {
            Ok(server) => ended(&self.disk, server)?,
            Err(error) => ensure!(self.disk.is_without_power()?, "{error:#}"),
        }
        self.power_is_gone()
    }

    /// While the store is copied beside the server. A copy that was reported is there, and whole.
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

    /// While a copy takes the place of the store: it does so wholly, or not at all.
    fn at_a_return(&mut self) -> anyhow::Result<()> {
        self.report.at_a_return += 1;
        let server = self.reopened()?;
        ensure!(self.tool("backup", &self.db(), &self.copy())?, "the store cannot be copied");
        let mut copied = self.crowd.clone();
        let (address, disk) = (server.address, &self.disk);
        let a_while = Duration::from_millis(100);
        writers::work_until(&mut self.crowd, address, a_while, writers::none, || ended(disk, server))?;
        // What a killed server leaves in the log is put in order by the return itself.
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

/// Scenes of a whole copy.
fn scenes(copy: &Path) -> anyhow::Result<usize> {
    writers::sound(copy)?;
    let connection = rusqlite::Connection::open_with_flags(copy, rusqlite::OpenFlags::SQLITE_OPEN_READ_ONLY)?;
    Ok(connection.query_row("SELECT count(*) FROM scenes", [], |row| row.get::<_, i64>(0))?.unsigned_abs()
        as usize)
}
