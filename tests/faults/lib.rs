//! Makes file operations fail. The library is loaded before the system's (`LD_PRELOAD`), replaces the calls
//! that write and read files, and fails some of them as the plan says. Only files below one folder are
//! affected.
//!
//! The plan is a small file that this process and the test map as shared memory; `dragtraffic_tests::faults`
//! describes its words. If `FAULTS_JOURNAL` names a file, every change is recorded there, and the process
//! ends in the middle of its work when the plan says so ([`journal`]).

#![cfg(target_os = "linux")]
#![allow(unsafe_code, reason = "it takes the place of C functions, and speaks to the kernel in their stead")]
#![allow(missing_docs, reason = "they are the C library's functions")]
#![allow(clippy::missing_safety_doc, reason = "as the C library's own")]

mod journal;

use libc::{c_char, c_int, c_long, c_uint, c_void, mode_t, off_t, size_t, ssize_t};
use std::sync::atomic::{AtomicPtr, AtomicU64, Ordering};

/// The words of the plan, in their order in the file.
#[repr(C)]
struct Plan {
    /// Bits of the calls that fail; 0 for none.
    calls: AtomicU64,
    /// The error of a failed call.
    errno: AtomicU64,
    /// Not 0: the first failing call writes half of its bytes before the others fail.
    short: AtomicU64,
    /// Number of calls that succeed first.
    before: AtomicU64,
    /// Number of calls that fail then.
    failing: AtomicU64,
    /// Number of failed calls since the start.
    failed: AtomicU64,
    /// Changes until the power fails; 0 once it has failed.
    power: AtomicU64,
    /// Not 0: the disk reports a sync that it did not make.
    lies: AtomicU64,
}

const WRITE: u64 = 1;
const SYNC: u64 = 2;
const RENAME: u64 = 4;
const TRUNCATE: u64 = 8;
const READ: u64 = 16;

static PLAN: AtomicPtr<Plan> = AtomicPtr::new(std::ptr::null_mut());

/// Opens a file directly through the kernel, not through the functions below.
///
/// # Safety
/// The path ends with a zero byte.
unsafe fn open_plainly(path: *const c_char, flags: c_int) -> c_int {
    // SAFETY: the caller's promise.
    unsafe { libc::syscall(libc::SYS_openat, libc::AT_FDCWD, path, flags | libc::O_CLOEXEC, 0) as c_int }
}

/// The plan in memory, mapped at the first call.
fn plan() -> Option<&'static Plan> {
    let known = PLAN.load(Ordering::Acquire);
    if !known.is_null() {
        // SAFETY: it was mapped below, and stays mapped.
        return Some(unsafe { &*known });
    }
    // SAFETY: plain calls with checked results. Mapping it twice at the same time is harmless.
    unsafe {
        let path = libc::getenv(c"FAULTS_PLAN".as_ptr());
        if path.is_null() {
            return None;
        }
        let file = open_plainly(path, libc::O_RDWR);
        if file < 0 {
            return None;
        }
        let (size, way) = (size_of::<Plan>(), libc::PROT_READ | libc::PROT_WRITE);
        let at = libc::mmap(std::ptr::null_mut(), size, way, libc::MAP_SHARED, file, 0);
        libc::close(file);
        if at == libc::MAP_FAILED {
            return None;
        }
        PLAN.store(at.cast(), Ordering::Release);
        Some(&*at.cast())
    }
}

/// Outcome of a call.
enum Fate {
    Done,
    Half,
    Fails,
}

/// Outcome of a call; `concerned` decides whether the plan applies to it.
fn fate(call: u64, concerned: impl FnOnce() -> bool) -> Fate {
    let Some(plan) = plan() else { return Fate::Done };
    if plan.calls.load(Ordering::Acquire) & call == 0 || !concerned() {
        return Fate::Done;
    }
    let one_less = |left: u64| left.checked_sub(1);
    if plan.before.fetch_update(Ordering::AcqRel, Ordering::Acquire, one_less).is_ok() {
        return Fate::Done;
    }
    if plan.failing.fetch_update(Ordering::AcqRel, Ordering::Acquire, one_less).is_err() {
        return Fate::Done;
    }
    plan.failed.fetch_add(1, Ordering::AcqRel);
    if call == WRITE && plan.short.swap(0, Ordering::AcqRel) != 0 {
        return Fate::Half;
    }
    // SAFETY: errno is this thread's own.
    unsafe { *libc::__errno_location() = plan.errno.load(Ordering::Acquire) as c_int };
    Fate::Fails
}

/// Whether the file lies below the affected folder.
fn is_below(path: &[u8]) -> bool {
    // SAFETY: the environment is not changed while the program runs, and its strings end with zero.
    let folder = unsafe {
        let folder = libc::getenv(c"FAULTS_FOLDER".as_ptr());
        if folder.is_null() {
            return false;
        }
        std::slice::from_raw_parts(folder.cast::<u8>(), libc::strlen(folder))
    };
    path.starts_with(folder)
}

/// The path of an open file, in this buffer.
fn path_of(file: c_int, path: &mut [u8; 4096]) -> Option<&[u8]> {
    let mut link = *b"/proc/self/fd/0000000000\0";
    let digits = link.len() - 1;
    let mut rest = file;
    if rest < 0 {
        return None;
    }
    // The kernel rejects leading zeros: the digits are moved to the front afterwards.
    let mut at = digits;
    loop {
        at -= 1;
        link[at] = b'0' + (rest % 10) as u8;
        rest /= 10;
        if rest == 0 {
            break;
        }
    }
    let first = b"/proc/self/fd/".len();
    link.copy_within(at..=digits, first);
    // SAFETY: both buffers are valid for their whole lengths.
    let length = unsafe { libc::readlink(link.as_ptr().cast(), path.as_mut_ptr().cast(), path.len()) };
    usize::try_from(length).ok().map(|length| &path[..length])
}

