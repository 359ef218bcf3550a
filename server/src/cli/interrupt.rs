//! Ctrl-C and its like: files are whole or not there, and long runs may keep what is done.

use super::{Exit, output};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use tokio::signal::unix::{SignalKind, signal};

/// What a process that was asked to terminate ends with.
const TERMINATED: i32 = 143;

/// Watches for Ctrl-C and a request to terminate: what is half written goes, and the program ends.
pub fn watch() {
    listen(None);
}

/// As [`watch`], but the first request sets a flag, for work that ends by itself soon; the second ends the program.
#[cfg(feature = "lab")]
pub fn gently() -> Arc<AtomicBool> {
    let asked = Arc::new(AtomicBool::new(false));
    listen(Some(Arc::clone(&asked)));
    asked
}

fn listen(gentle: Option<Arc<AtomicBool>>) {
    let Ok(runtime) = tokio::runtime::Builder::new_current_thread().enable_all().build() else { return };
    // Registered before this returns: no request that comes later is missed.
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
