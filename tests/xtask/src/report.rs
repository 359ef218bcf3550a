//! Runs checks in stages, and prints their results and durations.

use crate::Outcome;
use std::cell::RefCell;
use std::io::Write;
use std::panic::resume_unwind;
use std::process::{Command, ExitCode, ExitStatus, Stdio};
use std::time::{Duration, Instant};

/// Body of a check.
pub type Work<'a> = &'a (dyn Fn() -> anyhow::Result<Outcome> + Sync);
/// Checks that run one after the other.
pub type Lane<'a> = Vec<(&'a str, Work<'a>)>;
/// Name, duration and result of a check.
type Line<'a> = (&'a str, Duration, Outcome);

thread_local! {
    /// Output of the commands of a check that runs beside another one.
    static HELD: RefCell<Option<Vec<u8>>> = const { RefCell::new(None) };
}

/// Runs the stages in order and the lanes of each in parallel: a failed check does not stop the others. With
/// `strict`, a skipped check fails. The output of failed parallel checks comes last, just above the table.
pub fn run(stages: Vec<Vec<Lane<'_>>>, strict: bool) -> ExitCode {
    let began = Instant::now();
    let (mut lines, mut faults) = (Vec::new(), Vec::new());
    for mut lanes in stages {
        lanes.retain(|lane| !lane.is_empty());
        match &lanes[..] {
            [lane] => lines.extend(lane.iter().map(|(name, work)| ended(name, *work, strict))),
            lanes => {
                for (line, text) in side_by_side(lanes, strict) {
                    lines.push(line);
                    faults.extend(text);
                }
            }
        }
    }
    faults.iter().for_each(|text| print_bytes(text));
    let failed = lines.iter().any(|(.., outcome)| matches!(outcome, Outcome::Failed(_)));
    println!("\n{}", table(lines, began.elapsed()));
    if failed { ExitCode::FAILURE } else { ExitCode::SUCCESS }
}

/// Runs each lane on a thread. The output of a check's commands comes at its end; if it failed, with its
/// line.
fn side_by_side<'a>(lanes: &[Lane<'a>], strict: bool) -> Vec<(Line<'a>, Option<Vec<u8>>)> {
    let held = move |(name, work): &(&'a str, Work<'a>)| {
        HELD.set(Some(format!("== {name}\n").into_bytes()));
        let line = worked(name, *work, strict);
        let text = HELD.take().unwrap_or_default();
        if matches!(line.2, Outcome::Failed(_)) {
            return (line, Some(text));
        }
        print_bytes(&text);
        (line, None)
    };
    std::thread::scope(|scope| {
        let threads: Vec<_> =
            lanes.iter().map(|lane| scope.spawn(move || lane.iter().map(held).collect::<Vec<_>>())).collect();
        let ended =
            threads.into_iter().flat_map(|thread| thread.join().unwrap_or_else(|why| resume_unwind(why)));
        ended.collect()
    })
}

fn print_bytes(text: &[u8]) {
    // A closed terminal is not a fault of the check.
    let _ = std::io::stdout().lock().write_all(text);
}

fn ended<'a>(name: &'a str, work: Work<'_>, strict: bool) -> Line<'a> {
    println!("== {name}");
    worked(name, work, strict)
}

fn worked<'a>(name: &'a str, work: Work<'_>, strict: bool) -> Line<'a> {
    let began = Instant::now();
    let outcome = match work() {
        Ok(Outcome::Skipped(why)) if strict => Outcome::Failed(format!("skipped: {why}")),
        Ok(outcome) => outcome,
        Err(error) => Outcome::Failed(format!("{error:#}")),
    };
    (name, began.elapsed(), outcome)
}

/// Runs a command. Its output is held back while another check runs beside this one.
///
/// # Errors
/// If it cannot be started.
pub fn status(command: &mut Command) -> std::io::Result<ExitStatus> {
    command.stdin(Stdio::null());
    if HELD.with_borrow(Option::is_none) {
        return command.status();
    }
    // One pipe for both, so that lines keep their order.
    let (mut read, write) = std::io::pipe()?;
    let mut child = command.stdout(write.try_clone()?).stderr(write).spawn()?;
    // The command holds the ends of the pipe until it gets others.
    command.stdout(Stdio::null()).stderr(Stdio::null());
    let mut text = Vec::new();
    std::io::Read::read_to_end(&mut read, &mut text)?;
    HELD.with_borrow_mut(|held| held.get_or_insert_default().extend(text));
    child.wait()
}

