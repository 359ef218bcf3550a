//! A folder that is read through its handle: a name that leads out of the folder, or to a pipe or device, is
//! not opened.

use formats::{FolderFiles, Source, table};
use std::fs::File;
use std::io::{self, Read};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::SystemTime;

/// Size limit of a file in memory, including the files that are read with it.
const MOST_BYTES: u64 = 256 << 20;

/// A file in memory, with the files of its folder that are read with it.
#[derive(Clone, Debug)]
pub struct HeldFile {
    /// Its bytes.
    pub bytes: Vec<u8>,
    /// The other files, by name.
    pub others: Vec<(String, Arc<Vec<u8>>)>,
}

impl HeldFile {
    /// A file without others.
    pub fn alone(bytes: Vec<u8>) -> Self {
        Self { bytes, others: Vec::new() }
    }

    /// Total bytes.
    pub fn length(&self) -> u64 {
        self.others.iter().map(|(_, other)| other.len()).chain([self.bytes.len()]).sum::<usize>() as u64
    }

    /// The other files as companions of the file with this name; `None` without others.
    pub fn folder(&self, name: &str) -> Option<FolderFiles> {
        let other =
            |(name, bytes): &(String, Arc<Vec<u8>>)| (name.clone(), Arc::clone(bytes) as Arc<dyn Source>);
        let others: Vec<_> = self.others.iter().map(other).collect();
        (!others.is_empty()).then(|| FolderFiles { name: name.to_owned(), others })
    }
}

/// Length and time of a file, by which changes are detected.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FileStamp {
    /// Its length.
    pub bytes: u64,
    /// Time of its last change.
    pub modified: SystemTime,
}

/// A file of a folder, opened anew for each reading.
#[derive(Debug)]
struct FolderFile {
    folder: Arc<DataFolder>,
    name: PathBuf,
    length: u64,
}

impl Source for FolderFile {
    fn open(&self) -> io::Result<Box<dyn Read + Send + '_>> {
        Ok(Box::new(self.folder.plain_file(&self.name)?))
    }

    fn encoded_len(&self) -> u64 {
        self.length
    }
}

/// The files of its folder that are read with the file at a path: the other tables of a recording, and the
/// maps of its place. `None` for other files, and if the folder cannot be read. Links are followed only
/// inside the folder.
pub fn beside(path: &Path, columns: Option<&dyn Source>) -> Option<FolderFiles> {
    let name = path.file_name()?.to_str()?;
    let mut opened = None;
    let list = || {
        let parent = path.parent().filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new("."));
        let folder = opened.insert(Arc::new(DataFolder::open(parent)?));
        folder.texts()
    };
    let names = table::beside(name, columns, list).ok()?;
    let folder = opened?;
    let other = |other: String| {
        let length = folder.plain_file(Path::new(&other)).and_then(|file| file.metadata()).ok()?.len();
        let file = FolderFile { folder: Arc::clone(&folder), name: PathBuf::from(&other), length };
        Some((other, Arc::new(file) as Arc<dyn Source>))
    };
    let others: Vec<_> = names.into_iter().filter_map(other).collect();
    (!others.is_empty()).then(|| FolderFiles { name: name.to_owned(), others })
}

/// The recordings of a folder, each by its main table, sorted by name.
///
/// # Errors
/// When the folder cannot be read.
pub fn recordings(path: &Path) -> io::Result<Vec<PathBuf>> {
    let names = DataFolder::open(path)?.texts()?;
    let list: Vec<&str> = names.iter().map(String::as_str).collect();
    let firsts = table::firsts(&list, None);
    Ok(firsts.into_iter().filter_map(|at| list.get(at).map(|name| path.join(name))).collect())
}

