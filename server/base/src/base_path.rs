//! The base path under which a proxy publishes this server, such as `/tools/drag`. There is one per process.

use std::sync::OnceLock;

static BASE: OnceLock<String> = OnceLock::new();

/// Sets the path, once. A trailing slash is dropped.
///
/// # Errors
/// A sentence about an invalid path.
pub fn set(path: &str) -> Result<(), String> {
    let path = path.strip_suffix('/').unwrap_or(path);
    let plain = |c: char| c.is_ascii_alphanumeric() || "-._~/".contains(c);
    let segments =
        path.strip_prefix('/').map(|rest| rest.split('/').all(|part| !part.trim_matches('.').is_empty()));
    if !path.is_empty() && (segments != Some(true) || !path.chars().all(plain)) {
        return Err(format!("\"{path}\" found; a path such as /tools/drag is expected"));
    }
    BASE.set(path.to_owned()).map_err(|_| "it is set already".to_owned())
}

/// The path; empty for a server at the root.
pub fn base() -> &'static str {
    BASE.get().map_or("", String::as_str)
}

/// An address of this server, which begins with `/`, as clients see it.
pub fn published(path: &str) -> String {
    format!("{}{path}", base())
}

/// The server's address for one that a client sees.
pub fn within(path: &str) -> Option<&str> {
    below(base(), path)
}

fn below<'p>(base: &str, path: &'p str) -> Option<&'p str> {
    path.strip_prefix(base).filter(|rest| rest.starts_with('/'))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn addresses_lie_below_the_path_or_elsewhere() {
        assert_eq!(below("/tools/drag", "/tools/drag/v1/info"), Some("/v1/info"));
        assert_eq!(below("/tools/drag", "/tools/drag/"), Some("/"));
        assert_eq!(below("/tools/drag", "/tools/drag"), None);
        assert_eq!(below("/tools/drag", "/tools/dragon/"), None);
        assert_eq!(below("", "/v1/info"), Some("/v1/info"));
    }

    #[test]
    fn other_texts_are_no_paths() {
        for text in ["tools", "//", "/a//b", "/a/../b", "/a b", "/ä", "https://a/b"] {
            assert!(set(text).is_err(), "{text}");
        }
    }
}
