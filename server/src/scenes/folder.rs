//! The data folder: its files are read by a thread of its own, below a handle of the folder.
//!
//! A file that hangs, such as one of a network share that is gone, holds up the folder alone. A name that leads out
//! of the folder, or to a pipe or device, is not opened.

use api::{Code, Problem};
use std::fs::File;
use std::io::{self, Read};
use std::path::{Path, PathBuf};
use std::sync::mpsc;
use std::time::{Duration, SystemTime};
use tokio::sync::oneshot;

/// Largest file taken from it.
const MOST_BYTES: u64 = 256 << 20;
/// Files that wait to be read.
const WAITING: usize = 32;
/// Time for a file to be read, and for the folder to answer.
const PATIENCE: Duration = Duration::from_secs(10);
const ANSWER: Duration = Duration::from_secs(2);

type Task = Box<dyn FnOnce(&DataFolder) + Send>;

/// The folder, for any thread.
#[derive(Clone)]
pub struct FolderReader(mpsc::SyncSender<Task>);

impl FolderReader {
    /// Opens a folder, and starts the thread that reads it.
    ///
    /// # Errors
    /// When it cannot be opened, or the system gives no thread.
    pub fn start(path: &Path) -> io::Result<Self> {
        let folder = DataFolder::open(path)?;
        let (tasks, waiting) = mpsc::sync_channel::<Task>(WAITING);
        let work = move || waiting.into_iter().for_each(|task| task(&folder));
        std::thread::Builder::new().name("data-folder".into()).spawn(work)?;
        Ok(Self(tasks))
    }

    /// Has the thread do something, for so long at most.
    async fn ask<T: Send + 'static>(
        &self,
        patience: Duration,
        task: impl FnOnce(&DataFolder) -> T + Send + 'static,
    ) -> Option<T> {
        let (reply, done) = oneshot::channel();
        let task: Task = Box::new(move |folder| {
            // A caller that left does not want the answer any more.
            if !reply.is_closed() {
                let _ = reply.send(task(folder));
            }
        });
        self.0.try_send(task).ok()?;
        tokio::time::timeout(patience, done).await.ok()?.ok()
    }

    /// The bytes of a file of the folder, by its name there; an error says why it is none.
    ///
    /// # Errors
    /// `store-unavailable` when the folder does not answer.
    pub async fn read(&self, name: PathBuf) -> Result<io::Result<Vec<u8>>, Problem> {
        let silent = || {
            let detail = "The data folder does not answer.";
            Problem::new(Code::StoreUnavailable, detail).retry_after(5)
        };
        self.ask(PATIENCE, move |folder| folder.read(&name)).await.ok_or_else(silent)
    }

    /// True if the thread is not held up.
    pub async fn answers(&self) -> bool {
        self.ask(ANSWER, |_| ()).await.is_some()
    }
}

/// A folder with its handle.
pub struct DataFolder {
    #[cfg(not(target_os = "linux"))]
    path: PathBuf,
    #[cfg(target_os = "linux")]
    handle: rustix::fd::OwnedFd,
}

impl DataFolder {
    /// Opens a folder.
    ///
    /// # Errors
    /// When it is none, or may not be read.
    #[cfg(target_os = "linux")]
    pub fn open(path: &Path) -> io::Result<Self> {
        use rustix::fs::{Mode, OFlags, open};
        let flags = OFlags::DIRECTORY | OFlags::RDONLY | OFlags::CLOEXEC;
        Ok(Self { handle: open(path, flags, Mode::empty())? })
    }

    /// Opens a folder.
    ///
    /// # Errors
    /// When it is none, or may not be read.
    #[cfg(not(target_os = "linux"))]
    pub fn open(path: &Path) -> io::Result<Self> {
        std::fs::read_dir(path)?;
        Ok(Self { path: path.canonicalize()? })
    }

    /// Names of its entries, sorted.
    ///
    /// # Errors
    /// When it cannot be read.
    #[cfg(target_os = "linux")]
    pub fn names(&self) -> io::Result<Vec<PathBuf>> {
        use std::os::unix::ffi::OsStrExt;
        let name = |entry: rustix::fs::DirEntry| {
            PathBuf::from(std::ffi::OsStr::from_bytes(entry.file_name().to_bytes()))
        };
        let entries = rustix::fs::Dir::read_from(&self.handle)?.filter_map(Result::ok).map(name);
        // Of the folder itself and the one above.
        let mut names: Vec<PathBuf> =
            entries.filter(|name| name.file_name().is_some() && name != Path::new(".")).collect();
        names.sort();
        Ok(names)
    }

