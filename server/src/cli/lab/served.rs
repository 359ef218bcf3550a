//! This program as a server under test, and a simple client that measures time.

use super::failed;
use crate::cli::{Common, Failure};
use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::path::PathBuf;
use std::process::{Child, Command, Stdio};
use std::time::Instant;

/// Number of polls, 0.1 s apart, until a server must be ready.
const TRIES: usize = 300;

/// Accept header for a reply in one piece.
pub const JSON: &str = "application/json";
/// Accept header for a reply of single events.
pub const NDJSON: &str = "application/x-ndjson";

/// This program as a server, with an empty store.
pub struct Served {
    child: Child,
    /// Port on which it listens.
    pub port: u16,
    folder: PathBuf,
}

impl Served {
    /// Starts the server and waits until it is ready.
    pub fn start(common: &Common) -> Result<Self, Failure> {
        let folder = std::env::temp_dir().join(format!("dragtraffic-bench-{}", std::process::id()));
        std::fs::create_dir_all(&folder)?;
        let mut command = Command::new(std::env::current_exe()?);
        command.args(["serve", "--quiet", "--port", "0", "--db"]).arg(folder.join("scenes.sqlite"));
        if let Some(weights) = &common.weights {
            command.arg("--weights").arg(weights);
        }
        let child = command.stdin(Stdio::null()).stdout(Stdio::piped()).spawn()?;
        let mut served = Self { child, port: 0, folder };
        let mut line = String::new();
        BufReader::new(served.child.stdout.take().ok_or_else(|| failed(Silent))?).read_line(&mut line)?;
        let port = line.trim().trim_end_matches('/').rsplit(':').next().and_then(|port| port.parse().ok());
        served.port = port.ok_or_else(|| failed(Silent))?;
        for _ in 0..TRIES {
            let ready = Connection::open(served.port)?.send("GET", "/readyz", JSON, b"")?;
            if ready.status == 200 {
                return Ok(served);
            }
            std::thread::sleep(std::time::Duration::from_millis(100));
        }
        Err(failed(Silent))
    }
}

impl Served {
    /// Current memory, MB; `None` where the system does not report it.
    pub fn memory_mb(&self) -> Option<f64> {
        let status = std::fs::read_to_string(format!("/proc/{}/status", self.child.id())).ok()?;
        let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:"))?;
        line.trim().strip_suffix(" kB")?.parse::<f64>().ok().map(|kb| kb / 1024.0)
    }
}

impl Drop for Served {
    fn drop(&mut self) {
        // Remaining files are in the system's temporary folder.
        let _ = self.child.kill().and_then(|()| self.child.wait());
        let _ = std::fs::remove_dir_all(&self.folder);
    }
}

#[derive(Debug, thiserror::Error)]
#[error("the server that was to be measured did not start")]
struct Silent;

#[derive(Debug, thiserror::Error)]
#[error("{path} answered {status}: {text}")]
struct Unexpected {
    path: String,
    status: u16,
    text: String,
}

/// One reply.
pub struct Timed {
    /// Status code.
    pub status: u16,
    /// Body without its transfer coding.
    pub body: Vec<u8>,
    /// Time from the first byte sent to the last byte read.
    pub ms: f64,
    /// Time to the first line with futures.
    pub first_ms: Option<f64>,
    /// Whether the server closes the connection after it.
    pub closes: bool,
}

/// One connection to the server.
pub struct Connection(BufReader<TcpStream>);

impl Connection {
    /// Opens a connection.
    pub fn open(port: u16) -> Result<Self, Failure> {
        let stream = TcpStream::connect(("127.0.0.1", port))?;
        stream.set_nodelay(true)?;
        Ok(Self(BufReader::new(stream)))
    }

    /// Posts JSON; any other status than success is a failure.
    pub fn post(&mut self, path: &str, accept: &str, body: &[u8]) -> Result<Timed, Failure> {
        let reply = self.send("POST", path, accept, body)?;
        if reply.status < 300 {
            return Ok(reply);
        }
        let text = String::from_utf8_lossy(&reply.body).chars().take(300).collect();
        Err(failed(Unexpected { path: path.into(), status: reply.status, text }))
    }

    /// Sends a request and reads its reply, whatever its status.
    pub fn send(&mut self, method: &str, path: &str, accept: &str, body: &[u8]) -> Result<Timed, Failure> {
        let began = Instant::now();
        let port = self.0.get_ref().peer_addr()?.port();
        let head = format!(
            "{method} {path} HTTP/1.1\r\nhost: 127.0.0.1:{port}\r\naccept: {accept}\r\n\
             content-type: application/json\r\ncontent-length: {}\r\n\r\n",
            body.len()
        );
        self.0.get_mut().write_all(&[head.as_bytes(), body].concat())?;
        let status = self.line()?.split(' ').nth(1).and_then(|s| s.parse().ok()).unwrap_or(0);
        let (mut length, mut chunked, mut closes) = (0, false, false);
        loop {
            let line = self.line()?.to_ascii_lowercase();
            match line.split_once(':').map(|(name, value)| (name, value.trim())) {
                Some(("content-length", value)) => length = value.parse().unwrap_or(0),
                Some(("transfer-encoding", _)) => chunked = true,
                Some(("connection", "close")) => closes = true,
                Some(_) => {}
                None => break,
            }
        }
        let (mut body, mut first_ms) = (Vec::new(), None);
        loop {
            if chunked {
                length = usize::from_str_radix(&self.line()?, 16).unwrap_or(0);
            }
            let from = body.len();
            body.resize(from + length, 0);
            self.0.read_exact(body.get_mut(from..).unwrap_or_default())?;
            if first_ms.is_none()
                && body.get(from..).is_some_and(|b| b.starts_with(b"{\"event\":\"initial\""))
            {
                first_ms = Some(began.elapsed().as_secs_f64() * 1e3);
            }
            if !chunked {
                break;
            }
            self.line()?;
            if length == 0 {
                break;
            }
        }
        Ok(Timed { status, body, ms: began.elapsed().as_secs_f64() * 1e3, first_ms, closes })
    }

    fn line(&mut self) -> Result<String, Failure> {
        let mut line = String::new();
        self.0.read_line(&mut line)?;
        Ok(line.trim_end().to_owned())
    }
}