/// A line for each check, the slowest first, and the sums.
fn table(mut lines: Vec<Line<'_>>, total: Duration) -> String {
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
    use super::{HELD, Outcome, run, side_by_side, status, table};
    use std::process::{Command, ExitCode};
    use std::sync::Barrier;
    use std::sync::atomic::{AtomicUsize, Ordering};
    use std::time::Duration;

    #[test]
    fn the_slowest_check_comes_first_and_the_sums_last() {
        let lines = vec![
            ("fmt", Duration::from_secs(3), Outcome::Passed),
            ("test", Duration::from_secs(400), Outcome::Failed("two".into())),
            ("wasm", Duration::from_secs(20), Outcome::Skipped("no compiler".into())),
        ];
        let expected = "test            400 s  FAILED: two\nwasm             20 s  skipped: no compiler\n\
                        fmt               3 s  passed\ntotal           410 s\n\n\
                        checks: 1 passed, 1 failed, 1 skipped";
        assert_eq!(table(lines, Duration::from_secs(410)), expected);
    }

    #[test]
    fn a_skipped_check_fails_where_that_is_asked_for() {
        let skips = || Ok(Outcome::Skipped("no compiler".into()));
        let stage = || vec![vec![vec![("wasm", &skips as _)]]];
        assert_eq!(run(stage(), false), ExitCode::SUCCESS);
        assert_eq!(run(stage(), true), ExitCode::FAILURE);
    }

    #[test]
    fn lanes_run_beside_each_other_and_stages_one_after_the_other() {
        let (here, there) = (Barrier::new(2), AtomicUsize::new(0));
        // Each of the two waits for the other.
        let meets = || {
            here.wait();
            there.fetch_add(1, Ordering::Relaxed);
            Ok(Outcome::Passed)
        };
        let both_met = || match there.load(Ordering::Relaxed) {
            2 => Ok(Outcome::Passed),
            met => Ok(Outcome::Failed(format!("{met} of 2"))),
        };
        let stages = vec![
            vec![vec![("a", &meets as _)], vec![("b", &meets as _)], Vec::new()],
            vec![vec![("after", &both_met as _)]],
        ];
        assert_eq!(run(stages, true), ExitCode::SUCCESS);
        let fails = || anyhow::bail!("broken");
        let passes = || Ok(Outcome::Passed);
        let stages = vec![vec![vec![("a", &fails as _)], vec![("b", &passes as _)]]];
        assert_eq!(run(stages, false), ExitCode::FAILURE);
    }

    #[test]
    fn what_a_failed_check_printed_comes_with_its_line() {
        let fails = || {
            status(Command::new("cargo").arg("no-such-command"))?;
            anyhow::bail!("broken")
        };
        let passes = || {
            status(Command::new("cargo").arg("--version"))?;
            Ok(Outcome::Passed)
        };
        let ended = side_by_side(&[vec![("a", &fails as _)], vec![("b", &passes as _)]], false);
        let texts: Vec<_> = ended.into_iter().map(|(line, text)| (line.0, text)).collect();
        let [("a", Some(failed)), ("b", None)] = &texts[..] else { panic!("{texts:?}") };
        assert!(String::from_utf8_lossy(failed).contains("no-such-command"));
    }

    #[test]
    fn what_a_command_prints_is_held_in_its_order_where_another_check_runs() {
        HELD.set(Some(Vec::new()));
        let ended = status(Command::new("cargo").arg("--version")).unwrap();
        let failed = status(Command::new("cargo").arg("no-such-command")).unwrap();
        let text = String::from_utf8(HELD.take().unwrap()).unwrap();
        assert!(ended.success() && !failed.success());
        assert!(text.starts_with("cargo 1.") && text.contains("no-such-command"), "{text}");
    }
}
