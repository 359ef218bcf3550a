//! The real program: built once, started on a free port with its own folder.

use crate::http::{Reply, Request};
use anyhow::{Context, bail, ensure};
use std::io::{BufRead, BufReader};
use std::net::SocketAddr;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::OnceLock;
use std::time::{Duration, Instant, SystemTime};
use tempfile::TempDir;

/// Ticks per second of Linux' core-time counters.
const TICKS: f64 = 100.0;

/// The repository's root.
pub fn root() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/.."))
}

/// The program: `DRAGTRAFFIC_BIN`, else the one beside these tests if it is newer than its sources (`cargo
/// test --workspace` has just built it), else a new build.
#[allow(clippy::panic, reason = "no test can go on without it")]
pub fn program() -> &'static Path {
    static PROGRAM: OnceLock<PathBuf> = OnceLock::new();
    PROGRAM.get_or_init(|| {
        let given = std::env::var_os("DRAGTRAFFIC_BIN").map(PathBuf::from);
        given
            .or_else(current)
            .map_or_else(build, Ok)
            .unwrap_or_else(|error| panic!("the program could not be built: {error:#}"))
    })
}

/// The program beside the tests, if none of its sources is newer.
fn current() -> Option<PathBuf> {
    let sources = ["Cargo.lock", "server", "models", "assets/scenes", "web/src", "web/index.html"];
    let sources: Vec<PathBuf> = sources.iter().map(|source| root().join(source)).collect();
    built("dragtraffic", &sources)
}

/// The program of this name that cargo built beside the tests, if none of its sources is newer.
pub(crate) fn built(name: &str, sources: &[impl AsRef<Path>]) -> Option<PathBuf> {
    let own = std::env::current_exe().ok()?;
    // Tests lie in their own folder, and programs in its parent.
    let path = own.ancestors().skip(1).take(2).map(|folder| folder.join(name)).find(|path| path.is_file())?;
    let made = path.metadata().and_then(|m| m.modified()).ok()?;
    let changed = sources.iter().filter_map(|source| newest(source.as_ref())).max();
    changed.is_none_or(|changed| changed < made).then_some(path)
}

/// Latest change of a file, or of any file below a folder.
fn newest(path: &Path) -> Option<SystemTime> {
    if !path.is_dir() {
        return path.metadata().and_then(|m| m.modified()).ok();
    }
    let entries = std::fs::read_dir(path).ok()?.flatten();
    entries.filter_map(|entry| newest(&entry.path())).max()
}

fn build() -> anyhow::Result<PathBuf> {
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let output = Command::new(cargo)
        .args(["build", "-p", "dragtraffic", "--features", "lab"])
        .arg("--message-format=json-render-diagnostics")
        .current_dir(root())
        .stdin(Stdio::null())
        .stderr(Stdio::inherit())
        .output()?;
    ensure!(output.status.success(), "cargo build failed");
    let text = String::from_utf8_lossy(&output.stdout);
    let messages = text.lines().filter_map(|line| serde_json::from_str::<serde_json::Value>(line).ok());
    let mut executables = messages.filter_map(|m| m["executable"].as_str().map(PathBuf::from));
    executables.next_back().context("cargo named no program")
}

/// A running server, killed when dropped.
pub struct Server {
    /// Address of its listener.
    pub address: SocketAddr,
    child: Child,
    folder: Option<TempDir>,
}

impl Server {
    /// Starts a server with an empty store.
    ///
    /// # Errors
    /// If it does not print its address within ten seconds.
    pub fn start(flags: &[&str]) -> anyhow::Result<Self> {
        Self::of(program(), flags)
    }

    /// Starts a given program as a server with an empty store.
    ///
    /// # Errors
    /// If it does not print its address.
    pub fn of(program: &Path, flags: &[&str]) -> anyhow::Result<Self> {
        let folder = tempfile::tempdir()?;
        let db = folder.path().join("scenes.sqlite");
        let mut server = Self::launch(Self::command_of(program, &db, flags))?;
        server.folder = Some(folder);
        Ok(server)
    }

    /// Starts a server with an empty store, and waits until its demos are listed.
    ///
    /// # Errors
    /// When it does not start, or the demos are missing after ten seconds.
    pub fn with_demos() -> anyhow::Result<Self> {
        let server = Self::start(&[])?;
        for _ in 0..200 {
            if server.get("/v1/scenes/demo-crossing?map=ref")?.status == 200 {
                return Ok(server);
            }
            std::thread::sleep(Duration::from_millis(50));
        }
        anyhow::bail!("demo-crossing is not listed")
    }

    /// Starts a server with an empty store that keeps its access log for [`Server::log`].
    ///
    /// # Errors
    /// If it does not print its address.
    pub fn with_log(flags: &[&str]) -> anyhow::Result<Self> {
        let folder = tempfile::tempdir()?;
        let log = std::fs::File::create(folder.path().join("log"))?;
        let mut command = Self::command(&folder.path().join("scenes.sqlite"), flags);
        command.args(["--log-level", "info"]).stderr(log);
        let mut server = Self::launch(command)?;
        server.folder = Some(folder);
        Ok(server)
    }

    /// Starts a server on a given store.
    ///
    /// # Errors
    /// If it does not print its address.
    pub fn start_at(db: &Path, flags: &[&str]) -> anyhow::Result<Self> {
        Self::launch(Self::command(db, flags))
    }

    /// The command that starts a server on a given store.
    pub fn command(db: &Path, flags: &[&str]) -> Command {
        Self::command_of(program(), db, flags)
    }

