//! Files that several processes put into one folder: each appears complete, under its name, and is never
//! replaced.
//!
//! There is no lock. Equal work gives equal bytes, so a process that comes second finds its own bytes there.

use std::fs::{self, File};
use std::io::{self, ErrorKind, Write};
use std::path::{Path, PathBuf};

/// Result of an attempt to create a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Creation {
    /// It was created.
    New,
    /// It existed with the same bytes.
    Equal,
    /// It existed with other bytes, and is unchanged.
    Different,
}

/// Number of names that are tried for a partial file.
const TRIES: usize = 1_000;

/// Creates a file with these bytes if its name is free. The bytes are on the disk before the name is. A
/// killed process leaves nothing behind if the file system supports unnamed files (`O_TMPFILE`); otherwise it
/// may leave a partial file, which [`sweep`] removes. Missing folders are made.
///
/// # Errors
/// When it cannot be written.
pub fn create(path: &Path, bytes: &[u8]) -> io::Result<Creation> {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    fs::create_dir_all(folder)?;
    let put = match unnamed(folder, path, bytes) {
        Err(error) if lacks_support(&error) => by_link(folder, path, bytes),
        result => result,
    };
    match put {
        Ok(()) => {
            File::open(folder)?.sync_all()?;
            Ok(Creation::New)
        }
        // If another process swept the partial file away, the name was already taken.
        Err(error) if matches!(error.kind(), ErrorKind::AlreadyExists | ErrorKind::NotFound) => {
            let equal = fs::read(path)? == bytes;
            Ok(if equal { Creation::Equal } else { Creation::Different })
        }
        Err(error) => Err(error),
    }
}

/// Creates the file through an unnamed file, which gets its name once it is complete.
#[cfg(target_os = "linux")]
fn unnamed(folder: &Path, path: &Path, bytes: &[u8]) -> io::Result<()> {
    use rustix::fs::{AtFlags, CWD, Mode, OFlags, linkat, open};
    use std::os::fd::AsRawFd;

    let mode = Mode::from_raw_mode(0o666);
    let file = open(folder, OFlags::TMPFILE | OFlags::WRONLY | OFlags::CLOEXEC, mode)?;
    let mut file = File::from(file);
    file.write_all(bytes)?;
    file.sync_all()?;
    let own = format!("/proc/self/fd/{}", file.as_raw_fd());
    linkat(CWD, own, CWD, path, AtFlags::SYMLINK_FOLLOW)?;
    Ok(())
}

#[cfg(not(target_os = "linux"))]
fn unnamed(_: &Path, _: &Path, _: &[u8]) -> io::Result<()> {
    Err(ErrorKind::Unsupported.into())
}

/// Whether the file system or the system lacks unnamed files. A kernel that does not know them opens the
/// folder.
fn lacks_support(error: &io::Error) -> bool {
    matches!(error.kind(), ErrorKind::Unsupported | ErrorKind::IsADirectory | ErrorKind::InvalidInput)
        || error.kind() == ErrorKind::NotFound && !Path::new("/proc/self/fd").exists()
}

/// Creates the file through a partial file with its own name.
fn by_link(folder: &Path, path: &Path, bytes: &[u8]) -> io::Result<()> {
    let (partial, mut file) = partial(folder, path)?;
    let written = file.write_all(bytes).and_then(|()| file.sync_all());
    let linked = written.and_then(|()| fs::hard_link(&partial, path));
    match fs::remove_file(&partial) {
        Err(error) if error.kind() != ErrorKind::NotFound && linked.is_ok() => Err(error),
        _ => linked,
    }
}

fn partial(folder: &Path, path: &Path) -> io::Result<(PathBuf, File)> {
    let (name, process) = (path.file_name().unwrap_or_default().to_string_lossy(), std::process::id());
    // Processes of two machines may have the same number.
    for number in 0..TRIES {
        let partial = folder.join(format!(".{name}.{process}-{number}{PARTIAL}"));
        match File::options().write(true).create_new(true).open(&partial) {
            Err(error) if error.kind() == ErrorKind::AlreadyExists => {}
            result => return Ok((partial, result?)),
        }
    }
    Err(io::Error::new(
        ErrorKind::AlreadyExists,
        format!("{TRIES} partial files of {name} are there already"),
    ))
}

/// Suffix of the name of a partial file.
const PARTIAL: &str = ".tmp";

/// Removes the partial files of a folder whose final file exists: they are useless.
///
/// # Errors
/// When the folder cannot be read.
pub fn sweep(folder: &Path) -> io::Result<()> {
    for entry in fs::read_dir(folder)? {
        let name = entry?.file_name();
        let name = name.to_string_lossy();
        let whole = name.strip_prefix('.').and_then(|rest| rest.strip_suffix(PARTIAL)?.rsplit_once('.'));
        if whole.is_some_and(|(whole, _)| folder.join(whole).exists()) {
            // Another process may sweep at the same time.
            let _ = fs::remove_file(folder.join(&*name));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(folder: &Path) -> Vec<String> {
        let entries = fs::read_dir(folder).unwrap();
        let mut names: Vec<String> =
            entries.map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned()).collect();
        names.sort();
        names
    }

    #[test]
    fn a_file_is_created_once_and_never_replaced() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("deep/a.parquet");
        assert_eq!(create(&path, b"one").unwrap(), Creation::New);
        assert_eq!(create(&path, b"one").unwrap(), Creation::Equal);
        assert_eq!(create(&path, b"two").unwrap(), Creation::Different);
        assert_eq!(
            (fs::read(&path).unwrap(), names(path.parent().unwrap())),
            (b"one".to_vec(), vec!["a.parquet".to_owned()])
        );
    }

    #[test]
    fn without_files_that_have_no_name_the_same_holds() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a");
        by_link(folder.path(), &path, b"one").unwrap();
        let again = by_link(folder.path(), &path, b"two").unwrap_err();
        assert_eq!(again.kind(), ErrorKind::AlreadyExists);
        assert_eq!((fs::read(&path).unwrap(), names(folder.path())), (b"one".to_vec(), vec!["a".to_owned()]));
    }

    #[test]
    fn many_at_once_agree() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a");
        let ends: Vec<Creation> = std::thread::scope(|scope| {
            let all: Vec<_> = (0..8).map(|_| scope.spawn(|| create(&path, b"same").unwrap())).collect();
            all.into_iter().map(|one| one.join().unwrap()).collect()
        });
        assert_eq!(ends.iter().filter(|end| **end == Creation::New).count(), 1, "{ends:?}");
        assert!(!ends.contains(&Creation::Different) && names(folder.path()) == ["a"]);
    }

    #[test]
    fn what_a_killed_process_left_is_swept_once_the_file_is_there() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.json");
        let (left, _) = partial(folder.path(), &path).unwrap();
        let (second, _) = partial(folder.path(), &path).unwrap();
        assert_ne!(left, second);
        sweep(folder.path()).unwrap();
        assert_eq!(names(folder.path()).len(), 2, "its file is not there yet");
        create(&path, b"x").unwrap();
        sweep(folder.path()).unwrap();
        assert_eq!(names(folder.path()), ["a.json"]);
    }
}
