//! Schedules: steps drawn from one seed and run one after another, so that a failure can be reproduced.

use super::Tell;
use crate::faults::{Disk, Fault, How};
use crate::http::{Reply, Request};
use crate::program::{Server, program};
use crate::random::Random;
use crate::scenes::{generate, street};
use crate::writers::{self, Outcome, Writer};
use anyhow::{Context, bail, ensure};
use serde_json::json;
use std::path::PathBuf;
use std::process::Command;
use std::time::Duration;

const WRITERS: u64 = 4;

/// One step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Step {
    /// A writer changes one of its scenes.
    Change(u64),
    /// All writers work in parallel for this many milliseconds.
    Crowd(u64),
    /// Generates futures with this seed, with or without reacting road users, and reads to the end.
    Generate(u64, bool),
    /// Generates futures; the reader disconnects after this many milliseconds.
    Leave(u64),
    /// Generates futures, and cancels them by their id after this many milliseconds.
    Cancel(u64),
    /// A revision is superseded by the next after this many milliseconds, as in a drag.
    Overtake(u64),
    /// A scene is scored.
    Score,
    /// Road users are placed with this seed.
    Place(u64),
    /// A file of this many road users is imported.
    Import(u64),
    /// A scene is exported.
    Export,
    /// A copy of the store is taken while all writers work.
    Backup,
    /// From now on the disk is full.
    Full,
    /// From now on the disk fails.
    Broken,
    /// From now on the disk works.
    Well,
    /// The server is killed while all writers work, after this many milliseconds, and started again.
    Kill(u64),
    /// Stops the server, and starts it again.
    Stop,
    /// Compares the store with the expected scenes.
    Compare,
}

/// The steps of a seed, always the same.
pub fn steps(seed: u64) -> Vec<Step> {
    let mut random = Random::new(seed);
    let count = 20 + random.below(20);
    let mut is_well = true;
    let mut steps = Vec::new();
    for _ in 0..count {
        let step = match random.below(24) {
            0..5 => Step::Change(random.below(WRITERS)),
            5..7 => Step::Crowd(20 + random.below(150)),
            7..9 => Step::Generate(random.below(1_000), random.below(2) == 0),
            9 => Step::Leave(random.below(60)),
            10 => Step::Cancel(random.below(60)),
            11..13 => Step::Overtake(random.below(40)),
            13 => Step::Score,
            14 => Step::Place(random.below(1_000)),
            15 => Step::Import(1 + random.below(6)),
            16 => Step::Export,
            17 => Step::Backup,
            18 if is_well => Step::Full,
            19 if is_well => Step::Broken,
            18 | 19 => Step::Well,
            20..22 => Step::Kill(random.below(120)),
            22 => Step::Stop,
            _ => Step::Compare,
        };
        match step {
            Step::Full | Step::Broken => is_well = false,
            // A restarted server gets a working disk.
            Step::Well | Step::Kill(_) | Step::Stop => is_well = true,
            _ => {}
        }
        steps.push(step);
    }
    steps.push(Step::Well);
    steps.push(Step::Compare);
    steps
}

/// Runs the schedules of `count` seeds from `seed`; returns the number of steps.
///
/// # Errors
/// At the first step that fails, with the steps before it and the command that repeats them.
pub fn schedules(count: u64, seed: u64, tell: Tell<'_>) -> anyhow::Result<u64> {
    let mut done = 0;
    for number in 0..count {
        let seed = seed.wrapping_add(number);
        let steps = steps(seed);
        let mut stage = Stage::new(seed)?;
        for (at, step) in steps.iter().enumerate() {
            stage.step(*step).with_context(|| {
                let past: Vec<String> = steps[..=at].iter().map(|step| format!("  {step:?}")).collect();
                let (past, said) = (past.join("\n"), stage.disk.last_words());
                format!("{past}\n{said}\nagain with: cargo xtask soak schedule --seed {seed} --count 1")
            })?;
            done += 1;
        }
        tell(&format!("seed {seed}: {} steps, {:?}", steps.len(), writers::tally(&stage.crowd)));
    }
    Ok(done)
}

