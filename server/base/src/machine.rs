//! Resources of the machine: memory, disk space, kind and abilities of a file system.

use std::fs::File;
use std::io::{self, Write};
use std::path::Path;

/// Bytes that a probe writes: one page of the store.
const PROBE_BYTES: usize = 4_096;

/// Memory limit of the process, bytes, and its source: the machine, its control group (containers, systemd)
/// or a limit of address space. `None` if the system does not report it.
#[cfg(target_os = "linux")]
pub fn memory() -> Option<(u64, &'static str)> {
    let text = std::fs::read_to_string("/proc/meminfo").ok()?;
    let total = text.lines().find_map(|line| line.strip_prefix("MemTotal:")?.trim().strip_suffix(" kB"));
    let machine = total.and_then(|kib| kib.parse::<u64>().ok()).map(|kib| (kib << 10, "the machine"));
    let address_space = rustix::process::getrlimit(rustix::process::Resource::As).current;
    let address_space = address_space.map(|bytes| (bytes, "ulimit -v"));
    let all = [machine, control_group().map(|bytes| (bytes, "the control group")), address_space];
    all.into_iter().flatten().min()
}

/// The smallest limit of the process's control group and its parents (cgroups(7)).
#[cfg(target_os = "linux")]
fn control_group() -> Option<u64> {
    let groups = std::fs::read_to_string("/proc/self/cgroup").ok()?;
    let limits = groups.lines().filter_map(|line| {
        let (_, rest) = line.split_once(':')?;
        match rest.split_once(':')? {
            ("", path) => Some(("/sys/fs/cgroup", "memory.max", path)),
            (controllers, path) if controllers.split(',').any(|name| name == "memory") => {
                Some(("/sys/fs/cgroup/memory", "memory.limit_in_bytes", path))
            }
            _ => None,
        }
    });
    let of_group = |(root, file, path): (&str, &str, &str)| {
        let above =
            Path::new(path).ancestors().map(|path| path.to_string_lossy().trim_start_matches('/').to_owned());
        let read = |path: String| std::fs::read_to_string(Path::new(root).join(path).join(file)).ok();
        // "max" is not a number.
        above.filter_map(read).filter_map(|text| text.trim().parse::<u64>().ok()).min()
    };
    limits.filter_map(of_group).min()
}

/// Unknown on other systems.
#[cfg(not(target_os = "linux"))]
pub fn memory() -> Option<(u64, &'static str)> {
    None
}

/// Bytes that this process can still write to a folder's file system; `None` if the system does not report
/// it.
#[cfg(target_os = "linux")]
pub fn free_bytes(folder: &Path) -> Option<u64> {
    let found = rustix::fs::statvfs(folder).ok()?;
    Some(found.f_bavail.saturating_mul(found.f_frsize))
}

/// Unknown on other systems.
#[cfg(not(target_os = "linux"))]
pub fn free_bytes(_: &Path) -> Option<u64> {
    None
}

/// Name of a network file system, on which a store must not lie: SQLite's log needs memory that all its users
/// share.
#[cfg(target_os = "linux")]
pub fn network_file_system(folder: &Path) -> Option<&'static str> {
    // Numbers of statfs(2).
    const SHARED: [(u64, &str); 7] = [
        (0x6969, "NFS"),
        (0xff53_4d42, "CIFS"),
        (0xfe53_4d42, "SMB"),
        (0x517b, "SMB"),
        (0x0102_1997, "9P"),
        (0x00c3_6400, "Ceph"),
        (0x7461_636f, "OCFS2"),
    ];
    let kind = rustix::fs::statfs(folder).ok()?.f_type as u64 & 0xffff_ffff;
    SHARED.iter().find(|(number, _)| *number == kind).map(|(_, name)| *name)
}

/// Unknown on other systems.
#[cfg(not(target_os = "linux"))]
pub fn network_file_system(_: &Path) -> Option<&'static str> {
    None
}

/// Tries the operations of a store in a folder: creates a file, writes, locks, syncs, renames and removes it.
///
/// # Errors
/// The name of the first step that fails.
pub fn try_folder(folder: &Path) -> Result<(), (&'static str, io::Error)> {
    let at = |step: &'static str| move |error: io::Error| (step, error);
    let probe =
        tempfile::Builder::new().prefix(".dragtraffic-").tempfile_in(folder).map_err(at("making a file"))?;
    let mut file = probe.as_file();
    file.write_all(&[0; PROBE_BYTES]).map_err(at("writing"))?;
    lock(file).map_err(at("locking"))?;
    file.sync_all().map_err(at("syncing a file"))?;
    let renamed = probe.path().with_extension("renamed");
    let kept = probe.persist(&renamed).map_err(|error| ("renaming", error.error))?;
    drop(kept);
    std::fs::remove_file(&renamed).map_err(at("removing"))?;
    if cfg!(unix) {
        File::open(folder).and_then(|folder| folder.sync_all()).map_err(at("syncing the folder"))?;
    }
    Ok(())
}

/// Uses the kind of lock that SQLite takes.
#[cfg(target_os = "linux")]
fn lock(file: &File) -> io::Result<()> {
    Ok(rustix::fs::fcntl_lock(file, rustix::fs::FlockOperation::NonBlockingLockExclusive)?)
}

#[cfg(not(target_os = "linux"))]
fn lock(file: &File) -> io::Result<()> {
    Ok(file.try_lock()?)
}

#[cfg(all(test, target_os = "linux"))]
mod tests {
    use super::{free_bytes, memory, network_file_system, try_folder};
    use std::path::Path;

    #[test]
    fn the_machine_reports_memory_and_room() {
        let (bytes, what) = memory().unwrap();
        assert!(bytes > 1 << 24 && !what.is_empty(), "{bytes} {what}");
        let folder = tempfile::tempdir().unwrap();
        assert!(free_bytes(folder.path()).is_some() && network_file_system(folder.path()).is_none());
        assert_eq!(free_bytes(Path::new("/none")), None);
    }

    #[test]
    fn a_folder_is_tried_and_left_as_it_was() {
        let folder = tempfile::tempdir().unwrap();
        try_folder(folder.path()).unwrap();
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
        let refused = try_folder(&folder.path().join("none")).unwrap_err();
        assert_eq!(refused.0, "making a file");
        assert_eq!(try_folder(Path::new("/proc")).unwrap_err().0, "making a file");
    }
}
