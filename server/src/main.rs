//! The program `dragtraffic`. Without a command it serves the editor; `dragtraffic --help` lists the
//! commands.

use std::process::ExitCode;

/// The allocator keeps freed memory for the next tensor, because candle allocates each operation's output.
/// Memory unused for ten seconds returns to the system, so a large import does not stay resident. There are no
/// huge pages, because 2 MB of one stay resident while any part of it is in use.
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

/// Environment variables that the numeric libraries read at start-up. One thread per call: workers already
/// run scenes and calls in parallel, and candle's own threads cost more than they gain at this size.
const SETTINGS: [(&str, &str); 4] = [
    ("CANDLE_NUM_THREADS", "1"),
    ("RAYON_NUM_THREADS", "1"),
    ("MIMALLOC_PURGE_DELAY", "10000"),
    ("MIMALLOC_ALLOW_THP", "0"),
];

fn main() -> ExitCode {
    with_settings();
    ExitCode::from(dragtraffic::run(std::env::args_os()))
}

/// Restarts the program with missing settings, because the allocator has read its own before `main`. Values
/// of the user are kept.
fn with_settings() {
    if SETTINGS.iter().all(|(name, _)| std::env::var_os(name).is_some()) {
        return;
    }
    #[cfg(unix)]
    if let Ok(program) = std::env::current_exe() {
        use std::os::unix::process::CommandExt;
        let missing = SETTINGS.into_iter().filter(|(name, _)| std::env::var_os(name).is_none());
        let mut command = std::process::Command::new(program);
        if let Some(name) = std::env::args_os().next() {
            command.arg0(name);
        }
        // Returns only on failure; the program then runs without the settings, slightly slower.
        let _ = command.args(std::env::args_os().skip(1)).envs(missing).exec();
    }
}
