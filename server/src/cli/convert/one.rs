//! The single output of many scenes.

use super::ConvertArgs;
use crate::cli::{Exit, Failure, output};
use formats::files::Whole;
use formats::registry;
use std::io::Write;
use std::path::{Path, PathBuf};

/// The single output of all scenes: a file that appears when it is complete, or stdout.
pub struct One {
    file: Option<(PathBuf, Whole)>,
    /// First bytes of the file, before the first scene.
    heading: Vec<u8>,
    /// Whether the format holds many scenes.
    pub many: bool,
    /// The scene, for a format that holds only one.
    only: Option<Vec<u8>>,
    /// Number of bytes, if they are counted instead of printed to a terminal.
    unprinted: Option<usize>,
}

impl One {
    /// Opens the output; an existing file is kept unless `--force` is given.
    ///
    /// # Errors
    /// Exit 1, 8.
    pub fn create(args: &ConvertArgs) -> Result<Self, Failure> {
        let format = registry::by_id(args.to);
        let many = format.is_some_and(|format| format.info().many);
        let heading = format.and_then(|format| format.export(&[], &formats::ExportOptions::default()).ok());
        // A format without a heading can only be written as a whole, so it takes one scene here.
        let many = many && heading.is_some();
        let heading = heading.filter(|_| many).map_or_else(Vec::new, |exported| exported.bytes);
        let path = args.output.as_deref().filter(|path| *path != Path::new("-"));
        if let Some(path) = path {
            output::keep(path, args.force)?;
        }
        let create = |path: &Path| {
            let file = Whole::create(path).map_err(|error| unwritable(path, &error))?;
            Ok::<_, Failure>((path.to_path_buf(), file))
        };
        let unprinted = output::is_terminal(args.output.as_deref()).then_some(0);
        Ok(Self { file: path.map(create).transpose()?, heading, many, only: None, unprinted })
    }

    /// Adds a scene in the format.
    ///
    /// # Errors
    /// Exit 1, and 2 for a second scene of a format that holds one.
    pub fn add(&mut self, part: &[u8]) -> Result<(), Failure> {
        if self.many {
            return self.put(part);
        }
        if self.only.is_some() {
            return Err(too_many());
        }
        self.only = Some(part.to_vec());
        Ok(())
    }

    fn put(&mut self, part: &[u8]) -> Result<(), Failure> {
        let heading = std::mem::take(&mut self.heading);
        for bytes in [heading.as_slice(), part].into_iter().filter(|bytes| !bytes.is_empty()) {
            match (&mut self.file, &mut self.unprinted) {
                (None, Some(unprinted)) => *unprinted += bytes.len(),
                (None, None) => output::print(bytes)?,
                (Some((path, file)), _) => match file.write_all(bytes) {
                    Err(error) if error.kind() == std::io::ErrorKind::BrokenPipe => {}
                    done => done.map_err(|error| unwritable(path, &error))?,
                },
            }
        }
        Ok(())
    }

    /// Completes the file, which then appears.
    ///
    /// # Errors
    /// Exit 1.
    pub fn finish(mut self) -> Result<(), Failure> {
        if let Some(only) = self.only.take() {
            self.put(&only)?;
        }
        if let Some(unprinted) = self.unprinted {
            return output::print_size(unprinted, "", "--output -");
        }
        let Some((path, file)) = self.file else { return Ok(()) };
        match file.finish() {
            // A closed pipe is not a failure.
            Err(error) if error.kind() == std::io::ErrorKind::BrokenPipe => Ok(()),
            done => done.map_err(|error| unwritable(&path, &error)),
        }
    }
}

/// The failure of several scenes in a format that holds one.
pub fn too_many() -> Failure {
    Failure::usage(
        "several scenes: pick one with --index, or give a folder, --output DIR/, for one file per scene",
    )
}

fn unwritable(path: &Path, error: &std::io::Error) -> Failure {
    Failure::new(Exit::Failure, format!("{}: {error}", path.display()))
}
