//! Rooms inside a crate: which module imports which, read from the sources.
//!
//! A room is a module of a crate's root. Rooms stand on floors, and a room may import those on the floors below
//! it alone; so there is no ring either, and rooms on one floor know nothing of each other. What is read is the text: paths that begin with `crate::` or climb
//! with `super::` to the root, wherever they stand outside comments and strings.

use std::path::{Path, PathBuf};

/// One crate and its rooms.
pub struct House {
    /// Name of the crate.
    pub name: &'static str,
    /// Folder of its sources, below the repository's root.
    pub sources: &'static str,
    /// Its rooms floor by floor, the lowest first.
    pub floors: &'static [&'static [&'static str]],
}

impl House {
    /// Everything that is wrong: imports that lead up, and modules without a place in the order.
    ///
    /// # Errors
    /// When the sources cannot be read.
    pub fn faults(&self, root: &Path) -> std::io::Result<Vec<String>> {
        let sources = root.join(self.sources);
        let mut faults = Vec::new();
        for file in files(&sources)? {
            let module = module_of(file.strip_prefix(&sources).unwrap_or(&file));
            let text = std::fs::read_to_string(&file)?;
            let faulty = self.faults_of(&module, &text);
            faults.extend(faulty.into_iter().map(|fault| format!("{}: {fault}", file.display())));
        }
        Ok(faults)
    }

    /// Faults of one module with this path from the crate's root.
    pub fn faults_of(&self, module: &[String], text: &str) -> Vec<String> {
        // The root itself puts the rooms together.
        let Some(room) = module.first() else { return Vec::new() };
        let place = |name: &str| self.floors.iter().position(|floor| floor.contains(&name));
        let Some(own) = place(room) else {
            return vec![format!("the room {room} of {} has no floor", self.name)];
        };
        let mut used: Vec<String> = used_rooms(module, text);
        used.sort();
        used.dedup();
        let not_below = |name: &String| name != room && place(name).is_some_and(|at| at >= own);
        let faulty = used.into_iter().filter(not_below);
        faulty.map(|name| format!("{room} does not stand above {name} and must not import it")).collect()
    }
}

/// All Rust files of a folder and of those in it, in a fixed order.
///
/// # Errors
/// When a folder cannot be read.
pub fn files(folder: &Path) -> std::io::Result<Vec<PathBuf>> {
    let mut entries: Vec<PathBuf> = std::fs::read_dir(folder)?.flatten().map(|entry| entry.path()).collect();
    entries.sort();
    let mut all = Vec::new();
    for path in entries {
        if path.is_dir() {
            all.extend(files(&path)?);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            all.push(path);
        }
    }
    Ok(all)
}

/// `routes/scenes.rs` is `[routes, scenes]`, `routes/mod.rs` is `[routes]`, `main.rs` is the root.
fn module_of(path: &Path) -> Vec<String> {
    let text = path.with_extension("").to_string_lossy().replace('\\', "/");
    let mut parts: Vec<String> = text.split('/').map(str::to_owned).collect();
    if parts.last().is_some_and(|last| ["mod", "main", "lib"].contains(&last.as_str())) {
        parts.pop();
    }
    parts
}

/// First names below the crate's root of all paths in a text.
fn used_rooms(module: &[String], text: &str) -> Vec<String> {
    let code = without_words(text);
    let mut used = Vec::new();
    let mut rest = code.as_str();
    let mut before = ' ';
    while let Some(start) = rest.chars().next() {
        let fresh = !(before.is_alphanumeric() || before == '_' || before == ':');
        let climbed = fresh.then(|| climb(module, rest)).flatten();
        match climbed {
            Some(tail) => {
                used.extend(heads(tail));
                before = ':';
                rest = tail;
            }
            None => {
                before = start;
                rest = rest.get(start.len_utf8()..).unwrap_or_default();
            }
        }
    }
    used
}

/// What follows a path's way to the root; `None` when it does not lead there.
fn climb<'a>(module: &[String], code: &'a str) -> Option<&'a str> {
    if let Some(tail) = code.strip_prefix("crate::") {
        return Some(tail);
    }
    let (mut tail, mut steps) = (code, 0);
    while let Some(next) = tail.strip_prefix("super::") {
        (tail, steps) = (next, steps + 1);
    }
    (steps > 0 && steps >= module.len()).then_some(tail)
}

