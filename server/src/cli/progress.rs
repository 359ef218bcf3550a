//! Progress of a long command: a bar with the remaining time on a terminal, a line every few seconds
//! elsewhere, nothing under `--quiet`.

use super::output;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::IsTerminal;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// Interval of lines if there is no terminal.
const EVERY: Duration = Duration::from_secs(5);
/// Interval at which the bar moves while nothing completes.
const TICK: Duration = Duration::from_millis(250);
const STYLE: &str = "{msg} {wide_bar} {pos} of {len}, {elapsed} so far, {eta} left";

/// Progress of one command.
pub struct Progress {
    what: &'static str,
    quiet: bool,
    bar: Option<ProgressBar>,
    state: Mutex<State>,
}

#[derive(Clone, Copy)]
struct State {
    done: u64,
    /// Number of items done before the command began.
    before: u64,
    total: u64,
    began: Instant,
    told: Instant,
}

impl Progress {
    /// Progress over `total` items, named by `what`, such as "scenes".
    pub fn new(what: &'static str, total: u64, quiet: bool) -> Self {
        let bar = (!quiet && total > 1 && std::io::stderr().is_terminal()).then(|| {
            let bar = ProgressBar::with_draw_target(Some(total), ProgressDrawTarget::stderr());
            // If the style cannot be parsed, the default one is used.
            let style = ProgressStyle::with_template(STYLE).unwrap_or_else(|_| ProgressStyle::default_bar());
            bar.set_style(style);
            bar.set_message(what);
            bar.enable_steady_tick(TICK);
            bar
        });
        let now = Instant::now();
        Self {
            what,
            quiet,
            bar,
            state: Mutex::new(State { done: 0, before: 0, total, began: now, told: now }),
        }
    }

    /// Counts one more item.
    pub fn step(&self) {
        let done = self.lock().done + 1;
        self.reach(done);
    }

    /// Sets the number of completed items.
    pub fn reach(&self, done: u64) {
        let mut state = self.lock();
        state.done = done;
        if let Some(bar) = &self.bar {
            bar.set_position(done);
        } else if !self.quiet && state.told.elapsed() >= EVERY {
            state.told = Instant::now();
            output::complain(&text(self.what, &state, state.began.elapsed()));
        }
    }

    /// Sets the number of items that an earlier run completed.
    #[cfg(feature = "lab")]
    pub fn begin(&self, before: u64) {
        let mut state = self.lock();
        (state.done, state.before) = (before, before);
        if let Some(bar) = &self.bar {
            bar.set_position(before);
            bar.reset_eta();
        }
    }

    /// Prints a permanent line above the bar; nothing under `--quiet`.
    pub fn line(&self, text: &str) {
        if !self.quiet {
            self.error(text);
        }
    }

    /// Prints a line even under `--quiet`.
    pub fn error(&self, text: &str) {
        match &self.bar {
            Some(bar) => bar.suspend(|| output::complain(text)),
            None => output::complain(text),
        }
    }

    /// Hides the bar while `write` prints results to stdout.
    pub fn pausing<R>(&self, write: impl FnOnce() -> R) -> R {
        match &self.bar {
            Some(bar) => bar.suspend(write),
            None => write(),
        }
    }

    fn lock(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}

/// A progress line for output without a terminal.
fn text(what: &str, state: &State, elapsed: Duration) -> String {
    let State { done, before, total, .. } = state;
    let (left, own) = (total.saturating_sub(*done), done.saturating_sub(*before));
    if own == 0 || left == 0 {
        return format!("{done} of {total} {what}");
    }
    let left_s = (elapsed.as_secs_f64() / own as f64 * left as f64).round() as u64;
    let left = match left_s {
        0..=119 => format!("{left_s} s"),
        120..=7199 => format!("{} min", left_s / 60),
        _ => format!("{} h", left_s / 3600),
    };
    format!("{done} of {total} {what}, about {left} left")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_say_how_far_and_how_long() {
        let now = Instant::now();
        let at = |done| State { done, before: 0, total: 100, began: now, told: now };
        let after = |done, seconds| text("scenes", &at(done), Duration::from_secs(seconds));
        assert_eq!(after(0, 3), "0 of 100 scenes");
        assert_eq!(after(25, 10), "25 of 100 scenes, about 30 s left");
        assert_eq!(after(10, 60), "10 of 100 scenes, about 9 min left");
        assert_eq!(after(1, 600), "1 of 100 scenes, about 16 h left");
        assert_eq!(after(100, 9), "100 of 100 scenes");
        let resumed = State { before: 80, ..at(90) };
        assert_eq!(text("steps", &resumed, Duration::from_secs(5)), "90 of 100 steps, about 5 s left");
    }
}