struct Stage {
    folder: tempfile::TempDir,
    disk: Disk,
    server: Option<Server>,
    crowd: Vec<Writer>,
    revision: u64,
    is_well: bool,
}

/// Refusals that are allowed: those of a failing disk, or none.
fn allowed(is_well: bool) -> fn(u16, &str) -> bool {
    if is_well { writers::none } else { writers::of_the_disk }
}

impl Stage {
    fn new(seed: u64) -> anyhow::Result<Self> {
        let folder = tempfile::tempdir()?;
        let disk = Disk::of(folder.path())?;
        let crowd = Writer::crowd(WRITERS, seed);
        let mut stage = Self { folder, disk, server: None, crowd, revision: 0, is_well: true };
        stage.start()?;
        Ok(stage)
    }

    fn db(&self) -> PathBuf {
        self.folder.path().join("scenes.sqlite")
    }

    fn start(&mut self) -> anyhow::Result<()> {
        self.disk_is(None)?;
        let mut command = Server::command(&self.db(), &[]);
        command.stderr(self.disk.log()?);
        self.disk.put_under(&mut command)?;
        let server = Server::launch(command)?;
        writers::compare(&mut self.crowd, &server)?;
        self.crowd.iter_mut().for_each(Writer::settle);
        writers::sound(&self.db())?;
        self.server = Some(server);
        Ok(())
    }

    fn server(&self) -> anyhow::Result<&Server> {
        self.server.as_ref().context("no server")
    }

    fn disk_is(&mut self, failing: Option<How>) -> anyhow::Result<()> {
        self.is_well = failing.is_none();
        failing.map_or_else(|| self.disk.well(), |how| self.disk.fails(Fault::lasting(how)))
    }

    fn post(&self, path: &str, body: &serde_json::Value) -> anyhow::Result<Reply> {
        let reply = self.server()?.post(path, body)?;
        let refused = reply.status >= 300;
        let known = allowed(self.is_well)(reply.status, &reply.code());
        ensure!(!refused || known, "{path}: {} {}", reply.status, reply.text());
        Ok(reply)
    }

    fn step(&mut self, step: Step) -> anyhow::Result<()> {
        match step {
            Step::Change(writer) => self.change(writer),
            Step::Crowd(ms) => self.crowd(ms, || Ok(())),
            Step::Generate(seed, react) => {
                let mut body = generate(8);
                (body["seed"], body["react"]) = (json!(seed), json!(react));
                let reply = self.post("/v1/generate", &body)?;
                ensure!(reply.status == 200, "{}", reply.text());
                Ok(())
            }
            Step::Leave(ms) => self.leave(ms),
            Step::Cancel(ms) => self.cancel(ms),
            Step::Overtake(ms) => self.overtake(ms),
            Step::Score => self.post("/v1/score", &json!({"scene": street(6, 40)})).map(drop),
            Step::Place(seed) => {
                let body = json!({"scene": street(2, 20), "density": {"count": 8}, "seed": seed});
                self.post("/v1/place", &body).map(drop)
            }
            Step::Import(agents) => self.post("/v1/import", &street(agents as usize, 20)).map(drop),
            Step::Export => self.post("/v1/export?format=womd", &street(3, 91)).map(drop),
            Step::Backup => self.backup(),
            Step::Full => self.disk_is(Some(How::Full)),
            Step::Broken => self.disk_is(Some(How::Broken)),
            Step::Well => self.disk_is(None),
            Step::Kill(ms) => {
                let server = self.server.take().context("no server")?;
                let (address, after) = (server.address, Duration::from_millis(ms));
                let allowed = allowed(self.is_well);
                writers::work_until(&mut self.crowd, address, after, allowed, || server.kill())?;
                self.start()
            }
            Step::Stop => {
                let (code, _) = self.server.take().context("no server")?.stop()?;
                ensure!(code == Some(0), "it ended with {code:?}");
                self.start()
            }
            Step::Compare => writers::compare(&mut self.crowd, self.server.as_ref().context("no server")?),
        }
    }

