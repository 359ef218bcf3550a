//! Descriptors that the process may have: each connection takes one.

/// Descriptors for everything but connections: the store, its readers, files that are written, libraries.
#[cfg(target_os = "linux")]
const OTHERS: u64 = 64;

/// Most connections for which there are descriptors, at most `wanted`; raises the process's own limit where it may.
#[cfg(target_os = "linux")]
pub fn connections(wanted: u64) -> u64 {
    use rustix::process::{Resource, Rlimit, getrlimit, setrlimit};
    let Rlimit { current, maximum } = getrlimit(Resource::Nofile);
    // Half as many more are refused, or asked about the server's health, at the same time.
    let needed = wanted.saturating_add(wanted / 2).saturating_add(OTHERS);
    let Some(current) = current.filter(|current| *current < needed) else { return wanted };
    let raised = maximum.map_or(needed, |maximum| maximum.min(needed));
    let raise = Rlimit { current: Some(raised), maximum };
    let have = if setrlimit(Resource::Nofile, raise).is_ok() { raised } else { current };
    (have.saturating_sub(OTHERS) / 3 * 2).clamp(1, wanted.max(1))
}

/// As many as wanted: the system's limit is not known.
#[cfg(not(target_os = "linux"))]
pub fn connections(wanted: u64) -> u64 {
    wanted
}
