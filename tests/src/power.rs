//! Power cuts: what a disk still has of the files of a folder, derived from the journal that the library of
//! `tests/faults` keeps of every change.
//!
//! A file has the bytes of its last sync, and a folder the names of its last sync (POSIX promises no more).
//! Of later changes, a disk may have all, none, or any sectors.

use crate::random::Random;
use anyhow::{Context, bail, ensure};
use std::collections::{BTreeMap, HashMap};
use std::fs;
use std::io::Write;
use std::os::unix::fs::{MetadataExt, OpenOptionsExt};
use std::path::{Path, PathBuf};

/// A disk writes this many bytes atomically.
const SECTOR: usize = 512;

/// Which unsynced changes a disk keeps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unsynced {
    /// Nothing.
    Lost,
    /// All of it, as after the kill of a process.
    Kept,
    /// Any sectors of each file, in no order; the first few changes of the names, as a journal of names has
    /// them.
    Drawn,
}

impl Unsynced {
    /// One of them at random, all with the same probability.
    pub fn drawn(random: &mut Random) -> Self {
        [Self::Lost, Self::Kept, Self::Drawn][random.below(3) as usize]
    }
}

/// A change of a file's bytes.
enum ByteChange {
    Write(usize, Vec<u8>),
    Resize(usize),
}

/// A change of the names.
enum NameChange {
    Give(PathBuf, usize),
    Move(PathBuf, PathBuf),
    Take(PathBuf),
}

#[derive(Default)]
struct FileModel {
    synced: Vec<u8>,
    unsynced: Vec<ByteChange>,
}

/// Files of a folder, on the disk and as programs see them.
#[derive(Default)]
pub struct DiskModel {
    files: Vec<FileModel>,
    /// Names as programs see them.
    seen: BTreeMap<PathBuf, usize>,
    /// Names on the disk.
    synced: BTreeMap<PathBuf, usize>,
    unsynced: Vec<NameChange>,
    /// Files by their numbers in the journal.
    numbers: HashMap<u64, usize>,
}

impl DiskModel {
    /// A fully synced folder without subfolders.
    ///
    /// # Errors
    /// When it cannot be read.
    pub fn of(folder: &Path) -> anyhow::Result<Self> {
        let mut model = Self::default();
        for entry in fs::read_dir(folder.canonicalize()?)? {
            let path = entry?.path();
            let file = model.files.len();
            model.files.push(FileModel { synced: fs::read(&path)?, unsynced: Vec::new() });
            model.numbers.insert(path.metadata()?.ino(), file);
            model.seen.insert(path, file);
        }
        model.synced = model.seen.clone();
        Ok(model)
    }

    /// Applies the changes of a journal, and returns their number.
    ///
    /// # Errors
    /// When the file is not a journal.
    pub fn replay(&mut self, journal: &Path) -> anyhow::Result<u64> {
        let bytes = fs::read(journal)?;
        let mut rest = bytes.as_slice();
        let mut count = 0;
        while !rest.is_empty() {
            let mut head = [0_u64; 5];
            for word in &mut head {
                let (first, after) = rest.split_first_chunk::<8>().context("half a record")?;
                *word = u64::from_ne_bytes(*first);
                rest = after;
            }
            let [change, number, at, first, second] = head;
            let mut part = |length: u64| -> anyhow::Result<&[u8]> {
                let (part, after) = rest.split_at_checked(length as usize).context("half a record")?;
                rest = after;
                Ok(part)
            };
            let (first, second) = (part(first)?, part(second)?);
            self.change(change, (number, at), first, second)?;
            count += 1;
        }
        Ok(count)
    }

    fn change(
        &mut self,
        change: u64,
        (number, at): (u64, u64),
        first: &[u8],
        second: &[u8],
    ) -> anyhow::Result<()> {
        let path = |bytes: &[u8]| PathBuf::from(String::from_utf8_lossy(bytes).into_owned());
        match change {
            1 => self.made(&path(first), number, at != 0),
            2 => self.file(number)?.unsynced.push(ByteChange::Write(at as usize, first.to_vec())),
            3 => self.file(number)?.unsynced.push(ByteChange::Resize(at as usize)),
            4 => self.file(number)?.settle(),
            5 => self.sync_names(&path(first)),
            6 => {
                let (from, to) = (path(first), path(second));
                let file = self.seen.remove(&from).context("a file without a name is renamed")?;
                self.seen.insert(to.clone(), file);
                self.unsynced.push(NameChange::Move(from, to));
            }
            7 => {
                self.seen.remove(&path(first));
                self.unsynced.push(NameChange::Take(path(first)));
            }
            other => bail!("{other} is no change"),
        }
        Ok(())
    }

    fn file(&mut self, number: u64) -> anyhow::Result<&mut FileModel> {
        let file = self.numbers.get(&number).context("a file that was never made")?;
        self.files.get_mut(*file).context("no file")
    }

