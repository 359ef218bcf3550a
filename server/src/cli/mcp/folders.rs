//! The folders that a client may read and write; no path leads outside them.

use api::{Code, Problem};
use base::folder::{DataFolder, HeldFile};
use formats::files;
use std::ffi::OsStr;
use std::io;
use std::path::{Component, Path, PathBuf};

/// Longest file name, bytes.
const LONGEST_NAME: usize = 255;
/// Limit of listed files.
const MOST_LISTED: usize = 300;
/// Depth of listed subfolders of an allowed folder.
const DEEPEST: usize = 4;

/// An allowed folder.
struct Allowed {
    /// Path as given.
    given: PathBuf,
    /// Path without links.
    real: PathBuf,
    reader: DataFolder,
}

/// All allowed folders, in the given order.
pub struct AllowedFolders(Vec<Allowed>);

impl AllowedFolders {
    /// Opens the folders.
    ///
    /// # Errors
    /// A sentence about a folder that cannot be read.
    pub fn open(paths: &[PathBuf]) -> Result<Self, String> {
        let open = |path: &PathBuf| {
            let failed = |error: io::Error| format!("--folder {}: {error}", path.display());
            let real = path.canonicalize().map_err(failed)?;
            let reader = DataFolder::open(&real).map_err(failed)?;
            Ok(Allowed { given: path.clone(), real, reader })
        };
        paths.iter().map(open).collect::<Result<_, String>>().map(Self)
    }

    /// A file by its path, or by its name in one of the folders, with the files that are read with it.
    ///
    /// # Errors
    /// `not-found` for a file in none of the folders, or one that cannot be read.
    pub fn read(&self, path: &str) -> Result<HeldFile, Problem> {
        let mut found = self.0.iter().filter_map(|allowed| Some((allowed, allowed.below(path)?)));
        found
            .find_map(|(allowed, name)| allowed.reader.read(&name, u64::MAX).ok())
            .ok_or_else(|| self.not_here(path))
    }

    /// Writes a complete file and returns its path. It does not write through a link, and the folder must
    /// exist.
    ///
    /// # Errors
    /// `not-found` for a path in none of the folders, `exists` unless `overwrite`, `store-unavailable` for a
    /// disk error.
    pub fn write(&self, path: &str, bytes: &[u8], overwrite: bool) -> Result<PathBuf, Problem> {
        let target = self.0.iter().find_map(|allowed| allowed.target(path));
        let target = target.ok_or_else(|| self.not_here(path))?;
        match std::fs::symlink_metadata(&target) {
            Ok(found) if !found.is_file() => return Err(self.not_here(path)),
            Ok(_) if !overwrite => {
                let detail = format!("{} exists; overwrite replaces it", target.display());
                return Err(Problem::field("/file", Code::Exists, detail));
            }
            _ => {}
        }
        files::replace(&target, bytes).map_err(|error| {
            let detail = format!("{} cannot be written: {}", target.display(), error.kind());
            Problem::new(Code::StoreUnavailable, detail)
        })?;
        Ok(target)
    }

    fn not_here(&self, path: &str) -> Problem {
        let shown: String = path.chars().take(200).collect();
        let folders: Vec<String> = self.0.iter().map(|allowed| allowed.given.display().to_string()).collect();
        let folders = match folders.as_slice() {
            [] => "it was started without --folder, so only examples can be opened".to_owned(),
            given => format!("its folders are {}", given.join(", ")),
        };
        let detail = format!("\"{shown}\" is no file that this server may use: {folders}");
        Problem::field("/file", Code::NotFound, detail)
    }

    /// Sorted paths of the files in the folders, and whether there are more. Links to folders are not
    /// followed.
    pub fn files(&self) -> (Vec<String>, bool) {
        let mut files = Vec::new();
        for allowed in &self.0 {
            listed(&allowed.real, &allowed.given, DEEPEST, &mut files);
        }
        let more = files.len() > MOST_LISTED;
        files.truncate(MOST_LISTED);
        (files, more)
    }
}

