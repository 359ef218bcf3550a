//! Ids of scenes, jobs and clients: `[A-Za-z0-9_-]{1,64}`.

/// Most characters of an id.
const LONGEST: usize = 64;

/// True for a character that an id may have.
fn is_legal(c: char) -> bool {
    c.is_ascii_alphanumeric() || c == '-' || c == '_'
}

/// True for text that can be an id.
pub fn is_id(text: &str) -> bool {
    (1..=LONGEST).contains(&text.len()) && text.chars().all(is_legal)
}

/// Text as an id: other characters become `-`, what is too long is cut.
pub fn cleaned(text: &str) -> String {
    text.chars().map(|c| if is_legal(c) { c } else { '-' }).take(LONGEST).collect()
}

/// A new id that nothing else has.
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
