//! Ctrl-C and similar signals: files are complete or absent, and long runs may keep finished results.

use super::{Exit, output};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use tokio::signal::unix::{SignalKind, signal};

/// Exit code of a process that was asked to terminate.
const TERMINATED: i32 = 143;

/// Watches for Ctrl-C and termination requests: removes incomplete files and ends the program.
pub fn watch() {
    listen(None);
}

/// As [`watch`], but the first request sets a flag for work that ends soon by itself; the second one ends the
/// program.
#[cfg(feature = "lab")]
pub fn gently() -> Arc<AtomicBool> {
    let asked = Arc::new(AtomicBool::new(false));
    listen(Some(Arc::clone(&asked)));
    asked
}

fn listen(gentle: Option<Arc<AtomicBool>>) {
    let Ok(runtime) = tokio::runtime::Builder::new_current_thread().enable_all().build() else { return };
    // Registered before this returns, so no later request is missed.
    let guard = runtime.enter();
    let signals = signal(SignalKind::interrupt()).and_then(|int| Ok((int, signal(SignalKind::terminate())?)));
    drop(guard);
    let Ok((mut interrupt, mut terminate)) = signals else { return };
    std::thread::spawn(move || {
        runtime.block_on(async move {
            let mut left = usize::from(gentle.is_some());
            loop {
                let code = tokio::select! {
                    _ = interrupt.recv() => Exit::Interrupted as i32,
                    _ = terminate.recv() => TERMINATED,
                };
                match &gentle {
                    Some(asked) if left > 0 => {
                        left -= 1;
                        asked.store(true, Ordering::Relaxed);
                        output::complain("stopping after this step; once more ends at once");
                    }
                    _ => {
                        formats::files::abandon();
                        std::process::exit(code);
                    }
                }
            }
        });
    });
}
