//! Facts about this process, under the names that Prometheus clients give them. Linux reports them in /proc.

use metrics::gauge;

/// Measures the process; does nothing on other systems.
pub fn measure() {
    let facts = facts().unwrap_or_default();
    for (name, value) in facts {
        gauge!(name).set(value);
    }
}

/// Times in /proc are in hundredths of a second, whatever the kernel's own clock.
#[cfg(target_os = "linux")]
const TICKS: f64 = 100.0;

#[cfg(target_os = "linux")]
fn facts() -> Option<[(&'static str, f64); 6]> {
    let stat = std::fs::read_to_string("/proc/self/stat").ok()?;
    // The second field, the name, is in parentheses and may contain anything.
    let fields: Vec<&str> = stat.rsplit_once(')')?.1.split_whitespace().collect();
    let number = |field: usize| fields.get(field - 3)?.parse::<f64>().ok();
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let resident = status.lines().find_map(|line| line.strip_prefix("VmRSS:")?.trim().strip_suffix(" kB"))?;
    let boot = std::fs::read_to_string("/proc/stat").ok()?;
    let boot_s: f64 = boot.lines().find_map(|line| line.strip_prefix("btime "))?.parse().ok()?;
    let descriptors = rustix::process::getrlimit(rustix::process::Resource::Nofile).current;
    Some([
        ("process_cpu_seconds_total", (number(14)? + number(15)?) / TICKS),
        ("process_threads", number(20)?),
        ("process_start_time_seconds", boot_s + number(22)? / TICKS),
        ("process_resident_memory_bytes", 1024.0 * resident.parse::<f64>().ok()?),
        ("process_open_fds", std::fs::read_dir("/proc/self/fd").ok()?.count() as f64),
        ("process_max_fds", descriptors.map_or(f64::INFINITY, |most| most as f64)),
    ])
}

#[cfg(not(target_os = "linux"))]
fn facts() -> Option<[(&'static str, f64); 6]> {
    None
}

#[cfg(all(test, target_os = "linux"))]
mod tests {
    #[test]
    fn a_process_has_a_size_and_a_start() {
        let facts: std::collections::HashMap<_, _> = super::facts().unwrap().into();
        assert!(facts["process_resident_memory_bytes"] > 1e6 && facts["process_open_fds"] >= 3.0);
        let now_s = std::time::SystemTime::UNIX_EPOCH.elapsed().unwrap().as_secs_f64();
        assert!((now_s - facts["process_start_time_seconds"]).abs() < 3_600.0);
        assert!(facts["process_cpu_seconds_total"] >= 0.0 && facts["process_threads"] >= 1.0);
    }
}
