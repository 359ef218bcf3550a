//! Similar names, for hints at typos.

/// Number of letters that are compared.
const MOST_LETTERS: usize = 80;
/// Most letters that a typo changes.
const SLIP: usize = 3;

/// The known name of which `name` is probably a typo; `None` if none is close enough.
fn nearest<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let close = known.into_iter().filter_map(|known| Some((distance(known, name)?, known)));
    close.min().map(|(_, known)| known)
}

/// The hint after an unknown name; empty if no known name is close.
pub fn hint<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> String {
    nearest(name, known).map_or_else(String::new, |meant| format!(" (did you mean {meant}?)"))
}

/// Whether it is 1 to `most` letters, digits, - and _.
pub(crate) fn is_name(name: &str, most: usize) -> bool {
    let legal = |c: char| c.is_ascii_alphanumeric() || c == '-' || c == '_';
    (1..=most).contains(&name.len()) && name.chars().all(legal)
}

/// Edit distance, if it is small enough for a typo.
fn distance(a: &str, b: &str) -> Option<usize> {
    let b: Vec<char> = b.chars().take(MOST_LETTERS).collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, x) in a.chars().enumerate() {
        let mut before = row[0];
        row[0] = i + 1;
        for (j, y) in b.iter().enumerate() {
            let changed = before + usize::from(x != *y);
            before = row[j + 1];
            row[j + 1] = changed.min(row[j] + 1).min(before + 1);
        }
    }
    row.last().copied().filter(|d| *d <= SLIP)
}

#[cfg(test)]
mod tests {
    use super::nearest;

    #[test]
    fn a_slip_has_a_neighbour_and_another_word_has_none() {
        let known = ["seeds", "scenes", "where"];
        assert_eq!(nearest("seed", known), Some("seeds"));
        assert_eq!(nearest("sceens", known), Some("scenes"));
        assert_eq!(nearest("something_else", known), None);
    }
}
