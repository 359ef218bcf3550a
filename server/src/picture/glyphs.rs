//! Letters of pictures: three columns by five rows of squares, enough for ids and numbers.

/// Columns of a letter.
pub const COLUMNS: usize = 3;
/// Rows of a letter.
pub const ROWS: usize = 5;

/// Letters by row from the top, one octal digit per row. Lower case is drawn as upper case.
const LETTERS: [(char, u32); 42] = [
    ('0', 0o75557),
    ('1', 0o26227),
    ('2', 0o71747),
    ('3', 0o71717),
    ('4', 0o55711),
    ('5', 0o74717),
    ('6', 0o74757),
    ('7', 0o71222),
    ('8', 0o75757),
    ('9', 0o75717),
    ('A', 0o25755),
    ('B', 0o65656),
    ('C', 0o34443),
    ('D', 0o65556),
    ('E', 0o74647),
    ('F', 0o74644),
    ('G', 0o34553),
    ('H', 0o55755),
    ('I', 0o72227),
    ('J', 0o11152),
    ('K', 0o55655),
    ('L', 0o44447),
    ('M', 0o57755),
    ('N', 0o65555),
    ('O', 0o25552),
    ('P', 0o65644),
    ('Q', 0o25563),
    ('R', 0o65655),
    ('S', 0o34216),
    ('T', 0o72222),
    ('U', 0o55557),
    ('V', 0o55552),
    ('W', 0o55775),
    ('X', 0o55255),
    ('Y', 0o55222),
    ('Z', 0o71247),
    ('-', 0o00700),
    ('_', 0o00007),
    ('.', 0o00002),
    (':', 0o02020),
    ('/', 0o11244),
    (' ', 0),
];

/// Columns and rows of the squares of a letter; an unknown letter is a frame.
pub fn squares(letter: char) -> impl Iterator<Item = (usize, usize)> {
    let capital = letter.to_ascii_uppercase();
    let rows = LETTERS.iter().find(|(known, _)| *known == capital).map_or(0o75557, |(_, rows)| *rows);
    let all = (0..ROWS).flat_map(|row| (0..COLUMNS).map(move |column| (column, row)));
    all.filter(move |(column, row)| rows >> ((ROWS - 1 - row) * COLUMNS + COLUMNS - 1 - column) & 1 == 1)
}

#[cfg(test)]
mod tests {
    use super::{COLUMNS, LETTERS, ROWS, squares};

    fn drawn(letter: char) -> Vec<String> {
        let on: Vec<_> = squares(letter).collect();
        let row = |r| (0..COLUMNS).map(|c| if on.contains(&(c, r)) { '#' } else { '.' }).collect();
        (0..ROWS).map(row).collect()
    }

    #[test]
    fn letters_are_told_apart() {
        assert_eq!(drawn('7'), ["###", "..#", ".#.", ".#.", ".#."]);
        assert_eq!(drawn('a'), [".#.", "#.#", "###", "#.#", "#.#"]);
        for (i, (letter, rows)) in LETTERS.iter().enumerate() {
            assert!(LETTERS[..i].iter().all(|(_, other)| other != rows), "{letter}");
        }
    }
}