/// A folder with its handle.
#[derive(Debug)]
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
    /// When it is not a folder, or cannot be read.
    #[cfg(target_os = "linux")]
    pub fn open(path: &Path) -> io::Result<Self> {
        use rustix::fs::{Mode, OFlags, open};
        let flags = OFlags::DIRECTORY | OFlags::RDONLY | OFlags::CLOEXEC;
        Ok(Self { handle: open(path, flags, Mode::empty())? })
    }

    /// Opens a folder.
    ///
    /// # Errors
    /// When it is not a folder, or cannot be read.
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
        // Without the entries of the folder itself and its parent.
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

    /// The names that are valid text.
    fn texts(&self) -> io::Result<Vec<String>> {
        let text = |name: PathBuf| name.into_os_string().into_string().ok();
        Ok(self.names()?.into_iter().filter_map(text).collect())
    }

    /// A subfolder.
    #[cfg(target_os = "linux")]
    fn below(&self, name: &Path) -> io::Result<Self> {
        Ok(Self { handle: self.file(name)?.into() })
    }

    /// A subfolder.
    #[cfg(not(target_os = "linux"))]
    fn below(&self, name: &Path) -> io::Result<Self> {
        let path = self.path.join(name).canonicalize()?;
        if !path.starts_with(&self.path) {
            return Err(io::Error::other("no folder below"));
        }
        Ok(Self { path })
    }

    /// Length and time of the last change of the plain file that a name leads to; `None` without such a file.
    pub fn stamp(&self, name: &Path) -> Option<FileStamp> {
        let facts = self.plain_file(name).and_then(|file| file.metadata()).ok()?;
        Some(FileStamp { bytes: facts.len(), modified: facts.modified().ok()? })
    }

    /// The names of the files that are read with a file of the folder itself.
    pub fn beside(&self, name: &Path) -> Vec<String> {
        let own = name.file_name().and_then(|name| name.to_str());
        own.and_then(|own| table::beside(own, None, || self.texts()).ok()).unwrap_or_default()
    }

    /// The bytes of the file that a name leads to now, and of the files that are read with it. Those are the
    /// other tables of a recording and the maps of its place, if they are plain files of the same folder.
    ///
    /// # Errors
    /// When the file does not exist below the folder, is not a plain file, or all have more than `most` bytes together,
    /// or more than 256 MiB.
    pub fn read(&self, name: &Path, most: u64) -> io::Result<HeldFile> {
        let most = most.min(MOST_BYTES);
        let mut left = most;
        let mut take = |file: File| {
            let mut bytes = Vec::new();
            file.take(left + 1).read_to_end(&mut bytes)?;
            let more = || io::Error::other(format!("larger than {most} bytes"));
            left = left.checked_sub(bytes.len() as u64).ok_or_else(more)?;
            Ok::<_, io::Error>(bytes)
        };
        let bytes = take(self.plain_file(name)?)?;
        let Some(own) = name.file_name().and_then(|name| name.to_str()) else {
            return Ok(HeldFile::alone(bytes));
        };
        let parent = name.parent().filter(|parent| !parent.as_os_str().is_empty());
        let mut inner = None;
        let list = || match parent {
            Some(parent) => inner.insert(self.below(parent)?).texts(),
            None => self.texts(),
        };
        // If the folder cannot be listed, there are no other files.
        let names = table::beside(own, None, list).unwrap_or_default();
        let folder = inner.as_ref().unwrap_or(self);
        let mut others = Vec::new();
        for name in names {
            if let Ok(file) = folder.plain_file(Path::new(&name)) {
                others.push((name, Arc::new(take(file)?)));
            }
        }
        Ok(HeldFile { bytes, others })
    }

    /// Opens a file that is neither a pipe nor a device nor a folder.
    fn plain_file(&self, name: &Path) -> io::Result<File> {
        let file = self.file(name)?;
        if !file.metadata()?.is_file() {
            return Err(io::Error::other("no plain file"));
        }
        Ok(file)
    }

    /// Links are followed only inside the folder; a pipe is opened without waiting for its other end.
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
    use super::DataFolder;
    use std::io::Read;
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
        let read = |name: &str| {
            opened.read(Path::new(name), u64::MAX).ok().map(|held| String::from_utf8(held.bytes).unwrap())
        };
        assert_eq!(read("inner/a").as_deref(), Some("inside"));
        assert_eq!(read("beneath").as_deref(), Some("inside"));
        for name in ["out", "up", "magic", "pipe", "inner", "none", "../x", "/etc/hostname"] {
            assert_eq!(read(name), None, "{name}");
        }
        assert_eq!(opened.names().unwrap().len(), 6);
    }

    #[test]
    fn a_recording_is_read_with_plain_files_of_its_folder_alone() {
        let (outside, folder) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
        let inner = folder.path().join("inner");
        std::fs::create_dir(&inner).unwrap();
        for at in [outside.path(), folder.path(), &inner] {
            for name in ["0_tracks.csv", "0_tracksMeta.csv", "0_recordingMeta.csv", "1_tracks.csv", "a.osm"] {
                std::fs::write(at.join(name), name).unwrap();
            }
        }
        // Links are followed only inside the folder, and a pipe does not block.
        std::fs::remove_file(inner.join("0_recordingMeta.csv")).unwrap();
        std::os::unix::fs::symlink("../0_recordingMeta.csv", inner.join("0_recordingMeta.csv")).unwrap();
        std::os::unix::fs::symlink(outside.path().join("a.osm"), inner.join("b.osm")).unwrap();
        std::os::unix::fs::symlink("a.osm", inner.join("c.osm")).unwrap();
        let made = std::process::Command::new("mkfifo").arg(inner.join("d.osm")).status().unwrap();
        assert!(made.success());
        let expected = ["0_tracksMeta.csv", "a.osm", "c.osm"];
        let opened = DataFolder::open(folder.path()).unwrap();
        let held = opened.read(Path::new("inner/0_tracks.csv"), u64::MAX).unwrap();
        let names: Vec<&str> = held.others.iter().map(|(name, _)| name.as_str()).collect();
        assert_eq!(names, expected);
        assert_eq!(held.others[2].1.as_slice(), b"a.osm");
        let beside = super::beside(&inner.join("0_tracks.csv"), None).unwrap();
        let names: Vec<&str> = beside.others.iter().map(|(name, _)| name.as_str()).collect();
        assert_eq!((beside.name.as_str(), names.as_slice()), ("0_tracks.csv", expected.as_slice()));
        let mut text = String::new();
        beside.others[2].1.open().unwrap().read_to_string(&mut text).unwrap();
        assert_eq!((text.as_str(), beside.others[2].1.encoded_len()), ("a.osm", 5));
        assert!(super::beside(&inner.join("0_tracksMeta.csv"), None).is_none());
        let tracks = ["0_tracks.csv", "1_tracks.csv"].map(|name| inner.join(name));
        assert_eq!(super::recordings(&inner).unwrap(), tracks);
        assert!(super::beside(&inner.join("none/0_tracks.csv"), None).is_none());
        assert!(
            held.folder("x").is_some()
                && opened.read(Path::new("a.osm"), u64::MAX).unwrap().folder("x").is_none()
        );
    }
}
