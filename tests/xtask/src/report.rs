//! Runs checks one after the other, and prints how each ended and how long it took.

use crate::Outcome;
use std::process::ExitCode;
use std::time::{Duration, Instant};

/// Body of a check.
pub type Work<'a> = &'a dyn Fn() -> anyhow::Result<Outcome>;

/// Runs all of them: a check that fails does not stop the others. With `strict`, a skipped check fails.
pub fn run<'a>(checks: impl IntoIterator<Item = (&'a str, Work<'a>)>, strict: bool) -> ExitCode {
    let mut lines = Vec::new();
    for (name, check) in checks {
        println!("== {name}");
        let began = Instant::now();
        let outcome = match check() {
            Ok(Outcome::Skipped(why)) if strict => Outcome::Failed(format!("skipped: {why}")),
            Ok(outcome) => outcome,
            Err(error) => Outcome::Failed(format!("{error:#}")),
        };
        lines.push((name, began.elapsed(), outcome));
    }
    let failed = lines.iter().any(|(.., outcome)| matches!(outcome, Outcome::Failed(_)));
    println!("\n{}", table(lines));
    if failed { ExitCode::FAILURE } else { ExitCode::SUCCESS }
}

/// A line for each check, the slowest first, and their sums.
fn table(mut lines: Vec<(&str, Duration, Outcome)>) -> String {
    let total: Duration = lines.iter().map(|(_, time, _)| *time).sum();
    lines.sort_by_key(|(_, time, _)| std::cmp::Reverse(*time));
    let (mut passed, mut failed, mut skipped) = (0, 0, 0);
    let mut text = String::new();
    for (name, time, outcome) in lines {
        let (count, words) = match outcome {
            Outcome::Passed => (&mut passed, "passed".to_owned()),
            Outcome::Told(what) => (&mut passed, format!("passed: {what}")),
            Outcome::Skipped(why) => (&mut skipped, format!("skipped: {why}")),
            Outcome::Failed(why) => (&mut failed, format!("FAILED: {why}")),
        };
        *count += 1;
        text.push_str(&format!("{name:<13} {:>5} s  {words}\n", time.as_secs()));
    }
    text.push_str(&format!("{:<13} {:>5} s\n\n", "total", total.as_secs()));
    text.push_str(&format!("checks: {passed} passed, {failed} failed, {skipped} skipped"));
    text
}

#[cfg(test)]
mod tests {
    use super::{Outcome, run, table};
    use std::process::ExitCode;
    use std::time::Duration;

    #[test]
    fn the_slowest_check_comes_first_and_the_sums_last() {
        let lines = vec![
            ("fmt", Duration::from_secs(3), Outcome::Passed),
            ("test", Duration::from_secs(400), Outcome::Failed("two".into())),
            ("wasm", Duration::from_secs(20), Outcome::Skipped("no compiler".into())),
        ];
        let expected = "test            400 s  FAILED: two\nwasm             20 s  skipped: no compiler\n\
                        fmt               3 s  passed\ntotal           423 s\n\n\
                        checks: 1 passed, 1 failed, 1 skipped";
        assert_eq!(table(lines), expected);
    }

    #[test]
    fn a_skipped_check_fails_where_that_is_asked_for() {
        let skips = || Ok(Outcome::Skipped("no compiler".into()));
        assert_eq!(run([("wasm", &skips as _)], false), ExitCode::SUCCESS);
        assert_eq!(run([("wasm", &skips as _)], true), ExitCode::FAILURE);
    }
}