/// Names that a path or a group of paths begins with: `a::b` gives a, `{a::b, c}` gives a and c.
fn heads(tail: &str) -> Vec<String> {
    let name = |text: &str| -> String {
        text.trim_start().chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect()
    };
    let Some(group) = tail.trim_start().strip_prefix('{') else { return vec![name(tail)] };
    let mut depth = 0;
    let mut names = vec![name(group)];
    for (at, c) in group.char_indices() {
        match c {
            '{' => depth += 1,
            '}' if depth == 0 => break,
            '}' => depth -= 1,
            ',' if depth == 0 => names.push(name(group.get(at + 1..).unwrap_or_default())),
            _ => {}
        }
    }
    names
}

/// The text with comments and the insides of strings left out.
fn without_words(text: &str) -> String {
    let mut code = String::with_capacity(text.len());
    let mut in_string = false;
    for line in text.lines() {
        let mut chars = line.char_indices().peekable();
        while let Some((at, c)) = chars.next() {
            match c {
                '\\' if in_string => drop(chars.next()),
                '"' => in_string = !in_string,
                // A quote as a character is no string.
                '\'' if !in_string && line.get(at..).is_some_and(|rest| rest.starts_with("'\"'")) => {
                    chars.next();
                    chars.next();
                }
                '/' if !in_string && chars.peek().is_some_and(|(_, next)| *next == '/') => break,
                _ if !in_string => code.push(c),
                _ => {}
            }
        }
        code.push('\n');
    }
    code
}

#[cfg(test)]
mod tests {
    use super::{House, module_of, used_rooms};
    use std::path::Path;

    const HOUSE: House =
        House { name: "house", sources: "src", floors: &[&["cellar"], &["kitchen", "hall"], &["attic"]] };

    fn faults(module: &str, text: &str) -> usize {
        let module: Vec<String> = module.split("::").map(str::to_owned).collect();
        HOUSE.faults_of(&module, text).len()
    }

    #[test]
    fn arrows_down_are_fine_and_arrows_up_are_found() {
        assert_eq!(faults("attic", "use crate::cellar::Wine;\nuse crate::kitchen::{Pan, Pot};"), 0);
        assert_eq!(faults("kitchen", "use crate::kitchen::Pan; use super::Pot;"), 0);
        assert_eq!(faults("cellar", "use crate::attic::Trunk;"), 1);
        assert_eq!(faults("kitchen", "fn f() { crate::attic::open(); }"), 1);
        assert_eq!(faults("cellar", "use crate::{kitchen::Pan, attic::{Trunk, Chest}};"), 2);
        assert_eq!(faults("kitchen::stove", "use super::super::attic::Trunk;"), 1);
        assert_eq!(faults("kitchen::stove", "use super::attic::Shelf;"), 0, "a module of its own room");
        assert_eq!(faults("cellar", "macro_rules! m { () => { $crate::attic::open() } }"), 1);
        assert_eq!(faults("kitchen", "use crate::hall::Door;"), 1, "on the same floor");
        assert_eq!(faults("garage", "use crate::cellar::Wine;"), 1, "no place in the order");
    }

    #[test]
    fn words_in_comments_and_strings_are_no_arrows() {
        let text = "// crate::attic\n/// [`crate::attic::Trunk`]\nconst A: &str = \"crate::attic\"; // x\n";
        assert_eq!(faults("cellar", text), 0);
        assert_eq!(faults("cellar", "const Q: char = '\"'; use crate::attic::Trunk;"), 1);
        assert_eq!(faults("cellar", "use mycrate::attic::Trunk;"), 0);
    }

    #[test]
    fn files_are_modules() {
        assert_eq!(module_of(Path::new("routes/mod.rs")), ["routes"]);
        assert_eq!(module_of(Path::new("routes/scenes.rs")), ["routes", "scenes"]);
        assert!(module_of(Path::new("main.rs")).is_empty());
        assert_eq!(used_rooms(&["a".into(), "b".into()], "super::super::c::d"), ["c"]);
    }
}