/// Whether the plan applies to an open file.
fn is_concerned(file: c_int) -> bool {
    path_of(file, &mut [0; 4096]).is_some_and(is_below)
}

/// The bytes of a path.
fn named<'a>(path: *const c_char) -> &'a [u8] {
    // SAFETY: callers hand in a string that ends with zero, as they do to the C library.
    unsafe { std::slice::from_raw_parts(path.cast::<u8>(), libc::strlen(path)) }
}

fn is_named(path: *const c_char) -> bool {
    is_below(named(path))
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn write(file: c_int, bytes: *const c_void, count: size_t) -> ssize_t {
    let count = match fate(WRITE, || is_concerned(file)) {
        Fate::Done => count,
        Fate::Half => count.div_ceil(2),
        Fate::Fails => return -1,
    };
    // SAFETY: the caller's promise to the C library.
    journal::written(file, bytes, None, || unsafe {
        libc::syscall(libc::SYS_write, file, bytes, count) as ssize_t
    })
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn pwrite64(file: c_int, bytes: *const c_void, count: size_t, at: off_t) -> ssize_t {
    let count = match fate(WRITE, || is_concerned(file)) {
        Fate::Done => count,
        Fate::Half => count.div_ceil(2),
        Fate::Fails => return -1,
    };
    // SAFETY: the caller's promise to the C library.
    journal::written(file, bytes, Some(at), || unsafe {
        libc::syscall(libc::SYS_pwrite64, file, bytes, count, at) as ssize_t
    })
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn pwrite(file: c_int, bytes: *const c_void, count: size_t, at: off_t) -> ssize_t {
    // SAFETY: as the caller's.
    unsafe { pwrite64(file, bytes, count, at) }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn read(file: c_int, bytes: *mut c_void, count: size_t) -> ssize_t {
    match fate(READ, || is_concerned(file)) {
        Fate::Fails => -1,
        // SAFETY: the caller's promise to the C library.
        _ => unsafe { libc::syscall(libc::SYS_read, file, bytes, count) as ssize_t },
    }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn pread64(file: c_int, bytes: *mut c_void, count: size_t, at: off_t) -> ssize_t {
    match fate(READ, || is_concerned(file)) {
        Fate::Fails => -1,
        // SAFETY: the caller's promise to the C library.
        _ => unsafe { libc::syscall(libc::SYS_pread64, file, bytes, count, at) as ssize_t },
    }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn pread(file: c_int, bytes: *mut c_void, count: size_t, at: off_t) -> ssize_t {
    // SAFETY: as the caller's.
    unsafe { pread64(file, bytes, count, at) }
}

/// Syncs a file, or the names in a folder.
fn synced(number: c_long, file: c_int) -> c_int {
    match fate(SYNC, || is_concerned(file)) {
        Fate::Fails => -1,
        // SAFETY: the call takes a plain number.
        _ => journal::synced(file, || unsafe { libc::syscall(number, file) as c_int }),
    }
}

#[unsafe(no_mangle)]
pub extern "C" fn fsync(file: c_int) -> c_int {
    synced(libc::SYS_fsync, file)
}

#[unsafe(no_mangle)]
pub extern "C" fn fdatasync(file: c_int) -> c_int {
    synced(libc::SYS_fdatasync, file)
}

#[unsafe(no_mangle)]
pub extern "C" fn ftruncate(file: c_int, length: off_t) -> c_int {
    match fate(TRUNCATE, || is_concerned(file)) {
        Fate::Fails => -1,
        // SAFETY: the call takes plain numbers.
        _ => journal::resized(file, length, || unsafe {
            libc::syscall(libc::SYS_ftruncate, file, length) as c_int
        }),
    }
}

#[unsafe(no_mangle)]
pub extern "C" fn ftruncate64(file: c_int, length: off_t) -> c_int {
    ftruncate(file, length)
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn rename(from: *const c_char, to: *const c_char) -> c_int {
    match fate(RENAME, || is_named(to)) {
        Fate::Fails => -1,
        // SAFETY: the caller's promise to the C library.
        _ => journal::renamed(named(from), named(to), || unsafe {
            libc::syscall(libc::SYS_renameat2, libc::AT_FDCWD, from, libc::AT_FDCWD, to, 0) as c_int
        }),
    }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn unlink(path: *const c_char) -> c_int {
    // SAFETY: the caller's promise to the C library.
    journal::removed(named(path), || unsafe {
        libc::syscall(libc::SYS_unlinkat, libc::AT_FDCWD, path, 0) as c_int
    })
}

/// The mode is optional in C; its register can be read in any case on the supported machines.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn openat(folder: c_int, path: *const c_char, flags: c_int, mode: mode_t) -> c_int {
    // SAFETY: the caller's promise to the C library.
    journal::opened(flags, || unsafe {
        libc::syscall(libc::SYS_openat, folder, path, flags, c_uint::from(mode)) as c_int
    })
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn openat64(folder: c_int, path: *const c_char, flags: c_int, mode: mode_t) -> c_int {
    // SAFETY: as the caller's.
    unsafe { openat(folder, path, flags, mode) }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn open(path: *const c_char, flags: c_int, mode: mode_t) -> c_int {
    // SAFETY: as the caller's.
    unsafe { openat(libc::AT_FDCWD, path, flags, mode) }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn open64(path: *const c_char, flags: c_int, mode: mode_t) -> c_int {
    // SAFETY: as the caller's.
    unsafe { openat(libc::AT_FDCWD, path, flags, mode) }
}
