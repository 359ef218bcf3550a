//! Disk faults under a busy server: it reports them, stays up, loses nothing, and recovers with the disk.

use super::Tell;
use crate::faults::{Call, Disk, Fault, How};
use crate::http::Request;
use crate::program::{Server, program};
use crate::random::Random;
use crate::scenes::street;
use crate::writers::{self, Outcome, Tally, Writer};
use anyhow::{Context, bail, ensure};
use std::path::{Path, PathBuf};
use std::process::Command;

/// Number of writers. They take turns, so that the calls of a round come in one order.
const WRITERS: u64 = 3;
/// Greatest number of changes until a fault must occur.
const CHANGES: usize = 40;
/// Number of changes that a lasting fault meets.
const REFUSED: usize = 3;

/// Counts of a trial.
#[derive(Clone, Copy, Debug, Default)]
pub struct Report {
    /// Rounds, each with one fault or a series of faults.
    pub rounds: u64,
    /// Calls that failed.
    pub failed: u64,
    /// Counts of the writers.
    pub writes: Tally,
    /// Starts that a fault prevented.
    pub starts_refused: u64,
    /// Copies that a fault prevented.
    pub copies_refused: u64,
    /// Reads that a fault prevented.
    pub reads_refused: u64,
    /// Kills after faults.
    pub kills: u64,
}

/// A trial under way.
struct Trial {
    folder: tempfile::TempDir,
    disk: Disk,
    server: Option<Server>,
    crowd: Vec<Writer>,
    random: Random,
    report: Report,
}

/// Runs rounds until this many calls have failed.
///
/// # Errors
/// When the server loses something, ends, or replies against its contract or against `/readyz`.
pub fn faults(count: u64, seed: u64, tell: Tell<'_>) -> anyhow::Result<Report> {
    let folder = tempfile::tempdir()?;
    std::fs::create_dir(folder.path().join("data"))?;
    for k in 0..4 {
        let mut scene = street(2, 10);
        scene["meta"]["source_id"] = serde_json::json!(format!("{k}"));
        std::fs::write(folder.path().join(format!("data/{k}.json")), scene.to_string())?;
    }
    let disk = Disk::of(folder.path())?;
    let (crowd, random) = (Writer::crowd(WRITERS, seed), Random::new(seed));
    let mut trial = Trial { folder, disk, server: None, crowd, random, report: Report::default() };
    trial.restart()?;
    while trial.report.failed < count {
        let round = trial.report.rounds;
        let done = trial.round();
        done.with_context(|| format!("round {round} of seed {seed}\n{}", trial.disk.last_words()))?;
        trial.report.rounds += 1;
        trial.report.failed = trial.disk.failed()?;
        if round % 50 == 49 {
            tell(&format!("{:?}", trial.now()));
        }
        ensure!(round < 100 * count.max(10), "faults do not come");
    }
    trial.kill()?;
    Ok(trial.now())
}

impl Trial {
    fn now(&self) -> Report {
        Report { writes: writers::tally(&self.crowd), ..self.report }
    }

    fn db(&self) -> PathBuf {
        self.folder.path().join("scenes.sqlite")
    }

    fn server(&self) -> anyhow::Result<&Server> {
        self.server.as_ref().context("no server")
    }

    fn compare(&mut self) -> anyhow::Result<()> {
        writers::compare(&mut self.crowd, self.server.as_ref().context("no server")?)
    }

    fn command(&self) -> anyhow::Result<Command> {
        let data = self.folder.path().join("data");
        let data = data.to_str().context("a folder with a plain name")?;
        let mut command = Server::command(&self.db(), &["--data", data, "--limit", "cached_scene_bytes=1"]);
        command.stderr(self.disk.log()?);
        self.disk.put_under(&mut command)?;
        Ok(command)
    }

    fn restart(&mut self) -> anyhow::Result<()> {
        self.disk.well()?;
        let server = Server::launch(self.command()?)?;
        writers::compare(&mut self.crowd, &server)?;
        self.crowd.iter_mut().for_each(Writer::settle);
        server.wait_ready()?;
        self.server = Some(server);
        writers::sound(&self.db())
    }

    fn kill(&mut self) -> anyhow::Result<()> {
        self.report.kills += 1;
        self.server.take().context("no server")?.kill()?;
        self.restart()
    }

    fn round(&mut self) -> anyhow::Result<()> {
        match self.random.below(20) {
            0 => self.at_the_start(),
            1 => self.at_a_copy(),
            2 => self.at_a_read(),
            3 => self.at_last(),
            _ => self.at_a_change(),
        }
    }

    /// Some calls fail while scenes are changed.
    fn at_a_change(&mut self) -> anyhow::Result<()> {
        let fault = Fault::drawn(&mut self.random);
        let before = self.disk.failed()?;
        self.disk.fails(fault)?;
        self.changes_under(fault, before).with_context(|| fault.to_string())
    }

    fn changes_under(&mut self, fault: Fault, before: u64) -> anyhow::Result<()> {
        let mut refused = 0;
        for _ in 0..CHANGES {
            refused += usize::from(self.change()?);
            let failed = self.disk.failed()? - before;
            if failed >= fault.failing || refused >= REFUSED {
                break;
            }
        }
        self.recovers()?;
        // The log may still hold refused changes: a start must not misread them.
        if self.random.below(6) == 0 { self.kill() } else { Ok(()) }
    }

