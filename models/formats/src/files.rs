//! Files on disk: each appears completely or not at all, and only plain files are replaced.

use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Partial files of this process, for [`abandon`].
static UNDER_WAY: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

fn under_way() -> MutexGuard<'static, Vec<PathBuf>> {
    UNDER_WAY.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Removes partial files of this process before it ends.
pub fn abandon() {
    for path in under_way().drain(..) {
        discard(&path);
    }
}

/// A failure means that the file is already gone or cannot be removed; neither can be handled here.
fn discard(partial: &Path) {
    let is_folder = fs::symlink_metadata(partial).is_ok_and(|found| found.is_dir());
    let _ = if is_folder { fs::remove_dir_all(partial) } else { fs::remove_file(partial) };
}

/// A file or folder under a temporary name beside its own until it is complete. It is removed unless it was
/// put in place.
struct Partial {
    path: PathBuf,
    in_place: bool,
}

impl Partial {
    /// The temporary name beside a target.
    fn beside(target: &Path) -> PathBuf {
        let name = target.file_name().unwrap_or_default().to_string_lossy();
        target.with_file_name(format!(".{name}.{}.tmp", std::process::id()))
    }

    fn of(path: PathBuf) -> Self {
        under_way().push(path.clone());
        Self { path, in_place: false }
    }

    fn put(mut self, target: &Path) -> io::Result<()> {
        fs::rename(&self.path, target)?;
        self.in_place = true;
        Ok(())
    }
}

impl Drop for Partial {
    fn drop(&mut self) {
        if !self.in_place {
            discard(&self.path);
        }
        under_way().retain(|path| *path != self.path);
    }
}

/// A folder being filled. It appears under its name, with all its files on the disk, once
/// [`WholeFolder::finish`] has succeeded.
pub struct WholeFolder {
    target: PathBuf,
    partial: Partial,
}

impl WholeFolder {
    /// Begins a folder that does not exist yet; missing parents are made.
    ///
    /// # Errors
    /// `AlreadyExists` when the name is taken, or another process fills the folder; when it cannot be made.
    pub fn create(path: &Path) -> io::Result<Self> {
        if fs::symlink_metadata(path).is_ok() {
            return Err(io::ErrorKind::AlreadyExists.into());
        }
        path.file_name().ok_or(io::ErrorKind::InvalidInput)?;
        if let Some(above) = path.parent().filter(|above| !above.as_os_str().is_empty()) {
            fs::create_dir_all(above)?;
        }
        let partial = Partial::beside(path);
        fs::create_dir(&partial)?;
        Ok(Self { target: path.to_path_buf(), partial: Partial::of(partial) })
    }

    /// Writes a new file of this name.
    ///
    /// # Errors
    /// When it exists already, or cannot be written.
    pub fn add(&self, name: &str, bytes: &[u8]) -> io::Result<()> {
        let mut file = File::create_new(self.partial.path.join(name))?;
        file.write_all(bytes)?;
        file.sync_all()
    }

    /// Puts the folder in place.
    ///
    /// # Errors
    /// When the name was taken in the meantime, or the disk refuses.
    pub fn finish(self) -> io::Result<()> {
        if cfg!(unix) {
            File::open(&self.partial.path)?.sync_all()?;
        }
        if fs::symlink_metadata(&self.target).is_ok() {
            return Err(io::ErrorKind::AlreadyExists.into());
        }
        self.partial.put(&self.target)?;
        let above = self.target.parent().filter(|above| !above.as_os_str().is_empty());
        if cfg!(unix) { File::open(above.unwrap_or(Path::new(".")))?.sync_all() } else { Ok(()) }
    }
}

/// Whether writing would replace something. Devices and pipes accept what is written and lose nothing.
pub fn would_replace(path: &Path) -> bool {
    fs::metadata(path).is_ok_and(|found| found.is_file() || found.is_dir())
}

/// A file being written. It appears under its name, or replaces the old file, once [`Whole::finish`] has
/// succeeded. A link is followed; a device or a pipe is written directly.
pub struct Whole {
    target: PathBuf,
    /// `None` if there is nothing to put in place.
    partial: Option<Partial>,
    file: BufWriter<File>,
}

