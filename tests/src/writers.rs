//! Writers that remember the replies. Each changes its own scenes by PUT, PATCH and DELETE. It knows what the
//! store must hold afterwards, even if the server or its disk failed.

use crate::http::Request;
use crate::program::Server;
use crate::random::Random;
use crate::scenes::street;
use anyhow::{Context, bail, ensure};
use serde_json::{Value, json};
use std::collections::{BTreeMap, BTreeSet};
use std::net::SocketAddr;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// Scenes of one writer.
const SCENES: u64 = 6;

/// The fields that distinguish a scene's versions.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Version {
    name: String,
    agents: usize,
}

/// Knowledge about one scene.
#[derive(Clone, Debug, Default)]
struct Known {
    /// The version of the last reply; `None` for a scene that does not exist.
    sure: Option<Version>,
    /// Versions that an unanswered or refused change may have left.
    perhaps: Vec<Option<Version>>,
    /// ETag of `sure`, if a reply had one.
    etag: Option<String>,
}

/// Outcome of a change.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// It was answered with success.
    Kept,
    /// It was refused with this status and code.
    Refused(u16, String),
    /// There was no answer.
    Lost,
}

/// Counts of the writers' changes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Tally {
    /// Answered with success.
    pub kept: u64,
    /// Refused.
    pub refused: u64,
    /// Without an answer.
    pub lost: u64,
    /// Refused or unanswered changes that were found fully applied.
    pub applied: u64,
}

impl std::ops::AddAssign for Tally {
    fn add_assign(&mut self, other: Self) {
        self.kept += other.kept;
        self.refused += other.refused;
        self.lost += other.lost;
        self.applied += other.applied;
    }
}

/// One writer.
#[derive(Clone)]
pub struct Writer {
    name: String,
    random: Random,
    count: u64,
    scenes: BTreeMap<String, Known>,
    /// Counts of its changes.
    pub tally: Tally,
}

impl Writer {
    /// This many writers, each with its own name.
    pub fn crowd(count: u64, seed: u64) -> Vec<Self> {
        let writer = |k| Self {
            name: format!("w{k}"),
            random: Random::of_part(seed, k),
            count: 0,
            scenes: BTreeMap::new(),
            tally: Tally::default(),
        };
        (0..count).map(writer).collect()
    }

    /// Makes one change of one of its scenes.
    pub fn change(&mut self, address: SocketAddr) -> Outcome {
        self.count += 1;
        let id = format!("{}-{}", self.name, self.random.below(SCENES));
        let known = self.scenes.entry(id.clone()).or_default();
        let name = format!("{id} version {}", self.count);
        let whole = Version { name: name.clone(), agents: 1 + self.random.below(5) as usize };
        let path = format!("/v1/scenes/{id}");
        let (request, then) = match (&known.sure, known.etag.as_deref()) {
            (None, _) => {
                let put = Request::new("PUT", &path).header("if-none-match", "*");
                (put.json(&document(&whole)), Some(whole))
            }
            (Some(sure), etag) => {
                let etag = etag.unwrap_or("*");
                match self.random.below(4) {
                    0 => (Request::new("DELETE", &path).header("if-match", etag), None),
                    1 => {
                        let patch = Request::new("PATCH", &path).header("if-match", etag);
                        (patch.json(&json!({"name": name})), Some(Version { name, agents: sure.agents }))
                    }
                    _ => {
                        let put = Request::new("PUT", &path).header("if-match", etag);
                        (put.json(&document(&whole)), Some(whole))
                    }
                }
            }
        };
        let Ok(reply) = request.send(address) else {
            known.perhaps.push(then);
            self.tally.lost += 1;
            return Outcome::Lost;
        };
        if (200..300).contains(&reply.status) {
            let etag = Some(reply.header("etag").to_owned()).filter(|etag| !etag.is_empty());
            *known = Known { sure: then, perhaps: Vec::new(), etag };
            self.tally.kept += 1;
            return Outcome::Kept;
        }
        // After a kill the log may still hold a change that the disk refused.
        known.perhaps.push(then);
        self.tally.refused += 1;
        Outcome::Refused(reply.status, reply.code())
    }

    /// Compares the server's scenes with the expected ones, and remembers what it has found.
    ///
    /// # Errors
    /// When an acknowledged write is lost, or mixed with another one.
    pub fn compare(&mut self, server: &Server) -> anyhow::Result<()> {
        for (id, known) in &mut self.scenes {
            let reply = server.get(&format!("/v1/scenes/{id}"))?;
            let found = match reply.status {
                200 => Some(version(&reply.json()).with_context(|| format!("{id} is mixed"))?),
                404 => None,
                status => bail!("{id}: {status} {}", reply.text()),
            };
            if found != known.sure {
                let perhaps = &known.perhaps;
                let told = known.sure.as_ref();
                ensure!(
                    perhaps.contains(&found),
                    "{id}: {told:?} was answered (perhaps {perhaps:?}), {found:?} is there"
                );
                self.tally.applied += 1;
                known.sure = found;
            }
            known.etag = Some(reply.header("etag").to_owned()).filter(|etag| !etag.is_empty());
        }
        Ok(())
    }

    /// Forgets possible effects of unanswered changes: after a start, the stored scenes are final.
    pub fn settle(&mut self) {
        self.scenes.values_mut().for_each(|known| known.perhaps.clear());
    }

