//! Location of recorded scenes for tests; they are not part of the repository.
//!
//! `DRAGTRAFFIC_SAMPLES` names a folder with `womd/train`, `womd/val` and `formats/waymo`. Setting it
//! promises that all of them exist: a test without its files then fails. Without the variable, tests read the
//! folder `shared/data` beside the checkout, and a test that finds no files is skipped with a printed reason.

#![allow(
    clippy::panic,
    clippy::print_stdout,
    reason = "for tests: a failed one panics, a skipped one says so"
)]

use std::ffi::OsString;
use std::path::{Path, PathBuf};

/// Names the folder of samples.
pub const VARIABLE: &str = "DRAGTRAFFIC_SAMPLES";
/// Folder of samples without the variable.
const BESIDE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared/data");

/// Files of a samples folder with `part` in their names, sorted; `None`, with a printed reason, if there are
/// none and the variable is not set.
///
/// # Panics
/// If the variable is set and there are none, or one cannot be read.
pub fn files(folder: &str, part: &str) -> Option<Vec<PathBuf>> {
    let said = std::env::var_os(VARIABLE);
    match find(said.as_ref(), Path::new(BESIDE), folder, part) {
        Ok(files) => Some(files),
        Err(why) if said.is_some() => panic!("{VARIABLE} is set, but {why}"),
        Err(why) => {
            println!("skipped: {why}; {VARIABLE} names a folder of samples");
            None
        }
    }
}

/// The folder of samples itself; `None`, with a printed reason, as in [`files`].
///
/// # Panics
/// If the variable is set and there are no such files, or one cannot be read.
pub fn folder(folder: &str, part: &str) -> Option<PathBuf> {
    files(folder, part)?.first()?.parent().map(Path::to_path_buf)
}

fn find(said: Option<&OsString>, beside: &Path, folder: &str, part: &str) -> Result<Vec<PathBuf>, String> {
    let folder = said.map_or(beside, |said| Path::new(said)).join(folder);
    let cannot = |path: &Path, error| format!("{} cannot be read: {error}", path.display());
    let mut files = Vec::new();
    for entry in std::fs::read_dir(&folder).map_err(|error| cannot(&folder, error))? {
        let path = entry.map_err(|error| cannot(&folder, error))?.path();
        if path.file_name().is_some_and(|name| name.to_string_lossy().contains(part)) {
            std::fs::File::open(&path).map_err(|error| cannot(&path, error))?;
            files.push(path);
        }
    }
    files.sort();
    if files.is_empty() { Err(format!("{} has no {part}", folder.display())) } else { Ok(files) }
}

#[cfg(test)]
mod tests {
    use super::find;
    use std::path::Path;

    #[test]
    fn what_is_said_to_be_there_must_be() {
        let here = Path::new(env!("CARGO_MANIFEST_DIR"));
        let said = here.as_os_str().to_owned();
        let nowhere = Path::new("/nonexistent");
        assert_eq!(find(Some(&said), nowhere, "src", ".rs"), Ok(vec![here.join("src/lib.rs")]));
        assert_eq!(find(None, here, "src", ".rs"), Ok(vec![here.join("src/lib.rs")]));
        assert!(find(Some(&said), here, "src", ".tfrecord").unwrap_err().contains("has no .tfrecord"));
        assert!(find(Some(&said), here, "gone", "").unwrap_err().contains("cannot be read"));
        assert!(find(None, nowhere, "src", "").unwrap_err().contains("/nonexistent/src cannot be read"));
    }
}
