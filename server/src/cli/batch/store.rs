//! Where a batch keeps its results: a folder of this machine, or a prefix in an object store.

use super::cloud::{CloudStore, CloudWriter};
use crate::cli::{Exit, Failure, output};
use formats::files::Whole;
use formats::folder::{self, Creation};
use std::collections::BTreeSet;
use std::io::{self, ErrorKind, Write};
use std::path::{Path, PathBuf};

/// A place of named files. Names are relative and have `/` between their parts.
pub enum ResultStore {
    /// A folder of this machine.
    Folder(PathBuf),
    /// A prefix in S3, Google Cloud Storage or Azure.
    Cloud(CloudStore),
}

impl ResultStore {
    /// At a path, or at a URL such as `s3://bucket/prefix`.
    ///
    /// # Errors
    /// Exit 2 for a URL of another kind, and when a file is at the path.
    pub fn new(place: &Path) -> Result<Self, Failure> {
        if let Some(url) = place.to_str().filter(|text| text.contains("://")) {
            return CloudStore::new(url).map(Self::Cloud);
        }
        if place.exists() && !place.is_dir() {
            return Err(Failure::usage(format!("{}: a folder expected, this is a file", place.display())));
        }
        Ok(Self::Folder(place.to_path_buf()))
    }

    /// The place as messages name it.
    pub fn shown(&self) -> String {
        match self {
            Self::Folder(path) => path.display().to_string(),
            Self::Cloud(store) => store.url().to_owned(),
        }
    }

    /// A file as messages name it.
    pub fn shown_at(&self, name: &str) -> String {
        match self {
            Self::Folder(path) => path.join(name).display().to_string(),
            Self::Cloud(store) => format!("{}/{name}", store.url().trim_end_matches('/')),
        }
    }

    /// The bytes of a file; `None` where none has the name.
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

    /// The bytes of a file that is there.
    ///
    /// # Errors
    /// Exit 3.
    pub fn read(&self, name: &str) -> Result<Vec<u8>, Failure> {
        let missing = || Failure::input(format!("{}: no such file", self.shown_at(name)));
        self.find(name)?.ok_or_else(missing)
    }

    /// A file of this name is there.
    ///
    /// # Errors
    /// Exit 3 when the store does not say.
    pub fn has(&self, name: &str) -> Result<bool, Failure> {
        match self {
            Self::Folder(path) => Ok(path.join(name).exists()),
            Self::Cloud(store) => {
                store.has(name).map_err(|error| Failure::input(format!("{}: {error}", self.shown_at(name))))
            }
        }
    }

    /// Names of the files in a folder of the place, without the folder.
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

    /// Creates a file, unless it is there: its bytes are kept before anybody can see its name.
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

    /// Writes a file whole, in place of the one that may be there.
    ///
    /// # Errors
    /// Exit 1 when it cannot be written.
    pub fn write(&self, name: &str, bytes: &[u8]) -> Result<(), Failure> {
        match self {
            Self::Folder(path) => output::write(Some(&path.join(name)), bytes, true),
            Self::Cloud(store) => store.write(name, bytes).map_err(|error| self.unwritten(name, &error)),
        }
    }

    /// Begins a file that is written part by part, and appears whole.
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

    /// A file that could not be written.
    pub fn unwritten(&self, name: &str, error: &io::Error) -> Failure {
        Failure::new(Exit::Failure, format!("{}: {error}", self.shown_at(name)))
    }

    /// Removes what killed processes left half written in these folders. Object stores show whole files alone.
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

/// A file that is written part by part.
pub enum ResultWriter<'a> {
    /// On this machine.
    File(Whole),
    /// In an object store.
    Cloud(CloudWriter<'a>),
}

impl ResultWriter<'_> {
    /// Puts the file in its place.
    ///
    /// # Errors
    /// When what was written cannot be kept.
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
