//! The audit log: who changed which scene, and who was refused. One JSON object per line.

use axum::http::{HeaderMap, Method, StatusCode, header};
use serde::Serialize;
use std::fs::{File, OpenOptions};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};

/// Limit of lines that wait for the disk; further lines are lost, which is logged.
const WAITING: usize = 4_096;
/// Number of older files that are kept besides the current one.
const OLD_FILES: u32 = 5;
/// Name that means standard output.
const STDOUT: &str = "-";

/// One line.
#[derive(Debug, Serialize)]
pub struct AuditLine<'a> {
    /// Time, RFC 3339.
    pub time: String,
    /// Name of the token, or of the user that a trusted proxy authenticated.
    pub who: Option<&'a str>,
    /// Address of the client.
    pub from: String,
    /// Method and route.
    pub what: String,
    /// Id of the scene in the address, or of the new one.
    pub scene: Option<&'a str>,
    /// HTTP status.
    pub status: u16,
    /// Request id, as in the access log.
    pub request_id: &'a str,
}

type LineSink = Box<dyn FnMut(&[u8]) -> io::Result<()> + Send>;

/// Queue of lines to the log's thread.
#[derive(Debug)]
pub struct AuditLog(SyncSender<Vec<u8>>);

impl AuditLog {
    /// A log to a file of at most `most` bytes, with older ones beside it, or to standard output (`-`).
    ///
    /// # Errors
    /// When the file cannot be opened.
    pub fn open(target: &str, most: u64) -> io::Result<Self> {
        let (sender, lines) = sync_channel(WAITING);
        let sink: LineSink = if target == STDOUT {
            Box::new(|line| {
                let mut out = io::stdout().lock();
                out.write_all(line).and_then(|()| out.flush())
            })
        } else {
            let mut file = RotatedFile::open(Path::new(target), most)?;
            Box::new(move |line| file.append(line))
        };
        std::thread::Builder::new().name("audit".into()).spawn(move || write_all(&lines, sink))?;
        Ok(Self(sender))
    }

    /// Adds a line.
    pub fn add(&self, line: &AuditLine<'_>) {
        let mut text = serde_json::to_vec(line).unwrap_or_default();
        text.push(b'\n');
        if self.0.try_send(text).is_err() {
            tracing::error!(?line, "a line of the audit log is lost: the disk is too slow");
        }
    }
}

fn write_all(lines: &Receiver<Vec<u8>>, mut sink: impl FnMut(&[u8]) -> io::Result<()>) {
    for line in lines {
        if let Err(error) = sink(&line) {
            tracing::error!(%error, line = %String::from_utf8_lossy(&line).trim_end(), "audit log");
        }
    }
}

/// Whether a reply is always logged: changes of scenes, and refusals for lack of a token or a right.
pub fn is_audited(method: &Method, edits: bool, status: StatusCode) -> bool {
    let refused = matches!(status, StatusCode::UNAUTHORIZED | StatusCode::FORBIDDEN);
    refused || edits && *method != Method::GET
}

/// Id of the scene in an address such as `/v1/scenes/ID/duplicate`.
pub fn scene_in(path: &str) -> Option<&str> {
    path.rsplit_once("/v1/scenes/").map(|(_, rest)| rest.split('/').next().unwrap_or(rest))
}

/// Id of the new scene in a reply.
pub fn scene_made(headers: &HeaderMap) -> Option<&str> {
    scene_in(headers.get(header::LOCATION)?.to_str().ok()?)
}

/// A file that is rotated when it is full.
struct RotatedFile {
    path: PathBuf,
    most: u64,
    file: File,
    bytes: u64,
}

impl RotatedFile {
    fn open(path: &Path, most: u64) -> io::Result<Self> {
        let mut options = OpenOptions::new();
        options.create(true).append(true);
        #[cfg(unix)]
        std::os::unix::fs::OpenOptionsExt::mode(&mut options, 0o600);
        let file = options.open(path)?;
        let bytes = file.metadata()?.len();
        Ok(Self { path: path.to_owned(), most, file, bytes })
    }

    fn append(&mut self, line: &[u8]) -> io::Result<()> {
        if self.bytes > 0 && self.bytes + line.len() as u64 > self.most {
            let numbered = |n: u32| PathBuf::from(format!("{}.{n}", self.path.display()));
            for n in (1..OLD_FILES).rev() {
                // There may be fewer of them.
                let _ = std::fs::rename(numbered(n), numbered(n + 1));
            }
            std::fs::rename(&self.path, numbered(1))?;
            *self = Self::open(&self.path, self.most)?;
        }
        self.file.write_all(line)?;
        self.bytes += line.len() as u64;
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_full_file_makes_way_and_the_oldest_goes() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("audit.log");
        let mut file = RotatedFile::open(&path, 10).unwrap();
        for i in 0..8 {
            file.append(format!("line {i}\n").as_bytes()).unwrap();
        }
        let read = |name: &str| std::fs::read_to_string(folder.path().join(name)).ok();
        assert_eq!(read("audit.log").as_deref(), Some("line 7\n"));
        assert_eq!(read("audit.log.1").as_deref(), Some("line 6\n"));
        assert_eq!(read("audit.log.5").as_deref(), Some("line 2\n"));
        assert_eq!(read("audit.log.6"), None);
        // An existing file is continued.
        drop(file);
        RotatedFile::open(&path, 100).unwrap().append(b"line 8\n").unwrap();
        assert_eq!(read("audit.log").as_deref(), Some("line 7\nline 8\n"));
    }

    #[test]
    fn scenes_are_named_by_addresses() {
        assert_eq!(scene_in("/tools/v1/scenes/a-1/duplicate"), Some("a-1"));
        assert_eq!((scene_in("/v1/scenes"), scene_in("/v1/info")), (None, None));
    }
}