    /// Names of its entries, sorted.
    ///
    /// # Errors
    /// When it cannot be read.
    #[cfg(not(target_os = "linux"))]
    pub fn names(&self) -> io::Result<Vec<PathBuf>> {
        let mut names: Vec<PathBuf> =
            std::fs::read_dir(&self.path)?.flatten().map(|entry| entry.file_name().into()).collect();
        names.sort();
        Ok(names)
    }

    /// When a file was last changed, where the system says it.
    pub fn modified(&self, name: &Path) -> Option<SystemTime> {
        self.file(name).and_then(|file| file.metadata()?.modified()).ok()
    }

    /// The bytes of a file, whatever its name leads to now.
    ///
    /// # Errors
    /// When there is none below the folder, it is no plain file, or too large.
    pub fn read(&self, name: &Path) -> io::Result<Vec<u8>> {
        let file = self.file(name)?;
        if !file.metadata()?.is_file() {
            return Err(io::Error::other("no plain file"));
        }
        let mut bytes = Vec::new();
        file.take(MOST_BYTES + 1).read_to_end(&mut bytes)?;
        if bytes.len() as u64 > MOST_BYTES {
            return Err(io::Error::other(format!("larger than {MOST_BYTES} bytes")));
        }
        Ok(bytes)
    }

    /// Links are followed inside the folder; a pipe is opened without waiting for its other end.
    #[cfg(target_os = "linux")]
    fn file(&self, name: &Path) -> io::Result<File> {
        use rustix::fs::{Mode, OFlags, ResolveFlags, openat, openat2};
        let flags = OFlags::RDONLY | OFlags::CLOEXEC | OFlags::NONBLOCK | OFlags::NOCTTY;
        let resolve = ResolveFlags::BENEATH | ResolveFlags::NO_MAGICLINKS;
        let opened = openat2(&self.handle, name, flags, Mode::empty(), resolve);
        // Older systems cannot follow links safely.
        let opened = match opened {
            Err(rustix::io::Errno::NOSYS) => {
                if name.components().count() != 1 || name.file_name().is_none() {
                    return Err(io::Error::other("no file of the folder itself"));
                }
                openat(&self.handle, name, flags | OFlags::NOFOLLOW, Mode::empty())
            }
            opened => opened,
        };
        Ok(File::from(opened?))
    }

    #[cfg(not(target_os = "linux"))]
    fn file(&self, name: &Path) -> io::Result<File> {
        let real = self.path.join(name).canonicalize()?;
        if !real.starts_with(&self.path) || !real.metadata()?.is_file() {
            return Err(io::Error::other("no plain file of the folder"));
        }
        File::open(real)
    }
}

#[cfg(all(test, target_os = "linux"))]
mod tests {
    use super::{DataFolder, FolderReader};
    use std::path::Path;

    #[test]
    fn only_plain_files_below_the_folder_are_read() {
        let (outside, folder) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
        let at = |name: &str| folder.path().join(name);
        std::fs::create_dir(at("inner")).unwrap();
        std::fs::write(at("inner/a"), "inside").unwrap();
        std::fs::write(outside.path().join("a"), "outside").unwrap();
        let link = |to: &Path, name: &str| std::os::unix::fs::symlink(to, at(name)).unwrap();
        link(Path::new("inner/a"), "beneath");
        link(&outside.path().join("a"), "out");
        link(Path::new("../"), "up");
        link(Path::new("/proc/self/fd/0"), "magic");
        let made = std::process::Command::new("mkfifo").arg(at("pipe")).status().unwrap();
        assert!(made.success());
        let opened = DataFolder::open(folder.path()).unwrap();
        let read =
            |name: &str| opened.read(Path::new(name)).ok().map(|bytes| String::from_utf8(bytes).unwrap());
        assert_eq!(read("inner/a").as_deref(), Some("inside"));
        assert_eq!(read("beneath").as_deref(), Some("inside"));
        for name in ["out", "up", "magic", "pipe", "inner", "none", "../x", "/etc/hostname"] {
            assert_eq!(read(name), None, "{name}");
        }
        assert_eq!(opened.names().unwrap().len(), 6);
    }

    #[tokio::test]
    async fn a_folder_that_hangs_is_known_to() {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("a"), "x").unwrap();
        let reader = FolderReader::start(folder.path()).unwrap();
        assert_eq!(reader.read("a".into()).await.unwrap().unwrap(), b"x");
        assert!(reader.answers().await);
        let (release, held) = std::sync::mpsc::channel::<()>();
        let hangs = reader.clone();
        let task =
            tokio::spawn(async move { hangs.ask(super::PATIENCE, move |_| held.recv().is_err()).await });
        tokio::time::sleep(std::time::Duration::from_millis(50)).await;
        assert!(!reader.answers().await);
        drop(release);
        assert_eq!(task.await.unwrap(), Some(true));
        assert!(reader.answers().await);
    }
}
