//! Module layers inside a crate, called rooms: which module imports which, read from the sources.
//!
//! A room is a module of a crate's root, or of a module that is a house of its own. Rooms stand on floors,
//! and a room may import only rooms on lower floors: rooms on one floor do not depend on each other.
//! [`rings`] looks for import cycles inside rooms, file by file. Both parse the text: every path outside
//! comments and strings.

use std::path::{Path, PathBuf};

/// One crate and its rooms.
pub struct House {
    /// Name of the crate.
    pub name: &'static str,
    /// Folder of the crate's sources, below the repository's root.
    pub sources: &'static str,
    /// The module that contains the rooms; empty for the crate's root.
    pub module: &'static [&'static str],
    /// Its rooms floor by floor, the lowest first.
    pub floors: &'static [&'static [&'static str]],
}

impl House {
    /// All faults: imports of a higher or the same floor, and modules that the order does not name.
    ///
    /// # Errors
    /// When the sources cannot be read.
    pub fn faults(&self, root: &Path) -> std::io::Result<Vec<String>> {
        let sources = root.join(self.sources);
        let folder = self.module.iter().fold(sources.clone(), |path, name| path.join(name));
        let mut faults = Vec::new();
        for file in files(&folder)? {
            let module = module_of(file.strip_prefix(&sources).unwrap_or(&file));
            let text = std::fs::read_to_string(&file)?;
            let faulty = self.faults_of(&module, &text);
            faults.extend(faulty.into_iter().map(|fault| format!("{}: {fault}", file.display())));
        }
        Ok(faults)
    }

    /// Faults of one module, given by its path from the crate's root.
    pub fn faults_of(&self, module: &[String], text: &str) -> Vec<String> {
        let inside = |path: &[String]| {
            let below = path.len() > self.module.len() && path.iter().zip(self.module).all(|(a, b)| a == b);
            below.then(|| path[self.module.len()].clone())
        };
        // The house itself combines its rooms.
        let Some(room) = inside(module) else { return Vec::new() };
        let place = |name: &str| self.floors.iter().position(|floor| floor.contains(&name));
        let Some(own) = place(&room) else {
            return vec![format!("the room {room} of {} has no floor", self.name)];
        };
        let mut used: Vec<String> = paths(module, text).iter().filter_map(|path| inside(path)).collect();
        used.sort();
        used.dedup();
        let faulty = used.into_iter().filter_map(|name| match place(&name) {
            Some(at) if name != room && at >= own => {
                Some(format!("{room} does not stand above {name} and must not import it"))
            }
            // Items that a house itself defines stand above all of its rooms.
            None if !self.module.is_empty() => Some(format!("{room} must not import {name} of its house")),
            _ => None,
        });
        faulty.collect()
    }
}

/// All Rust files of a folder, in a fixed order.
///
/// # Errors
/// When it cannot be read.
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

/// All paths in the text of a module, from the crate's root: `use super::{b, c::D}` in `a::e` gives `a::b`
/// and `a::c::D`. A path that begins with a plain name is relative to the module itself.
fn paths(module: &[String], text: &str) -> Vec<Vec<String>> {
    let tokens = tokens(&without_words(text));
    // The inline modules of the text, each with the depth of braces at which it opened.
    let (mut inner, mut depth): (Vec<(String, usize)>, usize) = (Vec::new(), 0);
    let mut found = Vec::new();
    let mut at = 0;
    while let Some(token) = tokens.get(at) {
        let next = |ahead: usize| tokens.get(at + ahead).map(String::as_str);
        let fresh = at == 0 || !["::", "$"].contains(&tokens[at - 1].as_str());
        match token.as_str() {
            "{" => depth += 1,
            "}" => {
                depth = depth.saturating_sub(1);
                inner.retain(|(_, opened)| *opened <= depth);
            }
            "mod" if next(2) == Some("{") => {
                inner.push((next(1).unwrap_or_default().to_owned(), depth + 1));
            }
            // `pub(in ...)` is a visibility, not an import.
            "in" if at > 0 && tokens[at - 1] == "(" => {
                at += tokens[at..].iter().take_while(|token| *token != ")").count();
                continue;
            }
            _ if next(1) == Some("::") && (fresh || token == "crate") && is_name(token) => {
                let own = module.iter().chain(inner.iter().map(|(name, _)| name));
                let mut base: Vec<String> = own.cloned().collect();
                let mut start = at;
                match token.as_str() {
                    "crate" => {
                        base.clear();
                        start += 2;
                    }
                    "self" => start += 2,
                    _ => {}
                }
                while tokens.get(start).is_some_and(|token| token == "super") {
                    base.pop();
                    start += 2;
                }
                at = tree(&tokens, start, &base, &mut found);
                continue;
            }
            _ => {}
        }
        at += 1;
    }
    found
}