impl Allowed {
    /// The name of a path below this folder; `None` if its text alone leads outside.
    fn below(&self, path: &str) -> Option<PathBuf> {
        let path = Path::new(path);
        let name = match path.is_absolute() {
            true => path.strip_prefix(&self.given).or_else(|_| path.strip_prefix(&self.real)).ok()?,
            false => path.strip_prefix(&self.given).unwrap_or(path),
        };
        let plain: PathBuf = name.components().filter(|part| *part != Component::CurDir).collect();
        let is_name = |name: &OsStr| name.len() <= LONGEST_NAME && !name.as_encoded_bytes().contains(&0);
        let is_plain =
            plain.components().all(|part| matches!(part, Component::Normal(name) if is_name(name)));
        (is_plain && plain.file_name().is_some()).then_some(plain)
    }

    /// The place of a new file, with the links of its folders resolved; `None` if that is outside.
    fn target(&self, path: &str) -> Option<PathBuf> {
        let name = self.below(path)?;
        let folder = self.real.join(name.parent()?).canonicalize().ok()?;
        folder.starts_with(&self.real).then(|| folder.join(name.file_name().unwrap_or_default()))
    }
}

/// Adds the files of a folder and its subfolders.
fn listed(folder: &Path, shown: &Path, deep: usize, files: &mut Vec<String>) {
    let Ok(entries) = std::fs::read_dir(folder) else { return };
    let mut entries: Vec<_> = entries.flatten().collect();
    entries.sort_by_key(std::fs::DirEntry::file_name);
    for entry in entries {
        if files.len() > MOST_LISTED {
            return;
        }
        let (name, kind) = (entry.file_name(), entry.file_type());
        if name.to_string_lossy().starts_with('.') {
            continue;
        }
        match kind {
            Ok(kind) if kind.is_dir() && deep > 0 => {
                listed(&entry.path(), &shown.join(name), deep - 1, files);
            }
            Ok(kind) if kind.is_file() => files.push(shown.join(name).display().to_string()),
            _ => {}
        }
    }
}

#[cfg(all(test, unix))]
mod tests {
    use super::AllowedFolders;
    use api::Code;
    use std::os::unix::fs::symlink;

    #[test]
    fn no_path_leads_out_of_the_folders() {
        let (outside, inside) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
        let at = |name: &str| inside.path().join(name);
        std::fs::create_dir(at("below")).unwrap();
        std::fs::write(at("below/a"), "inside").unwrap();
        std::fs::write(outside.path().join("secret"), "outside").unwrap();
        symlink(outside.path().join("secret"), at("link")).unwrap();
        symlink(outside.path(), at("way-out")).unwrap();
        symlink(at("below"), at("way-in")).unwrap();
        let folders = AllowedFolders::open(&[inside.path().to_path_buf()]).unwrap();
        let absolute = |name: &str| at(name).display().to_string();
        assert_eq!(folders.read("below/a").unwrap().bytes, b"inside");
        assert_eq!(folders.read("./below/a").unwrap().bytes, b"inside");
        assert_eq!(folders.read(&absolute("below/a")).unwrap().bytes, b"inside");
        let secret = outside.path().join("secret").display().to_string();
        let relative = format!("../{}/secret", outside.path().file_name().unwrap().display());
        let names = ["link", "way-out/secret", "below/../link", "..", "", ".", "below", "/etc/hostname"];
        for name in names.into_iter().chain([secret.as_str(), relative.as_str(), &absolute("link")]) {
            assert_eq!(folders.read(name).unwrap_err().code, Code::NotFound, "{name}");
        }
        for name in ["link", "way-out/new", "../new", "below/../../new", "none/new", "below", "/new", ""] {
            assert_eq!(folders.write(name, b"x", true).unwrap_err().code, Code::NotFound, "{name}");
        }
        assert_eq!(std::fs::read(outside.path().join("secret")).unwrap(), b"outside");
        assert_eq!(std::fs::read_dir(outside.path()).unwrap().count(), 1);
        folders.write("below/new", b"1", false).unwrap();
        assert_eq!(folders.write("way-in/new", b"2", false).unwrap_err().code, Code::Exists);
        folders.write("way-in/new", b"2", true).unwrap();
        assert_eq!(std::fs::read(at("below/new")).unwrap(), b"2");
        let (files, more) = folders.files();
        assert_eq!((files, more), (vec![absolute("below/a"), absolute("below/new")], false));
        // Without a folder there is nothing to read.
        assert!(AllowedFolders::open(&[]).unwrap().read("below/a").is_err());
        assert!(AllowedFolders::open(&[at("none")]).is_err());
    }
}
