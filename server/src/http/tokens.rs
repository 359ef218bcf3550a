//! Named tokens with rights, from a file that is read again when it changes.

use super::sign_in::{SessionCookie, same_bytes};
use api::{Code, Problem};
use axum::http::{HeaderMap, Method, header};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::{Arc, PoisonError, RwLock};
use std::time::{Duration, SystemTime};

/// Least characters of a token.
const LEAST: usize = 32;
/// Time between two looks at the file.
const LOOK: Duration = Duration::from_secs(1);
/// Name of the token in a file with nothing else.
const ONLY: &str = "admin";

/// What a token allows; each right includes the ones before it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Right {
    /// Read scenes and compute; saved scenes do not change.
    Read,
    /// Save, change and delete scenes.
    Edit,
    /// Read the server's counters.
    Admin,
}

/// The rights by name.
const RIGHTS: [(&str, Right); 3] = [("read", Right::Read), ("edit", Right::Edit), ("admin", Right::Admin)];

impl Right {
    fn word(self) -> &'static str {
        RIGHTS.iter().find(|(_, right)| *right == self).map_or("", |(word, _)| word)
    }

    /// The right that a request requires.
    pub fn needed(method: &Method, path: &str, query: Option<&str>) -> Self {
        let reads = matches!(*method, Method::GET | Method::HEAD | Method::OPTIONS);
        let tries = || {
            let mut pairs = form_urlencoded::parse(query.unwrap_or_default().as_bytes());
            pairs.any(|(name, value)| name == "dry_run" && value == "true")
        };
        match path {
            "/metrics" => Self::Admin,
            "/v1/import" if !reads && !tries() => Self::Edit,
            path if !reads && (path == "/v1/scenes" || path.starts_with("/v1/scenes/")) => Self::Edit,
            _ => Self::Read,
        }
    }
}

/// One token.
#[derive(Debug)]
pub struct NamedToken {
    /// Name, for logs.
    pub name: String,
    right: Right,
    secret: String,
    /// Cookie that represents the token in browsers.
    pub cookie: SessionCookie,
}

impl NamedToken {
    fn new(name: &str, right: Right, secret: &str) -> Result<Self, String> {
        if secret.len() < LEAST || !secret.is_ascii() {
            return Err(format!("a token of at least {LEAST} ASCII characters is expected"));
        }
        let cookie = SessionCookie::of(secret);
        Ok(Self { name: name.to_owned(), right, secret: secret.to_owned(), cookie })
    }

    /// Whether it allows everything.
    pub fn is_admin(&self) -> bool {
        self.right == Right::Admin
    }

    fn is(&self, given: &str) -> bool {
        same_bytes(given.as_bytes(), self.secret.as_bytes())
    }

    /// Refuses a request that exceeds this token's right.
    ///
    /// # Errors
    /// `forbidden`.
    pub fn allow(&self, needed: Right) -> Result<(), Problem> {
        if self.right >= needed {
            return Ok(());
        }
        let (name, own, needed) = (&self.name, self.right.word(), needed.word());
        let detail =
            format!("The token \"{name}\" has the right \"{own}\"; this operation needs \"{needed}\".");
        Err(Problem::new(Code::Forbidden, detail))
    }
}

/// The tokens of a server.
#[derive(Debug)]
pub struct TokenList {
    file: PathBuf,
    tokens: RwLock<Arc<[NamedToken]>>,
}

impl TokenList {
    /// Reads a file with one token, or with lines `NAME RIGHT TOKEN`.
    ///
    /// # Errors
    /// A sentence with the line.
    pub fn open(file: &Path) -> Result<Self, String> {
        let tokens = read(file)?;
        if tokens.is_empty() {
            return Err("no token in the file".into());
        }
        Ok(Self { file: file.to_owned(), tokens: RwLock::new(tokens.into()) })
    }