impl Whole {
    /// Begins a file; missing folders are made.
    ///
    /// # Errors
    /// When it cannot be created.
    pub fn create(path: &Path) -> io::Result<Self> {
        let target = fs::canonicalize(path).unwrap_or_else(|_| path.to_path_buf());
        let found = fs::metadata(&target);
        // A dangling link is followed by opening it.
        let dangling = found.is_err() && fs::symlink_metadata(path).is_ok();
        if dangling || found.as_ref().is_ok_and(|found| !found.is_file()) {
            let file = File::options().write(true).create(dangling).truncate(dangling).open(path)?;
            return Ok(Self { target, partial: None, file: BufWriter::new(file) });
        }
        if let Some(folder) = target.parent().filter(|folder| !folder.as_os_str().is_empty()) {
            fs::create_dir_all(folder)?;
        }
        let partial = Partial::of(Partial::beside(&target));
        let file = File::create(&partial.path)?;
        if let Ok(found) = found {
            file.set_permissions(found.permissions())?;
        }
        Ok(Self { target, partial: Some(partial), file: BufWriter::new(file) })
    }

    /// Path of the unfinished file, for callers that write to it by name; `None` for a device or a pipe.
    pub fn partial(&self) -> Option<&Path> {
        self.partial.as_ref().map(|partial| partial.path.as_path())
    }

    /// Puts the file in place.
    ///
    /// # Errors
    /// When the written bytes cannot be kept; the old file is then unchanged.
    pub fn finish(mut self) -> io::Result<()> {
        self.file.flush()?;
        let Some(partial) = self.partial else { return Ok(()) };
        self.file.get_ref().sync_all()?;
        partial.put(&self.target)
    }
}

impl Write for Whole {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.file.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

/// Writes a file completely or not at all.
///
/// # Errors
/// When it cannot be written; the old file is then unchanged.
pub fn replace(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let mut file = Whole::create(path)?;
    file.write_all(bytes)?;
    file.finish()
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;
    use std::os::unix::fs::{FileTypeExt, PermissionsExt, symlink};

    #[test]
    fn links_are_followed_and_devices_stay() {
        let folder = tempfile::tempdir().unwrap();
        let (file, link) = (folder.path().join("file"), folder.path().join("link"));
        fs::write(&file, "old").unwrap();
        fs::set_permissions(&file, fs::Permissions::from_mode(0o600)).unwrap();
        symlink(&file, &link).unwrap();
        replace(&link, b"new").unwrap();
        assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
        assert_eq!(fs::read(&file).unwrap(), b"new");
        assert_eq!(fs::metadata(&file).unwrap().permissions().mode() & 0o777, 0o600);
        let nowhere = folder.path().join("nowhere");
        symlink(folder.path().join("made"), &nowhere).unwrap();
        replace(&nowhere, b"new").unwrap();
        assert!(fs::symlink_metadata(&nowhere).unwrap().is_symlink());
        assert_eq!(fs::read(folder.path().join("made")).unwrap(), b"new");
        replace(Path::new("/dev/null"), b"new").unwrap();
        assert!(fs::metadata("/dev/null").unwrap().file_type().is_char_device());
        assert!(!would_replace(Path::new("/dev/null")) && would_replace(&file));
    }

    #[test]
    fn a_folder_appears_when_it_is_whole() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("above/scenes");
        let names = || {
            let names = fs::read_dir(folder.path().join("above")).unwrap();
            names.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect::<Vec<_>>()
        };
        let half = WholeFolder::create(&path).unwrap();
        half.add("a", b"1").unwrap();
        assert_eq!(half.add("a", b"2").unwrap_err().kind(), io::ErrorKind::AlreadyExists);
        assert!(!path.exists());
        drop(half);
        assert!(names().is_empty());
        let whole = WholeFolder::create(&path).unwrap();
        whole.add("a", b"1").unwrap();
        whole.finish().unwrap();
        assert_eq!((names(), fs::read(path.join("a")).unwrap()), (vec!["scenes".to_owned()], b"1".to_vec()));
        let refused = WholeFolder::create(&path).err().map(|error| error.kind());
        assert_eq!(refused, Some(io::ErrorKind::AlreadyExists));
    }

    #[test]
    fn half_a_file_is_none() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("deep/file");
        let mut half = Whole::create(&path).unwrap();
        half.write_all(b"half").unwrap();
        let listed = || fs::read_dir(folder.path().join("deep")).unwrap().count();
        assert_eq!((listed(), path.exists()), (1, false));
        drop(half);
        assert_eq!(listed(), 0);
        replace(&path, b"whole").unwrap();
        assert_eq!((listed(), fs::read(&path).unwrap()), (1, b"whole".to_vec()));
        assert!(replace(folder.path(), b"a folder").is_err());
    }
}