    fn command_of(program: &Path, db: &Path, flags: &[&str]) -> Command {
        let mut command = Command::new(program);
        command.args(["serve", "--port", "0", "--db"]).arg(db).args(flags).env("DRAGTRAFFIC_LOG", "warn");
        command
    }

    /// Starts a server by a prepared command.
    ///
    /// # Errors
    /// If it does not print its address.
    pub fn launch(mut command: Command) -> anyhow::Result<Self> {
        let mut child = command.stdin(Stdio::null()).stdout(Stdio::piped()).spawn()?;
        let out = child.stdout.take().context("no stdout")?;
        let mut line = String::new();
        BufReader::new(out).read_line(&mut line)?;
        let address = line.trim().strip_prefix("DragTraffic is at http://").and_then(|a| a.split('/').next());
        let Some(address) = address.and_then(|a| a.parse().ok()) else {
            let status = child.wait()?;
            bail!("the server said \"{}\" and ended with {status}", line.trim());
        };
        Ok(Self { address, child, folder: None })
    }

    /// Waits until `/readyz` reports success.
    ///
    /// # Errors
    /// After a minute.
    pub fn wait_ready(&self) -> anyhow::Result<()> {
        let began = Instant::now();
        while began.elapsed() < Duration::from_secs(60) {
            if self.get("/readyz")?.status == 200 {
                return Ok(());
            }
            std::thread::sleep(Duration::from_millis(50));
        }
        bail!("not ready within a minute")
    }

    /// Sends a request.
    ///
    /// # Errors
    /// When no reply can be read.
    pub fn send(&self, request: &Request) -> anyhow::Result<Reply> {
        request.send(self.address)
    }

    /// GET.
    ///
    /// # Errors
    /// When no reply can be read.
    pub fn get(&self, path: &str) -> anyhow::Result<Reply> {
        self.send(&Request::new("GET", path))
    }

    /// POST of JSON.
    ///
    /// # Errors
    /// When no reply can be read.
    pub fn post(&self, path: &str, body: &serde_json::Value) -> anyhow::Result<Reply> {
        self.send(&Request::new("POST", path).json(body))
    }

    /// Value of a metric: the sum over its labels, or one series if labels are given.
    ///
    /// # Errors
    /// When no reply can be read.
    pub fn metric(&self, name: &str) -> anyhow::Result<f64> {
        let text = self.get("/metrics")?.text();
        let lines = text.lines().filter(|line| {
            line.strip_prefix(name).is_some_and(|rest| rest.starts_with('{') || rest.starts_with(' '))
        });
        Ok(lines.filter_map(|line| line.rsplit(' ').next()?.parse::<f64>().ok()).sum())
    }

    /// Memory that the server holds, bytes (Linux).
    ///
    /// # Errors
    /// If it has ended, or the system does not report it.
    pub fn memory(&self) -> anyhow::Result<u64> {
        self.status_bytes("VmRSS:")
    }

    /// Peak memory of the server so far, bytes (Linux).
    ///
    /// # Errors
    /// If it has ended, or the system does not report it.
    pub fn peak_memory(&self) -> anyhow::Result<u64> {
        self.status_bytes("VmHWM:")
    }

    fn status_bytes(&self, name: &str) -> anyhow::Result<u64> {
        let status = std::fs::read_to_string(format!("/proc/{}/status", self.pid()))?;
        let line = status.lines().find_map(|line| line.strip_prefix(name)).context("no such size")?;
        let kib: u64 = line.trim().trim_end_matches(" kB").parse()?;
        Ok(kib << 10)
    }

    /// Core time that the server has used, seconds (Linux); other work on the machine does not matter.
    ///
    /// # Errors
    /// If it has ended, or the system does not report it.
    pub fn core_s(&self) -> anyhow::Result<f64> {
        let stat = std::fs::read_to_string(format!("/proc/{}/stat", self.pid()))?;
        let (_, fields) = stat.rsplit_once(')').context("no fields")?;
        let mut fields = fields.split_whitespace().skip(11).map(str::parse::<f64>);
        let mut next = || fields.next().context("no field")?.context("no number");
        Ok((next()? + next()?) / TICKS)
    }

    /// Whether the server runs.
    pub fn is_up(&mut self) -> bool {
        matches!(self.child.try_wait(), Ok(None))
    }

    /// The log of the server, if it was started with one.
    ///
    /// # Errors
    /// If it has none.
    pub fn log(&self) -> anyhow::Result<String> {
        let folder = self.folder.as_ref().context("no folder")?;
        Ok(std::fs::read_to_string(folder.path().join("log"))?)
    }

    /// Process id.
    pub fn pid(&self) -> u32 {
        self.child.id()
    }

    /// Kills the server at once, as a power cut would.
    ///
    /// # Errors
    /// When it has already ended.
    pub fn kill(mut self) -> anyhow::Result<()> {
        self.child.kill()?;
        self.child.wait()?;
        Ok(())
    }

    /// Requests a stop and waits for the end: exit code and time taken.
    ///
    /// # Errors
    /// When the signal cannot be sent.
    pub fn stop(mut self) -> anyhow::Result<(Option<i32>, Duration)> {
        let began = Instant::now();
        let sent = Command::new("kill").args(["-TERM", &self.pid().to_string()]).status()?;
        ensure!(sent.success(), "kill failed");
        let status = self.child.wait()?;
        Ok((status.code(), began.elapsed()))
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// Peak resident memory of a process, where the system reports it.
pub fn peak_memory_mb(process: &str) -> Option<u64> {
    let status = std::fs::read_to_string(format!("/proc/{process}/status")).ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    Some(line.trim().strip_suffix(" kB")?.parse::<u64>().ok()? / 1024)
}