    fn made(&mut self, path: &Path, number: u64, is_emptied: bool) {
        if let Some(file) = self.seen.get(path) {
            if is_emptied && let Some(file) = self.files.get_mut(*file) {
                file.unsynced.push(ByteChange::Resize(0));
            }
            return;
        }
        let file = self.files.len();
        self.files.push(FileModel::default());
        // The number of a deleted file is reused for the next one.
        self.numbers.insert(number, file);
        self.seen.insert(path.to_owned(), file);
        self.unsynced.push(NameChange::Give(path.to_owned(), file));
    }

    fn sync_names(&mut self, folder: &Path) {
        let is_of = |path: &Path| path.parent() == Some(folder);
        for change in std::mem::take(&mut self.unsynced) {
            let (NameChange::Give(path, _) | NameChange::Move(_, path) | NameChange::Take(path)) = &change;
            if is_of(path) { self.settle_name(change) } else { self.unsynced.push(change) }
        }
    }

    fn settle_name(&mut self, change: NameChange) {
        match change {
            NameChange::Give(path, file) => drop(self.synced.insert(path, file)),
            NameChange::Move(from, to) => {
                if let Some(file) = self.synced.remove(&from) {
                    self.synced.insert(to, file);
                }
            }
            NameChange::Take(path) => drop(self.synced.remove(&path)),
        }
    }

    /// Cuts the power: the state that is left becomes the state on the disk.
    pub fn cut(&mut self, unsynced: Unsynced, random: &mut Random) {
        let names = std::mem::take(&mut self.unsynced);
        let kept = match unsynced {
            Unsynced::Lost => 0,
            Unsynced::Kept => names.len(),
            Unsynced::Drawn => random.below(names.len() as u64 + 1) as usize,
        };
        names.into_iter().take(kept).for_each(|change| self.settle_name(change));
        self.seen = self.synced.clone();
        for file in &mut self.files {
            match unsynced {
                Unsynced::Lost => file.unsynced.clear(),
                Unsynced::Kept => file.settle(),
                Unsynced::Drawn => file.settle_some(random),
            }
        }
    }

    /// Files as programs see them, by name.
    ///
    /// # Errors
    /// When a name has no file.
    pub fn seen(&self) -> anyhow::Result<BTreeMap<PathBuf, Vec<u8>>> {
        let bytes = |file: &usize| -> anyhow::Result<Vec<u8>> {
            let file = self.files.get(*file).context("a name without a file")?;
            let mut bytes = file.synced.clone();
            file.unsynced.iter().for_each(|change| change.apply(&mut bytes));
            Ok(bytes)
        };
        self.seen.iter().map(|(path, file)| Ok((path.clone(), bytes(file)?))).collect()
    }

    /// Writes the state that programs see after the cut to the folder.
    ///
    /// # Errors
    /// When it cannot be written.
    pub fn rebuild(&self, folder: &Path) -> anyhow::Result<()> {
        for entry in fs::read_dir(folder)? {
            fs::remove_file(entry?.path())?;
        }
        for (path, bytes) in self.seen()? {
            fs::File::options().write(true).create_new(true).mode(0o600).open(path)?.write_all(&bytes)?;
        }
        Ok(())
    }

    /// Checks that the journal has every change: its result must equal the files. SQLite writes the index of
    /// its log in memory, so that file is left out; the first process that opens a store creates it again.
    ///
    /// # Errors
    /// At the first file that differs.
    pub fn agrees(&self, folder: &Path) -> anyhow::Result<()> {
        let is_told = |path: &Path| path.extension().is_none_or(|end| end != "sqlite-shm");
        let mut told = self.seen()?;
        told.retain(|path, _| is_told(path));
        for entry in fs::read_dir(folder.canonicalize()?)? {
            let path = entry?.path();
            if is_told(&path) {
                let bytes = told.remove(&path).with_context(|| format!("{} is not told", path.display()))?;
                ensure!(bytes == fs::read(&path)?, "{} is told to be other than it is", path.display());
            }
        }
        ensure!(told.is_empty(), "{:?} are told and not there", told.keys());
        Ok(())
    }
}

impl FileModel {
    fn settle(&mut self) {
        for change in std::mem::take(&mut self.unsynced) {
            change.apply(&mut self.synced);
        }
    }

    /// Keeps some of the changes, and some sectors of those.
    fn settle_some(&mut self, random: &mut Random) {
        for change in std::mem::take(&mut self.unsynced) {
            match (random.below(3), change) {
                (0, _) => {}
                (1, ByteChange::Write(at, bytes)) => {
                    let mut from = 0;
                    while from < bytes.len() {
                        let end = ((at + from) / SECTOR + 1) * SECTOR - at;
                        let end = end.min(bytes.len());
                        if random.below(2) == 0 {
                            ByteChange::Write(at + from, bytes[from..end].to_vec()).apply(&mut self.synced);
                        }
                        from = end;
                    }
                }
                (_, change) => change.apply(&mut self.synced),
            }
        }
    }
}

impl ByteChange {
    fn apply(&self, file: &mut Vec<u8>) {
        match self {
            Self::Write(at, bytes) => {
                file.resize(file.len().max(at + bytes.len()), 0);
                file[*at..at + bytes.len()].copy_from_slice(bytes);
            }
            Self::Resize(length) => file.resize(*length, 0),
        }
    }
}
