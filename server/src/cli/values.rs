//! Parsers of flag values. They check while clap parses, so that messages name the flag.

use formats::around::Around;
use std::ops::Range;

/// Most seeds of one call.
const MOST_SEEDS: u64 = 100_000;

/// A number from `min` to `max`, both included; `unit` such as "seconds", or empty.
pub fn within(
    min: f64,
    max: f64,
    unit: &'static str,
) -> impl Fn(&str) -> Result<f64, String> + Clone + Send + Sync + 'static {
    move |text| {
        let expected = || format!("{min} to {max} {unit}").trim_end().to_owned();
        number(text)
            .ok()
            .filter(|v| (min..=max).contains(v))
            .ok_or_else(|| format!("{} expected", expected()))
    }
}

/// A finite number.
///
/// # Errors
/// One sentence.
pub fn number(text: &str) -> Result<f64, String> {
    let number = text.trim().parse().ok().filter(|v: &f64| v.is_finite());
    number.ok_or_else(|| format!("\"{text}\" is not a number"))
}

/// A whole number from `min` to `max`, both included.
pub fn whole(min: u64, max: u64) -> impl Fn(&str) -> Result<u64, String> + Clone + Send + Sync + 'static {
    move |text| {
        let number = text.trim().parse().ok().filter(|n| (min..=max).contains(n));
        number.ok_or_else(|| format!("a whole number from {min} to {max} expected"))
    }
}

/// One of a few numbers.
pub fn one_of(
    allowed: &'static [f64],
) -> impl Fn(&str) -> Result<f64, String> + Clone + Send + Sync + 'static {
    move |text| {
        let found = number(text).ok().filter(|v| allowed.contains(v));
        found.ok_or_else(|| {
            let words: Vec<String> = allowed.iter().map(f64::to_string).collect();
            format!("{} expected", words.join(", "))
        })
    }
}

/// Seeds: a count from 0, or `FIRST..LAST`.
///
/// # Errors
/// One sentence.
pub fn seeds(text: &str) -> Result<Range<u64>, String> {
    let expected = || "a count such as 20, or FIRST..LAST such as 0..19 expected".to_owned();
    let most = formats::native::MAX_SAFE_INTEGER;
    let whole = |text: &str| text.trim().parse::<u64>().ok().filter(|n| *n <= most).ok_or_else(expected);
    let range = match text.split_once("..") {
        Some((first, last)) => whole(first)?..whole(last)? + 1,
        None => 0..whole(text)?,
    };
    match range.end.checked_sub(range.start) {
        Some(1..=MOST_SEEDS) => Ok(range),
        Some(0) | None => Err("at least one seed expected".into()),
        Some(_) => Err(format!("at most {MOST_SEEDS} seeds expected")),
    }
}

/// The circle of a map to read.
pub fn around(text: &str) -> Result<Around, String> {
    text.parse().map_err(|message: scene::message::Message| message.to_string())
}

/// Indices of scenes in a file: one number, or `FIRST..LAST`.
///
/// # Errors
/// One sentence.
pub fn index(text: &str) -> Result<Range<usize>, String> {
    api::import::range(text).map_err(|problem| problem.detail)
}

/// A value for one road user.
#[derive(Clone, Debug, PartialEq)]
pub struct For<T> {
    /// Id of the road user.
    pub id: String,
    /// The value.
    pub value: T,
}

/// Parses `ID=...` with `parse` for the rest.
pub fn for_one<T>(
    parse: fn(&str) -> Result<T, String>,
) -> impl Fn(&str) -> Result<For<T>, String> + Clone + Send + Sync + 'static
where
    T: 'static,
{
    move |text| match text.split_once('=') {
        Some((id, rest)) if !id.is_empty() => Ok(For { id: id.to_owned(), value: parse(rest)? }),
        _ => Err("the id of a road user and = expected first, as in 6=...".into()),
    }
}

/// Parses the share in `NAME=0.8`.
///
/// # Errors
/// One sentence.
pub fn share(text: &str) -> Result<f64, String> {
    number(text).ok().filter(|v| *v >= 0.0).ok_or_else(|| "a share such as 0.8 expected".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_held_to_their_range() {
        let seconds = within(0.5, 20.0, "seconds");
        assert_eq!(seconds("20"), Ok(20.0));
        for bad in ["0.4", "20.1", "NaN", "inf", "", "ten"] {
            assert_eq!(seconds(bad), Err("0.5 to 20 seconds expected".into()), "{bad}");
        }
        assert_eq!(one_of(&[3.0, 6.0])("4"), Err("3, 6 expected".into()));
    }

    #[test]
    fn seeds_are_a_count_or_a_range() {
        assert_eq!(seeds("20"), Ok(0..20));
        assert_eq!(seeds("5..8"), Ok(5..9));
        assert_eq!(seeds("5..5"), Ok(5..6));
        for bad in ["0", "8..5", "-1", "a", "1..2..3", "200000"] {
            assert!(seeds(bad).is_err(), "{bad}");
        }
    }
}
