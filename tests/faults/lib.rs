//! Makes files fail: loaded before the system's library (`LD_PRELOAD`), it stands in for the calls that write and read
//! files, and has some of them fail as the plan says. Only files below one folder are concerned.
//!
//! The plan is a small file that this process and the one that makes the plans share in memory; its words are
//! described in `dragtraffic_tests::faults`.

#![cfg(target_os = "linux")]
#![allow(unsafe_code, reason = "it takes the place of C functions, and speaks to the kernel in their stead")]
#![allow(missing_docs, reason = "they are the C library's functions")]
#![allow(clippy::missing_safety_doc, reason = "as the C library's own")]

use libc::{c_char, c_int, c_long, c_void, off_t, size_t, ssize_t};
use std::sync::atomic::{AtomicPtr, AtomicU64, Ordering};

/// The words of the plan, in their order in the file.
#[repr(C)]
struct Plan {
    /// Bits of the calls that fail; 0 for none.
    calls: AtomicU64,
    /// The error that they give.
    errno: AtomicU64,
    /// Not 0: the first of them writes half of what it is given before the others fail.
    short: AtomicU64,
    /// Calls that succeed before.
    before: AtomicU64,
    /// Calls that fail then.
    failing: AtomicU64,
    /// Number of failed calls since the start.
    failed: AtomicU64,
}

const WRITE: u64 = 1;
const SYNC: u64 = 2;
const RENAME: u64 = 4;
const TRUNCATE: u64 = 8;
const READ: u64 = 16;

static PLAN: AtomicPtr<Plan> = AtomicPtr::new(std::ptr::null_mut());

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
        let file = libc::open(path, libc::O_RDWR | libc::O_CLOEXEC);
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

/// The file lies below the folder that is to fail.
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

/// The same of an open file.
fn is_concerned(file: c_int) -> bool {
    let mut link = *b"/proc/self/fd/0000000000\0";
    let digits = link.len() - 1;
    let mut rest = file;
    if rest < 0 {
        return false;
    }
    // Leading zeros are not understood there: the digits are put to the front afterwards.
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
    let mut path = [0_u8; 4096];
    // SAFETY: both buffers are valid for their whole lengths.
    let length = unsafe { libc::readlink(link.as_ptr().cast(), path.as_mut_ptr().cast(), path.len()) };
    usize::try_from(length).is_ok_and(|length| is_below(&path[..length]))
}

fn is_named(path: *const c_char) -> bool {
    // SAFETY: callers hand in a string that ends with zero, as they do to the C library.
    is_below(unsafe { std::slice::from_raw_parts(path.cast::<u8>(), libc::strlen(path)) })
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn write(file: c_int, bytes: *const c_void, count: size_t) -> ssize_t {
    let count = match fate(WRITE, || is_concerned(file)) {
        Fate::Done => count,
        Fate::Half => count.div_ceil(2),
        Fate::Fails => return -1,
    };
    // SAFETY: what the caller promises to the C library.
    unsafe { libc::syscall(libc::SYS_write, file, bytes, count) as ssize_t }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn pwrite64(file: c_int, bytes: *const c_void, count: size_t, at: off_t) -> ssize_t {
    let count = match fate(WRITE, || is_concerned(file)) {
        Fate::Done => count,
        Fate::Half => count.div_ceil(2),
        Fate::Fails => return -1,
    };
    // SAFETY: what the caller promises to the C library.
    unsafe { libc::syscall(libc::SYS_pwrite64, file, bytes, count, at) as ssize_t }
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
        // SAFETY: what the caller promises to the C library.
        _ => unsafe { libc::syscall(libc::SYS_read, file, bytes, count) as ssize_t },
    }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn pread64(file: c_int, bytes: *mut c_void, count: size_t, at: off_t) -> ssize_t {
    match fate(READ, || is_concerned(file)) {
        Fate::Fails => -1,
        // SAFETY: what the caller promises to the C library.
        _ => unsafe { libc::syscall(libc::SYS_pread64, file, bytes, count, at) as ssize_t },
    }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn pread(file: c_int, bytes: *mut c_void, count: size_t, at: off_t) -> ssize_t {
    // SAFETY: as the caller's.
    unsafe { pread64(file, bytes, count, at) }
}

/// The kernel's answer to a call that takes one file and perhaps a length.
fn done(call: u64, number: c_long, file: c_int, length: off_t) -> c_int {
    match fate(call, || is_concerned(file)) {
        Fate::Fails => -1,
        // SAFETY: the call takes plain numbers.
        _ => unsafe { libc::syscall(number, file, length) as c_int },
    }
}

#[unsafe(no_mangle)]
pub extern "C" fn fsync(file: c_int) -> c_int {
    done(SYNC, libc::SYS_fsync, file, 0)
}

#[unsafe(no_mangle)]
pub extern "C" fn fdatasync(file: c_int) -> c_int {
    done(SYNC, libc::SYS_fdatasync, file, 0)
}

#[unsafe(no_mangle)]
pub extern "C" fn ftruncate(file: c_int, length: off_t) -> c_int {
    done(TRUNCATE, libc::SYS_ftruncate, file, length)
}

#[unsafe(no_mangle)]
pub extern "C" fn ftruncate64(file: c_int, length: off_t) -> c_int {
    done(TRUNCATE, libc::SYS_ftruncate, file, length)
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn rename(from: *const c_char, to: *const c_char) -> c_int {
    match fate(RENAME, || is_named(to)) {
        Fate::Fails => -1,
        // SAFETY: what the caller promises to the C library.
        _ => unsafe {
            libc::syscall(libc::SYS_renameat2, libc::AT_FDCWD, from, libc::AT_FDCWD, to, 0) as c_int
        },
    }
}
