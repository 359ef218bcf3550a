//! Ids of scenes, jobs and clients: `[A-Za-z0-9_-]{1,64}`.

/// Longest id, characters.
const LONGEST: usize = 64;

/// Whether a character may occur in an id.
fn is_legal(c: char) -> bool {
    c.is_ascii_alphanumeric() || c == '-' || c == '_'
}

/// Whether a text is a valid id.
pub fn is_id(text: &str) -> bool {
    (1..=LONGEST).contains(&text.len()) && text.chars().all(is_legal)
}

/// Converts a text to an id: invalid characters become `-`, and it is cut to the longest length.
pub fn cleaned(text: &str) -> String {
    text.chars().map(|c| if is_legal(c) { c } else { '-' }).take(LONGEST).collect()
}

/// A new unique id.
pub fn fresh() -> String {
    uuid::Uuid::now_v7().to_string()
}

#[cfg(test)]
mod tests {
    use super::{cleaned, fresh, is_id};

    #[test]
    fn ids_are_short_and_plain() {
        assert!(is_id("a") && is_id("A_z-09") && is_id(&fresh()));
        for bad in ["", "a b", "a/b", "ä", ".."] {
            assert!(!is_id(bad), "{bad}");
        }
        assert!(!is_id(&"a".repeat(65)));
        assert_eq!(cleaned("a b/ä"), "a-b--");
    }
}