    /// Ids of the scenes that must exist.
    pub fn present(&self) -> impl Iterator<Item = &str> {
        self.scenes.iter().filter(|(_, known)| known.sure.is_some()).map(|(id, _)| id.as_str())
    }
}

fn document(version: &Version) -> Value {
    let mut scene = street(version.agents, 12);
    scene["name"] = json!(version.name);
    // Each version names itself, so that a body with the row of another version is detected.
    scene["meta"]["notes"] = json!(version.agents.to_string());
    scene
}

fn version(scene: &Value) -> anyhow::Result<Version> {
    let name = scene["name"].as_str().context("no name")?.to_owned();
    let agents = scene["agents"].as_array().context("no road users")?.len();
    let lanes = scene["map"]["lanes"].as_array().context("no map")?.len();
    ensure!(scene["meta"]["notes"] == json!(agents.to_string()) && lanes == 2, "{scene}");
    Ok(Version { name, agents })
}

/// Counts of all writers.
pub fn tally(writers: &[Writer]) -> Tally {
    let mut all = Tally::default();
    writers.iter().for_each(|writer| all += writer.tally);
    all
}

/// Compares the server's store with all writers, and its list with the expected entries.
///
/// # Errors
/// When something is lost, mixed, or present although it must not be.
pub fn compare(writers: &mut [Writer], server: &Server) -> anyhow::Result<()> {
    for writer in writers.iter_mut() {
        writer.compare(server)?;
    }
    let wanted: BTreeSet<&str> = writers.iter().flat_map(Writer::present).collect();
    let mut listed = BTreeSet::new();
    let mut after = String::new();
    loop {
        let page = server.get(&format!("/v1/scenes?limit=200{after}"))?.json();
        let items = page["scenes"].as_array().context("no list")?;
        let own = items.iter().filter(|item| item["readonly"] == false);
        listed.extend(own.filter_map(|item| item["id"].as_str().map(str::to_owned)));
        match page["next"].as_str() {
            Some(next) => after = format!("&after={next}"),
            None => break,
        }
    }
    let own: BTreeSet<&str> = listed.iter().map(String::as_str).filter(|id| id.starts_with('w')).collect();
    ensure!(own == wanted, "listed {own:?}, expected {wanted:?}");
    Ok(())
}

/// Runs all writers in parallel until a stop, or until the server is gone.
///
/// # Errors
/// When a reply breaks the contract, or is a refusal that `allowed` does not accept.
pub fn work(
    writers: &mut [Writer],
    address: SocketAddr,
    stop: &AtomicBool,
    allowed: fn(u16, &str) -> bool,
) -> anyhow::Result<()> {
    std::thread::scope(|scope| {
        let work = |writer: &mut Writer| loop {
            if stop.load(Ordering::Relaxed) {
                return Ok(());
            }
            match writer.change(address) {
                Outcome::Lost => return Ok(()),
                Outcome::Refused(status, code) if !allowed(status, &code) => {
                    bail!("{}: {status} {code}", writer.name)
                }
                Outcome::Kept | Outcome::Refused(..) => {}
            }
        };
        let threads: Vec<_> = writers.iter_mut().map(|writer| scope.spawn(move || work(writer))).collect();
        for thread in threads {
            thread.join().map_err(|_| anyhow::anyhow!("a reply breaks the contract"))??;
        }
        Ok(())
    })
}

/// Runs all writers for this time, then does something to the server while they work.
///
/// # Errors
/// As [`work`], or those of the action.
pub fn work_until<T>(
    writers: &mut [Writer],
    address: SocketAddr,
    after: Duration,
    allowed: fn(u16, &str) -> bool,
    then: impl FnOnce() -> anyhow::Result<T>,
) -> anyhow::Result<T> {
    let stop = AtomicBool::new(false);
    std::thread::scope(|scope| {
        let crowd = scope.spawn(|| work(writers, address, &stop, allowed));
        std::thread::sleep(after);
        let done = then();
        stop.store(true, Ordering::Relaxed);
        crowd.join().map_err(|_| anyhow::anyhow!("the writers broke off"))??;
        done
    })
}

/// Checks the file of a store with the database library itself.
///
/// # Errors
/// When it is damaged.
pub fn sound(db: &Path) -> anyhow::Result<()> {
    let connection = rusqlite::Connection::open_with_flags(db, rusqlite::OpenFlags::SQLITE_OPEN_READ_ONLY)?;
    connection.busy_timeout(Duration::from_secs(10))?;
    let found: String = connection.query_row("PRAGMA integrity_check", [], |row| row.get(0))?;
    ensure!(found == "ok", "{}: {found}", db.display());
    let orphans = connection.prepare("PRAGMA foreign_key_check")?.exists([])?;
    ensure!(!orphans, "{}: a scene has lost its map", db.display());
    Ok(())
}

/// Allows no refusal: there is no fault.
pub fn none(_: u16, _: &str) -> bool {
    false
}

/// Refusals of a failing disk.
pub fn of_the_disk(status: u16, code: &str) -> bool {
    matches!((status, code), (507, "store-full") | (503, "store-unavailable"))
}

/// Waits until a condition holds.
///
/// # Errors
/// When it does not hold within half a minute.
pub fn wait_for(what: &str, holds: impl Fn() -> bool) -> anyhow::Result<()> {
    let began = Instant::now();
    while !holds() {
        ensure!(began.elapsed() < Duration::from_secs(30), "{what}: not within half a minute");
        std::thread::sleep(Duration::from_millis(20));
    }
    Ok(())
}
