//! File descriptors of the process: each connection takes one.

/// Descriptors for everything except client connections: the store, its readers, written files, libraries, and the
/// connections of probes.
#[cfg(target_os = "linux")]
const OTHERS: u64 = 96;

/// Number of connections for which there are descriptors, at most `wanted`. Raises the process's own limit if
/// permitted.
#[cfg(target_os = "linux")]
pub fn connections(wanted: u64) -> u64 {
    use rustix::process::{Resource, Rlimit, getrlimit, setrlimit};
    let Rlimit { current, maximum } = getrlimit(Resource::Nofile);
    // Half as many more connections may be refused, or be health probes, at the same time.
    let needed = wanted.saturating_add(wanted / 2).saturating_add(OTHERS);
    let Some(current) = current.filter(|current| *current < needed) else { return wanted };
    let raised = maximum.map_or(needed, |maximum| maximum.min(needed));
    let raise = Rlimit { current: Some(raised), maximum };
    let have = if setrlimit(Resource::Nofile, raise).is_ok() { raised } else { current };
    (have.saturating_sub(OTHERS) / 3 * 2).clamp(1, wanted.max(1))
}

/// As many as wanted, because the system's limit is unknown.
#[cfg(not(target_os = "linux"))]
pub fn connections(wanted: u64) -> u64 {
    wanted
}
