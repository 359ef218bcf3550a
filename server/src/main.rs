//! The program `dragtraffic`. Without a command it serves the editor; `dragtraffic --help` lists the rest.

use std::process::ExitCode;

/// The allocator keeps freed memory for the next tensor, because candle allocates each operation's output.
/// Memory unused for ten seconds returns to the system, so a large import does not stay resident.
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

/// Environment variables that the numeric libraries read at their start. One thread a call: workers already
/// run scenes and calls in parallel, and candle's own threads cost more than they gain at this size.
const SETTINGS: [(&str, &str); 3] =
    [("CANDLE_NUM_THREADS", "1"), ("RAYON_NUM_THREADS", "1"), ("MIMALLOC_PURGE_DELAY", "10000")];

fn main() -> ExitCode {
    with_settings();
    ExitCode::from(dragtraffic::run(std::env::args_os()))
}

/// Starts the program again with the settings in place where they are missing; the allocator has
/// read its own before `main`. Values that the user gave are kept.
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
        // Returns only when it fails; the program then runs as it is, a little slower.
        let _ = command.args(std::env::args_os().skip(1)).envs(missing).exec();
    }
}