    /// Number of tokens by right.
    pub fn summary(&self) -> String {
        let tokens = self.tokens.read().unwrap_or_else(PoisonError::into_inner);
        let count = |right| tokens.iter().filter(|token| token.right == right).count();
        let counts = RIGHTS.map(|(word, right)| (word, count(right)));
        let counts = counts.iter().filter(|(_, count)| *count > 0);
        counts.map(|(word, count)| format!("{count} {word}")).collect::<Vec<_>>().join(", ")
    }

    /// Reads the file again whenever it changes; never returns. If the file has a fault, the tokens do not
    /// change.
    pub async fn follow(&self) {
        let mut seen = self.state();
        let mut look = tokio::time::interval(LOOK);
        loop {
            look.tick().await;
            let now = self.state();
            if now == seen {
                continue;
            }
            seen = now;
            match read(&self.file) {
                Ok(tokens) => {
                    tracing::info!(tokens = tokens.len(), "tokens were read again");
                    *self.tokens.write().unwrap_or_else(PoisonError::into_inner) = tokens.into();
                }
                Err(reason) => {
                    tracing::error!(reason, "the token file has a fault: the tokens before it hold")
                }
            }
        }
    }

    fn state(&self) -> Option<(SystemTime, u64)> {
        let metadata = std::fs::metadata(&self.file).ok()?;
        Some((metadata.modified().ok()?, metadata.len()))
    }

    /// Calls `found` with the request's token of the highest right.
    ///
    /// # Errors
    /// `unauthorized` without a token, or with one that is not in the file.
    pub fn bearer<T>(&self, headers: &HeaderMap, found: impl FnOnce(&NamedToken) -> T) -> Result<T, Problem> {
        let given = headers.get(header::AUTHORIZATION).and_then(|value| value.to_str().ok());
        let given = given.and_then(|value| value.split_once(' '));
        let given = given.filter(|(scheme, _)| scheme.eq_ignore_ascii_case("bearer"));
        let given = given.map(|(_, token)| token.trim_start());
        let carried =
            |token: &NamedToken| given.is_some_and(|given| token.is(given)) || token.cookie.is_in(headers);
        self.strongest(carried, found).ok_or_else(|| {
            let detail = match given {
                Some(_) => "The bearer token is not one of this server's.",
                None => "A bearer token is needed.",
            };
            Problem::new(Code::Unauthorized, detail)
        })
    }

    /// Calls `found` with the token of this text, if there is one.
    pub fn named<T>(&self, text: &str, found: impl FnOnce(&NamedToken) -> T) -> Option<T> {
        self.strongest(|token| token.is(text), found)
    }

    fn strongest<T>(
        &self,
        is: impl Fn(&NamedToken) -> bool,
        found: impl FnOnce(&NamedToken) -> T,
    ) -> Option<T> {
        let tokens = Arc::clone(&self.tokens.read().unwrap_or_else(PoisonError::into_inner));
        tokens.iter().filter(|token| is(token)).max_by_key(|token| token.right).map(found)
    }
}

fn read(path: &Path) -> Result<Vec<NamedToken>, String> {
    let text = std::fs::read_to_string(path).map_err(|error| error.to_string())?;
    #[cfg(unix)]
    {
        use std::os::unix::fs::MetadataExt;
        let metadata = std::fs::metadata(path).map_err(|error| error.to_string())?;
        check_mode(metadata.mode(), metadata.uid())?;
    }
    parse(&text)
}

/// Refuses a file that others than its owner can read. A file of root may be readable by its group: root
/// chose the group, as Kubernetes does for a volume (fsGroup). PostgreSQL has the same rule for its server
/// keys.
#[cfg(unix)]
fn check_mode(mode: u32, owner: u32) -> Result<(), String> {
    let (most, advice) = if owner == 0 { (0o640, "chmod 640") } else { (0o600, "chmod 600") };
    let beyond = mode & 0o077 & !most;
    if beyond == 0 {
        return Ok(());
    }
    let who = if beyond & 0o007 == 0 { "its group" } else { "others" };
    Err(format!(
        "mode {:o}: {who} may use it; {advice} is the most for its owner (user {owner})",
        mode & 0o777
    ))
}

