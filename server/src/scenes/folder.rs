//! The data folder: a separate thread reads its files, through a handle of the folder.
//!
//! A file that hangs, for example on a lost network share, blocks only this folder. A name that leads out of
//! the folder, or to a pipe or device, is not opened.

use api::{Code, Problem};
use base::folder::{DataFolder, HeldFile};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::mpsc;
use std::time::Duration;
use tokio::sync::oneshot;

/// Limit of files that wait to be read.
const WAITING: usize = 32;
/// Time limit for reading a file, and for the folder to answer.
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
    /// When the folder cannot be opened, or a thread cannot be started.
    pub fn start(path: &Path) -> io::Result<Self> {
        let folder = DataFolder::open(path)?;
        let (tasks, waiting) = mpsc::sync_channel::<Task>(WAITING);
        let work = move || waiting.into_iter().for_each(|task| task(&folder));
        std::thread::Builder::new().name("data-folder".into()).spawn(work)?;
        Ok(Self(tasks))
    }

    /// Runs a task on the thread, with a time limit.
    async fn ask<T: Send + 'static>(
        &self,
        patience: Duration,
        task: impl FnOnce(&DataFolder) -> T + Send + 'static,
    ) -> Option<T> {
        let (reply, done) = oneshot::channel();
        let task: Task = Box::new(move |folder| {
            // A caller that left no longer needs the reply.
            if !reply.is_closed() {
                let _ = reply.send(task(folder));
            }
        });
        self.0.try_send(task).ok()?;
        tokio::time::timeout(patience, done).await.ok()?.ok()
    }

    /// A file of the folder by its name, with the files that are read with it; the inner error says why it
    /// cannot be read, such as more than `most` bytes.
    ///
    /// # Errors
    /// `store-unavailable` when the folder does not answer.
    pub async fn read(&self, name: PathBuf, most: u64) -> Result<io::Result<HeldFile>, Problem> {
        let silent = || {
            let detail = "The data folder does not answer.";
            Problem::new(Code::StoreUnavailable, detail).retry_after(5)
        };
        self.ask(PATIENCE, move |folder| folder.read(&name, most)).await.ok_or_else(silent)
    }

    /// Whether the thread is responsive.
    pub async fn answers(&self) -> bool {
        self.ask(ANSWER, |_| ()).await.is_some()
    }
}

#[cfg(all(test, target_os = "linux"))]
mod tests {
    use super::FolderReader;

    #[tokio::test]
    async fn a_folder_that_hangs_is_known_to() {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("a"), "x").unwrap();
        let reader = FolderReader::start(folder.path()).unwrap();
        assert_eq!(reader.read("a".into(), 1).await.unwrap().unwrap().bytes, b"x");
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