    fn change(&mut self, writer: u64) -> anyhow::Result<()> {
        let (address, allowed) = (self.server()?.address, allowed(self.is_well));
        match self.crowd[writer as usize].change(address) {
            Outcome::Kept => Ok(()),
            Outcome::Refused(status, code) if allowed(status, &code) => Ok(()),
            other => bail!("{other:?}"),
        }
    }

    /// Runs all writers for a while, and something else at the same time.
    fn crowd(&mut self, ms: u64, beside: impl FnOnce() -> anyhow::Result<()>) -> anyhow::Result<()> {
        let (address, after) = (self.server()?.address, Duration::from_millis(ms));
        let lost = writers::tally(&self.crowd).lost;
        writers::work_until(&mut self.crowd, address, after, allowed(self.is_well), beside)?;
        ensure!(writers::tally(&self.crowd).lost == lost, "a change got no answer");
        Ok(())
    }

    fn backup(&mut self) -> anyhow::Result<()> {
        let (db, copy) = (self.db(), self.folder.path().join("copy.sqlite"));
        let mut command = Command::new(program());
        command.args(["backup", "--quiet", "--force", "--db"]).arg(&db).arg("-o").arg(&copy);
        self.crowd(20, || {
            let output = command.output()?;
            ensure!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
            writers::sound(&copy)
        })
    }

    /// A long streamed generation.
    fn long(&mut self, job: &str) -> (Request, String) {
        self.revision += 1;
        let job = format!("{job}-{}", self.revision);
        let mut body = generate(12);
        (body["agents"], body["steps"], body["samples"]) = (json!("all"), json!(40), json!(4));
        (body["job"], body["client"], body["revision"]) = (json!(job), json!("hand"), json!(self.revision));
        let request = Request::new("POST", "/v1/generate").header("accept", "application/x-ndjson");
        (request.json(&body), job)
    }

    fn leave(&mut self, ms: u64) -> anyhow::Result<()> {
        let stream = self.long("left").0.open(self.server()?.address)?;
        std::thread::sleep(Duration::from_millis(ms));
        drop(stream);
        self.nobody_works()
    }

    fn cancel(&mut self, ms: u64) -> anyhow::Result<()> {
        let (request, job) = self.long("cancelled");
        let address = self.server()?.address;
        let reader = std::thread::spawn(move || request.send(address));
        std::thread::sleep(Duration::from_millis(ms));
        let gone = Request::new("DELETE", &format!("/v1/jobs/{job}")).send(address)?;
        ensure!(gone.status == 204, "{}", gone.text());
        let reply = reader.join().map_err(|_| anyhow::anyhow!("a reply breaks the contract"))??;
        ensure!(reply.status == 200 || reply.code() == "cancelled", "{} {}", reply.status, reply.text());
        self.nobody_works()
    }

    fn overtake(&mut self, ms: u64) -> anyhow::Result<()> {
        let (older, newer) = (self.long("older").0, self.long("newer").0);
        let address = self.server()?.address;
        let reader = std::thread::spawn(move || older.send(address));
        std::thread::sleep(Duration::from_millis(ms));
        let reply = newer.send(address)?;
        ensure!(reply.status == 200 && reply.text().contains("\"final\""), "the newer one: {}", reply.text());
        let reply = reader.join().map_err(|_| anyhow::anyhow!("a reply breaks the contract"))??;
        let fits = reply.status == 200 || matches!(reply.code().as_str(), "superseded" | "stale-revision");
        ensure!(fits, "the older one: {} {}", reply.status, reply.text());
        self.nobody_works()
    }

    /// Checks that no work continues for callers that have left.
    fn nobody_works(&self) -> anyhow::Result<()> {
        let server = self.server()?;
        let load = || -> anyhow::Result<f64> {
            Ok(server.metric("dragtraffic_running")? + server.metric("dragtraffic_queue_length")?)
        };
        writers::wait_for("work for nobody ends", || load().is_ok_and(|load| load == 0.0))
    }
}