    /// The disk is full or broken for a while, and every client sees it.
    fn at_last(&mut self) -> anyhow::Result<()> {
        let how = if self.random.below(2) == 0 { How::Full } else { How::Broken };
        self.disk.fails(Fault::lasting(how))?;
        let mut refused = false;
        for _ in 0..CHANGES {
            refused |= self.change()?;
        }
        ensure!(refused, "changes are answered though nothing can be written ({how:?})");
        let ready = self.server()?.get("/readyz")?;
        ensure!(ready.status == 503, "ready, though nothing can be written ({how:?})");
        ensure!(ready.json()["failing"] == serde_json::json!(["store"]), "{}", ready.text());
        self.compare().context("scenes can still be read")?;
        self.recovers()
    }

    /// One change by a random writer; true if the disk refused it.
    fn change(&mut self) -> anyhow::Result<bool> {
        let at = self.random.below(WRITERS) as usize;
        let address = self.server()?.address;
        match self.crowd[at].change(address) {
            Outcome::Kept => Ok(false),
            Outcome::Refused(status, code) if writers::of_the_disk(status, &code) => Ok(true),
            Outcome::Refused(status, code) => bail!("{status} {code}"),
            Outcome::Lost => bail!("the server gave no answer"),
        }
    }

    /// After the repair of the disk, the server recovers at once, and nothing is lost.
    fn recovers(&mut self) -> anyhow::Result<()> {
        self.disk.well()?;
        let ready = self.server()?.get("/readyz")?;
        ensure!(ready.status == 200, "the disk is well, the server is not: {}", ready.text());
        self.compare()?;
        let address = self.server()?.address;
        for writer in &mut self.crowd {
            let outcome = writer.change(address);
            ensure!(outcome == Outcome::Kept, "the disk is well, a change is not: {outcome:?}");
        }
        self.server.as_mut().map_or(Ok(()), |server| {
            ensure!(server.is_up(), "the server has fallen");
            Ok(())
        })
    }

    /// A server starts on a failing disk, or reports why it cannot.
    fn at_the_start(&mut self) -> anyhow::Result<()> {
        self.server.take().context("no server")?.kill()?;
        let fault = Fault { before: self.random.below(6), ..Fault::drawn(&mut self.random) };
        self.disk.fails(fault)?;
        if let Err(error) = Server::launch(self.command()?) {
            ensure!(error.to_string().contains("exit status: 1"), "{fault}: {error:#}");
            self.report.starts_refused += 1;
        }
        self.restart().with_context(|| format!("{fault}, at the start"))
    }

    /// The store is copied on a failing disk: the result is a complete copy or none.
    fn at_a_copy(&mut self) -> anyhow::Result<()> {
        let copies = self.folder.path().join("copies");
        std::fs::create_dir_all(&copies)?;
        let copy = copies.join("copy.sqlite");
        let call = [Call::Write, Call::Sync, Call::Rename, Call::Read][self.random.below(4) as usize];
        let can_be_full = call != Call::Read && self.random.below(2) == 0;
        let how = if can_be_full { How::Full } else { How::Broken };
        self.disk.fails(Fault { call, how, before: self.random.below(12), failing: u64::MAX })?;
        let mut command = Command::new(program());
        command.args(["backup", "--db"]).arg(self.db()).arg("-o").arg(&copy);
        self.disk.put_under(&mut command)?;
        let output = command.output()?;
        self.disk.well()?;
        if output.status.success() {
            writers::sound(&copy)?;
            std::fs::remove_file(&copy)?;
        } else {
            let said = String::from_utf8_lossy(&output.stderr);
            ensure!(output.status.code() == Some(1) && said.lines().count() == 1, "{call:?} {how:?}: {said}");
            self.report.copies_refused += 1;
        }
        let left = names(&copies)?;
        // A name may exist before the disk refuses to confirm it: then the file is complete.
        for name in left.iter().filter(|name| *name == "copy.sqlite") {
            writers::sound(&copies.join(name))?;
            std::fs::remove_file(copies.join(name))?;
        }
        ensure!(left.iter().all(|name| name == "copy.sqlite"), "{call:?} {how:?} left {left:?}");
        Ok(())
    }

    /// Scenes of the store and of the data folder are read on a failing disk.
    fn at_a_read(&mut self) -> anyhow::Result<()> {
        let before = self.random.below(3);
        self.disk.fails(Fault { call: Call::Read, how: How::Broken, before, failing: 2 })?;
        let own = self.crowd.iter().flat_map(Writer::present).map(str::to_owned);
        let ids: Vec<String> = own.chain((0..4).map(|k| format!("drawn-{k}"))).collect();
        for id in ids {
            let read = Request::new("GET", &format!("/v1/scenes/{id}")).send(self.server()?.address)?;
            let known = matches!(
                (read.status, read.code().as_str()),
                (200, "") | (404, "not-found") | (503, "store-unavailable")
            );
            ensure!(known, "{id}: {} {}", read.status, read.text());
            self.report.reads_refused += u64::from(read.status != 200);
        }
        self.recovers()
    }
}

fn names(folder: &Path) -> anyhow::Result<Vec<String>> {
    let entries = std::fs::read_dir(folder)?.flatten();
    Ok(entries.map(|entry| entry.file_name().to_string_lossy().into_owned()).collect())
}