/// Reads a path, or a group of them, below `base`; returns the index after it.
fn tree(tokens: &[String], mut at: usize, base: &[String], found: &mut Vec<Vec<String>>) -> usize {
    if tokens.get(at).is_some_and(|token| token == "{") {
        at += 1;
        while let Some(token) = tokens.get(at) {
            match token.as_str() {
                "}" => return at + 1,
                "," => at += 1,
                _ => at = tree(tokens, at, base, found).max(at + 1),
            }
        }
        return at;
    }
    let Some(name) = tokens.get(at).filter(|token| is_name(token)) else {
        found.push(base.to_vec());
        return at + usize::from(tokens.get(at).is_some_and(|token| token == "*"));
    };
    let mut path = base.to_vec();
    path.push(name.clone());
    if tokens.get(at + 1).is_some_and(|token| token == "::") {
        return tree(tokens, at + 2, &path, found);
    }
    found.push(path);
    at + 1
}

/// Names, `::`, and every other character except spaces.
fn tokens(code: &str) -> Vec<String> {
    let mut tokens: Vec<String> = Vec::new();
    let mut chars = code.chars().peekable();
    while let Some(c) = chars.next() {
        if c.is_whitespace() {
            continue;
        }
        let mut token = c.to_string();
        let of_name = |c: char| c.is_alphanumeric() || c == '_';
        if of_name(c) {
            while let Some(more) = chars.next_if(|c| of_name(*c)) {
                token.push(more);
            }
        } else if c == ':' && chars.next_if_eq(&':').is_some() {
            token.push(':');
        }
        tokens.push(token);
    }
    tokens
}

fn is_name(token: &str) -> bool {
    token.starts_with(|c: char| c.is_alphabetic() || c == '_')
}

/// Import cycles among the files of a folder below a crate's sources, each as a list of modules. `folder` is
/// the module of the folder. Imports of types count like all others.
///
/// # Errors
/// When the sources cannot be read.
pub fn rings(sources: &Path, folder: &[&str]) -> std::io::Result<Vec<Vec<String>>> {
    let below = folder.iter().fold(sources.to_owned(), |path, name| path.join(name));
    let mut texts = Vec::new();
    for file in files(&below)? {
        let module = module_of(file.strip_prefix(sources).unwrap_or(&file));
        texts.push((module, std::fs::read_to_string(&file)?));
    }
    Ok(rings_of(&texts))
}

/// Import cycles among modules, each given by its path and its text.
pub fn rings_of(texts: &[(Vec<String>, String)]) -> Vec<Vec<String>> {
    let index = |path: &[String]| {
        let prefixes = (1..=path.len()).rev().filter_map(|n| path.get(..n));
        prefixes.into_iter().find_map(|prefix| texts.iter().position(|(module, _)| module == prefix))
    };
    let imports = |(i, (module, text)): (usize, &(Vec<String>, String))| -> Vec<usize> {
        let used = paths(module, text).into_iter().filter_map(|path| index(&path));
        used.filter(|used| *used != i).collect()
    };
    let imports: Vec<Vec<usize>> = texts.iter().enumerate().map(imports).collect();
    let reached: Vec<Vec<bool>> = (0..texts.len())
        .map(|from| {
            let mut seen = vec![false; texts.len()];
            let mut open = imports[from].clone();
            while let Some(next) = open.pop() {
                if !std::mem::replace(&mut seen[next], true) {
                    open.extend(&imports[next]);
                }
            }
            seen
        })
        .collect();
    let mut rings: Vec<Vec<String>> = Vec::new();
    for from in 0..texts.len() {
        let ring: Vec<usize> =
            (0..texts.len()).filter(|to| reached[from][*to] && reached[*to][from]).collect();
        // Each cycle is reported once, by its first module.
        if ring.first() == Some(&from) {
            rings.push(ring.into_iter().map(|i| texts[i].0.join("::")).collect());
        }
    }
    rings
}

