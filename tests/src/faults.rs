//! Deliberate disk faults: which calls of a running program fail, from when, and with which error. The
//! library of `tests/faults` causes them, loaded into the program before the system's own.

use crate::program::{built, root};
use crate::random::Random;
use anyhow::{Context, ensure};
use std::fmt;
use std::fs::File;
use std::os::unix::fs::FileExt;
use std::path::{Path, PathBuf};
use std::process::Command;
use tempfile::TempDir;

/// A kind of call that can fail.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Call {
    /// Writing bytes.
    Write = 1,
    /// Syncing written bytes.
    Sync = 2,
    /// Renaming a file.
    Rename = 4,
    /// Changing a file's length.
    Truncate = 8,
    /// Reading bytes.
    Read = 16,
}

/// Kind of failure.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum How {
    /// There is no space (ENOSPC).
    Full,
    /// The device fails (EIO).
    Broken,
    /// Half of the bytes are written, then there is no space.
    Short,
}

/// One fault.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Fault {
    /// Failing call.
    pub call: Call,
    /// Kind of its failure.
    pub how: How,
    /// Number of calls of this kind that succeed first.
    pub before: u64,
    /// Number of calls that fail then; `u64::MAX` until the disk is repaired.
    pub failing: u64,
}

impl Fault {
    /// A random fault of those that can occur while the store is written.
    pub fn drawn(random: &mut Random) -> Self {
        let call = match random.below(10) {
            0..5 => Call::Write,
            5..8 => Call::Sync,
            8 => Call::Truncate,
            _ => Call::Read,
        };
        let how = match (call, random.below(3)) {
            (Call::Write, 0) => How::Short,
            (Call::Write | Call::Truncate, 1) => How::Full,
            _ => How::Broken,
        };
        let failing = match random.below(4) {
            0 => u64::MAX,
            1 => 1 + random.below(6),
            _ => 1,
        };
        Self { call, how, before: random.below(24), failing }
    }

    /// Every write fails until the disk is repaired.
    pub fn lasting(how: How) -> Self {
        Self { call: Call::Write, how, before: 0, failing: u64::MAX }
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { call, how, before, failing } = self;
        let times =
            if *failing == u64::MAX { "until the end".to_owned() } else { format!("{failing} times") };
        write!(f, "{call:?} fails ({how:?}) after {before} calls, {times}")
    }
}

/// A folder's disk with planned faults.
pub struct Disk {
    folder: PathBuf,
    plan: PathBuf,
    file: File,
    /// File that records the changes, if any.
    journal: Option<PathBuf>,
    own: TempDir,
}

/// Words of the plan, by their index in the file.
const CALLS: u64 = 0;
const ERRNO: u64 = 1;
const SHORT: u64 = 2;
const BEFORE: u64 = 3;
const FAILING: u64 = 4;
const FAILED: u64 = 5;
const POWER: u64 = 6;
const LIES: u64 = 7;
const WORDS: u64 = 8;

impl Disk {
    /// A disk without faults.
    ///
    /// # Errors
    /// When the library cannot be built, or the plan cannot be made.
    pub fn of(folder: &Path) -> anyhow::Result<Self> {
        library()?;
        let own = tempfile::tempdir()?;
        let plan = own.path().join("plan");
        let file = File::options().read(true).write(true).create_new(true).open(&plan)?;
        file.set_len(WORDS * 8)?;
        Ok(Self { folder: folder.canonicalize()?, plan, file, journal: None, own })
    }

    /// A disk without faults that records every change ([`crate::power`]).
    ///
    /// # Errors
    /// As [`Disk::of`].
    pub fn with_journal(folder: &Path) -> anyhow::Result<Self> {
        let disk = Self::of(folder)?;
        let journal = disk.own.path().join("journal");
        File::create(&journal)?;
        disk.power_goes(u64::MAX)?;
        Ok(Self { journal: Some(journal), ..disk })
    }

    /// The changes since the start of the journal.
    ///
    /// # Errors
    /// When no journal is kept.
    pub fn journal(&self) -> anyhow::Result<&Path> {
        self.journal.as_deref().context("a disk without a journal")
    }

