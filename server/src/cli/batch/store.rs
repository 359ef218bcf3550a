//! Storage of a batch's results: a folder on disk, or a prefix in an object store.

use super::cloud::{CloudStore, CloudWriter};
use crate::cli::{Exit, Failure, output};
use formats::files::Whole;
use formats::folder::{self, Creation};
use std::collections::BTreeSet;
use std::io::{self, ErrorKind, Write};
use std::path::{Path, PathBuf};

/// A store of named files. Names are relative and use `/` as separator.
pub enum ResultStore {
    /// A folder on disk.
    Folder(PathBuf),
    /// A prefix in S3, Google Cloud Storage or Azure.
    Cloud(CloudStore),
}

impl ResultStore {
    /// The store at a path, or at a URL such as `s3://bucket/prefix`.
    ///
    /// # Errors
    /// Exit 2 for a URL of another kind, and when the path is a file.
    pub fn new(place: &Path) -> Result<Self, Failure> {
        if let Some(url) = place.to_str().filter(|text| text.contains("://")) {
            return CloudStore::new(url).map(Self::Cloud);
        }
        if place.exists() && !place.is_dir() {
            return Err(Failure::usage(format!("{}: a folder expected, this is a file", place.display())));
        }
        Ok(Self::Folder(place.to_path_buf()))
    }

    /// The store, for messages.
    pub fn shown(&self) -> String {
        match self {
            Self::Folder(path) => path.display().to_string(),
            Self::Cloud(store) => store.url().to_owned(),
        }
    }

    /// A file of the store, for messages.
    pub fn shown_at(&self, name: &str) -> String {
        match self {
            Self::Folder(path) => path.join(name).display().to_string(),
            Self::Cloud(store) => format!("{}/{name}", store.url().trim_end_matches('/')),
        }
    }

    /// The bytes of a file; `None` if it does not exist.
    ///
    /// # Errors
    /// Exit 3 when it cannot be read.
    pub fn find(&self, name: &str) -> Result<Option<Vec<u8>>, Failure> {
        let found = match self {
            Self::Folder(path) => match std::fs::read(path.join(name)) {
                Err(error) if error.kind() == ErrorKind::NotFound => Ok(None),
                result => result.map(Some),
            },
            Self::Cloud(store) => store.find(name),
        };
        found.map_err(|error| Failure::input(format!("{}: {error}", self.shown_at(name))))
    }

    /// The bytes of an existing file.
    ///
    /// # Errors
    /// Exit 3.
    pub fn read(&self, name: &str) -> Result<Vec<u8>, Failure> {
        let missing = || Failure::input(format!("{}: no such file", self.shown_at(name)));
        self.find(name)?.ok_or_else(missing)
    }

    /// Whether a file exists.
    ///
    /// # Errors
    /// Exit 3 when the store cannot tell.
    pub fn has(&self, name: &str) -> Result<bool, Failure> {
        match self {
            Self::Folder(path) => Ok(path.join(name).exists()),
            Self::Cloud(store) => {
                store.has(name).map_err(|error| Failure::input(format!("{}: {error}", self.shown_at(name))))
            }
        }
    }

    /// Names of the files in a folder of the store, without the folder.
    ///
    /// # Errors
    /// Exit 3 when it cannot be listed.
    pub fn list(&self, part: &str) -> Result<BTreeSet<String>, Failure> {
        let found = match self {
            Self::Folder(path) => match std::fs::read_dir(path.join(part)) {
                Err(error) if error.kind() == ErrorKind::NotFound => Ok(BTreeSet::new()),
                Err(error) => Err(error),
                Ok(entries) => entries.map(|entry| Ok(entry?.file_name().to_string_lossy().into())).collect(),
            },
            Self::Cloud(store) => store.list(part),
        };
        found.map_err(|error| Failure::input(format!("{}: {error}", self.shown_at(part))))
    }

    /// Creates a file unless it exists. Its bytes are durable before its name is visible.
    ///
    /// # Errors
    /// Exit 1 when it cannot be written.
    pub fn create(&self, name: &str, bytes: &[u8]) -> Result<Creation, Failure> {
        let created = match self {
            Self::Folder(path) => folder::create(&path.join(name), bytes),
            Self::Cloud(store) => store.create(name, bytes),
        };
        created.map_err(|error| self.unwritten(name, &error))
    }

    /// Writes a complete file, and replaces an existing one.
    ///
    /// # Errors
    /// Exit 1 when it cannot be written.
    pub fn write(&self, name: &str, bytes: &[u8]) -> Result<(), Failure> {
        match self {
            Self::Folder(path) => output::write(Some(&path.join(name)), bytes, true),
            Self::Cloud(store) => store.write(name, bytes).map_err(|error| self.unwritten(name, &error)),
        }
    }

    /// Begins a file that is written in parts and becomes visible when it is complete.
    ///
    /// # Errors
    /// Exit 1 when it cannot be written.
    pub fn writer(&self, name: &str) -> Result<ResultWriter<'_>, Failure> {
        let begun = match self {
            Self::Folder(path) => Whole::create(&path.join(name)).map(ResultWriter::File),
            Self::Cloud(store) => Ok(ResultWriter::Cloud(store.writer(name))),
        };
        begun.map_err(|error| self.unwritten(name, &error))
    }

    /// The failure of a file that could not be written.
    pub fn unwritten(&self, name: &str, error: &io::Error) -> Failure {
        Failure::new(Exit::Failure, format!("{}: {error}", self.shown_at(name)))
    }

    /// Removes incomplete files of killed processes from these folders. Object stores only show complete
    /// files.
    ///
    /// # Errors
    /// Exit 1 when a folder cannot be read.
    pub fn sweep(&self, parts: &[&str]) -> Result<(), Failure> {
        let Self::Folder(path) = self else { return Ok(()) };
        for part in parts.iter().map(|part| path.join(part)).filter(|part| part.is_dir()) {
            folder::sweep(&part)?;
        }
        Ok(())
    }
}

/// A file that is written in parts.
pub enum ResultWriter<'a> {
    /// A file on disk.
    File(Whole),
    /// An object in a store.
    Cloud(CloudWriter<'a>),
}

impl ResultWriter<'_> {
    /// Completes the file, which then becomes visible.
    ///
    /// # Errors
    /// When its content cannot be stored.
    pub fn finish(self) -> io::Result<()> {
        match self {
            Self::File(file) => file.finish(),
            Self::Cloud(object) => object.finish(),
        }
    }
}

impl Write for ResultWriter<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match self {
            Self::File(file) => file.write(bytes),
            Self::Cloud(object) => object.write(bytes),
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        match self {
            Self::File(file) => file.flush(),
            Self::Cloud(_) => Ok(()),
        }
    }
}