/// The text without comments and without the contents of strings.
fn without_words(text: &str) -> String {
    let mut code = String::with_capacity(text.len());
    let mut in_string = false;
    for line in text.lines() {
        let mut chars = line.char_indices().peekable();
        while let Some((at, c)) = chars.next() {
            match c {
                '\\' if in_string => drop(chars.next()),
                '"' => in_string = !in_string,
                // A quote as a character literal does not begin a string.
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
    use super::{House, module_of, paths, rings_of};
    use std::path::Path;

    const FLOORS: &[&[&str]] = &[&["cellar"], &["kitchen", "hall"], &["attic"]];
    const HOUSE: House = House { name: "house", sources: "src", module: &[], floors: FLOORS };
    const WING: House = House { name: "wing", sources: "src", module: &["wing"], floors: FLOORS };

    fn module(path: &str) -> Vec<String> {
        path.split("::").map(str::to_owned).collect()
    }

    fn faults(path: &str, text: &str) -> usize {
        HOUSE.faults_of(&module(path), text).len()
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
        assert_eq!(paths(&module("a::b"), "super::super::c::d"), [module("c::d")]);
        let group = "use super::{c, d::{E, f::*}, self::g::H};";
        assert_eq!(
            paths(&module("a::b"), group),
            ["a::c", "a::d::E", "a::d::f", "a::self::g::H"].map(module)
        );
        assert!(paths(&module("a::b"), "pub(in crate::a) fn f() {}").is_empty());
        let tests = "mod tests { use super::*; use super::super::c::D; } fn f() { super::c::d() }";
        assert_eq!(paths(&module("a::b"), tests), ["a::b", "a::c::D", "a::c::d"].map(module));
    }

    #[test]
    fn a_module_may_be_a_house_of_its_own() {
        let faults = |path: &str, text: &str| WING.faults_of(&module(path), text).len();
        assert_eq!(faults("wing::attic", "use super::cellar::Wine; use crate::wing::kitchen::Pan;"), 0);
        assert_eq!(faults("wing::cellar", "use super::attic::Trunk;"), 1);
        assert_eq!(faults("wing::cellar::shelf", "use crate::wing::{hall, attic::Trunk};"), 2);
        assert_eq!(faults("wing::cellar", "use crate::attic::Trunk;"), 0, "of another house");
        assert_eq!(faults("wing::cellar", "use super::Key;"), 1, "the house stands above its rooms");
        assert_eq!(faults("wing::cellar", "use super::super::hall::Door;"), 0, "outside the house");
    }

    #[test]
    fn rings_are_found_file_by_file() {
        let texts = |all: &[(&str, &str)]| -> Vec<(Vec<String>, String)> {
            all.iter().map(|(path, text)| (module(path), (*text).to_owned())).collect()
        };
        let straight = [("a", "mod b; use b::B;"), ("a::b", "use super::c::C;"), ("a::c", "")];
        assert!(rings_of(&texts(&straight)).is_empty());
        let ring = [
            ("a::b", "use super::c::C;"),
            ("a::c", "fn f() { crate::a::d::e() }"),
            ("a::d", "use super::b::B;"),
        ];
        assert_eq!(rings_of(&texts(&ring)), [["a::b", "a::c", "a::d"]]);
        // A file that imports a type of the module that contains it.
        let parent = [("a", "mod b; use b::B; struct Key;"), ("a::b", "use super::Key;")];
        assert_eq!(rings_of(&texts(&parent)), [["a", "a::b"]]);
    }
}