fn parse(text: &str) -> Result<Vec<NamedToken>, String> {
    let mut names = BTreeSet::new();
    let lines =
        text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty() && !line.starts_with('#'));
    let lines: Vec<_> = lines.map(|(i, line)| (i, line.split_whitespace().collect::<Vec<_>>())).collect();
    if let [(_, only)] = lines.as_slice()
        && let [token] = only.as_slice()
    {
        return Ok(vec![NamedToken::new(ONLY, Right::Admin, token)?]);
    }
    let token = |(i, words): &(usize, Vec<&str>)| {
        let line = i + 1;
        let [name, right, token] = words.as_slice() else {
            return Err(format!("line {line}: NAME RIGHT TOKEN is expected"));
        };
        let Some((_, right)) = RIGHTS.iter().find(|(word, _)| word == right) else {
            return Err(format!("line {line}: right \"{right}\" found; read, edit or admin is expected"));
        };
        if !names.insert((*name).to_owned()) {
            return Err(format!("line {line}: the name \"{name}\" appears twice"));
        }
        NamedToken::new(name, *right, token).map_err(|reason| format!("line {line}: {reason}"))
    };
    lines.iter().map(token).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const A: &str = "aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa";
    const B: &str = "bbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbb";

    #[test]
    fn a_file_has_one_token_or_a_name_and_a_right_for_each() {
        let told = |text: &str| -> Vec<(String, Right)> {
            parse(text).unwrap().into_iter().map(|token| (token.name, token.right)).collect()
        };
        assert_eq!(told(&format!("{A}\n")), [("admin".into(), Right::Admin)]);
        let text = format!("# team\nanna edit {A}\n\n  guest\tread {B}\n");
        assert_eq!(told(&text), [("anna".into(), Right::Edit), ("guest".into(), Right::Read)]);
        for (text, reason) in [
            ("short".to_owned(), "a token of at least 32"),
            (format!("{A}\n{B}"), "line 1: NAME RIGHT TOKEN"),
            (format!("a read {A}\nb write {B}"), "line 2: right \"write\" found; read, edit or admin"),
            (format!("a read {A}\n\na edit {B}"), "line 3: the name \"a\" appears twice"),
            ("a read short".to_owned(), "line 1: a token of at least 32"),
        ] {
            let found = parse(&text).unwrap_err();
            assert!(found.starts_with(reason), "{found}");
        }
    }

    #[cfg(unix)]
    #[test]
    fn the_group_may_read_a_file_of_root_alone() {
        for (owner, modes) in [(0, &[0o600, 0o400, 0o640, 0o440][..]), (65_532, &[0o600, 0o400, 0o700])] {
            modes.iter().for_each(|mode| assert_eq!(check_mode(0o100_000 | mode, owner), Ok(()), "{mode:o}"));
        }
        for (owner, mode, reason) in [
            (65_532, 0o440, "mode 440: its group may use it; chmod 600"),
            (65_532, 0o604, "mode 604: others may use it; chmod 600"),
            (0, 0o660, "mode 660: its group may use it; chmod 640"),
            (0, 0o644, "mode 644: others may use it; chmod 640"),
        ] {
            let refused = check_mode(0o100_000 | mode, owner).unwrap_err();
            assert!(refused.starts_with(reason), "{refused}");
        }
    }

    #[test]
    fn operations_need_rights() {
        let needed = |method: &str, path: &str, query: Option<&str>| {
            Right::needed(&method.parse().unwrap(), path, query)
        };
        assert_eq!(needed("GET", "/v1/scenes/a", None), Right::Read);
        assert_eq!(needed("POST", "/v1/generate", None), Right::Read);
        assert_eq!(needed("POST", "/v1/import", Some("dry_run=true")), Right::Read);
        assert_eq!(needed("POST", "/v1/import", Some("format=osm")), Right::Edit);
        assert_eq!(needed("POST", "/v1/scenes", None), Right::Edit);
        assert_eq!(needed("POST", "/v1/scenes/a/duplicate", None), Right::Edit);
        assert_eq!(needed("DELETE", "/v1/scenes/a", None), Right::Edit);
        assert_eq!(needed("GET", "/metrics", None), Right::Admin);
    }
}
