//! Licences of products of several sources: the strictest one applies to the whole.

/// Licence of data that states none.
pub const UNKNOWN: &str = "unknown";

/// Strictness of a licence, by the words that importers set. An unknown licence counts as stricter than all
/// others except non-commercial ones.
fn strictness(licence: &str) -> u8 {
    let words: Vec<String> =
        licence.to_ascii_lowercase().split(['-', ' ', '_', '.']).map(str::to_owned).collect();
    let has = |word: &str| words.iter().any(|w| w == word);
    match () {
        () if has("nc") => 5,
        () if has("odbl") || has("sa") => 3,
        () if has("by") => 2,
        () if has("cc0") || licence.eq_ignore_ascii_case("public domain") => 0,
        () if has("mit") || has("apache") || has("bsd") => 1,
        () => 4,
    }
}

/// Whether use must be non-commercial: Waymo's and Argoverse's terms, by the word that importers set.
pub fn is_noncommercial(licence: &str) -> bool {
    strictness(licence) == 5
}

/// Whether the licence demands at most that copies of a program name its authors.
pub fn is_open(licence: &str) -> bool {
    strictness(licence) <= 1
}

/// The licence of a product of all these sources; equally strict licences apply together. `None` if there are
/// none.
pub fn strictest<'a>(licences: impl IntoIterator<Item = &'a str>) -> Option<String> {
    let parts: Vec<&str> = licences.into_iter().flat_map(|licence| licence.split(" AND ")).collect();
    let most = parts.iter().map(|part| strictness(part)).max()?;
    let mut held: Vec<&str> = parts.into_iter().filter(|part| strictness(part) == most).collect();
    held.sort_unstable();
    held.dedup();
    Some(held.join(" AND "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_strictest_wins() {
        let of = |licences: &[&str]| strictest(licences.iter().copied()).unwrap();
        assert_eq!(of(&["cc0", "waymo-nc", "MIT OR Apache-2.0"]), "waymo-nc");
        assert_eq!(of(&["cc0", UNKNOWN, "cc-by-4.0"]), UNKNOWN);
        assert_eq!(of(&["waymo-nc", "cc-by-nc-sa-4.0", "waymo-nc"]), "cc-by-nc-sa-4.0 AND waymo-nc");
        assert_eq!(of(&["cc-by-nc-sa-4.0 AND waymo-nc", "waymo-nc"]), "cc-by-nc-sa-4.0 AND waymo-nc");
        assert_eq!(of(&["cc0", "MIT OR Apache-2.0"]), "MIT OR Apache-2.0");
        assert_eq!(strictest([]), None);
    }

    #[test]
    fn words_of_licences() {
        assert!(is_noncommercial("waymo-nc") && is_noncommercial("CC-BY-NC-SA-4.0"));
        assert!(!is_noncommercial("cc0") && !is_noncommercial("once"));
        assert!(is_open("cc0") && is_open("MIT OR Apache-2.0"));
        assert!(!is_open("odbl") && !is_open(UNKNOWN) && !is_open("waymo-nc"));
    }
}