    /// Begins a new journal. No program may use the disk meanwhile.
    ///
    /// # Errors
    /// When no journal is kept.
    pub fn begin_journal(&self) -> anyhow::Result<()> {
        File::create(self.journal()?)?;
        Ok(())
    }

    /// Cuts the power at the last of this many changes from now on: programs that make it, or try to make
    /// another one, are killed.
    ///
    /// # Errors
    /// When the plan cannot be written.
    pub fn power_goes(&self, after: u64) -> anyhow::Result<()> {
        self.set(POWER, after)
    }

    /// Whether the power has failed.
    ///
    /// # Errors
    /// When the plan cannot be read.
    pub fn is_without_power(&self) -> anyhow::Result<bool> {
        Ok(self.word(POWER)? == 0)
    }

    /// The disk reports syncs that it did not make, as cheap disks do.
    ///
    /// # Errors
    /// When the plan cannot be written.
    pub fn lies(&self) -> anyhow::Result<()> {
        self.set(LIES, 1)
    }

    /// Makes a program use this disk.
    ///
    /// # Errors
    /// When the library cannot be built.
    pub fn put_under(&self, program: &mut Command) -> anyhow::Result<()> {
        program.env("LD_PRELOAD", library()?);
        program.env("FAULTS_PLAN", &self.plan).env("FAULTS_FOLDER", &self.folder);
        if let Some(journal) = &self.journal {
            program.env("FAULTS_JOURNAL", journal);
        }
        Ok(())
    }

    /// A file outside the disk for the output of programs under faults, which is long.
    ///
    /// # Errors
    /// When it cannot be made.
    pub fn log(&self) -> std::io::Result<File> {
        File::options().append(true).create(true).open(self.own.path().join("log"))
    }

    /// The end of that file.
    pub fn last_words(&self) -> String {
        let said = std::fs::read(self.own.path().join("log")).unwrap_or_default();
        let said = String::from_utf8_lossy(&said[said.len().saturating_sub(2_000)..]).into_owned();
        format!("the program's last words: {}", said.trim())
    }

    fn set(&self, word: u64, value: u64) -> anyhow::Result<()> {
        Ok(self.file.write_all_at(&value.to_ne_bytes(), word * 8)?)
    }

    /// Causes a fault from now on.
    ///
    /// # Errors
    /// When the plan cannot be written.
    pub fn fails(&self, fault: Fault) -> anyhow::Result<()> {
        self.well()?;
        // ENOSPC and EIO, as Linux numbers them.
        self.set(ERRNO, if fault.how == How::Broken { 5 } else { 28 })?;
        self.set(SHORT, u64::from(fault.how == How::Short))?;
        self.set(BEFORE, fault.before)?;
        // The next write would complete a short one, so it must fail too.
        self.set(FAILING, fault.failing.saturating_add(u64::from(fault.how == How::Short)))?;
        self.set(CALLS, fault.call as u64)
    }

    /// Ends all faults.
    ///
    /// # Errors
    /// When the plan cannot be written.
    pub fn well(&self) -> anyhow::Result<()> {
        self.set(CALLS, 0)?;
        self.set(FAILING, 0)
    }

    /// Number of failed calls so far.
    ///
    /// # Errors
    /// When the plan cannot be read.
    pub fn failed(&self) -> anyhow::Result<u64> {
        self.word(FAILED)
    }

    fn word(&self, word: u64) -> anyhow::Result<u64> {
        let mut bytes = [0; 8];
        self.file.read_exact_at(&mut bytes, word * 8)?;
        Ok(u64::from_ne_bytes(bytes))
    }
}

/// The library, rebuilt unless it is newer than its source.
fn library() -> anyhow::Result<PathBuf> {
    let source = root().join("tests/faults");
    let name = format!("examples/libfaults{}", std::env::consts::DLL_SUFFIX);
    let path = built(&name, &[&source]).map_or_else(|| build(&name), Ok)?;
    path.canonicalize().with_context(|| path.display().to_string())
}

fn build(name: &str) -> anyhow::Result<PathBuf> {
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let arguments = ["build", "--quiet", "--locked", "--workspace", "--example", "faults"];
    let status = Command::new(cargo).args(arguments).current_dir(root()).status()?;
    ensure!(status.success(), "the library of faults could not be built");
    built(name, &[] as &[&Path]).context("cargo put the library of faults elsewhere")
}
