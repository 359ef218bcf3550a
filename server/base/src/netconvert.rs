//! SUMO's netconvert, if this machine has it.

use api::import::Companions;
use formats::netconvert::Netconvert;
use std::env;
use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom};
use std::path::PathBuf;
use std::process::{Command, Stdio};
use std::sync::Arc;
use std::thread::sleep;
use std::time::{Duration, Instant};

/// Environment variable with its path, if it is not on PATH.
const PLACE: &str = "DRAGTRAFFIC_NETCONVERT";
/// The name of the network that it writes.
const NETWORK: &str = "map.net.xml";
/// Time limit: a town of some kilometres takes a few seconds.
const TIME: Duration = Duration::from_secs(60);
/// Limits of its output, and of the stored messages, bytes.
const MOST_BYTES: u64 = 64 << 20;
const MOST_WORDS: u64 = 2_000;

/// The program, searched at each call, because it may be installed while the server runs.
#[derive(Clone, Copy, Debug)]
pub struct Installed;

/// `DRAGTRAFFIC_NETCONVERT`, else the one on the path, else the one of `SUMO_HOME`.
fn program() -> Option<PathBuf> {
    let name = format!("netconvert{}", env::consts::EXE_SUFFIX);
    let named = env::var_os(PLACE).map(PathBuf::from);
    let path = env::var_os("PATH").unwrap_or_default();
    let home = env::var_os("SUMO_HOME").map(|home| PathBuf::from(home).join("bin"));
    let folders = env::split_paths(&path).chain(home).map(|folder| folder.join(&name));
    named.into_iter().chain(folders).find(|path| path.is_file())
}

/// Companions of a file on this machine.
pub fn companions() -> Companions {
    Companions { netconvert: Some(Arc::new(Installed)), ..Companions::default() }
}

impl Netconvert for Installed {
    fn network(&self, name: &str, file: &[u8], arguments: &[String]) -> io::Result<Vec<u8>> {
        let program = program().ok_or(io::ErrorKind::NotFound)?;
        let folder = tempfile::tempdir()?;
        std::fs::write(folder.path().join(name), file)?;
        let mut said =
            File::options().read(true).write(true).create_new(true).open(folder.path().join("said.txt"))?;
        let mut child = Command::new(program)
            .args(arguments)
            .args(["--xml-validation", "never", "-o", NETWORK])
            .current_dir(folder.path())
            .stdin(Stdio::null())
            .stdout(Stdio::null())
            .stderr(said.try_clone()?)
            .spawn()?;
        let began = Instant::now();
        let written = || std::fs::metadata(folder.path().join(NETWORK)).map_or(0, |known| known.len());
        let status = loop {
            if let Some(status) = child.try_wait()? {
                break status;
            }
            if began.elapsed() > TIME || written() > MOST_BYTES {
                child.kill()?;
                child.wait()?;
                let text = "it takes too long for a map of this size; cut out less";
                return Err(io::Error::new(io::ErrorKind::TimedOut, text));
            }
            sleep(Duration::from_millis(10));
        };
        if !status.success() || written() == 0 {
            said.seek(SeekFrom::Start(0))?;
            let mut words = Vec::new();
            said.take(MOST_WORDS).read_to_end(&mut words)?;
            let words = String::from_utf8_lossy(&words);
            let last = words.lines().rfind(|line| line.starts_with("Error"));
            let text = last.or(words.lines().last()).unwrap_or("it ended without a word");
            return Err(io::Error::other(text.to_owned()));
        }
        let mut network = Vec::new();
        File::open(folder.path().join(NETWORK))?.take(MOST_BYTES).read_to_end(&mut network)?;
        Ok(network)
    }
}
